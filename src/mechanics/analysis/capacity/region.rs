//! Computes with convex sets of forces in the plane: convex hull, edges, distances and intersection with half-planes.

pub(super) use super::cone::SAME_DIRECTION;
use super::probe::{HalfPlane, Probe};
use super::refine::{self, Sample};
use super::request::Cases;
use super::{CapacityEdge, CapacityVertex, LoadCapacity, VertexForce, cone};
use crate::geometry::{Point, Vector, cross, in_half_plane, quarter_turn};
use crate::mechanics::analysis::condition::Condition;
use crate::mechanics::scene::BlockId;

/// Unbounded sets are cut off at this multiple of their size.
pub(super) const RAY_LENGTH_PER_SIZE: f64 = 1e5;

/// Builds the capacity of a block from samples of its boundary: vertices, edges and error bound.
pub(super) fn capacity(set: cone::SampledSet, probe: &Probe, block: BlockId, at: &[Point]) -> LoadCapacity {
    let cone::SampledSet { samples, rays } = set;
    let size = refine::size(&samples);
    let tolerance = refine::tolerance(probe, size);
    let forces: Vec<Vector> = samples.iter().map(|s| s.carried.force).collect();
    let corners = corners(&forces, &rays, tolerance);
    let vertices: Vec<CapacityVertex> = corners.iter().map(|k| vertex(&samples[*k], probe)).collect();
    let lines: Vec<CapacityEdge> = samples.iter().filter_map(|s| s.half_plane.as_ref()).map(edge_of).collect();
    let mut capacity = LoadCapacity {
        block,
        at: at.to_vec(),
        robot: None,
        vertices,
        rays,
        edges: Vec::new(),
        gap: 0.0,
        mechanism: Vec::new(),
        cases: 1,
        ranges: Cases::default(),
    };
    set_edges(&mut capacity, &lines, size.max(1e-3 * probe.heaviest()));
    capacity
}

/// Sets the edges and the error bound of a capacity. The edge for each side of the polygon is the half-plane of `lines`
/// whose boundary is nearest to this side.
pub(super) fn set_edges(capacity: &mut LoadCapacity, lines: &[CapacityEdge], size: f64) {
    let corners: Vec<Vector> = capacity.vertices.iter().map(|v| v.force).collect();
    let mut edges = Vec::new();
    for (ends, from, to) in sides(&corners, &capacity.rays, size) {
        let off = |line: &CapacityEdge| {
            let off = |force: Vector| (line.limit - line.normal.dot(&force)).abs();
            off(from).max(off(to))
        };
        let chord = to - from;
        let outward = Vector::new(chord.y, -chord.x);
        let faces = lines.iter().filter(|line| from == to || line.normal.dot(&outward) > 0.0);
        if let Some(line) = faces.min_by(|a, b| off(a).total_cmp(&off(b))) {
            edges.push(CapacityEdge { ends, ..line.clone() });
        }
    }
    capacity.gap = gap(&corners, &capacity.rays, lines, size);
    capacity.edges = edges;
}

fn vertex(sample: &Sample, probe: &Probe) -> CapacityVertex {
    let contacts = sample.carried.forces.contacts.iter().enumerate();
    CapacityVertex {
        force: sample.carried.force,
        torque: sample.carried.torque,
        contacts: contacts
            .map(|(k, forces)| VertexForce {
                interface: probe.interface(k),
                normal: forces.normal,
                friction: forces.friction,
            })
            .collect(),
        proof: Some(sample.carried.proof),
    }
}

fn edge_of(line: &HalfPlane) -> CapacityEdge {
    CapacityEdge {
        ends: [None; 2],
        normal: line.normal,
        limit: line.limit,
        mechanism: line.motion.clone(),
        proof: line.proof,
        case: 0,
        condition: Condition::default(),
    }
}

/// Returns the sides of a convex set, anticlockwise. Each side is given by the indices of its two vertices, `None`
/// where the side is unbounded, and by two points on it. On an unbounded side, one of these points is a corner, and the
/// other lies at the distance `size` from it.
pub(super) fn sides(corners: &[Vector], rays: &[Vector], size: f64) -> Vec<([Option<usize>; 2], Vector, Vector)> {
    let count = corners.len();
    let mut sides = Vec::new();
    if count == 0 {
        return sides;
    }
    let side = |k: usize, next: usize| ([Some(k), Some(next)], corners[k], corners[next]);
    if let Some(along) = opposite(rays) {
        // A half-plane has one side. A strip has two, and so has a line, which is a strip of width 0.
        sides.push(([None; 2], corners[0] - along * size, corners[0]));
        if rays.len() == 2 {
            let last = corners[count - 1];
            sides.push(([None; 2], last + along * size, last));
        }
        return sides;
    }
    match rays {
        [] => sides.extend((0..count).map(|k| side(k, (k + 1) % count))),
        [only] => {
            // The two unbounded edges are parallel.
            sides.push(([None, Some(0)], corners[0] + only * size, corners[0]));
            sides.extend((1..count).map(|k| side(k - 1, k)));
            let last = corners[count - 1];
            sides.push(([Some(count - 1), None], last, last + only * size));
        }
        [first, second, ..] => {
            let last = corners[count - 1];
            sides.push(([None, Some(0)], corners[0] + second * size, corners[0]));
            sides.extend((1..count).map(|k| side(k - 1, k)));
            sides.push(([Some(count - 1), None], last, last + first * size));
        }
    }
    sides
}

/// Returns the first ray if the last ray is its opposite; otherwise `None`. With two such rays, the set is a line or a
/// strip; with three, it is a half-plane to the left of the first ray.
pub(super) fn opposite(rays: &[Vector]) -> Option<Vector> {
    match rays {
        [first, .., last] if rays.len() < 4 => ((first + last).norm() <= SAME_DIRECTION).then_some(*first),
        _ => None,
    }
}

/// Returns the indices of the forces that are corners of the convex hull of `forces` and `rays`, anticlockwise. If the
/// hull is unbounded, the list begins after the unbounded side. A corner within about `tolerance` of the rest of the
/// hull may be left out. The corner of a half-plane or of a line is a force on its boundary; a strip has one on each
/// side.
pub(super) fn corners(forces: &[Vector], rays: &[Vector], tolerance: f64) -> Vec<usize> {
    if forces.is_empty() || rays.len() > 3 {
        return Vec::new();
    }
    if let Some(along) = opposite(rays) {
        let height = |k: &usize| cross(along, forces[*k]);
        let mut order: Vec<usize> = (0..forces.len()).collect();
        order.sort_by(|a, b| height(a).total_cmp(&height(b)));
        let (lowest, highest) = (order[0], order[order.len() - 1]);
        let is_strip = rays.len() == 2 && height(&highest) - height(&lowest) > tolerance;
        return if is_strip { vec![lowest, highest] } else { vec![lowest] };
    }
    let extent = forces.iter().map(|f| (f - forces[0]).norm());
    let far = RAY_LENGTH_PER_SIZE * extent.fold(1e6 * tolerance, f64::max);
    let mut points: Vec<(Vector, Option<usize>)> = forces.iter().enumerate().map(|(k, f)| (*f, Some(k))).collect();
    for ray in rays {
        points.extend(forces.iter().map(|f| (f + ray * far, None)));
    }
    let mut ring = hull(points);
    simplify(&mut ring, tolerance);
    // Far points represent the rays. Begin with the first corner after them.
    let is_far = |k: usize| ring[k % ring.len()].1.is_none();
    let first = (0..ring.len()).find(|k| is_far(*k) && !is_far(k + 1));
    let count = ring.len();
    let start = first.map_or(0, |k| k + 1);
    (0..count).filter_map(|k| ring[(start + k) % count].1).collect()
}

/// Returns the convex hull of points, anticlockwise, by Andrew's monotone chain (1979). Each point keeps its tag.
fn hull(mut points: Vec<(Vector, Option<usize>)>) -> Vec<(Vector, Option<usize>)> {
    points.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup_by(|(a, _), (b, _)| a == b);
    if points.len() < 3 {
        return points;
    }
    let mut ring: Vec<(Vector, Option<usize>)> = Vec::new();
    for pass in 0..2 {
        let base = ring.len();
        for point in &points {
            while ring.len() >= base + 2 {
                let [a, b] = [ring[ring.len() - 2].0, ring[ring.len() - 1].0];
                if cross(b - a, point.0 - b) > 0.0 {
                    break;
                }
                ring.pop();
            }
            ring.push(*point);
        }
        ring.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    ring
}

/// Removes corners that lie within a quarter of the tolerance of the segment between their neighbours. The corner
/// nearest to its segment is removed first. Points without an index, which represent rays, stay.
fn simplify(ring: &mut Vec<(Vector, Option<usize>)>, tolerance: f64) {
    while ring.len() > 1 {
        let count = ring.len();
        let height = |k: &usize| {
            let [before, at, after] = [count - 1, 0, 1].map(|step| ring[(k + step) % count].0);
            match count {
                2 => (at - after).norm(),
                _ => to_segment(at, before, after),
            }
        };
        let lowest = (0..count).filter(|k| ring[*k].1.is_some()).min_by(|a, b| height(a).total_cmp(&height(b)));
        match lowest.filter(|k| height(k) <= 0.25 * tolerance) {
            Some(k) => ring.remove(k),
            None => break,
        };
    }
}

/// Returns the distance between a point and a line segment.
pub(super) fn to_segment(point: Vector, a: Vector, b: Vector) -> f64 {
    let along = b - a;
    let square = along.norm_squared();
    let share = match square {
        0.0 => 0.0,
        _ => ((point - a).dot(&along) / square).clamp(0.0, 1.0),
    };
    (point - a - along * share).norm()
}

/// Returns the four corners of a square around a force, anticlockwise. `half` is half the length of a side.
pub(super) fn square(centre: Vector, half: f64) -> Vec<Vector> {
    let corner = |x: f64, y: f64| centre + Vector::new(x, y) * half;
    vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
}

/// Returns the error bound of a set, N: the largest distance between the set and a force that satisfies all half-planes
/// `lines`. Only forces within a square of side 8 · `size` around the first corner are compared.
fn gap(corners: &[Vector], rays: &[Vector], lines: &[CapacityEdge], size: f64) -> f64 {
    let Some(first) = corners.first() else {
        return 0.0;
    };
    let mut outer = square(*first, 4.0 * size);
    for line in lines {
        outer = in_half_plane(&outer, |force| line.normal.dot(force) - line.limit);
    }
    let inner = bounded_polygon(corners, rays, 100.0 * size);
    outer.iter().map(|force| distance(&inner, *force)).fold(0.0, f64::max)
}

/// Returns the distance between a force and a convex polygon; 0 if the force lies inside.
pub(super) fn distance(ring: &[Vector], force: Vector) -> f64 {
    let count = ring.len();
    let edges = || (0..count).map(|k| (ring[k], ring[(k + 1) % count]));
    if count > 2 && edges().all(|(a, b)| cross(b - a, force - a) >= 0.0) {
        return 0.0;
    }
    let near = edges().map(|(a, b)| to_segment(force, a, b));
    near.fold(f64::INFINITY, f64::min)
}

/// Returns a bounded convex polygon: the convex hull of the corners and of the corners moved by `far` along each ray.
pub(super) fn bounded_polygon(corners: &[Vector], rays: &[Vector], far: f64) -> Vec<Vector> {
    let mut rays = rays.to_vec();
    if let [first, second] = rays[..]
        && opposite(&rays).is_none()
    {
        // Without a ray in the middle, the polygon of two almost opposite rays would be almost flat.
        rays.push((first + second).normalize());
    }
    let mut points: Vec<(Vector, Option<usize>)> = corners.iter().map(|f| (*f, None)).collect();
    for ray in rays {
        points.extend(corners.iter().map(|f| (f + ray * far, None)));
    }
    hull(points).into_iter().map(|p| p.0).collect()
}

/// Returns half-planes normal · F ≤ limit, as (normal, limit), whose intersection is the convex hull of the corners,
/// extended along the rays. `slack` is added to each limit. An unbounded set is cut off at a distance of about `far`,
/// unless it is a half-plane, a strip or a line.
pub(super) fn half_planes(corners: &[Vector], rays: &[Vector], far: f64, slack: f64) -> Vec<(Vector, f64)> {
    let side = |from: Vector, outward: Vector| {
        let normal = outward.normalize();
        (normal, normal.dot(&from) + slack)
    };
    if opposite(rays).is_some() {
        let sides = sides(corners, rays, 1.0).into_iter();
        let sides = sides.map(|(_, from, to)| side(to, -quarter_turn(to - from)));
        return sides.collect();
    }
    match bounded_polygon(corners, rays, far)[..] {
        [] => Vec::new(),
        [point] => axes().map(|axis| side(point, axis)).to_vec(),
        [a, b] => {
            let along = b - a;
            let across = quarter_turn(along);
            vec![side(a, across), side(a, -across), side(a, -along), side(b, along)]
        }
        ref ring => (0..ring.len())
            .map(|k| {
                let (from, to) = (ring[k], ring[(k + 1) % ring.len()]);
                side(from, -quarter_turn(to - from))
            })
            .collect(),
    }
}

/// Returns the four unit vectors along the coordinate axes, anticlockwise from the right.
pub(super) fn axes() -> [Vector; 4] {
    [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Vector::new(x, y))
}
