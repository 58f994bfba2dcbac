//! Snapping: moves corners of bodies that nearly touch, so that the bodies touch exactly. Imported drawings and scenes
//! with rounded coordinates need this.
//!
//! Every body has a gap, the distance within which its corners and sides are joined to those of other bodies. Between
//! two bodies, the smaller gap applies.
//!
//! 1. Corners of different bodies within the gap are merged into one node ([`Nodes`]): clustering with complete
//!    linkage.
//! 2. Nodes within the gap of a side of another body are found.
//! 3. A straight side and the nodes along it are moved onto one line ([`Lines`]): total least squares. A side that
//!    approximates a piece of a curve gets the node as an additional corner instead.
//! 4. The result is checked. A body that lost its shape or overlaps another body more than before is left as drawn, and
//!    the steps are repeated without moving it.
//!
//! Invariant: no body loses its shape, and no two bodies overlap more than as drawn, apart from a small tolerance.
//! References: Everitt et al., Cluster Analysis, 2011, §4.2 (complete linkage); Milenkovic, Verifiable implementations
//! of geometric algorithms using finite precision arithmetic, 1988 (merging corners and shifting them onto sides).

mod line;
mod node;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::box_index::across_longest;
use super::{Aabb, BoxIndex, ConvexPieces, Edge, Point, Polygon, PolygonError, cross, overlap};
use line::Lines;
use node::Nodes;

/// A corner of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    /// Position, in metres.
    pub(crate) at: Point,
    /// Whether the side that begins at this corner approximates a piece of a curve.
    pub(crate) curved: bool,
}

/// An outline and its holes, each clockwise or anticlockwise.
pub(crate) type Rings = Vec<Vec<Corner>>;

/// Converts rings of corners to a polygon. The first ring is the outline, the others are holes.
pub(crate) fn polygon(rings: &Rings) -> Result<Polygon, Vec<PolygonError>> {
    let points = |ring: &Vec<Corner>| ring.iter().map(|c| c.at).collect::<Vec<Point>>();
    let mut rings = rings.iter().map(points);
    let outline = rings.next().unwrap_or_default();
    Polygon::new(outline, rings.collect())
}

/// Returns the signed area of a ring in square metres, positive if the ring runs anticlockwise.
pub(crate) fn area(ring: &[Corner]) -> f64 {
    let Some(base) = ring.first() else { return 0.0 };
    let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
    pairs.map(|(a, b)| cross(a.at - base.at, b.at - base.at)).sum::<f64>() / 2.0
}

/// The largest number of attempts. After each attempt, damaged bodies are fixed as drawn and the rest is snapped again.
///
/// After the last attempt, all bodies are returned as drawn.
const MAX_ATTEMPTS: usize = 12;

/// A node whose distance from a side is at most this fraction of the gap already lies on that side.
///
/// It is a thousandth of [`MIN_MOVE`]. A limit below the rounding of coordinates would rebuild bodies that already fit.
const EXACT_DISTANCE_TOL: f64 = 1e-9;

/// A corner that moves by at most this fraction of the gap is not reported as moved, because this is only rounding.
const MIN_MOVE: f64 = 1e-6;

/// A ring whose area shrinks to this fraction of its former area, or below, has lost its shape.
const MIN_AREA_SHARE: f64 = 0.5;

/// If more pairs of bodies lie close together, for each corner on average, their overlaps are not compared, and no body
/// is moved.
const MAX_PAIRS_PER_CORNER: usize = 16;

/// Returns how many neighbours of all `count` corners, or of all their sides, are visited. If there are more, thousands of
/// outlines lie at one place, and nothing is joined.
fn most_visits(count: usize) -> usize {
    const MEAN: usize = 256;
    MEAN * count + 100_000
}

/// The distances within which corners are joined to other bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gaps<'g> {
    /// The gap of each body in metres; 0 for a body whose corners are not to be moved.
    pub(crate) of_body: &'g [f64],
    /// The gap of a corner is at most this fraction of the shorter of its two sides. Infinite if every corner has the
    /// gap of its body.
    pub(crate) share_of_edge: f64,
    /// Where corners of these bodies and of later ones meet, all of them move to the mean of their places. The corners of
    /// earlier bodies stay.
    pub(crate) moved_from: usize,
}

impl<'g> Gaps<'g> {
    /// Creates the gaps of all corners from the gap of each body, in metres. Every corner has the gap of its body,
    /// however short the sides at this corner are.
    pub(crate) fn new(of_body: &'g [f64]) -> Gaps<'g> {
        Gaps { of_body, share_of_edge: f64::INFINITY, moved_from: usize::MAX }
    }
}

/// The result of snapping.
pub(crate) struct Outcome<'b> {
    /// The outlines of all bodies; borrowed from the input if no body changed.
    pub(crate) bodies: Cow<'b, [Rings]>,
    /// The bodies that changed.
    pub(crate) moved: Vec<Moved>,
    /// Numbers of the bodies that were left as drawn because snapping would have damaged them.
    pub(crate) kept: Vec<usize>,
}

/// A body that was changed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Moved {
    /// The number of the body.
    pub(crate) body: usize,
    /// The number of its corners that were moved or added.
    pub(crate) corners: usize,
    /// The largest distance by which one of its corners moved, in metres.
    pub(crate) distance: f64,
    /// Numbers of the bodies that it touches after snapping.
    pub(crate) to: BTreeSet<usize>,
}

/// Moves corners onto corners and sides of other bodies if their distance is at most the smaller of their gaps. Corners
/// that merge take the position of the corner of a fixed body, or else of the earliest body in the list; the mean position
/// if all their bodies are at least `gaps.moved_from`.
///
/// A body marked in `fixed` does not change: corners of other bodies may move onto it, but its own corners never move.
/// Bodies that snapping would damage stay as drawn. Snapping may deepen an overlap of two bodies by at most `noise`
/// times the smaller of their gaps.
pub(crate) fn snapped<'b>(bodies: &'b [Rings], gaps: Gaps<'_>, fixed: &[bool], noise: f64) -> Outcome<'b> {
    let mut kept = fixed.to_vec();
    for _ in 0..MAX_ATTEMPTS {
        let mut outcome = attempt(bodies, gaps, &kept);
        if outcome.moved.is_empty() {
            // No corner moved by more than rounding. Return the input bit for bit; it needs no check.
            outcome.bodies = Cow::Borrowed(bodies);
        }
        // Find the bodies that snapping has damaged. They keep their drawn corners in the next attempt, which snaps the
        // other bodies again.
        let fresh: Vec<usize> = match &outcome.bodies {
            Cow::Borrowed(_) => Vec::new(),
            Cow::Owned(new) => {
                let wrong = damaged_bodies(bodies, new, gaps.of_body, noise);
                wrong.into_iter().filter(|b| !kept[*b]).collect()
            }
        };
        if fresh.is_empty() {
            outcome.kept = kept_but_not_fixed(&kept, fixed);
            return outcome;
        }
        for body in fresh {
            kept[body] = true;
        }
    }
    Outcome {
        bodies: Cow::Borrowed(bodies),
        moved: Vec::new(),
        kept: kept_but_not_fixed(&vec![true; bodies.len()], fixed),
    }
}

/// Returns the indices of the bodies that snapping left as drawn, except those that the caller fixed.
fn kept_but_not_fixed(kept: &[bool], fixed: &[bool]) -> Vec<usize> {
    let pairs = kept.iter().zip(fixed).enumerate();
    pairs.filter_map(|(b, (kept, fixed))| (*kept && !*fixed).then_some(b)).collect()
}

/// A side of a body: it leads from the node `ends[0]` to the node `ends[1]`.
struct Side {
    body: usize,
    ring: usize,
    corner: usize,
    ends: [usize; 2],
    curved: bool,
}

/// A node within the gap of a side of another body.
struct NodeNearSide<'s> {
    node: usize,
    side: &'s Side,
    /// Distance from the side's start to the foot of the perpendicular from the node, in metres.
    reach: f64,
    /// Distance of the node from the side, in metres.
    off: f64,
}

/// Snaps all bodies once. The corners of the bodies marked in `kept` do not move. The result may be damaged; the caller
/// must check it.
fn attempt<'b>(bodies: &'b [Rings], gaps: Gaps<'_>, kept: &[bool]) -> Outcome<'b> {
    // Step 1: merge close corners into nodes.
    let mut nodes = Nodes::new(bodies, gaps, kept);
    let gaps = gaps.of_body;
    // Step 2: find the nodes near sides of other bodies.
    let sides = sides(bodies, &nodes);
    let found = nodes_near_sides(&nodes, &sides, gaps, kept);
    // Return the bodies unchanged if every corner is exactly at its node, every node near a side lies on this side, and
    // no such side is curved.
    let fits = |b: &NodeNearSide<'_>| !b.side.curved && b.off <= EXACT_DISTANCE_TOL * nodes.all[b.node].gap;
    if nodes.exact && found.iter().all(fits) {
        return Outcome { bodies: Cow::Borrowed(bodies), moved: Vec::new(), kept: Vec::new() };
    }
    // The bodies that share a node touch each other.
    let mut touching: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); bodies.len()];
    for node in &nodes.all {
        let there = nodes.bodies(node);
        for a in there {
            touching[*a].extend(there.iter().filter(|b| *b != a));
        }
    }
    // `on` maps each straight side, given by its two end nodes, to the nodes within the gap of this side. `taken` maps
    // each curved side to the nodes that become additional corners of this side, each with its distance from the start
    // of the side.
    let mut on: BTreeMap<[usize; 2], BTreeSet<usize>> = BTreeMap::new();
    let mut taken: BTreeMap<(usize, usize, usize), Vec<(f64, usize)>> = BTreeMap::new();
    for NodeNearSide { node, side, reach, .. } in found {
        for body in nodes.bodies(&nodes.all[node]) {
            touching[*body].insert(side.body);
            touching[side.body].insert(*body);
        }
        if side.curved {
            let key = (side.body, side.ring, side.corner);
            taken.entry(key).or_default().push((reach, node));
        } else {
            let [a, b] = side.ends;
            on.entry([a.min(b), a.max(b)]).or_default().insert(node);
        }
    }
    // Step 3: move the nodes of each straight side onto one line, then rebuild the outlines from the nodes.
    let lines = Lines::new(&nodes, &on);
    lines.settle(&mut nodes);
    rebuild_bodies(bodies, &nodes, taken, touching, gaps)
}

/// Returns all pairs of a node and a side of another body whose distance is at most the smaller of their gaps. Curved
/// sides of the bodies marked in `kept` are left out, because these bodies get no new corners. Returns no pairs if there
/// are more neighbours than [`most_visits`].
///
/// The index contains the nodes, and each side is a query. An index of the sides would be slower: the boxes of hundreds
/// of sides of thin stones can overlap, whereas nodes are points.
fn nodes_near_sides<'s>(nodes: &Nodes, sides: &'s [Side], gaps: &[f64], kept: &[bool]) -> Vec<NodeNearSide<'s>> {
    let ends = |side: &Side| Edge { from: nodes.all[side.ends[0]].at, to: nodes.all[side.ends[1]].at };
    let across = across_longest(sides.iter().map(ends));
    let around = |n: &usize| Aabb::with_direction(&[nodes.all[*n].at], across);
    let nearby = BoxIndex::new((0..nodes.all.len()).collect(), around);
    let mut found = Vec::new();
    let mut visits = most_visits(sides.len());
    for side in sides {
        if side.curved && kept[side.body] {
            continue;
        }
        // Search the box of the side, extended by the gap of its body.
        let Edge { from, to } = ends(side);
        let along = to - from;
        let length = along.norm();
        let around = Aabb::with_direction(&[from, to], across).grown(gaps[side.body]);
        for number in nearby.intersecting(around).copied() {
            visits = visits.saturating_sub(1);
            let node = &nodes.all[number];
            if nodes.bodies(node).binary_search(&side.body).is_ok() {
                continue;
            }
            // The foot of the perpendicular must lie between the ends of the side, and the distance must not exceed the
            // smaller of the two gaps.
            let reach = (node.at - from).dot(&along) / length;
            let foot = from + along * (reach / length);
            let off = (node.at - foot).norm();
            // A side of length 0 gives NaN here. Every comparison with NaN fails, so no node is near such a side.
            let gap = node.gap.min(gaps[side.body]);
            if reach > 0.0 && reach < length && off <= gap {
                found.push(NodeNearSide { node: number, side, reach, off });
            }
        }
        if visits == 0 {
            return Vec::new();
        }
    }
    found
}

/// Returns the sides of all bodies, with the nodes at their ends.
fn sides(bodies: &[Rings], nodes: &Nodes) -> Vec<Side> {
    let mut sides = Vec::with_capacity(bodies.iter().flatten().map(Vec::len).sum());
    for (body, rings) in bodies.iter().enumerate() {
        for (ring, corners) in rings.iter().enumerate() {
            for corner in 0..corners.len() {
                let ends = [corner, (corner + 1) % corners.len()].map(|c| nodes.number(body, ring, c));
                sides.push(Side { body, ring, corner, ends, curved: corners[corner].curved });
            }
        }
    }
    sides
}

/// Rebuilds the outlines: every corner moves to its node, and curved sides get the nodes in `taken` as new corners.
fn rebuild_bodies(
    bodies: &[Rings],
    nodes: &Nodes,
    mut taken: BTreeMap<(usize, usize, usize), Vec<(f64, usize)>>,
    mut touching: Vec<BTreeSet<usize>>,
    gaps: &[f64],
) -> Outcome<'static> {
    let mut moved = Vec::new();
    let mut out = Vec::new();
    for (body, rings) in bodies.iter().enumerate() {
        let (mut corners, mut distance) = (0, 0.0_f64);
        let mut built = Vec::new();
        for (ring, old) in rings.iter().enumerate() {
            let mut new = Vec::with_capacity(old.len());
            for (i, corner) in old.iter().enumerate() {
                let at = nodes.all[nodes.number(body, ring, i)].at;
                let by = (at - corner.at).norm();
                if by > MIN_MOVE * gaps[body] {
                    corners += 1;
                    distance = distance.max(by);
                }
                // Add the corner, then the additional nodes on the curved side that begins at this corner, in order
                // along the side.
                new.push(Corner { at, ..*corner });
                if let Some(mut more) = taken.remove(&(body, ring, i)) {
                    more.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                    corners += more.len();
                    let added = |m: &(f64, usize)| Corner { at: nodes.all[m.1].at, curved: true };
                    new.extend(more.iter().map(added));
                }
            }
            built.push(new);
        }
        if corners > 0 {
            moved.push(Moved { body, corners, distance, to: std::mem::take(&mut touching[body]) });
        }
        out.push(built);
    }
    Outcome { bodies: Cow::Owned(out), moved, kept: Vec::new() }
}

/// Returns the indices of the bodies that snapping damaged. A body is damaged if its rings are no longer a valid
/// polygon, or if a ring changed its direction or lost half of its area. Both bodies of a pair are damaged if they
/// overlap deeper than before, by more than `noise` times the smaller of their gaps.
fn damaged_bodies(before: &[Rings], after: &[Rings], gaps: &[f64], noise: f64) -> BTreeSet<usize> {
    let mut wrong = BTreeSet::new();
    let mut polygons: Vec<Option<Polygon>> = Vec::new();
    for (body, (old, new)) in before.iter().zip(after).enumerate() {
        // A body is damaged if a ring lost its shape or the new outline is not a valid polygon.
        let sound = old.iter().zip(new).all(|(old, new)| {
            let (old, new) = (area(old), area(new));
            // The ring must keep its direction of rotation and more than half of its area.
            new * old.signum() > MIN_AREA_SHARE * old.abs()
        });
        let made = polygon(new).ok().filter(|_| sound);
        if made.is_none() {
            wrong.insert(body);
        }
        polygons.push(made);
    }
    // Compare the depth of each overlap after snapping with the depth before.
    let pieces: Vec<Option<ConvexPieces>> = polygons.iter().map(|p| p.as_ref().map(ConvexPieces::new)).collect();
    let drawn = |body: usize| polygon(&before[body]).ok();
    let entries =
        polygons.iter().enumerate().filter_map(|(i, p)| p.as_ref().map(|p| (Aabb::with_diagonals(p.outline()), i)));
    let nearby = BoxIndex::new(entries.collect(), |entry| entry.0);
    let mut pairs = MAX_PAIRS_PER_CORNER * before.iter().flatten().map(Vec::len).sum::<usize>() + 100_000;
    for (own, (_, a)) in nearby.all() {
        for (_, b) in nearby.intersecting(*own) {
            if b <= a {
                continue;
            }
            if pairs == 0 {
                return (0..before.len()).collect();
            }
            pairs -= 1;
            let (Some(one), Some(two)) = (&pieces[*a], &pieces[*b]) else {
                continue;
            };
            let noise = noise * gaps[*a].min(gaps[*b]);
            // Compute the depth before snapping only for pairs that overlap afterwards.
            let Some(now) = overlap(one, two, noise) else {
                continue;
            };
            let then = drawn(*a)
                .zip(drawn(*b))
                .and_then(|(one, two)| overlap(&ConvexPieces::new(&one), &ConvexPieces::new(&two), 0.0))
                .map_or(0.0, |o| o.depth);
            if now.depth > then + noise {
                wrong.extend([*a, *b]);
            }
        }
    }
    wrong
}

#[cfg(test)]
mod tests;
