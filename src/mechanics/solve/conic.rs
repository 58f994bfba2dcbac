//! The one door to the solvers: a [`QuadraticProgram`] goes in, a status of our own and plain vectors come out.
//!
//! Linear programs of many blocks go to the normal equations first ([`super::normal`]), all others to clarabel, and so does
//! what ended there without a status: of chains at once, of others when it is tried again with full conditioning.
//!
//! Settings that are not the solver's own, and why: `qdldl` because the automatic choice takes faer on large programs,
//! 13.1 s against 4.6 s at 10⁴ blocks; tolerance 1e-9 because it is the loosest that decides every frame measured in [`doc::accuracy`](crate::doc::accuracy);
//! presolve off because nothing here has infinite bounds. NaN in the data comes back as "solved", so it is refused here.

use std::cell::Cell;
use std::time::Instant;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use super::normal::{self, Limits};
use crate::program::QuadraticProgram;

thread_local! {
    /// When this thread's programs are to be given up.
    static DEADLINE: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// Programs that this thread solves for as long as this lives are given up at a deadline.
///
/// A deadline belongs to a run, not to a program: so it is not handed down through everything that poses one.
#[derive(Debug)]
pub(crate) struct DeadlineGuard {
    before: Option<Instant>,
}

impl DeadlineGuard {
    /// From now on; `None` is no deadline.
    pub(crate) fn set(deadline: Option<Instant>) -> DeadlineGuard {
        DeadlineGuard {
            before: DEADLINE.replace(deadline),
        }
    }
}

impl Drop for DeadlineGuard {
    fn drop(&mut self) {
        DEADLINE.set(self.before);
    }
}

/// How a conic problem ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// x, s and z are an optimum.
    Solved,
    /// The rows contradict each other; z tells how.
    Infeasible,
    /// The objective has no bound; x is the direction along which it grows.
    Unbounded,
    /// The solver gave up.
    Unsolved,
}

/// What the solver gave back.
#[derive(Clone, Debug)]
pub struct Answer {
    /// How it ended.
    pub status: Status,
    /// The unknowns, or the certificate's direction.
    pub x: Vec<f64>,
    /// The rows' multipliers.
    pub z: Vec<f64>,
    /// The rows' slack b − Ax.
    pub s: Vec<f64>,
    /// Interior-point iterations.
    pub iterations: usize,
}

impl Answer {
    /// The answer of a solver that has none.
    pub(super) fn none(problem: &QuadraticProgram) -> Answer {
        Answer {
            status: Status::Unsolved,
            x: vec![0.0; problem.unknowns],
            z: vec![0.0; problem.bound.len()],
            s: vec![0.0; problem.bound.len()],
            iterations: 0,
        }
    }

    /// The same; without a status where some number is none.
    pub(super) fn if_finite(self) -> Answer {
        let sound = finite(&self.x) && finite(&self.z) && finite(&self.s);
        Answer {
            status: if sound { self.status } else { Status::Unsolved },
            ..self
        }
    }
}

/// The tolerance of feasibility and gap the solver is asked for.
pub const TOLERANCE: f64 = 1e-9;

/// The most iterations of one program.
pub const ITERATIONS: usize = 100;

/// How a program is solved: how precisely, with what conditioning, and whether the one picture is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// The tolerance of feasibility and gap the solver is asked for.
    pub tolerance: f64,
    /// Where the normal equations end; `None`, and with clarabel, at the tolerance.
    pub finer: Option<CrossoverTolerance>,
    /// How its linear systems are conditioned.
    pub conditioning: Conditioning,
    /// Which of several balances is wanted.
    pub choice: Choice,
}

/// Where the normal equations end that are to tell the columns of an optimum from all others.
///
/// Where these columns stand out, two to eleven iterations beyond the tolerance leave them next to no slack. Where they do not, as in
/// walls near their edge, no number of iterations does, and the last ten are saved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossoverTolerance {
    /// They end at this part of the tolerance, where they can.
    pub by: f64,
    /// The columns stand out where all that are in use have no more slack than this together, in parts of the cost.
    pub slack: f64,
    /// Where more slack is expected at that end, they end at so many times the tolerance.
    pub before: f64,
}

/// Which of several balances of the same cost is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Any: what the interior-point method ends in. Good enough for a verdict.
    Any,
    /// The one of least Σ force², which does not depend on the order of the file.
    Unique,
}

impl From<Conditioning> for SolverSettings {
    /// The default tolerance, and the unique balance.
    fn from(conditioning: Conditioning) -> SolverSettings {
        SolverSettings {
            tolerance: TOLERANCE,
            finer: None,
            conditioning,
            choice: Choice::Unique,
        }
    }
}

/// How the solver conditions its linear systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conditioning {
    /// Neither equilibration nor refinement of its linear systems: two thirds of the time. Good for the many programs
    /// whose pure numbers are all near 1, and safe because an answer is believed only with its proof.
    Plain,
    /// The solver's own defaults.
    Full,
}

/// Solves a conic problem.
///
/// # Panics
/// If the data hold a number that is not finite: scenes are checked at the door, so that is our own mistake.
pub fn solve(problem: &QuadraticProgram, tolerance: f64, conditioning: Conditioning) -> Answer {
    let settings = SolverSettings {
        tolerance,
        ..conditioning.into()
    };
    solve_within(problem, settings, ITERATIONS)
}

/// Solves a conic problem in a given number of iterations, or gives up.
///
/// # Panics
/// As [`solve`].
pub fn solve_within(
    problem: &QuadraticProgram,
    settings: SolverSettings,
    iterations: usize,
) -> Answer {
    let SolverSettings {
        tolerance,
        conditioning,
        finer,
        ..
    } = settings;
    let entries = problem
        .matrix
        .iter()
        .chain(&problem.quadratic)
        .all(|e| e.2.is_finite());
    assert!(
        finite(&problem.linear) && finite(&problem.bound) && entries,
        "a program is made of finite numbers"
    );
    if conditioning == Conditioning::Plain || normal::is_squares(problem) {
        let limits = Limits {
            tolerance,
            finer,
            iterations,
            deadline: DEADLINE.get(),
        };
        if let Some(answer) = normal::solve(problem, limits) {
            return answer;
        }
    }
    by_clarabel(problem, settings, iterations)
}

/// Solves a conic problem of finite numbers by clarabel, whatever its size.
pub fn by_clarabel(
    problem: &QuadraticProgram,
    settings: SolverSettings,
    iterations: usize,
) -> Answer {
    let SolverSettings {
        tolerance,
        conditioning,
        ..
    } = settings;
    let rows = problem.bound.len();
    let quadratic = compressed(problem.unknowns, problem.unknowns, &problem.quadratic);
    let matrix = compressed(rows, problem.unknowns, &problem.matrix);
    let mut cones = Vec::with_capacity(2);
    if problem.equalities > 0 {
        cones.push(SupportedConeT::ZeroConeT(problem.equalities));
    }
    if rows > problem.equalities {
        cones.push(SupportedConeT::NonnegativeConeT(rows - problem.equalities));
    }
    let left = DEADLINE
        .get()
        .map(|end| end.saturating_duration_since(Instant::now()));
    if left.is_some_and(|left| left.is_zero()) {
        return Answer::none(problem);
    }
    let settings = DefaultSettings {
        verbose: false,
        time_limit: left.map_or(f64::INFINITY, |left| left.as_secs_f64()),
        direct_solve_method: "qdldl".to_string(),
        presolve_enable: false,
        max_iter: u32::try_from(iterations).unwrap_or(u32::MAX),
        equilibrate_enable: conditioning == Conditioning::Full,
        iterative_refinement_enable: conditioning == Conditioning::Full,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        ..DefaultSettings::default()
    };
    let solver = DefaultSolver::new(
        &quadratic,
        &problem.linear,
        &matrix,
        &problem.bound,
        &cones,
        settings,
    );
    let Ok(mut solver) = solver else {
        return Answer::none(problem);
    };
    solver.solve();
    let solution = solver.solution;
    let status = match solution.status {
        SolverStatus::Solved => Status::Solved,
        SolverStatus::PrimalInfeasible => Status::Infeasible,
        SolverStatus::DualInfeasible => Status::Unbounded,
        _ => Status::Unsolved,
    };
    let answer = Answer {
        status,
        x: solution.x,
        z: solution.z,
        s: solution.s,
        iterations: solution.iterations as usize,
    };
    answer.if_finite()
}

fn finite(list: &[f64]) -> bool {
    list.iter().all(|v| v.is_finite())
}

/// Compressed columns from (row, column, value) entries; entries of one place are added.
fn compressed(rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> CscMatrix<f64> {
    let mut starts = vec![0; columns + 1];
    for (_, column, _) in entries {
        starts[column + 1] += 1;
    }
    for k in 0..columns {
        starts[k + 1] += starts[k];
    }
    let mut next = starts.clone();
    let mut list = vec![(0, 0.0); entries.len()];
    for (row, column, value) in entries {
        list[next[*column]] = (*row, *value);
        next[*column] += 1;
    }
    let (mut colptr, mut rowval, mut nzval) = (
        vec![0],
        Vec::with_capacity(list.len()),
        Vec::with_capacity(list.len()),
    );
    for k in 0..columns {
        let column = &mut list[starts[k]..starts[k + 1]];
        column.sort_by_key(|e| e.0);
        for (row, value) in column.iter() {
            if rowval.len() > colptr[k] && rowval.last() == Some(row) {
                if let Some(last) = nzval.last_mut() {
                    *last += value;
                }
            } else {
                rowval.push(*row);
                nzval.push(*value);
            }
        }
        colptr.push(rowval.len());
    }
    CscMatrix::new(rows, columns, colptr, rowval, nzval)
}
