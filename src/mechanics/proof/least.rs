//! What a motion says of the least sum of forces that balance: weak duality, summed from the geometry.
//!
//! Forces that balance exactly do no work along any motion: what the loads give, contacts and grips take. A contact's force
//! takes at most δ of N + |T|, with δ the worst violation of the motion, a robot's component at most its amount times its
//! speed. So with loads of power P no forces of a sum below P/δ balance. Of a robot with a limit only what its speed is
//! beyond δ counts, limit times that, against P.

use super::{Forces, Motion, NON_BINDING, ROUNDING, moving_load, power_of_loads, worst_violation};
use crate::assembly::Assembly;

impl Forces {
    /// Σ (N1 + N2 + |T|) + Σ (|Fx| + |Fy| + |M|/L), N, with L in metres.
    pub fn sum(&self, length: f64) -> f64 {
        let contacts = self.contacts.iter();
        let contacts = contacts.map(|c| c.normal[0] + c.normal[1] + c.friction.abs());
        let grips = self.grips.iter();
        let grips = grips.map(|g| g.force.x.abs() + g.force.y.abs() + g.torque.abs() / length);
        contacts.sum::<f64>() + grips.sum::<f64>()
    }
}

/// A number of newtons below which no admissible forces sum that balance an assembly exactly; 0 where the motion says
/// nothing. Speeds are those against which a unit of force costs 1; sums count torques over the assembly's L.
pub fn force_sum_lower_bound(assembly: &Assembly, motions: &[Motion]) -> f64 {
    let binding = NON_BINDING * moving_load(assembly, motions);
    let mut worst = worst_violation(assembly, motions).max(1.0);
    let mut limited = Vec::new();
    for grip in &assembly.grips {
        let (body, motion) = (&assembly.bodies[grip.body], &motions[grip.body]);
        let at_grip = motion.about(body.centroid, grip.at);
        let unsure = ROUNDING * motion.summed(body.centroid, grip.at);
        for (speed, limit) in [
            (at_grip.x.abs() + unsure.x, grip.limits.fx),
            (at_grip.y.abs() + unsure.y, grip.limits.fy),
            (
                motion.spin.abs() * assembly.length,
                grip.limits.torque / assembly.length,
            ),
        ] {
            if limit > binding {
                worst = worst.max(speed);
            } else {
                limited.push((speed, limit));
            }
        }
    }
    let (power, summed) = power_of_loads(assembly, motions);
    let spent = limited
        .iter()
        .map(|(v, limit)| limit * (v - worst).max(0.0));
    let rounding = (motions.len() + 8) as f64 * f64::EPSILON * summed;
    ((power - spent.sum::<f64>() - rounding) / worst).max(0.0)
}
