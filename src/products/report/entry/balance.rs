//! [`support_forces`] and [`whole`]: the reactions, and a table of all external forces for a check of equilibrium by hand.

use super::unit::Units;
use super::{Grid, TableCell};
use crate::geometry::{Point, Vector, cross};
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, SolvedFrame, Verdict};
use crate::mechanics::scene::{AppliedForce, BlockId, BodyId, ForceCause, Scene};
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
    /// The moment of force and torque about the origin, N·m, anticlockwise positive.
    moment: f64,
}

impl Force {
    fn new(what: impl Into<String>, at: Point, force: Vector, torque: f64) -> Force {
        Force { what: what.into(), at: Some(at), force, torque, moment: cross(at.coords, force) + torque }
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

/// Makes a table of the reactions: the forces of the ground and of robots on the blocks. `number` is the index of the
/// frame.
pub(super) fn support_forces(analysis: &Analysis, number: usize) -> Grid {
    let solved = analysis.at(number);
    let mut forces = reactions(solved);
    forces.extend(robots(solved));
    table("", &forces, Units::new(solved), false)
}

/// Makes a table of the external forces on the supported blocks of a frame: reactions, forces of robots, missing
/// forces, weight and loads. The last row is their sum. Moments are about the origin. `number` is the index of the
/// frame.
pub(super) fn whole(analysis: &Analysis, number: usize) -> Grid {
    let solved @ SolvedFrame { scene, found, .. } = analysis.at(number);
    let placed = scene.frames[number].placed.iter().copied();
    let supported: Vec<BlockId> = placed.filter(|block| !found.unsupported.contains(block)).collect();
    let grounds = reactions(solved);
    let together = |what: &str, forces: Vec<Force>| match forces.len() {
        0 | 1 => forces,
        _ => vec![Force::sum(what, &forces)],
    };
    let mut forces = together("reactions of the ground, together", grounds);
    forces.extend(together("robots, together", robots(solved)));
    forces.extend(missing(solved, &supported));
    let all = scene.applied_forces();
    let applied = supported.iter().flat_map(|id| &all[id.0]);
    let (weights, mut loads): (Vec<&AppliedForce>, Vec<&AppliedForce>) =
        applied.partition(|applied| applied.cause == ForceCause::Weight);
    // List the loads in the order of the scene.
    loads.sort_by_key(|load| load.cause);
    forces.extend(total_weight(&weights));
    forces.extend(listed_loads(scene, &loads));
    let caption = "External forces on the supported blocks; moments about the origin";
    table(caption, &forces, Units::new(solved), true)
}

/// Returns the forces of the ground on the blocks, one for each joint between the ground and a block. If there are more
/// than [`MAX_REACTIONS`] such joints, returns one force for each part of the ground.
fn reactions(solved: SolvedFrame<'_>) -> Vec<Force> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut joints: Vec<(usize, Force)> = Vec::new();
    for contact in &frame_analysis.contacts {
        for acting in contact.acting() {
            if let Some(BodyId::Ground(ground)) = acting.kind.partner() {
                let what = support(scene, contact, acting.on);
                joints.push((ground, Force::new(what, acting.at, acting.force, 0.0)));
            }
        }
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

/// Names a part of the ground by its side of a block: `ground under a`, `wall left of a`.
fn support(scene: &Scene, contact: &Contact, block: BlockId) -> String {
    let interface = &contact.interface;
    // The normal points away from the second body or towards it; orient it from the ground to the block.
    let middle = scene.blocks[block.0].centroid - interface.middle();
    let normal = interface.normal;
    let towards = if normal.dot(&middle) < 0.0 { -normal } else { normal };
    let side = match (towards.dot(&-scene.down()), towards.x) {
        (up, _) if up > 0.5 => "ground under",
        (up, _) if up < -0.5 => "ground above",
        (_, x) if x > 0.0 => "wall left of",
        _ => "wall right of",
    };
    format!("{side} {}", line(&scene.blocks[block.0].id))
}

/// Returns the forces that robots exert on the blocks.
fn robots(solved: SolvedFrame<'_>) -> Vec<Force> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let force = |r: &crate::mechanics::analysis::RobotForce| {
        let what = format!("robot {}", line(&scene.robots[r.robot.0].id));
        Force::new(what, r.at, r.force, r.torque)
    };
    frame_analysis.robots.iter().map(force).collect()
}

/// Returns the missing forces on `blocks`. Missing forces between two of these blocks cancel and are left out. If
/// there are more than [`MAX_REACTIONS`] forces, returns only their sum.
fn missing(solved: SolvedFrame<'_>, blocks: &[BlockId]) -> Vec<Force> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut forces = Vec::new();
    for failure in &frame_analysis.failures {
        let on = failure.acting().into_iter().filter(|acting| blocks.contains(&acting.on));
        let (force, torque) = on.fold((Vector::zeros(), 0.0), |(f, t), on| (f + on.force, t + on.torque));
        if force.norm() > 0.0 || torque != 0.0 {
            let what = match failure.robot() {
                Some(robot) => {
                    format!("missing force of robot {}", line(&scene.robots[robot.0].id))
                }
                None => "missing force, as if the bodies stuck together".to_owned(),
            };
            forces.push(Force::new(what, failure.at(), force, torque));
        }
    }
    if forces.len() > MAX_REACTIONS {
        let what = format!("missing forces at {} points", forces.len());
        return vec![Force::sum(what, &forces)];
    }
    forces
}

/// Returns one row for the weights of several blocks, at their common centre of gravity; `None` if there are none.
fn total_weight(weights: &[&AppliedForce]) -> Option<Force> {
    let force: Vector = weights.iter().map(|w| w.force).sum();
    let total = force.norm();
    let middle: Vector = weights.iter().map(|w| w.at.coords * (w.force.norm() / total)).sum();
    let what = match weights.len() {
        0 => return None,
        1 => "weight of the block".to_owned(),
        count => format!("weight of {count} blocks"),
    };
    Some(Force::new(what, Point::from(middle), force, 0.0))
}

/// Returns one force for each load. If there are more than [`MAX_LOADS`] loads, returns only their sum.
fn listed_loads(scene: &Scene, loads: &[&AppliedForce]) -> Vec<Force> {
    let force = |load: &&AppliedForce| {
        let what = format!("load on {}", line(&scene.blocks[load.block.0].id));
        Force::new(what, load.at, load.force, load.torque)
    };
    let forces: Vec<Force> = loads.iter().map(force).collect();
    if forces.len() > MAX_LOADS {
        return vec![Force::sum(format!("{} loads", forces.len()), &forces)];
    }
    forces
}

/// Makes the table of forces. With `is_sum`, it has their moments and a last row with their sum.
fn table(caption: &str, forces: &[Force], units: Units, is_sum: bool) -> Grid {
    let newtons = units.newtons(forces.iter().flat_map(|f| [f.force.x, f.force.y]));
    // The product of arm and force, to which a moment of rounding errors is compared.
    let arm = |f: &Force| f.at.map_or(0.0, |at| at.coords.norm() * f.force.norm());
    let moments = units.torques(forces.iter().flat_map(|f| [f.moment, f.torque, arm(f)]));
    let places = forces.iter().filter_map(|f| f.at);
    let metres = units.lengths(places.flat_map(|p| [p.x, p.y]));
    let mut heads = vec![
        if is_sum { "external force" } else { "reaction" }.to_owned(),
        metres.head("x"),
        metres.head("y"),
        newtons.head("horizontal F_x"),
        newtons.head("vertical F_y"),
    ];
    heads.extend(is_sum.then(|| moments.head("moment M")));
    let mut grid = Grid::new(caption, &heads);
    let place = |value: Option<f64>| value.map_or("–".to_owned(), |v| metres.write(v));
    for force in forces {
        let mut what = force.what.clone();
        // Leave out torques that are only rounding errors of the solver.
        if force.torque.abs() > TORQUE_TOL * (1.0 + force.force.norm()) {
            what.push_str(&format!(", and a torque of {}", moments.with_unit(force.torque)));
        }
        let [x, y] = [force.at.map(|p| p.x), force.at.map(|p| p.y)].map(place);
        let mut cells = vec![what, x, y, newtons.write(force.force.x), newtons.write(force.force.y)];
        cells.extend(is_sum.then(|| moments.write(force.moment)));
        grid.add("", cells);
    }
    if is_sum {
        let sum = Force::sum("sum", forces);
        let words = [newtons.write(sum.force.x), newtons.write(sum.force.y), moments.write(sum.moment)];
        let words = ["sum", "", ""].map(str::to_owned).into_iter().chain(words);
        grid.add("", words.map(|w| TableCell::strong_if(true, w)));
        grid.has_sum = true;
    }
    grid
}

/// Explains what the sums in the balance table mean, and how moments are computed.
pub(super) fn check_words(frame_analysis: &FrameAnalysis) -> String {
    let words = match frame_analysis.verdict {
        Verdict::Stable => "The sums are zero: weights, loads and reactions balance.",
        Verdict::Unstable if !frame_analysis.unsupported.is_empty() && frame_analysis.failures.is_empty() => {
            "The table leaves out the blocks that nothing carries. The other blocks are in equilibrium."
        }
        Verdict::Unstable if frame_analysis.failures.is_empty() => {
            "The structure falls, and its forces were not computed: the sums are the imbalance."
        }
        Verdict::Unstable => {
            "The structure balances only with the missing forces, which neither contacts nor robots can give."
        }
        Verdict::Undecided => "No balance is proved: the sums are the remaining imbalance of the best forces found.",
    };
    format!("{words} M = x·F_y − y·F_x + torque; right, up and anticlockwise are positive.")
}
