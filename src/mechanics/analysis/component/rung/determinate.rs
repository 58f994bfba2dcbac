//! What is statically determinate: the mechanism, and what would have to stick, without a program.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Effort, collapse};

pub(super) fn attempt(program: &Program) -> Attempt {
    let (motion, stuck) = collapse(program).unzip();
    Attempt {
        forces: None,
        motion,
        witness: None,
        stuck,
        effort: Effort::default(),
    }
}
