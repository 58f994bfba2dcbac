//! The program of least adhesion, lexicographically: least adhesion, then least force, then fewest points that stick.
//!
//! The limit β → ∞ of [Vallat23](crate::doc::references) §2.0.8, without a large number. Each stage keeps only the columns on the
//! face of optima of the stage before, so nothing is traded against it. Stages:
//!
//! 1. least Σ sticking, where admissible forces cost nothing;
//! 2. least Σ force, on the face of stage 1;
//! 3. fewest points: an interior-point method spreads ties over all tied places, so each round makes sticking dear where
//!    little of it is used (reweighted ℓ₁, Candès, Wakin and Boyd 2008). The cost depends on amounts only, not on the order
//!    of the file: a tie between mirror images stays a tie, and the figure of a mirrored scene is the mirrored figure;
//! 4. least Σ force² on what is left, which is unique.

use super::level::refined_optimum;
use super::limit::columns_in;
use super::slanted::Slanted;
use super::{
    Amounts, Conditioning, CrossoverTolerance, Dual, Effort, Face, LeastAdhesion, SolverSettings,
    Status, TOLERANCE, determinate, dual, in_forces, largest, least_adhesion_levels,
    least_squares_amounts, of_velocities, once, refine_balance,
};
use crate::program::{Column, Program, kinematic_dual, sticking_columns};

/// Rounds of stage 3. The number of points rarely falls after the third.
const MAX_ROUNDS: usize = 4;

/// As [`MAX_ROUNDS`], with many blocks. In 120 walls of 200 to 2 000 bricks more rounds dropped 1 to 3 points in 100, in one wall
/// 9, and took a tenth of the time.
const MAX_ROUNDS_MANY: usize = 1;

/// Costs 1/β of admissible forces relative to sticking, tried one after the other if stage 1 ends without a status at cost 0.
///
/// If wedged blocks can press each other without limit, the dual of stage 1 has no interior, and the solver may end without a
/// status. With a cost it has one.
const FORCE_COSTS: [f64; 2] = [1e-6, 1e-4];

/// Sticking at a point below this fraction of the largest is dropped in stage 3. The second value is tried if the first drops
/// too much, such as sticking against a light load.
const DROP_TOL: [f64; 2] = [1e-5, 1e-9];

/// As [`DROP_TOL`], with many blocks. At 10⁻⁵ a column was missing in a wall of 4 128 bricks, which the least squares took 1.8 s
/// to find out. At 10⁻⁹ rounding of the solver is kept, with up to 40 more points in 100.
const DROP_TOL_MANY: [f64; 2] = [1e-6, 1e-9];

/// How a program is stated and solved, by its number of blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Size {
    /// Few blocks: loads as they are, and all digits of the optimum.
    Few,
    /// Many blocks: a largest load of 1, and tolerances that walls near their limit can meet.
    Many,
}

impl Size {
    /// The number of blocks from which on there are many.
    const MANY_BLOCKS: usize = 200;

    fn new(program: &Program) -> Size {
        match program.blocks {
            0..Self::MANY_BLOCKS => Size::Few,
            _ => Size::Many,
        }
    }
}

/// With many blocks, stages 2 to 4 are skipped if the sum of the basic columns' slacks exceeds this multiple of what sums of
/// sticking may differ by. The sticking would grow by that slack if each carried the largest load. For 46 walls of 200
/// to 2 000 bricks stage 2 had a valid answer up to 0.11, and none from 0.96 on.
const MAX_BASIC_SLACK: f64 = 0.5;

/// With many blocks, stage 1 is solved to a finer tolerance. Without that, in a wall of 2 000 bricks turned by 40°, stage 2 had no
/// balance on the columns found.
const CROSSOVER: CrossoverTolerance = CrossoverTolerance {
    tolerance_factor: 1e-2,
    max_slack: 1.2 * MAX_BASIC_SLACK * SUM_TOL_MANY,
    early_factor: 3.0,
};

/// A block whose load is below this fraction of the largest is light.
const LIGHT_LOAD: f64 = 1e-3;

/// Margins of [`Dual::active`], tried one after the other: if the plain rule loses a column that is needed, larger ones keep it.
const MARGINS: [f64; 3] = [1.0, 1e3, 1e6];

/// Sums of sticking that differ by less than this fraction are equal: the solver's tolerance of 1e-9, on sums of some tens of
/// terms.
const SUM_TOL: f64 = 3e-8;

/// As [`SUM_TOL`], with many blocks, where the solver's own sum has no more digits.
const SUM_TOL_MANY: f64 = 3e-7;

/// Solves the program of least adhesion.
pub fn least_adhesion(program: &Program, conditioning: Conditioning) -> LeastAdhesion {
    least_adhesion_in(program, conditioning.into())
}

/// Solves the program of least adhesion with given settings.
///
/// With many blocks it is scaled to a largest load of 1. With loads of 300 a wall of 410 bricks just past its limit ends without
/// a status, six times after a hundred iterations; with loads of 1 it is solved in 69.
pub fn least_adhesion_in(program: &Program, settings: SolverSettings) -> LeastAdhesion {
    determinate::least_adhesion(program).unwrap_or_else(|| by_programs(program, settings))
}

/// As [`least_adhesion_in`], without the closed form.
pub(super) fn by_programs(program: &Program, settings: SolverSettings) -> LeastAdhesion {
    let mut effort = Effort::default();
    let size = Size::new(program);
    let load = match largest(&program.loads) {
        load if size == Size::Many && load > 0.0 => load,
        _ => 1.0,
    };
    let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
    let mut all = columns_in(program, load);
    all.extend(sticking_columns(program));
    let whole = Face::whole(&loads, all);
    let (first, priced) = first_stage(&whole, size, settings, &mut effort);
    let motion = Some(first.y.iter().map(|v| -v).collect());
    if first.status != Status::Solved {
        let none = Amounts::none(program);
        let fallen = first.status == Status::Unbounded;
        return LeastAdhesion {
            balanced: fallen.then_some(false),
            forces: none.clone(),
            sticking: none,
            motion: motion.filter(|_| fallen),
            priced,
            effort,
        };
    }
    let least = sticking_sum(&whole, &first.amounts);
    let precise = least_adhesion_levels::wanted(&whole.loads, least).and_then(|wanted| {
        let (loads, columns) = (&whole.loads, &whole.columns);
        let cost = |c: &Column| f64::from(u8::from(c.force.is_sticking()));
        let found = refined_optimum(loads, columns, cost, &first, wanted, &mut effort)?;
        Some((found, wanted))
    });
    let mut motion = motion;
    let mut face = match &precise {
        Some((first, wanted)) => {
            motion = Some(first.y.iter().map(|v| -v).collect());
            least_adhesion_levels::chosen(&whole, first, *wanted, settings, &mut effort)
        }
        None => later_stages(&whole, &first, size, settings, &mut effort),
    };
    if settings.conditioning == Conditioning::Full && precise.is_none() {
        face.amounts = refine_balance(&face.loads, &face.columns, face.amounts, &mut effort);
    }
    let (mut forces, mut sticking) = face.gathered(program);
    forces.multiply(load);
    sticking.multiply(load);
    LeastAdhesion {
        balanced: Some(true),
        forces,
        sticking,
        motion,
        priced,
        effort,
    }
}

/// Stage 1. Returns the optimum, and whether admissible forces had a cost.
fn first_stage(
    whole: &Face,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
) -> (Dual, bool) {
    let priced = |price: f64, effort: &mut Effort| {
        dual(&whole.loads, &whole.columns, settings, effort, |c| {
            if c.force.is_sticking() {
                1.0
            } else {
                price * c.cost
            }
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

/// When stage 1 stops. The sticking of a light block converges last: with such blocks it does not stop early.
fn crossover(loads: &[f64]) -> CrossoverTolerance {
    let bodies = loads
        .chunks_exact(3)
        .map(|load| libm::hypot(load[0], load[1]));
    let lightest = bodies
        .filter(|load| *load > 0.0)
        .fold(f64::INFINITY, f64::min);
    CrossoverTolerance {
        early_factor: if lightest < LIGHT_LOAD * largest(loads) {
            0.0
        } else {
            CROSSOVER.early_factor
        },
        ..CROSSOVER
    }
}

/// Stage 1 without redundant columns; if the kinematic form has no status, in forces.
fn first_stage_of_many(whole: &Face, settings: SolverSettings, effort: &mut Effort) -> Dual {
    let slanted = Slanted::new(&whole.columns);
    let cost = |c: &Column| f64::from(u8::from(c.force.is_sticking()));
    let (conic, row_of) = kinematic_dual(&whole.loads, &slanted.columns, cost);
    let finer = SolverSettings {
        crossover: Some(crossover(&whole.loads)),
        ..settings
    };
    let answer = once(&conic, finer, effort);
    let mut solved = of_velocities(&whole.loads, &slanted.columns, &conic, &row_of, &answer);
    if solved.status == Status::Unsolved {
        solved = in_forces(&whole.loads, &slanted.columns, settings, effort, cost);
    }
    slanted.in_all_columns(&whole.columns, solved)
}

/// Stages 2 to 4: among all balances of least adhesion the one that is shown.
///
/// Near the limit of standing of many blocks, the basic columns of the optimum cannot be told from the others, and the least
/// force falls by a tenth while the sticking grows by a millionth. Then the balance of stage 1 is kept: its sticking is
/// the least, its force is not.
fn later_stages(
    whole: &Face,
    first: &Dual,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Face {
    let least = sticking_sum(whole, &first.amounts);
    let (same, margins) = match size {
        Size::Many => (SUM_TOL_MANY, &MARGINS[..1]),
        Size::Few => (SUM_TOL, &MARGINS[..]),
    };
    // Sums below the solver's tolerance are all the same.
    let slight = TOLERANCE * largest(&whole.loads);
    let unchanged = |face: &Face, amounts: &[f64]| {
        (sticking_sum(face, amounts) - least).abs() <= same * least + slight
    };
    let from_first_stage = || whole.clone().with(first.amounts.clone());
    let in_use = first.slack.iter().zip(first.active(1.0));
    let slack: f64 = in_use
        .filter(|(_, active)| *active)
        .map(|(slack, _)| slack)
        .sum();
    if size == Size::Many && slack > MAX_BASIC_SLACK * (same * least + slight) {
        return from_first_stage();
    }
    let Some(face) = least_force_face(whole, first, margins, &unchanged, size, settings, effort)
        .or_else(|| (size == Size::Few).then(from_first_stage))
    else {
        return from_first_stage();
    };
    // Stages 3 and 4. With many blocks few columns are left, hardly more than a unique balance has. Plain conditioning ends there without a
    // status.
    let squares = match size {
        Size::Many => SolverSettings {
            conditioning: Conditioning::Full,
            ..settings
        },
        Size::Few => settings,
    };
    let drop_tolerances = match size {
        Size::Few => DROP_TOL,
        Size::Many => DROP_TOL_MANY,
    };
    for drop_tolerance in drop_tolerances {
        let Some(few) = concentrate(&face, drop_tolerance, &unchanged, size, settings, effort)
        else {
            continue;
        };
        let amounts = least_squares_amounts(&few.loads, &few.columns, squares, effort);
        if let Some(amounts) = amounts.filter(|amounts| unchanged(&few, amounts)) {
            return few.with(amounts);
        }
    }
    face
}

/// Stage 2: the face of least force among balances of least adhesion; `None` if no margin gives one with the same adhesion.
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
        let narrow = whole.narrowed(first, *margin);
        let second = solve_stage(&narrow, size, settings, effort, |c| c.cost);
        if second.status != Status::Solved || !unchanged(&narrow, &second.amounts) {
            return None;
        }
        let narrower = narrow.narrowed(&second, 1.0);
        Some(if unchanged(&narrower, &narrower.amounts) {
            narrower
        } else {
            narrow.with(second.amounts)
        })
    })
}

/// Solves the dual of a later stage.
///
/// With many blocks, a stage that ends without a status does so with full conditioning too, after two to four times as long.
/// So it is not tried again; the result of the former stage is shown.
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
            let answer = once(&conic, settings, effort);
            of_velocities(&face.loads, &face.columns, &conic, &row_of, &answer)
        }
    }
}

/// Stage 3: the face with few points that stick. `None` if the columns of many blocks turn out to have no balance.
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
        if face
            .columns
            .iter()
            .filter(|c| c.force.is_sticking())
            .count()
            < 2
        {
            break;
        }
        // Cost 1/amount, limited to a thousand times that of the largest amount.
        let most = sticking_amounts(&face, &face.amounts).fold(0.0, f64::max);
        for (column, amount) in face.columns.iter_mut().zip(&face.amounts) {
            if column.force.is_sticking() {
                column.cost = 1e-2 * most / (amount + 1e-3 * most);
            }
        }
        let solved = solve_stage(&face, size, settings, effort, |c| {
            if c.force.is_sticking() { c.cost } else { 0.0 }
        });
        // The least squares would take ten times as long to find that out.
        if size == Size::Many && solved.status == Status::Unbounded {
            return None;
        }
        if solved.status != Status::Solved || !unchanged(&face, &solved.amounts) {
            break;
        }
        face.amounts = solved.amounts;
        // Drop what has become small; stop when nothing does.
        let most = sticking_amounts(&face, &face.amounts).fold(0.0, f64::max);
        let before = face.columns.len();
        face = face.only(|c, a| !c.force.is_sticking() || a > drop_tolerance * most);
        if face.columns.len() == before {
            break;
        }
    }
    Some(face)
}

fn sticking_amounts<'a>(face: &'a Face, amounts: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    face.columns
        .iter()
        .zip(amounts)
        .filter(|(c, _)| c.force.is_sticking())
        .map(|(_, a)| *a)
}

fn sticking_sum(face: &Face, amounts: &[f64]) -> f64 {
    sticking_amounts(face, amounts).sum()
}
