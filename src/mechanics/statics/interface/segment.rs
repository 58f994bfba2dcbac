//! [`CommonSegment`]: the segment that two edges that face each other have in common, and the gap between them.
//! [`GapSegment`]: such a segment if the two edges do not touch. [`without_outline`] drops the segments whose gap only
//! follows from the rounded shape of an outline. It keeps the segments whose edges may have been meant to touch.

use super::join::JOIN_REACH;
use crate::geometry::{Edge, Point, Tolerance, Vector};
use crate::mechanics::scene::{Scene, ToleranceSource};

/// If a tolerance is given, a segment that covers this fraction of the shorter edge is a contact, however short the
/// edge.
///
/// If this fraction were ten times larger, it would be more than a whole edge. If it were ten times smaller, two bricks
/// that barely touch at their chamfers would have a contact.
const CONTACT_PER_EDGE: f64 = 0.5;

/// Edges shorter than this fraction of a given tolerance are not real edges: healing moved their two corners to one
/// point.
///
/// If it were ten times larger, the edges of a circle of 100 000 corners would be dropped; if it were ten times
/// smaller, it would be close to the rounding errors of the coordinates.
const MIN_EDGE_PER_TOLERANCE: f64 = 1e-6;

/// The segment that two edges of opposite direction both cover. Coordinates along the segment are measured along the
/// mean direction of the edges, from the start of the first edge.
pub(super) struct CommonSegment {
    a: Edge,
    b: Edge,
    /// The mean direction of the two edges, oriented like the first edge.
    along: Vector,
    /// The coordinate of the segment's start along the mean direction, metres.
    pub(super) start: f64,
    /// The coordinate of the segment's end along the mean direction, metres.
    pub(super) end: f64,
}

impl CommonSegment {
    /// Returns the common segment of the edges `a` and `b`, which run in opposite directions.
    pub(super) fn new(a: Edge, b: Edge) -> CommonSegment {
        let along = (a.vector() - b.vector()).normalize();
        let mut segment = CommonSegment { a, b, along, start: 0.0, end: 0.0 };
        segment.start = f64::max(0.0, segment.place(b.to));
        segment.end = f64::min(segment.place(a.to), segment.place(b.from));
        segment
    }

    /// Returns the length of the segment in metres; negative if the edges have no common segment.
    pub(super) fn length(&self) -> f64 {
        self.end - self.start
    }

    /// Returns the coordinate of a point along the segment, in metres from the start of the first edge.
    fn place(&self, p: Point) -> f64 {
        self.along.dot(&(p - self.a.from))
    }

    /// Returns the unit vector that is perpendicular to the segment and points out of the first body.
    fn outward(&self) -> Vector {
        Vector::new(self.along.y, -self.along.x)
    }

    /// Returns the signed distance, in metres, of the edge `e` at the coordinate `s` along the segment. The distance is
    /// measured from the line through the start of the first edge in the mean direction of both edges. It is positive
    /// outside the first body.
    fn height(&self, e: Edge, s: f64) -> f64 {
        let outward = self.outward();
        let (h0, h1) = (outward.dot(&(e.from - self.a.from)), outward.dot(&(e.to - self.a.from)));
        let (t0, t1) = (self.place(e.from), self.place(e.to));
        h0 + (h1 - h0) * ((s - t0) / (t1 - t0)).clamp(0.0, 1.0)
    }

    /// Returns the gap between the two edges at the coordinate `s`, in metres; negative if the bodies overlap there.
    fn gap(&self, s: f64) -> f64 {
        self.height(self.b, s) - self.height(self.a, s)
    }

    /// Returns the larger of the absolute gaps at the two ends of the segment, in metres. Overlaps are negative gaps.
    pub(super) fn distance(&self) -> f64 {
        self.gap(self.start).abs().max(self.gap(self.end).abs())
    }

    /// Returns the smaller of the gaps at the two ends of the segment, in metres; negative if the bodies overlap.
    pub(super) fn depth(&self) -> f64 {
        self.gap(self.start).min(self.gap(self.end))
    }

    /// Returns the point halfway between the two edges at the coordinate `s`.
    pub(super) fn middle(&self, s: f64) -> Point {
        let height = (self.height(self.a, s) + self.height(self.b, s)) / 2.0;
        self.a.from + self.along * s + self.outward() * height
    }

    /// Returns this segment as a [`GapSegment`], for edges that do not touch.
    pub(super) fn open(&self) -> GapSegment {
        let at = self.a.from + self.along * ((self.start + self.end) / 2.0);
        let ends = [self.start, self.end].map(|s| (self.middle(s), self.gap(s).abs()));
        GapSegment::new(ends, at)
    }
}

/// Returns the least common length, in metres, of two edges that form an interface. `edge` is the length of the shorter
/// edge in metres. If the scene gives a tolerance that is large compared with the edge, the result can be smaller than
/// [`Tolerance::min_contact_length`].
pub(super) fn min_contact_length(scene: &Scene, tolerance: Tolerance, edge: f64) -> f64 {
    let min_length = tolerance.min_contact_length(edge);
    let is_given = scene.healed.source == ToleranceSource::Given;
    if is_given && edge > MIN_EDGE_PER_TOLERANCE * tolerance.gap {
        // A given tolerance may be longer than the edges of a round stone. A segment that covers half of an edge is
        // then a contact.
        return min_length.min(CONTACT_PER_EDGE * edge);
    }
    min_length
}

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
