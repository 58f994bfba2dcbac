//! The hard program: admissible forces of least sum that balance every block, or a motion that none can stop.

use super::level::{WIDE, lightest, refined_optimum, with_least_squares};
use super::{
    Amounts, Choice, Conditioning, Dual, Effort, Face, SolverSettings, Status, largest,
    least_squares_amounts, of_velocities, once_within, refined, remainder, settled,
    solved_with_retry,
};
use crate::program::{Program, columns, kinematic_dual};

/// What the hard program gave.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Forces that balance, where it found some.
    pub forces: Option<Amounts>,
    /// A motion along which the loads work and no contact objects, where it found one: three velocities per block.
    pub motion: Option<Vec<f64>>,
    /// Where it found forces: the motion against which no contact works by more than its force costs, which says how small
    /// their sum can be.
    pub witness: Option<Vec<f64>>,
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

/// Very rough contacts cost the solver digits; within this share the cheapest balance is nearer the truth than its
/// objective.
const NEAR_COST: f64 = 1e-6;

/// The least squares may leave so much unbalanced, in parts of the largest load: half of what a proof lets pass.
const BALANCED: f64 = 5e-8;

/// From so many blocks on the quick way is given up early, and not tried again with full conditioning.
const MANY_BLOCKS: usize = 200;

/// Iterations after which it is given up.
///
/// Walls of 400 to 2 000 bricks take 6 to 60 where they stand or fall by more than a thousandth. Nearer to the edge the
/// least force ends without a status after 100, in either way, where the program without cost is solved in 30.
const SHORT: usize = 60;

/// Iterations after which a first look at many blocks is given up.
///
/// Walls of 400 to 900 bricks take 6 where they stand upright and 7 to 9 where they fall by far; arches of 1 000 and 10 000
/// stones take 11 and 13. What takes more is near the edge, where the program without cost is solved in 12 to 20.
const FIRST_LOOK: usize = 15;

/// Of many blocks, when so large a share of the columns in use may as well not be, the optimum is sought more sharply first.
///
/// In walls of coordinates with 4 decimals thousands of columns have an amount and a slack of the same size, 10⁻⁴ of the
/// others': the faces taken for the optimum's have no balance, which the least squares take long to find out.
const VAGUE: f64 = 0.05;

/// By so much more sharply.
const SHARP: f64 = 1e-3;

/// Whether of many columns it is not clear that they belong to the optimum.
fn is_vague(solved: &Dual) -> bool {
    vagueness(solved) > VAGUE
}

/// What share of the columns in use may as well not be.
fn vagueness(solved: &Dual) -> f64 {
    let count = |margin: f64| {
        let active = solved.active(margin).into_iter();
        active.filter(|active| *active).count() as f64
    };
    match solved.status {
        Status::Solved => (count(1e3) - count(1e-3)) / count(1.0).max(1.0),
        _ => 0.0,
    }
}

/// The least force of few blocks whose loads span many sizes, each with its own digits; `None` of others.
fn of_every_body(
    program: &Program,
    whole: &Face,
    solved: &Dual,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Balance> {
    let light = lightest(&whole.loads);
    let wide = light < WIDE * largest(&whole.loads);
    if !wide || program.blocks >= MANY_BLOCKS || settings.choice == Choice::Any {
        return None;
    }
    let (loads, columns) = (&whole.loads, &whole.columns);
    let optimum = refined_optimum(loads, columns, |c| c.cost, solved, light, effort)?;
    let face = whole.narrowed(&optimum, 1.0);
    let (forces, _) = with_least_squares(face, light, settings, effort).gathered(program);
    Some(Balance {
        forces: Some(forces),
        motion: None,
        witness: Some(optimum.y.iter().map(|v| -v).collect()),
        effort: *effort,
    })
}

/// Solves the hard program of [Vallat23](crate::doc::references) §2.0.7 through its kinematic dual.
pub fn balance(program: &Program, conditioning: Conditioning) -> Balance {
    balance_in(program, conditioning.into())
}

/// Solves it with given settings.
pub fn balance_in(program: &Program, settings: SolverSettings) -> Balance {
    balance_within(program, settings, SHORT)
}

/// Solves it as a first look at many blocks: given up early where it is not solved soon.
pub fn balance_at_first_look(program: &Program, settings: SolverSettings) -> Balance {
    balance_within(program, settings, FIRST_LOOK)
}

fn balance_within(program: &Program, settings: SolverSettings, short: usize) -> Balance {
    let mut effort = Effort::default();
    let whole = Face::whole(&program.loads, columns(program));
    let (conic, row_of) = kinematic_dual(&whole.loads, &whole.columns, |c| c.cost);
    let answer = if settings.conditioning == Conditioning::Plain && program.blocks >= MANY_BLOCKS {
        once_within(&conic, settings, short, &mut effort)
    } else {
        solved_with_retry(&conic, settings, &mut effort)
    };
    let mut solved = of_velocities(&whole.loads, &whole.columns, &conic, &row_of, &answer);
    let mut face_settings = settings;
    if program.blocks >= MANY_BLOCKS && settings.choice == Choice::Unique && is_vague(&solved) {
        let sharp = SolverSettings {
            tolerance: SHARP * settings.tolerance,
            ..settings
        };
        let answer = once_within(&conic, sharp, SHORT, &mut effort);
        if answer.status == Status::Solved {
            solved = of_velocities(&whole.loads, &whole.columns, &conic, &row_of, &answer);
            face_settings.conditioning = Conditioning::Full;
        }
    }
    match solved.status {
        Status::Solved => {
            if let Some(found) = of_every_body(program, &whole, &solved, settings, &mut effort) {
                return found;
            }
            let size = largest(&program.loads);
            let mut found: Option<(f64, Face)> = None;
            let margins = match settings.choice {
                Choice::Any => &[][..],
                Choice::Unique => &MARGINS[..],
            };
            let mut sizes = Vec::with_capacity(margins.len());
            for margin in margins {
                let face = whole.narrowed(&solved, *margin);
                // Margins order the columns, so a face of as many columns and full ones is one that was tried.
                let of = (face.columns.len(), face.at_limit.len());
                if sizes.contains(&of) {
                    continue;
                }
                sizes.push(of);
                let Some(mut amounts) =
                    least_squares_amounts(&face.loads, &face.columns, face_settings, &mut effort)
                else {
                    continue;
                };
                let cost = face.cost(&amounts);
                let off = (cost - solved.objective).abs() / solved.objective.abs();
                let balanced = |amounts: &[f64]| {
                    largest(&remainder(&face.loads, &face.columns, amounts)) <= BALANCED * size
                };
                if off <= NEAR_COST && !balanced(&amounts) {
                    // The right columns, but long arches add up more rounding than a proof lets pass.
                    amounts = settled(&face.loads, &face.columns, amounts, settings, &mut effort);
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
            let mut face = match (found, settings.choice) {
                (Some(best), _) => best.1,
                (None, Choice::Unique) => whole.with(solved.amounts),
                // One system of equations is cheaper than making good what the solver leaves, block by block.
                (None, Choice::Any) => {
                    let (loads, amounts) = (&whole.loads, solved.amounts);
                    let amounts = settled(loads, &whole.columns, amounts, settings, &mut effort);
                    whole.with(amounts)
                }
            };
            if settings.conditioning == Conditioning::Full {
                face.amounts = refined(&face.loads, &face.columns, face.amounts, &mut effort);
            }
            let (forces, _) = face.gathered(program);
            Balance {
                forces: Some(forces),
                motion: None,
                witness: Some(solved.y.iter().map(|v| -v).collect()),
                effort,
            }
        }
        // The dual's velocities are those against which loads work; the blocks move the other way.
        Status::Unbounded => Balance {
            forces: None,
            motion: Some(solved.y.iter().map(|v| -v).collect()),
            witness: None,
            effort,
        },
        _ => Balance {
            forces: None,
            motion: None,
            witness: None,
            effort,
        },
    }
}
