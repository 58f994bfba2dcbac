//! One group of blocks, from its program to a proved verdict in the scene's units.
//!
//! The order of trust: forces from a closed form, forces from the hard program, a motion from the hard program, and last
//! the least-sticking program, whose optimum is the physical residual and decides near the edge. Each is believed only
//! with its proof. Where both proofs hold, the forces win.

mod failure;
mod question;

pub(super) use question::{judged, only_by_wedging};

use super::{Failure, Options, Verdict};
use crate::effect::{Plan, Situation};
use crate::geometry::Vector;
use crate::interface::Interface;
use crate::program::{Group, Program, Scale, assemble, load_on};
use crate::proof::{self, Demand, Held, Motion, Pressed, Proof, Yardstick};
use crate::scene::{BodyId, Frame, Scene};
use crate::solve::{
    Amounts, Choice, Effort, Manner, balance_in, leftover, opened, single, stick_in,
};

/// What was found out about one group, forces in the order of its interfaces and holds.
#[derive(Clone, Debug)]
pub(super) struct Findings {
    pub verdict: Verdict,
    pub doubt: String,
    /// N1, N2 and T per interface, N.
    pub contacts: Vec<([f64; 2], f64)>,
    /// Force and torque per hold.
    pub grips: Vec<(Vector, f64)>,
    pub failures: Vec<Failure>,
    pub total_sticking: f64,
    pub unsupported: bool,
    pub mechanism: Vec<Motion>,
    pub proof: Proof,
    pub effort: Effort,
}

/// Everything one group is judged by.
struct Case<'a> {
    scene: &'a Scene,
    frame: &'a Frame,
    interfaces: &'a [&'a Interface],
    group: &'a Group,
    yardstick: Yardstick,
    scale: Scale,
    manners: Vec<Manner>,
    demand: Demand,
}

/// Forces in newtons with their proof.
struct Carried {
    contacts: Vec<([f64; 2], f64)>,
    grips: Vec<(Vector, f64)>,
    proof: Proof,
}

/// Solves one group and proves its verdict.
pub(super) fn solved(
    situation: &Situation,
    plan: &Plan,
    group: &Group,
    length: f64,
    options: Options,
) -> Findings {
    let (scene, frame, interfaces) = (situation.scene, situation.frame, situation.interfaces);
    let case = Case::of(scene, frame, interfaces, plan, group, length, options);
    let program = assemble(scene, frame, interfaces, plan, group, case.scale);
    if let Some(found) = case.at_once(&program, plan) {
        return found;
    }
    // Limits that can hardly matter are left out first; where they do matter after all, everything is done again.
    if let Some(generous) = program.without_lavish_limits() {
        let judged = case.judged(&generous);
        if judged.verdict != Verdict::Undecided && program.allows(&judged.amounts.grip) {
            return judged.findings(&case);
        }
    }
    case.judged(&program).findings(&case)
}

/// A judgement in the program's pure numbers.
struct Judged {
    verdict: Verdict,
    doubt: String,
    program: Program,
    amounts: Amounts,
    sticking: Option<Amounts>,
    /// No sticking could hold it.
    hopeless: bool,
    mechanism: Vec<Motion>,
    proof: Proof,
    effort: Effort,
}

/// The heaviest load of a group, N: a force, a moment over L, or a weight.
pub(super) fn heaviest(scene: &Scene, plan: &Plan, group: &Group, length: f64) -> f64 {
    let sizes = group.blocks.iter().map(|block| {
        let (force, moment) = load_on(scene, plan, *block);
        force
            .norm()
            .max(moment.abs() / length)
            .max(scene.blocks[block.0].weight)
    });
    sizes.fold(0.0, f64::max)
}

fn doubt(forces: &Proof, motion: Option<&Proof>) -> String {
    let forces = match forces {
        Proof::Forces {
            worst_imbalance, ..
        } => format!("forces are off by {worst_imbalance:.1e} of the heaviest load"),
        Proof::Mechanism { .. } => String::new(),
    };
    match motion {
        Some(Proof::Mechanism {
            power,
            worst_violation,
        }) => {
            format!(
                "{forces}; a motion has power {power:.1e} but violates a contact by {worst_violation:.1e}"
            )
        }
        _ => format!("{forces}; no motion was found"),
    }
}

impl Judged {
    fn findings(self, case: &Case) -> Findings {
        let carried = case.carried(&self.program, &self.amounts);
        let (mut failures, mut total_sticking) = (Vec::new(), 0.0);
        if let (Some(sticking), Verdict::Unstable) = (&self.sticking, self.verdict) {
            failures = case.failures(&self.program, sticking);
            total_sticking = sticking.total() * case.scale.force;
        }
        let mut mechanism = self.mechanism;
        // It was proved with every block; what only trembles is left out of what is told.
        mechanism.retain(|m| m.fastest(case.scene) > 1e-7);
        for motion in &mut mechanism {
            let plain = |v: f64| if v.abs() < 1e-9 { 0.0 } else { v };
            motion.velocity = motion.velocity.map(plain);
            motion.spin = if motion.spin.abs() * case.yardstick.length < 1e-9 {
                0.0
            } else {
                motion.spin
            };
        }
        Findings {
            verdict: self.verdict,
            doubt: self.doubt,
            contacts: carried.contacts,
            grips: carried.grips,
            total_sticking,
            unsupported: self.hopeless && self.verdict == Verdict::Unstable,
            failures,
            mechanism,
            proof: self.proof,
            effort: self.effort,
        }
    }
}

impl<'a> Case<'a> {
    /// A group in its own yardstick and scale.
    fn of(
        scene: &'a Scene,
        frame: &'a Frame,
        interfaces: &'a [&'a Interface],
        plan: &Plan,
        group: &'a Group,
        length: f64,
        options: Options,
    ) -> Case<'a> {
        let heaviest = heaviest(scene, plan, group, length);
        Case {
            scene,
            frame,
            interfaces,
            group,
            yardstick: Yardstick {
                force: if heaviest > 0.0 { heaviest } else { 1.0 },
                length,
            },
            scale: Scale::of(length, heaviest),
            manners: options.manners(),
            demand: options.accuracy.demand(),
        }
    }

    /// What can be answered without a program.
    fn at_once(&self, program: &Program, plan: &Plan) -> Option<Findings> {
        if heaviest(self.scene, plan, self.group, self.yardstick.length) == 0.0 {
            let carried = self.carried(program, &Amounts::none(program));
            return Some(self.stands(carried, Effort::default()));
        }
        if let Some(falls) = self.falls_free(plan) {
            return Some(falls);
        }
        let carried = self.carried(program, &single(program)?);
        self.believes(&carried.proof)
            .then(|| self.stands(carried, Effort::default()))
    }

    /// Whether a proved motion does more work than forces within the proof's band could take up.
    fn outweighs_the_band(&self, motion: &[Motion], proof: &Proof) -> bool {
        let ways: f64 = motion
            .iter()
            .map(|m| m.velocity.norm() + m.spin.abs() * self.yardstick.length)
            .sum();
        matches!(proof, Proof::Mechanism { power, .. } if *power > 2.0 * Proof::BAND * ways)
    }

    /// Solves a program and proves what comes out: quick first, with full care only where the quick answer has no proof.
    fn judged(&self, program: &Program) -> Judged {
        let mut judged = Judged {
            verdict: Verdict::Stable,
            doubt: String::new(),
            program: program.clone(),
            amounts: Amounts::none(program),
            sticking: None,
            hopeless: false,
            mechanism: Vec::new(),
            proof: Proof::Mechanism {
                power: 0.0,
                worst_violation: 0.0,
            },
            effort: Effort::default(),
        };
        // Forces that balance, but not those of least sum; a motion with its proof.
        let (mut carries, mut falls) = (None, None);
        for (round, manner) in self.manners.iter().enumerate() {
            let first = balance_in(program, *manner);
            judged.effort = judged.effort.and(first.effort);
            // Where the solver ended nowhere with full care it will not do better a second time.
            let nowhere = first.forces.is_none() && first.motion.is_none();
            if let Some(amounts) = first.forces {
                let proof = self.carried(program, &amounts).proof;
                if self.believes(&proof) {
                    return Judged {
                        amounts,
                        proof,
                        ..judged
                    };
                }
            }
            falls = first
                .motion
                .and_then(|y| self.falling(program, &y, &mut judged.effort));
            if falls.is_none()
                && round == 0
                && let Some(left) = leftover(program)
            {
                judged.effort = judged.effort.and(left.effort);
                let proof = self.carried(program, &left.forces).proof;
                if self.believes(&proof) {
                    carries = Some((left.forces, proof));
                } else {
                    falls = self.falling(program, &left.motion, &mut judged.effort);
                }
            }
            let enough = nowhere || manner.choice == Choice::Any;
            if falls.is_some() || (carries.is_some() && enough) {
                break;
            }
        }
        if let Some((amounts, proof)) = carries {
            return Judged {
                amounts,
                proof,
                ..judged
            };
        }
        let mut doubts = String::new();
        for manner in &self.manners {
            let stuck = stick_in(program, *manner);
            judged.effort = judged.effort.and(stuck.effort);
            let proof = self.carried(program, &stuck.forces).proof;
            if stuck.balanced == Some(true) && self.believes(&proof) {
                return Judged {
                    amounts: stuck.forces,
                    proof,
                    ..judged
                };
            }
            judged.amounts = stuck.forces;
            judged.sticking = (stuck.balanced == Some(true)).then_some(stuck.sticking);
            judged.hopeless = stuck.balanced == Some(false);
            let raw = stuck
                .motion
                .as_ref()
                .map(|y| self.mechanism(&self.moved(y).1));
            doubts = doubt(&proof, raw.as_ref());
            let own = stuck
                .motion
                .and_then(|y| self.falling(program, &y, &mut judged.effort));
            // At a price the motion trespasses: then one from elsewhere is shown, if there is one.
            let shown = if stuck.priced {
                falls.clone().or(own)
            } else {
                own.or_else(|| falls.clone())
            };
            if let Some((mechanism, proof)) = shown {
                return Judged {
                    verdict: Verdict::Unstable,
                    mechanism,
                    proof,
                    ..judged
                };
            }
            judged.proof = proof;
        }
        Judged {
            verdict: Verdict::Undecided,
            doubt: doubts,
            ..judged
        }
    }

    /// The motion near a given one, freed from the solver's error, with its proof if that convinces.
    ///
    /// A violation is believed to be rounding only after the change: one of the solver's, however small, may be what the
    /// motion of a wedge into its notch lives on.
    fn falling(
        &self,
        program: &Program,
        y: &[f64],
        effort: &mut Effort,
    ) -> Option<(Vec<Motion>, Proof)> {
        let (fastest, mut motion) = self.moved(y);
        let mut proof = self.mechanism(&motion);
        if motion.is_empty() {
            return None;
        }
        if proof.rules_out().is_finite() {
            let unit: Vec<f64> = y.iter().map(|v| v / fastest).collect();
            (_, motion) = self.moved(&opened(program, &unit, effort)?);
            proof = self.mechanism(&motion);
        }
        self.believes(&proof).then_some((motion, proof))
    }

    fn believes(&self, proof: &Proof) -> bool {
        proof.meets(self.demand)
    }

    fn touching(&self) -> Vec<&Interface> {
        self.group
            .interfaces
            .iter()
            .map(|i| self.interfaces[*i])
            .collect()
    }

    fn mechanism(&self, motion: &[Motion]) -> Proof {
        proof::mechanism(
            self.scene,
            self.frame,
            motion,
            &self.touching(),
            self.yardstick,
        )
    }

    /// Newtons from pure numbers, made admissible to the last bit, with their proof.
    ///
    /// Noise below 1e-13 of the heaviest load (of friction: 1e-10 of N or μN, and never more than a tenth of the band)
    /// becomes 0 and friction is cut to μN, so that what is left of the solver's error shows as imbalance alone, where
    /// the proof measures it.
    fn carried(&self, program: &Program, amounts: &Amounts) -> Carried {
        let unit = self.scale.force;
        let noise = 1e-13 * self.yardstick.force;
        let clean = |v: f64| if v.abs() <= noise { 0.0 } else { v };
        let mut contacts = Vec::with_capacity(program.contacts.len());
        for (k, contact) in program.contacts.iter().enumerate() {
            let normal = amounts.normal[k].map(|v| clean(v * unit).max(0.0));
            let most = contact.friction * (normal[0] + normal[1]);
            let friction = (amounts.friction[k] * unit).clamp(-most, most);
            let still = (1e-10 * most.min(normal[0] + normal[1]))
                .min(0.1 * Proof::BAND * self.yardstick.force);
            contacts.push((
                normal,
                if friction.abs() <= still {
                    0.0
                } else {
                    friction
                },
            ));
        }
        let mut grips = Vec::with_capacity(program.grips.len());
        for (k, grip) in program.grips.iter().enumerate() {
            let limits = self.scene.robots[self.frame.holds[grip.hold].robot.0].limits;
            let [x, y, m] = amounts.grip[k];
            let cut = |v: f64, limit: f64| clean(v).clamp(-limit, limit);
            let force = Vector::new(cut(x * unit, limits.fx), cut(y * unit, limits.fy));
            grips.push((
                force,
                cut(m * unit, limits.torque / self.scale.length) * self.scale.length,
            ));
        }
        let pressed: Vec<Pressed> = self
            .touching()
            .into_iter()
            .zip(&contacts)
            .map(|(interface, (normal, friction))| Pressed {
                interface,
                normal: *normal,
                friction: *friction,
            })
            .collect();
        let held: Vec<Held> = self
            .group
            .holds
            .iter()
            .zip(&grips)
            .map(|(hold, (force, torque))| Held {
                hold: *hold,
                force: *force,
                torque: *torque,
            })
            .collect();
        let proof = proof::forces(
            self.scene,
            self.frame,
            &self.group.blocks,
            &pressed,
            &held,
            self.yardstick,
        );
        Carried {
            contacts,
            grips,
            proof,
        }
    }

    fn stands(&self, carried: Carried, effort: Effort) -> Findings {
        let holds = self.believes(&carried.proof);
        Findings {
            verdict: if holds {
                Verdict::Stable
            } else {
                Verdict::Undecided
            },
            doubt: if holds {
                String::new()
            } else {
                doubt(&carried.proof, None)
            },
            contacts: carried.contacts,
            grips: carried.grips,
            failures: Vec::new(),
            total_sticking: 0.0,
            unsupported: false,
            mechanism: Vec::new(),
            proof: carried.proof,
            effort,
        }
    }

    /// A group that touches no ground and is held by nobody falls with the sum of its loads, all blocks alike.
    fn falls_free(&self, plan: &Plan) -> Option<Findings> {
        let grounded = self
            .touching()
            .iter()
            .any(|i| matches!(i.bodies[1], BodyId::Ground(_)));
        if grounded || !self.group.holds.is_empty() {
            return None;
        }
        let total = self.group.blocks.iter().fold(Vector::zeros(), |sum, b| {
            sum + load_on(self.scene, plan, *b).0
        });
        if total.norm() <= Proof::BAND * self.yardstick.force {
            return None;
        }
        let velocity = total.normalize();
        let mechanism: Vec<Motion> = self
            .group
            .blocks
            .iter()
            .map(|block| Motion {
                block: *block,
                velocity,
                spin: 0.0,
            })
            .collect();
        let proof = proof::mechanism(
            self.scene,
            self.frame,
            &mechanism,
            &self.touching(),
            self.yardstick,
        );
        Some(Findings {
            verdict: Verdict::Unstable,
            doubt: String::new(),
            contacts: vec![([0.0; 2], 0.0); self.group.interfaces.len()],
            grips: Vec::new(),
            failures: Vec::new(),
            total_sticking: 0.0,
            unsupported: true,
            mechanism,
            proof,
            effort: Effort::default(),
        })
    }

    /// The speed of the fastest point in pure numbers, and motions in the scene's units, that point with speed 1.
    fn moved(&self, y: &[f64]) -> (f64, Vec<Motion>) {
        let all = self
            .group
            .blocks
            .iter()
            .enumerate()
            .map(|(k, block)| Motion {
                block: *block,
                velocity: Vector::new(y[3 * k], y[3 * k + 1]),
                // Pure velocities are per unit of length.
                spin: y[3 * k + 2] / self.scale.length,
            });
        let all: Vec<Motion> = all.collect();
        let fastest = all
            .iter()
            .map(|m| m.fastest(self.scene))
            .fold(0.0, f64::max);
        if fastest == 0.0 {
            return (0.0, Vec::new());
        }
        let moved = all.iter().map(|m| Motion {
            block: m.block,
            velocity: m.velocity / fastest,
            spin: m.spin / fastest,
        });
        (fastest, moved.collect())
    }
}
