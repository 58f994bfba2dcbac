//! Draws which blocks may leave: the colour of a block says whether the rest stands without it, whether it stands while a
//! robot holds another block, or neither.

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::option::Options;
use super::panel::{About, Figure};
use super::placing::Label;
use super::stage;
use crate::mechanics::analysis::{Analysis, Removable, Verdict};
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Theme};
use crate::products::wording::question::removable_phrases;
use crate::products::wording::verdict;

/// Structures of at most this many blocks state the help that each block needs.
const MAX_AMOUNTS: usize = 16;
/// Width and height of a symbol in the key, mm.
const KEY_SIZE: (f64, f64) = (3.2, 2.2);

/// The figure of the blocks that may leave.
pub(crate) struct RemovableBlocks;

impl Figure for RemovableBlocks {
    fn about(&self) -> About {
        About {
            needs_removable: true,
            ..About::new(
                "removable",
                "Which blocks may leave: without help, while a robot holds another block, or not",
                "Blocks that may leave a dry-laid structure",
            )
        }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _options: &Options) -> Vec<String> {
        let (scene, found) = analysis.at(frame);
        match (&found.removable, found.verdict) {
            (_, Verdict::Undecided) => vec![verdict::reason(scene, found)],
            (rows, _) => removable_phrases(scene, rows.as_deref().unwrap_or_default()),
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        let rows = canvas.found().removable.as_deref().unwrap_or_default();
        let states_amounts = rows.len() <= MAX_AMOUNTS && canvas.options.main_amounts;
        if states_amounts {
            canvas.mentioned = rows.iter().filter_map(|row| Some(row.help?.block)).collect();
        }
        for row in rows {
            block(canvas, row, states_amounts);
        }
    }
}

/// Returns the rank of a block's group in the key, its words, its fill, and whether its outline is bold.
fn group(row: &Removable, theme: &Theme) -> (u8, &'static str, Colour, bool) {
    match (row.rest, row.help) {
        (Verdict::Stable, _) => (10, "the rest stands without it", theme.stands.mixed(theme.page, 0.78), false),
        (Verdict::Undecided, _) => (13, "undecided", theme.undecided.mixed(theme.page, 0.6), true),
        (Verdict::Unstable, Some(_)) => {
            (11, "the rest stands if a robot holds one more block", theme.robot(0).mixed(theme.page, 0.4), false)
        }
        (Verdict::Unstable, None) => {
            (12, "the rest falls, and one robot cannot help", theme.faint.mixed(theme.page, 0.5), true)
        }
    }
}

/// Draws one block in the colour of its group, with the help that it needs.
fn block(canvas: &mut Canvas<'_>, row: &Removable, states_amount: bool) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let (rank, words, fill, is_bold) = group(row, theme);
    let edge = canvas.pen(theme.outline, if is_bold { 0.4 } else { 0.2 });
    let (wide, high) = (canvas.mm(KEY_SIZE.0), canvas.mm(KEY_SIZE.1) / 2.0);
    let corners = [(0.0, -high), (wide, -high), (wide, high), (0.0, high)];
    let symbol = Outline::ring(corners.map(|(x, y)| PagePoint::new(x, y)));
    let symbol = vec![Path::filled(symbol, fill).with_stroke(edge.clone())];
    let key = Key::new(rank, words, symbol, wide);
    let block = &scene.blocks[row.block.0];
    let outline = canvas.camera.polygon(&block.body.polygon);
    let inner = stage::seams(&block.body, scene.lattice, &canvas.camera);
    let seams = Path::stroked(inner, canvas.pen(theme.seam_on(fill, 0.22), 0.1));
    let help = row.help.map(|help| {
        let force = canvas.newtons(help.force);
        (format!("{force} on {}", scene.blocks[help.block.0].id), help)
    });
    let title = match &help {
        Some((words, _)) => format!("Block {}: the rest stands with {words}", block.id),
        None => format!("Block {}: {words}", block.id),
    };
    let shapes = vec![Path::filled(outline, fill).with_stroke(edge), seams];
    canvas.put(Mark::new(Layer::Stone, "removable", shapes).titled(title).keyed(&key));
    if let Some((words, _)) = help.filter(|_| states_amount) {
        let at = canvas.place(block.centroid);
        canvas.label(Label::new(words, theme.ink, vec![at], 60));
    }
}
