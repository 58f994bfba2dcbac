//! Sticking: the forces a mortar, or a stronger robot, would have to give; they show where a structure fails.
//! Source: [Vallat23](crate::doc::references) §2.0.8, posed lexicographically: first the least sticking, then the
//! least force.

use super::{EffectReport, counted};

/// Name in results.
pub const NAME: &str = "sticking";

/// Called for when the program without it has no solution. `blocks` counts the frame's; `unknowns` those of sticking, as
/// posed or saved.
pub fn report(blocks: usize, needed: bool, unknowns: usize) -> EffectReport {
    if needed {
        let why = format!(
            "no admissible forces balance the {}",
            counted(blocks, "block")
        );
        EffectReport::simulated(NAME, why, unknowns)
    } else {
        EffectReport::skipped(NAME, "the program without it has a solution", unknowns)
    }
}
