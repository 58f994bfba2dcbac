//! The ladder: one program after the other, until the forces or the motion of one has a proof.
//!
//! Read it from top to bottom. Where both proofs hold, the forces win; so a motion that does no more work than forces
//! within their band could take up decides only once the program of least residual, or of least sticking, has shown that no
//! forces balance.

use super::local::Outcome;
use super::rung::{Attempt, Strategy};
use super::straight::Least;
use super::{Case, Method};
use crate::analysis::{UndecidedReason, Verdict};
use crate::program::Program;
use crate::proof::{Motion, Proof};
use crate::solve::{Amounts, Effort, Stuck, is_late};

/// A verdict with its proof, in the pure numbers of its program.
pub(super) struct Decision {
    pub verdict: Verdict,
    /// Why it is undecided, in words; empty otherwise.
    pub doubt: Option<UndecidedReason>,
    /// Forces that balance, or that balance together with the sticking.
    pub amounts: Amounts,
    /// The sum that admissible forces must have at least to balance, N, where it was shown, and whether these have it.
    pub force_bound: Option<f64>,
    pub least_force: bool,
    /// What would have to stick.
    pub sticking: Option<Amounts>,
    /// No sticking could hold it.
    pub beyond_sticking: bool,
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    /// The rung that decided.
    pub method: Method,
    /// Whether the program of least force ended without a status.
    pub no_status: bool,
    /// What the program of least sticking gave, where the ladder came to it.
    pub stuck: Option<Stuck>,
    /// Whether only some bodies fall, and what sticks there is known.
    pub in_part: bool,
    pub effort: Effort,
}

impl Case<'_> {
    /// Climbs the ladder until a proof convinces.
    pub fn decided(&self, program: &Program) -> Decision {
        let mut effort = Effort::default();
        let mut no_status = false;
        let mut weak: Option<(Vec<Motion>, Proof)> = None;
        let (mut last, mut stuck) = (None, None);
        for rung in Strategy::ladder(program, &self.settings, self.place, self.described) {
            // After the deadline only the last attempt is reported; even to pose the next program takes time.
            if last.is_some() && is_late() {
                break;
            }
            let attempt = rung.attempt(program);
            effort = effort.and(attempt.effort);
            no_status |= rung.is_least() && attempt.forces.is_none() && attempt.motion.is_none();
            let decision = Decision {
                no_status,
                ..Decision::new(program, rung.method())
            };
            if let Some(amounts) = &attempt.forces {
                let proof = self.carried(amounts).proof;
                let outcome = match self.believes(&proof) {
                    true => Outcome::Stands(amounts.clone(), proof),
                    false => self.made_good(program, amounts, &mut effort),
                };
                match outcome {
                    Outcome::Stands(good, proof) => {
                        let (force_bound, least_force) =
                            self.least_shown(attempt.witness.as_deref(), &good);
                        let found = Least {
                            amounts: good,
                            proof,
                            force_bound,
                            least_force,
                        };
                        let found = match !least_force && no_status {
                            true => self.smaller(program, found, &mut effort),
                            false => found,
                        };
                        return Decision {
                            force_bound: found.force_bound,
                            least_force: found.least_force,
                            amounts: found.amounts,
                            proof: found.proof,
                            effort,
                            ..decision
                        };
                    }
                    Outcome::Falls(falling) => {
                        // Where no sticking helps the bodies that fall, the whole tells what is past help.
                        let in_part = falling.sticking.is_some();
                        return Decision {
                            verdict: Verdict::Unstable,
                            amounts: falling.amounts,
                            sticking: falling.sticking,
                            mechanism: falling.mechanism,
                            proof: falling.proof,
                            in_part,
                            effort,
                            ..decision
                        };
                    }
                    Outcome::Open => {}
                }
            }
            let falls = attempt
                .motion
                .as_ref()
                .and_then(|y| self.falling(program, y, &mut effort));
            let strong = falls
                .as_ref()
                .is_some_and(|(motion, proof)| self.outweighs_the_band(motion, proof));
            if let Some((mechanism, proof)) = falls.or(weak.take()) {
                if strong || rung.excludes_balance(&attempt) {
                    return Decision {
                        verdict: Verdict::Unstable,
                        mechanism,
                        proof,
                        stuck: attempt.stuck.or(stuck),
                        effort,
                        ..decision
                    };
                }
                weak = Some((mechanism, proof));
            }
            stuck = attempt.stuck.clone().or(stuck);
            last = Some((decision, attempt));
        }
        self.without_proof(program, last, weak, effort)
    }

    /// What is left at the end of the ladder: a motion, or a doubt.
    fn without_proof(
        &self,
        program: &Program,
        last: Option<(Decision, Attempt)>,
        weak: Option<(Vec<Motion>, Proof)>,
        effort: Effort,
    ) -> Decision {
        let (decision, attempt) = match last {
            Some((decision, attempt)) => (decision, Some(attempt)),
            None => (Decision::new(program, Method::LeastForce), None),
        };
        let decision = Decision { effort, ..decision };
        if let Some((mechanism, proof)) = weak {
            return Decision {
                verdict: Verdict::Unstable,
                mechanism,
                proof,
                stuck: attempt.and_then(|a| a.stuck),
                ..decision
            };
        }
        let forces = attempt.as_ref().and_then(|a| a.unproved_forces());
        let amounts = forces.cloned().unwrap_or_else(|| Amounts::none(program));
        let proof = self.carried(&amounts).proof;
        let motion = attempt.as_ref().and_then(|a| a.motion.as_ref());
        let raw = motion.map(|y| self.mechanism(&self.moved(y).1));
        Decision {
            verdict: Verdict::Undecided,
            doubt: Some(UndecidedReason::Unproved {
                forces: proof,
                motion: raw,
            }),
            amounts,
            proof,
            ..decision
        }
    }
}

impl Decision {
    /// A frame for a decision by a method: stable, by no forces, proved by nothing.
    pub fn new(program: &Program, method: Method) -> Decision {
        Decision {
            verdict: Verdict::Stable,
            doubt: None,
            amounts: Amounts::none(program),
            force_bound: None,
            least_force: false,
            sticking: None,
            beyond_sticking: false,
            mechanism: Vec::new(),
            proof: Proof::Mechanism {
                power: 0.0,
                worst_violation: 0.0,
            },
            method,
            no_status: false,
            stuck: None,
            in_part: false,
            effort: Effort::default(),
        }
    }
}
