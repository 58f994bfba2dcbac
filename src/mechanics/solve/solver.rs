//! The single entry point to the solvers: takes a [`QuadraticProgram`] and returns an [`Answer`].
//!
//! With plain conditioning, the module [`super::normal`] solves the programs of many blocks; clarabel solves all
//! others. Least-squares problems of many blocks go to `normal` with either conditioning. If a quadratic program, or
//! the program of a chain of blocks such as an arch, ends in `normal` without a result, clarabel solves it at once. For
//! any other program without a result, clarabel is used only if the caller tries again with full conditioning.
//!
//! Numbers that are NaN or infinite are rejected here, because the solvers would report such a program as solved.
//!
//! clarabel implements a primal-dual interior-point method on the homogeneous embedding
//! ([Goulart24](crate::doc::references)). These settings differ from its defaults:
//!
//! - `direct_solve_method` is `qdldl`. The automatic choice for large programs is faer, which takes 13.1 s instead of
//!   4.6 s at 10⁴ blocks;
//! - presolve is off, because it only removes infinite bounds, and these programs have none;
//! - equilibration and iterative refinement are off with [`Conditioning::Plain`].

use std::time::Duration;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use super::answer::{Answer, Status, is_finite};
use super::normal;
use super::settings::{Conditioning, MAX_ITERATIONS, SolverSettings, StoppingCriteria, deadline, is_late};
use crate::clock::Instant;
use crate::mechanics::program::QuadraticProgram;

/// Solves a linear or quadratic program to the given tolerance.
///
/// # Panics
/// Panics if the data contain a number that is not finite. Scenes are checked when they are read, so this would be a
/// bug.
pub fn solve(problem: &QuadraticProgram, tolerance: f64, conditioning: Conditioning) -> Answer {
    solve_with(problem, SolverSettings { tolerance, ..conditioning.into() })
}

/// Solves a linear or quadratic program with the given settings. If the iterations are not enough, or if the deadline
/// has passed, the status is `Unsolved`.
///
/// # Panics
/// Panics in the same case as [`solve`].
pub fn solve_with(problem: &QuadraticProgram, settings: SolverSettings) -> Answer {
    // Do not start after the deadline: before its first iteration, a large program needs an ordering and a
    // factorisation, which take as long as many iterations.
    if is_late() {
        return Answer::without_status(problem);
    }
    assert!(all_finite(problem), "a program is made of finite numbers");
    if settings.conditioning == Conditioning::Plain || normal::is_least_squares(problem) {
        let criteria = StoppingCriteria {
            tolerance: settings.tolerance,
            crossover: settings.crossover,
            iterations: settings.iterations,
            deadline: deadline(),
        };
        if let Some(answer) = normal::solve(problem, criteria) {
            return answer;
        }
    }
    by_clarabel(problem, settings)
}

/// Solves the linear program of the forces of least cost by the normal equations, also for few blocks. `None` if these
/// end without an optimum.
pub fn solve_forces(problem: &QuadraticProgram, tolerance: f64) -> Option<Answer> {
    let criteria = StoppingCriteria { tolerance, crossover: None, iterations: MAX_ITERATIONS, deadline: deadline() };
    let answer = normal::solve_any_size(problem, criteria, normal::CHAIN_OPERATIONS)?;
    (answer.status == Status::Solved).then_some(answer)
}

/// True if every number of a program is finite.
pub(super) fn all_finite(problem: &QuadraticProgram) -> bool {
    let mut entries = problem.matrix.iter().chain(&problem.quadratic);
    is_finite(&problem.linear) && is_finite(&problem.bound) && entries.all(|entry| entry.2.is_finite())
}

/// Solves a quadratic program of any size with clarabel. All numbers of the program must be finite.
pub fn by_clarabel(problem: &QuadraticProgram, settings: SolverSettings) -> Answer {
    let rows = problem.bound.len();
    let quadratic = compressed_columns(problem.unknowns, problem.unknowns, &problem.quadratic);
    let matrix = compressed_columns(rows, problem.unknowns, &problem.matrix);
    // The cones of the slacks: the zero cone for the equalities, the nonnegative cone for the inequalities.
    let mut cones = Vec::with_capacity(2);
    if problem.equalities > 0 {
        cones.push(SupportedConeT::ZeroConeT(problem.equalities));
    }
    if rows > problem.equalities {
        cones.push(SupportedConeT::NonnegativeConeT(rows - problem.equalities));
    }
    let time_left = deadline().map(|end| end.saturating_duration_since(Instant::now()));
    if time_left.is_some_and(|time| time.is_zero()) {
        return Answer::without_status(problem);
    }
    let settings = clarabel_settings(settings, time_left);
    let solver = DefaultSolver::new(&quadratic, &problem.linear, &matrix, &problem.bound, &cones, settings);
    let Ok(mut solver) = solver else {
        return Answer::without_status(problem);
    };
    solver.solve();
    let solution = solver.solution;
    // An "almost solved" status counts as unsolved: the caller then tries again or solves another linear program.
    let status = match solution.status {
        SolverStatus::Solved => Status::Solved,
        SolverStatus::PrimalInfeasible => Status::Infeasible,
        SolverStatus::DualInfeasible => Status::Unbounded,
        _ => Status::Unsolved,
    };
    let answer =
        Answer { status, x: solution.x, z: solution.z, s: solution.s, iterations: solution.iterations as usize };
    answer.if_finite()
}

/// Returns the settings of clarabel. `time_left` is the time until the deadline, if there is one.
fn clarabel_settings(settings: SolverSettings, time_left: Option<Duration>) -> DefaultSettings<f64> {
    let SolverSettings { tolerance, iterations, conditioning, .. } = settings;
    let is_full = conditioning == Conditioning::Full;
    DefaultSettings {
        verbose: false,
        time_limit: time_left.map_or(f64::INFINITY, |time| time.as_secs_f64()),
        direct_solve_method: "qdldl".to_string(),
        presolve_enable: false,
        max_iter: u32::try_from(iterations).unwrap_or(u32::MAX),
        equilibrate_enable: is_full,
        iterative_refinement_enable: is_full,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        ..DefaultSettings::default()
    }
}

/// Builds a compressed sparse column matrix from (row, column, value) entries. Entries with the same row and column are
/// added up.
fn compressed_columns(rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> CscMatrix<f64> {
    // Counting sort by column: count the entries of each column, then place them.
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
    // Sort each column by row, and add up entries of the same row.
    let (mut colptr, mut rowval, mut nzval) = (vec![0], Vec::with_capacity(list.len()), Vec::with_capacity(list.len()));
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
