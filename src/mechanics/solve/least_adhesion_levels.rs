//! Computes the least adhesion accurately if the loads differ by more powers of ten than a solver has correct digits.
//!
//! The stages are those of [`super::least_adhesion()`], but the optimum of each stage is refined level by level
//! ([`super::level`]). Even the adhesion of a stone of a gram on a block of a hundred tons then has correct digits. A
//! column leaves the face of optima if its amount is exactly 0; no threshold relative to the largest force is used.

use super::level::{WIDE_LOAD_RATIO, block_loads, lightest, refined_optimum, with_least_squares};
use super::{Dual, Effort, Face, SolverSettings, Status, dual, largest};
use crate::mechanics::program::Column;

/// If the least sum of adhesion is below this fraction of the largest load, the optimum is refined until forces of the
/// size of this sum are accurate.
const SMALL_ADHESION: f64 = 1e-3;

/// A least sum of adhesion below this fraction of the largest load counts as 0: it is the rounding of the loads.
///
/// A push on a heavy stone without friction needs adhesion, even if the push is far below the solver's tolerance.
const ZERO_ADHESION: f64 = 1e-15;

/// [`ZERO_ADHESION`] for many blocks, where a refinement takes long. It is a tenth of the solver's tolerance.
const ZERO_ADHESION_MANY: f64 = 1e-10;

/// Sums of adhesion whose relative difference is at most this count as equal. It is a hundredth of the error that a
/// result may have.
const SUM_TOL: f64 = 1e-8;

/// If the refined sum of adhesion is below this multiple of the smallest accurate force, the optimum is refined again.
const REFINE_AGAIN_RATIO: f64 = 1e-2;

/// The largest number of rounds of stage 3.
const MAX_ROUNDS: usize = 4;

/// Returns the size of the smallest forces that must be accurate, in the units of the loads.
///
/// `None` if this size is so close to the largest load that the unrefined optimum is accurate enough. `least_sum` is
/// the least sum of adhesion, and `has_many_blocks` says whether the program has many blocks.
fn smallest_accurate_force(loads: &[f64], least_sum: f64, has_many_blocks: bool) -> Option<f64> {
    let largest_load = largest(loads);
    let light = lightest(loads);
    let zero_tol = if has_many_blocks { ZERO_ADHESION_MANY } else { ZERO_ADHESION };
    let is_small = zero_tol * largest_load < least_sum && least_sum < SMALL_ADHESION * largest_load;
    let force_size = if is_small { light.min(least_sum) } else { light };
    (force_size < WIDE_LOAD_RATIO * largest_load && force_size > 0.0).then_some(force_size)
}

/// Returns the refined optimum of stage 1, and the size of the smallest forces that are accurate in it.
///
/// `None` if loads and adhesion do not differ by many powers of ten, or if the refinement fails. `first` is the optimum
/// of stage 1; `has_many_blocks` says whether the program has many blocks. The unrefined sum of adhesion may consist
/// only of the solver's error. If the refined sum is far smaller than the smallest accurate force, the optimum is
/// therefore refined again.
pub(super) fn precise_optimum(
    whole: &Face,
    first: &Dual,
    has_many_blocks: bool,
    effort: &mut Effort,
) -> Option<(Dual, f64)> {
    let (loads, columns) = (&whole.loads, &whole.columns);
    let cost = |c: &Column| f64::from(u8::from(c.force.is_adhesion()));
    let mut refined = |start: &Dual| {
        let least_sum = whole.adhesion_sum(&start.amounts);
        let force_size = smallest_accurate_force(loads, least_sum, has_many_blocks)?;
        let found = refined_optimum(loads, columns, cost, start, force_size, effort)?;
        Some((found, force_size))
    };
    let (found, force_size) = refined(first)?;
    match whole.adhesion_sum(&found.amounts) < REFINE_AGAIN_RATIO * force_size {
        true => refined(&found).or(Some((found, force_size))),
        false => Some((found, force_size)),
    }
}

/// Chooses one balance among all balances of least adhesion: the least force first, then the fewest points with
/// adhesion, then the least Σ force².
///
/// `first` is the refined optimum of stage 1. A stage that ends without an optimum is skipped.
pub(super) fn least_force_optimum(
    whole: &Face,
    first: &Dual,
    force_size: f64,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Face {
    let face = whole.optimal_face(first, 1.0);
    let least_sum = face.adhesion_sum(&face.amounts);
    // A column whose true slack is smaller than the solver's error may be on the face by mistake. If a later stage
    // increases the adhesion by using such a column, its result is rejected.
    let unchanged = |face: &Face| face.adhesion_sum(&face.amounts) <= (1.0 + SUM_TOL) * least_sum;
    // Stage 2: least force.
    let second = optimum(&face, force_size, settings, effort, |c| c.cost);
    let narrower = second.map(|second| face.optimal_face(&second, 1.0));
    let face = narrower.filter(unchanged).unwrap_or(face);
    // Stages 3 and 4: fewest points, then least squares.
    let concentrated = concentrate(face.clone(), force_size, settings, effort);
    let face = Some(concentrated).filter(unchanged).unwrap_or(face);
    let squares = with_least_squares(face.clone(), force_size, settings, effort);
    Some(squares).filter(unchanged).unwrap_or(face)
}

/// Computes the optimum on a face for the given costs, accurate relative to the load of each body. `None` if no optimum
/// is found.
fn optimum(
    face: &Face,
    force_size: f64,
    settings: SolverSettings,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Option<Dual> {
    let solved = dual(&face.loads, &face.columns, settings, effort, &cost);
    let start = (solved.status == Status::Solved).then_some(solved)?;
    refined_optimum(&face.loads, &face.columns, cost, &start, force_size, effort)
}

/// Stage 3: reduces the face to few points with adhesion.
///
/// In each round, the cost of an adhesion column increases if its amount is small. The amount is measured relative to
/// the smaller load of the two bodies on which the column acts.
fn concentrate(mut face: Face, force_size: f64, settings: SolverSettings, effort: &mut Effort) -> Face {
    // The smallest nonzero load of the blocks on which a column acts; 1 if there is none.
    let block_loads = block_loads(&face.loads);
    let lighter_load = |column: &Column| {
        let loads = column.entries().map(|(row, _)| block_loads[row / 3]);
        let light = loads.filter(|load| *load > 0.0).fold(f64::INFINITY, f64::min);
        if light.is_finite() { light } else { 1.0 }
    };
    for _ in 0..MAX_ROUNDS {
        let adheres = |column: &&Column| column.force.is_adhesion();
        let before = face.columns.iter().filter(adheres).count();
        if before < 2 {
            break;
        }
        // Reweighting: the cost of a column is nearly proportional to 1/share, where share = amount / smaller load. It
        // is at most about a thousand times the cost of the column with the largest share.
        let columns = face.columns.iter().zip(&face.amounts);
        let shares: Vec<f64> = columns
            .map(|(column, amount)| match column.force.is_adhesion() {
                true => amount / lighter_load(column),
                false => 0.0,
            })
            .collect();
        let largest_share = largest(&shares);
        for (column, share) in face.columns.iter_mut().zip(&shares) {
            if column.force.is_adhesion() {
                column.cost = 1e-2 * largest_share / (share + 1e-3 * largest_share);
            }
        }
        let cost = |c: &Column| if c.force.is_adhesion() { c.cost } else { 0.0 };
        let Some(solved) = optimum(&face, force_size, settings, effort, cost) else {
            break;
        };
        // Drop the adhesion columns whose amount is exactly 0; stop if there are no such columns.
        face.amounts = solved.amounts;
        face = face.restrict(|column, amount| !column.force.is_adhesion() || amount > 0.0);
        if face.columns.iter().filter(adheres).count() == before {
            break;
        }
    }
    face
}
