//! Margins: how far a frame is from the edge of standing. They add no unknown to the frame's program; each poses
//! programs of its own. Source: the load factor of limit analysis, Livesley 1978; Heyman 1966 for geometry.

use super::{EffectName, EffectReport, counted};

/// Name in results.
pub const NAME: EffectName = EffectName::Margins;

/// Called for when asked for; `judged` is how many changed frames were judged for them.
pub fn report(judged: Option<usize>) -> EffectReport {
    match judged {
        None => EffectReport::skipped(NAME, "not asked for", 0),
        Some(n) => EffectReport::simulated(
            NAME,
            format!("asked for; {} judged", counted(n, "changed frame")),
            0,
        ),
    }
}
