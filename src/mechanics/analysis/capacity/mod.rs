//! [`LoadCapacity`]: all forces that may act on a block, in addition to its present loads, such that the frame stands.
//!
//! Equilibrium is linear in the forces, so these forces (Fx, Fy) form a convex set. The set is a polygon, which may be
//! unbounded or empty. It contains the forces that a robot without limits could exert at this point ([`probe`]). One
//! linear program computes the farthest force of the set in a given direction. It also gives contact forces that prove
//! this force, and a motion that excludes every farther force. More directions are added until two polygons agree: that
//! of the proved forces, and that of the half-planes of the motions ([`refine`]). If forces of any size are carried in
//! some direction, the directions in which the set is unbounded are found first ([`cone`]). For several cases, the
//! result is the intersection of their sets ([`cases`]).

mod cases;
mod cone;
mod probe;
mod refine;
mod region;
mod request;
#[cfg(any(feature = "cli", feature = "wasm"))]
mod typed;

use super::decide::{LimitDistance, ProofCache, decide_verdict};
use super::{Analysis, FrameAnalysis, Options, Verdict};
use crate::assembly::Assembly;
use crate::effect::{self, FrameContext};
use crate::geometry::{Point, Vector};
use crate::interface::Interfaces;
use crate::proof::{Motion, Proof};
use crate::scene::{Block, BlockId, RobotId, Scene};
use crate::solve::{DeadlineGuard, is_late};
use probe::Probe;
pub use request::{CapacityError, CapacityRequest, Cases, ForceAt};
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) use typed::typed_capacity;

/// All forces that may act on a block at a point, in addition to its present loads, such that the frame stands.
///
/// The set is the convex hull of `vertices`, extended without end along `rays`. Forces are in newtons, x to the right
/// and y up.
///
/// # Example
/// ```
/// use drystone::analysis::{CapacityRequest, CapacityShape};
/// use drystone::{Analysis, Scene};
/// // A block of 6 N and 4 m × 2 m on a floor with friction 0.5, pushed at its centroid.
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [5, 0], [5, 2], [1, 2]], "weight": 6 }] }"#)?;
/// let request = CapacityRequest::of_block(scene.block_named("a").expect("it exists"));
/// let capacity = Analysis::new(&scene).capacity(0, &request)?;
/// // It slides if |Fx| > 0.5 (6 − Fy): a cone that opens downwards below its tip at (0, 6).
/// assert_eq!(capacity.shape(), CapacityShape::Unbounded);
/// assert!((capacity.vertices[0].force.y - 6.0).abs() < 1e-6);
/// assert!(capacity.contains([2.9, 0.0]) && !capacity.contains([3.1, 0.0]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LoadCapacity {
    /// The block on which the force acts.
    pub block: BlockId,
    /// The point at which the force acts, metres. A free contact has two points; the force is then their resultant.
    pub at: Vec<Point>,
    /// The robot whose force it is, if a robot holds the block at this point.
    pub robot: Option<RobotId>,
    /// The corners of the set, anticlockwise; one for a point, two for a segment, none for the empty set.
    pub vertices: Vec<CapacityVertex>,
    /// The unit directions in which the set is unbounded, anticlockwise: at most two, or four if every force is
    /// carried.
    pub rays: Vec<Vector>,
    /// The edges, anticlockwise.
    pub edges: Vec<CapacityEdge>,
    /// A bound on the error, N: no force that the motions allow is farther than this from the set of proved forces.
    pub gap: f64,
    /// How the frame begins to fall whatever the force is. Empty unless the set is empty and a motion proves it.
    pub mechanism: Vec<Motion>,
    /// The number of extreme cases in which each of these forces is carried; 1 if no range was given.
    pub cases: usize,
}

/// A corner of a [`LoadCapacity`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CapacityVertex {
    /// The force on the block, N.
    pub force: Vector,
    /// The torque of a free contact, N·m, about its first point; 0 if the force acts at one point.
    pub torque: f64,
    /// The contact forces that balance the force of this vertex. Empty if several cases were intersected, because each
    /// case has its own.
    pub contacts: Vec<VertexForce>,
    /// The proof by these forces; `None` if several cases were intersected.
    pub proof: Option<Proof>,
}

/// The forces at one interface that carry the force of a vertex, N.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct VertexForce {
    /// The index of the interface among the contacts of the frame.
    pub interface: usize,
    /// Normal forces at its two application points, pressure positive.
    pub normal: [f64; 2],
    /// Friction on its first body, positive along (−n_y, n_x).
    pub friction: f64,
}

/// An edge of a [`LoadCapacity`]: every force F of the set has normal · F ≤ limit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CapacityEdge {
    /// The indices of the vertices at which the edge begins and ends, anticlockwise. `None` on a side where it is
    /// unbounded.
    pub ends: [Option<usize>; 2],
    /// The outward unit normal. The point of the block begins to move in this direction under a force just beyond the
    /// edge.
    pub normal: Vector,
    /// The limit of normal · F, N.
    pub limit: f64,
    /// How the blocks begin to move under a force just beyond the edge.
    pub mechanism: Vec<Motion>,
    /// The proof that the frame falls by this motion under such a force.
    pub proof: Proof,
    /// The index, from 0, of the case that this edge belongs to.
    pub case: usize,
}

/// The kind of set that a [`LoadCapacity`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CapacityShape {
    /// No force is carried.
    Empty,
    /// Only one force is carried.
    Point,
    /// The forces on the line segment between two forces.
    Segment,
    /// A bounded polygon.
    Polygon,
    /// The set is unbounded: forces of any size are carried in some directions.
    Unbounded,
    /// Every force is carried.
    Everything,
}

impl CapacityShape {
    /// Returns the name of this shape in JSON results.
    pub fn word(self) -> &'static str {
        match self {
            CapacityShape::Empty => "empty",
            CapacityShape::Point => "point",
            CapacityShape::Segment => "segment",
            CapacityShape::Polygon => "polygon",
            CapacityShape::Unbounded => "unbounded",
            CapacityShape::Everything => "everything",
        }
    }
}

impl LoadCapacity {
    /// Returns the kind of this set: empty, a point, a segment, a polygon, unbounded, or every force.
    pub fn shape(&self) -> CapacityShape {
        match (self.vertices.len(), self.rays.len()) {
            (_, 3..) => CapacityShape::Everything,
            (_, 1..) => CapacityShape::Unbounded,
            (0, _) => CapacityShape::Empty,
            (1, _) => CapacityShape::Point,
            (2, _) => CapacityShape::Segment,
            _ => CapacityShape::Polygon,
        }
    }

    /// Returns the largest value of force · direction among the carried forces; it is in newtons for a unit direction.
    /// `None` if this value is unbounded, or if no force is carried.
    pub fn most(&self, direction: impl Into<Vector>) -> Option<f64> {
        let direction = direction.into();
        let unbounded = |ray: &Vector| ray.dot(&direction) > 1e-9 * direction.norm();
        if self.rays.iter().any(unbounded) {
            return None;
        }
        let along = self.vertices.iter().map(|v| v.force.dot(&direction));
        along.reduce(f64::max)
    }

    /// True if the frame stands with this additional force, in newtons, on the block.
    pub fn contains(&self, force: impl Into<Vector>) -> bool {
        let force = force.into();
        let corners: Vec<Vector> = self.vertices.iter().map(|v| v.force).collect();
        region::contains(&corners, &self.rays, force)
    }

    /// Returns the magnitude of the largest force, N, that the block can carry in a unit direction. Infinite if it can
    /// carry every force in this direction. `None` if the frame falls without an additional force.
    pub fn reach(&self, direction: impl Into<Vector>) -> Option<f64> {
        let direction = direction.into();
        if !self.contains(Vector::zeros()) {
            return None;
        }
        let corners: Vec<Vector> = self.vertices.iter().map(|v| v.force).collect();
        Some(region::reach(&corners, &self.rays, direction))
    }

    /// Returns the indices of `edges`, from the longest edge to the shortest. Unbounded edges come first.
    pub fn longest_edges(&self) -> Vec<usize> {
        let length = |k: &usize| match self.edges[*k].ends {
            [Some(a), Some(b)] => (self.vertices[a].force - self.vertices[b].force).norm(),
            _ => f64::INFINITY,
        };
        let mut order: Vec<usize> = (0..self.edges.len()).collect();
        order.sort_by(|a, b| length(b).total_cmp(&length(a)));
        order
    }

    fn empty(block: BlockId, at: Vec<Point>, mechanism: Vec<Motion>) -> LoadCapacity {
        LoadCapacity {
            block,
            at,
            robot: None,
            vertices: Vec::new(),
            rays: Vec::new(),
            edges: Vec::new(),
            gap: 0.0,
            mechanism,
            cases: 1,
        }
    }
}

impl Analysis {
    /// Computes all forces that a block can carry in a frame, in addition to its present loads. Frames are numbered
    /// from 0.
    ///
    /// Units: newtons and metres. Signs: x to the right, y up.
    ///
    /// # Errors
    /// Returns an error if there is no such frame, if the block is not placed in it, if the request is not valid, or if
    /// no proof was found.
    pub fn capacity(
        &self,
        frame: usize,
        request: &CapacityRequest,
    ) -> Result<LoadCapacity, CapacityError> {
        capacity_of(&self.scene, &Interfaces::new(&self.scene), frame, request)
    }

    /// Computes the motion by which the frame falls under a force just beyond an edge of the capacity, as an elementary
    /// mechanism (see [`Analysis::elementary`]) for drawing. The list is empty if the frame or the edge does not exist.
    ///
    /// The fastest point has speed 1.
    pub fn edge_mechanism(
        &self,
        frame: usize,
        capacity: &LoadCapacity,
        edge: usize,
    ) -> Vec<Motion> {
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
        let scene = self.scene.with_force(
            capacity.block,
            capacity.at[0],
            middle + edge.normal * (1e-3 * size),
        );
        self.elementary_mechanisms(&scene, found, &edge.mechanism)
    }
}

/// Computes the capacity of each frame if the options request it. Adds a notice to a frame if this fails.
pub(super) fn add_capacities(
    scene: &Scene,
    interfaces: &Interfaces,
    frames: &mut [FrameAnalysis],
    options: &Options,
) {
    let Some(request) = &options.capacity else {
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

/// Returns a notice if one of `points` lies outside the block: about the first such point. Otherwise `None`.
fn outside(block: &Block, points: &[Point]) -> Option<String> {
    let outline = block.body.polygon.outline();
    let next = |k: usize| outline[(k + 1) % outline.len()];
    let near = |at: Point| {
        let edges = outline.iter().enumerate();
        let away = edges.map(|(k, a)| region::to_segment(at.coords, a.coords, next(k).coords));
        away.fold(f64::INFINITY, f64::min)
    };
    let small = 1e-6 * block.body.polygon.bounds().diagonal();
    let is_outside = |at: &&Point| !block.body.polygon.contains(**at) && near(**at) > small;
    points.iter().find(is_outside).map(|at| {
        format!(
            "capacity: the point ({}, {}) lies outside the block; the force acts there as on an arm that is fixed to it",
            at.x, at.y
        )
    })
}

/// Computes the capacity of a block in a frame of a scene, numbered from 0.
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
    let context = FrameContext {
        scene,
        frame: found,
        interfaces: &interfaces.in_frame(scene, found),
    };
    let (mut assembly, _) = effect::assemble(&context);
    // The capacity replaces the force of this robot, so its force limits are set to 0. Its torque limit stays.
    let tool = request.tool(found);
    let mut grips = assembly.grips.iter_mut();
    if let Some(grip) = tool.and_then(|hold| grips.find(|grip| grip.robot == hold.robot)) {
        (grip.limits.fx, grip.limits.fy) = (0.0, 0.0);
    }
    let capacity = cases::intersected(&assembly, &request.cases, |changed| {
        capacity_of_assembly(changed, request.block, &points)
    })?;
    Ok(LoadCapacity {
        robot: tool.map(|hold| hold.robot),
        ..capacity
    })
}

/// Computes the set of forces that a block can carry in one assembly. The set is empty if another component, which does
/// not contain the block, falls.
fn capacity_of_assembly(
    assembly: &Assembly,
    block: BlockId,
    points: &[Point],
) -> Result<LoadCapacity, CapacityError> {
    let (mut own, mut falls) = (None, None);
    for component in assembly.components() {
        if let Some(body) = component.bodies.iter().position(|b| b.block == block) {
            own = Some((component, body));
            continue;
        }
        // The component does not contain the block. It must stand by itself.
        match decide_verdict(
            &component,
            LimitDistance::Unknown,
            &mut ProofCache::default(),
        ) {
            (Verdict::Stable, _) => {}
            (Verdict::Unstable, motion) => falls = Some(motion),
            (Verdict::Undecided, _) => return Err(undecided()),
        }
    }
    let (component, body) = own.ok_or(CapacityError::NotPlaced)?;
    if let Some(mechanism) = falls {
        return Ok(LoadCapacity::empty(block, points.to_vec(), mechanism));
    }
    let probe = Probe::new(&component, body, points);
    match cone::sample_set(&probe) {
        Some(found) => {
            let capacity = region::capacity(found, &probe, block, points);
            match is_inexact(&capacity) {
                true => Err(undecided()),
                false => Ok(capacity),
            }
        }
        // No force was found, for one of two reasons: no force on the block balances the loads, or the solver failed.
        // The component with a free force decides: if it falls, the set is empty.
        None => match decide_verdict(
            &probe.held,
            LimitDistance::Unknown,
            &mut ProofCache::default(),
        ) {
            (Verdict::Unstable, motion) => Ok(LoadCapacity::empty(block, points.to_vec(), motion)),
            _ => Err(undecided()),
        },
    }
}

fn undecided() -> CapacityError {
    match is_late() {
        true => CapacityError::Late,
        false => CapacityError::Undecided,
    }
}
