//! [`mark`]: marks changed blocks and forces in a figure.

use crate::geometry::Point;
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::{Camera, Colour, Drawing, Group, Outline, PagePoint, Path, Stroke};
use crate::products::report::entry::hover::onto_scene;

/// The smallest and largest radius of the ring around a changed force, in pixels.
const RING_RADIUS_LIMITS: (f64, f64) = (3.0, 9.0);

/// Returns the radius of the rings in pixels. It is smaller if many rings would overlap. `places` has their centres.
fn radius(places: &[PagePoint]) -> f64 {
    let (least, most) = RING_RADIUS_LIMITS;
    let span = |of: fn(&PagePoint) -> f64| {
        let (low, high) =
            places.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (high - low).max(0.0)
    };
    let (width, height) = (span(|p| p.x), span(|p| p.y));
    let count = places.len() as f64;
    // Estimate the distance between neighbouring rings, as if they were spread evenly over their bounding box or
    // along a line.
    let apart = f64::max(libm::sqrt(width * height / count), width.max(height) / count);
    match places.len() {
        0 | 1 => most,
        _ => (0.3 * apart).clamp(least, most),
    }
}

/// Draws an outline around some blocks, and a ring around some points, in a drawing of the scene. `blocks` has the
/// indices of the blocks, and `rings` has the points in metres.
pub(super) fn mark(drawing: &mut Drawing, scene: &Scene, blocks: &[usize], rings: &[Point], colour: Colour) {
    if blocks.is_empty() && rings.is_empty() {
        return;
    }
    let marks = |camera: &Camera| {
        let mut outline = Outline::default();
        for block in blocks {
            outline.extend(camera.polygon(&scene.blocks[*block].body.polygon));
        }
        let mut group = Group { echo: true, ..Group::with_class("changed") };
        if !outline.segments.is_empty() {
            group = group.with(Path::stroked(outline, Stroke::new(colour, 3.0)));
        }
        let places: Vec<PagePoint> = rings.iter().map(|at| camera.place(*at)).collect();
        let radius = radius(&places);
        for at in places {
            let circle = Outline::circle(at, radius);
            group = group.with(Path::stroked(circle, Stroke::new(colour, 1.8)));
        }
        group
    };
    onto_scene(drawing, &marks);
}
