//! [`Marks`]: every arrow of a frame in numbers, in metres and newtons, before anything is drawn.
//!
//! From tail to tip an arrow is proportional to its force. One too short to be seen is not drawn, and counted.

use super::words::{counted, listed, quantity};
use crate::drawing::Colour;
use crate::drawing::arrow::{HEAD_LENGTH, head_size};
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

/// An arrow shorter than this from tail to tip, pixels, is not seen.
pub(crate) const LEAST_SEEN: f64 = 2.0;

/// Where an arrow's head lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Head {
    /// Within the vector: from tail to tip the arrow tells its force.
    Within,
    /// Beyond the vector, as in the source's printed figures: the shaft alone tells the force.
    Beyond,
}

/// A straight arrow in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceArrow {
    /// The body the force acts on.
    pub on: BodyId,
    /// Where it begins, metres.
    pub at: Point,
    /// As long as its force asks for, metres: from tail to tip, or its shaft alone where its head lies beyond.
    pub vector: Vector,
    /// The force it tells, N; for half of a torque's pair, the torque in N·m per metre of distance of the two halves.
    pub force: Vector,
    /// Its colour.
    pub colour: Colour,
    /// Width of its shaft, metres.
    pub width: f64,
    /// Where its head lies.
    pub head: Head,
    /// What it tells.
    pub kind: ArrowKind,
}

impl ForceArrow {
    /// From its tail to the tip of its head, metres.
    pub fn reach(&self) -> Vector {
        let length = self.vector.norm();
        match self.head {
            Head::Beyond if length > 0.0 => self.vector * (1.0 + HEAD_LENGTH * self.width / length),
            _ => self.vector,
        }
    }
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
    /// Its length along the circle from tail to tip, metres, with the torque's sign.
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

impl Marks {
    /// How many arrows are too short to be seen where a metre is so many pixels long, in words: `3 forces under 0.5 N
    /// not drawn`. `unit` is the unit edge in metres. `None` where all are seen.
    pub(crate) fn unseen(&self, unit: f64, scale: f64) -> Option<String> {
        let least = LEAST_SEEN / scale;
        let short = |arrow: &&ForceArrow| arrow.reach().norm() < least;
        let forces = self.arrows.iter().filter(short).count();
        // That of a load is drawn with a least length.
        let torques = self.turns.iter().filter(|t| t.kind != TurnKind::Load);
        let torques = torques.filter(|t| t.arc.abs() < least).count();
        // A length is so many newtons for a force, and as many newton metres for a torque on an arm of one metre.
        let amount = round_above(least / unit * self.newtons_per_unit);
        let parts = [("force", forces, "N"), ("torque", torques, "N·m")];
        let parts = parts.into_iter().filter(|part| part.1 > 0);
        let parts = parts.map(|(what, count, of)| {
            format!("{} under {}", counted(count, what), quantity(amount, of))
        });
        let parts: Vec<String> = parts.collect();
        (!parts.is_empty()).then(|| format!("{} not drawn", listed(&parts)))
    }

    /// The largest force of an arrow, N, and at least the force that is one unit edge long.
    pub(crate) fn largest(&self) -> f64 {
        let forces = self.arrows.iter().map(|arrow| arrow.force.norm());
        forces.fold(self.newtons_per_unit, f64::max)
    }
}

/// The next number of one digit that is not below this one.
pub(crate) fn round_above(amount: f64) -> f64 {
    if !(amount > 0.0 && amount.is_finite()) {
        return amount;
    }
    let power = libm::pow(10.0, libm::floor(libm::log10(amount)));
    let digit = (amount / power * (1.0 - 1e-12)).ceil();
    digit * power
}

/// How far a point is from an arrow's ink, metres; below 0 inside it.
pub(crate) fn from_arrow(arrow: &ForceArrow, p: Point) -> f64 {
    let reach = arrow.reach();
    let length = reach.norm();
    if length <= 0.0 {
        return f64::INFINITY;
    }
    let (long, wide) = head_size(length, arrow.width);
    let tip = arrow.at + reach;
    let neck = tip - reach * (long / length);
    let shaft = from_segment(arrow.at, neck, p) - arrow.width / 2.0;
    // The head is a wedge; two thirds of half its width around its axis cover it.
    let head = from_segment(neck, tip, p) - wide / 3.0;
    shaft.min(head)
}

fn from_segment(a: Point, b: Point, p: Point) -> f64 {
    let along = b - a;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        ((p - a).dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - (a + along * share)).norm()
}
