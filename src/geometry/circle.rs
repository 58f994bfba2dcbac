//! [`Circle`]: the outline of a round body.

use super::{Point, Polygon, Vector, sin_cos_degrees};

/// The number of corners of the polygon that stands for a circle in pictures. Its sides leave the circle by less than
/// a thousandth of the radius.
const CORNERS: usize = 96;

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// The centre, in metres.
    pub centre: Point,
    /// The radius in metres, more than 0.
    pub radius: f64,
}

impl Circle {
    /// Returns the area in square metres.
    pub fn area(self) -> f64 {
        std::f64::consts::PI * self.radius * self.radius
    }

    /// Returns a regular polygon with the area and the centre of the circle.
    ///
    /// ```
    /// use drystone::internals::geometry::{Circle, Point};
    /// let log = Circle { centre: Point::new(2.0, 1.0), radius: 0.5 };
    /// assert!((log.polygon().area() - log.area()).abs() < 1e-12);
    /// ```
    pub fn polygon(self) -> Polygon {
        let step = 360.0 / CORNERS as f64;
        let triangle = 0.5 * sin_cos_degrees(step).0;
        let reach = (self.area() / (CORNERS as f64 * triangle)).sqrt();
        let corner = |k: usize| {
            let (sin, cos) = sin_cos_degrees(step * k as f64);
            self.centre + Vector::new(cos, sin) * reach
        };
        Polygon::from_valid_rings(vec![(0..CORNERS).map(corner).collect()])
    }

    /// Returns the distance of a point from the circle, in metres; negative inside.
    pub(crate) fn distance(self, point: Point) -> f64 {
        (point - self.centre).norm() - self.radius
    }

    /// Returns the distance by which the circle must move until it does not overlap a polygon, in metres; negative if
    /// they are apart.
    pub(crate) fn depth_in(self, polygon: &Polygon) -> f64 {
        let away = polygon.edges().map(|edge| edge.distance(self.centre)).fold(f64::INFINITY, f64::min);
        self.radius + if polygon.contains(self.centre) { away } else { -away }
    }
}
