//! Least force: admissible forces of least sum that balance the loads, or a motion that no forces can stop. This one
//! program decides nearly every component, and figures show its forces.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Balance, SolverSettings, balance_at_first_look, balance_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    of(balance_in(program, settings))
}

/// Like [`attempt`], but with few iterations. Near the limit the program converges slowly or ends without a status,
/// and other strategies decide sooner.
pub(super) fn first_look(program: &Program, settings: SolverSettings) -> Attempt {
    of(balance_at_first_look(program, settings))
}

fn of(solved: Balance) -> Attempt {
    Attempt {
        forces: solved.forces,
        motion: solved.motion,
        witness: solved.witness,
        least_adhesion: None,
        effort: solved.effort,
    }
}
