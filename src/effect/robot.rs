//! Robots: a force F_x±, F_y± at the grip point of each held block, within its limits. Source:
//! [Vallat23](crate::doc::references) §2.0.6.

use super::{EffectReport, Situation, counted};

/// Name in results.
pub const NAME: &str = "robots";

/// Called for when some robot holds a placed block.
pub fn report(situation: &Situation) -> EffectReport {
    let (holds, robots) = (situation.frame.holds.len(), situation.scene.robots.len());
    if robots == 0 {
        EffectReport::skipped(NAME, "the scene has no robots", 0)
    } else if holds == 0 {
        EffectReport::skipped(NAME, "no robot holds a block", 4 * robots)
    } else {
        let verb = if holds == 1 {
            "holds a block"
        } else {
            "hold blocks"
        };
        EffectReport::simulated(
            NAME,
            format!("{} {verb}", counted(holds, "robot")),
            4 * holds,
        )
    }
}
