//! Two programs that have an optimum whether the component stands or falls. [`attempt_any_balance`] finds some forces
//! that balance the loads, or a motion that excludes such forces. [`attempt`] finds the forces with the least imbalance
//! and the motion with the greatest power.

use super::Attempt;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{Effort, Residual, any_balance, least_residual};

pub(super) fn attempt_any_balance(program: &Program) -> Attempt {
    from_residual(Some(any_balance(program)))
}

pub(super) fn attempt(program: &Program) -> Attempt {
    from_residual(least_residual(program))
}

fn from_residual(residual: Option<Residual>) -> Attempt {
    match residual {
        Some(residual) => Attempt {
            forces: residual.is_reliable.then_some(residual.forces),
            motion: Some(residual.motion),
            witness: None,
            least_adhesion: None,
            effort: residual.effort,
        },
        None => Attempt { forces: None, motion: None, witness: None, least_adhesion: None, effort: Effort::default() },
    }
}
