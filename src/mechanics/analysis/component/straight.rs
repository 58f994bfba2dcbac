//! Least forces of joints that are parallel but for rounding.

use super::Case;
use super::rung::Strategy;
use crate::program::Program;
use crate::proof::Proof;
use crate::solve::{Amounts, Choice, Effort, SolverSettings, corrected};

/// Forces that balance, with what was shown of their sum.
pub(super) struct Least {
    pub amounts: Amounts,
    pub proof: Proof,
    /// As in a decision.
    pub force_bound: Option<f64>,
    pub least_force: bool,
}

impl Case<'_> {
    /// Forces of a smaller sum than those found, where the program of least force ended without a status: the least ones with
    /// nearly parallel joints made parallel, changed least so that they balance as the joints are. Where any forces will do,
    /// those found stay.
    pub(super) fn smaller(&self, program: &Program, found: Least, effort: &mut Effort) -> Least {
        match self.least_with_straight_joints(program, effort) {
            Some(least) if least.amounts.total() < found.amounts.total() => least,
            _ => found,
        }
    }

    fn least_with_straight_joints(&self, program: &Program, effort: &mut Effort) -> Option<Least> {
        let wanted = |s: &&SolverSettings| s.choice != Choice::Any;
        let settings = self.settings.iter().find(wanted)?;
        let straight = program.with_parallel_joints()?;
        let attempt = Strategy::Force(*settings).attempt(&straight);
        *effort = effort.and(attempt.effort);
        let amounts = corrected(program, attempt.forces.as_ref()?, effort)?;
        let proof = self.carried(&amounts).proof;
        if !self.believes(&proof) {
            return None;
        }
        let (force_bound, least_force) = self.least_shown(attempt.witness.as_deref(), &amounts);
        Some(Least {
            amounts,
            proof,
            force_bound,
            least_force,
        })
    }
}
