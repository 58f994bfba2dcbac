//! That the rows of a case contradict each other: multipliers z with Aᵀz = 0 and bᵀz < 0, z ≥ 0 on inequalities.

use crate::program::{Program, QuadraticProgram};
use crate::solve::{Conditioning, Status, TOLERANCE, solve};

/// Displacements and forces up to so many times the loads are ruled out; multipliers are only as exact as that wants.
const FAR: f64 = 1e6;

/// Corrections of multipliers.
const CORRECTIONS: usize = 6;

/// Parts of the loads by which a contradiction must exceed what a rest may leave unbalanced: twice that.
const BAND: f64 = 2e-7;

/// Of multipliers up to 1, what is none.
const NONE: f64 = 1e-6;

/// Whether multipliers show that a case's rows contradict each other: those given, corrected where they are too rough for
/// it, or those that show it most clearly.
pub(super) fn contradicts(conic: &QuadraticProgram, z: &[f64], program: &Program) -> bool {
    made_to(conic, z, program)
        || clearest(conic).is_some_and(|clearest| made_to(conic, &clearest, program))
}

/// The multipliers of largest gain −bᵀz with Aᵀz = 0 and |z| ≤ 1: as far from 0 as they may be, where a certificate that
/// comes with a solver's status may be so near to it that corrections make it vanish.
fn clearest(conic: &QuadraticProgram) -> Option<Vec<f64>> {
    let rows = conic.bound.len();
    let size = conic.bound.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if size == 0.0 {
        return None;
    }
    let equal = conic.matrix.iter();
    let mut matrix: Vec<(usize, usize, f64)> = equal
        .map(|(row, column, value)| (*column, *row, *value))
        .collect();
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
    let answer = solve(&problem, TOLERANCE, Conditioning::Full);
    let clean = |v: &f64| if v.abs() < NONE { 0.0 } else { *v };
    (answer.status == Status::Solved).then(|| answer.x.iter().map(clean).collect())
}

/// Whether multipliers, corrected where they are too rough for it, show that a case's rows contradict each other.
fn made_to(conic: &QuadraticProgram, z: &[f64], program: &Program) -> bool {
    let most = z.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    // Rows that hardly count are left out: the others make up for what they would add.
    let mut z: Vec<f64> = z.to_vec();
    for (row, z) in z.iter_mut().enumerate() {
        if row >= conic.equalities && *z <= 1e-7 * most {
            *z = 0.0;
        }
    }
    for _ in 0..CORRECTIONS {
        if rules_out(conic, &z, program) {
            return true;
        }
        let Some(corrected) = corrected(conic, &z) else {
            return false;
        };
        z = corrected;
    }
    rules_out(conic, &z, program)
}

/// Multipliers changed least so that Aᵀz = 0; those of inequalities that the change would make negative become 0.
fn corrected(conic: &QuadraticProgram, z: &[f64]) -> Option<Vec<f64>> {
    let off = product(conic, z);
    let size = off.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if size == 0.0 {
        return None;
    }
    let rows: Vec<usize> = (0..z.len()).filter(|row| z[*row] != 0.0).collect();
    let mut number = vec![usize::MAX; z.len()];
    rows.iter()
        .enumerate()
        .for_each(|(k, row)| number[*row] = k);
    let entries = conic.matrix.iter();
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

fn product(conic: &QuadraticProgram, z: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; conic.unknowns];
    for (row, column, value) in &conic.matrix {
        product[*column] += value * z[*row];
    }
    product
}

/// Whether Aᵀz = 0 and bᵀz < 0 with z ≥ 0 on inequalities, so that no x has Ax ≤ b: in numbers, none within [`FAR`].
fn rules_out(conic: &QuadraticProgram, z: &[f64], program: &Program) -> bool {
    let z: Vec<f64> = z
        .iter()
        .enumerate()
        .map(|(row, z)| {
            if row < conic.equalities {
                *z
            } else {
                z.max(0.0)
            }
        })
        .collect();
    let gain = -conic.bound.iter().zip(&z).map(|(b, z)| b * z).sum::<f64>();
    let error: f64 = product(conic, &z).iter().map(|v| v.abs()).sum();
    let loads = &program.loads;
    let total: f64 = loads.iter().map(|v| v.abs()).sum();
    // A verdict of "stable" allows each block a small part of its load; so the contradiction must be a larger one.
    let band: f64 = loads
        .chunks(3)
        .zip(z.chunks(3))
        .map(|(load, z)| {
            let own = load.iter().fold(1e-6 * total, |m: f64, v| m.max(v.abs()));
            own * z.iter().map(|v| v.abs()).sum::<f64>()
        })
        .sum();
    gain > BAND * band && error * FAR * total < gain
}
