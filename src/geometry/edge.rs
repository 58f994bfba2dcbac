//! [`Edge`], a side of a polygon, and [`orientation`], which decides on which side of a line a point lies.

use super::{Aabb, Point, Vector};

/// A directed side of a polygon; the polygon's material lies on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Start point, in metres.
    pub from: Point,
    /// End point, in metres.
    pub to: Point,
}

impl Edge {
    /// Returns the vector from the start to the end of the edge, in metres.
    pub fn vector(&self) -> Vector {
        self.to - self.from
    }

    /// Returns the length in metres.
    pub fn length(&self) -> f64 {
        self.vector().norm()
    }

    /// Returns the distance of a point from the edge in metres.
    pub(crate) fn distance(&self, point: Point) -> f64 {
        let along = self.vector();
        let share = (point - self.from).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
        (point - (self.from + along * share.clamp(0.0, 1.0))).norm()
    }

    /// Returns the unit normal of the edge that points out of the material.
    pub fn outward(&self) -> Vector {
        let d = self.vector().normalize();
        Vector::new(d.y, -d.x)
    }

    /// Returns the smallest axis-parallel box around the edge.
    pub(crate) fn bounds(&self) -> Aabb {
        let (a, b) = (self.from, self.to);
        Aabb { min: [a.x.min(b.x), a.y.min(b.y)], max: [a.x.max(b.x), a.y.max(b.y)] }
    }
}

/// Returns the sides of a closed ring of corners, in their order. The last side leads back to the first corner.
pub(super) fn ring_edges(ring: &[Point]) -> impl Iterator<Item = Edge> + '_ {
    // A comparison is faster than the remainder `(i + 1) % ring.len()`, and this loop takes much of the time for
    // reading a scene.
    let next = |i: usize| if i + 1 == ring.len() { 0 } else { i + 1 };
    (0..ring.len()).map(move |i| Edge { from: ring[i], to: ring[next(i)] })
}

/// Returns a positive number if the path a → b → c turns left, a negative number if it turns right, and 0 if the three
/// points are collinear.
///
/// The sign is exact for any finite coordinates. Reference: Shewchuk, Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates, 1997.
pub(crate) fn orientation(a: Point, b: Point, c: Point) -> f64 {
    let coord = |p: Point| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}
