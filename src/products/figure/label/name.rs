//! Creates the labels with the names of blocks and robots.

use super::super::pen::Pen;
use super::super::view;
use super::lettering::{Label, MIN_SIZE, broken, label};
use crate::geometry::{Bounds, Point, Polygon};
use crate::mechanics::scene::{BlockId, Hold};
use crate::pictures::drawing::Face;
use crate::pictures::drawing::placement::LabelRequest;

/// Number of positions tried along each axis of a block.
const POSITIONS_PER_AXIS: usize = 13;
/// Distances from a block's centroid are rounded to this fraction of the block's diagonal, so that rounding errors do
/// not move a name.
const DISTANCE_STEP: f64 = 1e-3;
/// Least distance from the sides of the block for a name that is broken into several lines, pixels.
const INSET: f64 = 4.0;
/// Typical length of a block's edge, as a fraction of the square root of its area. The font size of the name depends on
/// this length.
const EDGE_SHARE: f64 = 0.6;
/// If the typical edge of a block is longer than this, in unit lengths, its name has a larger font size.
const MIN_LARGE_BLOCK_EDGE: f64 = 3.0;

/// Returns the font size of a block's name, in pixels. `edge` is a typical edge length of the block, or the unit
/// length, in pixels.
fn name_size(pen: &Pen<'_>, edge: f64) -> f64 {
    (0.25 * edge).max(MIN_SIZE).min(pen.context.options.theme.sizes.name)
}

/// Returns the label with the name of a block; `None` if the bounding box of the block is outside `view`, the shown
/// part of the scene, in a zoomed picture.
pub(super) fn name(pen: &Pen<'_>, id: BlockId, view: Bounds) -> Option<Label> {
    let block = &pen.context.analysis.scene.blocks[id.0];
    let zoomed = pen.context.options.zoom.is_some();
    if zoomed && view::intersection(view, block.body.polygon.bounds()).is_none() {
        return None;
    }
    // The name of a block that is much larger than the unit length has a larger font size.
    let own = pen.camera.length(EDGE_SHARE * libm::sqrt(block.body.polygon.area()));
    let size = if own > MIN_LARGE_BLOCK_EDGE * pen.unit() { name_size(pen, own) } else { name_size(pen, pen.unit()) };
    // The search for a position of the name begins closer to the centroid if the block is small.
    let extent = block.body.polygon.bounds().diagonal();
    let request = LabelRequest {
        anchor: pen.camera.place(pen.moved(id, block.centroid)),
        first_ring: (0.4 * pen.unit()).min(0.5 * pen.camera.length(extent) + 2.0),
        size: (0.0, 0.0),
        preferred: centres_inside(&block.body.polygon, block.centroid, zoomed.then_some(view))
            .into_iter()
            .map(|p| pen.camera.place(pen.moved(id, p)))
            .collect(),
        with_leader: Vec::new(),
        padding: 0.5 * size,
        max_distance: (!zoomed || view::contains(view, block.centroid)).then_some(f64::INFINITY),
    };
    let label = label(block.id.clone(), Face::SansBold, size, "name", request);
    let across = pen.camera.length(block.body.polygon.bounds().width()) - 2.0 * INSET;
    Some(Label { of: Some(id), ..broken(label, across) })
}

/// Returns the labels with the names of the robots that hold a block. A zoomed picture names only the robots whose
/// grips are in `view`.
pub(super) fn robots(pen: &Pen<'_>, view: Bounds) -> Vec<Label> {
    let scene = &pen.context.analysis.scene;
    let size = name_size(pen, pen.unit());
    // Names of robots are slightly smaller than names of blocks, but not smaller than `MIN_SIZE`, unless names of blocks
    // are so too.
    let size = (0.9 * size).max(size.min(MIN_SIZE));
    let named = |hold: &Hold| {
        let request = LabelRequest {
            anchor: pen.camera.place(pen.moved(hold.block, hold.at)),
            first_ring: pen.disc() + 2.0,
            size: (0.0, 0.0),
            preferred: Vec::new(),
            with_leader: Vec::new(),
            padding: 0.0,
            max_distance: Some(f64::INFINITY),
        };
        let id = scene.robots[hold.robot.0].id.clone();
        let block = scene.blocks[hold.block.0].body.polygon.bounds();
        let across = pen.camera.length(block.width()) - 2.0 * INSET;
        let label = label(id, Face::Sans, size, "robot-name", request);
        Label { of: Some(hold.block), ..broken(label, across) }
    };
    let zoomed = pen.context.options.zoom.is_some();
    let holds = scene.frames[pen.number].holds.iter();
    let shown = holds.filter(|hold| !zoomed || view::contains(view, hold.at));
    shown.map(named).collect()
}

/// Returns points inside a polygon at which the centre of a label may lie, the nearest to `middle` first. If there is a
/// `view`, the points are inside the part of the polygon that it shows.
fn centres_inside(polygon: &Polygon, middle: Point, view: Option<Bounds>) -> Vec<Point> {
    let whole = polygon.bounds();
    let bounds = view.and_then(|v| view::intersection(v, whole)).unwrap_or(whole);
    let share = |i: usize| (i as f64 + 0.5) / POSITIONS_PER_AXIS as f64;
    let points: Vec<Point> = (0..POSITIONS_PER_AXIS * POSITIONS_PER_AXIS)
        .map(|i| {
            let x = bounds.min.x + bounds.width() * share(i % POSITIONS_PER_AXIS);
            let y = bounds.min.y + bounds.height() * share(i / POSITIONS_PER_AXIS);
            Point::new(x, y)
        })
        .filter(|p| polygon.contains(*p))
        .collect();
    // Round the distances, so that distances that differ only by rounding errors become equal. The sort is stable, so
    // points at equal distances keep the order of the grid.
    let step = DISTANCE_STEP * whole.diagonal();
    let rank = |p: &Point| ((p - middle).norm() / step).round();
    let mut ranked: Vec<(f64, Point)> = points.into_iter().map(|p| (rank(&p), p)).collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.into_iter().map(|(_, p)| p).collect()
}
