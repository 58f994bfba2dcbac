//! Iterative refinement of amounts: the residual is scaled to size 1, solved for as a correction, and added.

use super::{Conditioning, Effort, SolverSettings, Status, largest, remainder, solved_with_retry};
use crate::program::{Column, Correction, least_norm, least_squares};

/// Rounds of [`refine_balance`]: twice nine digits are more than f64 has.
const MAX_ROUNDS: usize = 2;

/// A residual below this fraction of the largest load is rounding.
const ROUNDING: f64 = 1e-14;

/// The amounts with the least change that removes their residual: one linear system, no inequalities.
///
/// An amount that would become negative is set to 0; what that costs shows in the balance. If the system is not solved, the
/// amounts are returned as they are.
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
    let answer = solved_with_retry(&least_norm(&scaled, columns), settings, effort);
    if answer.status != Status::Solved {
        return amounts;
    }
    let better = amounts.iter().zip(&answer.x);
    better.map(|(a, d)| (a + size * d).max(0.0)).collect()
}

/// Amounts near the given ones whose balance is exact to rounding, as far as they are found.
///
/// Each round solves a quadratic program for a correction that keeps every amount ≥ 0, and gains the solver's nine digits.
/// Without it the balance of a feather under a mountain is lost in the mountain's rounding.
pub(super) fn refine_balance(
    loads: &[f64],
    columns: &[Column],
    mut amounts: Vec<f64>,
    effort: &mut Effort,
) -> Vec<f64> {
    for _ in 0..MAX_ROUNDS {
        let rest = remainder(loads, columns, &amounts);
        let size = largest(&rest);
        if size <= ROUNDING * largest(loads) {
            break;
        }
        let scaled: Vec<f64> = rest.iter().map(|v| v / size).collect();
        let correction = Correction {
            amounts: &amounts,
            size,
        };
        let answer = solved_with_retry(
            &least_squares(&scaled, columns, Some(correction)),
            Conditioning::Full,
            effort,
        );
        if answer.status != Status::Solved {
            break;
        }
        let better: Vec<f64> = amounts
            .iter()
            .zip(&answer.x)
            .map(|(a, d)| (a + d * size).max(0.0))
            .collect();
        // Keep a correction only if it improves the balance.
        if largest(&remainder(loads, columns, &better)) >= size {
            break;
        }
        amounts = better;
    }
    amounts
}
