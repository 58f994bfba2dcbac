//! Computes a [`LoadCapacity`]: all forces that may act on a block, in addition to its present loads, such that the
//! frame stands.
//!
//! Equilibrium is linear in the forces, so these forces (Fx, Fy) form a convex set. The set is a polygon, which may be
//! unbounded or empty. It consists of the forces that a robot without limits could exert at the point of the block
//! ([`probe`]). A simplex method walks from corner to corner ([`force_polygon`](crate::mechanics::solve::force_polygon)). This
//! method gives contact forces that prove each corner, and for each edge a motion that excludes every farther force.
//!
//! Where a proof is missing, one linear program computes the farthest force of the set in a given direction, with
//! contact forces and a motion. More directions are added until two polygons agree: the convex hull of the proved
//! forces, and the intersection of the half-planes of the motions ([`refine`]). If the simplex method fails, all forces
//! are computed in this way. If the set is then unbounded, the directions in which it is unbounded are computed first
//! ([`cone`]). For several cases, the result is the intersection of their sets ([`cases`]).

mod cases;
mod cone;
mod load_capacity;
mod probe;
mod refine;
mod region;
mod request;
#[cfg(any(feature = "cli", feature = "wasm"))]
mod typed;

use super::decide::{LimitDistance, ProofCache, decide_verdict};
use super::{Analysis, FrameAnalysis, Options, Verdict};
use crate::geometry::{Point, Vector};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{Block, BlockId, Scene};
use crate::mechanics::solve::{DeadlineGuard, is_late};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;
#[cfg(feature = "certificate")]
pub(in crate::mechanics) use cases::extremes;
pub use load_capacity::{CapacityEdge, CapacityShape, CapacityVertex, LoadCapacity, VertexForce};
use probe::Probe;
pub(in crate::mechanics) use probe::with_grip;
pub use request::{CapacityError, CapacityRequest, Cases, ForceAt};
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) use typed::typed_capacity;

impl Analysis {
    /// Computes all forces that a block can carry in a frame, in addition to its present loads. Frames are numbered
    /// from 0.
    ///
    /// Units: newtons and metres. Signs: x to the right, y up.
    ///
    /// # Errors
    /// Returns an error if there is no such frame, if the block is not placed in it, if the request is not valid, or if
    /// no proof was found.
    pub fn capacity(&self, frame: usize, request: &CapacityRequest) -> Result<LoadCapacity, CapacityError> {
        if !self.given().has_conditions() {
            return capacity_of(&self.given, &Interfaces::new(&self.given), frame, request);
        }
        let alone = self.given().alone(frame).ok_or(CapacityError::NoFrame)?;
        request.points(&alone, &alone.frames[0])?;
        if !alone.frames[0].placed.contains(&request.block) {
            return Err(CapacityError::NotPlaced);
        }
        let found = Analysis::with(alone, &Options::default().capacity(*request)).frames;
        found.first().and_then(|found| found.capacity.clone()).ok_or(CapacityError::Undecided)
    }

    /// Computes the motion by which the frame falls under a force just beyond an edge of the capacity, as an elementary
    /// mechanism (see [`Analysis::elementary`]) for drawing. The list is empty if the frame or the edge does not exist.
    ///
    /// The fastest point has speed 1. If the capacity belongs to several cases, or if the force acts at two points, the
    /// result is the motion that proves the edge.
    pub fn edge_mechanism(&self, frame: usize, capacity: &LoadCapacity, edge: usize) -> Vec<Motion> {
        let (Some(found), Some(edge)) = (self.frames.get(frame), capacity.edges.get(edge)) else {
            return Vec::new();
        };
        if edge.case > 0 || capacity.cases > 1 || capacity.at.len() > 1 {
            return edge.mechanism.clone();
        }
        // A force just beyond the middle of the edge makes the power of all loads along this motion positive.
        let ends = edge.ends.iter().flatten();
        let ends: Vec<Vector> = ends.map(|end| capacity.vertices[*end].force).collect();
        let middle = ends.iter().sum::<Vector>() / ends.len().max(1) as f64;
        let size = edge.limit.abs().max(middle.norm()).max(1e-3 * found.weight);
        let scene =
            self.at(frame).scene.with_force(capacity.block, capacity.at[0], middle + edge.normal * (1e-3 * size));
        self.elementary_mechanisms(&scene, found, &edge.mechanism)
    }
}

/// Computes the capacity of each frame if the options request it. Adds a notice if a point of the force lies outside
/// the block. Also adds a notice if the computation fails, unless the block is not placed in this frame.
pub(super) fn add_capacities(scene: &Scene, interfaces: &Interfaces, frames: &mut [FrameAnalysis], options: &Options) {
    let Some(request) = &options.ask.capacity else {
        return;
    };
    let _until = DeadlineGuard::new(options.deadline);
    for (number, frame) in frames.iter_mut().enumerate() {
        match capacity_of(scene, interfaces, number, request) {
            Ok(capacity) => {
                let block = &scene.blocks[request.block.0];
                frame.notices.extend(outside(block, &capacity.at));
                frame.capacity = Some(capacity);
            }
            Err(CapacityError::NotPlaced) => {}
            Err(why) => frame.notices.push(format!("capacity: {why}")),
        }
    }
}

/// True if the error bound of a capacity exceeds `MAX_RELATIVE_GAP` times its largest corner force.
fn is_inexact(capacity: &LoadCapacity) -> bool {
    let sizes = capacity.vertices.iter().map(|v| v.force.norm());
    capacity.gap > MAX_RELATIVE_GAP * sizes.fold(0.0, f64::max)
}

/// If the gap is larger than this fraction of the largest force, the capacity is reported as undecided.
const MAX_RELATIVE_GAP: f64 = 1e-4;

/// Returns a notice about the first of `points` that lies outside the block; `None` if there is no such point.
fn outside(block: &Block, points: &[Point]) -> Option<String> {
    let small = 1e-6 * block.body.polygon.bounds().diagonal();
    let is_outside = |at: &&Point| block.body.distance(**at) > small;
    points.iter().find(is_outside).map(|at| {
        format!(
            "capacity: the point ({}, {}) lies outside the block; the force acts there as on an arm that is fixed to it",
            at.x, at.y
        )
    })
}

/// Computes the capacity of a block in one frame of a scene. Frames are numbered from 0.
pub(crate) fn capacity_of(
    scene: &Scene,
    interfaces: &Interfaces,
    frame: usize,
    request: &CapacityRequest,
) -> Result<LoadCapacity, CapacityError> {
    let found = scene.frames.get(frame).ok_or(CapacityError::NoFrame)?;
    let points = request.points(scene, found)?;
    if !found.placed.contains(&request.block) {
        return Err(CapacityError::NotPlaced);
    }
    let mut assembly = effect::assembly_of(scene, found, interfaces);
    // If the additional force replaces the force of a robot, the force limits of this robot are set to 0. Its torque
    // limit stays.
    let tool = request.tool(found);
    let mut grips = assembly.grips.iter_mut();
    if let Some(grip) = tool.and_then(|hold| grips.find(|grip| grip.robot == hold.robot)) {
        (grip.limits.fx, grip.limits.fy) = (0.0, 0.0);
    }
    let capacity =
        cases::intersected(&assembly, &request.cases, |changed| capacity_of_assembly(changed, request.block, &points))?;
    Ok(LoadCapacity { robot: tool.map(|hold| hold.robot), ranges: request.cases, ..capacity })
}

/// Computes the set of forces that a block can carry in one assembly. The set is empty if another component, which does
/// not contain the block, falls.
pub(super) fn capacity_of_assembly(
    assembly: &Assembly,
    block: BlockId,
    points: &[Point],
) -> Result<LoadCapacity, CapacityError> {
    let holds = |component: &Assembly| component.bodies.iter().position(|body| body.block == block);
    let (own, others): (Vec<Assembly>, Vec<Assembly>) =
        assembly.components().into_iter().partition(|component| holds(component).is_some());
    // The components that do not contain the block must stand without the additional force.
    match decided(&others) {
        (Verdict::Stable, _) => {}
        (Verdict::Unstable, motion) => return Ok(LoadCapacity::empty(block, points.to_vec(), motion)),
        (Verdict::Undecided, _) if is_late() => return Err(CapacityError::Late),
        (Verdict::Undecided, _) => return Err(CapacityError::Undecided),
    }
    let component = own.into_iter().next().ok_or(CapacityError::NotPlaced)?;
    let body = holds(&component).ok_or(CapacityError::NotPlaced)?;
    let probe = Probe::new(&component, body, points);
    let exact = |found| {
        let capacity = region::capacity(found, &probe, block, points);
        if is_inexact(&capacity) { Err(CapacityError::Inexact(capacity.gap)) } else { Ok(capacity) }
    };
    let undecided = |why: CapacityError| match probe.given_up_after() {
        _ if is_late() => CapacityError::Late,
        Some(checks) => CapacityError::GaveUp(checks),
        None => why,
    };
    // The simplex method solves one program for the whole polygon. If it fails, each corner and each edge needs a
    // separate program.
    if let Some(Ok(capacity)) = cone::from_polygon(&probe).map(exact) {
        return Ok(capacity);
    }
    match cone::sample_set(&probe) {
        Some(found) => exact(found).map_err(undecided),
        // No force was found, for one of two reasons: no force on the block balances the loads, or the solver failed.
        // Decide the component with an unlimited grip at the point: if it falls even then, the set is empty.
        None => match decided(std::slice::from_ref(&probe.held)) {
            (Verdict::Unstable, motion) => Ok(LoadCapacity::empty(block, points.to_vec(), motion)),
            _ => Err(undecided(CapacityError::Undecided)),
        },
    }
}

/// Returns the worst verdict on several components of a frame, and the motions with which components fall.
pub(super) fn decided(components: &[Assembly]) -> (Verdict, Vec<Motion>) {
    let found = components.iter().map(|own| decide_verdict(own, LimitDistance::Unknown, &mut ProofCache::default()));
    found.fold((Verdict::Stable, Vec::new()), |(worst, mut all), (verdict, motion)| {
        all.extend(motion);
        (worst.max(verdict), all)
    })
}
