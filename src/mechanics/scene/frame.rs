//! [`Frame`]: the state of the structure after one step: the placed blocks, and the blocks that robots hold or plan to
//! place.

use super::format::Expectation;
use super::{BlockId, RobotId};
use crate::geometry::Point;

/// A robot that holds a block in a frame, and the grip point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hold {
    /// The robot.
    pub robot: RobotId,
    /// The block held.
    pub block: BlockId,
    /// The grip point, metres.
    pub at: Point,
}

/// A block that a robot is about to place. It is drawn as an outline and carries no force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Plan {
    /// The robot.
    pub robot: RobotId,
    /// The block, not yet placed.
    pub block: BlockId,
}

/// The state of the structure after one step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Frame {
    /// The step's title; empty if it has none.
    pub title: String,
    /// The placed blocks, in the order of placing. The k-th block is drawn in colour k of the sequence.
    pub placed: Vec<BlockId>,
    /// The blocks that robots hold, in the order of the robots' numbers.
    pub holds: Vec<Hold>,
    /// The planned blocks, in the order of the robots' numbers.
    pub plans: Vec<Plan>,
    /// The verdict that the author of the scene expects for this frame; `None` if the file gives none.
    pub expected: Option<Expectation>,
}
