//! [`OpenStretch`]: a stretch along which two bodies face each other without touching.
//!
//! [`without_outline`] drops the stretches that belong to the shape of an outline. It keeps those that may have been
//! meant to touch.

use crate::geometry::{Point, Tolerance};

use super::join::JOIN_REACH;

/// A stretch belongs to the outline if it begins near a contact: within this multiple of its widest gap.
///
/// Edges that rise by less than one in a hundred face the other body themselves. A tenth would miss shallow steps of
/// round stones; ten times this value would include the hollow between two supports of one body.
const OUTLINE_REACH_PER_GAP: f64 = 50.0;

/// A stretch along which two edges face each other and do not touch.
pub(super) struct OpenStretch {
    /// The end with the smaller gap, and that gap in metres.
    narrow: (Point, f64),
    /// The other end, and its gap in metres.
    wide: (Point, f64),
    /// The middle of the stretch on the first edge.
    pub(super) at: Point,
}

impl OpenStretch {
    /// Creates a stretch from its two ends, each with its gap in metres, and from its middle point `at`.
    pub(super) fn new(ends: [(Point, f64); 2], at: Point) -> OpenStretch {
        let [a, b] = ends;
        let (narrow, wide) = if a.1 <= b.1 { (a, b) } else { (b, a) };
        OpenStretch { narrow, wide, at }
    }

    /// Returns the widest gap along the stretch, in metres.
    pub(super) fn distance(&self) -> f64 {
        self.wide.1
    }

    fn length(&self) -> f64 {
        (self.wide.0 - self.narrow.0).norm()
    }
}

/// Drops the open stretches of two bodies that only follow from the shape of an outline.
///
/// Two bodies that touch cannot be moved towards each other. A round stone that touches the ground is near it on both
/// sides, because its outline turns there: no tolerance closes that without bending the outline. These steps follow the
/// outline:
///
/// 1. Begin at the points where the bodies touch: at the ends of their contacts, or at the one corner on which a body
///    stands. A body on two corners with a hollow between them may have been meant to lie flat.
/// 2. Drop every stretch that is narrowest there, and continue from its wide end.
///
/// Three kinds of stretches are kept. The first is at most as wide as the rounding of coordinates (`misfit`, metres),
/// which can make a straight edge look bent. The second is longer than `longest` metres: a body that is drawn askew
/// along its whole side may have been meant to lie flat. The third lies away from the points where the bodies touch.
pub(super) fn without_outline(
    mut stretches: Vec<OpenStretch>,
    touching: Vec<Point>,
    tolerance: Tolerance,
    misfit: f64,
    longest: f64,
) -> Vec<OpenStretch> {
    let mut reached = touching;
    let mut next = 0;
    while let Some(from) = reached.get(next).copied() {
        next += 1;
        stretches.retain(|stretch| {
            let reach = JOIN_REACH * tolerance.gap + OUTLINE_REACH_PER_GAP * stretch.distance();
            let is_outline = stretch.distance() > misfit
                && stretch.length() <= longest
                && (stretch.narrow.0 - from).norm() <= reach;
            if is_outline {
                reached.push(stretch.wide.0);
            }
            !is_outline
        });
    }
    stretches
}
