//! Least sticking: the least that a mortar, or stronger robots, would have to give for a balance. Its optimum is the
//! physical residual, which tells 0 from next to nothing nearer to the edge than a solver's status does.

use super::Attempt;
use crate::program::Program;
use crate::solve::{SolverSettings, stick_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    let stuck = stick_in(program, settings);
    Attempt {
        forces: (stuck.balanced == Some(true)).then(|| stuck.forces.clone()),
        motion: stuck.motion.clone(),
        effort: stuck.effort,
        witness: None,
        stuck: Some(stuck),
    }
}
