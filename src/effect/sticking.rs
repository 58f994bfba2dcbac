//! Sticking: the forces a mortar, or a stronger robot, would have to give; they show where a structure fails.
//! Source: [Vallat23](crate::doc::references) §2.0.8, posed lexicographically: first the least sticking, then the
//! least force.

use super::{EffectReport, Situation, counted};
use crate::interface::ContactKind;

/// Name in results.
pub const NAME: &str = "sticking";

/// Called for when the program without it has no solution.
pub fn report(situation: &Situation, needed: bool) -> EffectReport {
    let contacts: usize = situation
        .interfaces
        .iter()
        .map(|i| if i.kind == ContactKind::Edge { 4 } else { 3 })
        .sum();
    let unknowns = contacts + 6 * situation.frame.holds.len();
    if needed {
        let why = format!(
            "no admissible forces balance the {}",
            counted(situation.frame.placed.len(), "block")
        );
        EffectReport::simulated(NAME, why, unknowns)
    } else {
        EffectReport::skipped(NAME, "the program without it has a solution", unknowns)
    }
}
