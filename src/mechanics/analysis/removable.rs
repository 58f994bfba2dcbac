//! [`Removable`]: for each block of a frame, whether the rest stands without it, and the least force of a robot that
//! holds it, or that holds the rest.
//!
//! The sufficient forces on a block form a polygon with proofs ([`LoadCapacity`](super::LoadCapacity)), and the least force is its distance
//! from 0. It is computed for one block after the other ([`least_hold`]): a motion with which the frame falls gives a
//! half-plane that contains every sufficient force, for every block. The motions of the polygons found so far therefore
//! exclude most of the other blocks.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::capacity::{capacity_of_assembly, decided, with_grip};
use super::condition::Condition;
use super::position::{in_all_positions, same_position};
use super::{Analysis, FrameAnalysis, Options, Verdict};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::proof::{Motion, net_power};
use crate::mechanics::scene::{BlockId, Frame, Limits, Scene};
use crate::mechanics::solve::DeadlineGuard;
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// Whether a block may leave its frame, and which forces of robots are needed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Removable {
    /// The block.
    pub block: BlockId,
    /// The verdict on the rest of the frame: without this block, and without the robot that holds it.
    pub rest: Verdict,
    /// The least force, N, of a robot without torque that holds this block at its grip point, otherwise at its centroid,
    /// with which the whole frame stands; 0 if it stands without this robot. `None` if no force suffices, or if none was
    /// found.
    pub force: Option<f64>,
    /// If the rest falls: the block that one more robot must hold, so that the rest stands.
    pub help: Option<Help>,
    /// The condition in which the rest has its verdict.
    pub condition: Condition,
}

impl Removable {
    fn new(block: BlockId, rest: Verdict, force: Option<f64>, help: Option<Help>) -> Removable {
        Removable { block, rest, force, help, condition: Condition::default() }
    }

    /// Returns what holds in two conditions: the worse verdict, the larger force, and the larger help. The flag says that
    /// different blocks must be held in the two conditions, and no single one is known.
    pub(super) fn and(self, other: Removable) -> (Removable, bool) {
        let force = self.force.zip(other.force).map(|(own, other)| own.max(other));
        let helps = |row: &Removable| row.help.is_some() || row.rest == Verdict::Stable;
        let (help, differs) = match (self.help, other.help) {
            (Some(own), Some(other)) if own.block != other.block => (None, true),
            (Some(own), Some(other)) => (Some(Help { force: own.force.max(other.force), ..own }), false),
            // Where there is no help, the rest stands without it, or nothing is known to help.
            (own, others) => (own.or(others).filter(|_| helps(&self) && helps(&other)), false),
        };
        let worse = if other.rest > self.rest { other } else { self };
        (Removable { force, help, ..worse }, differs)
    }
}

/// The least help with which the rest of a frame stands.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Help {
    /// The block that the robot holds at its centroid. No other block that no robot holds needs a smaller force.
    pub block: BlockId,
    /// The least force of the robot, N.
    pub force: f64,
}

/// The frames without one block are analysed in groups that contain at most about this number of blocks, because all of
/// them together may need gigabytes.
const MAX_TOGETHER: usize = 100_000;

/// Finds out for each frame which blocks may leave it, if the options request it.
pub(super) fn add_removables(scene: &Scene, interfaces: &Interfaces, frames: &mut [FrameAnalysis], options: &Options) {
    if !options.ask.removable {
        return;
    }
    for (frame, found) in scene.frames.iter().zip(frames) {
        let without = |left: &BlockId| Frame {
            placed: frame.placed.iter().copied().filter(|block| block != left).collect(),
            holds: frame.holds.iter().copied().filter(|hold| hold.block != *left).collect(),
            plans: Vec::new(),
            ..frame.clone()
        };
        let mut rows = Vec::with_capacity(frame.placed.len());
        // The conditions in which a frame that stands without its vehicle falls.
        let is_open = found.verdict == Verdict::Stable && scene.vehicle.is_some();
        let mut open = if is_open { in_all_positions(scene, frame, interfaces) } else { Vec::new() };
        open.retain(|given| decided(&given.components()).0 != Verdict::Stable);
        for blocks in frame.placed.chunks((MAX_TOGETHER / frame.placed.len().max(1)).max(1)) {
            if options.is_late() {
                let is_held = |block: BlockId| frame.holds.iter().any(|hold| hold.block == block);
                let late = |block: &BlockId| {
                    let force = (found.verdict == Verdict::Stable && !is_held(*block)).then_some(0.0);
                    let row = Removable::new(*block, Verdict::Undecided, force, None);
                    (row, force.is_none() && found.verdict != Verdict::Undecided)
                };
                rows.extend(blocks.iter().map(late));
                continue;
            }
            let rests = blocks.iter().map(without).collect();
            let rests = Analysis::with(Scene { frames: rests, ..scene.clone() }, &options.only_verdict());
            let one = |number: usize| {
                let _until = DeadlineGuard::new(options.deadline);
                of_block(&rests, interfaces, number, (blocks[number], frame), (found.verdict, &open))
            };
            let numbers = 0..blocks.len();
            #[cfg(feature = "parallel")]
            rows.par_extend(numbers.into_par_iter().map(one));
            #[cfg(not(feature = "parallel"))]
            rows.extend(numbers.map(one));
        }
        for (row, _) in rows.iter().filter(|(_, is_missing)| *is_missing) {
            let name = &scene.blocks[row.block.0].id;
            found.notices.push(format!("removable: no proof was found of the least force for block {name}"));
        }
        found.removable = Some(rows.into_iter().map(|(row, _)| row).collect());
    }
}

/// Finds out whether one block may leave the frame `whole`, which has this verdict without its vehicle, and falls in the
/// conditions `open`. The frame `number` of `rests` is the one without this block.
/// The flag says that a force is missing because no proof was found.
fn of_block(
    rests: &Analysis,
    interfaces: &Interfaces,
    number: usize,
    (block, whole): (BlockId, &Frame),
    (verdict, open): (Verdict, &[Assembly]),
) -> (Removable, bool) {
    let (scene, rest) = (rests.given(), &rests.frames[number]);
    let hold = whole.holds.iter().find(|hold| hold.block == block);
    let force = match (verdict, hold) {
        (Verdict::Undecided, _) => Ok(None),
        (Verdict::Stable, None) => {
            largest_hold(open, (block, scene.blocks[block.0].centroid)).map(|help| help.map(|help| help.force))
        }
        _ => {
            let mut all = in_all_positions(scene, whole, interfaces);
            for given in &mut all {
                let robots = given.grips.iter_mut().filter(|grip| hold.is_some_and(|hold| hold.robot == grip.robot));
                robots.for_each(|grip| grip.limits = Limits { fx: 0.0, fy: 0.0, torque: 0.0 });
            }
            let at = hold.map_or(scene.blocks[block.0].centroid, |hold| hold.at);
            largest_hold(&all, (block, at)).map(|help| help.map(|help| help.force))
        }
    };
    let help = match rest.verdict {
        Verdict::Unstable => {
            let frame = &scene.frames[number];
            let free = frame.placed.iter().filter(|block| frame.holds.iter().all(|hold| hold.block != **block));
            let points = free.map(|block| (*block, scene.blocks[block.0].centroid)).collect();
            // If the rest falls under a vehicle, this scene has the axles at the governing position.
            let given = effect::assembly_of(rests.at(number).scene, frame, interfaces);
            match least_hold(&given, points, &rest.mechanism) {
                Ok(Some(help)) if scene.vehicle.is_some() => {
                    let point = (help.block, scene.blocks[help.block.0].centroid);
                    largest_hold(&in_all_positions(scene, frame, interfaces), point)
                }
                found => found,
            }
        }
        _ => Ok(None),
    };
    let is_missing = force.is_err() || help.is_err();
    let (force, help) = (force.unwrap_or_default(), help.unwrap_or_default());
    let position = rest.under_vehicle.and_then(|under| under.position);
    let position = position.and_then(|own| same_position(scene, (&scene.frames[number], own), whole));
    let row = Removable::new(block, rest.verdict, force, help);
    (Removable { condition: Condition { position, ..row.condition }, ..row }, is_missing)
}

/// Returns the least force at a point of a block with which a frame stands in each of several conditions: the largest of
/// the forces that they need. `None` if no force suffices in one of them.
fn largest_hold(conditions: &[Assembly], (block, at): (BlockId, Point)) -> Result<Option<Help>, NotFound> {
    let mut worst = Help { block, force: 0.0 };
    for given in conditions {
        match decided(&given.components()) {
            (Verdict::Stable, _) => {}
            (_, motion) => match least_hold(given, vec![(block, at)], &motion)? {
                Some(help) => worst.force = worst.force.max(help.force),
                None => return Ok(None),
            },
        }
    }
    Ok(Some(worst))
}

/// No proof shows which force is the least.
pub(super) struct NotFound;

/// The forces on one block with which a frame may stand, as far as the motions tell.
struct Candidate {
    block: BlockId,
    body: usize,
    at: Point,
    /// The half-planes normal · F ≥ limit.
    half_planes: Vec<(Vector, f64)>,
    /// The smallest force in all half-planes.
    least: Vector,
}

/// Finds the least force of a robot at one of the points, on one of the blocks, with which an assembly stands. `None` if
/// no such force suffices. `motion` is a motion with which it falls, or empty.
pub(super) fn least_hold(
    given: &Assembly,
    points: Vec<(BlockId, Point)>,
    motion: &[Motion],
) -> Result<Option<Help>, NotFound> {
    let candidate = |(block, at): (BlockId, Point)| {
        let body = given.bodies.iter().position(|body| body.block == block)?;
        Some(Candidate { block, body, at, half_planes: Vec::new(), least: Vector::zeros() })
    };
    let mut open: Vec<Candidate> = points.into_iter().filter_map(candidate).collect();
    let exclude = |open: &mut Vec<Candidate>, motion: &[Motion]| {
        let power = net_power(given, motion);
        open.retain_mut(|candidate| candidate.exclude(given, motion, power));
    };
    exclude(&mut open, motion);
    let mut best: Option<Help> = None;
    while let Some(next) = (0..open.len()).min_by(|a, b| open[*a].least.norm().total_cmp(&open[*b].least.norm())) {
        let Candidate { block, body, at, least, .. } = open.remove(next);
        if best.is_some_and(|best| least.norm() >= best.force * (1.0 - 1e-9)) {
            break;
        }
        // A robot without limits shows whether any force suffices.
        let unlimited = [f64::INFINITY, f64::INFINITY, 0.0];
        match decided(&with_grip(given, body, at, unlimited).components()) {
            (Verdict::Stable, _) => {}
            (Verdict::Unstable, motion) => {
                exclude(&mut open, &motion);
                continue;
            }
            (Verdict::Undecided, _) => return Err(NotFound),
        }
        let capacity = capacity_of_assembly(given, block, &[at]).map_err(|_| NotFound)?;
        capacity.edges.iter().for_each(|edge| exclude(&mut open, &edge.mechanism));
        if let Some(force) = capacity.least().filter(|force| best.is_none_or(|best| *force < best.force)) {
            best = Some(Help { block, force });
        }
    }
    Ok(best)
}

impl Candidate {
    /// Excludes the forces that do not stop a motion, whose net power without the force is given. Returns false if no
    /// force is left.
    fn exclude(&mut self, given: &Assembly, motion: &[Motion], power: f64) -> bool {
        let centroid = given.bodies[self.body].centroid;
        let own = motion.iter().find(|motion| motion.block == self.block);
        let velocity = own.map(|own| own.about(centroid, self.at)).unwrap_or_default();
        let Some(normal) = (-velocity).try_normalize(1e-9) else { return power <= 0.0 };
        let limit = power / velocity.norm();
        let mut is_left = true;
        if normal.dot(&self.least) < limit {
            // The smallest force now lies on the new line: at its foot, or nearest to it between the other lines.
            let (foot, along) = (normal * limit, quarter_turn(normal));
            let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
            for (other, bound) in &self.half_planes {
                let (rate, missing) = (other.dot(&along), bound - other.dot(&foot));
                if rate > 1e-9 {
                    low = low.max(missing / rate);
                } else if rate < -1e-9 {
                    high = high.min(missing / rate);
                }
            }
            // Lines that almost meet in a point may only seem to miss each other.
            is_left = low <= high + 1e-6 * (limit.abs() + low.abs() + high.abs());
            self.least = foot + along * 0.0_f64.max(low).min(high);
        }
        self.half_planes.push((normal, limit));
        is_left
    }
}
