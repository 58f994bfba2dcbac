//! Converts velocities from the solver to a motion in metres, removes the solver's error, and proves that no admissible
//! forces can stop this motion (route 3b).

use super::Component;
use crate::geometry::Vector;
use crate::mechanics::program::Program;
use crate::mechanics::proof::{self, Motion, Proof, fastest};
use crate::mechanics::solve::{Effort, repair_motion};
use crate::mechanics::statics::assembly::{Assembly, LoadVector};

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
