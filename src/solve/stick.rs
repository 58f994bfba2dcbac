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

use super::{Amounts, Care, Effort, Face, Manner, Status, largest, refined, tidy, twin};
use crate::program::{Program, columns, sticking_columns};

/// Rounds of concentrating; the count of points rarely falls after the third.
const ROUNDS: usize = 4;

/// What an admissible force costs beside a unit of sticking, 1/β: nothing, if the first stage can be solved so.
///
/// Where wedged blocks can press each other without end the first stage's velocities have no room to move in, and the
/// solver may end nowhere. With a price they have.
const PRICES: [f64; 3] = [0.0, 1e-6, 1e-4];

/// How little an amount may be, in parts of the largest, to be left out of the sticking. The finer value is for the case
/// that so little is needed after all, such as against a light load.
const LITTLE: [f64; 2] = [1e-5, 1e-9];

/// What would have to stick.
#[derive(Clone, Debug)]
pub struct Stuck {
    /// Whether some amount of sticking balances every block: `None` where the solver could not tell.
    pub balanced: Option<bool>,
    /// The admissible forces then.
    pub forces: Amounts,
    /// The sticking forces then.
    pub sticking: Amounts,
    /// A motion of the blocks along which the loads work and no contact objects: three velocities per block.
    pub motion: Option<Vec<f64>>,
    /// Whether admissible forces had a price, so that the motion may trespass a little against contacts.
    pub priced: bool,
    /// The work it took.
    pub effort: Effort,
}

/// Solves the soft program.
pub fn stick(program: &Program, care: Care) -> Stuck {
    stick_in(program, care.into())
}

/// Solves it in a manner of one's own.
pub fn stick_in(program: &Program, manner: Manner) -> Stuck {
    let mut effort = Effort::default();
    let mut all = columns(program);
    all.extend(sticking_columns(program));
    let whole = Face::whole(&program.need, all);
    let mut first = Status::Unclear;
    let mut solved = None;
    let mut priced = false;
    for price in PRICES {
        priced = price > 0.0;
        let tried = twin(&whole.need, &whole.columns, manner, &mut effort, |c| {
            if c.force.sticks() {
                1.0
            } else {
                price * c.cost
            }
        });
        first = tried.status;
        solved = Some(tried);
        if first != Status::Unclear {
            break;
        }
    }
    let motion = |y: &[f64]| Some(y.iter().map(|v| -v).collect());
    let first = match solved {
        Some(solved) if first == Status::Solved => solved,
        other => {
            let none = Amounts::none(program);
            let fallen = other.filter(|_| first == Status::Unbounded);
            return Stuck {
                balanced: fallen.is_some().then_some(false),
                forces: none.clone(),
                sticking: none,
                motion: fallen.and_then(|solved| motion(&solved.y)),
                priced,
                effort,
            };
        }
    };
    let least = sticking_sum(&whole, &first.amounts);
    let unchanged = |face: &Face, amounts: &[f64]| {
        (sticking_sum(face, amounts) - least).abs() <= 3e-8 * least + 1e-9 * largest(&program.need)
    };
    // Where the plain rule loses a column that is needed, more are let in.
    let mut face = whole.clone().with(first.amounts.clone());
    for margin in [1.0, 1e3, 1e6] {
        let narrow = whole.narrowed(&first, margin);
        let second = twin(&narrow.need, &narrow.columns, manner, &mut effort, |c| {
            c.cost
        });
        if second.status == Status::Solved && unchanged(&narrow, &second.amounts) {
            let narrower = narrow.narrowed(&second, 1.0);
            face = if unchanged(&narrower, &narrower.amounts) {
                narrower
            } else {
                narrow.with(second.amounts)
            };
            break;
        }
    }
    let mut chosen = None;
    for little in LITTLE {
        let few = concentrated(&face, little, &unchanged, manner, &mut effort);
        chosen = tidy(&few.need, &few.columns, manner, &mut effort)
            .filter(|amounts| unchanged(&few, amounts))
            .map(|amounts| few.with(amounts));
        if chosen.is_some() {
            break;
        }
    }
    let mut face = chosen.unwrap_or(face);
    if manner.care == Care::Full {
        face.amounts = refined(&face.need, &face.columns, face.amounts, &mut effort);
    }
    let (forces, sticking) = face.gathered(program);
    Stuck {
        balanced: Some(true),
        forces,
        sticking,
        motion: motion(&first.y),
        priced,
        effort,
    }
}

/// The face with few points that stick, by making little sticking dear, round by round.
fn concentrated(
    face: &Face,
    little: f64,
    unchanged: &impl Fn(&Face, &[f64]) -> bool,
    manner: Manner,
    effort: &mut Effort,
) -> Face {
    let mut face = face.clone();
    for _ in 0..ROUNDS {
        if face.columns.iter().filter(|c| c.force.sticks()).count() < 2 {
            break;
        }
        let most = sticking_amounts(&face, &face.amounts).fold(0.0, f64::max);
        for (column, amount) in face.columns.iter_mut().zip(&face.amounts) {
            if column.force.sticks() {
                column.cost = 1e-2 * most / (amount + 1e-3 * most);
            }
        }
        let solved = twin(&face.need, &face.columns, manner, effort, |c| {
            if c.force.sticks() { c.cost } else { 0.0 }
        });
        if solved.status != Status::Solved || !unchanged(&face, &solved.amounts) {
            break;
        }
        face.amounts = solved.amounts;
        let most = sticking_amounts(&face, &face.amounts).fold(0.0, f64::max);
        let before = face.columns.len();
        face = face.only(|c, a| !c.force.sticks() || a > little * most);
        if face.columns.len() == before {
            break;
        }
    }
    face
}

fn sticking_amounts<'a>(face: &'a Face, amounts: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    face.columns
        .iter()
        .zip(amounts)
        .filter(|(c, _)| c.force.sticks())
        .map(|(_, a)| *a)
}

fn sticking_sum(face: &Face, amounts: &[f64]) -> f64 {
    sticking_amounts(face, amounts).sum()
}
