//! Route 3: solves several linear programs one after another, until the forces or the motion of one of them are proved.
//!
//! If both proofs hold, the forces decide. A proof of forces allows a small imbalance. A motion with less power than
//! this imbalance could absorb is *weak*: forces that balance may exist as well. A weak motion decides only after a
//! program has shown that no forces balance: the program of any balance, of least residual or of least adhesion. If no
//! program shows this, the component is undecided.

use super::rebalance::Rebalanced;
use super::strategy::Strategy;
use super::{Component, Outcome};
use crate::mechanics::analysis::{UndecidedReason, Verdict};
use crate::mechanics::program::Program;
use crate::mechanics::proof::{Motion, Proof};
use crate::mechanics::solve::{Amounts, Balance, is_late};

/// The results of the strategies that were tried so far.
struct Progress {
    /// The outcome as far as it is known: its effort and the answers of earlier programs.
    outcome: Outcome,
    /// A weak motion with its proof: an accepted imbalance of forces could absorb its power.
    weak_motion: Option<(Vec<Motion>, Proof)>,
    last: Option<Balance>,
}

impl Component<'_> {
    /// Tries the strategies in order, and returns the first outcome that is proved. If no strategy gives a proof
    /// before the deadline, the outcome is undecided.
    pub fn decide_by_programs(&self, program: &Program) -> Outcome {
        let outcome = Outcome::undecided(self.assembly, program);
        let mut progress = Progress { outcome, weak_motion: None, last: None };
        let strategies = Strategy::in_order(program, self.settings, self.limit_distance);
        for strategy in strategies {
            // After the deadline, stop and report the last attempt: even setting up the next program takes time.
            if progress.last.is_some() && is_late() {
                break;
            }
            // Solve one program, then try to prove its forces, then its motion.
            let attempt = strategy.attempt(program);
            let outcome = &mut progress.outcome;
            outcome.method = strategy.method();
            outcome.effort = outcome.effort.plus(attempt.effort);
            // The closed form is used only if its forces need adhesion.
            if strategy != Strategy::Determinate && self.decide_by_forces(program, &attempt, &mut progress.outcome) {
                return progress.outcome;
            }
            let is_decided = self.decide_by_motion(program, strategy, &attempt, &mut progress);
            if strategy.finds_adhesion() && attempt.motion.is_some() {
                progress.outcome.least_adhesion = Some(attempt.clone());
            }
            if is_decided {
                return progress.outcome;
            }
            progress.last = Some(attempt);
        }
        self.without_proof(program, progress)
    }

    /// Decides by the forces of an attempt. The component stands if they balance every body; it falls if some bodies
    /// are proved to fall. Returns false if neither is proved.
    fn decide_by_forces(&self, program: &Program, attempt: &Balance, outcome: &mut Outcome) -> bool {
        let Some(amounts) = &attempt.forces else {
            return false;
        };
        // The solver's accuracy is relative to the heaviest load, so its forces may not balance a light body.
        match self.balance_every_body(program, amounts, &mut outcome.effort) {
            Some(Rebalanced::Forces(proved)) => {
                // Check how close the sum of the forces is to the least sum.
                let witness = attempt.witness.as_deref();
                (outcome.force_bound, outcome.least_force) = self.bound_force_sum(witness, &proved.forces);
                outcome.stand(proved);
                true
            }
            Some(Rebalanced::Falls(part)) => {
                outcome.fall(part.mechanism, part.proof);
                outcome.amounts = part.amounts;
                // If the adhesion that the falling bodies need is not known, `complete` computes the failures of the
                // whole component from the start.
                outcome.only_some_fall = part.adhesion.is_some();
                outcome.adhesion = part.adhesion;
                true
            }
            None => false,
        }
    }

    /// Decides that a component falls, by the motion of `attempt` or by a weak motion of an earlier attempt. Returns
    /// false if neither motion exists with a proof. Also returns false if balancing forces may still exist; the motion
    /// is then kept as `progress.weak_motion`.
    fn decide_by_motion(
        &self,
        program: &Program,
        strategy: Strategy,
        attempt: &Balance,
        progress: &mut Progress,
    ) -> bool {
        let outcome = &mut progress.outcome;
        let motion = attempt.motion.as_ref();
        let proved = motion.and_then(|y| self.prove_motion(program, y, &mut outcome.effort));
        // A motion decides alone if its power is larger than the power of any imbalance that a proof by forces accepts.
        let is_strong = proved.as_ref().is_some_and(|(motion, proof)| self.exceeds_force_tolerance(motion, proof));
        let Some((mechanism, proof)) = proved.or(progress.weak_motion.take()) else {
            return false;
        };
        // Otherwise the motion is weak. It decides only if a program shows that no forces balance the loads.
        if !is_strong && !strategy.excludes_balance(attempt) {
            progress.weak_motion = Some((mechanism, proof));
            return false;
        }
        outcome.fall(mechanism, proof);
        true
    }

    /// Returns the outcome *undecided*, for the case that no strategy gave a proof: the programs failed, or the
    /// deadline passed. The outcome contains the forces of the last attempt. It also reports the errors of a motion:
    /// of a weak motion, if there is one, otherwise of the last attempt's motion. A weak motion does not decide,
    /// because no program has excluded a balance.
    fn without_proof(&self, program: &Program, progress: Progress) -> Outcome {
        let attempt = progress.last.as_ref();
        let amounts = attempt.and_then(|attempt| attempt.forces.clone());
        let proved = self.prove_forces(amounts.unwrap_or_else(|| Amounts::zero(program)));
        let weak = progress.weak_motion.map(|(_, proof)| proof);
        let motion = attempt.and_then(|attempt| attempt.motion.as_ref());
        // The reason for the undecided verdict reports the errors of the forces and of the motion.
        let unproved_motion = weak.or_else(|| motion.map(|y| self.check_mechanism(&self.to_motions(y).1)));
        let mut outcome = progress.outcome;
        outcome.doubt = Some(UndecidedReason::Unproved { forces: proved.proof, motion: unproved_motion });
        outcome.stand(proved);
        outcome.verdict = Verdict::Undecided;
        outcome
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::analysis::Options;
    use crate::mechanics::program::Scale;
    use crate::mechanics::scene::{BlockId, Scene};
    use crate::mechanics::statics::effect;
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
        let assembly = effect::assembly_of(&scene, &scene.frames[0], &Interfaces::new(&scene));
        let component = Component::new(&assembly, Options::default());
        let program = Program::new(&assembly, Scale::from_assembly(&assembly));
        let motion = Motion { block: BlockId(0), velocity: crate::geometry::Vector::new(1.0, 0.0), spin: 0.0 };
        let weak = Proof::Mechanism { power: 1e-9, worst_violation: 0.0 };
        let outcome = Outcome::undecided(&assembly, &program);
        let progress = Progress { outcome, weak_motion: Some((vec![motion], weak)), last: None };
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
