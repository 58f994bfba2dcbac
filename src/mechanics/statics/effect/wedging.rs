//! Wedging: whether a frame stands only by a self-stress that its loads do not build up. A self-stress is a set of
//! contact forces that balance each other without any load.
//!
//! Pure statics accepts any self-stress: a block between two walls "stands" at any μ > 0, squeezed by a force that
//! nothing produces. The check for wedging adds no unknown to the frame's program and does not change the verdict.
//!
//! The model has a normal spring at every application point, which can only press, and a tangential spring along every
//! interface. All springs have the same stiffness and no stress before the loads act; friction follows Coulomb's law.
//! "Only by wedging" means that these springs have no state of rest under the loads. Source of the question and of its
//! models H and A: Kao et al. 2022, Coupled Rigid-Block Analysis.

use super::{EffectName, EffectReport};

/// The effect that this file reports on.
const NAME: EffectName = EffectName::Wedging;

/// The answer of the check for wedging.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wedging {
    /// Not requested.
    NotRequested,
    /// Not checked, because the frame does not stand.
    Falls,
    /// Undecided: a state of rest was neither found nor ruled out. The text states the reason.
    Undecided(String),
    /// The springs have a state of rest: the frame does not need wedging.
    FromRest,
    /// The springs have no state of rest; the text says how this was shown.
    OnlyByWedging(String),
}

/// Returns the report on wedging. Wedging is checked only if it was requested and the frame stands.
pub fn report(wedging: Wedging) -> EffectReport {
    match wedging {
        Wedging::NotRequested => EffectReport::skipped(NAME, "not requested", 0),
        Wedging::Falls => EffectReport::skipped(NAME, "the frame does not stand", 0),
        Wedging::Undecided(why) => EffectReport::simulated(NAME, format!("requested, but undecided: {why}"), 0),
        Wedging::FromRest => EffectReport::simulated(
            NAME,
            "requested: springs without initial stress come to rest under the loads".to_string(),
            0,
        ),
        Wedging::OnlyByWedging(shown) => EffectReport::simulated(
            NAME,
            format!("requested: springs without initial stress do not come to rest under the loads; {shown}"),
            0,
        ),
    }
}
