//! The program of least force: admissible forces of least sum that balance every block, or a motion that nothing opposes.
//!
//! [Vallat23](crate::doc::references) §2.0.7, solved through its kinematic dual. Steps:
//!
//! 1. solve the dual ([`Dual`]); an unbounded dual is the motion;
//! 2. find the face of optima from the basic columns ([`Face::narrowed`]);
//! 3. on the face, find the forces of least Σ force², which are unique;
//! 4. accept them if they balance and cost as much as the optimum; else try the face of another margin.

use super::level::{WIDE, lightest, refined_optimum, with_least_squares};
use super::{
    Amounts, Choice, Conditioning, Dual, Effort, Face, SolverSettings, Status,
    balance_by_least_change, largest, least_squares_amounts, of_velocities, once_within,
    refine_balance, remainder, solved_with_retry,
};
use crate::program::{Program, QuadraticProgram, columns, kinematic_dual};

/// The result of the program of least force.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Forces that balance, if there are any.
    pub forces: Option<Amounts>,
    /// Else a motion along which the loads work and no contact does: three velocities for each block.
    pub motion: Option<Vec<f64>>,
    /// With forces: a motion along which no force takes more work than it costs. Its power is a lower bound of their sum.
    pub witness: Option<Vec<f64>>,
    /// The work it took.
    pub effort: Effort,
}

/// Margins of [`Dual::active`] that are tried for the face of optima.
///
/// The first is the plain rule. A column whose slack and amount are both nearly 0 may be in by chance, which shows in the
/// cost: then a smaller margin helps. Near the limit of standing one may be out by chance, and nothing balances: then a larger
/// one does.
const MARGINS: [f64; 5] = [1.0, 1e-3, 1e3, 1e-6, 1e6];

/// On the true face every balance has the same cost, up to the solver's digits. A larger relative difference means that
/// there is a column too many. Ten times larger, such a column would be accepted; a tenth is the solver's own error.
const COST_TOL: f64 = 2e-8;

/// With very rough contacts the solver loses digits. Within this relative difference the cheapest balance is taken, which is
/// nearer the truth than the solver's objective.
const ROUGH_COST_TOL: f64 = 1e-6;

/// The least squares may leave this unbalanced, relative to the largest load: half of what a proof allows.
const BALANCE_TOL: f64 = 5e-8;

/// From this number of blocks on plain conditioning is given up early, and full conditioning is not tried.
const MANY_BLOCKS: usize = 200;

/// Iterations after which a program of many blocks is given up.
///
/// Walls of 400 to 2 000 bricks take 6 to 60 if they stand or fall by more than a thousandth. Nearer to the limit the least
/// force ends without a status after 100, with either conditioning; the program without cost is solved in 30.
const MAX_ITERATIONS_MANY: usize = 60;

/// Iterations after which the first attempt at many blocks is given up.
///
/// Walls of 400 to 900 bricks take 6 if they stand upright and 7 to 9 if they fall by far; arches of 1 000 and 10 000 stones
/// take 11 and 13. What takes more is near the limit, where the program without cost is solved in 12 to 20.
const MAX_ITERATIONS_FIRST_LOOK: usize = 15;

/// With many blocks, the program is solved to a finer tolerance if a larger share of the basic columns is doubtful.
///
/// In walls whose coordinates have 4 decimals thousands of columns have an amount and a slack of the same size, 10⁻⁴ of the
/// others'. The faces found then have no balance, and the least squares take long to find that out.
const MAX_DOUBTFUL_SHARE: f64 = 0.05;

/// The finer tolerance, as a fraction of the normal one.
const FINE_TOLERANCE_FACTOR: f64 = 1e-3;

/// The share of the basic columns that may as well be non-basic: amount and slack within a factor of 1000.
fn doubtful_share(solved: &Dual) -> f64 {
    let count = |margin: f64| {
        let active = solved.active(margin).into_iter();
        active.filter(|active| *active).count() as f64
    };
    match solved.status {
        Status::Solved => (count(1e3) - count(1e-3)) / count(1.0).max(1.0),
        _ => 0.0,
    }
}

/// Solves the program of least force.
pub fn balance(program: &Program, conditioning: Conditioning) -> Balance {
    balance_in(program, conditioning.into())
}

/// Solves the program of least force with given settings.
pub fn balance_in(program: &Program, settings: SolverSettings) -> Balance {
    balance_within(program, settings, MAX_ITERATIONS_MANY)
}

/// As [`balance_in`], but a program of many blocks is given up after a few iterations.
pub fn balance_at_first_look(program: &Program, settings: SolverSettings) -> Balance {
    balance_within(program, settings, MAX_ITERATIONS_FIRST_LOOK)
}

fn balance_within(program: &Program, settings: SolverSettings, max_iterations: usize) -> Balance {
    let mut effort = Effort::default();
    let whole = Face::whole(&program.loads, columns(program));
    let (solved, face_settings) =
        solve_dual(program, &whole, settings, max_iterations, &mut effort);
    let mut found = Balance {
        forces: None,
        motion: None,
        witness: None,
        effort,
    };
    let motion = || Some(solved.y.iter().map(|v| -v).collect());
    match solved.status {
        Status::Solved => {
            let effort = &mut found.effort;
            if let Some(balance) = balance_by_levels(program, &whole, &solved, settings, effort) {
                return balance;
            }
            found.witness = motion();
            let effort = &mut found.effort;
            let best = match settings.choice {
                Choice::Any => None,
                Choice::Unique => least_squares_balance(
                    program,
                    &whole,
                    &solved,
                    [settings, face_settings],
                    effort,
                ),
            };
            let mut face = match (best, settings.choice) {
                (Some(best), _) => best,
                (None, Choice::Unique) => whole.with(solved.amounts),
                // One system of equations is cheaper than repairs block by block.
                (None, Choice::Any) => {
                    let (loads, amounts) = (&whole.loads, solved.amounts);
                    let amounts =
                        balance_by_least_change(loads, &whole.columns, amounts, settings, effort);
                    whole.with(amounts)
                }
            };
            if settings.conditioning == Conditioning::Full {
                face.amounts = refine_balance(&face.loads, &face.columns, face.amounts, effort);
            }
            found.forces = Some(face.gathered(program).0);
        }
        // The dual's velocities are those against which the loads work; the blocks move the other way.
        Status::Unbounded => found.motion = motion(),
        _ => {}
    }
    found
}

/// The least force of few blocks whose loads span many sizes, right to the digits of each block; `None` for other programs.
fn balance_by_levels(
    program: &Program,
    whole: &Face,
    solved: &Dual,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Balance> {
    let light = lightest(&whole.loads);
    let has_wide_range = light < WIDE * largest(&whole.loads);
    if !has_wide_range || program.blocks >= MANY_BLOCKS || settings.choice == Choice::Any {
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

/// Step 1: the dual, and the settings for the least squares on its face.
fn solve_dual(
    program: &Program,
    whole: &Face,
    settings: SolverSettings,
    max_iterations: usize,
    effort: &mut Effort,
) -> (Dual, SolverSettings) {
    let (dual, row_of) = kinematic_dual(&whole.loads, &whole.columns, |c| c.cost);
    let read = |dual: &QuadraticProgram, answer| {
        of_velocities(&whole.loads, &whole.columns, dual, &row_of, answer)
    };
    let has_many_blocks = program.blocks >= MANY_BLOCKS;
    let answer = if settings.conditioning == Conditioning::Plain && has_many_blocks {
        once_within(&dual, settings, max_iterations, effort)
    } else {
        solved_with_retry(&dual, settings, effort)
    };
    let solved = read(&dual, &answer);
    if has_many_blocks
        && settings.choice == Choice::Unique
        && doubtful_share(&solved) > MAX_DOUBTFUL_SHARE
    {
        let fine = SolverSettings {
            tolerance: FINE_TOLERANCE_FACTOR * settings.tolerance,
            ..settings
        };
        let answer = once_within(&dual, fine, MAX_ITERATIONS_MANY, effort);
        if answer.status == Status::Solved {
            let full = SolverSettings {
                conditioning: Conditioning::Full,
                ..settings
            };
            return (read(&dual, &answer), full);
        }
    }
    (solved, settings)
}

/// Steps 2 to 4: the balance of least Σ force² among those of least cost; `None` if no margin gives one.
///
/// `settings` are those of the repair of a balance, and of the least squares.
fn least_squares_balance(
    program: &Program,
    whole: &Face,
    solved: &Dual,
    settings: [SolverSettings; 2],
    effort: &mut Effort,
) -> Option<Face> {
    let [repair_settings, face_settings] = settings;
    let size = largest(&program.loads);
    let mut best: Option<(f64, Face)> = None;
    let mut tried = Vec::with_capacity(MARGINS.len());
    for margin in MARGINS {
        let face = whole.narrowed(solved, margin);
        // The faces of increasing margins contain each other, so one with as many columns was tried already.
        let counts = (face.columns.len(), face.at_limit.len());
        if tried.contains(&counts) {
            continue;
        }
        tried.push(counts);
        let Some(mut amounts) =
            least_squares_amounts(&face.loads, &face.columns, face_settings, effort)
        else {
            continue;
        };
        let cost = face.cost(&amounts);
        let difference = (cost - solved.objective).abs() / solved.objective.abs();
        let is_balanced = |amounts: &[f64]| {
            largest(&remainder(&face.loads, &face.columns, amounts)) <= BALANCE_TOL * size
        };
        if difference <= ROUGH_COST_TOL && !is_balanced(&amounts) {
            // The right columns, but in long arches rounding adds up to more than a proof allows.
            amounts = balance_by_least_change(
                &face.loads,
                &face.columns,
                amounts,
                repair_settings,
                effort,
            );
        }
        if difference > ROUGH_COST_TOL || !is_balanced(&amounts) {
            continue;
        }
        if best.as_ref().is_none_or(|best| cost < best.0) {
            best = Some((cost, face.with(amounts)));
        }
        if difference <= COST_TOL {
            break;
        }
    }
    best.map(|(_, face)| face)
}
