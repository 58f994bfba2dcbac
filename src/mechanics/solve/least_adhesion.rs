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

use super::dual::{ReducedColumns, columns_in};
use super::{
    Amounts, Conditioning, CrossoverTolerance, Dual, Effort, Face, LeastAdhesion, SolverSettings, Status, TOLERANCE,
    determinate, dual, from_kinematic_answer, largest, least_squares_amounts, level, refine_balance, solve_once,
    solve_static_form,
};
use crate::mechanics::program::{Column, Program, adhesion_columns, kinematic_dual};

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

/// Whether a program has few or many blocks, which decides how the program is scaled and solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Size {
    /// Few blocks: loads are not scaled, and the tolerances are strict. A stage that ends without a result is solved
    /// again with full conditioning.
    Few,
    /// Many blocks: loads are scaled to a largest load of 1. The tolerances are wider, so that walls near their limit
    /// can meet them.
    Many,
}

impl Size {
    fn new(program: &Program) -> Size {
        if program.has_many_blocks() { Size::Many } else { Size::Few }
    }
}

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

/// Margins of [`Dual::active`], tried in turn: if a margin of 1 drops a needed column, a larger margin keeps it.
const ACTIVE_MARGINS: [f64; 3] = [1.0, 1e3, 1e6];

/// Two sums of adhesion count as equal if their relative difference is at most this.
///
/// It corresponds to the solver's tolerance of 1e-9 for each of a few tens of terms. If it were ten times smaller,
/// valid later stages would be rejected; if it were ten times larger, stage 2 could accept more adhesion to reduce the
/// force.
const SUM_TOL: f64 = 3e-8;

/// [`SUM_TOL`] for many blocks, where the sum that the solver returns is itself less accurate.
const SUM_TOL_MANY: f64 = 3e-7;

/// Computes the least adhesion with which forces balance every block, or a motion that no adhesion prevents.
pub fn least_adhesion(program: &Program, conditioning: Conditioning) -> LeastAdhesion {
    least_adhesion_in(program, conditioning.into())
}

/// Like [`least_adhesion`], but the caller chooses all solver settings, not only the conditioning.
///
/// With many blocks the program is scaled to a largest load of 1. With loads of 300, six attempts to solve a wall of
/// 410 bricks slightly beyond its limit each ended without a result after a hundred iterations; with loads of 1 it is
/// solved in 69.
pub fn least_adhesion_in(program: &Program, settings: SolverSettings) -> LeastAdhesion {
    determinate::least_adhesion(program).unwrap_or_else(|| by_programs(program, settings))
}

/// Like [`least_adhesion_in`], but without the closed form for statically determinate structures.
pub(super) fn by_programs(program: &Program, settings: SolverSettings) -> LeastAdhesion {
    let mut effort = Effort::default();
    let size = Size::new(program);
    // If there are many blocks, scale the loads to a largest load of 1.
    let load = match largest(&program.loads) {
        load if size == Size::Many && load > 0.0 => load,
        _ => 1.0,
    };
    let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
    let mut all = columns_in(program, load);
    all.extend(adhesion_columns(program));
    let whole = Face::whole(&loads, all);
    // Stage 1: least adhesion. If no adhesion balances the blocks, the dual is unbounded along a motion.
    let (first, priced) = first_stage(&whole, size, settings, &mut effort);
    if first.status != Status::Solved {
        return without_balance(program, first, priced, effort);
    }
    let mut motion = Some(first.y.iter().map(|v| -v).collect());
    // If loads or adhesion differ by many powers of ten, refine the optimum of stage 1 level by level, from the
    // largest amounts to the smallest.
    let many = size == Size::Many;
    let precise = level::precise_optimum(&whole, &first, many, &mut effort);
    let mut face = match &precise {
        Some((first, force_size)) => {
            motion = Some(first.y.iter().map(|v| -v).collect());
            level::least_force_optimum(&whole, first, *force_size, settings, &mut effort)
        }
        None => later_stages(&whole, &first, size, settings, &mut effort),
    };
    if settings.conditioning == Conditioning::Full && precise.is_none() {
        face.amounts = refine_balance(&face.loads, &face.columns, face.amounts, &mut effort);
    }
    // Convert the forces back to the units of the program.
    let (mut forces, mut adhesion) = face.to_forces(program);
    forces.multiply(load);
    adhesion.multiply(load);
    LeastAdhesion { balanced: Some(true), forces, adhesion, motion, priced, effort }
}

/// Returns the result if stage 1 found no balance. The result contains a motion if the dual of stage 1 is unbounded.
fn without_balance(program: &Program, first: Dual, priced: bool, effort: Effort) -> LeastAdhesion {
    let none = Amounts::zero(program);
    let fallen = first.status == Status::Unbounded;
    LeastAdhesion {
        balanced: fallen.then_some(false),
        forces: none.clone(),
        adhesion: none,
        motion: fallen.then(|| first.y.iter().map(|v| -v).collect()),
        priced,
        effort,
    }
}

/// Stage 1: computes the least Σ adhesion. Returns the solution of the last linear program, and true if admissible
/// forces had a small cost in this program.
fn first_stage(whole: &Face, size: Size, settings: SolverSettings, effort: &mut Effort) -> (Dual, bool) {
    let priced =
        |price: f64, effort: &mut Effort| {
            dual(&whole.loads, &whole.columns, settings, effort, |c| {
                if c.force.is_adhesion() { 1.0 } else { price * c.cost }
            })
        };
    let mut last = match size {
        Size::Many => first_stage_of_many(whole, settings, effort),
        Size::Few => priced(0.0, effort),
    };
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

/// Returns the stopping rule of stage 1 for many blocks. If a block is far lighter than the largest load, stage 1 does
/// not stop early, because the adhesion of light blocks converges last.
fn crossover(loads: &[f64]) -> CrossoverTolerance {
    let bodies = loads.chunks_exact(3).map(|load| libm::hypot(load[0], load[1]));
    let lightest = bodies.filter(|load| *load > 0.0).fold(f64::INFINITY, f64::min);
    CrossoverTolerance {
        early_factor: if lightest < level::WIDE_LOAD_RATIO * largest(loads) { 0.0 } else { CROSSOVER.early_factor },
        ..CROSSOVER
    }
}

/// Stage 1 for many blocks: solves the kinematic form without redundant columns. If it ends without a result, the
/// static form is solved.
fn first_stage_of_many(whole: &Face, settings: SolverSettings, effort: &mut Effort) -> Dual {
    // Without redundant columns, the kinematic form has fewer rows.
    let reduced_columns = ReducedColumns::new(&whole.columns);
    let cost = |c: &Column| f64::from(u8::from(c.force.is_adhesion()));
    let (conic, row_of) = kinematic_dual(&whole.loads, &reduced_columns.columns, cost);
    let finer = SolverSettings { crossover: Some(crossover(&whole.loads)), ..settings };
    let answer = solve_once(&conic, finer, effort);
    let mut solved = from_kinematic_answer(&whole.loads, &reduced_columns.columns, &conic, &row_of, &answer);
    if solved.status == Status::Unsolved {
        solved = solve_static_form(&whole.loads, &reduced_columns.columns, settings, effort, cost);
    }
    reduced_columns.expand_optimum(&whole.columns, solved)
}

/// Stages 2 to 4: chooses one balance among all balances of least adhesion.
///
/// For many blocks near the limit of stability, basic columns cannot be distinguished from the others: the least force
/// may decrease by a tenth if the adhesion increases by only a millionth. In this case, the balance of stage 1 is
/// returned. It has the least adhesion, but not the least force.
fn later_stages(whole: &Face, first: &Dual, size: Size, settings: SolverSettings, effort: &mut Effort) -> Face {
    let least = whole.adhesion_sum(&first.amounts);
    let (same, margins) = match size {
        Size::Many => (SUM_TOL_MANY, &ACTIVE_MARGINS[..1]),
        Size::Few => (SUM_TOL, &ACTIVE_MARGINS[..]),
    };
    // Sums that differ by less than the solver's tolerance count as equal.
    let slight = TOLERANCE * largest(&whole.loads);
    let unchanged = |face: &Face, amounts: &[f64]| (face.adhesion_sum(amounts) - least).abs() <= same * least + slight;
    let from_first_stage = || whole.clone().with_amounts(first.amounts.clone());
    // The sum of the slacks of the basic columns measures how well stage 1 separates them from the others.
    let in_use = first.slack.iter().zip(first.active(1.0));
    let slack: f64 = in_use.filter(|(_, active)| *active).map(|(slack, _)| slack).sum();
    if size == Size::Many && slack > MAX_BASIC_SLACK * (same * least + slight) {
        return from_first_stage();
    }
    let Some(face) = least_force_face(whole, first, margins, &unchanged, size, settings, effort)
        .or_else(|| (size == Size::Few).then(from_first_stage))
    else {
        return from_first_stage();
    };
    // Stages 3 and 4. With many blocks, the face has hardly more columns than a unique balance would have. The
    // least-squares problem then needs full conditioning: with plain conditioning it ends without a result.
    let squares = match size {
        Size::Many => SolverSettings { conditioning: Conditioning::Full, ..settings },
        Size::Few => settings,
    };
    let drop_tolerances = match size {
        Size::Few => DROP_TOL,
        Size::Many => DROP_TOL_MANY,
    };
    for drop_tolerance in drop_tolerances {
        let Some(few) = concentrate(&face, drop_tolerance, &unchanged, size, settings, effort) else {
            continue;
        };
        let amounts = least_squares_amounts(&few.loads, &few.columns, squares, effort);
        if let Some(amounts) = amounts.filter(|amounts| unchanged(&few, amounts)) {
            return few.with_amounts(amounts);
        }
    }
    face
}

/// Stage 2: returns the face of the balances that have the least force among those of least adhesion.
///
/// `None` if the solver finds no balance with the same sum of adhesion for any of the margins.
fn least_force_face(
    whole: &Face,
    first: &Dual,
    margins: &[f64],
    unchanged: &impl Fn(&Face, &[f64]) -> bool,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Face> {
    margins.iter().find_map(|margin| {
        // Restrict to the optima of stage 1, minimise the force, and check that the adhesion is unchanged.
        let narrow = whole.optimal_face(first, *margin);
        let second = solve_stage(&narrow, size, settings, effort, |c| c.cost);
        if second.status != Status::Solved || !unchanged(&narrow, &second.amounts) {
            return None;
        }
        let narrower = narrow.optimal_face(&second, 1.0);
        Some(if unchanged(&narrower, &narrower.amounts) { narrower } else { narrow.with_amounts(second.amounts) })
    })
}

/// Solves the kinematic dual of stage 2 or 3.
///
/// With many blocks, a stage that ends without a result with plain conditioning also does so with full conditioning,
/// which takes two to four times as long. The stage is therefore not solved again; the caller keeps the result of the
/// previous stage.
fn solve_stage(
    face: &Face,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Dual {
    match size {
        Size::Few => dual(&face.loads, &face.columns, settings, effort, cost),
        Size::Many => {
            let (conic, row_of) = kinematic_dual(&face.loads, &face.columns, cost);
            let answer = solve_once(&conic, settings, effort);
            from_kinematic_answer(&face.loads, &face.columns, &conic, &row_of, &answer)
        }
    }
}

/// Stage 3: reduces the face to few points with adhesion. `None` if the program has many blocks and the
/// remaining columns cannot balance the loads.
fn concentrate(
    face: &Face,
    drop_tolerance: f64,
    unchanged: &impl Fn(&Face, &[f64]) -> bool,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Face> {
    let mut face = face.clone();
    let rounds = match size {
        Size::Few => MAX_ROUNDS,
        Size::Many => MAX_ROUNDS_MANY,
    };
    for _ in 0..rounds {
        if face.columns.iter().filter(|c| c.force.is_adhesion()).count() < 2 {
            break;
        }
        // Reweighting: the cost of a column is nearly proportional to 1/amount. It is at most about a thousand times
        // the cost of the column with the largest amount.
        let most = face.adhesion_amounts(&face.amounts).fold(0.0, f64::max);
        for (column, amount) in face.columns.iter_mut().zip(&face.amounts) {
            if column.force.is_adhesion() {
                column.cost = 1e-2 * most / (amount + 1e-3 * most);
            }
        }
        let solved = solve_stage(&face, size, settings, effort, |c| if c.force.is_adhesion() { c.cost } else { 0.0 });
        // If the dual is unbounded, these columns cannot balance the loads. The least-squares problem of stage 4 would
        // take ten times as long to show this.
        if size == Size::Many && solved.status == Status::Unbounded {
            return None;
        }
        if solved.status != Status::Solved || !unchanged(&face, &solved.amounts) {
            break;
        }
        face.amounts = solved.amounts;
        // Drop the points with little adhesion; stop if there are no such points.
        let most = face.adhesion_amounts(&face.amounts).fold(0.0, f64::max);
        let before = face.columns.len();
        face = face.restrict(|c, a| !c.force.is_adhesion() || a > drop_tolerance * most);
        if face.columns.len() == before {
            break;
        }
    }
    Some(face)
}
