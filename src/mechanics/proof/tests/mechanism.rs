//! Tests of proofs by a motion: its power, its violation of contacts and grips, and their rounding errors.

use super::*;
use crate::mechanics::scene::format::BlockEntry;

/// Returns the power and the violation of a motion.
fn driven(assembly: &Assembly, motions: &[Motion]) -> [f64; 2] {
    match check_mechanism(assembly, motions) {
        Proof::Mechanism { power, worst_violation } => [power, worst_violation],
        Proof::Forces { .. } => [f64::NAN; 2],
    }
}

#[test]
fn a_slide_violates_a_contact_only_if_it_has_friction() {
    let pushed = on_ground(listed(7.0, 0.0, 0.0));
    // Of a reaction with N + |T| = 1, friction is at most 0.5/1.5. The loads are 10 N and 7 N. Twice the speed is the
    // same motion.
    for speed in [1.0, 2.0] {
        let [power, violation] = driven(&pushed, &[moving(0, speed, 0.0, 0.0)]);
        assert_near(power, 7.0 / 17.0, 1e-14);
        assert_near(violation, 1.0 / 3.0, 1e-14);
        let rules_out = check_mechanism(&pushed, &[moving(0, speed, 0.0, 0.0)]).excluded_force_sum();
        assert_near(rules_out, 21.0 / 17.0, 1e-13);
    }
    // The box moves down by 1 and along by 3. Pressing resists with 1, and with full friction (1.5 + 1)/1.5.
    let [_, violation] = driven(&pushed, &[moving(0, 3.0, -1.0, 0.0)]);
    assert_near(violation, 2.5 / 1.5 / libm::sqrt(10.0), 1e-14);
    // Without friction no force resists the slide, so the motion rules out every balance.
    let smooth = pushed.with_friction(0.0);
    let slides = check_mechanism(&smooth, &[moving(0, 1.0, 0.0, 0.0)]);
    assert_eq!(slides.excluded_force_sum(), f64::INFINITY);
    assert!(slides.meets(ProofThreshold::STRICT));
}

#[test]
fn a_turning_box_violates_its_joint_only_if_it_closes_it() {
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
        vec![body(0, 0.0, 3.0, 10.0, LoadVector::ZERO), body(1, 3.0, 2.0, 6.0, listed(1.0, 0.0, 0.0))],
        vec![joint(0, None, 0.0), joint(1, Some(0), 3.0)],
    )
    .with_friction(0.0);
    // Both boxes rise together, and the joint on the ground opens.
    let together = [moving(0, 0.0, 2.0, 0.0), moving(1, 0.0, 2.0, 0.0)];
    let [_, violation] = driven(&two, &together);
    assert!(violation > 0.0 && violation < 1e-14, "only the rounding errors of both velocities: {violation}");
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
    let fastest =
        held.bodies[0].corners.iter().map(|p| motion[0].about(held.bodies[0].centroid, *p).norm()).fold(0.0, f64::max);
    let load = 17.0 * fastest;
    for (limits, absorbed, expected) in [
        ((0.0, 0.0, 0.0), 0.0, 0.0),
        ((2.0, 0.0, 0.0), 2.0 * 2.25, 0.0),
        ((0.0, 3.0, 0.0), 3.0 * 2.0, 0.0),
        // A torque acts against the angular velocity: L has no influence.
        ((0.0, 0.0, 4.0), 4.0 * 0.5, 0.0),
        ((f64::INFINITY, 0.0, 0.0), 0.0, 2.25),
        ((0.0, f64::INFINITY, 0.0), 0.0, 2.0),
        // The block turns at 0.5 rad/s. An unlimited torque counts with this speed times L = 2 m.
        ((0.0, 0.0, f64::INFINITY), 0.0, 1.0),
        ((2e5, 0.0, 0.0), 0.0, 2.25),
        ((1e5, 0.0, 0.0), 2.25e5, 0.0),
    ] {
        held.grips = vec![grip(0, limits.0, limits.1, limits.2)];
        let [power, violation] = driven(&held, &motion);
        assert_near(power, (7.0 * 3.0 + 10.0 - absorbed) / load, 1e-12 * (1.0 + absorbed));
        assert_near(violation, expected / fastest, 1e-13);
    }
}

/// The largest possible rounding error of each sum counts against the motion, but not more.
#[test]
fn the_rounding_error_of_each_sum_counts_against_a_motion() {
    // A force of 10⁸ N that moves at 10⁻⁸ m/s has a power of 1 W, accurate to 13 digits.
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
    let [_, violation] = driven(&heavy, &motion);
    assert!(violation > 0.0 && violation < 1e-13, "{violation}");
}

/// The proved power is what remains after all possible rounding errors are subtracted. It is checked to the last
/// digits.
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
    // A moment of 10⁸ N·m that turns at 10⁻⁸ rad/s has a power of 1 W, accurate to 13 digits.
    alone.bodies[0].listed = listed(0.0, 0.0, 1e8);
    alone = alone.with_summed_loads();
    assert_near(watts(&alone, &[moving(0, 0.0, 0.0, 1e-8)]), 1.0, 1e-13);
    // A robot that absorbs 1 W: eight rounding errors of its speed are subtracted, and nine of the sum.
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
    // itself, 8/3 ε. A friction of 10⁶ does not enlarge the error, because it does not enlarge the speed.
    let slides = driven(&on_ground(LoadVector::ZERO), &[moving(0, 1.0, 0.0, 0.0)]);
    assert!(slides[1] >= 1.0 / 3.0 + 2.5 * EPSILON && slides[1] < 1.0 / 3.0 + 1e-14);
    let slides = driven(&on_ground(LoadVector::ZERO).with_friction(1e6), &[moving(0, 1.0, 0.0, 0.0)]);
    let exact = 1e6 / (1e6 + 1.0);
    assert!(slides[1] >= exact + 7.0 * EPSILON && slides[1] < exact + 1e-14);
    // The motion of a weightless block proves nothing.
    let mut weightless = on_ground(LoadVector::ZERO);
    weightless.bodies[0].weight = 0.0;
    let still = driven(&weightless.with_summed_loads(), &[moving(0, 1.0, 1.0, 0.0)]);
    assert_eq!(still, [0.0, 0.0]);
}

#[test]
fn velocities_of_points_follow_from_the_motion_of_their_body() {
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
        .expect("the scene is valid");
    let at = motion.at(&scene, Point::new(0.0, 3.0));
    assert_near((at - Vector::new(2.25, -2.0)).norm(), 0.0, 1e-12);
    // The lower left corner moves by 3 + 0.75 and by −1 − 1. No other corner is faster.
    assert_near(motion.fastest(&scene), 4.25, 1e-12);
}
