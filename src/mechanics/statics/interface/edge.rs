//! Finds the edge interfaces of scenes in which not all bodies consist of lattice cells: edges of two bodies that face
//! each other within the contact tolerance.
//!
//! 1. A bounding-volume hierarchy over position, direction and offset returns the pairs of edges that may face each other.
//! 2. [`compare`] decides for each pair: common segment, too short, or apart.
//! 3. Segments of the same two bodies that continue each other are joined ([`join`](super::join)).
//! 4. Gaps that a stone keeps open are found ([`pinned`](super::pinned)).
//!
//! Reference: Ericson, Real-Time Collision Detection, 2005, chapter 6 (bounding-volume hierarchies).

use super::join::{JOIN_REACH, join_segments};
use super::pinned::{MAX_PINNED_SIZE_PER_GAP, pinned_gaps};
use super::segment::{CommonSegment, GapSegment, min_contact_length, without_outline};
use super::{ContactKind, Interface, Interfaces, NearMiss, bodies, normal_across, ordered};
use crate::geometry::{Aabb, BoxIndex, Edge, Point, Tolerance, Vector, cross};
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{BodyId, Scene, size};

/// Edges farther apart than this multiple of the contact tolerance are not mentioned in a notice.
const MAX_REPORTED_GAPS: f64 = 30.0;

/// Edges whose directions differ by less than this, in radians, count as parallel however small the gap is.
///
/// Directions of short edges are rounded to about 10⁻¹²; the value leaves a reserve for edges far from the origin.
pub(super) const PARALLEL_TOL: f64 = 1e-9;

/// The value of [`direction`] after a full turn.
const FULL_TURN: f64 = 4.0;

/// Bodies with a gap above this fraction of a block's size, or of the diameter of a circle, are not near misses: they were
/// not drawn to touch.
pub(in crate::mechanics) const MAX_GAP_PER_SIZE: f64 = 0.01;

/// Common segments are ignored, and not reported as too short, if their length is at most this fraction of
/// [`Tolerance::min_length`].
///
/// Such segments result from rounding where a corner touches the end of an edge.
const CORNER_ROUNDING: f64 = 1e-3;

/// An edge longer than this fraction of a block's size (four times its area over its perimeter) is a side on which the
/// block may have been meant to lie; a shorter edge is part of a rounded outline.
///
/// The shortest side of a slender column is just over half its size; an edge of a round stone with 20 corners is a
/// sixth.
const LONG_SIDE_PER_SIZE: f64 = 0.5;

/// An edge of a body.
struct Side {
    body: BodyId,
    /// Its index among the body's edges.
    number: usize,
    edge: Edge,
    /// The largest distance at which edges of other bodies are compared with this edge, metres.
    search_distance: f64,
}

impl Side {
    /// Returns the bounding box of the edge in x, y, direction, and the distance of its line from `origin`, which is
    /// positive to the left of the origin.
    ///
    /// The ranges of directions and distances are wide enough for each edge that may face this one within the smaller
    /// angle tolerance of the two edges. Without the direction, the box of a thin inclined stone of an arch overlaps
    /// hundreds of others. With the direction, the box overlaps only a few, because each joint has a different direction.
    /// Without the distance, the boxes of the parallel teeth of a comb overlap if the teeth are inclined.
    fn bounds(&self, origin: Point) -> Aabb<4> {
        let along = self.edge.vector();
        let length = along.norm();
        let angle = (2.0 * self.search_distance / length).clamp(PARALLEL_TOL, Tolerance::MAX_ANGLE);
        // Add a thousandth, because `compare` tests the sine, which is slightly smaller than the angle. `direction`
        // changes by at most 1 per radian.
        let angle = 1.001 * angle;
        let (position, direction) = (self.edge.bounds(), direction(along));
        let ends = [self.edge.from, self.edge.to].map(|end| end - origin);
        let distance = cross(along, ends[0]) / length;
        let turned = self.search_distance + angle * ends[0].norm().max(ends[1].norm());
        Aabb {
            min: [position.min[0], position.min[1], direction - angle, distance - turned],
            max: [position.max[0], position.max[1], direction + angle, distance + turned],
        }
    }

    /// Returns the query boxes for edges that face this edge: edges of the opposite direction within the search
    /// distance. Directions are periodic, so two boxes are needed near 0 and [`FULL_TURN`].
    fn facing(&self, origin: Point) -> impl Iterator<Item = Aabb<4>> {
        let mut bounds = self.bounds(origin);
        (bounds.min[3], bounds.max[3]) = (-bounds.max[3], -bounds.min[3]);
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
        let is_needed = move |bounds: &Aabb<4>| bounds.max[2] >= -margin && bounds.min[2] <= FULL_TURN + margin;
        opposite.into_iter().filter(is_needed)
    }
}

/// Returns a number from 0 to 4 that grows with the angle of a vector, anticlockwise from the x axis. It grows by 1 in
/// each quadrant, and is computed without trigonometry.
fn direction(v: Vector) -> f64 {
    let part = v.y.abs() / (v.x.abs() + v.y.abs());
    match (v.x >= 0.0, v.y >= 0.0) {
        (true, true) => part,
        (false, true) => 2.0 - part,
        (false, false) => 2.0 + part,
        (true, false) => FULL_TURN - part,
    }
}

/// The relation of two edges that face each other.
enum Relation {
    /// They touch along a segment; the number is their largest distance along it, metres.
    Touching(Interface, f64),
    /// They touch along a segment that is too short for an interface.
    TooShort(Interface),
    /// They face each other along this segment with a gap wider than the tolerance: a near miss.
    Apart(GapSegment),
}

/// Two bodies, the numbers of one edge of each, and the relation of the two edges.
type Pair = ([BodyId; 2], [usize; 2], Relation);

/// Finds all edge interfaces of a scene, and the edges that are nearly interfaces.
pub(super) fn find(scene: &Scene) -> Interfaces {
    let (sides, smallest) = sides(scene);
    let origin = sides.first().map_or(Point::origin(), |side| side.edge.from);
    let index = BoxIndex::new(sides, |side| side.bounds(origin));
    let mut pairs: Vec<Pair> = Vec::with_capacity(2 * scene.blocks.len());
    let sides = index.all().map(|(_, side)| side);
    for a in sides.filter(|a| matches!(a.body, BodyId::Block(_))) {
        for b in a.facing(origin).flat_map(|query| index.intersecting(query)) {
            let Some(bodies) = ordered(a.body, b.body).filter(|p| p[0] == a.body && a.body != b.body) else {
                continue;
            };
            if let Some(relation) = compare(scene, bodies, a, b) {
                pairs.push((bodies, [a.number, b.number], relation));
            }
        }
    }
    // Sort the pairs, because the index returns edges in no particular order and results must not depend on it.
    pairs.sort_unstable_by_key(|pair| (pair.0, pair.1));
    collect(scene, pairs, &index, smallest)
}

/// Returns all edges of a scene, and the size of its smallest block in metres.
fn sides(scene: &Scene) -> (Vec<Side>, f64) {
    let count = |body: BodyId| (scene.body(body).polygon.rings().iter()).map(Vec::len).sum::<usize>();
    let mut sides: Vec<Side> = Vec::with_capacity(bodies(scene).map(count).sum());
    let (mut smallest, mut farthest) = (f64::INFINITY, 0.0_f64);
    for body in bodies(scene) {
        let (polygon, gap) = (&scene.body(body).polygon, scene.body(body).gap);
        let search_distance = match body {
            BodyId::Block(_) => {
                let size = size(polygon);
                smallest = smallest.min(size);
                let distance = (MAX_GAP_PER_SIZE * size).max(gap);
                farthest = farthest.max(distance);
                distance
            }
            BodyId::Ground(_) => f64::INFINITY,
        };
        sides.extend((polygon.edges().enumerate()).map(|(number, edge)| Side { body, number, edge, search_distance }));
    }
    // Of a block and the ground, the distance of the block counts.
    sides.iter_mut().for_each(|side| side.search_distance = side.search_distance.min(farthest));
    (sides, smallest)
}

/// The contacts, near misses and notices found along the pairs of edges.
#[derive(Default)]
struct Collection {
    interfaces: Vec<Interface>,
    near_misses: Vec<NearMiss>,
    slivers: Vec<Interface>,
    /// Interfaces with a gap that a stone may keep open.
    open_joints: Vec<NearMiss>,
    notices: Notices,
}

/// Converts pairs of edges to interfaces, near misses and slivers. Pairs of the same two bodies must be consecutive.
fn collect(scene: &Scene, pairs: Vec<Pair>, sides: &BoxIndex<Side, 4>, smallest: f64) -> Interfaces {
    let mut found = Collection::default();
    found.interfaces.reserve(pairs.len());
    let mut pairs = pairs.into_iter().peekable();
    while let Some(bodies) = pairs.peek().map(|pair| pair.0) {
        let tolerance = scene.tolerance_between(bodies[0], bodies[1]);
        let first = found.interfaces.len();
        let mut open = Vec::new();
        while let Some((_, _, relation)) = pairs.next_if(|pair| pair.0 == bodies) {
            match relation {
                Relation::Touching(interface, distance) => {
                    found.add_touching(interface, distance, smallest);
                }
                Relation::TooShort(interface) => found.add_short(interface, tolerance),
                Relation::Apart(segment) => open.push(segment),
            }
        }
        if found.interfaces.len() > first + 1 {
            let segments = found.interfaces.split_off(first);
            found.interfaces.extend(join_segments(segments, tolerance));
        }
        if !open.is_empty() {
            let touching = touching_points(scene, bodies, &found.interfaces[first..], sides);
            found.add_gaps(scene, bodies, open, touching);
        }
    }
    let pinned_gaps = pinned_gaps(scene, &found.interfaces, &found.open_joints);
    Interfaces {
        all: found.interfaces,
        near_misses: found.near_misses,
        slivers: found.slivers,
        pinned_gaps,
        notices: found.notices.into_sentences(scene.tolerance, scene.units),
    }
}

impl Collection {
    /// Adds an interface whose edges are at most `distance` metres apart. `smallest` is the size of the smallest block
    /// in metres.
    fn add_touching(&mut self, interface: Interface, distance: f64, smallest: f64) {
        // A gap counts as an open joint only if it is wide enough for the smallest stone, which may keep it open.
        if distance > 0.0 && MAX_PINNED_SIZE_PER_GAP * distance >= smallest {
            self.open_joints.push(NearMiss { bodies: interface.bodies, at: interface.middle(), distance });
        }
        self.interfaces.push(interface);
    }

    /// Records a contact that is too short for an interface, for the notice on short contacts. If its length exceeds
    /// the rounding error of the coordinates, it is also kept as a sliver.
    fn add_short(&mut self, interface: Interface, tolerance: Tolerance) {
        self.notices.add_short(interface.length(), tolerance);
        if interface.length() > tolerance.rounding {
            self.slivers.push(interface);
        }
    }

    /// Adds the gaps between two bodies as near misses. If the bodies touch, gaps that only follow from a rounded
    /// outline are left out.
    fn add_gaps(&mut self, scene: &Scene, bodies: [BodyId; 2], open: Vec<GapSegment>, touching: Vec<Point>) {
        let tolerance = scene.tolerance_between(bodies[0], bodies[1]);
        let longest = longest_outline_edge(scene, bodies);
        for gap in without_outline(open, touching, tolerance, scene.misfit, longest) {
            if gap.distance() <= MAX_REPORTED_GAPS * tolerance.gap {
                self.notices.add_near_contact(scene, bodies, gap.distance());
            }
            self.near_misses.push(NearMiss { bodies, at: gap.at, distance: gap.distance() });
        }
    }
}

/// Returns the greatest length, in metres, of edges that may belong to the rounded outlines of two bodies. Longer edges
/// count as straight sides.
fn longest_outline_edge(scene: &Scene, bodies: [BodyId; 2]) -> f64 {
    let of_body = |body: &BodyId| match body {
        BodyId::Block(_) => LONG_SIDE_PER_SIZE * size(&scene.body(*body).polygon),
        BodyId::Ground(_) => f64::INFINITY,
    };
    bodies.iter().map(of_body).fold(f64::INFINITY, f64::min)
}

/// Returns the points at which two bodies touch: the ends of their interfaces. Without an interface, returns the only
/// corner of the first body that touches the second, if there is such a corner.
fn touching_points(
    scene: &Scene,
    bodies: [BodyId; 2],
    interfaces: &[Interface],
    sides: &BoxIndex<Side, 4>,
) -> Vec<Point> {
    if !interfaces.is_empty() {
        return interfaces.iter().flat_map(|i| i.ends).collect();
    }
    only_touching_corner(scene, bodies, sides).into_iter().collect()
}

/// Returns the only point at which corners of the first body touch the second. `None` if no corner touches, or if
/// corners touch at different points.
fn only_touching_corner(scene: &Scene, bodies: [BodyId; 2], sides: &BoxIndex<Side, 4>) -> Option<Point> {
    let gap = scene.tolerance_between(bodies[0], bodies[1]).gap;
    let touches = |at: &Point| {
        // Edges of any direction are found.
        let any = f64::INFINITY;
        let query = Aabb { min: [at.x - gap, at.y - gap, -any, -any], max: [at.x + gap, at.y + gap, any, any] };
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
    touching.all(|at| (at - first).norm() <= JOIN_REACH * gap).then_some(first)
}

/// Compares edge `a` of the first body with edge `b` of the second. Returns their relation, or `None` if they do not
/// face each other closely enough for an interface or a near miss.
fn compare(scene: &Scene, bodies: [BodyId; 2], a: &Side, b: &Side) -> Option<Relation> {
    let search_distance = a.search_distance.min(b.search_distance);
    let (a, b) = (a.edge, b.edge);
    let (va, vb) = (a.vector(), b.vector());
    if va.dot(&vb) >= 0.0 {
        return None;
    }
    // Test whether the edges are parallel. The allowed angle is larger for short edges, because displacements of
    // their ends by the tolerance turn them more.
    let (la, lb) = (va.norm(), vb.norm());
    let tolerance = scene.tolerance_between(bodies[0], bodies[1]);
    let is_parallel_within = |gap: f64| {
        let angle = (2.0 * gap / la.min(lb)).clamp(PARALLEL_TOL, tolerance.angle);
        cross(va, vb).abs() <= angle * la * lb
    };
    if !is_parallel_within(search_distance) {
        return None;
    }
    let segment = CommonSegment::new(a, b);
    let length = segment.length();
    if length < -tolerance.min_length {
        return None;
    }
    let distance = segment.distance();
    if distance > tolerance.gap {
        let is_near_miss = segment.depth() >= -tolerance.gap && distance <= search_distance && length > distance;
        return is_near_miss.then(|| Relation::Apart(segment.open()));
    }
    if !is_parallel_within(tolerance.gap) {
        return None;
    }
    let is_short = length <= min_contact_length(scene, tolerance, la.min(lb));
    if is_short && length <= CORNER_ROUNDING * tolerance.min_length {
        return None;
    }
    // The first body lies to the left of its edge, so the tangent (−n_y, n_x) points against the edge. The end of the
    // segment is therefore listed first.
    let ends = [segment.middle(segment.end), segment.middle(segment.start)];
    let normal = normal_across(ends);
    let friction = scene.friction_at(bodies, normal);
    let interface = Interface { bodies, kind: ContactKind::Edge, ends, normal, friction };
    Some(if is_short { Relation::TooShort(interface) } else { Relation::Touching(interface, distance) })
}

/// Collects the segments that are too short and the edges that are too far apart for an interface.
#[derive(Default)]
pub(super) struct Notices {
    /// Number of segments that are too short.
    short_count: usize,
    /// The length of the longest segment that is too short, metres.
    longest_short: f64,
    /// The largest [`Tolerance::min_length`] of the pairs of bodies with such a segment, metres.
    required_length: f64,
    /// Pairs of bodies that nearly touch: a text with both names, and the distance of their edges in metres.
    unjoined: Vec<(String, f64)>,
}

impl Notices {
    /// Records a segment of `length` metres, which is too short for an interface.
    pub(super) fn add_short(&mut self, length: f64, tolerance: Tolerance) {
        self.short_count += 1;
        self.longest_short = self.longest_short.max(length);
        self.required_length = self.required_length.max(tolerance.min_length);
    }

    /// Records two bodies with edges that are `distance` metres apart, which is more than the tolerance.
    pub(super) fn add_near_contact(&mut self, scene: &Scene, bodies: [BodyId; 2], distance: f64) {
        let names = bodies.map(|body| scene.name(body));
        self.unjoined.push((format!("{} and {}", names[0], names[1]), distance));
    }

    /// Returns the notices as sentences for users, with lengths in the unit of the scene. There is at most one
    /// sentence about contacts that are too short, and at most one about gaps that are too wide.
    pub(super) fn into_sentences(self, tolerance: Tolerance, units: UnitsEntry) -> Vec<String> {
        let mut sentences = Vec::new();
        if self.short_count > 0 {
            sentences.push(format!(
                "{} contact(s) up to {} long are shorter than {} and count as touching corners, which carry no force",
                self.short_count,
                units.small_length(self.longest_short, 1),
                units.small_length(self.required_length, 1)
            ));
        }
        if let Some((names, distance)) = self.unjoined.first() {
            let others = match self.unjoined.len() - 1 {
                0 => String::new(),
                n => format!(", and so do {n} other pair(s) of edges"),
            };
            sentences.push(format!(
                "{names} nearly touch, {} apart, more than the {} that count as contact{others}",
                units.small_length(*distance, 1),
                units.small_length(tolerance.gap, 1)
            ));
        }
        sentences
    }
}
