//! An optimum of a linear program whose loads span many sizes, accurate for every body by itself.
//!
//! Iterative refinement of linear programs ([GleixnerSteffyWolter16](crate::doc::references)). An interior-point method
//! balances every body to some 10⁻⁹ of the heaviest load, and says nothing about a body a billion times lighter. So the
//! program is solved level by level, each at the size of what the level before left:
//!
//! 1. Residual: what the amounts leave unbalanced is summed with twice the digits. Its largest entry is ρ.
//! 2. Classification: a column whose amount is far above ρ, and whose slack is next to nothing, is *basic*. No change of the
//!    size of ρ can bring it to a bound, so its change is free, of either sign, and costs nothing. Every other column
//!    starts again from its nearer bound, at its reduced cost.
//! 3. Correction: the program of the changes is scaled to loads of 1 and solved. Its amounts correct the amounts, its
//!    multipliers the velocities.
//! 4. Clean-up: a column whose slack outweighs its amount is at its bound, to the last bit.
//!
//! The velocities of a light body mean nothing until a level has the size of its load. Each level gains about six digits.

use super::{
    Conditioning, Dual, Effort, Face, SolverSettings, Status, largest, least_squares_amounts,
    refine_balance, solved_with_retry,
};
use crate::geometry::CompensatedSum;
use crate::program::{Column, QuadraticProgram};

/// Loads differ by more than a solver's digits where the lightest is below this part of the heaviest.
pub(super) const WIDE: f64 = 1e-3;

/// Levels at most: twelve decades of loads, and the digits of the lightest, take four.
const MAX_LEVELS: usize = 8;

/// A basic column's amount is at least this many times ρ.
const AMPLE: f64 = 1e3;

/// A basic column's slack is at most this, where a unit of force costs about 1.
const BASIC_SLACK: f64 = 1e-6;

/// The solver's digits suffice for forces this many times smaller than the loads of a level.
const DIGITS_OF_LEVEL: f64 = 1e2;

/// A body balances where no more than this part of its own load is left, or the rounding of what acts on it.
/// What is left must not change the digits of the forces that are wanted either.
const BALANCED: f64 = 1e-10;
const SHARE_OF_WANTED: f64 = 1e-8;
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A limit beyond this many loads of a level cannot bind there; one below the second value allows nothing there.
const LOOSE_LIMIT: f64 = 1e6;
const NARROW_LIMIT: f64 = 1e-9;

/// The loads of every body: force, and moment in parts of L.
pub(super) fn own_loads(loads: &[f64]) -> Vec<f64> {
    let bodies = loads.chunks_exact(3);
    bodies
        .map(|load| libm::hypot(load[0], load[1]).max(load[2].abs()))
        .collect()
}

/// The load of the lightest body that has one.
pub(super) fn lightest(loads: &[f64]) -> f64 {
    let own = own_loads(loads).into_iter().filter(|load| *load > 0.0);
    own.fold(f64::INFINITY, f64::min)
}

/// Whether amounts balance every body, measured by its own load and by the size of force that is wanted.
fn balances_every_body(loads: &[f64], columns: &[Column], amounts: &[f64], wanted: f64) -> bool {
    let rest = residual(loads, columns, amounts);
    let mut acting = own_loads(loads);
    for (column, amount) in columns.iter().zip(amounts) {
        for (row, value) in column.entries() {
            acting[row / 3] += (value * amount).abs();
        }
    }
    let own = own_loads(loads);
    let mut bodies = rest.chunks_exact(3).zip(own.iter().zip(&acting));
    bodies.all(|(rest, (own, acting))| {
        let allowed = (BALANCED * own).min(SHARE_OF_WANTED * wanted);
        largest(rest) <= allowed.max(ROUNDING * acting)
    })
}

/// loads − Σ amount·column, summed with twice the digits.
fn residual(loads: &[f64], columns: &[Column], amounts: &[f64]) -> Vec<f64> {
    let mut sums = vec![CompensatedSum::default(); loads.len()];
    for (sum, load) in sums.iter_mut().zip(loads) {
        sum.add(*load);
    }
    for (column, amount) in columns.iter().zip(amounts).filter(|(_, a)| **a != 0.0) {
        for (row, value) in column.entries() {
            sums[row].add_product(-amount, value);
        }
    }
    sums.into_iter().map(CompensatedSum::value).collect()
}

/// The optimum near a given one, accurate to forces of size `wanted`; `None` where the solver does not get there.
///
/// Its amounts balance every body. A column that is not in use has an amount of exactly 0, one in use a slack of exactly 0.
pub(super) fn refined_optimum(
    loads: &[f64],
    columns: &[Column],
    cost: impl Fn(&Column) -> f64,
    start: &Dual,
    wanted: f64,
    effort: &mut Effort,
) -> Option<Dual> {
    let costs: Vec<f64> = columns.iter().map(cost).collect();
    let mut at = start.clone();
    for _ in 0..MAX_LEVELS {
        let level = Level::new(loads, columns, &costs, &at)?;
        let size = level.size;
        at = level.solved(columns, &costs, at, effort)?;
        let balanced = balances_every_body(loads, columns, &at.amounts, wanted);
        if size <= DIGITS_OF_LEVEL * wanted && balanced {
            return Some(at);
        }
    }
    None
}

/// A face with the amounts of least Σ force² on it, where these balance every body; else as it is.
pub(super) fn with_least_squares(
    face: Face,
    wanted: f64,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Face {
    let (loads, columns) = (&face.loads, &face.columns);
    let balances = |amounts: &Vec<f64>| balances_every_body(loads, columns, amounts, wanted);
    let found = least_squares_amounts(loads, columns, settings, effort);
    let found = found.map(|amounts| match balances(&amounts) {
        true => amounts,
        false => refine_balance(loads, columns, amounts, effort),
    });
    match found.filter(balances) {
        Some(amounts) => face.with(amounts),
        None => face,
    }
}

/// Where a column stands on a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// Its amount starts again from 0.
    Lower,
    /// Its amount starts again from its limit, downwards.
    Upper,
    /// Its change is free.
    Basic,
    /// It stays as it is: its whole range is nothing on this level.
    Fixed,
}

/// The program of the changes, at its own size.
struct Level {
    places: Vec<Place>,
    /// What the columns that are not basic must give, with a largest entry of 1.
    loads: Vec<f64>,
    /// What 1 stands for.
    size: f64,
}

impl Level {
    fn new(loads: &[f64], columns: &[Column], costs: &[f64], at: &Dual) -> Option<Level> {
        let rho = largest(&residual(loads, columns, &at.amounts));
        let given = |k: usize| {
            let (column, amount) = (&columns[k], at.amounts[k]);
            let slack = costs[k] - column.dot(&at.y);
            let room = amount.min(column.limit - amount);
            if room > AMPLE * rho && slack.abs() <= BASIC_SLACK {
                (Place::Basic, amount)
            } else if column.limit.is_finite() && slack < 0.0 {
                (Place::Upper, column.limit)
            } else {
                (Place::Lower, 0.0)
            }
        };
        let (mut places, kept): (Vec<Place>, Vec<f64>) = (0..columns.len()).map(given).unzip();
        let left = residual(loads, columns, &kept);
        let size = largest(&left);
        if size == 0.0 || !size.is_finite() {
            return None;
        }
        for (place, column) in places.iter_mut().zip(columns) {
            if column.limit < NARROW_LIMIT * size {
                *place = Place::Fixed;
            }
        }
        Some(Level {
            places,
            loads: left.iter().map(|v| v / size).collect(),
            size,
        })
    }

    /// The linear program min Σ reduced cost·change  s.t.  the changes balance the loads of the level.
    fn program_of_changes(&self, columns: &[Column], costs: &[f64], y: &[f64]) -> QuadraticProgram {
        let n = columns.len();
        let mut program = QuadraticProgram {
            unknowns: n,
            quadratic: Vec::new(),
            linear: vec![0.0; n],
            matrix: Vec::with_capacity(7 * n),
            bound: self.loads.clone(),
            equalities: self.loads.len(),
        };
        for (k, (column, place)) in columns.iter().zip(&self.places).enumerate() {
            let sign = if *place == Place::Upper { -1.0 } else { 1.0 };
            let reduced = costs[k] - column.dot(y);
            if *place != Place::Fixed {
                let entries = column.entries().map(|(row, v)| (row, k, sign * v));
                program.matrix.extend(entries);
            }
            if *place == Place::Basic {
                continue;
            }
            program.linear[k] = (sign * reduced).max(0.0);
            program.matrix.push((program.bound.len(), k, -1.0));
            program.bound.push(0.0);
            if *place == Place::Fixed || column.limit < LOOSE_LIMIT * self.size {
                let most = match place {
                    Place::Fixed => 1.0,
                    _ => column.limit / self.size,
                };
                program.matrix.push((program.bound.len(), k, 1.0));
                program.bound.push(most);
            }
        }
        program
    }

    /// The optimum with the changes of this level, cleaned.
    fn solved(
        &self,
        columns: &[Column],
        costs: &[f64],
        mut at: Dual,
        effort: &mut Effort,
    ) -> Option<Dual> {
        let program = self.program_of_changes(columns, costs, &at.y);
        let answer = solved_with_retry(&program, Conditioning::Full, effort);
        if answer.status != Status::Solved {
            return None;
        }
        for (y, multiplier) in at.y.iter_mut().zip(&answer.z) {
            *y -= multiplier;
        }
        for (k, (column, place)) in columns.iter().zip(&self.places).enumerate() {
            let reduced = costs[k] - column.dot(&at.y);
            let change = answer.x[k];
            (at.slack[k], at.multipliers[k]) = (0.0, 0.0);
            match place {
                Place::Basic => at.amounts[k] += self.size * change,
                Place::Fixed => {}
                Place::Lower if change > reduced => at.amounts[k] = self.size * change,
                Place::Lower => {
                    at.amounts[k] = 0.0;
                    at.slack[k] = reduced.max(0.0);
                }
                Place::Upper if change > -reduced => {
                    at.amounts[k] = column.limit - self.size * change;
                }
                Place::Upper => {
                    at.amounts[k] = column.limit;
                    at.multipliers[k] = (-reduced).max(0.0);
                }
            }
            at.amounts[k] = at.amounts[k].clamp(0.0, column.limit);
        }
        let spent = costs.iter().zip(&at.amounts).map(|(c, a)| c * a);
        at.objective = spent.sum();
        Some(at)
    }
}
