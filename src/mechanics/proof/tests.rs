//! Tests of proofs by forces and of their threshold, for a box of 4 m by 3 m and a second box on it. The expected
//! numbers are computed by hand.

use super::*;
use crate::mechanics::scene::{BodyId, Limits, RobotId};
use crate::mechanics::statics::assembly::{AssemblyContact, AssemblyGrip};

mod balance;
mod least;
mod mechanism;

/// A box 4 m wide, whose lower left corner is (0, `bottom`). With `bottom` 0 and a height of 3 m, its centroid is (2,
/// 1.5), and its farthest corner is 2.5 m away from the centroid.
fn body(number: usize, bottom: f64, height: f64, weight: f64, listed: LoadVector) -> AssemblyBody {
    let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, height), (0.0, height)];
    AssemblyBody {
        block: BlockId(number),
        centroid: Point::new(2.0, bottom + height / 2.0),
        corners: corners.map(|(x, y)| Point::new(x, bottom + y)).into(),
        weight,
        listed,
        fixed: LoadVector::ZERO,
        load: LoadVector::ZERO,
    }
}

fn listed(x: f64, y: f64, moment: f64) -> LoadVector {
    LoadVector { force: Vector::new(x, y), moment }
}

/// A level joint at this height, with application points at x = 3 and x = 1 and a friction coefficient of 0.5.
fn joint(on: usize, from: Option<usize>, height: f64) -> AssemblyContact {
    let at = |x: f64| Point::new(x, height);
    AssemblyContact {
        interface: on,
        bodies: [BodyId::Block(BlockId(on)), from.map_or(BodyId::Ground(0), |n| BodyId::Block(BlockId(n)))],
        on,
        from,
        kind: ContactKind::Edge,
        ends: [at(4.0), at(0.0)],
        points: [at(3.0), at(1.0)],
        normal: Vector::new(0.0, 1.0),
        friction: 0.5,
        is_factored: true,
    }
}

fn grip(body: usize, fx: f64, fy: f64, torque: f64) -> AssemblyGrip {
    AssemblyGrip { hold: 0, robot: RobotId(0), body, at: Point::new(0.0, 3.0), limits: Limits { fx, fy, torque } }
}

fn assembly(bodies: Vec<AssemblyBody>, contacts: Vec<AssemblyContact>) -> Assembly {
    Assembly { bodies, contacts, grips: Vec::new(), pull: Vector::new(0.0, -1.0), load_factor: 1.0, length: 2.0 }
        .with_summed_loads()
}

/// The box of 10 N on the ground, with a listed load.
fn on_ground(listed: LoadVector) -> Assembly {
    assembly(vec![body(0, 0.0, 3.0, 10.0, listed)], vec![joint(0, None, 0.0)])
}

fn pressed(first: f64, second: f64, friction: f64) -> ContactForces {
    ContactForces { normal: [first, second], friction }
}

fn moving(block: usize, x: f64, y: f64, spin: f64) -> Motion {
    Motion { block: BlockId(block), velocity: Vector::new(x, y), spin }
}

/// Returns the imbalance, share, pull and slip of forces.
fn found(assembly: &Assembly, contacts: Vec<ContactForces>, grips: Vec<GripForces>) -> [f64; 4] {
    match check_forces(assembly, &Forces { contacts, grips }) {
        Proof::Forces { worst_imbalance, worst_share, worst_pull, worst_slip } => {
            [worst_imbalance, worst_share, worst_pull, worst_slip]
        }
        Proof::Mechanism { .. } => [f64::NAN; 4],
    }
}

fn assert_near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found}, not {expected}");
}

#[test]
fn forces_in_exact_balance_have_no_imbalance() {
    // A push of 1 N at the middle of the upper box is resisted by friction in both joints. About the lower centroid
    // each of the two friction forces has a moment of −1.5 N·m, so the ground presses 3 N more at its right point, 1
    // m from the middle, than at its left point. The uneven pressure of the upper joint adds 1 N to this difference.
    let two = assembly(
        vec![body(0, 0.0, 3.0, 10.0, LoadVector::ZERO), body(1, 3.0, 2.0, 6.0, listed(1.0, 0.0, 0.0))],
        vec![joint(0, None, 0.0), joint(1, Some(0), 3.0)],
    );
    let below = pressed(9.5 + 0.5, 6.5 - 0.5, 1.0);
    // About the upper centroid, friction has a moment of −1 N·m. It is balanced by normal forces that differ by ±0.5
    // N from their mean.
    let above = pressed(3.5, 2.5, 1.0);
    assert_eq!(found(&two, vec![below, above], vec![]), [0.0; 4]);
    // A robot's force and torque at (0, 3): −2 N along x has a moment of +3 N·m about the centroid, which is 1.5 m
    // lower; −4 N along y has a moment of +8 N·m.
    let mut held = on_ground(listed(2.0, 4.0, -4.0));
    held.grips = vec![grip(0, 2.0, 4.0, 9.0)];
    let exerted = GripForces { force: Vector::new(-2.0, -4.0), torque: 4.0 - 3.0 - 8.0 };
    let all = found(&held, vec![pressed(5.0, 5.0, 0.0)], vec![exerted]);
    assert_eq!(all, [0.0; 4]);
}

#[test]
fn imbalance_is_the_fraction_by_which_forces_must_change_or_move() {
    let box_alone = on_ground(LoadVector::ZERO);
    assert_eq!(found(&box_alone, vec![pressed(5.0, 5.0, 0.0)], vec![]), [0.0; 4]);
    // The joint exerts 1 N too much: 1 N relative to 11 N of the joint and 10 N of weight.
    let all = found(&box_alone, vec![pressed(5.5, 5.5, 0.0)], vec![]);
    assert_near(all[0], 1.0 / 21.0, 1e-5);
    assert_near(all[1], 0.1, 1e-15);
    // A moment of 2 N·m is 0.8 N at the radius of 2.5 m. Moving 20 N of forces counts 20 N, the moment itself 0.8 N.
    // A change of 5 N at each of the two points, 1 m to either side of the centroid, counts 4 N.
    let twisted = on_ground(listed(0.0, 0.0, 2.0));
    let all = found(&twisted, vec![pressed(5.0, 5.0, 0.0)], vec![]);
    assert_near(all[0], 0.8 / 24.8, 1e-6);
    assert_near(all[1], 0.8 / 10.8, 1e-15);
    // Only the push of 1 N itself acts in its direction.
    let pushed = on_ground(listed(1.0, 0.0, 0.0));
    let all = found(&pushed, vec![pressed(5.0, 5.0, 0.0)], vec![]);
    assert_near(all[0], 1.0, 1e-3);
    // The imbalance of the assembly is the largest of all blocks.
    let mut two = on_ground(LoadVector::ZERO);
    two.bodies.push(body(1, 3.0, 2.0, 6.0, LoadVector::ZERO));
    two.contacts.push(joint(1, Some(0), 3.0));
    let contacts = vec![pressed(8.0, 8.0, 0.0), pressed(3.5, 3.5, 0.0)];
    let each = imbalances(&two, &Forces { contacts: contacts.clone(), grips: vec![] });
    assert_near(each[0], 1.0 / 33.0, 1e-5);
    assert_near(each[1], 1.0 / 13.0, 1e-5);
    assert_eq!(found(&two, contacts, vec![])[0], each[1]);
}

#[test]
fn the_load_factor_and_the_direction_of_gravity_count_in_the_balance() {
    let doubled = on_ground(listed(0.0, -3.0, 0.0)).with_load_factor(2.0);
    let all = found(&doubled, vec![pressed(8.0, 8.0, 0.0)], vec![]);
    assert_eq!(all, [0.0; 4]);
    assert_near(gross_load(&doubled, &doubled.bodies[0]), 16.0, 1e-15);
    let leaning = on_ground(LoadVector::ZERO).with_gravity(Vector::new(0.6, -0.8));
    // Friction resists 6 N of the weight, 1.5 m below the centroid: a moment of 9 N·m, so the right point has 4.5 N
    // more and the left point 4.5 N less.
    let all = found(&leaning, vec![pressed(8.5, -0.5, 6.0)], vec![]);
    assert_eq!(all[0], 0.0);
}

#[test]
fn pull_slip_and_excess_over_limits_are_relative_to_the_forces_concerned() {
    let all = |assembly: &Assembly, at: ContactForces| found(assembly, vec![at], vec![]);
    let edge = on_ground(LoadVector::ZERO);
    assert_near(all(&edge, pressed(-1.0, 11.0, 0.0))[2], 1.0 / 12.0, 1e-15);
    assert_near(all(&edge, pressed(11.0, -1.0, 0.0))[2], 1.0 / 12.0, 1e-15);
    assert_near(all(&edge, pressed(4.0, 6.0, -6.0))[3], 1.0 / 16.0, 1e-15);
    assert_eq!(all(&edge, pressed(4.0, 6.0, 5.0))[2..], [0.0, 0.0]);
    // A corner contact has only one point. Any force at the other point is an error.
    let mut tip = on_ground(LoadVector::ZERO);
    tip.contacts[0].kind = ContactKind::Corner;
    assert_near(all(&tip, pressed(6.0, 2.0, 0.0))[2], 0.25, 1e-15);
    assert_near(all(&tip, pressed(6.0, -2.0, 0.0))[2], 0.25, 1e-15);
    assert_near(all(&tip, pressed(-6.0, 0.0, 0.0))[2], 1.0, 1e-15);
    assert_eq!(all(&tip, pressed(6.0, 0.0, 0.0))[2], 0.0);
    let mut held = on_ground(LoadVector::ZERO);
    for (force, torque, over) in
        [((3.0, 4.0), 5.0, 0.0), ((-4.0, 0.0), 0.0, 0.25), ((0.0, 8.0), 0.0, 0.5), ((0.0, 0.0), -20.0, 0.75)]
    {
        held.grips = vec![grip(0, 3.0, 4.0, 5.0)];
        let exerted = GripForces { force: Vector::new(force.0, force.1), torque };
        let slip = found(&held, vec![pressed(5.0, 5.0, 0.0)], vec![exerted])[3];
        assert_near(slip, over, 1e-15);
    }
}

#[test]
fn a_proof_holds_if_it_meets_the_threshold() {
    let balances = |imbalance, pull, slip| Proof::Forces {
        worst_imbalance: imbalance,
        worst_share: 1.0,
        worst_pull: pull,
        worst_slip: slip,
    };
    let band = Proof::IMBALANCE_TOL;
    assert!(balances(band, band, band).holds());
    for over in [balances(2.0 * band, 0.0, 0.0), balances(0.0, 2.0 * band, 0.0), balances(0.0, 0.0, 2.0 * band)] {
        assert!(!over.holds());
        assert_eq!(over.excluded_force_sum(), 0.0);
    }
    assert!(!balances(band, 0.0, 0.0).meets(ProofThreshold::STRICT));
    let moves = |power, worst_violation| Proof::Mechanism { power, worst_violation };
    assert!(moves(0.5, 5e-8).holds());
    assert!(!moves(0.5, 6e-8).holds());
    assert!(!moves(0.5, 5e-8).meets(ProofThreshold::STRICT));
    assert!(!moves(0.0, 0.0).holds() && !moves(-0.5, 0.0).holds());
    assert_eq!(moves(0.5, 0.25).excluded_force_sum(), 2.0);
    assert_eq!(moves(0.0, 0.0).excluded_force_sum(), 0.0);
    assert_eq!(moves(-0.5, 0.25).excluded_force_sum(), 0.0);
}
