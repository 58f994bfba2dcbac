//! Corner contacts: a tip on an edge, or on another tip, where no edge interface of the same pair already reaches.
//!
//! The source leaves them out as unreliable; a scene asks for them with `"corner_contacts": true`. Normal of a tip on an
//! edge: the edge's. Of a tip on a tip: the bisector of the two corners' own bisectors.

use rstar::{AABB, RTree, RTreeObject};

use super::{ContactKind, Interface, bodies, ordered};
use crate::geometry::{Edge, Point, Vector, cross};
use crate::scene::{BodyId, Scene};

/// A corner with the two sides that meet in it.
struct Tip {
    body: BodyId,
    at: Point,
    before: Vector,
    after: Vector,
}

impl Tip {
    /// Whether material fills less than a half turn.
    fn is_convex(&self) -> bool {
        cross(self.before, self.after) > 0.0
    }

    /// Unit vector along the corner's bisector into the material.
    fn inward(&self) -> Vector {
        let along = (self.before.normalize() + self.after.normalize()).normalize();
        Vector::new(-along.y, along.x)
    }
}

struct Place {
    side: Edge,
    tip: Tip,
}

impl RTreeObject for Place {
    type Envelope = AABB<[f64; 2]>;
    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(
            [self.side.from.x, self.side.from.y],
            [self.side.to.x, self.side.to.y],
        )
    }
}

/// All corner contacts beside the edge interfaces already known.
pub(super) fn find(scene: &Scene, known: &[Interface]) -> Vec<Interface> {
    // On a lattice points are equal or at least half a side apart; any small length serves.
    let near_of = |a: BodyId, b: BodyId| match (&scene.lattice, scene.exact) {
        (Some(lattice), true) => 1e-6 * lattice.side,
        _ => scene.tolerance_between(a, b).gap,
    };
    let tree = RTree::bulk_load(places(scene));
    let mut found: Vec<Interface> = Vec::new();
    for place in tree.iter().filter(|p| p.tip.is_convex()) {
        let (tip, at) = (&place.tip, place.tip.at);
        let near = near_of(tip.body, tip.body);
        let around = AABB::from_corners([at.x - near, at.y - near], [at.x + near, at.y + near]);
        for other in tree.locate_in_envelope_intersecting(around) {
            let Some(pair) =
                ordered(tip.body, other.tip.body).filter(|_| tip.body != other.tip.body)
            else {
                continue;
            };
            let near = near_of(pair[0], pair[1]);
            let Some(into_tip) = normal(tip, other, near) else {
                continue;
            };
            let covered = known
                .iter()
                .chain(&found)
                .filter(|i| i.bodies == pair)
                .any(|i| distance(at, i.ends) <= 4.0 * near);
            if !covered {
                let normal = if pair[0] == tip.body {
                    into_tip
                } else {
                    -into_tip
                };
                let friction = scene.friction_between(pair[0], pair[1]);
                found.push(Interface {
                    bodies: pair,
                    kind: ContactKind::Corner,
                    ends: [at, at],
                    normal,
                    friction,
                });
            }
        }
    }
    found
}

fn places(scene: &Scene) -> Vec<Place> {
    let mut places = Vec::new();
    for body in bodies(scene) {
        for ring in scene.body(body).polygon.rings() {
            for i in 0..ring.len() {
                let (before, at, after) = (
                    ring[(i + ring.len() - 1) % ring.len()],
                    ring[i],
                    ring[(i + 1) % ring.len()],
                );
                let tip = Tip {
                    body,
                    at,
                    before: at - before,
                    after: after - at,
                };
                places.push(Place {
                    side: Edge {
                        from: at,
                        to: after,
                    },
                    tip,
                });
            }
        }
    }
    places
}

/// The normal into the tip's body where `tip` touches the corner or the inside of the side of `other`.
fn normal(tip: &Tip, other: &Place, near: f64) -> Option<Vector> {
    if (other.side.from - tip.at).norm() <= near {
        let between = tip.inward() - other.tip.inward();
        return (between.norm() > 1e-9).then(|| between.normalize());
    }
    let along = other.side.vector();
    let length = along.norm();
    let s = along.dot(&(tip.at - other.side.from)) / length;
    let inside = s > near && s < length - near;
    (inside && cross(along, tip.at - other.side.from).abs() <= near * length)
        .then(|| other.side.outward())
}

fn distance(p: Point, ends: [Point; 2]) -> f64 {
    let along = ends[1] - ends[0];
    let square = along.norm_squared();
    let s = if square > 0.0 {
        (along.dot(&(p - ends[0])) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - (ends[0] + along * s)).norm()
}
