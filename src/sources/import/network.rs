//! [`join`]: makes outlines of open lines that meet, and cuts closed outlines along the lines that cross them.
//!
//! 1. Ends of lines within the tolerance are one node. Lines of one group that form a plain ring, in which two lines
//!    meet at every node, become an outline.
//! 2. The other lines, and the closed outlines near them, are split where they cross, touch or end on each other. The
//!    pieces are the edges of a planar graph; of equal pieces, one is kept.
//! 3. The faces of the graph are walked with half-edges: at the end of an edge, the walk goes on along the next edge
//!    clockwise. Edges with the same face on both sides enclose nothing. Reference: de Berg et al., Computational
//!    Geometry, 2008, section 2.2.
//! 4. A face in a closed outline that lines cut is a part of it. A face outside of all outlines is a block, if a line is
//!    on its boundary.

use std::collections::{BTreeMap, BTreeSet};

use super::draft::{Draft, FillRule, Part, PartGeometry, Role};
use super::region::{crossings, is_inside};
use super::subpath::{Segment, Subpath};
use crate::geometry::{Aabb, BoxIndex, Point, cross, orientation};

/// Lines with more chords, or with more crossings, are not joined.
const MAX_CHORDS: usize = 200_000;
/// Chords of curves are within this share of the tolerance while crossings are found.
const CHORD_TOL: f64 = 0.1;
/// The tolerance is at most this share of the length of the shorter lines: of the twentieth part that is shortest.
const MAX_SHARE_OF_LENGTH: f64 = 0.25;

/// An open line, with the part from which it comes.
struct Line {
    curve: Subpath,
    part: Part,
}

/// An edge of the graph.
struct Edge {
    /// The nodes of both ends; the curve begins and ends exactly at their places.
    ends: [usize; 2],
    curve: Subpath,
    /// Points along the curve, including both of its ends.
    points: Vec<Point>,
    /// The lines and outlines of which this is a piece.
    owners: BTreeSet<usize>,
}

/// A closed walk along half-edges: the edges, and whether each is reversed.
struct Walk {
    halves: Vec<(usize, bool)>,
    points: Vec<Point>,
    area: f64,
}

/// Replaces the open lines of a draft by the outlines that they form. `tolerance` is the distance, in metres, within
/// which ends meet. Lines that enclose nothing are reported.
pub(super) fn join(draft: &mut Draft, tolerance: f64) {
    let mut closed: Vec<Part> = Vec::new();
    let mut groups: BTreeMap<(usize, u8), Vec<Line>> = BTreeMap::new();
    for part in std::mem::take(&mut draft.parts) {
        let PartGeometry::Subpaths(subpaths, rule) = &part.form else {
            closed.push(part);
            continue;
        };
        let (mut rings, mut open) = (Vec::new(), Vec::new());
        for subpath in subpaths {
            let is_ring = subpath.closed || (subpath.segments.len() > 1 && meets(subpath, tolerance));
            if is_ring { &mut rings } else { &mut open }.push(Subpath { closed: is_ring, ..subpath.clone() });
        }
        let key = (part.group, part.kind as u8);
        let template = Part { form: PartGeometry::Subpaths(Vec::new(), *rule), ..part.clone() };
        groups.entry(key).or_default().extend(open.into_iter().map(|curve| Line { curve, part: template.clone() }));
        if !rings.is_empty() || subpaths.is_empty() {
            closed.push(Part { form: PartGeometry::Subpaths(rings, *rule), ..part });
        }
    }
    let mut left = Vec::new();
    for lines in groups.into_values() {
        left.extend(rings(lines, tolerance, &mut closed));
    }
    draft.parts = closed;
    let (robots, left): (Vec<Line>, Vec<Line>) = left.into_iter().partition(|line| line.part.kind == Role::Robot);
    let unused = if left.is_empty() { left } else { faces_between(draft, left, tolerance) };
    for line in robots.into_iter().chain(unused) {
        let help = "close it; if it is not a block, give it or its layer a name that begins with ignore";
        draft.lose("line", &line.part.element, "it is open", help);
    }
}

fn meets(curve: &Subpath, tolerance: f64) -> bool {
    (curve.end() - curve.start).norm() <= tolerance
}

/// Adds the plain rings that the lines of one group form to `closed`, and returns the other lines (step 1).
fn rings(lines: Vec<Line>, tolerance: f64, closed: &mut Vec<Part>) -> Vec<Line> {
    let mut nodes = Nodes::new(tolerance);
    let edge = |(i, line): (usize, &Line)| Edge::new(&mut nodes, line.curve.clone(), i, tolerance);
    let edges: Vec<Edge> = lines.iter().enumerate().map(edge).collect();
    let mut alive = vec![true; edges.len()];
    // Where more or less than two ends meet, the lines are taken away, and then those that met them.
    let mut at_node: Vec<Vec<usize>> = vec![Vec::new(); nodes.places.len()];
    edges.iter().enumerate().for_each(|(i, edge)| edge.ends.iter().for_each(|node| at_node[*node].push(i)));
    let mut odd: Vec<usize> = (0..at_node.len()).filter(|node| at_node[*node].len() != 2).collect();
    while let Some(node) = odd.pop() {
        for edge in std::mem::take(&mut at_node[node]) {
            alive[edge] = false;
            odd.extend(edges[edge].ends.iter().filter(|node| !at_node[**node].is_empty()));
        }
    }
    let mut used = vec![false; lines.len()];
    for walk in walks(&edges, &alive).into_iter().filter(|walk| walk.area > 0.0) {
        let first = walk.halves.iter().map(|half| half.0).min().unwrap_or(0);
        walk.halves.iter().for_each(|half| used[half.0] = true);
        let form = PartGeometry::Subpaths(vec![outline(&walk, &edges)], FillRule::EvenOdd);
        closed.push(Part { form, ..lines[first].part.clone() });
    }
    let unused = lines.into_iter().zip(used).filter(|(_, used)| !used);
    unused.map(|(line, _)| line).collect()
}

/// Adds the faces between the lines to the draft, and cuts its outlines along the lines (steps 2 to 4). Returns the
/// lines that enclose nothing.
fn faces_between(draft: &mut Draft, lines: Vec<Line>, tolerance: f64) -> Vec<Line> {
    let mut lengths: Vec<f64> =
        lines.iter().flat_map(|line| line.curve.starts()).map(|(a, s)| (s.end() - a).norm()).collect();
    lengths.sort_by(f64::total_cmp);
    let tolerance = tolerance.min(MAX_SHARE_OF_LENGTH * lengths[lengths.len() / 20]);
    let boxes = BoxIndex::new(lines.iter().map(|line| around(&line.curve.hull())).collect(), |b| *b);
    let touches = |ring: &Subpath| boxes.intersecting(around(&ring.hull()).grown(tolerance)).next().is_some();
    let is_near = |part: &Part| part.kind != Role::Robot && part.subpaths().iter().any(touches);
    let near: Vec<usize> = (0..draft.parts.len()).filter(|i| is_near(&draft.parts[*i])).collect();
    // The lines come first, then the outlines near them.
    let mut curves: Vec<(usize, &Subpath)> = lines.iter().enumerate().map(|(i, line)| (i, &line.curve)).collect();
    for (k, i) in near.iter().enumerate() {
        curves.extend(draft.parts[*i].subpaths().iter().map(|ring| (lines.len() + k, ring)));
    }
    let Some(edges) = split(&curves, tolerance) else {
        let help = "give layers without blocks names that begin with ignore";
        draft.remark("", "its lines cross too often to find the blocks between them", help);
        return lines;
    };
    let everything = vec![true; edges.len()];
    let mut seen = vec![0; edges.len()];
    let mut alive = everything.clone();
    for (number, walk) in walks(&edges, &everything).iter().enumerate() {
        for (edge, _) in &walk.halves {
            // Both sides of the edge are in this walk: the same face is on both.
            alive[*edge] &= std::mem::replace(&mut seen[*edge], number + 1) != number + 1;
        }
    }
    let is_line = |owner: &&usize| **owner < lines.len();
    let outlines: Vec<Vec<Vec<Point>>> = near.iter().map(|i| sampled(&draft.parts[*i], tolerance)).collect();
    let is_in = |outline: &[Vec<Point>], p: Point| outline.iter().filter(|ring| is_inside(ring, p)).count() % 2 == 1;
    let cuts = |k: usize| {
        edges.iter().zip(&alive).any(|(edge, alive)| {
            let is_other = edge.owners.iter().any(|o| *o < lines.len()) && !edge.owners.contains(&(lines.len() + k));
            *alive && is_other && is_in(&outlines[k], edge.middle())
        })
    };
    let is_cut: Vec<bool> = (0..near.len()).map(cuts).collect();
    let (mut spaces, mut made) = (0, Vec::new());
    for rings in faces(&walks(&edges, &alive)) {
        let Some(inside) = point_in(&rings, tolerance) else { continue };
        let form = PartGeometry::Subpaths(rings.iter().map(|walk| outline(walk, &edges)).collect(), FillRule::EvenOdd);
        let holders: Vec<usize> =
            (0..near.len()).filter(|k| outlines[*k].iter().any(|ring| is_inside(ring, inside))).collect();
        let cut = holders.iter().find(|k| is_cut[**k] && is_in(&outlines[**k], inside));
        if let Some(k) = cut {
            made.push(Part { form, ..draft.parts[near[*k]].clone() });
        } else if holders.is_empty() {
            let mut shares: BTreeMap<usize, f64> = BTreeMap::new();
            for (edge, _) in rings.iter().flat_map(|walk| &walk.halves) {
                for owner in edges[*edge].owners.iter().filter(is_line) {
                    *shares.entry(*owner).or_default() += edges[*edge].length();
                }
            }
            // The line with the largest share gives its role and its layer, and its name if all have the same.
            let longest = shares.iter().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0)));
            let Some((owner, _)) = longest else { continue };
            let part = lines[*owner].part.clone();
            let is_named = shares.keys().all(|other| lines[*other].part.name == part.name);
            made.push(Part { form, name: if is_named { part.name.clone() } else { String::new() }, ..part });
            spaces += 1;
        }
    }
    let living = edges.iter().zip(&alive).filter(|(_, alive)| **alive);
    let used: BTreeSet<usize> = living.flat_map(|(edge, _)| edge.owners.iter().copied()).collect();
    if spaces > 0 {
        draft.notes.push(format!(
            "outlines between lines that meet: {spaces}; if one is an opening, leave it out with --ignore X,Y"
        ));
    }
    let cut: BTreeSet<usize> = near.into_iter().zip(is_cut).filter(|(_, is_cut)| *is_cut).map(|(i, _)| i).collect();
    if !cut.is_empty() {
        let names: Vec<&str> = cut.iter().map(|i| draft.parts[*i].element.as_str()).collect();
        let names = crate::text::first_of(names, super::MAX_NAMES);
        draft.notes.push(format!("cut along the lines that cross it: {names}"));
    }
    let mut number = 0;
    draft.parts.retain(|_| {
        number += 1;
        !cut.contains(&(number - 1))
    });
    draft.parts.extend(made);
    lines.into_iter().enumerate().filter(|(i, _)| !used.contains(i)).map(|(_, line)| line).collect()
}

/// Splits curves where they cross, touch or end on each other (step 2). A curve comes with the number of its owner.
/// Returns `None` if there are too many chords or crossings.
fn split(curves: &[(usize, &Subpath)], tolerance: f64) -> Option<Vec<Edge>> {
    let strands: Vec<(usize, Point, Segment)> = curves
        .iter()
        .flat_map(|(owner, curve)| curve.starts().map(|(from, segment)| (*owner, from, segment)))
        .collect();
    let chords_of = |(number, (_, from, segment)): (usize, &(usize, Point, Segment))| {
        let points = points_along(*from, segment, tolerance);
        let share = 1.0 / (points.len() - 1) as f64;
        let pairs: Vec<[Point; 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        pairs.into_iter().enumerate().map(move |(k, ends)| (number, k as f64 * share, share, ends))
    };
    let chords: Vec<(usize, f64, f64, [Point; 2])> = strands.iter().enumerate().flat_map(chords_of).collect();
    if chords.len() > MAX_CHORDS {
        return None;
    }
    let index = BoxIndex::new(chords.clone(), |chord| around(&chord.3).grown(tolerance));
    // Half of a curve that returns to its start is never the whole of it.
    let halves = |(_, from, segment): &(usize, Point, Segment)| match segment {
        Segment::Line(_) => Vec::new(),
        _ => vec![(0.5, segment.at(*from, 0.5))],
    };
    let mut cuts: Vec<Vec<(f64, Point)>> = strands.iter().map(halves).collect();
    let mut found = 0;
    for (strand, first, share, [a, b]) in &chords {
        for (other, other_first, other_share, [c, d]) in index.intersecting(around(&[*a, *b])) {
            if strand == other {
                continue;
            }
            for (end, is_end) in [(*a, *first == 0.0), (*b, first + share > 1.0 - 1e-9)] {
                let along = ((end - c).dot(&(d - c)) / (d - c).norm_squared()).clamp(0.0, 1.0);
                if is_end && (c + (d - c) * along - end).norm() <= tolerance {
                    cuts[*other].push((other_first + other_share * along, end));
                }
            }
            let sides =
                [orientation(*a, *b, *c), orientation(*a, *b, *d), orientation(*c, *d, *a), orientation(*c, *d, *b)];
            if sides[0] * sides[1] < 0.0 && sides[2] * sides[3] < 0.0 {
                let along = sides[2] / (sides[2] - sides[3]);
                cuts[*strand].push((first + share * along, a + (b - a) * along));
            }
            found += 1;
            if found > 10 * MAX_CHORDS {
                return None;
            }
        }
    }
    let mut nodes = Nodes::new(tolerance);
    for (_, from, segment) in &strands {
        nodes.number(*from);
        nodes.number(segment.end());
    }
    let mut edges: Vec<Edge> = Vec::new();
    let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for ((owner, from, segment), mut cuts) in strands.iter().zip(cuts) {
        cuts.push((1.0, segment.end()));
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut before = (0.0, nodes.number(*from));
        for (share, at) in cuts {
            let node = nodes.number(at);
            if node == before.1 {
                continue;
            }
            let piece = segment.between(*from, [before.0, share], nodes.places[node]);
            let curve = Subpath { start: nodes.places[before.1], segments: vec![piece], closed: false };
            let edge = Edge::new(&mut nodes, curve, *owner, tolerance);
            let mut key = edge.ends;
            key.sort_unstable();
            let same = between.entry(key).or_default();
            match same.iter().find(|i| (edges[**i].middle() - edge.middle()).norm() <= 2.0 * tolerance) {
                Some(i) => drop(edges[*i].owners.insert(*owner)),
                None => {
                    same.push(edges.len());
                    edges.push(edge);
                }
            }
            before = (share, node);
        }
    }
    Some(edges)
}

/// Walks around all faces of the graph of living edges (step 3). Walks around faces have a positive area, and walks
/// around the outside of a connected piece of the graph a negative one.
fn walks(edges: &[Edge], alive: &[bool]) -> Vec<Walk> {
    // Half-edge 2 i runs along the edge i, and 2 i + 1 backwards.
    let nodes = edges.iter().flat_map(|edge| edge.ends).max().map_or(0, |most| most + 1);
    let mut out: Vec<Vec<usize>> = vec![Vec::new(); nodes];
    for (i, edge) in edges.iter().enumerate().filter(|(i, _)| alive[*i]) {
        out[edge.ends[0]].push(2 * i);
        out[edge.ends[1]].push(2 * i + 1);
    }
    let points = |half: usize| {
        let mut points = edges[half / 2].points.clone();
        if half % 2 == 1 {
            points.reverse();
        }
        points
    };
    let mut place = vec![0; 2 * edges.len()];
    for around in &mut out {
        around.sort_by(|one, other| {
            let (one, other) = (points(*one), points(*other));
            let is_lower = |p: Point| p.y < one[0].y || (p.y == one[0].y && p.x < one[0].x);
            let turn = orientation(one[0], one[1], other[1]);
            is_lower(one[1]).cmp(&is_lower(other[1])).then(0.0_f64.total_cmp(&turn))
        });
        around.iter().enumerate().for_each(|(k, half)| place[*half] = k);
    }
    let mut walks = Vec::new();
    let mut seen = vec![false; 2 * edges.len()];
    for first in 0..2 * edges.len() {
        let (mut half, mut walk) = (first, Walk { halves: Vec::new(), points: Vec::new(), area: 0.0 });
        while alive[half / 2] && !std::mem::replace(&mut seen[half], true) {
            walk.halves.push((half / 2, half % 2 == 1));
            let along = points(half);
            walk.points.extend(&along[..along.len() - 1]);
            let back = half ^ 1;
            let around = &out[edges[half / 2].ends[1 - half % 2]];
            half = around[(place[back] + around.len() - 1) % around.len()];
        }
        if let Some(base) = walk.points.first() {
            let sides = walk.points.iter().zip(walk.points.iter().cycle().skip(1));
            walk.area = sides.map(|(a, b)| cross(a - base, b - base)).sum::<f64>() / 2.0;
            walks.push(walk);
        }
    }
    walks
}

/// Returns the faces: each the walk around it, and the walks around the pieces of the graph that lie in it.
fn faces(walks: &[Walk]) -> Vec<Vec<&Walk>> {
    let (inner, outer): (Vec<&Walk>, Vec<&Walk>) = walks.iter().partition(|walk| walk.area > 0.0);
    let mut faces: Vec<Vec<&Walk>> = inner.into_iter().map(|walk| vec![walk]).collect();
    let boxes = BoxIndex::new((0..faces.len()).collect(), |i| around(&faces[*i][0].points));
    let mut holes = Vec::new();
    for hole in outer {
        let edges: BTreeSet<usize> = hole.halves.iter().map(|half| half.0).collect();
        let holds = |i: &&usize| {
            let walk = &faces[**i][0];
            walk.area > -hole.area
                && is_inside(&walk.points, hole.points[0])
                && !walk.halves.iter().any(|half| edges.contains(&half.0))
        };
        let around = boxes.intersecting(around(&hole.points)).filter(holds);
        holes.extend(around.min_by(|a, b| faces[**a][0].area.total_cmp(&faces[**b][0].area)).map(|face| (*face, hole)));
    }
    holes.into_iter().for_each(|(face, hole)| faces[face].push(hole));
    faces
}

/// Returns a point in a face; `None` if the face is thinner than the tolerance.
fn point_in(face: &[&Walk], tolerance: f64) -> Option<Point> {
    let points = || face.iter().flat_map(|walk| &walk.points);
    let area: f64 = face.iter().map(|walk| walk.area).sum();
    let length = |walk: &&Walk| walk.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>();
    if !(2.0 * area > tolerance * face.iter().map(length).sum::<f64>()) {
        return None;
    }
    let mut heights: Vec<f64> = points().map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    // Half-way between the two heights of corners that are farthest apart.
    let widest = heights.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    let y = (widest[0] + widest[1]) / 2.0;
    let mut crossed: Vec<f64> = face.iter().flat_map(|walk| crossings(&walk.points, y)).collect();
    crossed.sort_by(f64::total_cmp);
    let [left, right] = *crossed.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))? else {
        return None;
    };
    Some(Point::new((left + right) / 2.0, y))
}

/// Returns the closed curve along a walk.
fn outline(walk: &Walk, edges: &[Edge]) -> Subpath {
    let mut curves = walk.halves.iter().map(|(edge, is_reversed)| match is_reversed {
        true => edges[*edge].curve.reversed(),
        false => edges[*edge].curve.clone(),
    });
    let mut whole = curves.next().unwrap_or(Subpath { start: Point::origin(), segments: Vec::new(), closed: true });
    whole.segments.extend(curves.flat_map(|curve| curve.segments));
    whole.closed = true;
    whole
}

/// Returns points along the outlines of a part.
fn sampled(part: &Part, tolerance: f64) -> Vec<Vec<Point>> {
    let along = |ring: &Subpath| ring.starts().flat_map(|(from, s)| points_along(from, &s, tolerance)).collect();
    part.subpaths().iter().map(along).collect()
}

fn points_along(from: Point, segment: &Segment, tolerance: f64) -> Vec<Point> {
    let inner = segment.inner(from, CHORD_TOL * tolerance);
    [from].into_iter().chain(inner).chain([segment.end()]).collect()
}

fn around(points: &[Point]) -> Aabb {
    let [x, y] = [|p: &Point| p.x, |p: &Point| p.y].map(|c| crate::geometry::range_of(points.iter().map(c)));
    Aabb { min: [x.0, y.0], max: [x.1, y.1] }
}

impl Edge {
    /// Creates an edge from a curve, whose ends are moved to the places of their nodes.
    fn new(nodes: &mut Nodes, mut curve: Subpath, owner: usize, tolerance: f64) -> Edge {
        let ends = [curve.start, curve.end()].map(|end| nodes.number(end));
        curve.start = nodes.places[ends[0]];
        if let Some(Segment::Line(to) | Segment::Cubic(_, _, to)) = curve.segments.last_mut() {
            *to = nodes.places[ends[1]];
        }
        if let Some(Segment::Arc(arc)) = curve.segments.last_mut() {
            arc.to = nodes.places[ends[1]];
        }
        let mut points = vec![curve.start];
        points.extend(curve.starts().flat_map(|(from, s)| points_along(from, &s, tolerance).split_off(1)));
        Edge { ends, curve, points, owners: BTreeSet::from([owner]) }
    }

    fn middle(&self) -> Point {
        let i = (self.points.len() - 1) / 2;
        match self.points.len() % 2 {
            0 => self.points[i] + (self.points[i + 1] - self.points[i]) / 2.0,
            _ => self.points[i],
        }
    }

    fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// The nodes of the graph. Points within the tolerance are one node, at the place of the first of them.
struct Nodes {
    places: Vec<Point>,
    cells: BTreeMap<[i64; 2], Vec<usize>>,
    tolerance: f64,
}

impl Nodes {
    fn new(tolerance: f64) -> Nodes {
        Nodes { places: Vec::new(), cells: BTreeMap::new(), tolerance }
    }

    /// Returns the number of the node at a point.
    fn number(&mut self, point: Point) -> usize {
        let cell = [point.x, point.y].map(|c| (c / (2.0 * self.tolerance)).floor() as i64);
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            let key = [cell[0].saturating_add(dx), cell[1].saturating_add(dy)];
            let near = |i: &&usize| (self.places[**i] - point).norm() <= self.tolerance;
            if let Some(node) = self.cells.get(&key).and_then(|list| list.iter().find(near)) {
                return *node;
            }
        }
        self.places.push(point);
        self.cells.entry(cell).or_default().push(self.places.len() - 1);
        self.places.len() - 1
    }
}
