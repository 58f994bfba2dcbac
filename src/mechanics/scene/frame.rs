//! [`Frame`]: the placed blocks, and the blocks that robots hold, after one step.

use super::format::Expectation;
use super::{BlockId, RobotId};
use crate::geometry::Point;

/// A robot holding a block.
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

/// A block a robot is about to place: drawn as an outline, carries no force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Plan {
    /// The robot.
    pub robot: RobotId,
    /// The block, not yet placed.
    pub block: BlockId,
}

/// The state after one step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Frame {
    /// The step's title; empty if it has none.
    pub title: String,
    /// The placed blocks, in placing order: the k-th wears colour k of the sequence.
    pub placed: Vec<BlockId>,
    /// Who holds what, by robot number.
    pub holds: Vec<Hold>,
    /// Planned blocks, by robot number.
    pub plans: Vec<Plan>,
    /// The verdict that the author expects, if the file says so.
    pub expected: Option<Expectation>,
}
