//! Whether any admissible forces balance, whatever they cost; and where none do, those that leave least unbalanced.
//!
//! Near the edge of standing the least force ends without a status: it has no optimum beyond the edge and one without
//! measure short of it. Two programs without that cost decide there. The first asks for any balance, with the forces as
//! unknowns: some 30 iterations on either side of the edge of a wall of 410 bricks, 10⁻⁵ of the load away, where the least
//! force takes 200 and fails. The second is the least Σ |what is left|. Where nothing is left, the forces balance; where
//! something is, the velocities are those of largest power within −1 ≤ y ≤ 1. It has an optimum on either side, and says
//! where an answer lies within the band of the proofs.

use super::limit::columns_in;
use super::slanted::Slanted;
use super::{
    Amounts, Conditioning, Effort, Face, Status, in_forces, largest, remainder, settled,
    solved_with_retry,
};
use crate::program::{Program, least_left};

/// What the program of the least residual gave.
#[derive(Clone, Debug)]
pub struct Residual {
    /// The admissible forces.
    pub forces: Amounts,
    /// The motion of largest power: three velocities per block.
    pub motion: Vec<f64>,
    /// The work it took.
    pub effort: Effort,
}

/// A motion whose power is more than this share of the way its blocks go, in parts of the largest load, is beyond doubt
/// by ten times the band within which forces count as balanced.
const BEYOND_THE_BAND: f64 = 1e-6;

/// What any balance may leave, in parts of the largest load, before the least residual is asked for.
const BALANCED: f64 = 1e-9;

/// Finds forces that balance, or else those that leave least and the motion against which that is so; `None` where the
/// solver ends without a status.
///
/// It is posed with a largest load of 1: on a wall of 410 bricks pushed to its edge loads of 300 end without a status,
/// loads of 1 after some 70 iterations.
pub fn least_residual(program: &Program) -> Option<Residual> {
    let load = match largest(&program.loads) {
        0.0 => 1.0,
        load => load,
    };
    let columns = columns_in(program, load);
    let slanted = Slanted::of(&columns);
    let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
    let mut effort = Effort::default();
    let residual = |amounts: &[f64], y: &[f64], effort: Effort| {
        let mut face = Face::whole(&program.loads, columns.clone());
        face.amounts = slanted.amounts_of_all(&columns, amounts);
        face.amounts.iter_mut().for_each(|amount| *amount *= load);
        let (forces, _) = face.gathered(program);
        Residual {
            forces,
            motion: y.iter().map(|v| -v).collect(),
            effort,
        }
    };
    let any = in_forces(
        &loads,
        &slanted.columns,
        Conditioning::Plain,
        &mut effort,
        |_| 0.0,
    );
    match any.status {
        Status::Solved => {
            let settings = Conditioning::Plain.into();
            let amounts = settled(&loads, &slanted.columns, any.amounts, settings, &mut effort);
            if largest(&remainder(&loads, &slanted.columns, &amounts)) <= BALANCED {
                return Some(residual(&amounts, &vec![0.0; loads.len()], effort));
            }
        }
        Status::Unbounded => {
            let power: f64 = loads.iter().zip(&any.y).map(|(n, v)| n * v).sum();
            let way: f64 = any.y.iter().map(|v| v.abs()).sum();
            if power > BEYOND_THE_BAND * way {
                return Some(residual(&vec![0.0; any.amounts.len()], &any.y, effort));
            }
        }
        _ => {}
    }
    let (conic, row_of) = least_left(&loads, &slanted.columns);
    let answer = solved_with_retry(&conic, Conditioning::Plain, &mut effort);
    if answer.status != Status::Solved {
        return None;
    }
    let amounts: Vec<f64> = row_of
        .iter()
        .enumerate()
        .map(|(k, row)| match *row {
            // A pair posed as one equality carries the amount of its first, of either sign.
            usize::MAX => (-answer.z[row_of[k - 1]]).max(0.0),
            row => answer.z[row].max(0.0),
        })
        .collect();
    Some(residual(&amounts, &answer.x[..loads.len()], effort))
}
