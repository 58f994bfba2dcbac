//! [`Cholesky`]: the sparse factorization A·W·Aᵀ + diagonal·I = L·Lᵀ, where A·W·Aᵀ is Σ weight·column·columnᵀ. The
//! factor L is computed supernode by supernode; a supernode is a group of consecutive columns of L with the same rows
//! below them.
//!
//! This is the multifrontal method (Duff and Reid 1983; Liu 1992). Steps for each supernode, in postorder of the
//! elimination tree:
//!
//! 1. assemble its frontal matrix: the sum of weight·column·columnᵀ over the columns of A whose first unknown it
//!    eliminates, and the update matrices of its children from the stack (extend-add);
//! 2. factor its own columns;
//! 3. push its own update matrix, the rest of the frontal matrix in the rows below, onto the stack.
//!
//! A·W·Aᵀ itself is never assembled as a whole.

use super::column_groups::ColumnGroups;
use super::dense::{PackedRows, dot, factor_columns};
use super::supernodes::{Supernode, Supernodes};

/// A Cholesky factor with its symbolic analysis, so that it can be computed again with other weights.
pub(super) struct Cholesky {
    supernodes: Supernodes,
    /// The index in `values` at which each supernode begins. Its values are stored column by column; each column has
    /// the supernode's own rows, then the rows below.
    begin: Vec<usize>,
    values: Vec<f64>,
    /// For each supernode, the groups of columns of A whose first unknown it eliminates.
    assembled_groups: Vec<Vec<u32>>,
    workspace: Workspace,
}

/// Buffers that are reused by every factorization.
#[derive(Default)]
struct Workspace {
    /// The local row of each position in the current front.
    local: Vec<u32>,
    /// Update matrices (contribution blocks), packed lower triangles; a stack.
    update_stack: Vec<f64>,
    /// The weighted Gram matrix of one group of columns.
    gram: Vec<f64>,
    /// Rows of a child that are also consecutive in its parent's front.
    runs: Vec<RowRun>,
    packed: PackedRows,
}

/// Returns the index at which row 0 of column c would be in a packed lower triangle of `rows` rows. The entry in row r
/// ≥ c is at this index + r.
fn packed_begin(rows: usize, c: usize) -> usize {
    c * rows - c * (c + 1) / 2
}

/// Returns the number of entries in a packed lower triangle of `rows` rows.
fn packed_size(rows: usize) -> usize {
    rows * (rows + 1) / 2
}

impl Cholesky {
    /// Symbolic analysis: finds the order of elimination and permutes the rows of `columns` into this order. `None` if
    /// no order is found.
    pub fn new(columns: &mut ColumnGroups) -> Option<Cholesky> {
        // Find the order of elimination and the rows of each supernode.
        let supernodes = Supernodes::new(columns)?;
        columns.permute_rows(&supernodes.position);
        let mut begin = vec![0];
        let mut supernode_of = vec![0; columns.unknowns()];
        for (k, node) in supernodes.list.iter().enumerate() {
            supernode_of[node.first..node.first + node.width].fill(k);
            begin.push(begin[k] + node.width * (node.width + node.rows.len()));
        }
        // Each group of columns is assembled into the supernode that eliminates its first row.
        let mut assembled_groups = vec![Vec::new(); supernodes.list.len()];
        for k in 0..columns.group_count() {
            if let Some(first) = columns.group(k).rows.first() {
                assembled_groups[supernode_of[*first as usize]].push(k as u32);
            }
        }
        let values = vec![0.0; begin[supernodes.list.len()]];
        let workspace = Workspace { local: vec![0; columns.unknowns()], ..Workspace::default() };
        Some(Cholesky { supernodes, begin, values, assembled_groups, workspace })
    }

    /// Returns the number of multiplications and additions of one factorization.
    pub fn operations(&self) -> f64 {
        let of = |node: &Supernode| {
            let (w, m) = (node.width as f64, node.rows.len() as f64);
            w * m * m + w * w * m + w * w * w / 3.0
        };
        self.supernodes.list.iter().map(of).sum()
    }

    /// Permutes a list from the order of the program's unknowns into the order of elimination.
    pub fn to_elimination_order(&self, list: &[f64]) -> Vec<f64> {
        let mut ordered = vec![0.0; list.len()];
        for (value, position) in list.iter().zip(&self.supernodes.position) {
            ordered[*position as usize] = *value;
        }
        ordered
    }

    /// Permutes a list from the order of elimination back into the order of the program's unknowns.
    pub fn to_program_order(&self, list: &[f64]) -> Vec<f64> {
        let positions = self.supernodes.position.iter();
        positions.map(|position| list[*position as usize]).collect()
    }

    /// Computes the Cholesky factor of A·W·Aᵀ + diagonal·I. `weights` is the diagonal of W, one weight for each column
    /// of A.
    pub fn factor(&mut self, columns: &ColumnGroups, weights: &[f64], diagonal: f64) {
        let Workspace { local, update_stack, gram, runs, packed } = &mut self.workspace;
        update_stack.clear();
        // The supernodes whose update matrices are on the stack.
        let mut on_stack: Vec<usize> = Vec::new();
        for (p, node) in self.supernodes.list.iter().enumerate() {
            let rows = &self.supernodes.rows[node.rows.clone()];
            let (width, below) = (node.width, rows.len());
            let height = width + below;
            let values = &mut self.values[self.begin[p]..self.begin[p + 1]];
            // Step 1: assemble the frontal matrix.
            values.fill(0.0);
            for k in 0..width {
                local[node.first + k] = k as u32;
                values[k * height + k] = diagonal;
            }
            for (k, row) in rows.iter().enumerate() {
                local[*row as usize] = (width + k) as u32;
            }
            // The children's update matrices are on top of the stack. The supernode's own update matrix is assembled
            // above them, and moved to their place at the end.
            let first_child = on_stack.len() - node.children;
            let update_size = |p: &usize| packed_size(self.supernodes.list[*p].rows.len());
            let size: usize = on_stack[first_child..].iter().map(update_size).sum();
            let base = update_stack.len() - size;
            let own = update_stack.len();
            update_stack.resize(own + packed_size(below), 0.0);
            let (children, update) = update_stack.split_at_mut(own);
            let mut front = Front { width, height, values, update };
            for k in &self.assembled_groups[p] {
                let group = columns.group(*k as usize);
                group.weighted_gram(weights, gram);
                front.assemble(group.rows, gram, local);
            }
            let mut at = base;
            // Extend-add: add the update matrices of the children to the front.
            for child in on_stack.drain(first_child..) {
                let rows = &self.supernodes.rows[self.supernodes.list[child].rows.clone()];
                RowRun::find(rows, local, runs);
                let end = at + packed_size(rows.len());
                front.extend_add(rows.len(), &children[at..end], runs);
                at = end;
            }
            // Step 2: factor the supernode's own columns.
            factor_columns(front.values, height, width, packed);
            // Step 3: the update matrix is the lower right part of the front minus L₂₁·L₂₁ᵀ.
            if below > 0 {
                packed.pack(front.values, height, width);
                packed.subtract_gram(front.update, below, |c| packed_begin(below, c));
                on_stack.push(p);
            }
            update_stack.copy_within(own.., base);
            update_stack.truncate(base + packed_size(below));
        }
    }

    /// Solves L·Lᵀ·x = b for N right-hand sides at once. `x` contains b at the start and the solution at the end, both
    /// in the order of elimination.
    pub fn solve<const N: usize>(&self, x: &mut [[f64; N]]) {
        self.forward(x);
        self.backward(x);
    }

    /// Solves L·x = right-hand side by forward substitution, children before parents.
    fn forward<const N: usize>(&self, x: &mut [[f64; N]]) {
        let mut sums: Vec<[f64; N]> = Vec::new();
        for (p, node) in self.supernodes.list.iter().enumerate() {
            let rows = &self.supernodes.rows[node.rows.clone()];
            let (width, height) = (node.width, node.width + rows.len());
            let values = &self.values[self.begin[p]..self.begin[p + 1]];
            sums.clear();
            sums.resize(height, [0.0; N]);
            for (k, column) in values.chunks_exact(height).enumerate() {
                let at = node.first + k;
                // `column[k]` is 1/L(k, k).
                for n in 0..N {
                    x[at][n] = (x[at][n] - sums[k][n]) * column[k];
                }
                let own = x[at];
                for (sum, l) in sums[k + 1..].iter_mut().zip(&column[k + 1..]) {
                    for n in 0..N {
                        sum[n] += l * own[n];
                    }
                }
            }
            // Scatter the supernode's contribution to the rows below.
            for (row, sum) in rows.iter().zip(&sums[width..]) {
                for n in 0..N {
                    x[*row as usize][n] -= sum[n];
                }
            }
        }
    }

    /// Solves Lᵀ·x = right-hand side by backward substitution, parents before children.
    fn backward<const N: usize>(&self, x: &mut [[f64; N]]) {
        let mut lists: [Vec<f64>; N] = std::array::from_fn(|_| Vec::new());
        for (p, node) in self.supernodes.list.iter().enumerate().rev() {
            let rows = &self.supernodes.rows[node.rows.clone()];
            let (width, height) = (node.width, node.width + rows.len());
            let values = &self.values[self.begin[p]..self.begin[p + 1]];
            // Gather the right-hand sides of the supernode, and the solved values of the rows below.
            for (n, list) in lists.iter_mut().enumerate() {
                list.clear();
                list.extend(x[node.first..node.first + width].iter().map(|x| x[n]));
                list.extend(rows.iter().map(|row| x[*row as usize][n]));
            }
            for (k, column) in values.chunks_exact(height).enumerate().rev() {
                for (n, list) in lists.iter_mut().enumerate() {
                    let sum = dot(&list[k + 1..], &column[k + 1..]);
                    list[k] = (list[k] - sum) * column[k];
                    x[node.first + k][n] = list[k];
                }
            }
        }
    }
}

/// Rows of a child's update matrix that are consecutive in its parent's front too.
struct RowRun {
    /// The child's row at which the run begins.
    from: usize,
    /// The child's row after the run.
    end: usize,
    /// The local row in the parent's front at which the run begins.
    to: usize,
}

impl RowRun {
    /// Splits the rows of a child's update matrix into runs that are consecutive in the parent's front too. `local`
    /// maps each row of L to its row in that front.
    fn find(rows: &[u32], local: &[u32], runs: &mut Vec<RowRun>) {
        runs.clear();
        for (k, row) in rows.iter().enumerate() {
            let to = local[*row as usize] as usize;
            match runs.last_mut() {
                Some(run) if run.to + (k - run.from) == to => run.end = k + 1,
                _ => runs.push(RowRun { from: k, end: k + 1, to }),
            }
        }
    }
}

/// The frontal matrix of one supernode, a lower triangle: its own columns, and the update matrix for its parent.
struct Front<'a> {
    width: usize,
    height: usize,
    values: &'a mut [f64],
    update: &'a mut [f64],
}

impl Front<'_> {
    /// Adds `gram` to the front: the weighted Gram matrix of a group of columns, which have entries in `rows`. `local`
    /// maps each row of L to its row in the front.
    fn assemble(&mut self, rows: &[u32], gram: &[f64], local: &[u32]) {
        for (i, column) in rows.iter().enumerate() {
            let mut column = self.column(local[*column as usize] as usize);
            let sums = &gram[i * rows.len()..(i + 1) * rows.len()];
            for (row, sum) in rows[i..].iter().zip(&sums[i..]) {
                column[local[*row as usize] as usize] += sum;
            }
        }
    }

    /// Extend-add: adds the update matrix of a child, a packed lower triangle of `rows` rows. `runs` maps these rows to
    /// the rows of the front.
    fn extend_add(&mut self, rows: usize, update: &[f64], runs: &[RowRun]) {
        let mut end = 0;
        for (k, run) in runs.iter().enumerate() {
            for i in run.from..run.end {
                let mut column = self.column(run.to + i - run.from);
                let begin = end;
                end += rows - i;
                let entries = &update[begin..end];
                for run in &runs[k..] {
                    let from = run.from.max(i);
                    let to = run.to + from - run.from;
                    column.add(to, &entries[from - i..run.end - i]);
                }
            }
        }
    }

    /// Returns column c of the front, indexed by local rows. A column of the update matrix has only the rows from the
    /// diagonal down. A column of the supernode has all rows; those above the diagonal are not used.
    fn column(&mut self, c: usize) -> FrontColumn<'_> {
        match c.checked_sub(self.width) {
            None => FrontColumn { list: &mut self.values[c * self.height..(c + 1) * self.height], first_row: 0 },
            Some(c) => {
                let rows = self.height - self.width;
                let begin = packed_begin(rows, c) + c;
                FrontColumn { list: &mut self.update[begin..begin + rows - c], first_row: self.width + c }
            }
        }
    }
}

/// The rows of a column of the front, starting at `first_row`.
struct FrontColumn<'a> {
    list: &'a mut [f64],
    first_row: usize,
}

impl FrontColumn<'_> {
    /// Adds the numbers of a list to consecutive rows of the column, starting at `row`.
    fn add(&mut self, row: usize, list: &[f64]) {
        let begin = row - self.first_row;
        for (v, w) in self.list[begin..begin + list.len()].iter_mut().zip(list) {
            *v += w;
        }
    }
}

impl std::ops::Index<usize> for FrontColumn<'_> {
    type Output = f64;

    fn index(&self, row: usize) -> &f64 {
        &self.list[row - self.first_row]
    }
}

impl std::ops::IndexMut<usize> for FrontColumn<'_> {
    fn index_mut(&mut self, row: usize) -> &mut f64 {
        &mut self.list[row - self.first_row]
    }
}
