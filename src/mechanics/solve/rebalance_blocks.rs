//! Slightly changes the forces that a solver returned, until every block is balanced relative to the forces on that
//! block.
//!
//! A solver balances every block to a billionth of the heaviest load. For a wall as a whole, this is accurate. For a
//! pebble in the wall, however, the error can exceed the weight of the pebble. Two programs correct the forces by
//! iterative refinement:
//!
//! - [`rebalance_relative`] measures the residual of each block relative to the forces on the block, and the change of
//!   each ray of a friction cone relative to its amount. The least change is the solution of a linear system.
//! - [`rebalance_absolute`] computes the least change that keeps every amount admissible, by a quadratic program. It is
//!   used for a part of a structure that is scaled separately. The forces on this part from outside do not change.
//!
//! Residuals are small differences of large forces, so they are summed with twice the digits of f64. Reference: Higham,
//! Accuracy and Stability of Numerical Algorithms, 2002, chapter 12 (iterative refinement).

use super::optimum::solve_in_turn;
use super::settings::ROUNDING_TOL;
use super::solver::all_finite;
use super::{Amounts, Conditioning, Effort, Status};
use crate::geometry::{CompensatedSum, Vector, quarter_turn};
use crate::mechanics::program::{Column, Correction, Force, Program, QuadraticProgram, columns, least_squares};

/// The largest number of rounds. Each round adds about as many correct digits as the solver reaches.
const MAX_ROUNDS: usize = 4;

/// The weight of the remaining residual of a block, compared with the relative changes of forces (a quadratic penalty).
///
/// If it were ten times smaller, some residual would remain; if it were ten times larger, the linear system would lose
/// digits.
const IMBALANCE_WEIGHT: f64 = 1e8;

/// A round must gain this number of decimal digits in total, or it is rejected. It corresponds to halving one block's
/// residual.
const MIN_DIGITS_GAINED: f64 = 0.3;

/// In a round, an amount may decrease by at most its own value or this multiple of the residual, whichever is smaller.
///
/// The second value is tried if no balance is found with the first value. On a support whose width is a millionth of a
/// block, forces must change by a million times the residual to balance its moment.
const UNBOUNDED_RATIOS: [f64; 2] = [1e4, 1e8];

/// Returns the residual loads − Σ force of a program, one number for each row, and Σ |force| on each block, including
/// its load.
fn block_residuals(program: &Program, amounts: &Amounts) -> (Vec<f64>, Vec<f64>) {
    // The sums begin with the loads; each force is then subtracted in the three rows of its block.
    let mut sums: Vec<CompensatedSum> = vec![CompensatedSum::default(); program.loads.len()];
    for (sum, load) in sums.iter_mut().zip(&program.loads) {
        sum.add(*load);
    }
    let mut total: Vec<f64> = program.loads.chunks_exact(3).map(|load| libm::hypot(load[0], load[1])).collect();
    let mut act = |block: usize, arm: Vector, direction: Vector, amount: f64| {
        let row = 3 * block;
        sums[row].add_product(-amount, direction.x);
        sums[row + 1].add_product(-amount, direction.y);
        sums[row + 2].add_product(-arm.x, direction.y * amount);
        sums[row + 2].add_product(arm.y, direction.x * amount);
        total[block] += amount.abs();
    };
    for (k, contact) in program.contacts.iter().enumerate() {
        let (normal, tangent) = (contact.normal, quarter_turn(contact.normal));
        let sides = [Some((contact.on, 1.0)), contact.from.map(|from| (from, -1.0))];
        for ((block, arms), sign) in sides.into_iter().flatten() {
            act(block, arms[0], normal * sign, amounts.normal[k][0]);
            act(block, arms[1], normal * sign, amounts.normal[k][1]);
            act(block, arms[0], tangent * sign, amounts.friction[k]);
        }
    }
    for (grip, [x, y, _]) in program.grips.iter().zip(&amounts.grip) {
        act(grip.block, grip.arm, Vector::new(1.0, 0.0), *x);
        act(grip.block, grip.arm, Vector::new(0.0, 1.0), *y);
    }
    // The torque of a grip has no arm and acts only on the moment row.
    for (grip, [_, _, moment]) in program.grips.iter().zip(&amounts.grip) {
        sums[3 * grip.block + 2].add(-moment);
    }
    (sums.into_iter().map(CompensatedSum::value).collect(), total)
}

/// Divides given forces into amounts of the columns `list`. Every ray of the friction cone of a contact with pressure
/// gets an amount above 0, unless the friction is at its limit.
///
/// Let s be |T|/(μN), the fraction of the friction limit that is used. The normal force N is divided into three parts:
/// (1 − s)/2 along the normal, (1 + 3s)/4 along the ray on the side of T, and (1 − s)/4 along the other ray.
fn ray_amounts(program: &Program, list: &[Column], amounts: &Amounts) -> Vec<f64> {
    let amount = |column: &Column| match column.force {
        Force::Ray { contact, point, normal, friction } => {
            // `friction_use` is s with the sign of T: the fraction of the friction limit that is used.
            let pressed = amounts.normal[contact][point];
            let mu = program.contacts[contact].friction;
            let [first, second] = amounts.normal[contact];
            let friction_limit = mu * (first + second);
            let friction_use =
                if friction_limit > 0.0 { (amounts.friction[contact] / friction_limit).clamp(-1.0, 1.0) } else { 0.0 };
            let share = if mu == 0.0 {
                1.0
            } else if friction == 0.0 {
                0.5 * (1.0 - friction_use.abs())
            } else if friction * friction_use > 0.0 {
                0.25 * (1.0 + 3.0 * friction_use.abs())
            } else {
                0.25 * (1.0 - friction_use.abs())
            };
            share * pressed / normal
        }
        Force::Grip { grip, component, sign } => (sign * amounts.grip[grip][component]).max(0.0),
        _ => 0.0,
    };
    list.iter().map(amount).collect()
}

/// Returns the forces after the amounts of the columns change by `changes`. Normal forces that become negative are
/// set to 0.
fn apply(amounts: &Amounts, list: &[Column], changes: &[f64]) -> Amounts {
    let mut changed = amounts.clone();
    for (column, change) in list.iter().zip(changes) {
        changed.add(column.force, *change);
    }
    for normal in changed.normal.iter_mut().flatten() {
        *normal = normal.max(0.0);
    }
    changed
}

/// Returns, for each row, the factor that makes its residual relative to the forces on the block: 1/Σ|force|, and for a
/// moment 1/(Σ|force|·longest arm).
fn row_scales(program: &Program, total: &[f64]) -> Vec<f64> {
    // Find the longest arm of each block.
    let mut longest_arm = vec![0.0; program.blocks];
    let mut extend_arm = |block: usize, arm: Vector| longest_arm[block] = f64::max(longest_arm[block], arm.norm());
    for contact in &program.contacts {
        let sides = [Some(contact.on), contact.from];
        for (block, arms) in sides.into_iter().flatten() {
            arms.into_iter().for_each(|arm| extend_arm(block, arm));
        }
    }
    for grip in &program.grips {
        extend_arm(grip.block, grip.arm);
    }
    let reciprocal = |v: f64| if v > 0.0 { 1.0 / v } else { 1.0 };
    let rows = total.iter().zip(&longest_arm);
    rows.flat_map(|(total, longest_arm)| {
        [reciprocal(*total), reciprocal(*total), reciprocal(*total) * reciprocal(*longest_arm)]
    })
    .collect()
}

/// Returns the largest absolute entry of a residual after each row is multiplied by its scale.
fn largest_scaled(residual: &[f64], scales: &[f64]) -> f64 {
    let off = residual.iter().zip(scales).map(|(v, d)| (v * d).abs());
    off.fold(0.0, f64::max)
}

/// Changes given forces slightly to reduce the residual of each block relative to the forces on it. `None` if no change
/// improves the balance.
///
/// Let r be the residual and ε the relative changes of the amounts. Let W be the diagonal matrix of the amounts of the
/// rays, and D the diagonal matrix of the scales of the rows. Each round solves the program min ½ |ε|² + ½ weight |v|²
/// s.t.  D A W ε + v = D r. A block that no forces can balance keeps its residual v.
pub fn rebalance_relative(program: &Program, amounts: &Amounts, effort: &mut Effort) -> Option<Amounts> {
    let list = columns(program);
    let (mut best, mut is_improved) = (amounts.clone(), false);
    for _ in 0..MAX_ROUNDS {
        // Compute the residual of each block, relative to the forces on it.
        let (residual, total) = block_residuals(program, &best);
        let scales = row_scales(program, &total);
        let size = largest_scaled(&residual, &scales);
        if size <= ROUNDING_TOL {
            break;
        }
        let weights = ray_amounts(program, &list, &best);
        let used: Vec<usize> = (0..list.len()).filter(|k| weights[*k] > 0.0).collect();
        let conic = relative_changes(&list, &used, &weights, &scales, &residual, size);
        // If the loads are near the smallest number of f64, the scales are infinite. Stop then.
        if !all_finite(&conic) {
            break;
        }
        let answer = solve_in_turn(&conic, [Conditioning::Full.into()], effort);
        if answer.status != Status::Solved {
            break;
        }
        let mut changes = vec![0.0; list.len()];
        for (unknown, k) in used.iter().enumerate() {
            // No amount decreases below half of its value, so that a later round can increase it again.
            changes[*k] = (answer.x[unknown] * size).max(-0.5) * weights[*k];
        }
        let next = apply(&best, &list, &changes);
        let (after, total) = block_residuals(program, &next);
        // Convergence test: the number of correct digits, summed over all blocks, must increase. It need not increase
        // for every block, because some blocks may have no balance.
        if balanced_digits(&after, &row_scales(program, &total))
            < balanced_digits(&residual, &scales) + MIN_DIGITS_GAINED
        {
            break;
        }
        (best, is_improved) = (next, true);
    }
    is_improved.then_some(best)
}

/// Builds the quadratic program for one round of [`rebalance_relative`]: its unknowns are the relative changes ε of the
/// columns `used` and the remaining residual v of each row.
///
/// `residual` is loads − Σ force, and `size` its largest scaled entry.
fn relative_changes(
    list: &[Column],
    used: &[usize],
    weights: &[f64],
    scales: &[f64],
    residual: &[f64],
    size: f64,
) -> QuadraticProgram {
    let rows = residual.len();
    let unknowns = used.len() + rows;
    let scaled = residual.iter().zip(scales).map(|(v, d)| v * d / size);
    let mut conic = QuadraticProgram {
        unknowns,
        quadratic: Vec::with_capacity(unknowns),
        linear: vec![0.0; unknowns],
        matrix: Vec::with_capacity(6 * used.len() + rows),
        bound: scaled.collect(),
        equalities: rows,
    };
    for (unknown, k) in used.iter().enumerate() {
        conic.quadratic.push((unknown, unknown, 1.0));
        for (row, value) in list[*k].entries() {
            let entry = value * weights[*k] * scales[row];
            conic.matrix.push((row, unknown, entry));
        }
    }
    for row in 0..rows {
        let unknown = used.len() + row;
        conic.quadratic.push((unknown, unknown, IMBALANCE_WEIGHT));
        conic.matrix.push((row, unknown, 1.0));
    }
    conic
}

/// Returns the number of decimal digits to which each block is balanced, summed over all blocks.
fn balanced_digits(residual: &[f64], scales: &[f64]) -> f64 {
    residual
        .chunks_exact(3)
        .zip(scales.chunks_exact(3))
        .map(|(residual, scales)| -libm::log10(largest_scaled(residual, scales).max(1e-16)))
        .sum()
}

/// Changes given forces by as little as possible, in up to four rounds, until they balance every block up to rounding.
/// `None` if no change improves the balance.
pub fn rebalance_absolute(program: &Program, amounts: &Amounts, effort: &mut Effort) -> Option<Amounts> {
    let list = columns(program);
    let (mut best, mut is_improved) = (amounts.clone(), false);
    for _ in 0..MAX_ROUNDS {
        let Some(next) =
            (UNBOUNDED_RATIOS.into_iter()).find_map(|ratio| correct_once(program, &list, &best, ratio, effort))
        else {
            break;
        };
        (best, is_improved) = (next, true);
    }
    is_improved.then_some(best)
}

/// Performs one round of [`rebalance_absolute`]: returns forces whose residual is at most half as large, or `None` if
/// it finds no such forces.
///
/// An amount decreases by at most its own value or `ratio` times the residual, whichever is smaller (see
/// [`UNBOUNDED_RATIOS`]).
fn correct_once(
    program: &Program,
    list: &[Column],
    best: &Amounts,
    ratio: f64,
    effort: &mut Effort,
) -> Option<Amounts> {
    // Scale the residual so that its largest entry is 1.
    let (residual, _) = block_residuals(program, best);
    let size = residual.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let weights = ray_amounts(program, list, best);
    let largest_weight = weights.iter().fold(0.0, |m: f64, v| m.max(*v));
    if size <= f64::EPSILON * largest_weight || size == 0.0 {
        return None;
    }
    let scaled: Vec<f64> = residual.iter().map(|v| v / size).collect();
    let correction = Correction { amounts: &weights, size, largest: ratio };
    let conic = least_squares(&scaled, list, Some(correction));
    if !all_finite(&conic) {
        return None;
    }
    let answer = solve_in_turn(&conic, [Conditioning::Full.into()], effort);
    if answer.status != Status::Solved {
        return None;
    }
    let changes: Vec<f64> = answer.x.iter().map(|d| d * size).collect();
    // Accept the change only if it halves the residual.
    let changed = apply(best, list, &changes);
    let (residual, _) = block_residuals(program, &changed);
    residual.iter().all(|v| v.abs() <= 0.5 * size).then_some(changed)
}

#[cfg(test)]
mod tests;
