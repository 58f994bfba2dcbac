//! The effect *sticking*: the missing forces, also called adhesion. With these additional forces, from mortar or from
//! stronger robots, a falling structure would stand. The missing forces show where the structure fails.
//!
//! Two objectives are minimised one after the other (lexicographically): first the sum of the missing forces, then the
//! sum of all forces. Source: [Vallat23](crate::doc::references) §2.0.8, which minimises a weighted sum of both.

use super::{EffectName, EffectReport, counted};

/// The effect that this file reports on.
const NAME: EffectName = EffectName::Sticking;

/// Whether the least missing forces were computed, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdhesionSearch {
    /// Computed, because admissible forces cannot balance the loads.
    Found,
    /// Not computed, because the frame stands.
    NotNeeded,
    /// Not computed, because the frame falls and only its verdict was requested.
    NotRequested,
}

/// Returns the report on sticking. `blocks` is the number of blocks in the frame. `unknowns` is the number of unknowns
/// that sticking adds to the linear program, or would add if it were computed.
pub fn report(blocks: usize, search: AdhesionSearch, unknowns: usize) -> EffectReport {
    match search {
        AdhesionSearch::Found => {
            let why = format!("no admissible forces balance the {}", counted(blocks, "block"));
            EffectReport::simulated(NAME, why, unknowns)
        }
        AdhesionSearch::NotNeeded => EffectReport::skipped(NAME, "the frame stands without it", unknowns),
        AdhesionSearch::NotRequested => {
            let why = "only the verdict was asked for, and a motion proves that it falls";
            EffectReport::skipped(NAME, why, unknowns)
        }
    }
}
