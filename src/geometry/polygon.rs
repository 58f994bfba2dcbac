//! [`Polygon`]: a simple outline with holes, checked when it is made.
//!
//! Invariant: the outer ring runs anticlockwise and every hole clockwise, so that the material always lies to the left
//! of an edge and [`Edge::outward`] always points out of it. Repeated corners are dropped; corners on a straight line
//! stay, they are the author's.

use super::{Aabb, BoxIndex, Point, Vector, cross};

/// A simple polygon, perhaps with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    rings: Vec<Vec<Point>>,
}

/// One side of a polygon, with the material on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Where the edge begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
}

impl Edge {
    /// From begin to end, metres.
    pub fn vector(&self) -> Vector {
        self.to - self.from
    }

    /// Length in metres.
    pub fn length(&self) -> f64 {
        self.vector().norm()
    }

    /// The unit normal that points out of the material.
    pub fn outward(&self) -> Vector {
        let d = self.vector().normalize();
        Vector::new(d.y, -d.x)
    }

    /// The box around it.
    pub(crate) fn around(&self) -> Aabb {
        let (a, b) = (self.from, self.to);
        Aabb {
            min: [a.x.min(b.x), a.y.min(b.y)],
            max: [a.x.max(b.x), a.y.max(b.y)],
        }
    }
}

/// An axis-parallel box in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Bounds {
    /// The smallest box around some points, `None` for no points.
    pub fn from_points(points: impl IntoIterator<Item = Point>) -> Option<Bounds> {
        points.into_iter().fold(None, |bounds: Option<Bounds>, p| {
            let b = bounds.unwrap_or(Bounds { min: p, max: p });
            Some(Bounds {
                min: b.min.inf(&p),
                max: b.max.sup(&p),
            })
        })
    }

    /// The smallest box around two boxes.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds {
            min: self.min.inf(&other.min),
            max: self.max.sup(&other.max),
        }
    }

    /// The box grown by `margin` metres on every side.
    pub fn grown(self, margin: f64) -> Bounds {
        let m = Vector::new(margin, margin);
        Bounds {
            min: self.min - m,
            max: self.max + m,
        }
    }

    /// Length of the diagonal in metres.
    pub fn diagonal(self) -> f64 {
        (self.max - self.min).norm()
    }

    /// Width in metres.
    pub fn width(self) -> f64 {
        self.max.x - self.min.x
    }

    /// Height in metres.
    pub fn height(self) -> f64 {
        self.max.y - self.min.y
    }

    /// Whether two boxes share a point.
    pub fn meets(self, other: Bounds) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }
}

/// A way in which a list of corners is no polygon. `ring` 0 is the outline, ring k the k-th hole from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonError {
    /// Fewer than three different corners.
    TooFewCorners {
        /// Which ring.
        ring: usize,
        /// How many different corners it has.
        corners: usize,
    },
    /// The ring encloses nothing.
    ZeroArea {
        /// Which ring.
        ring: usize,
    },
    /// Two sides cross or touch where they should not.
    Crossing {
        /// Rings of the two sides.
        rings: [usize; 2],
        /// The corners (as listed) at which the two sides begin.
        corners: [usize; 2],
        /// Where they meet.
        at: Point,
    },
    /// A hole that is not inside the outline, or is inside another hole.
    HoleOutside {
        /// Which ring.
        ring: usize,
    },
}

impl Polygon {
    /// A polygon from its corners, either way round, and its holes.
    ///
    /// # Errors
    /// Every [`PolygonError`] that was found. Coordinates must be finite; a non-finite one is a flaw of zero area.
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
        let mut flaws = Vec::new();
        let mut rings = Vec::with_capacity(1 + holes.len());
        rings.push(outline);
        rings.extend(holes);
        let mut flat = Vec::new();
        let mut repeats = Repeats::default();
        for (ring, points) in rings.iter_mut().enumerate() {
            repeats.drop_from(points, ring);
            if points.len() < 3 {
                flaws.push(PolygonError::TooFewCorners {
                    ring,
                    corners: points.len(),
                });
                continue;
            }
            let area = signed_area(points);
            let perimeter: f64 = sides(points).map(|e| e.length()).sum();
            // Written so that NaN counts as no area.
            let encloses = area.abs() > 1e-15 * perimeter * perimeter;
            if !encloses {
                let straight = |p: &Point| orientation(points[0], points[1], *p) == 0.0;
                if !area.is_finite() || points.iter().all(straight) {
                    flaws.push(PolygonError::ZeroArea { ring });
                } else {
                    flat.push(PolygonError::ZeroArea { ring });
                }
            }
        }
        if flaws.is_empty() {
            // The areas on both sides of a crossing can cancel: then the crossing is the flaw, not the area.
            flaws = crossings(&rings, &repeats);
        }
        if flaws.is_empty() {
            flaws = flat;
        }
        if !flaws.is_empty() {
            return Err(flaws);
        }
        for (ring, points) in rings.iter_mut().enumerate() {
            if (signed_area(points) > 0.0) != (ring == 0) {
                points.reverse();
            }
        }
        for ring in 1..rings.len() {
            let corner = rings[ring][0];
            let inside_other =
                (1..rings.len()).any(|k| k != ring && ring_contains(&rings[k], corner));
            if !ring_contains(&rings[0], corner) || inside_other {
                flaws.push(PolygonError::HoleOutside { ring });
            }
        }
        if flaws.is_empty() {
            Ok(Polygon { rings })
        } else {
            Err(flaws)
        }
    }

    /// A polygon from rings known to be sound: outline anticlockwise, holes clockwise, as a lattice traces them.
    pub(crate) fn from_traced(rings: Vec<Vec<Point>>) -> Polygon {
        Polygon { rings }
    }

    /// The outline, anticlockwise, without a repeated last corner.
    pub fn outline(&self) -> &[Point] {
        &self.rings[0]
    }

    /// The holes, each clockwise.
    pub fn holes(&self) -> &[Vec<Point>] {
        &self.rings[1..]
    }

    /// The outline and then the holes.
    pub fn rings(&self) -> &[Vec<Point>] {
        &self.rings
    }

    /// Every side, with the material on its left.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        self.rings.iter().flat_map(|ring| sides(ring))
    }

    /// Area in square metres, holes taken out.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| signed_area(ring)).sum()
    }

    /// Centroid of the area.
    pub fn centroid(&self) -> Point {
        let base = self.rings[0][0];
        let mut area = 0.0;
        let mut moment = Vector::zeros();
        for edge in self.edges() {
            let (a, b) = (edge.from - base, edge.to - base);
            let twice = cross(a, b);
            area += twice;
            moment += (a + b) * twice;
        }
        base + moment / (3.0 * area)
    }

    /// The box around the outline.
    pub fn bounds(&self) -> Bounds {
        let first = self.rings[0][0];
        self.rings[0].iter().fold(
            Bounds {
                min: first,
                max: first,
            },
            |b, p| b.union(Bounds { min: *p, max: *p }),
        )
    }

    /// Whether a point lies inside the material (on its edge: either answer).
    pub fn contains(&self, point: Point) -> bool {
        self.rings
            .iter()
            .filter(|ring| ring_contains(ring, point))
            .count()
            == 1
    }

    /// Whether the outline has no holes and turns left at every corner.
    pub fn is_convex(&self) -> bool {
        let ring = &self.rings[0];
        self.rings.len() == 1
            && (0..ring.len()).all(|i| {
                let (a, b, c) = (
                    ring[i],
                    ring[(i + 1) % ring.len()],
                    ring[(i + 2) % ring.len()],
                );
                orientation(a, b, c) >= 0.0
            })
    }

    /// The polygon turned anticlockwise by `degrees` about the origin and then moved by `by`.
    pub fn placed(mut self, degrees: f64, by: Vector) -> Polygon {
        let (sin, cos) = sin_cos_degrees(degrees);
        for p in self.rings.iter_mut().flatten() {
            *p = Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y) + by;
        }
        self
    }
}

/// Sine and cosine of an angle in degrees, exact at multiples of a quarter turn.
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

/// Twice-exact sign of the turn a → b → c, positive to the left.
pub(crate) fn orientation(a: Point, b: Point, c: Point) -> f64 {
    let coord = |p: Point| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}

fn sides(ring: &[Point]) -> impl Iterator<Item = Edge> + '_ {
    // Without a division for every side.
    let next = |i: usize| if i + 1 == ring.len() { 0 } else { i + 1 };
    (0..ring.len()).map(move |i| Edge {
        from: ring[i],
        to: ring[next(i)],
    })
}

/// Corners that were dropped, so that the others can be named by their listed numbers: ring and number, in their order.
#[derive(Default)]
struct Repeats(Vec<(usize, usize)>);

impl Repeats {
    /// Drops the corners of a ring that repeat the one before.
    fn drop_from(&mut self, points: &mut Vec<Point>, ring: usize) {
        let (mut before, mut number) = (None, 0);
        points.retain(|p| {
            let repeats = before.replace(*p) == Some(*p);
            if repeats {
                self.0.push((ring, number));
            }
            number += 1;
            !repeats
        });
        while points.len() > 1 && points[0] == points[points.len() - 1] {
            points.pop();
        }
    }

    /// The listed number of a corner that was kept.
    fn listed(&self, ring: usize, kept: usize) -> usize {
        let dropped = self.0.iter().filter(|dropped| dropped.0 == ring);
        dropped.fold(kept, |number, (_, d)| number + usize::from(*d <= number))
    }
}

fn signed_area(ring: &[Point]) -> f64 {
    let base = ring[0];
    sides(ring)
        .map(|e| cross(e.from - base, e.to - base))
        .sum::<f64>()
        / 2.0
}

fn ring_contains(ring: &[Point], p: Point) -> bool {
    let mut inside = false;
    for e in sides(ring) {
        if (e.from.y > p.y) != (e.to.y > p.y) {
            let turn = orientation(e.from, e.to, p);
            if (e.to.y > e.from.y) == (turn > 0.0) {
                inside = !inside;
            }
        }
    }
    inside
}

#[derive(Clone, Copy)]
struct Side {
    ring: usize,
    position: usize,
    count: usize,
    edge: Edge,
}

impl Side {
    fn around(&self) -> Aabb {
        self.edge.around()
    }

    /// A point that it has in common with a later side, where it should have none.
    fn meets(&self, later: &Side) -> Option<Point> {
        let (a, b) = (self, later);
        if (a.ring, a.position + 1) == (b.ring, b.position) {
            folded_back(a.edge.from, a.edge.to, b.edge.to)
        } else if a.ring == b.ring && a.position == 0 && b.position + 1 == b.count {
            folded_back(b.edge.from, b.edge.to, a.edge.to)
        } else {
            meeting(a.edge, b.edge)
        }
    }
}

/// So many crossings of a polygon are listed.
const MOST_CROSSINGS: usize = 20;

/// Up to so many sides are compared with each other without asking first which of them are near.
const FEW_SIDES: usize = 12;

/// The first places, in the order of the sides, at which two sides meet that are not neighbours, and folds back of
/// neighbours.
fn crossings(rings: &[Vec<Point>], repeats: &Repeats) -> Vec<PolygonError> {
    let mut all: Vec<Side> = Vec::with_capacity(rings.iter().map(Vec::len).sum());
    for (ring, corners) in rings.iter().enumerate() {
        all.extend(sides(corners).enumerate().map(|(position, edge)| Side {
            ring,
            position,
            count: corners.len(),
            edge,
        }));
    }
    let nearby = (all.len() > FEW_SIDES).then(|| BoxIndex::new(all.clone(), Side::around));
    let mut flaws = Vec::new();
    for (number, a) in all.iter().enumerate() {
        let before = flaws.len();
        let mut compare = |b: &Side| {
            if let Some(at) = a.meets(b) {
                let crossing = PolygonError::Crossing {
                    rings: [a.ring, b.ring],
                    corners: [a, b].map(|side| repeats.listed(side.ring, side.position)),
                    at,
                };
                flaws.push(((b.ring, b.position), crossing));
            }
        };
        let around = a.around();
        match &nearby {
            None => (all[number + 1..].iter())
                .filter(|b| around.meets(&b.around()))
                .for_each(compare),
            Some(nearby) => (nearby.intersecting(around))
                .filter(|b| (a.ring, a.position) < (b.ring, b.position))
                .for_each(&mut compare),
        }
        // They are found in no order of their own.
        flaws[before..].sort_by_key(|f| f.0);
        if flaws.len() >= MOST_CROSSINGS {
            flaws.truncate(MOST_CROSSINGS);
            break;
        }
    }
    flaws.into_iter().map(|f| f.1).collect()
}

/// The corner `b`, if the path a → b → c turns straight back there.
fn folded_back(a: Point, b: Point, c: Point) -> Option<Point> {
    (orientation(a, b, c) == 0.0 && (a - b).dot(&(c - b)) > 0.0).then_some(b)
}

/// A common point of two sides, if they have one.
fn meeting(a: Edge, b: Edge) -> Option<Point> {
    let a_from = orientation(b.from, b.to, a.from);
    let a_to = orientation(b.from, b.to, a.to);
    let b_from = orientation(a.from, a.to, b.from);
    let b_to = orientation(a.from, a.to, b.to);
    let on = |e: Edge, p: Point| (p - e.from).dot(&(p - e.to)) <= 0.0;
    for (turn, edge, point) in [
        (a_from, b, a.from),
        (a_to, b, a.to),
        (b_from, a, b.from),
        (b_to, a, b.to),
    ] {
        if turn == 0.0 && on(edge, point) {
            return Some(point);
        }
    }
    // An end on the line of the other side, but not on that side, has both of the other's ends to one side of its own.
    if (a_from > 0.0) != (a_to > 0.0) && (b_from > 0.0) != (b_to > 0.0) {
        let share = a_from / (a_from - a_to);
        return Some(a.from + a.vector() * share);
    }
    None
}

#[cfg(test)]
mod tests;
