//! [`Camera`]: maps metres in the scene to pixels on the page. The y axis points up in the scene and down on the page.

use super::{Outline, PagePoint, PageRect};
use crate::geometry::{Bounds, Point, Polygon, Vector};

/// The position and scale of a scene on a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    corner: Point,
    at: PagePoint,
    scale: f64,
}

impl Camera {
    /// Creates a camera that shows the upper left corner of `view` (metres) at the page position `at`, with `scale`
    /// pixels per metre.
    ///
    /// ```
    /// use drystone::drawing::{Camera, PagePoint};
    /// use drystone::scene::{Bounds, Point};
    /// let view = Bounds { min: Point::new(2.0, 1.0), max: Point::new(5.0, 7.0) };
    /// let camera = Camera::new(view, PagePoint::new(10.0, 20.0), 8.0);
    /// assert_eq!(camera.place(Point::new(3.0, 6.0)), PagePoint::new(18.0, 28.0));
    /// ```
    pub fn new(view: Bounds, at: PagePoint, scale: f64) -> Camera {
        Camera { corner: Point::new(view.min.x, view.max.y), at, scale }
    }

    /// Returns a camera that shows the same picture moved right by `x` and down by `y` pixels.
    pub fn moved(self, x: f64, y: f64) -> Camera {
        Camera { at: self.at.moved(x, y), ..self }
    }

    /// Converts a point of the scene to its position on the page.
    pub fn place(&self, p: Point) -> PagePoint {
        // Subtract before multiplying, because this gives a smaller rounding error far from the origin.
        let d = p - self.corner;
        PagePoint::new(self.at.x + d.x * self.scale, self.at.y - d.y * self.scale)
    }

    /// Converts a position on the page to the point of the scene that is shown there.
    pub fn back(&self, at: PagePoint) -> Point {
        let (right, down) = (at.x - self.at.x, at.y - self.at.y);
        self.corner + Vector::new(right, -down) / self.scale
    }

    /// Returns the position of the scene's origin on the page.
    pub fn origin(&self) -> PagePoint {
        self.place(Point::origin())
    }

    /// Converts a vector of the scene (metres) to a vector on the page (pixels, right and down).
    pub fn turn(&self, v: Vector) -> (f64, f64) {
        (v.x * self.scale, -v.y * self.scale)
    }

    /// Converts a length from metres to pixels.
    pub fn length(&self, metres: f64) -> f64 {
        metres * self.scale
    }

    /// Converts a length from pixels to metres.
    pub fn metres(&self, pixels: f64) -> f64 {
        pixels / self.scale
    }

    /// Converts a box of the scene to the rectangle on the page that shows it.
    pub fn rect(&self, bounds: Bounds) -> PageRect {
        PageRect {
            at: self.place(Point::new(bounds.min.x, bounds.max.y)),
            width: self.length(bounds.width()),
            height: self.length(bounds.height()),
        }
    }

    /// Converts a polygon of the scene, with its holes, to its outline on the page.
    pub fn polygon(&self, polygon: &Polygon) -> Outline {
        let mut outline = Outline::default();
        for ring in polygon.rings() {
            outline.extend(Outline::ring(ring.iter().map(|p| self.place(*p))));
        }
        outline
    }
}
