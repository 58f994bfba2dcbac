//! Solves small systems of equilibrium equations by elimination. Finds the balance if it is unique, and otherwise the
//! balance of least Σ force².
//!
//! An interior-point method reaches nine digits after many iterations; elimination reaches sixteen digits without
//! iteration. If elimination cannot prove its result, the caller uses the solver. Reference: Golub and Van Loan,
//! Matrix Computations, 2013, §3.4 (partial pivoting), §4.2 (Cholesky) and §5.5 (rank deficiency).

use super::amounts::largest;
use super::settings::TOLERANCE;
use crate::mechanics::program::{Column, product};

/// The largest number of rows. Larger systems are solved by the sparse solver, because the work of dense elimination
/// grows with the cube of the rows.
const MAX_ROWS: usize = 120;

/// The smallest allowed pivot. If a pivot is smaller, the columns count as linearly dependent, and the balance as not
/// unique.
///
/// The entries are near 1. If this value were ten times smaller, the amounts could lose one more digit; if it were ten
/// times larger, columns of short contacts would be refused.
const PIVOT_TOL: f64 = 1e-7;

/// The tolerance for residuals and negative amounts in the least-squares problem, as a fraction of the largest load.
///
/// It can be stricter than [`TOLERANCE`], up to which residuals and negative amounts of a unique balance count as
/// rounding: [`proved_optimum`] checks each result, and the solver is used if the check fails.
const STRICT_TOL: f64 = 1e-12;

/// Computes the amounts of the columns that balance the loads, if they are unique, by Gaussian elimination with partial
/// pivoting.
///
/// `None` if the columns are linearly dependent, an amount is outside its bounds, no amounts balance the loads, or
/// there are more than 120 rows.
pub(super) fn unique_balance(loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
    let (rows, n) = (loads.len(), columns.len());
    if n > rows || rows > MAX_ROWS {
        return None;
    }
    // Build the augmented matrix row by row: the columns, followed by the loads.
    let width = n + 1;
    let mut table = vec![0.0; rows * width];
    for (j, column) in columns.iter().enumerate() {
        for (row, value) in column.entries() {
            table[row * width + j] = value;
        }
    }
    for (row, value) in loads.iter().enumerate() {
        table[row * width + n] = *value;
    }
    eliminate(&mut table, rows, n)?;
    // Back substitution.
    let mut amounts = vec![0.0; n];
    for j in (0..n).rev() {
        let known: f64 = (j + 1..n).map(|k| table[j * width + k] * amounts[k]).sum();
        amounts[j] = (table[j * width + n] - known) / table[j * width + j];
    }
    let tolerance = TOLERANCE * largest(loads);
    let is_balanced = (n..rows).all(|row| table[row * width + n].abs() <= tolerance);
    let is_admissible = amounts.iter().zip(columns).all(|(a, c)| *a >= -tolerance && *a <= c.limit + tolerance);
    (is_balanced && is_admissible).then(|| amounts.iter().map(|a| a.max(0.0)).collect())
}

/// Performs the forward elimination of the first `n` columns of a table with n + 1 columns. `None` if a pivot is too
/// small.
fn eliminate(table: &mut [f64], rows: usize, n: usize) -> Option<()> {
    let width = n + 1;
    for j in 0..n {
        let size = |row: &usize| table[row * width + j].abs();
        let best = (j..rows).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        if size(&best) < PIVOT_TOL {
            return None;
        }
        // Exchange rows, then eliminate below the pivot.
        if best != j {
            for k in j..width {
                table.swap(best * width + k, j * width + k);
            }
        }
        let (above, below) = table.split_at_mut((j + 1) * width);
        let pivot = &above[j * width..];
        for row in below.chunks_exact_mut(width) {
            let factor = row[j] / pivot[j];
            if factor != 0.0 {
                for k in j..width {
                    row[k] -= factor * pivot[k];
                }
            }
        }
    }
    Some(())
}

/// Computes the amounts ≥ 0 of least Σ force² that balance the loads, by an active-set method. `None` if a few rounds
/// of the method do not find them, if the method does not apply, or if there are more than 120 rows.
///
/// The method applies only if Σ force² contains no products of the amounts of two columns, as with pure normal forces.
/// Let λ_j be the amount of column g_j, p_j its Σ force² for an amount of 1, and y the multipliers of the balance. At
/// the optimum (Karush, Kuhn and Tucker), λ_j = g_jᵀy / p_j for the columns in use and g_jᵀy ≤ 0 for the dropped
/// columns. Each round solves for y and drops the columns with negative amounts.
pub(super) fn least_squares_balance(loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
    let rows = loads.len();
    let mix = |pair: &[Column]| product(&pair[0].force, &pair[1].force).is_some_and(|p| p != 0.0);
    if rows > MAX_ROWS || columns.windows(2).any(mix) {
        return None;
    }
    let squares: Vec<f64> = columns.iter().filter_map(|c| product(&c.force, &c.force)).collect();
    let scale = largest(loads);
    let mut in_use = vec![true; columns.len()];
    for _ in 0..MAX_ROUNDS {
        let y = solve_semidefinite(gram(rows, columns, &squares, &in_use), loads)?;
        // The amounts at the stationary point for these columns are λ = gᵀy / p.
        let both = columns.iter().zip(&squares);
        let amounts: Vec<f64> = both.map(|(c, square)| c.dot(&y) / square).collect();
        let is_negative = |k: &usize| in_use[*k] && amounts[*k] < -STRICT_TOL * scale;
        let dropped: Vec<usize> = (0..columns.len()).filter(is_negative).collect();
        if dropped.is_empty() {
            return proved_optimum(loads, columns, &amounts, &in_use);
        }
        dropped.into_iter().for_each(|k| in_use[k] = false);
    }
    None
}

/// The largest number of rounds that drop negative amounts. After that, the solver is used.
const MAX_ROUNDS: usize = 6;

/// Returns Σ column·columnᵀ/square over the columns in use, as a full matrix.
fn gram(rows: usize, columns: &[Column], squares: &[f64], in_use: &[bool]) -> Vec<f64> {
    let mut gram = vec![0.0; rows * rows];
    let both = columns.iter().zip(squares).zip(in_use);
    for ((column, square), _) in both.filter(|(_, in_use)| **in_use) {
        for (i, a) in column.entries() {
            for (j, b) in column.entries() {
                gram[i * rows + j] += a * b / square;
            }
        }
    }
    gram
}

/// Returns the amounts of all columns, with 0 for the columns that are not in use. `None` if these amounts do not meet
/// the conditions of an optimum.
fn proved_optimum(loads: &[f64], columns: &[Column], amounts: &[f64], in_use: &[bool]) -> Option<Vec<f64>> {
    let scale = largest(loads);
    let both = || amounts.iter().zip(in_use);
    let kept: Vec<f64> = both().map(|(a, in_use)| if *in_use { a.max(0.0) } else { 0.0 }).collect();
    // Dropped columns must have gᵀy ≤ 0. The amounts of the other columns must be within their limits and balance the
    // loads.
    let is_optimal = both().all(|(a, in_use)| *in_use || *a <= TOLERANCE * scale);
    let is_admissible = kept.iter().zip(columns).all(|(a, c)| *a <= c.limit);
    let mut residual = loads.to_vec();
    let forces = columns.iter().zip(&kept);
    forces.for_each(|(c, a)| c.add_to(&mut residual, -a));
    let is_balanced = residual.iter().all(|v| v.abs() <= STRICT_TOL * scale);
    (is_optimal && is_admissible && is_balanced).then_some(kept)
}

/// A pivot up to this fraction of the largest diagonal entry counts as 0: its row depends linearly on earlier rows. The
/// entries are sums of products, whose rounding is about 10⁻¹⁵.
const SEMIDEFINITE_PIVOT_TOL: f64 = 1e-11;

/// Solves the symmetric positive semidefinite system a·x = b by Cholesky factorization. Unknowns without a pivot become
/// 0. `None` if the result is not finite.
fn solve_semidefinite(mut a: Vec<f64>, b: &[f64]) -> Option<Vec<f64>> {
    let n = b.len();
    let has_pivot = factor_semidefinite(&mut a, n);
    // Forward and backward substitution.
    let mut x = b.to_vec();
    for j in 0..n {
        if has_pivot[j] {
            let known: f64 = (0..j).map(|k| a[j * n + k] * x[k]).sum();
            x[j] = (x[j] - known) / a[j * n + j];
        } else {
            x[j] = 0.0;
        }
    }
    for j in (0..n).rev().filter(|j| has_pivot[*j]) {
        let known: f64 = (j + 1..n).map(|k| a[k * n + j] * x[k]).sum();
        x[j] = (x[j] - known) / a[j * n + j];
    }
    x.iter().all(|v| v.is_finite()).then_some(x)
}

/// Replaces the lower triangle of a semidefinite matrix by its Cholesky factor. Returns, for each column, whether it
/// has a pivot. Columns without a pivot are set to 0 from the diagonal down.
fn factor_semidefinite(a: &mut [f64], n: usize) -> Vec<bool> {
    let max_diagonal = (0..n).map(|i| a[i * n + i]).fold(0.0, f64::max);
    let mut has_pivot = vec![false; n];
    for j in 0..n {
        let mut d = a[j * n + j];
        for k in 0..j {
            d -= a[j * n + k] * a[j * n + k];
        }
        if d <= SEMIDEFINITE_PIVOT_TOL * max_diagonal {
            // Restricted to the columns in use, this row depends linearly on earlier rows. If the entry of the loads in
            // this row does not depend on the earlier entries in the same way, the later check of the balance fails.
            for i in j..n {
                a[i * n + j] = 0.0;
            }
            continue;
        }
        has_pivot[j] = true;
        let root = d.sqrt();
        a[j * n + j] = root;
        for i in j + 1..n {
            let mut v = a[i * n + j];
            for k in 0..j {
                v -= a[i * n + k] * a[j * n + k];
            }
            a[i * n + j] = v / root;
        }
    }
    has_pivot
}
