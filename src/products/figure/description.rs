//! Describes blocks, arrows and motions in words, with numbers and units, for tooltips and screen readers.

use super::arrow::{ArrowKind, ForceArrow, TurnArrow, TurnKind};
use super::context::FigureContext;
use super::words::{force, quantity};
use crate::mechanics::analysis::Motion;
use crate::mechanics::scene::{Block, BodyId, Scene};
pub(crate) use crate::products::wording::failure::{named, pair};

/// Returns the weight of a block and the value that its colour shows, in words. `place` is the index of the block among
/// the placed blocks of the frame.
pub(crate) fn block(context: &FigureContext<'_>, frame: usize, place: usize, block: &Block) -> String {
    let weight = quantity(block.weight, context.analysis.scene.units.force());
    if !context.colours_show_amplitudes {
        return format!("weight {weight}");
    }
    let fill = context.fills.description(context.fills.shares[frame][place]);
    if fill.is_empty() {
        return format!("weight {weight}");
    }
    format!("weight {weight}, {fill}")
}

/// True if a missing force is drawn as a dot because its arrow is too short to be visible (`seen` is false). The two
/// opposite forces between two blocks have only one dot.
pub(crate) fn dotted(arrow: &ForceArrow, seen: bool) -> bool {
    let twice = match (arrow.kind.partner(), arrow.on) {
        (Some(BodyId::Block(partner)), BodyId::Block(on)) => partner.0 < on.0,
        _ => false,
    };
    !seen && !twice && arrow.kind.is_failure()
}

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

/// Describes the torque that an arrow shows, such as `Torque of a load on block a: 6 N·m clockwise`.
pub(crate) fn turn(context: &FigureContext<'_>, turn: &TurnArrow) -> String {
    let scene = &context.analysis.scene;
    let direction = if turn.torque > 0.0 { "anticlockwise" } else { "clockwise" };
    let amount = format!("{} {direction}", quantity(turn.torque.abs(), context.analysis.scene.units.torque()));
    let on = scene.name(turn.on);
    match turn.kind {
        TurnKind::Load => format!("Torque of a load on block {on}: {amount}"),
        TurnKind::Robot(id) => format!("Torque on block {on} from robot {}: {amount}", scene.robots[id.0].id),
        TurnKind::Missing(id) => {
            format!("Missing torque on block {on} from robot {}: {amount}", scene.robots[id.0].id)
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
