//! [`Affine`]: affine maps of the plane, for the nested transforms in a drawing.

use crate::geometry::{Point, Vector, sin_cos_degrees};

/// x ↦ a·x + c·y + e, y ↦ b·x + d·y + f, as SVG writes `matrix(a b c d e f)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine(pub(super) [f64; 6]);

impl Affine {
    pub(super) const IDENTITY: Affine = Affine([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    pub(super) fn translation(x: f64, y: f64) -> Affine {
        Affine([1.0, 0.0, 0.0, 1.0, x, y])
    }

    pub(super) fn scale(x: f64, y: f64) -> Affine {
        Affine([x, 0.0, 0.0, y, 0.0, 0.0])
    }

    /// Returns the rotation by an angle in degrees, from the x axis towards the y axis. Multiples of 90° are exact.
    pub(super) fn rotation(degrees: f64) -> Affine {
        let (sin, cos) = sin_cos_degrees(degrees);
        Affine([cos, sin, -sin, cos, 0.0, 0.0])
    }

    /// Returns the composition: `inner` is applied first, then this map.
    pub(super) fn after(&self, inner: &Affine) -> Affine {
        let [a, b, c, d, e, f] = inner.0;
        let (x, y) = (self.vector(Vector::new(a, b)), self.vector(Vector::new(c, d)));
        let at = self.point(Point::new(e, f));
        Affine([x.x, x.y, y.x, y.y, at.x, at.y])
    }

    pub(super) fn point(&self, p: Point) -> Point {
        let [a, b, c, d, e, f] = self.0;
        Point::new(a * p.x + c * p.y + e, b * p.x + d * p.y + f)
    }

    pub(super) fn vector(&self, v: Vector) -> Vector {
        let [a, b, c, d, _, _] = self.0;
        Vector::new(a * v.x + c * v.y, b * v.x + d * v.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inner_map_comes_first() {
        let map = Affine::translation(10.0, 20.0).after(&Affine::rotation(90.0));
        assert_eq!(map.point(Point::new(3.0, 1.0)), Point::new(9.0, 23.0));
        let map = Affine::rotation(90.0).after(&Affine::translation(10.0, 20.0));
        assert_eq!(map.point(Point::new(3.0, 1.0)), Point::new(-21.0, 13.0));
    }
}
