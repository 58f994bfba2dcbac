//! Robots: a force F_x±, F_y± at the grip point of each held block, within its limits. Source:
//! [Vallat23](crate::doc::references) §2.0.6.

use super::{Applicability, EffectName, FrameContext, counted};
use crate::assembly::{Assembly, AssemblyGrip};
use crate::scene::Limits;

/// Name in results.
pub const NAME: EffectName = EffectName::Robots;

/// Called for when some robot holds a placed block.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let (holds, robots) = (situation.frame.holds.len(), situation.scene.robots.len());
    match holds {
        _ if robots == 0 => Applicability::not("the scene has no robots"),
        // Two components, each either way.
        0 => Applicability::Not("no robot holds a block".to_owned(), 4 * robots),
        1 => Applicability::For("1 robot holds a block".to_owned()),
        n => Applicability::For(format!("{} hold blocks", counted(n, "robot"))),
    }
}

/// Adds a grip for every hold, with the robot's limits on force and none of its torque.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    let numbers = assembly.numbers(situation.scene.blocks.len());
    for (number, hold) in situation.frame.holds.iter().enumerate() {
        if let Some(body) = numbers[hold.block.0] {
            let limits = situation.scene.robots[hold.robot.0].limits;
            assembly.grips.push(AssemblyGrip {
                hold: number,
                robot: hold.robot,
                body,
                at: hold.at,
                limits: Limits {
                    torque: 0.0,
                    ..limits
                },
            });
        }
    }
}
