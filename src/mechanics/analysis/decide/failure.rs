//! Converts the missing adhesion of a component to failures: the places where force is missing, in metres and newtons.

use super::Component;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::Failure;
use crate::mechanics::proof::{Forces, gross_load};
use crate::mechanics::solve::Amounts;
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact, AssemblyGrip, load_about};

/// A failure is listed if it exceeds this fraction of the load of the lighter of its two bodies.
const MIN_SHARE_OF_LOAD: f64 = 1e-6;

/// A failure is also listed if it exceeds this fraction of the largest failure of its component. Less is solver
/// noise.
const MIN_SHARE_OF_LARGEST: f64 = 1e-9;

impl Component<'_> {
    /// Returns the failures in newtons and newton metres, in the order of contacts and grips. `adhesion` is in program
    /// units.
    pub(super) fn failures(&self, adhesion: &Amounts) -> Vec<Failure> {
        let unit = self.scale.force;
        let largest = adhesion.normal.iter().flatten().chain(&adhesion.friction).chain(adhesion.grip.iter().flatten());
        // Compute the largest adhesion in the component, N.
        let largest = unit * largest.fold(0.0, |m: f64, v| m.max(v.abs()));
        let bodies = self.assembly.bodies.iter();
        let weights: Vec<f64> = bodies.map(|b| gross_load(self.assembly, b)).collect();
        // The amount, in program units, above which a failure between two bodies is listed. It is a fraction of the
        // lighter body's load or of `largest`, whichever is less. A body without a load does not count as the lighter
        // body.
        let min_amount = |on: usize, from: Option<usize>| {
            let both = [Some(on), from].into_iter().flatten();
            let loaded = both.map(|body| weights[body]).filter(|weight| *weight > 0.0);
            let lighter = loaded.fold(f64::INFINITY, f64::min);
            (MIN_SHARE_OF_LOAD * lighter).min(MIN_SHARE_OF_LARGEST * largest) / unit
        };
        let mut failures = Vec::new();
        for (k, contact) in self.assembly.contacts.iter().enumerate() {
            let min_amount = min_amount(contact.on, contact.from);
            let amounts = (adhesion.normal[k], adhesion.friction[k]);
            self.add_contact_failures(&mut failures, contact, amounts, min_amount);
        }
        for (grip, missing) in self.assembly.grips.iter().zip(&adhesion.grip) {
            let min_amount = min_amount(grip.body, None);
            self.add_grip_failures(&mut failures, grip, *missing, min_amount);
        }
        failures
    }

    /// Appends the missing tension and the missing friction of a contact to `failures`, if they exceed `min_amount`.
    /// Inputs are in the program's unit of force.
    fn add_contact_failures(
        &self,
        failures: &mut Vec<Failure>,
        contact: &AssemblyContact,
        (pulls, friction): ([f64; 2], f64),
        min_amount: f64,
    ) {
        let (unit, bodies) = (self.scale.force, contact.bodies);
        let pulls = contact.points.into_iter().zip(pulls);
        for (at, pull) in pulls.filter(|p| p.1.abs() > min_amount) {
            failures.push(Failure::Tension { bodies, at, force: contact.normal * (-pull * unit) });
        }
        if friction.abs() > min_amount {
            failures.push(Failure::Friction {
                bodies,
                at: nalgebra::center(&contact.ends[0], &contact.ends[1]),
                force: contact.tangent() * (friction * unit),
            });
        }
    }

    /// Appends the missing force x, y and the missing torque m of a robot to `failures`, if they exceed `min_amount`.
    /// All inputs are in program units.
    fn add_grip_failures(
        &self,
        failures: &mut Vec<Failure>,
        grip: &AssemblyGrip,
        [x, y, m]: [f64; 3],
        min_amount: f64,
    ) {
        let unit = self.scale.force;
        let (robot, block, at) = (grip.robot, self.assembly.bodies[grip.body].block, grip.at);
        if x.abs() > min_amount || y.abs() > min_amount {
            failures.push(Failure::RobotForce { robot, block, at, force: Vector::new(x, y) * unit });
        }
        if m.abs() > min_amount {
            failures.push(Failure::RobotTorque { robot, block, at, torque: m * unit * self.scale.length });
        }
    }

    /// Returns a copy of the assembly in which the adhesion acts as a load. If the adhesion suffices, admissible
    /// forces balance the copy.
    pub(super) fn with_adhesion(&self, adhesion: &Amounts) -> Assembly {
        let unit = self.scale.force;
        let mut held = self.assembly.clone();
        // Each adhesive force acts on one body as a load. The opposite force acts on the other body.
        let mut act = |body: usize, at: Point, force: Vector, torque: f64| {
            let body = &mut held.bodies[body];
            // The load factor must not multiply the adhesion.
            body.fixed = body.fixed.plus(load_about(body.centroid, at, force, torque));
        };
        for (k, contact) in self.assembly.contacts.iter().enumerate() {
            let pulls = contact.points.into_iter().zip(adhesion.normal[k]);
            let pulls = pulls.map(|(at, pull)| (at, contact.normal * (-pull * unit)));
            let friction = (contact.ends[0], contact.tangent() * (adhesion.friction[k] * unit));
            for (at, force) in pulls.chain([friction]) {
                act(contact.on, at, force, 0.0);
                if let Some(from) = contact.from {
                    act(from, at, -force, 0.0);
                }
            }
        }
        for (grip, [x, y, m]) in self.assembly.grips.iter().zip(&adhesion.grip) {
            let force = Vector::new(*x, *y) * unit;
            act(grip.body, grip.at, force, m * unit * self.scale.length);
        }
        held.with_summed_loads()
    }

    /// Converts the forces `amounts` to newtons. Also returns whether they balance every body together with the
    /// adhesion.
    pub(super) fn prove_with_adhesion(&self, amounts: Amounts, adhesion: &Amounts) -> (Forces, bool) {
        let held = self.with_adhesion(adhesion);
        let component = Component { assembly: &held, ..*self };
        let proved = component.prove_forces(amounts);
        let balanced = component.accepts(&proved.proof);
        (proved.forces, balanced)
    }
}

/// Returns the sum of the magnitudes of all missing forces, N. A missing robot force counts as |Fx| + |Fy|. A missing
/// torque is divided by `length`, m.
pub(super) fn total(failures: &[Failure], length: f64) -> f64 {
    let sizes = failures.iter().map(|failure| match failure {
        Failure::RobotTorque { .. } => failure.amount() / length,
        _ => failure.amount(),
    });
    sizes.sum()
}
