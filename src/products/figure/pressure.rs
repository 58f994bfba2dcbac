//! Draws pressures: along each loaded edge a hatched diagram on the outside of the block, whose depth is to scale.

use super::canvas::Canvas;
use super::design::{Layer, Mark};
use crate::geometry::Vector;
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::{Outline, Path, Stroke};
use crate::products::wording::number::quantity;

/// The depth of the diagram where the pressure of the frame is largest, mm.
const DEPTH: f64 = 7.0;
/// The distance between the lines of the hatching, mm.
const SPACING: f64 = 1.5;

/// Draws the diagrams of all pressures on the blocks of the frame.
pub(crate) fn diagrams(canvas: &mut Canvas<'_>) {
    let (scene, placed) = (canvas.scene(), &canvas.frame().placed);
    let acting = scene.loads.iter().filter(|load| placed.contains(&load.block));
    let spread: Vec<_> = acting.filter_map(|load| Some((load, load.spread?))).collect();
    let largest = spread.iter().flat_map(|(_, spread)| spread.force.map(|force| force.norm())).fold(0.0, f64::max);
    let ink = canvas.theme().load;
    let fill = ink.mixed(canvas.theme().page, 0.88);
    for (load, spread) in spread {
        let body = BodyId::Block(load.block);
        let feet = spread.ends.map(|end| canvas.place_on(body, end));
        let depth = |force: Vector| (-force.x / largest * canvas.mm(DEPTH), force.y / largest * canvas.mm(DEPTH));
        let depths = spread.force.map(depth);
        let tips = [0, 1].map(|k| feet[k].moved(depths[k].0, depths[k].1));
        let length = feet[1].distance(feet[0]);
        let mix = |[a, b]: [f64; 2], share: f64| a + (b - a) * share;
        let spacing = canvas.mm(SPACING);
        let places = core::iter::successors(Some(0.5 * spacing), |at| Some(at + spacing));
        let lines = Outline::lines(places.take_while(|at| *at < length).map(|at| {
            let share = at / length;
            let foot = feet[0].moved((feet[1].x - feet[0].x) * share, (feet[1].y - feet[0].y) * share);
            let (x, y) = (mix(depths.map(|d| d.0), share), mix(depths.map(|d| d.1), share));
            [foot, foot.moved(x, y)]
        }));
        let outline = Outline::ring([feet[0], feet[1], tips[1], tips[0]]);
        let shapes = vec![
            Path::filled(outline, fill).with_stroke(Stroke::new(ink, canvas.mm(0.18)).mitred()),
            Path::stroked(lines, Stroke::new(ink, canvas.mm(0.14))),
        ];
        let unit = scene.units.force();
        let [first, last] = spread.force.map(|force| quantity(force.norm(), unit));
        let title = format!("Pressure on block {}: {first} to {last} per metre", scene.name(body));
        canvas.put(Mark::new(Layer::Load, "pressure", shapes).titled(title).avoided(canvas.mm(0.2)));
    }
}
