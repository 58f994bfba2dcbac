//! [`Lattice`]: whole-number places and cells, where collisions and contacts are exact.
//!
//! Invariant: everything is decided in integers; metres appear only in [`Lattice::point`] and [`Lattice::polygon`].
//! Triangular lattice: point (x, y) is at side·(x + y/2, y·√3/2). Square lattice: at side·(x, y).

use std::collections::{BTreeMap, BTreeSet};

use super::{Point, Polygon, Vector};

/// Which regular lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LatticeKind {
    /// Equilateral triangles.
    Triangular,
    /// Squares.
    Square,
}

/// Which triangle on a bottom edge; a square is [`Half::Whole`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Half {
    /// A square cell.
    Whole,
    /// The triangle above its bottom edge: (x, y), (x+1, y), (x, y+1).
    Up,
    /// The triangle below that edge: (x, y), (x+1, y), (x+1, y−1).
    Down,
}

/// One cell of a lattice, named by the left end of its horizontal edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cell {
    /// First lattice coordinate.
    pub x: i64,
    /// Second lattice coordinate.
    pub y: i64,
    /// Which cell there.
    pub half: Half,
}

type Node = (i64, i64);

/// A directed lattice edge with its cell on the left.
pub(crate) type Step = (Node, Node);

impl Cell {
    /// The corners, anticlockwise, in lattice coordinates.
    pub fn corners(self) -> Vec<(i64, i64)> {
        let (x, y) = (self.x, self.y);
        match self.half {
            Half::Whole => vec![(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)],
            Half::Up => vec![(x, y), (x + 1, y), (x, y + 1)],
            Half::Down => vec![(x, y), (x + 1, y - 1), (x + 1, y)],
        }
    }

    /// The cell moved by whole lattice steps.
    pub fn moved(self, by: (i64, i64)) -> Cell {
        Cell {
            x: self.x + by.0,
            y: self.y + by.1,
            half: self.half,
        }
    }

    /// The cell turned anticlockwise about the lattice origin by `steps` of 60° (triangles) or 90° (squares).
    pub fn turned(self, steps: i64) -> Cell {
        let kind = if self.half == Half::Whole {
            LatticeKind::Square
        } else {
            LatticeKind::Triangular
        };
        let corners: Vec<Node> = self
            .corners()
            .into_iter()
            .map(|c| turned(kind, c, steps))
            .collect();
        Cell::from_corners(&corners)
    }

    fn from_corners(corners: &[Node]) -> Cell {
        if corners.len() == 4 {
            let x = corners.iter().map(|c| c.0).min().unwrap_or(0);
            let y = corners.iter().map(|c| c.1).min().unwrap_or(0);
            return Cell {
                x,
                y,
                half: Half::Whole,
            };
        }
        // Two corners of a triangle share a row: they are its horizontal edge, and the third tells the side.
        for i in 0..3 {
            let (a, b, c) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
            if a.1 == b.1 {
                let half = if c.1 > a.1 { Half::Up } else { Half::Down };
                return Cell {
                    x: a.0.min(b.0),
                    y: a.1,
                    half,
                };
            }
        }
        unreachable!("a lattice triangle has a horizontal edge")
    }

    pub(crate) fn steps(self) -> impl Iterator<Item = Step> {
        let corners = self.corners();
        let n = corners.len();
        (0..n).map(move |i| (corners[i], corners[(i + 1) % n]))
    }
}

/// A lattice node turned anticlockwise about the origin by `steps` of 60° (triangular) or 90° (square).
pub(crate) fn turned(kind: LatticeKind, node: (i64, i64), steps: i64) -> (i64, i64) {
    let (mut x, mut y) = node;
    match kind {
        LatticeKind::Triangular => {
            for _ in 0..steps.rem_euclid(6) {
                (x, y) = (-y, x + y);
            }
        }
        LatticeKind::Square => {
            for _ in 0..steps.rem_euclid(4) {
                (x, y) = (-y, x);
            }
        }
    }
    (x, y)
}

/// A regular lattice with its edge length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Which lattice.
    pub kind: LatticeKind,
    /// Edge length in metres.
    pub side: f64,
}

impl Lattice {
    /// Where a lattice point lies, in metres. The coordinates need not be whole.
    ///
    /// ```
    /// use drystone::internals::geometry::{Lattice, LatticeKind};
    /// let lattice = Lattice { kind: LatticeKind::Triangular, side: 2.0 };
    /// let p = lattice.point(3.0, 1.0);
    /// assert_eq!(p.x, 7.0);
    /// assert!((p.y - 3f64.sqrt()).abs() < 1e-15);
    /// ```
    pub fn point(&self, x: f64, y: f64) -> Point {
        match self.kind {
            // The half row is added as a whole number of halves, so that equal places get equal bits.
            LatticeKind::Triangular => Point::new(
                (2.0 * x + y) * (self.side / 2.0),
                y * (self.side * HALF_SQRT_3),
            ),
            LatticeKind::Square => Point::new(x * self.side, y * self.side),
        }
    }

    pub(crate) fn node(&self, node: Node) -> Point {
        self.point(node.0 as f64, node.1 as f64)
    }

    /// Area of one cell in square metres.
    pub fn cell_area(&self) -> f64 {
        let square = self.side * self.side;
        match self.kind {
            LatticeKind::Triangular => square * HALF_SQRT_3 / 2.0,
            LatticeKind::Square => square,
        }
    }

    /// Centroid of one cell.
    pub fn cell_centre(&self, cell: Cell) -> Point {
        let corners = cell.corners();
        let sum = corners
            .iter()
            .fold(Vector::zeros(), |s, c| s + self.node(*c).coords);
        Point::from(sum / corners.len() as f64)
    }

    /// The outline of a set of cells: outer ring and holes, straight runs of edges joined into one.
    ///
    /// `None` where the cells are not all joined by edges.
    pub fn polygon(&self, cells: &[Cell]) -> Option<Polygon> {
        let rings = trace(cells)?;
        Some(Polygon::from_traced(
            rings
                .iter()
                .map(|ring| ring.iter().map(|n| self.node(*n)).collect())
                .collect(),
        ))
    }
}

const HALF_SQRT_3: f64 = 0.866_025_403_784_438_6;

/// The boundary of a set of cells as directed edges, the cells on their left, in their order.
pub(crate) fn boundary(cells: &[Cell]) -> Vec<Step> {
    let mut all: Vec<Step> = cells.iter().flat_map(|c| c.steps()).collect();
    all.sort_unstable();
    all.dedup();
    let is_outer = |(a, b): &&Step| all.binary_search(&(*b, *a)).is_err();
    all.iter().filter(is_outer).copied().collect()
}

/// Outer ring first, then the holes from the smallest, straight runs joined. `None` unless the cells hang together by edges.
fn trace(cells: &[Cell]) -> Option<Vec<Vec<Node>>> {
    if !joined(cells) {
        return None;
    }
    let edges = boundary(cells);
    let mut left = vec![true; edges.len()];
    let mut rings = Vec::new();
    for first in 0..edges.len() {
        let mut ring = vec![];
        let mut at = first;
        while std::mem::replace(&mut left[at], false) {
            let (a, b) = edges[at];
            ring.push(a);
            // Where rings touch in a node, turn as far left as possible, so that each cell stays with its own ring. Of
            // several ways on only one can turn left, and where none does one goes straight on.
            let begin = edges.partition_point(|edge| edge.0 < b);
            let ways = (begin..edges.len()).take_while(|k| edges[*k].0 == b);
            let next = (ways.filter(|k| left[*k])).max_by_key(|k| turn(a, b, edges[*k].1));
            let Some(next) = next else { break };
            at = next;
        }
        if !ring.is_empty() {
            rings.push(straightened(&ring));
        }
    }
    rings.sort_by_key(|ring| std::cmp::Reverse(doubled_area(ring)));
    Some(rings)
}

/// To which side the path a → b → c turns: 1 left, 0 straight on, −1 right.
fn turn(a: Node, b: Node, c: Node) -> i64 {
    ((b.0 - a.0) * (c.1 - b.1) - (b.1 - a.1) * (c.0 - b.0)).signum()
}

fn straightened(ring: &[Node]) -> Vec<Node> {
    let n = ring.len();
    (0..n)
        .filter(|i| {
            let (a, b, c) = (ring[(i + n - 1) % n], ring[*i], ring[(i + 1) % n]);
            turn(a, b, c) != 0
        })
        .map(|i| ring[i])
        .collect()
}

fn doubled_area(ring: &[Node]) -> i64 {
    let n = ring.len();
    (0..n)
        .map(|i| ring[i].0 * ring[(i + 1) % n].1 - ring[i].1 * ring[(i + 1) % n].0)
        .sum()
}

fn joined(cells: &[Cell]) -> bool {
    let mut owner: BTreeMap<Step, Cell> = BTreeMap::new();
    for cell in cells {
        for step in cell.steps() {
            owner.insert(step, *cell);
        }
    }
    let Some(first) = cells.first() else {
        return false;
    };
    let mut seen = BTreeSet::from([*first]);
    let mut queue = vec![*first];
    while let Some(cell) = queue.pop() {
        for (a, b) in cell.steps() {
            if let Some(next) = owner.get(&(b, a))
                && seen.insert(*next)
            {
                queue.push(*next);
            }
        }
    }
    seen.len() == cells.iter().collect::<BTreeSet<_>>().len()
}

#[cfg(test)]
mod tests;
