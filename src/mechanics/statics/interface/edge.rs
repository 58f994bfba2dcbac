//! Interfaces of scenes off the lattice: edges that face each other within the scene's tolerance.

use std::collections::BTreeMap;

use super::pinned::{FLAT, pinned_gaps};
use super::{ContactKind, Interface, Interfaces, NearMiss, bodies, ordered};
use crate::geometry::{Aabb, BoxIndex, Edge, Point, Tolerance, Vector, cross, quarter_turn};
use crate::scene::{BodyId, Scene, ToleranceSource, size};

/// Edges farther apart than this many gaps are not worth a notice.
const NEAR: f64 = 30.0;

/// Edges that are parallel to the last digits always face each other, however short the gap.
const PARALLEL: f64 = 1e-9;

/// A whole turn, measured by [`direction`].
const TURN: f64 = 4.0;

/// Edges of a block farther apart than this part of its size were not drawn to touch.
const BESIDE: f64 = 0.01;

/// Two stretches on one line continue each other where their ends lie within this many gaps of each other.
///
/// Both ends of a stretch come from corners that are off by up to a gap each. A tenth of this would leave the stretches of
/// one rounded joint apart; ten times this would join the two feet of a body across the hollow between them, which changes
/// no verdict but the interfaces that are drawn.
const JOIN_REACH: f64 = 4.0;

/// An outline that leaves a contact and comes to lie along the other body again does so within this many times the distance
/// it has gained.
///
/// Edges that rise by less than one in a hundred face the other body themselves. A tenth would miss shallow steps of round
/// stones; ten times this would pass over the hollow between two supports of one body.
const ALONG_OUTLINE: f64 = 50.0;

/// An edge longer than this part of a block's size (four times its area over its boundary) is a side on which it may have been
/// meant to lie; a shorter one is part of a rounded outline.
///
/// The shortest side of a slender column is just over half its size, an edge of a round stone of 20 corners a sixth.
const LONG_SIDE: f64 = 0.5;

/// Where a tolerance is given, a stretch that covers this part of the shorter edge is a contact, however short the edge.
///
/// Ten times this is more than an edge has. A tenth would count two bricks that touch at their chamfers by a hair.
const MOST_OF_EDGE: f64 = 0.5;

/// Edges shorter than this part of a given tolerance are what healing leaves of two corners in one place, not edges.
///
/// Ten times this would drop the edges of a circle of 100 000 corners; a tenth comes near the rounding of numbers.
const SHORTEST_EDGE: f64 = 1e-6;

struct Side {
    body: BodyId,
    number: usize,
    edge: Edge,
    /// What is farther away than this, in metres, does not matter to it.
    near: f64,
}

impl Side {
    /// The box around it, and the directions from which one that faces it differs by less than either of them may be off: of
    /// the stones of an arch, thin and leaning, boxes overlap by the hundred, and every joint has a direction of its own.
    fn around(&self) -> Aabb<3> {
        let along = self.edge.vector();
        let angle = (2.0 * self.near / along.norm()).clamp(PARALLEL, Tolerance::MAX_ANGLE);
        // A sine is less than its angle by less than a thousandth, and directions differ by less than angles.
        let angle = 1.001 * angle;
        let (flat, direction) = (self.edge.bounds(), direction(along));
        Aabb {
            min: [flat.min[0], flat.min[1], direction - angle],
            max: [flat.max[0], flat.max[1], direction + angle],
        }
    }

    /// Boxes around everything that faces it, within its reach. Next to where directions begin and end there are two.
    fn facing(&self) -> impl Iterator<Item = Aabb<3>> {
        let mut around = self.around();
        for d in 0..2 {
            around.min[d] -= self.near;
            around.max[d] += self.near;
        }
        let turned = [-0.5 * TURN, 0.5 * TURN].map(|by| {
            let mut turned = around;
            turned.min[2] += by;
            turned.max[2] += by;
            turned
        });
        let margin = 2.0 * Tolerance::MAX_ANGLE;
        let is_one =
            move |around: &Aabb<3>| around.max[2] >= -margin && around.min[2] <= TURN + margin;
        turned.into_iter().filter(is_one)
    }
}

/// Which way a vector points, from 0 to 4 anticlockwise, quarter by quarter: grows by at most 1 for every radian.
fn direction(v: Vector) -> f64 {
    let part = v.y.abs() / (v.x.abs() + v.y.abs());
    match (v.x >= 0.0, v.y >= 0.0) {
        (true, true) => part,
        (false, true) => 2.0 - part,
        (false, false) => 2.0 + part,
        (true, false) => TURN - part,
    }
}

/// How two edges lie to each other.
enum Meeting {
    /// They share a stretch, along which they are at most so far apart, metres.
    Stretch(Interface, f64),
    /// They share a stretch too short to count.
    Short(Interface),
    /// They face each other along a stretch, but this far apart at its two ends, metres.
    Apart(Apart),
}

/// A stretch along which two edges face each other and do not touch.
struct Apart {
    /// The end where they are nearer to each other, and how far apart they are there, metres.
    narrow: (Point, f64),
    /// The other end.
    wide: (Point, f64),
    /// Around where on the first edge.
    at: Point,
}

impl Apart {
    fn new(ends: [(Point, f64); 2], at: Point) -> Apart {
        let [a, b] = ends;
        let (narrow, wide) = if a.1 <= b.1 { (a, b) } else { (b, a) };
        Apart { narrow, wide, at }
    }

    /// The widest distance along the stretch, metres.
    fn distance(&self) -> f64 {
        self.wide.1
    }

    fn length(&self) -> f64 {
        (self.wide.0 - self.narrow.0).norm()
    }
}

/// All edge interfaces, and what nearly is one.
pub(super) fn find(scene: &Scene) -> Interfaces {
    let count = |body: BodyId| {
        (scene.body(body).polygon.rings().iter())
            .map(Vec::len)
            .sum::<usize>()
    };
    let mut sides: Vec<Side> = Vec::with_capacity(bodies(scene).map(count).sum());
    let mut smallest = f64::INFINITY;
    for body in bodies(scene) {
        let (polygon, gap) = (&scene.body(body).polygon, scene.body(body).gap);
        let near = match body {
            BodyId::Block(_) => {
                let size = size(polygon);
                smallest = smallest.min(size);
                (BESIDE * size).max(gap)
            }
            BodyId::Ground(_) => f64::INFINITY,
        };
        sides.extend((polygon.edges().enumerate()).map(|(number, edge)| Side {
            body,
            number,
            edge,
            near,
        }));
    }
    let nearby = BoxIndex::new(sides, Side::around);
    // With the bodies and the numbers of the two edges, whose order is that of the interfaces.
    let mut met: Vec<([BodyId; 2], [usize; 2], Meeting)> =
        Vec::with_capacity(2 * scene.blocks.len());
    let sides = nearby.all().map(|(_, side)| side);
    for a in sides.filter(|a| matches!(a.body, BodyId::Block(_))) {
        for b in a.facing().flat_map(|around| nearby.intersecting(around)) {
            let Some(pair) = ordered(a.body, b.body).filter(|p| p[0] == a.body && a.body != b.body)
            else {
                continue;
            };
            if let Some(meeting) = meeting(scene, pair, a, b) {
                met.push((pair, [a.number, b.number], meeting));
            }
        }
    }
    met.sort_unstable_by_key(|m| (m.0, m.1));
    let mut notices = Notices::default();
    let (mut all, mut near) = (Vec::with_capacity(met.len()), Vec::new());
    let (mut slivers, mut narrow) = (Vec::new(), Vec::new());
    let mut met = met.into_iter().peekable();
    while let Some(pair) = met.peek().map(|m| m.0) {
        let tolerance = scene.tolerance_between(pair[0], pair[1]);
        let first = all.len();
        let mut apart = Vec::new();
        while let Some((_, _, meeting)) = met.next_if(|m| m.0 == pair) {
            match meeting {
                Meeting::Stretch(interface, distance) => {
                    if distance > 0.0 && FLAT * distance >= smallest {
                        narrow.push(NearMiss {
                            bodies: pair,
                            at: interface.middle(),
                            distance,
                        });
                    }
                    all.push(interface);
                }
                Meeting::Short(interface) => {
                    notices.short(interface.length(), tolerance);
                    if interface.length() > tolerance.rounding {
                        slivers.push(interface);
                    }
                }
                Meeting::Apart(ends) => apart.push(ends),
            }
        }
        if all.len() > first + 1 {
            let stretches = all.split_off(first);
            all.extend(joined(stretches, tolerance));
        }
        if apart.is_empty() {
            continue;
        }
        let of_size = |body: &BodyId| match body {
            BodyId::Block(_) => LONG_SIDE * size(&scene.body(*body).polygon),
            BodyId::Ground(_) => f64::INFINITY,
        };
        let longest = pair.iter().map(of_size).fold(f64::INFINITY, f64::min);
        let mut touching: Vec<Point> = all[first..].iter().flat_map(|i| i.ends).collect();
        if touching.is_empty() {
            touching.extend(only_tip(scene, pair, tolerance, &nearby));
        }
        for gap in gaps_between(apart, touching, tolerance, scene.misfit, longest) {
            if gap.distance() <= NEAR * tolerance.gap {
                notices.apart(scene, pair, gap.distance());
            }
            near.push(NearMiss {
                bodies: pair,
                at: gap.at,
                distance: gap.distance(),
            });
        }
    }
    let pinned_gaps = pinned_gaps(scene, &all, &narrow);
    Interfaces {
        all,
        near_misses: near,
        slivers,
        pinned_gaps,
        notices: notices.words(scene.tolerance),
    }
}

/// The one corner of the first body that touches the second, which it touches nowhere else.
fn only_tip(
    scene: &Scene,
    pair: [BodyId; 2],
    tolerance: Tolerance,
    sides: &BoxIndex<Side, 3>,
) -> Option<Point> {
    let touches = |at: &Point| {
        let around = Aabb {
            min: [at.x - tolerance.gap, at.y - tolerance.gap, -TURN],
            max: [at.x + tolerance.gap, at.y + tolerance.gap, 2.0 * TURN],
        };
        let mut near = sides
            .intersecting(around)
            .filter(|side| side.body == pair[1]);
        near.any(|side| {
            let along = side.edge.vector();
            let share = along.dot(&(at - side.edge.from)) / along.norm_squared();
            let foot = side.edge.from + along * share.clamp(0.0, 1.0);
            (at - foot).norm() <= tolerance.gap
        })
    };
    let corners = scene.body(pair[0]).polygon.rings().iter().flatten();
    let mut tips = corners.filter(|at| touches(at));
    let first = *tips.next()?;
    let reach = JOIN_REACH * tolerance.gap;
    tips.all(|tip| (tip - first).norm() <= reach)
        .then_some(first)
}

/// The stretches along which two bodies are apart, without those that are the shape of an outline.
///
/// Two bodies that touch cannot be moved towards each other. A round stone that touches the ground is near it on both sides,
/// because its outline turns there: no tolerance closes that without bending the outline. So these steps follow the outline:
///
/// 1. Begin where the bodies touch: at the ends of their contacts, or at the one tip on which a body stands. A body on two
///    tips with a hollow between them may have been meant to lie flat.
/// 2. Leave out every stretch that is narrowest there, and go on from its wide end.
///
/// Three things stay: a stretch as wide as coordinates may be off by rounding (`misfit`, metres), since a straight edge may
/// look bent by that; a stretch longer than `longest`, since a body that is drawn askew on its whole side may have been meant
/// to lie flat; and whatever lies away from where the bodies touch.
fn gaps_between(
    mut apart: Vec<Apart>,
    touching: Vec<Point>,
    tolerance: Tolerance,
    misfit: f64,
    longest: f64,
) -> Vec<Apart> {
    let reach = JOIN_REACH * tolerance.gap;
    let mut reached = touching;
    let mut next = 0;
    while let Some(from) = reached.get(next).copied() {
        next += 1;
        apart.retain(|stretch| {
            let near = reach + ALONG_OUTLINE * stretch.distance();
            let is_outline = stretch.distance() > misfit
                && stretch.length() <= longest
                && (stretch.narrow.0 - from).norm() <= near;
            if is_outline {
                reached.push(stretch.wide.0);
            }
            !is_outline
        });
    }
    apart
}

/// What edge `a` of the first body and edge `b` of the second have in common.
fn meeting(scene: &Scene, bodies: [BodyId; 2], a: &Side, b: &Side) -> Option<Meeting> {
    let near = a.near.min(b.near);
    let (a, b) = (a.edge, b.edge);
    let (va, vb) = (a.vector(), b.vector());
    if va.dot(&vb) >= 0.0 {
        return None;
    }
    let (la, lb) = (va.norm(), vb.norm());
    let tolerance = scene.tolerance_between(bodies[0], bodies[1]);
    // Noise of one gap at either end turns a short edge more than a long one.
    let within = |gap: f64| {
        let angle = (2.0 * gap / la.min(lb)).clamp(PARALLEL, tolerance.angle);
        cross(va, vb).abs() <= angle * la * lb
    };
    if !within(near) {
        return None;
    }
    let along = (va - vb).normalize();
    let from_a = |p: Point| along.dot(&(p - a.from));
    let (a0, a1, b0, b1) = (0.0, from_a(a.to), from_a(b.to), from_a(b.from));
    let (s0, s1) = (f64::max(a0, b0), f64::min(a1, b1));
    let length = s1 - s0;
    if length < -tolerance.min_length {
        return None;
    }
    let outward = Vector::new(along.y, -along.x);
    let height = |e: Edge, s: f64| {
        let (h0, h1) = (
            outward.dot(&(e.from - a.from)),
            outward.dot(&(e.to - a.from)),
        );
        let (t0, t1) = (from_a(e.from), from_a(e.to));
        h0 + (h1 - h0) * ((s - t0) / (t1 - t0)).clamp(0.0, 1.0)
    };
    let (gap0, gap1) = (height(b, s0) - height(a, s0), height(b, s1) - height(a, s1));
    let middle = |s: f64| a.from + along * s + outward * ((height(a, s) + height(b, s)) / 2.0);
    let distance = gap0.abs().max(gap1.abs());
    if distance > tolerance.gap {
        let facing = gap0.min(gap1) >= -tolerance.gap && distance <= near && length > distance;
        let ends = [(s0, gap0), (s1, gap1)].map(|(s, gap)| (middle(s), gap.abs()));
        let at = a.from + along * ((s0 + s1) / 2.0);
        return facing.then_some(Meeting::Apart(Apart::new(ends, at)));
    }
    if !within(tolerance.gap) {
        return None;
    }
    let is_short = length <= shortest_contact(scene, tolerance, la.min(lb));
    // Less than a thousandth of the limit is the rounding of a corner that touches, not a contact.
    if is_short && length <= 1e-3 * tolerance.min_length {
        return None;
    }
    // The first body lies to the left of `along`, hence (−n_y, n_x) runs against it.
    let ends = [middle(s1), middle(s0)];
    let interface = Interface {
        bodies,
        kind: ContactKind::Edge,
        ends,
        normal: square_to(ends),
        friction: scene.friction_between(bodies[0], bodies[1]),
    };
    Some(match is_short {
        true => Meeting::Short(interface),
        false => Meeting::Stretch(interface, distance),
    })
}

/// The shortest common stretch of two edges that is an interface, metres, the shorter one `edge` long.
fn shortest_contact(scene: &Scene, tolerance: Tolerance, edge: f64) -> f64 {
    let shortest = tolerance.min_contact_length(edge);
    let is_given = scene.healed.source == ToleranceSource::Given;
    if is_given && edge > SHORTEST_EDGE * tolerance.gap {
        // A given tolerance may be larger than the edges of a round stone. What covers most of an edge is a contact.
        return shortest.min(MOST_OF_EDGE * edge);
    }
    shortest
}

/// The unit normal exactly square to a stretch whose ends run along (−n_y, n_x).
///
/// Friction is one force of an interface, wherever along it a program or a proof lets it act: both agree only where the
/// line through the two ends is the line of friction.
fn square_to(ends: [Point; 2]) -> Vector {
    quarter_turn((ends[0] - ends[1]).normalize())
}

/// Joins stretches of one pair that continue each other along one line: a vertex inside a straight edge changes nothing.
fn joined(stretches: Vec<Interface>, tolerance: Tolerance) -> Vec<Interface> {
    let reach = JOIN_REACH * tolerance.gap;
    let mut left = Ends::new(stretches, reach);
    let mut done = Vec::new();
    while let Some(mut one) = left.last() {
        while let Some(other) = left.next_to(&one) {
            one.ends = hull(&one, &other);
            one.normal = square_to(one.ends);
        }
        done.push(one);
    }
    done
}

/// The two outermost ends of two stretches, measured along the first one.
///
/// Which end of one stretch lies next to which end of the other does not decide this: where the stretches are shorter
/// than the distance within which ends count as equal, all four ends lie next to each other.
fn hull(one: &Interface, other: &Interface) -> [Point; 2] {
    let along = one.tangent();
    let place = |p: &Point| along.dot(&(p - one.ends[0]));
    let mut ends = one.ends;
    for p in other.ends {
        if place(&p) < place(&ends[0]) {
            ends[0] = p;
        }
        if place(&p) > place(&ends[1]) {
            ends[1] = p;
        }
    }
    ends
}

/// Stretches that are still to be joined, found by where they begin and end: a joint may have a hundred thousand.
struct Ends {
    /// `None` once taken.
    stretches: Vec<Option<Interface>>,
    /// The numbers of stretches by the square of a grid in which they begin, and likewise end.
    begin: BTreeMap<Square, Vec<usize>>,
    end: BTreeMap<Square, Vec<usize>>,
    /// How near ends have to be, and the grid's width.
    reach: f64,
}

type Square = (i64, i64);

impl Ends {
    fn new(stretches: Vec<Interface>, reach: f64) -> Ends {
        let mut ends = Ends {
            stretches: Vec::with_capacity(stretches.len()),
            begin: BTreeMap::new(),
            end: BTreeMap::new(),
            reach,
        };
        for (number, stretch) in stretches.into_iter().enumerate() {
            let [from, to] = stretch.ends.map(|p| ends.square(p));
            ends.begin.entry(from).or_default().push(number);
            ends.end.entry(to).or_default().push(number);
            ends.stretches.push(Some(stretch));
        }
        ends
    }

    /// A tolerance of zero makes one square of all places on either side of an axis, which is slow and no less right.
    fn square(&self, p: Point) -> Square {
        let number = |x: f64| (x / self.reach).floor() as i64;
        (number(p.x), number(p.y))
    }

    /// Takes the last one.
    fn last(&mut self) -> Option<Interface> {
        while let Some(last) = self.stretches.pop() {
            if last.is_some() {
                return last;
            }
        }
        None
    }

    /// Takes the first one that goes on where `one` ends or ends where it begins, in its line.
    fn next_to(&mut self, one: &Interface) -> Option<Interface> {
        let behind = self.near(StretchEnd::Begin, one.ends[1], one);
        let before = self.near(StretchEnd::End, one.ends[0], one);
        let next = behind.into_iter().chain(before).min()?;
        self.stretches.get_mut(next)?.take()
    }

    fn near(&mut self, side: StretchEnd, p: Point, one: &Interface) -> Option<usize> {
        let (x, y) = self.square(p);
        let (table, which) = match side {
            StretchEnd::Begin => (&mut self.begin, 0),
            StretchEnd::End => (&mut self.end, 1),
        };
        let mut first: Option<usize> = None;
        for dx in -1..=1 {
            for dy in -1..=1 {
                let square = (x.saturating_add(dx), y.saturating_add(dy));
                let Some(numbers) = table.get_mut(&square) else {
                    continue;
                };
                numbers.retain(|n| matches!(self.stretches.get(*n), Some(Some(_))));
                let goes_on = |n: &usize| {
                    let Some(Some(other)) = self.stretches.get(*n) else {
                        return false;
                    };
                    let straight = cross(one.normal, other.normal).abs() <= 1e-6
                        && one.normal.dot(&other.normal) > 0.0;
                    straight && (p - other.ends[which]).norm() <= self.reach
                };
                first = first
                    .into_iter()
                    .chain(numbers.iter().copied().find(goes_on))
                    .min();
            }
        }
        first
    }
}

/// Which end of a stretch.
#[derive(Clone, Copy)]
enum StretchEnd {
    Begin,
    End,
}

/// Gathers what did not count, to say it once.
#[derive(Default)]
struct Notices {
    shorts: usize,
    longest: f64,
    /// What was too short, at most.
    limit: f64,
    apart: Vec<(String, f64)>,
}

impl Notices {
    fn short(&mut self, length: f64, tolerance: Tolerance) {
        self.shorts += 1;
        self.longest = self.longest.max(length);
        self.limit = self.limit.max(tolerance.min_length);
    }

    fn apart(&mut self, scene: &Scene, pair: [BodyId; 2], distance: f64) {
        self.apart.push((
            format!("{} and {}", scene.name(pair[0]), scene.name(pair[1])),
            distance,
        ));
    }

    fn words(self, tolerance: Tolerance) -> Vec<String> {
        let mut words = Vec::new();
        if self.shorts > 0 {
            words.push(format!(
                "{} contact(s) up to {:.1e} m long are shorter than {:.1e} m and count as touching corners, which carry no force",
                self.shorts, self.longest, self.limit
            ));
        }
        if let Some((who, distance)) = self.apart.first() {
            let others = match self.apart.len() - 1 {
                0 => String::new(),
                n => format!(", and so do {n} other pair(s) of edges"),
            };
            words.push(format!(
                "{who} nearly touch, {distance:.1e} m apart, more than the {:.1e} m that count as contact{others}",
                tolerance.gap
            ));
        }
        words
    }
}
