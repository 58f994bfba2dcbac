//! [`SolveReport`]: the method that decided a frame, the number of linear programs solved, and the time.

use super::Method;

/// How a frame was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveReport {
    /// The method that decided the hardest component: the greatest [`Method`] of all components.
    pub method: Method,
    /// Iterations of all programs together.
    pub iterations: usize,
    /// Programs solved for this frame; 0 if closed forms or earlier frames answered it.
    pub programs: usize,
    /// Components: blocks that cannot influence each other.
    pub groups: usize,
    /// Components answered by an earlier frame.
    pub reused: usize,
    /// Wall time in seconds.
    pub seconds: f64,
    /// The part of this time that each stage took.
    pub stages: Stages,
}

/// The wall time of each stage of a frame, in seconds. An effect that is not simulated adds no unknowns and takes no
/// time in any stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Stages {
    /// Assembling the frame: contacts, loads and grips from the contributions of all effects.
    pub assembly: f64,
    /// Solving and proving: verdict, forces, failures and mechanism.
    pub solution: f64,
    /// Checking whether the frame stands only by wedging.
    pub wedging: f64,
    /// Computing the margins.
    pub margins: f64,
}
