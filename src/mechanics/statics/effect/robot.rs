//! Robots: each robot that holds a block may apply a force at its grip point. The components F_x and F_y of the force
//! are within the robot's limits.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.6.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::scene::Limits;
use crate::mechanics::statics::assembly::{Assembly, AssemblyGrip};

/// Forces of robots. Applies if a robot holds a placed block; contributes one grip per hold, with the robot's limits of
/// force and a torque limit of 0.
pub(super) struct Robots;

impl Effect for Robots {
    fn name(&self) -> EffectName {
        EffectName::Robots
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let (holds, robots) = (context.frame.holds.len(), context.scene.robots.len());
        match holds {
            _ if robots == 0 => Applicability::skipped("the scene has no robots"),
            // Four unknowns per robot: two force components, each in two directions.
            0 => Applicability::skipped_saving("no robot holds a block", 4 * robots),
            1 => Applicability::Applies("1 robot holds a block".to_owned()),
            n => Applicability::Applies(format!("{} hold blocks", counted(n, "robot"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        let body_of_block = assembly.body_of_block(context.scene.blocks.len());
        for (number, hold) in context.frame.holds.iter().enumerate() {
            if let Some(body) = body_of_block[hold.block.0] {
                let limits = context.scene.robots[hold.robot.0].limits;
                assembly.grips.push(AssemblyGrip {
                    hold: number,
                    robot: hold.robot,
                    body,
                    at: hold.at,
                    limits: Limits { torque: 0.0, ..limits },
                });
            }
        }
    }
}
