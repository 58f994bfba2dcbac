//! Tests of programs for two blocks, and of other forms of programs, with numbers computed by hand.

use super::*;

/// Creates a program of two blocks, with lengths in units of L. A box, 0.5 wide and 0.75 high, stands on the ground.
/// A board, 1 wide and 0.5 high, touches only the upper right corner of the box. A robot holds the upper left corner
/// of the board.
fn stacked() -> Program {
    let arms = |y: f64| [Vector::new(0.25, y), Vector::new(-0.25, y)];
    let joint =
        |on, from, kind, points| ContactTerm { kind, on, from, normal: Vector::new(0.0, 1.0), friction: 0.25, points };
    Program {
        blocks: 2,
        loads: vec![0.0, 300.0, 0.0, -15.0, 20.0, 10.0],
        contacts: vec![
            joint((0, arms(-0.375)), None, ContactKind::Edge, 2),
            joint((1, arms(-0.25)), Some((0, arms(0.375))), ContactKind::Corner, 1),
        ],
        grips: vec![GripTerm { block: 1, arm: Vector::new(-0.5, 0.25), limits: [10.0, 25.0, 8.0] }],
        scale: Scale::new(4.0, 600.0),
    }
}

#[test]
fn the_unit_of_force_is_a_300th_of_the_heaviest_load() {
    let scale = Scale::new(5.0, 3.0);
    assert_eq!((scale.length, scale.force, scale.moment()), (5.0, 0.01, 0.05));
    // Without loads the unit of force is 1/300 N.
    assert_eq!(Scale::new(2.0, 0.0).force, 1.0 / 300.0);
}

/// Frictionless joints have no friction columns. A force through the centroid of a block has no moment.
#[test]
fn products_of_columns_of_several_blocks_equal_products_of_dense_vectors() {
    let mut program = stacked();
    program.contacts[0].on.1[1].x = 0.0;
    program.contacts[1].on.1[0].x = 0.0;
    let smooth = {
        let mut smooth = program.clone();
        smooth.contacts.iter_mut().for_each(|c| c.friction = 0.0);
        columns(&smooth)
    };
    let pressing = smooth.iter().filter(|c| matches!(c.force, Force::Ray { .. }));
    assert_eq!(pressing.count(), 3);
    let mut all = columns(&program);
    all.extend(adhesion_columns(&program));
    all.extend(smooth);
    for a in &all {
        for b in &all {
            let expected: f64 = (dense(a, 6).iter().zip(dense(b, 6))).map(|(a, b)| a * b).sum();
            assert!((a.dot_column(b) - expected).abs() < 1e-14, "{a:?} {b:?}");
        }
    }
}

#[test]
fn only_forces_of_one_kind_at_one_contact_or_robot_have_a_product() {
    let ray = |contact, point| Force::Ray { contact, point, normal: 0.5, friction: 0.25 };
    assert_eq!(product(&ray(0, 0), &ray(1, 0)), None);
    assert_eq!(product(&ray(1, 0), &ray(1, 0)), Some(0.25 + 0.0625));
    assert_eq!(product(&ray(1, 0), &ray(1, 1)), Some(0.0625));
    let beyond = |grip, component| Force::AdhesionGrip { grip, component, sign: -1.0 };
    assert_eq!(product(&beyond(0, 1), &beyond(1, 1)), None);
    assert_eq!(product(&beyond(1, 1), &beyond(1, 1)), Some(1.0));
    assert_eq!(product(&beyond(1, 1), &beyond(1, 2)), Some(0.0));
    let stick = |contact, point| Force::AdhesionNormal { contact, point };
    assert_eq!(product(&stick(1, 0), &stick(1, 0)), Some(1.0));
    assert_eq!(product(&stick(1, 0), &stick(1, 1)), Some(0.0));
    let hold = |contact, sign| Force::AdhesionFriction { contact, sign };
    assert_eq!(product(&hold(1, 1.0), &hold(1, -1.0)), Some(-1.0));
    assert_eq!(product(&stick(1, 0), &hold(1, -1.0)), Some(0.0));
    assert_eq!(product(&hold(1, -1.0), &stick(1, 0)), Some(0.0));
    assert_eq!(product(&ray(1, 0), &stick(1, 0)), None);
}

/// Two robots hold one block. Only the first has limits. Only a pair of columns without limits becomes one equality.
#[test]
fn only_a_pair_of_opposite_unlimited_forces_becomes_one_equality() {
    let mut program = example();
    let other = GripTerm { limits: [f64::INFINITY; 3], ..program.grips[0].clone() };
    program.contacts[0].points = 1;
    program.grips.push(other);
    let all = columns(&program);
    assert_eq!(all.len(), 3 + 6 + 6);
    let (conic, row_of) = kinematic_form(&program.loads, &all, &Aim::Least(&|_: &Column| 0.0));
    // The pairs are the vertical force of the first robot and all three components of the second.
    assert_eq!(conic.equalities, 4);
    let pairs = [(5, 6), (9, 10), (11, 12), (13, 14)];
    for (number, (plus, minus)) in pairs.into_iter().enumerate() {
        assert_eq!((row_of[plus], row_of[minus]), (number, usize::MAX));
    }
    let others = [0, 1, 2, 3, 4, 7, 8].map(|k| row_of[k]);
    assert_eq!(others, [4, 5, 6, 7, 8, 9, 10]);
    // The last column has no partner after it. A pair in the reverse order does not count as a pair.
    let (conic, _) = kinematic_form(&program.loads, &all[..14], &Aim::Least(&|_: &Column| 0.0));
    assert_eq!(conic.equalities, 3);
    let turned = [all[12], all[11]];
    let (conic, _) = kinematic_form(&program.loads, &turned, &Aim::Least(&|_: &Column| 0.0));
    assert_eq!(conic.equalities, 0);
}

#[test]
fn the_force_program_minimises_costs_and_can_limit_another_sum() {
    let program = example();
    let all = columns(&program);
    let free = force_primal(&program.loads, &all, |c| 2.0 * c.cost, None);
    let plain = least_squares(&program.loads, &all, None);
    assert_eq!(free.linear, [2.0; 12]);
    assert!(free.quadratic.is_empty());
    assert_eq!((&free.bound, &free.matrix), (&plain.bound, &plain.matrix));
    let robots = |c: &Column| f64::from(u8::from(matches!(c.force, Force::Grip { .. })));
    let capped = force_primal(&program.loads, &all, |c| c.cost, Some((&robots, 7.0)));
    let last = plain.bound.len();
    assert_eq!((capped.bound.len(), capped.bound[last]), (last + 1, 7.0));
    let expected: Vec<f64> = (0..12).map(|k| if k < 6 { 0.0 } else { 1.0 }).collect();
    assert_eq!(row(&capped, last), expected);
}
