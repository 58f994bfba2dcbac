//! [`SessionError`]: why a step was not taken, in words.

use crate::scene::SceneError;
use crate::text::line;

/// Why a session did not take a step; everything is as it was before.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The scene, or the block, is wrong.
    #[error("{0}")]
    SceneError(#[from] SceneError),
    /// The scene has steps.
    #[error("the scene has steps; a session takes its own, so leave them out")]
    Steps,
    /// A block of this name stands already.
    #[error("there is a block {} already; give another id, or none", line(.0))]
    Twice(String),
    /// No block of this name stands.
    #[error("there is no block {}", line(.0))]
    NoBlock(String),
    /// The scene has no such robot.
    #[error("there is no robot {}", line(.0))]
    NoRobot(String),
    /// A block that is to be removed is held.
    #[error("block {} is held by robot {}; release it first", line(.0), line(.1))]
    Held(String, String),
    /// A robot holds another block.
    #[error("robot {} holds block {}; release it first", line(.0), line(.1))]
    HoldsAnother(String, String),
    /// A robot that is to let go holds nothing.
    #[error("robot {} holds nothing", line(.0))]
    HoldsNothing(String),
    /// A grip point is no point.
    #[error("a grip point of ({0}, {1}); coordinates are numbers of at most 1e12")]
    NoPlace(f64, f64),
}
