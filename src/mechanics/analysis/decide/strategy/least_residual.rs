//! Two programs that have an optimum whether the component stands or falls. [`any`] finds some forces that balance the
//! loads, or a motion that excludes such forces. [`attempt`] finds the forces with the least imbalance and the motion
//! with the greatest power.

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
            forces: left.is_reliable.then_some(left.forces),
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
