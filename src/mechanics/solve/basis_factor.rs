//! [`BasisFactor`]: a sparse LU factor of a square matrix whose columns are chosen among given columns.
//!
//! The factor is computed by Gaussian elimination on the columns, position by position. A position is the index of a
//! row in an order with little fill-in. Steps at each position:
//!
//! 1. collect the columns whose first nonzero entry is at the position;
//! 2. choose a pivot among the columns whose entry at the position is large: a preferred column, or else the column
//!    with the fewest entries;
//! 3. subtract multiples of the pivot column from the other collected columns, which removes their entries at the
//!    position.
//!
//! A column whose entries are all eliminated depends linearly on the chosen columns. A position without a pivot gets a
//! unit column. Reference: Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, chapter 6 (threshold partial
//! pivoting).

use crate::mechanics::program::Column;

/// The nonzero entries of a column as (position, value), with ascending positions.
pub(super) type SparseColumn = Vec<(usize, f64)>;

/// An entry may be a pivot if it is at least this fraction of the largest entry at the position. With 0.01, the factor
/// could lose one more digit; with 1, it would have more entries, and preferred columns would be refused.
const PIVOT_RATIO: f64 = 0.1;

/// Smaller entries are taken for rounding errors of columns that depend linearly on earlier pivots. The entries of
/// columns are near 1, and their rounding errors are about 1e-13. With a value of 1e-12, a rounding error could become
/// a pivot; with 1e-8, columns of very short contacts would count as dependent.
const PIVOT_TOL: f64 = 1e-10;

/// The column that is the pivot at a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pivot {
    /// The given column with this index.
    Column(usize),
    /// The unit column of the position.
    Unit,
}

/// The factor of a matrix B with one column for each position.
#[derive(Clone, Debug, Default)]
pub(super) struct BasisFactor {
    /// Which column is the pivot at each position.
    pub pivots: Vec<Pivot>,
    /// For each position, the pivot column after the elimination. Its first entry is at the position.
    upper: Vec<SparseColumn>,
    /// The subtractions in their order: (position of the changed column, position of the pivot, multiple).
    steps: Vec<(usize, usize, f64)>,
    /// The columns that were replaced since the factorization: the position, and the replaced column as a combination
    /// of the columns after the replacement (product form of the inverse, Dantzig and Orchard-Hays 1954).
    replacements: Vec<(usize, SparseColumn)>,
}

impl BasisFactor {
    /// Chooses one of `columns`, or else a unit column, for each of the `positions` positions, and factors the matrix
    /// of the chosen columns. `rank` returns the rank of the column with a given index; columns with a smaller rank are
    /// preferred.
    pub fn new(mut columns: Vec<SparseColumn>, positions: usize, rank: impl Fn(usize) -> usize) -> BasisFactor {
        let mut beginning_at: Vec<Vec<usize>> = vec![Vec::new(); positions];
        for (k, column) in columns.iter().enumerate() {
            if let Some((first, _)) = column.first() {
                beginning_at[*first].push(k);
            }
        }
        let mut factor = BasisFactor::default();
        let mut position_of = vec![usize::MAX; columns.len()];
        let mut steps: Vec<(usize, usize, f64)> = Vec::new();
        let mut difference = SparseColumn::new();
        for position in 0..positions {
            // Step 1: collect the candidates. Step 2: choose the pivot. Without a pivot, use a unit column.
            let candidates = std::mem::take(&mut beginning_at[position]);
            let Some(pivot) = choose(&candidates, &columns, &rank) else {
                for k in candidates {
                    columns[k].remove(0);
                    if let Some((first, _)) = columns[k].first() {
                        beginning_at[*first].push(k);
                    }
                }
                factor.pivots.push(Pivot::Unit);
                factor.upper.push(vec![(position, 1.0)]);
                continue;
            };
            position_of[pivot] = position;
            let pivot_column = std::mem::take(&mut columns[pivot]);
            // Step 3: eliminate the entries of the other candidates at the position.
            for k in candidates.into_iter().filter(|k| *k != pivot) {
                let multiple = columns[k][0].1 / pivot_column[0].1;
                subtract(&columns[k], &pivot_column, multiple, &mut difference);
                std::mem::swap(&mut columns[k], &mut difference);
                steps.push((k, position, multiple));
                if let Some((first, _)) = columns[k].first() {
                    beginning_at[*first].push(k);
                }
            }
            factor.pivots.push(Pivot::Column(pivot));
            factor.upper.push(pivot_column);
        }
        // Keep only the subtractions that changed a chosen column.
        let chosen = steps.into_iter().map(|(k, by, multiple)| (position_of[k], by, multiple));
        factor.steps = chosen.filter(|step| step.0 != usize::MAX).collect();
        factor
    }

    /// Replaces the column at a position. `solution` is the solution of B·x = new column. Returns the number of
    /// replacements since the factorization.
    pub fn replace(&mut self, position: usize, solution: &[f64]) -> usize {
        let pivot = solution[position];
        let entries = solution.iter().enumerate().filter(|(_, v)| **v != 0.0);
        let inverse =
            entries.map(|(other, v)| if other == position { (other, 1.0 / pivot) } else { (other, -v / pivot) });
        self.replacements.push((position, inverse.collect()));
        self.replacements.len()
    }

    /// Replaces the right-hand side b by the solution of B·x = b: one entry for the column at each position.
    pub fn solve(&self, x: &mut [f64]) {
        for (position, column) in self.upper.iter().enumerate() {
            let (pivot, others) = (column[0].1, &column[1..]);
            if x[position] != 0.0 {
                x[position] /= pivot;
                let value = x[position];
                others.iter().for_each(|(other, v)| x[*other] -= v * value);
            }
        }
        for (changed, by, multiple) in self.steps.iter().rev() {
            x[*by] -= multiple * x[*changed];
        }
        for (position, column) in &self.replacements {
            let value = x[*position];
            x[*position] = 0.0;
            column.iter().for_each(|(other, v)| x[*other] += v * value);
        }
    }

    /// Replaces the right-hand side c by the solution of Bᵀ·y = c: one entry for each position.
    pub fn solve_transposed(&self, y: &mut [f64]) {
        for (position, column) in self.replacements.iter().rev() {
            y[*position] = column.iter().map(|(other, v)| v * y[*other]).sum();
        }
        for (changed, by, multiple) in &self.steps {
            y[*changed] -= multiple * y[*by];
        }
        for (position, column) in self.upper.iter().enumerate().rev() {
            let known: f64 = column[1..].iter().map(|(other, v)| v * y[*other]).sum();
            y[position] = (y[position] - known) / column[0].1;
        }
    }
}

/// Chooses the pivot among columns whose first entries are at the same position; `None` if there are no such columns,
/// or if all these entries are so small that they count as rounding errors.
fn choose(candidates: &[usize], columns: &[SparseColumn], rank: &impl Fn(usize) -> usize) -> Option<usize> {
    let size = |k: usize| columns[k][0].1.abs();
    let largest = candidates.iter().map(|k| size(*k)).fold(0.0, f64::max);
    let least = (PIVOT_RATIO * largest).max(PIVOT_TOL);
    let large = candidates.iter().copied().filter(|k| size(*k) >= least);
    large.min_by_key(|k| (rank(*k), columns[*k].len()))
}

/// Writes column − multiple·pivot to `difference`, without the first entries, which cancel.
fn subtract(column: &SparseColumn, pivot: &SparseColumn, multiple: f64, difference: &mut SparseColumn) {
    difference.clear();
    let (mut own, mut its) = (column[1..].iter().peekable(), pivot[1..].iter().peekable());
    loop {
        let at = |entry: Option<&&(usize, f64)>| entry.map_or(usize::MAX, |entry| entry.0);
        let position = at(own.peek()).min(at(its.peek()));
        if position == usize::MAX {
            return;
        }
        let next_own = own.next_if(|entry| entry.0 == position);
        let next_its = its.next_if(|entry| entry.0 == position);
        let value = next_own.map_or(0.0, |e| e.1) - multiple * next_its.map_or(0.0, |e| e.1);
        if value != 0.0 {
            difference.push((position, value));
        }
    }
}

/// Returns the position of each row of `columns` in an order of elimination with little fill-in (approximate minimum
/// degree, Amestoy, Davis and Duff 1996). The three rows of a block stay together. `None` if no order is found.
pub(super) fn elimination_order(columns: &[Column], blocks: usize) -> Option<Vec<usize>> {
    // The neighbours of each block: the blocks that share a column with it, itself included.
    let mut neighbours: Vec<Vec<i32>> = (0..blocks).map(|k| vec![k as i32]).collect();
    for column in columns {
        let of_column = || column.entries().map(|(row, _)| row / 3);
        for block in of_column() {
            neighbours[block].extend(of_column().map(|other| other as i32));
        }
    }
    let (mut starts, mut list) = (vec![0], Vec::new());
    for mut of_block in neighbours {
        of_block.sort_unstable();
        of_block.dedup();
        list.append(&mut of_block);
        starts.push(list.len() as i32);
    }
    let order = amd::order(blocks as i32, &starts, &list, &amd::Control::default());
    let mut position = vec![0; 3 * blocks];
    for (place, block) in order.ok()?.0.iter().enumerate() {
        for row in 0..3 {
            position[3 * *block as usize + row] = 3 * place + row;
        }
    }
    Some(position)
}

/// Returns the coefficients of a column as (position, value), sorted by position. `position` contains the position of
/// each row in the order of elimination.
pub(super) fn placed(column: &Column, position: &[usize]) -> SparseColumn {
    let entries = column.entries().map(|(row, value)| (position[row], value));
    let mut entries: SparseColumn = entries.collect();
    entries.sort_unstable_by_key(|entry| entry.0);
    entries
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::solve::random_numbers::RandomNumbers;

    const ROWS: usize = 30;

    /// A column with a few entries near the diagonal.
    fn column(near: usize, random: &mut RandomNumbers) -> SparseColumn {
        let rows = near.saturating_sub(2)..(near + 3).min(ROWS);
        rows.map(|row| (row, random.next())).collect()
    }

    /// The largest error of the solutions of B·x = b and Bᵀ·y = c, where the columns of B are given for each position.
    fn worst_error(factor: &BasisFactor, columns: &[SparseColumn]) -> f64 {
        let wanted: Vec<f64> = (0..ROWS).map(|k| 1.0 + 0.1 * k as f64).collect();
        let (mut x, mut y) = (vec![0.0; ROWS], vec![0.0; ROWS]);
        for (k, column) in columns.iter().enumerate() {
            for (row, value) in column {
                x[*row] += value * wanted[k];
                y[k] += value * wanted[*row];
            }
        }
        factor.solve(&mut x);
        factor.solve_transposed(&mut y);
        let both = x.iter().chain(&y).zip(wanted.iter().chain(&wanted));
        both.map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn both_systems_are_solved_also_after_columns_were_replaced() {
        let mut random = RandomNumbers(7);
        let given: Vec<SparseColumn> = (0..ROWS).map(|k| column(k, &mut random)).collect();
        let mut factor = BasisFactor::new(given.clone(), ROWS, |_| 0);
        let basic = |pivot: &Pivot| match pivot {
            Pivot::Column(k) => given[*k].clone(),
            Pivot::Unit => panic!("random columns are independent"),
        };
        let mut columns: Vec<SparseColumn> = factor.pivots.iter().map(basic).collect();
        assert!(worst_error(&factor, &columns) < 1e-9);
        for position in [3, 17, 3, 29] {
            let new = column(position, &mut random);
            let mut solution = vec![0.0; ROWS];
            new.iter().for_each(|(row, value)| solution[*row] = *value);
            factor.solve(&mut solution);
            factor.replace(position, &solution);
            columns[position] = new;
            assert!(worst_error(&factor, &columns) < 1e-8, "at {position}");
        }
    }

    #[test]
    fn preferred_columns_are_chosen_and_a_dependent_column_is_not() {
        let columns = vec![
            vec![(0, 1.0), (1, 1.0)],
            vec![(0, 1.0), (1, 1.0)],
            vec![(0, 1.0), (2, 1.0)],
            vec![(1, 1.0), (2, -1.0)],
        ];
        // Column 3 is column 1 minus column 2, and column 0 equals column 1. One row needs a unit column.
        let factor = BasisFactor::new(columns, 3, |k| if k == 0 { 1 } else { 0 });
        let units = factor.pivots.iter().filter(|pivot| **pivot == Pivot::Unit);
        assert_eq!(units.count(), 1);
        assert!(!factor.pivots.contains(&Pivot::Column(0)));
    }
}
