//! Checks certificates of infeasibility (Farkas): multipliers z with Aᵀz = 0, bᵀz < 0 and z ≥ 0 on inequalities.
//!
//! With such multipliers, no x satisfies the rows Ax ≤ b (equalities for the first rows). The multipliers of a solver
//! satisfy Aᵀz = 0 only approximately. They are corrected until every x up to [`MAX_DISPLACEMENT`] is ruled out.
//! Reference: Boyd and Vandenberghe, Convex Optimization, 2004, §5.8 (theorems of alternatives).

use crate::mechanics::program::{Program, QuadraticProgram};
use crate::mechanics::proof::Proof;
use crate::mechanics::solve::{Conditioning, Status, TOLERANCE, solve};

/// Displacements and forces up to this multiple of the sum of all loads are ruled out.
///
/// Springs of stiffness 1 that come to rest move by far less. If this value were ten times larger, the multipliers
/// would need one more digit.
const MAX_DISPLACEMENT: f64 = 1e6;

/// The largest number of corrections of the multipliers. Each adds about as many correct digits as the solver
/// reaches.
const MAX_CORRECTIONS: usize = 6;

/// The gain −bᵀz of the multipliers z must exceed this fraction of Σ |load|·|z|, the largest contribution that the
/// loads can make to the gain.
///
/// It is twice the residual that forces at rest may leave, 1e-7 of a block's load. With less, a structure that springs
/// hold within that tolerance could be ruled out.
const BALANCE_BAND: f64 = 2.0 * Proof::IMBALANCE_TOL;

/// Multipliers whose absolute value is below this count as 0; the largest is at most 1. They come from a solver with a
/// tolerance of 1e-9.
const ZERO_MULTIPLIER: f64 = 1e-6;

/// Multipliers of inequalities below this fraction of the largest are dropped before the first correction.
const NEGLIGIBLE_MULTIPLIER: f64 = 1e-7;

/// True if the multipliers `z`, or else the multipliers of largest gain, prove that the rows of `conic` are infeasible.
///
/// `z` are the multipliers that the solver returned with the status `Infeasible`, one for each row.
pub(super) fn proves_infeasible(conic: &QuadraticProgram, z: &[f64], program: &Program) -> bool {
    proves_when_corrected(conic, z, program)
        || largest_gain(conic).is_some_and(|largest_gain| proves_when_corrected(conic, &largest_gain, program))
}

/// Computes the multipliers of largest gain −bᵀz with Aᵀz = 0, |z| ≤ 1, and z ≥ 0 on inequalities. `None` if b = 0, or
/// if the solver finds no optimum.
///
/// The multipliers that a solver returns may be so small that the corrections exceed them. The multipliers of largest
/// gain are as large as possible.
fn largest_gain(conic: &QuadraticProgram) -> Option<Vec<f64>> {
    let rows = conic.bound.len();
    let size = conic.bound.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if size == 0.0 {
        return None;
    }
    // The unknowns are the multipliers. The rows are Aᵀz = 0, then z ≤ 1, and −z ≤ 1 (−z ≤ 0 for inequalities).
    let equal = conic.matrix.iter();
    let mut matrix: Vec<(usize, usize, f64)> = equal.map(|(row, column, value)| (*column, *row, *value)).collect();
    let mut bound = vec![0.0; conic.unknowns];
    for row in 0..rows {
        let least = if row < conic.equalities { 1.0 } else { 0.0 };
        matrix.push((bound.len(), row, 1.0));
        matrix.push((bound.len() + 1, row, -1.0));
        bound.extend([1.0, least]);
    }
    let problem = QuadraticProgram {
        unknowns: rows,
        quadratic: Vec::new(),
        linear: conic.bound.iter().map(|v| v / size).collect(),
        matrix,
        bound,
        equalities: conic.unknowns,
    };
    // Solve, and set the multipliers that are only rounding errors of the solver to 0.
    let answer = solve(&problem, TOLERANCE, Conditioning::Full);
    let clean = |v: &f64| if v.abs() < ZERO_MULTIPLIER { 0.0 } else { *v };
    (answer.status == Status::Solved).then(|| answer.x.iter().map(clean).collect())
}

/// True if multipliers prove infeasibility, possibly after corrections by iterative refinement.
fn proves_when_corrected(conic: &QuadraticProgram, z: &[f64], program: &Program) -> bool {
    let most = z.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    // Set negligible multipliers to 0. The correction compensates for them.
    let mut z: Vec<f64> = z.to_vec();
    for (row, z) in z.iter_mut().enumerate() {
        if row >= conic.equalities && *z <= NEGLIGIBLE_MULTIPLIER * most {
            *z = 0.0;
        }
    }
    for _ in 0..MAX_CORRECTIONS {
        if proves(conic, &z, program) {
            return true;
        }
        let Some(corrected) = correct_multipliers(conic, &z) else {
            return false;
        };
        z = corrected;
    }
    proves(conic, &z, program)
}

/// Changes the multipliers that are not 0 as little as possible so that Aᵀz = 0, and returns all multipliers.
/// Multipliers of inequalities that would become negative are then set to 0, which may leave an error. `None` if Aᵀz
/// is already 0, or if the solver returns no answer.
fn correct_multipliers(conic: &QuadraticProgram, z: &[f64]) -> Option<Vec<f64>> {
    // Scale the error Aᵀz so that its largest entry is 1.
    let off = transpose_product(conic, z);
    let size = off.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if size == 0.0 {
        return None;
    }
    // Only multipliers that are not 0 may change.
    let rows: Vec<usize> = (0..z.len()).filter(|row| z[*row] != 0.0).collect();
    let mut number = vec![usize::MAX; z.len()];
    rows.iter().enumerate().for_each(|(k, row)| number[*row] = k);
    let entries = conic.matrix.iter();
    // Compute the least change of these multipliers with Aᵀ·change = −error.
    let correction = QuadraticProgram {
        unknowns: rows.len(),
        quadratic: (0..rows.len()).map(|k| (k, k, 1.0)).collect(),
        linear: vec![0.0; rows.len()],
        matrix: entries
            .filter(|(row, _, _)| number[*row] != usize::MAX)
            .map(|(row, column, value)| (*column, number[*row], *value))
            .collect(),
        bound: off.iter().map(|v| -v / size).collect(),
        equalities: conic.unknowns,
    };
    let answer = solve(&correction, TOLERANCE, Conditioning::Full);
    if answer.x.len() != rows.len() {
        return None;
    }
    let mut corrected = z.to_vec();
    for (row, change) in rows.iter().zip(&answer.x) {
        corrected[*row] += size * change;
        if *row >= conic.equalities {
            corrected[*row] = corrected[*row].max(0.0);
        }
    }
    Some(corrected)
}

/// Returns the product Aᵀz, one number for each unknown.
fn transpose_product(conic: &QuadraticProgram, z: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; conic.unknowns];
    for (row, column, value) in &conic.matrix {
        product[*column] += value * z[*row];
    }
    product
}

/// True if the gain −bᵀz exceeds both the contribution of the residuals that a verdict tolerates and the largest
/// |xᵀAᵀz| for x within [`MAX_DISPLACEMENT`].
fn proves(conic: &QuadraticProgram, z: &[f64], program: &Program) -> bool {
    let z: Vec<f64> =
        z.iter().enumerate().map(|(row, z)| if row < conic.equalities { *z } else { z.max(0.0) }).collect();
    let gain = -conic.bound.iter().zip(&z).map(|(b, z)| b * z).sum::<f64>();
    let error: f64 = transpose_product(conic, &z).iter().map(|v| v.abs()).sum();
    let loads = &program.loads;
    let total: f64 = loads.iter().map(|v| v.abs()).sum();
    // The verdict "stable" allows a small residual for each block, so the gain must exceed the contribution of these
    // residuals. The first rows are the equilibrium equations. The load of a block counts as at least a millionth of
    // all loads.
    let band: f64 = loads
        .chunks(3)
        .zip(z.chunks(3))
        .map(|(load, z)| {
            let own = load.iter().fold(1e-6 * total, |m: f64, v| m.max(v.abs()));
            own * z.iter().map(|v| v.abs()).sum::<f64>()
        })
        .sum();
    gain > BALANCE_BAND * band && error * MAX_DISPLACEMENT * total < gain
}
