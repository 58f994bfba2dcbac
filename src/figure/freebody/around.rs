//! What lies around a block: the bodies it touches, the points at which forces act, and how much of it all is shown.

use crate::analysis::{Analysis, Contact};
use crate::geometry::{Bounds, Point};
use crate::scene::{BlockId, BodyId};

/// The bodies that touch a block, each once.
pub(super) fn neighbours(contacts: &[&Contact], block: BlockId) -> Vec<BodyId> {
    let mut bodies: Vec<BodyId> = Vec::new();
    for contact in contacts {
        for body in contact.interface.bodies {
            if body != BodyId::Block(block) && !bodies.contains(&body) {
                bodies.push(body);
            }
        }
    }
    bodies
}

/// The application points that differ: two, or one where they fall together.
pub(super) fn distinct(contact: &Contact) -> Vec<Point> {
    let [a, b] = contact.application_points;
    if (b - a).norm() > 1e-9 * (1.0 + contact.interface.length()) {
        vec![a, b]
    } else {
        vec![a]
    }
}

/// The block whole, and of its neighbours what lies near.
pub(super) fn view(analysis: &Analysis<'_>, block: BlockId, contacts: &[&Contact]) -> Bounds {
    let own = analysis.scene.blocks[block.0].body.polygon.bounds();
    let near = own.grown(0.42 * own.diagonal());
    let mut view = own.grown(0.06 * own.diagonal());
    for body in neighbours(contacts, block) {
        let bounds = analysis.scene.body(body).polygon.bounds();
        let bounds = bounds.grown(0.03 * own.diagonal());
        view = view.union(Bounds {
            min: bounds.min.sup(&near.min),
            max: bounds.max.inf(&near.max),
        });
    }
    view
}
