//! Route 4: adds the remaining results after the verdict. These are the forces of least sum if the structure stands, or
//! its failures and its mechanism if it falls.

use super::rebalance::{MAX_ROUNDS, Rebalanced};
use super::{Component, Method, Outcome};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::Program;
use crate::mechanics::solve::{Amounts, balance_in, is_late, least_adhesion_in};

impl Component<'_> {
    /// Adds forces of least sum (stable) or failures (unstable) to an outcome. Returns the outcome unchanged if only
    /// the verdict is requested.
    pub fn complete(&self, program: &Program, outcome: Outcome) -> Outcome {
        if !self.is_complete() {
            return outcome;
        }
        match outcome.verdict {
            Verdict::Stable if !outcome.least_force => self.with_least_force(program, outcome),
            // If the outcome covers only some falling bodies, less adhesion may be enough for the whole component.
            Verdict::Unstable if !outcome.only_some_fall || !program.has_many_blocks() => {
                self.with_failures(program, outcome)
            }
            _ => outcome,
        }
    }

    /// Replaces the forces of an outcome by balancing forces of least sum, if these are proved to be the least. The
    /// program of least force is solved with full conditioning. If a large component was decided by least residual, it
    /// is solved with plain conditioning, which was not tried to the end before.
    fn with_least_force(&self, program: &Program, mut outcome: Outcome) -> Outcome {
        if is_late() {
            return outcome;
        }
        let [plain, full] = self.settings;
        let is_untried = program.has_many_blocks() && outcome.method == Method::LeastResidual;
        let solved = balance_in(program, if is_untried { plain } else { full });
        outcome.effort = outcome.effort.plus(solved.effort);
        if let Some(amounts) = solved.forces
            && let Some(Rebalanced::Forces(proved)) = self.balance_every_body(program, &amounts, &mut outcome.effort)
            && let (force_bound, true) = self.bound_force_sum(solved.witness.as_deref(), &proved.forces)
        {
            outcome.stand(proved);
            (outcome.force_bound, outcome.least_force) = (force_bound, true);
        }
        outcome
    }

    /// Adds the least adhesion and its mechanism to an outcome. Tries the solver settings in order. If the program
    /// finds forces that balance every body without adhesion, the verdict becomes stable. If the adhesion of falling
    /// bodies is known, it is replaced only if the adhesion of the whole component balances every body.
    fn with_failures(&self, program: &Program, mut outcome: Outcome) -> Outcome {
        let mut solved_before = outcome.least_adhesion.take().filter(|found| found.motion.is_some());
        let is_large = program.has_many_blocks();
        // A large component keeps the motion that proved the verdict: correcting another motion takes a third of the
        // total time.
        let keeps_motion = outcome.only_some_fall || (is_large && !outcome.mechanism.is_empty());
        for settings in &self.settings {
            let found = solved_before.take().unwrap_or_else(|| {
                let found = least_adhesion_in(program, *settings);
                outcome.effort = outcome.effort.plus(found.effort);
                found
            });
            if let Some(forces) = &found.forces {
                let proved = self.prove_forces(forces.clone());
                if self.accepts(&proved.proof) {
                    // These forces balance every body without adhesion. They decide, even if a motion is proved, too.
                    outcome.stand(proved);
                    return outcome;
                }
            }
            let unsupported = found.forces.is_none() && found.motion.is_some();
            let motion = found.motion.filter(|_| !keeps_motion);
            let proved_motion = motion.and_then(|y| self.prove_motion(program, &y, &mut outcome.effort));
            // If the program gives the forces a cost, its motion violates contacts slightly. The earlier motion is then
            // kept.
            if let (Some((mechanism, proof)), false) = (proved_motion, found.priced) {
                (outcome.mechanism, outcome.proof) = (mechanism, proof);
            }
            let Some((forces, adhesion)) = found.forces.zip(found.adhesion) else {
                // The least adhesion is unknown, or no adhesion holds the component. An adhesion of other settings, which
                // did not balance every body, is then no result.
                if outcome.adhesion.is_none() || (unsupported && !outcome.only_some_fall) {
                    (outcome.amounts, outcome.unsupported) = (Amounts::zero(program), unsupported);
                    outcome.adhesion = None;
                }
                if unsupported {
                    return outcome;
                }
                continue;
            };
            // Use this result if it balances every body, or if no earlier result gave an adhesion.
            let holds = self.prove_with_adhesion(forces.clone(), &adhesion).1;
            if holds || outcome.adhesion.is_none() {
                (outcome.amounts, outcome.adhesion) = (forces, Some(adhesion));
            }
            if holds || is_large {
                return outcome;
            }
        }
        self.with_failures_of_light_bodies(program, outcome)
    }

    /// Adds the adhesion that light bodies lack, if the adhesion of a program leaves them unbalanced: its error is a
    /// small fraction of the heaviest load, which may be more than the load of a light body. Holds all other bodies
    /// still and decides the light bodies in their own scale (route 3a). Returns the outcome unchanged if this does not
    /// balance every body.
    fn with_failures_of_light_bodies(&self, program: &Program, outcome: Outcome) -> Outcome {
        let Some(mut adhesion) = outcome.adhesion.clone() else {
            return outcome;
        };
        let (mut amounts, mut effort) = (outcome.amounts.clone(), outcome.effort);
        // Each round balances lighter bodies.
        for _ in 0..MAX_ROUNDS {
            let held = self.with_adhesion(&adhesion);
            let component = Component { assembly: &held, ..*self };
            let proved = component.prove_forces(amounts.clone());
            if component.accepts(&proved.proof) {
                return Outcome { adhesion: Some(adhesion), amounts, effort, ..outcome };
            }
            let sets = held.connected(&component.unbalanced(&proved.forces));
            let (falling, has_changed) = component.rebalance_sets(sets, &mut amounts, &mut effort);
            if is_late() || (falling.is_empty() && !has_changed) {
                break;
            }
            for (part, fall) in &falling {
                let mut missing = Amounts::zero(program);
                self.insert_part(&mut amounts, part, &fall.amounts);
                let Some(found) = &fall.adhesion else {
                    return outcome;
                };
                self.insert_part(&mut missing, part, found);
                adhesion.add_all(&missing);
            }
        }
        outcome
    }
}
