//! [`crossings`]: finds the pairs of a polygon's sides that cross or touch. Neighbouring sides that meet only at their
//! common corner do not count, so a simple polygon has no crossings.
//!
//! Every pair of sides whose boxes intersect is tested with the exact predicate [`orientation`]. The answer therefore
//! does not depend on rounding; only the reported point is rounded. Reference: de Berg et al., Computational Geometry,
//! 2008, chapter 2, for the test of two segments.

use super::box_index::across_longest;
use super::edge::{Edge, orientation, ring_edges};
use super::{Aabb, BoxIndex, Point};

/// The largest number of crossings that are returned. More would only lengthen the message to the author of the scene.
const MAX_CROSSINGS: usize = 20;

/// The sides of a polygon with up to this many sides are tested pair by pair. In larger polygons, a [`BoxIndex`]
/// finds the candidates.
const MAX_SIDES_WITHOUT_INDEX: usize = 12;

/// Two sides with a common point that is not the common corner of neighbours.
pub(super) struct Crossing {
    /// The indices of the rings to which the two sides belong.
    pub rings: [usize; 2],
    /// The corners at which the two sides begin, counted from 0 within their rings.
    pub corners: [usize; 2],
    /// A common point of the two sides, rounded.
    pub at: Point,
}

/// A side of a polygon, with the index of its ring and its position in this ring.
#[derive(Clone, Copy)]
struct Side {
    ring: usize,
    /// The index of the corner at which the side begins, in its ring.
    corner: usize,
    /// The number of corners of the ring.
    ring_len: usize,
    edge: Edge,
}

impl Side {
    /// Returns a point that this side and a later side of the polygon share; `None` if they share none. Neighbouring
    /// sides always share a corner; for them, returns this corner only if one side folds back onto the other.
    fn forbidden_contact(&self, later: &Side) -> Option<Point> {
        let (a, b) = (self, later);
        // The sides are neighbours if `b` follows `a`, or if `a` is the first side of the ring and `b` the last.
        if (a.ring, a.corner + 1) == (b.ring, b.corner) {
            folds_back(a.edge.from, a.edge.to, b.edge.to)
        } else if a.ring == b.ring && a.corner == 0 && b.corner + 1 == b.ring_len {
            folds_back(b.edge.from, b.edge.to, a.edge.to)
        } else {
            intersection(a.edge, b.edge)
        }
    }
}

/// Returns the pairs of sides that cross or touch, sorted by the position of their sides in the polygon. At most
/// [`MAX_CROSSINGS`] pairs are returned.
pub(super) fn crossings(rings: &[Vec<Point>]) -> Vec<Crossing> {
    // List every side with its ring and its corner number.
    let mut sides: Vec<Side> = Vec::with_capacity(rings.iter().map(Vec::len).sum());
    for (ring, corners) in rings.iter().enumerate() {
        sides.extend(ring_edges(corners).enumerate().map(|(corner, edge)| Side {
            ring,
            corner,
            ring_len: corners.len(),
            edge,
        }));
    }
    let index = (sides.len() > MAX_SIDES_WITHOUT_INDEX).then(|| {
        let across = across_longest(sides.iter().map(|side| side.edge));
        let around = move |side: &Side| Aabb::with_direction(&[side.edge.from, side.edge.to], across);
        (BoxIndex::new(sides.clone(), around), around)
    });
    let mut found: Vec<Crossing> = Vec::new();
    for (number, a) in sides.iter().enumerate() {
        let before = found.len();
        let mut test = |b: &Side| {
            if let Some(at) = a.forbidden_contact(b) {
                found.push(Crossing { rings: [a.ring, b.ring], corners: [a.corner, b.corner], at });
            }
        };
        // Test each pair only once: skip the sides that come before `a` in the list.
        match &index {
            None => {
                let bounds = a.edge.bounds();
                (sides[number + 1..].iter()).filter(|b| bounds.intersects(&b.edge.bounds())).for_each(test);
            }
            Some((index, around)) => {
                let near = index.intersecting(around(a));
                near.filter(|b| (a.ring, a.corner) < (b.ring, b.corner)).for_each(&mut test);
            }
        }
        // The index returns candidates in no particular order. Sort the crossings, so that the result does not depend
        // on it.
        found[before..].sort_by_key(|crossing| (crossing.rings[1], crossing.corners[1]));
        if found.len() >= MAX_CROSSINGS {
            found.truncate(MAX_CROSSINGS);
            break;
        }
    }
    found
}

/// Returns the corner `b` if the path a → b → c runs back along itself at b; otherwise `None`.
fn folds_back(a: Point, b: Point, c: Point) -> Option<Point> {
    (orientation(a, b, c) == 0.0 && (a - b).dot(&(c - b)) > 0.0).then_some(b)
}

/// Returns a common point of two segments; `None` if they have no common point.
fn intersection(a: Edge, b: Edge) -> Option<Point> {
    let a_from = orientation(b.from, b.to, a.from);
    let a_to = orientation(b.from, b.to, a.to);
    let b_from = orientation(a.from, a.to, b.from);
    let b_to = orientation(a.from, a.to, b.to);
    // An end of one segment lies on the other segment if it is collinear with the other segment and between the two
    // ends of the other segment.
    let is_between = |e: Edge, p: Point| (p - e.from).dot(&(p - e.to)) <= 0.0;
    for (turn, edge, point) in [(a_from, b, a.from), (a_to, b, a.to), (b_from, a, b.from), (b_to, a, b.to)] {
        if turn == 0.0 && is_between(edge, point) {
            return Some(point);
        }
    }
    // A proper crossing: the ends of each segment lie on different sides of the line through the other segment. If an
    // end of `a` lies on the line through `b` but outside `b`, the test is false: both ends of `b` then lie on the same
    // side of the line through `a`.
    if (a_from > 0.0) != (a_to > 0.0) && (b_from > 0.0) != (b_to > 0.0) {
        let share = a_from / (a_from - a_to);
        return Some(a.from + a.vector() * share);
    }
    None
}
