//! The hard program: admissible forces of least sum that balance every block, or a motion that none can stop.

use super::{
    Amounts, Care, Choice, Effort, Face, Manner, Status, careful, largest, of_velocities,
    once_within, refined, remainder, settled, tidy,
};
use crate::program::{Program, columns, kinematic};

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

/// Very rough contacts cost the solver digits; within this share the cheapest balance is nearer the truth than its aim.
const NEAR_COST: f64 = 1e-6;

/// The least squares may leave so much unbalanced, in parts of the largest load: half of what a proof lets pass.
const BALANCED: f64 = 5e-8;

/// From so many blocks on the quick way is given up early, and not tried again with full care.
const MANY_BLOCKS: usize = 200;

/// Iterations after which it is given up.
///
/// Walls of 400 to 2 000 bricks take 6 to 60 where they stand or fall by more than a thousandth. Nearer to the edge the
/// least force ends nowhere after 100, in either way, where the program without cost is solved in 30.
const SHORT: usize = 60;

/// Solves the hard program of [Vallat23](crate::doc::references) §2.0.7 through its kinematic twin.
pub fn balance(program: &Program, care: Care) -> Balance {
    balance_in(program, care.into())
}

/// Solves it in a manner of one's own.
pub fn balance_in(program: &Program, manner: Manner) -> Balance {
    let mut effort = Effort::default();
    let whole = Face::whole(&program.need, columns(program));
    let (conic, row_of) = kinematic(&whole.need, &whole.columns, |c| c.cost);
    let answer = if manner.care == Care::Quick && program.blocks >= MANY_BLOCKS {
        once_within(&conic, manner, SHORT, &mut effort)
    } else {
        careful(&conic, manner, &mut effort)
    };
    let solved = of_velocities(&whole.need, &whole.columns, &conic, &row_of, &answer);
    match solved.status {
        Status::Solved => {
            let size = largest(&program.need);
            let mut found: Option<(f64, Face)> = None;
            let margins = match manner.choice {
                Choice::Any => &[][..],
                Choice::Unique => &MARGINS[..],
            };
            let mut sizes = Vec::with_capacity(margins.len());
            for margin in margins {
                let face = whole.narrowed(&solved, *margin);
                // Margins order the columns, so a face of as many columns and full ones is one that was tried.
                let of = (face.columns.len(), face.full.len());
                if sizes.contains(&of) {
                    continue;
                }
                sizes.push(of);
                let Some(mut amounts) = tidy(&face.need, &face.columns, manner, &mut effort) else {
                    continue;
                };
                let cost = face.cost(&amounts);
                let off = (cost - solved.aim).abs() / solved.aim.abs();
                let balanced = |amounts: &[f64]| {
                    largest(&remainder(&face.need, &face.columns, amounts)) <= BALANCED * size
                };
                if off <= NEAR_COST && !balanced(&amounts) {
                    // The right columns, but long arches add up more rounding than a proof lets pass.
                    amounts = settled(&face.need, &face.columns, amounts, manner, &mut effort);
                }
                if off > NEAR_COST || !balanced(&amounts) {
                    continue;
                }
                if found.as_ref().is_none_or(|best| cost < best.0) {
                    found = Some((cost, face.with(amounts)));
                }
                if off <= SAME_COST {
                    break;
                }
            }
            let mut face = match (found, manner.choice) {
                (Some(best), _) => best.1,
                (None, Choice::Unique) => whole.with(solved.amounts),
                // One system of equations is cheaper than making good what the solver leaves, block by block.
                (None, Choice::Any) => {
                    let (need, amounts) = (&whole.need, solved.amounts);
                    let amounts = settled(need, &whole.columns, amounts, manner, &mut effort);
                    whole.with(amounts)
                }
            };
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
