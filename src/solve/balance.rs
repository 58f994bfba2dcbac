//! The hard program: admissible forces of least sum that balance every block, or a motion that none can stop.

use super::{
    Amounts, Care, Choice, Effort, Manner, Status, gathered, kept, refined, rest, tidy, twin,
};
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

/// Slack may outweigh the amount so many times before a column is left out of the face of optima.
///
/// The first value is the plain rule. Near the edge of standing an amount can be as small as its slack; then more columns
/// are let in, until what they carry balances.
const MARGINS: [f64; 3] = [1.0, 1e3, 1e6];

/// Solves the hard program of [Vallat23](crate::doc::references) §2.0.7 through its kinematic twin.
pub fn balance(program: &Program, care: Care) -> Balance {
    balance_in(program, care.into())
}

/// Solves it in a manner of one's own.
pub fn balance_in(program: &Program, manner: Manner) -> Balance {
    let mut effort = Effort::default();
    let columns = columns(program);
    let solved = twin(&program.need, &columns, manner, &mut effort, |c| c.cost);
    match solved.status {
        Status::Solved => {
            let mut found = None;
            let margins = match manner.choice {
                Choice::Any => &[][..],
                Choice::Unique => &MARGINS[..],
            };
            for margin in margins {
                let (face, _) = kept(&columns, &solved.amounts, &solved.active(*margin));
                let Some(amounts) = tidy(&program.need, &face, manner, &mut effort) else {
                    continue;
                };
                let cost: f64 = face.iter().zip(&amounts).map(|(c, a)| c.cost * a).sum();
                // On the true face every balance costs the same; a dearer one means a column too many.
                let cheap = (cost - solved.aim).abs() <= 1e-6 * solved.aim.abs();
                if cheap && rest(&program.need, &face, &amounts) <= 1e-8 {
                    found = Some((face, amounts));
                    break;
                }
            }
            let (face, amounts) = found.unwrap_or((columns, solved.amounts));
            let amounts = match manner.care {
                Care::Quick => amounts,
                Care::Full => refined(&program.need, &face, amounts, &mut effort),
            };
            let (forces, _) = gathered(program, &face, &amounts);
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
