//! [`Analysis::thrust_states`]: the extremes between which the forces of a stable frame may lie, such as least and
//! greatest thrust.
//!
//! Many sets of forces balance a frame. The horizontal thrust at its supports lies between a least and a greatest
//! value. Two linear programs with the constraints of the verdict compute them. The most central forces are
//! balancing forces with the largest safety kernel: each force keeps the largest possible distance from the ends of
//! its joint. The analysis itself reports the forces of least sum. In an arch, they are near the state of least thrust.

use std::collections::BTreeSet;

use super::decide::proved_forces;
use super::gather::set_forces;
use super::{Analysis, Contact, FrameAnalysis, MarginKind, Motion, Options, Verdict};
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::program::{Column, Force, Program, Scale, columns};
use crate::mechanics::proof::{Forces, motions_of};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::mechanics::solve::{Amounts, Conditioning, Effort, Status, least_cost};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// The supports have different horizontal forces if loads and robots push with more than this fraction of the weight.
/// The value is below the three digits with which a thrust is written.
const UNEQUAL_THRUST: f64 = 1e-4;

/// For frames with more blocks no thrust states are computed, because their programs would take longer than the
/// verdict.
const MAX_BLOCKS: usize = 200;
/// A frame whose least thrust is at most this fraction of its weight counts as standing without thrust.
const NO_THRUST: f64 = 1e-3;
/// The weight of the sum of forces in the objective. It selects the least sum among forces with the same thrust.
const PRICE_OF_FORCE: f64 = 1e-6;
/// The most central forces are computed for the largest kernel, reduced by this fraction. At the largest kernel
/// itself the frame is exactly at its limit of stability.
const WITHIN_KERNEL: f64 = 1e-4;

/// Forces that balance a frame.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ThrustState {
    /// The frame with these forces. Its verdict and its margins are copied from the analysis.
    pub frame: FrameAnalysis,
    /// The horizontal thrust, N: half the sum of the inward horizontal forces of both supports.
    pub thrust: f64,
}

/// The states between which the forces of a frame may vary. A state is `None` if it was not found.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct ThrustStates {
    /// The state of least horizontal thrust.
    pub least: Option<ThrustState>,
    /// The state of greatest horizontal thrust.
    pub greatest: Option<ThrustState>,
    /// The state at the largest safety kernel, with the largest distance of the forces from the edges of all joints.
    /// It requires that the margin of the kernel was computed.
    pub central: Option<ThrustState>,
    /// The horizontal thrust of the forces of the analysis, N; 0 if no states were computed.
    pub present: f64,
    /// The number of blocks that touch the ground. The states are computed only if there are two.
    pub supports: usize,
}

impl Analysis {
    /// Returns three sets of balancing forces of a frame (numbered from 0): the forces of least horizontal thrust, the
    /// forces of greatest horizontal thrust, and the most central forces. All three are `None` if the frame does not
    /// exist, does not stand, has more than 200 blocks, or needs almost no thrust. They are also `None` if the least
    /// thrust is not found, if not exactly two blocks touch the ground, or if loads and robots together push
    /// horizontally, because there is then no single horizontal thrust.
    pub fn thrust_states(&self, frame: usize) -> ThrustStates {
        let Some(found) = self.frames.get(frame) else {
            return ThrustStates::default();
        };
        let scene = self.at(frame).scene;
        let few = scene.frames[frame].placed.len() <= MAX_BLOCKS;
        let feet: BTreeSet<BlockId> = supports(&found.contacts).iter().map(|s| s.0).collect();
        let none = ThrustStates { supports: feet.len(), ..ThrustStates::default() };
        if found.verdict != Verdict::Stable || !few || feet.len() != 2 {
            return none;
        }
        // Without a horizontal load, the horizontal forces of the two supports are opposite and equal.
        let across = quarter_turn(scene.down());
        let applied = scene.applied_forces();
        let placed = scene.frames[frame].placed.iter();
        let applied = placed.flat_map(|block| applied[block.0].iter().map(|applied| applied.force));
        let robots = found.robots.iter().map(|robot| robot.force);
        let pushed: Vector = applied.chain(robots).sum();
        if pushed.dot(&across).abs() > UNEQUAL_THRUST * found.weight {
            return none;
        }
        let least = self.extreme(frame, 1.0);
        let needed = least.as_ref().is_some_and(|s| s.thrust > NO_THRUST * found.weight);
        if !needed {
            return none;
        }
        ThrustStates {
            least,
            greatest: self.extreme(frame, -1.0),
            central: self.central(frame),
            present: thrust(scene, &found.contacts),
            ..none
        }
    }

    /// Computes the state of least thrust (`sign` 1) or of greatest thrust (`sign` −1). `None` if no such forces are
    /// found and proved.
    fn extreme(&self, number: usize, sign: f64) -> Option<ThrustState> {
        let scene = self.at(number).scene;
        let frame = &scene.frames[number];
        let assembly = effect::assembly_of(scene, frame, &Interfaces::new(scene));
        let mut state = FrameAnalysis::clone(&self.frames[number]);
        for component in assembly.components() {
            let forces = extreme_forces(scene, &component, sign)?;
            set_forces(&mut state, &component, &forces, scene.kernel);
        }
        let thrust = thrust(scene, &state.contacts);
        Some(ThrustState { frame: state, thrust })
    }

    /// Computes the most central forces: forces that balance the frame with almost the largest safety kernel with
    /// which it stands. `None` if this kernel is unknown, or if the forces have no proof.
    pub(crate) fn central(&self, number: usize) -> Option<ThrustState> {
        let kernel = self.frames[number].margins_alone()?.most(MarginKind::Kernel)?;
        let mut scene = self.at(number).scene.alone(number)?;
        scene.movements.clear();
        scene.vehicle = None;
        scene.kernel = (kernel * (1.0 - WITHIN_KERNEL)).clamp(scene.kernel, 1.0);
        let analysis = Analysis::with(scene, &Options::default());
        let FrameAnalysis { verdict, contacts, robots, .. } = FrameAnalysis::clone(analysis.frames.first()?);
        let frame = FrameAnalysis { contacts, robots, ..FrameAnalysis::clone(&self.frames[number]) };
        let thrust = thrust(&self.given, &frame.contacts);
        (verdict == Verdict::Stable).then_some(ThrustState { frame, thrust })
    }
}

/// Returns the horizontal thrust, N: half the sum of the inward horizontal forces of all supports on the blocks. Inward
/// means towards the middle between the outermost supports.
fn thrust(scene: &Scene, contacts: &[Contact]) -> f64 {
    let across = quarter_turn(scene.down());
    let supports = supports(contacts);
    let places = supports.iter().map(|(_, c)| across.dot(&c.interface.middle().coords));
    let middle = middle(places.clone());
    let pushes = supports
        .iter()
        .zip(places)
        .map(|((_, contact), place)| contact.resultant.force.dot(&across) * if place < middle { 1.0 } else { -1.0 });
    0.5 * pushes.sum::<f64>()
}

/// Returns the contacts between a block and the ground, each with its block.
fn supports(contacts: &[Contact]) -> Vec<(BlockId, &Contact)> {
    let support = |contact: &'_ Contact| match contact.interface.bodies {
        [BodyId::Block(block), BodyId::Ground(_)] => Some(block),
        _ => None,
    };
    contacts.iter().filter_map(|contact| Some((support(contact)?, contact))).collect()
}

/// Returns the mean of the smallest and the largest coordinate, in metres.
fn middle(places: impl Iterator<Item = f64> + Clone) -> f64 {
    let least = places.clone().fold(f64::INFINITY, f64::min);
    0.5 * (least + places.fold(f64::NEG_INFINITY, f64::max))
}

/// Returns the forces of a component with the least (`sign` 1) or the greatest (`sign` −1) inward thrust at its
/// supports. `None` if the linear program fails, or if the forces do not balance every body.
fn extreme_forces(scene: &Scene, component: &Assembly, sign: f64) -> Option<Forces> {
    let across = quarter_turn(scene.down());
    let place = |contact: usize| across.dot(&component.contacts[contact].points[0].coords);
    let supports = (0..component.contacts.len()).filter(|k| component.contacts[*k].from.is_none());
    let middle = middle(supports.map(place));
    let cost = |contact: usize, _, force: Vector| {
        let side = if place(contact) < middle { 1.0 } else { -1.0 };
        sign * side * force.dot(&across)
    };
    cheapest_forces(component, cost, PRICE_OF_FORCE).ok().map(|cheapest| cheapest.0)
}

/// Returns the forces of a component that have the least cost, and the motion that proves that it is the least: no
/// contact force within the friction cones has less power along it than minus its cost. `cost` is the cost of the unit
/// force of a contact with the ground: its contact, its application point, and the force on the block. Every force of
/// the program costs `price` in addition.
///
/// # Errors
/// The status of the linear program if it has no optimum; `Unsolved` also if the forces do not balance every body.
pub(super) fn cheapest_forces(
    component: &Assembly,
    cost: impl Fn(usize, usize, Vector) -> f64,
    price: f64,
) -> Result<(Forces, Vec<Motion>), Status> {
    let program = Program::new(component, Scale::from_assembly(component));
    let columns = columns(&program);
    let cost_of = |column: &Column| match column.force {
        Force::Ray { contact, point, normal, friction } if component.contacts[contact].from.is_none() => {
            let axis = component.contacts[contact].normal;
            price + cost(contact, point, axis * normal + quarter_turn(axis) * friction)
        }
        _ => price,
    };
    let solved = least_cost(&program.loads, &columns, Conditioning::Full, &mut Effort::default(), cost_of);
    if solved.status != Status::Solved {
        return Err(solved.status);
    }
    let mut amounts = Amounts::zero(&program);
    for (column, amount) in columns.iter().zip(&solved.amounts) {
        amounts.add(column.force, *amount);
    }
    let motions = motions_of(component, &solved.y, program.scale.length).into_iter();
    let motions = motions.map(|own| Motion { velocity: -own.velocity, spin: -own.spin, ..own }).collect();
    proved_forces(component, &program, &amounts).map(|(forces, _)| (forces, motions)).ok_or(Status::Unsolved)
}
