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

use super::{
    Amounts, Care, Effort, Manner, Status, Twin, gathered, kept, largest, refined, tidy, twin,
};
use crate::program::{Column, Program, columns, sticking_columns};

/// Rounds of concentrating; the count of points rarely falls after the third.
const ROUNDS: usize = 4;

/// What would have to stick.
#[derive(Clone, Debug)]
pub struct Stuck {
    /// Whether some amount of sticking balances every block.
    pub balanced: bool,
    /// The admissible forces then.
    pub forces: Amounts,
    /// The sticking forces then.
    pub sticking: Amounts,
    /// A motion of the blocks along which the loads work and no contact objects: three velocities per block.
    pub motion: Option<Vec<f64>>,
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
    let first = twin(&program.need, &all, manner, &mut effort, |c| {
        if c.force.sticks() { 1.0 } else { 0.0 }
    });
    let motion = || Some(first.y.iter().map(|v| -v).collect());
    if first.status != Status::Solved {
        let motion = if first.status == Status::Unbounded {
            motion()
        } else {
            None
        };
        let none = Amounts::none(program);
        return Stuck {
            balanced: false,
            forces: none.clone(),
            sticking: none,
            motion,
            effort,
        };
    }
    let (mut face, mut amounts) = kept(&all, &first.amounts, &first.active(1.0));
    let least = sticking_sum(&face, &amounts);
    let unchanged = |columns: &[Column], amounts: &[f64]| {
        (sticking_sum(columns, amounts) - least).abs()
            <= 1e-6 * least + 1e-9 * largest(&program.need)
    };
    let second = twin(&program.need, &face, manner, &mut effort, |c| c.cost);
    if let Some(next) = narrowed(&face, &second, &unchanged) {
        (face, amounts) = next;
    }
    for _ in 0..ROUNDS {
        let points = face.iter().filter(|c| c.force.sticks()).count();
        if points < 2 {
            break;
        }
        let most = sticking_amounts(&face, &amounts).fold(0.0, f64::max);
        for (column, amount) in face
            .iter_mut()
            .zip(&amounts)
            .filter(|(c, _)| c.force.sticks())
        {
            column.cost = 1e-2 * most / (amount + 1e-3 * most);
        }
        let concentrated = twin(&program.need, &face, manner, &mut effort, |c| {
            if c.force.sticks() { c.cost } else { 0.0 }
        });
        if concentrated.status != Status::Solved || !unchanged(&face, &concentrated.amounts) {
            break;
        }
        amounts = concentrated.amounts;
        let most = sticking_amounts(&face, &amounts).fold(0.0, f64::max);
        let before = face.len();
        let active: Vec<bool> = face
            .iter()
            .zip(&amounts)
            .map(|(c, a)| !c.force.sticks() || *a > 1e-5 * most)
            .collect();
        (face, amounts) = kept(&face, &amounts, &active);
        if face.len() == before {
            break;
        }
    }
    let chosen = tidy(&program.need, &face, manner, &mut effort)
        .filter(|t| unchanged(&face, t))
        .unwrap_or(amounts);
    let chosen = match manner.care {
        Care::Quick => chosen,
        Care::Full => refined(&program.need, &face, chosen, &mut effort),
    };
    let (forces, sticking) = gathered(program, &face, &chosen);
    Stuck {
        balanced: true,
        forces,
        sticking,
        motion: motion(),
        effort,
    }
}

fn narrowed(
    face: &[Column],
    solved: &Twin,
    unchanged: &impl Fn(&[Column], &[f64]) -> bool,
) -> Option<(Vec<Column>, Vec<f64>)> {
    (solved.status == Status::Solved && unchanged(face, &solved.amounts))
        .then(|| kept(face, &solved.amounts, &solved.active(1.0)))
}

fn sticking_amounts<'a>(
    columns: &'a [Column],
    amounts: &'a [f64],
) -> impl Iterator<Item = f64> + 'a {
    columns
        .iter()
        .zip(amounts)
        .filter(|(c, _)| c.force.sticks())
        .map(|(_, a)| *a)
}

fn sticking_sum(columns: &[Column], amounts: &[f64]) -> f64 {
    sticking_amounts(columns, amounts).sum()
}
