//! Forces made good for every body for itself, or the motion of those that have none.
//!
//! A program balances its bodies to some digits of the heaviest load. Light bodies may be far off then, and what is off may
//! be all that would tell that they fall. So where forces balance the whole but not every body:
//!
//! 1. all forces are changed a little, each in parts of its own amount ([`relative`]);
//! 2. forces that are no parts of what there is, such as that of a robot which did not push so far, come in by the least
//!    change of all ([`corrected`]); a set alone would hand what it lacks to its neighbour, and get it back;
//! 3. of each connected set of bodies that still do not balance the others are held still, as if they were ground, and the
//!    forces on the set change as little as may be, in the set's own scale ([`corrected`]);
//! 4. where there is no such change, the ladder is climbed for the set alone. If it falls, so does the whole: its motion
//!    with all others at rest is a mechanism. If it stands, its forces take the place of the old ones.
//!
//! Each round brings bodies of smaller weight within the digits; sets within a set are treated alike.

use super::forces::ProvedForces;
use super::{Component, Place};
use crate::analysis::Verdict;
use crate::assembly::Substructure;
use crate::geometry::Vector;
use crate::program::{Program, Scale};
use crate::proof::{self, Motion, Proof};
use crate::solve::{Amounts, Effort, corrected, is_late, relative};

/// Rounds of making forces good.
const ROUNDS: usize = 8;

/// So many bodies are judged as a part, whatever the size of the whole.
const SMALL: usize = 12;

/// Forces that leave more than this of the heaviest load are no balance of the whole.
const WHOLE: f64 = 1e-6;

/// What becomes of forces that balance the whole.
pub(super) enum Outcome {
    /// They balance every body for itself.
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
    /// The forces of the others, and those that the sticking leaves to contacts and grips.
    pub amounts: Amounts,
    /// What would have to stick, where anything helps.
    pub sticking: Option<Amounts>,
}

impl Component<'_> {
    /// Makes forces good for every body for itself.
    pub fn rebalance_locally(&self, program: &Program, amounts: &Amounts, effort: &mut Effort) -> Outcome {
        let most = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if amounts.unbalanced(program) > WHOLE * most {
            return Outcome::Open;
        }
        let mut amounts = amounts.clone();
        let failing = |carried: &ProvedForces| -> Vec<bool> {
            let off = proof::imbalances(self.assembly, &carried.forces);
            off.iter().map(|off| *off > self.demand.imbalance).collect()
        };
        let count = |fails: &[bool]| fails.iter().filter(|fails| **fails).count();
        let mut all_at_once = true;
        for _ in 0..ROUNDS {
            let carried = self.prove_forces(&amounts);
            if self.believes(&carried.proof) {
                return Outcome::Stands(amounts, carried.proof);
            }
            if is_late() {
                break;
            }
            let fails = failing(&carried);
            if let Some(better) = relative(program, &amounts, effort)
                && count(&failing(&self.prove_forces(&better))) < count(&fails)
            {
                amounts = better;
                continue;
            }
            if all_at_once {
                match corrected(program, &amounts, effort) {
                    Some(better) if count(&failing(&self.prove_forces(&better))) < count(&fails) => {
                        amounts = better;
                        continue;
                    }
                    _ => all_at_once = false,
                }
            }
            let mut falling = Vec::new();
            let mut better = false;
            for set in self.assembly.connected(&fails) {
                let part = self.assembly.substructure(&set);
                match self.rebalance_part(&part, &amounts, effort) {
                    PartOutcome::Changed(changed) => {
                        self.insert_part(&mut amounts, &part, &changed);
                        better = true;
                    }
                    PartOutcome::Falls(found) => falling.push((part, found)),
                    PartOutcome::Open => {}
                }
            }
            if !falling.is_empty() {
                return self.combine_falling_parts(program, amounts, &falling);
            }
            if !better {
                break;
            }
        }
        Outcome::Open
    }

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
        // Loads near the smallest numbers there are have no scale of their own.
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
        if let Some(better) = corrected(&program, &given, effort)
            && off(&better) < 0.5 * off(&given)
        {
            return PartOutcome::Changed(in_units(&better, component.scale, self.scale));
        }
        // The whole is on the ladder already, and what is nearly the whole costs as much again.
        let (own, all) = (part.bodies.len(), self.assembly.bodies.len());
        if own == all || (own > SMALL && 2 * own > all) {
            return PartOutcome::Open;
        }
        if let Some(found) = component.in_closed_form(&program) {
            return match found.verdict {
                Verdict::Unstable => PartOutcome::Falls(PartFall {
                    mechanism: found.mechanism,
                    amounts: None,
                    sticking: None,
                }),
                _ => PartOutcome::Open,
            };
        }
        let decision = component.complete(&program, component.decide_by_programs(&program));
        *effort = effort.and(decision.effort);
        let whole = |amounts: &Amounts| in_units(amounts, component.scale, self.scale);
        match decision.verdict {
            Verdict::Stable => PartOutcome::Changed(whole(&decision.amounts)),
            Verdict::Unstable => PartOutcome::Falls(PartFall {
                amounts: Some(whole(&decision.amounts)),
                sticking: decision.sticking.as_ref().map(whole),
                mechanism: decision.mechanism,
            }),
            Verdict::Undecided => PartOutcome::Open,
        }
    }

    /// The fall of some parts while the others rest, with its proof in the whole.
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
        let mut sticking = Some(Amounts::none(program));
        for (part, fall) in falling {
            for (body, motion) in part.bodies.iter().zip(&fall.mechanism) {
                mechanism[*body] = *motion;
            }
            if let Some(held) = &fall.amounts {
                self.insert_part(&mut amounts, part, held);
            }
            match (&mut sticking, &fall.sticking) {
                (Some(sticking), Some(own)) => self.insert_part(sticking, part, own),
                _ => sticking = None,
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
            sticking,
        })
    }

    /// The forces of a part, in the units of its scale.
    fn part_amounts(&self, amounts: &Amounts, part: &Substructure, scale: Scale) -> Amounts {
        let own = Amounts {
            normal: part.contacts.iter().map(|k| amounts.normal[*k]).collect(),
            friction: part.contacts.iter().map(|k| amounts.friction[*k]).collect(),
            grip: part.grips.iter().map(|k| amounts.grip[*k]).collect(),
        };
        in_units(&own, self.scale, scale)
    }

    /// Enters the forces of a part, in the units of the whole.
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

/// What becomes of a part's forces, in the units of the whole.
enum PartOutcome {
    Changed(Amounts),
    Falls(PartFall),
    Open,
}

struct PartFall {
    /// One motion for each body of the part.
    mechanism: Vec<Motion>,
    amounts: Option<Amounts>,
    sticking: Option<Amounts>,
}

/// Amounts in the units of another scale.
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
