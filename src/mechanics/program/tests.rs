//! Tests with a box of 4 m by 3 m on the ground, held by a robot. The numbers are computed by hand, with L = 2 m and
//! a unit of force of 2 N.

use super::*;
use crate::mechanics::statics::effect::EffectName;

mod pose;

/// The numbers of unknowns of contacts, friction, corner contacts, robots' forces, robots' torques and adhesion.
fn by_effect(counts: &UnknownCounts) -> [usize; 6] {
    [
        EffectName::Contact,
        EffectName::Friction,
        EffectName::CornerContacts,
        EffectName::Robots,
        EffectName::RobotTorque,
        EffectName::Sticking,
    ]
    .map(|effect| counts.get(effect))
}

const THIRD: f64 = 1.0 / 3.0;

/// The box with loads of 1 N to the right, 8 N down and 3 N·m. A robot holds its upper left corner, with limits in N
/// and N·m.
fn held(fx: f64, fy: f64, torque: f64) -> Program {
    Program {
        blocks: 1,
        loads: vec![-0.5, 4.0, -0.75],
        contacts: vec![ContactTerm {
            kind: ContactKind::Edge,
            on: (0, [Vector::new(0.5, -0.75), Vector::new(-0.5, -0.75)]),
            from: None,
            normal: Vector::new(0.0, 1.0),
            friction: 0.5,
            points: 2,
        }],
        grips: vec![GripTerm { block: 0, arm: Vector::new(-1.0, 0.75), limits: [fx / 2.0, fy / 2.0, torque / 4.0] }],
        scale: Scale::new(2.0, 600.0),
    }
}

fn example() -> Program {
    held(2.0, f64::INFINITY, 8.0)
}

fn assert_columns(columns: &[Column], expected: &[&[(usize, f64)]]) {
    assert_eq!(columns.len(), expected.len());
    for (column, expected) in columns.iter().zip(expected) {
        assert_entries(column, expected);
    }
}

fn assert_entries(column: &Column, expected: &[(usize, f64)]) {
    let found: Vec<(usize, f64)> = column.entries().collect();
    let same = |(a, b): (&(usize, f64), &(usize, f64))| a.0 == b.0 && (a.1 - b.1).abs() < 1e-15;
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(same), "{found:?}, not {expected:?}");
}

/// A row of a quadratic program as dense numbers.
fn row(conic: &QuadraticProgram, number: usize) -> Vec<f64> {
    let mut row = vec![0.0; conic.unknowns];
    for (_, column, value) in conic.matrix.iter().filter(|e| e.0 == number) {
        row[*column] += value;
    }
    row
}

fn dense(column: &Column, length: usize) -> Vec<f64> {
    let mut dense = vec![0.0; length];
    column.add_to(&mut dense, 1.0);
    dense
}

#[test]
fn columns_are_the_edges_of_friction_cones_and_the_components_of_robots() {
    let program = example();
    let columns = columns(&program);
    // The points of the joint are L/2 to either side of the centroid and 3/4 L below it. A vertical unit force has a
    // moment of ±1/2. A unit on the edge of the friction cone consists of 2/3 normal force and 1/3 friction.
    let expected: [&[(usize, f64)]; 12] = [
        &[(1, 1.0), (2, 0.5)],
        &[(0, -THIRD), (1, 2.0 * THIRD), (2, 1.0 / 12.0)],
        &[(0, THIRD), (1, 2.0 * THIRD), (2, 7.0 / 12.0)],
        &[(1, 1.0), (2, -0.5)],
        &[(0, -THIRD), (1, 2.0 * THIRD), (2, -7.0 / 12.0)],
        &[(0, THIRD), (1, 2.0 * THIRD), (2, -1.0 / 12.0)],
        &[(0, 1.0), (2, -0.75)],
        &[(0, -1.0), (2, 0.75)],
        &[(1, 1.0), (2, -1.0)],
        &[(1, -1.0), (2, 1.0)],
        &[(2, 1.0)],
        &[(2, -1.0)],
    ];
    assert_columns(&columns, &expected);
    assert!(columns.iter().all(|c| c.cost == 1.0 && !c.force.is_adhesion()));
    let limits: Vec<f64> = columns[6..].iter().map(|c| c.limit).collect();
    let free = f64::INFINITY;
    assert_eq!(limits, [1.0, 1.0, free, free, 2.0, 2.0]);
    assert!(columns[..6].iter().all(|c| c.limit.is_infinite()));
    // A component with limit 0 has no column.
    assert_eq!(super::columns(&held(0.0, 1.0, 0.0)).len(), 8);
}

#[test]
fn adhesion_columns_allow_tension_any_friction_and_unlimited_robots() {
    let program = example();
    let columns = adhesion_columns(&program);
    let expected: [&[(usize, f64)]; 10] = [
        &[(1, -1.0), (2, -0.5)],
        &[(1, -1.0), (2, 0.5)],
        &[(0, -1.0), (2, -0.75)],
        &[(0, 1.0), (2, 0.75)],
        &[(0, 1.0), (2, -0.75)],
        &[(0, -1.0), (2, 0.75)],
        &[(1, 1.0), (2, -1.0)],
        &[(1, -1.0), (2, 1.0)],
        &[(2, 1.0)],
        &[(2, -1.0)],
    ];
    assert_columns(&columns, &expected);
    assert!((columns.iter()).all(|c| c.force.is_adhesion() && c.limit.is_infinite()));
    let counts = UnknownCounts::new(&program);
    assert_eq!(by_effect(&counts), [2, 4, 0, 4, 2, 10]);
    assert_eq!(by_effect(&counts.clone().plus(&counts)), [4, 8, 0, 8, 4, 20]);
}

#[test]
fn a_contact_force_acts_on_the_other_body_in_the_opposite_direction() {
    let program = Program {
        blocks: 2,
        loads: vec![0.0; 6],
        contacts: vec![ContactTerm {
            kind: ContactKind::Corner,
            on: (1, [Vector::new(0.5, -0.5); 2]),
            from: Some((0, [Vector::new(0.5, 0.75); 2])),
            normal: Vector::new(0.0, 1.0),
            friction: 0.5,
            points: 1,
        }],
        grips: vec![],
        scale: Scale::new(2.0, 600.0),
    };
    let columns = columns(&program);
    // A corner contact has one point. It is half of L below the centroid of block 1, and three quarters of L
    // above the centroid of block 0.
    assert_eq!(columns.len(), 3);
    assert_entries(
        &columns[1],
        &[
            (3, -THIRD),
            (4, 2.0 * THIRD),
            (5, THIRD - 0.5 * THIRD),
            (0, THIRD),
            (1, -2.0 * THIRD),
            (2, -(THIRD + 0.75 * THIRD)),
        ],
    );
    let counted = UnknownCounts::new(&program);
    assert_eq!(by_effect(&counted)[..3], [0, 0, 3]);
    assert_eq!(by_effect(&counted.clone().plus(&counted))[2], 6);
}

#[test]
fn products_of_columns_equal_products_of_dense_vectors() {
    let program = example();
    let mut all = columns(&program);
    all.extend(adhesion_columns(&program));
    let y = [0.25, -3.0, 7.0];
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for a in &all {
        let of_a = dense(a, 3);
        assert!((a.dot(&y) - product(&of_a, &y)).abs() < 1e-14);
        for b in &all {
            let of_b = dense(b, 3);
            assert!((a.dot_column(b) - product(&of_a, &of_b)).abs() < 1e-14);
            let same: Vec<f64> = b.entries().map(|e| e.1).collect();
            let own: Vec<f64> = a.entries().map(|e| e.1).collect();
            let equal = own == same && a.limit == b.limit;
            assert_eq!(a.has_values_of(b), equal);
        }
    }
    let mut sum = [1.0, 1.0, 1.0];
    all[0].add_to(&mut sum, -2.0);
    assert_eq!(sum, [1.0, -1.0, 0.0]);
}

/// The squared forces are N1, N2 and T of the joint, and each component of a grip.
#[test]
fn the_quadratic_form_sums_squares_of_forces() {
    let program = example();
    for columns in [columns(&program), adhesion_columns(&program)] {
        let amounts: Vec<f64> = (1..=columns.len()).map(|k| 0.3 * k as f64 + 0.1).collect();
        let (mut normal, mut friction, mut grip) = ([0.0; 2], 0.0, [0.0; 3]);
        for (column, amount) in columns.iter().zip(&amounts) {
            match column.force {
                Force::Ray { point, normal: n, friction: t, .. } => {
                    normal[point] += n * amount;
                    friction += t * amount;
                }
                Force::AdhesionNormal { point, .. } => normal[point] += amount,
                Force::AdhesionFriction { sign, .. } => friction += sign * amount,
                Force::Grip { component, sign, .. } | Force::AdhesionGrip { component, sign, .. } => {
                    grip[component] += sign * amount
                }
            }
        }
        let squares = normal.iter().chain(&grip).map(|v| v * v);
        let expected = squares.sum::<f64>() + friction * friction;
        let conic = least_squares(&program.loads, &columns, None);
        let of = |(i, j, value): &(usize, usize, f64)| {
            assert!(i <= j, "an entry ({i}, {j}) is below the diagonal");
            let twice = if i == j { 1.0 } else { 2.0 };
            twice * value * amounts[*i] * amounts[*j]
        };
        let found: f64 = conic.quadratic.iter().map(of).sum();
        assert!((found - expected).abs() < 1e-12 * expected, "{found} {expected}");
        assert!(conic.linear.iter().all(|v| *v == 0.0));
    }
    let place = |grip, component, sign| Force::Grip { grip, component, sign };
    assert_eq!(product(&place(0, 1, 1.0), &place(1, 1, 1.0)), None);
    assert_eq!(product(&place(0, 1, 1.0), &place(0, 2, 1.0)), Some(0.0));
    let stick = |contact, point| Force::AdhesionNormal { contact, point };
    assert_eq!(product(&stick(0, 1), &stick(1, 1)), None);
    let hold = |contact, sign| Force::AdhesionFriction { contact, sign };
    assert_eq!(product(&hold(0, 1.0), &hold(1, 1.0)), None);
    assert_eq!(product(&stick(0, 1), &hold(1, 1.0)), None);
    assert_eq!(product(&stick(0, 1), &place(0, 1, 1.0)), None);
}

#[test]
fn bounds_keep_amounts_and_corrected_amounts_between_zero_and_their_limits() {
    let program = example();
    let columns = columns(&program);
    let amounts: Vec<f64> = (0..columns.len()).map(|k| 0.125 * k as f64).collect();
    let correction = Correction { amounts: &amounts, size: 0.5, largest: f64::INFINITY };
    for correction in [None, Some(correction)] {
        let conic = least_squares(&program.loads, &columns, correction);
        assert_eq!((conic.unknowns, conic.equalities), (12, 3));
        assert_eq!(conic.bound[..3], program.loads);
        let mut next = 3;
        for (j, column) in columns.iter().enumerate() {
            for (i, value) in dense(column, 3).into_iter().enumerate() {
                assert_eq!(row(&conic, i)[j], value);
            }
            let (floor, size) = correction.map_or((0.0, 1.0), |c| (2.0 * c.amounts[j], c.size));
            let mut unit = vec![0.0; 12];
            unit[j] = -1.0;
            assert_eq!((row(&conic, next), conic.bound[next]), (unit.clone(), floor));
            next += 1;
            if column.limit.is_finite() {
                unit[j] = 1.0;
                let most = column.limit / size - floor;
                assert_eq!((row(&conic, next), conic.bound[next]), (unit, most));
                next += 1;
            }
        }
        assert_eq!(conic.bound.len(), next);
        if correction.is_some() {
            let unit: Vec<_> = (0..12).map(|j| (j, j, 1.0)).collect();
            assert_eq!(conic.quadratic, unit);
        }
    }
}

#[test]
fn the_kinematic_dual_has_a_row_for_every_column() {
    let program = example();
    let columns = columns(&program);
    // The robot's force along x and its torque are limited in both directions: four more unknowns, each with one
    // more row.
    let (conic, row_of) = kinematic_form(&program.loads, &columns, &Aim::Least(&|c: &Column| c.cost));
    assert_eq!((conic.unknowns, conic.equalities), (7, 0));
    assert_eq!(conic.bound.len(), 12 + 4);
    assert_eq!(conic.linear, [0.5, -4.0, 0.75, 1.0, 1.0, 2.0, 2.0]);
    let limited: Vec<usize> = (0..12).filter(|k| columns[*k].limit.is_finite()).collect();
    for (k, column) in columns.iter().enumerate() {
        let mut expected = dense(column, 7);
        if let Some(w) = limited.iter().position(|other| *other == k) {
            expected[3 + w] = -1.0;
            let mut positive = vec![0.0; 7];
            positive[3 + w] = -1.0;
            assert_eq!((row(&conic, 12 + w), conic.bound[12 + w]), (positive, 0.0));
        }
        assert_eq!((row(&conic, row_of[k]), conic.bound[row_of[k]]), (expected, 1.0));
    }
    // Without cost, the pair of columns of the unlimited vertical force is one equality.
    let (conic, row_of) = kinematic_form(&program.loads, &columns, &Aim::Least(&|_: &Column| 0.0));
    assert_eq!((conic.equalities, conic.bound.len()), (1, 11 + 4));
    assert_eq!((row_of[8], row_of[9]), (0, usize::MAX));
    assert_eq!(row(&conic, 0), dense(&columns[8], 7));
    let others: Vec<usize> = row_of.iter().copied().filter(|r| (1..11).contains(r)).collect();
    assert_eq!(others.len(), 10);

    let (conic, _) = kinematic_form(&program.loads, &columns, &Aim::Factor(Factor::Largest, &[0.0, 2.0, -1.0], 1.0));
    let last = conic.bound.len() - 1;
    assert_eq!(row(&conic, last), [0.0, -2.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(conic.bound[last], -1.0);
    let (conic, _) = kinematic_form(&program.loads, &columns, &Aim::Residual);
    for (k, sign) in [(0, 1.0), (1, -1.0), (4, 1.0), (5, -1.0)] {
        let at = 15 + k;
        let mut unit = vec![0.0; 7];
        unit[k / 2] = sign;
        assert_eq!((row(&conic, at), conic.bound[at]), (unit, 1.0));
    }
}

#[test]
fn the_programs_of_least_change_and_least_norm_have_the_expected_rows() {
    let program = example();
    let columns = columns(&program);
    let rows = [(&columns[0], 2.0), (&columns[2], 3.0)];
    let conic = least_change(3, &rows, 1);
    assert_eq!((row(&conic, 0), conic.bound[0]), (dense(&columns[0], 3), 2.0));
    let turned: Vec<f64> = dense(&columns[2], 3).iter().map(|v| -v).collect();
    assert_eq!((row(&conic, 1), conic.bound[1]), (turned, -3.0));
    assert_eq!(conic.quadratic, [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0)]);
    assert_eq!(conic.equalities, 1);

    let conic = least_norm(&program.loads, &columns);
    assert_eq!((conic.equalities, conic.bound), (3, program.loads.clone()));
    assert_eq!(conic.unknowns, 12);
    assert!(conic.quadratic.iter().all(|(i, j, v)| i == j && *v == 1.0));
    assert_eq!(conic.quadratic.len(), 12);
}

#[test]
fn limits_of_more_than_ten_times_all_loads_do_not_bind() {
    // The loads are 5.25 units in total, so a limit above 52.5 units does not bind.
    assert!(held(105.0, f64::INFINITY, 8.0).without_non_binding_limits().is_none());
    let without = held(106.0, 4.0, 211.0).without_non_binding_limits();
    let limits = without.map(|program| program.grips[0].limits);
    assert_eq!(limits, Some([f64::INFINITY, 2.0, f64::INFINITY]));
    let program = example();
    assert!(program.allows(&[[-1.0, 1e9, 2.0]]));
    assert!(program.allows(&[[1.0 + 1e-9, 0.0, -2.0]]));
    assert!(!program.allows(&[[-1.0 - 1e-8, 0.0, 0.0]]));
    assert!(!program.allows(&[[0.0, 0.0, 2.0 + 1e-8]]));
}
