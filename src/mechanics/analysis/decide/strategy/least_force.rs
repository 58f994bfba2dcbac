//! Program of least force: finds admissible forces of least sum that balance the loads, or a motion that no forces can
//! stop. It decides nearly every component, and figures show its forces.

use super::Attempt;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{Balance, SolverSettings, balance_at_first_look, balance_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    from_balance(balance_in(program, settings))
}

/// Solves the program of least force, but stops after a few iterations. Near the limit of stability, this program
/// converges slowly or ends without a result, and other programs decide sooner.
pub(super) fn first_look(program: &Program, settings: SolverSettings) -> Attempt {
    from_balance(balance_at_first_look(program, settings))
}

fn from_balance(balance: Balance) -> Attempt {
    Attempt {
        forces: balance.forces,
        motion: balance.motion,
        witness: balance.witness,
        least_adhesion: None,
        effort: balance.effort,
    }
}
