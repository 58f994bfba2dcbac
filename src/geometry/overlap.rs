//! [`overlap`]: computes the area, the centroid and the depth of the intersection of two polygons.
//!
//! Each polygon is cut into convex pieces by ear clipping, or into trapezoids if it has very many corners. Two convex
//! pieces are disjoint if a side of one of them separates them. Otherwise their depth is the smallest distance by which
//! one piece must move, perpendicular to a side, until it leaves the other (separating-axis test). The area comes from
//! clipping one piece by the other (Sutherland and Hodgman 1974). References: Ericson, Real-Time Collision Detection,
//! 2005, §4.4 and §5.2; Held, FIST, 2001, for ear clipping.
//!
//! Invariant: polygons that only touch do not overlap. An overlap of up to `gap` metres in depth counts as touching.
//! Depth is a distance along a side's normal, so it does not depend on where the scene lies.

use std::borrow::Cow;
use std::ops::{Add, Sub};
use std::sync::OnceLock;

use super::box_index::across_longest;
use super::edge::{orientation, ring_edges};
use super::{Aabb, Bounds, BoxIndex, Point, Polygon, Vector, convex_hull, cross, quarter_turn};

/// A polygon that is cut into convex pieces when they are first needed: the polygon itself if it is convex, otherwise
/// triangles, or trapezoids if it has very many corners.
///
/// Most bodies only touch other bodies. Then the bounds or the convex hulls of the two bodies are often enough to exclude
/// an overlap, and no pieces are needed.
#[derive(Clone, Debug)]
pub struct ConvexPieces<'p> {
    polygon: &'p Polygon,
    bounds: Bounds,
    pieces: OnceLock<Vec<Piece<'p>>>,
    hull: OnceLock<Vec<Point>>,
}

/// If the outlines of both polygons together have at most this number of corners, their hulls are not computed, because
/// ear clipping is fast. A polygon with more corners is cut into trapezoids, because the time of ear clipping grows with
/// the square of their number.
const FEW_CORNERS: usize = 2000;

/// If the hull with fewer sides has more sides than this, the hulls are not compared, because the time grows with the
/// product of the two numbers of sides.
const MAX_HULL_SIDES: usize = 500;

/// If a polygon has more pieces than this, an index finds the pieces of the other polygon near each of them.
const MAX_PIECES_WITHOUT_INDEX: usize = 32;

/// The search ends after this number of overlapping pairs of pieces. Two combs that cross have a pair for every two
/// teeth.
const MAX_PAIRS: usize = 1_000_000;

/// A convex piece with the data for two quick tests: its bounds, and its extent across its longest side.
///
/// Long thin pieces that lie side by side can have intersecting bounds; the second test separates most of these
/// pairs.
#[derive(Clone, Debug)]
struct Piece<'p> {
    bounds: Bounds,
    /// A vector perpendicular to the longest side and as long as that side.
    across: Vector,
    /// The smallest and the largest dot product of `across` with the coordinates of a corner.
    extent: [f64; 2],
    /// The corners, anticlockwise.
    corners: Cow<'p, [Point]>,
}

impl<'p> Piece<'p> {
    fn new(corners: Cow<'p, [Point]>) -> Option<Piece<'p>> {
        let bounds = Bounds::from_points(corners.iter().copied())?;
        let last = corners.len() - 1;
        let mut longest = corners[0] - corners[last];
        for i in 0..last {
            let side = corners[i + 1] - corners[i];
            if side.norm_squared() > longest.norm_squared() {
                longest = side;
            }
        }
        let across = quarter_turn(longest);
        Some(Piece { bounds, across, extent: extent(&corners, across), corners })
    }

    /// True if a line parallel to the longest side of this piece separates the two pieces. They then have no common
    /// point. If the result is false, the pieces may still be disjoint.
    fn is_separated_from(&self, other: &Piece<'_>) -> bool {
        let [min, max] = extent(&other.corners, self.across);
        min > self.extent[1] || max < self.extent[0]
    }
}

/// Returns the smallest and the largest dot product of the vector `along` with the coordinates of the points.
fn extent(points: &[Point], along: Vector) -> [f64; 2] {
    points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], p| {
        let at = along.dot(&p.coords);
        [min.min(at), max.max(at)]
    })
}

/// The intersection of two polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Common area in square metres.
    pub area: f64,
    /// Centroid of the common area.
    pub at: Point,
    /// The largest depth of any pair of convex pieces, in metres.
    pub depth: f64,
    /// Whether there are so many overlapping pieces that `area` and `depth` are only lower bounds.
    pub at_least: bool,
}

impl<'p> ConvexPieces<'p> {
    /// Prepares a polygon for [`overlap`].
    pub fn new(polygon: &'p Polygon) -> ConvexPieces<'p> {
        ConvexPieces { polygon, bounds: polygon.bounds(), pieces: OnceLock::new(), hull: OnceLock::new() }
    }

    fn hull(&self) -> &[Point] {
        (self.hull).get_or_init(|| convex_hull(self.polygon.outline().to_vec()))
    }

    fn pieces(&self) -> &[Piece<'p>] {
        self.pieces.get_or_init(|| Piece::all_of(self.polygon))
    }

    /// Returns an upper bound of the depth of the overlap with another polygon, in metres: the least distance along x
    /// or y by which one polygon must move until their bounds are disjoint.
    ///
    /// The depth of two convex pieces is the least distance, over all directions, by which one must move until it
    /// leaves the other. The pieces lie inside the bounds, so the distance for the bounds is at least as large.
    fn depth_bound(&self, other: &ConvexPieces<'_>) -> f64 {
        let (a, b) = (self.bounds, other.bounds);
        let (one, two) = (a.max - b.min, b.max - a.min);
        one.x.min(two.x).min(one.y).min(two.y)
    }

    /// Returns an upper bound of the depth of the overlap of two polygons with many corners, in metres: the least
    /// distance, perpendicular to a side of the hull with fewer sides, by which one polygon must move until the hulls
    /// are disjoint. All pieces lie inside the hulls, so the bound is valid for the same reason as
    /// [`Self::depth_bound`]. It is infinite if the polygons have few corners, or if both hulls have many sides.
    fn hull_depth_bound(&self, other: &ConvexPieces<'_>) -> f64 {
        if self.polygon.outline().len() + other.polygon.outline().len() <= FEW_CORNERS {
            return f64::INFINITY;
        }
        let (mut small, mut large) = (self.hull(), other.hull());
        if small.len() > large.len() {
            (small, large) = (large, small);
        }
        match small.len() {
            3..=MAX_HULL_SIDES => penetration(small, large),
            _ => f64::INFINITY,
        }
    }
}

impl<'p> Piece<'p> {
    /// Divides a polygon into convex pieces: one piece if the polygon is convex, otherwise triangles or trapezoids.
    fn all_of(polygon: &'p Polygon) -> Vec<Piece<'p>> {
        if polygon.is_convex() {
            let whole = Piece::new(Cow::Borrowed(polygon.outline()));
            return whole.into_iter().collect();
        }
        let points: Vec<Point> = polygon.rings().iter().flatten().copied().collect();
        if let Some(pieces) = (points.len() > FEW_CORNERS).then(|| trapezoids(polygon.rings())).flatten() {
            return pieces.into_iter().filter_map(|piece| Piece::new(Cow::Owned(piece))).collect();
        }
        // Use coordinates relative to a corner for the ear clipping. Far from the origin, differences between products
        // of absolute coordinates would lose digits.
        let base = points[0];
        let relative = points.iter().map(|p| [p.x - base.x, p.y - base.y]);
        let mut hole_starts = Vec::new();
        let mut count = polygon.outline().len();
        for hole in polygon.holes() {
            hole_starts.push(count);
            count += hole.len();
        }
        let mut corners: Vec<usize> = Vec::new();
        earcut::Earcut::new().earcut(relative, &hole_starts, &mut corners);
        corners
            .chunks_exact(3)
            .map(|t| {
                let mut triangle = vec![points[t[0]], points[t[1]], points[t[2]]];
                if cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0.0 {
                    triangle.reverse();
                }
                triangle
            })
            // Drop triangles without area. They overlap nothing, and a side of length 0 has no normal for the
            // separating-axis test.
            .filter(|t| cross(t[1] - t[0], t[2] - t[0]) > 0.0)
            .filter_map(|t| Piece::new(Cow::Owned(t)))
            .collect()
    }
}

/// Returns the overlap of two polygons that are given as convex pieces. `None` if the overlap is at most `gap` metres
/// deep.
pub fn overlap(a: &ConvexPieces<'_>, b: &ConvexPieces<'_>, gap: f64) -> Option<Overlap> {
    if a.depth_bound(b) <= gap || a.hull_depth_bound(b) <= gap {
        return None;
    }
    let mut depth: f64 = 0.0;
    let mut overlapping = Vec::new();
    // Pieces that only touch do not overlap.
    let touch = -1e-14 * a.bounds.diagonal();
    let index = (a.pieces().len() > MAX_PIECES_WITHOUT_INDEX).then(|| {
        let across = across_longest(a.polygon.edges());
        let around = move |piece: &Piece| Aabb::with_direction(&piece.corners, across);
        (BoxIndex::new((0..b.pieces().len()).collect(), |k: &usize| around(&b.pieces()[*k])), around)
    });
    let mut near: Vec<usize> = (0..b.pieces().len()).collect();
    for one in a.pieces() {
        if let Some((index, around)) = &index {
            near.clear();
            near.extend(index.intersecting(around(one).grown(touch)));
            near.sort_unstable();
        }
        for two in near.iter().map(|k| &b.pieces()[*k]).filter(|two| one.bounds.intersects(two.bounds)) {
            if one.is_separated_from(two) || two.is_separated_from(one) {
                continue;
            }
            // Separating-axis test with the normals of the sides of both pieces.
            let mut pair_depth = penetration(&one.corners, &two.corners);
            if pair_depth > 0.0 {
                pair_depth = pair_depth.min(penetration(&two.corners, &one.corners));
            }
            if pair_depth > 0.0 {
                depth = depth.max(pair_depth);
                overlapping.push((&one.corners, &two.corners));
            }
        }
        if overlapping.len() > MAX_PAIRS {
            break;
        }
    }
    if depth <= gap {
        return None;
    }
    // Compute the area and the centroid of the intersection relative to a corner of `a`, so that few digits are lost.
    let base = a.pieces().first()?.corners[0];
    let (area, moment) = common_area(&overlapping, base);
    let at_least = overlapping.len() > MAX_PAIRS;
    (area > 0.0).then(|| Overlap { area, at: base + moment / area, depth, at_least })
}

/// Two convex pieces that overlap.
type PiecePair<'p> = (&'p Cow<'p, [Point]>, &'p Cow<'p, [Point]>);

/// Returns the sum of the intersection areas of all pairs, in square metres, and the first moment of this area about
/// `base`, in cubic metres.
fn common_area(pairs: &[PiecePair<'_>], base: Point) -> (f64, Vector) {
    let mut area = 0.0;
    let mut moment = Vector::zeros();
    for (one, two) in pairs {
        let common = clipped(one, two);
        // The intersection is convex: the triangles between its first corner and each side cover it exactly once.
        for i in 1..common.len().saturating_sub(1) {
            let (p, q, r) = (common[0] - base, common[i] - base, common[i + 1] - base);
            let part = cross(q - p, r - p) / 2.0;
            area += part;
            moment += (p + q + r) * (part / 3.0);
        }
    }
    (area, moment)
}

/// Returns the depth to which the convex polygon `b` reaches into the convex polygon `a`, in metres. For each side of
/// `a`, the function finds the largest distance of a corner of `b` from this side, measured inwards. The depth is the
/// smallest of these distances.
///
/// The result is at most 0 if a side of `a` separates the two polygons.
fn penetration(a: &[Point], b: &[Point]) -> f64 {
    let mut depth = f64::INFINITY;
    for i in 0..a.len() {
        let (from, to) = (a[i], a[if i + 1 == a.len() { 0 } else { i + 1 }]);
        let along = to - from;
        let length = along.norm();
        let outward = Vector::new(along.y, -along.x) / length;
        let deepest = b.iter().map(|p| outward.dot(&(p - from))).fold(f64::INFINITY, f64::min);
        depth = depth.min(-deepest);
        if depth <= 0.0 {
            return depth;
        }
    }
    depth
}

/// Returns the corners of the intersection of two convex polygons. The function cuts `a` along the line through each
/// side of `b`.
fn clipped(a: &[Point], b: &[Point]) -> Vec<Point> {
    let mut kept = a.to_vec();
    for i in 0..b.len() {
        let (from, to) = (b[i], b[(i + 1) % b.len()]);
        kept = in_half_plane(&kept, |p| -cross(to - from, p - from));
    }
    kept
}

/// Returns the corners of the part of a convex polygon in which `height` is at most 0. `height` is the signed distance
/// from a line, or a positive multiple of this distance.
///
/// One step of the clipping method of Sutherland and Hodgman: keep the corners on the inner side, and add the points
/// where the outline crosses the line. A corner on the line is kept.
pub(crate) fn in_half_plane<P>(ring: &[P], height: impl Fn(&P) -> f64) -> Vec<P>
where
    P: Copy + Sub<Output = Vector> + Add<Vector, Output = P>,
{
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (k, from) in ring.iter().enumerate() {
        let to = &ring[(k + 1) % ring.len()];
        let (here, there) = (height(from), height(to));
        if here <= 0.0 {
            kept.push(*from);
        }
        if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
            kept.push(*from + (*to - *from) * (here / (here - there)));
        }
    }
    kept
}

#[cfg(test)]
mod tests;

/// A side, from its left to its right end.
struct Side {
    ends: [Point; 2],
    /// If the polygon lies above this side: where the trapezoid above it begins.
    begin: f64,
}

impl Side {
    /// Returns the point of the side at this x, which lies between its ends.
    fn at(&self, x: f64) -> Point {
        let [left, right] = self.ends;
        match x {
            x if x == left.x => left,
            x if x == right.x => right,
            x => Point::new(x, left.y + (right.y - left.y) * ((x - left.x) / (right.x - left.x))),
        }
    }
}

/// Returns trapezoids and triangles, anticlockwise, that cover the polygon with these rings once. Their corners lie on its
/// sides, apart from rounding. `None` may be returned if the rings touch or cross each other or themselves.
///
/// The time is that of sorting the corners. A vertical line sweeps over the corners from left to right and keeps the
/// sides that it crosses, from the lowest to the highest. Between each odd side and the next lies the polygon. At a
/// corner, the trapezoids between the sides that end or begin there, and at most one on either side of the corner, are
/// closed and begun anew. Corners above each other are swept from the lowest on, as if the polygon leaned to the right by
/// an infinitely small angle. Reference: de Berg et al., Computational Geometry, 3rd ed., 2008, chapters 3 and 6.
fn trapezoids(rings: &[Vec<Point>]) -> Option<Vec<Vec<Point>>> {
    let mut sides: Vec<Side> = Vec::new();
    // For each corner: the sides of which it is an end.
    let mut corners: Vec<(Point, [usize; 2])> = Vec::new();
    for ring in rings {
        let (first, last) = (sides.len(), sides.len() + ring.len() - 1);
        for (number, edge) in (first..).zip(ring_edges(ring)) {
            let (from, to) = (edge.from, edge.to);
            let ends = if (from.x, from.y) < (to.x, to.y) { [from, to] } else { [to, from] };
            corners.push((from, [if number == first { last } else { number - 1 }, number]));
            sides.push(Side { ends, begin: from.x });
        }
    }
    corners.sort_unstable_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut crossed: Vec<usize> = Vec::new();
    let mut pieces = Vec::new();
    for (corner, of_corner) in corners {
        let mut beginning = of_corner.to_vec();
        beginning.retain(|side| sides[*side].ends[0] == corner);
        if let [one, two] = beginning[..]
            && orientation(corner, sides[one].ends[1], sides[two].ends[1]) < 0.0
        {
            beginning.reverse();
        }
        let first = crossed.partition_point(|side| {
            let [left, right] = sides[*side].ends;
            orientation(left, right, corner) > 0.0
        });
        // As many sides end as do not begin.
        let [ended, begun] = [first + 2 - beginning.len(), first + beginning.len()];
        for pair in crossed.get(first - first % 2..ended + ended % 2)?.chunks_exact(2) {
            pieces.extend(between(&sides[pair[0]], &sides[pair[1]], corner.x));
        }
        crossed.splice(first..ended, beginning);
        for pair in crossed.get(first - first % 2..begun + begun % 2)?.chunks_exact(2) {
            sides[pair[0]].begin = corner.x;
        }
    }
    Some(pieces)
}

/// Returns the trapezoid between two sides from its beginning to `end`. `None` if it has no area.
fn between(under: &Side, over: &Side, end: f64) -> Option<Vec<Point>> {
    if end <= under.begin {
        return None;
    }
    let mut piece = vec![under.at(under.begin), under.at(end), over.at(end), over.at(under.begin)];
    piece.dedup();
    piece.pop_if(|last| *last == under.at(under.begin));
    let area: f64 = piece.windows(2).map(|side| cross(side[0] - piece[0], side[1] - piece[0])).sum();
    (piece.len() > 2 && area > 0.0).then_some(piece)
}
