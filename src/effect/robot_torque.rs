//! Robot torque: M± about the grip point, where a holding robot's torque limit is above 0. Source:
//! [Vallat23](crate::doc::references) §2.0.6;
//! its §3 sets every torque limit to 0, because real robots control torque badly.

use super::{EffectReport, Situation, counted};

/// Name in results.
pub const NAME: &str = "robot torque";

/// Called for when a holding robot may give a torque.
pub fn report(situation: &Situation) -> EffectReport {
    let robots = &situation.scene.robots;
    let holds = &situation.frame.holds;
    let strong = holds
        .iter()
        .filter(|h| robots[h.robot.0].limits.torque > 0.0)
        .count();
    if holds.is_empty() {
        EffectReport::skipped(NAME, "no robot holds a block", 0)
    } else if strong == 0 {
        EffectReport::skipped(
            NAME,
            "every holding robot's torque limit is 0",
            2 * holds.len(),
        )
    } else {
        EffectReport::simulated(
            NAME,
            format!("{} may give a torque", counted(strong, "holding robot")),
            2 * strong,
        )
    }
}
