//! [`BlockDiagonal`]: a symmetric matrix that couples only columns of the same contact, and the Cholesky factors of its
//! blocks.

use std::ops::Range;

use crate::mechanics::program::QuadraticProgram;

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
