//! Finds the largest contact force of a frame, and describes it.

use super::joint_name::joint_name;
use super::label::EQUAL_FORCE_TOL;
use super::words::quantity;
use crate::mechanics::analysis::{Contact, FrameAnalysis};
use crate::mechanics::scene::Scene;

/// Forces that differ from the largest by at most this fraction count as equally large.
const SIMILAR_TOL: f64 = 1e-3;

/// Returns the contact with the largest force in a frame. If several forces are equal except for rounding, the result
/// is the first of them. Returns `None` if no contact has a force.
pub(crate) fn largest_contact(frame_analysis: &FrameAnalysis) -> Option<&Contact> {
    let force = |c: &&Contact| c.resultant.force.norm();
    let contacts = frame_analysis.contacts.iter();
    contacts
        .filter(|c| force(c) > 0.0)
        .reduce(|most, c| if force(&c) > (1.0 + EQUAL_FORCE_TOL) * force(&most) { c } else { most })
}

/// Describes the largest contact force of a frame and its joint; empty if no joint has a force.
pub(crate) fn sentence(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    let Some(contact) = largest_contact(frame_analysis) else {
        return String::new();
    };
    let most = contact.resultant.force.norm();
    let alike = |c: &&Contact| c.resultant.force.norm() >= (1.0 - SIMILAR_TOL) * most;
    let joints = frame_analysis.contacts.iter().filter(alike).count();
    let pair = joint_name(scene, frame_analysis, contact);
    let others = match joints - 1 {
        0 => String::new(),
        1 => " and at one other joint".to_owned(),
        n => format!(" and at {n} other joints"),
    };
    format!("largest contact force {} between {pair}{others}", quantity(most, scene.units.force()))
}
