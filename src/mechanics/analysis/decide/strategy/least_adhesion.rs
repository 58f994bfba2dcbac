//! Least adhesion: the smallest forces by which contacts or robots would have to exceed their limits. The optimum is
//! the physical residual. Near the limit, it distinguishes zero from almost zero better than the status of a solver
//! does.

use super::Attempt;
use crate::program::Program;
use crate::solve::{SolverSettings, least_adhesion_in};

pub(super) fn attempt(program: &Program, settings: SolverSettings) -> Attempt {
    let least_adhesion = least_adhesion_in(program, settings);
    Attempt {
        forces: (least_adhesion.balanced == Some(true)).then(|| least_adhesion.forces.clone()),
        motion: least_adhesion.motion.clone(),
        effort: least_adhesion.effort,
        witness: None,
        least_adhesion: Some(least_adhesion),
    }
}
