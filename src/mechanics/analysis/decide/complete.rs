//! Route 4: what belongs to a verdict. Forces of least sum for what stands; failures and mechanism for what falls.

use super::Component;
use super::Method;
use super::programs::Decision;
use super::rebalance::Outcome;
use super::strategy::LARGE_PROGRAM_BLOCKS;
use crate::analysis::Verdict;
use crate::program::Program;
use crate::solve::{Choice, balance_in, is_late, least_adhesion_in};

impl Component<'_> {
    /// Adds least forces or failures to a decision, unless only the verdict is wanted.
    pub fn complete(&self, program: &Program, decision: Decision) -> Decision {
        if !self.complete_result {
            return decision;
        }
        match decision.verdict {
            Verdict::Stable if !decision.least_force => self.with_least_force(program, decision),
            Verdict::Unstable if !decision.in_part => self.with_failures(program, decision),
            // If the other bodies may move too, the least adhesion can be smaller than that of the falling bodies alone.
            Verdict::Unstable if program.blocks < LARGE_PROGRAM_BLOCKS => {
                self.with_failures_of_the_whole(program, decision)
            }
            _ => decision,
        }
    }

    /// Replaces forces that balance by those of least sum, if a more precise solution finds them.
    fn with_least_force(&self, program: &Program, mut decision: Decision) -> Decision {
        // A program without a status was already tried at full precision.
        if decision.no_status || self.settings.iter().any(|s| s.choice == Choice::Any) {
            return decision;
        }
        // For large components not decided in the first, short attempt, least force has not been solved to the end.
        let sought = usize::from(
            program.blocks < LARGE_PROGRAM_BLOCKS || decision.method != Method::LeastResidual,
        );
        for settings in self.settings.iter().skip(sought) {
            if is_late() {
                break;
            }
            let solved = balance_in(program, *settings);
            decision.effort = decision.effort.and(solved.effort);
            if sought == 0 && solved.forces.is_none() {
                break;
            }
            if let Some(amounts) = solved.forces {
                let proof = self.prove_forces(&amounts).proof;
                let good = match self.believes(&proof) {
                    true => Outcome::Stands(amounts.clone(), proof),
                    false => self.rebalance_locally(program, &amounts, &mut decision.effort),
                };
                if let Outcome::Stands(good, proof) = good {
                    let (force_bound, least_force) =
                        self.bound_force_sum(solved.witness.as_deref(), &good);
                    if least_force {
                        return Decision {
                            amounts: good,
                            force_bound,
                            least_force,
                            proof,
                            ..decision
                        };
                    }
                }
            }
        }
        decision
    }

    /// Replaces the adhesion of the falling bodies by that of the whole component, if that balances every body.
    fn with_failures_of_the_whole(&self, program: &Program, mut decision: Decision) -> Decision {
        for settings in &self.settings {
            if is_late() {
                break;
            }
            let adhesion = least_adhesion_in(program, *settings);
            decision.effort = decision.effort.and(adhesion.effort);
            if adhesion.balanced == Some(true)
                && self
                    .prove_with_adhesion(&adhesion.forces, &adhesion.sticking)
                    .1
            {
                decision.amounts = adhesion.forces;
                decision.sticking = Some(adhesion.sticking);
                break;
            }
        }
        decision
    }

    /// Computes the least adhesion, and the mechanism that belongs to it. The settings are tried in order.
    fn with_failures(&self, program: &Program, mut decision: Decision) -> Decision {
        let mut ready = decision.adhesion.take().filter(|s| s.balanced.is_some());
        for settings in &self.settings {
            let adhesion = ready.take().unwrap_or_else(|| {
                let adhesion = least_adhesion_in(program, *settings);
                decision.effort = decision.effort.and(adhesion.effort);
                adhesion
            });
            let forces = self.prove_forces(&adhesion.forces).proof;
            if adhesion.balanced == Some(true) && self.believes(&forces) {
                // Forces balance every body after all. Both proofs hold, and the forces win.
                return Decision {
                    verdict: Verdict::Stable,
                    amounts: adhesion.forces,
                    proof: forces,
                    ..decision
                };
            }
            // For large components the motion that decided is kept. Freeing another one of the solver's error takes a third as
            // long as everything else.
            let shown = program.blocks >= LARGE_PROGRAM_BLOCKS && !decision.mechanism.is_empty();
            let motion = adhesion.motion.filter(|_| !shown);
            let own = motion.and_then(|y| self.prove_motion(program, &y, &mut decision.effort));
            // A program with a price on forces gives a motion that violates contacts a little; the one that decided is kept.
            if let (Some((mechanism, proof)), false) = (own, adhesion.priced) {
                (decision.mechanism, decision.proof) = (mechanism, proof);
            }
            // A later setting replaces what an earlier one found only where that does not balance every body.
            let found = adhesion.balanced == Some(true);
            let holds = found
                && self
                    .prove_with_adhesion(&adhesion.forces, &adhesion.sticking)
                    .1;
            if holds || decision.sticking.is_none() {
                decision.beyond_sticking = adhesion.balanced == Some(false);
                decision.amounts = adhesion.forces;
                decision.sticking = found.then_some(adhesion.sticking);
            }
            let many = program.blocks >= LARGE_PROGRAM_BLOCKS;
            if holds || adhesion.balanced == Some(false) || (found && many) {
                break;
            }
        }
        decision
    }
}
