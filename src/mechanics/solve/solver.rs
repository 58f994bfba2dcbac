//! The single entry point to the solvers: takes a [`QuadraticProgram`] and returns an [`Answer`].
//!
//! With plain conditioning, the module [`super::normal`] solves the programs of many blocks; clarabel solves all
//! others. Least-squares problems of many blocks go to `normal` with either conditioning. If a quadratic program, or
//! the program of a chain of blocks such as an arch, ends in `normal` without a result, clarabel solves it at once. For
//! any other program without a result, clarabel is used only if the caller tries again with full conditioning.
//!
//! Numbers that are NaN or infinite are rejected here, because the solvers would report such a program as solved.

use super::answer::{Answer, is_finite};
use super::clarabel_solver::by_clarabel;
use super::deadline::{deadline, is_late};
use super::normal;
use super::settings::{Conditioning, MAX_ITERATIONS, SolverSettings, StoppingCriteria};
use crate::mechanics::program::QuadraticProgram;

/// Solves a linear or quadratic program to the given tolerance.
///
/// # Panics
/// Panics if the data contain a number that is not finite. Scenes are checked when they are read, so this would be a
/// bug.
pub fn solve(problem: &QuadraticProgram, tolerance: f64, conditioning: Conditioning) -> Answer {
    let settings = SolverSettings { tolerance, ..conditioning.into() };
    solve_within(problem, settings, MAX_ITERATIONS)
}

/// Solves a linear or quadratic program in at most `iterations` iterations. If they are not enough, or if the deadline
/// has passed, the status is `Unsolved`.
///
/// # Panics
/// Panics in the same case as [`solve`].
pub fn solve_within(problem: &QuadraticProgram, settings: SolverSettings, iterations: usize) -> Answer {
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
            iterations,
            deadline: deadline(),
        };
        if let Some(answer) = normal::solve(problem, criteria) {
            return answer;
        }
    }
    by_clarabel(problem, settings, iterations)
}

/// True if every number of a program is finite.
pub(super) fn all_finite(problem: &QuadraticProgram) -> bool {
    let mut entries = problem.matrix.iter().chain(&problem.quadratic);
    is_finite(&problem.linear) && is_finite(&problem.bound) && entries.all(|entry| entry.2.is_finite())
}
