//! [`Marks`]: the data of all arrows of a frame, in metres and newtons, before they are drawn.
//!
//! The length of an arrow is proportional to its force; [`Head`] states whether the head counts towards this length.
//! Arrows of forces too short to be visible are counted, but not drawn.

use crate::geometry::{Point, Vector};
use crate::mechanics::scene::{BodyId, RobotId};
use crate::pictures::drawing::Colour;
use crate::pictures::drawing::arrow::HEAD_LENGTH;

/// What a straight arrow shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArrowKind {
    /// The weight of a block.
    Weight,
    /// A load on a block.
    Load,
    /// The sum of normal and friction force, exerted by this body.
    Contact(BodyId),
    /// The normal force of an interface, exerted by this body.
    Normal(BodyId),
    /// The friction force of an interface, exerted by this body.
    Friction(BodyId),
    /// A robot's force.
    Robot(RobotId),
    /// One of the two vertical arrows that show the torque of a robot, in the style of the thesis.
    RobotTorque(RobotId),
    /// A missing pull from this body: adhesion that the structure would need.
    MissingPull(BodyId),
    /// Missing friction from this body.
    MissingFriction(BodyId),
    /// A missing force of a robot: the part of the needed force that exceeds the robot's limits.
    MissingRobotForce(RobotId),
    /// One of the two vertical arrows that show a torque beyond a robot's limit, in the style of the thesis.
    MissingTorque(RobotId),
}

impl ArrowKind {
    /// Returns the body that exerts the force: a block or the ground. Returns `None` for weights, loads, and forces and
    /// torques of robots.
    pub fn partner(self) -> Option<BodyId> {
        match self {
            ArrowKind::Contact(from)
            | ArrowKind::Normal(from)
            | ArrowKind::Friction(from)
            | ArrowKind::MissingPull(from)
            | ArrowKind::MissingFriction(from) => Some(from),
            _ => None,
        }
    }

    /// True if the arrow shows a missing force or torque.
    pub fn is_failure(self) -> bool {
        matches!(
            self,
            ArrowKind::MissingPull(_)
                | ArrowKind::MissingFriction(_)
                | ArrowKind::MissingRobotForce(_)
                | ArrowKind::MissingTorque(_)
        )
    }
}

/// Least length from tail to tip of an arrow that is visible, pixels. Shorter arrows are not drawn.
pub(crate) const MIN_VISIBLE_ARROW: f64 = 2.0;

/// The position of an arrow's head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Head {
    /// Within the vector: the length from tail to tip shows the force.
    Within,
    /// Beyond the vector, as in the figures of the thesis: the length of the shaft shows the force.
    Beyond,
}

/// A straight arrow in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceArrow {
    /// The body on which the force acts.
    pub on: BodyId,
    /// The tail of the arrow, metres.
    pub at: Point,
    /// The vector of the arrow at the scale of the frame, metres: from tail to tip, or only the shaft for
    /// [`Head::Beyond`].
    pub vector: Vector,
    /// The force that the arrow shows, N. For each of the two arrows of a torque, the torque in N·m, divided by the
    /// distance of the two arrows in metres.
    pub force: Vector,
    /// The colour of the arrow.
    pub colour: Colour,
    /// The width of the shaft, metres.
    pub width: f64,
    /// The position of the head.
    pub head: Head,
    /// The kind of force that the arrow shows.
    pub kind: ArrowKind,
}

impl ForceArrow {
    /// Returns the vector from the tail of the arrow to the tip of its head, metres.
    pub fn reach(&self) -> Vector {
        let length = self.vector.norm();
        match self.head {
            Head::Beyond if length > 0.0 => self.vector * (1.0 + HEAD_LENGTH * self.width / length),
            _ => self.vector,
        }
    }
}

/// What a torque arrow shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnKind {
    /// The torque of a load.
    Load,
    /// A robot's torque.
    Robot(RobotId),
    /// A torque beyond a robot's limit.
    Missing(RobotId),
}

/// An arrow along a circle that shows a torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnArrow {
    /// The body on which the torque acts.
    pub on: BodyId,
    /// The centre of the circle, metres.
    pub at: Point,
    /// The torque, N·m, anticlockwise positive.
    pub torque: f64,
    /// The colour of the arrow.
    pub colour: Colour,
    /// The width of the shaft, metres.
    pub width: f64,
    /// The kind of torque that the arrow shows.
    pub kind: TurnKind,
}

/// All arrows of a frame in drawing order: forces on the blocks, block by block, then forces of robots, then missing
/// forces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// The arrows of forces.
    pub arrows: Vec<ForceArrow>,
    /// The arrows of torques.
    pub turns: Vec<TurnArrow>,
    /// The force whose arrow is one unit length long, N; 0 if there are no forces. The unit length is a typical size of
    /// the blocks.
    pub newtons_per_unit: f64,
}

impl Marks {}

/// Returns the smallest number with one significant digit that is at least `amount`. Returns `amount` itself if it is
/// not positive and finite.
pub(crate) fn round_above(amount: f64) -> f64 {
    if !(amount > 0.0 && amount.is_finite()) {
        return amount;
    }
    let power = libm::pow(10.0, libm::floor(libm::log10(amount)));
    let digit = (amount / power * (1.0 - 1e-12)).ceil();
    digit * power
}
