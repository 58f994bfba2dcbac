//! Least residual: the forces that leave least unbalanced, and the motion of most power. It has an optimum on either side
//! of the edge of standing, where the program of least force may end without a status.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Effort, least_residual};

pub(super) fn attempt(program: &Program) -> Attempt {
    match least_residual(program) {
        Some(left) => Attempt {
            forces: Some(left.forces),
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
