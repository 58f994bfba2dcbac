//! Tests of the sentences about the sensitivity of a margin.

use super::*;

#[test]
fn both_ends_of_a_tilt_can_be_on_the_same_side() {
    assert_eq!(value(MarginKind::Tilt, -3.118, false), "3.11° left");
    assert_eq!(value(MarginKind::Tilt, 3.328, true), "3.32° right");
    assert_eq!(value(MarginKind::HorizontalLoad, -0.5, false), "0.5 left");
    assert_eq!(value(MarginKind::Kernel, 0.25, true), "0.25");
    assert_eq!(end_name(MarginKind::Tilt, true), "right");
    assert_eq!(end_name(MarginKind::Friction, false), "lower");
}
