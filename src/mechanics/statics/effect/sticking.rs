//! Sticking: the forces a mortar, or a stronger robot, would have to give; they show where a structure fails.
//! Source: [Vallat23](crate::doc::references) §2.0.8, posed lexicographically: first the least sticking, then the
//! least force.

use super::{EffectName, EffectReport, counted};

/// Name in results.
pub const NAME: EffectName = EffectName::Sticking;

/// Whether sticking was sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// It was, and something would have to stick.
    Found,
    /// There was nothing to seek.
    NotNeeded,
    /// The frame falls, and only its verdict was asked for.
    NotAsked,
}

/// Called for when the program without it has no solution, and more than the verdict is asked for. `blocks` counts the
/// frame's; `unknowns` those of sticking, as posed or saved.
pub fn report(blocks: usize, sought: Sought, unknowns: usize) -> EffectReport {
    match sought {
        Sought::Found => {
            let why = format!(
                "no admissible forces balance the {}",
                counted(blocks, "block")
            );
            EffectReport::simulated(NAME, why, unknowns)
        }
        Sought::NotNeeded => {
            EffectReport::skipped(NAME, "the program without it has a solution", unknowns)
        }
        Sought::NotAsked => {
            let why = "only the verdict was asked for, and a motion proves that it falls";
            EffectReport::skipped(NAME, why, unknowns)
        }
    }
}
