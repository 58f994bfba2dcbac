//! [`overlap`]: computes the area, the centroid and the depth of the intersection of two polygons.
//!
//! Each polygon is cut into convex pieces by ear clipping. Two convex pieces are disjoint if a side of one of them
//! separates them. Otherwise their depth is the smallest distance by which one piece must move, perpendicular to a
//! side, until it leaves the other (separating-axis test). The area comes from clipping one piece by the other
//! (Sutherland and Hodgman 1974). References: Ericson, Real-Time Collision Detection, 2005, §4.4 and §5.2; Held, FIST,
//! 2001, for ear clipping.
//!
//! Invariant: polygons that only touch do not overlap. An overlap of up to `gap` metres in depth counts as touching.
//! Depth is a distance along a side's normal, so it does not depend on where the scene lies.

use std::borrow::Cow;
use std::ops::{Add, Sub};

use super::{Bounds, Point, Polygon, Vector, cross, quarter_turn};

/// A polygon cut into convex pieces: the polygon itself if it is convex, otherwise triangles.
#[derive(Clone, Debug)]
pub struct ConvexPieces<'p> {
    convex: Option<Piece<'p>>,
    triangles: Vec<Piece<'p>>,
}

/// A convex piece with two quick tests: its bounds, and its extent across its longest side.
///
/// Long thin pieces that lie side by side have intersecting bounds; the second test separates most of these pairs.
#[derive(Clone, Debug)]
struct Piece<'p> {
    bounds: Bounds,
    /// A vector perpendicular to the longest side and as long as that side.
    across: Vector,
    /// The smallest and the largest product of `across` with a corner.
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
        Some(Piece {
            bounds,
            across,
            extent: extent(&corners, across),
            corners,
        })
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
    points
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], p| {
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
}

impl<'p> ConvexPieces<'p> {
    /// Divides a polygon into convex pieces: one piece if the polygon is convex, otherwise triangles.
    pub fn new(polygon: &'p Polygon) -> ConvexPieces<'p> {
        if polygon.is_convex() {
            return ConvexPieces {
                convex: Piece::new(Cow::Borrowed(polygon.outline())),
                triangles: Vec::new(),
            };
        }
        let points: Vec<Point> = polygon.rings().iter().flatten().copied().collect();
        // Pass coordinates relative to a corner to the ear clipping. Far from the origin, differences between products
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
        let triangles = corners
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
            .collect();
        ConvexPieces {
            convex: None,
            triangles,
        }
    }

    fn pieces(&self) -> impl Iterator<Item = &Piece<'p>> {
        self.convex.iter().chain(&self.triangles)
    }
}

/// Returns the overlap of two polygons that are given as convex pieces. `None` if the overlap is at most `gap` metres
/// deep.
pub fn overlap(a: &ConvexPieces<'_>, b: &ConvexPieces<'_>, gap: f64) -> Option<Overlap> {
    let mut depth: f64 = 0.0;
    let mut overlapping = Vec::new();
    for one in a.pieces() {
        for two in b.pieces().filter(|two| one.bounds.intersects(two.bounds)) {
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
    }
    if depth <= gap {
        return None;
    }
    // Compute the area and the centroid of the intersection relative to a corner near it, so that few digits are lost.
    let base = a.pieces().next()?.corners[0];
    let (area, moment) = common_area(&overlapping, base);
    (area > 0.0).then(|| Overlap {
        area,
        at: base + moment / area,
        depth,
    })
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
/// `a`, this is the largest distance of a point of `b` from the side, measured inwards; the result is the smallest of
/// these distances.
///
/// The result is at most 0 if a side of `a` separates the two polygons.
fn penetration(a: &[Point], b: &[Point]) -> f64 {
    let mut depth = f64::INFINITY;
    for i in 0..a.len() {
        let (from, to) = (a[i], a[if i + 1 == a.len() { 0 } else { i + 1 }]);
        let along = to - from;
        let length = along.norm();
        let outward = Vector::new(along.y, -along.x) / length;
        let deepest = b
            .iter()
            .map(|p| outward.dot(&(p - from)))
            .fold(f64::INFINITY, f64::min);
        depth = depth.min(-deepest);
        if depth <= 0.0 {
            return depth;
        }
    }
    depth
}

/// Returns the intersection of two convex polygons. It cuts `a` along the line through each side of `b`.
fn clipped(a: &[Point], b: &[Point]) -> Vec<Point> {
    let mut kept = a.to_vec();
    for i in 0..b.len() {
        let (from, to) = (b[i], b[(i + 1) % b.len()]);
        kept = in_half_plane(&kept, |p| -cross(to - from, p - from));
    }
    kept
}

/// Returns the part of a convex polygon in which `height` is at most 0. `height` is the signed distance from a line, or
/// a positive multiple of this distance.
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
mod tests {
    use super::*;

    fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Polygon {
        Polygon::new(
            vec![
                Point::new(x, y),
                Point::new(x + w, y),
                Point::new(x + w, y + h),
                Point::new(x, y + h),
            ],
            vec![],
        )
        .expect("sound")
    }

    #[test]
    fn touching_is_not_overlapping_and_an_overlap_has_area_and_place() {
        let a = rectangle(0.0, 0.0, 2.0, 1.0);
        let a = ConvexPieces::new(&a);
        assert_eq!(
            overlap(&a, &ConvexPieces::new(&rectangle(2.0, 0.0, 1.0, 1.0)), 0.0),
            None
        );
        assert_eq!(
            overlap(
                &a,
                &ConvexPieces::new(&rectangle(2.0 - 1e-7, 0.0, 1.0, 1.0)),
                1e-6
            ),
            None
        );
        let found = overlap(
            &a,
            &ConvexPieces::new(&rectangle(1.5, 0.75, 3.0, 1.0)),
            1e-6,
        )
        .expect("overlap");
        assert!((found.area - 0.125).abs() < 1e-12);
        assert!((found.at - Point::new(1.75, 0.875)).norm() < 1e-12);
        assert!((found.depth - 0.25).abs() < 1e-12);
    }

    #[test]
    fn a_block_in_the_hole_of_another_does_not_overlap_it() {
        let corners = |x: f64, w: f64| {
            vec![
                Point::new(x, x),
                Point::new(x + w, x),
                Point::new(x + w, x + w),
                Point::new(x, x + w),
            ]
        };
        let frame = Polygon::new(corners(0.0, 4.0), vec![corners(1.0, 2.0)]).expect("sound");
        let pieces = ConvexPieces::new(&frame);
        assert_eq!(
            overlap(
                &pieces,
                &ConvexPieces::new(&rectangle(1.0, 1.0, 2.0, 1.0)),
                1e-9
            ),
            None
        );
        let stuck = overlap(
            &pieces,
            &ConvexPieces::new(&rectangle(1.0, 1.0, 2.5, 1.0)),
            1e-9,
        )
        .expect("overlap");
        assert!((stuck.area - 0.5).abs() < 1e-12);
    }

    fn polygon(corners: &[[f64; 2]]) -> Polygon {
        let corners = corners.iter().map(|p| Point::new(p[0], p[1])).collect();
        Polygon::new(corners, vec![]).expect("sound")
    }

    /// The overlap of two, the same in either order.
    fn both(a: &Polygon, b: &Polygon) -> Overlap {
        let (a, b) = (&ConvexPieces::new(a), &ConvexPieces::new(b));
        let found = overlap(a, b, 1e-9).expect("overlap");
        let other = overlap(b, a, 1e-9).expect("overlap");
        assert!((found.area - other.area).abs() < 1e-12);
        assert!((found.at - other.at).norm() < 1e-12);
        assert!((found.depth - other.depth).abs() < 1e-12);
        found
    }

    #[test]
    fn common_area_and_its_centroid_are_those_of_the_pieces_together() {
        // An L and a square over its corner: 2 by ½ around (1½, ¾), and ½ by 1½ around (¾, 1¾).
        for (x, y) in [(0.0, 0.0), (40.0, -70.0)] {
            let corners = [
                [0.0, 0.0],
                [3.0, 0.0],
                [3.0, 1.0],
                [1.0, 1.0],
                [1.0, 3.0],
                [0.0, 3.0],
            ];
            let l = polygon(&corners.map(|p| [p[0] + x, p[1] + y]));
            let found = both(&l, &rectangle(0.5 + x, 0.5 + y, 2.0, 2.0));
            assert!((found.area - 1.75).abs() < 1e-12);
            let wanted = Point::new(x + (1.5 + 0.5625) / 1.75, y + (0.75 + 1.3125) / 1.75);
            assert!((found.at - wanted).norm() < 1e-12, "{}", found.at);
        }
        // A square less its four corners, cut by a diamond.
        let diamond = polygon(&[[1.5, 0.0], [0.0, 1.5], [-1.5, 0.0], [0.0, -1.5]]);
        let found = both(&diamond, &rectangle(-1.0, -1.0, 2.0, 2.0));
        assert!((found.area - 3.5).abs() < 1e-12 && found.at.coords.norm() < 1e-12);
    }

    #[test]
    fn depth_is_the_least_way_out() {
        let slab = rectangle(0.0, 0.0, 4.0, 4.0);
        for (x, y, depth) in [
            (1.0, 1.0, 2.0),
            (2.5, 1.0, 1.5),
            (-0.75, 2.0, 0.25),
            (3.5, 3.75, 0.25),
        ] {
            let found = both(&slab, &rectangle(x, y, 1.0, 1.0));
            assert!(
                (found.depth - depth).abs() < 1e-12,
                "{x} {y}: {}",
                found.depth
            );
        }
        // A tip, from above and onto a slope: ¼ deep, the slope 3 along and 4 down.
        let tip = polygon(&[[2.0, 3.75], [3.0, 9.0], [1.0, 9.0]]);
        assert!((both(&slab, &tip).depth - 0.25).abs() < 1e-12);
        let slope = polygon(&[[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]);
        let box_at = |d: f64| rectangle(1.5 - 0.8 * d, 2.0 - 0.6 * d, 5.0, 5.0);
        assert!((both(&slope, &box_at(0.25)).depth - 0.25).abs() < 1e-12);
        let deep = |a: &Polygon, b: &Polygon, gap: f64| {
            overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), gap)
        };
        assert_eq!(deep(&slope, &box_at(-1e-6), 0.0), None);
        // As deep as the gap is none yet.
        let stone = rectangle(1.0, 3.75, 1.0, 1.0);
        assert_eq!(deep(&slab, &stone, 0.25), None);
        assert!(deep(&slab, &stone, 0.2499).is_some());
    }

    /// 2⁵⁰ metres.
    const FAR: f64 = 1_125_899_906_842_624.0;

    #[test]
    fn pieces_cover_the_whole_once() {
        let ring = |x: f64, size: f64| rectangle(x, x, size, size).outline().to_vec();
        let frame = Polygon::new(ring(-3.0, 9.0), vec![ring(0.0, 1.0), ring(2.0, 3.0)]);
        let frame = frame.expect("sound");
        let mut area = 0.0;
        for piece in ConvexPieces::new(&frame).pieces() {
            let t = &piece.corners;
            let bounds = Bounds::from_points(t.iter().copied());
            assert_eq!((t.len(), bounds), (3, Some(piece.bounds)));
            let part = cross(t[1] - t[0], t[2] - t[0]) / 2.0;
            assert!(part > 0.0, "anticlockwise");
            let centre = t[0] + (t[1] - t[0] + (t[2] - t[0])) / 3.0;
            assert!(frame.contains(centre));
            area += part;
        }
        assert!((area - 71.0).abs() < 1e-12);
        // So far away that only quarters of a metre have a number.
        let far = |p: [f64; 2]| p.map(|v| v / 4.0 + FAR);
        let corners = [
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ];
        let l = polygon(&corners.map(far));
        let pieces = ConvexPieces::new(&l);
        let parts = pieces.pieces().map(|piece| {
            let t = &piece.corners;
            cross(t[1] - t[0], t[2] - t[0]) / 2.0
        });
        assert_eq!(parts.sum::<f64>(), 5.0 / 16.0);
        let square = rectangle(0.0, 0.0, 1.0, 1.0);
        let pieces = ConvexPieces::new(&square);
        let convex: Vec<usize> = pieces.pieces().map(|piece| piece.corners.len()).collect();
        assert_eq!(convex, [4], "what is convex stays whole");
    }
}
