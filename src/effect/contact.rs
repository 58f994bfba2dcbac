//! Contact: two normal forces per edge interface, one per corner contact, pressing only. Source:
//! [Vallat23](crate::doc::references) §2.0.1–2.

use super::{EffectReport, Situation, counted};
use crate::interface::ContactKind;

/// Name in results.
pub const NAME: &str = "contact";

/// Called for when two bodies touch.
pub fn report(situation: &Situation) -> EffectReport {
    let interfaces = situation.interfaces;
    let unknowns: usize = interfaces
        .iter()
        .map(|i| if i.kind == ContactKind::Edge { 2 } else { 1 })
        .sum();
    if interfaces.is_empty() {
        EffectReport::skipped(NAME, "no two bodies touch", 0)
    } else {
        EffectReport::simulated(NAME, counted(interfaces.len(), "interface"), unknowns)
    }
}
