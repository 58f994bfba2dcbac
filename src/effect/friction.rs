//! Friction: |T| ≤ μ (N1 + N2) on each interface, two unknowns T⁺ and T⁻. Source: [Vallat23](crate::doc::references) §2.0.3.
//!
//! Both corners' friction forces act along one line, so friction belongs to the interface; posed per interface it needs
//! two unknowns where the source has four, with the same answers.

use super::{EffectReport, Situation, counted};

/// Name in results.
pub const NAME: &str = "friction";

/// Called for when some interface has μ > 0.
pub fn report(situation: &Situation) -> EffectReport {
    let rough = situation
        .interfaces
        .iter()
        .filter(|i| i.friction > 0.0)
        .count();
    let smooth = situation.interfaces.len() - rough;
    if rough == 0 {
        let why = if smooth == 0 {
            "there is no interface"
        } else {
            "μ is 0 at every interface"
        };
        EffectReport::skipped(NAME, why, 2 * smooth)
    } else {
        let has = if rough == 1 { "has" } else { "have" };
        EffectReport::simulated(
            NAME,
            format!("{} {has} friction", counted(rough, "interface")),
            2 * rough,
        )
    }
}
