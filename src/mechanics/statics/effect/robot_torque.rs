//! Robot torque: each robot that holds a block may also apply a torque to the block, within the robot's torque limit.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.6. In §3 of that paper every torque limit is 0, because real robots
//! control torque poorly.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::statics::assembly::Assembly;

/// Torques of robots. Applies if the torque limit of a robot that holds a block is above 0; sets the torque limits of
/// the grips.
pub(super) struct RobotTorque;

impl Effect for RobotTorque {
    fn name(&self) -> EffectName {
        EffectName::RobotTorque
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let (robots, holds) = (&context.scene.robots, &context.frame.holds);
        let torques = holds.iter().map(|h| robots[h.robot.0].limits.torque);
        match torques.filter(|torque| *torque > 0.0).count() {
            _ if holds.is_empty() => Applicability::skipped("no robot holds a block"),
            0 => Applicability::skipped_saving("every holding robot's torque limit is 0", 2 * holds.len()),
            n => Applicability::Applies(format!("{} may apply a torque", counted(n, "holding robot"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        for grip in &mut assembly.grips {
            grip.limits.torque = context.scene.robots[grip.robot.0].limits.torque;
        }
    }
}
