//! [`path`]: finds the path of the force through a block from one joint to another, along true lines of action.
//!
//! The path starts along the force at the first joint. Where it meets the line of action of a load or of the weight,
//! it continues along the resultant of both forces. It ends at the second joint, along the line of the force there.

use crate::geometry::{Point, Polygon, Vector, cross};

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
