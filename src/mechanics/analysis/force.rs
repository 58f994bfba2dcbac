//! The forces at the interfaces and robots of a frame, and the missing forces of a frame that falls.

use crate::geometry::{Point, Vector};
use crate::mechanics::scene::{BlockId, BodyId, RobotId};
use crate::mechanics::statics::interface::{ContactKind, Interface};
use crate::mechanics::statics::resultant::Resultant;

/// An interface and the admissible forces that it transmits.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Contact {
    /// Where the two bodies touch. All forces act on `interface.bodies[0]`.
    pub interface: Interface,
    /// The two application points, metres.
    pub application_points: [Point; 2],
    /// The normal forces N1 and N2 at these points, N; at least 0.
    pub normal_forces: [f64; 2],
    /// The friction force T, N; positive along (−n_y, n_x), where n is the interface's normal.
    pub friction_force: f64,
    /// The resultant of these forces.
    pub resultant: Resultant,
    /// The used fraction of the available friction, |T| / (μ (N1 + N2)); 0 if no friction is available.
    pub friction_used: f64,
}

impl Contact {
    /// Returns the distance of the resultant from the middle of an edge interface, in metres, positive along its tangent. `None`
    /// for a corner, or without a normal force.
    pub fn eccentricity(&self) -> Option<f64> {
        let is_edge = self.interface.kind == ContactKind::Edge && self.interface.length() > 0.0;
        let off = || (self.resultant.at - self.interface.middle()).dot(&self.interface.tangent());
        (is_edge && self.normal_forces.iter().sum::<f64>() > 0.0).then(off)
    }

    /// Returns whether the resultant lies in the middle third of an edge interface.
    pub fn is_in_middle_third(&self) -> Option<bool> {
        Some(self.eccentricity()?.abs() <= self.interface.length() / 6.0 * (1.0 + MIDDLE_THIRD_TOL))
    }

    /// Returns the pressure at the two ends of an edge interface, N/m². The pressure varies linearly and has the resultant of
    /// the normal forces. There is no tension: if the resultant is outside the middle third, only a part of the interface
    /// presses. `thickness` is the thickness of the structure in metres. `None` for a corner, without a normal force, and if
    /// the resultant is at an end of the interface.
    pub fn pressure(&self, thickness: f64) -> Option<[f64; 2]> {
        let (off, length) = (self.eccentricity()?, self.interface.length());
        let mean = self.normal_forces.iter().sum::<f64>() / (length * thickness);
        let pressing = 3.0 * (length / 2.0 - off.abs());
        let [near, far] = match self.is_in_middle_third()? {
            true => [6.0, -6.0].map(|times| mean * (1.0 + times * off.abs() / length).max(0.0)),
            false => [2.0 * mean * length / pressing, 0.0],
        };
        let [first, second] = self.interface.ends;
        let is_first = (self.resultant.at - self.interface.middle()).dot(&(second - first)) < 0.0;
        (near.is_finite() && pressing > 0.0).then_some(if is_first { [near, far] } else { [far, near] })
    }
}

/// A resultant that is outside the middle third by at most this fraction of a third counts as inside.
const MIDDLE_THIRD_TOL: f64 = 1e-9;

/// The force and the torque of a robot on the block that it holds.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct RobotForce {
    /// The robot.
    pub robot: RobotId,
    /// The block that the robot holds.
    pub block: BlockId,
    /// The grip point, metres.
    pub at: Point,
    /// Force on the block, N.
    pub force: Vector,
    /// Torque on the block, N·m.
    pub torque: f64,
    /// The largest used fraction of the limits for force x, force y and torque; 0 if all are infinite or 0.
    pub limit_used: f64,
}

/// A missing force: adhesion at a joint, or a force or torque of a robot beyond its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Failure {
    /// Tension across an interface, at one of its application points.
    Tension {
        /// The two bodies; `force` acts on the first.
        bodies: [BodyId; 2],
        /// The application point, metres.
        at: Point,
        /// The tensile force on `bodies[0]`, N.
        force: Vector,
    },
    /// Friction beyond the limit μN, drawn at the middle of the interface.
    Friction {
        /// The two bodies; `force` acts on the first.
        bodies: [BodyId; 2],
        /// The middle of the interface, metres.
        at: Point,
        /// The missing friction force on `bodies[0]`, N.
        force: Vector,
    },
    /// A robot force beyond the robot's limits.
    RobotForce {
        /// The robot.
        robot: RobotId,
        /// The block that the robot holds.
        block: BlockId,
        /// The grip point, metres.
        at: Point,
        /// The missing force on the block, N.
        force: Vector,
    },
    /// A robot torque beyond the robot's limit.
    RobotTorque {
        /// The robot.
        robot: RobotId,
        /// The block that the robot holds.
        block: BlockId,
        /// The grip point, metres.
        at: Point,
        /// The missing torque on the block, N·m.
        torque: f64,
    },
}

impl Failure {
    /// Returns the name of this kind of failure in JSON results.
    pub fn word(&self) -> &'static str {
        match self {
            Failure::Tension { .. } => "tension",
            Failure::Friction { .. } => "friction",
            Failure::RobotForce { .. } => "robot_force",
            Failure::RobotTorque { .. } => "robot_torque",
        }
    }

    /// Returns the magnitude of the missing force, N, or of the missing torque, N·m. For a robot force it is `|Fx| +
    /// |Fy|`.
    pub fn amount(&self) -> f64 {
        match *self {
            Failure::Tension { force, .. } | Failure::Friction { force, .. } => force.norm(),
            Failure::RobotForce { force, .. } => force.x.abs() + force.y.abs(),
            Failure::RobotTorque { torque, .. } => torque.abs(),
        }
    }

    /// Returns the point at which the missing force or torque would act, in metres.
    pub fn at(&self) -> Point {
        match *self {
            Failure::Tension { at, .. }
            | Failure::Friction { at, .. }
            | Failure::RobotForce { at, .. }
            | Failure::RobotTorque { at, .. } => at,
        }
    }

    /// Returns the missing force, N, on the first body of a joint or on the block that a robot holds. It is zero if a
    /// torque is missing.
    pub fn force(&self) -> Vector {
        match *self {
            Failure::Tension { force, .. } | Failure::Friction { force, .. } | Failure::RobotForce { force, .. } => {
                force
            }
            Failure::RobotTorque { .. } => Vector::zeros(),
        }
    }

    /// Returns the missing torque on the block that a robot holds, N·m. It is zero if a force is missing.
    pub fn torque(&self) -> f64 {
        match *self {
            Failure::RobotTorque { torque, .. } => torque,
            _ => 0.0,
        }
    }

    /// Returns the missing force (N) and torque (N·m) on a body. `None` if this failure does not concern the body.
    pub fn on(&self, body: BodyId) -> Option<(Vector, f64)> {
        let (first, second) = self.bodies();
        let on_second = (second == Some(body)).then_some(-1.0);
        let sign = if first == body { 1.0 } else { on_second? };
        Some((self.force() * sign, self.torque()))
    }

    /// Returns the two bodies of a joint, or only the block that a robot holds.
    pub(crate) fn bodies(&self) -> (BodyId, Option<BodyId>) {
        match *self {
            Failure::Tension { bodies: [first, second], .. } | Failure::Friction { bodies: [first, second], .. } => {
                (first, Some(second))
            }
            Failure::RobotForce { block, .. } | Failure::RobotTorque { block, .. } => (BodyId::Block(block), None),
        }
    }

    /// Returns the robot whose limit the missing force or torque exceeds. `None` for a failure at a joint.
    pub fn robot(&self) -> Option<RobotId> {
        match *self {
            Failure::RobotForce { robot, .. } | Failure::RobotTorque { robot, .. } => Some(robot),
            Failure::Tension { .. } | Failure::Friction { .. } => None,
        }
    }
}
