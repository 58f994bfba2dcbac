//! [`Lattice`]: a regular lattice of cells with integer coordinates, on which collisions and contacts are decided
//! exactly.
//!
//! Invariant: every decision is made in integers; metres appear only in [`Lattice::point`] and in the methods that
//! call it. Node (x, y) lies at side·(x + y/2, y·√3/2) in the triangular lattice, and at side·(x, y) in the square
//! lattice.

use std::collections::{BTreeMap, BTreeSet};

use super::{Point, Polygon, Vector};

/// The kind of a regular lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LatticeKind {
    /// Equilateral triangles.
    Triangular,
    /// Squares.
    Square,
}

/// The shape of a cell. A triangle lies above (`Up`) or below (`Down`) its horizontal edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CellShape {
    /// A square.
    Square,
    /// The triangle above its horizontal edge: (x, y), (x+1, y), (x, y+1).
    Up,
    /// The triangle below its horizontal edge: (x, y), (x+1, y−1), (x+1, y).
    Down,
}

/// One cell of a lattice, identified by the left end of its lower edge (for a downward triangle, of its upper edge).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cell {
    /// First lattice coordinate.
    pub x: i64,
    /// Second lattice coordinate.
    pub y: i64,
    /// Square, upward or downward triangle.
    pub shape: CellShape,
}

/// A lattice node by its two coordinates.
pub(crate) type Node = (i64, i64);

/// A directed edge of a cell, from node to node, with the cell on its left.
pub(crate) type LatticeEdge = (Node, Node);

impl Cell {
    /// Returns the lattice coordinates of the cell's corners, anticlockwise.
    pub fn corners(self) -> Vec<(i64, i64)> {
        let (x, y) = (self.x, self.y);
        match self.shape {
            CellShape::Square => vec![(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)],
            CellShape::Up => vec![(x, y), (x + 1, y), (x, y + 1)],
            CellShape::Down => vec![(x, y), (x + 1, y - 1), (x + 1, y)],
        }
    }

    /// Returns the cell moved by `by`, in lattice steps.
    pub fn moved(self, by: (i64, i64)) -> Cell {
        Cell { x: self.x + by.0, y: self.y + by.1, shape: self.shape }
    }

    /// Returns the cell rotated anticlockwise about node (0, 0) by `steps` times 60° (triangles) or 90° (squares).
    pub fn turned(self, steps: i64) -> Cell {
        let kind = if self.shape == CellShape::Square { LatticeKind::Square } else { LatticeKind::Triangular };
        let corners: Vec<Node> = self.corners().into_iter().map(|c| turned(kind, c, steps)).collect();
        Cell::from_corners(&corners)
    }

    fn from_corners(corners: &[Node]) -> Cell {
        if corners.len() == 4 {
            let x = corners.iter().map(|c| c.0).min().unwrap_or(0);
            let y = corners.iter().map(|c| c.1).min().unwrap_or(0);
            return Cell { x, y, shape: CellShape::Square };
        }
        // Two corners of a triangle have the same y: they are the ends of its horizontal edge. The third corner lies
        // above or below this edge.
        for i in 0..3 {
            let (a, b, c) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
            if a.1 == b.1 {
                let shape = if c.1 > a.1 { CellShape::Up } else { CellShape::Down };
                return Cell { x: a.0.min(b.0), y: a.1, shape };
            }
        }
        unreachable!("a lattice triangle has a horizontal edge")
    }

    /// Returns the cell's edges, anticlockwise.
    pub(crate) fn edges(self) -> impl Iterator<Item = LatticeEdge> {
        let corners = self.corners();
        let n = corners.len();
        (0..n).map(move |i| (corners[i], corners[(i + 1) % n]))
    }
}

/// Rotates a node anticlockwise about node (0, 0) by `steps` times 60° (triangular lattice) or 90° (square lattice).
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
    /// Triangles or squares.
    pub kind: LatticeKind,
    /// Edge length in metres.
    pub side: f64,
}

impl Lattice {
    /// Returns the position, in metres, of a point given in lattice coordinates. The coordinates need not be integers.
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
            // 2x + y is exact for every node, so nodes on one vertical line get exactly the same x coordinate in
            // metres.
            LatticeKind::Triangular => Point::new((2.0 * x + y) * (self.side / 2.0), y * (self.side * HALF_SQRT_3)),
            LatticeKind::Square => Point::new(x * self.side, y * self.side),
        }
    }

    /// Returns the position of a node, in metres.
    pub(crate) fn node(&self, node: Node) -> Point {
        self.point(node.0 as f64, node.1 as f64)
    }

    /// Returns the area of one cell in square metres.
    pub fn cell_area(&self) -> f64 {
        let square = self.side * self.side;
        match self.kind {
            LatticeKind::Triangular => square * HALF_SQRT_3 / 2.0,
            LatticeKind::Square => square,
        }
    }

    /// Returns the centroid of one cell, in metres.
    pub fn cell_centre(&self, cell: Cell) -> Point {
        let corners = cell.corners();
        let sum = corners.iter().fold(Vector::zeros(), |s, c| s + self.node(*c).coords);
        Point::from(sum / corners.len() as f64)
    }

    /// Returns the union of the cells as one polygon, which may have holes. Collinear edges are merged into one side.
    ///
    /// `None` if there are no cells, or if they are not all connected by common edges.
    pub fn polygon(&self, cells: &[Cell]) -> Option<Polygon> {
        let rings = trace(cells)?;
        Some(Polygon::from_valid_rings(rings.iter().map(|ring| ring.iter().map(|n| self.node(*n)).collect()).collect()))
    }
}

/// √3/2: the height of a triangle with sides of length 1.
const HALF_SQRT_3: f64 = 0.866_025_403_784_438_6;

/// Returns the boundary edges of a set of cells in sorted order. The cells lie on the left of each edge.
pub(crate) fn boundary(cells: &[Cell]) -> Vec<LatticeEdge> {
    let mut all: Vec<LatticeEdge> = cells.iter().flat_map(|c| c.edges()).collect();
    all.sort_unstable();
    all.dedup();
    // An inner edge belongs to two cells and occurs once in each direction.
    let is_outer = |(a, b): &&LatticeEdge| all.binary_search(&(*b, *a)).is_err();
    all.iter().filter(is_outer).copied().collect()
}

/// Returns the boundary rings of a set of cells: the outline first, then the holes. `None` if there are no cells, or
/// if they are not all connected by common edges.
fn trace(cells: &[Cell]) -> Option<Vec<Vec<Node>>> {
    if !is_connected(cells) {
        return None;
    }
    let edges = boundary(cells);
    let mut unused = vec![true; edges.len()];
    let mut rings = Vec::new();
    for first in 0..edges.len() {
        let mut ring = vec![];
        let mut at = first;
        while std::mem::replace(&mut unused[at], false) {
            let (a, b) = edges[at];
            ring.push(a);
            // Several edges begin at a node where the boundary touches itself. Continue with the leftmost of them,
            // because it belongs to the same group of cells as the edge before. The sign of the turn is enough to
            // find the leftmost edge: at most one edge turns left. If none does, at most one goes straight on. If none
            // goes straight on either, only one edge is left.
            let begin = edges.partition_point(|edge| edge.0 < b);
            let candidates = (begin..edges.len()).take_while(|k| edges[*k].0 == b);
            let next = (candidates.filter(|k| unused[*k])).max_by_key(|k| turn(a, b, edges[*k].1));
            let Some(next) = next else { break };
            at = next;
        }
        if !ring.is_empty() {
            rings.push(without_collinear_nodes(&ring));
        }
    }
    // Put the outline first: it runs anticlockwise, so its area is positive. The areas of the holes are negative.
    rings.sort_by_key(|ring| std::cmp::Reverse(doubled_area(ring)));
    Some(rings)
}

/// Returns the direction in which the path a → b → c turns: 1 for left, 0 for straight on, −1 for right.
fn turn(a: Node, b: Node, c: Node) -> i64 {
    ((b.0 - a.0) * (c.1 - b.1) - (b.1 - a.1) * (c.0 - b.0)).signum()
}

/// Returns the nodes of a ring at which its direction changes.
fn without_collinear_nodes(ring: &[Node]) -> Vec<Node> {
    let n = ring.len();
    (0..n)
        .filter(|i| {
            let (a, b, c) = (ring[(i + n - 1) % n], ring[*i], ring[(i + 1) % n]);
            turn(a, b, c) != 0
        })
        .map(|i| ring[i])
        .collect()
}

/// Returns twice the area of a ring in lattice coordinates, positive if the ring runs anticlockwise.
fn doubled_area(ring: &[Node]) -> i64 {
    let n = ring.len();
    (0..n).map(|i| ring[i].0 * ring[(i + 1) % n].1 - ring[i].1 * ring[(i + 1) % n].0).sum()
}

/// True if every two cells are connected by a path that leads from cell to cell through common edges. False if there
/// are no cells.
fn is_connected(cells: &[Cell]) -> bool {
    let mut owner: BTreeMap<LatticeEdge, Cell> = BTreeMap::new();
    for cell in cells {
        for edge in cell.edges() {
            owner.insert(edge, *cell);
        }
    }
    let Some(first) = cells.first() else {
        return false;
    };
    // Depth-first search. The neighbour across an edge has the same edge in the opposite direction.
    let mut seen = BTreeSet::from([*first]);
    let mut stack = vec![*first];
    while let Some(cell) = stack.pop() {
        for (a, b) in cell.edges() {
            if let Some(next) = owner.get(&(b, a))
                && seen.insert(*next)
            {
                stack.push(*next);
            }
        }
    }
    seen.len() == cells.iter().collect::<BTreeSet<_>>().len()
}

#[cfg(test)]
mod tests;
