//! Describes failures for tables, captions and sentences.

use std::collections::{BTreeMap, BTreeSet};

use super::number::{self, NO_BREAK, digits, listed, place, quantity};
use crate::analysis::{Failure, FrameAnalysis};
use crate::scene::{BlockId, BodyId, Scene, Unit};

/// Largest number of unsupported blocks that are named. All further blocks are only counted.
const MAX_LISTED_BLOCKS: usize = 6;

/// Returns the magnitude of the missing force (N) or torque (N·m).
pub fn amount(failure: &Failure) -> f64 {
    match failure {
        Failure::Tension { force, .. }
        | Failure::Friction { force, .. }
        | Failure::RobotForce { force, .. } => force.norm(),
        Failure::RobotTorque { torque, .. } => torque.abs(),
    }
}

/// Sorts the failures of a frame by magnitude, largest first. Equal failures keep their order.
pub fn by_amount(found: &FrameAnalysis) -> Vec<&Failure> {
    let mut failures: Vec<&Failure> = found.failures.iter().collect();
    failures.sort_by(|a, b| amount(b).total_cmp(&amount(a)));
    failures
}

/// Names a body: `block 2`, `the ground`.
pub fn named(scene: &Scene, body: BodyId) -> String {
    match body {
        BodyId::Ground(_) => "the ground".to_owned(),
        BodyId::Block(_) => format!("block {}", scene.name(body)),
    }
}

/// Names the two bodies of an interface: `2 and the ground`.
pub fn pair(scene: &Scene, bodies: [BodyId; 2]) -> String {
    let [a, b] = bodies.map(|id| match id {
        BodyId::Ground(_) => "the ground",
        BodyId::Block(_) => scene.name(id),
    });
    format!("{a} and {b}")
}

/// Describes a failure and its place, as a sentence without a full stop.
pub fn sentence(scene: &Scene, failure: &Failure) -> String {
    let units = scene.units;
    let newtons = |value: f64| number::amount(value, units.force());
    match *failure {
        Failure::Tension {
            bodies: [a, b],
            at,
            force,
        } => format!(
            "{} comes off {} at {}: to hold it would need a pull of {}",
            scene.name(a),
            scene.name(b),
            place(at, units),
            newtons(force.norm())
        ),
        Failure::Friction {
            bodies: [a, b],
            at,
            force,
        } => format!(
            "{} slides along {} at {}: to hold it would need {} more than friction can give",
            scene.name(a),
            scene.name(b),
            place(at, units),
            newtons(force.norm())
        ),
        Failure::RobotForce {
            robot,
            block,
            force,
            ..
        } => format!(
            "robot {} cannot hold {}: it would have to give ({}, {}) {} beyond its limits",
            scene.robots[robot.0].id,
            scene.blocks[block.0].id,
            digits(units.force().value_from_si(force.x)),
            digits(units.force().value_from_si(force.y)),
            units.force().symbol()
        ),
        Failure::RobotTorque {
            robot,
            block,
            torque,
            ..
        } => format!(
            "robot {} cannot hold {}: it would have to give {} beyond its limit",
            scene.robots[robot.0].id,
            scene.blocks[block.0].id,
            number::amount(torque, units.torque())
        ),
    }
}

/// Describes the missing force as a noun phrase, for a list: `a pull of 8 N between a and b`.
pub fn missing_phrase(scene: &Scene, failure: &Failure) -> String {
    match failure {
        Failure::Tension { bodies, force, .. } => format!(
            "a pull of {} between {}",
            unbroken(force.norm(), scene.units.force()),
            pair(scene, *bodies)
        ),
        Failure::Friction { bodies, force, .. } => format!(
            "friction of {} between {}",
            unbroken(force.norm(), scene.units.force()),
            pair(scene, *bodies)
        ),
        Failure::RobotForce { robot, force, .. } => format!(
            "a force of {} from robot{NO_BREAK}{}",
            unbroken(force.norm(), scene.units.force()),
            scene.robots[robot.0].id
        ),
        Failure::RobotTorque { robot, torque, .. } => format!(
            "a torque of {} from robot{NO_BREAK}{}",
            unbroken(torque.abs(), scene.units.torque()),
            scene.robots[robot.0].id
        ),
    }
}

/// Writes a clause that names the bodies or the robot that would have to provide the missing force. `write` formats an
/// amount with its unit.
pub fn missing_sentence(
    scene: &Scene,
    failure: &Failure,
    write: &dyn Fn(f64, Unit) -> String,
) -> String {
    let named = |id: &BodyId| named(scene, *id);
    match failure {
        Failure::Tension {
            bodies: [a, b],
            force,
            ..
        } => format!(
            "{} would have to stick to {} with {}",
            named(a),
            named(b),
            write(force.norm(), scene.units.force())
        ),
        Failure::Friction {
            bodies: [a, b],
            force,
            ..
        } => format!(
            "{} slides along {}, and friction would have to give {} more",
            named(a),
            named(b),
            write(force.norm(), scene.units.force())
        ),
        Failure::RobotForce { robot, force, .. } => format!(
            "robot {} would have to give {} more",
            scene.robots[robot.0].id,
            write(force.norm(), scene.units.force())
        ),
        Failure::RobotTorque { robot, torque, .. } => format!(
            "robot {} would have to give a torque of {}",
            scene.robots[robot.0].id,
            write(torque.abs(), scene.units.torque())
        ),
    }
}

/// Names the blocks that even adhesion could not hold; `None` if there are no such blocks.
pub fn unsupported_phrase(scene: &Scene, found: &FrameAnalysis) -> Option<String> {
    let blocks = found.unsupported.iter();
    let names: Vec<String> = blocks.map(|b| scene.blocks[b.0].id.clone()).collect();
    let what = if names.len() == 1 { "block" } else { "blocks" };
    (!names.is_empty()).then(|| {
        format!(
            "nothing carries {what} {}",
            listed(&shortened(names, MAX_LISTED_BLOCKS))
        )
    })
}

/// Writes a sentence for each reason why blocks are unsupported, with at most `max` names. Empty if all blocks are
/// supported.
pub fn unsupported(scene: &Scene, found: &FrameAnalysis, max: usize) -> Vec<String> {
    let reached = reached(found);
    let (touching, apart): (Vec<BlockId>, Vec<BlockId>) = found
        .unsupported
        .iter()
        .partition(|id| reached.contains(id));
    let reasons = [
        (
            apart,
            "no contacts lead from there to the ground or to a robot",
        ),
        (
            touching,
            "even if all contacts and robots stuck, the fall would not stop",
        ),
    ];
    let mut sentences = Vec::new();
    for (blocks, reason) in reasons {
        let names = blocks.iter().take(max);
        let names: Vec<&str> = names.map(|id| scene.blocks[id.0].id.as_str()).collect();
        let more = match blocks.len() - names.len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        if !names.is_empty() {
            let names = names.join(", ");
            sentences.push(format!("nothing carries {names}{more}: {reason}"));
        }
    }
    sentences
}

/// Returns the blocks that contacts connect to the ground or to a block that a robot holds. It searches the graph of
/// contacts.
fn reached(found: &FrameAnalysis) -> BTreeSet<BlockId> {
    let mut neighbours: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    let mut next: Vec<BlockId> = found.robots.iter().map(|robot| robot.block).collect();
    for contact in &found.contacts {
        match contact.interface.bodies {
            [BodyId::Block(a), BodyId::Block(b)] => {
                neighbours.entry(a).or_default().push(b);
                neighbours.entry(b).or_default().push(a);
            }
            [BodyId::Block(block), BodyId::Ground(_)]
            | [BodyId::Ground(_), BodyId::Block(block)] => next.push(block),
            [BodyId::Ground(_), BodyId::Ground(_)] => {}
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

/// Keeps the first `max` parts, and replaces the others by a count: `3 more`.
pub fn shortened(mut parts: Vec<String>, max: usize) -> Vec<String> {
    if parts.len() > max {
        let left = parts.len() - max;
        parts.truncate(max);
        parts.push(format!("{left} more"));
    }
    parts
}

/// Writes a number and its unit, joined by no-break spaces.
fn unbroken(value: f64, unit: Unit) -> String {
    quantity(value, unit).replace(' ', &NO_BREAK.to_string())
}
