//! What sticks in a component, as failures in metres and newtons.

use super::Component;
use crate::analysis::Failure;
use crate::assembly::{Assembly, load_about};
use crate::geometry::{Point, Vector};
use crate::proof::{Forces, gross_load};
use crate::solve::Amounts;

/// A failure is listed above this part of the weight of its lighter body.
const SHARE_OF_WEIGHT: f64 = 1e-6;

/// And above this part of the largest of its component: less is the solver's noise.
const SHARE_OF_LARGEST: f64 = 1e-9;

impl Component<'_> {
    /// What sticks, in newtons, in the order of contacts and grips.
    pub(super) fn failures(&self, sticking: &Amounts) -> Vec<Failure> {
        let unit = self.scale.force;
        let most = sticking
            .normal
            .iter()
            .flatten()
            .chain(&sticking.friction)
            .chain(sticking.grip.iter().flatten());
        let most = unit * most.fold(0.0, |m: f64, v| m.max(v.abs()));
        let bodies = self.assembly.bodies.iter();
        let weights: Vec<f64> = bodies.map(|b| gross_load(self.assembly, b)).collect();
        // Bodies without a load have no scale of their own.
        let least = |on: usize, from: Option<usize>| {
            let both = [Some(on), from].into_iter().flatten();
            let loaded = both
                .map(|body| weights[body])
                .filter(|weight| *weight > 0.0);
            let lighter = loaded.fold(f64::INFINITY, f64::min);
            (SHARE_OF_WEIGHT * lighter).min(SHARE_OF_LARGEST * most) / unit
        };
        let block = |body: usize| self.assembly.bodies[body].block;
        let mut failures = Vec::new();
        for (k, contact) in self.assembly.contacts.iter().enumerate() {
            let bodies = contact.bodies;
            let least = least(contact.on, contact.from);
            let counts = |v: f64| v.abs() > least;
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
            let least = least(grip.body, None);
            let counts = |v: f64| v.abs() > least;
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

    /// The assembly with what sticks among its loads: what admissible forces have to balance beside it.
    pub(super) fn with_sticking(&self, sticking: &Amounts) -> Assembly {
        let unit = self.scale.force;
        let mut held = self.assembly.clone();
        // The factor on listed loads must not multiply what sticks.
        for body in &mut held.bodies {
            body.listed = body.listed.times(self.assembly.load_factor);
        }
        held.load_factor = 1.0;
        let mut act = |body: usize, at: Point, force: Vector, torque: f64| {
            let body = &mut held.bodies[body];
            body.listed = body
                .listed
                .plus(load_about(body.centroid, at, force, torque));
        };
        for (k, contact) in self.assembly.contacts.iter().enumerate() {
            let pulls = contact.points.into_iter().zip(sticking.normal[k]);
            let pulls = pulls.map(|(at, pull)| (at, contact.normal * (-pull * unit)));
            let rub = (
                contact.ends[0],
                contact.tangent() * (sticking.friction[k] * unit),
            );
            for (at, force) in pulls.chain([rub]) {
                act(contact.on, at, force, 0.0);
                if let Some(from) = contact.from {
                    act(from, at, -force, 0.0);
                }
            }
        }
        for (grip, [x, y, m]) in self.assembly.grips.iter().zip(&sticking.grip) {
            let force = Vector::new(*x, *y) * unit;
            act(grip.body, grip.at, force, m * unit * self.scale.length);
        }
        held.with_summed_loads()
    }

    /// Forces next to what sticks, in newtons, and whether both together balance every body.
    pub(super) fn prove_with_adhesion(
        &self,
        amounts: &Amounts,
        sticking: &Amounts,
    ) -> (Forces, bool) {
        let held = self.with_sticking(sticking);
        let component = Component {
            assembly: &held,
            settings: self.settings.clone(),
            ..*self
        };
        let carried = component.prove_forces(amounts);
        let balanced = component.believes(&carried.proof);
        (carried.forces, balanced)
    }
}

/// The sum of all that fails, N, a torque over the length L.
pub(super) fn total(failures: &[Failure], length: f64) -> f64 {
    let sizes = failures.iter().map(|failure| match failure {
        Failure::Tension { force, .. } | Failure::Friction { force, .. } => force.norm(),
        Failure::RobotForce { force, .. } => force.x.abs() + force.y.abs(),
        Failure::RobotTorque { torque, .. } => torque.abs() / length,
    });
    sizes.sum()
}
