//! Friction: |T| ≤ μ (N1 + N2) on each interface. Source: [Vallat23](crate::doc::references) §2.0.3.
//!
//! Each application point of a rough interface gets two more unknowns: the normal force with full friction either way.

use super::{Call, EffectName, Situation, counted};
use crate::assembly::Assembly;

/// Name in results.
pub const NAME: EffectName = EffectName::Friction;

/// Called for when some interface has μ > 0.
pub fn called_for(situation: &Situation) -> Call {
    let rough = situation.interfaces.iter().filter(|i| i.friction > 0.0);
    let (rough, all) = (rough.count(), situation.interfaces.len());
    match rough {
        0 if all == 0 => Call::not("there is no interface"),
        // Two directions at each of two application points.
        0 => Call::Not("μ is 0 at every interface".to_owned(), 4 * all),
        1 => Call::For("1 interface has friction".to_owned()),
        n => Call::For(format!("{} have friction", counted(n, "interface"))),
    }
}

/// Gives every contact its interface's coefficient.
pub fn contribute(situation: &Situation, assembly: &mut Assembly) {
    for contact in &mut assembly.contacts {
        contact.friction = situation.interfaces[contact.interface].friction;
    }
}
