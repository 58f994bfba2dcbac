//! [`SessionError`]: why a session refused a step, such as placing a block.

use crate::mechanics::scene::SceneError;
use crate::text::line;

/// Why a session could not start, or why it refused a step. A refused step does not change the session.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The scene or the block is not valid.
    #[error("{0}")]
    SceneError(#[from] SceneError),
    /// The scene file has steps.
    #[error("the scene has steps; remove them, because a session makes its own steps")]
    Steps,
    /// A block with this id is placed already.
    #[error("there is already a block {}; use another id, or none", line(.0))]
    Twice(String),
    /// No block with this id is placed.
    #[error("there is no block {}", line(.0))]
    NoBlock(String),
    /// The scene has no robot with this id.
    #[error("there is no robot {}", line(.0))]
    NoRobot(String),
    /// The block to remove is held by a robot.
    #[error("block {} is held by robot {}; release it first", line(.0), line(.1))]
    Held(String, String),
    /// The robot holds another block.
    #[error("robot {} holds block {}; release it first", line(.0), line(.1))]
    HoldsAnother(String, String),
    /// The robot to release holds nothing.
    #[error("robot {} holds nothing", line(.0))]
    HoldsNothing(String),
    /// The coordinates of a grip point are not valid.
    #[error("the grip point ({0}, {1}) is not valid; coordinates must be numbers of at most 1e12")]
    NoPlace(f64, f64),
}
