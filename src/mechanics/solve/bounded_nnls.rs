//! [`BoundedNnls`]: solves the least-squares problem with bounds, min ½|A·x − loads|² s.t. 0 ≤ x ≤ limit.
//!
//! The residual r = loads − A·x decides whether the structure stands. If r = 0, the amounts x are forces that balance
//! the loads. Otherwise −r is a motion that no contact resists, and along which the loads do more work than robots at
//! their limits absorb. The reason: A·x is the admissible resultant nearest to the loads. Without limits, Aᵀr ≤ 0 and
//! loadsᵀr = |r|² therefore hold (Moreau's two polar cones). The right-hand side `loads` is the negative of the load
//! vector. Forces have no cost, so the method finds any forces that balance, not those of least sum. The result is only
//! a candidate: the proof checks it.
//!
//! The method is the active-set method NNLS of [LawsonHanson74](crate::doc::references), chapter 23, extended by
//! upper bounds. Steps:
//!
//! 1. compute the gradient Aᵀr: columns at a bound whose gradient points to the inside of the bounds are candidates;
//! 2. move candidates into the passive set, which contains the columns between their bounds;
//! 3. solve the least-squares problem on the passive set, by the Cholesky factor of its Gram matrix, which is updated
//!    when a column enters or leaves;
//! 4. if an amount would leave its bounds (ratio test), move only until the first amount reaches its bound, remove that
//!    column from the passive set, and repeat step 3;
//! 5. if there are no candidates, the amounts are the optimum.
//!
//! For a changed program, the search starts from the former passive set: its factor depends neither on the loads nor on
//! other columns.
//!
//! [`Search`]: the state of one search of [`BoundedNnls`], with the columns that may enter the passive set and the
//! number of times this set may still change.

use super::amounts::Amounts;
use super::incremental_cholesky::IncrementalCholesky;
use crate::mechanics::program::{Column, Force, Program, columns};

/// A column may enter the passive set if its gradient exceeds this fraction of |column|·|residual|.
///
/// The gradient of a passive column is 0 up to a rounding of about 1e-13 of that product. If the fraction were 1e-12,
/// rounding would make columns enter; if it were 1e-10, small contributions that the proof needs would be missed.
const DUAL_TOL: f64 = 1e-11;

/// A residual |r| up to this fraction of the largest load counts as 0.
///
/// It is far below what a proof requires (1e-7) and above the rounding in the amounts of a few hundred bodies. If it
/// were ten times smaller, that rounding would make columns enter and leave without end.
const RESIDUAL_TOL: f64 = 1e-12;

/// A gradient, divided by |column|, below this fraction of the largest load counts as rounding.
const GRADIENT_FLOOR: f64 = 1e-13;

/// A column counts as linearly dependent on the passive columns if the squared length of its part orthogonal to them is
/// at most this fraction of its own squared length.
///
/// At this fraction the new pivot still has about five digits. If it were ten times larger, needed columns that are
/// nearly parallel to others would be refused; if it were ten times smaller, the factor would lose one more digit.
const DEPENDENCE_TOL: f64 = 1e-11;

/// In one search, the passive set may change about this many times the number of columns.
const MAX_PIVOTS_PER_COLUMN: usize = 4;

/// The passive set of a program, and the amounts found with it.
#[derive(Clone, Debug, Default)]
pub struct BoundedNnls {
    /// The passive columns, which lie between their bounds, in the order of the factor's rows.
    passive: Vec<usize>,
    /// The amounts of the passive columns.
    amounts: Vec<f64>,
    /// The Cholesky factor of the Gram matrix of the passive columns.
    factor: IncrementalCholesky,
    /// The columns at their upper bounds.
    at_limit: Vec<usize>,
}

/// Returns the columns (unit forces) of a program, without redundant columns. At a contact with friction, the pure
/// normal force is redundant: it is a sum of the two rays of the friction cone.
pub fn generators(program: &Program) -> Vec<Column> {
    let is_redundant = |column: &Column| match column.force {
        Force::Ray { contact, friction, .. } => friction == 0.0 && program.contacts[contact].friction > 0.0,
        _ => false,
    };
    let mut list = columns(program);
    list.retain(|column| !is_redundant(column));
    list
}

impl BoundedNnls {
    /// Renumbers the columns for a changed program: column k becomes `number(k)`. It is removed if `number(k)` is
    /// `None`.
    pub fn renumber(&mut self, number: impl Fn(usize) -> Option<usize>) {
        for place in (0..self.passive.len()).rev() {
            match number(self.passive[place]) {
                Some(new) => self.passive[place] = new,
                None => self.remove_at(place),
            }
        }
        self.at_limit = self.at_limit.iter().filter_map(|k| number(*k)).collect();
    }

    /// Solves the least-squares problem, starting from the present passive set. Returns the residual loads − A·x, or
    /// `None` after too many pivots.
    ///
    /// `columns` must contain the columns of the passive set at their current indices. It may also contain new columns.
    pub fn find(&mut self, loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
        let size = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let mut search = Search::new(self, loads, columns);
        if !self.passive.is_empty() {
            // The passive set of an earlier search may already be optimal.
            self.solve_passive(&mut search, Digits::All)?;
        }
        let (mut entry, mut digits) = (Entry::Several, Digits::All);
        loop {
            // Step 1: compute the gradient and find the candidates.
            let residual = self.residual(loads, columns);
            let length = residual.iter().map(|v| v * v).sum::<f64>().sqrt();
            let is_balanced = !(length > RESIDUAL_TOL * size);
            search.find_candidates(&residual, (DUAL_TOL * length).max(GRADIENT_FLOOR * size));
            if is_balanced {
                search.candidates.clear();
            }
            if search.candidates.is_empty() {
                if entry == Entry::Several && !is_balanced {
                    // Some columns may be rejected only because they entered together with others. Clear the
                    // rejections, and let one column enter at a time.
                    entry = Entry::One;
                    search.rejected.fill(false);
                } else if digits == Digits::All {
                    return Some(residual);
                } else {
                    digits = Digits::All;
                    self.solve_passive(&mut search, digits)?;
                }
                continue;
            }
            // After half of the pivots, let only one column enter at a time. That is slower, but it cannot cycle.
            if 2 * search.pivots_left < search.max_pivots {
                entry = Entry::One;
            }
            digits = Digits::Half;
            // Step 2 moves columns into the passive set; steps 3 and 4 solve for their amounts.
            let entered = self.enter(&mut search, entry)?;
            if entered.is_empty() {
                continue;
            }
            let progress = self.solve_passive(&mut search, digits)?;
            let stays = |(k, _): &(usize, State)| search.state[*k] == State::Passive;
            if progress == Progress::Moved || entered.iter().any(stays) {
                search.rejected.fill(false);
            }
            // A column that entered and left again is rejected until the amounts change: it probably entered because of
            // rounding.
            for (k, former) in entered {
                search.rejected[k] = search.state[k] == former;
            }
        }
    }

    /// Converts the amounts of the columns to forces of contacts and grips.
    pub fn to_forces(&self, program: &Program, columns: &[Column]) -> Amounts {
        let mut amounts = Amounts::zero(program);
        for (k, amount) in self.passive.iter().zip(&self.amounts) {
            amounts.add(columns[*k].force, *amount);
        }
        for k in &self.at_limit {
            amounts.add(columns[*k].force, columns[*k].limit);
        }
        amounts
    }

    /// Returns the indices of the columns in use: the passive columns and the columns at their limits.
    pub fn used_columns(&self) -> impl Iterator<Item = usize> + '_ {
        self.passive.iter().chain(&self.at_limit).copied()
    }

    /// Moves some candidates into the passive set, unless they depend linearly on its columns. Returns the columns that
    /// entered, with their former states; `None` after too many pivots.
    fn enter(&mut self, search: &mut Search, entry: Entry) -> Option<Vec<(usize, State)>> {
        let mut entered = Vec::new();
        for k in entry.choose(&mut search.candidates, search.columns, search.loads.len()) {
            search.count_pivot()?;
            let amount = match search.state[k] {
                State::AtLimit => search.columns[k].limit,
                _ => 0.0,
            };
            if self.append(search.columns, k, amount) {
                entered.push((k, search.state[k]));
                self.at_limit.retain(|f| *f != k);
                search.state[k] = State::Passive;
            } else {
                search.rejected[k] = true;
            }
        }
        Some(entered)
    }

    /// Moves the amounts to the least-squares solution of the passive set, and removes each column whose amount
    /// reaches a bound on the way. `None` after too many pivots.
    fn solve_passive(&mut self, search: &mut Search, digits: Digits) -> Option<Progress> {
        let (loads, columns) = (search.loads, search.columns);
        let mut progress = Progress::Stayed;
        loop {
            // Step 3: solve the least-squares problem on the passive set. Step 4: do the ratio test.
            let optimum = self.least_squares(loads, columns, digits);
            let Some((step, first)) = self.ratio_test(&optimum, columns) else {
                self.amounts = optimum;
                return Some(progress);
            };
            search.count_pivot()?;
            if step > 0.0 {
                progress = Progress::Moved;
            }
            // Move to the first bound, and remove the column that reaches it.
            let meets_limit = optimum[first] > 0.0;
            for (amount, optimal) in self.amounts.iter_mut().zip(&optimum) {
                *amount += step * (optimal - *amount);
            }
            let k = self.passive[first];
            self.remove_at(first);
            search.state[k] = State::AtZero;
            if meets_limit {
                search.state[k] = State::AtLimit;
                self.at_limit.push(k);
            }
            // Other amounts may have reached 0 in the same step. Rounding must not make them negative.
            for amount in &mut self.amounts {
                *amount = amount.max(0.0);
            }
        }
    }

    /// Ratio test: returns the longest step (as a fraction) towards the optimum of the passive set that keeps all
    /// bounds. Also returns the position, in the passive set, of the column that reaches its bound first. `None` if
    /// the full step keeps all bounds.
    fn ratio_test(&self, optimum: &[f64], columns: &[Column]) -> Option<(f64, usize)> {
        let mut shortest: Option<(f64, usize)> = None;
        for (place, (amount, optimal)) in self.amounts.iter().zip(optimum).enumerate() {
            // The fraction of the step at which the amount reaches 0 or its limit.
            let limit = columns[self.passive[place]].limit;
            let step = if *optimal < 0.0 {
                amount.max(0.0) / (amount.max(0.0) - optimal)
            } else if *optimal > limit {
                (limit - amount.min(limit)) / (optimal - amount.min(limit))
            } else {
                continue;
            };
            if shortest.is_none_or(|(least, _)| step < least) {
                shortest = Some((step, place));
            }
        }
        shortest
    }

    /// Returns the amounts of the passive columns that minimise the residual if their bounds are ignored.
    ///
    /// The normal equations determine the amounts to half of the digits of f64. With [`Digits::All`], one step of
    /// iterative refinement adds the other digits.
    fn least_squares(&self, loads: &[f64], columns: &[Column], digits: Digits) -> Vec<f64> {
        let mut residual = loads.to_vec();
        for k in &self.at_limit {
            columns[*k].add_to(&mut residual, -columns[*k].limit);
        }
        let mut amounts = vec![0.0; self.passive.len()];
        let solves = match digits {
            Digits::Half => 1,
            Digits::All => 2,
        };
        for _ in 0..solves {
            let gradient = self.passive.iter().map(|k| columns[*k].dot(&residual));
            let mut change: Vec<f64> = gradient.collect();
            self.factor.forward(&mut change);
            self.factor.backward(&mut change);
            for ((amount, by), k) in amounts.iter_mut().zip(&change).zip(&self.passive) {
                *amount += by;
                columns[*k].add_to(&mut residual, -by);
            }
        }
        amounts
    }

    /// Returns the residual loads − A·x, one number for each row.
    fn residual(&self, loads: &[f64], columns: &[Column]) -> Vec<f64> {
        let mut residual = loads.to_vec();
        for (k, amount) in self.passive.iter().zip(&self.amounts) {
            columns[*k].add_to(&mut residual, -amount);
        }
        for k in &self.at_limit {
            columns[*k].add_to(&mut residual, -columns[*k].limit);
        }
        residual
    }

    /// Adds column `k` to the passive set. Returns false, and adds nothing, if the column depends linearly on the
    /// columns in the set.
    fn append(&mut self, columns: &[Column], k: usize, amount: f64) -> bool {
        // Append the column's row to the Cholesky factor of the Gram matrix.
        let new = &columns[k];
        let products = self.passive.iter().map(|u| columns[*u].dot_column(new)).collect();
        let square = new.dot_column(new);
        if !self.factor.append(products, square, DEPENDENCE_TOL * square) {
            return false;
        }
        self.passive.push(k);
        self.amounts.push(amount);
        true
    }

    /// Removes the column at position `place` of the passive set.
    fn remove_at(&mut self, place: usize) {
        self.passive.remove(place);
        self.amounts.remove(place);
        self.factor.remove(place);
    }
}

/// How precisely the least-squares problem on the passive set is solved. All digits are needed only when no
/// candidates are left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Digits {
    Half,
    All,
}

/// Whether amounts changed before a bound was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Progress {
    Moved,
    Stayed,
}

/// The state of one call of [`BoundedNnls::find`].
struct Search<'a> {
    loads: &'a [f64],
    columns: &'a [Column],
    /// The length |column| of each column.
    norms: Vec<f64>,
    state: Vec<State>,
    /// True for columns that entered the passive set and left it at once, or that depend linearly on it. They are not
    /// tried again until the amounts change.
    rejected: Vec<bool>,
    /// The columns that may enter: (gradient per unit of |column|, column).
    candidates: Vec<(f64, usize)>,
    max_pivots: usize,
    pivots_left: usize,
}

impl<'a> Search<'a> {
    /// Creates the initial state of a search. `set` is the result of an earlier search, or empty.
    fn new(set: &BoundedNnls, loads: &'a [f64], columns: &'a [Column]) -> Search<'a> {
        let mut state = vec![State::AtZero; columns.len()];
        set.passive.iter().for_each(|k| state[*k] = State::Passive);
        set.at_limit.iter().for_each(|k| state[*k] = State::AtLimit);
        // The constant 16 allows enough pivots for small programs.
        let max_pivots = MAX_PIVOTS_PER_COLUMN * columns.len() + 16;
        Search {
            loads,
            columns,
            norms: columns.iter().map(norm).collect(),
            state,
            rejected: vec![false; columns.len()],
            candidates: Vec::new(),
            max_pivots,
            pivots_left: max_pivots,
        }
    }

    /// Collects the candidates: the columns at a bound whose gradient points away from the bound and, divided by
    /// |column|, exceeds `threshold`. Rejected columns are left out.
    fn find_candidates(&mut self, residual: &[f64], threshold: f64) {
        self.candidates.clear();
        for (k, column) in self.columns.iter().enumerate() {
            // The gradient is positive if a move of the amount away from its bound reduces the residual.
            let gradient = match self.state[k] {
                State::AtZero => column.dot(residual),
                State::AtLimit => -column.dot(residual),
                State::Passive => continue,
            };
            let gradient = gradient / self.norms[k];
            if gradient > threshold && !self.rejected[k] {
                self.candidates.push((gradient, k));
            }
        }
    }

    /// Counts one change of the passive set. `None` if the maximum number of changes is exceeded.
    fn count_pivot(&mut self) -> Option<()> {
        self.pivots_left = self.pivots_left.checked_sub(1)?;
        Some(())
    }
}

/// Whether the amount of a column is at a bound or between its bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    AtZero,
    /// Between its bounds.
    Passive,
    AtLimit,
}

/// How many columns enter at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Entry {
    /// The columns with the largest gradients, no two at the same block. One linear system is then solved for all of
    /// them.
    Several,
    /// The column with the largest gradient: the rule of Lawson and Hanson, with which the method always terminates.
    One,
}

impl Entry {
    /// Chooses the columns that enter the passive set, and empties the list of candidates. `rows` is the number of rows
    /// of the problem.
    fn choose(self, candidates: &mut Vec<(f64, usize)>, columns: &[Column], rows: usize) -> Vec<usize> {
        candidates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        if self == Entry::One {
            candidates.truncate(1);
        }
        // Go through the candidates in the order of decreasing gradient. Skip a column that acts on the same block as a
        // column already chosen.
        let mut is_taken = vec![false; rows.div_ceil(3)];
        let mut chosen = Vec::new();
        for (_, k) in candidates.drain(..) {
            let blocks = || columns[k].entries().map(|(row, _)| row / 3);
            if blocks().all(|block| !is_taken[block]) {
                blocks().for_each(|block| is_taken[block] = true);
                chosen.push(k);
            }
        }
        chosen
    }
}

/// Returns the Euclidean length |column| of a column.
fn norm(column: &Column) -> f64 {
    column.dot_column(column).sqrt()
}

#[cfg(test)]
mod tests;
