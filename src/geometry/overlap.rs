//! How much of two polygons lies on top of each other: depth decides, area and place are reported.
//!
//! Invariant: two polygons that only touch, with noise up to `gap` deep, do not overlap, whatever the length of the
//! touching edges. Depth is the separating-axis depth of convex pieces, so it does not depend on where the scene lies.

use std::borrow::Cow;

use super::{Bounds, Point, Polygon, Vector, cross, quarter_turn};

/// A polygon cut into convex pieces: itself where it is convex.
#[derive(Clone, Debug)]
pub struct ConvexPieces<'p> {
    whole: Option<Piece<'p>>,
    triangles: Vec<Piece<'p>>,
}

/// Corners of a convex piece, anticlockwise, with its box and the band between its longest side and the corner farthest
/// from it: many thin pieces that lie side by side are apart by that alone.
#[derive(Clone, Debug)]
struct Piece<'p> {
    around: Bounds,
    /// Square to the longest side, as long as that is, and how far the piece reaches along it.
    across: Vector,
    reach: [f64; 2],
    corners: Cow<'p, [Point]>,
}

impl<'p> Piece<'p> {
    fn new(corners: Cow<'p, [Point]>) -> Option<Piece<'p>> {
        let around = Bounds::from_points(corners.iter().copied())?;
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
            around,
            across,
            reach: reach(&corners, across),
            corners,
        })
    }

    /// Whether another piece lies beside this one's band.
    fn is_beside(&self, other: &Piece<'_>) -> bool {
        let [least, most] = reach(&other.corners, self.across);
        least > self.reach[1] || most < self.reach[0]
    }
}

/// How far points reach along a vector, times its length.
fn reach(points: &[Point], along: Vector) -> [f64; 2] {
    points
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], p| {
            let at = along.dot(&p.coords);
            [least.min(at), most.max(at)]
        })
}

/// Two bodies in the same place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Common area in square metres.
    pub area: f64,
    /// Its centroid.
    pub at: Point,
    /// How deep the deepest convex pieces reach into each other, in metres.
    pub depth: f64,
}

impl<'p> ConvexPieces<'p> {
    /// A convex polygon stays whole, any other is cut into triangles.
    pub fn new(polygon: &'p Polygon) -> ConvexPieces<'p> {
        if polygon.is_convex() {
            return ConvexPieces {
                whole: Piece::new(Cow::Borrowed(polygon.outline())),
                triangles: Vec::new(),
            };
        }
        let points: Vec<Point> = polygon.rings().iter().flatten().copied().collect();
        let base = points[0];
        let flat = points.iter().map(|p| [p.x - base.x, p.y - base.y]);
        let mut starts = Vec::new();
        let mut count = polygon.outline().len();
        for hole in polygon.holes() {
            starts.push(count);
            count += hole.len();
        }
        let mut corners: Vec<usize> = Vec::new();
        earcut::Earcut::new().earcut(flat, &starts, &mut corners);
        let triangles = corners
            .chunks_exact(3)
            .map(|t| {
                let mut triangle = vec![points[t[0]], points[t[1]], points[t[2]]];
                if cross(triangle[1] - triangle[0], triangle[2] - triangle[0]) < 0.0 {
                    triangle.reverse();
                }
                triangle
            })
            .filter(|t| cross(t[1] - t[0], t[2] - t[0]) > 0.0)
            .filter_map(|t| Piece::new(Cow::Owned(t)))
            .collect();
        ConvexPieces {
            whole: None,
            triangles,
        }
    }

    fn all(&self) -> impl Iterator<Item = &Piece<'p>> {
        self.whole.iter().chain(&self.triangles)
    }
}

/// The overlap of two cut polygons where it is deeper than `gap` metres, `None` where they are apart or only touch.
pub fn overlap(a: &ConvexPieces<'_>, b: &ConvexPieces<'_>, gap: f64) -> Option<Overlap> {
    let mut depth: f64 = 0.0;
    let mut close = Vec::new();
    for one in a.all() {
        for two in b.all().filter(|two| one.around.meets(two.around)) {
            if one.is_beside(two) || two.is_beside(one) {
                continue;
            }
            let mut d = penetration(&one.corners, &two.corners);
            if d > 0.0 {
                d = d.min(penetration(&two.corners, &one.corners));
            }
            if d > 0.0 {
                depth = depth.max(d);
                close.push((&one.corners, &two.corners));
            }
        }
    }
    if depth <= gap {
        return None;
    }
    let mut area = 0.0;
    let mut moment = Vector::zeros();
    let base = a.all().next()?.corners[0];
    for (one, two) in close {
        let common = clipped(one, two);
        for i in 1..common.len().saturating_sub(1) {
            let (p, q, r) = (common[0] - base, common[i] - base, common[i + 1] - base);
            let part = cross(q - p, r - p) / 2.0;
            area += part;
            moment += (p + q + r) * (part / 3.0);
        }
    }
    (area > 0.0).then(|| Overlap {
        area,
        at: base + moment / area,
        depth,
    })
}

/// Least distance by which `b` reaches behind a side of the convex `a`; at most 0 where a side separates them.
fn penetration(a: &[Point], b: &[Point]) -> f64 {
    let mut least = f64::INFINITY;
    for i in 0..a.len() {
        let (from, to) = (a[i], a[if i + 1 == a.len() { 0 } else { i + 1 }]);
        let along = to - from;
        let length = along.norm();
        let outward = Vector::new(along.y, -along.x) / length;
        let nearest = b
            .iter()
            .map(|p| outward.dot(&(p - from)))
            .fold(f64::INFINITY, f64::min);
        least = least.min(-nearest);
        if least <= 0.0 {
            return least;
        }
    }
    least
}

/// The convex `a` cut to the convex `b`.
fn clipped(a: &[Point], b: &[Point]) -> Vec<Point> {
    let mut kept = a.to_vec();
    for i in 0..b.len() {
        let (from, to) = (b[i], b[(i + 1) % b.len()]);
        let side = |p: &Point| cross(to - from, p - from);
        let mut next = Vec::with_capacity(kept.len() + 1);
        for k in 0..kept.len() {
            let (p, q) = (kept[k], kept[(k + 1) % kept.len()]);
            let (sp, sq) = (side(&p), side(&q));
            if sp >= 0.0 {
                next.push(p);
            }
            if (sp > 0.0 && sq < 0.0) || (sp < 0.0 && sq > 0.0) {
                next.push(p + (q - p) * (sp / (sp - sq)));
            }
        }
        kept = next;
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
    fn touching_is_not_overlapping_and_overlap_tells_area_and_place() {
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
        for piece in ConvexPieces::new(&frame).all() {
            let t = &piece.corners;
            let around = Bounds::from_points(t.iter().copied());
            assert_eq!((t.len(), around), (3, Some(piece.around)));
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
        let parts = pieces.all().map(|piece| {
            let t = &piece.corners;
            cross(t[1] - t[0], t[2] - t[0]) / 2.0
        });
        assert_eq!(parts.sum::<f64>(), 5.0 / 16.0);
        let square = rectangle(0.0, 0.0, 1.0, 1.0);
        let pieces = ConvexPieces::new(&square);
        let whole: Vec<usize> = pieces.all().map(|piece| piece.corners.len()).collect();
        assert_eq!(whole, [4], "what is convex stays whole");
    }
}
