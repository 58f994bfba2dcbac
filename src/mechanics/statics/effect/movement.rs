//! Movements: how a structure follows small movements of its supports. The effect adds no unknown to the frame's program
//! and does not change the verdict; each movement is one program with the same forces and another objective.

use super::{EffectName, EffectReport, counted};

/// Returns the report on the movements of supports, which the scene lists. They are computed if the frame stands.
pub fn report(movements: usize, stands: bool) -> EffectReport {
    if stands {
        EffectReport::simulated(EffectName::Movements, counted(movements, "movement"), 0)
    } else {
        EffectReport::skipped(EffectName::Movements, "the frame does not stand", 0)
    }
}
