//! [`BoundedNnls`]: least squares with bounds, min ½|A·x − loads|² s.t. 0 ≤ x ≤ limit.
//!
//! The residual r = loads − A·x answers both questions of statics. If r = 0, the amounts are forces that balance. Else r
//! is a motion that no admissible force opposes and along which the loads do work: at the nearest point of a cone
//! Aᵀr ≤ 0 and loadsᵀr = |r|² (Moreau's two polar cones). No cost enters, so the forces are some that balance, not the
//! least. Nothing here is believed without its proof.
//!
//! The active-set method NNLS of [LawsonHanson74](crate::doc::references), chapter 23, with upper bounds. Steps:
//!
//! 1. gradient Aᵀr: columns at a bound whose gradient points inwards are candidates;
//! 2. candidates enter the passive set;
//! 3. least squares on the passive set, by the Cholesky factor of its Gram matrix, which is kept up to date;
//! 4. if an amount would leave its bounds, a ratio test: move until the first bound is met, remove that column, back to 3;
//! 5. without candidates, the optimum is found.
//!
//! The passive set is a warm start for a changed program: the factor does not depend on the loads, nor on other columns.

use super::amounts::Amounts;
use super::incremental_cholesky::IncrementalCholesky;
use crate::program::{Column, Force, Program, columns};

/// A column may enter the passive set if its gradient exceeds this fraction of |column|·|residual|.
///
/// The gradient of a passive column is 0 up to some 1e-13 of that. At 1e-12 rounding would bring columns in; at 1e-10 small
/// contributions would be missed that the proof needs.
const DUAL_TOL: f64 = 1e-11;

/// A residual below this fraction of the loads counts as 0.
///
/// Far less than a proof asks for (1e-7), and more than the rounding of the amounts of some hundred bodies. At a tenth
/// columns would enter and leave for ever on that rounding.
const RESIDUAL_TOL: f64 = 1e-12;

/// A gradient below this fraction of the loads, per unit of |column|, is rounding.
const GRADIENT_FLOOR: f64 = 1e-13;

/// A column depends linearly on the passive ones if the square of its part orthogonal to them is at most this fraction of
/// its own square. That square then has some five digits left. Ten times larger, columns would be refused that are needed
/// next to nearly parallel ones; a tenth, the factor would lose one more digit.
const DEPENDENCE_TOL: f64 = 1e-11;

/// The passive set may change at most this many times the number of columns.
const MAX_PIVOTS_PER_COLUMN: usize = 4;

/// The passive set of a program, and the amounts found with it.
#[derive(Clone, Debug, Default)]
pub struct BoundedNnls {
    /// The passive columns, which lie between their bounds, in the order of the factor's rows.
    passive: Vec<usize>,
    /// The amounts of the passive columns.
    amounts: Vec<f64>,
    /// Of the Gram matrix of the passive columns.
    factor: IncrementalCholesky,
    /// The columns at their upper bounds.
    at_limit: Vec<usize>,
}

/// The columns of a program without those that others generate: with friction, a normal force alone is the sum of the two
/// rays of the cone.
pub fn generators(program: &Program) -> Vec<Column> {
    let is_redundant = |column: &Column| match column.force {
        Force::Ray {
            contact, friction, ..
        } => friction == 0.0 && program.contacts[contact].friction > 0.0,
        _ => false,
    };
    let mut list = columns(program);
    list.retain(|column| !is_redundant(column));
    list
}

impl BoundedNnls {
    /// Renumbers the columns, for a changed program. Columns for which `number` is `None` are removed.
    pub fn renumber(&mut self, number: impl Fn(usize) -> Option<usize>) {
        for place in (0..self.passive.len()).rev() {
            match number(self.passive[place]) {
                Some(new) => self.passive[place] = new,
                None => self.remove_at(place),
            }
        }
        self.at_limit = self.at_limit.iter().filter_map(|k| number(*k)).collect();
    }

    /// Finds the nearest balance, starting from the passive set. Returns the residual loads − A·x, or `None` after too many
    /// pivots.
    ///
    /// The columns must be those from which the set was made, apart from their numbers and from new ones.
    pub fn find(&mut self, loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
        let size = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let mut search = Search::new(self, loads, columns);
        if !self.passive.is_empty() {
            // The warm start may be the optimum already.
            self.solve_passive(&mut search, Digits::All)?;
        }
        let (mut entry, mut digits) = (Entry::Several, Digits::All);
        loop {
            // Step 1: the gradient, and the candidates.
            let residual = self.residual(loads, columns);
            let length = residual.iter().map(|v| v * v).sum::<f64>().sqrt();
            let is_balanced = !(length > RESIDUAL_TOL * size);
            search.find_candidates(&residual, (DUAL_TOL * length).max(GRADIENT_FLOOR * size));
            if is_balanced {
                search.candidates.clear();
            }
            if search.candidates.is_empty() {
                if entry == Entry::Several && !is_balanced {
                    // A column that left at once may have done so because of the others that entered with it.
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
            // Entering one at a time is slower, but cannot cycle.
            if 2 * search.pivots_left < search.max_pivots {
                entry = Entry::One;
            }
            digits = Digits::Some;
            // Steps 2 to 4.
            let entered = self.enter(&mut search, entry)?;
            if entered.is_empty() {
                continue;
            }
            let progress = self.solve_passive(&mut search, digits)?;
            let stays = |(k, _): &(usize, State)| search.state[*k] == State::Passive;
            if progress == Progress::Moved || entered.iter().any(stays) {
                search.rejected.fill(false);
            }
            // A column that left at once entered because of rounding: it must not try for ever.
            for (k, former) in entered {
                search.rejected[k] = search.state[k] == former;
            }
        }
    }

    /// The amounts, as the forces they stand for.
    pub fn gathered(&self, program: &Program, columns: &[Column]) -> Amounts {
        let mut amounts = Amounts::none(program);
        for (k, amount) in self.passive.iter().zip(&self.amounts) {
            amounts.add(columns[*k].force, *amount);
        }
        for k in &self.at_limit {
            amounts.add(columns[*k].force, columns[*k].limit);
        }
        amounts
    }

    /// The columns with an amount above 0: the passive ones, and those at their limits.
    pub fn numbers(&self) -> impl Iterator<Item = usize> + '_ {
        self.passive.iter().chain(&self.at_limit).copied()
    }

    /// Moves candidates into the passive set, unless they depend on it. Returns those that entered, with their former
    /// states; `None` after too many pivots.
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

    /// Moves the amounts to the least squares of the passive set, and removes columns that meet a bound on the way.
    fn solve_passive(&mut self, search: &mut Search, digits: Digits) -> Option<Progress> {
        let (loads, columns) = (search.loads, search.columns);
        let mut progress = Progress::Stayed;
        loop {
            let optimum = self.least_squares(loads, columns, digits);
            let Some((step, first)) = self.ratio_test(&optimum, columns) else {
                self.amounts = optimum;
                return Some(progress);
            };
            search.count_pivot()?;
            if step > 0.0 {
                progress = Progress::Moved;
            }
            let meets_limit = optimum[first] > 0.0;
            for (now, then) in self.amounts.iter_mut().zip(&optimum) {
                *now += step * (then - *now);
            }
            let k = self.passive[first];
            self.remove_at(first);
            search.state[k] = State::AtZero;
            if meets_limit {
                search.state[k] = State::AtLimit;
                self.at_limit.push(k);
            }
            // Others may have met 0 in the same step, up to rounding.
            for now in &mut self.amounts {
                *now = now.max(0.0);
            }
        }
    }

    /// The longest step towards the optimum of the passive set that keeps all bounds, and the place of the column that meets its
    /// bound; `None` if the whole step does.
    fn ratio_test(&self, optimum: &[f64], columns: &[Column]) -> Option<(f64, usize)> {
        let mut shortest: Option<(f64, usize)> = None;
        for (place, (now, then)) in self.amounts.iter().zip(optimum).enumerate() {
            let limit = columns[self.passive[place]].limit;
            let step = if *then < 0.0 {
                now.max(0.0) / (now.max(0.0) - then)
            } else if *then > limit {
                (limit - now.min(limit)) / (then - now.min(limit))
            } else {
                continue;
            };
            if shortest.is_none_or(|(least, _)| step < least) {
                shortest = Some((step, place));
            }
        }
        shortest
    }

    /// The amounts of the passive set of least residual, of either sign. Refined once for all digits, since the normal
    /// equations have half of them only.
    fn least_squares(&self, loads: &[f64], columns: &[Column], digits: Digits) -> Vec<f64> {
        let mut residual = loads.to_vec();
        for k in &self.at_limit {
            columns[*k].add_to(&mut residual, -columns[*k].limit);
        }
        let mut amounts = vec![0.0; self.passive.len()];
        let solves = match digits {
            Digits::Some => 1,
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

    /// loads − A·x.
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

    /// Adds a column to the passive set; false if it depends on the columns there.
    fn append(&mut self, columns: &[Column], k: usize, amount: f64) -> bool {
        let new = &columns[k];
        let products = self
            .passive
            .iter()
            .map(|u| columns[*u].dot_column(new))
            .collect();
        let square = new.dot_column(new);
        if !self
            .factor
            .append(products, square, DEPENDENCE_TOL * square)
        {
            return false;
        }
        self.passive.push(k);
        self.amounts.push(amount);
        true
    }

    /// Removes a column from the passive set.
    fn remove_at(&mut self, place: usize) {
        self.passive.remove(place);
        self.amounts.remove(place);
        self.factor.remove(place);
    }
}

/// What one call of [`BoundedNnls::find`] keeps track of.
struct Search<'a> {
    loads: &'a [f64],
    columns: &'a [Column],
    /// |column| of each.
    norms: Vec<f64>,
    state: Vec<State>,
    /// Columns that were tried in vain, until the passive set changes.
    rejected: Vec<bool>,
    /// (gradient per unit of |column|, column) of those that may enter.
    candidates: Vec<(f64, usize)>,
    max_pivots: usize,
    pivots_left: usize,
}

impl<'a> Search<'a> {
    fn new(set: &BoundedNnls, loads: &'a [f64], columns: &'a [Column]) -> Search<'a> {
        let mut state = vec![State::AtZero; columns.len()];
        set.passive.iter().for_each(|k| state[*k] = State::Passive);
        set.at_limit.iter().for_each(|k| state[*k] = State::AtLimit);
        // Some more, so that small programs are not cut short.
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

    /// Collects the columns at a bound whose gradient points inwards by more than `threshold`.
    fn find_candidates(&mut self, residual: &[f64], threshold: f64) {
        self.candidates.clear();
        for (k, column) in self.columns.iter().enumerate() {
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

    /// Counts a change of the passive set; `None` if there were too many.
    fn count_pivot(&mut self) -> Option<()> {
        self.pivots_left = self.pivots_left.checked_sub(1)?;
        Some(())
    }
}

/// Where the amount of a column is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    AtZero,
    /// Between its bounds.
    Passive,
    AtLimit,
}

/// How precisely the least squares of the passive set are solved: to the last digits only when there are no candidates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Digits {
    Some,
    All,
}

/// How many columns enter at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Entry {
    /// Those of largest gradient, no two at one block: one system of equations serves them all.
    Several,
    /// The one of largest gradient, as Lawson and Hanson have it, which terminates for certain.
    One,
}

impl Entry {
    /// Chooses from the candidates, and empties their list; `rows` is the number of rows of the problem.
    fn choose(
        self,
        candidates: &mut Vec<(f64, usize)>,
        columns: &[Column],
        rows: usize,
    ) -> Vec<usize> {
        candidates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        if self == Entry::One {
            candidates.truncate(1);
        }
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

/// Whether amounts changed before a bound was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Progress {
    Moved,
    Stayed,
}

fn norm(column: &Column) -> f64 {
    column.dot_column(column).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::interface::ContactKind;
    use crate::program::{ContactTerm, GripTerm, Scale};

    /// A block 2 wide and 1 high, pressed down by 10 at `x` from its middle and pushed by `push` at its centre, on ground of
    /// friction 0.5.
    fn block(x: f64, push: f64, grips: Vec<GripTerm>) -> Program {
        let arms = [Vector::new(1.0, -0.5), Vector::new(-1.0, -0.5)];
        Program {
            blocks: 1,
            loads: vec![-push, 10.0, 10.0 * x],
            contacts: vec![ContactTerm {
                kind: ContactKind::Edge,
                on: (0, arms),
                from: None,
                normal: Vector::new(0.0, 1.0),
                friction: 0.5,
                points: 2,
            }],
            grips,
            scale: Scale {
                length: 1.0,
                force: 1.0,
            },
        }
    }

    fn found(program: &Program) -> (Vec<f64>, Amounts) {
        let columns = generators(program);
        let mut nearest = BoundedNnls::default();
        let rest = nearest.find(&program.loads, &columns).expect("an end");
        (rest, nearest.gathered(program, &columns))
    }

    #[test]
    fn a_load_within_the_base_is_balanced_and_one_beyond_it_is_not() {
        let (rest, amounts) = found(&block(0.25, 1.0, vec![]));
        assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
        assert!((amounts.normal[0].iter().sum::<f64>() - 10.0).abs() < 1e-9);
        assert!(
            (amounts.friction[0] + 1.0).abs() < 1e-9 || (amounts.friction[0] - 1.0).abs() < 1e-9
        );
        let program = block(1.5, 0.0, vec![]);
        let (rest, _) = found(&program);
        let columns = generators(&program);
        assert!(
            columns.iter().all(|c| c.dot(&rest) < 1e-9),
            "no force objects"
        );
        let work: f64 = rest.iter().zip(&program.loads).map(|(r, b)| r * b).sum();
        assert!(work > 1.0, "the loads work: {work}");
    }

    #[test]
    fn a_limit_is_kept_and_left_again() {
        let grip = |limit: f64| GripTerm {
            block: 0,
            arm: Vector::new(0.0, 0.0),
            limits: [limit, 0.0, 0.0],
        };
        // A push of 9 meets friction of at most 5; the robot must give 4.
        let (rest, amounts) = found(&block(0.0, 9.0, vec![grip(6.0)]));
        assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
        assert!(amounts.grip[0][0].abs() <= 6.0 + 1e-12);
        let (rest, amounts) = found(&block(0.0, 9.0, vec![grip(3.0)]));
        assert!(rest.iter().any(|v| v.abs() > 0.1), "{rest:?}");
        assert!(
            (amounts.grip[0][0].abs() - 3.0).abs() < 1e-12,
            "{amounts:?}"
        );
    }

    #[test]
    fn a_passive_set_that_lost_a_column_is_completed() {
        let program = block(0.25, 1.0, vec![]);
        let columns = generators(&program);
        let mut nearest = BoundedNnls::default();
        nearest.find(&program.loads, &columns).expect("an end");
        let first = nearest.numbers().next().expect("used");
        nearest.renumber(|k| (k != first).then_some(k));
        let rest = nearest.find(&program.loads, &columns).expect("an end");
        assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
    }
}
