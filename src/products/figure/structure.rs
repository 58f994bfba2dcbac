//! Draws the structure without its solution, for exercises: the blocks, the ground, the robots and the loads. If the
//! analysis has found out which blocks may leave, a second outline inside each block shows it.

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::panel::{About, Figure};
use super::stage;
use crate::mechanics::analysis::{Removable, Verdict};
use crate::pictures::drawing::{Outline, PagePoint, Path};

/// The distance of the second outline from that of its block, mm.
const INSET: f64 = 0.75;

/// The figure of a structure without its solution.
pub(crate) struct Structure;

impl Figure for Structure {
    fn about(&self) -> About {
        About {
            hides_verdicts: true,
            ..About::new(
                "structure",
                "The structure and its loads without forces and verdict, for exercises; --dimensions adds its size, --removable shows which blocks may leave",
                "A dry-laid structure",
            )
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        stage::listed_contacts(canvas);
        for row in canvas.found().removable.iter().flatten() {
            outline(canvas, row);
        }
    }
}

/// Draws the second outline of a block.
fn outline(canvas: &mut Canvas<'_>, row: &Removable) {
    let theme = canvas.theme();
    let (rank, words, stroke) = match (row.rest, row.help) {
        (Verdict::Stable, _) => (10, "may leave", canvas.pen(theme.motion, 0.55)),
        (Verdict::Unstable, Some(_)) => {
            (11, "may leave while a robot holds another", canvas.dashes(theme.motion, 0.55, [1.1, 0.7]))
        }
        (Verdict::Unstable, None) => (12, "may not leave", canvas.pen(theme.faint, 0.16)),
        (Verdict::Undecided, _) => (13, "undecided", canvas.dashes(theme.faint, 0.3, [0.3, 0.6])),
    };
    let key = Key::block(rank, words, canvas.look, |small| vec![Path::stroked(small, stroke.clone())]);
    let block = &canvas.scene().blocks[row.block.0];
    let ring: Vec<PagePoint> = block.body.polygon.outline().iter().map(|corner| canvas.place(*corner)).collect();
    // The outline of a small block is nearer to its edge.
    let inset = canvas.mm(INSET).min(0.12 * canvas.camera.length(block.body.polygon.area().sqrt()));
    let path = Path::stroked(Outline::ring(inside(&ring, inset)), stroke);
    let mark = Mark::new(Layer::Force, "removable", vec![path]).titled(format!("Block {}: {words}", block.id));
    canvas.put(mark.keyed(&key).avoided(0.1));
}

/// Moves every side of an outline inside by `inset`. The corners of a block are anticlockwise in the scene, so on the page,
/// where y points down, its inside lies to the right of a side in the direction of travel.
fn inside(ring: &[PagePoint], inset: f64) -> Vec<PagePoint> {
    let count = ring.len();
    let normal = |number: usize| {
        let (from, to) = (ring[number % count], ring[(number + 1) % count]);
        let length = from.distance(to).max(1e-9);
        ((to.y - from.y) / length, (from.x - to.x) / length)
    };
    let corner = |number: usize| {
        let (before, after) = (normal(number + count - 1), normal(number));
        // Sharp corners move at most three times as far as the sides.
        let share = inset / (1.0 + before.0 * after.0 + before.1 * after.1).max(0.25);
        ring[number].moved(share * (before.0 + after.0), share * (before.1 + after.1))
    };
    (0..count).map(corner).collect()
}
