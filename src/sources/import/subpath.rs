//! [`Subpath`]: a connected sequence of lines and curves, which can be flattened into corners.
//!
//! A curve is divided into equal steps of its parameter. The number of steps follows from a bound on the distance
//! between chord and curve. Adaptive subdivision would need fewer steps, but equal steps give the same corners if the
//! curve is drawn in the other direction, as in the outline of the neighbouring block. The two blocks therefore touch
//! along the whole curve. [`Affine`] maps are the nested transforms in a drawing.

use core::f64::consts::{FRAC_PI_2, TAU};

use crate::geometry::snap::Corner;
use crate::geometry::{Circle, Point, Vector, cross, quarter_turn, sin_cos_degrees};

/// Arcs whose centres, radii and angles differ by less than this share of the radius form one circle.
const SAME_CIRCLE: f64 = 1e-6;
/// A segment with a smaller bulge is a straight line. The bulge is the sagitta divided by half the chord.
const MIN_BULGE: f64 = 1e-9;
/// A curve becomes at least two chords if the area between it and its chord is more than this share of the square of the
/// chord.
const NEGLIGIBLE_AREA: f64 = 1e-5;
/// Chords are within this share of the tolerance before their corners are moved: they move by up to 4/3 of the distance.
const BALANCED_SHARE: f64 = 0.75;
/// The largest number of chords of one curve.
const MAX_CHORDS: f64 = 4096.0;

/// A connected sequence of segments.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subpath {
    pub(super) start: Point,
    pub(super) segments: Vec<Segment>,
    /// Whether the subpath is closed. A straight line then joins its end to its start if these are different points.
    pub(super) closed: bool,
}

/// A segment of a subpath. It starts at the end of the segment before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Segment {
    Line(Point),
    /// A cubic Bézier curve: two control points and the end.
    Cubic(Point, Point, Point),
    Arc(Arc),
}

/// An elliptical arc: `centre + u cos θ + v sin θ` for θ from `from` to `from + sweep`, in radians. `to` is the end
/// point as it was given, without rounding errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    pub(super) centre: Point,
    pub(super) u: Vector,
    pub(super) v: Vector,
    pub(super) from: f64,
    pub(super) sweep: f64,
    pub(super) to: Point,
}

impl Subpath {
    pub(super) fn closed(corners: &[Point]) -> Option<Subpath> {
        let (start, rest) = corners.split_first()?;
        Some(Subpath { start: *start, segments: rest.iter().map(|p| Segment::Line(*p)).collect(), closed: true })
    }

    /// Returns an ellipse with half axes `rx` and `ry` along x and y. It starts at `centre` + (`rx`, 0) and turns from
    /// x towards y.
    pub(super) fn ellipse(centre: Point, rx: f64, ry: f64) -> Subpath {
        let (u, v) = (Vector::new(rx, 0.0), Vector::new(0.0, ry));
        // Two halves keep the symmetry when chords replace them.
        let half = |from: f64, to: Point| Segment::Arc(Arc { centre, u, v, from, sweep: TAU / 2.0, to });
        Subpath { start: centre + u, segments: vec![half(0.0, centre - u), half(TAU / 2.0, centre + u)], closed: true }
    }

    pub(super) fn mapped(&self, map: &Affine) -> Subpath {
        let segment = |segment: &Segment| match segment {
            Segment::Line(to) => Segment::Line(map.point(*to)),
            Segment::Cubic(a, b, to) => Segment::Cubic(map.point(*a), map.point(*b), map.point(*to)),
            Segment::Arc(arc) => Segment::Arc(Arc {
                centre: map.point(arc.centre),
                u: map.vector(arc.u),
                v: map.vector(arc.v),
                to: map.point(arc.to),
                ..*arc
            }),
        };
        Subpath {
            start: map.point(self.start),
            segments: self.segments.iter().map(segment).collect(),
            closed: self.closed,
        }
    }

    /// Returns the same curve in the opposite direction.
    pub(super) fn reversed(&self) -> Subpath {
        let mut ends = vec![self.start];
        ends.extend(self.segments.iter().map(Segment::end));
        let back = |(i, segment): (usize, &Segment)| match segment {
            Segment::Line(_) => Segment::Line(ends[i]),
            Segment::Cubic(a, b, _) => Segment::Cubic(*b, *a, ends[i]),
            Segment::Arc(arc) => {
                Segment::Arc(Arc { from: arc.from + arc.sweep, sweep: -arc.sweep, to: ends[i], ..*arc })
            }
        };
        Subpath {
            start: ends[ends.len() - 1],
            segments: self.segments.iter().enumerate().rev().map(back).collect(),
            closed: self.closed,
        }
    }

    /// Returns the circle that the subpath is. `None` if it is another curve.
    pub(super) fn circle(&self) -> Option<Circle> {
        let first = self.segments.iter().find_map(|segment| match segment {
            Segment::Arc(arc) => Some(arc),
            _ => None,
        })?;
        let radius = first.u.norm();
        let small = SAME_CIRCLE * radius;
        let mut turn = 0.0;
        let mut from = self.start;
        for segment in &self.segments {
            match segment {
                Segment::Arc(arc) => {
                    let is_same = (arc.centre - first.centre).norm() <= small
                        && (arc.u.norm() - radius).abs() <= small
                        && (arc.v.norm() - radius).abs() <= small
                        && arc.u.dot(&arc.v).abs() <= small * radius;
                    turn += if is_same { cross(arc.u, arc.v).signum() * arc.sweep } else { f64::NAN };
                }
                _ if (segment.end() - from).norm() <= small => {}
                _ => return None,
            }
            from = segment.end();
        }
        ((turn.abs() - TAU).abs() <= SAME_CIRCLE).then_some(Circle { centre: first.centre, radius })
    }

    /// True if the subpath has a segment that is not straight.
    pub(super) fn has_curves(&self) -> bool {
        let straight = |segment: &Segment| matches!(segment, Segment::Line(_));
        !self.segments.iter().all(straight)
    }

    pub(super) fn end(&self) -> Point {
        self.segments.last().map_or(self.start, Segment::end)
    }

    /// Returns the segments, each with the point at which it begins; also the line that closes the subpath.
    pub(super) fn starts(&self) -> impl Iterator<Item = (Point, Segment)> {
        let closing = (self.closed && self.end() != self.start).then_some((self.end(), Segment::Line(self.start)));
        let starts = [self.start].into_iter().chain(self.segments.iter().map(Segment::end));
        starts.zip(self.segments.iter().copied()).chain(closing)
    }

    /// Returns points whose bounding box contains the subpath.
    pub(super) fn hull(&self) -> Vec<Point> {
        let mut points = vec![self.start];
        for segment in &self.segments {
            match segment {
                Segment::Line(to) => points.push(*to),
                Segment::Cubic(a, b, to) => points.extend([*a, *b, *to]),
                Segment::Arc(arc) => {
                    let reach = Vector::new(libm::hypot(arc.u.x, arc.v.x), libm::hypot(arc.u.y, arc.v.y));
                    points.extend([arc.centre - reach, arc.centre + reach]);
                }
            }
        }
        points
    }

    /// Returns the number of corners of the subpath if chords that are at most `tolerance` from its curves replace them.
    pub(super) fn corners(&self, tolerance: f64) -> f64 {
        self.starts().map(|(from, segment)| segment.balanced_chords(from, tolerance)).sum()
    }

    /// Replaces curves by chords that are at most `tolerance` from them, and returns the corners. They lie a little beside
    /// the curve, so that the chords enclose its area. If the last corner is at most `close` from the first, it is left out. Returns `None` if the subpath is open and its ends are
    /// farther apart than `close`.
    pub(super) fn flattened(&self, tolerance: f64, close: f64) -> Option<Vec<Corner>> {
        let mut corners = vec![Corner { at: self.start, curved: false }];
        for segment in &self.segments {
            let from = corners[corners.len() - 1].at;
            let inner = segment.balanced(from, tolerance);
            let last = corners.len() - 1;
            corners[last].curved = !inner.is_empty();
            corners.extend(inner.into_iter().map(|at| Corner { at, curved: true }));
            corners.push(Corner { at: segment.end(), curved: false });
        }
        let (first, last) = (corners[0].at, corners[corners.len() - 1].at);
        if corners.len() > 1 && (last - first).norm() <= close {
            corners.pop();
        } else if !self.closed {
            return None;
        }
        Some(corners)
    }
}

impl Segment {
    /// Returns the segment between two points: an arc, or a straight line if the bulge is negligible. The bulge is the
    /// tangent of a quarter of the arc's angle, and is positive if the arc turns anticlockwise.
    ///
    /// With half the chord c and the bulge b, the sagitta is b·c and the radius is c·(1+b²)/(2|b|). The centre lies
    /// c·(1−b²)/(2b) to the left of the middle of the chord.
    pub(super) fn bulged(from: Point, to: Point, bulge: f64) -> Segment {
        let half = (to - from) / 2.0;
        if !(bulge.abs() > MIN_BULGE) || half.norm() == 0.0 {
            return Segment::Line(to);
        }
        let centre = from + half + quarter_turn(half) * ((1.0 - bulge * bulge) / (2.0 * bulge));
        let u = from - centre;
        Segment::Arc(Arc { centre, u, v: quarter_turn(u), from: 0.0, sweep: 4.0 * libm::atan(bulge), to })
    }

    pub(super) fn end(&self) -> Point {
        match self {
            Segment::Line(to) | Segment::Cubic(_, _, to) => *to,
            Segment::Arc(arc) => arc.to,
        }
    }

    /// Returns the part of a segment between two shares of its parameter, with its end moved to `end`. The whole segment
    /// begins at `from`.
    pub(super) fn between(&self, from: Point, [first, last]: [f64; 2], end: Point) -> Segment {
        match self {
            Segment::Line(_) => Segment::Line(end),
            Segment::Arc(arc) => Segment::Arc(Arc {
                from: arc.from + arc.sweep * first,
                sweep: arc.sweep * (last - first),
                to: end,
                ..*arc
            }),
            Segment::Cubic(a, b, to) => {
                let tangent = |t: f64| {
                    let s = 1.0 - t;
                    ((a - from) * (s * s) + (b - a) * (2.0 * s * t) + (to - b) * (t * t)) * (last - first)
                };
                Segment::Cubic(self.at(from, first) + tangent(first), self.at(from, last) - tangent(last), end)
            }
        }
    }

    /// Returns the number of chords, at most `tolerance` from the curve, that replace a segment that begins at `from`.
    fn chords(&self, from: Point, tolerance: f64) -> f64 {
        match self {
            Segment::Line(_) => 1.0,
            Segment::Cubic(a, b, to) => {
                // A chord over 1/n of the parameter is at most |second derivative| / 8n² from the curve. The second
                // derivative of a cubic is at most 6 times the larger second difference of its control points.
                let bend = (a.coords * 2.0 - from.coords - b.coords)
                    .norm()
                    .max((b.coords * 2.0 - a.coords - to.coords).norm());
                steps((0.75 * bend / tolerance).sqrt())
            }
            Segment::Arc(arc) => {
                let radius = largest_radius(arc.u, arc.v);
                let half = if tolerance < radius { libm::acos(1.0 - tolerance / radius) } else { FRAC_PI_2 };
                // A chord spans at most 45°, so that a circle has at least 8 corners at any tolerance.
                let widest = (2.0 * half).min(TAU / 8.0);
                steps((arc.sweep.abs() / widest) * (1.0 - 1e-9))
            }
        }
    }

    /// Returns the corners between the ends of a segment that begins at `from`. The chords between the corners are at
    /// most `tolerance` from the curve.
    pub(super) fn inner(&self, from: Point, tolerance: f64) -> Vec<Point> {
        let n = self.chords(from, tolerance);
        (1..n as u32).map(|k| self.at(from, f64::from(k) / n)).collect()
    }

    /// Returns the area that the curve and its chord enclose, positive if the way along the curve and back along the chord is
    /// anticlockwise.
    fn area(&self, from: Point) -> f64 {
        match self {
            Segment::Line(_) => 0.0,
            Segment::Arc(arc) => {
                // The sweep turns around the centre; the chord cuts off the triangle.
                cross(arc.u, arc.v) * (arc.sweep - libm::sin(arc.sweep)) / 2.0
            }
            Segment::Cubic(a, b, to) => {
                let [a, b, c] = [a, b, to].map(|p| p - from);
                3.0 * (cross(a, b) + cross(a, c) + 2.0 * cross(b, c)) / 20.0
            }
        }
    }

    fn balanced_chords(&self, from: Point, tolerance: f64) -> f64 {
        let chord = self.end() - from;
        let least = if self.area(from).abs() > NEGLIGIBLE_AREA * chord.norm_squared() { 2.0 } else { 1.0 };
        self.chords(from, BALANCED_SHARE * tolerance).max(least)
    }

    /// Like [`inner`](Segment::inner), but the corners are moved beside the curve, all by the same distance, so that the
    /// chords enclose the area that the curve encloses.
    fn balanced(&self, from: Point, tolerance: f64) -> Vec<Point> {
        let n = self.balanced_chords(from, tolerance);
        let mut inner: Vec<Point> = (1..n as u32).map(|k| self.at(from, f64::from(k) / n)).collect();
        // Moving a corner by d to the right of the line between its neighbours, of length l, adds d·l/2. The second step
        // corrects what two neighbours add together.
        for _ in 0..2 {
            let all: Vec<Point> = [from].into_iter().chain(inner.iter().copied()).chain([self.end()]).collect();
            let enclosed: f64 = all.windows(2).map(|pair| cross(pair[0] - from, pair[1] - from) / 2.0).sum();
            let across: Vec<Vector> = all.windows(3).map(|three| three[2] - three[0]).collect();
            let length: f64 = across.iter().map(|along| along.norm()).sum();
            let distance = 2.0 * (self.area(from) - enclosed) / length;
            if distance.is_finite() {
                let right = across.iter().map(|along| -quarter_turn(*along) / along.norm());
                inner
                    .iter_mut()
                    .zip(right)
                    .filter(|(_, right)| right.x.is_finite())
                    .for_each(|(p, right)| *p += right * distance);
            }
        }
        inner
    }

    /// Returns the point of a segment that begins at `from` at a share of its parameter.
    pub(super) fn at(&self, from: Point, share: f64) -> Point {
        match self {
            Segment::Line(to) => from + (to - from) * share,
            Segment::Cubic(a, b, to) => {
                let (t, s) = (share, 1.0 - share);
                let ends = from.coords * (s * s * s) + to.coords * (t * t * t);
                Point::from(ends + (a.coords * s + b.coords * t) * (3.0 * s * t))
            }
            Segment::Arc(arc) => {
                let (sin, cos) = sin_cos(arc.from + arc.sweep * share);
                arc.centre + arc.u * cos + arc.v * sin
            }
        }
    }
}

fn steps(count: f64) -> f64 {
    // The comparison is false if `count` is NaN; the result is then one step.
    if count > 1.0 { count.ceil().min(MAX_CHORDS) } else { 1.0 }
}

/// Returns the sine and the cosine of an angle in radians. They are exact if the angle is a multiple of 90° within 1e-12
/// quarter turns, which allows for rounding errors of angles from `atan2`.
fn sin_cos(angle: f64) -> (f64, f64) {
    let quarters = angle / FRAC_PI_2;
    let whole = quarters.round();
    if (quarters - whole).abs() > 1e-12 {
        return libm::sincos(angle);
    }
    match whole.rem_euclid(4.0) as u8 {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// Returns the largest radius of the ellipse `u cos θ + v sin θ`, which is the larger singular value of the matrix (u
/// v).
fn largest_radius(u: Vector, v: Vector) -> f64 {
    let (sum, det) = (u.norm_squared() + v.norm_squared(), cross(u, v));
    let inner = (sum * sum - 4.0 * det * det).max(0.0).sqrt();
    ((sum + inner) / 2.0).sqrt()
}

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
    fn a_chord_is_within_the_tolerance_of_its_curve() {
        let subpath = Subpath::ellipse(Point::new(2.0, 1.0), 5.0, 3.0);
        for tolerance in [1.0, 0.1, 1e-3] {
            let corners = subpath.flattened(tolerance, 0.0).expect("closed");
            let off = |p: Point| {
                let d = p - Point::new(2.0, 1.0);
                (1.0 - libm::hypot(d.x / 5.0, d.y / 3.0)) * 5.0
            };
            for i in 0..corners.len() {
                let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                let middle = a.at + (b.at - a.at) / 2.0;
                assert!(a.curved && [a.at, middle].iter().all(|p| off(*p).abs() <= 1.01 * tolerance));
            }
            let area = crate::geometry::snap::area(&corners) / (15.0 * core::f64::consts::PI);
            assert!((area - 1.0).abs() < 1e-4, "{area}");
        }
        assert_eq!(subpath.flattened(99.0, 0.0).expect("closed").len(), 8);
    }

    #[test]
    fn a_reversed_curve_has_the_same_corners() {
        let p = [(0.0, 0.0), (1.0, 3.0), (4.0, 3.5), (6.0, -1.0)].map(|p| Point::new(p.0, p.1));
        let there = Segment::Cubic(p[1], p[2], p[3]).inner(p[0], 0.01);
        let mut back = Segment::Cubic(p[2], p[1], p[0]).inner(p[3], 0.01);
        back.reverse();
        assert!(there.len() > 5);
        assert_eq!(there.len(), back.len());
        for (a, b) in there.iter().zip(&back) {
            assert!((a - b).norm() < 1e-14);
        }
    }

    #[test]
    fn an_open_subpath_is_an_outline_only_if_its_ends_nearly_meet() {
        let mut subpath =
            Subpath::closed(&[(0.0, 0.0), (3.0, 0.0), (0.0, 2.0), (0.0, 0.001)].map(|p| Point::new(p.0, p.1)))
                .expect("corners");
        assert_eq!(subpath.flattened(0.1, 1e-6).map(|c| c.len()), Some(4));
        subpath.closed = false;
        assert_eq!(subpath.flattened(0.1, 1e-6), None);
        assert_eq!(subpath.flattened(0.1, 0.01).map(|c| c.len()), Some(3));
    }

    #[test]
    fn the_inner_map_comes_first() {
        let map = Affine::translation(10.0, 20.0).after(&Affine::rotation(90.0));
        assert_eq!(map.point(Point::new(3.0, 1.0)), Point::new(9.0, 23.0));
        let map = Affine::rotation(90.0).after(&Affine::translation(10.0, 20.0));
        assert_eq!(map.point(Point::new(3.0, 1.0)), Point::new(-21.0, 13.0));
    }
}
