//! Geometry of the plane: points, vectors, polygons and lattices.
//!
//! A [`Point`] is a position; a [`Vector`] is a displacement, a force or a direction. They are two types because a
//! translation of the scene changes points but not vectors. Axes: x to the right, y up; angles anticlockwise.
//! [`Tolerance`] contains the lengths and the angle within which two bodies touch. Equilibrium is not computed here.

mod lattice;
mod box_index;
mod circle;
mod crossing;
mod edge;
mod overlap;
mod polygon;
mod compensated_sum;
pub(crate) mod snap;
mod tolerance;
mod zonotope;

pub use box_index::Bounds;
pub(crate) use box_index::{Aabb, BoxIndex};
pub use circle::Circle;
pub use compensated_sum::CompensatedSum;
pub use edge::Edge;
#[cfg(feature = "import")]
pub(crate) use edge::orientation;
pub(crate) use lattice::boundary;
pub use lattice::{Cell, CellShape, Lattice, LatticeKind};
pub(crate) use overlap::in_half_plane;
pub use overlap::{ConvexPieces, Overlap, overlap};
pub use polygon::{Polygon, PolygonError};
pub(crate) use polygon::{convex_hull, sin_cos_degrees};
pub use tolerance::Tolerance;
pub use zonotope::{Vec3, quick_gauge_bound, zonotope_gauge, zonotope_gauge_bound};

/// A position in the plane, in metres.
pub type Point = nalgebra::Point2<f64>;

/// A displacement in metres, a direction, or a force in newtons.
pub type Vector = nalgebra::Vector2<f64>;

/// Returns the cross product of two plane vectors, `a_x b_y − a_y b_x`. It is the moment of the force `b` with the
/// lever arm `a`, anticlockwise positive.
///
/// ```
/// use drystone::internals::geometry::{Vector, cross};
/// assert_eq!(cross(Vector::new(2.0, 0.0), Vector::new(5.0, 3.0)), 6.0);
/// ```
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Returns the vector rotated anticlockwise by 90°: `(−v_y, v_x)`.
pub fn quarter_turn(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// Returns the smallest and the largest of some values; ∞ and −∞ if there are none.
pub(crate) fn range_of(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_goes_anticlockwise() {
        assert_eq!(quarter_turn(Vector::new(2.0, 5.0)), Vector::new(-5.0, 2.0));
        assert_eq!(quarter_turn(Vector::new(3.0, 0.0)), Vector::new(0.0, 3.0));
        // Four quarter turns restore the vector. The cross product of a vector and its quarter turn is the square of
        // its length.
        let v = Vector::new(-0.3, 7.0);
        assert_eq!(quarter_turn(quarter_turn(quarter_turn(quarter_turn(v)))), v);
        assert_eq!(cross(v, quarter_turn(v)), v.norm_squared());
    }
}
