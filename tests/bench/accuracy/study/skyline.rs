//! [`Skyline`]: solves symmetric, positive semidefinite systems in extended precision.
//!
//! The factorisation is M = L D Lᵀ in skyline (envelope) storage: each row is stored from its first entry on
//! (Jennings 1966). Blocks that touch are usually close in the order of the scene, so the rows are short. A zero
//! pivot means that the row depends on earlier rows; its unknown is set to 0.

use super::double::Double;

/// A pivot up to this fraction of the diagonal entry counts as zero. The pivot of a dependent row is the rounding
/// error of its entries, about 1e-31 of the diagonal. The value 1e-22 is far above this error and far below the
/// pivots of independent rows.
const PIVOT_TOL: f64 = 1e-22;

/// A factorised matrix.
pub struct Skyline {
    /// The column of the first entry of each row.
    first: Vec<usize>,
    /// The rows of L, from their first columns to the diagonal.
    rows: Vec<Vec<Double>>,
    /// The diagonal of D; `None` for zero pivots.
    pivots: Vec<Option<Double>>,
}

impl Skyline {
    /// Factorises the matrix Σ weight · v vᵀ. `terms` has the weights and the sparse vectors v; `size` is the number
    /// of rows.
    pub fn new<'a>(size: usize, terms: impl Iterator<Item = (Double, &'a [(usize, Double)])> + Clone) -> Skyline {
        let mut first: Vec<usize> = (0..size).collect();
        for (_, entries) in terms.clone() {
            let least = entries.iter().map(|e| e.0).min().unwrap_or(0);
            for (row, _) in entries {
                first[*row] = first[*row].min(least);
            }
        }
        let mut rows: Vec<Vec<Double>> = (0..size).map(|row| vec![Double::ZERO; row - first[row] + 1]).collect();
        for (weight, entries) in terms {
            for (i, a) in entries {
                for (j, b) in entries.iter().filter(|e| e.0 <= *i) {
                    let at = &mut rows[*i][j - first[*i]];
                    *at = *at + weight * *a * *b;
                }
            }
        }
        let mut skyline = Skyline { first, rows, pivots: Vec::with_capacity(size) };
        skyline.factor();
        skyline
    }

    fn factor(&mut self) {
        for i in 0..self.rows.len() {
            let (above, rest) = self.rows.split_at_mut(i);
            let row = &mut rest[0];
            let start = self.first[i];
            let whole = row[i - start].abs().near();
            // Compute row i of L·D from the finished rows above it. Then divide its entries by the pivots D to get
            // row i of L.
            for j in start..i {
                let from = start.max(self.first[j]);
                let mut sum = row[j - start];
                for k in from..j {
                    sum = sum - row[k - start] * above[j][k - self.first[j]];
                }
                row[j - start] = if self.pivots[j].is_some() { sum } else { Double::ZERO };
            }
            let mut pivot = row[i - start];
            for j in start..i {
                if let Some(other) = self.pivots[j] {
                    let scaled = row[j - start] / other;
                    pivot = pivot - row[j - start] * scaled;
                    row[j - start] = scaled;
                }
            }
            let is_independent = pivot.near() > PIVOT_TOL * whole && whole > 0.0;
            self.pivots.push(is_independent.then_some(pivot));
        }
    }

    /// Solves M w = `right` for the factorised matrix M. If M is singular, `right` must be in its range.
    pub fn solve(&self, right: &[Double]) -> Vec<Double> {
        // Forward substitution with L, division by D, backward substitution with Lᵀ.
        let mut w = right.to_vec();
        for i in 0..w.len() {
            let start = self.first[i];
            let known = (start..i).fold(Double::ZERO, |sum, k| sum + self.rows[i][k - start] * w[k]);
            w[i] = match self.pivots[i] {
                Some(_) => w[i] - known,
                None => Double::ZERO,
            };
        }
        for (value, pivot) in w.iter_mut().zip(&self.pivots) {
            *value = pivot.map_or(Double::ZERO, |p| *value / p);
        }
        for i in (0..w.len()).rev() {
            if self.pivots[i].is_none() {
                continue;
            }
            let start = self.first[i];
            for k in start..i {
                w[k] = w[k] - self.rows[i][k - start] * w[i];
            }
        }
        w
    }
}
