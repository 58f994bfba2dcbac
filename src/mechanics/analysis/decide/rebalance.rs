//! Route 3a: corrects forces that balance the structure as a whole but leave light bodies unbalanced. If this fails, it
//! tries to prove that some of these bodies fall.
//!
//! A solver's error is a small fraction of the heaviest load. On a light body this error may exceed its own weight
//! and hide that it falls. Each round does the first of these steps that helps:
//!
//! 1. Change all forces by small parts of their own amounts ([`rebalance_relative`]).
//! 2. Make the least change of all forces ([`rebalance_absolute`]). It can add forces that were 0, such as that of a
//!    robot.
//! 3. For each connected set of unbalanced bodies, hold all other bodies still, as if they were ground. Make the
//!    least change of the forces on the set, in its own scale ([`rebalance_absolute`]).
//! 4. If there is no such change, decide the set like a component. If it falls, the whole falls: the motion of the set
//!    with all other bodies at rest is a mechanism. If it stands, its forces replace the old ones.
//!
//! Each round balances lighter bodies. Unbalanced sets within a set are treated in the same way.

use super::forces::ProvedForces;
use super::{Component, Place};
use crate::analysis::Verdict;
use crate::assembly::Substructure;
use crate::geometry::Vector;
use crate::program::{Program, Scale};
use crate::proof::{self, Motion, Proof};
use crate::solve::{Amounts, Effort, is_late, rebalance_absolute, rebalance_relative};

/// The number of rounds of correction. Each gains the digits of one solution; eight rounds cover weights from 1e-30
/// to 1e30.
const MAX_ROUNDS: usize = 8;

/// Sets of at most this many bodies are decided on their own, even if they are nearly the whole component.
const MAX_SMALL_SET: usize = 12;

/// Forces that leave more than this part of the heaviest load unbalanced do not balance the whole, and are not
/// corrected.
const MAX_WHOLE_IMBALANCE: f64 = 1e-6;

/// The result of correcting forces that balance the whole.
pub(super) enum Outcome {
    /// The forces balance each body.
    Stands(Amounts, Proof),
    /// Some bodies fall by themselves.
    Falls(FallingPart),
    /// Neither is proved.
    Open,
}

/// Bodies that fall while all others rest.
pub(super) struct FallingPart {
    /// The motion of every body of the whole.
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    /// The forces on the resting bodies, and the admissible forces on the falling bodies, which act together with the
    /// adhesion.
    pub amounts: Amounts,
    /// The adhesion that the falling bodies lack; `None` if no adhesion can hold them.
    pub adhesion: Option<Amounts>,
}

impl Component<'_> {
    /// Corrects forces until they balance every body, or proves that some bodies fall. Returns [`Outcome::Open`] if
    /// neither succeeds.
    pub fn rebalance_locally(
        &self,
        program: &Program,
        amounts: &Amounts,
        effort: &mut Effort,
    ) -> Outcome {
        let most = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if amounts.unbalanced(program) > MAX_WHOLE_IMBALANCE * most {
            return Outcome::Open;
        }
        let mut amounts = amounts.clone();
        let failing = |carried: &ProvedForces| -> Vec<bool> {
            let off = proof::imbalances(self.assembly, &carried.forces);
            off.iter().map(|off| *off > self.demand.imbalance).collect()
        };
        let count = |fails: &[bool]| fails.iter().filter(|fails| **fails).count();
        let mut all_at_once = true;
        for _ in 0..MAX_ROUNDS {
            let carried = self.prove_forces(&amounts);
            if self.believes(&carried.proof) {
                return Outcome::Stands(amounts, carried.proof);
            }
            if is_late() {
                break;
            }
            let fails = failing(&carried);
            // Step 1: change each force by a small fraction of itself.
            if let Some(better) = rebalance_relative(program, &amounts, effort)
                && count(&failing(&self.prove_forces(&better))) < count(&fails)
            {
                amounts = better;
                continue;
            }
            // Step 2: change all forces as little as possible. If this fails once, do not try it again.
            if all_at_once {
                match rebalance_absolute(program, &amounts, effort) {
                    Some(better)
                        if count(&failing(&self.prove_forces(&better))) < count(&fails) =>
                    {
                        amounts = better;
                        continue;
                    }
                    _ => all_at_once = false,
                }
            }
            // Steps 3 and 4: correct or decide each connected set of unbalanced bodies separately.
            let sets = self.assembly.connected(&fails);
            let (falling, is_better) = self.rebalance_sets(sets, &mut amounts, effort);
            if !falling.is_empty() {
                return self.combine_falling_parts(program, amounts, &falling);
            }
            if !is_better {
                break;
            }
        }
        Outcome::Open
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
        let mut is_better = false;
        for set in sets {
            let part = self.assembly.substructure(&set);
            match self.rebalance_part(&part, amounts, effort) {
                PartOutcome::Changed(changed) => {
                    self.insert_part(amounts, &part, &changed);
                    is_better = true;
                }
                PartOutcome::Falls(found) => falling.push((part, found)),
                PartOutcome::Open => {}
            }
        }
        (falling, is_better)
    }

    /// Corrects the forces on one set of bodies, while all other bodies are fixed. If this fails, decides whether the
    /// set falls.
    fn rebalance_part(
        &self,
        part: &Substructure,
        amounts: &Amounts,
        effort: &mut Effort,
    ) -> PartOutcome {
        let component = Component {
            assembly: &part.assembly,
            scale: Scale::from_assembly(&part.assembly),
            settings: self.settings.clone(),
            demand: self.demand,
            complete_result: self.complete_result,
            place: Place::Anywhere,
        };
        // Loads near the smallest floating-point numbers cannot be scaled, so leave this set undecided.
        let ratio = self.scale.force / component.scale.force;
        if !component.scale.force.is_normal() || !ratio.is_normal() {
            return PartOutcome::Open;
        }
        let program = Program::new(&part.assembly, component.scale);
        let given = self.part_amounts(amounts, part, component.scale);
        let off = |amounts: &Amounts| {
            let off = proof::imbalances(&part.assembly, &component.prove_forces(amounts).forces);
            off.into_iter().fold(0.0, f64::max)
        };
        if let Some(better) = rebalance_absolute(&program, &given, effort)
            && off(&better) < 0.5 * off(&given)
        {
            return PartOutcome::Changed(in_units(&better, component.scale, self.scale));
        }
        // Do not decide a part that contains nearly all bodies: it would take as long as the whole component, which is
        // already being decided.
        let (own, all) = (part.bodies.len(), self.assembly.bodies.len());
        if own == all || (own > MAX_SMALL_SET && 2 * own > all) {
            return PartOutcome::Open;
        }
        if let Some(found) = component.in_closed_form(&program) {
            return match found.verdict {
                Verdict::Unstable => PartOutcome::Falls(PartFall {
                    mechanism: found.mechanism,
                    amounts: None,
                    adhesion: None,
                }),
                _ => PartOutcome::Open,
            };
        }
        let decision = component.complete(&program, component.decide_by_programs(&program));
        *effort = effort.plus(decision.effort);
        let whole = |amounts: &Amounts| in_units(amounts, component.scale, self.scale);
        match decision.verdict {
            Verdict::Stable => PartOutcome::Changed(whole(&decision.amounts)),
            Verdict::Unstable => PartOutcome::Falls(PartFall {
                amounts: Some(whole(&decision.amounts)),
                adhesion: decision.adhesion.as_ref().map(whole),
                mechanism: decision.mechanism,
            }),
            Verdict::Undecided => PartOutcome::Open,
        }
    }

    /// Combines the motions of the falling parts into one motion, in which all other bodies are at rest, and proves it
    /// for the whole component. Returns [`Outcome::Open`] if the proof is too weak.
    fn combine_falling_parts(
        &self,
        program: &Program,
        mut amounts: Amounts,
        falling: &[(Substructure, PartFall)],
    ) -> Outcome {
        let mut mechanism: Vec<Motion> = self
            .assembly
            .bodies
            .iter()
            .map(|body| Motion {
                block: body.block,
                velocity: Vector::zeros(),
                spin: 0.0,
            })
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
                (Some(adhesion), Some(own)) => self.insert_part(adhesion, part, own),
                _ => adhesion = None,
            }
        }
        let proof = self.mechanism(&mechanism);
        if !self.convinces(&mechanism, &proof) {
            return Outcome::Open;
        }
        Outcome::Falls(FallingPart {
            mechanism,
            proof,
            amounts,
            adhesion,
        })
    }

    /// Selects the forces that act on a part, and converts them to the units of `scale`.
    fn part_amounts(&self, amounts: &Amounts, part: &Substructure, scale: Scale) -> Amounts {
        let own = Amounts {
            normal: part.contacts.iter().map(|k| amounts.normal[*k]).collect(),
            friction: part.contacts.iter().map(|k| amounts.friction[*k]).collect(),
            grip: part.grips.iter().map(|k| amounts.grip[*k]).collect(),
        };
        in_units(&own, self.scale, scale)
    }

    /// Replaces the forces on a part by `own`. All forces are in the units of the whole component.
    fn insert_part(&self, amounts: &mut Amounts, part: &Substructure, own: &Amounts) {
        for (place, number) in part.contacts.iter().enumerate() {
            amounts.normal[*number] = own.normal[place];
            amounts.friction[*number] = own.friction[place];
        }
        for (place, number) in part.grips.iter().enumerate() {
            amounts.grip[*number] = own.grip[place];
        }
    }
}

/// The result for a part, in the units of the whole.
enum PartOutcome {
    Changed(Amounts),
    Falls(PartFall),
    Open,
}

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
        normal: amounts
            .normal
            .iter()
            .map(|pair| pair.map(|v| v * force))
            .collect(),
        friction: amounts.friction.iter().map(|v| v * force).collect(),
        grip: amounts
            .grip
            .iter()
            .map(|[x, y, m]| [x * force, y * force, m * torque])
            .collect(),
    }
}
