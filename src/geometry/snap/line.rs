//! [`Lines`]: what lies along straight sides becomes straight.
//!
//! A joint of a wall runs through many corners, none of which lies exactly between its neighbours. To move each onto the
//! side before it would only hand the misfit on; so all corners of a joint get one line, and a corner on two joints goes
//! to where they cross.

use std::collections::{BTreeMap, BTreeSet};

use super::node::Nodes;
use crate::geometry::{Point, Vector, quarter_turn};

/// Rounds in which corners on three or more lines find their places.
const ROUNDS: usize = 200;
/// Two lines whose angle has a sine below the root of this do not say where they cross.
const PARALLEL: f64 = 1e-4;
/// Less than this part of the gap is the rounding of numbers.
const ROUNDING: f64 = 1e-9;

/// Sets of nodes, each of which is to lie on a line.
pub(super) struct Lines(Vec<Line>);

struct Line {
    nodes: Vec<usize>,
    course: Course,
}

/// What the line of some nodes is.
#[derive(Clone, Copy)]
enum Course {
    /// That of one side, which reaches along all of them.
    Side([usize; 2]),
    Level,
    Upright,
    /// The one that passes all nodes as closely as can be.
    Closest,
}

/// A line through a point with a unit normal.
struct Fit {
    through: Point,
    normal: Vector,
}

impl Fit {
    /// How far a place lies from the line, metres.
    fn distance(&self, at: Point) -> f64 {
        self.normal.dot(&(at - self.through)).abs()
    }
}

impl Lines {
    /// The lines of sides and the nodes on them; sides that share two nodes are one line where all of it is straight to
    /// within the nodes' gaps.
    pub(super) fn new(nodes: &Nodes, on: &BTreeMap<[usize; 2], BTreeSet<usize>>) -> Lines {
        let sides: Vec<[usize; 2]> = on.keys().copied().collect();
        let sets: Vec<BTreeSet<usize>> = on
            .iter()
            .map(|(ends, on)| on.iter().chain(ends).copied().collect())
            .collect();
        let mut by_node: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (i, set) in sets.iter().enumerate() {
            for node in set {
                by_node.entry(*node).or_default().push(i);
            }
        }
        let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for list in by_node.values() {
            for (k, i) in list.iter().enumerate() {
                for j in &list[k + 1..] {
                    *shared.entry((*i, *j)).or_default() += 1;
                }
            }
        }
        let mut group: Vec<usize> = (0..sets.len()).collect();
        for ((i, j), count) in shared {
            if count > 1 {
                let (a, b) = (root(&group, i), root(&group, j));
                group[a.max(b)] = a.min(b);
            }
        }
        let mut joined: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for i in 0..sets.len() {
            joined.entry(root(&group, i)).or_default().push(i);
        }
        let mut lines = Vec::new();
        for members in joined.into_values() {
            let line = |members: &[usize]| {
                let all: BTreeSet<usize> =
                    members.iter().flat_map(|m| &sets[*m]).copied().collect();
                let sides: Vec<[usize; 2]> = members.iter().map(|m| sides[*m]).collect();
                Line::new(nodes, all.into_iter().collect(), &sides)
            };
            match line(&members) {
                Some(whole) => lines.push(whole),
                None => lines.extend(members.iter().filter_map(|m| line(&[*m]))),
            }
        }
        Lines(lines)
    }

    /// Moves the nodes onto their lines; a node that would have to go farther than two gaps stays.
    pub(super) fn settle(&self, nodes: &mut Nodes) {
        let mut lines_of: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (i, line) in self.0.iter().enumerate() {
            for node in &line.nodes {
                lines_of.entry(*node).or_default().push(i);
            }
        }
        lines_of.retain(|node, _| !nodes.all[*node].fixed);
        let begun: BTreeMap<usize, Point> =
            lines_of.keys().map(|n| (*n, nodes.all[*n].at)).collect();
        for _ in 0..ROUNDS {
            let fits: Vec<Fit> = self.0.iter().map(|line| line.fit(nodes)).collect();
            let mut farthest = 0.0_f64;
            for (node, lines) in &lines_of {
                let at = nodes.all[*node].at;
                let step = towards(at, lines.iter().map(|l| &fits[*l]));
                nodes.all[*node].at = at + step;
                farthest = farthest.max(step.norm() / nodes.all[*node].gap);
            }
            if farthest <= 1e-9 {
                break;
            }
        }
        for (node, at) in begun {
            // Written so that NaN stays too.
            if !((nodes.all[node].at - at).norm() <= 2.0 * nodes.all[node].gap) {
                nodes.all[node].at = at;
            }
        }
    }
}

impl Line {
    /// `None` where no line passes all nodes within their gaps.
    fn new(nodes: &Nodes, members: Vec<usize>, sides: &[[usize; 2]]) -> Option<Line> {
        let place = |n: usize| nodes.all[n].at;
        let length = |s: &[usize; 2]| (place(s[1]) - place(s[0])).norm();
        let longest = *sides
            .iter()
            .reduce(|a, b| if length(b) > length(a) { b } else { a })?;
        let line = |course| Line {
            nodes: members.clone(),
            course,
        };
        // Written so that NaN does not fit.
        let fits = |line: &Line| {
            let fit = line.fit(nodes);
            (line.nodes.iter()).all(|n| fit.distance(place(*n)) <= nodes.all[*n].gap)
        };
        let side = line(Course::Side(longest));
        let along = (place(longest[1]) - place(longest[0])) / length(&longest);
        let reaches = |n: &usize| {
            let s = along.dot(&(place(*n) - place(longest[0])));
            let gap = nodes.all[*n].gap;
            s >= -gap && s <= length(&longest) + gap
        };
        if members.iter().all(reaches) && fits(&side) {
            return Some(side);
        }
        let closest = line(Course::Closest);
        if !fits(&closest) {
            return None;
        }
        // Level or upright as far as the corners can tell is level or upright.
        let fit = closest.fit(nodes);
        let normal = fit.normal;
        let distances = members.iter().map(|n| fit.distance(place(*n)));
        let off = distances.fold(0.0, f64::max);
        let spread = |axis: usize| {
            let all = members.iter().map(|n| place(*n)[axis]);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
                (l.min(x), h.max(x))
            });
            high - low
        };
        // A steep line has no width, so that its slope times its width says nothing of whether it is level.
        let (axis, course) = if normal.y.abs() >= normal.x.abs() {
            (0, Course::Level)
        } else {
            (1, Course::Upright)
        };
        let rounding = ROUNDING * nodes.all[members[0]].gap;
        if normal[axis].abs() * spread(axis) <= 2.0 * off + rounding {
            return Some(line(course));
        }
        Some(closest)
    }

    fn fit(&self, nodes: &Nodes) -> Fit {
        let place = |n: usize| nodes.all[n].at;
        if let Course::Side([a, b]) = self.course {
            return Fit {
                through: place(a),
                normal: quarter_turn((place(b) - place(a)).normalize()),
            };
        }
        let first = place(self.nodes[0]);
        let count = self.nodes.len() as f64;
        let sum: Vector = self.nodes.iter().map(|n| place(*n) - first).sum();
        let through = first + sum / count;
        let normal = match self.course {
            Course::Level => Vector::new(0.0, 1.0),
            Course::Upright => Vector::new(1.0, 0.0),
            _ => {
                let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
                for n in &self.nodes {
                    let d = place(*n) - through;
                    xx += d.x * d.x;
                    xy += d.x * d.y;
                    yy += d.y * d.y;
                }
                // The direction of greatest spread, by half the angle whose double the moments tell.
                let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
                Vector::new(-libm::sin(angle), libm::cos(angle))
            }
        };
        Fit { through, normal }
    }
}

/// The least step from a place onto lines, as nearly as one place can lie on all of them.
fn towards<'f>(at: Point, lines: impl Iterator<Item = &'f Fit>) -> Vector {
    let (mut p, mut q, mut r) = (0.0, 0.0, 0.0);
    let mut pull = Vector::zeros();
    for line in lines {
        let n = line.normal;
        p += n.x * n.x;
        q += n.x * n.y;
        r += n.y * n.y;
        pull += n * n.dot(&(line.through - at));
    }
    let (trace, det) = (p + r, p * r - q * q);
    if det > PARALLEL * trace * trace / 4.0 {
        return Vector::new(r * pull.x - q * pull.y, p * pull.y - q * pull.x) / det;
    }
    let angle = 0.5 * libm::atan2(2.0 * q, p - r);
    let normal = Vector::new(libm::cos(angle), libm::sin(angle));
    normal * (normal.dot(&pull) / trace)
}

fn root(group: &[usize], mut i: usize) -> usize {
    while group[i] != i {
        i = group[i];
    }
    i
}

#[cfg(test)]
mod tests;
