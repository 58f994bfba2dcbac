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
pub struct Nearest {
    /// The numbers of the used columns, in the order of the factor's rows, and their amounts.
    used: Vec<usize>,
    amounts: Vec<f64>,
    /// Rows of the lower triangular factor L, L·Lᵀ = the Gram matrix of the used columns.
    factor: Vec<Vec<f64>>,
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

impl Nearest {
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
        let mut changes = CHANGES * columns.len() + 16;
        if !self.used.is_empty() {
            self.settle(loads, columns, &mut place, &mut changes)?;
        }
        loop {
            let rest = self.rest(loads, columns);
            let left = rest.iter().map(|v| v * v).sum::<f64>().sqrt();
            if left <= NOTHING * size {
                return Some(rest);
            }
            let mut best: Option<(f64, usize)> = None;
            for (k, column) in columns.iter().enumerate() {
                let gain = match place[k] {
                    State::Out => column.dot(&rest),
                    State::Full => -column.dot(&rest),
                    State::Used => continue,
                };
                let gain = gain / norms[k];
                let enough = (WANTS * left).max(ROUNDING * size);
                if gain > enough && !barred[k] && best.is_none_or(|(most, _)| gain > most) {
                    best = Some((gain, k));
                }
            }
            let Some((_, k)) = best else {
                return Some(rest);
            };
            changes = changes.checked_sub(1)?;
            let before = place[k];
            let amount = match before {
                State::Full => columns[k].limit,
                _ => 0.0,
            };
            if !self.append(columns, k, amount) {
                barred[k] = true;
                continue;
            }
            self.full.retain(|f| *f != k);
            place[k] = State::Used;
            let settled = self.settle(loads, columns, &mut place, &mut changes)?;
            if settled == Settled::Moved || place[k] == State::Used {
                barred.fill(false);
            }
            // One that wanted to move and went straight back did so for rounding, which is no reason to try it for ever.
            barred[k] = place[k] == before;
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
        changes: &mut usize,
    ) -> Option<Settled> {
        let mut settled = Settled::Stayed;
        loop {
            let wanted = self.least_squares(loads, columns);
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

    /// The amounts of the used set, of either sign, that leave least; once refined.
    fn least_squares(&self, loads: &[f64], columns: &[Column]) -> Vec<f64> {
        let mut rest = loads.to_vec();
        for k in &self.full {
            columns[*k].add_to(&mut rest, -columns[*k].limit);
        }
        let mut amounts = vec![0.0; self.used.len()];
        for _ in 0..2 {
            let mut change: Vec<f64> = self.used.iter().map(|k| columns[*k].dot(&rest)).collect();
            self.forward(&mut change);
            self.backward(&mut change);
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

    /// L·x = v, in place.
    fn forward(&self, v: &mut [f64]) {
        for (k, row) in self.factor.iter().enumerate() {
            let (before, rest) = v.split_at_mut(k);
            let sum: f64 = row.iter().zip(before.iter()).map(|(a, b)| a * b).sum();
            rest[0] = (rest[0] - sum) / row[k];
        }
    }

    /// Lᵀ·x = v, in place.
    fn backward(&self, v: &mut [f64]) {
        for (k, row) in self.factor.iter().enumerate().rev() {
            let (before, rest) = v.split_at_mut(k);
            rest[0] /= row[k];
            for (value, entry) in before.iter_mut().zip(row) {
                *value -= entry * rest[0];
            }
        }
    }

    /// Takes a column in, unless it is a sum of the used ones.
    fn append(&mut self, columns: &[Column], k: usize, amount: f64) -> bool {
        let new = &columns[k];
        let mut row: Vec<f64> = self.used.iter().map(|u| columns[*u].times(new)).collect();
        self.forward(&mut row);
        let own = new.times(new);
        let across = own - row.iter().map(|v| v * v).sum::<f64>();
        if !(across > ACROSS * own) {
            return false;
        }
        row.push(across.sqrt());
        self.factor.push(row);
        self.used.push(k);
        self.amounts.push(amount);
        true
    }

    /// Takes a used column out: its row goes, and rotations make the factor triangular again.
    fn drop_at(&mut self, place: usize) {
        self.used.remove(place);
        self.amounts.remove(place);
        self.factor.remove(place);
        for k in place..self.factor.len() {
            let (a, b) = (self.factor[k][k], self.factor[k][k + 1]);
            let length = libm::hypot(a, b);
            let (c, s) = (a / length, b / length);
            for row in &mut self.factor[k..] {
                let (x, y) = (row[k], row[k + 1]);
                row[k] = c * x + s * y;
                row[k + 1] = c * y - s * x;
            }
            self.factor[k].truncate(k + 1);
        }
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
    use crate::program::{Contact, GripTerm, Scale};

    /// A block 2 wide and 1 high, pressed down by 10 at `x` from its middle and pushed by `push` at its centre, on ground of
    /// friction 0.5.
    fn block(x: f64, push: f64, grips: Vec<GripTerm>) -> Program {
        let arms = [Vector::new(1.0, -0.5), Vector::new(-1.0, -0.5)];
        Program {
            blocks: 1,
            loads: vec![-push, 10.0, 10.0 * x],
            contacts: vec![Contact {
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
        let mut nearest = Nearest::default();
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
        let mut nearest = Nearest::default();
        nearest.find(&program.loads, &columns).expect("an end");
        let first = nearest.numbers().next().expect("used");
        nearest.renumber(|k| (k != first).then_some(k));
        let rest = nearest.find(&program.loads, &columns).expect("an end");
        assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
    }
}
