//! Dense parts of a factor: Cholesky's columns, and products taken from a lower triangle.
//!
//! Four rows stand side by side in the packed form, so that one product of four by four numbers is sixteen independent
//! sums, which the compiler keeps in registers.

/// A pivot that is less than this part of what stood there before has been lost to rounding.
const LOST: f64 = 1e-13;

/// Columns factored one by one before what follows them is changed.
const STEP: usize = 16;

/// Rows of some columns, four rows side by side: entry k of group g stands at g·columns + k.
#[derive(Default)]
pub(super) struct Packed {
    entries: Vec<[f64; 4]>,
    columns: usize,
    rows: usize,
}

impl Packed {
    /// The rows from `from` on of columns of `height` rows.
    pub fn fill(&mut self, columns: &[f64], height: usize, from: usize) {
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

    /// Takes rows·rowsᵀ from the first `columns` columns of a lower triangle, of which row r of column c stands at
    /// `begin(c)` + r.
    pub fn take_from(&self, target: &mut [f64], columns: usize, begin: impl Fn(usize) -> usize) {
        let groups = || self.entries.chunks_exact(self.columns).enumerate();
        for (g, left) in groups().take(columns.div_ceil(4)) {
            let c = 4 * g;
            let wide = 4.min(columns - c);
            for (h, right) in groups().skip(g) {
                let r = 4 * h;
                let sums = products(left, right);
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
                            let within = |j: &usize| r + j < self.rows && r + j >= c + i;
                            for j in (0..4).filter(within) {
                                target[at + j] -= sums[j];
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Σ leftᵢ·rightⱼ of four rows with four rows.
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

/// Factors the first `width` columns, of `height` rows each, in place; what stands on the diagonal becomes 1/pivot, and 0
/// with all its column where the pivot is lost.
pub(super) fn factor(values: &mut [f64], height: usize, width: usize, packed: &mut Packed) {
    let before: Vec<f64> = (0..width).map(|k| values[k * height + k]).collect();
    let mut begin = 0;
    while begin < width {
        let end = (begin + STEP).min(width);
        for k in begin..end {
            let (left, right) = values.split_at_mut(k * height);
            let column = &mut right[k..height];
            for source in left.chunks_exact(height).skip(begin) {
                let by = source[k];
                for (v, l) in column.iter_mut().zip(&source[k..]) {
                    *v -= by * l;
                }
            }
            let pivot = column[0];
            if pivot > LOST * before[k] {
                let scale = 1.0 / pivot.sqrt();
                column[0] = scale;
                column[1..].iter_mut().for_each(|v| *v *= scale);
            } else {
                column.fill(0.0);
            }
        }
        if end < width {
            let (done, rest) = values.split_at_mut(end * height);
            packed.fill(&done[begin * height..], height, end);
            packed.take_from(rest, width - end, |c| c * height + end);
        }
        begin = end;
    }
}

/// A sum of products, in four parts.
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
