//! [`Bounds`]: an axis-parallel rectangle of the plane.

use super::{Point, Vector};

/// An axis-parallel rectangle, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Bounds {
    /// Returns the smallest axis-parallel rectangle that contains all points; `None` if there are no points.
    pub fn from_points(points: impl IntoIterator<Item = Point>) -> Option<Bounds> {
        points.into_iter().fold(None, |bounds: Option<Bounds>, p| {
            let b = bounds.unwrap_or(Bounds { min: p, max: p });
            Some(Bounds { min: b.min.inf(&p), max: b.max.sup(&p) })
        })
    }

    /// Returns the smallest rectangle that contains both rectangles.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Returns the rectangle extended by `margin` metres on every side.
    pub fn grown(self, margin: f64) -> Bounds {
        let m = Vector::new(margin, margin);
        Bounds { min: self.min - m, max: self.max + m }
    }

    /// Returns the length of the diagonal in metres.
    pub fn diagonal(self) -> f64 {
        (self.max - self.min).norm()
    }

    /// Returns the width in metres.
    pub fn width(self) -> f64 {
        self.max.x - self.min.x
    }

    /// Returns the height in metres.
    pub fn height(self) -> f64 {
        self.max.y - self.min.y
    }

    /// True if the two rectangles share at least one point. Rectangles that only touch share points.
    pub fn intersects(self, other: Bounds) -> bool {
        self.min.x <= other.max.x && other.min.x <= self.max.x && self.min.y <= other.max.y && other.min.y <= self.max.y
    }
}
