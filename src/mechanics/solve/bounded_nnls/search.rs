//! [`Search`]: the state of one search of [`BoundedNnls`], with the columns that may enter the passive set and the
//! number of times this set may still change.

use super::{BoundedNnls, MAX_PIVOTS_PER_COLUMN};
use crate::mechanics::program::Column;

/// The state of one call of [`BoundedNnls::find`].
pub(super) struct Search<'a> {
    pub(super) loads: &'a [f64],
    pub(super) columns: &'a [Column],
    /// The length |column| of each column.
    pub(super) norms: Vec<f64>,
    pub(super) state: Vec<State>,
    /// True for columns that entered the passive set and left it at once, or that depend linearly on it. They are not
    /// tried again until the amounts change.
    pub(super) rejected: Vec<bool>,
    /// The columns that may enter: (gradient per unit of |column|, column).
    pub(super) candidates: Vec<(f64, usize)>,
    pub(super) max_pivots: usize,
    pub(super) pivots_left: usize,
}

impl<'a> Search<'a> {
    /// Creates the initial state of a search. `set` is the result of an earlier search, or empty.
    pub(super) fn new(set: &BoundedNnls, loads: &'a [f64], columns: &'a [Column]) -> Search<'a> {
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
    pub(super) fn find_candidates(&mut self, residual: &[f64], threshold: f64) {
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
    pub(super) fn count_pivot(&mut self) -> Option<()> {
        self.pivots_left = self.pivots_left.checked_sub(1)?;
        Some(())
    }
}

/// Whether the amount of a column is at a bound or between its bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    AtZero,
    /// Between its bounds.
    Passive,
    AtLimit,
}

/// How many columns enter at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// The columns with the largest gradients, no two at the same block. One linear system is then solved for all of
    /// them.
    Several,
    /// The column with the largest gradient: the rule of Lawson and Hanson, with which the method always terminates.
    One,
}

impl Entry {
    /// Chooses the columns that enter the passive set, and empties the list of candidates. `rows` is the number of rows
    /// of the problem.
    pub(super) fn choose(self, candidates: &mut Vec<(f64, usize)>, columns: &[Column], rows: usize) -> Vec<usize> {
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
pub(super) fn norm(column: &Column) -> f64 {
    column.dot_column(column).sqrt()
}
