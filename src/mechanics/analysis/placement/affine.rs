//! The proved part of a placement tolerance: forces that are affine in the errors.
//!
//! The forces x = x₀ + Σ eᵢ xᵢ balance the component for all errors |eᵢ| ≤ d if A x₀ = loads, A xᵢ balances the moment
//! of body i per unit of error, and each row g of the joints (with their ends d inside their places) has
//! g·x₀ + d Σ |g·xᵢ| ≤ limit. Find the largest d:
//!
//! 1. *Master program.* For a given d in the rows, choose x₀ and, for each body, a mean of the known xᵢ, such that the
//!    second d, in front of the sum, is largest. Newton's method on both leads to the d at which they are equal.
//! 2. *New forces.* With the multipliers λ of the rows, find for each body the xᵢ with the least Σ λ |g·xᵢ|. Add them
//!    to the known forces. If they do not improve the sum over all bodies, the optimum is reached.
//!
//! This is column generation (Dantzig and Wolfe 1960). Every round has its own proof, so a time limit only makes the
//! tolerance smaller.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::model::{Model, Row};
use crate::mechanics::program::QuadraticProgram;
use crate::mechanics::solve::{Answer, Conditioning, DeadlineGuard, Status, deadline, is_late, solve};

/// The finest accuracy of a linear program.
const TOLERANCE: f64 = 1e-9;

/// The least accuracy of the last master program.
const LAST_TOLERANCE: f64 = 1e-5;

/// The accuracy of the first master programs. Multipliers in the middle of their range give better new forces than those
/// at its ends, and an interior-point method that stops early returns such multipliers.
const FIRST_TOLERANCE: f64 = 1e-2;

/// How accurately a master program is solved, as a share of the gap that the last new forces left.
const TOLERANCE_OF_GAP: f64 = 1e-2;

/// The optimum is reached if new forces improve it by less than this share.
const GAP: f64 = 3e-5;

/// The largest number of rounds. The structures of the tests take three to fifteen.
const MAX_ROUNDS: usize = 60;

/// A residual of the balance above this share of the heaviest load makes a proof void.
const MAX_RESIDUAL: f64 = 1e-10;

/// Smaller coefficients of the master program are left out; they are rounding errors.
const MIN_ENTRY: f64 = 1e-9;

/// The least weight of a row for new forces, as a share of the largest weight. Without it, forces in joints that do not
/// matter now could be of any size.
const MIN_WEIGHT: f64 = 1e-7;

/// Of the known forces of a body, only this many with the largest shares in the mean are kept.
const MAX_KNOWN: usize = 3;

/// The accuracy of the programs for new forces, as a share of that of the master program, with its bounds.
const NEW_ACCURACY: (f64, f64, f64) = (0.1, 1e-9, 1e-5);

/// The result of the method, in units of the model.
pub(super) struct Robust {
    /// The largest tolerance with a proof.
    pub proved: f64,
    /// The velocities of the motion that is nearest to failing, three for each body.
    pub motion: Vec<f64>,
    /// The row with the largest power in this motion.
    pub row: Option<usize>,
    /// Whether the method ended because of the time limit or its number of rounds.
    pub is_cut: bool,
}

/// Forces that balance a moment of 1 on a body.
struct Reaction {
    body: usize,
    forces: Vec<f64>,
}

/// Finds the largest tolerance that affine forces prove.
pub(super) fn largest_tolerance(model: &Model) -> Robust {
    let end = model.end_of_joints();
    let loose: Vec<usize> = (0..model.moments.len()).filter(|body| model.moments[*body] > 0.0).collect();
    let mut known = Vec::new();
    for body in &loose {
        let (forces, residual) = model.balanced(vec![0.0; model.columns.len()], &model.unit_moment(*body));
        if residual > MAX_RESIDUAL {
            return Robust { proved: 0.0, motion: Vec::new(), row: None, is_cut: false };
        }
        known.push(Reaction { body: *body, forces });
    }
    let mut found = Robust { proved: 0.0, motion: Vec::new(), row: None, is_cut: true };
    let mut tolerance = 0.0;
    // Tolerances of solvers are absolute, and the forces on the lightest body must be accurate too.
    let lightest = loose.iter().map(|body| model.moments[*body]).fold(1.0, f64::min);
    let mut accuracy = (FIRST_TOLERANCE * lightest).max(TOLERANCE);
    for _ in 0..MAX_ROUNDS {
        if is_late() {
            return found;
        }
        let rows = model.rows(tolerance);
        let Some(master) = Master::solve(model, &rows, &known, accuracy) else { return found };
        let weights = &master.multipliers;
        if let Some(proved) = master.proved(model, &rows, &known)
            && proved.min(tolerance) >= found.proved
        {
            found.proved = proved.min(tolerance);
        }
        found.motion.clone_from(&master.motion);
        found.row = weights.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map(|(row, _)| row);
        let new = cheapest_reactions(model, &rows, weights, &loose, accuracy);
        let least: f64 = new.iter().map(|(reaction, cost)| model.moments[reaction.body] * cost).sum();
        let next = master.next(model, &rows, &known, tolerance).clamp(0.0, end);
        let is_still = (next - tolerance).abs() <= GAP * next.max(tolerance) || tolerance == 0.0 && next == 0.0;
        if is_still && accuracy <= LAST_TOLERANCE * lightest.max(1e-4) && (least >= 1.0 - GAP || loose.is_empty()) {
            found.is_cut = false;
            return found;
        }
        known = master.used(known);
        known.extend(new.into_iter().map(|(reaction, _)| reaction));
        let gap = (1.0 - least).max((next - tolerance).abs() / next.max(tolerance));
        accuracy = (TOLERANCE_OF_GAP * gap * lightest).clamp(TOLERANCE, accuracy);
        tolerance = next;
    }
    found
}

/// The optimum of a master program.
struct Master {
    /// x₀.
    forces: Vec<f64>,
    /// The largest d in front of the sum.
    largest: f64,
    /// The amount of each known reaction; those of one body add up to `largest`.
    amounts: Vec<f64>,
    /// The multipliers of the rows.
    multipliers: Vec<f64>,
    /// The multipliers of the balance.
    motion: Vec<f64>,
}

impl Master {
    fn solve(model: &Model, rows: &[Row], known: &[Reaction], accuracy: f64) -> Option<Master> {
        let (unknowns, balances) = (model.columns.len(), model.loads.len());
        let largest = unknowns;
        let amount = |number: usize| unknowns + 1 + number;
        let mut body_row = vec![None; model.moments.len()];
        let mut bound = model.loads.clone();
        let mut matrix = Vec::new();
        for (unknown, column) in model.columns.iter().enumerate() {
            matrix.extend(column.iter().map(|(row, value)| (*row, unknown, *value)));
        }
        // The amounts of a body add up to the tolerance.
        for (number, reaction) in known.iter().enumerate() {
            let row = *body_row[reaction.body].get_or_insert_with(|| {
                let row = bound.len();
                matrix.push((row, largest, -1.0));
                bound.push(0.0);
                row
            });
            matrix.push((row, amount(number), 1.0));
        }
        let equalities = bound.len();
        for row in rows {
            matrix.extend(row.entries.iter().map(|(unknown, value)| (bound.len(), *unknown, *value)));
            for (number, reaction) in known.iter().enumerate() {
                let share = row.times(&reaction.forces).abs() * model.moments[reaction.body];
                if share > MIN_ENTRY {
                    matrix.push((bound.len(), amount(number), share));
                }
            }
            bound.push(row.limit);
        }
        for number in 0..known.len() {
            matrix.push((bound.len(), amount(number), -1.0));
            bound.push(0.0);
        }
        // With no reactions at all, the tolerance needs a bound of its own.
        matrix.push((bound.len(), largest, 1.0));
        bound.push(1e3);
        let mut linear = vec![0.0; amount(known.len())];
        linear[largest] = -1.0;
        let problem =
            QuadraticProgram { unknowns: linear.len(), quadratic: Vec::new(), linear, matrix, bound, equalities };
        let answer = solved(&problem, accuracy)?;
        Some(Master {
            forces: answer.x[..unknowns].to_vec(),
            largest: answer.x[largest],
            amounts: answer.x[unknowns + 1..].to_vec(),
            multipliers: answer.z[equalities..equalities + rows.len()].iter().map(|z| z.max(0.0)).collect(),
            motion: answer.z[..balances].to_vec(),
        })
    }

    /// Returns the mean of the known reactions of each body with moments.
    fn means(&self, model: &Model, known: &[Reaction]) -> Vec<(usize, Vec<f64>)> {
        let mut sums: Vec<Option<(f64, Vec<f64>)>> = vec![None; model.moments.len()];
        for (reaction, amount) in known.iter().zip(&self.amounts) {
            let amount = amount.max(0.0);
            let (total, sum) = sums[reaction.body].get_or_insert_with(|| (0.0, vec![0.0; model.columns.len()]));
            *total += amount;
            sum.iter_mut().zip(&reaction.forces).for_each(|(s, force)| *s += amount * force);
        }
        let bodies = sums.into_iter().enumerate();
        let means = bodies.filter_map(|(body, sum)| {
            let (total, sum) = sum?;
            Some((body, sum.iter().map(|s| s / total).collect()))
        });
        means.collect()
    }

    /// Returns the largest d in front of the sum that these forces prove by arithmetic alone; `None` if they do not
    /// balance.
    fn proved(&self, model: &Model, rows: &[Row], known: &[Reaction]) -> Option<f64> {
        let (forces, residual) = model.balanced(self.forces.clone(), &model.loads);
        let mut worst = residual;
        let mut sums = vec![0.0; rows.len()];
        for (body, mean) in self.means(model, known) {
            let (mean, residual) = model.balanced(mean, &model.unit_moment(body));
            worst = worst.max(residual);
            sums.iter_mut().zip(rows).for_each(|(sum, row)| *sum += row.times(&mean).abs() * model.moments[body]);
        }
        if worst.is_nan() || worst > MAX_RESIDUAL {
            return None;
        }
        let mut proved = f64::INFINITY;
        for (row, sum) in rows.iter().zip(&sums) {
            let room = row.limit - row.times(&forces);
            if room < 0.0 {
                return None;
            }
            if *sum > 0.0 {
                proved = proved.min(room / sum);
            }
        }
        Some(proved)
    }

    /// Returns the tolerance at which both values of d are expected to be equal: one step of Newton's method.
    fn next(&self, model: &Model, rows: &[Row], known: &[Reaction], tolerance: f64) -> f64 {
        let mut slope = 0.0;
        for (row, weight) in rows.iter().zip(&self.multipliers) {
            let mut growth = row.growth(&self.forces);
            for (reaction, amount) in known.iter().zip(&self.amounts) {
                let sign = row.times(&reaction.forces).signum();
                growth += amount.max(0.0) * model.moments[reaction.body] * sign * row.growth(&reaction.forces);
            }
            slope -= weight * growth;
        }
        tolerance + (self.largest - tolerance) / (1.0 - slope.min(0.0))
    }

    /// Returns the known reactions of each body with the largest shares in its mean.
    fn used(&self, known: Vec<Reaction>) -> Vec<Reaction> {
        let mut pairs: Vec<(Reaction, f64)> = known.into_iter().zip(self.amounts.iter().copied()).collect();
        pairs.sort_by(|(a, x), (b, y)| a.body.cmp(&b.body).then(y.total_cmp(x)));
        let mut kept: Vec<Reaction> = Vec::with_capacity(pairs.len());
        for (reaction, _) in pairs {
            let others = kept.iter().rev().take_while(|other| other.body == reaction.body).count();
            if others < MAX_KNOWN {
                kept.push(reaction);
            }
        }
        kept
    }
}

/// Returns, for each body, the reaction with the least Σ λ |row · x|, and this sum. λ are the weights of the rows.
fn cheapest_reactions(
    model: &Model,
    rows: &[Row],
    weights: &[f64],
    bodies: &[usize],
    accuracy: f64,
) -> Vec<(Reaction, f64)> {
    let until = deadline();
    let (share, least, most) = NEW_ACCURACY;
    let accuracy = (share * accuracy).clamp(least, most);
    let one = |body: &usize| {
        let _guard = DeadlineGuard::new(until);
        cheapest_reaction(model, rows, weights, *body, accuracy)
    };
    #[cfg(feature = "parallel")]
    return bodies.par_iter().filter_map(one).collect();
    #[cfg(not(feature = "parallel"))]
    return bodies.iter().filter_map(one).collect();
}

fn cheapest_reaction(
    model: &Model,
    rows: &[Row],
    weights: &[f64],
    body: usize,
    accuracy: f64,
) -> Option<(Reaction, f64)> {
    let unknowns = model.columns.len();
    let most = weights.iter().fold(0.0, |most: f64, weight| most.max(*weight));
    let mut matrix = Vec::new();
    for (unknown, column) in model.columns.iter().enumerate() {
        matrix.extend(column.iter().map(|(row, value)| (*row, unknown, *value)));
    }
    let mut bound = model.unit_moment(body);
    let equalities = bound.len();
    let mut linear = vec![0.0; unknowns];
    for (row, weight) in rows.iter().zip(weights) {
        let size = linear.len();
        linear.push(weight.max(MIN_WEIGHT * most));
        for sign in [1.0, -1.0] {
            matrix.extend(row.entries.iter().map(|(unknown, value)| (bound.len(), *unknown, sign * value)));
            matrix.push((bound.len(), size, -1.0));
            bound.push(0.0);
        }
    }
    let problem = QuadraticProgram { unknowns: linear.len(), quadratic: Vec::new(), linear, matrix, bound, equalities };
    let answer = solved(&problem, accuracy)?;
    let (forces, residual) = model.balanced(answer.x[..unknowns].to_vec(), &model.unit_moment(body));
    let cost = rows.iter().zip(weights).map(|(row, weight)| weight * row.times(&forces).abs()).sum();
    (residual <= MAX_RESIDUAL).then_some((Reaction { body, forces }, cost))
}

/// Solves a linear program; `None` if the solver ends without an optimum.
fn solved(problem: &QuadraticProgram, accuracy: f64) -> Option<Answer> {
    let attempts = [(1.0, Conditioning::Full), (1.0, Conditioning::Plain), (100.0, Conditioning::Full)];
    attempts
        .into_iter()
        .map(|(factor, conditioning)| solve(problem, factor * accuracy, conditioning))
        .find(|answer| answer.status == Status::Solved)
}
