//! Program of least adhesion: minimises the sum of the forces by which contacts or robots exceed their limits. Near the
//! limit of stability, this sum shows more reliably than the solver's status whether the component stands.

use super::Attempt;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{SolverSettings, least_adhesion_in};

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
