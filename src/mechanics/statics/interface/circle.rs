//! Finds the contacts of circles: a circle touches an edge, another circle or, if the scene has corner contacts, a corner
//! at one point, and the normal points to its centre.

use super::edge::MAX_GAP_PER_SIZE;
use super::join::JOIN_REACH;
use super::{ContactKind, Interface, Interfaces, NearMiss, bodies, ordered};
use crate::geometry::{Aabb, BoxIndex, Circle, Edge, Point, Vector, cross};
use crate::mechanics::scene::{BlockId, BodyId, Scene};

/// What a circle can touch.
enum Mark {
    /// An edge. True if the edge begins at a corner that is not reentrant, which comes after the edge `before`.
    Edge {
        edge: Edge,
        before: Vector,
    },
    Circle(Circle),
}

/// A part of an outline, with its body.
struct Part {
    body: BodyId,
    number: usize,
    mark: Mark,
}

/// A place where a circle touches or nearly touches.
#[derive(Clone, Copy)]
struct Touch {
    at: Point,
    /// Unit vector to the centre of the circle.
    normal: Vector,
    /// The distance of the two outlines, metres; negative if they overlap.
    gap: f64,
}

impl Touch {
    /// A touch at the middle of the gap. The vector `normal` points to the centre.
    fn new(circle: Circle, normal: Vector, gap: f64) -> Touch {
        Touch { at: circle.centre - normal * (circle.radius + 0.5 * gap), normal, gap }
    }
}

/// Adds the contacts of circles, and the small gaps beside them.
pub(super) fn find(scene: &Scene, found: &mut Interfaces) {
    let all = (0..scene.ground.len()).map(BodyId::Ground);
    let all = all.chain((0..scene.blocks.len()).map(|k| BodyId::Block(BlockId(k))));
    let circles: Vec<(BodyId, Circle)> = all.filter_map(|body| Some((body, scene.body(body).circle?))).collect();
    if circles.is_empty() {
        return;
    }
    let index = BoxIndex::new(parts(scene, &circles), |part| match part.mark {
        Mark::Edge { edge, .. } => edge.bounds(),
        Mark::Circle(circle) => around(circle),
    });
    for (body, circle) in circles {
        let reach = (2.0 * MAX_GAP_PER_SIZE * circle.radius).max(scene.body(body).gap);
        let mut near: Vec<&Part> = index.intersecting(around(circle).grown(reach)).collect();
        near.sort_unstable_by_key(|part| part.number);
        for parts in near.chunk_by(|a, b| a.body == b.body) {
            let other = parts[0].body;
            // Each pair of circles is compared once.
            if !matches!(parts[0].mark, Mark::Circle(_)) || other < body {
                add(scene, found, [body, other], reach, circle, parts);
            }
        }
    }
}

/// Returns the edges of all polygons, and the circles, grouped by their bodies.
fn parts(scene: &Scene, circles: &[(BodyId, Circle)]) -> Vec<Part> {
    let mut parts = Vec::new();
    for body in bodies(scene) {
        for ring in scene.body(body).polygon.rings() {
            let corner = |k: usize| ring[k % ring.len()];
            parts.extend((0..ring.len()).map(|k| Part {
                body,
                number: 0,
                mark: Mark::Edge {
                    edge: Edge { from: corner(k), to: corner(k + 1) },
                    before: corner(k) - corner(k + ring.len() - 1),
                },
            }));
        }
    }
    parts.extend(circles.iter().map(|(body, circle)| Part { body: *body, number: 0, mark: Mark::Circle(*circle) }));
    for (number, part) in parts.iter_mut().enumerate() {
        part.number = number;
    }
    parts
}

fn around(circle: Circle) -> Aabb {
    let point = [circle.centre.x, circle.centre.y];
    Aabb { min: point, max: point }.grown(circle.radius)
}

/// Adds the contacts of a circle with another body, and the gaps up to `reach` metres far from these contacts.
fn add(scene: &Scene, found: &mut Interfaces, pair: [BodyId; 2], reach: f64, circle: Circle, parts: &[&Part]) {
    let Some(bodies) = ordered(pair[0], pair[1]) else { return };
    let tolerance = scene.tolerance_between(pair[0], pair[1]).gap;
    let corners =
        parts.iter().filter(|_| scene.corner_contacts.on_edges()).filter_map(|part| at_corner(circle, part, tolerance));
    let touches = parts.iter().filter_map(|part| at_edge_or_circle(circle, part, tolerance)).chain(corners);
    let (touching, mut apart): (Vec<Touch>, Vec<Touch>) =
        touches.filter(|t| t.gap >= -tolerance && t.gap <= reach).partition(|t| t.gap <= tolerance);
    let mut kept: Vec<Touch> = Vec::new();
    for touch in touching {
        if kept.iter().any(|known| (known.at - touch.at).norm() <= JOIN_REACH * tolerance) {
            continue;
        }
        kept.push(touch);
        let normal = if bodies[0] == pair[0] { touch.normal } else { -touch.normal };
        let friction = scene.friction_at(bodies, normal);
        found.all.push(Interface { bodies, kind: ContactKind::Corner, ends: [touch.at; 2], normal, friction });
    }
    // Beside a contact, a round recess leaves narrow gaps that nobody drew as contacts.
    apart.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    for touch in apart {
        if kept.iter().all(|known| (known.at - touch.at).norm() > circle.radius) {
            kept.push(touch);
            found.near_misses.push(NearMiss { bodies, at: touch.at, distance: touch.gap });
        }
    }
}

/// Returns where a circle comes nearest to an edge, if this is between the ends of the edge, or to another circle.
fn at_edge_or_circle(circle: Circle, part: &Part, tolerance: f64) -> Option<Touch> {
    match part.mark {
        Mark::Circle(other) => {
            let normal = (circle.centre - other.centre).try_normalize(0.0)?;
            Some(Touch::new(circle, normal, other.distance(circle.centre) - circle.radius))
        }
        Mark::Edge { edge, .. } => {
            let (along, from) = (edge.vector(), circle.centre - edge.from);
            let length = along.norm();
            let place = along.dot(&from) / length;
            let outward = edge.outward();
            (place >= -tolerance && place <= length + tolerance)
                .then(|| Touch::new(circle, outward, outward.dot(&from) - circle.radius))
        }
    }
}

/// Returns where a circle comes nearest to the corner at which an edge begins; `None` if the corner is reentrant, or if
/// an edge is nearer.
fn at_corner(circle: Circle, part: &Part, tolerance: f64) -> Option<Touch> {
    let Mark::Edge { edge, before } = part.mark else { return None };
    let (after, from) = (edge.vector(), circle.centre - edge.from);
    let is_nearest = cross(before, after) > 0.0
        && after.dot(&from) < -tolerance * after.norm()
        && before.dot(&from) > tolerance * before.norm();
    let normal = from.try_normalize(0.0).filter(|_| is_nearest)?;
    Some(Touch::new(circle, normal, from.norm() - circle.radius))
}
