//! Contact: two normal forces per edge interface, pressing only. Source: [Vallat23](crate::doc::references) §2.0.1–2.

use super::{Applicability, EffectName, FrameContext, counted};
use crate::assembly::{Assembly, AssemblyContact};
use crate::interface::{ContactKind, Interface};
use crate::scene::BodyId;

/// Name in results.
pub const NAME: EffectName = EffectName::Contact;

/// Called for when two bodies touch.
pub fn called_for(situation: &FrameContext) -> Applicability {
    match situation.interfaces.len() {
        0 => Applicability::not("no two bodies touch"),
        n => Applicability::For(counted(n, "interface")),
    }
}

/// Adds a smooth contact for every edge interface.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    add(situation, assembly, ContactKind::Edge, |_| 0.0);
}

/// Adds a contact for every interface of a kind, with the friction given for each.
pub(super) fn add(
    situation: &FrameContext,
    assembly: &mut Assembly,
    kind: ContactKind,
    friction: impl Fn(&Interface) -> f64,
) {
    let numbers = assembly.numbers(situation.scene.blocks.len());
    let body = |id: BodyId| match id {
        BodyId::Ground(_) => None,
        BodyId::Block(block) => numbers[block.0],
    };
    for (number, interface) in situation.interfaces.iter().enumerate() {
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
