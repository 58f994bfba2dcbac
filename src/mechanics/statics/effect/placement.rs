//! Placement: how accurately the blocks of a frame must be placed. The effect adds no unknown to the frame's program and
//! does not change the verdict; its own programs have forces that are affine in the errors.

use super::{EffectName, EffectReport};

/// Returns the report on the placement tolerance, which was requested. It is computed if the frame stands.
pub fn report(stands: bool) -> EffectReport {
    if stands {
        let why = "requested: errors of joints, centres of gravity and loads, all independent".to_owned();
        EffectReport::simulated(EffectName::Placement, why, 0)
    } else {
        EffectReport::skipped(EffectName::Placement, "the frame does not stand", 0)
    }
}
