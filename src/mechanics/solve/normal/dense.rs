//! Dense matrix routines of the factorization: the Cholesky factor of the columns of a supernode, and the update matrix
//! of the supernode.
//!
//! The method is a right-looking blocked Cholesky factorization (Golub and Van Loan, Matrix Computations, section
//! 4.2). Rows are packed in groups of four, so that a product of four by four numbers is sixteen independent sums,
//! which the compiler keeps in vector registers.
//!
//! [`BlockDiagonal`]: a symmetric matrix that couples only columns of the same contact, and the Cholesky factors of its
//! blocks.

use std::ops::Range;

use crate::mechanics::program::QuadraticProgram;

/// A pivot up to this fraction of the diagonal entry before elimination counts as rounding. Its column is set to zero,
/// so that the unknown becomes 0: nothing holds the body in that direction.
///
/// It is several hundred times the relative rounding of an f64. If it were ten times larger, weak but real supports
/// would be dropped; if it were ten times smaller, the rounding of a sum of many terms would count as a support and
/// make the unknown very large.
const PIVOT_TOL: f64 = 1e-13;

/// The number of columns that are factored one by one before all columns to their right are updated together.
const BLOCK_COLUMNS: usize = 16;

/// Some rows of a matrix, packed in groups of four: entry k of group g, at g·columns + k, holds column k of its four
/// rows.
#[derive(Default)]
pub(super) struct PackedRows {
    entries: Vec<[f64; 4]>,
    columns: usize,
    rows: usize,
}

impl PackedRows {
    /// Packs the rows of a matrix from row `from` to the last one. The matrix is stored as columns of `height` rows
    /// each.
    pub fn pack(&mut self, columns: &[f64], height: usize, from: usize) {
        self.columns = columns.len() / height;
        self.rows = height - from;
        self.entries.clear();
        let groups = self.rows.div_ceil(4);
        self.entries.resize(groups * self.columns, [0.0; 4]);
        for (k, column) in columns.chunks_exact(height).enumerate() {
            for (group, rows) in column[from..].chunks(4).enumerate() {
                self.entries[group * self.columns + k][..rows.len()].copy_from_slice(rows);
            }
        }
    }

    /// Subtracts R·Rᵀ from the first `columns` columns of a lower triangle, where R is the matrix of the packed rows: a
    /// symmetric update of rank `self.columns`.
    ///
    /// Row r of column c of the triangle is at `begin(c)` + r in `target`.
    pub fn subtract_gram(&self, target: &mut [f64], columns: usize, begin: impl Fn(usize) -> usize) {
        let groups = || self.entries.chunks_exact(self.columns).enumerate();
        for (g, left) in groups().take(columns.div_ceil(4)) {
            let c = 4 * g;
            let wide = 4.min(columns - c);
            for (h, right) in groups().skip(g) {
                let r = 4 * h;
                let sums = products(left, right);
                // Whether all four entries lie inside the triangle. This is not the case on the diagonal and in the
                // last rows.
                let whole = h > g && r + 4 <= self.rows;
                for (i, sums) in sums.iter().enumerate().take(wide) {
                    let at = begin(c + i) + r;
                    match target.get_mut(at..).and_then(|t| t.first_chunk_mut::<4>()) {
                        Some(target) if whole => {
                            for (v, sum) in target.iter_mut().zip(sums) {
                                *v -= sum;
                            }
                        }
                        _ => {
                            let is_inside = |j: &usize| r + j < self.rows && r + j >= c + i;
                            for j in (0..4).filter(is_inside) {
                                target[at + j] -= sums[j];
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the dot products of four rows with four rows: entry (i, j) is Σ leftᵢ·rightⱼ over the columns.
fn products(left: &[[f64; 4]], right: &[[f64; 4]]) -> [[f64; 4]; 4] {
    let mut sums = [[0.0; 4]; 4];
    for (a, b) in left.iter().zip(right) {
        for i in 0..4 {
            for j in 0..4 {
                sums[i][j] += a[i] * b[j];
            }
        }
    }
    sums
}

/// Replaces the first `width` columns of a front, of `height` rows each, by those of its Cholesky factor.
///
/// Each diagonal entry becomes 1/L(k, k), the inverse of the square root of the pivot. If a pivot is lost to rounding,
/// its whole column becomes 0.
pub(super) fn factor_columns(values: &mut [f64], height: usize, width: usize, packed: &mut PackedRows) {
    // The diagonal before elimination; the pivots are compared with it.
    let diagonal: Vec<f64> = (0..width).map(|k| values[k * height + k]).collect();
    let mut begin = 0;
    while begin < width {
        let end = (begin + BLOCK_COLUMNS).min(width);
        for k in begin..end {
            // Subtract the earlier columns of this block. The columns of earlier blocks were subtracted before.
            let (left, right) = values.split_at_mut(k * height);
            let column = &mut right[k..height];
            for source in left.chunks_exact(height).skip(begin) {
                let by = source[k];
                for (v, l) in column.iter_mut().zip(&source[k..]) {
                    *v -= by * l;
                }
            }
            // Scale the column by the pivot, or drop it if the pivot is lost to rounding.
            let pivot = column[0];
            if pivot > PIVOT_TOL * diagonal[k] {
                let scale = 1.0 / pivot.sqrt();
                column[0] = scale;
                column[1..].iter_mut().for_each(|v| *v *= scale);
            } else {
                column.fill(0.0);
            }
        }
        // Update all columns to the right of the block at once.
        if end < width {
            let (done, rest) = values.split_at_mut(end * height);
            packed.pack(&done[begin * height..], height, end);
            packed.subtract_gram(rest, width - end, |c| c * height + end);
        }
        begin = end;
    }
}

/// Returns the dot product of two lists of equal length, summed in four parts.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (fours, others) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest = fours.remainder().iter().zip(others.remainder());
    let rest = rest.fold(0.0, |sum, (a, b)| sum + a * b);
    for (a, b) in fours.zip(others) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Returns the largest absolute value in a list, 0 for an empty list.
pub(super) fn max_norm(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// The largest number of columns in a block. A contact has three columns at each of its two application points.
pub(super) const MAX_BLOCK_COLUMNS: usize = 6;

/// A symmetric block-diagonal matrix.
pub(super) struct BlockDiagonal {
    /// The columns of each block.
    pub blocks: Vec<Range<usize>>,
    /// A full square matrix for each block, row by row.
    pub entries: Vec<f64>,
    /// The index in `entries` at which the matrix of each block begins, followed by the end of the last one.
    begin: Vec<usize>,
}

impl BlockDiagonal {
    /// Builds the matrix of a problem's quadratic objective; `None` if one of its blocks has more than
    /// [`MAX_BLOCK_COLUMNS`] columns.
    pub fn quadratic_of(problem: &QuadraticProgram) -> Option<BlockDiagonal> {
        let blocks = blocks(problem);
        if blocks.iter().any(|block| block.len() > MAX_BLOCK_COLUMNS) {
            return None;
        }
        // Store the square matrices of the blocks one after the other.
        let mut begin = vec![0];
        let mut block_of = vec![0; problem.unknowns];
        for (k, block) in blocks.iter().enumerate() {
            block_of[block.clone()].fill(k);
            begin.push(begin[k] + block.len() * block.len());
        }
        let mut entries = vec![0.0; begin[blocks.len()]];
        for (i, j, value) in &problem.quadratic {
            let k = block_of[*i];
            // The problem stores only the upper triangle; fill both triangles.
            let (start, width) = (blocks[k].start, blocks[k].len());
            entries[begin[k] + (i - start) * width + (j - start)] += value;
            if i != j {
                entries[begin[k] + (j - start) * width + (i - start)] += value;
            }
        }
        Some(BlockDiagonal { blocks, entries, begin })
    }

    /// Returns the range of the matrix of block `k` in [`Self::entries`].
    pub fn range(&self, k: usize) -> Range<usize> {
        self.begin[k]..self.begin[k + 1]
    }

    /// Writes P·x into `product`, where P is this matrix.
    pub fn multiply(&self, x: &[f64], product: &mut [f64]) {
        for (k, block) in self.blocks.iter().enumerate() {
            let rows = self.entries[self.range(k)].chunks_exact(block.len());
            for (to, row) in product[block.clone()].iter_mut().zip(rows) {
                *to = row.iter().zip(&x[block.clone()]).map(|(p, x)| p * x).sum();
            }
        }
    }
}

/// Divides the columns into as many consecutive blocks as possible, so that no entry of the quadratic objective couples
/// two blocks.
fn blocks(problem: &QuadraticProgram) -> Vec<Range<usize>> {
    let n = problem.unknowns;
    // For each column, find the first column with which it is coupled, or the column itself if it is not coupled with
    // an earlier one.
    let mut first: Vec<usize> = (0..n).collect();
    for (i, j, _) in &problem.quadratic {
        first[*j] = first[*j].min(*i);
    }
    // Go through the columns backwards. A block begins at column j if no column from j on is coupled with a column
    // before j.
    let (mut starts, mut low) = (Vec::new(), n);
    for j in (0..n).rev() {
        low = low.min(first[j]);
        if low == j {
            starts.push(j);
            low = n;
        }
    }
    starts.reverse();
    let ends = starts.iter().skip(1).copied().chain([n]);
    starts.iter().zip(ends).map(|(a, b)| *a..b).collect()
}

/// Replaces the lower triangle of a small positive definite matrix, stored row by row, by its Cholesky factor L.
pub(super) fn cholesky_in_place(matrix: &mut [f64], width: usize) {
    for i in 0..width {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| matrix[i * width + k] * matrix[j * width + k]).sum();
            let rest = matrix[i * width + j] - known;
            matrix[i * width + j] =
                if i == j { rest.max(f64::MIN_POSITIVE).sqrt() } else { rest / matrix[j * width + j] };
        }
    }
}

/// Replaces `list` by L⁻¹·list. `lower` is L, stored row by row.
pub(super) fn forward_substitute(lower: &[f64], width: usize, list: &mut [f64]) {
    for i in 0..width {
        let known: f64 = (0..i).map(|k| lower[i * width + k] * list[k]).sum();
        list[i] = (list[i] - known) / lower[i * width + i];
    }
}

/// Replaces `list` by L⁻ᵀ·list. `lower` is L, stored row by row.
pub(super) fn backward_substitute(lower: &[f64], width: usize, list: &mut [f64]) {
    for i in (0..width).rev() {
        let known: f64 = (i + 1..width).map(|k| lower[k * width + i] * list[k]).sum();
        list[i] = (list[i] - known) / lower[i * width + i];
    }
}
