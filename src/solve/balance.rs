//! The hard program: admissible forces of least sum that balance every block, or a motion that none can stop.

use super::{Amounts, Care, Effort, Status, gathered, kept, tidy, twin};
use crate::program::{Program, columns};

/// What the hard program gave.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Forces that balance, where it found some.
    pub forces: Option<Amounts>,
    /// A motion along which the loads work and no contact objects, where it found one: three velocities per block.
    pub motion: Option<Vec<f64>>,
    /// The work it took.
    pub effort: Effort,
}

/// Solves the hard program of [Vallat23](crate::doc::references) §2.0.7 through its kinematic twin.
pub fn balance(program: &Program, care: Care) -> Balance {
    let mut effort = Effort::default();
    let columns = columns(program);
    let solved = twin(&program.need, &columns, care, &mut effort, |c| c.cost);
    match solved.status {
        Status::Solved => {
            let (face, amounts) = kept(&columns, &solved.amounts, &solved.active);
            let cost = |amounts: &[f64]| {
                face.iter()
                    .zip(amounts)
                    .map(|(c, a)| c.cost * a)
                    .sum::<f64>()
            };
            // On the true face every balance costs the same; a dearer one means a column too many was taken for active.
            let chosen = tidy(&program.need, &face, care, &mut effort)
                .filter(|t| (cost(t) - solved.aim).abs() <= 1e-6 * solved.aim.abs())
                .unwrap_or(amounts);
            let (forces, _) = gathered(program, &face, &chosen);
            Balance {
                forces: Some(forces),
                motion: None,
                effort,
            }
        }
        // The twin's velocities are those against which loads work; the blocks move the other way.
        Status::Unbounded => Balance {
            forces: None,
            motion: Some(solved.y.iter().map(|v| -v).collect()),
            effort,
        },
        _ => Balance {
            forces: None,
            motion: None,
            effort,
        },
    }
}
