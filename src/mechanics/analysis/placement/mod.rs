//! [`Placement`]: how accurately the blocks of a frame must be placed.
//!
//! d is a placement tolerance of a frame if it stands for all combinations of these errors: each application point up
//! to d inside its place along the joint, the centre of gravity of each block up to d to either side across gravity,
//! and the line of action of each load up to d to either side across its direction. All errors are independent, and
//! all joints stay closed. Turned blocks, gaps, and joints that an error would open are not covered. The largest
//! tolerance lies between two numbers: up to the first, forces that are affine in the errors prove that the frame
//! stands (`affine`); at the second, a pattern of errors makes it fall (`pattern`).

mod affine;
mod model;
mod pattern;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use self::affine::{GAP, MOST, Robust, largest_tolerance};
use self::model::Model;
use self::pattern::Errors;
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::analysis::condition::Condition;
use crate::mechanics::analysis::margin::END_TOL;
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{BlockId, Scene};
use crate::mechanics::solve::{DeadlineGuard, deadline, is_late};
use crate::mechanics::statics::assembly::Assembly;

/// The largest number of bodies of a component whose tolerance is computed.
const MAX_BODIES: usize = 600;

/// A tolerance up to this, in units of the model, is rounding and counts as 0.
const ROUNDING: f64 = 1e-12;

/// A block that only robots hold has no limit if its tolerance is above this, in units of the model.
const UNBOUNDED: f64 = 0.99 * MOST;

/// An interval between proof and fall of at most this share leaves nothing to search.
const CLOSED: f64 = 1e-4;

/// How accurately the blocks of a frame must be placed: the tolerance of the model in
/// [`doc::placement`](crate::doc::placement).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Placement {
    /// The frame stands for all errors up to this, metres. Forces that are affine in the errors prove it.
    pub proved: f64,
    /// The frame falls with errors of this size, metres, in the directions of `pattern`. `None` if no such pattern was
    /// found.
    pub falls_at: Option<f64>,
    /// The errors of the centres of gravity with which the frame falls.
    pub pattern: Vec<PlacementError>,
    /// The motion by which it then falls.
    pub mechanism: Vec<Motion>,
    /// The contact that decides, as an index into the contacts of the frame: the one at which that motion opens or
    /// slides most, measured by the forces that it takes away.
    pub joint: Option<usize>,
    /// The block whose error does most of the work in that motion.
    pub block: Option<BlockId>,
    /// For each block, how far it alone may be off while all others are in place, metres.
    pub blocks: Vec<BlockPlacement>,
    /// Why the proved tolerance is not larger.
    pub limited_by: PlacementLimit,
    /// The condition in which the proved tolerance is least, and that of the errors with which the frame falls.
    pub conditions: [Condition; 2],
    /// The proof of each component.
    pub(crate) proofs: Vec<PlacementProof>,
}

/// The forces that prove the tolerance of a component, with numbers of components of forces: 3k + i is N₁, N₂ or T of
/// contact k; force x, force y and torque of the grips follow.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlacementProof {
    /// The indices of the contacts among those of the frame.
    pub interfaces: Vec<usize>,
    /// The indices of the grips among those of the frame.
    pub holds: Vec<usize>,
    /// The forces without errors, N, at the ends of the contacts.
    pub forces: Vec<(usize, f64)>,
    /// For each block, the forces that balance the moments of its weight and loads for each metre of the tolerance, N/m.
    pub reactions: Vec<(BlockId, Vec<(usize, f64)>)>,
}

/// Entries of a reaction up to this share of the largest one are rounding errors.
const NEGLIGIBLE: f64 = 1e-12;

impl PlacementProof {
    fn new(component: &Assembly, model: &Model, robust: &Robust) -> PlacementProof {
        let grips = 3 * component.contacts.len();
        let listed = |forces: &[f64], factor: f64| {
            let least = NEGLIGIBLE * forces.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            let used = model.components.iter().zip(forces).filter(|(_, force)| force.abs() > least);
            let used = used.map(|(number, force)| {
                let is_torque = *number >= grips && number % 3 == 2;
                (*number, force * factor * if is_torque { model.metres } else { 1.0 })
            });
            used.collect::<Vec<_>>()
        };
        let reactions = robust.reactions.iter().map(|(body, forces)| {
            // The errors of the model are in its unit of length.
            let factor = -model.moments[*body] * model.newtons / model.metres;
            (component.bodies[*body].block, listed(forces, factor))
        });
        PlacementProof {
            interfaces: component.contacts.iter().map(|contact| contact.interface).collect(),
            holds: component.grips.iter().map(|grip| grip.hold).collect(),
            forces: listed(&robust.forces, model.newtons),
            reactions: reactions.collect(),
        }
    }
}

/// The error of one block.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlacementError {
    /// The block.
    pub block: BlockId,
    /// How far its centre of gravity is off its place, metres. Its loads are off to the side that turns it the same
    /// way.
    pub offset: Vector,
}

/// How far one block may be off while all others are in place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct BlockPlacement {
    /// The block.
    pub block: BlockId,
    /// Proved tolerance of the block alone, metres.
    pub proved: f64,
}

words! {
    /// Why a proved placement tolerance is not larger.
    #[derive(PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum PlacementLimit {
        /// No larger tolerance has a proof of this kind.
        #[default]
        Balance = "balance";
        /// Beyond it, a joint has no length left.
        JointLength = "joint_length";
        /// A contact acts at a single point, which leaves no room for an error.
        PointContact = "point_contact";
        /// The component has too many blocks.
        TooManyBlocks = "too_many_blocks";
        /// The search ended before the optimum, because of rounding.
        Search = "search";
        /// The time limit ended the search.
        TimeLimit = "time_limit";
    }
}

/// Computes the placement tolerance of a frame that stands, from its components.
pub(super) fn find_placement<'a>(scene: &Scene, components: impl Iterator<Item = &'a Assembly>) -> Option<Placement> {
    let found = components.filter_map(|component| of_component(scene, component));
    found.reduce(Placement::and)
}

impl Placement {
    /// Returns what holds for two components together, or for the same frame in two conditions.
    pub(super) fn and(self, other: Placement) -> Placement {
        let falls_first = |p: &Placement| p.falls_at.unwrap_or(f64::INFINITY);
        let (mut worse, other) = if falls_first(&other) < falls_first(&self) { (other, self) } else { (self, other) };
        if other.proved < worse.proved {
            (worse.proved, worse.limited_by) = (other.proved, other.limited_by);
            worse.conditions[0] = other.conditions[0];
        }
        worse.blocks.extend(other.blocks);
        worse.proofs.extend(other.proofs);
        worse.blocks.sort_by(|a, b| a.block.cmp(&b.block).then(a.proved.total_cmp(&b.proved)));
        worse.blocks.dedup_by_key(|own| own.block);
        worse
    }

    /// True if the proved tolerance of all blocks together also holds in the condition of a scene, in which the frame is
    /// `assembly`. False if this is not known.
    pub(super) fn holds_for(&self, scene: &Scene, assembly: &Assembly) -> bool {
        assembly.components().iter().all(|component| {
            let (moments, scales) = moments_of(scene, component);
            let is_loose = !(component.contacts.is_empty() && component.grips.is_empty());
            if self.proved == 0.0 || !is_loose || scales.iter().all(|scale| *scale == 0.0) {
                return true;
            }
            let Some(model) = Model::new(component, &moments, &scales) else { return false };
            let aim = self.proved / model.metres * (1.0 - END_TOL);
            aim <= model.end_of_joints() && largest_tolerance(&model, Some(aim)).proved >= aim
        })
    }

    /// Returns the sense of the additional moment of each body in the pattern, 1 for anticlockwise, and the assembly with
    /// the errors of this pattern, of a size in metres.
    pub(crate) fn with_errors(&self, scene: &Scene, component: &Assembly, error: f64) -> (Vec<f64>, Assembly) {
        let side = quarter_turn(component.pull);
        let signs = component.bodies.iter().map(|body| {
            let own = self.pattern.iter().find(|error| error.block == body.block);
            own.map_or(0.0, |error| -error.offset.dot(&side).signum())
        });
        let signs: Vec<f64> = signs.collect();
        let (moments, scales) = moments_of(scene, component);
        let moved = Errors { component, moments: &moments, scales: &scales }.placed(error, &signs);
        (signs, moved)
    }
}

/// Returns the moment of each body per metre of error, N, and the factor on the error of each.
fn moments_of(scene: &Scene, component: &Assembly) -> (Vec<f64>, Vec<f64>) {
    let loads = |block: BlockId| {
        let own = scene.loads.iter().filter(|load| load.block == block);
        own.map(|load| load.force.norm()).sum::<f64>()
    };
    let bodies = component.bodies.iter();
    let moments =
        bodies.map(|body| body.weight * component.pull.norm() + component.load_factor.abs() * loads(body.block));
    (moments.collect(), component.bodies.iter().map(|body| scene.blocks[body.block.0].placement).collect())
}

/// Computes the placement tolerance of one component. `None` if none of its bodies can be off its place.
fn of_component(scene: &Scene, component: &Assembly) -> Option<Placement> {
    let (moments, scales) = moments_of(scene, component);
    if component.contacts.is_empty() && component.grips.is_empty() || scales.iter().all(|scale| *scale == 0.0) {
        return None;
    }
    let mut found = Placement {
        proved: 0.0,
        falls_at: None,
        pattern: Vec::new(),
        mechanism: Vec::new(),
        joint: None,
        block: None,
        blocks: Vec::new(),
        limited_by: PlacementLimit::Balance,
        conditions: Default::default(),
        proofs: Vec::new(),
    };
    if component.bodies.len() > MAX_BODIES {
        return Some(Placement { limited_by: PlacementLimit::TooManyBlocks, ..found });
    }
    if is_late() {
        return Some(Placement { limited_by: PlacementLimit::TimeLimit, ..found });
    }
    let Some(model) = Model::new(component, &moments, &scales) else {
        return Some(Placement { limited_by: PlacementLimit::PointContact, ..found });
    };
    let end = model.end_of_joints() * (1.0 - GAP);
    let mut best = without_shortest(component, &model, &moments, &scales);
    if best.as_ref().is_none_or(|(short, _)| short.proved < end && !is_late()) {
        let robust = largest_tolerance(&model, None);
        if best.as_ref().is_none_or(|(short, _)| short.proved <= robust.proved) {
            let proof = PlacementProof::new(component, &model, &robust);
            best = Some((robust, proof));
        }
    }
    let (robust, proof) = best?;
    if component.contacts.is_empty() && robust.proved > UNBOUNDED {
        return None;
    }
    found.proved = if robust.proved > ROUNDING { robust.proved * model.metres } else { 0.0 };
    found.proofs = vec![proof];
    let mut joint = robust.row.and_then(|row| model.contact_of_row(row));
    if robust.proved >= end {
        found.limited_by = PlacementLimit::JointLength;
        joint = model.shortest().next();
    } else if robust.is_cut {
        found.limited_by = if is_late() { PlacementLimit::TimeLimit } else { PlacementLimit::Search };
    }
    found.joint = joint.map(|contact| component.contacts[contact].interface);
    let errors = Errors { component, moments: &moments, scales: &scales };
    if let Some(falling) = errors.falling(&model, &robust.motion, found.proved) {
        let side = quarter_turn(component.pull).try_normalize(0.0).unwrap_or_default();
        let parts = component.bodies.iter().zip(&falling.signs).zip(&scales);
        let offsets = parts.filter(|(_, scale)| **scale > 0.0);
        found.pattern = offsets
            .map(|((body, sign), scale)| PlacementError {
                block: body.block,
                offset: side * (-sign * scale * falling.at),
            })
            .collect();
        let work = |motion: &Motion| {
            let body = component.bodies.iter().position(|body| body.block == motion.block);
            body.map_or(0.0, |body| (motion.spin * moments[body] * scales[body]).abs())
        };
        let most = falling.mechanism.iter().max_by(|a, b| work(a).total_cmp(&work(b)));
        found.block = most.map(|motion| motion.block);
        found.falls_at = Some(falling.at);
        if falling.at <= found.proved * (1.0 + CLOSED) && found.limited_by == PlacementLimit::Search {
            found.limited_by = PlacementLimit::Balance;
        }
        found.mechanism = falling.mechanism;
    }
    found.blocks = each_alone(component, &moments, &scales);
    // What holds for the errors of all blocks holds for those of one.
    found.blocks.iter_mut().for_each(|own| own.proved = own.proved.max(found.proved));
    Some(found)
}

/// Proves that a component stands even without its shortest joints, as a wall stands without its head joints, until these
/// have no length left. `None` if no joints are left.
fn without_shortest(
    component: &Assembly,
    model: &Model,
    moments: &[f64],
    scales: &[f64],
) -> Option<(Robust, PlacementProof)> {
    let short: Vec<usize> = model.shortest().collect();
    let mut rest = component.clone();
    rest.contacts =
        component.contacts.iter().enumerate().filter(|(k, _)| !short.contains(k)).map(|(_, c)| *c).collect();
    let aim = model.end_of_joints();
    let model = if rest.contacts.is_empty() { return None } else { Model::new(&rest, moments, scales)? };
    let robust = Robust { row: None, ..largest_tolerance(&model, Some(aim)) };
    let proof = PlacementProof::new(&rest, &model, &robust);
    Some((robust, proof))
}

/// Computes for each body how far it alone may be off.
fn each_alone(component: &Assembly, moments: &[f64], scales: &[f64]) -> Vec<BlockPlacement> {
    let until = deadline();
    let one = |number: usize| {
        let _guard = DeadlineGuard::new(until);
        let mut own = vec![0.0; scales.len()];
        own[number] = scales[number];
        let errors = Errors { component, moments, scales: &own };
        let proved = if own[number] > 0.0 && !is_late() { errors.of_one(number)? } else { return None };
        Some(BlockPlacement { block: component.bodies[number].block, proved })
    };
    let bodies = 0..component.bodies.len();
    #[cfg(feature = "parallel")]
    return bodies.into_par_iter().filter_map(one).collect();
    #[cfg(not(feature = "parallel"))]
    return bodies.filter_map(one).collect();
}
