//! Analyses scenes, and writes the results as JSON.

use super::Refusal;
use super::option::CheckOptions;
use crate::analysis::Analysis;
use crate::result::{Layout, Timing, to_json, to_json_of, to_json_with_blocks};

/// Analyses a scene, and returns the same JSON as `drystone check --json`.
pub(super) fn checked(scene: &str, options: &CheckOptions) -> Result<String, Refusal> {
    Ok(written(options.analysis(scene)?, options))
}

/// Writes an analysis as JSON.
pub(super) fn written(mut found: Analysis, options: &CheckOptions) -> String {
    if options.no_notes {
        found.notes.clear();
    }
    let timing = match options.timing {
        true => Timing::Included,
        false => Timing::LeftOut,
    };
    let file = options.file.as_deref();
    match (options.blocks, file) {
        (true, file) => to_json_with_blocks(file, &found, timing, Layout::Lines),
        (false, Some(file)) => to_json_of(file, &found, timing, Layout::Lines),
        (false, None) => to_json(&found, timing, Layout::Lines),
    }
}
