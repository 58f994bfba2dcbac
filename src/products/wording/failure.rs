//! What fails, in words: for a line of a table, below a figure, in a caption.

use std::collections::{BTreeMap, BTreeSet};

use super::number::{NO_BREAK, digits, listed, place, quantity};
use crate::analysis::{Failure, FrameAnalysis};
use crate::scene::{BlockId, BodyId, Scene};

/// How much is missing, N or N·m.
pub fn amount(failure: &Failure) -> f64 {
    match failure {
        Failure::Tension { force, .. }
        | Failure::Friction { force, .. }
        | Failure::RobotForce { force, .. } => force.norm(),
        Failure::RobotTorque { torque, .. } => torque.abs(),
    }
}

/// The same with its unit.
pub fn amount_with_unit(failure: &Failure) -> String {
    let unit = match failure {
        Failure::RobotTorque { .. } => "N·m",
        _ => "N",
    };
    quantity(amount(failure), unit)
}

/// The failures, the largest first; of equal ones the first in the list.
pub fn by_amount(found: &FrameAnalysis) -> Vec<&Failure> {
    let mut failures: Vec<&Failure> = found.failures.iter().collect();
    failures.sort_by(|a, b| amount(b).total_cmp(&amount(a)));
    failures
}

/// A body: `block 2`, `the ground`.
pub fn named(scene: &Scene, body: BodyId) -> String {
    match body {
        BodyId::Ground(_) => "the ground".to_owned(),
        BodyId::Block(_) => format!("block {}", scene.name(body)),
    }
}

/// The two bodies of an interface: `2 and the ground`.
pub fn pair(scene: &Scene, bodies: [BodyId; 2]) -> String {
    let [a, b] = bodies.map(|id| match id {
        BodyId::Ground(_) => "the ground",
        BodyId::Block(_) => scene.name(id),
    });
    format!("{a} and {b}")
}

/// A failure in a sentence, with its place: for a line of its own.
pub fn sentence(scene: &Scene, failure: &Failure) -> String {
    match *failure {
        Failure::Tension {
            bodies: [a, b],
            at,
            force,
        } => format!(
            "{} comes off {} at {}: holding on would take a pull of {} N",
            scene.name(a),
            scene.name(b),
            place(at),
            digits(force.norm())
        ),
        Failure::Friction {
            bodies: [a, b],
            at,
            force,
        } => format!(
            "{} slides along {} at {}: holding on would take {} N more than friction gives",
            scene.name(a),
            scene.name(b),
            place(at),
            digits(force.norm())
        ),
        Failure::RobotForce {
            robot,
            block,
            force,
            ..
        } => format!(
            "robot {} cannot hold {}: it would have to give ({}, {}) N beyond its limits",
            scene.robots[robot.0].id,
            scene.blocks[block.0].id,
            digits(force.x),
            digits(force.y)
        ),
        Failure::RobotTorque {
            robot,
            block,
            torque,
            ..
        } => format!(
            "robot {} cannot hold {}: it would have to give {} N·m beyond its limit",
            scene.robots[robot.0].id,
            scene.blocks[block.0].id,
            digits(torque)
        ),
    }
}

/// What is missing, as part of a list: `a pull of 8 N between a and b`.
pub fn missing(scene: &Scene, failure: &Failure) -> String {
    match failure {
        Failure::Tension { bodies, force, .. } => format!(
            "a pull of {} between {}",
            whole(force.norm(), "N"),
            pair(scene, *bodies)
        ),
        Failure::Friction { bodies, force, .. } => format!(
            "friction of {} between {}",
            whole(force.norm(), "N"),
            pair(scene, *bodies)
        ),
        Failure::RobotForce { robot, force, .. } => format!(
            "a force of {} from robot{NO_BREAK}{}",
            whole(force.norm(), "N"),
            scene.robots[robot.0].id
        ),
        Failure::RobotTorque { robot, torque, .. } => format!(
            "a torque of {} from robot{NO_BREAK}{}",
            whole(torque.abs(), "N·m"),
            scene.robots[robot.0].id
        ),
    }
}

/// What is missing, as part of a sentence about who would have to give it.
pub fn lacking(scene: &Scene, failure: &Failure) -> String {
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
            quantity(force.norm(), "N")
        ),
        Failure::Friction {
            bodies: [a, b],
            force,
            ..
        } => format!(
            "{} would have to hold on to {} against sliding with {}",
            named(a),
            named(b),
            quantity(force.norm(), "N")
        ),
        Failure::RobotForce { robot, force, .. } => format!(
            "robot {} would have to give {} more",
            scene.robots[robot.0].id,
            quantity(force.norm(), "N")
        ),
        Failure::RobotTorque { robot, torque, .. } => format!(
            "robot {} would have to give a torque of {}",
            scene.robots[robot.0].id,
            quantity(torque.abs(), "N·m")
        ),
    }
}

/// Which blocks no sticking could save; `None` where there are none.
pub fn uncarried(scene: &Scene, found: &FrameAnalysis) -> Option<String> {
    let blocks = found.unsupported.iter();
    let names: Vec<String> = blocks.map(|b| scene.blocks[b.0].id.clone()).collect();
    let what = if names.len() == 1 { "block" } else { "blocks" };
    (!names.is_empty()).then(|| format!("nothing carries {what} {}", listed(&shortened(names, 6))))
}

/// Why nothing carries some blocks, in a sentence for each reason, with at most `most` names in each; none where everything is
/// carried.
pub fn unsupported(scene: &Scene, found: &FrameAnalysis, most: usize) -> Vec<String> {
    let reached = reached(found);
    let (touching, apart): (Vec<BlockId>, Vec<BlockId>) = found
        .unsupported
        .iter()
        .partition(|id| reached.contains(id));
    let reasons = [
        (apart, "no way from there to the ground or to a robot"),
        (
            touching,
            "where it touches or is held, nothing that sticks could stop it",
        ),
    ];
    let mut sentences = Vec::new();
    for (blocks, reason) in reasons {
        let names = blocks.iter().take(most);
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

/// The blocks from which contacts lead to the ground or to a block that a robot holds.
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

/// The first of some parts, and how many more there are.
pub fn shortened(mut parts: Vec<String>, most: usize) -> Vec<String> {
    if parts.len() > most {
        let left = parts.len() - most;
        parts.truncate(most);
        parts.push(format!("{left} more"));
    }
    parts
}

/// An amount that stays whole where lines are broken.
fn whole(value: f64, unit: &str) -> String {
    quantity(value, unit).replace(' ', &NO_BREAK.to_string())
}
