//! Computes the residual of forces: the part of the loads that the forces do not balance.

use crate::mechanics::program::Column;

/// Returns the residual loads − Σ amount·column, one number for each row.
pub(super) fn remainder(loads: &[f64], columns: &[Column], amounts: &[f64]) -> Vec<f64> {
    let mut rest: Vec<f64> = loads.to_vec();
    for (column, amount) in columns.iter().zip(amounts) {
        column.add_to(&mut rest, -amount);
    }
    rest
}

/// Returns the largest absolute value in a list, 0 for an empty list.
pub(super) fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}
