//! [`curve`]: computes the axis of a schematic strand, which stays in its block.

use crate::geometry::{Point, Polygon, Vector};

/// Number of segments of a schematic curve.
const CURVE_SEGMENTS: usize = 12;
/// Distance of the control points of a curve from its ends, as a fraction of the chord's component along the force. If
/// the curve leaves its block, the next smaller value is tried; with 0, the curve is straight.
const HANDLE_SHARES: [f64; 4] = [0.2, 0.1, 0.05, 0.0];
/// A point whose distance from the block is at most this fraction of the block's size counts as inside.
const INSIDE_TOL: f64 = 1e-6;

/// Moves the points of an axis away from the edges of `polygon`, so that a band that is `widths` metres wide at these
/// points lies inside the polygon.
pub(super) fn moved_inside(polygon: &Polygon, axis: &mut [Point], widths: &[f64]) {
    for (point, width) in axis.iter_mut().zip(widths) {
        let half = 0.5 * width;
        for edge in polygon.edges() {
            let inward = -edge.outward();
            let depth = (*point - edge.from).dot(&inward);
            if depth.abs() < half && edge.distance(*point) < half {
                *point += inward * (half - depth);
            }
        }
    }
}

/// Returns a Bézier curve from `a` to `b`, as a list of points. `along_a` and `along_b` are its directions at these
/// points; a direction that points away from the other end is ignored. Of a few curves, the most curved one that does
/// not leave `polygon` is chosen. If all leave it, the curve is straight.
pub(super) fn curve(polygon: &Polygon, [(a, along_a), (b, along_b)]: [(Point, Vector); 2]) -> Vec<Point> {
    let chord = b - a;
    let drawn = |share: f64| -> Vec<Point> {
        let handle = |along: Vector| share * chord.dot(&along).max(0.0);
        let (p, q) = (a + along_a * handle(along_a), b - along_b * handle(along_b));
        let at = |i: usize| {
            let t = i as f64 / CURVE_SEGMENTS as f64;
            let s = 1.0 - t;
            let sum = a.coords * (s * s * s)
                + p.coords * (3.0 * s * s * t)
                + q.coords * (3.0 * s * t * t)
                + b.coords * (t * t * t);
            Point::from(sum)
        };
        (0..=CURVE_SEGMENTS).map(at).collect()
    };
    // The ends may lie a little outside the block, because bands that share a joint lie next to each other.
    let most = polygon.distance(a).max(polygon.distance(b)) + INSIDE_TOL * polygon.area().sqrt();
    let stays = |points: &Vec<Point>| points.iter().all(|p| polygon.distance(*p) <= most);
    HANDLE_SHARES.into_iter().map(drawn).find(stays).unwrap_or_else(|| drawn(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Polygon {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let corners = corners.map(|(x, y)| Point::new(x, y)).to_vec();
        Polygon::new(corners, Vec::new()).expect("a square")
    }

    #[test]
    fn a_curve_does_not_leave_its_block() {
        let block = square();
        // Between two points near the upper edge, with directions that both lead up and out of the block.
        let up = Vector::new(0.3, 1.0).normalize();
        let ends = [(Point::new(0.0, 1.9), up), (Point::new(2.0, 1.95), Vector::new(1.0, -1.0).normalize())];
        let axis = curve(&block, ends);
        assert!(axis.iter().all(|p| block.distance(*p) <= 1e-5), "{axis:?}");
        // With enough space, the curve begins in the direction of the force.
        let ends = [(Point::new(0.5, 0.5), up), (Point::new(1.5, 1.5), up)];
        let axis = curve(&block, ends);
        let first = (axis[1] - axis[0]).normalize();
        assert!(first.y > 1.2 * first.x, "{first}");
    }

    #[test]
    fn a_band_at_an_edge_is_moved_into_its_block() {
        let mut axis = [Point::new(2.0, 1.0), Point::new(2.0, 2.0)];
        moved_inside(&square(), &mut axis, &[0.4, 0.4]);
        let moved = [Point::new(1.8, 1.0), Point::new(1.8, 1.8)];
        for (point, expected) in axis.iter().zip(moved) {
            assert!((point - expected).norm() < 1e-9, "{axis:?}");
        }
    }
}
