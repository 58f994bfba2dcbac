//! Writes the heading of a free-body diagram: the title of the scene, the name of the block, and the step of the
//! construction.

use super::{HEADING_SIZE, MARGIN, SUBHEADING_SIZE};
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::{Face, text};
use crate::products::figure::option::Options;
use crate::products::figure::words::letter;

/// Returns the lines of the heading, each with its font and its font size in pixels. The list is empty if the options
/// exclude titles. `width` is the width of the page in pixels.
pub(super) fn heading(
    analysis: &Analysis,
    frame: usize,
    block: BlockId,
    options: &Options,
    width: f64,
) -> Vec<(String, Face, f64)> {
    if !options.titles {
        return Vec::new();
    }
    let scene = &analysis.scene;
    let mut which = format!("Block {} cut free", scene.blocks[block.0].id);
    if scene.frames.len() > 1 {
        let step = &scene.frames[frame].title;
        let (letter, count) = (letter(frame), scene.frames.len());
        which.push_str(&format!(", step ({letter}) of {count}"));
        if !step.is_empty() {
            which.push_str(&format!(": {step}"));
        }
    }
    let room = width - 2.0 * MARGIN;
    let broken = |words: &str, most: usize, face: Face, size: f64| {
        let lines = text::balanced(words, face, size, room, most);
        lines.into_iter().map(move |line| (line, face, size))
    };
    let mut lines = Vec::new();
    if !scene.title.is_empty() {
        lines.extend(broken(&scene.title, 3, Face::SerifBold, HEADING_SIZE));
    }
    lines.extend(broken(&which, 3, Face::Serif, SUBHEADING_SIZE));
    lines
}
