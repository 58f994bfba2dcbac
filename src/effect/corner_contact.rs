//! Corner contacts: tips that touch edges or tips carry force. The source leaves them out as unreliable
//! ([Vallat23](crate::doc::references) §3).

use super::{EffectReport, Situation};
use crate::interface::ContactKind;

/// Name in results.
pub const NAME: &str = "corner contacts";

/// Called for when the scene asks for them and a tip touches something.
pub fn report(situation: &Situation) -> EffectReport {
    let corners = situation
        .interfaces
        .iter()
        .filter(|i| i.kind == ContactKind::Corner);
    let (count, rough) = corners.fold((0, 0), |(n, r), i| {
        (n + 1, r + usize::from(i.friction > 0.0))
    });
    if !situation.scene.corner_contacts {
        EffectReport::skipped(NAME, "not asked for; tips are unreliable", 0)
    } else if count == 0 {
        EffectReport::skipped(NAME, "no tip touches another body", 0)
    } else {
        let verb = if count == 1 {
            "tip touches"
        } else {
            "tips touch"
        };
        EffectReport::simulated(
            NAME,
            format!("{count} {verb} another body"),
            count + 2 * rough,
        )
    }
}
