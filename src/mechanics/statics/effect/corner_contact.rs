//! Corner contacts: tips that touch edges or tips carry force. The source leaves them out as unreliable
//! ([Vallat23](crate::doc::references) §3).

use super::{Applicability, EffectName, FrameContext, contact};
use crate::assembly::Assembly;
use crate::interface::ContactKind;

/// Name in results.
pub const NAME: EffectName = EffectName::CornerContacts;

/// Called for when the scene asks for them and a tip touches something.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let kinds = situation.interfaces.iter().map(|i| i.kind);
    let count = kinds.filter(|kind| *kind == ContactKind::Corner).count();
    match count {
        _ if !situation.scene.corner_contacts => {
            Applicability::not("not asked for; tips are unreliable")
        }
        0 => Applicability::not("no tip touches another body"),
        1 => Applicability::For("1 tip touches another body".to_owned()),
        n => Applicability::For(format!("{n} tips touch another body")),
    }
}

/// Adds a contact with one application point for every tip, friction included.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    contact::add(situation, assembly, ContactKind::Corner, |i| i.friction);
}
