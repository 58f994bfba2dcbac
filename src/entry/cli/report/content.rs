//! [`entry`]: the content of a report on one scene, or on two scenes that are compared.

use crate::entry::cli::missing_glyphs;
use crate::entry::cli::source::Source;
use crate::mechanics::analysis::Analysis;
use crate::pictures::output::fonts::Fonts;
use crate::products::report::entry::{Entry, File, ReportOptions, Side, compared};

/// Returns the report entry of one scene, or of two scenes that are compared. Returns `None` if there is no scene.
pub(super) fn entry(read: &[(Source, String)], analyses: &[Analysis], report_options: &ReportOptions) -> Option<Entry> {
    let names: Vec<String> = read.iter().map(|(s, _)| shown(s)).collect();
    let file = |i: usize| File { name: &names[i], text: &read[i].1 };
    match analyses {
        [was, is] => {
            let side = |i: usize, analysis| Side { file: file(i), analysis };
            Some(compared([side(0, was), side(1, is)], report_options))
        }
        [one, ..] => Some(Entry::new(file(0), one, report_options)),
        [] => None,
    }
}

/// If a scene has characters that drystone's fonts lack, draws the figures of the entry again with code points instead
/// of these characters. The other text stays unchanged, because the program that shows the Markdown has its own fonts.
pub(super) fn make_figures_legible(
    entry: &mut Entry,
    read: &[(Source, String)],
    mut analyses: Vec<Analysis>,
    report_options: &ReportOptions,
) {
    let fonts = Fonts::default();
    let lacks = |analysis: &Analysis| missing_glyphs::lacks(&analysis.scene, &fonts);
    if !analyses.iter().any(lacks) {
        return;
    }
    for analysis in &mut analyses {
        analysis.scene = missing_glyphs::legible(&analysis.scene, &fonts).into();
    }
    if let Some(drawn) = self::entry(read, &analyses, report_options) {
        entry.take_figures(drawn);
    }
}

/// Returns the path of a source: as the user typed it, or, for a scene in a folder that the user typed, the path of the
/// folder followed by the path inside it.
fn shown(source: &Source) -> String {
    source.path.display().to_string()
}
