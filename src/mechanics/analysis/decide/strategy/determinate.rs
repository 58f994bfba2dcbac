//! Decides statically determinate components: computes the mechanism and the missing adhesion without a program.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Effort, collapse};

pub(super) fn attempt(program: &Program) -> Attempt {
    let (motion, least_adhesion) = collapse(program).unzip();
    Attempt {
        forces: None,
        motion,
        witness: None,
        least_adhesion,
        effort: Effort::default(),
    }
}
