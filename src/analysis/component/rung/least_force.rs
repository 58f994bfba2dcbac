//! Least force: admissible forces of least sum that balance, or a motion that none can stop. One program answers nearly
//! every component, and its forces are those to be drawn.

use super::Attempt;
use crate::program::Program;
use crate::solve::{SolverSettings, balance_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    let solved = balance_in(program, settings);
    Attempt {
        forces: solved.forces,
        motion: solved.motion,
        witness: solved.witness,
        stuck: None,
        effort: solved.effort,
    }
}
