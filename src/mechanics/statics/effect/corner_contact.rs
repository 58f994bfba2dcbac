//! Corner contacts: contact forces where a corner touches an edge or another corner, or where a circle touches.
//!
//! [Vallat23](crate::doc::references) §3 omits them as unreliable.

use super::{Applicability, Effect, EffectName, FrameContext, contact, counted};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::interface::ContactKind;

/// Forces at points. Applies if the scene requests corner contacts and a corner touches another body, if a circle
/// touches, or if the scene lists its contacts. Contributes one contact with friction and one application point for each.
pub(super) struct CornerContacts;

impl Effect for CornerContacts {
    fn name(&self) -> EffectName {
        EffectName::CornerContacts
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let kinds = context.interfaces.iter().map(|i| i.kind);
        let count = kinds.filter(|kind| *kind == ContactKind::Corner).count();
        let mut bodies = context.interfaces.iter().flat_map(|i| i.bodies);
        let circles = bodies.any(|body| context.scene.body(body).circle.is_some());
        match count {
            0 if !context.scene.corner_contacts => {
                Applicability::skipped("not requested; corner contacts are unreliable")
            }
            0 => Applicability::skipped("no corner touches another body"),
            1 if context.scene.lists_contacts() => Applicability::Applies("the scene lists 1 contact".to_owned()),
            n if context.scene.lists_contacts() => Applicability::Applies(format!("the scene lists {n} contacts")),
            _ if circles => {
                Applicability::Applies(format!("{} at which a circle or a corner touches", counted(count, "point")))
            }
            1 => Applicability::Applies("1 corner touches another body".to_owned()),
            n => Applicability::Applies(format!("{n} corners touch another body")),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        contact::add(context, assembly, ContactKind::Corner, |i| i.friction);
    }
}
