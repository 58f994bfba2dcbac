//! Wedging: whether a standing frame could have come to stand from an unstressed state. Pure statics accepts any
//! self-stress; a block between two walls "stands" at any μ > 0, squeezed by a force that nothing ever built up. It adds
//! no unknown to the frame's program and does not change the verdict. Source: Kao et al. 2022, Coupled Rigid-Block
//! Analysis, for the question and its H and A models.

use super::EffectReport;

/// Name in results.
pub const NAME: &str = "wedging";

/// What was found out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wedging {
    /// Nobody asked.
    NotAsked,
    /// The frame does not stand, so it does not stand by wedging either.
    Falls,
    /// It was looked for, and not every group of blocks gave an answer.
    Unclear,
    /// It was looked for.
    Found,
}

/// Called for when asked for and the frame stands.
pub fn report(wedging: Wedging) -> EffectReport {
    match wedging {
        Wedging::NotAsked => EffectReport::skipped(NAME, "not asked for", 0),
        Wedging::Falls => EffectReport::skipped(NAME, "the frame does not stand", 0),
        Wedging::Unclear => EffectReport::simulated(
            NAME,
            "asked for; the springs' forces did not settle, so it stays open".to_string(),
            0,
        ),
        Wedging::Found => EffectReport::simulated(NAME, "asked for".to_string(), 0),
    }
}
