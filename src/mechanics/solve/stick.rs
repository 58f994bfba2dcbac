//! The soft program, lexicographically: least sticking, then least force, then fewest failure points.
//!
//! This is the limit β → ∞ of [Vallat23](crate::doc::references) §2.0.8 without a large number in it. Each stage keeps
//! only the columns of the
//! face of optima of the stage before, so nothing is traded against it.
//!
//! Fewest points: an interior-point answer spreads ties over all tied places. Here each round makes sticking dear where
//! little of it is used (cost 1/amount), so that small amounts give way to large ones. The rule sees amounts only, not
//! the order of the file; a tie between mirror images stays a tie, and the figure of a mirrored scene is the mirrored
//! figure.

use super::level::refined_optimum;
use super::limit::columns_in;
use super::slanted::Slanted;
use super::{
    Amounts, Conditioning, CrossoverTolerance, Dual, Effort, Face, LeastAdhesion, SolverSettings,
    Status, determinate, dual, in_forces, largest, least_squares_amounts, of_velocities, once,
    refined, stick_levels,
};
use crate::program::{Column, Program, kinematic_dual, sticking_columns};

/// Rounds of concentrating; the count of points rarely falls after the third.
const ROUNDS: usize = 4;

/// Of many blocks one round has to do: in 120 walls of 200 to 2 000 bricks more rounds left out 1 to 3 places of 100, in one of them
/// 9, and a tenth of the time went into them.
const ROUNDS_OF_MANY: usize = 1;

/// What an admissible force costs beside a unit of sticking, 1/β: nothing, if the first stage can be solved so.
///
/// Where wedged blocks can press each other without end the first stage's velocities have no room to move in, and the
/// solver may end without a status. With a price they have.
const PRICES: [f64; 2] = [1e-6, 1e-4];

/// How little an amount may be, in parts of the largest, to be left out of the sticking. The finer value is for the case
/// that so little is needed after all, such as against a light load.
const LITTLE: [f64; 2] = [1e-5, 1e-9];

/// The same of many blocks. At 10⁻⁵ a column was missing in a wall of 4 128 bricks, which the least squares took 1.8 s to find
/// out; at 10⁻⁹ what the solver leaves is kept, and up to 40 of 100 places more.
const LITTLE_OF_MANY: [f64; 2] = [1e-6, 1e-9];

/// How large a program is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Size {
    /// Of a few blocks: posed with the loads as they are, every digit sought.
    Few,
    /// Of many: posed, and its optimum taken, as walls near their edge want it.
    Many,
}

impl Size {
    /// From so many blocks on there are many.
    const MANY_BLOCKS: usize = 200;

    fn new(program: &Program) -> Size {
        match program.blocks {
            0..Self::MANY_BLOCKS => Size::Few,
            _ => Size::Many,
        }
    }
}

/// Of many blocks the optimum of the first stage is kept where the columns in use have so much slack in all, in parts of what
/// sums of sticking may differ by. The sticking would grow by that slack if each carried the largest load. Of 46 walls of 200 to
/// 2 000 bricks the second stage had an answer that counts up to 0.11, and none from 0.96 on.
const SLACK_IN_USE: f64 = 0.5;

/// Of many blocks the first stage is solved more sharply. In a wall of 2 000 bricks turned by 40° the second stage had
/// no balance on the columns found without.
const FINER: CrossoverTolerance = CrossoverTolerance {
    tolerance_factor: 1e-2,
    max_slack: 1.2 * SLACK_IN_USE * SAME_OF_MANY,
    early_factor: 3.0,
};

/// A block is light whose load is less than this part of the largest.
const LIGHT: f64 = 1e-3;

/// Where the plain rule loses a column that is needed, more are let in.
const MARGINS: [f64; 3] = [1.0, 1e3, 1e6];

/// Sums of sticking that differ by less, relatively, count as the same.
const SAME: f64 = 3e-8;

/// The same of many blocks, where the solver tells the sum itself no better.
const SAME_OF_MANY: f64 = 3e-7;

/// Solves the soft program.
pub fn stick(program: &Program, conditioning: Conditioning) -> LeastAdhesion {
    stick_in(program, conditioning.into())
}

/// Solves it with given settings.
///
/// Of many blocks it is posed with a largest load of 1. With loads of 300 a wall of 410 bricks just past its edge ends
/// without a status, six times after a hundred iterations; with loads of 1 it is solved in 69.
pub fn stick_in(program: &Program, settings: SolverSettings) -> LeastAdhesion {
    determinate::least_sticking(program).unwrap_or_else(|| by_programs(program, settings))
}

/// Solves it whatever contacts there are.
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
    let (first, priced) = least_sticking(&whole, size, settings, &mut effort);
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
    let precise = stick_levels::wanted(&whole.loads, least).and_then(|wanted| {
        let (loads, columns) = (&whole.loads, &whole.columns);
        let cost = |c: &Column| f64::from(u8::from(c.force.is_sticking()));
        let found = refined_optimum(loads, columns, cost, &first, wanted, &mut effort)?;
        Some((found, wanted))
    });
    let mut motion = motion;
    let mut face = match &precise {
        Some((first, wanted)) => {
            motion = Some(first.y.iter().map(|v| -v).collect());
            stick_levels::chosen(&whole, first, *wanted, settings, &mut effort)
        }
        None => chosen(&whole, &first, size, settings, &mut effort),
    };
    if settings.conditioning == Conditioning::Full && precise.is_none() {
        face.amounts = refined(&face.loads, &face.columns, face.amounts, &mut effort);
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

/// The first stage: the least sticking, and whether admissible forces had to be priced for it.
fn least_sticking(
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
        Size::Many => without_middles(whole, settings, effort),
        Size::Few => priced(0.0, effort),
    };
    let mut dear = false;
    for price in PRICES {
        if last.status != Status::Unsolved {
            break;
        }
        last = priced(price, effort);
        dear = true;
    }
    (last, dear)
}

/// How sharply the first stage is solved. What a light block lacks comes last: there it is not ended before.
fn finer(loads: &[f64]) -> CrossoverTolerance {
    let bodies = loads
        .chunks_exact(3)
        .map(|load| libm::hypot(load[0], load[1]));
    let lightest = bodies
        .filter(|load| *load > 0.0)
        .fold(f64::INFINITY, f64::min);
    CrossoverTolerance {
        early_factor: if lightest < LIGHT * largest(loads) {
            0.0
        } else {
            FINER.early_factor
        },
        ..FINER
    }
}

/// The least sticking where forces have no price.
fn without_middles(whole: &Face, settings: SolverSettings, effort: &mut Effort) -> Dual {
    let slanted = Slanted::new(&whole.columns);
    let cost = |c: &Column| f64::from(u8::from(c.force.is_sticking()));
    let (conic, row_of) = kinematic_dual(&whole.loads, &slanted.columns, cost);
    let finer = SolverSettings {
        crossover: Some(finer(&whole.loads)),
        ..settings
    };
    let answer = once(&conic, finer, effort);
    let mut solved = of_velocities(&whole.loads, &slanted.columns, &conic, &row_of, &answer);
    if solved.status == Status::Unsolved {
        solved = in_forces(&whole.loads, &slanted.columns, settings, effort, cost);
    }
    slanted.in_all_columns(&whole.columns, solved)
}

/// Among all balances of least sticking the one that is shown: of least force, then with fewest points that stick.
///
/// Near the edge of standing of many blocks the columns of the optimum cannot be distinguished from the others, and the least force
/// falls by a tenth while the sticking grows by a millionth. There the balance of the first stage is kept: its sticking is
/// the least, its force is not.
fn chosen(
    whole: &Face,
    first: &Dual,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Face {
    let least = sticking_sum(whole, &first.amounts);
    let (same, margins) = match size {
        Size::Many => (SAME_OF_MANY, &MARGINS[..1]),
        Size::Few => (SAME, &MARGINS[..]),
    };
    let slight = 1e-9 * largest(&whole.loads);
    let unchanged = |face: &Face, amounts: &[f64]| {
        (sticking_sum(face, amounts) - least).abs() <= same * least + slight
    };
    let found = || whole.clone().with(first.amounts.clone());
    let in_use = first.slack.iter().zip(first.active(1.0));
    let slack: f64 = in_use
        .filter(|(_, active)| *active)
        .map(|(slack, _)| slack)
        .sum();
    if size == Size::Many && slack > SLACK_IN_USE * (same * least + slight) {
        return found();
    }
    let mut face = None;
    for margin in margins {
        let narrow = whole.narrowed(first, *margin);
        let second = later(&narrow, size, settings, effort, |c| c.cost);
        if second.status == Status::Solved && unchanged(&narrow, &second.amounts) {
            let narrower = narrow.narrowed(&second, 1.0);
            face = Some(if unchanged(&narrower, &narrower.amounts) {
                narrower
            } else {
                narrow.with(second.amounts)
            });
            break;
        }
    }
    let face = match face {
        Some(face) => face,
        None if size == Size::Many => return found(),
        None => found(),
    };
    // Of many blocks few columns are left, hardly more than balance leaves no choice: plain conditioning ends without a
    // status there.
    let squares = match size {
        Size::Many => SolverSettings {
            conditioning: Conditioning::Full,
            ..settings
        },
        Size::Few => settings,
    };
    let littles = match size {
        Size::Few => LITTLE,
        Size::Many => LITTLE_OF_MANY,
    };
    for little in littles {
        let Some(few) = concentrated(&face, little, &unchanged, size, settings, effort) else {
            continue;
        };
        let amounts = least_squares_amounts(&few.loads, &few.columns, squares, effort);
        if let Some(amounts) = amounts.filter(|amounts| unchanged(&few, amounts)) {
            return few.with(amounts);
        }
    }
    face
}

/// Solves the dual of a later stage.
///
/// Of many blocks what ends without a status does so with full conditioning too, after two to four times as long, and what the stage
/// before found is shown.
fn later(
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

/// The face with few points that stick, by making little sticking dear, round by round; `None` where the columns of many
/// blocks turn out to have no balance.
fn concentrated(
    face: &Face,
    little: f64,
    unchanged: &impl Fn(&Face, &[f64]) -> bool,
    size: Size,
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Face> {
    let mut face = face.clone();
    let rounds = match size {
        Size::Few => ROUNDS,
        Size::Many => ROUNDS_OF_MANY,
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
        let most = sticking_amounts(&face, &face.amounts).fold(0.0, f64::max);
        for (column, amount) in face.columns.iter_mut().zip(&face.amounts) {
            if column.force.is_sticking() {
                column.cost = 1e-2 * most / (amount + 1e-3 * most);
            }
        }
        let solved = later(&face, size, settings, effort, |c| {
            if c.force.is_sticking() { c.cost } else { 0.0 }
        });
        // The least squares would take ten times as long to find it out.
        if size == Size::Many && solved.status == Status::Unbounded {
            return None;
        }
        if solved.status != Status::Solved || !unchanged(&face, &solved.amounts) {
            break;
        }
        face.amounts = solved.amounts;
        let most = sticking_amounts(&face, &face.amounts).fold(0.0, f64::max);
        let before = face.columns.len();
        face = face.only(|c, a| !c.force.is_sticking() || a > little * most);
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
