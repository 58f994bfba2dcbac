//! [`Finder`]: finds the corners of bodies at the ends of joints, and the corners that lie on edges of other bodies.

use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::scene::{BodyId, Frame, Scene};
use crate::mechanics::statics::assembly::DisjointSets;
use crate::mechanics::statics::interface::{ContactKind, Interface, JOIN_REACH};

/// The distance up to which a corner counts as the end of a contact is at least this fraction of the coordinates. This
/// matters only for scenes without tolerance.
const ROUNDING_TOL: f64 = 1e-9;

/// A corner of a body, with its index in the outline. The corners of holes follow those of the outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub body: BodyId,
    pub number: usize,
    pub at: Point,
    /// The indices, in [`Finder::all`], of the corners before and after it in its ring.
    pub neighbours: [usize; 2],
}

/// A condition on joined corners: `of` lies on the edge from `from` to `to`, at the fraction `share` of its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guide {
    pub of: usize,
    pub from: usize,
    pub to: usize,
    share: f64,
    pub normal: Vector,
}

impl Guide {
    /// Returns the coefficient of the normal displacement of `corner` in the condition that the corner `of` stays on
    /// the edge between `from` and `to`. The coefficient is 0 for a corner other than these three.
    pub fn factor(&self, corner: usize) -> f64 {
        let mut factor = 0.0;
        for (place, value) in [(self.of, 1.0), (self.from, self.share - 1.0), (self.to, -self.share)] {
            if place == corner {
                factor += value;
            }
        }
        factor
    }
}

/// The corners that belong to an interface.
pub(super) struct InterfaceCorners {
    pub ends: Option<[usize; 2]>,
    /// If the contact is a corner on an edge, the two corners of this edge.
    pub edge: Option<[usize; 2]>,
    /// All corners of both bodies that count as ends of the contact.
    pub tips: Vec<usize>,
}

/// Finds the corners at the ends of interfaces.
pub(super) struct Finder<'s> {
    scene: &'s Scene,
    pub all: Vec<Corner>,
    /// Each body with the index of its first corner, in the order of the bodies.
    first: Vec<(BodyId, usize)>,
    sets: DisjointSets,
    /// Each corner that lies on an edge, with the two corners of this edge.
    on_edges: Vec<(usize, [usize; 2])>,
}

impl<'s> Finder<'s> {
    pub fn new(scene: &'s Scene, frame: &Frame) -> Finder<'s> {
        let ground = (0..scene.ground().len()).map(BodyId::Ground);
        let mut bodies: Vec<BodyId> = ground.chain(frame.placed.iter().map(|b| BodyId::Block(*b))).collect();
        bodies.sort();
        let (mut all, mut first) = (Vec::new(), Vec::new());
        for body in bodies {
            first.push((body, all.len()));
            let mut number = 0;
            // A circle has no corners.
            let rings = scene.body(body).polygon.rings().iter().filter(|_| scene.body(body).circle.is_none());
            for ring in rings {
                let start = all.len();
                for (k, at) in ring.iter().enumerate() {
                    let next = [(k + ring.len() - 1) % ring.len(), (k + 1) % ring.len()];
                    all.push(Corner { body, number, at: *at, neighbours: next.map(|k| start + k) });
                    number += 1;
                }
            }
        }
        Finder { scene, sets: DisjointSets::new(all.len()), all, first, on_edges: Vec::new() }
    }

    /// Returns the range of the indices, in `all`, of the corners of a body.
    fn corners_of(&self, body: BodyId) -> std::ops::Range<usize> {
        let place = self.first.partition_point(|(other, _)| *other < body);
        let from = self.first.get(place).map_or(0, |(_, first)| *first);
        let to = self.first.get(place + 1);
        from..to.map_or(self.all.len(), |(_, first)| *first)
    }

    /// Returns the largest distance, metres, at which a corner counts as an end of the interface.
    fn reach(&self, interface: &Interface) -> f64 {
        let [a, b] = interface.bodies;
        let gap = self.scene.tolerance_between(a, b).gap;
        let size = interface.ends[0].coords.norm().max(interface.length());
        (JOIN_REACH * gap).max(ROUNDING_TOL * size)
    }

    /// Returns, of all corners of a body, the corner nearest to a point. `None` if it is farther away than `reach`, in
    /// metres.
    fn corner_at(&self, body: BodyId, at: Point, reach: f64) -> Option<usize> {
        let near = self.corners_of(body).map(|place| (place, (self.all[place].at - at).norm()));
        let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.filter(|(_, distance)| *distance <= reach).map(|(place, _)| place)
    }

    /// Returns, of all edges of a body, the two corners of the edge nearest to a point. If `along` is given, only edges
    /// with about this direction count; `None` if there are none.
    fn edge_at(&self, body: BodyId, at: Point, along: Option<Vector>) -> Option<[usize; 2]> {
        let edges = self.corners_of(body).filter_map(|place| {
            let next = self.all[place].neighbours[1];
            let (from, to) = (self.all[place].at, self.all[next].at);
            let edge = to - from;
            let share = (edge.dot(&(at - from)) / edge.norm_squared()).clamp(0.0, 1.0);
            let is_along = along.is_none_or(|d| cross(d, edge).abs() <= 0.02 * edge.norm());
            is_along.then(|| ([place, next], (from + edge * share - at).norm()))
        });
        let nearest = edges.min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.map(|(edge, _)| edge)
    }

    /// At each end of an interface, joins the corners of both bodies that lie there: they will move together.
    pub fn join(&mut self, interface: &Interface) {
        let reach = self.reach(interface);
        for end in interface.ends {
            let both = interface.bodies.map(|body| self.corner_at(body, end, reach));
            if let [Some(a), Some(b)] = both {
                self.sets.union(a, b);
            }
        }
    }

    /// Finds the corners at the ends of an interface. Records which of them lie on an edge of the other body, and which
    /// corners lie inside the joint.
    pub fn contact(&mut self, interface: &Interface) -> InterfaceCorners {
        let reach = self.reach(interface);
        let is_corner = interface.kind == ContactKind::Corner;
        let mut found = InterfaceCorners { ends: None, edge: None, tips: Vec::new() };
        let mut ends = [None; 2];
        for (end, at) in ends.iter_mut().zip(interface.ends) {
            let both = interface.bodies.map(|body| self.corner_at(body, at, reach));
            found.tips.extend(both.into_iter().flatten());
            *end = both[0].or(both[1]);
            let along = (!is_corner).then(|| interface.tangent());
            if let ([Some(corner), None], body) | ([None, Some(corner)], body) =
                (both, interface.bodies[usize::from(both[0].is_some())])
                && let Some(edge) = self.edge_at(body, at, along)
            {
                self.on_edges.push((corner, edge));
                found.edge = is_corner.then_some(edge);
            }
        }
        if let [Some(a), Some(b)] = ends {
            found.ends = Some([a, b]);
            if !is_corner {
                self.guide_inside(interface, [a, b], reach);
            }
        }
        found
    }

    /// Records that each corner inside a straight joint lies on the line between the two ends of the joint.
    fn guide_inside(&mut self, interface: &Interface, ends: [usize; 2], reach: f64) {
        let along = interface.tangent();
        for body in interface.bodies {
            for place in self.corners_of(body) {
                let offset = self.all[place].at - interface.ends[0];
                let distance = along.dot(&offset);
                if distance > reach && distance < interface.length() - reach && cross(along, offset).abs() <= reach {
                    self.on_edges.push((place, ends));
                }
            }
        }
    }

    /// Returns, for each corner, the index of the joined corner that it belongs to. Also returns the number of joined
    /// corners.
    pub fn joined(&mut self) -> (Vec<usize>, usize) {
        let mut number = vec![usize::MAX; self.all.len()];
        let mut count = 0;
        let joined = (0..self.all.len()).map(|place| {
            let root = self.sets.find(place);
            if number[root] == usize::MAX {
                number[root] = count;
                count += 1;
            }
            number[root]
        });
        let joined = joined.collect();
        (joined, count)
    }

    /// Returns the conditions that joined corners stay on their edges, without duplicates.
    pub fn guides(&self, joined: &[usize]) -> Vec<Guide> {
        let guides = self.on_edges.iter().filter_map(|(corner, edge)| {
            let [from, to] = edge.map(|place| self.all[place].at);
            let along = to - from;
            let share = along.dot(&(self.all[*corner].at - from)) / along.norm_squared();
            let [of, from, to] = [*corner, edge[0], edge[1]].map(|place| joined[place]);
            (of != from && of != to).then(|| Guide { of, from, to, share, normal: quarter_turn(along.normalize()) })
        });
        let mut guides: Vec<Guide> = guides.collect();
        guides.sort_by_key(|g| (g.of, g.from, g.to));
        guides.dedup_by_key(|g| (g.of, g.from, g.to));
        guides
    }
}
