//! Finds forces of least sum for joints that are parallel except for rounding, where the solver may fail.

use super::Component;
use super::strategy::Strategy;
use crate::program::Program;
use crate::proof::Proof;
use crate::solve::{Amounts, Choice, Effort, SolverSettings, rebalance_absolute};

/// Forces that balance, and what is known about their sum.
pub(super) struct LeastForce {
    pub amounts: Amounts,
    pub proof: Proof,
    /// The lower bound of the sum, as in `Decision`.
    pub force_bound: Option<f64>,
    pub least_force: bool,
}

impl Component<'_> {
    /// Returns forces with a smaller sum if there are any, otherwise the forces `found`. Computes the least forces with
    /// the nearly parallel joints made exactly parallel. Then changes these forces as little as possible, so that they
    /// balance with the real joints.
    pub(super) fn reduce_force_sum(
        &self,
        program: &Program,
        found: LeastForce,
        effort: &mut Effort,
    ) -> LeastForce {
        match self.least_force_with_parallel_joints(program, effort) {
            Some(least) if least.amounts.total() < found.amounts.total() => least,
            _ => found,
        }
    }

    fn least_force_with_parallel_joints(
        &self,
        program: &Program,
        effort: &mut Effort,
    ) -> Option<LeastForce> {
        let wanted = |s: &&SolverSettings| s.choice != Choice::Any;
        let settings = self.settings.iter().find(wanted)?;
        let straight = program.with_parallel_joints()?;
        let attempt = Strategy::Force(*settings).attempt(&straight);
        *effort = effort.plus(attempt.effort);
        let amounts = rebalance_absolute(program, attempt.forces.as_ref()?, effort)?;
        let proof = self.prove_forces(&amounts).proof;
        if !self.accepts(&proof) {
            return None;
        }
        let (force_bound, least_force) = self.bound_force_sum(attempt.witness.as_deref(), &amounts);
        Some(LeastForce {
            amounts,
            proof,
            force_bound,
            least_force,
        })
    }
}
