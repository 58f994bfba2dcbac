//! [`SupportMovement`]: how a structure follows a small movement of a part of the ground.
//!
//! Among all forces that balance the frame, the structure goes to those whose force on the moved support does least work
//! on the movement: if the feet of an arch spread, to its least thrust. This is one linear program with the constraints
//! of the verdict. Its dual variables are the velocities of the blocks: the cracked shape. Its optimum says that they
//! agree with the movement, that no contact closes, and that every force is where its contact stays closed.
//! Displacements are small, so everything is proportional to the movement. As in mechanisms, a contact that slides also
//! opens, by μ times the slip (the associated flow rule). Reference: [Heyman66](crate::doc::references).

use std::collections::BTreeMap;

use super::gather::set_forces;
use super::thrust_states::cheapest_forces;
use super::{FrameAnalysis, Motion, Options, Verdict};
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::{BlockId, BodyId, Movement, Scene};
use crate::mechanics::solve::{DeadlineGuard, Status, is_late};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// A contact counts as closed up to this fraction of the largest relative velocity of two bodies in contact.
const CLOSED_TOL: f64 = 1e-4;

/// A component of the force on a support below this fraction of the force is an error of the solver.
const FORCE_NOISE: f64 = 1e-9;
/// The cost of a force, per unit of its work on the fastest point of the support. It moves a block by at most this fraction
/// of the movement, which is far below [`CLOSED_TOL`].
const PRICE_OF_FORCE: f64 = 1e-7;

/// How a frame follows one of the movements that the scene lists.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SupportMovement {
    /// The index in the list of movements of the scene, from 0.
    pub number: usize,
    /// What the structure does.
    pub outcome: MovementOutcome,
}

/// What a structure does if a support moves.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum MovementOutcome {
    /// It cracks and follows the support.
    Follows(Cracked),
    /// It cannot follow as rigid blocks: the support would have to crush it.
    Jams,
    /// No block touches the support, or no point of contact moves.
    Untouched,
    /// The solver ended without a result.
    Unsolved,
}

impl MovementOutcome {
    /// Returns the word for this outcome in results, such as `follows`.
    pub fn word(&self) -> &'static str {
        match self {
            MovementOutcome::Follows(_) => "follows",
            MovementOutcome::Jams => "jams",
            MovementOutcome::Untouched => "untouched",
            MovementOutcome::Unsolved => "unsolved",
        }
    }
}

/// The state of a structure that follows a movement. Velocities, openings and slips are per unit of the movement: metres
/// per metre by which the fastest point of contact of the support moves.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Cracked {
    /// The displacement of the fastest point at which the structure touches the support, metres.
    pub unit: f64,
    /// The force of the structure on the support, N.
    pub force: Vector,
    /// The work of this force on the movement, J: the least of all forces that balance the frame.
    pub work: f64,
    /// The joints that open or slide, in the order of the contacts.
    pub cracks: Vec<Crack>,
    /// The velocity of every placed block.
    pub motions: Vec<Motion>,
}

/// A joint that opens or slides. Units as in [`Cracked`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Crack {
    /// The index of the contact in the frame.
    pub contact: usize,
    /// The application point that stays closed, 0 or 1; `None` if both open alike or neither stays closed.
    pub end: Option<usize>,
    /// How far the joint opens at its wider end.
    pub opening: f64,
    /// How far the first body slides along (−n_y, n_x).
    pub slip: f64,
}

impl Cracked {
    /// Returns the displacement of a point of a body per unit of the movement.
    pub fn velocity(&self, scene: &Scene, movement: &Movement, body: BodyId, at: Point) -> Vector {
        match body {
            BodyId::Ground(part) if part == movement.ground => movement.at(at) / self.unit,
            BodyId::Ground(_) => Vector::zeros(),
            BodyId::Block(block) => {
                let own = self.motions.binary_search_by_key(&block, |motion| motion.block);
                own.map_or(Vector::zeros(), |own| self.motions[own].at(scene, at))
            }
        }
    }
}

/// Computes how each frame that stands follows the movements of the scene, unless `options` request only the verdict.
pub(super) fn add_movements(scene: &Scene, interfaces: &Interfaces, frames: &mut [FrameAnalysis], options: &Options) {
    if scene.movements.is_empty() || options.verdict_only {
        return;
    }
    let _until = DeadlineGuard::new(options.deadline);
    for (frame, found) in scene.frames.iter().zip(frames) {
        let stands = found.verdict == Verdict::Stable;
        found.effects.push(effect::report::movements(scene.movements.len(), stands));
        if !stands {
            continue;
        }
        let components = effect::assembly_of(scene, frame, interfaces).components();
        let outcomes = scene.movements.iter().map(|movement| outcome(scene, found, &components, movement));
        let numbered = outcomes.enumerate().map(|(number, outcome)| SupportMovement { number, outcome });
        found.movements = numbered.collect();
    }
}

/// Computes how a frame follows one movement.
fn outcome(scene: &Scene, found: &FrameAnalysis, components: &[Assembly], movement: &Movement) -> MovementOutcome {
    let is_moved = |contact: usize| found.contacts[contact].interface.bodies.contains(&BodyId::Ground(movement.ground));
    let touching = found.contacts.iter().enumerate().filter(|(number, _)| is_moved(*number));
    let reached = touching.clone().flat_map(|(_, contact)| contact.application_points);
    let unit = reached.map(|at| movement.at(at).norm()).fold(0.0, f64::max);
    if unit == 0.0 {
        return MovementOutcome::Untouched;
    }
    if is_late() {
        return MovementOutcome::Unsolved;
    }
    let mut state = found.clone();
    let mut motions: BTreeMap<BlockId, Motion> = BTreeMap::new();
    for component in components {
        if !component.contacts.iter().any(|contact| is_moved(contact.interface)) {
            continue;
        }
        let work = |contact: usize, point: usize, on_block: Vector| {
            let contact = &component.contacts[contact];
            if is_moved(contact.interface) { -on_block.dot(&movement.at(contact.points[point])) / unit } else { 0.0 }
        };
        // Where forces of any size do no work, the solver may find no end. A small price of forces bounds them.
        let cheapest = cheapest_forces(component, work, 0.0).or_else(|status| match status {
            Status::Infeasible => Err(status),
            _ => cheapest_forces(component, work, PRICE_OF_FORCE),
        });
        match cheapest {
            Ok((forces, moved)) => {
                set_forces(&mut state, component, &forces, scene.kernel);
                motions.extend(moved.into_iter().map(|motion| (motion.block, motion)));
            }
            Err(Status::Infeasible) => return MovementOutcome::Jams,
            Err(_) => return MovementOutcome::Unsolved,
        }
    }
    let on_support = touching.clone().map(|(number, _)| {
        let resultant = state.contacts[number].resultant;
        let force = -resultant.force;
        (force, force.dot(&movement.at(resultant.at)))
    });
    let (force, work) = on_support.fold((Vector::zeros(), 0.0), |sum, own| (sum.0 + own.0, sum.1 + own.1));
    // A component that is only rounding beside the other one is 0.
    let force = force.map(|part| if part.abs() <= FORCE_NOISE * force.norm() { 0.0 } else { part });
    let mut cracked = Cracked { unit, force, work, cracks: Vec::new(), motions: motions.into_values().collect() };
    cracked.cracks = cracks(scene, found, movement, &cracked);
    MovementOutcome::Follows(cracked)
}

/// Returns the joints that open or slide.
fn cracks(scene: &Scene, found: &FrameAnalysis, movement: &Movement, cracked: &Cracked) -> Vec<Crack> {
    let relative = |number: usize| {
        let contact = &found.contacts[number];
        contact.application_points.map(|at| {
            let [a, b] = contact.interface.bodies.map(|body| cracked.velocity(scene, movement, body, at));
            a - b
        })
    };
    let numbers = 0..found.contacts.len();
    let largest = numbers.clone().flat_map(relative).map(|v| v.norm()).fold(0.0, f64::max);
    let noise = CLOSED_TOL * largest;
    let one = |number: usize| {
        let interface = &found.contacts[number].interface;
        let relative = relative(number);
        let opening = relative.map(|v| v.dot(&interface.normal));
        let along = relative.map(|v| v.dot(&interface.tangent()));
        let closed = [0, 1].map(|k| opening[k] - interface.friction * along[k].abs() <= noise);
        let (end, slides) = match closed {
            [true, true] => (None, along[0]),
            [true, false] => (Some(0), along[0]),
            [false, true] => (Some(1), along[1]),
            [false, false] => (None, 0.0),
        };
        let slip = if slides.abs() > noise { slides } else { 0.0 };
        let opening = opening[0].max(opening[1]);
        (opening > noise || slip != 0.0).then_some(Crack { contact: number, end, opening, slip })
    };
    numbers.filter_map(one).collect()
}
