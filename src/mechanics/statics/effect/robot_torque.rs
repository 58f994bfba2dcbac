//! Robot torque: M± about the grip point, where a holding robot's torque limit is above 0. Source:
//! [Vallat23](crate::doc::references) §2.0.6;
//! its §3 sets every torque limit to 0, because real robots control torque badly.

use super::{Applicability, EffectName, FrameContext, counted};
use crate::assembly::Assembly;

/// Name in results.
pub const NAME: EffectName = EffectName::RobotTorque;

/// Called for when a holding robot may give a torque.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let (robots, holds) = (&situation.scene.robots, &situation.frame.holds);
    let torques = holds.iter().map(|h| robots[h.robot.0].limits.torque);
    match torques.filter(|torque| *torque > 0.0).count() {
        _ if holds.is_empty() => Applicability::not("no robot holds a block"),
        0 => Applicability::Not(
            "every holding robot's torque limit is 0".to_owned(),
            2 * holds.len(),
        ),
        n => Applicability::For(format!("{} may give a torque", counted(n, "holding robot"))),
    }
}

/// Gives every grip its robot's limit on torque.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    for grip in &mut assembly.grips {
        grip.limits.torque = situation.scene.robots[grip.robot.0].limits.torque;
    }
}
