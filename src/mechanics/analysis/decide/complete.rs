//! Route 4: adds the remaining results after the verdict. These are the forces of least sum if the structure stands, or
//! its failures and its mechanism if it falls.

use super::Component;
use super::Method;
use super::parallel_joints::LeastForce;
use super::programs::Decision;
use super::rebalance::RebalanceOutcome;
use super::strategy::LARGE_PROGRAM_BLOCKS;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{Choice, balance_in, is_late, least_adhesion_in};

impl Component<'_> {
    /// Adds forces of least sum (stable) or failures (unstable) to a decision. Returns the decision unchanged if only
    /// the verdict is requested.
    pub fn complete(&self, program: &Program, decision: Decision) -> Decision {
        if !self.complete_result {
            return decision;
        }
        match decision.verdict {
            Verdict::Stable if !decision.least_force => self.with_least_force(program, decision),
            Verdict::Unstable if !decision.only_some_fall => self.with_failures(program, decision),
            // The decision covers only some falling bodies. If the other bodies may move too, less adhesion may be
            // enough for the whole component.
            Verdict::Unstable if program.blocks < LARGE_PROGRAM_BLOCKS => {
                self.with_failures_of_the_whole(program, decision)
            }
            _ => decision,
        }
    }

    /// Replaces the forces of a decision by balancing forces of least sum, if a solution is accurate enough to prove
    /// that they are least. Otherwise tries to find balancing forces with a smaller sum.
    fn with_least_force(&self, program: &Program, mut decision: Decision) -> Decision {
        // Do not solve the program of least force if it ended without a result before, or if any balancing forces are
        // enough.
        if decision.least_force_failed || self.settings.iter().any(|s| s.choice == Choice::Any) {
            return decision;
        }
        // The first solver settings were tried before, so they are skipped. Exception: if a large component was decided
        // by least residual, they were not tried to the end.
        let skipped = usize::from(program.blocks < LARGE_PROGRAM_BLOCKS || decision.method != Method::LeastResidual);
        for settings in self.settings.iter().skip(skipped) {
            if is_late() {
                break;
            }
            let solved = balance_in(program, *settings);
            decision.effort = decision.effort.plus(solved.effort);
            if skipped == 0 && solved.forces.is_none() {
                break;
            }
            if let Some(amounts) = solved.forces {
                let proof = self.prove_forces(&amounts).proof;
                let outcome = match self.accepts(&proof) {
                    true => RebalanceOutcome::Stands(amounts.clone(), proof),
                    false => self.rebalance_locally(program, &amounts, &mut decision.effort),
                };
                if let RebalanceOutcome::Stands(outcome, proof) = outcome {
                    let (force_bound, least_force) = self.bound_force_sum(solved.witness.as_deref(), &outcome);
                    if least_force {
                        return Decision { amounts: outcome, force_bound, least_force, proof, ..decision };
                    }
                }
            }
        }
        if is_late() {
            return decision;
        }
        let found = LeastForce {
            amounts: decision.amounts,
            proof: decision.proof,
            force_bound: decision.force_bound,
            least_force: decision.least_force,
        };
        let found = self.reduce_force_sum(program, found, &mut decision.effort);
        Decision {
            amounts: found.amounts,
            proof: found.proof,
            force_bound: found.force_bound,
            least_force: found.least_force,
            ..decision
        }
    }

    /// Replaces the adhesion of the falling bodies by the least adhesion of the whole component, if it can be proved:
    /// the adhesion and the admissible forces must balance every body.
    fn with_failures_of_the_whole(&self, program: &Program, mut decision: Decision) -> Decision {
        for settings in &self.settings {
            if is_late() {
                break;
            }
            let least_adhesion = least_adhesion_in(program, *settings);
            decision.effort = decision.effort.plus(least_adhesion.effort);
            if least_adhesion.balanced == Some(true)
                && self.prove_with_adhesion(&least_adhesion.forces, &least_adhesion.adhesion).1
            {
                decision.amounts = least_adhesion.forces;
                decision.adhesion = Some(least_adhesion.adhesion);
                break;
            }
        }
        decision
    }

    /// Adds the least adhesion and its mechanism to a decision. Tries the solver settings in order. If the program
    /// finds forces that balance every body without adhesion, the verdict becomes stable.
    fn with_failures(&self, program: &Program, mut decision: Decision) -> Decision {
        let mut solved_before = decision.least_adhesion.take().filter(|s| s.balanced.is_some());
        for settings in &self.settings {
            let least_adhesion = solved_before.take().unwrap_or_else(|| {
                let least_adhesion = least_adhesion_in(program, *settings);
                decision.effort = decision.effort.plus(least_adhesion.effort);
                least_adhesion
            });
            let forces = self.prove_forces(&least_adhesion.forces).proof;
            if least_adhesion.balanced == Some(true) && self.accepts(&forces) {
                // These forces balance every body without adhesion. They decide, even if a motion is proved, too.
                return Decision {
                    verdict: Verdict::Stable,
                    amounts: least_adhesion.forces,
                    proof: forces,
                    ..decision
                };
            }
            // A large component keeps the motion that proved the verdict: correcting another motion takes a third of
            // the total time.
            let keeps_motion = program.blocks >= LARGE_PROGRAM_BLOCKS && !decision.mechanism.is_empty();
            let motion = least_adhesion.motion.filter(|_| !keeps_motion);
            let proved_motion = motion.and_then(|y| self.prove_motion(program, &y, &mut decision.effort));
            // If the program gives the forces a cost, its motion violates contacts slightly. The earlier motion is then
            // kept.
            if let (Some((mechanism, proof)), false) = (proved_motion, least_adhesion.priced) {
                (decision.mechanism, decision.proof) = (mechanism, proof);
            }
            // Use this result if it balances every body, or if no earlier result gave an adhesion.
            let has_adhesion = least_adhesion.balanced == Some(true);
            let holds = has_adhesion && self.prove_with_adhesion(&least_adhesion.forces, &least_adhesion.adhesion).1;
            if holds || decision.adhesion.is_none() {
                decision.adhesion_cannot_hold = least_adhesion.balanced == Some(false);
                decision.amounts = least_adhesion.forces;
                decision.adhesion = has_adhesion.then_some(least_adhesion.adhesion);
            }
            let is_large = program.blocks >= LARGE_PROGRAM_BLOCKS;
            if holds || least_adhesion.balanced == Some(false) || (has_adhesion && is_large) {
                break;
            }
        }
        decision
    }
}
