//! [`Outline`]: a path on the page that consists of straight lines and cubic curves.

use super::{PagePoint, PageRect};

/// A segment of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Begins a new part at this point.
    Move(PagePoint),
    /// A straight line to this point.
    Line(PagePoint),
    /// A cubic Bézier curve: two control points and its end.
    Curve(PagePoint, PagePoint, PagePoint),
    /// A straight line back to the beginning of the part.
    Close,
}

/// A path on the page with one or more parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Its segments in order.
    pub segments: Vec<Segment>,
}

impl Outline {
    /// Creates a closed polygon with these corners.
    pub fn ring(points: impl IntoIterator<Item = PagePoint>) -> Outline {
        let mut outline = Outline::line(points);
        if !outline.segments.is_empty() {
            outline.segments.push(Segment::Close);
        }
        outline
    }

    /// Creates an open line through these points.
    pub fn line(points: impl IntoIterator<Item = PagePoint>) -> Outline {
        let segments =
            points.into_iter().enumerate().map(|(i, p)| if i == 0 { Segment::Move(p) } else { Segment::Line(p) });
        Outline { segments: segments.collect() }
    }

    /// Creates the outline of a rectangle with rounded corners. `radius` is the radius of the corners in pixels. It is
    /// reduced to half the shorter side if it is larger.
    pub fn rounded(rect: PageRect, radius: f64) -> Outline {
        let r = radius.min(rect.width / 2.0).min(rect.height / 2.0);
        let corner = |x: f64, y: f64| rect.at.moved(x, y);
        let (w, h) = (rect.width, rect.height);
        if r <= 0.0 {
            return Outline::ring([corner(0.0, 0.0), corner(w, 0.0), corner(w, h), corner(0.0, h)]);
        }
        // The distance of the control points from the corner. With this distance, the cubic curve meets the quarter
        // circle at both ends and in the middle.
        let c = r * (1.0 - QUARTER_CIRCLE_HANDLE);
        Outline {
            segments: vec![
                Segment::Move(corner(r, 0.0)),
                Segment::Line(corner(w - r, 0.0)),
                Segment::Curve(corner(w - c, 0.0), corner(w, c), corner(w, r)),
                Segment::Line(corner(w, h - r)),
                Segment::Curve(corner(w, h - c), corner(w - c, h), corner(w - r, h)),
                Segment::Line(corner(r, h)),
                Segment::Curve(corner(c, h), corner(0.0, h - c), corner(0.0, h - r)),
                Segment::Line(corner(0.0, r)),
                Segment::Curve(corner(0.0, c), corner(c, 0.0), corner(r, 0.0)),
                Segment::Close,
            ],
        }
    }

    /// Creates a circle; `radius` is in pixels.
    pub fn circle(centre: PagePoint, radius: f64) -> Outline {
        let at = PagePoint::new(centre.x - radius, centre.y - radius);
        let mut circle = Outline::rounded(PageRect { at, width: 2.0 * radius, height: 2.0 * radius }, radius);
        // The circle is a square with the largest possible corner radius. Remove its straight sides of length 0.
        circle.segments.retain(|s| !matches!(s, Segment::Line(_)));
        circle
    }

    /// Appends the parts of another outline.
    pub fn extend(&mut self, other: Outline) {
        self.segments.extend(other.segments);
    }

    /// Returns the same outline moved right by `x` and down by `y` pixels.
    pub(crate) fn moved(self, x: f64, y: f64) -> Outline {
        self.mapped(|p| p.moved(x, y))
    }

    /// Returns the outline with each of its points replaced by its image.
    pub(crate) fn mapped(self, image: impl Fn(PagePoint) -> PagePoint) -> Outline {
        let segments = self.segments.into_iter().map(|segment| match segment {
            Segment::Move(p) => Segment::Move(image(p)),
            Segment::Line(p) => Segment::Line(image(p)),
            Segment::Curve(a, b, c) => Segment::Curve(image(a), image(b), image(c)),
            Segment::Close => Segment::Close,
        });
        Outline { segments: segments.collect() }
    }

    /// Returns the end points and control points of all segments. The outline lies inside their convex hull.
    pub fn points(&self) -> impl Iterator<Item = PagePoint> + '_ {
        self.segments.iter().flat_map(|segment| match *segment {
            Segment::Move(p) | Segment::Line(p) => vec![p],
            Segment::Curve(a, b, c) => vec![a, b, c],
            Segment::Close => vec![],
        })
    }
}

/// The distance of each control point from the nearer end of a cubic curve that approximates a quarter circle of radius
/// 1: (4/3)·tan(π/8).
pub(crate) const QUARTER_CIRCLE_HANDLE: f64 = 0.552_284_749_830_793_4;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_stays_at_its_radius_half_way_along_each_curve() {
        let centre = PagePoint::new(3.0, -7.0);
        let mut from = centre;
        let mut curves = 0;
        for segment in Outline::circle(centre, 2.0).segments {
            match segment {
                Segment::Move(p) | Segment::Line(p) => from = p,
                Segment::Curve(a, b, to) => {
                    let x = (from.x + 3.0 * a.x + 3.0 * b.x + to.x) / 8.0 - centre.x;
                    let y = (from.y + 3.0 * a.y + 3.0 * b.y + to.y) / 8.0 - centre.y;
                    assert!((libm::hypot(x, y) - 2.0).abs() < 1e-6);
                    from = to;
                    curves += 1;
                }
                Segment::Close => {}
            }
        }
        assert_eq!(curves, 4);
    }
}
