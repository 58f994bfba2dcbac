//! Finds bodies that overlap. If all bodies consist of lattice cells, two bodies overlap if they share a cell.
//! Otherwise two bodies overlap if one penetrates the other by more than the smaller of their contact tolerances
//! ([`Body::gap`]).
//!
//! Two bodies are compared only if both are present in the same frame. Two parts of the ground are never compared.

use std::collections::{BTreeMap, BTreeSet};

use super::finding::Findings;
use super::problem;
use super::{BlockId, Body, BodyId, Frame, size};
use crate::geometry::{Aabb, BoxIndex, Cell, ConvexPieces, Lattice, Overlap, Point, Polygon, Vector, overlap};
use crate::read::Trail;

/// The largest number of overlaps that are reported. If a scene has more, they most likely have one cause.
const MAX_LISTED_OVERLAPS: usize = 1000;
/// An overlap may come from rounding if its depth is less than this fraction of the smaller block's size.
const MAX_ROUNDING_DEPTH: f64 = 0.01;

/// Of `n` bodies, at most `MAX_NEAR_PAIRS + MAX_NEAR_PER_BODY · n` pairs may lie so close together that they may touch.
/// Thousands of equal parts of the ground under hundreds of blocks have millions of contacts.
const MAX_NEAR_PAIRS: usize = 100_000;
/// See [`MAX_NEAR_PAIRS`]. In a wall, a body has about six neighbours.
const MAX_NEAR_PER_BODY: usize = 20;

/// An overlap of two bodies.
struct Found {
    bodies: [BodyId; 2],
    area: f64,
    /// The depth of the overlap, in the units of the file: the distance by which one body must move to leave the other.
    /// For bodies that are not convex, it is the largest depth of any pair of their convex pieces.
    depth: f64,
    at: Point,
    /// Whether the bodies may have been meant to touch, because the depth is less than a hundredth of the smaller
    /// block's size. Always false if all bodies consist of lattice cells.
    may_be_meant: bool,
    /// Whether area and depth are only lower bounds.
    at_least: bool,
    /// The index of the first frame in which both bodies are present.
    frame: usize,
}

/// A valid body with its id.
pub(super) type Numbered<'s> = (BodyId, &'s Body);

/// The bodies to compare, and the data that decide whether an overlap is an error.
pub(super) struct Comparison<'s> {
    /// The bodies that are valid.
    pub(super) bodies: Vec<Numbered<'s>>,
    /// The ids of all blocks.
    pub(super) names: &'s [String],
    /// The frames, which contain the blocks that are present at the same time.
    pub(super) frames: &'s [Frame],
    /// The lattice, if all bodies consist of its cells.
    pub(super) lattice: Option<Lattice>,
    /// Whether the scene gives a contact tolerance. Every overlap that is deeper than this tolerance is then an error.
    pub(super) given: bool,
}

/// Two bodies that overlap although they probably were meant to touch. The depth is more than the contact tolerance,
/// but less than a hundredth of the smaller block's size.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Penetration {
    /// The two bodies. The second is always a block; the first is a part of the ground or an earlier block.
    pub bodies: [BodyId; 2],
    /// The depth of the overlap, metres: the distance by which one body must move to leave the other. For bodies that
    /// are not convex, it is the largest depth of any pair of their convex pieces.
    pub depth: f64,
    /// Centroid of the common area.
    pub at: Point,
}

/// Reports the pairs of bodies that overlap in some frame, at most [`MAX_LISTED_OVERLAPS`] of them. Pairs with a small
/// overlap, which may be a drawing error, are returned and not reported. If the scene gives a contact tolerance, or if
/// more than [`MAX_LISTED_OVERLAPS`] pairs overlap, small overlaps are reported too and the returned list is empty.
pub(super) fn check(findings: &mut Findings, scene: &Comparison<'_>) -> Vec<Penetration> {
    let most = MAX_NEAR_PAIRS + MAX_NEAR_PER_BODY * scene.bodies.len();
    let (near, count) = near_pairs(&scene.bodies, most);
    let presence = Presence::new(scene.names.len(), scene.frames);
    let mut found = match scene.lattice {
        Some(lattice) => on_lattice(&scene.bodies, lattice, &presence),
        None => off_lattice(&scene.bodies, &near, &presence),
    };
    found.sort_by_key(|f| (f.bodies[1], f.bodies[0]));
    let all = found.len();
    let (slight, found): (Vec<Found>, Vec<Found>) =
        (found.into_iter()).partition(|f| f.may_be_meant && !scene.given && all <= MAX_LISTED_OVERLAPS);
    let top = Trail::Top;
    let list = top.key("blocks");
    if found.is_empty() && count > most {
        findings.add(&list, problem::outline::too_close(count, most, scene.bodies.len()));
    }
    for f in found.iter().take(MAX_LISTED_OVERLAPS) {
        let BodyId::Block(block) = f.bodies[1] else {
            continue;
        };
        let name = |id: BodyId| match id {
            BodyId::Ground(i) => format!("ground[{i}]"),
            BodyId::Block(b) => format!("block `{}`", crate::text::shortened(&scene.names[b.0])),
        };
        let frame = (scene.frames.len() > 1).then(|| match scene.frames[f.frame].title.as_str() {
            "" => format!("steps[{}]", f.frame),
            title => format!("steps[{}], \"{}\"", f.frame, crate::text::shortened(title)),
        });
        let wording = problem::outline::overlap(
            &name(f.bodies[1]),
            &name(f.bodies[0]),
            &problem::outline::Common {
                depth: f.depth,
                area: f.area,
                at: f.at,
                may_be_meant: f.may_be_meant,
                at_least: f.at_least,
            },
            frame.as_deref(),
            findings.units,
        )
        .at(problem::Place::Between(f.at, f.bodies[0]));
        findings.add(&list.index(block.0), wording);
    }
    if found.len() > MAX_LISTED_OVERLAPS {
        findings.add(&list, problem::outline::more_overlaps(MAX_LISTED_OVERLAPS));
    }
    let slight = slight.into_iter().map(|f| Penetration { bodies: f.bodies, depth: f.depth, at: f.at });
    slight.collect()
}

/// The frames in which each body is present, as ranges with the index of the first and of the last frame.
struct Presence {
    /// The ranges of each block.
    blocks: Vec<Vec<(usize, usize)>>,
    /// The range of all frames, for the ground.
    always: Vec<(usize, usize)>,
}

impl Presence {
    fn new(blocks: usize, frames: &[Frame]) -> Presence {
        let mut spans: Vec<Vec<(usize, usize)>> = vec![Vec::new(); blocks];
        for (k, frame) in frames.iter().enumerate() {
            for block in &frame.placed {
                let spans = &mut spans[block.0];
                match spans.last_mut() {
                    Some(last) if last.1 + 1 == k => last.1 = k,
                    _ => spans.push((k, k)),
                }
            }
        }
        Presence { blocks: spans, always: vec![(0, frames.len().saturating_sub(1))] }
    }

    fn of_body(&self, id: BodyId) -> &[(usize, usize)] {
        match id {
            BodyId::Ground(_) => &self.always,
            BodyId::Block(BlockId(i)) => &self.blocks[i],
        }
    }

    /// Returns the index of the first frame in which both bodies are present. `None` if there is no such frame, or if
    /// both bodies are parts of the ground.
    fn together(&self, a: BodyId, b: BodyId) -> Option<usize> {
        if matches!((a, b), (BodyId::Ground(_), BodyId::Ground(_))) {
            return None;
        }
        let (a, b) = (self.of_body(a), self.of_body(b));
        let (mut i, mut j) = (0, 0);
        while i < a.len() && j < b.len() {
            let start = a[i].0.max(b[j].0);
            if start <= a[i].1.min(b[j].1) {
                return Some(start);
            }
            if a[i].1 < b[j].1 { i += 1 } else { j += 1 }
        }
        None
    }
}

fn on_lattice(bodies: &[Numbered<'_>], lattice: Lattice, presence: &Presence) -> Vec<Found> {
    let mut owners: BTreeMap<Cell, Vec<BodyId>> = BTreeMap::new();
    for (id, body) in bodies {
        for cell in body.cells.iter().flatten() {
            owners.entry(*cell).or_default().push(*id);
        }
    }
    let mut shared: BTreeMap<[BodyId; 2], (usize, Vec<Cell>)> = BTreeMap::new();
    'cells: for (cell, owners) in &owners {
        for (i, a) in owners.iter().enumerate() {
            for b in &owners[i + 1..] {
                let pair = [*a.min(b), *a.max(b)];
                if let Some(known) = shared.get_mut(&pair) {
                    known.1.push(*cell);
                } else if let Some(frame) = presence.together(pair[0], pair[1]) {
                    shared.insert(pair, (frame, vec![*cell]));
                    if shared.len() > MAX_LISTED_OVERLAPS {
                        break 'cells;
                    }
                }
            }
        }
    }
    let polygons: BTreeMap<BodyId, &Polygon> = (bodies.iter()).map(|(id, body)| (*id, &body.polygon)).collect();
    shared
        .into_iter()
        .map(|(bodies, (frame, cells))| {
            let sum = cells.iter().fold(Vector::zeros(), |s, c| s + lattice.cell_centre(*c).coords);
            let count = cells.len() as f64;
            let pieces = |id: BodyId| polygons.get(&id).copied().map(ConvexPieces::new);
            let deep = pieces(bodies[0]).zip(pieces(bodies[1])).and_then(|(a, b)| overlap(&a, &b, 0.0));
            Found {
                bodies,
                area: count * lattice.cell_area(),
                depth: deep.map_or(0.0, |o| o.depth),
                may_be_meant: false,
                at_least: false,
                at: Point::from(sum / count),
                frame,
            }
        })
        .collect()
}

/// Returns the pairs of bodies that may touch or overlap: those whose boxes are at most a hundredth of a body's size
/// apart, the later body first. The body is given by its index; two parts of the ground are no pair. Also returns the
/// number of pairs; if it exceeds `most`, the list has only the first of them.
fn near_pairs(bodies: &[Numbered<'_>], most: usize) -> (Vec<[usize; 2]>, usize) {
    let around = |(_, body): &Numbered<'_>| {
        Aabb::with_diagonals(body.polygon.outline()).grown((MAX_ROUNDING_DEPTH * size(&body.polygon)).max(body.gap))
    };
    let boxes: Vec<Aabb<4>> = bodies.iter().map(around).collect();
    let nearby = BoxIndex::new((0..bodies.len()).collect(), |i: &usize| boxes[*i]);
    let (mut pairs, mut count) = (Vec::new(), 0);
    for (i, (id, _)) in bodies.iter().enumerate().filter(|(_, b)| matches!(b.0, BodyId::Block(_))) {
        let first = pairs.len();
        let others = nearby.intersecting(boxes[i]).copied().filter(|j| bodies[*j].0 < *id);
        if count > most {
            count += others.count();
            continue;
        }
        pairs.extend(others.map(|j| [i, j]));
        pairs[first..].sort_unstable();
        count = pairs.len();
    }
    (pairs, count)
}

fn off_lattice(bodies: &[Numbered<'_>], near: &[[usize; 2]], presence: &Presence) -> Vec<Found> {
    let pieces: Vec<ConvexPieces> = bodies.iter().map(|(_, body)| ConvexPieces::new(&body.polygon)).collect();
    let mut found = Vec::new();
    for [i, j] in near.iter().copied() {
        let pair = [bodies[j].0, bodies[i].0];
        let gap = bodies[i].1.gap.min(bodies[j].1.gap);
        if let Some(frame) = presence.together(pair[0], pair[1])
            && let Some(o) = common([bodies[i].1, bodies[j].1], [&pieces[i], &pieces[j]], gap)
        {
            let blocks = [bodies[i], bodies[j]].into_iter();
            let sizes = blocks.filter(|b| matches!(b.0, BodyId::Block(_))).map(|b| size(&b.1.polygon));
            let meant = MAX_ROUNDING_DEPTH * sizes.fold(f64::INFINITY, f64::min);
            found.push(Found {
                bodies: pair,
                area: o.area,
                depth: o.depth,
                may_be_meant: o.depth < meant && !o.at_least,
                at_least: o.at_least,
                at: o.at,
                frame,
            });
        }
        if found.len() > MAX_LISTED_OVERLAPS {
            break;
        }
    }
    found
}

/// Returns the common area of two bodies if one penetrates the other by more than `gap`. The depth is exact for circles
/// too; their area and its centroid come from the polygons that stand for them.
fn common([a, b]: [&Body; 2], [one, other]: [&ConvexPieces<'_>; 2], gap: f64) -> Option<Overlap> {
    let depth = match (a.circle, b.circle) {
        (None, None) => return overlap(one, other, gap),
        (Some(a), Some(b)) => b.radius - a.distance(b.centre),
        (Some(circle), None) => circle.depth_in(&b.polygon),
        (None, Some(circle)) => circle.depth_in(&a.polygon),
    };
    let drawn = || overlap(one, other, 0.0).unwrap_or(Overlap { area: 0.0, at: a.centroid(), depth, at_least: false });
    (depth > gap).then(|| Overlap { depth, ..drawn() })
}

/// The largest number of bodies in one frame whose corners may meet at one point. These bodies have 4 950 contacts, for
/// which the computation takes half a second.
///
/// Each pair of corners at the point is a separate contact. No contact can replace others, because two corners push
/// each other along the difference of their bisectors, and this direction differs from pair to pair. n corners at one
/// point lead to n·(n − 1)/2 contacts, and to a dense linear program of 3·n rows. For 400 wedges, in a file of 48 KB,
/// these are 79 800 contacts and a computation of 20 s.
pub(super) const MAX_BODIES_AT_POINT: usize = 100;

/// In a frame of `n` bodies, at most `MAX_TIPS + MAX_TIPS_PER_BODY · n` pairs of corners may meet. In a regular tiling, a
/// body has less than ten.
const MAX_TIPS: usize = 10_000;
/// See [`MAX_TIPS`].
const MAX_TIPS_PER_BODY: usize = 10;

/// Reports a point at which corners of more than [`MAX_BODIES_AT_POINT`] bodies meet in one frame: of several such
/// points, the one with the smallest x. Otherwise reports if the corners of all points make too many pairs. Corners
/// within about `gap`, in the units of the file, count as corners at the same point.
pub(super) fn check_crowding(findings: &mut Findings, bodies: &[Numbered<'_>], frames: &[Frame], gap: f64) {
    let (at_point, pairs) = crowded(bodies, frames, gap);
    let most = MAX_TIPS + MAX_TIPS_PER_BODY * bodies.len();
    let wording = match at_point {
        Some((at, count)) => problem::outline::crowded(count, MAX_BODIES_AT_POINT, at),
        None if pairs > most => problem::outline::crowded_everywhere(pairs, most),
        None => return,
    };
    findings.add(&Trail::Top.key("corner_contacts"), wording);
}

/// Returns the point of smallest x at which corners of more than [`MAX_BODIES_AT_POINT`] bodies meet in one frame, with
/// the number of these bodies in the frame that contains most of them; `None` if there is no such point. Also returns
/// the largest number of pairs of corners that meet in a frame.
fn crowded(bodies: &[Numbered<'_>], frames: &[Frame], gap: f64) -> (Option<(Point, usize)>, usize) {
    // Adding 0 turns −0 into 0, because `total_cmp` below distinguishes −0 from 0.
    let cell = |v: f64| if gap > 0.0 { (v / gap).round() } else { v } + 0.0;
    let mut corners: Vec<([f64; 2], Point, BodyId)> = Vec::new();
    for (id, body) in bodies {
        let own = body.polygon.rings().iter().flatten().filter(|_| body.circle.is_none());
        corners.extend(own.map(|p| ([cell(p.x), cell(p.y)], *p, *id)));
    }
    corners.sort_by(|(a, _, one), (b, _, two)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(one.cmp(two)));
    // For each point, its place, and the number of bodies there: now, and in the frame that contains most of them.
    let mut points: Vec<(Point, usize, usize)> = Vec::new();
    let mut points_of: BTreeMap<BlockId, Vec<usize>> = BTreeMap::new();
    let mut pairs = 0;
    for group in corners.chunk_by(|a, b| a.0 == b.0).filter(|group| group[0].2 < group[group.len() - 1].2) {
        let mut ground = 0;
        for (_, _, id) in group.chunk_by(|a, b| a.2 == b.2).map(|same| same[0]) {
            match id {
                BodyId::Ground(_) => ground += 1,
                BodyId::Block(block) => points_of.entry(block).or_default().push(points.len()),
            }
        }
        pairs += ground * usize::saturating_sub(ground, 1) / 2;
        points.push((group[0].1, ground, ground));
    }
    let mut most = pairs;
    let mut present: BTreeSet<BlockId> = BTreeSet::new();
    for frame in frames {
        let placed: BTreeSet<BlockId> = frame.placed.iter().copied().filter(|id| points_of.contains_key(id)).collect();
        for gone in present.difference(&placed) {
            for point in &points_of[gone] {
                points[*point].1 -= 1;
                pairs -= points[*point].1;
            }
        }
        for new in placed.difference(&present) {
            for point in &points_of[new] {
                pairs += points[*point].1;
                points[*point].1 += 1;
                points[*point].2 = points[*point].2.max(points[*point].1);
            }
        }
        present = placed;
        most = most.max(pairs);
    }
    let crowded = points.iter().find(|(_, _, count)| *count > MAX_BODIES_AT_POINT);
    (crowded.map(|(at, _, count)| (*at, *count)), most)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(placed: &[usize]) -> Frame {
        Frame {
            title: String::new(),
            placed: placed.iter().copied().map(BlockId).collect(),
            holds: Vec::new(),
            plans: Vec::new(),
            expected: None,
        }
    }

    #[test]
    fn the_first_common_frame_of_two_bodies_is_found() {
        let frames = [frame(&[0]), frame(&[0, 1]), frame(&[1]), frame(&[1, 2]), frame(&[0])];
        let presence = Presence::new(3, &frames);
        let block = |i| BodyId::Block(BlockId(i));
        assert_eq!(presence.together(block(0), block(1)), Some(1));
        assert_eq!(presence.together(block(0), block(2)), None);
        assert_eq!(presence.together(block(2), block(1)), Some(3));
        assert_eq!(presence.together(block(2), BodyId::Ground(0)), Some(3));
        assert_eq!(presence.together(BodyId::Ground(0), BodyId::Ground(1)), None);
    }
}
