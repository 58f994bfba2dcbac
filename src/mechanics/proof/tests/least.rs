//! Tests of the lower bound of the sum of forces that follows from a motion.

use super::*;

#[test]
fn a_motion_bounds_the_sum_of_forces_from_below() {
    let forces = Forces {
        contacts: vec![pressed(1.0, 2.0, -3.0)],
        grips: vec![GripForces { force: Vector::new(4.0, -5.0), torque: -6.0 }],
    };
    assert_near(forces.sum(2.0), 6.0 + 9.0 + 3.0, 1e-14);
    // The ground presses with at least the weight, however fast the box moves down.
    let mut alone = on_ground(LoadVector::ZERO);
    for speed in [1.0, 2.0] {
        let bound = force_sum_lower_bound(&alone, &[moving(0, 0.0, -speed, 0.0)]);
        assert_near(bound, 10.0, 1e-12);
    }
    // A motion with a speed below 1 is not scaled up, so the bound is smaller.
    assert_near(force_sum_lower_bound(&alone, &[moving(0, 0.0, -0.5, 0.0)]), 5.0, 1e-12);
    assert_eq!(force_sum_lower_bound(&alone, &[moving(0, 0.0, 1.0, 0.0)]), 0.0);
    // A second box hangs on a robot. The loads have a power of 10 + 4 · 6 = 34 W. Of the speed against the robot's
    // limit of 3 N, only the part above 1 counts.
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
    // The centroid of the box moves along x at −5 m/s. The grip, 1 m below it, moves at −7.5 m/s, because the box also
    // turns at −2.5 rad/s. The power of a torque is the torque times the angular velocity.
    both.grips = vec![grip(1, 3.0, 0.0, 0.0)];
    let turning = [moving(0, 0.0, -1.0, 0.0), moving(1, -5.0, -4.0, -2.5)];
    assert_near(force_sum_lower_bound(&both, &turning), 34.0 - 3.0 * (7.5 - 1.0), 1e-12);
    both.grips = vec![grip(1, 0.0, 0.0, 8.0)];
    assert_near(force_sum_lower_bound(&both, &turning), 34.0 - 8.0 / 2.0 * (2.5 * 2.0 - 1.0), 1e-12);
}

#[test]
fn every_rounding_error_is_subtracted_from_a_lower_bound() {
    const EPSILON: f64 = f64::EPSILON;
    // A box of 10 N moves down at 1 m/s, and another of 6 N, held by a robot, at 4 m/s: the loads have 34 W.
    let mut both = on_ground(LoadVector::ZERO);
    both.bodies.push(body(1, 3.0, 2.0, 6.0, LoadVector::ZERO));
    let mut both = both.with_summed_loads();
    let bound = |assembly: &Assembly, last: Motion| force_sum_lower_bound(assembly, &[moving(0, 0.0, -1.0, 0.0), last]);
    // Ten rounding errors of the power and eight of the speed are subtracted.
    both.grips = vec![grip(1, 0.0, f64::INFINITY, 0.0)];
    let found = bound(&both, moving(1, 0.0, -4.0, 0.0)) / (34.0 / 4.0);
    let less = 1.0 - found;
    assert!((14.0 * EPSILON..21.0 * EPSILON).contains(&less));
    // The centroid moves along x at −5 m/s, and the grip at −7.5 m/s, because the box also turns.
    both.grips = vec![grip(1, f64::INFINITY, 0.0, 0.0)];
    let found = bound(&both, moving(1, -5.0, -4.0, -2.5)) / (34.0 / 7.5);
    let less = 1.0 - found;
    assert!((18.0 * EPSILON..30.0 * EPSILON).contains(&less));
    // A robot's limit below 10⁴ times the moving loads of 8.5 N counts as a limit: the robot can absorb more power
    // than the loads have. A higher limit counts as unlimited.
    for (limit, expected) in [(5e4, 0.0), (9e4, 34.0 / 4.0)] {
        both.grips = vec![grip(1, 0.0, limit, 0.0)];
        let found = bound(&both, moving(1, 0.0, -4.0, 0.0));
        assert_near(found, expected, 1e-12);
    }
}
