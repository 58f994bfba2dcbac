//! Vehicle: the load factor for each position of a vehicle. The effect adds no unknown to the frame's program and does not
//! change the verdict; each position is one program with other loads.

use super::{EffectName, EffectReport, counted};

/// Returns the report on the vehicle of the scene. `positions` is the number of positions that were analysed, if there are
/// any.
pub fn report(stands: bool, positions: Option<usize>) -> EffectReport {
    match (stands, positions) {
        (_, Some(count)) => EffectReport::simulated(EffectName::Vehicle, counted(count, "position"), 0),
        (true, None) => EffectReport::skipped(EffectName::Vehicle, "no position could be analysed", 0),
        (false, None) => EffectReport::skipped(EffectName::Vehicle, "the frame does not stand", 0),
    }
}
