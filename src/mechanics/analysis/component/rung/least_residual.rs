//! Any balance, whatever it costs, or a motion against all of them; then the least residual: the forces that leave least
//! unbalanced, and the motion of most power. Both have an answer on either side of the edge of standing, where the program of
//! least force may end without a status.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Effort, Residual, any_balance, least_residual};

pub(super) fn any(program: &Program) -> Attempt {
    of(Some(any_balance(program)))
}

pub(super) fn attempt(program: &Program) -> Attempt {
    of(least_residual(program))
}

fn of(solved: Option<Residual>) -> Attempt {
    match solved {
        Some(left) => Attempt {
            forces: left.nearest.then_some(left.forces),
            motion: Some(left.motion),
            witness: None,
            stuck: None,
            effort: left.effort,
        },
        None => Attempt {
            forces: None,
            motion: None,
            witness: None,
            stuck: None,
            effort: Effort::default(),
        },
    }
}
