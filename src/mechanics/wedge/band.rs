//! [`Band`]: banded linear systems, solved by LU factorization with partial pivoting.
//!
//! The matrices are not symmetric if faces slide. [`order`] assigns nearby positions to blocks that touch (Cuthill
//! and McKee 1969). The bandwidth is then about the number of matrix rows of one layer of blocks. Reference: Golub
//! and Van Loan, Matrix Computations, section 4.3.

use crate::mechanics::program::Program;

/// A pivot with a smaller absolute value is replaced by this value. The unknown of that row is then arbitrary; the
/// later check of the balance decides whether the solution is usable.
///
/// The entries are near 1, and the springs to the ground add at least 1e-11 to the diagonal. Only pivots that are
/// rounding are therefore replaced.
const MIN_PIVOT: f64 = 1e-14;

/// A matrix with `bandwidth` entries on either side of the diagonal.
pub(super) struct Band {
    size: usize,
    bandwidth: usize,
    rows: Vec<f64>,
    pivot_rows: Vec<usize>,
}

impl Band {
    /// Creates a banded matrix of zeros with `size` rows.
    pub(super) fn new(size: usize, bandwidth: usize) -> Band {
        let bandwidth = bandwidth.min(size.saturating_sub(1));
        Band {
            size,
            bandwidth,
            // Row exchanges can create up to `bandwidth` more entries on the right.
            rows: vec![0.0; size * (3 * bandwidth + 1)],
            pivot_rows: Vec::with_capacity(size),
        }
    }

    /// Returns the index of an entry in `rows`.
    fn at(&self, row: usize, column: usize) -> usize {
        row * (3 * self.bandwidth + 1) + column + self.bandwidth - row
    }

    /// Adds a value to the entry in the given row and column.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        let at = self.at(row, column);
        self.rows[at] += value;
    }

    /// Replaces the matrix by its LU factors.
    pub(super) fn factor(mut self) -> Band {
        for k in 0..self.size {
            // Partial pivoting.
            let last = (k + self.bandwidth).min(self.size - 1);
            let end = (k + 2 * self.bandwidth).min(self.size - 1);
            let mut best = k;
            for row in k + 1..=last {
                if self.rows[self.at(row, k)].abs() > self.rows[self.at(best, k)].abs() {
                    best = row;
                }
            }
            self.pivot_rows.push(best);
            // Row exchange.
            if best != k {
                for column in k..=end {
                    let (a, b) = (self.at(k, column), self.at(best, column));
                    self.rows.swap(a, b);
                }
            }
            let diagonal = self.at(k, k);
            if self.rows[diagonal].abs() < MIN_PIVOT {
                self.rows[diagonal] = MIN_PIVOT;
            }
            // Elimination. The factors L are stored in place of the eliminated entries.
            for row in k + 1..=last {
                let at = self.at(row, k);
                if self.rows[at] == 0.0 {
                    continue;
                }
                let factor = self.rows[at] / self.rows[diagonal];
                self.rows[at] = factor;
                for column in k + 1..=end {
                    let (to, from) = (self.at(row, column), self.at(k, column));
                    self.rows[to] -= factor * self.rows[from];
                }
            }
        }
        self
    }

    /// Solves the linear system for one right-hand side, with the LU factors that [`Band::factor`] computed.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        // Forward substitution with L and the row exchanges.
        for k in 0..self.size {
            x.swap(k, self.pivot_rows[k]);
            let known = x[k];
            if known != 0.0 {
                let last = (k + self.bandwidth).min(self.size - 1);
                for (row, value) in x.iter_mut().enumerate().take(last + 1).skip(k + 1) {
                    *value -= self.rows[self.at(row, k)] * known;
                }
            }
        }
        // Backward substitution with U.
        for k in (0..self.size).rev() {
            let end = (k + 2 * self.bandwidth).min(self.size - 1);
            for column in k + 1..=end {
                x[k] -= self.rows[self.at(k, column)] * x[column];
            }
            x[k] /= self.rows[self.at(k, k)];
        }
        x
    }
}

/// Numbers the blocks so that blocks that touch have similar numbers, which keeps the bandwidth small. Returns the
/// number of each block, and the largest difference between the numbers of two blocks that touch.
pub(super) fn order(program: &Program) -> (Vec<usize>, usize) {
    // Build the graph whose edges connect blocks that touch.
    let mut neighbours = vec![Vec::new(); program.blocks];
    let pairs = || {
        let pair = |c: &crate::mechanics::program::ContactTerm| Some((c.on.0, c.from.as_ref()?.0));
        program.contacts.iter().filter_map(pair)
    };
    for (a, b) in pairs() {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut place = vec![usize::MAX; program.blocks];
    let mut next = 0;
    // Breadth-first search, in which blocks with few neighbours come first. It starts from a peripheral block: the last
    // block that an earlier search reaches.
    let breadth_first = |from: usize, place: &[usize]| {
        let mut list = vec![from];
        let mut seen: Vec<bool> = place.iter().map(|p| *p != usize::MAX).collect();
        seen[from] = true;
        let mut k = 0;
        while k < list.len() {
            let mut next_blocks: Vec<usize> = neighbours[list[k]].clone();
            next_blocks.sort_by_key(|b| (neighbours[*b].len(), *b));
            for block in next_blocks {
                if !seen[block] {
                    seen[block] = true;
                    list.push(block);
                }
            }
            k += 1;
        }
        list
    };
    for block in 0..program.blocks {
        if place[block] != usize::MAX {
            continue;
        }
        // Number one connected part of the structure after the other.
        let farthest = breadth_first(block, &place).last().copied().unwrap_or(block);
        for found in breadth_first(farthest, &place) {
            place[found] = next;
            next += 1;
        }
    }
    let apart = pairs().map(|(a, b)| place[a].abs_diff(place[b])).max();
    (place, apart.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_is_solved_with_row_exchanges() {
        // [0 2 0; 3 0 1; 0 4 5] x = [4, 6, 23], x = (1, 2, 3).
        let mut band = Band::new(3, 1);
        for (row, column, value) in [(0, 1, 2.0), (1, 0, 3.0), (1, 2, 1.0), (2, 1, 4.0), (2, 2, 5.0)] {
            band.add(row, column, value);
        }
        let x = band.factor().solve(&[4.0, 6.0, 23.0]);
        for (found, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{x:?}");
        }
    }
}
