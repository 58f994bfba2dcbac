//! [`FreeEdges`]: the parts of the outlines of all blocks that touch no other body, and the path along them from one
//! point to another.

use crate::geometry::{Aabb, BoxIndex, Edge, Point};
use crate::mechanics::scene::{Block, BlockId, Body, Ground};

/// Two parts of edges follow each other if their ends are at most this many gaps apart: the joint between two blocks may
/// end in a ledge that is shorter than the gap.
const MAX_GAPS_APART: f64 = 4.0;

/// A point lies on the outline if its distance from it is at most this fraction of the size of all blocks.
const MAX_DISTANCE_PER_SIZE: f64 = 0.01;

/// Lengths that are smaller than this fraction of the size of all blocks are rounding errors.
const ROUNDING_PER_SIZE: f64 = 1e-9;

/// Two edges touch only if the sine of the angle between them is at most this.
const MAX_SINE: f64 = 0.05;

/// A part of an edge of a block. The block is on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub block: BlockId,
    pub ends: [Point; 2],
    /// Where the ends lie between the first and the last point of the path or side, from 0 to 1.
    pub shares: [f64; 2],
}

impl Stretch {
    fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    /// Returns the distance of a point from the part of the edge, and the nearest place on it, from 0 to 1.
    fn nearest(&self, point: Point) -> (f64, f64) {
        let along = self.ends[1] - self.ends[0];
        let share = ((point - self.ends[0]).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        ((point - (self.ends[0] + along * share)).norm(), share)
    }

    /// Returns the part from the place `from` to the place `to`, both from 0 to 1.
    fn part(&self, [from, to]: [f64; 2]) -> Stretch {
        let along = self.ends[1] - self.ends[0];
        Stretch { ends: [from, to].map(|share| self.ends[0] + along * share), ..*self }
    }
}

/// The index of a point that lies on no free edge, and the nearest point of a free edge, if there is any.
pub(super) type Outside = (usize, Option<Point>);

/// The parts of the outlines of all blocks that touch no other body.
pub(super) struct FreeEdges {
    parts: Vec<Stretch>,
    /// For each part, the index of the part that follows it.
    next: Vec<Option<usize>>,
    /// The size of all blocks.
    size: f64,
}

impl FreeEdges {
    /// Finds the free edges of the blocks. Blocks of all steps count.
    pub fn new(ground: &[Option<Ground>], blocks: &[Option<Block>]) -> FreeEdges {
        let grounds = ground.iter().flatten().map(|ground| (usize::MAX, &ground.body));
        let solid = blocks.iter().enumerate().filter_map(|(number, block)| Some((number, &block.as_ref()?.body)));
        let solid: Vec<(usize, &Body)> = solid.filter(|(_, body)| !body.is_schematic).collect();
        let sides = grounds.chain(solid.iter().copied());
        let sides = sides.flat_map(|(number, body)| body.polygon.edges().map(move |edge| (number, edge, body.gap)));
        let sides = BoxIndex::new(sides.collect(), |(_, edge, gap): &(usize, Edge, f64)| edge.bounds().grown(*gap));
        let bounds = solid.iter().map(|(_, body)| body.polygon.bounds()).reduce(|all, more| all.union(more));
        let size = bounds.map_or(0.0, |bounds| bounds.diagonal());
        let rounding = ROUNDING_PER_SIZE * size;
        let mut parts = Vec::new();
        for (number, body) in &solid {
            for edge in body.polygon.edges() {
                let touching = sides.intersecting(edge.bounds().grown(body.gap + rounding));
                let others = touching.filter(|(other, ..)| other != number);
                let covered = others.filter_map(|(_, other, gap)| covered(edge, *other, gap.min(body.gap) + rounding));
                let free = without(covered.collect()).into_iter();
                let whole = Stretch { block: BlockId(*number), ends: [edge.from, edge.to], shares: [0.0; 2] };
                parts.extend(free.map(|range| whole.part(range)).filter(|part| part.length() > body.gap + rounding));
            }
        }
        let gap = solid.iter().map(|(_, body)| body.gap).fold(0.0, f64::max);
        let next = followers(&parts, MAX_GAPS_APART * (gap + rounding));
        FreeEdges { parts, next, size }
    }

    /// Returns the free edges between two points. The shares run from the first to the second point.
    ///
    /// # Errors
    /// The first point that lies on no free edge; `None` if other bodies interrupt the outline between the points.
    pub fn between(&self, points: [Point; 2]) -> Result<Vec<Stretch>, Option<Outside>> {
        let mut places = [(0, 0.0); 2];
        for (number, point) in points.into_iter().enumerate() {
            let near = self.parts.iter().enumerate().map(|(index, part)| (index, part.nearest(point)));
            let nearest = near.min_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
            match nearest {
                Some((index, (distance, share))) if distance <= MAX_DISTANCE_PER_SIZE * self.size => {
                    places[number] = (index, share);
                }
                nearest => {
                    let at = nearest.map(|(index, (_, share))| self.parts[index].part([share, share]).ends[0]);
                    return Err(Some((number, at)));
                }
            }
        }
        let [first, last] = places;
        // The blocks are on the left of every edge. So one of the two paths runs from the first point to the second, the
        // other one back.
        let there = self.path(first, last).map(|path| with_shares(path, false));
        let back = self.path(last, first).map(|path| with_shares(path, true));
        let length = |path: &[Stretch]| path.iter().map(Stretch::length).sum::<f64>();
        match (there, back) {
            (Some(there), Some(back)) => Ok(if length(&back) < length(&there) { back } else { there }),
            (Some(path), None) | (None, Some(path)) => Ok(path),
            (None, None) => Err(None),
        }
    }

    /// Returns the parts of free edges from one place to another, in the direction of the edges. A place is a part and a
    /// share of its length. `None` if the path ends before.
    fn path(&self, (first, from): (usize, f64), (last, to): (usize, f64)) -> Option<Vec<Stretch>> {
        if first == last && from <= to {
            return Some(vec![self.parts[first].part([from, to])]);
        }
        let behind = || std::iter::successors(self.next[first], |at| self.next[*at]).take(self.parts.len());
        let between = behind().position(|at| at == last)?;
        let mut path = vec![self.parts[first].part([from, 1.0])];
        path.extend(behind().take(between).map(|at| self.parts[at]));
        path.push(self.parts[last].part([0.0, to]));
        Some(path)
    }
}

/// Returns, for each part, the index of the part that begins nearest to its end, at most `join` from it.
fn followers(parts: &[Stretch], join: f64) -> Vec<Option<usize>> {
    let starts = BoxIndex::new((0..parts.len()).collect(), |part: &usize| around(parts[*part].ends[0], 0.0));
    let follower = |(at, part): (usize, &Stretch)| {
        let distance = |next: &usize| (parts[*next].ends[0] - part.ends[1]).norm();
        let next = starts.intersecting(around(part.ends[1], join)).copied().filter(|next| *next != at);
        next.filter(|next| distance(next) <= join).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    parts.iter().enumerate().map(follower).collect()
}

/// Sets the shares of the parts of a path: from 0 to 1, or back if the path runs from the second point to the first.
/// Leaves out parts without length.
fn with_shares(path: Vec<Stretch>, is_back: bool) -> Vec<Stretch> {
    let total: f64 = path.iter().map(Stretch::length).sum();
    let mut before = 0.0;
    let share = |at: f64| if is_back { 1.0 - at / total } else { at / total };
    let mut parts = Vec::with_capacity(path.len());
    for part in path {
        let length = part.length();
        if length > ROUNDING_PER_SIZE * total {
            parts.push(Stretch { shares: [share(before), share(before + length)], ..part });
        }
        before += length;
    }
    parts
}

fn around(point: Point, distance: f64) -> Aabb {
    Aabb { min: [point.x, point.y], max: [point.x, point.y] }.grown(distance)
}

/// Returns the part of an edge that another edge covers: from one share of its length to another. `None` if they do not
/// touch.
fn covered(edge: Edge, other: Edge, gap: f64) -> Option<[f64; 2]> {
    let length = edge.length();
    let along = edge.vector() / length;
    let across = edge.outward();
    if other.vector().dot(&along) >= 0.0 || other.vector().dot(&across).abs() > MAX_SINE * other.length() + gap {
        return None;
    }
    let place = |point: Point| ((point - edge.from).dot(&along), (point - edge.from).dot(&across));
    let [(end, end_height), (start, start_height)] = [place(other.from), place(other.to)];
    let height = |at: f64| start_height + (end_height - start_height) * ((at - start) / (end - start));
    let range = [start.max(0.0), end.min(length)];
    let touches = range[0] < range[1] && range.iter().all(|at| height(*at).abs() <= gap);
    touches.then(|| range.map(|at| at / length))
}

/// Returns what remains of the range from 0 to 1 without the given ranges.
fn without(mut ranges: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut rest = Vec::new();
    let mut from = 0.0;
    for [start, end] in ranges {
        if start > from {
            rest.push([from, start]);
        }
        from = end.max(from);
    }
    if from < 1.0 {
        rest.push([from, 1.0]);
    }
    rest
}
