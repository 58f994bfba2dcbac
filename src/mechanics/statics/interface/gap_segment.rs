//! [`GapSegment`]: a segment along which the edges of two bodies face each other without touching.
//!
//! [`without_outline`] drops the segments whose gap only follows from the rounded shape of an outline. It keeps the
//! segments whose edges may have been meant to touch.

use crate::geometry::{Point, Tolerance};

use super::join::JOIN_REACH;

/// A segment belongs to the outline if it begins near a contact: within this multiple of its widest gap.
///
/// Edges that rise by less than one in a hundred face the other body themselves. If this value were ten times smaller,
/// shallow steps of round stones would be missed; if it were ten times larger, the hollow between two supports of one
/// body would be included.
const OUTLINE_REACH_PER_GAP: f64 = 50.0;

/// A segment along which two edges face each other and do not touch.
pub(super) struct GapSegment {
    /// The end with the smaller gap, and that gap in metres.
    narrow: (Point, f64),
    /// The other end, and its gap in metres.
    wide: (Point, f64),
    /// The middle of the segment on the first edge.
    pub(super) at: Point,
}

impl GapSegment {
    /// Creates a segment from its two ends, each with its gap in metres, and from its middle point `at`.
    pub(super) fn new(ends: [(Point, f64); 2], at: Point) -> GapSegment {
        let [a, b] = ends;
        let (narrow, wide) = if a.1 <= b.1 { (a, b) } else { (b, a) };
        GapSegment { narrow, wide, at }
    }

    /// Returns the widest gap along the segment, in metres.
    pub(super) fn distance(&self) -> f64 {
        self.wide.1
    }

    fn length(&self) -> f64 {
        (self.wide.0 - self.narrow.0).norm()
    }
}

/// Drops the gaps between two bodies that only follow from the shape of a rounded outline. Returns the gaps between
/// edges that may have been meant to touch.
///
/// Two bodies that touch cannot be moved towards each other. A round stone that touches the ground is near it on both
/// sides, because its outline turns there: no tolerance can close this gap without bending the outline. These steps
/// follow the outline:
///
/// 1. Begin at the points where the bodies touch: at the ends of their contacts, or at the one corner on which a body
///    stands. A body on two corners with a hollow between them may have been meant to lie flat.
/// 2. Drop every gap whose narrow end is near such a point, and continue from its wide end.
///
/// Three kinds of gaps are kept. The first is at most as wide as the rounding of coordinates (`misfit`, metres), which
/// can make a straight edge look bent. The second is longer than `longest` metres: a body that is drawn askew along its
/// whole side may have been meant to lie flat. The third lies away from the points where the bodies touch.
pub(super) fn without_outline(
    mut segments: Vec<GapSegment>,
    touching: Vec<Point>,
    tolerance: Tolerance,
    misfit: f64,
    longest: f64,
) -> Vec<GapSegment> {
    let mut reached = touching;
    let mut next = 0;
    while let Some(from) = reached.get(next).copied() {
        next += 1;
        segments.retain(|segment| {
            let reach = JOIN_REACH * tolerance.gap + OUTLINE_REACH_PER_GAP * segment.distance();
            let is_outline =
                segment.distance() > misfit && segment.length() <= longest && (segment.narrow.0 - from).norm() <= reach;
            if is_outline {
                reached.push(segment.wide.0);
            }
            !is_outline
        });
    }
    segments
}
