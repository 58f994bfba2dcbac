//! Describes arrows and motions in words, with numbers and units, for tooltips and screen readers.

use super::arrow::{ArrowKind, ForceArrow};
use super::words::{force, quantity};
use crate::mechanics::analysis::Motion;
use crate::mechanics::scene::{BodyId, Scene};
pub(crate) use crate::products::wording::failure::{named, pair};

/// Describes the force that an arrow shows, such as `Weight of block a: 6 N at 270°`.
/// `unit` is the unit length, metres.
pub(crate) fn arrow(scene: &Scene, unit: f64, arrow: &ForceArrow) -> String {
    let named = |id: BodyId| named(scene, id);
    let robot = |id: crate::mechanics::scene::RobotId| format!("robot {}", scene.robots[id.0].id);
    let (on, amount) = (named(arrow.on), force(arrow.force, scene.units));
    let torque = quantity(arrow.force.norm() * unit, scene.units.torque());
    match arrow.kind {
        ArrowKind::Weight => format!("Weight of {on}: {amount}"),
        ArrowKind::Load => format!("Load on {on}: {amount}"),
        ArrowKind::Contact(from) => format!("Force on {on} from {}: {amount}", named(from)),
        ArrowKind::Normal(from) => {
            format!("Normal force on {on} from {}: {amount}", named(from))
        }
        ArrowKind::Friction(from) => {
            format!("Friction force on {on} from {}: {amount}", named(from))
        }
        ArrowKind::Robot(id) => format!("Force on {on} from {}: {amount}", robot(id)),
        ArrowKind::RobotTorque(id) => format!("Torque on {on} from {}: {torque}", robot(id)),
        ArrowKind::MissingPull(from) => {
            format!("Missing pull on {on} from {}: {amount}", named(from))
        }
        ArrowKind::MissingFriction(from) => {
            format!("Missing friction on {on} from {}: {amount}", named(from))
        }
        ArrowKind::MissingRobotForce(id) => {
            format!("Missing force on {on} from {}: {amount}", robot(id))
        }
        ArrowKind::MissingTorque(id) => {
            format!("Missing torque on {on} from {}: {torque}", robot(id))
        }
    }
}

/// Describes in which direction a block begins to move in a mechanism, and how fast it turns.
pub(crate) fn motion(scene: &Scene, motion: &Motion) -> String {
    let name = &scene.blocks[motion.block.0].id;
    let degrees = libm::atan2(motion.velocity.y, motion.velocity.x).to_degrees();
    let degrees = (degrees.round() + 360.0) % 360.0;
    let turning = motion.spin.abs().to_degrees();
    let sense = if motion.spin > 0.0 { "anticlockwise" } else { "clockwise" };
    let begins = format!("Block {name} begins to move at {degrees:.0}°");
    if turning < 5e-4 {
        format!("{begins}, without turning")
    } else {
        format!("{begins}, turning {turning:.3}° {sense} per metre that the fastest point moves")
    }
}
