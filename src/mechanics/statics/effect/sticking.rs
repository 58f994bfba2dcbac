//! The effect *sticking*: the missing forces, also called adhesion. With these additional forces, from mortar or from
//! stronger robots, a falling structure would stand. They show where it fails.
//!
//! Two objectives are minimised one after the other (lexicographically): first the sum of sticking forces, then the sum
//! of all forces. Source: [Vallat23](crate::doc::references) §2.0.8, which adds both with a weight.

use super::{EffectName, EffectReport, counted};

/// The effect that this file reports on.
const NAME: EffectName = EffectName::Sticking;

/// Whether the least sticking was computed, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AdhesionSearch {
    /// Computed: admissible forces cannot balance the loads.
    Found,
    /// Not computed: the frame stands.
    NotNeeded,
    /// Not computed: the frame falls, and only its verdict was requested.
    NotRequested,
}

/// Returns the report on sticking. `blocks` is the number of blocks in the frame. `unknowns` is the number of unknowns
/// that sticking adds to the program, or that were saved because it was not computed.
pub fn report(blocks: usize, search: AdhesionSearch, unknowns: usize) -> EffectReport {
    match search {
        AdhesionSearch::Found => {
            let why = format!(
                "no admissible forces balance the {}",
                counted(blocks, "block")
            );
            EffectReport::simulated(NAME, why, unknowns)
        }
        AdhesionSearch::NotNeeded => {
            EffectReport::skipped(NAME, "the frame stands without it", unknowns)
        }
        AdhesionSearch::NotRequested => {
            let why = "only the verdict was asked for, and a motion proves that it falls";
            EffectReport::skipped(NAME, why, unknowns)
        }
    }
}
