//! [`SolverSettings`]: the tolerance, stopping rule, conditioning and choice of optimum of a solver. [`DeadlineGuard`]: a
//! time limit for all optimisation programs that a thread solves.

use std::cell::Cell;

use crate::clock::Instant;

/// The default tolerance of feasibility and duality gap, relative to the data of the program.
///
/// It is the largest tolerance with which every frame measured in [`doc::accuracy`](crate::doc::accuracy) is decided.
pub const TOLERANCE: f64 = 1e-9;

/// A residual up to this fraction of the forces of which it is the difference counts as rounding: some fifty times the
/// rounding of one force, because a block has many.
pub(super) const ROUNDING_TOL: f64 = 1e-14;

/// The largest number of iterations for one program.
pub const MAX_ITERATIONS: usize = 100;

/// The settings of a solver: tolerance, stopping rule, conditioning, and the choice among several optima.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// The tolerance of feasibility and duality gap.
    pub tolerance: f64,
    /// The largest number of iterations for one program.
    pub iterations: usize,
    /// A different stopping rule for the solver on the normal equations. With `None` it stops at the tolerance, as
    /// clarabel always does.
    pub crossover: Option<CrossoverTolerance>,
    /// How the linear systems are conditioned.
    pub conditioning: Conditioning,
    /// Which balance to return if several balances have the same cost.
    pub choice: Choice,
}

/// The stopping rule of the solver on the normal equations if basic columns must be distinguished from all others.
///
/// If the optimum is strictly complementary, two to eleven iterations beyond the tolerance bring the slack of basic
/// columns close to 0. If the optimum is not strictly complementary, as in walls near their limit, more iterations do
/// not help. The method then stops early, which saves about ten iterations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossoverTolerance {
    /// The method aims at this fraction of the tolerance. If it cannot reach this fraction, the tolerance itself is
    /// sufficient.
    pub tolerance_factor: f64,
    /// Basic columns are distinguished well enough if the sum of their slacks, relative to the cost, is at most this.
    pub max_slack: f64,
    /// If the sum of slacks is expected to end above `max_slack`, the method stops at this multiple of the tolerance.
    pub early_factor: f64,
}

/// When an interior-point method stops.
#[derive(Clone, Copy, Debug)]
pub(super) struct StoppingCriteria {
    /// The tolerance of feasibility and duality gap.
    pub tolerance: f64,
    /// A finer tolerance to aim at. If it is not reached, `tolerance` is sufficient.
    pub crossover: Option<CrossoverTolerance>,
    /// The largest number of iterations.
    pub iterations: usize,
    /// The time after which the method stops, with a result only if `tolerance` is already reached. `None` if there is
    /// no time limit.
    pub deadline: Option<Instant>,
}

/// Which of several balances of the same cost a solver returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Any balance of least cost: the one at which the interior-point method ends. This is sufficient for a verdict.
    Any,
    /// The balance of least Σ force², which does not depend on the order of the blocks in the file.
    Unique,
}

impl From<Conditioning> for SolverSettings {
    /// Returns settings with this conditioning, the default tolerance and number of iterations, no crossover and
    /// [`Choice::Unique`].
    fn from(conditioning: Conditioning) -> SolverSettings {
        let iterations = MAX_ITERATIONS;
        SolverSettings { tolerance: TOLERANCE, iterations, crossover: None, conditioning, choice: Choice::Unique }
    }
}

impl SolverSettings {
    /// Returns these settings and, if their conditioning is plain, the same with full conditioning.
    pub(super) fn with_retry(self) -> impl Iterator<Item = SolverSettings> {
        let full = SolverSettings { conditioning: Conditioning::Full, ..self };
        [self, full].into_iter().take(if self.conditioning == Conditioning::Plain { 2 } else { 1 })
    }
}

/// How the solver conditions its linear systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conditioning {
    /// No equilibration (scaling of rows and columns) and no iterative refinement. It takes two thirds of the time of
    /// `Full`. It is suitable for most programs, whose numbers are all near 1. It is safe, because a proof checks every
    /// answer.
    Plain,
    /// The defaults of the solver clarabel: equilibration and iterative refinement.
    Full,
}

thread_local! {
    /// The time after which solvers on this thread stop; `None` if there is no time limit.
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// While this guard exists, all solvers on this thread stop at the deadline that was given to [`DeadlineGuard::new`].
///
/// The deadline applies to all optimisation programs that a thread solves, one after another. It is a thread-local
/// value, so that it need not be an argument of every function that solves one of them.
#[derive(Debug)]
pub(crate) struct DeadlineGuard {
    former: Option<Instant>,
}

impl DeadlineGuard {
    /// Sets the deadline of this thread; `None` means no deadline. When the guard is dropped, the previous deadline
    /// applies again.
    pub(crate) fn new(deadline: Option<Instant>) -> DeadlineGuard {
        DeadlineGuard { former: DEADLINE.replace(deadline) }
    }
}

impl Drop for DeadlineGuard {
    fn drop(&mut self) {
        DEADLINE.set(self.former);
    }
}

/// Returns the deadline of this thread; `None` if it has no deadline.
pub(crate) fn deadline() -> Option<Instant> {
    DEADLINE.get()
}

/// True if the deadline of this thread has passed.
pub(crate) fn is_late() -> bool {
    deadline().is_some_and(|end| Instant::now() >= end)
}
