//! Least force: admissible forces of least sum that balance, or a motion that none can stop. One program answers nearly
//! every component, and its forces are those to be drawn.

use super::Attempt;
use crate::program::Program;
use crate::solve::{Balance, SolverSettings, balance_at_first_look, balance_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    of(balance_in(program, settings))
}

/// The same, stopped early: near the limit, where it may end without a status, other strategies decide sooner.
pub(super) fn first_look(program: &Program, settings: SolverSettings) -> Attempt {
    of(balance_at_first_look(program, settings))
}

fn of(solved: Balance) -> Attempt {
    Attempt {
        forces: solved.forces,
        motion: solved.motion,
        witness: solved.witness,
        adhesion: None,
        effort: solved.effort,
    }
}
