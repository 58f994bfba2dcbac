//! Draws the loads: forces as hollow arrows, torques as arcs, and pressures as hatched diagrams along the loaded edges.

use std::rc::Rc;

use super::arrow::round_above;
use super::canvas::Canvas;
use super::design::{ArrowSize, Key, Layer, Mark, along, direction};
use super::stage;
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::{BodyId, Load, Scene};
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path};
use crate::products::wording::number::{force, quantity};

/// At most about this many loads have amounts, the largest.
const MAX_LOAD_AMOUNTS: usize = 16;
/// The rank of the entry of the legend.
const LOAD_RANK: u8 = 40;
/// The depth of the diagram where the pressure of the frame is largest, mm.
const DEPTH: f64 = 7.0;
/// The distance between the lines of the hatching, mm.
const SPACING: f64 = 1.5;

/// Draws the loads of the frame as hollow arrows in one scale, each with its amount. The tip of an arrow is on the point
/// of the load if the side before the point is freer of blocks than the side after it; otherwise the arrow hangs from
/// the point.
pub(crate) fn loads(canvas: &mut Canvas<'_>) {
    let (scene, placed) = (canvas.scene(), &canvas.frame().placed);
    diagrams(canvas);
    let loads = scene.loads_on(placed);
    let all = scene.loads_on(&stage::shown_blocks(scene)).into_iter().map(|load| load.force.norm());
    let largest = all.fold(0.0, f64::max);
    let longest = canvas.scale * largest;
    let fits = (canvas.mm(5.0)..=canvas.mm(11.0)).contains(&longest);
    let common = joint_scale(canvas);
    let scale = common.unwrap_or(if fits { canvas.scale } else { canvas.mm(7.5) / largest });
    let ink = canvas.theme().load;
    let mut amounts: Vec<f64> = loads.iter().map(|load| load.force.norm()).collect();
    amounts.sort_by(|a, b| b.total_cmp(a));
    let least = amounts.get(MAX_LOAD_AMOUNTS - 1).copied().unwrap_or(0.0);
    let words = match loads.len() {
        1 => "load".to_owned(),
        count if count > MAX_LOAD_AMOUNTS => "loads, amounts only at the largest".to_owned(),
        _ => "loads".to_owned(),
    };
    // A load that would be too short has an arrow of the least length.
    let stub = common.map(|scale| canvas.mm(STUB) / scale);
    let has_stub = stub.is_some_and(|stub| loads.iter().any(|load| (1e-9..0.98 * stub).contains(&load.force.norm())));
    let units = scene.units.force();
    let words = match stub.filter(|_| has_stub) {
        Some(stub) => {
            format!("{words}; stub: under {}", quantity(units.size * round_above(units.value_from_si(stub)), units))
        }
        None => words,
    };
    let size = ArrowSize { length: canvas.mm(5.0), ..load_size(canvas) };
    let mut symbol = vec![hollow(canvas, size.outline(PagePoint::new(0.0, 0.0), (1.0, 0.0)), ink)];
    if loads.iter().any(|load| load.force.norm() > 0.0 && acts_inside(canvas, load)) {
        symbol.push(canvas.disc(PagePoint::new(canvas.mm(5.0), 0.0), 0.5, ink));
    }
    let key = Key::new(LOAD_RANK, words, symbol, canvas.mm(5.5));
    for load in &loads {
        if load.force.norm() > 0.0 {
            one_load(canvas, load, scale, &key, load.force.norm() >= least);
        }
        if load.torque != 0.0 {
            let at = canvas.place_on(BodyId::Block(load.block), load.at);
            let units = scene.units.torque();
            let on = scene.name(BodyId::Block(load.block));
            let title = format!(
                "Torque of a load on block {on}: {}",
                stage::turning(load.torque, quantity(load.torque.abs(), units))
            );
            // Torques at one point have arcs with different radii.
            let turns = loads.iter().take_while(|other| !core::ptr::eq(*other, load));
            let here = turns.filter(|other| other.torque != 0.0 && (other.at - load.at).norm() < 1e-6).count();
            let radius = 2.6 + 1.5 * here as f64;
            let mark = stage::torque(canvas, at, load.torque, (radius, 0.45), ink);
            canvas.put(Mark::new(Layer::Load, "torque", mark).titled(title).avoided(0.2));
            let side = at.moved(canvas.mm(radius + 0.4), 0.0);
            let words = named(scene, load, quantity(load.torque.abs(), units));
            stage::amount(canvas, words, ink, (vec![side], 0), Some((0.0, -1.0)));
        }
    }
}

/// The length of the arrow of a force that would be shorter in the one scale of a picture, mm.
pub(crate) const STUB: f64 = 2.5;

/// Returns the one scale of all forces of a picture with a mark at each joint, pixels per newton: loads and missing forces
/// have it too. `None` for other pictures.
pub(crate) fn joint_scale(canvas: &Canvas<'_>) -> Option<f64> {
    (canvas.scale > 0.0 && canvas.shares_scale).then_some(canvas.scale)
}

/// True if a load acts inside its block, visibly away from its edges. A dot then marks the point.
fn acts_inside(canvas: &Canvas<'_>, load: &Load) -> bool {
    let polygon = &canvas.scene().blocks[load.block.0].body.polygon;
    let deep = polygon.edges().all(|edge| canvas.camera.length(edge.distance(load.at)) > canvas.mm(0.6));
    deep && polygon.contains(load.at)
}

pub(super) fn load_size(canvas: &Canvas<'_>) -> ArrowSize {
    ArrowSize { length: 0.0, shaft: canvas.mm(0.85), head: (canvas.mm(1.9), canvas.mm(1.7)) }
}

pub(super) fn hollow(canvas: &Canvas<'_>, outline: Outline, ink: Colour) -> Path {
    Path::filled(outline, canvas.theme().page).with_stroke(canvas.pen(ink, 0.32).mitred())
}

fn one_load(canvas: &mut Canvas<'_>, load: &Load, scale: f64, key: &Rc<Key>, has_amount: bool) {
    let (scene, ink) = (canvas.scene(), canvas.theme().load);
    let norm = load.force.norm();
    let u = direction(load.force);
    let length = (scale * norm).max(canvas.mm(if joint_scale(canvas).is_some() { STUB } else { 3.0 }));
    let at = canvas.place(load.at);
    let stone = |from: f64, to: f64| stone_length(canvas, [along(at, u, from, 0.0), along(at, u, to, 0.0)]);
    let (before, after) = (stone(-length, -canvas.mm(0.05)), stone(canvas.mm(0.05), length));
    let ends = before <= after + canvas.mm(0.3);
    // The side is that of the block where it stands; the arrow moves with the block.
    let at = canvas.place_on(BodyId::Block(load.block), load.at);
    let tail = if ends { along(at, u, -length, 0.0) } else { at };
    let outline = ArrowSize { length, ..load_size(canvas) }.outline(tail, u);
    let mut shapes = vec![hollow(canvas, outline, ink)];
    if acts_inside(canvas, load) {
        shapes.push(canvas.disc(at, 0.5, ink));
    }
    let title = format!("Load on block {}: {}", scene.name(BodyId::Block(load.block)), force(load.force, scene.units));
    canvas.put(Mark::new(Layer::Load, "load", shapes).titled(title).keyed(key).avoided(0.2));
    if !has_amount {
        return;
    }
    let far = if ends { tail } else { along(at, u, length, 0.0) };
    let away = if ends { (-u.0, -u.1) } else { u };
    let anchors = vec![far, along(tail, u, length / 2.0, 0.0)];
    stage::amount(canvas, named(scene, load, canvas.newtons(norm)), ink, (anchors, 0), Some(away));
}

/// Writes the id of a load, if the file gives one, before its amount.
fn named(scene: &Scene, load: &Load, amount: String) -> String {
    match scene.load_id(load) {
        Some(id) => format!("{id}: {amount}"),
        None => amount,
    }
}

/// Returns the length of the part of a line segment that lies in placed blocks, pixels.
fn stone_length(canvas: &Canvas<'_>, [from, to]: [PagePoint; 2]) -> f64 {
    let scene = canvas.scene();
    let [start, end] = [from, to].map(|p| canvas.camera.back(p));
    let blocks = canvas.frame().placed.iter().map(|id| &scene.blocks[id.0].body.polygon);
    let metres: f64 = blocks.map(|polygon| inside_length(polygon.rings(), start, end - start)).sum();
    canvas.camera.length(metres)
}

/// Returns the length of the part of the segment from `start` along `way` that lies inside the rings, metres.
pub(crate) fn inside_length(rings: &[Vec<Point>], start: Point, way: Vector) -> f64 {
    let parts = parts(rings, start, way).into_iter().filter(|part| part.1);
    parts.map(|([from, to], _)| to - from).sum::<f64>() * way.norm()
}

/// Divides the segment from `start` along `way` where it crosses the rings. Returns each part with the shares of `way` at
/// which it begins and ends, and whether it lies inside the rings.
pub(crate) fn parts(rings: &[Vec<Point>], start: Point, way: Vector) -> Vec<([f64; 2], bool)> {
    let mut cuts = vec![0.0, 1.0];
    let mut inside = false;
    for ring in rings {
        for i in 0..ring.len() {
            let (a, b) = (ring[i] - start, ring[(i + 1) % ring.len()] - start);
            let (left, right) = (way.x * a.y - way.y * a.x, way.x * b.y - way.y * b.x);
            if (left >= 0.0) == (right >= 0.0) {
                continue;
            }
            let hit = a + (b - a) * (left / (left - right));
            let share = hit.dot(&way) / way.norm_squared();
            if share <= 0.0 {
                inside = !inside;
            } else if share < 1.0 {
                cuts.push(share);
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    let part = |(number, ends): (usize, &[f64])| ([ends[0], ends[1]], inside != (number % 2 == 1));
    cuts.windows(2).enumerate().map(part).collect()
}

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
            Path::filled(outline, fill).with_stroke(canvas.pen(ink, 0.18).mitred()),
            Path::stroked(lines, canvas.pen(ink, 0.14)),
        ];
        let unit = scene.units.force();
        let [first, last] = spread.force.map(|force| quantity(force.norm(), unit));
        let title = format!("Pressure on block {}: {first} to {last} per metre", scene.name(body));
        canvas.put(Mark::new(Layer::Load, "pressure", shapes).titled(title).avoided(0.2));
    }
}
