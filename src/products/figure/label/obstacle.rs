//! [`ink`]: collects the parts of a frame's picture that labels must not cover.

use crate::geometry::Polygon;
use crate::pictures::drawing::PagePoint;
use crate::pictures::drawing::placement::Ink;
use crate::products::figure::arrow::{ArrowKind, TurnArrow};
use crate::products::figure::pen::{CENTROID_RADIUS, DOT_RADIUS, Pen};

/// Returns the shapes that labels must not cover: the outlines of ground, blocks and planned blocks, the discs of
/// robots, the visible arrows, and the dots that replace small arrows.
pub(crate) fn ink(pen: &Pen<'_>) -> Ink {
    let mut ink = Ink::default();
    let scene = &pen.context.analysis.scene;
    let frame = &scene.frames[pen.number];
    let planned = frame.plans.iter().map(|p| p.block);
    let blocks = frame.placed.iter().copied().chain(planned);
    let polygons =
        blocks.map(|id| &scene.blocks[id.0].body.polygon).chain(scene.ground.iter().map(|g| &g.body.polygon));
    for edge in polygons.flat_map(Polygon::edges) {
        let (from, to) = (pen.camera.place(edge.from), pen.camera.place(edge.to));
        ink.line(from, to, pen.line);
    }
    for hold in &frame.holds {
        ink.disc(pen.camera.place(pen.moved(hold.block, hold.at)), pen.disc());
    }
    let marks = &pen.context.marks[pen.number];
    for arrow in marks.arrows.iter().filter(|a| pen.seen(a)) {
        let (from, along) = (pen.camera.place(arrow.at), pen.camera.turn(arrow.reach()));
        ink.arrow(from, along, pen.width(arrow));
        if arrow.kind == ArrowKind::Weight {
            ink.disc(from, CENTROID_RADIUS * pen.width(arrow) + 1.0);
        }
    }
    for arrow in pen.dots() {
        ink.disc(pen.camera.place(arrow.at), DOT_RADIUS + 0.5);
    }
    for turn in &marks.turns {
        turning(&mut ink, pen, turn);
    }
    ink
}

/// Adds the arrow of a torque to the ink, as wide lines between the points of its outline.
fn turning(ink: &mut Ink, pen: &Pen<'_>, turn: &TurnArrow) {
    let points: Vec<PagePoint> = pen.turn(turn).outline.points().collect();
    let centre = pen.camera.place(turn.at);
    for pair in points.windows(2) {
        let width = 3.0 * pen.camera.length(turn.width);
        // A line that begins at the centre of the circle does not belong to the drawn arrow.
        if libm::hypot(pair[0].x - centre.x, pair[0].y - centre.y) > 0.0 {
            ink.line(pair[0], pair[1], width);
        }
    }
}
