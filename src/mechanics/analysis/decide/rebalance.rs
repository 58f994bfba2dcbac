//! Route 3a: corrects forces that balance the structure as a whole but leave light bodies unbalanced. If this fails, it
//! tries to prove that some of these bodies fall.
//!
//! A solver's error is a small fraction of the heaviest load. On a light body this error may exceed the weight of the
//! body and hide that the body falls. Each round does the first of these steps that helps:
//!
//! 1. Change each force by a small fraction of itself ([`rebalance_relative`]).
//! 2. Change all forces as little as possible ([`rebalance_absolute`]). This step can add forces that were 0, such as
//!    a robot's force.
//! 3. For each connected set of unbalanced bodies, hold all other bodies still, as if they were ground. Change the
//!    forces on the set as little as possible, in units of force and length that suit the set ([`rebalance_absolute`]).
//! 4. If this does not improve the balance enough, decide the set like a component. If it falls, the whole component
//!    falls: the motion of the set with all other bodies at rest is a mechanism. If it stands, its forces replace the
//!    old ones.
//!
//! Each round balances lighter bodies. Unbalanced sets within a set are treated in the same way.

use super::forces::ProvedForces;
use super::{Component, LimitDistance};
use crate::geometry::Vector;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::{self, Motion, Proof};
use crate::mechanics::solve::{Amounts, Effort, is_late, rebalance_absolute, rebalance_relative};
use crate::mechanics::statics::assembly::Substructure;

/// The largest number of rounds of correction. Each round gains as many accurate digits as one solution has; eight
/// rounds cover weights from 1e-30 to 1e30.
const MAX_ROUNDS: usize = 8;

/// Sets of at most this many bodies are decided separately, even if they contain more than half of all bodies. A set of
/// all bodies is never decided separately.
const MAX_SMALL_SET: usize = 12;

/// Forces are corrected only if the largest residual of a balance equation is at most this fraction of the largest
/// load.
const MAX_WHOLE_IMBALANCE: f64 = 1e-6;

/// The result of correcting forces that balance the component as a whole.
pub(super) enum RebalanceOutcome {
    /// The forces balance each body.
    Stands(Amounts, Proof),
    /// Some bodies fall while all others rest.
    Falls(FallingPart),
    /// Neither is proved.
    Undecided,
}

/// Bodies that fall while all others rest.
pub(super) struct FallingPart {
    /// The motion of every body of the component.
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    /// The forces on the resting bodies, and the admissible forces on the falling bodies, which act together with the
    /// adhesion.
    pub amounts: Amounts,
    /// The adhesion that the falling bodies lack; `None` if no adhesion can hold them or none was computed.
    pub adhesion: Option<Amounts>,
}

impl Component<'_> {
    /// Corrects forces until they balance every body, or proves that some bodies fall. Returns
    /// [`RebalanceOutcome::Undecided`] if neither succeeds.
    pub fn rebalance_locally(&self, program: &Program, amounts: &Amounts, effort: &mut Effort) -> RebalanceOutcome {
        let largest_load = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if amounts.unbalanced(program) > MAX_WHOLE_IMBALANCE * largest_load {
            return RebalanceOutcome::Undecided;
        }
        let mut amounts = amounts.clone();
        let failing = |proved: &ProvedForces| -> Vec<bool> {
            let imbalance = proof::imbalances(self.assembly, &proved.forces);
            imbalance.iter().map(|imbalance| *imbalance > self.threshold.imbalance).collect()
        };
        let count = |fails: &[bool]| fails.iter().filter(|fails| **fails).count();
        let mut all_at_once = true;
        for _ in 0..MAX_ROUNDS {
            let proved = self.prove_forces(&amounts);
            if self.accepts(&proved.proof) {
                return RebalanceOutcome::Stands(amounts, proved.proof);
            }
            if is_late() {
                break;
            }
            let fails = failing(&proved);
            // Step 1: change each force by a small fraction of itself.
            if let Some(improved) = rebalance_relative(program, &amounts, effort)
                && count(&failing(&self.prove_forces(&improved))) < count(&fails)
            {
                amounts = improved;
                continue;
            }
            // Step 2: change all forces as little as possible. If this fails once, do not try it again.
            if all_at_once {
                match rebalance_absolute(program, &amounts, effort) {
                    Some(improved) if count(&failing(&self.prove_forces(&improved))) < count(&fails) => {
                        amounts = improved;
                        continue;
                    }
                    _ => all_at_once = false,
                }
            }
            // Steps 3 and 4: correct or decide each connected set of unbalanced bodies separately.
            let sets = self.assembly.connected(&fails);
            let (falling, has_changed) = self.rebalance_sets(sets, &mut amounts, effort);
            if !falling.is_empty() {
                return self.combine_falling_parts(program, amounts, &falling);
            }
            if !has_changed {
                break;
            }
        }
        RebalanceOutcome::Undecided
    }

    /// Corrects the forces on each set of bodies, while all other bodies are fixed. Returns the sets that fall, and
    /// whether any force changed.
    fn rebalance_sets(
        &self,
        sets: Vec<Vec<usize>>,
        amounts: &mut Amounts,
        effort: &mut Effort,
    ) -> (Vec<(Substructure, PartFall)>, bool) {
        let mut falling = Vec::new();
        let mut has_changed = false;
        for set in sets {
            let part = self.assembly.substructure(&set);
            match self.rebalance_part(&part, amounts, effort) {
                PartOutcome::Changed(changed) => {
                    self.insert_part(amounts, &part, &changed);
                    has_changed = true;
                }
                PartOutcome::Falls(found) => falling.push((part, found)),
                PartOutcome::Undecided => {}
            }
        }
        (falling, has_changed)
    }

    /// Corrects the forces on one set of bodies, while all other bodies are fixed. If this fails, decides whether the
    /// set falls.
    fn rebalance_part(&self, part: &Substructure, amounts: &Amounts, effort: &mut Effort) -> PartOutcome {
        let component = Component {
            assembly: &part.assembly,
            scale: Scale::from_assembly(&part.assembly),
            settings: self.settings.clone(),
            threshold: self.threshold,
            complete_result: self.complete_result,
            limit_distance: LimitDistance::Unknown,
        };
        // Loads near the smallest floating-point numbers cannot be scaled, so leave this set undecided.
        let ratio = self.scale.force / component.scale.force;
        if !component.scale.force.is_normal() || !ratio.is_normal() {
            return PartOutcome::Undecided;
        }
        let program = Program::new(&part.assembly, component.scale);
        let part_amounts_before = self.part_amounts(amounts, part, component.scale);
        let imbalance = |amounts: &Amounts| {
            let imbalance = proof::imbalances(&part.assembly, &component.prove_forces(amounts).forces);
            imbalance.into_iter().fold(0.0, f64::max)
        };
        if let Some(improved) = rebalance_absolute(&program, &part_amounts_before, effort)
            && imbalance(&improved) < 0.5 * imbalance(&part_amounts_before)
        {
            return PartOutcome::Changed(in_units(&improved, component.scale, self.scale));
        }
        // Do not decide a part that contains all bodies, or a large part that contains more than half of them. This
        // would take about as long as deciding the whole component, which is already in progress.
        let (part_count, body_count) = (part.bodies.len(), self.assembly.bodies.len());
        if part_count == body_count || (part_count > MAX_SMALL_SET && 2 * part_count > body_count) {
            return PartOutcome::Undecided;
        }
        if let Some(found) = component.in_closed_form(&program) {
            return match found.verdict {
                Verdict::Unstable => {
                    PartOutcome::Falls(PartFall { mechanism: found.mechanism, amounts: None, adhesion: None })
                }
                _ => PartOutcome::Undecided,
            };
        }
        let decision = component.complete(&program, component.decide_by_programs(&program));
        *effort = effort.plus(decision.effort);
        let in_whole_units = |amounts: &Amounts| in_units(amounts, component.scale, self.scale);
        match decision.verdict {
            Verdict::Stable => PartOutcome::Changed(in_whole_units(&decision.amounts)),
            Verdict::Unstable => PartOutcome::Falls(PartFall {
                amounts: Some(in_whole_units(&decision.amounts)),
                adhesion: decision.adhesion.as_ref().map(in_whole_units),
                mechanism: decision.mechanism,
            }),
            Verdict::Undecided => PartOutcome::Undecided,
        }
    }

    /// Combines the motions of the falling parts into one motion, in which all other bodies are at rest, and proves it
    /// for the whole component. Returns [`RebalanceOutcome::Undecided`] if the proof is too weak.
    fn combine_falling_parts(
        &self,
        program: &Program,
        mut amounts: Amounts,
        falling: &[(Substructure, PartFall)],
    ) -> RebalanceOutcome {
        let mut mechanism: Vec<Motion> = self
            .assembly
            .bodies
            .iter()
            .map(|body| Motion { block: body.block, velocity: Vector::zeros(), spin: 0.0 })
            .collect();
        let mut adhesion = Some(Amounts::zero(program));
        for (part, fall) in falling {
            for (body, motion) in part.bodies.iter().zip(&fall.mechanism) {
                mechanism[*body] = *motion;
            }
            if let Some(held) = &fall.amounts {
                self.insert_part(&mut amounts, part, held);
            }
            match (&mut adhesion, &fall.adhesion) {
                (Some(adhesion), Some(missing)) => self.insert_part(adhesion, part, missing),
                _ => adhesion = None,
            }
        }
        let proof = self.check_mechanism(&mechanism);
        if !self.accepts_motion(&mechanism, &proof) {
            return RebalanceOutcome::Undecided;
        }
        RebalanceOutcome::Falls(FallingPart { mechanism, proof, amounts, adhesion })
    }

    /// Selects the forces that act on a part, and converts them to the units of `scale`.
    fn part_amounts(&self, amounts: &Amounts, part: &Substructure, scale: Scale) -> Amounts {
        let part_amounts = Amounts {
            normal: part.contacts.iter().map(|k| amounts.normal[*k]).collect(),
            friction: part.contacts.iter().map(|k| amounts.friction[*k]).collect(),
            grip: part.grips.iter().map(|k| amounts.grip[*k]).collect(),
        };
        in_units(&part_amounts, self.scale, scale)
    }

    /// Replaces the forces on a part by `part_amounts`. All forces are in the units of the whole component.
    fn insert_part(&self, amounts: &mut Amounts, part: &Substructure, part_amounts: &Amounts) {
        for (position, number) in part.contacts.iter().enumerate() {
            amounts.normal[*number] = part_amounts.normal[position];
            amounts.friction[*number] = part_amounts.friction[position];
        }
        for (position, number) in part.grips.iter().enumerate() {
            amounts.grip[*number] = part_amounts.grip[position];
        }
    }
}

/// The result for a part. Forces are in the units of the whole component.
enum PartOutcome {
    Changed(Amounts),
    Falls(PartFall),
    Undecided,
}

/// A part that falls. Forces and adhesion are in the units of the whole component; `None` if they were not computed.
struct PartFall {
    /// One motion for each body of the part.
    mechanism: Vec<Motion>,
    amounts: Option<Amounts>,
    adhesion: Option<Amounts>,
}

/// Converts forces from the units of one scale to those of another.
fn in_units(amounts: &Amounts, from: Scale, to: Scale) -> Amounts {
    let force = from.force / to.force;
    let torque = force * from.length / to.length;
    Amounts {
        normal: amounts.normal.iter().map(|pair| pair.map(|v| v * force)).collect(),
        friction: amounts.friction.iter().map(|v| v * force).collect(),
        grip: amounts.grip.iter().map(|[x, y, m]| [x * force, y * force, m * torque]).collect(),
    }
}
