//! [`Marks`]: every arrow of a frame in numbers, in metres and newtons, before anything is drawn.

use crate::drawing::Colour;
use crate::geometry::{Point, Vector};
use crate::scene::{BodyId, RobotId};

/// What a straight arrow tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArrowKind {
    /// The weight of a block.
    Weight,
    /// A load on a block.
    Load,
    /// Normal and friction force together, from this body.
    Contact(BodyId),
    /// The normal force of an interface, from this body.
    Normal(BodyId),
    /// The friction force of an interface, from this body.
    Friction(BodyId),
    /// A robot's force.
    Robot(RobotId),
    /// Half of the vertical pair that stands for a robot's torque.
    RobotTorque(RobotId),
    /// A pull that would have to stick, from this body.
    MissingPull(BodyId),
    /// Friction that would have to stick, from this body.
    MissingFriction(BodyId),
    /// A force beyond a robot's limits.
    MissingRobotForce(RobotId),
    /// Half of the vertical pair that stands for a torque beyond a robot's limit.
    MissingTorque(RobotId),
}

impl ArrowKind {
    /// The body whose own arrow is the opposite of this one, `None` where there is none.
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

    /// Whether the arrow tells what would be needed rather than what is there.
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

/// A straight arrow in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceArrow {
    /// The body the force acts on.
    pub on: BodyId,
    /// Where it begins, metres.
    pub at: Point,
    /// Its shaft, metres.
    pub vector: Vector,
    /// The force it tells, N; for half of a torque's pair, the torque in N·m per metre of distance of the two halves.
    pub force: Vector,
    /// Its colour.
    pub colour: Colour,
    /// Width of its shaft, metres.
    pub width: f64,
    /// What it tells.
    pub kind: ArrowKind,
}

/// What a turning arrow tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnKind {
    /// The torque of a load.
    Load,
    /// A robot's torque.
    Robot(RobotId),
    /// A torque beyond a robot's limit.
    Missing(RobotId),
}

/// A turning arrow in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnArrow {
    /// The body the torque acts on.
    pub on: BodyId,
    /// Its centre, metres.
    pub at: Point,
    /// The torque, N·m, anticlockwise positive.
    pub torque: f64,
    /// Length of its shaft along the circle, metres, with the torque's sign.
    pub arc: f64,
    /// Its colour.
    pub colour: Colour,
    /// Width of its shaft, metres.
    pub width: f64,
    /// What it tells.
    pub kind: TurnKind,
}

/// Every arrow of a frame in drawing order: block by block, robots, and at last what fails.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// The straight ones.
    pub arrows: Vec<ForceArrow>,
    /// The turning ones.
    pub turns: Vec<TurnArrow>,
    /// The amount that is one unit edge long, N; 0 where there is no force.
    pub newtons_per_unit: f64,
}
