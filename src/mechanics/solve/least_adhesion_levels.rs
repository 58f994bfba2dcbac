//! The later stages of the least adhesion, where its sizes span more digits than a solver has.
//!
//! As [`super::stick`], with every stage solved level by level ([`super::level`]), so that a stone of a gram on a block of a
//! hundred tons sticks by its own digits. Columns leave the face of optima by an amount of exactly 0, and no threshold in
//! parts of the largest force decides.

use super::level::{WIDE, lightest, own_loads, refined_optimum, with_least_squares};
use super::{Dual, Effort, Face, SolverSettings, Status, dual, largest};
use crate::program::Column;

/// A sum of sticking below this part of the largest load is more than a solver's digits away from it.
const SLIGHT: f64 = 1e-3;

/// A sum of sticking below this part of the largest load is none.
const NONE: f64 = 1e-10;

/// Rounds of concentrating.
const ROUNDS: usize = 4;

/// The size of force whose digits are wanted, where an optimum of the least adhesion does not have them.
pub(super) fn wanted(loads: &[f64], least: f64) -> Option<f64> {
    let most = largest(loads);
    let light = lightest(loads);
    let slight = NONE * most < least && least < SLIGHT * most;
    let wanted = if slight { light.min(least) } else { light };
    (wanted < WIDE * most && wanted > 0.0).then_some(wanted)
}

/// Among all balances of least adhesion the one that is shown: of least force, then with fewest points that stick.
///
/// `first` is the optimum of the first stage, refined. A stage that the solver does not get through is left out.
pub(super) fn chosen(
    whole: &Face,
    first: &Dual,
    wanted: f64,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Face {
    let mut face = whole.narrowed(first, 1.0);
    if let Some(second) = optimum(&face, wanted, settings, effort, |c| c.cost) {
        face = face.narrowed(&second, 1.0);
    }
    let face = concentrated(face, wanted, settings, effort);
    with_least_squares(face, wanted, settings, effort)
}

/// The optimum of a face for given costs, every body with its own digits.
fn optimum(
    face: &Face,
    wanted: f64,
    settings: SolverSettings,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Option<Dual> {
    let solved = dual(&face.loads, &face.columns, settings, effort, &cost);
    let start = (solved.status == Status::Solved).then_some(solved)?;
    refined_optimum(&face.loads, &face.columns, cost, &start, wanted, effort)
}

/// The face with few points that stick: little sticking, in parts of the load where it acts, is made dear round by round.
fn concentrated(
    mut face: Face,
    wanted: f64,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Face {
    let own = own_loads(&face.loads);
    let lightest_of = |column: &Column| {
        let loads = column.entries().map(|(row, _)| own[row / 3]);
        let light = loads
            .filter(|load| *load > 0.0)
            .fold(f64::INFINITY, f64::min);
        if light.is_finite() { light } else { 1.0 }
    };
    for _ in 0..ROUNDS {
        let sticks = |column: &&Column| column.force.is_sticking();
        let before = face.columns.iter().filter(sticks).count();
        if before < 2 {
            break;
        }
        let columns = face.columns.iter().zip(&face.amounts);
        let shares: Vec<f64> = columns
            .map(|(column, amount)| match column.force.is_sticking() {
                true => amount / lightest_of(column),
                false => 0.0,
            })
            .collect();
        let most = largest(&shares);
        for (column, share) in face.columns.iter_mut().zip(&shares) {
            if column.force.is_sticking() {
                column.cost = 1e-2 * most / (share + 1e-3 * most);
            }
        }
        let cost = |c: &Column| if c.force.is_sticking() { c.cost } else { 0.0 };
        let Some(solved) = optimum(&face, wanted, settings, effort, cost) else {
            break;
        };
        face.amounts = solved.amounts;
        face = face.only(|column, amount| !column.force.is_sticking() || amount > 0.0);
        if face.columns.iter().filter(sticks).count() == before {
            break;
        }
    }
    face
}
