//! Small balances solved by elimination, to rounding: the one that leaves no choice, and the one of least squares.
//!
//! Where the interior-point method would give nine digits in many steps, elimination gives sixteen in one. What it cannot
//! show to be the answer it leaves to the solver.

use crate::program::{Column, product};

/// Larger systems go to the sparse solver: elimination here is dense and grows with the cube.
const MOST_ROWS: usize = 120;

/// Pivots below this mean that the columns depend on each other, so that there is a choice.
const LEAST_PIVOT: f64 = 1e-7;

/// The only amounts of the columns that give `loads`, where the columns are independent and the amounts not negative.
pub(super) fn only(loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
    let (rows, n) = (loads.len(), columns.len());
    if n > rows || rows > MOST_ROWS {
        return None;
    }
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
    for j in 0..n {
        let size = |row: &usize| table[row * width + j].abs();
        let best = (j..rows).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        if size(&best) < LEAST_PIVOT {
            return None;
        }
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
    let scale = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut amounts = vec![0.0; n];
    for j in (0..n).rev() {
        let known: f64 = (j + 1..n).map(|k| table[j * width + k] * amounts[k]).sum();
        amounts[j] = (table[j * width + n] - known) / table[j * width + j];
    }
    let rest = (n..rows).all(|row| table[row * width + n].abs() <= 1e-9 * scale);
    let pressing = amounts
        .iter()
        .zip(columns)
        .all(|(a, c)| *a >= -1e-9 * scale && *a <= c.limit + 1e-9 * scale);
    (rest && pressing).then(|| amounts.iter().map(|a| a.max(0.0)).collect())
}

/// The amounts ≥ 0 of least Σ force² that give `loads`, where a few rounds of dropping negative ones find them.
///
/// Only for columns whose squares do not mix, such as normal forces alone. The multipliers of the balance prove the answer:
/// λ_j = g_jᵀy / p_j where that is positive, and g_jᵀy ≤ 0 for every column dropped.
pub(super) fn least(loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
    let rows = loads.len();
    if rows > MOST_ROWS
        || columns
            .windows(2)
            .any(|w| product(&w[0].force, &w[1].force).is_some_and(|p| p != 0.0))
    {
        return None;
    }
    let squares: Vec<f64> = columns
        .iter()
        .filter_map(|c| product(&c.force, &c.force))
        .collect();
    let scale = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut used = vec![true; columns.len()];
    for _ in 0..ROUNDS {
        let mut gram = vec![0.0; rows * rows];
        for ((column, square), _) in columns
            .iter()
            .zip(&squares)
            .zip(&used)
            .filter(|(_, used)| **used)
        {
            for (i, a) in column.entries() {
                for (j, b) in column.entries() {
                    gram[i * rows + j] += a * b / square;
                }
            }
        }
        let y = semidefinite(gram, loads)?;
        let amounts: Vec<f64> = columns
            .iter()
            .zip(&squares)
            .map(|(c, square)| c.dot(&y) / square)
            .collect();
        let negative = |k: &usize| used[*k] && amounts[*k] < -1e-12 * scale;
        let drop: Vec<usize> = (0..columns.len()).filter(negative).collect();
        if drop.is_empty() {
            let kept: Vec<f64> = amounts
                .iter()
                .zip(&used)
                .map(|(a, used)| if *used { a.max(0.0) } else { 0.0 })
                .collect();
            let proved = amounts
                .iter()
                .zip(&used)
                .all(|(a, used)| *used || *a <= 1e-9 * scale);
            let allowed = kept.iter().zip(columns).all(|(a, c)| *a <= c.limit);
            let mut rest = loads.to_vec();
            columns
                .iter()
                .zip(&kept)
                .for_each(|(c, a)| c.add_to(&mut rest, -a));
            let balanced = rest.iter().all(|v| v.abs() <= 1e-12 * scale);
            return (proved && allowed && balanced).then_some(kept);
        }
        drop.into_iter().for_each(|k| used[k] = false);
    }
    None
}

/// Rounds of dropping negative amounts before the solver is asked.
const ROUNDS: usize = 6;

/// Solves a symmetric positive semidefinite system by Cholesky; rows without a pivot get 0.
fn semidefinite(mut a: Vec<f64>, b: &[f64]) -> Option<Vec<f64>> {
    let n = b.len();
    let largest = (0..n).map(|i| a[i * n + i]).fold(0.0, f64::max);
    let mut x = b.to_vec();
    let mut pivots = vec![false; n];
    for j in 0..n {
        let mut d = a[j * n + j];
        for k in 0..j {
            d -= a[j * n + k] * a[j * n + k];
        }
        if d <= 1e-11 * largest {
            // Nothing acts along this row; whether nothing is needed shows in the balance.
            for i in j..n {
                a[i * n + j] = 0.0;
            }
            continue;
        }
        pivots[j] = true;
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
    for j in 0..n {
        if pivots[j] {
            let known: f64 = (0..j).map(|k| a[j * n + k] * x[k]).sum();
            x[j] = (x[j] - known) / a[j * n + j];
        } else {
            x[j] = 0.0;
        }
    }
    for j in (0..n).rev().filter(|j| pivots[*j]).collect::<Vec<_>>() {
        let known: f64 = (j + 1..n).map(|k| a[k * n + j] * x[k]).sum();
        x[j] = (x[j] - known) / a[j * n + j];
    }
    x.iter().all(|v| v.is_finite()).then_some(x)
}
