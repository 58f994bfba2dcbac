//! Describes in words which forces are missing at the failures of a frame, for tables, captions and sentences.

use std::collections::{BTreeMap, BTreeSet};

use super::number::{NO_BREAK, listed, place, quantity};
use crate::mechanics::analysis::{Failure, FrameAnalysis, SolvedFrame};
use crate::mechanics::scene::{BlockId, BodyId, CornerContacts, RobotId, Scene};
use crate::mechanics::statics::interface::{ContactKind, Interfaces};
use crate::text::first_of;

/// Largest number of unsupported blocks that are named. All further blocks are only counted.
const MAX_LISTED_BLOCKS: usize = 6;

/// Returns the magnitude of the force (N) or torque (N·m) that is missing at a failure.
pub fn magnitude(failure: &Failure) -> f64 {
    failure.force().norm() + failure.torque().abs()
}

/// Returns the failures of a frame, sorted by the magnitude of the missing force, largest first. Equal failures keep
/// their order.
pub fn by_amount(frame_analysis: &FrameAnalysis) -> Vec<&Failure> {
    let mut failures: Vec<&Failure> = frame_analysis.failures.iter().collect();
    failures.sort_by(|a, b| magnitude(b).total_cmp(&magnitude(a)));
    failures
}

/// Returns the name of a body for a sentence: `block 2` or `the ground`.
pub fn named(scene: &Scene, body: BodyId) -> String {
    match body {
        BodyId::Ground(_) => ground(scene, body).to_owned(),
        BodyId::Block(_) => format!("block {}", scene.name(body)),
    }
}

/// Returns the name of a part of the ground for a sentence: its id, or `the ground`.
fn ground(scene: &Scene, body: BodyId) -> &str {
    match scene.name(body) {
        "ground" => "the ground",
        id => id,
    }
}

/// Returns the names of the two bodies of an interface: `2 and the ground`.
pub fn pair(scene: &Scene, bodies: [BodyId; 2]) -> String {
    let [a, b] = bodies.map(|id| match id {
        BodyId::Ground(_) => ground(scene, id),
        BodyId::Block(_) => scene.name(id),
    });
    format!("{a} and {b}")
}

/// Writes the magnitude of the missing force or torque with its unit.
fn stated(scene: &Scene, failure: &Failure) -> String {
    let is_torque = matches!(failure, Failure::RobotTorque { .. });
    quantity(magnitude(failure), if is_torque { scene.units.torque() } else { scene.units.force() })
}

/// Describes a failure, its position and the missing force, as a sentence without a full stop.
pub fn sentence(scene: &Scene, failure: &Failure) -> String {
    let (stated, at) = (stated(scene, failure), place(failure.at(), scene.units));
    match *failure {
        Failure::Tension { bodies, .. } => {
            let [a, b] = bodies.map(|body| scene.name(body));
            format!("{a} comes off {b} at {at}: holding them together would need a pull of {stated}")
        }
        Failure::Friction { bodies, .. } => {
            let [a, b] = bodies.map(|body| scene.name(body));
            format!("{a} slides along {b} at {at}: stopping it would need {stated} more than friction can give")
        }
        Failure::RobotForce { robot, block, force, .. } => {
            // A component that is a rounding error of the other one is 0.
            let part = |value: f64| if value.abs() <= 1e-9 * force.norm() { 0.0 } else { value };
            format!(
                "robot {} cannot hold {}: it would need an additional force of ({}, {}) beyond its limits",
                scene.robots[robot.0].id,
                scene.blocks[block.0].id,
                quantity(part(force.x), scene.units.force()),
                quantity(part(force.y), scene.units.force())
            )
        }
        Failure::RobotTorque { robot, block, torque, .. } => format!(
            "robot {} cannot hold {}: it would need an additional {} torque of {stated} beyond its limit",
            scene.robots[robot.0].id,
            scene.blocks[block.0].id,
            if torque < 0.0 { "clockwise" } else { "anticlockwise" }
        ),
    }
}

/// Describes the missing force of a failure as a noun phrase, for a list: `a pull of 8 N between a and b`.
pub fn missing_phrase(scene: &Scene, failure: &Failure) -> String {
    let stated = stated(scene, failure).replace(' ', &NO_BREAK.to_string());
    let robot = |robot: &RobotId| format!("robot{NO_BREAK}{}", scene.robots[robot.0].id);
    match failure {
        Failure::Tension { bodies, .. } => format!("a pull of {stated} between {}", pair(scene, *bodies)),
        Failure::Friction { bodies, .. } => format!("friction of {stated} between {}", pair(scene, *bodies)),
        Failure::RobotForce { robot: id, .. } => format!("a force of {stated} from {}", robot(id)),
        Failure::RobotTorque { robot: id, .. } => format!("a torque of {stated} from {}", robot(id)),
    }
}

/// Describes the missing force of a failure as a clause: `block a would have to stick to block b with 8 N`.
pub fn missing_sentence(scene: &Scene, failure: &Failure) -> String {
    let (stated, named) = (stated(scene, failure), |id: &BodyId| named(scene, *id));
    let robot = |robot: &RobotId| &scene.robots[robot.0].id;
    match failure {
        Failure::Tension { bodies: [a, b], .. } => {
            format!("{} would have to stick to {} with {stated}", named(a), named(b))
        }
        Failure::Friction { bodies: [a, b], .. } => {
            format!("{} slides along {}, and friction would have to give {stated} more", named(a), named(b))
        }
        Failure::RobotForce { robot: id, .. } => format!("robot {} would have to give {stated} more", robot(id)),
        Failure::RobotTorque { robot: id, .. } => {
            format!("robot {} would have to give {stated} more torque", robot(id))
        }
    }
}

/// Names the blocks that even adhesion at all contacts could not hold: `nothing carries block a`. Returns `None` if
/// there are no such blocks.
pub fn unsupported_phrase(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let blocks = frame_analysis.unsupported.iter();
    let names: Vec<String> = blocks.map(|b| scene.blocks[b.0].id.clone()).collect();
    let what = if names.len() == 1 { "block" } else { "blocks" };
    (!names.is_empty()).then(|| format!("nothing carries {what} {}", listed(&shortened(names, MAX_LISTED_BLOCKS))))
}

/// Explains why blocks are unsupported: one sentence for each reason, each with the names of at most `max` blocks.
/// Returns an empty list if all blocks are supported.
pub fn unsupported(solved: SolvedFrame<'_>, max: usize) -> Vec<String> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let reached = reached(frame_analysis);
    let (touching, apart): (Vec<BlockId>, Vec<BlockId>) =
        frame_analysis.unsupported.iter().partition(|id| reached.contains(id));
    let reasons = [
        (apart, "no chain of contacts leads to the ground or to a robot"),
        (touching, "even if all contacts could stick and no robot had limits, no forces would balance the loads"),
    ];
    let mut sentences = Vec::new();
    for (blocks, reason) in reasons {
        if !blocks.is_empty() {
            let names = first_of(blocks.iter().map(|id| scene.blocks[id.0].id.as_str()), max);
            sentences.push(format!("nothing carries {names}: {reason}"));
        }
    }
    sentences.extend(touching_corner(solved));
    sentences
}

/// In scenes with more blocks, no corner contacts are searched for an explanation.
const MAX_BLOCKS_WITH_CORNERS: usize = 1000;

/// If a corner of an unsupported block touches another body, returns a sentence that explains why this carries nothing.
/// Returns `None` if there is no such corner, or if corners carry force in this scene.
fn touching_corner(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let unsupported = &frame_analysis.unsupported;
    if scene.corner_contacts.on_edges() || unsupported.is_empty() || scene.blocks.len() > MAX_BLOCKS_WITH_CORNERS {
        return None;
    }
    let is_unsupported = |id: &BodyId| matches!(id, BodyId::Block(block) if unsupported.contains(block));
    let placed = frame_analysis.contacts.iter().flat_map(|contact| contact.interface.bodies);
    let placed: BTreeSet<BodyId> = placed.chain(unsupported.iter().copied().map(BodyId::Block)).collect();
    let is_placed = |id: &BodyId| matches!(id, BodyId::Ground(_)) || placed.contains(id);
    let with_corners = Scene { corner_contacts: CornerContacts::ALL, ..scene.clone() };
    let corner = Interfaces::new(&with_corners).all.into_iter().find(|interface| {
        interface.kind == ContactKind::Corner
            && !frame_analysis.contacts.iter().any(|contact| contact.interface == *interface)
            && interface.bodies.iter().any(is_unsupported)
            && interface.bodies.iter().all(is_placed)
    })?;
    let [a, b] = corner.bodies.map(|body| scene.name(body));
    Some(format!(
        "{a} and {b} touch only at a corner, at {}, which carries force only in a scene with \"corner_contacts\": true",
        place(corner.middle(), scene.units)
    ))
}

/// Returns the blocks that a chain of contacts connects to the ground or to a block that a robot holds, found by a
/// search in the graph of contacts.
fn reached(frame_analysis: &FrameAnalysis) -> BTreeSet<BlockId> {
    let mut neighbours: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    let mut next: Vec<BlockId> = frame_analysis.robots.iter().map(|robot| robot.block).collect();
    for contact in &frame_analysis.contacts {
        match contact.interface.bodies {
            [BodyId::Block(a), BodyId::Block(b)] => {
                neighbours.entry(a).or_default().push(b);
                neighbours.entry(b).or_default().push(a);
            }
            [BodyId::Block(block), BodyId::Ground(_)] => next.push(block),
            _ => {}
        }
    }
    let mut reached = BTreeSet::new();
    while let Some(block) = next.pop() {
        if reached.insert(block) {
            next.extend(neighbours.get(&block).into_iter().flatten());
        }
    }
    reached
}

/// Returns the first `max` parts of a list. If there are more, their number follows as the last entry: `3 more`.
pub fn shortened(mut parts: Vec<String>, max: usize) -> Vec<String> {
    if parts.len() > max {
        let left = parts.len() - max;
        parts.truncate(max);
        parts.push(format!("{left} more"));
    }
    parts
}
