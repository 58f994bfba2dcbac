//! [`SolveReport`]: the methods, programs and times that the solution of a frame took.

use super::Method;

/// How a frame was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveReport {
    /// How the component that was hardest to decide was decided.
    pub method: Method,
    /// Iterations of all programs together.
    pub iterations: usize,
    /// Programs solved for this frame; 0 where closed forms or earlier frames answered it.
    pub programs: usize,
    /// Components: blocks that cannot influence each other.
    pub groups: usize,
    /// Components answered by an earlier frame.
    pub reused: usize,
    /// Wall time in seconds.
    pub seconds: f64,
    /// What that time was spent on.
    pub stages: Stages,
}

/// Where the wall time of a frame went, seconds. An effect that is left out brings no unknowns, so it costs nothing in any
/// of these.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Stages {
    /// Posing the frame: contacts, loads and grips from what each effect contributes.
    pub assembly: f64,
    /// Solving and proving: the verdict, the forces, what fails and the motion.
    pub solution: f64,
    /// Whether it stands by wedging only.
    pub wedging: f64,
    /// The margins.
    pub margins: f64,
}
