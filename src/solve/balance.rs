//! The hard program: admissible forces of least sum that balance every block, or a motion that none can stop.

use super::{
    Amounts, Care, Choice, Effort, Face, Manner, Status, largest, refined, remainder, tidy, twin,
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
/// The first value is the plain rule. A column whose slack and amount are both next to nothing may be in by chance, which
/// shows in the cost; near the edge of standing one may be out by chance, and then nothing balances.
const MARGINS: [f64; 5] = [1.0, 1e-3, 1e3, 1e-6, 1e6];

/// On the true face every balance costs the same, up to the solver's digits; a dearer one means a column too many.
const SAME_COST: f64 = 2e-8;

/// Solves the hard program of [Vallat23](crate::doc::references) §2.0.7 through its kinematic twin.
pub fn balance(program: &Program, care: Care) -> Balance {
    balance_in(program, care.into())
}

/// Solves it in a manner of one's own.
pub fn balance_in(program: &Program, manner: Manner) -> Balance {
    let mut effort = Effort::default();
    let whole = Face::whole(&program.need, columns(program));
    let solved = twin(&whole.need, &whole.columns, manner, &mut effort, |c| c.cost);
    match solved.status {
        Status::Solved => {
            let size = largest(&program.need);
            let mut found = None;
            let margins = match manner.choice {
                Choice::Any => &[][..],
                Choice::Unique => &MARGINS[..],
            };
            for margin in margins {
                let face = whole.narrowed(&solved, *margin);
                let Some(amounts) = tidy(&face.need, &face.columns, manner, &mut effort) else {
                    continue;
                };
                let cheap =
                    (face.cost(&amounts) - solved.aim).abs() <= SAME_COST * solved.aim.abs();
                let rest = largest(&remainder(&face.need, &face.columns, &amounts));
                if cheap && rest <= 1e-8 * size {
                    found = Some(face.with(amounts));
                    break;
                }
            }
            let mut face = found.unwrap_or_else(|| whole.with(solved.amounts));
            if manner.care == Care::Full {
                face.amounts = refined(&face.need, &face.columns, face.amounts, &mut effort);
            }
            let (forces, _) = face.gathered(program);
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
