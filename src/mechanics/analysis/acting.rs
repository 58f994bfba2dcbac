//! [`ActingForce`]: a force on a block of a frame. [`acting_forces`] is the list of all forces on the blocks: weights,
//! loads, the forces of contacts and robots, and missing forces.

use super::FrameAnalysis;
use super::force::{Contact, Failure, RobotForce};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::scene::{AppliedForce, BlockId, BodyId, ForceCause, Frame, RobotId, Scene};

/// The kind of a force on a block, and what exerts it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForceKind {
    /// The weight of a block.
    Weight,
    /// A load on a block.
    Load,
    /// The sum of normal and friction force, exerted by this body.
    Contact(BodyId),
    /// The normal force of an interface, exerted by this body.
    Normal(BodyId),
    /// The friction force of an interface, exerted by this body.
    Friction(BodyId),
    /// A robot's force.
    Robot(RobotId),
    /// A robot's torque. In the style of the thesis, two vertical arrows show it.
    RobotTorque(RobotId),
    /// A missing pull from this body: the structure would stand only if the joint could transfer this tension.
    MissingPull(BodyId),
    /// Missing friction from this body.
    MissingFriction(BodyId),
    /// The part of the needed force of a robot that exceeds the robot's limits.
    MissingRobotForce(RobotId),
    /// A torque beyond a robot's limit. In the style of the thesis, two vertical arrows show it.
    MissingTorque(RobotId),
}

impl ForceKind {
    /// Returns the body that exerts the force: a block or the ground. Returns `None` for weights, loads, and forces and
    /// torques of robots.
    pub fn partner(self) -> Option<BodyId> {
        match self {
            ForceKind::Contact(from)
            | ForceKind::Normal(from)
            | ForceKind::Friction(from)
            | ForceKind::MissingPull(from)
            | ForceKind::MissingFriction(from) => Some(from),
            _ => None,
        }
    }

    /// Returns the robot that exerts the force or torque. Returns `None` for weights, loads and forces of bodies.
    pub(crate) fn robot(self) -> Option<RobotId> {
        match self {
            ForceKind::Robot(robot)
            | ForceKind::RobotTorque(robot)
            | ForceKind::MissingRobotForce(robot)
            | ForceKind::MissingTorque(robot) => Some(robot),
            _ => None,
        }
    }

    /// True for a force of an interface.
    pub(crate) fn is_contact(self) -> bool {
        matches!(self, ForceKind::Contact(_) | ForceKind::Normal(_) | ForceKind::Friction(_))
    }

    /// True for a weight or a load.
    pub(crate) fn is_applied(self) -> bool {
        matches!(self, ForceKind::Weight | ForceKind::Load)
    }

    /// True for a missing force or torque.
    pub fn is_failure(self) -> bool {
        matches!(
            self,
            ForceKind::MissingPull(_)
                | ForceKind::MissingFriction(_)
                | ForceKind::MissingRobotForce(_)
                | ForceKind::MissingTorque(_)
        )
    }
}

/// A force on a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ActingForce {
    /// The block on which the force acts.
    pub on: BlockId,
    /// The kind of the force, and what exerts it.
    pub kind: ForceKind,
    /// The point where the force acts, metres.
    pub at: Point,
    /// The force, N.
    pub force: Vector,
    /// The torque that acts together with the force, N·m, anticlockwise positive.
    pub torque: f64,
}

/// Returns all forces on the blocks of a frame. The order is: the weight and the loads of each block, in placing order;
/// the forces of each contact, as `of_contact` returns them; the forces of robots; missing forces.
pub(crate) fn acting_forces(
    scene: &Scene,
    frame: &Frame,
    found: &FrameAnalysis,
    of_contact: impl Fn(&Contact) -> Vec<ActingForce>,
) -> Vec<ActingForce> {
    let applied = scene.applied_forces();
    let given = frame.placed.iter().flat_map(|block| &applied[block.0]).map(AppliedForce::acting);
    let contacts = found.contacts.iter().flat_map(of_contact);
    let robots = found.robots.iter().map(RobotForce::acting);
    given.chain(contacts).chain(robots).chain(found.failures.iter().flat_map(Failure::acting)).collect()
}

/// Returns the forces on each of `count` blocks, indexed by block.
pub(crate) fn by_block(forces: Vec<ActingForce>, count: usize) -> Vec<Vec<ActingForce>> {
    let mut blocks = vec![Vec::new(); count];
    forces.into_iter().for_each(|acting| blocks[acting.on.0].push(acting));
    blocks
}

/// Returns the force on the first of two bodies and the opposite force on the second, if they are blocks. `kind` takes
/// the body that exerts the force.
fn between(bodies: [BodyId; 2], kind: fn(BodyId) -> ForceKind, at: Point, force: Vector) -> Vec<ActingForce> {
    let [first, second] = bodies;
    let both = [(first, second, force), (second, first, -force)].into_iter();
    let on_block = |(on, from, force)| match on {
        BodyId::Block(on) => Some(ActingForce { on, kind: kind(from), at, force, torque: 0.0 }),
        BodyId::Ground(_) => None,
    };
    both.filter_map(on_block).collect()
}

impl FrameAnalysis {
    /// Returns the largest resultant of a contact, N.
    pub(crate) fn largest_at_contacts(&self) -> f64 {
        self.contacts.iter().map(Contact::amount).fold(0.0, f64::max)
    }

    /// Returns the largest force of a contact or a robot, N.
    pub(crate) fn largest_force(&self) -> f64 {
        self.robots.iter().map(|robot| robot.force.norm()).fold(self.largest_at_contacts(), f64::max)
    }
}

impl Contact {
    /// Returns the other of the two bodies.
    pub(crate) fn other(&self, body: BodyId) -> BodyId {
        let [first, second] = self.interface.bodies;
        if first == body { second } else { first }
    }

    /// Returns the magnitude of the resultant, N.
    pub(crate) fn amount(&self) -> f64 {
        self.resultant.force.norm()
    }

    /// Returns the sum of the normal forces, N.
    pub(crate) fn normal_force(&self) -> f64 {
        self.normal_forces.iter().sum()
    }

    /// Returns the resultant on one of the two bodies, N.
    pub(crate) fn force_on(&self, body: BodyId) -> Vector {
        if self.resultant.on == body { self.resultant.force } else { -self.resultant.force }
    }

    /// Returns the resultant on each of the two bodies that is a block.
    pub(crate) fn acting(&self) -> Vec<ActingForce> {
        between(self.interface.bodies, ForceKind::Contact, self.resultant.at, self.resultant.force)
    }

    /// Returns the normal force and the friction force on each of the two bodies that is a block, at the point of the
    /// resultant.
    pub(crate) fn acting_parts(&self) -> Vec<ActingForce> {
        let normal = self.interface.normal;
        let part = |kind, force| between(self.interface.bodies, kind, self.resultant.at, force);
        let friction = part(ForceKind::Friction, quarter_turn(normal) * self.friction_force);
        [part(ForceKind::Normal, normal * self.normal_force()), friction].concat()
    }
}

impl AppliedForce {
    pub(crate) fn acting(&self) -> ActingForce {
        let kind = match self.cause {
            ForceCause::Weight => ForceKind::Weight,
            ForceCause::Load(_) => ForceKind::Load,
        };
        ActingForce { on: self.block, kind, at: self.at, force: self.force, torque: self.torque }
    }
}

impl RobotForce {
    /// Returns the force and the torque on the block that the robot holds.
    pub(crate) fn acting(&self) -> ActingForce {
        let RobotForce { robot, block: on, at, force, torque, .. } = *self;
        ActingForce { on, kind: ForceKind::Robot(robot), at, force, torque }
    }
}

impl Failure {
    /// Returns the missing force or torque on each block.
    pub(crate) fn acting(&self) -> Vec<ActingForce> {
        match *self {
            Failure::Tension { bodies, at, force } => between(bodies, ForceKind::MissingPull, at, force),
            Failure::Friction { bodies, at, force } => between(bodies, ForceKind::MissingFriction, at, force),
            Failure::RobotForce { robot, block: on, at, force } => {
                vec![ActingForce { on, kind: ForceKind::MissingRobotForce(robot), at, force, torque: 0.0 }]
            }
            Failure::RobotTorque { robot, block: on, at, torque } => {
                vec![ActingForce { on, kind: ForceKind::MissingTorque(robot), at, force: Vector::zeros(), torque }]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::cross;
    use crate::mechanics::analysis::Analysis;

    /// An overhanging plank on a block, with a load, and a stone that a robot cannot hold: with the missing forces, the
    /// listed forces balance every block.
    #[test]
    fn the_listed_forces_balance_every_block_that_falls() {
        let scene = Scene::from_json(
            r#"{ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": [[0, 0], [2, 0], [2, -1], [0, -1]] }],
                "blocks": [{ "id": "foot", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "weight": 6 },
                    { "id": "plank", "polygon": [[1, 1], [5, 1], [5, 2], [1, 2]], "weight": 8 },
                    { "id": "stone", "polygon": [[8, 0], [9, 0], [9, 1], [8, 1]], "weight": 7 }],
                "loads": [{ "block": "plank", "force": [1, -2], "at": [4, 2], "torque": 3 }],
                "robots": [{ "id": "r", "holds": "stone", "at": [8.25, 0.5], "limits": { "force": 5 } }] }"#,
        )
        .expect("a valid scene");
        let analysis = Analysis::new(&scene);
        let all = acting_forces(&scene, &scene.frames[0], &analysis.frames[0], Contact::acting_parts);
        for (block, forces) in scene.blocks.iter().zip(by_block(all.clone(), scene.blocks.len())) {
            let force: Vector = forces.iter().map(|f| f.force).sum();
            let moment: f64 = forces.iter().map(|f| cross(f.at - block.centroid, f.force) + f.torque).sum();
            assert!(forces.len() > 2 && force.norm() < 1e-6 && moment.abs() < 1e-6, "{}: {forces:?}", block.id);
        }
        let missing = all.iter().filter(|f| f.kind.is_failure());
        assert_eq!(missing.filter(|f| f.kind.robot() == Some(RobotId(0))).count(), 2, "a force and a torque: {all:?}");
    }
}
