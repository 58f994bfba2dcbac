//! Computes the least adhesion with which a structure would stand: tension and excess friction of contacts, and excess
//! forces of robots. Further objectives, in this order: least force, fewest points with adhesion, least Σ force².
//!
//! This is the limit β → ∞ of [Vallat23](crate::doc::references) §2.0.8, computed without a large number. Each stage
//! keeps only the columns on the face of optima of the previous stage. A stage therefore cannot worsen the objective of
//! an earlier stage. Stages:
//!
//! 1. least Σ adhesion, where admissible forces cost nothing;
//! 2. least Σ force, on the face of stage 1;
//! 3. fewest points with adhesion: an interior-point method spreads adhesion over all points that an optimum may use.
//!    Each round of this stage therefore raises the cost of columns with small amounts (reweighted ℓ₁, Candès, Wakin
//!    and Boyd 2008). The cost depends only on amounts, not on the order of blocks in the file. A symmetric structure
//!    therefore keeps symmetric forces, and the figure of a mirrored scene is the mirrored figure;
//! 4. least Σ force² on the remaining columns, which is unique.

use super::level::{self, SUM_TOL_PRECISE, block_loads, lightest, refined_optimum, with_least_squares};
use super::optimum::{solve_kinematic_form, solve_static_form};
use super::scaled::{ReducedColumns, columns_in};
use super::{
    Balance, Conditioning, CrossoverTolerance, Effort, Face, Optimum, SolverSettings, Status, TOLERANCE, determinate,
    largest, least_squares_amounts, refine_balance,
};
use crate::mechanics::program::{Aim, Column, Program, adhesion_columns};

/// The largest number of rounds of stage 3. The number of points rarely falls after the third round.
const MAX_ROUNDS: usize = 4;

/// The number of rounds of stage 3 for many blocks.
///
/// In 120 walls of 200 to 2 000 bricks, more rounds removed only 1 to 3 points in 100 (9 in one wall) and took a tenth
/// of the total time.
const MAX_ROUNDS_MANY: usize = 1;

/// Costs of admissible forces in stage 1, where adhesion costs 1 (1/β in Vallat (2023)). They are tried in turn if
/// stage 1 ends without a result when these forces cost nothing.
///
/// If blocks are wedged, the forces between them can be arbitrarily large. The dual of stage 1 then has no interior,
/// and the solver may end without a result. With a positive cost the dual has an interior.
const FORCE_COSTS: [f64; 2] = [1e-6, 1e-4];

/// Stage 3 drops the adhesion at a point if it is below this fraction of the largest adhesion at a point.
///
/// The second value is tried if the first drops adhesion that is needed, for example to carry a light load.
const DROP_TOL: [f64; 2] = [1e-5, 1e-9];

/// [`DROP_TOL`] for many blocks.
///
/// At 10⁻⁵ a needed column was dropped in a wall of 4 128 bricks, and the least-squares problem took 1.8 s to show it.
/// At 10⁻⁹ adhesion that is only the solver's rounding is kept too, so the result has up to 40 % more points.
const DROP_TOL_MANY: [f64; 2] = [1e-6, 1e-9];

/// With many blocks, stages 2 to 4 are skipped if stage 1 does not separate basic columns clearly from the others: the
/// sum of the slacks of basic columns exceeds this multiple of the tolerance for sums of adhesion.
///
/// If each of these columns carried the largest load, the sum of adhesion would grow by the sum of their slacks. In 46
/// walls of 200 to 2 000 bricks, stage 2 had a valid answer up to a multiple of 0.11 and none from 0.96.
const MAX_BASIC_SLACK: f64 = 0.5;

/// The stopping rule of stage 1 for many blocks: a finer tolerance, with which basic columns are clearly distinct.
///
/// Without this rule, the face of optima of a wall of 2 000 bricks, rotated by 40°, contained no balance in stage 2.
const CROSSOVER: CrossoverTolerance =
    CrossoverTolerance { tolerance_factor: 1e-2, max_slack: 1.2 * MAX_BASIC_SLACK * SUM_TOL_MANY, early_factor: 3.0 };

/// If a velocity of the motion of stage 1 reaches this, no adhesion prevents the motion: only lever arms of rounding do.
///
/// The motion is scaled so that no adhesion is overcome at a velocity above 1. With kernel 1 a lever arm is 10⁻¹⁶ instead
/// of 0, the velocity is 10¹⁶, and pulls of 10 MN would balance a load of 10⁻⁹ N. A kernel of 1 − 10⁻⁹ leads to
/// velocities of only 10⁹.
const MIN_FREE_SPEED: f64 = 1e13;

/// Stage 1 is solved again at most this many times, each time without the loads along one more motion that no adhesion
/// prevents.
const MAX_FREE_MOTIONS: usize = 4;

/// Margins of [`Optimum::active`], tried in turn: if a margin of 1 drops a needed column, a larger margin keeps it.
const ACTIVE_MARGINS: [f64; 3] = [1.0, 1e3, 1e6];

/// Two sums of adhesion count as equal if their relative difference is at most this.
///
/// It corresponds to the solver's tolerance of 1e-9 for each of a few tens of terms. If it were ten times smaller,
/// valid later stages would be rejected; if it were ten times larger, stage 2 could accept more adhesion to reduce the
/// force.
const SUM_TOL: f64 = 3e-8;

/// [`SUM_TOL`] for many blocks, where the sum that the solver returns is itself less accurate.
const SUM_TOL_MANY: f64 = 3e-7;

/// Computes the least adhesion with which forces balance every block, or a motion that no adhesion prevents. Also
/// returns the forces and the motion that belong to this adhesion.
///
/// With many blocks the program is scaled to a largest load of 1. With loads of 300, six attempts to solve a wall of
/// 410 bricks slightly beyond its limit each ended without a result after a hundred iterations; with loads of 1 it is
/// solved in 69.
pub fn least_adhesion_in(program: &Program, settings: SolverSettings) -> Balance {
    determinate::least_adhesion(program).unwrap_or_else(|| by_programs(program, settings))
}

/// Like [`least_adhesion_in`], but without the closed form for statically determinate structures.
pub(super) fn by_programs(program: &Program, settings: SolverSettings) -> Balance {
    let mut effort = Effort::default();
    let many = program.has_many_blocks();
    // If there are many blocks, scale the loads to a largest load of 1.
    let load = match largest(&program.loads) {
        load if many && load > 0.0 => load,
        _ => 1.0,
    };
    let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
    let mut all = columns_in(program, load);
    all.extend(adhesion_columns(program));
    let mut whole = Face::whole(&loads, all);
    // Stage 1: least adhesion. If no adhesion balances the blocks, the kinematic form is unbounded along a motion.
    let (mut first, mut priced) = first_stage(&whole, many, settings, &mut effort);
    let mut free = None;
    for _ in 0..MAX_FREE_MOTIONS {
        if first.status != Status::Solved || largest(&first.y) < MIN_FREE_SPEED {
            break;
        }
        // Leave out the part of the loads that drives this motion, so that the adhesion elsewhere is still found.
        whole.loads = without_work_along(&whole.loads, &first.y);
        free = free.or_else(|| Some(first.motion()));
        (first, priced) = first_stage(&whole, many, settings, &mut effort);
    }
    let holds_nothing = free.is_some()
        && (largest(&first.y) >= MIN_FREE_SPEED
            || whole.adhesion_sum(&first.amounts) <= TOLERANCE * largest(&whole.loads));
    if first.status != Status::Solved || holds_nothing {
        let motion = free.or_else(|| (first.status == Status::Unbounded).then(|| first.motion()));
        return Balance { motion, priced, effort, ..Balance::default() };
    }
    // If loads or adhesion differ by many powers of ten, refine the optimum of stage 1 level by level, from the
    // largest amounts to the smallest.
    let (first, force_size) = match level::precise_optimum(&whole, &first, many, &mut effort) {
        Some((refined, force_size)) => (refined, Some(force_size)),
        None => (first, None),
    };
    let motion = free.or_else(|| Some(first.motion()));
    let mut face = LaterStages::new(&whole, &first, many, force_size, settings).face(&whole, &first, &mut effort);
    if settings.conditioning == Conditioning::Full && force_size.is_none() {
        face.amounts = refine_balance(&face.loads, &face.columns, face.amounts, &mut effort);
    }
    // Convert the forces back to the units of the program.
    let (mut forces, mut adhesion) = face.to_forces(program);
    forces.multiply(load);
    adhesion.multiply(load);
    Balance { forces: Some(forces), adhesion: Some(adhesion), motion, priced, witness: None, effort }
}

/// Returns the loads without the part that does work along `y`.
fn without_work_along(loads: &[f64], y: &[f64]) -> Vec<f64> {
    // Scale the velocities to 1 first, so that their squares do not overflow.
    let fastest = largest(y);
    let power: f64 = loads.iter().zip(y).map(|(load, v)| load * v / fastest).sum();
    let squares: f64 = y.iter().map(|v| v / fastest * (v / fastest)).sum();
    loads.iter().zip(y).map(|(load, v)| load - power / squares * v / fastest).collect()
}

/// Stage 1: computes the least Σ adhesion. Returns the solution of the last linear program, and true if admissible
/// forces had a small cost in this program.
fn first_stage(whole: &Face, many: bool, settings: SolverSettings, effort: &mut Effort) -> (Optimum, bool) {
    let priced = |price: f64, effort: &mut Effort| {
        let cost = |c: &Column| if c.force.is_adhesion() { 1.0 } else { price * c.cost };
        solve_kinematic_form(&whole.loads, &whole.columns, &Aim::Least(&cost), settings.with_retry(), effort)
    };
    let mut last = if many { first_stage_of_many(whole, settings, effort) } else { priced(0.0, effort) };
    let mut dear = false;
    for price in FORCE_COSTS {
        if last.status != Status::Unsolved {
            break;
        }
        last = priced(price, effort);
        dear = true;
    }
    (last, dear)
}

/// Stage 1 for many blocks: solves the kinematic form without redundant columns. If it ends without a result, the
/// static form is solved.
fn first_stage_of_many(whole: &Face, settings: SolverSettings, effort: &mut Effort) -> Optimum {
    // Without redundant columns, the kinematic form has fewer rows.
    let reduced_columns = ReducedColumns::new(&whole.columns);
    let (loads, columns) = (&whole.loads, &reduced_columns.columns);
    let cost = |c: &Column| f64::from(u8::from(c.force.is_adhesion()));
    // The adhesion of light blocks converges last, so stage 1 does not stop early if there are any.
    let has_light = lightest(loads) < level::WIDE_LOAD_RATIO * largest(loads);
    let early_factor = if has_light { 0.0 } else { CROSSOVER.early_factor };
    let finer = SolverSettings { crossover: Some(CrossoverTolerance { early_factor, ..CROSSOVER }), ..settings };
    let mut solved = solve_kinematic_form(loads, columns, &Aim::Least(&cost), [finer], effort);
    if solved.status == Status::Unsolved {
        solved = solve_static_form(loads, columns, settings, effort, cost);
    }
    reduced_columns.expand_optimum(&whole.columns, solved)
}

/// Stages 2 to 4: choose one balance among all balances of least adhesion.
struct LaterStages {
    /// Whether the program has many blocks. Its tolerances are then wider, so that walls near their limit can meet
    /// them, and a stage that ends without a result is not solved again: it would do so with full conditioning, too,
    /// and take two to four times as long.
    many: bool,
    /// If the optimum of each stage is refined level by level ([`level`]): the size of the smallest forces that must be
    /// accurate. Stage 3 then drops only amounts of exactly 0.
    force_size: Option<f64>,
    settings: SolverSettings,
    /// The least sum of adhesion.
    least: f64,
    /// Another sum of adhesion counts as equal if it differs by at most this.
    tolerance: f64,
}

impl LaterStages {
    fn new(
        whole: &Face,
        first: &Optimum,
        many: bool,
        force_size: Option<f64>,
        settings: SolverSettings,
    ) -> LaterStages {
        let least = whole.adhesion_sum(&first.amounts);
        // Sums that differ by less than the solver's tolerance count as equal.
        let slight = TOLERANCE * largest(&whole.loads);
        let tolerance = match (force_size, many) {
            (Some(_), _) => SUM_TOL_PRECISE * least,
            (None, true) => SUM_TOL_MANY * least + slight,
            (None, false) => SUM_TOL * least + slight,
        };
        LaterStages { many: many && force_size.is_none(), force_size, settings, least, tolerance }
    }

    /// Returns the chosen balance: a face with its amounts.
    ///
    /// For many blocks near the limit of stability, basic columns cannot be distinguished from the others: the least
    /// force may decrease by a tenth if the adhesion increases by only a millionth. In this case, the balance of stage
    /// 1 is returned. It has the least adhesion, but not the least force.
    fn face(&self, whole: &Face, first: &Optimum, effort: &mut Effort) -> Face {
        let from_first_stage = || match self.force_size {
            Some(_) => whole.optimal_face(first, 1.0),
            None => whole.clone().with_amounts(first.amounts.clone()),
        };
        // The sum of the slacks of the basic columns measures how well stage 1 separates them from the others.
        let in_use = first.slack.iter().zip(first.active(1.0));
        let slack: f64 = in_use.filter(|(_, active)| *active).map(|(slack, _)| slack).sum();
        if self.many && slack > MAX_BASIC_SLACK * self.tolerance {
            return from_first_stage();
        }
        let Some(face) = self.least_force(whole, first, effort).or_else(|| (!self.many).then(from_first_stage)) else {
            return from_first_stage();
        };
        let drop_tolerances = match (self.force_size, self.many) {
            (Some(_), _) => &[0.0][..],
            (None, true) => &DROP_TOL_MANY,
            (None, false) => &DROP_TOL,
        };
        for drop_tolerance in drop_tolerances {
            let few = self.concentrate(&face, *drop_tolerance, effort);
            if let Some(squares) = few.and_then(|few| self.least_squares(few, effort)) {
                return squares;
            }
        }
        face
    }

    /// True if a balance has the least sum of adhesion. A column whose true slack is smaller than the solver's error may
    /// be on a face by mistake. If a stage increases the adhesion by using such a column, its result is rejected.
    fn has_least_adhesion(&self, face: &Face) -> bool {
        (face.adhesion_sum(&face.amounts) - self.least).abs() <= self.tolerance
    }

    /// Solves the program of stage 2 or 3.
    fn solve(&self, face: &Face, effort: &mut Effort, cost: impl Fn(&Column) -> f64) -> Optimum {
        let (loads, columns) = (&face.loads, &face.columns);
        let attempts = self.settings.with_retry().take(if self.many { 1 } else { 2 });
        let solved = solve_kinematic_form(loads, columns, &Aim::Least(&cost), attempts, effort);
        let Some(force_size) = self.force_size.filter(|_| solved.status == Status::Solved) else {
            return solved;
        };
        let refined = refined_optimum(loads, columns, cost, &solved, force_size, effort);
        refined.unwrap_or(Optimum { status: Status::Unsolved, ..solved })
    }

    /// Stage 2: returns the face of the balances that have the least force among those of least adhesion.
    ///
    /// `None` if the solver finds no balance with the same sum of adhesion for any of the margins.
    fn least_force(&self, whole: &Face, first: &Optimum, effort: &mut Effort) -> Option<Face> {
        let count = if self.many || self.force_size.is_some() { 1 } else { ACTIVE_MARGINS.len() };
        ACTIVE_MARGINS[..count].iter().find_map(|margin| {
            // Restrict to the optima of stage 1, minimise the force, and check that the adhesion is unchanged.
            let narrow = whole.optimal_face(first, *margin);
            let second = self.solve(&narrow, effort, |c| c.cost);
            if second.status != Status::Solved {
                return None;
            }
            let narrower = narrow.optimal_face(&second, 1.0);
            let narrow = narrow.with_amounts(second.amounts);
            let same = self.has_least_adhesion(&narrow);
            same.then(|| if self.has_least_adhesion(&narrower) { narrower } else { narrow })
        })
    }

    /// Stage 3: reduces the face to few points with adhesion. `None` if the program has many blocks and the remaining
    /// columns cannot balance the loads.
    fn concentrate(&self, face: &Face, drop_tolerance: f64, effort: &mut Effort) -> Option<Face> {
        let mut face = face.clone();
        for _ in 0..if self.many { MAX_ROUNDS_MANY } else { MAX_ROUNDS } {
            if face.columns.iter().filter(|c| c.force.is_adhesion()).count() < 2 {
                break;
            }
            // Reweighting: the cost of a column is nearly proportional to 1/share. It is at most about a thousand times
            // the cost of the column with the largest share.
            let shares = self.shares(&face);
            let most = largest(&shares);
            for (column, share) in face.columns.iter_mut().zip(&shares) {
                if column.force.is_adhesion() {
                    column.cost = 1e-2 * most / (share + 1e-3 * most);
                }
            }
            let solved = self.solve(&face, effort, |c| if c.force.is_adhesion() { c.cost } else { 0.0 });
            // If the kinematic form is unbounded, these columns cannot balance the loads. The least-squares problem of
            // stage 4 would take ten times as long to show this.
            if self.many && solved.status == Status::Unbounded {
                return None;
            }
            let before = std::mem::replace(&mut face.amounts, solved.amounts);
            if solved.status != Status::Solved || !self.has_least_adhesion(&face) {
                face.amounts = before;
                break;
            }
            // Drop the points with little adhesion; stop if there are no such points.
            let shares = self.shares(&face);
            let (most, mut shares) = (largest(&shares), shares.into_iter());
            let count = face.columns.len();
            face = face.restrict(|column, _| {
                let share = shares.next().unwrap_or(0.0);
                !column.force.is_adhesion() || share > drop_tolerance * most
            });
            if face.columns.len() == count {
                break;
            }
        }
        Some(face)
    }

    /// Returns, for each column, its amount if it is adhesion, otherwise 0. If the loads differ by many powers of ten,
    /// the amount is relative to the smaller load of the two bodies on which the column acts.
    fn shares(&self, face: &Face) -> Vec<f64> {
        let block_loads = self.force_size.map(|_| block_loads(&face.loads));
        let lighter_load = |column: &Column| {
            let loads = block_loads.iter().flat_map(|loads| column.entries().map(|(row, _)| loads[row / 3]));
            let light = loads.filter(|load| *load > 0.0).fold(f64::INFINITY, f64::min);
            if light.is_finite() { light } else { 1.0 }
        };
        let columns = face.columns.iter().zip(&face.amounts);
        columns.map(|(c, amount)| if c.force.is_adhesion() { amount / lighter_load(c) } else { 0.0 }).collect()
    }

    /// Stage 4: returns the face with the amounts of least Σ force². `None` if they are not found, or if they change the
    /// sum of adhesion.
    fn least_squares(&self, few: Face, effort: &mut Effort) -> Option<Face> {
        let squares = match self.force_size {
            Some(force_size) => with_least_squares(few, force_size, self.settings, effort),
            None => {
                // With many blocks, the face has hardly more columns than a unique balance would have. With plain
                // conditioning, the least-squares problem then ends without a result.
                let full = SolverSettings { conditioning: Conditioning::Full, ..self.settings };
                let settings = if self.many { full } else { self.settings };
                let amounts = least_squares_amounts(&few.loads, &few.columns, settings, effort)?;
                few.with_amounts(amounts)
            }
        };
        Some(squares).filter(|face| self.has_least_adhesion(face))
    }
}
