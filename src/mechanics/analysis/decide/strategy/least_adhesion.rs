//! Least adhesion: the least that mortar or stronger robots would have to provide for a balance. The optimum is the physical
//! residual. It distinguishes 0 from almost 0 closer to the limit than a solver's status does.

use super::Attempt;
use crate::program::Program;
use crate::solve::{SolverSettings, least_adhesion_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    let adhesion = least_adhesion_in(program, settings);
    Attempt {
        forces: (adhesion.balanced == Some(true)).then(|| adhesion.forces.clone()),
        motion: adhesion.motion.clone(),
        effort: adhesion.effort,
        witness: None,
        adhesion: Some(adhesion),
    }
}
