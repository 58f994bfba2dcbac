//! [`Polygon`]: a simple outline with holes, checked when it is constructed.
//!
//! Invariant: the outline runs anticlockwise and every hole clockwise. The material therefore lies to the left of each
//! edge, and [`Edge::outward`] points out of it. Repeated corners are dropped. Corners on a straight side are kept,
//! because the author of the scene may refer to them.

use super::crossing::{Crossing, crossings};
use super::edge::{orientation, ring_edges};
use super::{Bounds, Edge, Point, Vector, cross};

/// A ring with |area| up to this fraction of its squared perimeter encloses no area.
///
/// The value is about five times the machine epsilon, so that the computed area of collinear corners counts as 0. A
/// limit ten times smaller would accept the rounding error of a flat ring as an area. A limit ten times larger would
/// change little: for the thinnest stones of real scenes, the fraction is above 10⁻⁶.
const MIN_AREA_PER_SQUARED_PERIMETER: f64 = 1e-15;

/// A simple polygon, possibly with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    rings: Vec<Vec<Point>>,
}

/// Why rings of corners are not a polygon. Ring 0 is the outline, rings 1, 2, … are the holes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonError {
    /// A ring has fewer than three different corners.
    TooFewCorners {
        /// The number of the ring.
        ring: usize,
        /// The number of different corners of the ring.
        corners: usize,
    },
    /// A ring encloses no area.
    ZeroArea {
        /// The number of the ring.
        ring: usize,
    },
    /// Two sides cross or touch.
    Crossing {
        /// The rings of the two sides.
        rings: [usize; 2],
        /// The corners at which the two sides begin, numbered from 0 as the caller listed them.
        corners: [usize; 2],
        /// A common point of the two sides.
        at: Point,
    },
    /// A hole is not inside the outline, or is inside another hole.
    HoleOutside {
        /// The number of the ring.
        ring: usize,
    },
}

impl Polygon {
    /// Builds a polygon from the corners of its outline and of its holes. Each ring may run in either direction.
    ///
    /// # Errors
    /// All [`PolygonError`]s that were found. A ring with a coordinate that is not finite is reported as a ring of zero
    /// area.
    ///
    /// # Example
    /// ```
    /// use drystone::internals::geometry::{Point, Polygon};
    /// let wedge = Polygon::new(vec![Point::new(0.0, 0.0), Point::new(1.0, 3.0), Point::new(4.0, 0.0)], vec![])?;
    /// assert_eq!(wedge.area(), 6.0);
    /// assert!((wedge.centroid() - Point::new(5.0 / 3.0, 1.0)).norm() < 1e-15);
    /// # Ok::<(), Vec<drystone::internals::geometry::PolygonError>>(())
    /// ```
    pub fn new(outline: Vec<Point>, holes: Vec<Vec<Point>>) -> Result<Polygon, Vec<PolygonError>> {
        let mut rings = Vec::with_capacity(1 + holes.len());
        rings.push(outline);
        rings.extend(holes);
        let checked = check_rings(&mut rings)?;
        check_crossings(&rings, checked)?;
        for (ring, points) in rings.iter_mut().enumerate() {
            let is_outline = ring == 0;
            if (signed_area(points) > 0.0) != is_outline {
                points.reverse();
            }
        }
        check_holes(&rings)?;
        Ok(Polygon { rings })
    }

    /// Creates a polygon without checks. The rings must be valid: the outline anticlockwise, the holes clockwise, no
    /// crossings.
    pub(crate) fn from_valid_rings(rings: Vec<Vec<Point>>) -> Polygon {
        Polygon { rings }
    }

    /// Returns the corners of the outline, anticlockwise. The first corner is not repeated at the end.
    pub fn outline(&self) -> &[Point] {
        &self.rings[0]
    }

    /// Returns the corners of each hole, clockwise.
    pub fn holes(&self) -> &[Vec<Point>] {
        &self.rings[1..]
    }

    /// Returns the rings: the outline, then the holes.
    pub fn rings(&self) -> &[Vec<Point>] {
        &self.rings
    }

    /// Returns every side of the outline and of the holes. The material is on the left of each side.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        self.rings.iter().flat_map(|ring| ring_edges(ring))
    }

    /// Returns the area in square metres. The area of the holes is not included.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| signed_area(ring)).sum()
    }

    /// Returns the centroid of the polygon's area, which does not include the holes.
    pub fn centroid(&self) -> Point {
        // Use coordinates relative to a corner. For a block far from the origin, differences between products of
        // absolute coordinates would lose digits.
        let base = self.rings[0][0];
        let mut doubled_area = 0.0;
        let mut moment = Vector::zeros();
        for edge in self.edges() {
            let (a, b) = (edge.from - base, edge.to - base);
            let doubled = cross(a, b);
            doubled_area += doubled;
            moment += (a + b) * doubled;
        }
        base + moment / (3.0 * doubled_area)
    }

    /// Returns the smallest axis-parallel rectangle around the outline.
    pub fn bounds(&self) -> Bounds {
        let first = self.rings[0][0];
        self.rings[0].iter().fold(Bounds { min: first, max: first }, |b, p| b.union(Bounds { min: *p, max: *p }))
    }

    /// True if a point lies inside the outline and outside all holes. A point exactly on a side may give either result.
    pub fn contains(&self, point: Point) -> bool {
        self.rings.iter().filter(|ring| ring_contains(ring, point)).count() == 1
    }

    /// Returns the distance of a point from the polygon in metres; 0 for a point inside.
    pub(crate) fn distance(&self, point: Point) -> f64 {
        if self.contains(point) {
            return 0.0;
        }
        let distances = self.edges().map(|edge| edge.distance(point));
        distances.fold(f64::INFINITY, f64::min)
    }

    /// True if the polygon has no holes and its outline never turns right.
    pub fn is_convex(&self) -> bool {
        let ring = &self.rings[0];
        self.rings.len() == 1
            && (0..ring.len()).all(|i| {
                let (a, b, c) = (ring[i], ring[(i + 1) % ring.len()], ring[(i + 2) % ring.len()]);
                orientation(a, b, c) >= 0.0
            })
    }

    /// Returns the polygon rotated anticlockwise by `degrees` about the origin and then moved by `by` metres.
    pub fn placed(mut self, degrees: f64, by: Vector) -> Polygon {
        let (sin, cos) = sin_cos_degrees(degrees);
        for p in self.rings.iter_mut().flatten() {
            *p = Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y) + by;
        }
        self
    }
}

/// Returns sine and cosine of an angle in degrees. Both are exact at multiples of 90°.
pub(crate) fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turned = degrees.rem_euclid(360.0);
    if turned == 0.0 {
        (0.0, 1.0)
    } else if turned == 90.0 {
        (1.0, 0.0)
    } else if turned == 180.0 {
        (0.0, -1.0)
    } else if turned == 270.0 {
        (-1.0, 0.0)
    } else {
        libm::sincos(turned.to_radians())
    }
}

/// The results of [`check_rings`] for rings that it accepts.
#[derive(Default)]
struct CheckedRings {
    dropped: DroppedCorners,
    /// Rings whose corners are not collinear, but whose area is 0, usually because their sides cross.
    without_area: Vec<PolygonError>,
}

/// Drops repeated corners, then checks each ring separately. A ring must have at least three corners, finite
/// coordinates, and corners that do not all lie on one line.
fn check_rings(rings: &mut [Vec<Point>]) -> Result<CheckedRings, Vec<PolygonError>> {
    let mut errors = Vec::new();
    let mut checked = CheckedRings::default();
    for (ring, points) in rings.iter_mut().enumerate() {
        checked.dropped.drop_repeated(points, ring);
        if points.len() < 3 {
            errors.push(PolygonError::TooFewCorners { ring, corners: points.len() });
            continue;
        }
        let area = signed_area(points);
        let perimeter: f64 = ring_edges(points).map(|e| e.length()).sum();
        // The comparison is false if the area is NaN, so such a ring is rejected below.
        let encloses_area = area.abs() > MIN_AREA_PER_SQUARED_PERIMETER * perimeter * perimeter;
        if !encloses_area {
            let is_collinear = |p: &Point| orientation(points[0], points[1], *p) == 0.0;
            if !area.is_finite() || points.iter().all(is_collinear) {
                errors.push(PolygonError::ZeroArea { ring });
            } else {
                checked.without_area.push(PolygonError::ZeroArea { ring });
            }
        }
    }
    if errors.is_empty() { Ok(checked) } else { Err(errors) }
}

/// Returns an error for each pair of sides that [`crossings`] finds: pairs that cross or touch. If there is no such
/// pair, returns an error for each ring without area.
///
/// If two sides cross, the areas of the two loops can cancel. Then only the crossing is reported, not the zero area.
fn check_crossings(rings: &[Vec<Point>], checked: CheckedRings) -> Result<(), Vec<PolygonError>> {
    let error = |crossing: Crossing| {
        let listed = |side: usize| (checked.dropped).listed(crossing.rings[side], crossing.corners[side]);
        PolygonError::Crossing { rings: crossing.rings, corners: [listed(0), listed(1)], at: crossing.at }
    };
    let mut errors: Vec<PolygonError> = crossings(rings).into_iter().map(error).collect();
    if errors.is_empty() {
        errors = checked.without_area;
    }
    if errors.is_empty() { Ok(()) } else { Err(errors) }
}

/// Returns an error for each hole outside the outline or inside another hole. The rings do not cross, so it is enough
/// to test one corner of each hole.
fn check_holes(rings: &[Vec<Point>]) -> Result<(), Vec<PolygonError>> {
    let mut errors = Vec::new();
    for ring in 1..rings.len() {
        let corner = rings[ring][0];
        let in_other_hole = (1..rings.len()).any(|k| k != ring && ring_contains(&rings[k], corner));
        if !ring_contains(&rings[0], corner) || in_other_hole {
            errors.push(PolygonError::HoleOutside { ring });
        }
    }
    if errors.is_empty() { Ok(()) } else { Err(errors) }
}

/// The repeated corners that were dropped, each as (ring, index in the caller's list), in ascending order.
#[derive(Default)]
struct DroppedCorners(Vec<(usize, usize)>);

impl DroppedCorners {
    /// Removes each corner of a ring that equals the corner before it, and records its index. Then removes corners at
    /// the end of the ring that equal the first corner. Their indices are not recorded, because their removal does not
    /// change the index of any other corner.
    fn drop_repeated(&mut self, points: &mut Vec<Point>, ring: usize) {
        let (mut before, mut number) = (None, 0);
        points.retain(|p| {
            let repeats = before.replace(*p) == Some(*p);
            if repeats {
                self.0.push((ring, number));
            }
            number += 1;
            !repeats
        });
        // Remove the repeated first corner that many formats write at the end of a ring.
        while points.len() > 1 && points[0] == points[points.len() - 1] {
            points.pop();
        }
    }

    /// Returns the index of a corner in the list that the caller passed. `kept` is the corner's index after repeated
    /// corners were dropped.
    fn listed(&self, ring: usize, kept: usize) -> usize {
        let dropped = self.0.iter().filter(|dropped| dropped.0 == ring);
        dropped.fold(kept, |number, (_, d)| number + usize::from(*d <= number))
    }
}

/// Returns the area of a ring in square metres by the shoelace formula, positive if the ring runs anticlockwise.
fn signed_area(ring: &[Point]) -> f64 {
    let base = ring[0];
    ring_edges(ring).map(|e| cross(e.from - base, e.to - base)).sum::<f64>() / 2.0
}

/// True if a point lies inside a ring: a ray from the point to the right crosses the ring an odd number of times.
fn ring_contains(ring: &[Point], p: Point) -> bool {
    let mut inside = false;
    for e in ring_edges(ring) {
        if (e.from.y > p.y) != (e.to.y > p.y) {
            let turn = orientation(e.from, e.to, p);
            if (e.to.y > e.from.y) == (turn > 0.0) {
                inside = !inside;
            }
        }
    }
    inside
}

/// Returns the corners of the convex hull of some points, anticlockwise. Points on the sides of the hull are left out.
/// Monotone chain algorithm, Andrew 1979.
pub(crate) fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let mut ring: Vec<Point> = Vec::with_capacity(points.len() + 1);
    for pass in 0..2 {
        let begin = ring.len();
        for p in &points {
            while ring.len() >= begin + 2 && {
                let [a, b] = [ring[ring.len() - 2], ring[ring.len() - 1]];
                cross(b - a, *p - b) <= 0.0
            } {
                ring.pop();
            }
            ring.push(*p);
        }
        ring.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    ring
}

#[cfg(test)]
mod tests;
