//! The linear program of least force: finds admissible forces of least sum that balance every block. If there are none,
//! finds a motion that no contact resists, and along which the loads do more work than the robots can absorb.
//!
//! [Vallat23](crate::doc::references) §2.0.7, solved through its kinematic dual. Steps:
//!
//! 1. solve the kinematic form ([`Optimum`]); an unbounded dual is the motion;
//! 2. find the face of optima from the basic columns ([`Face::optimal_face`]);
//! 3. on the face, find the forces of least Σ force², which are unique;
//! 4. accept them if they balance every block and cost as much as the optimum; otherwise try another margin for step 2.
//!    If no margin succeeds, use the optimum of step 1.

use super::level::{WIDE_LOAD_RATIO, lightest, refined_optimum, with_least_squares};
use super::optimum::solve_kinematic_form;
use super::{
    Balance, Choice, Conditioning, Effort, Face, MAX_ITERATIONS, Optimum, SolverSettings, Status,
    balance_by_least_change, largest, least_cost, least_squares_amounts, refine_balance, remainder,
};
use crate::mechanics::program::{Aim, Column, Program, columns};
use crate::mechanics::proof::Proof;

/// Margins of [`Optimum::active`] that are tried in turn for the face of optima, dimensionless.
///
/// At 1 a column is basic if its amount exceeds its slack. If both are nearly 0, a column may be included by mistake;
/// the cost then differs, and a smaller margin helps. Near the limit of stability a column may be missing by mistake;
/// then no forces balance, and a larger margin helps.
const ACTIVE_MARGINS: [f64; 5] = [1.0, 1e-3, 1e3, 1e-6, 1e6];

/// The largest relative difference of cost between the optimum and a balance on the face of optima.
///
/// On the true face every balance has the same cost, up to the solver's error. A larger difference shows that the face
/// contains a column that does not belong to it. If the tolerance were ten times larger, a face with such a column
/// would be accepted; if it were ten times smaller, it would be within the solver's error.
const COST_TOL: f64 = 2e-8;

/// The relative difference of cost up to which a balance is accepted if none meets [`COST_TOL`]; the cheapest one is
/// chosen.
///
/// With very high friction the solver loses digits, and the cost of a balance is then more accurate than the optimum
/// that the solver returns.
const ROUGH_COST_TOL: f64 = 1e-6;

/// The largest residual that a balance may leave after the least-squares problem, relative to the largest load: half of
/// what a proof allows.
const BALANCE_TOL: f64 = 0.5 * Proof::IMBALANCE_TOL;

/// The largest number of iterations for a program of many blocks with plain conditioning.
///
/// Walls of 400 to 2 000 bricks take 6 to 60 iterations unless they are within a thousandth of their limit. Closer to
/// the limit, least force ends without a result after 100 iterations with either conditioning, while the program
/// without cost is solved in 30.
const MAX_ITERATIONS_MANY: usize = 60;

/// The largest number of iterations in the first attempt at a program of many blocks, with plain conditioning.
///
/// Walls of 400 to 900 bricks take 6 iterations if they stand upright and 7 to 9 if they clearly fall. Arches of
/// 1 000 and 10 000 stones take 11 and 13. Structures that take more are near their limit. For these, the program
/// without cost, which is tried next, takes 12 to 20.
const MAX_ITERATIONS_FIRST_LOOK: usize = 15;

/// If the doubtful columns, whose amount and slack are of similar size, are more than this fraction of the number of
/// basic columns, a program of many blocks is solved again to a finer tolerance.
///
/// In walls whose coordinates have 4 decimals, thousands of columns have an amount and a slack of about the same size,
/// 10⁻⁴ of the other amounts. The face of optima found from them has no balance, and the least-squares
/// problem takes long to show that.
const MAX_DOUBTFUL_SHARE: f64 = 0.05;

/// The finer tolerance, as a fraction of the tolerance in the settings.
const FINE_TOLERANCE_FACTOR: f64 = 1e-3;

/// Returns the number of doubtful columns divided by the number of basic columns. A column is doubtful if its amount
/// and its slack differ by a factor of less than 1000. The result is 0 if the dual is not solved.
fn doubtful_share(solved: &Optimum) -> f64 {
    let count = |margin: f64| {
        let active = solved.active(margin).into_iter();
        active.filter(|active| *active).count() as f64
    };
    match solved.status {
        Status::Solved => (count(1e3) - count(1e-3)) / count(1.0).max(1.0),
        _ => 0.0,
    }
}

/// Finds forces of least sum that balance every block, or a motion that proves that there are no such forces.
pub fn balance(program: &Program, conditioning: Conditioning) -> Balance {
    balance_in(program, conditioning.into())
}

/// Like [`balance_in`], but with plain conditioning the solver stops after 15 iterations if the program has many
/// blocks.
pub fn balance_at_first_look(program: &Program, settings: SolverSettings) -> Balance {
    balance_in(program, SolverSettings { iterations: MAX_ITERATIONS_FIRST_LOOK, ..settings })
}

/// Like [`balance`], but the caller chooses all solver settings, not only the conditioning: steps 1 to 4 of the module
/// header. The number of iterations holds for step 1 with many blocks.
pub fn balance_in(program: &Program, settings: SolverSettings) -> Balance {
    let mut effort = Effort::default();
    // Step 1: solve the kinematic form.
    let whole = Face::whole(&program.loads, columns(program));
    let (solved, face_settings) = solve_first(program, &whole, settings, &mut effort);
    let settings = SolverSettings { iterations: MAX_ITERATIONS, ..settings };
    let mut found = Balance { effort, ..Balance::default() };
    let motion = || Some(solved.motion());
    match solved.status {
        Status::Solved => {
            let effort = &mut found.effort;
            // If the loads differ by many powers of ten, use the optimum that is also accurate for light blocks.
            // Otherwise choose the optimum of least Σ force² (steps 2 to 4), or repair the optimum that the solver
            // found.
            if let Some(balance) = balance_by_levels(program, &whole, &solved, settings, effort) {
                return balance;
            }
            found.witness = motion();
            let effort = &mut found.effort;
            let best = match settings.choice {
                Choice::Any => None,
                Choice::Unique => least_squares_balance(program, &whole, &solved, [settings, face_settings], effort),
            };
            let mut face = match (best, settings.choice) {
                (Some(best), _) => best,
                (None, Choice::Unique) => whole.with_amounts(solved.amounts),
                // Remove the solver's residual by one linear system, which is cheaper than a later correction block by
                // block.
                (None, Choice::Any) => {
                    let (loads, amounts) = (&whole.loads, solved.amounts);
                    let amounts = balance_by_least_change(loads, &whole.columns, amounts, settings, effort);
                    whole.with_amounts(amounts)
                }
            };
            if settings.conditioning == Conditioning::Full {
                face.amounts = refine_balance(&face.loads, &face.columns, face.amounts, effort);
            }
            found.forces = Some(face.to_forces(program).0);
        }
        // The loads do negative work along the velocities of the dual. The blocks therefore move in the opposite
        // direction.
        Status::Unbounded => found.motion = motion(),
        _ => {}
    }
    found
}

/// Computes the least force for few blocks whose loads differ by many powers of ten. The result is accurate relative to
/// the load of each block.
///
/// `None` if the loads are of similar size, if there are many blocks, if any balance is sufficient ([`Choice::Any`]),
/// or if the refinement fails.
fn balance_by_levels(
    program: &Program,
    whole: &Face,
    solved: &Optimum,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Balance> {
    let light = lightest(&whole.loads);
    let has_wide_range = light < WIDE_LOAD_RATIO * largest(&whole.loads);
    if !has_wide_range || program.has_many_blocks() || settings.choice == Choice::Any {
        return None;
    }
    // Refine the optimum level by level, from the largest loads to the smallest. Then choose the forces of least
    // Σ force² on the face of optima.
    let (loads, columns) = (&whole.loads, &whole.columns);
    let optimum = refined_optimum(loads, columns, |c| c.cost, solved, light, effort)?;
    let face = whole.optimal_face(&optimum, 1.0);
    let (forces, _) = with_least_squares(face, light, settings, effort).to_forces(program);
    Some(Balance { forces: Some(forces), witness: Some(optimum.motion()), effort: *effort, ..Balance::default() })
}

/// Step 1: solves the kinematic form. Returns its optimum, and the settings for the least-squares problem on the face of
/// optima.
fn solve_first(
    program: &Program,
    whole: &Face,
    settings: SolverSettings,
    effort: &mut Effort,
) -> (Optimum, SolverSettings) {
    let cost = |column: &Column| column.cost;
    let usual = SolverSettings { iterations: MAX_ITERATIONS, ..settings };
    if !program.has_many_blocks() {
        return (least_cost(&whole.loads, &whole.columns, usual, effort, cost), usual);
    }
    let mut solve =
        |settings| solve_kinematic_form(&whole.loads, &whole.columns, &Aim::Least(&cost), [settings], effort);
    let short = |most: usize| SolverSettings { iterations: most.min(MAX_ITERATIONS_MANY), ..settings };
    let solved = solve(if settings.conditioning == Conditioning::Plain { short(settings.iterations) } else { usual });
    // If many columns are doubtful (see `doubtful_share`), solve again to a finer tolerance.
    if settings.choice == Choice::Unique && doubtful_share(&solved) > MAX_DOUBTFUL_SHARE {
        let tolerance = FINE_TOLERANCE_FACTOR * settings.tolerance;
        let finer = solve(SolverSettings { tolerance, ..short(MAX_ITERATIONS_MANY) });
        if finer.status == Status::Solved {
            return (finer, SolverSettings { conditioning: Conditioning::Full, ..usual });
        }
    }
    (solved, usual)
}

/// Steps 2 to 4: among the balances of least cost, finds the one of least Σ force². `None` if none of the
/// [`ACTIVE_MARGINS`] leads to such a balance.
///
/// `settings[0]` is for removing the residual of a balance, and `settings[1]` is for the least-squares problem.
fn least_squares_balance(
    program: &Program,
    whole: &Face,
    solved: &Optimum,
    settings: [SolverSettings; 2],
    effort: &mut Effort,
) -> Option<Face> {
    let [repair_settings, face_settings] = settings;
    let size = largest(&program.loads);
    let mut best: Option<(f64, Face)> = None;
    let mut tried = Vec::with_capacity(ACTIVE_MARGINS.len());
    for margin in ACTIVE_MARGINS {
        // Step 2: select the columns of the face of optima.
        let face = whole.optimal_face(solved, margin);
        // The face of a larger margin contains the face of a smaller margin. If both have equally many columns, they
        // are the same face.
        let counts = (face.columns.len(), face.at_limit.len());
        if tried.contains(&counts) {
            continue;
        }
        tried.push(counts);
        // Step 3: solve the least-squares problem on the face.
        let Some(mut amounts) = least_squares_amounts(&face.loads, &face.columns, face_settings, effort) else {
            continue;
        };
        // Step 4: check the cost and the residual.
        let cost = face.cost(&amounts);
        let difference = (cost - solved.objective).abs() / solved.objective.abs();
        let is_balanced =
            |amounts: &[f64]| largest(&remainder(&face.loads, &face.columns, amounts)) <= BALANCE_TOL * size;
        if difference <= ROUGH_COST_TOL && !is_balanced(&amounts) {
            // The face is correct, but in long arches the rounding errors add up to more than a proof allows. Remove
            // the residual.
            amounts = balance_by_least_change(&face.loads, &face.columns, amounts, repair_settings, effort);
        }
        if difference > ROUGH_COST_TOL || !is_balanced(&amounts) {
            continue;
        }
        // Keep the balance of least cost. Stop at the first balance whose cost is within the tolerance.
        if best.as_ref().is_none_or(|best| cost < best.0) {
            best = Some((cost, face.with_amounts(amounts)));
        }
        if difference <= COST_TOL {
            break;
        }
    }
    best.map(|(_, face)| face)
}
