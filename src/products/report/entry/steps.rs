//! [`sections`] makes the sections of a report on a scene: the main section about the governing step, with a
//! table of all steps, then pictures of other steps that do not stand, and in a full report an appendix for each step.

use super::governing::{governing, headline_words};
use super::joints::Ranking;
use super::row::thumbnail;
use super::sheet::{empty, others, sheet};
use super::{Grid, ReportOptions, Section, TableCell, full};
use crate::mechanics::analysis::{Analysis, Verdict};
use crate::products::wording::number::letter;
use crate::products::wording::verdict::plain;
use crate::text::line;

/// Largest number of steps that do not stand and are drawn in addition to the governing step. A full report draws all
/// of them.
const MAX_FALLING_STEPS: usize = 4;

/// Makes the sections of a report on a scene.
pub(super) fn sections(analysis: &Analysis, report_options: &ReportOptions) -> Vec<Section> {
    let count = analysis.frames.len();
    let governing = governing(analysis);
    let steps = (count > 1).then(|| table(analysis));
    let mut first = sheet(analysis, governing, steps, report_options);
    if count > 1 {
        first.title = format!("{} (the step that governs)", first.title);
    }
    let mut sections = vec![first];
    let falling = (0..count).filter(|n| analysis.frames[*n].verdict != Verdict::Stable && *n != governing);
    let falling: Vec<usize> = falling.take(if report_options.full { count } else { MAX_FALLING_STEPS }).collect();
    if !falling.is_empty() {
        let mut section = empty(&analysis.scene, governing, analysis.verdict());
        (section.letter, section.title) = (String::new(), "Other steps that do not stand".to_owned());
        section.parts = others(analysis, &falling, report_options);
        sections.push(section);
    }
    if report_options.full {
        sections.extend((0..count).map(|number| full::appendix(analysis, number, report_options)));
    }
    sections
}

fn table(analysis: &Analysis) -> Grid {
    let scene = &analysis.scene;
    let mut grid = Grid::new("", &["picture", "step", "verdict", "headline margin", "governing joint"]);
    for (number, frame_analysis) in analysis.frames.iter().enumerate() {
        let title = match scene.frames[number].title.as_str() {
            "" => format!("Step {}", number + 1),
            title => line(title),
        };
        let headline = match headline_words(scene, number, frame_analysis) {
            words if words.is_empty() => "–".to_owned(),
            words => words,
        };
        let governing = Ranking::new(scene, frame_analysis).governing();
        grid.add(
            "",
            [
                TableCell::picture(thumbnail(scene, &scene.frames[number].placed)),
                format!("({}) {title}", letter(number)).into(),
                TableCell::strong_if(frame_analysis.verdict != Verdict::Stable, plain(frame_analysis.verdict)),
                headline.into(),
                governing.unwrap_or_else(|| "–".to_owned()).into(),
            ],
        );
    }
    grid
}
