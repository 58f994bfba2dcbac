//! The lower bound of the sum of forces that a motion gives, to the last digits.

use super::*;

#[test]
fn every_rounding_error_is_subtracted_from_a_lower_bound() {
    const EPSILON: f64 = f64::EPSILON;
    // A box that moves down at 1, and another, held by a robot, at 4: 34 W.
    let mut both = on_ground(LoadVector::ZERO);
    both.bodies.push(body(1, 3.0, 2.0, 6.0, LoadVector::ZERO));
    let mut both = both.with_summed_loads();
    let bound = |assembly: &Assembly, last: Motion| {
        force_sum_lower_bound(assembly, &[moving(0, 0.0, -1.0, 0.0), last])
    };
    // Ten rounding errors of the power and eight of the speed are subtracted.
    both.grips = vec![grip(1, 0.0, f64::INFINITY, 0.0)];
    let found = bound(&both, moving(1, 0.0, -4.0, 0.0)) / (34.0 / 4.0);
    let less = 1.0 - found;
    assert!((14.0 * EPSILON..21.0 * EPSILON).contains(&less));
    // Along x the centroid moves by 5, and the grip by 2.5 more because the box turns.
    both.grips = vec![grip(1, f64::INFINITY, 0.0, 0.0)];
    let found = bound(&both, moving(1, -5.0, -4.0, -2.5)) / (34.0 / 7.5);
    let less = 1.0 - found;
    assert!((18.0 * EPSILON..30.0 * EPSILON).contains(&less));
    // A robot's limit below 10⁴ times the moving loads of 8.5 N counts as a limit: the robot can take more power than
    // there is. A higher limit counts as unlimited.
    for (limit, expected) in [(5e4, 0.0), (9e4, 34.0 / 4.0)] {
        both.grips = vec![grip(1, 0.0, limit, 0.0)];
        let found = bound(&both, moving(1, 0.0, -4.0, 0.0));
        assert_near(found, expected, 1e-12);
    }
}
