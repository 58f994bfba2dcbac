//! [`with_missing_forces`]: the forces of a frame that falls together with its missing forces. They balance every
//! block, so they have a true line of thrust. Where a joint would have to pull, this line leaves the stone.

use crate::geometry::{Point, cross};
use crate::mechanics::analysis::{Contact, Failure, FrameAnalysis};

/// A missing force belongs to a joint if it acts at most this fraction of the joint's length away from it.
const SAME_JOINT_TOL: f64 = 1e-3;
/// A resultant leaves its joint if it acts beyond an end by more than this fraction of the joint's length. A reader would
/// not see less.
const BEYOND_TOL: f64 = 0.01;
/// A joint whose normal force is below this fraction of its force has no point at which its line of action would cross
/// it nearby.
const LEAST_NORMAL_SHARE: f64 = 0.05;

/// Returns the frame with its missing forces added to the forces of its joints and robots.
pub(super) fn with_missing_forces(found: &FrameAnalysis) -> FrameAnalysis {
    let mut frame = found.clone();
    for contact in &mut frame.contacts {
        add_missing(contact, &found.failures);
    }
    for failure in &found.failures {
        let Some(robot) = failure.robot() else { continue };
        if let Some(held) = frame.robots.iter_mut().find(|held| held.robot == robot) {
            held.force += failure.force();
            held.torque += failure.torque();
        }
    }
    frame
}

/// Adds the missing forces of a joint to its resultant. The sum acts where its line of action crosses the line of the
/// joint. If it would pull, or acts almost along the joint, the joint keeps its force.
fn add_missing(contact: &mut Contact, failures: &[Failure]) {
    let interface = &contact.interface;
    let (on, middle, tangent) = (contact.resultant.on, interface.middle(), interface.tangent());
    let mut force = contact.resultant.force;
    let mut moment = cross(contact.resultant.at - middle, force);
    let mut any = false;
    for failure in failures.iter().filter(|failure| acts_at(failure, contact)) {
        if let Some((missing, _)) = failure.on(on) {
            force += missing;
            moment += cross(failure.at() - middle, missing);
            any = true;
        }
    }
    let normal = force.dot(&interface.normal);
    if any && normal > LEAST_NORMAL_SHARE * force.norm() {
        contact.resultant.at = middle + tangent * (moment / cross(tangent, force));
        contact.resultant.force = force;
        contact.normal_forces = [0.5 * normal; 2];
    }
}

fn acts_at(failure: &Failure, contact: &Contact) -> bool {
    let (Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. }) = *failure else {
        return false;
    };
    let interface = &contact.interface;
    let [from, to] = interface.ends;
    let length = (to - from).norm();
    let along = (failure.at() - from).norm() + (failure.at() - to).norm();
    interface.bodies == bodies && along <= length * (1.0 + SAME_JOINT_TOL) + f64::MIN_POSITIVE
}

/// Returns the end of the joint beyond which its resultant acts; `None` if it acts inside the joint.
pub(super) fn left_at(contact: &Contact) -> Option<Point> {
    let interface = &contact.interface;
    let along = (contact.resultant.at - interface.middle()).dot(&interface.tangent());
    let beyond = along.abs() > (0.5 + BEYOND_TOL) * interface.length();
    let nearer = interface.ends.into_iter().min_by(|a, b| {
        let far = |p: &Point| (p - contact.resultant.at).norm();
        far(a).total_cmp(&far(b))
    });
    nearer.filter(|_| beyond)
}

/// True if a joint lacks friction for its resultant, which acts inside the joint.
pub(super) fn slips(contact: &Contact, found: &FrameAnalysis) -> bool {
    let lacks = |failure: &Failure| matches!(failure, Failure::Friction { .. }) && acts_at(failure, contact);
    left_at(contact).is_none() && found.failures.iter().any(lacks)
}
