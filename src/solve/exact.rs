//! The balance that leaves no choice: as many independent columns as matter, solved by elimination.
//!
//! Answers to rounding where the interior-point method would give nine digits, and tells whether there is a choice.

use crate::program::Column;

/// Larger systems go to the sparse solver: elimination here is dense and grows with the cube.
const MOST_ROWS: usize = 120;

/// Pivots below this mean that the columns depend on each other, so that there is a choice.
const LEAST_PIVOT: f64 = 1e-7;

/// The only amounts of the columns that give `need`, where the columns are independent and the amounts not negative.
pub(super) fn only(need: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
    let (rows, n) = (need.len(), columns.len());
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
    for (row, value) in need.iter().enumerate() {
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
    let scale = need.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
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
