//! Mechanism: how the blocks begin to move where a frame falls. It is the other half of the same solution (the dual
//! unknowns of the balance are virtual velocities), so it adds none. Source: Livesley 1978 for the pair.

use super::{EffectName, EffectReport};

/// Name in results.
pub const NAME: EffectName = EffectName::Mechanism;

/// Called for when the frame is unstable.
pub fn report(unstable: bool) -> EffectReport {
    if unstable {
        EffectReport::simulated(NAME, "the frame falls".to_string(), 0)
    } else {
        EffectReport::skipped(NAME, "the frame does not fall", 0)
    }
}
