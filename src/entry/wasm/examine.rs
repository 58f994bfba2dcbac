//! Analyses scenes, and writes the results as JSON.

use super::Refusal;
use super::option::CheckOptions;
use crate::mechanics::analysis::Analysis;
use crate::products::result::{Layout, Timing, to_json, to_json_of, to_json_with_blocks};

/// Analyses a scene, and returns the JSON of `drystone check --json`, without times unless the options request them.
pub(super) fn checked(scene: &str, options: &CheckOptions) -> Result<String, Refusal> {
    Ok(written(options.analysis(scene)?, options))
}

/// Returns an analysis as JSON. The options select whether it contains notes, times, blocks and the name of the file.
pub(super) fn written(mut analysis: Analysis, options: &CheckOptions) -> String {
    if options.no_notes {
        analysis.notes.clear();
    }
    let timing = match options.timing {
        true => Timing::Included,
        false => Timing::LeftOut,
    };
    let file = options.file.as_deref();
    match (options.blocks, file) {
        (true, file) => to_json_with_blocks(file, &analysis, timing, Layout::Lines),
        (false, Some(file)) => to_json_of(file, &analysis, timing, Layout::Lines),
        (false, None) => to_json(&analysis, timing, Layout::Lines),
    }
}
