//! What sticks in a group, as failures in the scene's units.

use super::Case;
use crate::analysis::Failure;
use crate::geometry::Vector;
use crate::program::Program;
use crate::solve::Amounts;

impl Case<'_> {
    /// What sticks, in newtons, in the order of interfaces and holds.
    pub(super) fn failures(&self, program: &Program, sticking: &Amounts) -> Vec<Failure> {
        let unit = self.scale.force;
        let most = sticking
            .normal
            .iter()
            .flatten()
            .chain(&sticking.friction)
            .chain(sticking.grip.iter().flatten());
        let least = 1e-6 * most.fold(0.0, |m: f64, v| m.max(v.abs()));
        let counts = |v: f64| v.abs() > least;
        let mut failures = Vec::new();
        for (k, contact) in program.contacts.iter().enumerate() {
            let interface = self.interfaces[contact.interface];
            let bodies = interface.bodies;
            let points = interface.application_points(self.scene.kernel);
            for (at, pull) in points
                .into_iter()
                .zip(sticking.normal[k])
                .filter(|p| counts(p.1))
            {
                failures.push(Failure::Tension {
                    bodies,
                    at,
                    force: interface.normal * (-pull * unit),
                });
            }
            if counts(sticking.friction[k]) {
                let force = interface.tangent() * (sticking.friction[k] * unit);
                failures.push(Failure::Friction {
                    bodies,
                    at: interface.middle(),
                    force,
                });
            }
        }
        for (k, grip) in program.grips.iter().enumerate() {
            let hold = self.frame.holds[grip.hold];
            let [x, y, m] = sticking.grip[k];
            let (robot, block, at) = (hold.robot, hold.block, hold.at);
            if counts(x) || counts(y) {
                failures.push(Failure::RobotForce {
                    robot,
                    block,
                    at,
                    force: Vector::new(x, y) * unit,
                });
            }
            if counts(m) {
                failures.push(Failure::RobotTorque {
                    robot,
                    block,
                    at,
                    torque: m * unit * self.scale.length,
                });
            }
        }
        failures
    }
}
