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
use super::{Component, LimitDistance, Outcome};
use crate::geometry::Vector;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::{self, Motion};
use crate::mechanics::solve::{Amounts, Effort, is_late, rebalance_absolute, rebalance_relative};
use crate::mechanics::statics::assembly::Substructure;

/// The largest number of rounds of correction. Each round gains as many accurate digits as one solution has; eight
/// rounds cover weights from 1e-30 to 1e30.
pub(super) const MAX_ROUNDS: usize = 8;

/// Sets of at most this many bodies are decided separately, even if they contain more than half of all bodies. A set of
/// all bodies is never decided separately.
const MAX_SMALL_SET: usize = 12;

/// Forces are corrected only if the largest residual of a balance equation is at most this fraction of the largest
/// load.
const MAX_WHOLE_IMBALANCE: f64 = 1e-6;

/// The result of correcting forces that balance a component as a whole, or of correcting the forces on a part.
pub(super) enum Rebalanced {
    /// Corrected forces. For a component they balance each body.
    Forces(ProvedForces),
    /// Some bodies fall while all others rest. The outcome has their mechanism, and if they are known, their missing
    /// adhesion and the forces that act together with it.
    Falls(Box<Outcome>),
}

impl Component<'_> {
    /// Returns forces with a proof that they balance every body: the given forces, if they do, otherwise corrected
    /// forces. Or proves that some bodies fall. `None` if neither succeeds.
    pub fn balance_every_body(&self, program: &Program, amounts: &Amounts, effort: &mut Effort) -> Option<Rebalanced> {
        let mut proved = self.prove_forces(amounts.clone());
        if self.accepts(&proved.proof) {
            return Some(Rebalanced::Forces(proved));
        }
        let largest_load = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if amounts.unbalanced(program) > MAX_WHOLE_IMBALANCE * largest_load {
            return None;
        }
        let count = |proved: &ProvedForces| self.unbalanced(&proved.forces).iter().filter(|fails| **fails).count();
        let mut all_at_once = true;
        for _ in 0..MAX_ROUNDS {
            if is_late() {
                return None;
            }
            let improved = |amounts: Option<Amounts>| {
                amounts.map(|amounts| self.prove_forces(amounts)).filter(|improved| count(improved) < count(&proved))
            };
            // Step 1: change each force by a small fraction of itself.
            let mut better = improved(rebalance_relative(program, &proved.amounts, effort));
            // Step 2: change all forces as little as possible. If this fails once, do not try it again.
            if better.is_none() && all_at_once {
                better = improved(rebalance_absolute(program, &proved.amounts, effort));
                all_at_once = better.is_some();
            }
            // Steps 3 and 4: correct or decide each connected set of unbalanced bodies separately.
            if better.is_none() {
                let sets = self.assembly.connected(&self.unbalanced(&proved.forces));
                let mut amounts = proved.amounts.clone();
                let (falling, has_changed) = self.rebalance_sets(sets, &mut amounts, effort);
                if !falling.is_empty() {
                    return self.combine_falling_parts(program, amounts, falling);
                }
                better = has_changed.then(|| self.prove_forces(amounts));
            }
            proved = better?;
            if self.accepts(&proved.proof) {
                return Some(Rebalanced::Forces(proved));
            }
        }
        None
    }

    /// Corrects the forces on each set of bodies, while all other bodies are fixed. Returns the sets that fall, and
    /// whether any force changed.
    pub(super) fn rebalance_sets(
        &self,
        sets: Vec<Vec<usize>>,
        amounts: &mut Amounts,
        effort: &mut Effort,
    ) -> (Vec<(Substructure, Outcome)>, bool) {
        let mut falling = Vec::new();
        let mut has_changed = false;
        for set in sets {
            let part = self.assembly.substructure(&set);
            match self.rebalance_part(&part, amounts, effort) {
                Some(Rebalanced::Forces(changed)) => {
                    self.insert_part(amounts, &part, &changed.amounts);
                    has_changed = true;
                }
                Some(Rebalanced::Falls(found)) => falling.push((part, *found)),
                None => {}
            }
        }
        (falling, has_changed)
    }

    /// Corrects the forces on one set of bodies, while all other bodies are fixed. If this fails, decides whether the
    /// set falls. The amounts of the result are in the units of the whole component.
    fn rebalance_part(&self, part: &Substructure, amounts: &Amounts, effort: &mut Effort) -> Option<Rebalanced> {
        let component = Component {
            assembly: &part.assembly,
            scale: Scale::from_assembly(&part.assembly),
            settings: self.settings,
            threshold: self.threshold,
            limit_distance: LimitDistance::Unknown,
        };
        // Loads near the smallest floating-point numbers cannot be scaled, so leave this set undecided.
        let ratio = self.scale.force / component.scale.force;
        if !component.scale.force.is_normal() || !ratio.is_normal() {
            return None;
        }
        let program = Program::new(&part.assembly, component.scale);
        let in_whole_units = |amounts: &Amounts| in_units(amounts, component.scale, self.scale);
        let changed = |proved: ProvedForces| {
            Some(Rebalanced::Forces(ProvedForces { amounts: in_whole_units(&proved.amounts), ..proved }))
        };
        let before = component.prove_forces(self.part_amounts(amounts, part, component.scale));
        let imbalance =
            |proved: &ProvedForces| proof::imbalances(&part.assembly, &proved.forces).into_iter().fold(0.0, f64::max);
        if let Some(improved) = rebalance_absolute(&program, &before.amounts, effort) {
            let improved = component.prove_forces(improved);
            if imbalance(&improved) < 0.5 * imbalance(&before) {
                return changed(improved);
            }
        }
        // Do not decide a part that contains all bodies, or a large part that contains more than half of them. This
        // would take about as long as deciding the whole component, which is already in progress.
        let (part_count, body_count) = (part.bodies.len(), self.assembly.bodies.len());
        if part_count == body_count || (part_count > MAX_SMALL_SET && 2 * part_count > body_count) {
            return None;
        }
        let mut outcome = component
            .in_closed_form(&program)
            .unwrap_or_else(|| component.complete(&program, component.decide_by_programs(&program)));
        *effort = effort.plus(outcome.effort);
        match outcome.verdict {
            Verdict::Stable => {
                changed(ProvedForces { amounts: outcome.amounts, forces: outcome.forces, proof: outcome.proof })
            }
            Verdict::Unstable => {
                outcome.amounts = in_whole_units(&outcome.amounts);
                outcome.adhesion = outcome.adhesion.as_ref().map(in_whole_units);
                Some(Rebalanced::Falls(Box::new(outcome)))
            }
            Verdict::Undecided => None,
        }
    }

    /// Combines the motions of the falling parts into one motion, in which all other bodies are at rest, and proves it
    /// for the whole component. `None` if the proof is too weak.
    fn combine_falling_parts(
        &self,
        program: &Program,
        amounts: Amounts,
        falling: Vec<(Substructure, Outcome)>,
    ) -> Option<Rebalanced> {
        let bodies = self.assembly.bodies.iter();
        let mut mechanism: Vec<Motion> =
            bodies.map(|body| Motion { block: body.block, velocity: Vector::zeros(), spin: 0.0 }).collect();
        let mut outcome = Outcome { amounts, ..Outcome::undecided(self.assembly, program) };
        let mut adhesion = Some(Amounts::zero(program));
        for (part, fall) in &falling {
            for (body, motion) in part.bodies.iter().zip(&fall.mechanism) {
                mechanism[*body] = *motion;
            }
            self.insert_part(&mut outcome.amounts, part, &fall.amounts);
            match (&mut adhesion, &fall.adhesion) {
                (Some(adhesion), Some(missing)) => self.insert_part(adhesion, part, missing),
                _ => adhesion = None,
            }
        }
        let proof = self.check_mechanism(&mechanism);
        if !self.accepts_motion(&mechanism, &proof) {
            return None;
        }
        outcome.fall(mechanism, proof);
        outcome.adhesion = adhesion;
        Some(Rebalanced::Falls(Box::new(outcome)))
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
    pub(super) fn insert_part(&self, amounts: &mut Amounts, part: &Substructure, part_amounts: &Amounts) {
        for (position, number) in part.contacts.iter().enumerate() {
            amounts.normal[*number] = part_amounts.normal[position];
            amounts.friction[*number] = part_amounts.friction[position];
        }
        for (position, number) in part.grips.iter().enumerate() {
            amounts.grip[*number] = part_amounts.grip[position];
        }
    }
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
