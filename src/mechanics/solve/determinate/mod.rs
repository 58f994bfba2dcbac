//! Computes in closed form the forces, the least adhesion and the motion of statically determinate structures: stacks,
//! and all other structures whose contacts form a tree.
//!
//! In a tree, each contact is the only connection of the blocks beyond it to the ground. The balance of these blocks
//! determines the forces N1, N2 and T of the contact. If every contact can exert its forces, the structure stands.
//! Otherwise the missing part is the adhesion: tension −N, and friction beyond μ(N1 + N2). With μ ≤ 1 no other choice
//! needs less adhesion: one newton of additional pressure, balanced by one newton of tension, allows only μ newtons of
//! friction.
//!
//! No program is solved, and the accuracy does not depend on the length of a chain. An interior-point method has no
//! correct digits left at 10 000 blocks. Steps: order the joints from the ground outwards; sum the loads from the
//! leaves to the ground; split the forces of each joint; derive the motion from the joints that give way. Reference:
//! Hibbeler, Structural Analysis, 2012, chapter 2 (determinacy and equilibrium of parts).
//!
//! [`Joint`]: one contact of a structure in which the contacts form a tree, so that only one path leads from each body
//! to the ground. The function [`joints`] lists all joints from the ground outwards.

use super::amounts::{Amounts, Balance};
use crate::geometry::{Vector, cross, quarter_turn};
use crate::mechanics::program::{ContactTerm, Program};

/// A missing force up to this fraction of the contact's forces counts as rounding: the contact does not fail.
///
/// A tower of 1000 blocks sums 1000 loads, each with a rounding of 1e-16. If this value were ten times smaller, some of
/// its joints would seem to fail. Real failures, of the size that proofs accept (1e-7), are far above it.
const ROUNDING_TOL: f64 = 1e-12;

/// The additional opening of every joint in a motion, relative to the largest velocity.
///
/// It is about fifty times the rounding of a velocity, so that rounding cannot make a joint close. The power of the
/// loads changes by a similarly small fraction.
const EXTRA_OPENING: f64 = 1e-14;

/// Returns the contact forces that balance the loads. `None` if the contacts do not form a tree or other conditions of
/// `joints` are not met, if a contact cannot exert its force, or if a force is not finite.
pub fn determinate(program: &Program) -> Option<Amounts> {
    let joints = joints(program)?;
    let split = SplitForces::new(program, &joints)?;
    let holds = |joint: &Joint| split.speeds(joint) == ([0.0; 2], 0.0);
    joints.iter().all(holds).then_some(split.forces)
}

/// Computes the forces that each joint must exert to balance the loads, in the order of the joints.
fn needed_forces(program: &Program, joints: &[Joint]) -> Vec<ContactForces> {
    let mut needed: Vec<Wrench> = program
        .loads
        .chunks_exact(3)
        .map(|load| Wrench { force: Vector::new(load[0], load[1]), moment: load[2] })
        .collect();
    // Go from the leaves of the tree towards the ground. The wrench that a joint must exert on its body is added to the
    // wrench that the body below needs.
    for joint in joints.iter().rev() {
        let wrench = needed[joint.body];
        if let Some((below, between)) = joint.below {
            needed[below].force += wrench.force;
            needed[below].moment += wrench.moment + cross(between, wrench.force);
        }
    }
    let forces = joints.iter().map(|joint| joint.forces(needed[joint.body]));
    forces.collect()
}

/// Computes the least adhesion, and the motion that proves that it is the least. `None` if the contacts do not form a
/// tree (see [`joints`]), if a friction coefficient exceeds 1, or if a result is not finite.
pub(super) fn least_adhesion(program: &Program) -> Option<Balance> {
    let joints = joints(program)?;
    SplitForces::new(program, &joints)?.into_least_adhesion(program, &joints)
}

/// Computes a collapse mechanism with few moving joints, and the least adhesion.
///
/// On each path from the ground, only the first failing contact opens or slides; the blocks beyond it move as one body.
/// `None` if the contacts do not form a tree (see `joints`), if the structure stands, if a friction coefficient exceeds
/// 1, or if a result is not finite.
pub fn collapse(program: &Program) -> Option<Balance> {
    let joints = joints(program)?;
    let split = SplitForces::new(program, &joints)?;
    let mut moves = vec![false; program.blocks];
    let mut speeds = Vec::with_capacity(joints.len());
    for joint in &joints {
        // If the body below moves, the joint stays closed, and the body above moves with the body below.
        let rests = joint.below.is_none_or(|(below, _)| !moves[below]);
        let (opens, slides) = if rests { split.speeds(joint) } else { ([0.0; 2], 0.0) };
        moves[joint.body] = !rests || opens != [0.0; 2] || slides != 0.0;
        speeds.push((opens, slides));
    }
    if !moves.contains(&true) {
        return None;
    }
    let motion = motion(program, &joints, &speeds)?;
    Some(Balance { motion: Some(motion), ..split.into_least_adhesion(program, &joints)? })
}

/// Computes the velocities of the bodies from the speeds at which the joints open and slide. `None` if a velocity is
/// not finite.
///
/// Every joint opens by an additional [`EXTRA_OPENING`] times the largest velocity, unless this reduces the power of
/// the loads by half or more.
fn motion(program: &Program, joints: &[Joint], speeds: &[JointSpeeds]) -> Option<Vec<f64>> {
    let opened = |extra: f64| {
        let mut motion = vec![0.0; program.loads.len()];
        for (joint, (opens, slides)) in joints.iter().zip(speeds) {
            joint.add_motion(opens.map(|v| v + extra), *slides, &mut motion);
        }
        motion
    };
    let power = |motion: &[f64]| -> f64 {
        let both = program.loads.iter().zip(motion);
        both.map(|(load, v)| -load * v).sum()
    };
    let plain = opened(0.0);
    if !plain.iter().all(|v| v.is_finite()) {
        return None;
    }
    let fastest = plain.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let opened_more = opened(EXTRA_OPENING * fastest);
    if power(&opened_more) > 0.5 * power(&plain) { Some(opened_more) } else { Some(plain) }
}

/// The forces that balance the loads, split into the part that contacts can exert and the part that needs adhesion.
struct SplitForces {
    forces: Amounts,
    adhesion: Amounts,
}

impl SplitForces {
    fn new(program: &Program, joints: &[Joint]) -> Option<SplitForces> {
        let (mut forces, mut adhesion) = (Amounts::zero(program), Amounts::zero(program));
        for (joint, ([first, second], tangential)) in joints.iter().zip(needed_forces(program, joints)) {
            if !(first.is_finite() && second.is_finite() && tangential.is_finite()) {
                return None;
            }
            // The contact exerts the part of the force inside its friction cone. The rest is adhesion.
            let pressed = [first.max(0.0), second.max(0.0)];
            let limit = joint.contact.friction * (pressed[0] + pressed[1]);
            let friction = tangential.clamp(-limit, limit);
            forces.normal[joint.number] = pressed;
            forces.friction[joint.number] = friction;
            adhesion.normal[joint.number] = [pressed[0] - first, pressed[1] - second];
            adhesion.friction[joint.number] = tangential - friction;
        }
        Some(SplitForces { forces, adhesion })
    }

    /// Returns the optimum of the program of least adhesion. In its motion, all failing joints open or slide.
    ///
    /// `None` if a friction coefficient exceeds 1, because the closed form is then not always the least adhesion. Also
    /// `None` if a velocity is not finite.
    fn into_least_adhesion(self, program: &Program, joints: &[Joint]) -> Option<Balance> {
        if program.contacts.iter().any(|contact| contact.friction > 1.0) {
            return None;
        }
        let speeds: Vec<_> = joints.iter().map(|joint| self.speeds(joint)).collect();
        Some(Balance {
            motion: Some(motion(program, joints, &speeds)?),
            forces: Some(self.forces),
            adhesion: Some(self.adhesion),
            ..Balance::default()
        })
    }

    /// Returns the speeds at which the two points of a joint open, and the speed at which the joint slides, if the
    /// joint loses its adhesion. All are 0 if the joint needs no adhesion.
    fn speeds(&self, joint: &Joint) -> JointSpeeds {
        let (pull, missing) = (self.adhesion.normal[joint.number], self.adhesion.friction[joint.number]);
        let [first, second] = self.forces.normal[joint.number];
        let is_above_rounding = |v: f64| v.abs() > ROUNDING_TOL * (first + second + v.abs());
        let slides = if is_above_rounding(missing) { -missing.signum() } else { 0.0 };
        // The flow rule is associated: a sliding face also opens, at μ times the sliding speed.
        let opens =
            pull.map(|pull| if is_above_rounding(pull) { 1.0 } else { joint.contact.friction * f64::abs(slides) });
        (opens, slides)
    }
}

/// A contact whose two points are closer together than this, relative to the median interface length, cannot resist a
/// moment.
///
/// Its forces would be 10⁹ times the loads, and the proof could not use any of their digits.
const MIN_FACE_LENGTH: f64 = 1e-9;

/// A force and its moment about a body's centroid.
#[derive(Clone, Copy)]
struct Wrench {
    pub force: Vector,
    pub moment: f64,
}

/// The forces ([N1, N2], T) of a contact; a negative N is tension.
type ContactForces = ([f64; 2], f64);

/// The speeds at which the two points of a contact open, and the speed at which the contact slides along its tangent.
type JointSpeeds = ([f64; 2], f64);

/// A contact of a tree of blocks, and the body that the contact connects to the ground, directly or through other
/// bodies.
struct Joint<'a> {
    /// The index of the contact.
    pub number: usize,
    pub contact: &'a ContactTerm,
    /// The body on the side of the contact that is farther from the ground.
    pub body: usize,
    /// The vectors from that body's centroid to the two application points.
    arms: [Vector; 2],
    /// 1 if the contact pushes `body` along the normal, −1 if it pushes `body` against the normal.
    sign: f64,
    /// The next body on the way to the ground, and the vector from the centroid of that body to the centroid of `body`.
    pub below: Option<(usize, Vector)>,
}

impl Joint<'_> {
    /// Returns the moments of unit forces about the body's centroid: of a normal force at each of the two points, and
    /// of a tangential force.
    fn levers(&self) -> ([f64; 2], f64) {
        let normal = self.contact.normal;
        let levers = self.arms.map(|arm| cross(arm, normal));
        (levers, cross(self.arms[0], quarter_turn(normal)))
    }

    /// Computes the contact forces that together exert a given wrench (force and moment) on the body: three equations
    /// for three unknowns.
    pub fn forces(&self, wrench: Wrench) -> ContactForces {
        let (levers, lever) = self.levers();
        let normal = self.contact.normal;
        let across = self.sign * normal.dot(&wrench.force);
        let along = self.sign * quarter_turn(normal).dot(&wrench.force);
        let moment = self.sign * wrench.moment - lever * along;
        // N1 + N2 = `across`, and the moments of N1, N2 and T add up to the moment of the wrench.
        let by = 1.0 / (levers[1] - levers[0]);
        let first = (levers[1] * across - moment) * by;
        let second = (moment - levers[0] * across) * by;
        ([first, second], along)
    }

    /// Writes the velocities of the body into `motion`. The velocity of the body at the joint is the sum of two: the
    /// velocity of the body below, and the velocity with which the joint opens and slides.
    pub fn add_motion(&self, opens: [f64; 2], slides: f64, motion: &mut [f64]) {
        let normal = self.contact.normal;
        let tangent = quarter_turn(normal);
        // Computes the velocity of a point of a rigid body. `arm` leads from the centroid of the body to the point.
        let at = |[x, y, spin]: [f64; 3], arm: Vector| Vector::new(x, y) + quarter_turn(arm) * spin;
        let below = self.below.map_or([[0.0; 2].into(); 2], |(body, between)| {
            let velocity = [0, 1, 2].map(|row| motion[3 * body + row]);
            self.arms.map(|arm| at(velocity, arm + between))
        });
        let across = [0, 1].map(|k| normal.dot(&below[k]) + self.sign * opens[k]);
        let along = tangent.dot(&below[0]) + self.sign * slides;
        // The spin follows from the difference of the body's normal velocities at the two points. The velocity of the
        // centroid follows from the velocity at the first point and the spin.
        let (levers, lever) = self.levers();
        let spin = (across[1] - across[0]) / (levers[1] - levers[0]);
        let velocity = normal * (across[0] - spin * levers[0]) + tangent * (along - spin * lever);
        motion[3 * self.body..3 * self.body + 3].copy_from_slice(&[velocity.x, velocity.y, spin]);
    }
}

/// Lists the joints in order from the ground outwards, one for each body.
///
/// `None` if the contacts do not form a tree: a body has several paths to the ground, or none. Also `None` if the
/// program has grips or corner contacts, or if a contact is too short.
fn joints(program: &Program) -> Option<Vec<Joint<'_>>> {
    let one_each = program.contacts.len() == program.blocks && program.grips.is_empty();
    if !one_each || program.contacts.iter().any(|contact| contact.points != 2) {
        return None;
    }
    // List the contacts of each body. The search starts from the contacts with the ground, so put these into the queue.
    let mut touching = vec![Vec::new(); program.blocks];
    let mut queue = Vec::new();
    for (number, contact) in program.contacts.iter().enumerate() {
        match contact.from {
            Some((from, _)) => {
                touching[from].push(number);
                touching[contact.on.0].push(number);
            }
            None => queue.push((number, None)),
        }
    }
    let mut found = vec![false; program.blocks];
    let mut joints = Vec::with_capacity(program.blocks);
    // Depth-first search from the ground. A body that is reached twice has two paths to the ground, so the contacts do
    // not form a tree.
    while let Some((number, below)) = queue.pop() {
        let contact = &program.contacts[number];
        let both = [Some((contact.on, 1.0)), contact.from.map(|from| (from, -1.0))];
        let mut sides = both.into_iter().flatten();
        let ((body, arms), sign) = sides.find(|((body, _), _)| Some(*body) != below)?;
        if std::mem::replace(&mut found[body], true) {
            return None;
        }
        let between = first_arm(contact, below).map(|own| own - arms[0]);
        let joint = Joint { number, contact, body, arms, sign, below: below.zip(between) };
        let [first, second] = joint.levers().0;
        if (second - first).abs() < MIN_FACE_LENGTH {
            return None;
        }
        joints.push(joint);
        let next = touching[body].iter().filter(|k| **k != number);
        queue.extend(next.map(|k| (*k, Some(body))));
    }
    (joints.len() == program.blocks).then_some(joints)
}

/// Returns the vector from the centroid of `body` to the first point of a contact. `None` if the contact does not touch
/// the body.
fn first_arm(contact: &ContactTerm, body: Option<usize>) -> Option<Vector> {
    let sides = [Some(contact.on), contact.from].into_iter().flatten();
    let of_body = |side: &(usize, [Vector; 2])| Some(side.0) == body;
    sides.clone().find(of_body).map(|(_, arms)| arms[0])
}

#[cfg(test)]
mod tests;
