//! What belongs to a verdict: the forces of least sum where it stands, what fails and how it moves where it falls.

use super::Case;
use super::Method;
use super::ladder::Decision;
use super::local::Outcome;
use super::rung::MANY_BLOCKS;
use crate::analysis::Verdict;
use crate::program::Program;
use crate::solve::{Choice, balance_in, is_late, stick_in};

impl Case<'_> {
    /// A decision with its description, where that is asked for.
    pub fn described(&self, program: &Program, decision: Decision) -> Decision {
        if !self.described {
            return decision;
        }
        match decision.verdict {
            Verdict::Stable if !decision.least_force => self.with_least_force(program, decision),
            Verdict::Unstable if !decision.in_part => self.with_failures(program, decision),
            // What bodies lack that fall while all others rest may be more in the whole, where the others give way.
            Verdict::Unstable if program.blocks < MANY_BLOCKS => {
                self.with_failures_of_the_whole(program, decision)
            }
            _ => decision,
        }
    }

    /// The forces of least sum in place of some that balance, where a more precise solution has them.
    fn with_least_force(&self, program: &Program, mut decision: Decision) -> Decision {
        // What ended without a status was tried at full precision already; and a draft is content with any forces.
        if decision.no_status || self.settings.iter().any(|s| s.choice == Choice::Any) {
            return decision;
        }
        // Of many blocks that the first look did not decide the least force was not sought in earnest.
        let sought =
            usize::from(program.blocks < MANY_BLOCKS || decision.method != Method::LeastResidual);
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
                let proof = self.carried(&amounts).proof;
                let good = match self.believes(&proof) {
                    true => Outcome::Stands(amounts.clone(), proof),
                    false => self.made_good(program, &amounts, &mut decision.effort),
                };
                if let Outcome::Stands(good, proof) = good {
                    let (force_bound, least_force) =
                        self.least_shown(solved.witness.as_deref(), &good);
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

    /// What would have to stick in the whole, in place of what the falling bodies lack, where it balances every body.
    fn with_failures_of_the_whole(&self, program: &Program, mut decision: Decision) -> Decision {
        for settings in &self.settings {
            if is_late() {
                break;
            }
            let stuck = stick_in(program, *settings);
            decision.effort = decision.effort.and(stuck.effort);
            if stuck.balanced == Some(true)
                && self.carried_with_sticking(&stuck.forces, &stuck.sticking).1
            {
                decision.amounts = stuck.forces;
                decision.sticking = Some(stuck.sticking);
                break;
            }
        }
        decision
    }

    /// What would have to stick, sought as long as there is a way, and the mechanism that goes with it.
    fn with_failures(&self, program: &Program, mut decision: Decision) -> Decision {
        let mut ready = decision.stuck.take().filter(|s| s.balanced.is_some());
        for settings in &self.settings {
            let stuck = ready.take().unwrap_or_else(|| {
                let stuck = stick_in(program, *settings);
                decision.effort = decision.effort.and(stuck.effort);
                stuck
            });
            let forces = self.carried(&stuck.forces).proof;
            if stuck.balanced == Some(true) && self.believes(&forces) {
                // Both proofs hold: the forces win.
                return Decision {
                    verdict: Verdict::Stable,
                    amounts: stuck.forces,
                    proof: forces,
                    ..decision
                };
            }
            // Of many blocks the motion that decided is shown: to free another of the solver's error takes a third as long
            // as all the rest.
            let shown = program.blocks >= MANY_BLOCKS && !decision.mechanism.is_empty();
            let motion = stuck.motion.filter(|_| !shown);
            let own = motion.and_then(|y| self.falling(program, &y, &mut decision.effort));
            // At a price on forces the motion violates contacts a little: then the one that decided is shown.
            if let (Some((mechanism, proof)), false) = (own, stuck.priced) {
                (decision.mechanism, decision.proof) = (mechanism, proof);
            }
            // A later setting replaces what an earlier one found only where that does not balance every body.
            let found = stuck.balanced == Some(true);
            let holds = found && self.carried_with_sticking(&stuck.forces, &stuck.sticking).1;
            if holds || decision.sticking.is_none() {
                decision.beyond_sticking = stuck.balanced == Some(false);
                decision.amounts = stuck.forces;
                decision.sticking = found.then_some(stuck.sticking);
            }
            let many = program.blocks >= MANY_BLOCKS;
            if holds || stuck.balanced == Some(false) || (found && many) {
                break;
            }
        }
        decision
    }
}
