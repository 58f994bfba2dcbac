//! The geometry of the bands of a figure of force flow: paths along true lines of action, schematic curves, and the
//! outline of a band from its axis and its widths.
//!
//! A true path starts along the force at the first joint. Where it meets the line of action of a load or of the weight,
//! it continues along the resultant of both forces. It ends at the second joint, along the line of the force there. A
//! schematic curve stays in its block.

use crate::geometry::{Point, Polygon, Vector, cross, quarter_turn};
use crate::pictures::drawing::{Camera, Outline};

/// A line meets a point if their distance is at most this fraction of the block's size.
const LENGTH_TOL: f64 = 1e-6;
/// Two lines of action count as parallel if the sine of the angle between them is at most this value.
const PARALLEL_TOL: f64 = 1e-6;
/// Largest number of loads, including the weight, for which the function searches a path.
const MAX_ORDERED: usize = 4;

/// A force with a point on its line of action.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineOfAction {
    pub at: Point,
    /// The force on the block, N.
    pub force: Vector,
}

/// A path along true lines of action.
#[derive(Clone, Debug)]
pub(super) struct TruePath {
    /// The first joint, the corners in order, and the second joint.
    pub corners: Vec<Point>,
    /// The magnitude of the force along each segment between two corners, N.
    pub amounts: Vec<f64>,
    /// For each load, its index and the corner at which it joins the path.
    pub joins: Vec<(usize, Point)>,
}

/// Returns the path of the force from the first joint to the second. `loads` are the loads and the weight. The function
/// tries all orders in which the path can meet the loads. Returns `None` if there are more than [`MAX_ORDERED`] loads,
/// or if no path exists that stays in the block and never turns back.
pub(super) fn path(
    polygon: &Polygon,
    first: LineOfAction,
    second: LineOfAction,
    loads: &[LineOfAction],
) -> Option<TruePath> {
    if loads.len() > MAX_ORDERED {
        return None;
    }
    let size = polygon.area().sqrt();
    let search = Search { polygon, miss: LENGTH_TOL * size, second, loads };
    let start = TruePath { corners: vec![first.at], amounts: Vec::new(), joins: Vec::new() };
    search.onward(start, first.force)
}

struct Search<'a> {
    polygon: &'a Polygon,
    /// Largest distance at which a line still meets a point, or a corner of the path still lies in the block, metres.
    miss: f64,
    second: LineOfAction,
    loads: &'a [LineOfAction],
}

impl Search<'_> {
    /// Continues a path from its last corner, where the force is `force`, to the second joint, and tries all orders of
    /// the remaining loads. Returns `None` if no such path exists.
    fn onward(&self, path: TruePath, force: Vector) -> Option<TruePath> {
        let amount = force.norm();
        let at = *path.corners.last()?;
        if amount <= 0.0 {
            return None;
        }
        if path.joins.len() == self.loads.len() {
            return self.arrived(path, at, force);
        }
        let rest = |i: &usize| path.joins.iter().all(|join| join.0 != *i);
        (0..self.loads.len()).filter(rest).find_map(|i| {
            let load = self.loads[i];
            let corner = meeting(at, force, load.at, load.force)?;
            let forward = (corner - at).dot(&force) >= -self.miss * amount;
            if !forward || self.polygon.distance(corner) > self.miss {
                return None;
            }
            let next = force + load.force;
            let mut path = path.clone();
            path.corners.push(corner);
            path.amounts.push(amount);
            path.joins.push((i, corner));
            self.onward(path, next)
        })
    }

    /// Adds the last segment of a path, from `at` to the second joint. Returns `None` if the line of action of `force`
    /// through `at` does not lead to this joint.
    fn arrived(&self, mut path: TruePath, at: Point, force: Vector) -> Option<TruePath> {
        let way = self.second.at - at;
        let aside = cross(force, way) / force.norm();
        let forward = way.dot(&force) >= 0.0;
        if aside.abs() > self.miss.max(1e-4 * way.norm()) || !forward {
            return None;
        }
        path.corners.push(self.second.at);
        path.amounts.push(force.norm());
        Some(path)
    }
}

/// Returns the intersection of the line through `a` in the direction `along_a` and the line through `b` in the
/// direction `along_b`. Returns `b` if both lines are the same, and `None` if they are parallel but not the same.
fn meeting(a: Point, along_a: Vector, b: Point, along_b: Vector) -> Option<Point> {
    let sine = cross(along_a, along_b);
    if sine.abs() <= PARALLEL_TOL * along_a.norm() * along_b.norm() {
        let way = b - a;
        let aside = cross(along_a, way) / along_a.norm();
        return (aside.abs() <= LENGTH_TOL * way.norm()).then_some(b);
    }
    Some(a + along_a * (cross(b - a, along_b) / sine))
}

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

/// Largest width of a band at a corner, as a multiple of its width before and after the corner.
const MAX_MITRE: f64 = 1.6;

/// Returns the outline of a band along `axis` on the page. `widths` has the full width of the band at each point of the
/// axis, in metres. If a point occurs twice with different widths, the width changes abruptly there.
pub(super) fn ribbon(axis: &[Point], widths: &[f64], camera: &Camera) -> Outline {
    let points = 0..axis.len().min(widths.len());
    if axis.iter().all(|p| same(*p, axis[0])) {
        return Outline::default();
    }
    let side = |sign: f64| {
        let at = move |i: usize| camera.place(axis[i] + aside(axis, i) * (0.5 * sign * widths[i]));
        points.clone().map(at)
    };
    Outline::ring(side(1.0).chain(side(-1.0).rev()))
}

/// True if two points coincide, except for rounding.
fn same(a: Point, b: Point) -> bool {
    (a - b).norm() <= 1e-9 * (a.coords.norm() + b.coords.norm())
}

/// Returns a vector across the band at point `i` of the axis, pointing to the left. Its length is 1 on a straight part.
/// At a corner it is longer, so that the band keeps its width (a mitre).
fn aside(axis: &[Point], i: usize) -> Vector {
    let apart = |p: &&Point| !same(**p, axis[i]);
    let across = |along: Vector| quarter_turn(along / along.norm());
    let before = axis[..i].iter().rev().find(apart);
    let behind = axis[i..].iter().find(apart);
    match (before.map(|p| across(axis[i] - p)), behind.map(|p| across(p - axis[i]))) {
        (Some(before), Some(behind)) => {
            let sum = before + behind;
            let half = 0.5 * sum.norm();
            if half < 1e-9 {
                return before;
            }
            sum / sum.norm() * (1.0 / half).min(MAX_MITRE)
        }
        (before, behind) => before.or(behind).unwrap_or_else(Vector::zeros),
    }
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
