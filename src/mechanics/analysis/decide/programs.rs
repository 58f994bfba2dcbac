//! Route 3: solves several linear programs one after another, until the forces or the motion of one of them are proved.
//!
//! If both proofs hold, the forces decide. A proof of forces allows a small imbalance. A motion with less power than
//! this imbalance could absorb is *weak*: forces that balance may exist as well. A weak motion decides only after a
//! program has shown that no forces balance: the program of any balance, of least residual or of least adhesion. If no
//! program shows this, the component is undecided.

use super::parallel_joints::LeastForce;
use super::rebalance::RebalanceOutcome;
use super::strategy::{Attempt, Strategy};
use super::{Component, Method};
use crate::mechanics::analysis::{UndecidedReason, Verdict};
use crate::mechanics::program::Program;
use crate::mechanics::proof::{Motion, Proof};
use crate::mechanics::solve::{Amounts, Effort, LeastAdhesion, is_late};

/// A verdict with its proof. `amounts` and `adhesion` are in program units; the mechanism and the bound are in metres
/// and newtons.
pub(super) struct Decision {
    pub verdict: Verdict,
    /// The reason if the verdict is *undecided*; `None` otherwise.
    pub doubt: Option<UndecidedReason>,
    /// Forces that balance, or that balance together with the adhesion.
    pub amounts: Amounts,
    /// A proved lower bound for the sum of balancing forces, N; `None` if none was proved.
    pub force_bound: Option<f64>,
    /// Whether the forces are proved to have the least sum.
    pub least_force: bool,
    /// The adhesion that is missing for a balance; `None` if the component stands or no adhesion was computed.
    pub adhesion: Option<Amounts>,
    /// Whether no adhesion at the application points could hold the component.
    pub adhesion_cannot_hold: bool,
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    /// The strategy that decided.
    pub method: Method,
    /// Whether a program of least force ended without a result.
    pub least_force_failed: bool,
    /// The answer of the program of least adhesion, if it was solved.
    pub least_adhesion: Option<LeastAdhesion>,
    /// Whether only some bodies fall, and the adhesion that these lack is known.
    pub only_some_fall: bool,
    pub effort: Effort,
}

/// The results of the strategies that were tried so far.
#[derive(Default)]
struct Progress {
    effort: Effort,
    /// Whether a program of least force ended without a result.
    least_force_failed: bool,
    /// A weak motion with its proof: an accepted imbalance of forces could absorb its power.
    weak_motion: Option<(Vec<Motion>, Proof)>,
    least_adhesion: Option<LeastAdhesion>,
    last: Option<(Strategy, Attempt)>,
}

impl Progress {
    /// Creates a decision made by `strategy`, with the solver effort so far. Its forces and its proof are still empty.
    fn decision(&self, program: &Program, strategy: Strategy) -> Decision {
        Decision {
            least_force_failed: self.least_force_failed,
            effort: self.effort,
            ..Decision::new(program, strategy.method())
        }
    }
}

impl Component<'_> {
    /// Tries the strategies in order, and returns the first decision that is proved. If no strategy gives a proof
    /// before the deadline, the decision is undecided.
    pub fn decide_by_programs(&self, program: &Program) -> Decision {
        let mut progress = Progress::default();
        let strategies = Strategy::in_order(program, &self.settings, self.limit_distance, self.complete_result);
        for strategy in strategies {
            // After the deadline, stop and report the last attempt: even setting up the next program takes time.
            if progress.last.is_some() && is_late() {
                break;
            }
            // Solve one program, then try to prove its forces, then its motion.
            let attempt = strategy.attempt(program);
            progress.effort = progress.effort.plus(attempt.effort);
            progress.least_force_failed |=
                strategy.is_full_least_force() && attempt.forces.is_none() && attempt.motion.is_none();
            let decided = self
                .decide_by_forces(program, strategy, &attempt, &mut progress)
                .or_else(|| self.decide_by_motion(program, strategy, &attempt, &mut progress));
            if let Some(decision) = decided {
                return decision;
            }
            progress.least_adhesion = attempt.least_adhesion.clone().or(progress.least_adhesion);
            progress.last = Some((strategy, attempt));
        }
        self.without_proof(program, progress)
    }

    /// Decides by the forces of an attempt. The component stands if they balance every body; it falls if some bodies
    /// are proved to fall. `None` if neither is proved.
    fn decide_by_forces(
        &self,
        program: &Program,
        strategy: Strategy,
        attempt: &Attempt,
        progress: &mut Progress,
    ) -> Option<Decision> {
        let amounts = attempt.forces.as_ref()?;
        // The solver's accuracy is relative to the heaviest load, so its forces may not balance a light body.
        let proof = self.prove_forces(amounts).proof;
        let outcome = match self.accepts(&proof) {
            true => RebalanceOutcome::Stands(amounts.clone(), proof),
            false => self.rebalance_locally(program, amounts, &mut progress.effort),
        };
        match outcome {
            RebalanceOutcome::Stands(amounts, proof) => {
                // Check how close the sum of the forces is to the least sum.
                let witness = attempt.witness.as_deref();
                let (force_bound, least_force) = self.bound_force_sum(witness, &amounts);
                let mut found = LeastForce { amounts, proof, force_bound, least_force };
                // If joints are nearly parallel, the program of least force may end without a result. Then simpler
                // programs reduce the sum.
                if !least_force && progress.least_force_failed {
                    found = self.reduce_force_sum(program, found, &mut progress.effort);
                }
                Some(Decision {
                    force_bound: found.force_bound,
                    least_force: found.least_force,
                    amounts: found.amounts,
                    proof: found.proof,
                    ..progress.decision(program, strategy)
                })
            }
            RebalanceOutcome::Falls(part) => Some(Decision {
                verdict: Verdict::Unstable,
                amounts: part.amounts,
                // If the adhesion that the falling bodies need is not known, `complete` computes the failures of the
                // whole component from the start.
                only_some_fall: part.adhesion.is_some(),
                adhesion: part.adhesion,
                mechanism: part.mechanism,
                proof: part.proof,
                ..progress.decision(program, strategy)
            }),
            RebalanceOutcome::Undecided => None,
        }
    }

    /// Decides that a component falls, by the motion of `attempt` or by a weak motion of an earlier attempt. `None` if
    /// neither motion exists with a proof. Also `None` if balancing forces may still exist; the motion is then kept as
    /// `progress.weak_motion`.
    fn decide_by_motion(
        &self,
        program: &Program,
        strategy: Strategy,
        attempt: &Attempt,
        progress: &mut Progress,
    ) -> Option<Decision> {
        let motion = attempt.motion.as_ref();
        let proved = motion.and_then(|y| self.prove_motion(program, y, &mut progress.effort));
        // A motion decides alone if its power is larger than the power of any imbalance that a proof by forces accepts.
        let is_strong = proved.as_ref().is_some_and(|(motion, proof)| self.exceeds_force_tolerance(motion, proof));
        let (mechanism, proof) = proved.or(progress.weak_motion.take())?;
        // Otherwise the motion is weak. It decides only if a program shows that no forces balance the loads.
        if !is_strong && !strategy.excludes_balance(attempt) {
            progress.weak_motion = Some((mechanism, proof));
            return None;
        }
        Some(Decision {
            verdict: Verdict::Unstable,
            mechanism,
            proof,
            least_adhesion: attempt.least_adhesion.clone().or(progress.least_adhesion.take()),
            ..progress.decision(program, strategy)
        })
    }

    /// Returns the decision *undecided*, for the case that no strategy gave a proof: the programs failed, or the
    /// deadline passed. The decision contains the forces of the last attempt. It also reports the errors of a motion:
    /// of a weak motion, if there is one, otherwise of the last attempt's motion. A weak motion does not decide,
    /// because no program has excluded a balance.
    fn without_proof(&self, program: &Program, progress: Progress) -> Decision {
        let decision = match &progress.last {
            Some((strategy, _)) => progress.decision(program, *strategy),
            None => Decision::new(program, Method::LeastForce),
        };
        let attempt = progress.last.map(|(_, attempt)| attempt);
        let forces = attempt.as_ref().and_then(|a| a.unproved_forces());
        let amounts = forces.cloned().unwrap_or_else(|| Amounts::zero(program));
        let proof = self.prove_forces(&amounts).proof;
        let weak = progress.weak_motion.map(|(_, proof)| proof);
        let motion = attempt.as_ref().and_then(|a| a.motion.as_ref());
        // The reason for the undecided verdict reports the errors of the forces and of the motion.
        let unproved_motion = weak.or_else(|| motion.map(|y| self.check_mechanism(&self.to_motions(y).1)));
        Decision {
            verdict: Verdict::Undecided,
            doubt: Some(UndecidedReason::Unproved { forces: proof, motion: unproved_motion }),
            amounts,
            proof,
            ..decision
        }
    }
}

impl Decision {
    /// Creates a decision with the verdict *stable*, zero forces and an empty proof. The caller sets the forces and the
    /// proof.
    pub fn new(program: &Program, method: Method) -> Decision {
        Decision {
            verdict: Verdict::Stable,
            doubt: None,
            amounts: Amounts::zero(program),
            force_bound: None,
            least_force: false,
            adhesion: None,
            adhesion_cannot_hold: false,
            mechanism: Vec::new(),
            proof: Proof::Mechanism { power: 0.0, worst_violation: 0.0 },
            method,
            least_force_failed: false,
            least_adhesion: None,
            only_some_fall: false,
            effort: Effort::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::analysis::Options;
    use crate::mechanics::program::Scale;
    use crate::mechanics::scene::{BlockId, Scene};
    use crate::mechanics::statics::effect::{self, FrameContext};
    use crate::mechanics::statics::interface::Interfaces;

    /// A proved motion that does little work is not a verdict, because forces that no program has computed may
    /// balance.
    #[test]
    fn a_weak_motion_without_a_program_that_excludes_a_balance_leaves_it_undecided() {
        let scene = Scene::from_json(
            r#"{ "drystone": 1, "ground": [{ "polygon": [[0, -1], [4, -1], [4, 0], [0, 0]] }],
                "blocks": [{ "id": "a", "polygon": [[1, 0], [2, 0], [2, 1], [1, 1]], "weight": 1 }] }"#,
        )
        .expect("sound");
        let interfaces = Interfaces::new(&scene);
        let (assembly, _) = effect::assemble(&FrameContext {
            scene: &scene,
            frame: &scene.frames[0],
            interfaces: &interfaces.in_frame(&scene, &scene.frames[0]),
        });
        let component = Component::new(&assembly, Options::default());
        let program = Program::new(&assembly, Scale::from_assembly(&assembly));
        let motion = Motion { block: BlockId(0), velocity: crate::geometry::Vector::new(1.0, 0.0), spin: 0.0 };
        let weak = Proof::Mechanism { power: 1e-9, worst_violation: 0.0 };
        let progress = Progress { weak_motion: Some((vec![motion], weak)), ..Progress::default() };
        let decision = component.without_proof(&program, progress);
        assert_eq!(decision.verdict, Verdict::Undecided);
        assert!(decision.mechanism.is_empty());
        let Some(doubt @ UndecidedReason::Unproved { motion, .. }) = decision.doubt else {
            panic!("{:?}", decision.doubt);
        };
        assert_eq!(motion, Some(weak));
        let words = doubt.to_string();
        assert!(words.contains("its power may be zero"), "{words}");
    }
}
