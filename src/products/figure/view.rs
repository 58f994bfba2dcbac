//! [`shown`]: computes the part of the scene that the panel of each frame shows. Ground far from the blocks is cut off.

use super::arrow::Marks;
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::scene::{BlockId, Frame, Scene};
use crate::pictures::drawing::arrow::HEAD_WIDTH;

/// The width of ground shown beyond the blocks, as a fraction of the structure's diagonal; at least one unit length is
/// shown.
const SIDE_GROUND_SHARE: f64 = 0.12;
/// A piece of ground near the structure is not cut if both its width and its height are at most this, unit lengths.
const MAX_UNCUT_GROUND: f64 = 3.0;
/// Distance from a block to the edge of its zoomed view, as a fraction of the block's larger side.
const ZOOM_PADDING: f64 = 0.5;
/// Space around all shown items, unit lengths.
const PADDING: f64 = 0.08;

/// Returns, for each frame, a box in metres around everything that the frame shows: blocks, planned blocks, arrows
/// (`marks`), robots, the box `reach` of other items, and the ground near the blocks of any frame. `disc` is the radius
/// of a robot's disc in unit lengths; `unit` is the unit length in metres.
pub(crate) fn shown(scene: &Scene, marks: &[Marks], reach: &[Option<Bounds>], disc: f64, unit: f64) -> Vec<Bounds> {
    let ground = ground_shown(scene, unit);
    let frame = |((frame, marks), reach): ((&Frame, &Marks), &Option<Bounds>)| {
        let blocks = blocks(scene, frame).map(|id| scene.blocks[id.0].body.polygon.bounds());
        let arrows = marks.arrows.iter().filter_map(|arrow| {
            let ends = Bounds::from_points([arrow.at, arrow.at + arrow.reach()]);
            ends.map(|b| b.grown(HEAD_WIDTH * arrow.width / 2.0))
        });
        // Several torques at one point have arrows of different radii.
        let here = |at: Point| marks.turns.iter().filter(|other| (other.at - at).norm() < 1e-6 * unit).count();
        let turns = marks.turns.iter().map(|turn| square_around(turn.at, (0.46 + 0.28 * here(turn.at) as f64) * unit));
        let robots = frame.holds.iter().map(|hold| square_around(hold.at, disc * unit));
        let all = blocks.chain(arrows).chain(turns).chain(robots).chain(ground).chain(*reach);
        all.reduce(Bounds::union).unwrap_or(square_around(Point::origin(), unit)).grown(PADDING * unit)
    };
    scene.frames.iter().zip(marks).zip(reach).map(frame).collect()
}

/// Returns the blocks that a frame shows: placed and planned blocks.
fn blocks<'a>(scene: &'a Scene, frame: &'a Frame) -> impl Iterator<Item = BlockId> + 'a {
    let planned = frame.plans.iter().map(|plan| plan.block);
    frame.placed.iter().copied().chain(planned).filter(|id| id.0 < scene.blocks.len())
}

/// Returns a box, in metres, around the part of the ground that the figures of a scene show: the ground near the
/// blocks, or all of the ground if no block is shown. Returns `None` if there is no such ground. `unit` is the unit
/// length in metres.
pub(crate) fn ground_shown(scene: &Scene, unit: f64) -> Option<Bounds> {
    let ground = || scene.ground.iter().map(|g| g.body.polygon.bounds());
    let seen = scene.frames.iter().flat_map(|frame| blocks(scene, frame));
    let structure = seen.map(|id| scene.blocks[id.0].body.polygon.bounds()).reduce(Bounds::union);
    let Some(structure) = structure else {
        return ground().reduce(Bounds::union);
    };
    let reach = structure.diagonal().max(unit);
    let near = structure.grown((SIDE_GROUND_SHARE * reach).max(unit));
    let far = structure.grown(reach);
    let shown = |part: Bounds| {
        let small = part.width() <= MAX_UNCUT_GROUND * unit && part.height() <= MAX_UNCUT_GROUND * unit;
        if small && far.intersects(part) { Some(part) } else { intersection(near, part) }
    };
    ground().filter_map(shown).reduce(Bounds::union)
}

/// True if the ground that the figures of a scene show reaches below all blocks. `unit` is the unit length in metres.
pub(crate) fn has_ground_below(scene: &Scene, unit: f64) -> bool {
    let seen = scene.frames.iter().flat_map(|frame| blocks(scene, frame));
    let lowest = seen.map(|id| scene.blocks[id.0].body.polygon.bounds().min.y);
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    ground_shown(scene, unit).is_some_and(|ground| ground.min.y < lowest)
}

/// Returns a box around a block, in metres: the bounding box of the block, enlarged on all sides by half of its longer
/// side.
pub(crate) fn zoomed_view(scene: &Scene, block: BlockId) -> Bounds {
    let bounds = scene.blocks[block.0].body.polygon.bounds();
    bounds.grown(ZOOM_PADDING * bounds.width().max(bounds.height()))
}

/// True if a point lies in a box or on its boundary.
pub(crate) fn contains(bounds: Bounds, p: Point) -> bool {
    (bounds.min.x..=bounds.max.x).contains(&p.x) && (bounds.min.y..=bounds.max.y).contains(&p.y)
}

fn square_around(p: Point, radius: f64) -> Bounds {
    Bounds { min: p, max: p }.grown(radius)
}

/// Returns the intersection of two boxes; `None` if they neither overlap nor touch.
pub(crate) fn intersection(a: Bounds, b: Bounds) -> Option<Bounds> {
    let (min, max) = (a.min.sup(&b.min), a.max.inf(&b.max));
    let size: Vector = max - min;
    (size.x >= 0.0 && size.y >= 0.0).then_some(Bounds { min, max })
}
