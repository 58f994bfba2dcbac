//! Weight: each block's own weight at its centroid, along gravity. Adds no unknown. Source:
//! [Vallat23](crate::doc::references) §2.0.1.

use super::{EffectReport, Situation, counted};

/// Name in results.
pub const NAME: &str = "weight";

/// Called for when some placed block has weight and gravity has a direction.
pub fn report(situation: &Situation) -> EffectReport {
    let scene = situation.scene;
    let heavy = situation
        .frame
        .placed
        .iter()
        .filter(|b| scene.blocks[b.0].weight > 0.0)
        .count();
    if scene.gravity.norm() == 0.0 {
        EffectReport::skipped(NAME, "there is no gravity", 0)
    } else if heavy == 0 {
        EffectReport::skipped(NAME, "no placed block has weight", 0)
    } else {
        let has = if heavy == 1 { "has" } else { "have" };
        EffectReport::simulated(NAME, format!("{} {has} weight", counted(heavy, "block")), 0)
    }
}
