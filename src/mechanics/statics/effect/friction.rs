//! Friction: |T| ≤ μ (N1 + N2) on each interface. Source: [Vallat23](crate::doc::references) §2.0.3.
//!
//! Each application point of a rough interface gets two more unknowns: the normal force with full friction either way.

use super::{Applicability, EffectName, FrameContext, counted};
use crate::assembly::Assembly;

/// Name in results.
pub const NAME: EffectName = EffectName::Friction;

/// Called for when some interface has μ > 0.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let rough = situation.interfaces.iter().filter(|i| i.friction > 0.0);
    let (rough, all) = (rough.count(), situation.interfaces.len());
    match rough {
        0 if all == 0 => Applicability::not("there is no interface"),
        // Two directions at each of two application points.
        0 => Applicability::Not("μ is 0 at every interface".to_owned(), 4 * all),
        1 => Applicability::For("1 interface has friction".to_owned()),
        n => Applicability::For(format!("{} have friction", counted(n, "interface"))),
    }
}

/// Gives every contact its interface's coefficient.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    for contact in &mut assembly.contacts {
        contact.friction = situation.interfaces[contact.interface].friction;
    }
}
