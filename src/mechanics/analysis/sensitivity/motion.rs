//! [`State`]: the forces and the mechanism of a component at an end of an interval, where it begins to fall.

use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::proof::ContactForces;

/// The rigid motion of a body: the velocity at `origin`, and the angular velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct RigidMotion {
    pub origin: Point,
    pub velocity: Vector,
    pub spin: f64,
}

impl RigidMotion {
    /// No motion.
    pub const REST: RigidMotion =
        RigidMotion { origin: Point::new(0.0, 0.0), velocity: Vector::new(0.0, 0.0), spin: 0.0 };

    /// Returns the velocity of a point that moves with the body.
    pub fn at(&self, point: Point) -> Vector {
        self.velocity + quarter_turn(point - self.origin) * self.spin
    }
}

/// Forces and a mechanism at the end of an interval.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// The motion of each body.
    pub motions: Vec<RigidMotion>,
    /// The forces of each contact in newtons; 0 for contacts inside a group of bodies that move as one rigid body.
    pub forces: Vec<ContactForces>,
    /// The force of each grip in newtons; 0 for robots that hold their body at rest.
    pub grips: Vec<Vector>,
    /// The derivative, with respect to the parameter, of the power of all forces along the motions.
    pub work: f64,
}

impl State {
    /// Returns the change of the power of a force on a body, per metre that the point of the force moves along x and
    /// along y. If the point moves by d, the power changes by spin · (d × force).
    pub fn power_per_shift(&self, body: usize, force: Vector) -> Vector {
        -quarter_turn(force) * self.motions[body].spin
    }
}
