//! What is statically determinate: stacks, and all else in which every contact is the only one that joins what lies beyond it
//! to the ground.
//!
//! There the balance of what lies beyond a contact says what the contact has to give: N1, N2 and T, with no choice. Where it can,
//! these are the forces. What of them it cannot give has to stick: a pull −N, and friction beyond μ(N1 + N2). Where μ ≤ 1 no
//! other way takes less: one more newton pressed and pulled at once would allow μ newtons of friction, and cost one. No
//! program is solved, and no digits are lost to the length of a chain, of which an interior-point method loses all at 10 000
//! blocks.

use super::{Amounts, Effort, Stuck};
use crate::geometry::{Vector, cross, quarter_turn};
use crate::program::{ContactTerm, Program};

/// Points less than this apart, in parts of a usual face, take no moment.
const SHORTEST: f64 = 1e-9;

/// Less of what a contact gives is the rounding of sums: it neither moves nor fails.
const ROUNDING: f64 = 1e-12;

/// By so much more every joint opens, in parts of the fastest velocity: some fifty times the rounding of one.
const HAIR: f64 = 1e-14;

/// The forces, where there is no choice and every contact can give them.
pub fn determinate(program: &Program) -> Option<Amounts> {
    let joints = joints(program)?;
    let split = Split::new(program, &joints)?;
    let holds = |joint: &Joint| split.speeds(joint) == ([0.0; 2], 0.0);
    joints.iter().all(holds).then_some(split.forces)
}

/// N1, N2 and T that balance asks of every joint.
fn given(program: &Program, joints: &[Joint]) -> Vec<([f64; 2], f64)> {
    let mut needed: Vec<Wrench> = program
        .loads
        .chunks_exact(3)
        .map(|load| Wrench {
            force: Vector::new(load[0], load[1]),
            moment: load[2],
        })
        .collect();
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

/// What would have to stick, and the motion that shows that it takes so much; `None` where forces have a choice.
pub(super) fn stick(program: &Program) -> Option<Stuck> {
    let joints = joints(program)?;
    Split::new(program, &joints)?.stuck(program, &joints)
}

/// The motion in which only contacts next to the ground give way, so that what lies beyond moves with them as one body, and
/// what would have to stick; `None` where forces have a choice, and where none sticks.
pub fn collapse(program: &Program) -> Option<(Vec<f64>, Stuck)> {
    let joints = joints(program)?;
    let split = Split::new(program, &joints)?;
    let mut moves = vec![false; program.blocks];
    let mut speeds = Vec::with_capacity(joints.len());
    for joint in &joints {
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

/// The velocities of the bodies from the speeds at which joints open and slide. Every joint opens by a hair more, so that no
/// rounding makes it close, where the loads hardly notice.
fn motion(program: &Program, joints: &[Joint], speeds: &[([f64; 2], f64)]) -> Option<Vec<f64>> {
    let opened = |hair: f64| {
        let mut motion = vec![0.0; program.loads.len()];
        for (joint, (opens, slides)) in joints.iter().zip(speeds) {
            joint.moves(opens.map(|v| v + hair), *slides, &mut motion);
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
    let ajar = opened(HAIR * fastest);
    match power(&ajar) > 0.5 * power(&plain) {
        true => Some(ajar),
        false => Some(plain),
    }
}

/// What contacts have to give: what they can, and what has to stick.
struct Split {
    forces: Amounts,
    sticking: Amounts,
}

impl Split {
    fn new(program: &Program, joints: &[Joint]) -> Option<Split> {
        let (mut forces, mut sticking) = (Amounts::none(program), Amounts::none(program));
        for (joint, ([first, second], along)) in joints.iter().zip(given(program, joints)) {
            if !(first.is_finite() && second.is_finite() && along.is_finite()) {
                return None;
            }
            let pressed = [first.max(0.0), second.max(0.0)];
            let most = joint.contact.friction * (pressed[0] + pressed[1]);
            let rubbed = along.clamp(-most, most);
            forces.normal[joint.number] = pressed;
            forces.friction[joint.number] = rubbed;
            sticking.normal[joint.number] = [pressed[0] - first, pressed[1] - second];
            sticking.friction[joint.number] = along - rubbed;
        }
        Some(Split { forces, sticking })
    }

    /// As an optimum of the least sticking, with the motion of all that gives way; `None` where friction beyond 1 may take less.
    fn stuck(self, program: &Program, joints: &[Joint]) -> Option<Stuck> {
        if program
            .contacts
            .iter()
            .any(|contact| contact.friction > 1.0)
        {
            return None;
        }
        let speeds: Vec<_> = joints.iter().map(|joint| self.speeds(joint)).collect();
        Some(Stuck {
            balanced: Some(true),
            motion: Some(motion(program, joints, &speeds)?),
            forces: self.forces,
            sticking: self.sticking,
            priced: false,
            effort: Effort::default(),
        })
    }

    /// The speeds at which the points open whose sticking gives way, and that along the face.
    fn speeds(&self, joint: &Joint) -> ([f64; 2], f64) {
        let (pull, lacking) = (
            self.sticking.normal[joint.number],
            self.sticking.friction[joint.number],
        );
        let [first, second] = self.forces.normal[joint.number];
        let counts = |v: f64| v.abs() > ROUNDING * (first + second + v.abs());
        let slides = match counts(lacking) {
            true => -lacking.signum(),
            false => 0.0,
        };
        // Sliding opens what presses, as in every motion to which friction does not object.
        let opens = pull.map(|pull| match counts(pull) {
            true => 1.0,
            false => joint.contact.friction * f64::abs(slides),
        });
        (opens, slides)
    }
}

/// A force and its moment about a body's centroid.
#[derive(Clone, Copy)]
struct Wrench {
    force: Vector,
    moment: f64,
}

/// A contact, and the body that it joins to the ground.
struct Joint<'a> {
    number: usize,
    contact: &'a ContactTerm,
    body: usize,
    /// The arms of the points about its centroid.
    arms: [Vector; 2],
    /// 1 where the contact pushes it along the normal, −1 where it pushes it back.
    sign: f64,
    /// The body between it and the ground, and the way from that one's centroid to its own.
    below: Option<(usize, Vector)>,
}

impl Joint<'_> {
    /// The moment of a unit at each point along the normal about the body's centroid, and of a unit along the face.
    fn levers(&self) -> ([f64; 2], f64) {
        let normal = self.contact.normal;
        let levers = self.arms.map(|arm| cross(arm, normal));
        (levers, cross(self.arms[0], quarter_turn(normal)))
    }

    /// N1, N2 and T that give the body a wrench.
    fn forces(&self, wrench: Wrench) -> ([f64; 2], f64) {
        let (levers, lever) = self.levers();
        let normal = self.contact.normal;
        let across = self.sign * normal.dot(&wrench.force);
        let along = self.sign * quarter_turn(normal).dot(&wrench.force);
        let moment = self.sign * wrench.moment - lever * along;
        let by = 1.0 / (levers[1] - levers[0]);
        let first = (levers[1] * across - moment) * by;
        let second = (moment - levers[0] * across) * by;
        ([first, second], along)
    }

    /// Adds the body's velocities, where the points open and the faces slide at given speeds.
    fn moves(&self, opens: [f64; 2], slides: f64, motion: &mut [f64]) {
        let normal = self.contact.normal;
        let tangent = quarter_turn(normal);
        let at = |[x, y, spin]: [f64; 3], arm: Vector| Vector::new(x, y) + quarter_turn(arm) * spin;
        let below = self.below.map_or([[0.0; 2].into(); 2], |(body, between)| {
            let velocity = [0, 1, 2].map(|row| motion[3 * body + row]);
            self.arms.map(|arm| at(velocity, arm + between))
        });
        let across = [0, 1].map(|k| normal.dot(&below[k]) + self.sign * opens[k]);
        let along = tangent.dot(&below[0]) + self.sign * slides;
        let (levers, lever) = self.levers();
        let spin = (across[1] - across[0]) / (levers[1] - levers[0]);
        let velocity = normal * (across[0] - spin * levers[0]) + tangent * (along - spin * lever);
        motion[3 * self.body..3 * self.body + 3].copy_from_slice(&[velocity.x, velocity.y, spin]);
    }
}

/// The joints from the ground outwards, one for each body; `None` where a body has more ways to the ground, or none.
fn joints(program: &Program) -> Option<Vec<Joint<'_>>> {
    let one_each = program.contacts.len() == program.blocks && program.grips.is_empty();
    if !one_each || program.contacts.iter().any(|contact| contact.points != 2) {
        return None;
    }
    let mut touching = vec![Vec::new(); program.blocks];
    let mut waiting = Vec::new();
    for (number, contact) in program.contacts.iter().enumerate() {
        match contact.from {
            Some((from, _)) => {
                touching[from].push(number);
                touching[contact.on.0].push(number);
            }
            None => waiting.push((number, None)),
        }
    }
    let mut found = vec![false; program.blocks];
    let mut joints = Vec::with_capacity(program.blocks);
    while let Some((number, below)) = waiting.pop() {
        let contact = &program.contacts[number];
        let both = [
            Some((contact.on, 1.0)),
            contact.from.map(|from| (from, -1.0)),
        ];
        let mut sides = both.into_iter().flatten();
        let ((body, arms), sign) = sides.find(|((body, _), _)| Some(*body) != below)?;
        if std::mem::replace(&mut found[body], true) {
            return None;
        }
        let between = sides_of(contact, below).map(|own| own - arms[0]);
        let joint = Joint {
            number,
            contact,
            body,
            arms,
            sign,
            below: below.zip(between),
        };
        let [first, second] = joint.levers().0;
        if (second - first).abs() < SHORTEST {
            return None;
        }
        joints.push(joint);
        let further = touching[body].iter().filter(|k| **k != number);
        waiting.extend(further.map(|k| (*k, Some(body))));
    }
    (joints.len() == program.blocks).then_some(joints)
}

/// The arm of a contact's first point about the centroid of one of its bodies.
fn sides_of(contact: &ContactTerm, body: Option<usize>) -> Option<Vector> {
    let sides = [Some(contact.on), contact.from].into_iter().flatten();
    let of_body = |side: &(usize, [Vector; 2])| Some(side.0) == body;
    sides.clone().find(of_body).map(|(_, arms)| arms[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::ContactKind;
    use crate::program::{Scale, columns, sticking_columns};
    use crate::solve::Conditioning;
    use crate::solve::numbers::Numbers;
    use crate::solve::stick::by_programs;

    /// Blocks that each touch one earlier one or the ground, in any direction and with any load.
    fn branches(blocks: usize, numbers: &mut Numbers) -> Program {
        let point = |numbers: &mut Numbers| Vector::new(3.0 * numbers.next(), 3.0 * numbers.next());
        let centroids: Vec<Vector> = (0..blocks).map(|_| point(numbers)).collect();
        let contact = |body: usize, numbers: &mut Numbers| {
            let angle = 4.0 * numbers.next();
            let normal = Vector::new(libm::cos(angle), libm::sin(angle));
            let middle = point(numbers);
            let half = quarter_turn(normal) * (0.6 + 0.4 * numbers.next());
            let arms = |body: usize| {
                (
                    body,
                    [middle - half, middle + half].map(|p| p - centroids[body]),
                )
            };
            let (own, other) = (arms(body), numbers.below(body + 1));
            let (on, from) = match other == body {
                true => (own, None),
                false if numbers.next() > 0.0 => (own, Some(arms(other))),
                false => (arms(other), Some(own)),
            };
            ContactTerm {
                kind: ContactKind::Edge,
                on,
                from,
                normal,
                friction: f64::max(0.0, 0.4 + 0.6 * numbers.next()).min(0.95),
                points: 2,
            }
        };
        Program {
            blocks,
            contacts: (0..blocks).map(|body| contact(body, numbers)).collect(),
            loads: (0..3 * blocks).map(|_| 10.0 * numbers.next()).collect(),
            grips: Vec::new(),
            scale: Scale {
                length: 1.0,
                force: 1.0,
            },
        }
    }

    #[test]
    fn what_sticks_is_what_the_programs_find_and_its_motion_shows_that_no_less_does() {
        let mut numbers = Numbers(3);
        let mut stuck_somewhere = 0;
        for blocks in [1, 2, 3, 5, 8].repeat(8) {
            let program = branches(blocks, &mut numbers);
            let found = stick(&program).unwrap();
            let other = by_programs(&program, Conditioning::Full.into());
            let total = found.sticking.total();
            assert!((total - other.sticking.total()).abs() < 1e-6 * (1.0 + total));
            assert!((found.forces.total() - other.forces.total()).abs() < 1e-5 * (1.0 + total));
            let all: Vec<_> = [columns(&program), sticking_columns(&program)].concat();
            let sum = Amounts {
                normal: std::iter::zip(&found.forces.normal, &found.sticking.normal)
                    .map(|(a, s)| [a[0] - s[0], a[1] - s[1]])
                    .collect(),
                friction: std::iter::zip(&found.forces.friction, &found.sticking.friction)
                    .map(|(a, s)| a + s)
                    .collect(),
                grip: Vec::new(),
            };
            assert!(sum.unbalanced(&program) < 1e-9 * (1.0 + total));
            // Velocities at which no force gains: their power bounds from below what has to stick.
            let motion = found.motion.unwrap();
            let fastest = motion.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
            for column in &all {
                let cost = if column.force.is_sticking() { 1.0 } else { 0.0 };
                assert!(-column.dot(&motion) <= cost + 1e-10 * fastest);
            }
            let power = |motion: &[f64]| -> f64 {
                let both = std::iter::zip(&program.loads, motion);
                both.map(|(l, v)| -l * v).sum()
            };
            let collapse = collapse(&program);
            assert_eq!(collapse.is_some(), total > 0.0);
            if let Some((falling, _)) = collapse {
                let gained = power(&falling);
                assert!(gained > 0.0 && gained <= total + 1e-8 * fastest * (1.0 + total));
            }
            let power = power(&motion);
            assert!(
                (power - total).abs() < 1e-8 * fastest * (1.0 + total),
                "{power} {total}"
            );
            stuck_somewhere += usize::from(total > 1.0);
        }
        assert!(stuck_somewhere > 20);
    }

    #[test]
    fn its_forces_are_those_that_stick_nowhere() {
        let mut numbers = Numbers(11);
        for blocks in [1, 2, 4, 9].repeat(10) {
            let mut program = branches(blocks, &mut numbers);
            program.loads.fill(0.0);
            for column in columns(&program) {
                let amount = 1.0 + 0.9 * numbers.next();
                column.add_to(&mut program.loads, amount);
            }
            let forces = determinate(&program).unwrap();
            assert!(forces.unbalanced(&program) < 1e-10);
            let stuck = stick(&program).unwrap();
            assert!(stuck.sticking.total() < 1e-10);
            assert_eq!(stuck.forces, forces);
            // One contact that has to pull is enough.
            let pulled = sticking_columns(&program);
            pulled[0].add_to(&mut program.loads, 20.0);
            assert!(determinate(&program).is_none());
            assert!(stick(&program).unwrap().sticking.total() > 1.0);
        }
    }

    #[test]
    fn where_forces_have_a_choice_it_says_nothing() {
        let mut numbers = Numbers(5);
        let tree = branches(4, &mut numbers);
        assert!(stick(&tree).is_some());
        let mut ring = tree.clone();
        ring.contacts.push(ring.contacts[3].clone());
        assert!(stick(&ring).is_none());
        // As many contacts as blocks, but one block has two and another none.
        ring.contacts.remove(0);
        assert!(stick(&ring).is_none());
        let mut rough = tree.clone();
        rough.contacts[1].friction = 1.1;
        assert!(stick(&rough).is_none());
        let mut corner = tree;
        corner.contacts[1].points = 1;
        assert!(stick(&corner).is_none() && determinate(&corner).is_none());
    }
}
