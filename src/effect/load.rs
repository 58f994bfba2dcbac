//! Loads: forces and torques on blocks beside their weight. Add no unknown.

use super::{EffectReport, Situation, counted};

/// Name in results.
pub const NAME: &str = "loads";

/// Called for when the scene lists a load on a placed block.
pub fn report(situation: &Situation) -> EffectReport {
    let (loads, placed) = (&situation.scene.loads, &situation.frame.placed);
    let acting = loads.iter().filter(|l| placed.contains(&l.block)).count();
    if loads.is_empty() {
        EffectReport::skipped(NAME, "the scene lists no loads", 0)
    } else if acting == 0 {
        EffectReport::skipped(NAME, "no listed load acts on a placed block", 0)
    } else {
        let verb = if acting == 1 {
            "acts on a placed block"
        } else {
            "act on placed blocks"
        };
        EffectReport::simulated(NAME, format!("{} {verb}", counted(acting, "load")), 0)
    }
}
