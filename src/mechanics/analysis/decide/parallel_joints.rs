//! Finds forces of least sum in two cases in which the solver may fail: joints that are parallel except for rounding,
//! and slight loads, which are far smaller than the others.

use super::Component;
use super::strategy::Strategy;
use crate::mechanics::program::Program;
use crate::mechanics::proof::Proof;
use crate::mechanics::solve::{Amounts, Choice, Effort, SolverSettings, rebalance_absolute};

/// Forces that balance every body, with their proof and a lower bound for the sum of any balancing forces.
pub(super) struct LeastForce {
    pub amounts: Amounts,
    pub proof: Proof,
    /// A proved lower bound for the sum of balancing forces, N; `None` if none was proved.
    pub force_bound: Option<f64>,
    /// Whether the forces are proved to have the least sum.
    pub least_force: bool,
}

impl Component<'_> {
    /// Returns balancing forces with a smaller sum if it finds any, otherwise the forces `found`.
    ///
    /// Computes the forces of least sum of two simpler programs: one with nearly parallel joints made exactly
    /// parallel, and one without slight loads. Then changes these forces as little as possible, so that they balance
    /// in the real program.
    pub(super) fn reduce_force_sum(&self, program: &Program, found: LeastForce, effort: &mut Effort) -> LeastForce {
        let simpler = [program.with_parallel_joints(), program.without_slight_loads()];
        let mut best = found;
        for simpler in simpler.into_iter().flatten() {
            match self.least_force_near(program, &simpler, effort) {
                Some(least) if least.amounts.total() < best.amounts.total() => best = least,
                _ => {}
            }
        }
        best
    }

    /// Returns the forces of least sum of the program `simpler`, changed to balance the loads of `program`. `None` if
    /// no such forces are found, or if their proof is too weak.
    fn least_force_near(&self, program: &Program, simpler: &Program, effort: &mut Effort) -> Option<LeastForce> {
        let wanted = |s: &&SolverSettings| s.choice != Choice::Any;
        let settings = self.settings.iter().find(wanted)?;
        let attempt = Strategy::Force(*settings).attempt(simpler);
        *effort = effort.plus(attempt.effort);
        let amounts = rebalance_absolute(program, attempt.forces.as_ref()?, effort)?;
        let proof = self.prove_forces(&amounts).proof;
        if !self.accepts(&proof) {
            return None;
        }
        let (force_bound, least_force) = self.bound_force_sum(attempt.witness.as_deref(), &amounts);
        Some(LeastForce { amounts, proof, force_bound, least_force })
    }
}
