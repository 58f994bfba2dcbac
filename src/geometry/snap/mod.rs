//! Snapping: what nearly touches is made to touch. A drawing that is imported and a scene whose coordinates are rounded are
//! healed by the same code.
//!
//! Every body has its own gap; between two bodies the smaller one counts. Corners of different bodies that lie within
//! that gap of each other become one place. Then corners within a gap of another body's side come onto it: a straight side, with all that lies along it, becomes one line and draws the corners there; a
//! side that stands for a piece of a curve takes the corner in. Invariant: no body loses its shape, and no two bodies lie
//! deeper in each other than they were drawn; a body that would is left as it was drawn.

mod line;
mod node;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::{Aabb, BoxIndex, ConvexPieces, Edge, Point, Polygon, PolygonError, cross, overlap};
use line::Lines;
use node::Nodes;

/// A corner of an outline, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    /// Where it lies.
    pub(crate) at: Point,
    /// Whether the side that begins here stands for a piece of a curve.
    pub(crate) curved: bool,
}

/// An outline and its holes, either way round.
pub(crate) type Rings = Vec<Vec<Corner>>;

/// The polygon of an outline and its holes.
pub(crate) fn polygon(rings: &Rings) -> Result<Polygon, Vec<PolygonError>> {
    let points = |ring: &Vec<Corner>| ring.iter().map(|c| c.at).collect::<Vec<Point>>();
    let mut rings = rings.iter().map(points);
    let outline = rings.next().unwrap_or_default();
    Polygon::new(outline, rings.collect())
}

/// Signed area in square metres: positive anticlockwise.
pub(crate) fn area(ring: &[Corner]) -> f64 {
    let Some(base) = ring.first() else { return 0.0 };
    let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
    pairs
        .map(|(a, b)| cross(a.at - base.at, b.at - base.at))
        .sum::<f64>()
        / 2.0
}

/// So many times bodies that came out wrong are put back and the rest is tried again.
const ROUNDS: usize = 12;

/// What is nearer than this part of the gap is there already: a thousandth of what counts as having moved.
const EXACT: f64 = 1e-9;

/// How far corners may move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gaps<'g> {
    /// Each body's gap in metres, 0 for one that takes no part.
    pub(crate) of_body: &'g [f64],
    /// A corner moves by at most this part of its shorter edge; infinite where only the gap counts.
    pub(crate) share_of_edge: f64,
}

impl<'g> Gaps<'g> {
    /// Gaps that count whatever the length of an edge.
    pub(crate) fn new(of_body: &'g [f64]) -> Gaps<'g> {
        Gaps {
            of_body,
            share_of_edge: f64::INFINITY,
        }
    }
}

/// What became of some bodies.
pub(crate) struct Outcome<'b> {
    /// Their outlines; as they were given where none of them changed.
    pub(crate) bodies: Cow<'b, [Rings]>,
    /// Which of them changed.
    pub(crate) moved: Vec<Moved>,
    /// Bodies that had to stay as they were drawn.
    pub(crate) kept: Vec<usize>,
}

/// A body that was changed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Moved {
    /// Its number.
    pub(crate) body: usize,
    /// How many of its corners moved or came in.
    pub(crate) corners: usize,
    /// How far the farthest moved, in metres.
    pub(crate) distance: f64,
    /// What it touches now.
    pub(crate) to: BTreeSet<usize>,
}

/// The bodies with what lies within their gaps of each other brought together. The earlier body stays where two meet.
///
/// A body of `fixed` stays as it is, and
/// corners of others come to it; their sides do not. An overlap of up to `noise`, in parts of the gap between two bodies, is
/// none.
pub(crate) fn snapped<'b>(
    bodies: &'b [Rings],
    gaps: Gaps<'_>,
    fixed: &[bool],
    noise: f64,
) -> Outcome<'b> {
    let mut kept = fixed.to_vec();
    for _ in 0..ROUNDS {
        let mut outcome = attempt(bodies, gaps, &kept);
        if outcome.moved.is_empty() {
            // To the last bit, so that nothing can have come out worse.
            outcome.bodies = Cow::Borrowed(bodies);
        }
        let fresh: Vec<usize> = match &outcome.bodies {
            Cow::Borrowed(_) => Vec::new(),
            Cow::Owned(new) => {
                let wrong = spoilt(bodies, new, gaps.of_body, noise);
                wrong.into_iter().filter(|b| !kept[*b]).collect()
            }
        };
        if fresh.is_empty() {
            outcome.kept = held(&kept, fixed);
            return outcome;
        }
        for body in fresh {
            kept[body] = true;
        }
    }
    Outcome {
        bodies: Cow::Borrowed(bodies),
        moved: Vec::new(),
        kept: held(&vec![true; bodies.len()], fixed),
    }
}

/// The numbers of bodies that stay for another reason than that they are fixed.
fn held(kept: &[bool], fixed: &[bool]) -> Vec<usize> {
    let pairs = kept.iter().zip(fixed).enumerate();
    pairs
        .filter_map(|(b, (kept, fixed))| (*kept && !*fixed).then_some(b))
        .collect()
}

/// A side of a body, between two nodes.
struct Side {
    body: usize,
    ring: usize,
    corner: usize,
    ends: [usize; 2],
    curved: bool,
}

/// A node beside a side of another body, within their gaps.
struct Beside<'s> {
    node: usize,
    side: &'s Side,
    /// How far along the side, and how far off it; metres.
    reach: f64,
    off: f64,
}

fn attempt<'b>(bodies: &'b [Rings], gaps: Gaps<'_>, kept: &[bool]) -> Outcome<'b> {
    let mut nodes = Nodes::new(bodies, gaps, kept);
    let gaps = gaps.of_body;
    let sides = sides(bodies, &nodes);
    let found = beside(&nodes, &sides, gaps, kept);
    // Where everything fits already there is nothing to draw together.
    let fits = |b: &Beside<'_>| !b.side.curved && b.off <= EXACT * nodes.all[b.node].gap;
    if nodes.exact && found.iter().all(fits) {
        return Outcome {
            bodies: Cow::Borrowed(bodies),
            moved: Vec::new(),
            kept: Vec::new(),
        };
    }
    let mut touching: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); bodies.len()];
    for node in &nodes.all {
        let there = nodes.bodies(node);
        for a in there {
            touching[*a].extend(there.iter().filter(|b| *b != a));
        }
    }
    // Where corners lie on straight sides, by the side; and those that curved sides take in, by how far along.
    let mut on: BTreeMap<[usize; 2], BTreeSet<usize>> = BTreeMap::new();
    let mut taken: BTreeMap<(usize, usize, usize), Vec<(f64, usize)>> = BTreeMap::new();
    for Beside {
        node, side, reach, ..
    } in found
    {
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
    let lines = Lines::new(&nodes, &on);
    lines.settle(&mut nodes);
    rebuilt(bodies, &nodes, taken, touching, gaps)
}

/// The nodes that lie beside sides of other bodies. Nodes are looked for about sides, and not the other way round: boxes
/// around the sides of thin stones overlap by the hundred, and points do not.
fn beside<'s>(nodes: &Nodes, sides: &'s [Side], gaps: &[f64], kept: &[bool]) -> Vec<Beside<'s>> {
    let nearby = BoxIndex::new((0..nodes.all.len()).collect(), |n: &usize| {
        let at = nodes.all[*n].at.into();
        Aabb { min: at, max: at }
    });
    let mut found = Vec::new();
    for side in sides {
        if side.curved && kept[side.body] {
            continue;
        }
        let (from, to) = (nodes.all[side.ends[0]].at, nodes.all[side.ends[1]].at);
        let along = to - from;
        let length = along.norm();
        let around = Edge { from, to }.bounds().grown(gaps[side.body]);
        for number in nearby.intersecting(around).copied() {
            let node = &nodes.all[number];
            if nodes.bodies(node).contains(&side.body) {
                continue;
            }
            let reach = (node.at - from).dot(&along) / length;
            let foot = from + along * (reach / length);
            let off = (node.at - foot).norm();
            // Written so that a side of no length takes nothing.
            let gap = node.gap.min(gaps[side.body]);
            if reach > 0.0 && reach < length && off <= gap {
                found.push(Beside {
                    node: number,
                    side,
                    reach,
                    off,
                });
            }
        }
    }
    found
}

fn sides(bodies: &[Rings], nodes: &Nodes) -> Vec<Side> {
    let mut sides = Vec::with_capacity(bodies.iter().flatten().map(Vec::len).sum());
    for (body, rings) in bodies.iter().enumerate() {
        for (ring, corners) in rings.iter().enumerate() {
            for corner in 0..corners.len() {
                let ends =
                    [corner, (corner + 1) % corners.len()].map(|c| nodes.number(body, ring, c));
                sides.push(Side {
                    body,
                    ring,
                    corner,
                    ends,
                    curved: corners[corner].curved,
                });
            }
        }
    }
    sides
}

/// The bodies with their corners where their nodes are.
fn rebuilt(
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
                // Less than a millionth of the gap is the rounding of numbers.
                if by > 1e-6 * gaps[body] {
                    corners += 1;
                    distance = distance.max(by);
                }
                new.push(Corner { at, ..*corner });
                if let Some(mut more) = taken.remove(&(body, ring, i)) {
                    more.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                    corners += more.len();
                    let come_in = |m: &(f64, usize)| Corner {
                        at: nodes.all[m.1].at,
                        curved: true,
                    };
                    new.extend(more.iter().map(come_in));
                }
            }
            built.push(new);
        }
        if corners > 0 {
            moved.push(Moved {
                body,
                corners,
                distance,
                to: std::mem::take(&mut touching[body]),
            });
        }
        out.push(built);
    }
    Outcome {
        bodies: Cow::Owned(out),
        moved,
        kept: Vec::new(),
    }
}

/// Bodies that came out worse than they were drawn.
fn spoilt(before: &[Rings], after: &[Rings], gaps: &[f64], noise: f64) -> BTreeSet<usize> {
    let mut wrong = BTreeSet::new();
    let mut polygons: Vec<Option<Polygon>> = Vec::new();
    for (body, (old, new)) in before.iter().zip(after).enumerate() {
        let sound = old.iter().zip(new).all(|(old, new)| {
            let (old, new) = (area(old), area(new));
            // Not turned over, nor nearly gone.
            new * old.signum() > 0.5 * old.abs()
        });
        let made = polygon(new).ok().filter(|_| sound);
        if made.is_none() {
            wrong.insert(body);
        }
        polygons.push(made);
    }
    let pieces: Vec<Option<ConvexPieces>> = polygons
        .iter()
        .map(|p| p.as_ref().map(ConvexPieces::new))
        .collect();
    let drawn = |body: usize| polygon(&before[body]).ok();
    let entries = polygons
        .iter()
        .enumerate()
        .filter_map(|(i, p)| p.as_ref().map(|p| (Aabb::with_diagonals(p.outline()), i)));
    let nearby = BoxIndex::new(entries.collect(), |entry| entry.0);
    for (own, (_, a)) in nearby.all() {
        for (_, b) in nearby.intersecting(*own) {
            if b <= a {
                continue;
            }
            let (Some(one), Some(two)) = (&pieces[*a], &pieces[*b]) else {
                continue;
            };
            let noise = noise * gaps[*a].min(gaps[*b]);
            let Some(now) = overlap(one, two, noise) else {
                continue;
            };
            let then = drawn(*a)
                .zip(drawn(*b))
                .and_then(|(one, two)| {
                    overlap(&ConvexPieces::new(&one), &ConvexPieces::new(&two), 0.0)
                })
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
