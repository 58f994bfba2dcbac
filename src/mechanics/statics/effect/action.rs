//! The effects that act on the assembly of a frame: loads, contacts, friction and grips. Sources: paragraphs of
//! [Vallat23](crate::doc::references).
//!
//! - Weight (§2.0.1): gravity acts on each block at its centroid. It adds no unknowns to the linear program.
//! - Contact (§2.0.1–2): two normal forces per edge interface, one at each application point. They can press but never
//!   pull.
//! - Friction (§2.0.3): |T| ≤ μ (N1 + N2) at each interface (Coulomb's law). There are two unknowns per application
//!   point, one for each edge of the friction cone: a normal force together with the full friction in one direction.
//! - Kernel (§2.0.10): each application point moves inward by the fraction kernel/2 of the interface's length. It adds
//!   no unknowns.
//! - Robots (§2.0.6): each robot that holds a block may apply a force at its grip point, with F_x and F_y within the
//!   robot's limits.
//! - Robot torque (§2.0.6): such a robot may also apply a torque, within its torque limit. In §3 every torque limit is 0,
//!   because real robots control torque poorly.
//! - Loads: forces and torques on blocks in addition to their weight. They add no unknowns.
//! - Corner contacts: forces where a corner touches an edge or another corner, or where a circle touches. §3 omits them
//!   as unreliable.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::scene::{BodyId, Limits};
use crate::mechanics::statics::assembly::{Assembly, AssemblyContact, AssemblyGrip, load_about};
use crate::mechanics::statics::interface::{ContactKind, Interface, application_points};

/// The weight of the blocks. Applies if there is gravity and a placed block has weight; sets the weight of each body
/// and the direction of gravity.
pub(super) struct Weight;

impl Effect for Weight {
    fn name(&self) -> EffectName {
        EffectName::Weight
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let scene = context.scene;
        let weights = context.frame.placed.iter();
        let weights = weights.map(|b| scene.blocks[b.0].weight);
        match weights.filter(|weight| *weight > 0.0).count() {
            _ if scene.gravity.norm() == 0.0 => Applicability::skipped("there is no gravity"),
            0 => Applicability::skipped("no placed block has weight"),
            1 => Applicability::Applies("1 block has weight".to_owned()),
            n => Applicability::Applies(format!("{} have weight", counted(n, "block"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        assembly.pull = context.scene.down();
        for body in &mut assembly.bodies {
            body.weight = context.scene.blocks[body.block.0].weight;
        }
    }
}

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
        add_contacts(context, assembly, ContactKind::Edge, |_| 0.0);
    }
}

/// Adds one contact to the assembly for each interface of the kind `kind`. `friction` returns the friction coefficient
/// of the contact.
fn add_contacts(
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
                is_factored: context.scene.has_factored_friction(interface.bodies, interface.normal),
            });
        }
    }
}

/// Friction at interfaces. Applies if μ > 0 at some interface; contributes the coefficient of each contact.
pub(super) struct Friction;

impl Effect for Friction {
    fn name(&self) -> EffectName {
        EffectName::Friction
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let rough = context.interfaces.iter().filter(|i| i.friction > 0.0);
        let (rough, all) = (rough.count(), context.interfaces.len());
        match rough {
            0 if all == 0 => Applicability::skipped("there is no interface"),
            // Four unknowns per interface: two directions of friction at each of the two application points.
            0 => Applicability::skipped_saving("μ is 0 at every interface", 4 * all),
            1 => Applicability::Applies("1 interface has friction".to_owned()),
            n => Applicability::Applies(format!("{} have friction", counted(n, "interface"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        for contact in &mut assembly.contacts {
            contact.friction = context.interfaces[contact.interface].friction;
        }
    }
}

/// The safety kernel. Applies if it is above 0 and there is an interface; moves the application points of all contacts.
pub(super) struct Kernel;

impl Effect for Kernel {
    fn name(&self) -> EffectName {
        EffectName::Kernel
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let kernel = context.scene.kernel;
        if kernel == 0.0 {
            Applicability::skipped("the kernel is 0")
        } else if context.interfaces.is_empty() {
            Applicability::skipped("there is no interface")
        } else {
            Applicability::Applies(format!(
                "forces act at least {} of each interface's length away from its ends",
                kernel / 2.0
            ))
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        for contact in &mut assembly.contacts {
            contact.points = application_points(contact.ends, context.scene.kernel);
        }
    }
}

/// Forces of robots. Applies if a robot holds a placed block; contributes one grip per hold, with the robot's limits of
/// force and a torque limit of 0.
pub(super) struct Robots;

impl Effect for Robots {
    fn name(&self) -> EffectName {
        EffectName::Robots
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let (holds, robots) = (context.frame.holds.len(), context.scene.robots.len());
        match holds {
            _ if robots == 0 => Applicability::skipped("the scene has no robots"),
            // Four unknowns per robot: two force components, each in two directions.
            0 => Applicability::skipped_saving("no robot holds a block", 4 * robots),
            1 => Applicability::Applies("1 robot holds a block".to_owned()),
            n => Applicability::Applies(format!("{} hold blocks", counted(n, "robot"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        let body_of_block = assembly.body_of_block(context.scene.blocks.len());
        for (number, hold) in context.frame.holds.iter().enumerate() {
            if let Some(body) = body_of_block[hold.block.0] {
                let limits = context.scene.robots[hold.robot.0].limits;
                assembly.grips.push(AssemblyGrip {
                    hold: number,
                    robot: hold.robot,
                    body,
                    at: hold.at,
                    limits: Limits { torque: 0.0, ..limits },
                });
            }
        }
    }
}

/// Torques of robots. Applies if the torque limit of a robot that holds a block is above 0; sets the torque limits of
/// the grips.
pub(super) struct RobotTorque;

impl Effect for RobotTorque {
    fn name(&self) -> EffectName {
        EffectName::RobotTorque
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let (robots, holds) = (&context.scene.robots, &context.frame.holds);
        let torques = holds.iter().map(|h| robots[h.robot.0].limits.torque);
        match torques.filter(|torque| *torque > 0.0).count() {
            _ if holds.is_empty() => Applicability::skipped("no robot holds a block"),
            0 => Applicability::skipped_saving("every holding robot's torque limit is 0", 2 * holds.len()),
            n => Applicability::Applies(format!("{} may apply a torque", counted(n, "holding robot"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        for grip in &mut assembly.grips {
            grip.limits.torque = context.scene.robots[grip.robot.0].limits.torque;
        }
    }
}

/// The loads that the scene lists. Applies if one of them acts on a placed block; adds the loads to the load vectors of
/// the bodies.
pub(super) struct Loads;

impl Effect for Loads {
    fn name(&self) -> EffectName {
        EffectName::Loads
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let scene = context.scene;
        if scene.loads.is_empty() {
            return Applicability::skipped("the scene lists no loads");
        }
        let mut placed = vec![false; scene.blocks.len()];
        for block in &context.frame.placed {
            placed[block.0] = true;
        }
        let mut acting: Vec<usize> = scene.loads.iter().filter(|l| placed[l.block.0]).map(|l| l.entry).collect();
        acting.dedup();
        match acting.len() {
            0 => Applicability::skipped("no listed load acts on a placed block"),
            1 => Applicability::Applies("1 load acts on a placed block".to_owned()),
            n => Applicability::Applies(format!("{} act on placed blocks", counted(n, "load"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        let body_of_block = assembly.body_of_block(context.scene.blocks.len());
        for load in context.scene.loads.iter().flat_map(|load| load.parts().into_iter().flatten()) {
            if let Some(number) = body_of_block[load.block.0] {
                let body = &mut assembly.bodies[number];
                let more = load_about(body.centroid, load.at, load.force, load.torque);
                let sum = if load.is_fixed { &mut body.fixed } else { &mut body.listed };
                *sum = sum.plus(more);
            }
        }
    }
}

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
            0 if !context.scene.corner_contacts.on_edges() => {
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
        add_contacts(context, assembly, ContactKind::Corner, |i| i.friction);
    }
}
