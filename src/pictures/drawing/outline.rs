//! [`Outline`]: a path on the page that consists of straight lines and cubic curves. [`hatch`] fills an
//! outline with parallel lines, as engineering drawings show the ground.

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

    /// Creates an outline of straight lines, each between two points.
    pub fn lines(lines: impl IntoIterator<Item = [PagePoint; 2]>) -> Outline {
        let segments = lines.into_iter().flat_map(|[from, to]| [Segment::Move(from), Segment::Line(to)]);
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

/// Returns the parts of parallel 45° lines that lie inside the rings and inside `page`. `spacing` is the vertical
/// distance of neighbouring lines in pixels. The rings are filled by the even-odd rule, so holes stay empty. Parts that
/// are shorter than a pixel may be left out.
pub(crate) fn hatch(rings: &[Vec<PagePoint>], page: PageRect, spacing: f64) -> Vec<[PagePoint; 2]> {
    let mut lines = Vec::new();
    if !(spacing > 0.0) {
        return lines;
    }
    // The lines run down to the right on the page. Along each line, y − x has the constant value `level`.
    let first = page.at.y - page.at.x - page.width;
    let count = ((page.width + page.height) / spacing).floor();
    for number in 0..=count as usize {
        let level = first + spacing * number as f64;
        let mut cuts: Vec<f64> = Vec::new();
        for ring in rings {
            for i in 0..ring.len() {
                let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
                let (above, below) = (a.y - a.x - level, b.y - b.x - level);
                // A corner on the line counts as a corner below the line. The line then cuts each ring an even number
                // of times.
                if (above >= 0.0) != (below >= 0.0) {
                    cuts.push(a.x + (b.x - a.x) * above / (above - below));
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        let low = page.at.x.max(page.at.y - level);
        let high = (page.at.x + page.width).min(page.at.y + page.height - level);
        for pair in cuts.chunks_exact(2) {
            let (from, to) = (pair[0].max(low), pair[1].min(high));
            if to - from > 0.5 {
                let at = |x: f64| PagePoint::new(x, x + level);
                lines.push([at(from), at(to)]);
            }
        }
    }
    lines
}

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

    #[test]
    fn lines_lie_inside_the_outline_and_outside_holes() {
        let square = |from: f64, to: f64| {
            vec![PagePoint::new(from, from), PagePoint::new(to, from), PagePoint::new(to, to), PagePoint::new(from, to)]
        };
        let page = PageRect { at: PagePoint::new(0.0, 0.0), width: 80.0, height: 200.0 };
        let rings = [square(10.0, 100.0), square(40.0, 60.0)];
        let drawn = hatch(&rings, page, 5.0);
        assert!(drawn.len() > 20);
        for [a, b] in drawn {
            assert!((b.y - a.y - (b.x - a.x)).abs() < 1e-9);
            let middle = PagePoint::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0);
            let inside = |p: PagePoint, from: f64, to: f64| p.x > from && p.x < to && p.y > from && p.y < to;
            assert!(inside(middle, 10.0, 100.0) && !inside(middle, 40.0, 60.0));
            assert!(a.x >= 9.99 && b.x <= 80.01 && b.y <= 100.01);
        }
        assert!(hatch(&rings, page, 0.0).is_empty());
    }
}
