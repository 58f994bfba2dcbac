//! Tests of proofs against sums done by hand, for a box of 4 m by 3 m and a second box on it.

use super::*;
use crate::assembly::{AssemblyContact, AssemblyGrip};
use crate::scene::format::BlockEntry;
use crate::scene::{BodyId, Limits, RobotId};

mod balance;
mod least;

/// A box 4 m wide whose lower left corner is (0, `bottom`). With `bottom` 0 and a height of 3 m, its centroid is (2,
/// 1.5), and its farthest corner is 2.5 m away from the centroid.
fn body(number: usize, bottom: f64, height: f64, weight: f64, listed: LoadVector) -> AssemblyBody {
    let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, height), (0.0, height)];
    AssemblyBody {
        block: BlockId(number),
        centroid: Point::new(2.0, bottom + height / 2.0),
        corners: corners.map(|(x, y)| Point::new(x, bottom + y)).into(),
        weight,
        listed,
        load: LoadVector::ZERO,
    }
}

fn listed(x: f64, y: f64, moment: f64) -> LoadVector {
    LoadVector {
        force: Vector::new(x, y),
        moment,
    }
}

/// A level joint at this height, with application points at x = 3 and x = 1 and a friction coefficient of 0.5.
fn joint(on: usize, from: Option<usize>, height: f64) -> AssemblyContact {
    let at = |x: f64| Point::new(x, height);
    AssemblyContact {
        interface: on,
        bodies: [
            BodyId::Block(BlockId(on)),
            from.map_or(BodyId::Ground(0), |n| BodyId::Block(BlockId(n))),
        ],
        on,
        from,
        kind: ContactKind::Edge,
        ends: [at(4.0), at(0.0)],
        points: [at(3.0), at(1.0)],
        normal: Vector::new(0.0, 1.0),
        friction: 0.5,
    }
}

fn grip(body: usize, fx: f64, fy: f64, torque: f64) -> AssemblyGrip {
    AssemblyGrip {
        hold: 0,
        robot: RobotId(0),
        body,
        at: Point::new(0.0, 3.0),
        limits: Limits { fx, fy, torque },
    }
}

fn assembly(bodies: Vec<AssemblyBody>, contacts: Vec<AssemblyContact>) -> Assembly {
    Assembly {
        bodies,
        contacts,
        grips: Vec::new(),
        pull: Vector::new(0.0, -1.0),
        load_factor: 1.0,
        length: 2.0,
    }
    .with_summed_loads()
}

/// The box of 10 N on the ground, with a listed load.
fn on_ground(listed: LoadVector) -> Assembly {
    assembly(
        vec![body(0, 0.0, 3.0, 10.0, listed)],
        vec![joint(0, None, 0.0)],
    )
}

fn pressed(first: f64, second: f64, friction: f64) -> ContactForces {
    ContactForces {
        normal: [first, second],
        friction,
    }
}

fn moving(block: usize, x: f64, y: f64, spin: f64) -> Motion {
    Motion {
        block: BlockId(block),
        velocity: Vector::new(x, y),
        spin,
    }
}

/// Imbalance, share, pull and slip of forces.
fn found(assembly: &Assembly, contacts: Vec<ContactForces>, grips: Vec<GripForces>) -> [f64; 4] {
    match check_forces(assembly, &Forces { contacts, grips }) {
        Proof::Forces {
            worst_imbalance,
            worst_share,
            worst_pull,
            worst_slip,
        } => [worst_imbalance, worst_share, worst_pull, worst_slip],
        Proof::Mechanism { .. } => [f64::NAN; 4],
    }
}

/// Power and violation of a motion.
fn driven(assembly: &Assembly, motions: &[Motion]) -> [f64; 2] {
    match check_mechanism(assembly, motions) {
        Proof::Mechanism {
            power,
            worst_violation,
        } => [power, worst_violation],
        Proof::Forces { .. } => [f64::NAN; 2],
    }
}

fn assert_near(found: f64, expected: f64, within: f64) {
    assert!(
        (found - expected).abs() <= within,
        "{found}, not {expected}"
    );
}

#[test]
fn forces_in_exact_balance_have_no_imbalance() {
    // A push of 1 N at the middle of the upper box is resisted by friction in both joints. About the lower centroid
    // each of the two friction forces has a moment of −1.5 N·m, so the ground presses 3 N more at its right point, 1
    // m from the middle, than at its left point. The uneven pressure of the upper joint adds 1 N to this difference.
    let two = assembly(
        vec![
            body(0, 0.0, 3.0, 10.0, LoadVector::ZERO),
            body(1, 3.0, 2.0, 6.0, listed(1.0, 0.0, 0.0)),
        ],
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
    let gives = GripForces {
        force: Vector::new(-2.0, -4.0),
        torque: 4.0 - 3.0 - 8.0,
    };
    let all = found(&held, vec![pressed(5.0, 5.0, 0.0)], vec![gives]);
    assert_eq!(all, [0.0; 4]);
}

#[test]
fn imbalance_is_the_share_by_which_forces_must_change_or_move() {
    let box_alone = on_ground(LoadVector::ZERO);
    assert_eq!(
        found(&box_alone, vec![pressed(5.0, 5.0, 0.0)], vec![]),
        [0.0; 4]
    );
    // The joint gives 1 N too much: 1 N relative to 11 N of the joint and 10 N of weight.
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
    let each = imbalances(
        &two,
        &Forces {
            contacts: contacts.clone(),
            grips: vec![],
        },
    );
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
fn pulls_slips_and_limits_are_shares_of_their_own_forces() {
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
    for (force, torque, over) in [
        ((3.0, 4.0), 5.0, 0.0),
        ((-4.0, 0.0), 0.0, 0.25),
        ((0.0, 8.0), 0.0, 0.5),
        ((0.0, 0.0), -20.0, 0.75),
    ] {
        held.grips = vec![grip(0, 3.0, 4.0, 5.0)];
        let gives = GripForces {
            force: Vector::new(force.0, force.1),
            torque,
        };
        let slip = found(&held, vec![pressed(5.0, 5.0, 0.0)], vec![gives])[3];
        assert_near(slip, over, 1e-15);
    }
}

#[test]
fn a_sliding_box_does_work_against_the_friction_it_has() {
    let pushed = on_ground(listed(7.0, 0.0, 0.0));
    // Of a reaction with N + |T| = 1, friction is at most 0.5/1.5. The loads are 10 N and 7 N. Twice the speed is the
    // same motion.
    for speed in [1.0, 2.0] {
        let [power, violation] = driven(&pushed, &[moving(0, speed, 0.0, 0.0)]);
        assert_near(power, 7.0 / 17.0, 1e-14);
        assert_near(violation, 1.0 / 3.0, 1e-14);
        let rules_out =
            check_mechanism(&pushed, &[moving(0, speed, 0.0, 0.0)]).excluded_force_sum();
        assert_near(rules_out, 21.0 / 17.0, 1e-13);
    }
    // The box moves down by 1 and along by 3. Pressing resists with 1, and with full friction (1.5 + 1)/1.5.
    let [_, violation] = driven(&pushed, &[moving(0, 3.0, -1.0, 0.0)]);
    assert_near(violation, 2.5 / 1.5 / libm::sqrt(10.0), 1e-14);
    // Without friction no force resists the slide: the motion rules out every balance.
    let smooth = pushed.with_friction(0.0);
    let slides = check_mechanism(&smooth, &[moving(0, 1.0, 0.0, 0.0)]);
    assert_eq!(slides.excluded_force_sum(), f64::INFINITY);
    assert!(slides.meets(ProofThreshold::STRICT));
}

#[test]
fn a_turning_box_opens_its_joint_or_presses_it() {
    // The box turns about its lower left corner: the centroid moves up by 2 and left by 1.5, the farthest corner by
    // 5.
    let twisted = on_ground(listed(0.0, 0.0, 45.0));
    let [power, violation] = driven(&twisted, &[moving(0, -1.5, 2.0, 1.0)]);
    assert_near(power, (45.0 - 20.0) / (28.0 * 5.0), 1e-14);
    assert_eq!(violation, 0.0);
    let [power, violation] = driven(&twisted, &[moving(0, 1.5, -2.0, -1.0)]);
    assert_near(power, -25.0 / 140.0, 1e-14);
    assert_near(violation, 3.0 / 5.0, 1e-14);
}

#[test]
fn between_two_blocks_only_the_relative_motion_counts() {
    let two = assembly(
        vec![
            body(0, 0.0, 3.0, 10.0, LoadVector::ZERO),
            body(1, 3.0, 2.0, 6.0, listed(1.0, 0.0, 0.0)),
        ],
        vec![joint(0, None, 0.0), joint(1, Some(0), 3.0)],
    )
    .with_friction(0.0);
    // Both boxes rise together, and the joint on the ground opens.
    let together = [moving(0, 0.0, 2.0, 0.0), moving(1, 0.0, 2.0, 0.0)];
    let [_, violation] = driven(&two, &together);
    assert!(
        violation > 0.0 && violation < 1e-14,
        "only the rounding errors of both velocities: {violation}"
    );
    // The lower box rises into the upper box, which rises half as fast.
    let into = [moving(0, 0.0, 2.0, 0.0), moving(1, 0.0, 1.0, 0.0)];
    assert_near(driven(&two, &into)[1], 0.5, 1e-14);
    // The loads of the moving boxes: 10 N at full speed, 7 N at half speed.
    assert_near(moving_load(&two, &into), 13.5, 1e-14);
    let still = [moving(0, 0.0, 0.0, 0.0), moving(1, 0.0, 0.0, 0.0)];
    assert_eq!(moving_load(&two, &still), 0.0);
    assert_eq!(driven(&two, &still), [0.0, 0.0]);
}

#[test]
fn a_limited_grip_costs_power_and_an_unlimited_grip_is_violated() {
    // The velocity of the grip point is (3 − 0.75, −1 − 1): the box turns at 0.5 rad/s, and its centroid lies 2 m to
    // the right of the grip and 1.5 m below it.
    let motion = [moving(0, 3.0, -1.0, 0.5)];
    let mut held = on_ground(listed(7.0, 0.0, 0.0)).with_friction(0.0);
    held.contacts.clear();
    let fastest = held.bodies[0]
        .corners
        .iter()
        .map(|p| motion[0].about(held.bodies[0].centroid, *p).norm())
        .fold(0.0, f64::max);
    let load = 17.0 * fastest;
    for (limits, taken, violation) in [
        ((0.0, 0.0, 0.0), 0.0, 0.0),
        ((2.0, 0.0, 0.0), 2.0 * 2.25, 0.0),
        ((0.0, 3.0, 0.0), 3.0 * 2.0, 0.0),
        // A torque acts against the angular velocity: L has no influence.
        ((0.0, 0.0, 4.0), 4.0 * 0.5, 0.0),
        ((f64::INFINITY, 0.0, 0.0), 0.0, 2.25),
        ((0.0, f64::INFINITY, 0.0), 0.0, 2.0),
        // An unlimited torque counts with the speed 0.5 · 2, because L = 2 m.
        ((0.0, 0.0, f64::INFINITY), 0.0, 1.0),
        ((2e5, 0.0, 0.0), 0.0, 2.25),
        ((1e5, 0.0, 0.0), 2.25e5, 0.0),
    ] {
        held.grips = vec![grip(0, limits.0, limits.1, limits.2)];
        let [power, objects] = driven(&held, &motion);
        assert_near(
            power,
            (7.0 * 3.0 + 10.0 - taken) / load,
            1e-12 * (1.0 + taken),
        );
        assert_near(objects, violation / fastest, 1e-13);
    }
}

/// The possible rounding error of a sum counts against the motion, and no more than that.
#[test]
fn rounding_counts_against_a_motion_by_its_own_size() {
    // A force of 10⁸ N that moves at 10⁻⁸ m/s gives 1 W, to 15 digits.
    let mut heavy = on_ground(listed(1e8, 0.0, 0.0)).with_friction(0.0);
    let [power, violation] = driven(&heavy, &[moving(0, 1e-8, 0.0, 0.0)]);
    assert_near(power, 1e8 / (1e8 + 10.0), 1e-13);
    assert_eq!(violation, 0.0);
    // Two velocities of the grip point cancel. Their rounding error counts as a motion against the limit of 10³ N.
    heavy.contacts.clear();
    heavy.bodies[0].listed = listed(1.0, 0.0, 0.0);
    heavy = heavy.with_summed_loads();
    let motion = [moving(0, 3.0, 4.0, 2.0)];
    let exact = {
        heavy.grips = vec![grip(0, 0.0, 0.0, 0.0)];
        driven(&heavy, &motion)[0]
    };
    heavy.grips = vec![grip(0, 1e3, 0.0, 0.0)];
    let [less, _] = driven(&heavy, &motion);
    assert!(less < exact - 1e-14, "{less} {exact}");
    assert_near(less, exact, 1e-10);
    heavy.grips = vec![grip(0, f64::INFINITY, 0.0, 0.0)];
    let [_, objects] = driven(&heavy, &motion);
    assert!(objects > 0.0 && objects < 1e-13, "{objects}");
}

/// Checked to the last digits: a motion is trusted only for the power that is left after all rounding errors are
/// subtracted.
#[test]
fn every_sum_of_a_motion_allows_for_the_largest_rounding_error() {
    const EPSILON: f64 = f64::EPSILON;
    // 1 W from the force and 1 W from the moment: nine rounding errors of 2 W are subtracted.
    let mut alone = on_ground(listed(1.0, 0.0, 1.0));
    alone.contacts.clear();
    alone.bodies[0].weight = 0.0;
    alone = alone.with_summed_loads();
    let motion = [moving(0, 1.0, 0.0, 1.0)];
    let watts = |assembly: &Assembly, motion: &[Motion]| {
        let unit = moving_load(assembly, motion) * fastest(&assembly.bodies[0], &motion[0]);
        driven(assembly, motion)[0] * unit
    };
    let found = watts(&alone, &motion);
    assert!(found <= 2.0 - 12.0 * EPSILON && found > 2.0 - 1e-13);
    // A moment of 10⁸ N·m that turns at 10⁻⁸ rad/s gives 1 W to as many digits.
    alone.bodies[0].listed = listed(0.0, 0.0, 1e8);
    alone = alone.with_summed_loads();
    assert_near(watts(&alone, &[moving(0, 0.0, 0.0, 1e-8)]), 1.0, 1e-13);
    // A robot that takes 1 W: eight rounding errors of its speed are subtracted, and nine of the sum.
    let mut held = on_ground(listed(0.0, 0.0, 1.0));
    held.contacts.clear();
    held.bodies[0].weight = 0.0;
    held = held.with_summed_loads();
    held.grips = vec![grip(0, 1.0, 0.0, 0.0)];
    let found = watts(&held, &[moving(0, 1.0, 0.0, 0.0)]);
    assert!(found <= -1.0 - 12.0 * EPSILON && found > -1.0 - 1e-13);
    held.grips = vec![grip(0, 1e3, 0.0, 0.0)];
    let found = watts(&held, &[moving(0, 1e-3, 0.0, 0.0)]);
    assert_near(found, -1.0, 1e-14);
    // A slide along a level joint: the speed against which friction acts may be off by eight rounding errors of
    // itself.
    let slides = driven(&on_ground(LoadVector::ZERO), &[moving(0, 1.0, 0.0, 0.0)]);
    assert!(slides[1] >= 1.0 / 3.0 + 3.0 * EPSILON && slides[1] < 1.0 / 3.0 + 1e-14);
    // The motion of a weightless block proves nothing.
    let mut weightless = on_ground(LoadVector::ZERO);
    weightless.bodies[0].weight = 0.0;
    let still = driven(&weightless.with_summed_loads(), &[moving(0, 1.0, 1.0, 0.0)]);
    assert_eq!(still, [0.0, 0.0]);
}

#[test]
fn a_motion_bounds_the_sum_of_forces_from_below() {
    let forces = Forces {
        contacts: vec![pressed(1.0, 2.0, -3.0)],
        grips: vec![GripForces {
            force: Vector::new(4.0, -5.0),
            torque: -6.0,
        }],
    };
    assert_near(forces.sum(2.0), 6.0 + 9.0 + 3.0, 1e-14);
    // The ground presses with at least the weight, however fast the box moves down.
    let mut alone = on_ground(LoadVector::ZERO);
    for speed in [1.0, 2.0] {
        let bound = force_sum_lower_bound(&alone, &[moving(0, 0.0, -speed, 0.0)]);
        assert_near(bound, 10.0, 1e-12);
    }
    // At a speed below 1, a unit of force costs more than the motion gives, so the bound is smaller.
    assert_near(
        force_sum_lower_bound(&alone, &[moving(0, 0.0, -0.5, 0.0)]),
        5.0,
        1e-12,
    );
    assert_eq!(
        force_sum_lower_bound(&alone, &[moving(0, 0.0, 1.0, 0.0)]),
        0.0
    );
    // A second box hangs on a robot: 10 + 4 · 6 W. Of the speed against the robot's limit of 3 N, only the part above
    // 1 counts.
    alone.bodies.push(body(1, 3.0, 2.0, 6.0, LoadVector::ZERO));
    let mut both = alone.with_summed_loads();
    let motions = [moving(0, 0.0, -1.0, 0.0), moving(1, 0.0, -4.0, 0.0)];
    for (limits, bound) in [
        ((0.0, 3.0, 0.0), 34.0 - 3.0 * 3.0),
        ((0.0, 0.0, 0.0), 34.0),
        ((0.0, f64::INFINITY, 0.0), 34.0 / 4.0),
        // Forces of the robot that are perpendicular to the motion have no influence.
        ((f64::INFINITY, 0.0, f64::INFINITY), 34.0),
    ] {
        both.grips = vec![grip(1, limits.0, limits.1, limits.2)];
        assert_near(force_sum_lower_bound(&both, &motions), bound, 1e-12);
    }
    // Along x the centroid moves by −5. The grip, 1 m below it, moves by −2.5 more because the box turns. A torque
    // counts with the angular velocity.
    both.grips = vec![grip(1, 3.0, 0.0, 0.0)];
    let turning = [moving(0, 0.0, -1.0, 0.0), moving(1, -5.0, -4.0, -2.5)];
    assert_near(
        force_sum_lower_bound(&both, &turning),
        34.0 - 3.0 * (7.5 - 1.0),
        1e-12,
    );
    both.grips = vec![grip(1, 0.0, 0.0, 8.0)];
    assert_near(
        force_sum_lower_bound(&both, &turning),
        34.0 - 8.0 / 2.0 * (2.5 * 2.0 - 1.0),
        1e-12,
    );
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
    for over in [
        balances(2.0 * band, 0.0, 0.0),
        balances(0.0, 2.0 * band, 0.0),
        balances(0.0, 0.0, 2.0 * band),
    ] {
        assert!(!over.holds());
        assert_eq!(over.excluded_force_sum(), 0.0);
    }
    assert!(!balances(band, 0.0, 0.0).meets(ProofThreshold::STRICT));
    let moves = |power, worst_violation| Proof::Mechanism {
        power,
        worst_violation,
    };
    assert!(moves(0.5, 5e-8).holds());
    assert!(!moves(0.5, 6e-8).holds());
    assert!(!moves(0.5, 5e-8).meets(ProofThreshold::STRICT));
    assert!(!moves(0.0, 0.0).holds() && !moves(-0.5, 0.0).holds());
    assert_eq!(moves(0.5, 0.25).excluded_force_sum(), 2.0);
    assert_eq!(moves(0.0, 0.0).excluded_force_sum(), 0.0);
    assert_eq!(moves(-0.5, 0.25).excluded_force_sum(), 0.0);
}

#[test]
fn points_of_a_body_move_with_it() {
    let motion = moving(0, 3.0, -1.0, 0.5);
    let centroid = Point::new(2.0, 1.5);
    let at = motion.about(centroid, Point::new(0.0, 3.0));
    assert_eq!(at, Vector::new(2.25, -2.0));
    let (near, far) = (Point::new(2.0, 1.5), Point::new(4.0, 1.5));
    assert_eq!(motion.fastest_of(centroid, &[far, near]), libm::sqrt(10.0));
    let scene = Scene::builder()
        .ground([[-1.0, -1.0], [5.0, -1.0], [5.0, 0.0], [-1.0, 0.0]])
        .block(BlockEntry::new("a").polygon([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]))
        .build()
        .expect("a sound scene");
    let at = motion.at(&scene, Point::new(0.0, 3.0));
    assert_near((at - Vector::new(2.25, -2.0)).norm(), 0.0, 1e-12);
    // The lower left corner moves by 3 + 0.75 and by −1 − 1. No other corner is faster.
    assert_near(motion.fastest(&scene), 4.25, 1e-12);
}
