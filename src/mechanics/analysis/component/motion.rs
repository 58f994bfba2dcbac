//! Motions of a component: from the solver's velocities to metres, freed of the solver's error, with their proofs.

use super::Case;
use super::rung::MANY_BLOCKS;
use crate::assembly::{Assembly, LoadVector};
use crate::geometry::Vector;
use crate::program::Program;
use crate::proof::{self, Motion, Proof, fastest};
use crate::solve::{Effort, polished};

/// Forces of so many times the sum of all loads are what a motion must rule out at least.
const THRUST: f64 = 10.0;

impl Case<'_> {
    /// The motion near a given one, freed of the solver's error, with its proof if that convinces.
    ///
    /// A violation is believed to be rounding only after the change: one of the solver's, however small, may be what the
    /// motion of a wedge into its notch lives on.
    pub(super) fn falling(
        &self,
        program: &Program,
        y: &[f64],
        effort: &mut Effort,
    ) -> Option<(Vec<Motion>, Proof)> {
        let (speed, mut motion) = self.moved(y);
        let mut proof = self.mechanism(&motion);
        if speed == 0.0 {
            return None;
        }
        if proof.excluded_force_sum().is_finite() {
            let many = motion.len() >= MANY_BLOCKS;
            let in_pieces = || self.falling_in_pieces(&motion, effort);
            if let Some(found) = many.then(in_pieces).flatten() {
                return Some(found);
            }
            let unit: Vec<f64> = y.iter().map(|v| v / speed).collect();
            (_, motion) = self.moved(&polished(program, &unit, effort)?);
            proof = self.mechanism(&motion);
        }
        self.convinces(&motion, &proof).then_some((motion, proof))
    }

    /// Whether a motion with its proof convinces: it is believed as such, and rules out all forces that the loads of the
    /// whole component might press with, so that no thrust of heavy bodies makes up for what a light one's motion violates.
    pub(super) fn convinces(&self, motion: &[Motion], proof: &Proof) -> bool {
        let bodies = self.assembly.bodies.iter();
        let all: f64 = bodies.map(|b| proof::gross_load(self.assembly, b)).sum();
        let load = proof::moving_load(self.assembly, motion);
        self.believes(proof) && proof.excluded_force_sum() * load >= THRUST * all
    }

    /// Whether a proved motion does more work than forces within the proof's band could take up.
    pub(super) fn outweighs_the_band(&self, motion: &[Motion], proof: &Proof) -> bool {
        let ways: f64 = motion
            .iter()
            .map(|m| m.velocity.norm() + m.spin.abs() * self.assembly.length)
            .sum();
        let heaviest = self.assembly.heaviest_load();
        let load = proof::moving_load(self.assembly, motion);
        matches!(proof, Proof::Mechanism { power, .. } if power * load > 2.0 * Proof::IMBALANCE_TOL * heaviest * ways)
    }

    /// A component that touches no ground and is held by nobody falls with the sum of its loads, all bodies alike.
    pub(super) fn falls_free(&self) -> Option<(Vec<Motion>, Proof)> {
        if !self.assembly.is_unsupported() {
            return None;
        }
        let loads = self.assembly.bodies.iter().map(|body| body.load);
        let total = loads.fold(LoadVector::NONE, LoadVector::plus).force;
        if total.norm() <= Proof::IMBALANCE_TOL * self.assembly.heaviest_load() {
            return None;
        }
        let velocity = total.normalize();
        let bodies = self.assembly.bodies.iter();
        let mechanism = bodies.map(|body| Motion {
            block: body.block,
            velocity,
            spin: 0.0,
        });
        let mechanism: Vec<Motion> = mechanism.collect();
        let proof = self.mechanism(&mechanism);
        Some((mechanism, proof))
    }

    pub(super) fn mechanism(&self, motion: &[Motion]) -> Proof {
        proof::check_mechanism(self.assembly, motion)
    }

    /// The speed of the fastest point in pure numbers, and every body's motion in metres, that point with speed 1.
    pub(super) fn moved(&self, y: &[f64]) -> (f64, Vec<Motion>) {
        let bodies = self.assembly.bodies.iter();
        let mut all: Vec<Motion> = bodies
            .enumerate()
            .map(|(k, body)| Motion {
                block: body.block,
                velocity: Vector::new(y[3 * k], y[3 * k + 1]),
                // Pure velocities are per unit of length.
                spin: y[3 * k + 2] / self.scale.length,
            })
            .collect();
        let speed = to_speed_one(self.assembly, &mut all);
        (speed, all)
    }
}

/// Multiplies a motion so that its fastest point has speed 1; the speed it had before.
pub(super) fn to_speed_one(assembly: &Assembly, motion: &mut [Motion]) -> f64 {
    let bodies = assembly.bodies.iter();
    let speeds = bodies
        .zip(&*motion)
        .map(|(body, motion)| fastest(body, motion));
    let speed = speeds.fold(0.0, f64::max);
    if speed > 0.0 {
        for motion in motion {
            motion.velocity /= speed;
            motion.spin /= speed;
        }
    }
    speed
}
