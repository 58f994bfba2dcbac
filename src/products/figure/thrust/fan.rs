//! Draws the force polygon next to the line of thrust in the classical form: a load line, a pole, and a ray from the
//! pole for each joint. A ray shows the force in the joint with the same number. The weight and the loads of a block
//! connect the tips of the rays of its two joints. The force polygon of one chain of blocks is called a fan.

use super::chain::{Chain, chains};
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::FrameAnalysis;
use crate::mechanics::scene::{AppliedForce, ForceCause};
use crate::pictures::drawing::{Colour, Outline, Path};
use crate::products::figure::canvas::Canvas;
use crate::products::figure::design::{Key, Layer, Mark};
use crate::products::figure::placing::Label;
use crate::products::wording::number::{force, quantity, round_below_in};

/// The space of the fans to the right of the structure, as a fraction of the longer side of the structure.
pub(super) const WIDTH_SHARE: f64 = 0.6;
/// Largest width of a fan, the largest height of all fans (at least the height of the structure), and the gaps beside
/// them and between them, as fractions of the longer side of the structure.
const FAN_SHARE: (f64, f64) = (0.38, 0.5);
const GAP_SHARE: f64 = 0.12;
/// If the weight and the loads of a block do not balance its two joint forces, the remainder is drawn as the force of
/// robots. A remainder up to this fraction of the resultant of the two joint forces is ignored.
const ROBOT_TOL: f64 = 1e-6;
/// Widths of the load line, of the first and the last ray, and of the other rays, mm.
const WIDTHS: [f64; 3] = [0.35, 0.35, 0.18];
/// Largest length of the line that shows the scale, mm.
const MAX_SCALE_LINE: f64 = 12.0;

/// Draws the force polygons of a frame, one fan of rays for each chain of blocks, to the right of the structure, and the
/// numbers of the joints. Returns false if no chain of blocks has a thrust.
pub(super) fn draw(canvas: &mut Canvas<'_>, found: &FrameAnalysis) -> bool {
    let (scene, frame) = (canvas.scene(), canvas.frame());
    let chains = chains(scene, frame, found);
    let own = |chain: &Chain| {
        let tips = chain.forces.iter().map(|force| Point::from(*force));
        Bounds::from_points(tips.chain([Point::origin()]))
    };
    let boxes: Vec<Bounds> = chains.iter().filter_map(own).collect();
    let widest = boxes.iter().map(|own| own.width()).fold(0.0, f64::max);
    let high: f64 = boxes.iter().map(|own| own.height()).sum();
    let Some(structure) = scene.bounds(&frame.placed).filter(|_| widest > 0.0 && high > 0.0) else { return false };
    let side = structure.width().max(structure.height());
    let gaps = GAP_SHARE * side * (boxes.len() - 1) as f64;
    // The scale of the polygons, metres in the scene per newton.
    let metres =
        (FAN_SHARE.0 * side / widest).min((structure.height().max(FAN_SHARE.1 * side) - gaps).max(0.2 * side) / high);
    let mut top = structure.max.y;
    let mut before = 0;
    for (chain, own) in chains.iter().zip(boxes) {
        let left = structure.max.x + GAP_SHARE * side;
        let pole = Point::new(left - metres * own.min.x, top - metres * own.max.y);
        top -= metres * own.height() + GAP_SHARE * side;
        fan(canvas, chain, before, (pole, metres));
        number_joints(canvas, found, chain, before);
        before += chain.forces.len();
    }
    let units = scene.units.force();
    let pixels = canvas.camera.length(metres);
    let newtons = round_below_in(canvas.mm(MAX_SCALE_LINE) / pixels, units);
    let stroke = canvas.pen(canvas.theme().motion, WIDTHS[1]);
    canvas.explain(Key::line(
        20,
        format!("{} in the force polygon", quantity(newtons, units)),
        newtons * pixels,
        stroke,
    ));
    canvas.note(79, "ray from O: force in the joint of this number");
    true
}

/// Draws the rays with their numbers, the load line, and the thrust H. The number of the first ray is `before` + 1. The
/// scale is in metres in the scene per newton.
fn fan(canvas: &mut Canvas<'_>, chain: &Chain, before: usize, (pole, metres): (Point, f64)) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let vertices: Vec<Point> = chain.forces.iter().map(|force| pole + *force * metres).collect();
    let line = |canvas: &mut Canvas<'_>, class: &'static str, ends: [Point; 2], ink: Colour, width: f64, title| {
        let line = Outline::line(ends.map(|p| canvas.place(p)));
        let path = Path::stroked(line, canvas.pen(ink, width));
        canvas.put(Mark::new(Layer::Force, class, vec![path]).titled(title).avoided(0.05));
    };
    for (k, (vertex, ray)) in vertices.iter().zip(&chain.forces).enumerate() {
        let width = WIDTHS[if k == 0 || k + 1 == vertices.len() { 1 } else { 2 }];
        let title = format!("Ray {}: {}", before + k + 1, force(*ray, scene.units));
        line(canvas, "ray", [pole, *vertex], theme.motion, width, title);
    }
    // The load line: the weight, the loads and the robot forces of each block, from the tip of one ray to the next.
    let applied = scene.applied_forces();
    for (k, id) in chain.blocks.iter().enumerate() {
        let piece = |applied: &AppliedForce| match applied.cause {
            ForceCause::Weight => (applied.force, theme.ink, "Weight"),
            ForceCause::Load(_) => (applied.force, theme.load, "Load"),
        };
        let mut pieces: Vec<_> = applied[id.0].iter().map(piece).collect();
        let sum = chain.forces[k + 1] - chain.forces[k];
        let held: Vector = sum - pieces.iter().map(|p| p.0).sum::<Vector>();
        if held.norm() > ROBOT_TOL * sum.norm() {
            pieces.push((held, theme.faint, "Robots"));
        }
        let mut at = vertices[k];
        for (amount, ink, what) in pieces {
            let title = format!("{what} on block {}: {}", scene.blocks[id.0].id, force(amount, scene.units));
            line(canvas, "load-line", [at, at + amount * metres], ink, WIDTHS[0], title);
            at += amount * metres;
        }
    }
    let dots = vertices.iter().map(|vertex| Outline::circle(canvas.place(*vertex), canvas.mm(0.25)));
    let dots = dots.map(|dot| Path::filled(dot, theme.ink)).collect();
    canvas.put(Mark::new(Layer::Symbol, "vertices", dots));
    let label = |canvas: &mut Canvas<'_>, words: String, at: Point, away: (f64, f64), rank: u8| {
        let label = Label::new(words, theme.ink, vec![canvas.place(at)], rank);
        canvas.label(Label { away: Some(away), ..label });
    };
    label(canvas, "O".into(), pole, (-1.0, 0.0), 6);
    // If all loads are vertical, the thrust H is the distance of the pole from the load line, at the scale of the
    // polygon.
    let thrust = canvas.newtons(chain.crown_thrust);
    let lowest = vertices.iter().map(|vertex| vertex.y).fold(pole.y, f64::min);
    label(canvas, format!("H = {thrust}"), Point::new(pole.x, lowest), (0.0, 1.0), 5);
    // Numbers that would lie on each other are left out; those of the joints on the structure remain.
    let right = if vertices.iter().any(|vertex| vertex.x > pole.x) { 1.0 } else { -1.0 };
    let apart = 1.1 * canvas.look.text * theme.sizes.amount;
    let far = |a: &Point, b: &Point| canvas.camera.length((a - b).norm()) >= apart;
    let (mut kept, last) = (Vec::new(), vertices.len() - 1);
    for (k, vertex) in vertices.iter().enumerate() {
        let is_free = kept.last().is_none_or(|(_, other)| far(vertex, other));
        if k == last || is_free && far(vertex, &vertices[last]) {
            kept.push((before + k + 1, *vertex));
        }
    }
    for (number, vertex) in kept {
        label(canvas, number.to_string(), vertex, (right, 0.0), 30);
    }
}

/// Writes the number of each joint on the structure, next to the outer or upper end of the joint. The first number is
/// `before` + 1.
fn number_joints(canvas: &mut Canvas<'_>, found: &FrameAnalysis, chain: &Chain, before: usize) {
    let points = chain.joints.iter().map(|joint| found.contacts[*joint].resultant.at);
    let Some(own) = Bounds::from_points(points) else { return };
    let middle = 0.5 * (own.min.x + own.max.x);
    for (k, joint) in chain.joints.iter().enumerate() {
        let ends = found.contacts[*joint].interface.ends;
        let outward = |p: &Point| p.y + 0.5 * (p.x - middle).abs();
        let [inner, outer] = if outward(&ends[0]) < outward(&ends[1]) { ends } else { [ends[1], ends[0]] };
        let along = outer - inner;
        let away = (along.x / along.norm().max(f64::MIN_POSITIVE), -along.y / along.norm().max(f64::MIN_POSITIVE));
        let label = Label::new((before + k + 1).to_string(), canvas.theme().motion, vec![canvas.place(outer)], 29);
        canvas.label(Label { away: Some(away), ..label });
    }
}
