//! Finds the robots that are at a limit of their force or torque.

use super::words::FULL_UTILISATION;
use crate::mechanics::analysis::{FrameAnalysis, RobotForce, Verdict};
use crate::mechanics::scene::{RobotId, Scene};

/// True if at least one limit of a robot, for a force or a torque, is finite and larger than 0.
pub(crate) fn has_limits(scene: &Scene, robot: RobotId) -> bool {
    let limits = scene.robots[robot.0].limits;
    let finite = |limit: f64| limit.is_finite() && limit > 0.0;
    finite(limits.fx) || finite(limits.fy) || finite(limits.torque)
}

/// Returns the robots whose force or torque reaches one of their limits in a frame. The list is empty if the frame does
/// not stand.
pub(crate) fn robots_reached<'a>(scene: &Scene, frame_analysis: &'a FrameAnalysis) -> Vec<&'a RobotForce> {
    let stands = frame_analysis.verdict == Verdict::Stable;
    let robots = frame_analysis.robots.iter().filter(|_| stands);
    let reached = robots.filter(|r| r.limit_used >= FULL_UTILISATION);
    reached.filter(|r| has_limits(scene, r.robot)).collect()
}
