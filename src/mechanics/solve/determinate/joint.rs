//! [`Joint`]: one contact of a structure in which the contacts form a tree, so that only one path leads from each body
//! to the ground. The function [`joints`] lists all joints from the ground outwards.

use crate::geometry::{Vector, cross, quarter_turn};
use crate::mechanics::program::{ContactTerm, Program};

/// A contact whose two points are closer together than this, relative to the median interface length, cannot resist a
/// moment.
///
/// Its forces would be 10⁹ times the loads, and the proof could not use any of their digits.
const MIN_FACE_LENGTH: f64 = 1e-9;

/// A force and its moment about a body's centroid.
#[derive(Clone, Copy)]
pub(super) struct Wrench {
    pub force: Vector,
    pub moment: f64,
}

/// The forces ([N1, N2], T) of a contact; a negative N is tension.
pub(super) type ContactForces = ([f64; 2], f64);

/// The speeds at which the two points of a contact open, and the speed at which the contact slides along its tangent.
pub(super) type JointSpeeds = ([f64; 2], f64);

/// A contact of a tree of blocks, and the body that the contact connects to the ground, directly or through other
/// bodies.
pub(super) struct Joint<'a> {
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

    /// Writes the body's velocities into `motion`. At the joint, the velocity of the body is that of the body below,
    /// plus the speeds at which the joint opens and slides.
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
pub(super) fn joints(program: &Program) -> Option<Vec<Joint<'_>>> {
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
