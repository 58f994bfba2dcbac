//! Wedging: whether a standing frame could have come to stand from an unstressed state. Pure statics accepts any
//! self-stress; a block between two walls "stands" at any μ > 0, squeezed by a force that nothing ever built up. It adds
//! no unknown to the frame's program and does not change the verdict. Source: Kao et al. 2022, Coupled Rigid-Block
//! Analysis, for the question and its H and A models.
//!
//! The answer is about springs: one that only presses at every application point, one along every interface, all of one
//! stiffness and without stress before the loads act, friction after Coulomb. "Only by wedging" says that no such springs
//! come to rest.

use super::{EffectName, EffectReport};

/// Name in results.
pub const NAME: EffectName = EffectName::Wedging;

/// What was found out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wedging {
    /// Nobody asked.
    NotAsked,
    /// The frame does not stand, so it does not stand by wedging either.
    Falls,
    /// Neither a rest was found nor shown that there is none; why.
    Open(String),
    /// Springs come to rest.
    FromRest,
    /// None do; what was shown.
    Only(String),
}

/// Called for when asked for and the frame stands.
pub fn report(wedging: Wedging) -> EffectReport {
    match wedging {
        Wedging::NotAsked => EffectReport::skipped(NAME, "not asked for", 0),
        Wedging::Falls => EffectReport::skipped(NAME, "the frame does not stand", 0),
        Wedging::Open(why) => {
            EffectReport::simulated(NAME, format!("asked for and left open: {why}"), 0)
        }
        Wedging::FromRest => EffectReport::simulated(
            NAME,
            "asked for: springs without stress come to rest under the loads".to_string(),
            0,
        ),
        Wedging::Only(shown) => EffectReport::simulated(
            NAME,
            format!("asked for: no springs without stress come to rest under the loads; {shown}"),
            0,
        ),
    }
}
