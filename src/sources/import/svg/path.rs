//! Parses SVG path data into subpaths. It reads all commands, absolute and relative.

use core::f64::consts::TAU;

use svgtypes::{PathParser, PathSegment};

use crate::geometry::{Point, Vector, cross};
use crate::sources::import::subpath::{Arc, Segment, Subpath};

/// Returns the subpaths of a `d` attribute.
///
/// # Errors
/// Returns the message of the parser if the path data is not valid.
pub(super) fn subpaths(text: &str) -> Result<Vec<Subpath>, String> {
    let mut builder =
        SubpathBuilder { subpaths: Vec::new(), at: Point::origin(), open: None, handle: None, quadratic: None };
    for segment in PathParser::from(text) {
        builder.draw(segment.map_err(|error| error.to_string())?);
    }
    builder.finish();
    Ok(builder.subpaths)
}

struct SubpathBuilder {
    subpaths: Vec<Subpath>,
    at: Point,
    open: Option<Subpath>,
    /// The second control point of the last command if it was a cubic curve; a smooth curve mirrors it.
    handle: Option<Point>,
    /// The control point of the last command if it was a quadratic curve.
    quadratic: Option<Point>,
}

impl SubpathBuilder {
    /// Ends the current subpath. A subpath without segments is dropped.
    fn finish(&mut self) {
        self.subpaths.extend(self.open.take().filter(|subpath| !subpath.segments.is_empty()));
    }

    /// Adds a segment to the current subpath. After a `Z` that no `M` follows, the segment begins a new subpath at the
    /// current point.
    fn add(&mut self, segment: Segment) {
        let start = self.at;
        let subpath = self.open.get_or_insert(Subpath { start, segments: Vec::new(), closed: false });
        subpath.segments.push(segment);
        self.at = segment.end();
    }

    /// Adds the segments of one path command.
    fn draw(&mut self, segment: PathSegment) {
        let base = if segment.is_abs() { Vector::zeros() } else { self.at.coords };
        let place = |x: f64, y: f64| Point::new(x, y) + base;
        let (handle, quadratic) = (self.handle.take(), self.quadratic.take());
        match segment {
            PathSegment::MoveTo { x, y, .. } => self.begin(place(x, y)),
            PathSegment::LineTo { x, y, .. } => self.add(Segment::Line(place(x, y))),
            PathSegment::HorizontalLineTo { x, .. } => {
                self.add(Segment::Line(Point::new(x + base.x, self.at.y)));
            }
            PathSegment::VerticalLineTo { y, .. } => {
                self.add(Segment::Line(Point::new(self.at.x, y + base.y)));
            }
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                self.cubic(place(x1, y1), place(x2, y2), place(x, y));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = handle.map_or(self.at, |h| self.at + (self.at - h));
                self.cubic(first, place(x2, y2), place(x, y));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                self.quadratic(place(x1, y1), place(x, y));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let handle = quadratic.map_or(self.at, |h| self.at + (self.at - h));
                self.quadratic(handle, place(x, y));
            }
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                let to = place(x, y);
                let turn = x_axis_rotation.to_radians();
                self.add(match arc(self.at, to, [rx, ry], turn, large_arc, sweep) {
                    Some(arc) => Segment::Arc(arc),
                    None => Segment::Line(to),
                });
            }
            PathSegment::ClosePath { .. } => self.close(),
        }
    }

    /// Ends the current subpath and begins a new one at `start`.
    fn begin(&mut self, start: Point) {
        self.finish();
        self.at = start;
        self.open = Some(Subpath { start, segments: Vec::new(), closed: false });
    }

    /// Closes the current subpath and ends it.
    fn close(&mut self) {
        if let Some(mut subpath) = self.open.take() {
            self.at = subpath.start;
            subpath.closed = true;
            self.open = Some(subpath);
            self.finish();
        }
    }

    /// Adds a cubic Bézier curve with the control points `first` and `second`.
    fn cubic(&mut self, first: Point, second: Point, to: Point) {
        self.handle = Some(second);
        self.add(Segment::Cubic(first, second, to));
    }

    /// Adds a quadratic Bézier curve as a cubic one. The cubic control points are at 2/3 of the way from each end to
    /// `handle`.
    fn quadratic(&mut self, handle: Point, to: Point) {
        let towards = |from: Point| from + (handle - from) * (2.0 / 3.0);
        self.quadratic = Some(handle);
        self.add(Segment::Cubic(towards(self.at), towards(to), to));
    }
}

/// Converts an elliptical arc from end points to a centre and angles (SVG 2, appendix B.2.4). Returns `None` if the arc
/// is a straight line.
///
/// 1. Map the ellipse to the unit circle; h is half the chord.
/// 2. If the chord is longer than the diameter, enlarge the radii (B.2.5).
/// 3. The centre is at distance √(1 − h²) from the middle of the chord; the two flags decide on which side.
/// 4. Compute the angles of both ends, and correct the sign of the sweep.
fn arc(from: Point, to: Point, radii: [f64; 2], turn: f64, large: bool, clockwise: bool) -> Option<Arc> {
    let (rx, ry) = (radii[0].abs(), radii[1].abs());
    if from == to || !(rx > 0.0 && ry > 0.0) {
        return None;
    }
    let (sin, cos) = libm::sincos(turn);
    let (along, across) = (Vector::new(cos, sin), Vector::new(-sin, cos));
    // Steps 1 and 2: map the ellipse to the unit circle, and enlarge radii that are too small.
    let half = (from - to) / 2.0;
    let h = Vector::new(half.dot(&along) / rx, half.dot(&across) / ry);
    let length = h.norm();
    let scale = length.max(1.0);
    let (rx, ry) = (rx * scale, ry * scale);
    let h = h / scale;
    // Step 3: compute the centre.
    let off = ((1.0 - h.norm_squared()).max(0.0)).sqrt() / h.norm();
    let side = if large == clockwise { -off } else { off };
    let centre = Vector::new(h.y, -h.x) * side;
    let (u, v) = (along * rx, across * ry);
    let middle = from + (to - from) / 2.0;
    let (start, end) = (h - centre, -h - centre);
    // Step 4: compute the angles.
    let begin = libm::atan2(start.y, start.x);
    let mut sweep = libm::atan2(cross(start, end), start.dot(&end));
    // Correct the sign of the sweep. For a half circle, `atan2` may return +π or −π.
    if clockwise && sweep < 0.0 {
        sweep += TAU;
    } else if !clockwise && sweep > 0.0 {
        sweep -= TAU;
    }
    // A sweep of 0 is not an arc.
    if sweep == 0.0 || !(rx.is_finite() && ry.is_finite()) {
        return None;
    }
    Some(Arc { centre: middle + u * centre.x + v * centre.y, u, v, from: begin, sweep, to })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(d: &str) -> Vec<(f64, f64)> {
        let subpaths = subpaths(d).expect("path data");
        assert_eq!(subpaths.len(), 1, "{d}");
        let corners = subpaths[0].flattened(1e-4, 1e-9).expect("closed");
        corners.iter().map(|c| (c.at.x, c.at.y)).collect()
    }

    #[test]
    fn relative_commands_and_commands_with_one_coordinate_give_the_same_outline() {
        let square = [(1.0, 2.0), (5.0, 2.0), (5.0, 5.0), (1.0, 5.0)];
        for d in ["M1 2 5 2 5 5 1 5Z", "m1,2h4v3h-4z", "M1 2H5V5H1V2", "m 1 2 l 4 0 0 3 -4 0 z"] {
            assert_eq!(corners(d), square, "{d}");
        }
    }

    #[test]
    fn after_a_close_the_next_subpath_begins_at_the_start_of_the_closed_one() {
        let subpaths = subpaths("M1 1h2v2z l-5 0 0 -5z M9 9").expect("path data");
        assert_eq!(subpaths.len(), 2);
        assert_eq!(subpaths[1].start, Point::new(1.0, 1.0));
        assert_eq!(subpaths[1].segments[1], Segment::Line(Point::new(-4.0, -4.0)));
    }

    #[test]
    fn each_of_the_four_arcs_lies_on_its_ellipse() {
        for (large, sweep, centre) in [(0, 0, (4.0, 3.0)), (0, 1, (0.0, 0.0)), (1, 0, (0.0, 0.0)), (1, 1, (4.0, 3.0))] {
            let d = format!("M4 0A4 3 0 {large} {sweep} 0 3Z");
            let found = corners(&d);
            for p in &found {
                let reach = libm::hypot((p.0 - centre.0) / 4.0, (p.1 - centre.1) / 3.0);
                assert!((reach - 1.0).abs() < 1e-3, "{d}: {p:?}");
            }
            // The area of a quarter of an ellipse or of three quarters, minus or plus a triangle.
            let area = crate::geometry::snap::area(
                &subpaths(&d).expect("path data")[0].flattened(1e-4, 1e-9).expect("closed"),
            );
            let expected = 12.0 * core::f64::consts::PI / 4.0 * if large == 1 { 3.0 } else { 1.0 };
            let triangle = if large == 1 { 6.0 } else { -6.0 };
            assert!((area.abs() - expected - triangle).abs() < 1e-2, "{d}: {area}");
        }
        // Radii that are too small for their chord are enlarged. A radius of 0 gives a line.
        assert!(corners("M0 0A1 1 0 0 1 10 0Z").iter().all(|p| (libm::hypot(p.0 - 5.0, p.1) - 5.0).abs() < 1e-3));
        assert_eq!(corners("M0 0A0 1 0 0 1 10 0L3 3Z").len(), 3);
    }

    #[test]
    fn smooth_curves_mirror_the_previous_control_point() {
        let smooth = corners("M0 0C0 2 2 4 4 4S8 2 8 0Z");
        let plain = corners("M0 0C0 2 2 4 4 4C6 4 8 2 8 0Z");
        assert_eq!(smooth, plain);
        let smooth = corners("M0 0Q2 4 4 0T8 0L8-9Z");
        let plain = corners("M0 0Q2 4 4 0Q6 -4 8 0L8-9Z");
        assert_eq!(smooth, plain);
        assert!(subpaths("M0 0 L x").is_err());
    }
}
