//! Two programs: [`any`] finds some forces that balance the loads, or a motion that proves that no forces do.
//! [`attempt`] finds the forces with the least imbalance and the motion with the greatest power. Both programs have an
//! optimum on both sides of the limit, where the program of least force may end without a status.

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
            least_adhesion: None,
            effort: left.effort,
        },
        None => Attempt {
            forces: None,
            motion: None,
            witness: None,
            least_adhesion: None,
            effort: Effort::default(),
        },
    }
}
