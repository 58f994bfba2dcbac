//! Closed forms for statically determinate structures: stacks, and all trees of blocks.
//!
//! Every contact is the only one that joins what lies beyond it to the ground. So the balance of what lies beyond gives its
//! forces N1, N2 and T uniquely. If the contact can give them, these are the forces. What it cannot give has to stick: a pull −N, and
//! friction beyond μ(N1 + N2). With μ ≤ 1 no other way takes less: one more newton pressed and pulled at once would allow
//! μ newtons of friction, and cost one.
//!
//! No program is solved, and no digits are lost to the length of a chain. An interior-point method loses all of them at
//! 10 000 blocks.

mod joint;
#[cfg(test)]
mod tests;

use super::adhesion_result::LeastAdhesion;
use super::amounts::{Amounts, Effort};
use crate::geometry::{Vector, cross};
use crate::program::Program;
use joint::{ContactForces, Joint, JointSpeeds, Wrench, joints};

/// A missing force below this fraction of the contact's forces is rounding: the contact neither moves nor fails. A tower of 1000
/// blocks sums that many loads, each with a rounding of 1e-16. At a tenth its joints would seem to fail.
const ROUNDING_TOL: f64 = 1e-12;

/// Every joint opens by this more, relative to the fastest velocity: some fifty times the rounding of one. Then no rounding
/// makes a joint close, and the loads hardly notice.
const EXTRA_OPENING: f64 = 1e-14;

/// The forces, if they are unique and every contact can give them; else `None`.
pub fn determinate(program: &Program) -> Option<Amounts> {
    let joints = joints(program)?;
    let split = Split::new(program, &joints)?;
    let holds = |joint: &Joint| split.speeds(joint) == ([0.0; 2], 0.0);
    joints.iter().all(holds).then_some(split.forces)
}

/// The forces that balance needs at every joint, in the joints' order: loads are summed from the ends towards the ground.
fn needed_forces(program: &Program, joints: &[Joint]) -> Vec<ContactForces> {
    let mut needed: Vec<Wrench> = program
        .loads
        .chunks_exact(3)
        .map(|load| Wrench {
            force: Vector::new(load[0], load[1]),
            moment: load[2],
        })
        .collect();
    // From the ends towards the ground: what a joint carries acts on the body below it.
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

/// The least adhesion, and the motion that proves it; `None` if the forces are not unique.
pub(super) fn least_adhesion(program: &Program) -> Option<LeastAdhesion> {
    let joints = joints(program)?;
    Split::new(program, &joints)?.stuck(program, &joints)
}

/// A collapse mechanism with few moving joints, and the least adhesion. On each way from the ground only the first failing
/// contact gives way; what lies beyond moves with it as one body. `None` if the forces are not unique, or if nothing sticks.
pub fn collapse(program: &Program) -> Option<(Vec<f64>, LeastAdhesion)> {
    let joints = joints(program)?;
    let split = Split::new(program, &joints)?;
    let mut moves = vec![false; program.blocks];
    let mut speeds = Vec::with_capacity(joints.len());
    for joint in &joints {
        // A joint on a moving body stays closed, and its body moves along.
        let rests = joint.below.is_none_or(|(below, _)| !moves[below]);
        let (opens, slides) = match rests {
            true => split.speeds(joint),
            false => ([0.0; 2], 0.0),
        };
        moves[joint.body] = !rests || opens != [0.0; 2] || slides != 0.0;
        speeds.push((opens, slides));
    }
    if !moves.contains(&true) {
        return None;
    }
    let motion = motion(program, &joints, &speeds)?;
    Some((motion, split.stuck(program, &joints)?))
}

/// The velocities of the bodies, from the speeds at which joints open and slide; `None` if one is not finite.
///
/// Every joint opens by [`EXTRA_OPENING`] more, unless that takes half of the loads' power.
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
    match power(&opened_more) > 0.5 * power(&plain) {
        true => Some(opened_more),
        false => Some(plain),
    }
}

/// The forces that balance needs, split into what contacts can give and what has to stick.
struct Split {
    forces: Amounts,
    sticking: Amounts,
}

impl Split {
    fn new(program: &Program, joints: &[Joint]) -> Option<Split> {
        let (mut forces, mut sticking) = (Amounts::none(program), Amounts::none(program));
        for (joint, ([first, second], along)) in joints.iter().zip(needed_forces(program, joints)) {
            if !(first.is_finite() && second.is_finite() && along.is_finite()) {
                return None;
            }
            // The contact gives what is inside its friction cone; the rest has to stick.
            let pressed = [first.max(0.0), second.max(0.0)];
            let limit = joint.contact.friction * (pressed[0] + pressed[1]);
            let friction = along.clamp(-limit, limit);
            forces.normal[joint.number] = pressed;
            forces.friction[joint.number] = friction;
            sticking.normal[joint.number] = [pressed[0] - first, pressed[1] - second];
            sticking.friction[joint.number] = along - friction;
        }
        Some(Split { forces, sticking })
    }

    /// The optimum of the program of least adhesion, with the motion of all joints that give way; `None` if a friction above 1
    /// might need less sticking.
    fn stuck(self, program: &Program, joints: &[Joint]) -> Option<LeastAdhesion> {
        if program
            .contacts
            .iter()
            .any(|contact| contact.friction > 1.0)
        {
            return None;
        }
        let speeds: Vec<_> = joints.iter().map(|joint| self.speeds(joint)).collect();
        Some(LeastAdhesion {
            balanced: Some(true),
            motion: Some(motion(program, joints, &speeds)?),
            forces: self.forces,
            sticking: self.sticking,
            priced: false,
            effort: Effort::default(),
        })
    }

    /// The speeds at which the points open and the face slides if its sticking gives way.
    fn speeds(&self, joint: &Joint) -> JointSpeeds {
        let (pull, missing) = (
            self.sticking.normal[joint.number],
            self.sticking.friction[joint.number],
        );
        let [first, second] = self.forces.normal[joint.number];
        let is_above_rounding = |v: f64| v.abs() > ROUNDING_TOL * (first + second + v.abs());
        let slides = match is_above_rounding(missing) {
            true => -missing.signum(),
            false => 0.0,
        };
        // Friction is associated here: sliding opens the points that press, by μ times the slip.
        let opens = pull.map(|pull| match is_above_rounding(pull) {
            true => 1.0,
            false => joint.contact.friction * f64::abs(slides),
        });
        (opens, slides)
    }
}
