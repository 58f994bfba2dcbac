//! Margins: how far loads, friction, tilt, the safety kernel and the limits of robots may change before the verdict
//! changes.
//!
//! Margins add no unknown to the frame's program, because each margin solves separate programs. Sources: the load
//! factor of limit analysis, Livesley 1978; the geometric safety factor, Heyman 1966.

use super::{EffectName, EffectReport, counted};

/// The effect that this file reports on.
const NAME: EffectName = EffectName::Margins;

/// Returns the report on margins. `decided_count` is the number of verdicts that were computed for the margins, each
/// for one connected part of the structure with a changed quantity. It is `None` if margins were not requested.
pub fn report(decided_count: Option<usize>) -> EffectReport {
    match decided_count {
        None => EffectReport::skipped(NAME, "not requested", 0),
        Some(n) => EffectReport::simulated(NAME, format!("requested; computed {}", counted(n, "verdict")), 0),
    }
}
