//! Where forces have no choice: what gives way next to the ground, and what would have to stick, without a program.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Effort, tips};

pub(super) fn attempt(program: &Program) -> Attempt {
    let (motion, stuck) = tips(program).unzip();
    Attempt {
        forces: None,
        motion,
        witness: None,
        stuck,
        effort: Effort::default(),
    }
}
