//! Contact: two normal forces per edge interface, one at each application point. They can press but never pull.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.1–2.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::scene::BodyId;
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact};
use crate::mechanics::statics::interface::{ContactKind, Interface};

/// Normal forces between edges that touch. Applies if two bodies touch; contributes one contact without friction per
/// edge interface.
pub(super) struct Contact;

impl Effect for Contact {
    fn name(&self) -> EffectName {
        EffectName::Contact
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        match context.interfaces.len() {
            0 => Applicability::skipped("no two bodies touch"),
            n => Applicability::Applies(counted(n, "interface")),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        add(context, assembly, ContactKind::Edge, |_| 0.0);
    }
}

/// Adds one contact to the assembly for each interface of the kind `kind`. `friction` returns the friction coefficient
/// of the contact.
pub(super) fn add(
    context: &FrameContext,
    assembly: &mut Assembly,
    kind: ContactKind,
    friction: impl Fn(&Interface) -> f64,
) {
    let body_of_block = assembly.body_of_block(context.scene.blocks.len());
    let body = |id: BodyId| match id {
        BodyId::Ground(_) => None,
        BodyId::Block(block) => body_of_block[block.0],
    };
    for (number, interface) in context.interfaces.iter().enumerate() {
        let [on, from] = interface.bodies.map(body);
        if let (true, Some(on)) = (interface.kind == kind, on) {
            assembly.contacts.push(AssemblyContact {
                interface: number,
                bodies: interface.bodies,
                on,
                from,
                kind,
                ends: interface.ends,
                points: interface.ends,
                normal: interface.normal,
                friction: friction(interface),
            });
        }
    }
}
