//! Finds corner contacts: a corner touches an edge or another corner, and the two bodies have no edge interface there.
//!
//! Vallat (2023) omits corner contacts as unreliable; a scene requests them with `"corner_contacts": true`, or with
//! `"on_edges"` only those of a corner with an edge. If a corner touches an edge, the normal is that of the edge. If two
//! corners touch, the normal has the direction of the difference of their inward unit bisectors.

use std::collections::BTreeMap;

use super::edge::PARALLEL_TOL;
use super::join::JOIN_REACH;
use super::{ContactKind, Interface, bodies, ordered};
use crate::geometry::{Aabb, BoxIndex, Edge, Point, Vector, cross};
use crate::mechanics::scene::{BodyId, Scene};

/// The tolerance on a lattice, as a fraction of its side. Any small fraction suffices: points are equal or at least
/// half a side apart.
const LATTICE_TOLERANCE_PER_SIDE: f64 = 1e-6;

/// A corner with the two sides that meet in it.
struct Tip {
    body: BodyId,
    at: Point,
    /// The vector of the side that ends at this corner.
    before: Vector,
    /// The vector of the side that begins at this corner.
    after: Vector,
}

impl Tip {
    /// True if the inner angle of the corner is less than 180°.
    fn is_convex(&self) -> bool {
        cross(self.before, self.after) > 0.0
    }

    /// Returns the unit vector along the bisector of the corner. The vector points into the material.
    fn inward(&self) -> Vector {
        let along = (self.before.normalize() + self.after.normalize()).normalize();
        Vector::new(-along.y, along.x)
    }
}

/// A corner and the side of the outline that begins at this corner.
struct CornerSide {
    /// Its index among all corners of the scene.
    number: usize,
    side: Edge,
    tip: Tip,
}

/// Finds all corner contacts that are not part of the edge interfaces in `known`.
pub(super) fn find(scene: &Scene, known: &[Interface]) -> Vec<Interface> {
    let tolerance_between = |a: BodyId, b: BodyId| match (&scene.lattice, scene.exact) {
        (Some(lattice), true) => LATTICE_TOLERANCE_PER_SIDE * lattice.side,
        _ => scene.tolerance_between(a, b).gap,
    };
    let index = BoxIndex::new(corner_sides(scene), |place| place.side.bounds());
    // Go through the corners in the order of the scene. If several corners of two bodies are at the same point, the
    // first of them becomes the contact.
    let mut places: Vec<&CornerSide> = index.all().map(|(_, place)| place).collect();
    places.sort_unstable_by_key(|place| place.number);
    let mut found: Vec<Interface> = Vec::new();
    // The ends of all contacts, grouped by the pair of bodies, because hundreds of wedges may meet at one point.
    let mut ends_of_pair: BTreeMap<[BodyId; 2], Vec<[Point; 2]>> = BTreeMap::new();
    for interface in known {
        let ends = ends_of_pair.entry(interface.bodies).or_default();
        ends.push(interface.ends);
    }
    for place in places.into_iter().filter(|p| p.tip.is_convex()) {
        let (tip, at) = (&place.tip, place.tip.at);
        let reach = tolerance_between(tip.body, tip.body);
        let point = [at.x, at.y];
        let query = Aabb { min: point, max: point };
        let mut candidates: Vec<&CornerSide> = index.intersecting(query.grown(reach)).collect();
        candidates.sort_unstable_by_key(|candidate| candidate.number);
        for other in candidates {
            let Some(pair) = ordered(tip.body, other.tip.body).filter(|_| tip.body != other.tip.body) else {
                continue;
            };
            let tolerance = tolerance_between(pair[0], pair[1]);
            let Some(into_tip) = normal(tip, other, tolerance, scene.corner_contacts.on_corners()) else {
                continue;
            };
            let ends = ends_of_pair.entry(pair).or_default();
            let is_covered = ends.iter().any(|ends| distance_to_segment(at, *ends) <= JOIN_REACH * tolerance);
            if !is_covered {
                ends.push([at, at]);
                let normal = if pair[0] == tip.body { into_tip } else { -into_tip };
                let friction = scene.friction_at(pair, normal);
                found.push(Interface { bodies: pair, kind: ContactKind::Corner, ends: [at, at], normal, friction });
            }
        }
    }
    found
}

/// Returns all corners of a scene, each with the side that begins at the corner.
fn corner_sides(scene: &Scene) -> Vec<CornerSide> {
    let mut places = Vec::new();
    for body in bodies(scene) {
        for ring in scene.body(body).polygon.rings() {
            for i in 0..ring.len() {
                let (before, at, after) =
                    (ring[(i + ring.len() - 1) % ring.len()], ring[i], ring[(i + 1) % ring.len()]);
                let tip = Tip { body, at, before: at - before, after: after - at };
                places.push(CornerSide { number: places.len(), side: Edge { from: at, to: after }, tip });
            }
        }
    }
    places
}

/// Returns the unit normal that points into the body of `tip`, if `tip` touches the corner of `other` or the interior
/// of the side that begins there. `None` if they do not touch, or if two touching corners have no defined normal or carry
/// no force.
fn normal(tip: &Tip, other: &CornerSide, tolerance: f64, do_tips_carry: bool) -> Option<Vector> {
    if (other.side.from - tip.at).norm() <= tolerance {
        let between = tip.inward() - other.tip.inward();
        // Two corners that point in the same direction have no normal.
        return (do_tips_carry && between.norm() > PARALLEL_TOL).then(|| between.normalize());
    }
    let along = other.side.vector();
    let length = along.norm();
    let s = along.dot(&(tip.at - other.side.from)) / length;
    let is_between_ends = s > tolerance && s < length - tolerance;
    (is_between_ends && cross(along, tip.at - other.side.from).abs() <= tolerance * length)
        .then(|| other.side.outward())
}

/// Returns the distance of a point from a segment. The two ends of the segment may be equal.
fn distance_to_segment(p: Point, ends: [Point; 2]) -> f64 {
    let along = ends[1] - ends[0];
    let square = along.norm_squared();
    let s = if square > 0.0 { (along.dot(&(p - ends[0])) / square).clamp(0.0, 1.0) } else { 0.0 };
    (p - (ends[0] + along * s)).norm()
}
