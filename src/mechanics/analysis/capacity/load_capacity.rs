//! [`LoadCapacity`]: the set of forces that a block can carry, with its corners, edges and proofs.

use super::region;
use super::request::Cases;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::condition::Condition;
use crate::mechanics::proof::{Motion, Proof};
use crate::mechanics::scene::{BlockId, RobotId};

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
    /// The point at which the force acts, metres. For `ForceAt::Contact` there are two points, and the force is the
    /// resultant of the forces at both.
    pub at: Vec<Point>,
    /// The robot whose force this force replaces; `None` if no robot holds the block, or if the request names a point.
    pub robot: Option<RobotId>,
    /// The corners of the set, anticlockwise; one for a point, two for a segment, none for the empty set and if every
    /// force is carried. For a half-plane or a line, one force on its boundary; for a strip, one on each side.
    pub vertices: Vec<CapacityVertex>,
    /// The unit directions in which the set is unbounded, anticlockwise: at most two; three for a half-plane (along its
    /// edge, inward, and back along its edge), and four if every force is carried.
    pub rays: Vec<Vector>,
    /// The edges of the set, anticlockwise.
    pub edges: Vec<CapacityEdge>,
    /// A bound on the error, N: no force that the motions allow is farther than this from the set of proved forces.
    pub gap: f64,
    /// How the frame begins to fall whatever the force is. If each case carries some forces but no force is carried in
    /// all cases, this is the motion of one edge of one case. Empty unless the set is empty and a motion proves this.
    pub mechanism: Vec<Motion>,
    /// The number of extreme cases of the given ranges, in each load case and position of a vehicle. The structure carries
    /// each force of this result in all of these cases. It is 1 without ranges and conditions.
    pub cases: usize,
    /// The ranges in which the block carries the forces; empty if no range was given.
    pub ranges: Cases,
}

/// A corner of a [`LoadCapacity`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CapacityVertex {
    /// The force on the block, N.
    pub force: Vector,
    /// The torque on the block about the first point, N·m, if the force acts at two points; otherwise 0.
    pub torque: f64,
    /// The contact forces that balance the force of this vertex. Empty if several cases were intersected, because the
    /// contact forces differ between cases.
    pub contacts: Vec<VertexForce>,
    /// The proof by these forces; `None` if several cases were intersected.
    pub proof: Option<Proof>,
}

/// The forces at one interface, N, when the block carries the force of a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct VertexForce {
    /// The index of the interface among the interfaces of the frame.
    pub interface: usize,
    /// The normal forces at the two application points of the interface. Pressure is positive.
    pub normal: [f64; 2],
    /// The friction on the first body of the interface, positive along (−n_y, n_x), where n is the normal of the
    /// interface.
    pub friction: f64,
}

/// An edge of a [`LoadCapacity`]: every force F of the set has normal · F ≤ limit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CapacityEdge {
    /// The indices of the vertices at which the edge begins and ends, anticlockwise. `None` on a side where it is
    /// unbounded.
    pub ends: [Option<usize>; 2],
    /// The outward unit normal. Under a force just beyond the edge, the point where the force acts begins to move in
    /// this direction.
    pub normal: Vector,
    /// The limit of normal · F, N.
    pub limit: f64,
    /// How the blocks begin to move under a force just beyond the edge.
    pub mechanism: Vec<Motion>,
    /// The proof that the frame falls by this motion under such a force.
    pub proof: Proof,
    /// The index, from 0, of the case that this edge belongs to.
    pub case: usize,
    /// The condition in which the frame does not carry a farther force.
    pub condition: Condition,
}

/// The kind of set that a [`LoadCapacity`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CapacityShape {
    /// No force is carried.
    Empty,
    /// Only one force is carried.
    Point,
    /// The carried forces form a line segment.
    Segment,
    /// The carried forces form a bounded polygon.
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
            (_, 4..) => CapacityShape::Everything,
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

    /// Returns the magnitude of the smallest carried force, N; 0 if the frame stands without a force. `None` if no force
    /// is carried.
    pub fn least(&self) -> Option<f64> {
        if self.shape() == CapacityShape::Everything {
            return Some(0.0);
        }
        // The smallest force is no farther from a corner than twice the largest corner is from 0.
        let far = self.vertices.iter().map(|v| v.force.norm()).reduce(f64::max)?;
        Some(region::distance(&self.bounded_polygon(4.0 * far), Vector::zeros()))
    }

    /// True if the frame stands with this additional force, in newtons, on the block.
    pub fn contains(&self, force: impl Into<Vector>) -> bool {
        let force = force.into();
        let (planes, size) = self.half_planes(force.norm());
        let is_inside = |(normal, limit): &(Vector, f64)| normal.dot(&force) <= limit + 1e-9 * size;
        self.shape() != CapacityShape::Empty && planes.iter().all(is_inside)
    }

    /// Returns the magnitude of the largest force, N, that the block can carry in a unit direction. Infinite if it can
    /// carry forces of any magnitude in this direction. `None` if the set does not contain the force 0: the frame then
    /// falls without an additional force.
    pub fn reach(&self, direction: impl Into<Vector>) -> Option<f64> {
        let direction = direction.into();
        let (planes, size) = self.half_planes(f64::MIN_POSITIVE);
        let along = |(normal, limit): &(Vector, f64)| {
            let rate = normal.dot(&direction);
            (rate > region::SAME_DIRECTION).then(|| (limit / rate).max(0.0))
        };
        let reach = planes.iter().filter_map(along).fold(f64::INFINITY, f64::min);
        let far = 0.1 * region::RAY_LENGTH_PER_SIZE * size;
        self.contains(Vector::zeros()).then_some(if reach > far { f64::INFINITY } else { reach })
    }

    /// Returns the set as half-planes normal · F ≤ limit, and its size, N, which is at least `size`.
    fn half_planes(&self, size: f64) -> (Vec<(Vector, f64)>, f64) {
        let corners: Vec<Vector> = self.vertices.iter().map(|v| v.force).collect();
        let size = corners.iter().map(|f| f.norm()).fold(size, f64::max);
        (region::half_planes(&corners, &self.rays, region::RAY_LENGTH_PER_SIZE * size, 0.0), size)
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

    /// Returns the set as a bounded convex polygon, N: unbounded edges end at a distance of `far` from the corners.
    #[must_use]
    pub(crate) fn bounded_polygon(&self, far: f64) -> Vec<Vector> {
        let corners: Vec<Vector> = self.vertices.iter().map(|v| v.force).collect();
        region::bounded_polygon(&corners, &self.rays, far)
    }

    /// Returns the empty set for a block. `mechanism` is the motion by which the frame falls under every force.
    pub(super) fn empty(block: BlockId, at: Vec<Point>, mechanism: Vec<Motion>) -> LoadCapacity {
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
            ranges: Cases::default(),
        }
    }
}
