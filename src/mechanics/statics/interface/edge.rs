//! Interfaces of scenes off the lattice: edges of two bodies that face each other within the scene's tolerance.
//!
//! 1. A bounding-volume hierarchy over position and direction returns the pairs of edges that may face each other.
//! 2. [`compare`] decides for each pair: common stretch, too short, or apart.
//! 3. Stretches of the same two bodies that continue each other are joined ([`join`](super::join)).
//! 4. Gaps that a stone keeps open are found ([`pinned`](super::pinned)).

use super::join::{JOIN_REACH, join_stretches};
use super::notice::Notices;
use super::open_stretch::{OpenStretch, without_outline};
use super::pinned::{MAX_PINNED_SIZE_PER_GAP, pinned_gaps};
use super::{ContactKind, Interface, Interfaces, NearMiss, bodies, normal_across, ordered};
use crate::geometry::{Aabb, BoxIndex, Edge, Point, Tolerance, Vector, cross};
use crate::scene::{BodyId, Scene, ToleranceSource, size};

/// Edges that are farther apart than this many gaps are not mentioned in a notice.
const MAX_REPORTED_GAPS: f64 = 30.0;

/// Edges whose directions differ by less than this, in radians, count as parallel however small the gap is.
///
/// Directions of short edges are rounded to about 10⁻¹²; the value leaves a reserve for edges far from the origin.
const PARALLEL_TOL: f64 = 1e-9;

/// The value of [`direction`] after a full turn.
const FULL_TURN: f64 = 4.0;

/// Edges with a gap above this fraction of a block's size are not near misses: they were not drawn to touch.
const MAX_GAP_PER_SIZE: f64 = 0.01;

/// Common stretches up to this fraction of the tolerance's shortest contact are not even reported as too short.
///
/// They are the rounding of a corner that touches the end of an edge.
const CORNER_ROUNDING: f64 = 1e-3;

/// An edge longer than this fraction of a block's size (four times its area over its boundary) is a side on which it may
/// have been meant to lie; a shorter one is part of a rounded outline.
///
/// The shortest side of a slender column is just over half its size, an edge of a round stone of 20 corners a sixth.
const LONG_SIDE_PER_SIZE: f64 = 0.5;

/// If a tolerance is given, a stretch that covers this fraction of the shorter edge is a contact, however short the edge.
///
/// Ten times this is more than an edge has. A tenth would count two bricks that touch at their chamfers by a hair.
const CONTACT_PER_EDGE: f64 = 0.5;

/// Edges shorter than this fraction of a given tolerance are what healing leaves of two corners in one place, not edges.
///
/// Ten times this would drop the edges of a circle of 100 000 corners; a tenth comes near the rounding of numbers.
const MIN_EDGE_PER_TOLERANCE: f64 = 1e-6;

/// An edge of a body.
struct Side {
    body: BodyId,
    /// Its index among the body's edges.
    number: usize,
    edge: Edge,
    /// Edges of other bodies at a larger distance are ignored, metres.
    search_distance: f64,
}

impl Side {
    /// Bounds of the edge in x, y and direction.
    ///
    /// The range of directions contains each edge that may face this one within the smaller of both angle tolerances.
    /// Without the direction, the boxes of an arch's thin inclined stones overlap by the hundred; with it they do not,
    /// because each joint has a direction of its own.
    fn bounds(&self) -> Aabb<3> {
        let along = self.edge.vector();
        let angle =
            (2.0 * self.search_distance / along.norm()).clamp(PARALLEL_TOL, Tolerance::MAX_ANGLE);
        // `compare` tests the sine, which is smaller than the angle by less than a thousandth. `direction` grows by at
        // most 1 per radian.
        let angle = 1.001 * angle;
        let (position, direction) = (self.edge.bounds(), direction(along));
        Aabb {
            min: [position.min[0], position.min[1], direction - angle],
            max: [position.max[0], position.max[1], direction + angle],
        }
    }

    /// Query boxes for edges that face this one: opposite direction, within the search distance.
    ///
    /// Directions are periodic. Near 0 and [`FULL_TURN`] two boxes are needed.
    fn facing(&self) -> impl Iterator<Item = Aabb<3>> {
        let mut bounds = self.bounds();
        for d in 0..2 {
            bounds.min[d] -= self.search_distance;
            bounds.max[d] += self.search_distance;
        }
        let opposite = [-0.5 * FULL_TURN, 0.5 * FULL_TURN].map(|by| {
            let mut turned = bounds;
            turned.min[2] += by;
            turned.max[2] += by;
            turned
        });
        let margin = 2.0 * Tolerance::MAX_ANGLE;
        let is_needed =
            move |bounds: &Aabb<3>| bounds.max[2] >= -margin && bounds.min[2] <= FULL_TURN + margin;
        opposite.into_iter().filter(is_needed)
    }
}

/// A monotonic measure of a vector's direction without trigonometry: 0 to 4 anticlockwise from the x axis, 1 per quadrant.
fn direction(v: Vector) -> f64 {
    let part = v.y.abs() / (v.x.abs() + v.y.abs());
    match (v.x >= 0.0, v.y >= 0.0) {
        (true, true) => part,
        (false, true) => 2.0 - part,
        (false, false) => 2.0 + part,
        (true, false) => FULL_TURN - part,
    }
}

/// How two edges that face each other lie.
enum Relation {
    /// They touch along a stretch; the number is their largest distance along it, metres.
    Touching(Interface, f64),
    /// They touch along a stretch that is too short for an interface.
    TooShort(Interface),
    /// They do not touch along this stretch.
    Apart(OpenStretch),
}

/// Two bodies, the numbers of two of their edges, and how these lie.
type Pair = ([BodyId; 2], [usize; 2], Relation);

/// All edge interfaces of a scene, and everything that nearly is one.
pub(super) fn find(scene: &Scene) -> Interfaces {
    let (sides, smallest) = sides(scene);
    let index = BoxIndex::new(sides, Side::bounds);
    let mut pairs: Vec<Pair> = Vec::with_capacity(2 * scene.blocks.len());
    let sides = index.all().map(|(_, side)| side);
    for a in sides.filter(|a| matches!(a.body, BodyId::Block(_))) {
        for b in a.facing().flat_map(|query| index.intersecting(query)) {
            let Some(bodies) =
                ordered(a.body, b.body).filter(|p| p[0] == a.body && a.body != b.body)
            else {
                continue;
            };
            if let Some(relation) = compare(scene, bodies, a, b) {
                pairs.push((bodies, [a.number, b.number], relation));
            }
        }
    }
    // The index returns edges in no particular order; results must not depend on it.
    pairs.sort_unstable_by_key(|pair| (pair.0, pair.1));
    collect(scene, pairs, &index, smallest)
}

/// All edges of a scene, and the size of its smallest block, metres.
fn sides(scene: &Scene) -> (Vec<Side>, f64) {
    let count = |body: BodyId| {
        (scene.body(body).polygon.rings().iter())
            .map(Vec::len)
            .sum::<usize>()
    };
    let mut sides: Vec<Side> = Vec::with_capacity(bodies(scene).map(count).sum());
    let mut smallest = f64::INFINITY;
    for body in bodies(scene) {
        let (polygon, gap) = (&scene.body(body).polygon, scene.body(body).gap);
        let search_distance = match body {
            BodyId::Block(_) => {
                let size = size(polygon);
                smallest = smallest.min(size);
                (MAX_GAP_PER_SIZE * size).max(gap)
            }
            BodyId::Ground(_) => f64::INFINITY,
        };
        sides.extend((polygon.edges().enumerate()).map(|(number, edge)| Side {
            body,
            number,
            edge,
            search_distance,
        }));
    }
    (sides, smallest)
}

/// Sorts the pairs of edges, grouped by their bodies, into interfaces, near misses and slivers.
fn collect(
    scene: &Scene,
    pairs: Vec<Pair>,
    sides: &BoxIndex<Side, 3>,
    smallest: f64,
) -> Interfaces {
    let mut notices = Notices::default();
    let (mut all, mut near_misses) = (Vec::with_capacity(pairs.len()), Vec::new());
    let (mut slivers, mut open_joints) = (Vec::new(), Vec::new());
    let mut pairs = pairs.into_iter().peekable();
    while let Some(bodies) = pairs.peek().map(|pair| pair.0) {
        let tolerance = scene.tolerance_between(bodies[0], bodies[1]);
        let first = all.len();
        let mut open = Vec::new();
        while let Some((_, _, relation)) = pairs.next_if(|pair| pair.0 == bodies) {
            match relation {
                Relation::Touching(interface, distance) => {
                    // Only a gap that some stone of the scene can fill may be kept open by a stone.
                    if distance > 0.0 && MAX_PINNED_SIZE_PER_GAP * distance >= smallest {
                        open_joints.push(NearMiss {
                            bodies,
                            at: interface.middle(),
                            distance,
                        });
                    }
                    all.push(interface);
                }
                Relation::TooShort(interface) => {
                    notices.add_short(interface.length(), tolerance);
                    if interface.length() > tolerance.rounding {
                        slivers.push(interface);
                    }
                }
                Relation::Apart(stretch) => open.push(stretch),
            }
        }
        if all.len() > first + 1 {
            let stretches = all.split_off(first);
            all.extend(join_stretches(stretches, tolerance));
        }
        if open.is_empty() {
            continue;
        }
        let touching = touching_points(scene, bodies, &all[first..], sides);
        let longest = longest_outline_edge(scene, bodies);
        for gap in without_outline(open, touching, tolerance, scene.misfit, longest) {
            if gap.distance() <= MAX_REPORTED_GAPS * tolerance.gap {
                notices.add_apart(scene, bodies, gap.distance());
            }
            near_misses.push(NearMiss {
                bodies,
                at: gap.at,
                distance: gap.distance(),
            });
        }
    }
    let pinned_gaps = pinned_gaps(scene, &all, &open_joints);
    Interfaces {
        all,
        near_misses,
        slivers,
        pinned_gaps,
        notices: notices.into_sentences(scene.tolerance),
    }
}

/// The length in metres up to which an edge may be part of a rounded outline of either body.
fn longest_outline_edge(scene: &Scene, bodies: [BodyId; 2]) -> f64 {
    let of_body = |body: &BodyId| match body {
        BodyId::Block(_) => LONG_SIDE_PER_SIZE * size(&scene.body(*body).polygon),
        BodyId::Ground(_) => f64::INFINITY,
    };
    bodies.iter().map(of_body).fold(f64::INFINITY, f64::min)
}

/// Where two bodies touch: the ends of their interfaces, or the only corner of the first body that touches the second.
fn touching_points(
    scene: &Scene,
    bodies: [BodyId; 2],
    interfaces: &[Interface],
    sides: &BoxIndex<Side, 3>,
) -> Vec<Point> {
    if !interfaces.is_empty() {
        return interfaces.iter().flat_map(|i| i.ends).collect();
    }
    only_touching_corner(scene, bodies, sides)
        .into_iter()
        .collect()
}

/// The only corner of the first body that touches the second; `None` if there is none, or several in different places.
fn only_touching_corner(
    scene: &Scene,
    bodies: [BodyId; 2],
    sides: &BoxIndex<Side, 3>,
) -> Option<Point> {
    let gap = scene.tolerance_between(bodies[0], bodies[1]).gap;
    let touches = |at: &Point| {
        // Any direction: the range exceeds a full turn.
        let query = Aabb {
            min: [at.x - gap, at.y - gap, -FULL_TURN],
            max: [at.x + gap, at.y + gap, 2.0 * FULL_TURN],
        };
        let candidates = sides.intersecting(query);
        let mut candidates = candidates.filter(|side| side.body == bodies[1]);
        candidates.any(|side| {
            let along = side.edge.vector();
            let share = along.dot(&(at - side.edge.from)) / along.norm_squared();
            let foot = side.edge.from + along * share.clamp(0.0, 1.0);
            (at - foot).norm() <= gap
        })
    };
    let corners = scene.body(bodies[0]).polygon.rings().iter().flatten();
    let mut touching = corners.filter(|at| touches(at));
    let first = *touching.next()?;
    touching
        .all(|at| (at - first).norm() <= JOIN_REACH * gap)
        .then_some(first)
}

/// How edge `a` of the first body and edge `b` of the second lie; `None` if they do not face each other.
fn compare(scene: &Scene, bodies: [BodyId; 2], a: &Side, b: &Side) -> Option<Relation> {
    let search_distance = a.search_distance.min(b.search_distance);
    let (a, b) = (a.edge, b.edge);
    let (va, vb) = (a.vector(), b.vector());
    if va.dot(&vb) >= 0.0 {
        return None;
    }
    // Are they parallel? Rounding by one gap at either end turns a short edge more than a long one.
    let (la, lb) = (va.norm(), vb.norm());
    let tolerance = scene.tolerance_between(bodies[0], bodies[1]);
    let is_parallel_within = |gap: f64| {
        let angle = (2.0 * gap / la.min(lb)).clamp(PARALLEL_TOL, tolerance.angle);
        cross(va, vb).abs() <= angle * la * lb
    };
    if !is_parallel_within(search_distance) {
        return None;
    }
    // The stretch from s0 to s1 that both cover, measured along their mean direction from the start of `a`.
    let along = (va - vb).normalize();
    let place = |p: Point| along.dot(&(p - a.from));
    let (a0, a1, b0, b1) = (0.0, place(a.to), place(b.to), place(b.from));
    let (s0, s1) = (f64::max(a0, b0), f64::min(a1, b1));
    let length = s1 - s0;
    if length < -tolerance.min_length {
        return None;
    }
    // The distance from `a` to `b` at the two ends of the stretch.
    let outward = Vector::new(along.y, -along.x);
    let height = |e: Edge, s: f64| {
        let (h0, h1) = (
            outward.dot(&(e.from - a.from)),
            outward.dot(&(e.to - a.from)),
        );
        let (t0, t1) = (place(e.from), place(e.to));
        h0 + (h1 - h0) * ((s - t0) / (t1 - t0)).clamp(0.0, 1.0)
    };
    let (gap0, gap1) = (height(b, s0) - height(a, s0), height(b, s1) - height(a, s1));
    // The line halfway between the two edges.
    let middle = |s: f64| a.from + along * s + outward * ((height(a, s) + height(b, s)) / 2.0);
    let distance = gap0.abs().max(gap1.abs());
    if distance > tolerance.gap {
        let is_near_miss =
            gap0.min(gap1) >= -tolerance.gap && distance <= search_distance && length > distance;
        let at = a.from + along * ((s0 + s1) / 2.0);
        let ends = [(s0, gap0), (s1, gap1)].map(|(s, gap)| (middle(s), gap.abs()));
        return is_near_miss.then_some(Relation::Apart(OpenStretch::new(ends, at)));
    }
    if !is_parallel_within(tolerance.gap) {
        return None;
    }
    let is_short = length <= min_contact_length(scene, tolerance, la.min(lb));
    if is_short && length <= CORNER_ROUNDING * tolerance.min_length {
        return None;
    }
    // The first body lies to the left of `along`, so that (−n_y, n_x) points in the opposite direction.
    let ends = [middle(s1), middle(s0)];
    let interface = Interface {
        bodies,
        kind: ContactKind::Edge,
        ends,
        normal: normal_across(ends),
        friction: scene.friction_between(bodies[0], bodies[1]),
    };
    Some(match is_short {
        true => Relation::TooShort(interface),
        false => Relation::Touching(interface, distance),
    })
}

/// The length in metres that two edges must have in common to form an interface; `edge` is the shorter edge's length.
fn min_contact_length(scene: &Scene, tolerance: Tolerance, edge: f64) -> f64 {
    let min_length = tolerance.min_contact_length(edge);
    let is_given = scene.healed.source == ToleranceSource::Given;
    if is_given && edge > MIN_EDGE_PER_TOLERANCE * tolerance.gap {
        // A given tolerance may be larger than the edges of a round stone. What covers most of an edge is a contact.
        return min_length.min(CONTACT_PER_EDGE * edge);
    }
    min_length
}
