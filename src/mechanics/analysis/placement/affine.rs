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

use std::collections::BTreeMap;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::model::{Line, Model, Row};
use crate::mechanics::program::QuadraticProgram;
use crate::mechanics::solve::{
    Answer, Conditioning, DeadlineGuard, Effort, SolverSettings, Status, deadline, is_late, solve_forces, solve_in_turn,
};

/// The finest accuracy of a linear program.
const TOLERANCE: f64 = 1e-9;

/// The least accuracy of the last master program, as a share of the gap.
const ACCURACY_OF_GAP: f64 = 0.3;

/// The accuracy of the first master programs. Multipliers in the middle of their range give better new forces than those
/// at its ends, and an interior-point method that stops early returns such multipliers.
const FIRST_TOLERANCE: f64 = 1e-2;

/// How accurately a master program is solved, as a share of the gap that the last new forces left.
const TOLERANCE_OF_GAP: f64 = 1e-2;

/// The optimum is reached if new forces improve it by less than this share.
pub(super) const GAP: f64 = 3e-5;

/// [`GAP`] for more than [`FEW_BODIES`] bodies. With it, a wall of 105 bricks takes less than half the time and an arch of
/// 99 stones three quarters of it. A stack of 100 blocks takes the same time.
const GAP_OF_MANY: f64 = 1e-3;

/// The largest number of bodies for which the optimum is found to five digits.
const FEW_BODIES: usize = 60;

/// The largest number of rounds. The structures of the tests take three to fifteen.
const MAX_ROUNDS: usize = 60;

/// A residual of the balance above this share of the heaviest load makes a proof void.
const MAX_RESIDUAL: f64 = 1e-10;

/// The least amount of a known reaction in a mean, so that a mean exists if all amounts are 0.
const MIN_AMOUNT: f64 = 1e-30;

/// Smaller coefficients of the master program are left out; they are rounding errors.
const MIN_ENTRY: f64 = 1e-9;

/// The least weight of a row for new forces, as a share of the largest weight. Without it, forces in joints that do not
/// matter now could be of any size.
const MIN_WEIGHT: f64 = 1e-7;

/// Of the known forces of a body, only this many with the largest shares in the mean are kept. With three, some walls
/// find the same forces again and again.
const MAX_KNOWN: usize = 8;

/// Known forces with a smaller share in the mean are dropped, if the master program is not solved more accurately than
/// this. A body with one known reaction costs the master program nothing, and most bodies have only one. A larger share
/// lets the search of some doorways go round in circles.
const LEAST_SHARE: f64 = 1e-4;

/// New forces are added for the bodies that make up this share of the improvement.
const SHARE_OF_GAIN: f64 = 0.98;

/// The accuracy of the programs for new forces, as a share of that of the master program, with its bounds.
const NEW_ACCURACY: (f64, f64, f64) = (0.1, 1e-9, 1e-5);

/// The largest tolerance of all, in units of the model.
pub(super) const MOST: f64 = 1e3;

/// The result of the method, in units of the model.
#[derive(Default)]
pub(super) struct Robust {
    /// The largest tolerance with a proof.
    pub proved: f64,
    /// The proof: x₀.
    pub forces: Vec<f64>,
    /// The proof: for each loose body, its number and xᵢ for a moment of 1.
    pub reactions: Vec<(usize, Vec<f64>)>,
    /// The velocities of the motion that is nearest to failing, three for each body.
    pub motion: Vec<f64>,
    /// The row with the largest power in this motion.
    pub row: Option<usize>,
    /// Whether the method ended because of the time limit or its number of rounds.
    pub is_cut: bool,
}

/// A tolerance with x₀ and the xᵢ that prove it, as in [`Robust`].
type Proof = (f64, Vec<f64>, Vec<(usize, Vec<f64>)>);

/// Forces that balance a moment of 1 on a body.
struct Reaction {
    body: usize,
    forces: Vec<f64>,
}

/// Finds the largest tolerance that affine forces prove. With an `aim`, it is searched for only at this tolerance, and
/// the search ends as soon as the aim is proved, or proves to be too large.
pub(super) fn largest_tolerance(model: &Model, aim: Option<f64>) -> Robust {
    let end = aim.unwrap_or_else(|| model.end_of_joints());
    let loose: Vec<usize> = (0..model.moments.len()).filter(|body| model.moments[*body] > 0.0).collect();
    let mut known = Vec::new();
    for body in &loose {
        let (forces, residual) = model.balanced(vec![0.0; model.columns.len()], &model.unit_moment(*body));
        if residual > MAX_RESIDUAL {
            return Robust::default();
        }
        known.push(Reaction { body: *body, forces });
    }
    let gap_allowed = if model.moments.len() > FEW_BODIES { GAP_OF_MANY } else { GAP };
    let mut found = Robust { is_cut: true, ..Robust::default() };
    let (mut tolerance, mut too_large) = (aim.unwrap_or(0.0), f64::INFINITY);
    // Tolerances of solvers are absolute, and the forces on the lightest body must be accurate too.
    let lightest = loose.iter().map(|body| model.moments[*body]).fold(1.0, f64::min);
    let mut accuracy = (FIRST_TOLERANCE * lightest).max(TOLERANCE);
    for _ in 0..MAX_ROUNDS {
        if is_late() {
            return found;
        }
        let rows = model.rows(tolerance);
        let Some(master) = Master::solve(model, &rows, &known, accuracy) else {
            // Probably no forces balance the component with joints as short as this.
            too_large = tolerance;
            if too_large - found.proved <= gap_allowed * too_large || aim.is_some() {
                return found;
            }
            tolerance = found.proved + (too_large - found.proved) / 2.0;
            accuracy = (0.1 * accuracy).max(TOLERANCE);
            continue;
        };
        let weights = &master.multipliers;
        if let Some((proved, forces, reactions)) = master.proved(model, &rows, &known)
            && proved.min(tolerance) >= found.proved
        {
            (found.proved, found.forces, found.reactions) = (proved.min(tolerance), forces, reactions);
        }
        found.motion.clone_from(&master.motion);
        found.row = weights.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map(|(row, _)| row);
        if found.proved >= (1.0 - GAP) * end {
            found.is_cut = false;
            return found;
        }
        let new = cheapest_reactions(model, tolerance, &rows, weights, &loose, accuracy);
        let least: f64 = new.iter().map(|(reaction, cost)| model.moments[reaction.body] * cost).sum();
        // No other forces reach a larger d than this one divided by the least sum. Stop if that is below the aim.
        if aim.is_some_and(|aim| master.largest < 0.99 * aim * least) {
            return found;
        }
        let next = aim.unwrap_or_else(|| master.next(model, &rows, &known, tolerance).clamp(0.0, end));
        let next = if next < too_large { next } else { found.proved + (too_large - found.proved) / 2.0 };
        let is_still = (next - tolerance).abs() <= gap_allowed * next.max(tolerance) || tolerance == 0.0 && next == 0.0;
        let is_proved = found.proved >= (1.0 - 2.0 * gap_allowed) * next;
        if is_still
            && is_proved
            && accuracy <= ACCURACY_OF_GAP * gap_allowed * lightest.max(1e-4)
            && (least >= 1.0 - gap_allowed || loose.is_empty())
        {
            found.is_cut = false;
            return found;
        }
        known = master.renewed(model, &rows, known, new, LEAST_SHARE.min(accuracy));
        let gap = (1.0 - least).max((next - tolerance).abs() / next.max(tolerance));
        // Where the tolerance stands still but is not proved, only more accurate multipliers find better forces.
        let most = if is_still && aim.is_none() { 0.1 * accuracy } else { accuracy };
        accuracy = (TOLERANCE_OF_GAP * gap * lightest).min(most).max(TOLERANCE);
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
        let mut body_row = vec![None; model.moments.len()];
        let mut bound = model.loads.clone();
        let mut matrix = Vec::new();
        for (unknown, column) in model.columns.iter().enumerate() {
            matrix.extend(column.iter().map(|(row, value)| (*row, unknown, *value)));
        }
        // The amounts of a body add up to the tolerance. A single reaction has this amount itself.
        let mut counts = vec![0; model.moments.len()];
        known.iter().for_each(|reaction| counts[reaction.body] += 1);
        let mut places = vec![largest; known.len()];
        let mut end = unknowns + 1;
        for (place, reaction) in places.iter_mut().zip(known).filter(|(_, reaction)| counts[reaction.body] > 1) {
            let row = *body_row[reaction.body].get_or_insert_with(|| {
                let row = bound.len();
                matrix.push((row, largest, -1.0));
                bound.push(0.0);
                row
            });
            *place = end;
            matrix.push((row, end, 1.0));
            end += 1;
        }
        let equalities = bound.len();
        for row in rows {
            matrix.extend(row.entries.iter().map(|(unknown, value)| (bound.len(), *unknown, *value)));
            let mut single = 0.0;
            for (place, reaction) in places.iter().zip(known) {
                let share = row.times(&reaction.forces).abs() * model.moments[reaction.body];
                if *place == largest {
                    single += share;
                } else if share > MIN_ENTRY {
                    matrix.push((bound.len(), *place, share));
                }
            }
            if single > MIN_ENTRY {
                matrix.push((bound.len(), largest, single));
            }
            bound.push(row.limit);
        }
        for place in largest + 1..end {
            matrix.push((bound.len(), place, -1.0));
            bound.push(0.0);
        }
        // Without joints, the tolerance needs a bound of its own.
        matrix.push((bound.len(), largest, 1.0));
        bound.push(MOST);
        let mut linear = vec![0.0; end];
        linear[largest] = -1.0;
        let problem =
            QuadraticProgram { unknowns: linear.len(), quadratic: Vec::new(), linear, matrix, bound, equalities };
        let answer = solved(&problem, accuracy)?;
        Some(Master {
            forces: answer.x[..unknowns].to_vec(),
            largest: answer.x[largest],
            amounts: places.iter().map(|place| answer.x[*place]).collect(),
            multipliers: answer.z[equalities..equalities + rows.len()].iter().map(|z| z.max(0.0)).collect(),
            motion: answer.z[..balances].to_vec(),
        })
    }

    /// Returns the mean of the known reactions of each body with moments.
    fn means(&self, model: &Model, known: &[Reaction]) -> Vec<(usize, Vec<f64>)> {
        let mut sums: Vec<Option<(f64, Vec<f64>)>> = vec![None; model.moments.len()];
        for (reaction, amount) in known.iter().zip(&self.amounts) {
            let amount = amount.max(MIN_AMOUNT);
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

    /// Returns the largest d in front of the sum that these forces prove by arithmetic alone, x₀ and the xᵢ; `None` if they
    /// do not balance.
    fn proved(&self, model: &Model, rows: &[Row], known: &[Reaction]) -> Option<Proof> {
        let (forces, residual) = model.balanced(self.forces.clone(), &model.loads);
        let mut worst = residual;
        let mut sums = vec![0.0; rows.len()];
        let mut means = self.means(model, known);
        for (body, mean) in &mut means {
            let residual;
            (*mean, residual) = model.balanced(std::mem::take(mean), &model.unit_moment(*body));
            worst = worst.max(residual);
            sums.iter_mut().zip(rows).for_each(|(sum, row)| *sum += row.times(mean).abs() * model.moments[*body]);
        }
        if worst > MAX_RESIDUAL || sums.iter().chain(&forces).any(|value| !value.is_finite()) {
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
        Some((proved, forces, means))
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

    /// Returns the known reactions with the largest shares in the mean of each body, and the new ones that improve most.
    fn renewed(
        &self,
        model: &Model,
        rows: &[Row],
        known: Vec<Reaction>,
        new: Vec<(Reaction, f64)>,
        least_share: f64,
    ) -> Vec<Reaction> {
        let mut costs = vec![0.0; model.moments.len()];
        for (body, mean) in self.means(model, &known) {
            costs[body] = cost(rows, &self.multipliers, &mean);
        }
        let gain = |(reaction, cost): &(Reaction, f64)| model.moments[reaction.body] * (costs[reaction.body] - cost);
        let mut gains: Vec<(f64, Reaction)> = new.into_iter().map(|pair| (gain(&pair), pair.0)).collect();
        gains.retain(|pair| pair.0 > 0.0);
        gains.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut left = SHARE_OF_GAIN * gains.iter().map(|pair| pair.0).sum::<f64>();
        let mut pairs: Vec<(Reaction, f64)> = known.into_iter().zip(self.amounts.iter().copied()).collect();
        pairs.sort_by(|(a, x), (b, y)| a.body.cmp(&b.body).then(y.total_cmp(x)));
        let mut kept: Vec<Reaction> = Vec::with_capacity(pairs.len());
        for (reaction, amount) in pairs {
            let others = kept.iter().rev().take_while(|other| other.body == reaction.body).count();
            if others == 0 || others < MAX_KNOWN && amount > least_share * self.largest {
                kept.push(reaction);
            }
        }
        for (gain, reaction) in gains {
            if left > 0.0 {
                kept.push(reaction);
            }
            left -= gain;
        }
        kept
    }
}

/// Returns Σ weight |row · forces|.
fn cost(rows: &[Row], weights: &[f64], forces: &[f64]) -> f64 {
    rows.iter().zip(weights).map(|(row, weight)| weight * row.times(forces).abs()).sum()
}

/// Returns, for each body, the reaction with the least Σ λ |row · x|, and this sum. λ are the weights of the rows.
///
/// In forces ≥ 0 along both senses of the lines of the joints, this is one program with the same columns and costs for
/// all bodies.
fn cheapest_reactions(
    model: &Model,
    tolerance: f64,
    rows: &[Row],
    weights: &[f64],
    bodies: &[usize],
    accuracy: f64,
) -> Vec<(Reaction, f64)> {
    let until = deadline();
    let (share, least, most) = NEW_ACCURACY;
    let accuracy = (share * accuracy).clamp(least, most);
    let unknowns = model.columns.len();
    let heaviest = weights.iter().fold(0.0, |most: f64, weight| most.max(*weight));
    let lines = model.lines(tolerance);
    let (mut matrix, mut linear, mut along) = (Vec::new(), Vec::new(), vec![0.0; unknowns]);
    let balances = model.loads.len();
    for Line { entries, rows: own } in &lines {
        entries.iter().for_each(|(unknown, value)| along[*unknown] = *value);
        let weights: Vec<f64> = weights[own.clone()].iter().map(|weight| weight.max(MIN_WEIGHT * heaviest)).collect();
        let cost = cost(&rows[own.clone()], &weights, &along);
        entries.iter().for_each(|(unknown, _)| along[*unknown] = 0.0);
        let mut column = BTreeMap::new();
        for (unknown, value) in entries {
            model.columns[*unknown].iter().for_each(|(row, entry)| *column.entry(*row).or_insert(0.0) += value * entry);
        }
        for sign in [1.0, -1.0] {
            matrix.extend(column.iter().map(|(row, entry)| (*row, linear.len(), sign * entry)));
            matrix.push((balances + linear.len(), linear.len(), -1.0));
            linear.push(cost);
        }
    }
    let one = |body: &usize| {
        let _guard = DeadlineGuard::new(until);
        if is_late() {
            return None;
        }
        let moment = model.unit_moment(*body);
        let bound = [&moment[..], &vec![0.0; linear.len()]].concat();
        let (linear, matrix) = (linear.clone(), matrix.clone());
        let unknowns = linear.len();
        let problem = QuadraticProgram { unknowns, quadratic: Vec::new(), linear, matrix, bound, equalities: balances };
        let answer = solve_forces(&problem, accuracy).or_else(|| solved(&problem, accuracy))?;
        let mut forces = vec![0.0; model.columns.len()];
        for (line, amounts) in lines.iter().zip(answer.x.chunks_exact(2)) {
            line.entries.iter().for_each(|(unknown, value)| forces[*unknown] += value * (amounts[0] - amounts[1]));
        }
        let (forces, residual) = model.balanced(forces, &moment);
        let cost = cost(rows, weights, &forces);
        (residual <= MAX_RESIDUAL).then_some((Reaction { body: *body, forces }, cost))
    };
    #[cfg(feature = "parallel")]
    return bodies.par_iter().filter_map(one).collect();
    #[cfg(not(feature = "parallel"))]
    return bodies.iter().filter_map(one).collect();
}

/// Solves a linear program; `None` if the solver ends without an optimum.
fn solved(problem: &QuadraticProgram, accuracy: f64) -> Option<Answer> {
    let with = |tolerance, conditioning: Conditioning| SolverSettings { tolerance, ..conditioning.into() };
    let attempts = [
        with(accuracy, Conditioning::Full),
        with(accuracy, Conditioning::Plain),
        with(100.0 * accuracy, Conditioning::Full),
    ];
    let answer = solve_in_turn(problem, attempts, &mut Effort::default());
    (answer.status == Status::Solved).then_some(answer)
}
