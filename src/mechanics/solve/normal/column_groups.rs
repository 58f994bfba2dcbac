//! [`ColumnGroups`]: the sparse columns of the linear program, grouped into small dense matrices.
//!
//! A column is one force. The columns of one contact are consecutive and have entries in the balance of the same two
//! bodies. They are stored as one dense matrix, a group, so that the row indices are looked up once for all columns of
//! the group. Most groups have 3 rows (a body and the ground) or 6 (two bodies); loops over these have a width known at
//! compile time.

use std::ops::Range;

/// The columns of the program, each with a few entries. Rows are the unknowns of the normal equations (velocities).
#[derive(Clone, Debug)]
pub(super) struct ColumnGroups {
    unknowns: usize,
    groups: Vec<GroupRange>,
    /// Row indices of all groups.
    rows: Vec<u32>,
    /// Entries of all groups.
    values: Vec<f64>,
}

/// The ranges of the common lists that belong to one group.
#[derive(Clone, Debug)]
struct GroupRange {
    columns: Range<usize>,
    rows: Range<usize>,
    values: Range<usize>,
}

/// Consecutive columns with entries in the same rows: a dense matrix of `rows.len()` rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct ColumnGroup<'a> {
    /// The index of its first column.
    pub first: usize,
    /// Row indices, increasing.
    pub rows: &'a [u32],
    /// The entries, column by column: one for each row, zeros included.
    pub values: &'a [f64],
}

impl ColumnGroups {
    /// Builds the columns from (column, row, value) entries, where each body owns three consecutive rows.
    ///
    /// A column joins the previous group in two cases: the group contains all bodies of the column, or the column
    /// contains all bodies of the group.
    pub fn new(
        unknowns: usize,
        columns: usize,
        entries: impl Iterator<Item = (usize, usize, f64)> + Clone,
    ) -> ColumnGroups {
        let sparse = SparseColumns::new(columns, entries);
        let mut groups: Vec<Range<usize>> = Vec::new();
        let (mut bodies, mut own): (Vec<u32>, Vec<u32>) = Default::default();
        for k in 0..columns {
            // Find the bodies that the column acts on.
            own.clear();
            own.extend(sparse.entries(k).map(|(row, _)| row / 3));
            let is_subset = |a: &[u32], b: &[u32]| a.iter().all(|body| b.contains(body));
            let (no_new_body, covers_group) = (is_subset(&own, &bodies), is_subset(&bodies, &own));
            match groups.last_mut() {
                Some(group) if no_new_body || covers_group => group.end = k + 1,
                _ => groups.push(k..k + 1),
            }
            if !no_new_body {
                std::mem::swap(&mut bodies, &mut own);
            }
        }
        sparse.grouped(unknowns, &groups)
    }

    /// Builds the columns from (column, row, value) entries. `groups` contains the range of columns of each group.
    pub fn with_groups(
        unknowns: usize,
        groups: &[Range<usize>],
        entries: impl Iterator<Item = (usize, usize, f64)> + Clone,
    ) -> ColumnGroups {
        let columns = groups.last().map_or(0, |group| group.end);
        SparseColumns::new(columns, entries).grouped(unknowns, groups)
    }

    /// Returns the number of rows, which are the unknowns of the normal equations.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Returns the number of columns.
    pub fn column_count(&self) -> usize {
        self.groups.last().map_or(0, |group| group.columns.end)
    }

    /// Returns the number of groups.
    pub fn group_count(&self) -> usize {
        self.groups.len()
    }

    /// Returns group k.
    pub fn group(&self, k: usize) -> ColumnGroup<'_> {
        let range = &self.groups[k];
        ColumnGroup {
            first: range.columns.start,
            rows: &self.rows[range.rows.clone()],
            values: &self.values[range.values.clone()],
        }
    }

    /// Returns the entries of group k, column by column, as a mutable slice.
    pub fn values_mut(&mut self, k: usize) -> &mut [f64] {
        &mut self.values[self.groups[k].values.clone()]
    }

    /// Returns the largest number of rows in a group.
    pub fn max_entries(&self) -> usize {
        let sizes = self.groups.iter().map(|group| group.rows.len());
        sizes.max().unwrap_or(0)
    }

    /// Permutes the rows: row k becomes row `position[k]`.
    pub fn permute_rows(&mut self, position: &[u32]) {
        // The pairs (new row, former index in the group), sorted by the new row.
        let mut order: Vec<(u32, usize)> = Vec::new();
        let mut former: Vec<f64> = Vec::new();
        for group in &self.groups {
            let rows = &mut self.rows[group.rows.clone()];
            order.clear();
            let moved = rows.iter().enumerate();
            order.extend(moved.map(|(k, row)| (position[*row as usize], k)));
            order.sort_unstable();
            for (row, (new, _)) in rows.iter_mut().zip(&order) {
                *row = *new;
            }
            let columns = self.values[group.values.clone()].chunks_exact_mut(order.len().max(1));
            for column in columns {
                former.clear();
                former.extend_from_slice(column);
                for (entry, (_, k)) in column.iter_mut().zip(&order) {
                    *entry = former[*k];
                }
            }
        }
    }

    /// Adds A·amounts to `sum`. `amounts` has one number for each column, `sum` has one number for each row.
    pub fn add_product(&self, amounts: &[f64], sum: &mut [f64]) {
        for (k, range) in self.groups.iter().enumerate() {
            let group = self.group(k);
            let amounts = &amounts[range.columns.clone()];
            match group.rows.len() {
                3 => group.add_product::<3>(amounts, sum),
                6 => group.add_product::<6>(amounts, sum),
                0 => {}
                width => {
                    for (column, amount) in group.values.chunks_exact(width).zip(amounts) {
                        for (row, value) in group.rows.iter().zip(column) {
                            sum[*row as usize] += value * amount;
                        }
                    }
                }
            }
        }
    }

    /// Writes Aᵀy into `products`, one number for each column.
    pub fn transpose_product(&self, y: &[f64], products: &mut [f64]) {
        for (k, range) in self.groups.iter().enumerate() {
            let group = self.group(k);
            let products = &mut products[range.columns.clone()];
            match group.rows.len() {
                3 => group.transpose_product::<3>(y, products),
                6 => group.transpose_product::<6>(y, products),
                0 => products.fill(0.0),
                width => {
                    for (column, product) in group.values.chunks_exact(width).zip(products) {
                        let entries = group.rows.iter().zip(column);
                        *product = entries.fold(0.0, |sum, (row, value)| sum + value * y[*row as usize]);
                    }
                }
            }
        }
    }
}

impl ColumnGroup<'_> {
    fn add_product<const W: usize>(&self, amounts: &[f64], sum: &mut [f64]) {
        let mut own = [0.0; W];
        for (column, amount) in self.values.as_chunks::<W>().0.iter().zip(amounts) {
            for (own, value) in own.iter_mut().zip(column) {
                *own += value * amount;
            }
        }
        for (row, own) in self.rows.iter().zip(own) {
            sum[*row as usize] += own;
        }
    }

    fn transpose_product<const W: usize>(&self, y: &[f64], products: &mut [f64]) {
        let mut own = [0.0; W];
        for (own, row) in own.iter_mut().zip(self.rows) {
            *own = y[*row as usize];
        }
        for (column, product) in self.values.as_chunks::<W>().0.iter().zip(products) {
            *product = column.iter().zip(&own).map(|(value, y)| value * y).sum();
        }
    }

    /// Computes the group's part of A·W·Aᵀ, Σ weight·column·columnᵀ, with one weight for each column of the program,
    /// and writes it into `sums`.
    ///
    /// The result is a full symmetric matrix: entry (i, j) is at j·width + i.
    pub fn weighted_gram(&self, weights: &[f64], sums: &mut Vec<f64>) {
        let width = self.rows.len();
        sums.clear();
        match width {
            3 => sums.extend_from_slice(self.weighted_gram_of::<3>(weights).as_flattened()),
            6 => sums.extend_from_slice(self.weighted_gram_of::<6>(weights).as_flattened()),
            0 => {}
            _ => {
                sums.resize(width * width, 0.0);
                let columns = self.values.chunks_exact(width);
                for (column, weight) in columns.zip(&weights[self.first..]) {
                    for (sums, value) in sums.chunks_exact_mut(width).zip(column) {
                        let by = weight * value;
                        for (sum, value) in sums.iter_mut().zip(column) {
                            *sum += by * value;
                        }
                    }
                }
            }
        }
    }

    fn weighted_gram_of<const W: usize>(&self, weights: &[f64]) -> [[f64; W]; W] {
        let mut sums = [[0.0; W]; W];
        let columns = self.values.as_chunks::<W>().0.iter();
        for (column, weight) in columns.zip(&weights[self.first..]) {
            for (sums, value) in sums.iter_mut().zip(column) {
                let by = weight * value;
                for (sum, value) in sums.iter_mut().zip(column) {
                    *sum += by * value;
                }
            }
        }
        sums
    }
}

/// Columns in compressed sparse form.
struct SparseColumns {
    /// Column k owns entries `start[k]..start[k + 1]`.
    start: Vec<usize>,
    /// (row, value)
    entries: Vec<(u32, f64)>,
}

impl SparseColumns {
    fn new(columns: usize, entries: impl Iterator<Item = (usize, usize, f64)> + Clone) -> SparseColumns {
        let mut start = vec![0; columns + 1];
        for (column, _, _) in entries.clone() {
            start[column + 1] += 1;
        }
        for k in 0..columns {
            start[k + 1] += start[k];
        }
        // Counting sort: place the entries of each column one after the other.
        let mut next = start.clone();
        let mut list = vec![(0, 0.0); start[columns]];
        for (column, row, value) in entries {
            list[next[column]] = (row as u32, value);
            next[column] += 1;
        }
        SparseColumns { start, entries: list }
    }

    fn entries(&self, k: usize) -> impl Iterator<Item = (u32, f64)> {
        self.entries[self.start[k]..self.start[k + 1]].iter().copied()
    }

    /// Gathers columns into groups. A group has all rows in which its columns have entries. Entries with the same row
    /// and column are added up.
    fn grouped(&self, unknowns: usize, groups: &[Range<usize>]) -> ColumnGroups {
        let mut grouped = ColumnGroups {
            unknowns,
            groups: Vec::new(),
            rows: Vec::new(),
            values: Vec::with_capacity(self.entries.len()),
        };
        let mut rows: Vec<u32> = Vec::new();
        for columns in groups {
            // The rows of the group are all rows of its columns, sorted and without duplicates.
            rows.clear();
            let entries = columns.clone().flat_map(|k| self.entries(k));
            rows.extend(entries.map(|(row, _)| row));
            rows.sort_unstable();
            rows.dedup();
            let (first_row, first_value) = (grouped.rows.len(), grouped.values.len());
            for k in columns.clone() {
                let begin = grouped.values.len();
                grouped.values.resize(begin + rows.len(), 0.0);
                for (row, value) in self.entries(k) {
                    if let Ok(at) = rows.binary_search(&row) {
                        grouped.values[begin + at] += value;
                    }
                }
            }
            grouped.rows.extend_from_slice(&rows);
            grouped.groups.push(GroupRange {
                columns: columns.clone(),
                rows: first_row..grouped.rows.len(),
                values: first_value..grouped.values.len(),
            });
        }
        grouped
    }
}
