//! The forces, missing forces and motions of a frame, as written in JSON.

use serde::Serialize;

use super::{Number, Pair, arrow, place};
use crate::mechanics::analysis::{Contact, Failure, Motion as Moved, RobotForce};
use crate::mechanics::scene::Scene;
use crate::mechanics::statics::interface::ContactKind;

#[derive(Serialize)]
pub(super) struct Interface<'a> {
    bodies: [&'a str; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<&'static str>,
    ends: [Pair; 2],
    application_points: [Pair; 2],
    normal: Pair,
    mu: Number,
    normal_forces: [Number; 2],
    friction_force: Number,
    resultant: Resultant,
    friction_used: Number,
}

#[derive(Serialize)]
pub(super) struct Resultant {
    at: Pair,
    force: Pair,
}

#[derive(Serialize)]
pub(super) struct Robot<'a> {
    id: &'a str,
    holds: &'a str,
    at: Pair,
    force: Pair,
    torque: Number,
    limit_used: Number,
}

/// A failure. It has either `bodies` or `robot` and `holds`, and either `force` or `torque`.
#[derive(Serialize)]
pub(super) struct Missing<'a> {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    bodies: Option<[&'a str; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    holds: Option<&'a str>,
    at: Pair,
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<Pair>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque: Option<Number>,
    amount: Number,
}

#[derive(Serialize)]
pub(super) struct Motion<'a> {
    block: &'a str,
    velocity: Pair,
    spin: Number,
}

impl<'a> Motion<'a> {
    pub(super) fn new(scene: &'a Scene, motion: &Moved) -> Motion<'a> {
        Motion { block: &scene.blocks[motion.block.0].id, velocity: arrow(motion.velocity), spin: Number(motion.spin) }
    }
}

impl<'a> Interface<'a> {
    pub(super) fn new(scene: &'a Scene, contact: &Contact) -> Interface<'a> {
        let interface = &contact.interface;
        let word = || {
            let is_round = interface.bodies.iter().any(|body| scene.body(*body).circle.is_some());
            if is_round { "circle" } else { "corner" }
        };
        Interface {
            bodies: interface.bodies.map(|b| scene.name(b)),
            kind: (interface.kind == ContactKind::Corner).then(word),
            ends: interface.ends.map(place),
            application_points: contact.application_points.map(place),
            normal: arrow(interface.normal),
            mu: Number(interface.friction),
            normal_forces: contact.normal_forces.map(Number),
            friction_force: Number(contact.friction_force),
            resultant: Resultant { at: place(contact.resultant.at), force: arrow(contact.resultant.force) },
            friction_used: Number(contact.friction_used),
        }
    }
}

impl<'a> Robot<'a> {
    pub(super) fn new(scene: &'a Scene, robot: &RobotForce) -> Robot<'a> {
        Robot {
            id: &scene.robots[robot.robot.0].id,
            holds: &scene.blocks[robot.block.0].id,
            at: place(robot.at),
            force: arrow(robot.force),
            torque: Number(robot.torque),
            limit_used: Number(robot.limit_used),
        }
    }
}

impl<'a> Missing<'a> {
    pub(super) fn new(scene: &'a Scene, failure: &Failure) -> Missing<'a> {
        let (bodies, holds) = match *failure {
            Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. } => {
                (Some(bodies.map(|b| scene.name(b))), None)
            }
            Failure::RobotForce { block, .. } | Failure::RobotTorque { block, .. } => {
                (None, Some(scene.blocks[block.0].id.as_str()))
            }
        };
        let is_torque = matches!(failure, Failure::RobotTorque { .. });
        Missing {
            kind: failure.word(),
            bodies,
            robot: failure.robot().map(|r| scene.robots[r.0].id.as_str()),
            holds,
            at: place(failure.at()),
            force: (!is_torque).then(|| arrow(failure.force())),
            torque: is_torque.then(|| Number(failure.torque())),
            amount: Number(failure.amount()),
        }
    }
}
