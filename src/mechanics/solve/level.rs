//! Refines the optimum of a linear program until it is accurate relative to the load of each body.
//!
//! An interior-point method balances every body to about 10⁻⁹ of the heaviest load. For a body that is a billion times
//! lighter, this residual is as large as its own load. Iterative refinement of linear programs
//! ([GleixnerSteffyWolter16](crate::doc::references)) solves the program again for its residual, level by level. The
//! loads of each level have the size of the residual of the previous level:
//!
//! 1. Residual: loads − Σ amount·column is summed with twice the digits. Its largest entry is ρ.
//! 2. Classification: a column is *basic* if its amount is far above ρ and far from its limit, and its slack is nearly
//!    0. A change of size ρ cannot bring its amount to a bound, so the change may have either sign and has no cost. The
//!    amount of every other column starts again from a bound, with its reduced cost.
//! 3. Correction: the program of the changes is scaled to loads of 1 and solved. Its solution corrects the amounts, its
//!    multipliers correct the velocities.
//! 4. Clean-up: if the slack of a column exceeds its amount, the amount is set exactly to its bound.
//!
//! The velocities of a light body are not accurate until the loads of a level have the size of its load. Each level
//! adds about six correct digits.
//!
//! A solver has about ten correct digits. [`precise_optimum`] refines the least adhesion if the largest load is so much
//! larger than the smallest that this is not enough. Even the adhesion of a stone of a gram on a block of a hundred tons
//! then has correct digits.

use super::optimum::solve_in_turn;
use super::{
    Conditioning, Effort, Face, Optimum, SolverSettings, Status, largest, least_squares_amounts, refine_balance,
};
use crate::geometry::CompensatedSum;
use crate::mechanics::program::{Column, QuadraticProgram};

/// The optimum needs refinement by levels if the lightest load, or the least sum of adhesion, is below this fraction of
/// the heaviest load: it would have fewer than six correct digits. A block below it is light.
pub(super) const WIDE_LOAD_RATIO: f64 = 1e-3;

/// The largest number of levels. Loads that span twelve powers of ten need four.
const MAX_LEVELS: usize = 8;

/// The amount of a basic column, and the distance of the amount from its limit, exceed this multiple of the residual ρ.
///
/// A change may be many times ρ, as the thrust of an arch is many times its load. The factor keeps such a change within
/// the bounds.
const BASIC_AMOUNT_RATIO: f64 = 1e3;

/// The slack of a basic column is at most this in absolute value. For comparison: a unit of force costs about 1, and
/// the solver's tolerance is 10⁻⁹.
const BASIC_SLACK: f64 = 1e-6;

/// Forces this many times smaller than the loads of a level are still accurate at that level.
const DIGITS_OF_LEVEL: f64 = 1e2;

/// A body is balanced if its residual is at most this fraction of its own load.
const BALANCE_TOL: f64 = 1e-10;

/// The residual of a body is also at most this fraction of the smallest forces that must be accurate.
const SMALL_FORCE_TOL: f64 = 1e-8;

/// A residual up to this fraction of Σ |force| on the body counts as rounding and is always allowed.
const ROUNDING_TOL: f64 = 64.0 * f64::EPSILON;

/// If a limit is above this multiple of the loads of a level, forces that balance these loads stay below the limit. The
/// program of this level then has no row for the limit.
const LOOSE_LIMIT: f64 = 1e6;

/// If the limit of a column is below this multiple of the loads of a level, the amount of the column does not change at
/// this level.
const NARROW_LIMIT: f64 = 1e-9;

/// Returns the size of each body's load: the larger of its force and its moment/L.
pub(super) fn block_loads(loads: &[f64]) -> Vec<f64> {
    let bodies = loads.chunks_exact(3);
    bodies.map(|load| libm::hypot(load[0], load[1]).max(load[2].abs())).collect()
}

/// Returns the smallest nonzero load among all bodies, or infinity if no body has a load. The size of a load is defined
/// in [`block_loads`].
pub(super) fn lightest(loads: &[f64]) -> f64 {
    let positive = block_loads(loads).into_iter().filter(|load| *load > 0.0);
    positive.fold(f64::INFINITY, f64::min)
}

/// True if the residual of every body is negligible compared with the body's load and with `force_size`, or is only
/// rounding. `force_size` is the size of the smallest forces that must be accurate.
fn balances_every_body(loads: &[f64], columns: &[Column], amounts: &[f64], force_size: f64) -> bool {
    let remaining = residual(loads, columns, amounts);
    // Compute Σ |force| on each body, to which the rounding error of its residual is proportional.
    let mut acting = block_loads(loads);
    for (column, amount) in columns.iter().zip(amounts) {
        for (row, value) in column.entries() {
            acting[row / 3] += (value * amount).abs();
        }
    }
    let own_loads = block_loads(loads);
    let mut bodies = remaining.chunks_exact(3).zip(own_loads.iter().zip(&acting));
    bodies.all(|(remaining, (own_load, acting))| {
        let allowed = (BALANCE_TOL * own_load).min(SMALL_FORCE_TOL * force_size);
        largest(remaining) <= allowed.max(ROUNDING_TOL * acting)
    })
}

/// Returns the residual loads − Σ amount·column, summed with twice the digits of f64.
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

/// Refines an optimum until forces of size `force_size` are accurate. `None` if the solver finds no optimum at a level,
/// if the residual at a level is exactly 0, or if eight levels are not enough.
///
/// The resulting amounts balance every body. Every column has an amount of exactly 0 or a slack of exactly 0.
pub(super) fn refined_optimum(
    loads: &[f64],
    columns: &[Column],
    cost: impl Fn(&Column) -> f64,
    start: &Optimum,
    force_size: f64,
    effort: &mut Effort,
) -> Option<Optimum> {
    let costs: Vec<f64> = columns.iter().map(cost).collect();
    let mut at = start.clone();
    for _ in 0..MAX_LEVELS {
        let level = Level::new(loads, columns, &costs, &at)?;
        let level_load = level.scale;
        at = level.corrected_optimum(columns, &costs, at, effort)?;
        let balanced = balances_every_body(loads, columns, &at.amounts, force_size);
        if level_load <= DIGITS_OF_LEVEL * force_size && balanced {
            return Some(at);
        }
    }
    None
}

/// Returns the face with the amounts of least Σ force² on it. If no amounts are found, or if they do not balance every
/// body, the face is returned unchanged.
pub(super) fn with_least_squares(face: Face, force_size: f64, settings: SolverSettings, effort: &mut Effort) -> Face {
    let (loads, columns) = (&face.loads, &face.columns);
    let balances = |amounts: &Vec<f64>| balances_every_body(loads, columns, amounts, force_size);
    let found = least_squares_amounts(loads, columns, settings, effort);
    let found =
        found.map(|amounts| if balances(&amounts) { amounts } else { refine_balance(loads, columns, amounts, effort) });
    match found.filter(balances) {
        Some(amounts) => face.with_amounts(amounts),
        None => face,
    }
}

/// How a column may change at a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ColumnStatus {
    /// Its amount starts from 0 and may increase.
    Lower,
    /// Its amount starts from its limit and may decrease.
    Upper,
    /// Its amount may increase or decrease.
    Basic,
    /// Its amount stays the same, because its limit is negligible compared with the loads of this level.
    Fixed,
}

/// One level: the program of the changes of the amounts, scaled to a largest load of 1.
struct Level {
    statuses: Vec<ColumnStatus>,
    /// The loads that the changes must balance, scaled to a largest entry of 1.
    loads: Vec<f64>,
    /// The scale: a load of 1 here is a load of `scale` in the original program.
    scale: f64,
}

impl Level {
    fn new(loads: &[f64], columns: &[Column], costs: &[f64], at: &Optimum) -> Option<Level> {
        // Step 1: compute the residual.
        let rho = largest(&residual(loads, columns, &at.amounts));
        // Step 2: classify each column, and choose its initial amount for this level.
        let classify = |k: usize| {
            let (column, amount) = (&columns[k], at.amounts[k]);
            let slack = costs[k] - column.dot(&at.y);
            let distance_to_bound = amount.min(column.limit - amount);
            if distance_to_bound > BASIC_AMOUNT_RATIO * rho && slack.abs() <= BASIC_SLACK {
                (ColumnStatus::Basic, amount)
            } else if column.limit.is_finite() && slack < 0.0 {
                (ColumnStatus::Upper, column.limit)
            } else {
                (ColumnStatus::Lower, 0.0)
            }
        };
        let (mut statuses, initial): (Vec<ColumnStatus>, Vec<f64>) = (0..columns.len()).map(classify).unzip();
        // The loads of this level are the part of the loads that these initial amounts do not balance.
        let remaining = residual(loads, columns, &initial);
        let scale = largest(&remaining);
        if scale == 0.0 || !scale.is_finite() {
            return None;
        }
        for (status, column) in statuses.iter_mut().zip(columns) {
            if column.limit < NARROW_LIMIT * scale {
                *status = ColumnStatus::Fixed;
            }
        }
        Some(Level { statuses, loads: remaining.iter().map(|v| v / scale).collect(), scale })
    }

    /// Builds the linear program of step 3: min Σ reduced cost·change s.t. the changes balance the loads of the level.
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
        for (k, (column, status)) in columns.iter().zip(&self.statuses).enumerate() {
            let sign = if *status == ColumnStatus::Upper { -1.0 } else { 1.0 };
            let reduced = costs[k] - column.dot(y);
            if *status != ColumnStatus::Fixed {
                let entries = column.entries().map(|(row, v)| (row, k, sign * v));
                program.matrix.extend(entries);
            }
            // The change of a basic column has no cost and no bounds.
            if *status == ColumnStatus::Basic {
                continue;
            }
            program.linear[k] = (sign * reduced).max(0.0);
            program.matrix.push((program.bound.len(), k, -1.0));
            program.bound.push(0.0);
            if *status == ColumnStatus::Fixed || column.limit < LOOSE_LIMIT * self.scale {
                let limit = match status {
                    ColumnStatus::Fixed => 1.0,
                    _ => column.limit / self.scale,
                };
                program.matrix.push((program.bound.len(), k, 1.0));
                program.bound.push(limit);
            }
        }
        program
    }

    /// Steps 3 and 4: solves the program of changes, and returns the corrected optimum. `None` if the solver finds no
    /// optimum.
    fn corrected_optimum(
        &self,
        columns: &[Column],
        costs: &[f64],
        mut at: Optimum,
        effort: &mut Effort,
    ) -> Option<Optimum> {
        let program = self.program_of_changes(columns, costs, &at.y);
        let answer = solve_in_turn(&program, [Conditioning::Full.into()], effort);
        if answer.status != Status::Solved {
            return None;
        }
        // Correct the velocities by the multipliers of the balance rows.
        for (y, multiplier) in at.y.iter_mut().zip(&answer.z) {
            *y -= multiplier;
        }
        // Step 4: an amount leaves its bound only if its change exceeds the reduced cost of the column.
        for (k, (column, status)) in columns.iter().zip(&self.statuses).enumerate() {
            let reduced = costs[k] - column.dot(&at.y);
            let change = answer.x[k];
            (at.slack[k], at.multipliers[k]) = (0.0, 0.0);
            match status {
                ColumnStatus::Basic => at.amounts[k] += self.scale * change,
                ColumnStatus::Fixed => {}
                ColumnStatus::Lower if change > reduced => at.amounts[k] = self.scale * change,
                ColumnStatus::Lower => {
                    at.amounts[k] = 0.0;
                    at.slack[k] = reduced.max(0.0);
                }
                ColumnStatus::Upper if change > -reduced => {
                    at.amounts[k] = column.limit - self.scale * change;
                }
                ColumnStatus::Upper => {
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

/// A least sum of adhesion below this fraction of the largest load counts as 0: it is the rounding of the loads.
///
/// A push on a heavy stone without friction needs adhesion, even if the push is far below the solver's tolerance.
const ZERO_ADHESION: f64 = 1e-15;

/// [`ZERO_ADHESION`] for many blocks, where a refinement takes long. It is a tenth of the solver's tolerance.
const ZERO_ADHESION_MANY: f64 = 1e-10;

/// Refined sums of adhesion whose relative difference is at most this count as equal. It is a hundredth of the error
/// that a result may have.
pub(super) const SUM_TOL_PRECISE: f64 = 1e-8;

/// If the refined sum of adhesion is below this multiple of the smallest accurate force, the optimum is refined again.
const REFINE_AGAIN_RATIO: f64 = 1e-2;

/// Returns the size of the smallest forces that must be accurate, in the units of the loads.
///
/// `None` if this size is so close to the largest load that the unrefined optimum is accurate enough. `least_sum` is
/// the least sum of adhesion, and `has_many_blocks` says whether the program has many blocks.
fn smallest_accurate_force(loads: &[f64], least_sum: f64, has_many_blocks: bool) -> Option<f64> {
    let largest_load = largest(loads);
    let light = lightest(loads);
    let zero_tol = if has_many_blocks { ZERO_ADHESION_MANY } else { ZERO_ADHESION };
    let is_small = zero_tol * largest_load < least_sum && least_sum < WIDE_LOAD_RATIO * largest_load;
    let force_size = if is_small { light.min(least_sum) } else { light };
    (force_size < WIDE_LOAD_RATIO * largest_load && force_size > 0.0).then_some(force_size)
}

/// Returns the refined optimum of stage 1, and the size of the smallest forces that are accurate in it.
///
/// `None` if loads and adhesion do not differ by many powers of ten, or if the refinement fails. `first` is the optimum
/// of stage 1; `has_many_blocks` says whether the program has many blocks. The unrefined sum of adhesion may consist
/// only of the solver's error. If the refined sum is far smaller than the smallest accurate force, the optimum is
/// therefore refined again.
pub(super) fn precise_optimum(
    whole: &Face,
    first: &Optimum,
    has_many_blocks: bool,
    effort: &mut Effort,
) -> Option<(Optimum, f64)> {
    let (loads, columns) = (&whole.loads, &whole.columns);
    let cost = |c: &Column| f64::from(u8::from(c.force.is_adhesion()));
    let mut refined = |start: &Optimum| {
        let least_sum = whole.adhesion_sum(&start.amounts);
        let force_size = smallest_accurate_force(loads, least_sum, has_many_blocks)?;
        let found = refined_optimum(loads, columns, cost, start, force_size, effort)?;
        Some((found, force_size))
    };
    let (found, force_size) = refined(first)?;
    if whole.adhesion_sum(&found.amounts) < REFINE_AGAIN_RATIO * force_size {
        refined(&found).or(Some((found, force_size)))
    } else {
        Some((found, force_size))
    }
}
