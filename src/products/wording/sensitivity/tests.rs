//! Tests of the sentences about the sensitivity of a margin.

use super::*;

#[test]
fn both_ends_of_a_tilt_can_be_on_the_same_side() {
    assert_eq!(value(MarginKind::Tilt, -3.113), "3.11° left");
    assert_eq!(value(MarginKind::Tilt, 3.32), "3.32° right");
    assert_eq!(value(MarginKind::HorizontalLoad, -0.5), "0.500 left");
    assert_eq!(value(MarginKind::Kernel, 0.25), "0.250");
    assert_eq!(end_name(MarginKind::Tilt, true), "right");
    assert_eq!(end_name(MarginKind::Friction, false), "lower");
}
