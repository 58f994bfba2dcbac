//! Computes the amounts, positive or negative, of least norm that balance the loads: f = Aᵀ(A·Aᵀ)⁻¹·loads.
//!
//! A·Aᵀ is factored once, and the multipliers y of A·Aᵀ·y = loads are improved by iterative refinement (Golub and Van
//! Loan, Matrix Computations, section 3.5.3).

use super::cholesky::Cholesky;
use super::column_groups::ColumnGroups;
use super::dense::max_norm;

/// The number of solves with the factor: the first solve and two of refinement. Each adds about as many correct
/// digits as the factor has.
const MAX_SOLVES: usize = 3;

/// The amounts of least norm, and the multipliers y of the balance in the order of elimination.
pub(super) struct LeastNorm {
    pub amounts: Vec<f64>,
    pub multipliers: Vec<f64>,
}

/// Finds the amounts of least norm that balance the loads. `None` if the largest absolute entry of the remaining
/// residual loads − A·amounts exceeds `tolerance`.
pub(super) fn solve(columns: &ColumnGroups, factor: &mut Cholesky, loads: &[f64], tolerance: f64) -> Option<LeastNorm> {
    let mut amounts = vec![1.0; columns.column_count()];
    factor.factor(columns, &amounts, 0.0);
    let mut multipliers = vec![0.0; loads.len()];
    let mut residual = loads.to_vec();
    for _ in 0..MAX_SOLVES {
        // Solve for the residual and add the correction to the multipliers.
        let mut change: Vec<[f64; 1]> = residual.iter().map(|v| [*v]).collect();
        factor.solve(&mut change);
        let changes = multipliers.iter_mut().zip(&change);
        changes.for_each(|(y, d)| *y += d[0]);
        columns.transpose_product(&multipliers, &mut amounts);
        // Recompute the residual loads − A·amounts.
        residual.fill(0.0);
        columns.add_product(&amounts, &mut residual);
        let both = residual.iter_mut().zip(loads);
        both.for_each(|(v, load)| *v = load - *v);
    }
    (max_norm(&residual) <= tolerance).then_some(LeastNorm { amounts, multipliers })
}
