//! [`Lines`]: fits straight lines to the nodes along straight sides, and moves the nodes onto these lines.
//!
//! A joint of a wall runs through many corners, none of which lies exactly between its neighbours. Moving each corner
//! onto the previous side would only pass the error on. Therefore one line is fitted to all corners of a joint, and a
//! corner on two joints moves to the intersection of the two lines.
//!
//! A line runs along a side, or is fitted by total least squares (the principal axis of the nodes), or is exactly
//! horizontal or vertical. Two steps alternate until no node moves: fit all lines to the nodes; move each node by the
//! shortest least-squares step onto its lines. References: Pearson, On Lines and Planes of Closest Fit, 1901; Golub
//! and Van Loan, Matrix Computations, 2013, §5.3 (least squares by normal equations) and §5.5 (shortest solution).

use std::collections::{BTreeMap, BTreeSet};

use super::node::Nodes;
use crate::geometry::{Point, Vector, quarter_turn};

/// The largest number of times that lines are fitted and nodes are moved.
///
/// Nodes on at most two lines that do not change arrive in one step. Only nodes on three or more lines need many.
const MAX_ITERATIONS: usize = 200;
/// Two lines whose angle has a squared sine up to this are treated as parallel: their intersection is ill-conditioned.
///
/// The limit is an angle of 0.57°. If the angle were 0.18°, a node could move 300 times as far as its distance from the
/// lines. If the angle were 1.8°, the corners of slender wedges would no longer move to the intersection.
const MIN_SQUARED_SINE: f64 = 1e-4;
/// Lengths below this fraction of the gap are rounding: the tolerance of the convergence test, and of the test
/// whether a line is horizontal or vertical.
///
/// It must exceed the rounding of coordinates; for a gap of 1 mm it is 10⁻¹² m.
const ROUNDING_TOL: f64 = 1e-9;
/// A node that would move farther than this many gaps stays where it was.
const MAX_MOVE_IN_GAPS: f64 = 2.0;

/// Lines with the nodes that are to be moved onto them.
pub(super) struct Lines(Vec<Line>);

struct Line {
    nodes: Vec<usize>,
    kind: LineKind,
}

/// How the line through some nodes is determined.
#[derive(Clone, Copy)]
enum LineKind {
    /// The line through the two end nodes of one side. All nodes of the line lie between these two nodes, up to their
    /// gaps.
    Side([usize; 2]),
    /// A horizontal line through the mean of the nodes.
    Horizontal,
    /// A vertical line through the mean of the nodes.
    Vertical,
    /// The line with the least sum of squared distances from the nodes.
    Closest,
}

/// A line through a point with a unit normal.
struct Fit {
    through: Point,
    normal: Vector,
}

impl Fit {
    /// Returns the distance of a point from the line, in metres.
    fn distance(&self, at: Point) -> f64 {
        self.normal.dot(&(at - self.through)).abs()
    }
}

impl Lines {
    /// Creates the lines. `on` maps each straight side, given by its two end nodes, to the nodes of other bodies within
    /// the gap of this side.
    ///
    /// Sides that share at least two nodes get one common line, if the distance of every node from this line is at most
    /// the node's gap. Otherwise each of these sides gets its own line.
    pub(super) fn new(nodes: &Nodes, on: &BTreeMap<[usize; 2], BTreeSet<usize>>) -> Lines {
        let sides: Vec<[usize; 2]> = on.keys().copied().collect();
        let sets: Vec<BTreeSet<usize>> = on.iter().map(|(ends, on)| on.iter().chain(ends).copied().collect()).collect();
        let mut by_node: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (i, set) in sets.iter().enumerate() {
            for node in set {
                by_node.entry(*node).or_default().push(i);
            }
        }
        // Join two sides into one group (union-find) if they share at least two nodes. Most of them share two nodes that
        // are neighbours on both sides, and this is found without looking at each pair of sides.
        let mut group: Vec<usize> = (0..sets.len()).collect();
        let join = |group: &mut Vec<usize>, i: usize, j: usize| {
            let (a, b) = (root(group, i), root(group, j));
            group[a.max(b)] = a.min(b);
        };
        let mut first_with: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        for (i, (side, set)) in sides.iter().zip(&sets).enumerate() {
            let [from, to] = side.map(|node| nodes.all[node].at);
            let mut along: Vec<usize> = set.iter().copied().collect();
            let place = |node: &usize| (nodes.all[*node].at - from).dot(&(to - from));
            along.sort_by(|p, q| place(p).total_cmp(&place(q)));
            for pair in along.windows(2) {
                let key = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                let first = *first_with.entry(key).or_insert(i);
                join(&mut group, first, i);
            }
        }
        // Count the nodes that each pair of sides of different groups shares.
        let mut shared: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for list in by_node.values() {
            let roots: Vec<usize> = list.iter().map(|i| root(&group, *i)).collect();
            if roots.iter().all(|root| *root == roots[0]) {
                continue;
            }
            for (k, i) in list.iter().enumerate() {
                for (j, _) in list[k + 1..].iter().zip(&roots[k + 1..]).filter(|(_, root)| **root != roots[k]) {
                    *shared.entry((*i, *j)).or_default() += 1;
                }
            }
        }
        for ((i, j), _) in shared.into_iter().filter(|(_, count)| *count > 1) {
            join(&mut group, i, j);
        }
        let mut joined: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for i in 0..sets.len() {
            joined.entry(root(&group, i)).or_default().push(i);
        }
        // Make one line for each group of sides. If no single line fits all sides of a group, make one line for each of
        // these sides.
        let mut lines = Vec::new();
        for members in joined.into_values() {
            let line = |members: &[usize]| {
                let all: BTreeSet<usize> = members.iter().flat_map(|m| &sets[*m]).copied().collect();
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

    /// Moves the nodes onto their lines. Fixed nodes do not move. A node that would move farther than twice its gap
    /// does not move either.
    pub(super) fn settle(&self, nodes: &mut Nodes) {
        let mut lines_of: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (i, line) in self.0.iter().enumerate() {
            for node in &line.nodes {
                lines_of.entry(*node).or_default().push(i);
            }
        }
        lines_of.retain(|node, _| !nodes.all[*node].fixed);
        let begun: BTreeMap<usize, Point> = lines_of.keys().map(|n| (*n, nodes.all[*n].at)).collect();
        for _ in 0..MAX_ITERATIONS {
            // Fit all lines to the current nodes, then move every node towards its lines.
            let fits: Vec<Fit> = self.0.iter().map(|line| line.fit(nodes)).collect();
            let mut farthest = 0.0_f64;
            for (node, lines) in &lines_of {
                let at = nodes.all[*node].at;
                let step = least_squares_step(at, lines.iter().map(|l| &fits[*l]));
                nodes.all[*node].at = at + step;
                farthest = farthest.max(step.norm() / nodes.all[*node].gap);
            }
            // Convergence test: stop if the largest step, as a fraction of the node's gap, is only rounding.
            if farthest <= ROUNDING_TOL {
                break;
            }
        }
        for (node, at) in begun {
            // Move a node back if it moved too far. The negated comparison also moves a node back whose position is
            // NaN.
            if !((nodes.all[node].at - at).norm() <= MAX_MOVE_IN_GAPS * nodes.all[node].gap) {
                nodes.all[node].at = at;
            }
        }
    }
}

impl Line {
    /// Returns a line for the nodes `members` on or near the sides `sides`. The distance of every node from the line is
    /// at most the node's gap. `None` if no such line is found.
    ///
    /// The line runs along the longest side if no node lies beyond the ends of this side by more than the node's gap.
    /// Otherwise the line is fitted to the nodes. The fitted line is made exactly horizontal or vertical if the scatter
    /// of the nodes allows this.
    fn new(nodes: &Nodes, members: Vec<usize>, sides: &[[usize; 2]]) -> Option<Line> {
        let place = |n: usize| nodes.all[n].at;
        let length = |s: &[usize; 2]| (place(s[1]) - place(s[0])).norm();
        let longest = *sides.iter().reduce(|a, b| if length(b) > length(a) { b } else { a })?;
        let line = |kind| Line { nodes: members.clone(), kind };
        let fits = |line: &Line| {
            let fit = line.fit(nodes);
            // If the two ends of a side coincide, every distance is NaN and the comparison is false: the line does
            // not fit.
            (line.nodes.iter()).all(|n| fit.distance(place(*n)) <= nodes.all[*n].gap)
        };
        let side = line(LineKind::Side(longest));
        let along = (place(longest[1]) - place(longest[0])) / length(&longest);
        let reaches = |n: &usize| {
            let s = along.dot(&(place(*n) - place(longest[0])));
            let gap = nodes.all[*n].gap;
            s >= -gap && s <= length(&longest) + gap
        };
        if members.iter().all(reaches) && fits(&side) {
            return Some(side);
        }
        let closest = line(LineKind::Closest);
        if !fits(&closest) {
            return None;
        }
        // `off` is the scatter of the nodes: their largest distance from the fitted line, in metres.
        let fit = closest.fit(nodes);
        let normal = fit.normal;
        let distances = members.iter().map(|n| fit.distance(place(*n)));
        let off = distances.fold(0.0, f64::max);
        let spread = |axis: usize| {
            let all = members.iter().map(|n| place(*n)[axis]);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            high - low
        };
        // A flat line becomes horizontal if it rises over the width of the nodes by at most twice their scatter. A
        // steep line becomes vertical if it shifts sideways over the height of the nodes by at most twice their
        // scatter. A steep line is not tested for being horizontal: the width of its nodes can be near 0, so it would
        // pass that test.
        let (axis, kind) =
            if normal.y.abs() >= normal.x.abs() { (0, LineKind::Horizontal) } else { (1, LineKind::Vertical) };
        let rounding = ROUNDING_TOL * nodes.all[members[0]].gap;
        if normal[axis].abs() * spread(axis) <= 2.0 * off + rounding {
            return Some(line(kind));
        }
        Some(closest)
    }

    /// Computes the line from the current positions of its nodes, in the way that [`LineKind`] describes.
    fn fit(&self, nodes: &Nodes) -> Fit {
        let place = |n: usize| nodes.all[n].at;
        if let LineKind::Side([a, b]) = self.kind {
            return Fit { through: place(a), normal: quarter_turn((place(b) - place(a)).normalize()) };
        }
        let first = place(self.nodes[0]);
        let count = self.nodes.len() as f64;
        let sum: Vector = self.nodes.iter().map(|n| place(*n) - first).sum();
        let through = first + sum / count;
        let normal = match self.kind {
            LineKind::Horizontal => Vector::new(0.0, 1.0),
            LineKind::Vertical => Vector::new(1.0, 0.0),
            _ => {
                let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
                for n in &self.nodes {
                    let d = place(*n) - through;
                    xx += d.x * d.x;
                    xy += d.x * d.y;
                    yy += d.y * d.y;
                }
                // Total least squares: the line follows the principal axis of the second moments, tan 2α = 2xy / (xx −
                // yy).
                let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
                Vector::new(-libm::sin(angle), libm::cos(angle))
            }
        };
        Fit { through, normal }
    }
}

/// Returns the step, in metres, that minimises the sum of squared distances from a point to some lines. If several
/// steps give the minimum, returns the shortest.
fn least_squares_step<'f>(at: Point, lines: impl Iterator<Item = &'f Fit>) -> Vector {
    // Set up the normal equations [p q; q r] · step = pull.
    let (mut p, mut q, mut r) = (0.0, 0.0, 0.0);
    let mut pull = Vector::zeros();
    for line in lines {
        let n = line.normal;
        p += n.x * n.x;
        q += n.x * n.y;
        r += n.y * n.y;
        pull += n * n.dot(&(line.through - at));
    }
    // For two lines the determinant is the squared sine of their angle, and the trace is 2.
    let (trace, det) = (p + r, p * r - q * q);
    if det > MIN_SQUARED_SINE * trace * trace / 4.0 {
        return Vector::new(r * pull.x - q * pull.y, p * pull.y - q * pull.x) / det;
    }
    // Nearly parallel lines: step only along their mean normal, the principal axis of the matrix.
    let angle = 0.5 * libm::atan2(2.0 * q, p - r);
    let normal = Vector::new(libm::cos(angle), libm::sin(angle));
    normal * (normal.dot(&pull) / trace)
}

/// Returns the representative of the group that contains `i`, in a union-find structure.
fn root(group: &[usize], mut i: usize) -> usize {
    while group[i] != i {
        i = group[i];
    }
    i
}

#[cfg(test)]
mod tests;
