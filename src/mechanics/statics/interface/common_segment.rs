//! [`CommonSegment`]: the segment that two edges that face each other have in common, and the gap between them.

use super::gap_segment::GapSegment;
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
