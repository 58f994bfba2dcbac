//! [`IncrementalCholesky`]: a Cholesky factor that is updated when a row and a column are added to the matrix or
//! removed from it.
//!
//! A row is appended by one forward substitution and removed by Givens rotations (update and downdate of a factor,
//! Golub and Van Loan, Matrix Computations, section 6.5). Rows are stored from their first nonzero entry (skyline
//! storage). In the Gram matrix of forces, two forces have a nonzero product only if they act on a common block. If the
//! columns are ordered by blocks, the work of a change grows with the width of the structure, not with the number of
//! blocks.

/// The lower triangular factor L of the matrix L·Lᵀ.
#[derive(Clone, Debug, Default)]
pub(super) struct IncrementalCholesky {
    rows: Vec<FactorRow>,
}

#[derive(Clone, Debug)]
struct FactorRow {
    /// The column of the first stored entry. The last entry is on the diagonal.
    first: usize,
    entries: Vec<f64>,
}

impl IncrementalCholesky {
    /// Replaces v by L⁻¹·v.
    pub fn forward(&self, v: &mut [f64]) {
        self.forward_from(v, 0);
    }

    /// Like [`Self::forward`], but requires that the entries of v before `begin` are 0.
    fn forward_from(&self, v: &mut [f64], begin: usize) {
        for (k, row) in self.rows.iter().enumerate().skip(begin) {
            let (before, rest) = v.split_at_mut(k);
            let (off, diagonal) = row.split_diagonal();
            let from = row.first.max(begin);
            let sum = dot(&off[from - row.first..], &before[from..]);
            rest[0] = (rest[0] - sum) / diagonal;
        }
    }

    /// Replaces v by L⁻ᵀ·v.
    pub fn backward(&self, v: &mut [f64]) {
        for (k, row) in self.rows.iter().enumerate().rev() {
            let (before, rest) = v.split_at_mut(k);
            let (off, diagonal) = row.split_diagonal();
            rest[0] /= diagonal;
            for (value, entry) in before[row.first..].iter_mut().zip(off) {
                *value -= entry * rest[0];
            }
        }
    }

    /// Appends a row and column to the matrix: `products` are the entries of the new row before the diagonal, `square`
    /// is its diagonal entry.
    ///
    /// Returns false, and appends nothing, if the new pivot is at most `min_pivot`.
    pub fn append(&mut self, mut products: Vec<f64>, square: f64, min_pivot: f64) -> bool {
        // The new row of L solves L·row = products. Leading zeros of the products stay zeros in the row.
        let first = products.iter().position(|v| *v != 0.0);
        let first = first.unwrap_or(products.len());
        self.forward_from(&mut products, first);
        let mut entries = Vec::with_capacity(products.len() + 1 - first);
        entries.extend_from_slice(&products[first..]);
        let pivot = square - dot(&entries, &entries);
        if !(pivot > min_pivot) {
            return false;
        }
        entries.push(pivot.sqrt());
        self.rows.push(FactorRow { first, entries });
        true
    }

    /// Removes row and column `index` from the factored matrix.
    ///
    /// Each later row of the factor then has one entry to the right of the diagonal. Givens rotations of adjacent
    /// columns make the factor triangular again.
    pub fn remove(&mut self, index: usize) {
        self.rows.remove(index);
        for k in index..self.rows.len() {
            let (a, b) = (self.rows[k].entry(k), self.rows[k].entry(k + 1));
            // Compute the Givens rotation that sets the entry to the right of the diagonal to 0.
            let length = libm::hypot(a, b);
            let (c, s) = (a / length, b / length);
            for row in &mut self.rows[k..] {
                row.rotate(k, c, s);
            }
            let row = &mut self.rows[k];
            row.entries.truncate(k + 1 - row.first);
        }
    }
}

impl FactorRow {
    /// Returns the entries to the left of the diagonal, and the diagonal entry.
    fn split_diagonal(&self) -> (&[f64], f64) {
        match self.entries.split_last() {
            Some((diagonal, off)) => (off, *diagonal),
            None => (&[], 1.0),
        }
    }

    /// Returns the entry in column k, or 0 if it is not stored.
    fn entry(&self, k: usize) -> f64 {
        let index = k.checked_sub(self.first);
        let entry = index.and_then(|index| self.entries.get(index));
        entry.copied().unwrap_or(0.0)
    }

    /// Applies a Givens rotation to the row: the entries x and y in columns k and k + 1 become c·x + s·y and c·y − s·x.
    fn rotate(&mut self, k: usize, c: f64, s: f64) {
        let (x, y) = (self.entry(k), self.entry(k + 1));
        if y == 0.0 && x == 0.0 {
            return;
        }
        if self.first > k {
            self.entries.insert(0, 0.0);
            self.first = k;
        }
        let index = k - self.first;
        self.entries[index] = c * x + s * y;
        self.entries[index + 1] = c * y - s * x;
    }
}

/// Returns the dot product of two lists, as four partial sums that the processor computes in parallel.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((fours, rest), (others, last)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = [0.0; 4];
    for (x, y) in fours.iter().zip(others) {
        sums[0] += x[0] * y[0];
        sums[1] += x[1] * y[1];
        sums[2] += x[2] * y[2];
        sums[3] += x[3] * y[3];
    }
    let mut sum = 0.0;
    for (x, y) in rest.iter().zip(last) {
        sum += x * y;
    }
    sum + (sums[0] + sums[1]) + (sums[2] + sums[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix of two chains that are coupled only by its last row.
    fn entry(i: usize, j: usize) -> f64 {
        match (i.max(j), i.abs_diff(j)) {
            (_, 0) => 4.0 + 0.3 * i as f64,
            (6, by) => 0.1 + 0.05 * by as f64,
            (_, 2) => 1.0,
            _ => 0.0,
        }
    }

    /// True if the factor solves A·x = v, where A consists of these rows and columns of the matrix.
    fn solves(factor: &IncrementalCholesky, kept: &[usize]) -> bool {
        let wanted: Vec<f64> = (0..kept.len()).map(|k| 1.0 - 0.4 * k as f64).collect();
        let row = |i: &usize| -> f64 {
            let terms = kept.iter().zip(&wanted);
            terms.map(|(j, x)| entry(*i, *j) * x).sum()
        };
        let mut v: Vec<f64> = kept.iter().map(row).collect();
        factor.forward(&mut v);
        factor.backward(&mut v);
        v.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn rows_can_be_added_and_removed_in_any_order() {
        let add = |factor: &mut IncrementalCholesky, kept: &mut Vec<usize>, i: usize| {
            let products = kept.iter().map(|j| entry(i, *j)).collect();
            assert!(factor.append(products, entry(i, i), 1e-9));
            kept.push(i);
            assert!(solves(factor, kept), "with {kept:?}");
        };
        for order in [[0, 3, 1], [6, 0, 0], [2, 4, 0]] {
            let (mut factor, mut kept) = (IncrementalCholesky::default(), Vec::new());
            (0..7).for_each(|i| add(&mut factor, &mut kept, i));
            for place in order {
                factor.remove(place);
                kept.remove(place);
                assert!(solves(&factor, &kept), "with {kept:?}");
            }
            let gone: Vec<usize> = (0..7).filter(|i| !kept.contains(i)).collect();
            for i in gone {
                add(&mut factor, &mut kept, i);
            }
        }
    }

    #[test]
    fn a_linearly_dependent_row_is_refused() {
        let mut factor = IncrementalCholesky::default();
        assert!(factor.append(vec![], 1.0, 1e-9));
        assert!(factor.append(vec![0.0], 1.0, 1e-9));
        assert!(!factor.append(vec![1.0, 2.0], 5.0, 1e-9));
        assert_eq!(factor.rows.len(), 2);
        assert_eq!(factor.rows[1].first, 1, "leading zeros are not stored");
    }
}
