//! The single entry to the solvers: a [`QuadraticProgram`] problem goes in, a status of our own and plain vectors come out.
//!
//! Linear programs of many blocks go to the normal equations first ([`super::normal`]), all others to clarabel. A chain that
//! ends there without a status goes to clarabel at once; other programs do when the caller tries again with full
//! conditioning. The solvers call NaN in the data "solved", so it is refused here.

use super::answer::{Answer, is_finite};
use super::clarabel_solver::by_clarabel;
use super::deadline::{deadline, is_late};
use super::normal;
use super::settings::{Conditioning, MAX_ITERATIONS, SolverSettings, StoppingCriteria};
use crate::program::QuadraticProgram;

/// Solves a conic problem.
///
/// # Panics
/// If the data contain a number that is not finite. Scenes are checked when they are read, so that would be a bug.
pub fn solve(problem: &QuadraticProgram, tolerance: f64, conditioning: Conditioning) -> Answer {
    let settings = SolverSettings {
        tolerance,
        ..conditioning.into()
    };
    solve_within(problem, settings, MAX_ITERATIONS)
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
    // To order and factorise a large program takes as long as many iterations: after the deadline none is begun.
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

/// Whether every number of a problem is finite.
pub(super) fn all_finite(problem: &QuadraticProgram) -> bool {
    let mut entries = problem.matrix.iter().chain(&problem.quadratic);
    is_finite(&problem.linear)
        && is_finite(&problem.bound)
        && entries.all(|entry| entry.2.is_finite())
}
