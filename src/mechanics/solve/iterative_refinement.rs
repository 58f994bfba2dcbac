//! Corrects the forces of a solver, so that they balance the loads more accurately. The residual (the part of the loads
//! that is not balanced) is scaled to size 1, and a correction that removes it is computed and added.
//!
//! Reference: Higham, Accuracy and Stability of Numerical Algorithms, 2002, chapter 12.

use super::optimum::solve_in_turn;
use super::settings::ROUNDING_TOL;
use super::{Conditioning, Effort, SolverSettings, Status, largest, remainder};
use crate::mechanics::program::{Column, Correction, least_norm, least_squares};

/// The largest number of rounds of [`refine_balance`]. Each round adds about nine correct digits, so two
/// rounds reach the precision of f64.
const MAX_ROUNDS: usize = 2;

/// Adds to the amounts the change of least Σ change² that removes their residual. This takes one linear system.
///
/// An amount that would become negative is set to 0, which may leave a residual. Upper limits are not observed. If the
/// solver finds no solution, the amounts are returned unchanged.
pub(super) fn balance_by_least_change(
    loads: &[f64],
    columns: &[Column],
    amounts: Vec<f64>,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Vec<f64> {
    let rest = remainder(loads, columns, &amounts);
    let size = largest(&rest);
    if size == 0.0 {
        return amounts;
    }
    let scaled: Vec<f64> = rest.iter().map(|v| v / size).collect();
    let answer = solve_in_turn(&least_norm(&scaled, columns), settings.with_retry(), effort);
    if answer.status != Status::Solved {
        return amounts;
    }
    let better = amounts.iter().zip(&answer.x);
    better.map(|(a, d)| (a + size * d).max(0.0)).collect()
}

/// Refines amounts in at most two rounds. Stops earlier if the amounts balance the loads up to rounding, if the solver
/// finds no correction, or if a round does not reduce the residual.
///
/// Each round solves a quadratic program for a correction that keeps every amount ≥ 0, and adds about nine correct
/// digits. Without refinement, the imbalance of a very light block under a very heavy block is hidden by the rounding
/// errors of the heavy block.
pub(super) fn refine_balance(
    loads: &[f64],
    columns: &[Column],
    mut amounts: Vec<f64>,
    effort: &mut Effort,
) -> Vec<f64> {
    for _ in 0..MAX_ROUNDS {
        let rest = remainder(loads, columns, &amounts);
        let size = largest(&rest);
        if size <= ROUNDING_TOL * largest(loads) {
            break;
        }
        let scaled: Vec<f64> = rest.iter().map(|v| v / size).collect();
        // Solve for a correction that removes the residual. The residual is scaled to size 1.
        let correction = Correction { amounts: &amounts, size, largest: f64::INFINITY };
        let problem = least_squares(&scaled, columns, Some(correction));
        let answer = solve_in_turn(&problem, [Conditioning::Full.into()], effort);
        if answer.status != Status::Solved {
            break;
        }
        let better: Vec<f64> = amounts.iter().zip(&answer.x).map(|(a, d)| (a + d * size).max(0.0)).collect();
        // Keep a correction only if it reduces the residual.
        if largest(&remainder(loads, columns, &better)) >= size {
            break;
        }
        amounts = better;
    }
    amounts
}
