//! Collects the results of all components of a frame in one [`FrameAnalysis`].

use super::decide::{Method, Outcome};
use super::frame::weaker_proof;
use super::{Contact, FrameAnalysis, Proof, RobotForce, SolveReport, Stages, Verdict};
use crate::geometry::Vector;
use crate::mechanics::proof::Forces;
use crate::mechanics::scene::Hold;
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect::{EffectReport, FrameContext};
use crate::mechanics::statics::interface::Interface;
use crate::mechanics::statics::resultant::{friction_used, from_point_forces};

/// Creates the analysis of a frame with zero force at every contact and grip. The results of the components are added
/// later.
pub(super) fn unloaded_frame(context: &FrameContext, assembly: &Assembly, effects: Vec<EffectReport>) -> FrameAnalysis {
    let (scene, frame) = (context.scene, context.frame);
    let contacts = context.interfaces.iter();
    let contacts = contacts.map(|interface| unloaded_contact(interface, scene.kernel));
    let robots = frame.holds.iter().map(unloaded_robot);
    FrameAnalysis {
        verdict: Verdict::Stable,
        doubts: Vec::new(),
        length: assembly.length,
        total_force: 0.0,
        force_bound: Some(0.0),
        least_force: true,
        total_sticking: 0.0,
        weight: frame.placed.iter().map(|b| scene.blocks[b.0].weight).sum(),
        contacts: contacts.collect(),
        robots: robots.collect(),
        failures: Vec::new(),
        unsupported: Vec::new(),
        mechanism: Vec::new(),
        margins: None,
        sensitivity: None,
        placement: None,
        movements: Vec::new(),
        removable: None,
        vehicle: None,
        under_vehicle: None,
        corners_decide: false,
        alone: None,
        capacity: None,
        only_by_wedging: None,
        exact: None,
        cases: None,
        wedged: None,
        effects,
        proof: Proof::Forces { worst_imbalance: 0.0, worst_share: 0.0, worst_pull: 0.0, worst_slip: 0.0 },
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

/// Returns the contact at an interface, with zero force.
fn unloaded_contact(interface: &Interface, kernel: f64) -> Contact {
    Contact {
        interface: interface.clone(),
        application_points: interface.application_points(kernel),
        normal_forces: [0.0; 2],
        friction_force: 0.0,
        resultant: from_point_forces(interface, kernel, [0.0; 2], 0.0),
        friction_used: 0.0,
    }
}

/// Returns the force of a robot on the block that it holds, set to zero.
fn unloaded_robot(hold: &Hold) -> RobotForce {
    RobotForce {
        robot: hold.robot,
        block: hold.block,
        at: hold.at,
        force: Vector::zeros(),
        torque: 0.0,
        limit_used: 0.0,
    }
}

/// Adds the results of one component to the frame.
pub(super) fn add_component(analysis: &mut FrameAnalysis, component: &Assembly, findings: &Outcome, kernel: f64) {
    set_forces(analysis, component, &findings.forces, kernel);
    analysis.total_force += findings.forces.sum(component.length);
    // The bounds of the components add up, because no force acts between two components. If one bound is unknown,
    // or one component is not stable, the sum is unknown.
    analysis.force_bound = match (analysis.force_bound, findings.force_bound) {
        (Some(sum), Some(own)) if findings.verdict == Verdict::Stable => Some(sum + own),
        _ => None,
    };
    analysis.least_force &= findings.least_force;
    analysis.total_sticking += findings.total_sticking;
    analysis.failures.extend(findings.failures.iter().copied());
    analysis.mechanism.extend(findings.mechanism.iter().copied());
    if findings.unsupported {
        let blocks = component.bodies.iter().map(|body| body.block);
        analysis.unsupported.extend(blocks);
    }
    analysis.doubts.extend(findings.doubt.clone());
    analysis.proof = match (analysis.verdict, findings.verdict) {
        // If both verdicts are the same, use the worse numbers of both proofs. Otherwise use the proof of the worse
        // verdict.
        (a, b) if a == b => weaker_proof(analysis.proof, findings.proof),
        (a, b) if a < b => findings.proof,
        _ => analysis.proof,
    };
    analysis.verdict = analysis.verdict.max(findings.verdict);
}

/// Sets the forces of one component, in newtons, at its contacts and robots, with their resultants and the fractions of
/// limits that they use.
pub(super) fn set_forces(analysis: &mut FrameAnalysis, component: &Assembly, forces: &Forces, kernel: f64) {
    for (assembled, forces) in component.contacts.iter().zip(&forces.contacts) {
        let contact = &mut analysis.contacts[assembled.interface];
        let (normal, friction) = (forces.normal, forces.friction);
        contact.normal_forces = normal;
        contact.friction_force = friction;
        contact.resultant = from_point_forces(&contact.interface, kernel, normal, friction);
        contact.friction_used = friction_used(&contact.interface, normal, friction);
    }
    for (grip, held) in component.grips.iter().zip(&forces.grips) {
        let used_fraction = |value: f64, limit: f64| {
            if limit.is_finite() && limit > 0.0 { value.abs() / limit } else { 0.0 }
        };
        let (force, torque, limits) = (held.force, held.torque, grip.limits);
        let robot = &mut analysis.robots[grip.hold];
        robot.force = force;
        robot.torque = torque;
        robot.limit_used = used_fraction(force.x, limits.fx)
            .max(used_fraction(force.y, limits.fy))
            .max(used_fraction(torque, limits.torque));
    }
}
