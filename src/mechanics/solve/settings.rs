//! [`SolverSettings`]: how precisely and in which way a program is solved.

use std::time::Instant;

/// The tolerance of feasibility and gap, relative to the data.
///
/// The loosest that decides every frame measured in [`doc::accuracy`](crate::doc::accuracy).
pub const TOLERANCE: f64 = 1e-9;

/// The largest number of iterations for one program.
pub const MAX_ITERATIONS: usize = 100;

/// How a program is solved: how precisely, with what conditioning, and whether unique forces are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// The tolerance of feasibility and gap.
    pub tolerance: f64,
    /// Where the normal equations end; `None`, like clarabel always, at the tolerance.
    pub crossover: Option<CrossoverTolerance>,
    /// How the linear systems are conditioned.
    pub conditioning: Conditioning,
    /// Which of several balances is wanted.
    pub choice: Choice,
}

/// When the normal equations stop, if the basic columns of the optimum are to be told from all others.
///
/// If the optimum is strictly complementary, two to eleven iterations beyond the tolerance leave basic columns next to no
/// slack. If it is not, as in walls near their limit, no number of iterations does; then the last ten are saved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossoverTolerance {
    /// The method stops at this fraction of the tolerance, if it gets there.
    pub tolerance_factor: f64,
    /// The basic columns are distinct if the sum of their slacks is at most this, relative to the cost.
    pub max_slack: f64,
    /// If more slack is expected at the end, the method stops at this multiple of the tolerance.
    pub early_factor: f64,
}

/// When an interior-point method stops.
#[derive(Clone, Copy, Debug)]
pub(super) struct StoppingCriteria {
    /// The tolerance of feasibility and gap.
    pub tolerance: f64,
    /// The finer tolerance to go on to. If it is out of reach, `tolerance` is enough.
    pub crossover: Option<CrossoverTolerance>,
    /// The largest number of iterations.
    pub iterations: usize,
    /// When to give up.
    pub deadline: Option<Instant>,
}

/// Which of several balances of the same cost is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Any: the one in which the interior-point method ends. Good enough for a verdict.
    Any,
    /// The one of least Σ force², which does not depend on the order of the file.
    Unique,
}

impl From<Conditioning> for SolverSettings {
    /// The default tolerance, and the unique balance.
    fn from(conditioning: Conditioning) -> SolverSettings {
        SolverSettings {
            tolerance: TOLERANCE,
            crossover: None,
            conditioning,
            choice: Choice::Unique,
        }
    }
}

/// How the solver conditions its linear systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conditioning {
    /// Neither equilibration nor iterative refinement: two thirds of the time. Good for most programs, whose pure numbers
    /// are all near 1, and safe because an answer is believed only with its proof.
    Plain,
    /// The solver's own defaults.
    Full,
}
