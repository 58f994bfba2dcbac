//! [`trapezoids`]: cuts a polygon with very many corners into trapezoids, in the time of sorting its corners.
//!
//! A vertical line sweeps over the corners from left to right and keeps the sides that it crosses, from the lowest to the
//! highest. Between each odd side and the next lies the polygon. At a corner, the trapezoids between the sides that end or
//! begin there, and at most one on either side of the corner, are closed and begun anew. Corners above each other are
//! swept from the lowest on, as if the polygon leaned to the right by an infinitely small angle.
//!
//! References: de Berg et al., Computational Geometry, 3rd ed., 2008, chapters 3 and 6.

use super::edge::{orientation, ring_edges};
use super::{Point, cross};

/// A side, from its left to its right end.
struct Side {
    ends: [Point; 2],
    /// If the polygon lies above this side: where the trapezoid above it begins.
    begin: f64,
}

impl Side {
    /// Returns the point of the side at this x, which lies between its ends.
    fn at(&self, x: f64) -> Point {
        let [left, right] = self.ends;
        match x {
            x if x == left.x => left,
            x if x == right.x => right,
            x => Point::new(x, left.y + (right.y - left.y) * ((x - left.x) / (right.x - left.x))),
        }
    }
}

/// Returns trapezoids and triangles, anticlockwise, that cover the polygon with these rings once. Their corners lie on its
/// sides, apart from rounding. `None` may be returned if the rings touch or cross each other or themselves.
pub(super) fn trapezoids(rings: &[Vec<Point>]) -> Option<Vec<Vec<Point>>> {
    let mut sides: Vec<Side> = Vec::new();
    // For each corner: the sides of which it is an end.
    let mut corners: Vec<(Point, [usize; 2])> = Vec::new();
    for ring in rings {
        let (first, last) = (sides.len(), sides.len() + ring.len() - 1);
        for (number, edge) in (first..).zip(ring_edges(ring)) {
            let (from, to) = (edge.from, edge.to);
            let ends = if (from.x, from.y) < (to.x, to.y) { [from, to] } else { [to, from] };
            corners.push((from, [if number == first { last } else { number - 1 }, number]));
            sides.push(Side { ends, begin: from.x });
        }
    }
    corners.sort_unstable_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut crossed: Vec<usize> = Vec::new();
    let mut pieces = Vec::new();
    for (corner, of_corner) in corners {
        let mut beginning = of_corner.to_vec();
        beginning.retain(|side| sides[*side].ends[0] == corner);
        if let [one, two] = beginning[..]
            && orientation(corner, sides[one].ends[1], sides[two].ends[1]) < 0.0
        {
            beginning.reverse();
        }
        let first = crossed.partition_point(|side| {
            let [left, right] = sides[*side].ends;
            orientation(left, right, corner) > 0.0
        });
        // As many sides end as do not begin.
        let [ended, begun] = [first + 2 - beginning.len(), first + beginning.len()];
        for pair in crossed.get(first - first % 2..ended + ended % 2)?.chunks_exact(2) {
            pieces.extend(between(&sides[pair[0]], &sides[pair[1]], corner.x));
        }
        crossed.splice(first..ended, beginning);
        for pair in crossed.get(first - first % 2..begun + begun % 2)?.chunks_exact(2) {
            sides[pair[0]].begin = corner.x;
        }
    }
    Some(pieces)
}

/// Returns the trapezoid between two sides from its beginning to `end`. `None` if it has no area.
fn between(under: &Side, over: &Side, end: f64) -> Option<Vec<Point>> {
    if end <= under.begin {
        return None;
    }
    let mut piece = vec![under.at(under.begin), under.at(end), over.at(end), over.at(under.begin)];
    piece.dedup();
    piece.pop_if(|last| *last == under.at(under.begin));
    let area: f64 = piece.windows(2).map(|side| cross(side[0] - piece[0], side[1] - piece[0])).sum();
    (piece.len() > 2 && area > 0.0).then_some(piece)
}
