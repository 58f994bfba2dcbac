//! Describes how the force polygon of a falling structure closes: only with the missing forces, or without them. Also
//! names the missing forces.

use super::{closed, outer};
use crate::mechanics::analysis::{Failure, FrameAnalysis};
use crate::mechanics::scene::{BodyId, Scene};
use crate::products::figure::arrow::{ArrowKind, Marks};
use crate::products::figure::verdict;

/// Returns two texts: why the polygon is closed, and the missing forces. If the polygon only closes with missing forces
/// from the ground or from robots, the second text names only these forces. Missing forces between two blocks act in
/// opposite pairs, so they do not change the polygon.
pub(super) fn reason(scene: &Scene, frame_analysis: &FrameAnalysis, marks: &Marks) -> (String, String) {
    let missing = || outer(marks).filter(|arrow| arrow.kind.is_failure());
    let is_robot = |kind| {
        let torque = matches!(kind, ArrowKind::MissingTorque(_));
        torque || matches!(kind, ArrowKind::MissingRobotForce(_))
    };
    let robots = missing().any(|arrow| is_robot(arrow.kind));
    let ground = missing().any(|arrow| !is_robot(arrow.kind));
    let carried = outer(marks).filter(|arrow| !arrow.kind.is_failure());
    if (robots || ground) && !closed(carried) {
        let of = match (ground, robots) {
            (true, false) => "at the ground",
            (false, _) => "from robots",
            (true, true) => "at the ground and from robots",
        };
        let mut outside = frame_analysis.clone();
        outside.failures.retain(is_outside);
        let how = format!("the force polygon closes only with the missing forces {of}");
        return (how, verdict::reason(scene, &outside));
    }
    let inside = |failure: &Failure| failure.force().norm() > 0.0 && !is_outside(failure);
    let how = if robots || ground {
        "the force polygon closes even without the missing forces, because their sum is zero"
    } else if frame_analysis.failures.iter().any(inside) {
        "the force polygon closes, because the forces missing inside the structure act in pairs"
    } else {
        "the force polygon closes, because only torques are missing"
    };
    (how.to_owned(), verdict::reason(scene, frame_analysis))
}

/// True if a missing force acts on the structure from outside: from the ground or from a robot. False for a missing
/// torque.
fn is_outside(failure: &Failure) -> bool {
    match failure {
        Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. } => {
            bodies.iter().any(|body| matches!(body, BodyId::Ground(_)))
        }
        Failure::RobotForce { .. } => true,
        Failure::RobotTorque { .. } => false,
    }
}
