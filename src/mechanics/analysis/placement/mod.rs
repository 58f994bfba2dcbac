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

use self::affine::{GAP, largest_tolerance};
use self::model::Model;
use self::pattern::Errors;
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{BlockId, Scene};
use crate::mechanics::solve::{DeadlineGuard, deadline, is_late};
use crate::mechanics::statics::assembly::Assembly;

/// The largest number of bodies of a component whose tolerance is computed.
const MAX_BODIES: usize = 600;

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
    found.reduce(|a, b| {
        let falls_first = |p: &Placement| p.falls_at.unwrap_or(f64::INFINITY);
        let (mut worse, other) = if falls_first(&b) < falls_first(&a) { (b, a) } else { (a, b) };
        if other.proved < worse.proved {
            (worse.proved, worse.limited_by) = (other.proved, other.limited_by);
        }
        worse.blocks.extend(other.blocks);
        worse.blocks.sort_by_key(|own| own.block);
        worse
    })
}

/// Computes the placement tolerance of one component. `None` if none of its bodies can be off its place.
fn of_component(scene: &Scene, component: &Assembly) -> Option<Placement> {
    let loads = |block: BlockId| {
        let own = scene.loads.iter().filter(|load| load.block == block);
        own.map(|load| load.force.norm()).sum::<f64>()
    };
    let bodies = component.bodies.iter();
    let moments: Vec<f64> = bodies
        .map(|body| body.weight * component.pull.norm() + component.load_factor.abs() * loads(body.block))
        .collect();
    let scales: Vec<f64> = component.bodies.iter().map(|body| scene.blocks[body.block.0].placement).collect();
    if component.contacts.is_empty() || scales.iter().all(|scale| *scale == 0.0) {
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
    };
    if component.bodies.len() > MAX_BODIES {
        return Some(Placement { limited_by: PlacementLimit::TooManyBlocks, ..found });
    }
    let Some(model) = Model::new(component, &moments, &scales) else {
        return Some(Placement { limited_by: PlacementLimit::PointContact, ..found });
    };
    let robust = largest_tolerance(&model);
    found.proved = robust.proved * model.metres;
    if robust.proved >= model.end_of_joints() * (1.0 - GAP) {
        found.limited_by = PlacementLimit::JointLength;
    } else if robust.is_cut {
        found.limited_by = if is_late() { PlacementLimit::TimeLimit } else { PlacementLimit::Search };
    }
    found.joint =
        robust.row.and_then(|row| model.contact_of_row(row)).map(|contact| component.contacts[contact].interface);
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
