//! Computes a lower bound of the sum of forces that any balance of an assembly needs, by weak duality from a motion.
//!
//! If forces balance the loads, contacts and grips absorb the power P of the loads along every motion. A contact force
//! absorbs at most δ(N + |T|), where δ is the worst violation of the motion. A component of a robot's force absorbs at
//! most its amount times the speed of the grip point. Forces with a sum below P/δ therefore cannot balance the loads. A
//! robot with a limit may absorb more than δ per newton; the excess, limit · (speed − δ), is subtracted from P.

use super::{Forces, Motion, NON_BINDING_RATIO, ROUNDING_TOL, moving_load, power_of_loads, worst_violation};
use crate::mechanics::statics::assembly::Assembly;

impl Forces {
    /// Returns the sum of the magnitudes of all forces, N: Σ (N1 + N2 + |T|) + Σ (|Fx| + |Fy| + |M|/L). `length` is L
    /// in metres.
    pub fn sum(&self, length: f64) -> f64 {
        let contacts = self.contacts.iter();
        let contacts = contacts.map(|c| c.normal[0] + c.normal[1] + c.friction.abs());
        let grips = self.grips.iter();
        let grips = grips.map(|g| g.force.x.abs() + g.force.y.abs() + g.torque.abs() / length);
        contacts.sum::<f64>() + grips.sum::<f64>()
    }
}

/// Returns a lower bound, N, of [`Forces::sum`] for all admissible forces that balance an assembly exactly.
///
/// The bound follows from the motion, which has one entry for each body. The motion must be scaled like the dual
/// variables: a unit force may act against a speed of at most 1. The bound is 0 if the motion proves no better bound.
/// Torques are divided by the assembly's length L.
pub fn force_sum_lower_bound(assembly: &Assembly, motions: &[Motion]) -> f64 {
    // A robot with a limit above this value counts as unlimited.
    let binding = NON_BINDING_RATIO * moving_load(assembly, motions);
    // `worst` is δ, the largest speed against which a unit force may act. Robot components without a limit can increase
    // δ. For a component with a limit, the power beyond δ is subtracted from the power of the loads.
    let mut worst = worst_violation(assembly, motions).max(1.0);
    let mut limited = Vec::new();
    for grip in &assembly.grips {
        let (body, motion) = (&assembly.bodies[grip.body], &motions[grip.body]);
        // Compute the speed of the grip against each component of the robot's force, including its rounding error.
        let at_grip = motion.about(body.centroid, grip.at);
        let rounding = ROUNDING_TOL * motion.summed(body.centroid, grip.at);
        for (speed, limit) in [
            (at_grip.x.abs() + rounding.x, grip.limits.fx),
            (at_grip.y.abs() + rounding.y, grip.limits.fy),
            (motion.spin.abs() * assembly.length, grip.limits.torque / assembly.length),
        ] {
            if limit > binding {
                worst = worst.max(speed);
            } else {
                limited.push((speed, limit));
            }
        }
    }
    // The bound is (power of the loads − excess of limited robots − rounding error) / δ.
    let (power, summed) = power_of_loads(assembly, motions);
    let spent = limited.iter().map(|(v, limit)| limit * (v - worst).max(0.0));
    let rounding = (motions.len() + 8) as f64 * f64::EPSILON * summed;
    ((power - spent.sum::<f64>() - rounding) / worst).max(0.0)
}
