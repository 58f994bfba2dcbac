//! The balance nearest to given loads: admissible amounts that leave least unbalanced, min ½|A·x − loads|² s.t. 0 ≤ x ≤
//! limit.
//!
//! It tells both stories at once. Where nothing is left the amounts are forces that balance; where something is, what is
//! left, r = loads − A·x, is a motion that no admissible force can object to and along which the loads do work: for the
//! nearest point of a cone Aᵀr ≤ 0 and loadsᵀr = |r|² (Moreau's two polar cones). No cost enters, so the forces are some
//! that balance and not the least.
//!
//! Solved by the active-set method of [LawsonHanson74](crate::doc::references), chapter 23: a set of used columns, grown by
//! the one that most wants in and shrunk where an amount would leave its bounds, with the Cholesky factor of their Gram
//! matrix kept up to date. A used set is a first guess for a changed program at hardly any cost, since the factor does not
//! depend on the loads, nor on rows and columns that are new. Nothing here is believed without its proof.

use super::Amounts;
use super::incremental_cholesky::Factor;
use crate::program::{Column, Force, Program, columns};

/// A column wants in where it gains more than this share of its own size times what is left.
const WANTS: f64 = 1e-11;

/// What is left below this share of the loads is nothing: far less than a proof asks for, and more than the rounding of the
/// amounts of some hundred bodies, which would keep columns changing places for ever.
const NOTHING: f64 = 1e-12;

/// And what wants in with less than this share of the loads does so for that rounding.
const ROUNDING: f64 = 1e-13;

/// A column whose part across the used ones is smaller than this share of it is a sum of them.
const ACROSS: f64 = 1e-11;

/// So many changes of the used set per column are allowed.
const CHANGES: usize = 4;

/// The used columns of a program and what was found with them.
#[derive(Clone, Debug, Default)]
pub struct BoundedNnls {
    /// The numbers of the used columns, in the order of the factor's rows, and their amounts.
    used: Vec<usize>,
    amounts: Vec<f64>,
    /// Of the Gram matrix of the used columns.
    factor: Factor,
    /// Columns at their limits.
    full: Vec<usize>,
}

/// The columns that are looked at: where there is friction, the normal force alone is the sum of two others.
pub fn generators(program: &Program) -> Vec<Column> {
    let needless = |column: &Column| match column.force {
        Force::Ray {
            contact, friction, ..
        } => friction == 0.0 && program.contacts[contact].friction > 0.0,
        _ => false,
    };
    let mut list = columns(program);
    list.retain(|column| !needless(column));
    list
}

impl BoundedNnls {
    /// The same set where columns have other numbers now; those that are gone, of which `number` is `None`, go.
    pub fn renumber(&mut self, number: impl Fn(usize) -> Option<usize>) {
        for place in (0..self.used.len()).rev() {
            match number(self.used[place]) {
                Some(new) => self.used[place] = new,
                None => self.drop_at(place),
            }
        }
        self.full = self.full.iter().filter_map(|k| number(*k)).collect();
    }

    /// Finds the nearest balance, starting from the set at hand. Returns what is left of the loads, or `None` where it does
    /// not come to an end.
    ///
    /// The columns must be those from which the set was made, up to their numbers and up to new ones.
    pub fn find(&mut self, loads: &[f64], columns: &[Column]) -> Option<Vec<f64>> {
        let size = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let norms: Vec<f64> = columns.iter().map(norm).collect();
        // Columns that were tried and found to be sums of the used ones, until the set changes.
        let mut barred = vec![false; columns.len()];
        let mut place = vec![State::Out; columns.len()];
        self.used.iter().for_each(|k| place[*k] = State::Used);
        self.full.iter().for_each(|k| place[*k] = State::Full);
        let budget = CHANGES * columns.len() + 16;
        let mut changes = budget;
        // What was known may be all that it takes.
        let (mut entry, mut digits) = (Entry::Several, Digits::All);
        let mut wanting = Vec::new();
        if !self.used.is_empty() {
            self.settle(loads, columns, &mut place, digits, &mut changes)?;
        }
        loop {
            let rest = self.rest(loads, columns);
            let left = rest.iter().map(|v| v * v).sum::<f64>().sqrt();
            let enough = (WANTS * left).max(ROUNDING * size);
            wanting.clear();
            for (k, column) in columns.iter().enumerate() {
                let gain = match place[k] {
                    State::Out => column.dot(&rest),
                    State::Full => -column.dot(&rest),
                    State::Used => continue,
                };
                let gain = gain / norms[k];
                if gain > enough && !barred[k] && left > NOTHING * size {
                    wanting.push((gain, k));
                }
            }
            if wanting.is_empty() {
                if entry == Entry::Several && left > NOTHING * size {
                    // What went straight back may have done so for what came with it.
                    entry = Entry::One;
                    barred.fill(false);
                } else if digits == Digits::All {
                    return Some(rest);
                } else {
                    digits = Digits::All;
                    self.settle(loads, columns, &mut place, digits, &mut changes)?;
                }
                continue;
            }
            if 2 * changes < budget {
                entry = Entry::One;
            }
            digits = Digits::Some;
            let mut entered = Vec::new();
            for k in entry.chosen(&mut wanting, columns, loads.len()) {
                changes = changes.checked_sub(1)?;
                let amount = match place[k] {
                    State::Full => columns[k].limit,
                    _ => 0.0,
                };
                if self.append(columns, k, amount) {
                    entered.push((k, place[k]));
                    self.full.retain(|f| *f != k);
                    place[k] = State::Used;
                } else {
                    barred[k] = true;
                }
            }
            if entered.is_empty() {
                continue;
            }
            let settled = self.settle(loads, columns, &mut place, digits, &mut changes)?;
            let stays = |(k, _): &(usize, State)| place[*k] == State::Used;
            if settled == Settled::Moved || entered.iter().any(stays) {
                barred.fill(false);
            }
            // One that wanted to move and went straight back did so for rounding, which is no reason to try it for ever.
            for (k, before) in entered {
                barred[k] = place[k] == before;
            }
        }
    }

    /// The amounts by what they stand for.
    pub fn gathered(&self, program: &Program, columns: &[Column]) -> Amounts {
        let mut amounts = Amounts::none(program);
        for (k, amount) in self.used.iter().zip(&self.amounts) {
            amounts.add(columns[*k].force, *amount);
        }
        for k in &self.full {
            amounts.add(columns[*k].force, columns[*k].limit);
        }
        amounts
    }

    /// The numbers of the columns in use, at their limits too.
    pub fn numbers(&self) -> impl Iterator<Item = usize> + '_ {
        self.used.iter().chain(&self.full).copied()
    }

    /// Moves the amounts to the least squares of the used set, taking columns out whose amounts meet a bound on the way.
    fn settle(
        &mut self,
        loads: &[f64],
        columns: &[Column],
        place: &mut [State],
        digits: Digits,
        changes: &mut usize,
    ) -> Option<Settled> {
        let mut settled = Settled::Stayed;
        loop {
            let wanted = self.least_squares(loads, columns, digits);
            // How far towards it every amount stays within its bounds, and the one that meets its own first.
            let mut step: Option<(f64, usize)> = None;
            for (place, (now, then)) in self.amounts.iter().zip(&wanted).enumerate() {
                let limit = columns[self.used[place]].limit;
                let part = if *then < 0.0 {
                    now.max(0.0) / (now.max(0.0) - then)
                } else if *then > limit {
                    (limit - now.min(limit)) / (then - now.min(limit))
                } else {
                    continue;
                };
                if step.is_none_or(|(least, _)| part < least) {
                    step = Some((part, place));
                }
            }
            let Some((part, first)) = step else {
                self.amounts = wanted;
                return Some(settled);
            };
            *changes = changes.checked_sub(1)?;
            if part > 0.0 {
                settled = Settled::Moved;
            }
            let at_limit = wanted[first] > 0.0;
            for (now, then) in self.amounts.iter_mut().zip(&wanted) {
                *now += part * (then - *now);
            }
            let k = self.used[first];
            self.drop_at(first);
            place[k] = State::Out;
            if at_limit {
                place[k] = State::Full;
                self.full.push(k);
            }
            // The others may have come to the same bound.
            for now in &mut self.amounts {
                *now = now.max(0.0);
            }
        }
    }

    /// The amounts of the used set, of either sign, that leave least; to all digits where they are refined once.
    fn least_squares(&self, loads: &[f64], columns: &[Column], digits: Digits) -> Vec<f64> {
        let mut rest = loads.to_vec();
        for k in &self.full {
            columns[*k].add_to(&mut rest, -columns[*k].limit);
        }
        let mut amounts = vec![0.0; self.used.len()];
        let rounds = match digits {
            Digits::Some => 1,
            Digits::All => 2,
        };
        for _ in 0..rounds {
            let mut change: Vec<f64> = self.used.iter().map(|k| columns[*k].dot(&rest)).collect();
            self.factor.forward(&mut change);
            self.factor.backward(&mut change);
            for ((amount, by), k) in amounts.iter_mut().zip(&change).zip(&self.used) {
                *amount += by;
                columns[*k].add_to(&mut rest, -by);
            }
        }
        amounts
    }

    fn rest(&self, loads: &[f64], columns: &[Column]) -> Vec<f64> {
        let mut rest = loads.to_vec();
        for (k, amount) in self.used.iter().zip(&self.amounts) {
            columns[*k].add_to(&mut rest, -amount);
        }
        for k in &self.full {
            columns[*k].add_to(&mut rest, -columns[*k].limit);
        }
        rest
    }

    /// Takes a column in, unless it is a sum of the used ones.
    fn append(&mut self, columns: &[Column], k: usize, amount: f64) -> bool {
        let new = &columns[k];
        let products = self.used.iter().map(|u| columns[*u].times(new)).collect();
        let own = new.times(new);
        if !self.factor.append(products, own, ACROSS * own) {
            return false;
        }
        self.used.push(k);
        self.amounts.push(amount);
        true
    }

    /// Takes a used column out.
    fn drop_at(&mut self, place: usize) {
        self.used.remove(place);
        self.amounts.remove(place);
        self.factor.remove(place);
    }
}

/// Where a column stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Its amount is 0.
    Out,
    /// Between its bounds.
    Used,
    /// At its limit.
    Full,
}

/// How precisely amounts are sought: to the last digits only where nothing wants in any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Digits {
    Some,
    All,
}

/// How many columns come in at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Entry {
    /// The ones that gain most, no two on one block: one system of equations serves for all of them.
    Several,
    /// The one that gains most, which leads to the end for certain.
    One,
}

impl Entry {
    /// Those of the columns that want in by their gains, of a problem of so many rows.
    fn chosen(
        self,
        wanting: &mut Vec<(f64, usize)>,
        columns: &[Column],
        rows: usize,
    ) -> Vec<usize> {
        wanting.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        if self == Entry::One {
            wanting.truncate(1);
        }
        let mut taken = vec![false; rows.div_ceil(3)];
        let mut chosen = Vec::new();
        for (_, k) in wanting.drain(..) {
            let blocks = || columns[k].entries().map(|(row, _)| row / 3);
            if blocks().all(|block| !taken[block]) {
                blocks().for_each(|block| taken[block] = true);
                chosen.push(k);
            }
        }
        chosen
    }
}

/// Whether amounts were moved before a bound was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Settled {
    Moved,
    Stayed,
}

fn norm(column: &Column) -> f64 {
    column.times(column).sqrt()
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
    fn a_set_that_lost_a_column_is_made_whole() {
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
