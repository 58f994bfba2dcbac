//! What sticks in a component, as failures in metres and newtons.

use super::Case;
use crate::analysis::Failure;
use crate::geometry::Vector;
use crate::solve::Amounts;

impl Case<'_> {
    /// What sticks, in newtons, in the order of contacts and grips.
    pub(super) fn failures(&self, sticking: &Amounts) -> Vec<Failure> {
        let unit = self.scale.force;
        let most = sticking
            .normal
            .iter()
            .flatten()
            .chain(&sticking.friction)
            .chain(sticking.grip.iter().flatten());
        let least = 1e-6 * most.fold(0.0, |m: f64, v| m.max(v.abs()));
        let counts = |v: f64| v.abs() > least;
        let block = |body: usize| self.assembly.bodies[body].block;
        let mut failures = Vec::new();
        for (k, contact) in self.assembly.contacts.iter().enumerate() {
            let bodies = contact.bodies;
            let pulls = contact.points.into_iter().zip(sticking.normal[k]);
            for (at, pull) in pulls.filter(|p| counts(p.1)) {
                failures.push(Failure::Tension {
                    bodies,
                    at,
                    force: contact.normal * (-pull * unit),
                });
            }
            if counts(sticking.friction[k]) {
                failures.push(Failure::Friction {
                    bodies,
                    at: nalgebra::center(&contact.ends[0], &contact.ends[1]),
                    force: contact.tangent() * (sticking.friction[k] * unit),
                });
            }
        }
        for (grip, [x, y, m]) in self.assembly.grips.iter().zip(&sticking.grip) {
            let (robot, block, at) = (grip.robot, block(grip.body), grip.at);
            if counts(*x) || counts(*y) {
                failures.push(Failure::RobotForce {
                    robot,
                    block,
                    at,
                    force: Vector::new(*x, *y) * unit,
                });
            }
            if counts(*m) {
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
