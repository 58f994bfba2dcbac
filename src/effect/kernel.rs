//! Safety kernel: application points move inward by half the kernel of the stretch. Adds no unknown. Source:
//! [Vallat23](crate::doc::references) §2.0.10.

use super::{EffectReport, Situation};

/// Name in results.
pub const NAME: &str = "kernel";

/// Called for when the kernel is above 0 and there is an interface to shrink.
pub fn report(situation: &Situation) -> EffectReport {
    let kernel = situation.scene.kernel;
    if kernel == 0.0 {
        EffectReport::skipped(NAME, "the kernel is 0", 0)
    } else if situation.interfaces.is_empty() {
        EffectReport::skipped(NAME, "there is no interface", 0)
    } else {
        EffectReport::simulated(
            NAME,
            format!(
                "forces keep {} of each stretch away from its ends",
                kernel / 2.0
            ),
            0,
        )
    }
}
