//! How much of two polygons lies on top of each other: depth decides, area and place are reported.
//!
//! Invariant: two polygons that only touch, with noise up to `gap` deep, do not overlap, whatever the length of the
//! touching edges. Depth is the separating-axis depth of convex pieces, so it does not depend on where the scene lies.

use std::borrow::Cow;

use super::{Bounds, Point, Polygon, Vector, cross};

/// A polygon cut into convex pieces: itself where it is convex.
#[derive(Clone, Debug)]
pub struct Pieces<'p> {
    whole: Option<Piece<'p>>,
    triangles: Vec<Piece<'p>>,
}

/// Corners of a convex piece, anticlockwise, with its box.
#[derive(Clone, Debug)]
struct Piece<'p> {
    around: Bounds,
    corners: Cow<'p, [Point]>,
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

impl<'p> Pieces<'p> {
    /// A convex polygon stays whole, any other is cut into triangles.
    pub fn of(polygon: &'p Polygon) -> Pieces<'p> {
        if polygon.is_convex() {
            return Pieces {
                whole: Some(Piece {
                    around: polygon.bounds(),
                    corners: Cow::Borrowed(polygon.outline()),
                }),
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
            .filter_map(|t| {
                Some(Piece {
                    around: Bounds::of(t.iter().copied())?,
                    corners: Cow::Owned(t),
                })
            })
            .collect();
        Pieces {
            whole: None,
            triangles,
        }
    }

    fn all(&self) -> impl Iterator<Item = &Piece<'p>> {
        self.whole.iter().chain(&self.triangles)
    }
}

/// The overlap of two cut polygons where it is deeper than `gap` metres, `None` where they are apart or only touch.
pub fn overlap(a: &Pieces<'_>, b: &Pieces<'_>, gap: f64) -> Option<Overlap> {
    let mut depth: f64 = 0.0;
    let mut close = Vec::new();
    for one in a.all() {
        for two in b.all().filter(|two| one.around.meets(two.around)) {
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
        let a = Pieces::of(&a);
        assert_eq!(
            overlap(&a, &Pieces::of(&rectangle(2.0, 0.0, 1.0, 1.0)), 0.0),
            None
        );
        assert_eq!(
            overlap(&a, &Pieces::of(&rectangle(2.0 - 1e-7, 0.0, 1.0, 1.0)), 1e-6),
            None
        );
        let found =
            overlap(&a, &Pieces::of(&rectangle(1.5, 0.75, 3.0, 1.0)), 1e-6).expect("overlap");
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
        let pieces = Pieces::of(&frame);
        assert_eq!(
            overlap(&pieces, &Pieces::of(&rectangle(1.0, 1.0, 2.0, 1.0)), 1e-9),
            None
        );
        let stuck =
            overlap(&pieces, &Pieces::of(&rectangle(1.0, 1.0, 2.5, 1.0)), 1e-9).expect("overlap");
        assert!((stuck.area - 0.5).abs() < 1e-12);
    }
}
