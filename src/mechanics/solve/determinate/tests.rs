//! Tests with random trees of blocks: the closed forms agree with the linear programs, and the motions prove bounds.

use super::*;
use crate::geometry::quarter_turn;
use crate::mechanics::program::ContactTerm;
use crate::mechanics::program::{Scale, adhesion_columns, columns};
use crate::mechanics::solve::Conditioning;
use crate::mechanics::solve::least_adhesion::by_programs;
use crate::mechanics::solve::random_numbers::RandomNumbers;
use crate::mechanics::statics::interface::ContactKind;

/// Blocks that each touch one earlier block or the ground, in any direction and with any load.
fn branches(blocks: usize, numbers: &mut RandomNumbers) -> Program {
    let point = |numbers: &mut RandomNumbers| Vector::new(3.0 * numbers.next(), 3.0 * numbers.next());
    let centroids: Vec<Vector> = (0..blocks).map(|_| point(numbers)).collect();
    let contact = |body: usize, numbers: &mut RandomNumbers| {
        let angle = 4.0 * numbers.next();
        let normal = Vector::new(libm::cos(angle), libm::sin(angle));
        let middle = point(numbers);
        let half = quarter_turn(normal) * (0.6 + 0.4 * numbers.next());
        let arms = |body: usize| (body, [middle - half, middle + half].map(|p| p - centroids[body]));
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
        scale: Scale { length: 1.0, force: 1.0 },
    }
}

#[test]
fn the_least_adhesion_agrees_with_the_programs_and_its_motion_proves_the_minimum() {
    let mut numbers = RandomNumbers(3);
    let mut stuck_somewhere = 0;
    for blocks in [1, 2, 3, 5, 8].repeat(8) {
        let program = branches(blocks, &mut numbers);
        let found = least_adhesion(&program).unwrap();
        let other = by_programs(&program, Conditioning::Full.into());
        let (forces, adhesion) = found.forces.zip(found.adhesion).unwrap();
        let total = adhesion.total();
        assert!((total - other.adhesion.unwrap().total()).abs() < 1e-6 * (1.0 + total));
        assert!((forces.total() - other.forces.unwrap().total()).abs() < 1e-5 * (1.0 + total));
        let all: Vec<_> = [columns(&program), adhesion_columns(&program)].concat();
        let sum = Amounts {
            normal: std::iter::zip(&forces.normal, &adhesion.normal).map(|(a, s)| [a[0] - s[0], a[1] - s[1]]).collect(),
            friction: std::iter::zip(&forces.friction, &adhesion.friction).map(|(a, s)| a + s).collect(),
            grip: Vec::new(),
        };
        assert!(sum.unbalanced(&program) < 1e-9 * (1.0 + total));
        // At these velocities no force gains more power than it costs. The power of the loads is therefore a lower
        // bound of the adhesion.
        let motion = found.motion.unwrap();
        let fastest = motion.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
        for column in &all {
            let cost = if column.force.is_adhesion() { 1.0 } else { 0.0 };
            assert!(-column.dot(&motion) <= cost + 1e-10 * fastest);
        }
        let power = |motion: &[f64]| -> f64 {
            let both = std::iter::zip(&program.loads, motion);
            both.map(|(l, v)| -l * v).sum()
        };
        let collapse = collapse(&program);
        assert_eq!(collapse.is_some(), total > 0.0);
        if let Some(falling) = collapse.and_then(|found| found.motion) {
            let gained = power(&falling);
            assert!(gained > 0.0 && gained <= total + 1e-8 * fastest * (1.0 + total));
        }
        let power = power(&motion);
        assert!((power - total).abs() < 1e-8 * fastest * (1.0 + total), "{power} {total}");
        stuck_somewhere += usize::from(total > 1.0);
    }
    assert!(stuck_somewhere > 20);
}

#[test]
fn determinate_forces_need_no_adhesion() {
    let mut numbers = RandomNumbers(11);
    for blocks in [1, 2, 4, 9].repeat(10) {
        let mut program = branches(blocks, &mut numbers);
        program.loads.fill(0.0);
        for column in columns(&program) {
            let amount = 1.0 + 0.9 * numbers.next();
            column.add_to(&mut program.loads, amount);
        }
        let forces = determinate(&program).unwrap();
        assert!(forces.unbalanced(&program) < 1e-10);
        let stuck = least_adhesion(&program).unwrap();
        assert!(stuck.adhesion.unwrap().total() < 1e-10);
        assert_eq!(stuck.forces, Some(forces));
        // With a single contact in tension, the contacts alone cannot balance the loads.
        let pulled = adhesion_columns(&program);
        pulled[0].add_to(&mut program.loads, 20.0);
        assert!(determinate(&program).is_none());
        assert!(least_adhesion(&program).unwrap().adhesion.unwrap().total() > 1.0);
    }
}

#[test]
fn there_is_no_closed_form_for_rings_corner_contacts_and_high_friction() {
    let mut numbers = RandomNumbers(5);
    let tree = branches(4, &mut numbers);
    assert!(least_adhesion(&tree).is_some());
    let mut ring = tree.clone();
    ring.contacts.push(ring.contacts[3].clone());
    assert!(least_adhesion(&ring).is_none());
    // There are as many contacts as blocks, but one block has two contacts and another has none.
    ring.contacts.remove(0);
    assert!(least_adhesion(&ring).is_none());
    let mut rough = tree.clone();
    rough.contacts[1].friction = 1.1;
    assert!(least_adhesion(&rough).is_none());
    let mut corner = tree;
    corner.contacts[1].points = 1;
    assert!(least_adhesion(&corner).is_none() && determinate(&corner).is_none());
}
