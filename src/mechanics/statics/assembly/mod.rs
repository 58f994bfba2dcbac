//! [`Assembly`]: one frame of a scene as free bodies, contacts and grips, in metres and newtons.
//!
//! An assembly has bodies with load vectors, contacts with application points, and grips with limits. It does not
//! contain files, steps or materials. The effects of [`crate::mechanics::statics::effect`] build it. [`Assembly::components`] splits it
//! into components that cannot influence each other. The `with_…` functions return changed assemblies, from which
//! margins are computed.
//!
//! Invariant: body, contact and grip numbers are indices into the assembly's own lists. The first body of a contact is
//! never the ground. Each load vector is the sum of weight and listed loads ([`Assembly::with_summed_loads`]).

mod part;

use std::sync::Arc;

pub(crate) use part::DisjointSets;
pub use part::Substructure;

use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::scene::{BlockId, BodyId, Frame, Limits, RobotId, Scene};
use crate::mechanics::statics::interface::{ContactKind, Interface, application_points};

/// One frame of a scene, or a component of it, as a system of rigid bodies.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The free bodies, in the order of their blocks.
    pub bodies: Vec<AssemblyBody>,
    /// The contacts between bodies, and between bodies and the ground, in the order of the frame's interfaces.
    pub contacts: Vec<AssemblyContact>,
    /// The grips of robots on bodies, in the order of the frame's holds.
    pub grips: Vec<AssemblyGrip>,
    /// The gravity vector, in newtons per newton of weight: a unit vector in the direction of gravity, unless a margin
    /// varies it. Zero if weight is not simulated.
    pub pull: Vector,
    /// The factor on the listed loads: 1, unless a margin varies it.
    pub load_factor: f64,
    /// The characteristic length L in metres: the median length of the edge interfaces, if there are any. When torques
    /// and forces are compared, a torque M counts as a force M/L.
    pub length: f64,
}

/// The safety kernel that keeps forces within the middle third of each joint.
pub const MIDDLE_THIRD: f64 = 2.0 / 3.0;

/// A load on a body: a force at the body's centroid, and a moment about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadVector {
    /// Force, N.
    pub force: Vector,
    /// Moment, N·m, anticlockwise positive.
    pub moment: f64,
}

impl LoadVector {
    /// No load.
    pub const ZERO: LoadVector = LoadVector { force: Vector::new(0.0, 0.0), moment: 0.0 };

    /// Returns the sum of two load vectors about the same centroid.
    pub fn plus(self, other: LoadVector) -> LoadVector {
        LoadVector { force: self.force + other.force, moment: self.moment + other.moment }
    }

    /// Returns the load vector multiplied by a factor.
    pub fn times(self, factor: f64) -> LoadVector {
        LoadVector { force: self.force * factor, moment: self.moment * factor }
    }

    /// Returns the size of the load in newtons: the magnitude of the force, or the absolute moment divided by `length`
    /// (metres) if that is larger.
    pub fn size(&self, length: f64) -> f64 {
        self.force.norm().max(self.moment.abs() / length)
    }
}

/// A free rigid body.
#[derive(Clone, Debug)]
pub struct AssemblyBody {
    /// The block of the scene.
    pub block: BlockId,
    /// Centroid, metres; moments of the body are taken about it.
    pub centroid: Point,
    /// Corners of the outline, metres.
    pub corners: Arc<[Point]>,
    /// Weight, N; 0 if weight is not simulated.
    pub weight: f64,
    /// The sum of the loads that the scene lists for the block, without the load factor.
    pub listed: LoadVector,
    /// The sum of the listed loads that the load factor does not multiply.
    pub fixed: LoadVector,
    /// The total load, without the forces of contacts and robots: [`Assembly::pull`] · weight + fixed loads + load
    /// factor · listed loads.
    pub load: LoadVector,
}

impl AssemblyBody {
    /// Returns the sum of all loads that the scene lists for the block, with the load factor.
    pub fn given(&self, load_factor: f64) -> LoadVector {
        self.fixed.plus(self.listed.times(load_factor))
    }

    /// Returns the largest distance of a corner from the centroid, in metres.
    pub fn radius(&self) -> f64 {
        let reach = self.corners.iter().map(|p| (p - self.centroid).norm());
        reach.fold(0.0, f64::max)
    }
}

/// A contact between two bodies, or between a body and the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyContact {
    /// The index of the interface among the frame's interfaces.
    pub interface: usize,
    /// The two bodies of the scene. The first is the body with the index `on`.
    pub bodies: [BodyId; 2],
    /// The index of the body on which the contact force acts with positive sign. The other body receives the opposite
    /// force.
    pub on: usize,
    /// The index of the other body; `None` for the ground.
    pub from: Option<usize>,
    /// Edge or corner.
    pub kind: ContactKind,
    /// Ends of the contact segment, metres. The tangent (−n_y, n_x) points from the first to the second. Equal for a
    /// corner.
    pub ends: [Point; 2],
    /// The application points of the normal forces, metres: the ends, moved inward by the safety kernel.
    pub points: [Point; 2],
    /// Unit normal of the contact, which points into the body `on`.
    pub normal: Vector,
    /// Friction coefficient; 0 if friction is not simulated.
    pub friction: f64,
    /// Whether a factor on the friction multiplies this coefficient.
    pub is_factored: bool,
}

impl AssemblyContact {
    /// Returns the unit tangent (−n_y, n_x). Friction on the first body is positive in this direction.
    pub fn tangent(&self) -> Vector {
        quarter_turn(self.normal)
    }

    /// Returns the number of application points at which forces act: 2 for an edge, 1 for a corner.
    pub fn points_in_use(&self) -> usize {
        match self.kind {
            ContactKind::Edge => 2,
            ContactKind::Corner => 1,
        }
    }
}

/// The grip of a robot on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyGrip {
    /// The index of the hold among the frame's holds.
    pub hold: usize,
    /// The robot.
    pub robot: RobotId,
    /// The index of the held body.
    pub body: usize,
    /// The grip point, metres.
    pub at: Point,
    /// The largest force components and torque; 0 for a component that is not simulated.
    pub limits: Limits,
}

impl Assembly {
    /// Creates the assembly of a frame with its placed blocks as bodies, but without loads, contacts and grips. The
    /// effects add these afterwards.
    pub fn without_effects(scene: &Scene, frame: &Frame, interfaces: &[&Interface]) -> Assembly {
        let mut placed = frame.placed.clone();
        placed.sort();
        let bodies = placed.into_iter().map(|block| {
            let given = &scene.blocks[block.0];
            AssemblyBody {
                block,
                centroid: given.centroid,
                corners: given.body.polygon.outline().into(),
                weight: 0.0,
                listed: LoadVector::ZERO,
                fixed: LoadVector::ZERO,
                load: LoadVector::ZERO,
            }
        });
        Assembly {
            bodies: bodies.collect(),
            contacts: Vec::new(),
            grips: Vec::new(),
            pull: Vector::zeros(),
            load_factor: 1.0,
            length: characteristic_length(scene, frame, interfaces),
        }
    }

    /// Returns a list with one entry for each block of the scene: the index of its body, or `None` if the block has no
    /// body in this assembly. `blocks` is the number of blocks of the scene.
    pub fn body_of_block(&self, blocks: usize) -> Vec<Option<usize>> {
        let mut body_of_block = vec![None; blocks];
        for (number, body) in self.bodies.iter().enumerate() {
            body_of_block[body.block.0] = Some(number);
        }
        body_of_block
    }

    /// Recomputes the load vector of each body from gravity and from the body's weight and listed loads.
    pub fn with_summed_loads(mut self) -> Assembly {
        for body in &mut self.bodies {
            let weight = LoadVector { force: self.pull * body.weight, moment: 0.0 };
            body.load = weight.plus(body.given(self.load_factor));
        }
        self
    }

    /// Returns the load of the most heavily loaded body, in newtons. The load of a body is the largest of three
    /// numbers: its force, its moment divided by L, and its weight under the current gravity.
    pub fn heaviest_load(&self) -> f64 {
        let pull = self.pull.norm();
        self.bodies.iter().map(|body| body.load.size(self.length).max(body.weight * pull)).fold(0.0, f64::max)
    }
}

/// Returns the load vector about `centroid` that is equivalent to a force at the point `at` and a torque. The units are
/// metres, newtons and N·m.
pub fn load_about(centroid: Point, at: Point, force: Vector, torque: f64) -> LoadVector {
    LoadVector { force, moment: cross(at - centroid, force) + torque }
}

/// Returns the characteristic length L of a frame in metres: the median length of its edge interfaces.
///
/// If there are no edge interfaces, L is the median square root of the placed blocks' areas. L depends only on the
/// placed blocks, so the result of a step does not change with later steps.
fn characteristic_length(scene: &Scene, frame: &Frame, interfaces: &[&Interface]) -> f64 {
    let edges = interfaces.iter().filter(|i| i.kind == ContactKind::Edge);
    let area = |b: &BlockId| scene.blocks[b.0].body.polygon.area();
    median(edges.map(|i| i.length()).collect())
        .or_else(|| median(frame.placed.iter().map(|b| area(b).sqrt()).collect()))
        .unwrap_or(1.0)
}

/// Returns the lower median of a list; `None` for an empty list.
fn median(mut list: Vec<f64>) -> Option<f64> {
    list.sort_by(f64::total_cmp);
    list.get(list.len().saturating_sub(1) / 2).copied()
}

/// Changes of one quantity, such as friction, for the computation of margins. The bodies stay in their positions.
impl Assembly {
    /// Sets the friction coefficient of every contact to `mu`.
    pub fn with_friction(mut self, mu: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.friction = mu;
        }
        self
    }

    /// Multiplies the friction coefficient of every contact that has a factor by `factor`.
    pub fn with_friction_factor(mut self, factor: f64) -> Assembly {
        for contact in self.contacts.iter_mut().filter(|contact| contact.is_factored) {
            contact.friction *= factor;
        }
        self
    }

    /// Moves the application points inward by `kernel`/2 of each interface's length, measured from the interface's
    /// ends.
    pub fn with_kernel(mut self, kernel: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.points = application_points(contact.ends, kernel);
        }
        self
    }

    /// Locks all joints against sliding. Each joint becomes smooth and gets two smooth contacts at its middle, whose normals are
    /// its tangent and the opposite direction. They carry a tangential force of any size and allow no slip. The joint can still
    /// open.
    pub fn without_sliding(mut self) -> Assembly {
        // Each contact needs a number of its own.
        let first = self.contacts.iter().map(|contact| contact.interface + 1).max().unwrap_or(0);
        let locks = self.contacts.iter().enumerate().flat_map(|(number, contact)| {
            let middle = contact.ends[0] + (contact.ends[1] - contact.ends[0]) / 2.0;
            let at = [middle; 2];
            let lock = |side, normal| AssemblyContact {
                interface: first + 2 * number + side,
                kind: ContactKind::Corner,
                ends: at,
                points: at,
                normal,
                friction: 0.0,
                is_factored: false,
                ..*contact
            };
            [lock(0, contact.tangent()), lock(1, -contact.tangent())]
        });
        let locks: Vec<AssemblyContact> = locks.collect();
        self = self.with_friction(0.0);
        self.contacts.extend(locks);
        self
    }

    /// Locks all bodies against turning. Each body gets a grip that carries a torque of any size, but no force.
    pub fn without_turning(mut self) -> Assembly {
        let limits = Limits { fx: 0.0, fy: 0.0, torque: f64::INFINITY };
        let first = self.grips.iter().map(|grip| grip.hold + 1).max().unwrap_or(0);
        let bodies = self.bodies.iter().enumerate();
        let locks = bodies.map(|(body, own)| AssemblyGrip {
            hold: first + body,
            robot: RobotId(first + body),
            body,
            at: own.centroid,
            limits,
        });
        let locks: Vec<AssemblyGrip> = locks.collect();
        self.grips.extend(locks);
        self
    }

    /// Moves the application points of each joint to the ends of its middle third, unless the safety kernel has moved them
    /// farther inward.
    pub fn with_middle_third(mut self) -> Assembly {
        for contact in &mut self.contacts {
            let third = application_points(contact.ends, MIDDLE_THIRD);
            let width = |points: [Point; 2]| (points[1] - points[0]).norm();
            if width(third) < width(contact.points) {
                contact.points = third;
            }
        }
        self
    }

    /// Sets the gravity vector `pull`, in newtons per newton of weight, and recomputes the loads.
    pub fn with_gravity(mut self, pull: Vector) -> Assembly {
        self.pull = pull;
        self.with_summed_loads()
    }

    /// Sets the factor by which the listed loads are multiplied, and recomputes the loads.
    pub fn with_load_factor(mut self, factor: f64) -> Assembly {
        self.load_factor = factor;
        self.with_summed_loads()
    }

    /// Sets the limits of the grip with this index.
    pub fn with_limits(mut self, grip: usize, limits: Limits) -> Assembly {
        self.grips[grip].limits = limits;
        self
    }
}
