//! [`SolveReport`]: the method that decided a frame, the number of linear programs solved, and the time.

use super::Method;

/// How a frame was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveReport {
    /// The method that decided the hardest component: the greatest [`Method`] of all components.
    pub method: Method,
    /// The total number of solver iterations of the programs that `programs` counts.
    pub iterations: usize,
    /// The number of linear programs solved for the verdict and forces of this frame; 0 if closed forms or results of
    /// earlier frames decided every component.
    pub programs: usize,
    /// The number of components. Blocks in different components cannot influence each other.
    pub groups: usize,
    /// The number of components whose results come from an earlier frame.
    pub reused: usize,
    /// The wall time for the whole frame, in seconds.
    pub seconds: f64,
    /// The wall time of each stage.
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
