//! What a motion says of the least sum of forces, to the last digits.

use super::*;

#[test]
fn a_bound_from_below_has_every_rounding_taken_off() {
    const EPSILON: f64 = f64::EPSILON;
    // A box let down at 1, another that hangs on a robot at 4: 34 W.
    let mut both = on_ground(LoadVector::ZERO);
    both.bodies.push(body(1, 3.0, 2.0, 6.0, LoadVector::ZERO));
    let mut both = both.with_summed_loads();
    let bound = |assembly: &Assembly, last: Motion| {
        force_sum_lower_bound(assembly, &[moving(0, 0.0, -1.0, 0.0), last])
    };
    // Ten roundings of the power, eight of the speed.
    both.grips = vec![grip(1, 0.0, f64::INFINITY, 0.0)];
    let found = bound(&both, moving(1, 0.0, -4.0, 0.0)) / (34.0 / 4.0);
    let less = 1.0 - found;
    assert!((14.0 * EPSILON..21.0 * EPSILON).contains(&less));
    // Along x the grip goes by 5 and by 2.5 more for the turning.
    both.grips = vec![grip(1, f64::INFINITY, 0.0, 0.0)];
    let found = bound(&both, moving(1, -5.0, -4.0, -2.5)) / (34.0 / 7.5);
    let less = 1.0 - found;
    assert!((18.0 * EPSILON..30.0 * EPSILON).contains(&less));
    // A limit of less than 10⁴ times the 8.5 N that move is one, and takes more power than there is.
    for (limit, expected) in [(5e4, 0.0), (9e4, 34.0 / 4.0)] {
        both.grips = vec![grip(1, 0.0, limit, 0.0)];
        let found = bound(&both, moving(1, 0.0, -4.0, 0.0));
        assert_near(found, expected, 1e-12);
    }
}
