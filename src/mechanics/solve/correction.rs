//! Corrections of amounts: what they leave unbalanced is scaled up and solved for once more.

use super::{Conditioning, Effort, SolverSettings, Status, largest, remainder, solved_with_retry};
use crate::program::{Column, Correction, least_norm, least_squares};

/// Amounts with the smallest change that undoes what they leave unbalanced: one system of equations, no inequality. One
/// that would fall below 0 is cut there, so that what it cost shows in the balance.
pub(super) fn settled(
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

/// Amounts whose balance is exact to rounding, if they can be had near the given ones.
///
/// What is left unbalanced is scaled up to size 1 and solved for as a correction, which keeps every amount ≥ 0; each round
/// gains the solver's nine digits. Without it a feather under a mountain drowns in the mountain's rounding.
pub(super) fn refined(
    loads: &[f64],
    columns: &[Column],
    mut amounts: Vec<f64>,
    effort: &mut Effort,
) -> Vec<f64> {
    for _ in 0..2 {
        let rest = remainder(loads, columns, &amounts);
        let size = largest(&rest);
        if size <= 1e-14 * largest(loads) {
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
        if largest(&remainder(loads, columns, &better)) >= size {
            break;
        }
        amounts = better;
    }
    amounts
}
