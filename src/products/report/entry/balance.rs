//! [`whole`] and [`of_block`]: tables of forces for a check of equilibrium by hand. One table lists the external
//! forces on the whole structure, the other lists the forces on one block.

use super::unit::Units;
use super::{Grid, TableCell};
use crate::geometry::{Point, Vector, cross};
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, Verdict};
use crate::mechanics::scene::{AppliedForce, BlockId, BodyId, ForceCause, Scene};
use crate::products::wording::failure::named;
use crate::text::line;

/// Largest number of reactions in separate rows. If there are more, they are summed for each part of the ground. It is
/// also the largest number of missing forces in separate rows; if there are more, one row has their sum.
const MAX_REACTIONS: usize = 8;
/// Largest number of loads in separate rows. If there are more, one row has their sum.
const MAX_LOADS: usize = 6;

/// The torque of a force, in N·m, counts as a rounding error of the solver up to this value times (1 + magnitude of the
/// force in N).
const TORQUE_TOL: f64 = 1e-9;

/// A force in a table of forces.
struct Force {
    /// The name of the force in the table.
    what: String,
    /// The point at which the force acts, m; `None` for a sum of forces.
    at: Option<Point>,
    /// The force in N: x to the right, y up.
    force: Vector,
    /// The torque that acts in addition to the force, N·m.
    torque: f64,
    /// The moment of force and torque about the reference point, N·m, anticlockwise positive.
    moment: f64,
}

impl Force {
    fn new(what: impl Into<String>, at: Point, force: Vector, torque: f64, about: Point) -> Force {
        Force { what: what.into(), at: Some(at), force, torque, moment: cross(at - about, force) + torque }
    }

    /// Returns one row for several forces, with the sum of the forces and the sum of their moments.
    fn sum(what: impl Into<String>, forces: &[Force]) -> Force {
        Force {
            what: what.into(),
            at: None,
            torque: 0.0,
            force: forces.iter().map(|f| f.force).sum(),
            moment: forces.iter().map(|f| f.moment).sum(),
        }
    }
}

/// Makes a table of the external forces on the supported blocks of a frame: reactions, forces of robots, missing
/// forces, weight and loads. The last row is their sum. Moments are about the origin. `number` is the index of the
/// frame.
pub(super) fn whole(analysis: &Analysis, number: usize) -> Grid {
    let (scene, frame_analysis) = (analysis.scene_of(number), &analysis.frames[number]);
    let about = Point::origin();
    let supported: Vec<BlockId> = scene.frames[number]
        .placed
        .iter()
        .copied()
        .filter(|block| !frame_analysis.unsupported.contains(block))
        .collect();
    let mut forces = reactions(scene, frame_analysis, about);
    forces.extend(robots(scene, frame_analysis, None, about));
    forces.extend(missing(scene, frame_analysis, &supported, about));
    let all = scene.applied_forces();
    let applied = supported.iter().flat_map(|id| &all[id.0]);
    let (weights, mut loads): (Vec<&AppliedForce>, Vec<&AppliedForce>) =
        applied.partition(|applied| applied.cause == ForceCause::Weight);
    // List the loads in the order of the scene.
    loads.sort_by_key(|load| load.cause);
    forces.extend(total_weight(&weights, about));
    forces.extend(listed_loads(scene, &loads, about));
    let caption = "External forces on the supported blocks; moments about the origin";
    table(caption, &forces, Units::new(scene, frame_analysis))
}

/// Makes a table of the forces on one block. The last row is their sum. Moments are about the centroid of the block.
/// `number` is the index of the frame.
pub(super) fn of_block(analysis: &Analysis, number: usize, block: BlockId) -> Grid {
    let (scene, frame_analysis) = (analysis.scene_of(number), &analysis.frames[number]);
    let own = &scene.blocks[block.0];
    let about = own.centroid;
    let all = scene.applied_forces();
    let loads: Vec<&AppliedForce> =
        (all[block.0].iter()).filter(|applied| applied.cause != ForceCause::Weight).collect();
    let weight = scene.down() * own.weight;
    let mut forces = vec![Force::new("weight", about, weight, 0.0, about)];
    forces.extend(listed_loads(scene, &loads, about));
    let body = BodyId::Block(block);
    for contact in &frame_analysis.contacts {
        let [a, b] = contact.interface.bodies;
        let other = match body {
            body if body == a => b,
            body if body == b => a,
            _ => continue,
        };
        let from = format!("from {}", line(&named(scene, other)));
        forces.push(Force::new(from, contact.resultant.at, force_on(contact, body), 0.0, about));
    }
    forces.extend(robots(scene, frame_analysis, Some(block), about));
    forces.extend(missing(scene, frame_analysis, &[block], about));
    let caption = format!("Block {} cut free; moments about its centroid", line(&own.id));
    table(&caption, &forces, Units::new(scene, frame_analysis))
}

/// Returns the force at an interface, in newtons, that acts on `body`. `body` is one of the two bodies of the
/// interface.
fn force_on(contact: &Contact, body: BodyId) -> Vector {
    if contact.resultant.on == body { contact.resultant.force } else { -contact.resultant.force }
}

/// Returns the forces of the ground on the blocks, one for each joint between the ground and a block. If there are more
/// than [`MAX_REACTIONS`] such joints, returns one force for each part of the ground. `about` is the reference point of
/// moments.
fn reactions(scene: &Scene, frame_analysis: &FrameAnalysis, about: Point) -> Vec<Force> {
    let mut joints: Vec<(usize, Force)> = Vec::new();
    for contact in &frame_analysis.contacts {
        let (ground, block) = match contact.interface.bodies {
            [BodyId::Ground(ground), BodyId::Block(block)] | [BodyId::Block(block), BodyId::Ground(ground)] => {
                (ground, block)
            }
            _ => continue,
        };
        let what = format!("ground under {}", line(&scene.blocks[block.0].id));
        let force = force_on(contact, BodyId::Block(block));
        joints.push((ground, Force::new(what, contact.resultant.at, force, 0.0, about)));
    }
    if joints.len() <= MAX_REACTIONS {
        return joints.into_iter().map(|joint| joint.1).collect();
    }
    let parts = 0..scene.ground.len();
    let summed = parts.filter_map(|part| {
        let (own, rest): (Vec<_>, Vec<_>) = std::mem::take(&mut joints).into_iter().partition(|j| j.0 == part);
        joints = rest;
        let own: Vec<Force> = own.into_iter().map(|joint| joint.1).collect();
        let what = format!("ground, part {}, {} joints", part + 1, own.len());
        (!own.is_empty()).then(|| Force::sum(what, &own))
    });
    summed.collect()
}

/// Returns the forces that robots exert on all blocks, or only on `block` if it is given.
fn robots(scene: &Scene, frame_analysis: &FrameAnalysis, block: Option<BlockId>, about: Point) -> Vec<Force> {
    let holding = frame_analysis.robots.iter().filter(|r| block.is_none_or(|b| b == r.block));
    let force = |r: &crate::mechanics::analysis::RobotForce| {
        let what = format!("robot {}", line(&scene.robots[r.robot.0].id));
        Force::new(what, r.at, r.force, r.torque, about)
    };
    holding.map(force).collect()
}

/// Returns the missing forces on `blocks`. Missing forces between two of these blocks cancel and are left out. If
/// there are more than [`MAX_REACTIONS`] forces, returns only their sum.
fn missing(scene: &Scene, frame_analysis: &FrameAnalysis, blocks: &[BlockId], about: Point) -> Vec<Force> {
    let mut forces = Vec::new();
    for failure in &frame_analysis.failures {
        let on = blocks.iter().filter_map(|block| failure.on(BodyId::Block(*block)));
        let (force, torque) = on.fold((Vector::zeros(), 0.0), |(f, t), (g, u)| (f + g, t + u));
        if force.norm() > 0.0 || torque != 0.0 {
            let what = match failure.robot() {
                Some(robot) => {
                    format!("missing force of robot {}", line(&scene.robots[robot.0].id))
                }
                None => "missing force, as if the bodies stuck together".to_owned(),
            };
            forces.push(Force::new(what, failure.at(), force, torque, about));
        }
    }
    if forces.len() > MAX_REACTIONS {
        let what = format!("missing forces at {} points", forces.len());
        return vec![Force::sum(what, &forces)];
    }
    forces
}

/// Returns one row for the weights of several blocks, at their common centre of gravity; `None` if there are none.
fn total_weight(weights: &[&AppliedForce], about: Point) -> Option<Force> {
    let force: Vector = weights.iter().map(|w| w.force).sum();
    let total = force.norm();
    let middle: Vector = weights.iter().map(|w| w.at.coords * (w.force.norm() / total)).sum();
    let what = match weights.len() {
        0 => return None,
        1 => "weight of the block".to_owned(),
        count => format!("weight of {count} blocks"),
    };
    Some(Force::new(what, Point::from(middle), force, 0.0, about))
}

/// Returns one force for each load. If there are more than [`MAX_LOADS`] loads, returns only their sum.
fn listed_loads(scene: &Scene, loads: &[&AppliedForce], about: Point) -> Vec<Force> {
    let force = |load: &&AppliedForce| {
        let what = format!("load on {}", line(&scene.blocks[load.block.0].id));
        Force::new(what, load.at, load.force, load.torque, about)
    };
    let forces: Vec<Force> = loads.iter().map(force).collect();
    if forces.len() > MAX_LOADS {
        return vec![Force::sum(format!("{} loads", forces.len()), &forces)];
    }
    forces
}

fn table(caption: &str, forces: &[Force], units: Units) -> Grid {
    let newtons = units.newtons(forces.iter().flat_map(|f| [f.force.x, f.force.y]));
    let moments = units.torques(forces.iter().map(|f| f.moment));
    let places = forces.iter().filter_map(|f| f.at);
    let metres = units.lengths(places.flat_map(|p| [p.x, p.y]));
    let mut grid = Grid::new(
        caption,
        &[
            "force".to_owned(),
            metres.head("x"),
            metres.head("y"),
            newtons.head("right"),
            newtons.head("up"),
            moments.head("moment"),
        ],
    );
    let place = |value: Option<f64>| value.map_or("–".to_owned(), |v| metres.write(v));
    for force in forces {
        let mut what = force.what.clone();
        // Leave out torques that are only rounding errors of the solver.
        if force.torque.abs() > TORQUE_TOL * (1.0 + force.force.norm()) {
            let stated = moments.with_unit(force.torque);
            what.push_str(&format!(", and a torque of {stated}"));
        }
        let cells = [
            what,
            place(force.at.map(|p| p.x)),
            place(force.at.map(|p| p.y)),
            newtons.write(force.force.x),
            newtons.write(force.force.y),
            moments.write(force.moment),
        ];
        grid.add("", cells);
    }
    let sum = Force::sum("sum", forces);
    let words = [newtons.write(sum.force.x), newtons.write(sum.force.y), moments.write(sum.moment)];
    let words = ["sum", "", ""].map(str::to_owned).into_iter().chain(words);
    grid.add("", words.map(|w| TableCell::strong_if(true, w)));
    grid.has_sum = true;
    grid
}

/// Explains what the sums in the two balance tables mean, and how moments are computed.
pub(super) fn check_words(frame_analysis: &FrameAnalysis) -> String {
    let formula = "Moment = x·F_up − y·F_right + torque, anticlockwise positive; x and y from the point of reference.";
    let words = match frame_analysis.verdict {
        Verdict::Stable => "The sums are zero in the printed digits: weights, loads and reactions balance.",
        Verdict::Unstable if !frame_analysis.unsupported.is_empty() && frame_analysis.failures.is_empty() => {
            "The table of the whole structure leaves out the blocks that nothing carries. The other blocks are in equilibrium."
        }
        Verdict::Unstable if frame_analysis.failures.is_empty() => {
            "The structure falls, and its forces were not computed: the sums are the imbalance."
        }
        Verdict::Unstable => {
            "The sums are zero only with the missing forces, which neither contacts nor robots can give."
        }
        Verdict::Undecided => "No balance is proved: the sums are the remaining imbalance of the best forces found.",
    };
    format!("{words} {formula}")
}
