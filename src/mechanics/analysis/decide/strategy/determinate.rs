//! Decides a statically determinate component that falls: computes its mechanism and its missing adhesion without a
//! linear program.

use super::Attempt;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{Effort, collapse};

pub(super) fn attempt(program: &Program) -> Attempt {
    let (motion, least_adhesion) = collapse(program).unzip();
    Attempt { forces: None, motion, witness: None, least_adhesion, effort: Effort::default() }
}
