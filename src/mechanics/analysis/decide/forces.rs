//! Converts the forces of a solver to newtons, corrects rounding errors so that no limit is violated, and checks how
//! well the forces balance.
//!
//! Converts velocities from the solver to a motion in metres, removes the solver's error, and proves that no admissible
//! forces can stop this motion (route 3b).

use super::Component;
use crate::geometry::Vector;
use crate::mechanics::program::Program;
use crate::mechanics::proof::{self, ContactForces, Forces, GripForces, Motion, Proof, fastest, gross_load};
use crate::mechanics::solve::{Amounts, Effort, is_late, repair_motion};
use crate::mechanics::statics::assembly::{Assembly, LoadVector};

/// The reference for rounding noise. A force that is small relative to it is set to 0.
#[derive(Clone, Copy)]
enum Noise {
    /// Relative to the heaviest load of the component.
    OfTheWhole,
    /// Relative to the forces on each body. For a contact, the smaller limit of its two bodies applies.
    OfEachBody,
    /// No force is noise.
    None,
}

/// A sum of forces counts as the least if it exceeds its lower bound by at most this fraction.
const SUM_TOL: f64 = 1e-6;

/// Forces in program units and in newtons, with their proof.
#[derive(Clone)]
pub(super) struct ProvedForces {
    pub amounts: Amounts,
    pub forces: Forces,
    pub proof: Proof,
}

impl Component<'_> {
    /// Converts forces to newtons, makes them exactly admissible, and computes their proof: how well they balance each
    /// body.
    ///
    /// Noise is set to 0 and friction is limited to μN. The rest of the solver's error is then only an imbalance, which
    /// the proof measures. A force that is noise among heavy blocks may hold a light block. If the proof fails, fewer
    /// forces are therefore set to 0.
    pub fn prove_forces(&self, amounts: Amounts) -> ProvedForces {
        // Try again with fewer forces set to 0. If no attempt gives a proof, return the forces that balance the most
        // bodies.
        let mut best: Option<(usize, Forces, Proof)> = None;
        for noise in [Noise::OfTheWhole, Noise::OfEachBody, Noise::None] {
            let forces = self.in_newtons(&amounts, noise);
            let proof = proof::check_forces(self.assembly, &forces);
            // After the deadline return the first result.
            if self.accepts(&proof) || is_late() {
                return ProvedForces { amounts, forces, proof };
            }
            let unbalanced_count = self.unbalanced(&forces).iter().filter(|is_unbalanced| **is_unbalanced).count();
            if best.as_ref().is_none_or(|best| unbalanced_count < best.0) {
                best = Some((unbalanced_count, forces, proof));
            }
        }
        match best {
            Some((_, forces, proof)) => ProvedForces { amounts, forces, proof },
            None => {
                let forces = Forces::zero(self.assembly);
                let proof = proof::check_forces(self.assembly, &forces);
                ProvedForces { amounts, forces, proof }
            }
        }
    }

    /// Returns, for each body, whether the forces leave it unbalanced by more than a proof allows.
    pub fn unbalanced(&self, forces: &Forces) -> Vec<bool> {
        let imbalances = proof::imbalances(self.assembly, forces);
        imbalances.iter().map(|imbalance| *imbalance > self.threshold.imbalance).collect()
    }

    /// Returns a lower bound on the sum of balancing forces, N, and whether the sum of `forces` reaches this bound. The
    /// bound follows from the motion `witness` (program units); without `witness` it is `None`.
    pub fn bound_force_sum(&self, witness: Option<&[f64]>, forces: &Forces) -> (Option<f64>, bool) {
        let Some(witness) = witness else {
            return (None, false);
        };
        let motion = proof::motions_of(self.assembly, witness, self.scale.length);
        let bound = proof::force_sum_lower_bound(self.assembly, &motion);
        let sum = forces.sum(self.assembly.length);
        (Some(bound), sum <= (1.0 + SUM_TOL) * bound)
    }

    /// Converts forces to newtons, without setting small forces to 0, and computes their proof.
    pub fn prove_without_cleaning(&self, amounts: &Amounts) -> Proof {
        proof::check_forces(self.assembly, &self.in_newtons(amounts, Noise::None))
    }

    /// Converts forces to newtons, limits them to their admissible range, and sets forces to 0 that are only noise. A
    /// normal or robot force is noise below 1e-13 of the heaviest load or of the sum of all forces on the body; `noise`
    /// selects which. With `Noise::None`, no force is noise. Friction is noise only below 1e-10 of both N and μN.
    /// Setting noise to 0 changes the balance by at most a tenth of the accepted imbalance.
    fn in_newtons(&self, amounts: &Amounts, noise: Noise) -> Forces {
        let unit = self.scale.force;
        let demand = 0.1 * self.threshold.imbalance;
        let heaviest = match self.assembly.heaviest_load() {
            0.0 => 1.0,
            heaviest => heaviest,
        };
        let gross_forces = match noise {
            Noise::OfEachBody => self.gross_forces(amounts),
            _ => Vec::new(),
        };
        // For a body: the size below which a normal or robot force is noise, and the size below which friction is
        // noise, N.
        let limits = |body: usize| match noise {
            Noise::OfTheWhole => (1e-13 * heaviest, demand * heaviest),
            Noise::OfEachBody => {
                let load = gross_load(self.assembly, &self.assembly.bodies[body]);
                let rounding_limit = demand * if load > 0.0 { load } else { 1e-7 * gross_forces[body] };
                ((1e-13 * gross_forces[body]).min(rounding_limit), rounding_limit)
            }
            Noise::None => (0.0, 0.0),
        };
        let clean = |v: f64, noise: f64| if v.abs() <= noise { 0.0 } else { v };
        let contacts = self.assembly.contacts.iter().enumerate();
        let contacts = contacts.map(|(k, contact)| {
            let (on, from) = (limits(contact.on), contact.from.map(limits));
            let from = from.unwrap_or((f64::INFINITY, f64::INFINITY));
            let (normal_noise, friction_noise) = (on.0.min(from.0), on.1.min(from.1));
            let normal = amounts.normal[k].map(|v| clean(v * unit, normal_noise).max(0.0));
            let pressed = normal[0] + normal[1];
            let friction_limit = contact.friction * pressed;
            let friction = (amounts.friction[k] * unit).clamp(-friction_limit, friction_limit);
            let friction_noise = friction_noise.min(1e-10 * friction_limit.min(pressed));
            ContactForces { normal, friction: clean(friction, friction_noise) }
        });
        let grips = self.assembly.grips.iter().zip(&amounts.grip);
        let grips = grips.map(|(grip, [x, y, m])| {
            let length = self.scale.length;
            let (noise, _) = limits(grip.body);
            let clean_and_limit = |v: f64, limit: f64| clean(v, noise).clamp(-limit, limit);
            // The division and the multiplication by L may round the torque above its limit, so clamp it again.
            let torque_limit = grip.limits.torque;
            let torque = clean_and_limit(m * unit, torque_limit / length) * length;
            GripForces {
                force: Vector::new(
                    clean_and_limit(x * unit, grip.limits.fx),
                    clean_and_limit(y * unit, grip.limits.fy),
                ),
                torque: torque.clamp(-torque_limit, torque_limit),
            }
        });
        Forces { contacts: contacts.collect(), grips: grips.collect() }
    }

    /// Returns the sum of the magnitudes of all forces on each body, N: its load, contact forces and robot forces.
    fn gross_forces(&self, amounts: &Amounts) -> Vec<f64> {
        let bodies = self.assembly.bodies.iter();
        let mut sums: Vec<f64> = bodies.map(|b| gross_load(self.assembly, b)).collect();
        let contacts = amounts.normal.iter().zip(&amounts.friction);
        for (contact, (normal, friction)) in self.assembly.contacts.iter().zip(contacts) {
            let magnitude = (normal[0].abs() + normal[1].abs() + friction.abs()) * self.scale.force;
            sums[contact.on] += magnitude;
            if let Some(from) = contact.from {
                sums[from] += magnitude;
            }
        }
        for (grip, given) in self.assembly.grips.iter().zip(&amounts.grip) {
            let magnitude = given.iter().map(|v| v.abs()).sum::<f64>();
            sums[grip.body] += magnitude * self.scale.force;
        }
        sums
    }
}

/// A motion must prove that forces cannot balance the loads, even if the sum of the forces is this many times the sum
/// of all loads. The thrust of a flat arch is several times its weight, so with a tenth of this value a thrust could
/// contradict the motion. Ten times this value would leave flat wedges undecided.
const MIN_EXCLUDED_LOADS: f64 = 10.0;

impl Component<'_> {
    /// Returns a motion near the velocities `y` (program units) that violates no contact, and its proof. Returns `None`
    /// if no such motion is found, or if its proof is too weak.
    ///
    /// Even small violations are not ignored as rounding errors: the motion of a wedge into its notch consists only of
    /// such violations.
    pub(super) fn prove_motion(
        &self,
        program: &Program,
        y: &[f64],
        effort: &mut Effort,
    ) -> Option<(Vec<Motion>, Proof)> {
        let (speed, mut motion) = self.to_motions(y);
        let mut proof = self.check_mechanism(&motion);
        if speed == 0.0 {
            return None;
        }
        // If the motion violates contacts, remove the solver's error.
        if proof.excluded_force_sum().is_finite() {
            let unit: Vec<f64> = y.iter().map(|v| v / speed).collect();
            (_, motion) = self.to_motions(&repair_motion(program, &unit, effort)?);
            proof = self.check_mechanism(&motion);
        }
        self.accepts_motion(&motion, &proof).then_some((motion, proof))
    }

    /// True if a proof shows that no admissible forces can stop a motion. The proof must exclude even forces that are
    /// ten times as large as the loads of all bodies. Otherwise the thrust of heavy bodies, acting against a small
    /// violation, could stop the motion of a light body.
    pub(super) fn accepts_motion(&self, motion: &[Motion], proof: &Proof) -> bool {
        // Forces whose sum is at most `MIN_EXCLUDED_LOADS` times the sum of all loads must not be able to stop the
        // motion.
        let bodies = self.assembly.bodies.iter();
        let all: f64 = bodies.map(|b| proof::gross_load(self.assembly, b)).sum();
        let load = proof::moving_load(self.assembly, motion);
        self.accepts(proof) && proof.excluded_force_sum() * load >= MIN_EXCLUDED_LOADS * all
    }

    /// True if the power of the loads along a motion, minus the power that robots absorb, is larger than the power of
    /// any imbalance that a proof by forces accepts. Then no proof by forces can contradict the motion.
    pub(super) fn exceeds_force_tolerance(&self, motion: &[Motion], proof: &Proof) -> bool {
        let speed_sum: f64 = motion.iter().map(|m| m.velocity.norm() + m.spin.abs() * self.assembly.length).sum();
        let heaviest = self.assembly.heaviest_load();
        let load = proof::moving_load(self.assembly, motion);
        matches!(proof, Proof::Mechanism { power, .. } if power * load > 2.0 * Proof::IMBALANCE_TOL * heaviest * speed_sum)
    }

    /// Returns the translation by which an unsupported component falls, and its proof: all bodies move in the direction
    /// of the total load. `None` if the ground or a robot supports the component, or if its loads cancel.
    pub(super) fn falls_freely(&self) -> Option<(Vec<Motion>, Proof)> {
        if !self.assembly.is_unsupported() {
            return None;
        }
        let loads = self.assembly.bodies.iter().map(|body| body.load);
        let total = loads.fold(LoadVector::ZERO, LoadVector::plus).force;
        // If the loads cancel, they cause no translation.
        if total.norm() <= Proof::IMBALANCE_TOL * self.assembly.heaviest_load() {
            return None;
        }
        let velocity = total.normalize();
        let bodies = self.assembly.bodies.iter();
        let mechanism = bodies.map(|body| Motion { block: body.block, velocity, spin: 0.0 });
        let mechanism: Vec<Motion> = mechanism.collect();
        let proof = self.check_mechanism(&mechanism);
        Some((mechanism, proof))
    }

    pub(super) fn check_mechanism(&self, motion: &[Motion]) -> Proof {
        proof::check_mechanism(self.assembly, motion)
    }

    /// Converts velocities in program units to motions in metres, scaled so that the fastest point has speed 1. Also
    /// returns the speed of this point before scaling.
    pub(super) fn to_motions(&self, y: &[f64]) -> (f64, Vec<Motion>) {
        let bodies = self.assembly.bodies.iter();
        let mut all: Vec<Motion> = bodies
            .enumerate()
            .map(|(k, body)| Motion {
                block: body.block,
                velocity: Vector::new(y[3 * k], y[3 * k + 1]),
                // In program units, the spin is the speed at distance L from the centroid.
                spin: y[3 * k + 2] / self.scale.length,
            })
            .collect();
        let speed = to_speed_one(self.assembly, &mut all);
        (speed, all)
    }
}

/// Scales a motion so that its fastest point has speed 1. Returns the speed before scaling.
pub(super) fn to_speed_one(assembly: &Assembly, motion: &mut [Motion]) -> f64 {
    let bodies = assembly.bodies.iter();
    let speeds = bodies.zip(&*motion).map(|(body, motion)| fastest(body, motion));
    let speed = speeds.fold(0.0, f64::max);
    if speed > 0.0 {
        for motion in motion {
            motion.velocity /= speed;
            motion.spin /= speed;
        }
    }
    speed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::analysis::Options;
    use crate::mechanics::program::{Program, Scale};
    use crate::mechanics::scene::Scene;
    use crate::mechanics::statics::effect;
    use crate::mechanics::statics::interface::Interfaces;

    /// A block of 2 N on the ground needs no robot: 2 N suffice. If the robot presses with 2 N, the sum is 6 N.
    #[test]
    fn only_forces_that_reach_the_bound_are_reported_as_the_least() {
        let scene = Scene::from_json(
            r#"{ "drystone": 1, "ground": [{ "polygon": [[0, -1], [4, -1], [4, 0], [0, 0]] }],
                "blocks": [{ "id": "a", "polygon": [[1, 0], [2, 0], [2, 1], [1, 1]], "weight": 2 }],
                "robots": [{ "id": "r", "holds": "a" }] }"#,
        )
        .expect("sound");
        let assembly = effect::assembly_of(&scene, &scene.frames[0], &Interfaces::new(&scene));
        let component = Component::new(&assembly, Options::default());
        let scale = Scale::from_assembly(&assembly);
        let program = Program::new(&assembly, scale);
        let pressed = |robot: f64| {
            let mut amounts = Amounts::zero(&program);
            amounts.normal[0] = [0.5 * (2.0 + robot) / scale.force; 2];
            amounts.grip[0] = [0.0, -robot / scale.force, 0.0];
            amounts
        };
        // A motion downwards with speed 1: a sum below 2 N cannot balance 2 N.
        let witness = [0.0, -1.0, 0.0];
        let proved = |robot: f64| component.prove_forces(pressed(robot));
        let found = |robot: f64| component.bound_force_sum(Some(&witness), &proved(robot).forces);
        for robot in [0.0, 2.0] {
            assert!(component.accepts(&proved(robot).proof));
        }
        for (robot, is_least) in [(0.0, true), (2.0, false), (1e-5, false)] {
            let (bound, found_least) = found(robot);
            assert!((bound.expect("a bound") - 2.0).abs() < 1e-12);
            assert_eq!(found_least, is_least, "{robot}");
        }
        assert_eq!(component.bound_force_sum(None, &proved(0.0).forces), (None, false));
    }
}
