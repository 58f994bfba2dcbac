//! [`parts`]: returns the forces of an interface that are drawn as arrows: the resultant, or the normal force and the
//! friction force.

use super::super::arrow::ArrowKind;
use super::super::option::ForceStyle;
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::Contact;
use crate::mechanics::scene::BodyId;

/// A force of an interface on the first of its two bodies.
pub(super) struct InterfaceForce {
    /// A function that returns the kind of the arrow. Its argument is the body that exerts the force.
    pub kind: fn(BodyId) -> ArrowKind,
    /// The force, N.
    pub force: Vector,
    /// The point where it acts, metres.
    pub at: Point,
}

/// Returns the forces of an interface on the first of its two bodies. `style` selects one resultant, or the normal
/// force and the friction force.
pub(super) fn parts(contact: &Contact, style: ForceStyle) -> Vec<InterfaceForce> {
    let at = contact.resultant.at;
    let part = |kind, force| InterfaceForce { kind, force, at };
    match style {
        ForceStyle::Resultant => {
            let on_first = contact.resultant.on == contact.interface.bodies[0];
            let force = contact.resultant.force;
            vec![part(ArrowKind::Contact, if on_first { force } else { -force })]
        }
        ForceStyle::Components => {
            let normal = contact.interface.normal;
            let pressed: f64 = contact.normal_forces.iter().sum();
            vec![
                part(ArrowKind::Normal, normal * pressed),
                part(ArrowKind::Friction, quarter_turn(normal) * contact.friction_force),
            ]
        }
    }
}
