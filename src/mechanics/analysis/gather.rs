//! A frame put together from what was found of its components.

use super::decide::{Findings, Method};
use super::frame::worst;
use super::{Contact, FrameAnalysis, Proof, RobotForce, SolveReport, Stages, Verdict};
use crate::assembly::Assembly;
use crate::effect::{EffectReport, FrameContext};
use crate::geometry::Vector;
use crate::resultant::{friction_used, from_corner_forces};

/// The frame before any component is added: every contact and grip without force.
pub(super) fn gathered(
    situation: &FrameContext,
    assembly: &Assembly,
    effects: Vec<EffectReport>,
) -> FrameAnalysis {
    let (scene, frame) = (situation.scene, situation.frame);
    let contacts = situation
        .interfaces
        .iter()
        .map(|interface| Contact {
            interface: (*interface).clone(),
            application_points: interface.application_points(scene.kernel),
            normal_forces: [0.0; 2],
            friction_force: 0.0,
            resultant: from_corner_forces(interface, scene.kernel, [0.0; 2], 0.0),
            friction_used: 0.0,
        })
        .collect();
    let robots = frame
        .holds
        .iter()
        .map(|h| RobotForce {
            robot: h.robot,
            block: h.block,
            at: h.at,
            force: Vector::zeros(),
            torque: 0.0,
            limit_used: 0.0,
        })
        .collect();
    FrameAnalysis {
        verdict: Verdict::Stable,
        doubts: Vec::new(),
        length: assembly.length,
        total_force: 0.0,
        force_bound: Some(0.0),
        least_force: true,
        total_sticking: 0.0,
        weight: frame.placed.iter().map(|b| scene.blocks[b.0].weight).sum(),
        contacts,
        robots,
        failures: Vec::new(),
        unsupported: Vec::new(),
        mechanism: Vec::new(),
        margins: None,
        only_by_wedging: None,
        wedged: None,
        effects,
        proof: Proof::Forces {
            worst_imbalance: 0.0,
            worst_share: 0.0,
            worst_pull: 0.0,
            worst_slip: 0.0,
        },
        solve: SolveReport {
            method: Method::ClosedForm,
            iterations: 0,
            programs: 0,
            groups: 0,
            reused: 0,
            seconds: 0.0,
            stages: Stages::default(),
        },
        notices: Vec::new(),
    }
}

/// Enters what was found for one component.
pub(super) fn add(
    analysis: &mut FrameAnalysis,
    component: &Assembly,
    found: &Findings,
    kernel: f64,
) {
    for (at, pressed) in component.contacts.iter().zip(&found.forces.contacts) {
        let contact = &mut analysis.contacts[at.interface];
        let (normal, friction) = (pressed.normal, pressed.friction);
        contact.normal_forces = normal;
        contact.friction_force = friction;
        contact.resultant = from_corner_forces(&contact.interface, kernel, normal, friction);
        contact.friction_used = friction_used(&contact.interface, normal, friction);
        analysis.total_force += normal[0] + normal[1] + friction.abs();
    }
    for (grip, held) in component.grips.iter().zip(&found.forces.grips) {
        let share = |amount: f64, limit: f64| {
            if limit.is_finite() && limit > 0.0 {
                amount.abs() / limit
            } else {
                0.0
            }
        };
        let (force, torque, limits) = (held.force, held.torque, grip.limits);
        let robot = &mut analysis.robots[grip.hold];
        robot.force = force;
        robot.torque = torque;
        robot.limit_used = share(force.x, limits.fx)
            .max(share(force.y, limits.fy))
            .max(share(torque, limits.torque));
        analysis.total_force += force.x.abs() + force.y.abs() + torque.abs() / component.length;
    }
    analysis.force_bound = match (analysis.force_bound, found.force_bound) {
        (Some(sum), Some(own)) if found.verdict == Verdict::Stable => Some(sum + own),
        _ => None,
    };
    analysis.least_force &= found.least_force;
    analysis.total_sticking += found.total_sticking;
    analysis.failures.extend(found.failures.iter().copied());
    analysis.mechanism.extend(found.mechanism.iter().copied());
    if found.unsupported {
        let blocks = component.bodies.iter().map(|body| body.block);
        analysis.unsupported.extend(blocks);
    }
    analysis.doubts.extend(found.doubt.clone());
    analysis.proof = match (analysis.verdict, found.verdict) {
        // Components of the same verdict: the worst of their numbers. Otherwise the worse verdict brings its own proof.
        (a, b) if a == b => worst(analysis.proof, found.proof),
        (a, b) if a < b => found.proof,
        _ => analysis.proof,
    };
    analysis.verdict = analysis.verdict.max(found.verdict);
}
