//! [`Outline`]: the shape of a body relative to its own origin, before the body is rotated and moved to its position.

use super::finding::Findings;
use super::format::{CellEntry, CellHalf, CircleEntry, Pair};
use super::number::{SMALLEST_EXTENT, is_amount, is_sane};
use super::problem;
use crate::geometry::{
    Cell, CellShape, Circle, Lattice, LatticeKind, Point, Polygon, PolygonError, Vector, sin_cos_degrees,
};
use crate::read::Trail;

/// The largest absolute value of a lattice coordinate in a file. Up to this value, sums and products of a few
/// coordinates are exact.
pub(super) const MAX_LATTICE_COORDINATE: f64 = 1e6;

/// The shape of a body relative to its own origin.
#[derive(Clone, Debug)]
pub(super) enum Outline {
    /// A polygon with corners in the units of the file.
    Polygon(Polygon),
    /// A set of lattice cells.
    Cells(Vec<Cell>),
    /// A circle in the units of the file.
    Circle(Circle),
}

/// The outline of a body at its position, and the cells or the circle of which it consists.
pub(super) struct Placed {
    pub(super) polygon: Polygon,
    pub(super) cells: Option<Vec<Cell>>,
    pub(super) circle: Option<Circle>,
}

/// Builds the circle of an entry. If it is not valid, reports the problems and returns `None`.
pub(super) fn circle(findings: &mut Findings, at: &Trail<'_>, entry: &CircleEntry) -> Option<Outline> {
    let at = at.key("circle");
    let (centre, radius) = (entry.centre, entry.radius);
    let sound = is_sane(findings, &at.key("centre"), &centre) & is_amount(findings, &at.key("radius"), &[radius]);
    if sound && radius <= 0.0 {
        findings.add(&at.key("radius"), problem::outline::no_radius(radius));
    }
    (sound && radius > 0.0).then(|| Outline::Circle(Circle { centre: Point::new(centre[0], centre[1]), radius }))
}

/// Builds the polygon of an entry from its corners and holes. If the polygon is not valid, reports the problems and
/// returns `None`.
pub(super) fn polygon(
    findings: &mut Findings,
    at: &Trail<'_>,
    corners: &[Pair],
    holes: &[Vec<Pair>],
) -> Option<Outline> {
    let (outer, inner) = (at.key("polygon"), at.key("holes"));
    let mut sound = true;
    for (i, corner) in corners.iter().enumerate() {
        sound &= is_sane(findings, &outer.index(i), corner);
    }
    for (k, hole) in holes.iter().enumerate() {
        for (i, corner) in hole.iter().enumerate() {
            sound &= is_sane(findings, &inner.index(k).index(i), corner);
        }
    }
    if !sound {
        return None;
    }
    let points = |ring: &[Pair]| ring.iter().map(|c| Point::new(c[0], c[1])).collect::<Vec<_>>();
    let flaws = match Polygon::new(points(corners), holes.iter().map(|h| points(h)).collect()) {
        Ok(polygon) => {
            let extent = polygon.bounds().diagonal();
            if extent < SMALLEST_EXTENT {
                let units = findings.units;
                findings.add(&outer, problem::message::tiny_extent(extent, SMALLEST_EXTENT, units));
                return None;
            }
            let centroid = polygon.centroid();
            if centroid.x.is_finite() && centroid.y.is_finite() {
                return Some(Outline::Polygon(polygon));
            }
            // The area is so small that its computed value is 0. The centroid is then not finite.
            vec![PolygonError::ZeroArea { ring: 0 }]
        }
        Err(flaws) => flaws,
    };
    for flaw in flaws {
        note(findings, &outer, &inner, corners, holes, flaw);
    }
    None
}

fn note(
    findings: &mut Findings,
    outer: &Trail<'_>,
    inner: &Trail<'_>,
    corners: &[Pair],
    holes: &[Vec<Pair>],
    flaw: PolygonError,
) {
    let ring = match flaw {
        PolygonError::TooFewCorners { ring, .. }
        | PolygonError::ZeroArea { ring }
        | PolygonError::HoleOutside { ring } => ring,
        PolygonError::Crossing { rings, .. } => rings[0],
    };
    let hole;
    let at = if ring == 0 {
        outer
    } else {
        hole = inner.index(ring - 1);
        &hole
    };
    match flaw {
        PolygonError::TooFewCorners { corners, .. } => findings.add(at, problem::outline::too_few_corners(corners)),
        PolygonError::ZeroArea { .. } => findings.add(at, problem::outline::zero_area()),
        PolygonError::HoleOutside { .. } => findings.add(at, problem::outline::hole_outside()),
        PolygonError::Crossing { rings, corners: first, at: point } => {
            let count = |ring: usize| {
                if ring == 0 { corners.len() } else { holes.get(ring - 1).map_or(0, Vec::len) }
            };
            let side = |k: usize| problem::outline::Side {
                hole: rings[k].checked_sub(1),
                corners: [first[k], (first[k] + 1) % count(rings[k]).max(1)],
            };
            findings.add(
                &at.index(first[0]),
                problem::outline::crossing(&side(0), &side(1), point).at(problem::Place::Own(point)),
            );
        }
    }
}

/// Builds the lattice cells of an entry. If the cells are not valid, reports their problems and returns `None`.
pub(super) fn cells(
    findings: &mut Findings,
    at: &Trail<'_>,
    lattice: Option<Lattice>,
    entries: &[CellEntry],
) -> Option<Outline> {
    let at = at.key("cells");
    let Some(lattice) = lattice else {
        findings.add(&at, problem::outline::cells_without_grid());
        return None;
    };
    if entries.is_empty() {
        findings.add(&at, problem::outline::no_cells());
        return None;
    }
    let mut sound = true;
    let mut cells = Vec::with_capacity(entries.len());
    let mut seen = std::collections::BTreeMap::new();
    for (i, entry) in entries.iter().enumerate() {
        let at = at.index(i);
        let (pair, shape) = cell_parts(*entry);
        let wrong = match (shape, lattice.kind) {
            (CellShape::Square, LatticeKind::Triangular) => Some(problem::outline::square_cell()),
            (CellShape::Up | CellShape::Down, LatticeKind::Square) => Some(problem::outline::triangle_cell()),
            _ => None,
        };
        if let Some(wrong) = wrong {
            findings.add(&at, wrong);
            sound = false;
            continue;
        }
        let Some((x, y)) = node(findings, &at, pair) else {
            sound = false;
            continue;
        };
        let cell = Cell { x, y, shape };
        if let Some(first) = seen.insert(cell, i) {
            findings.add(&at, problem::outline::cell_twice(first));
            sound = false;
        }
        cells.push(cell);
    }
    if !sound {
        return None;
    }
    if lattice.polygon(&cells).is_none() {
        findings.add(&at, problem::outline::cells_apart());
        return None;
    }
    Some(Outline::Cells(cells))
}

/// Returns the coordinates and the shape of a cell.
pub(super) fn cell_parts(cell: CellEntry) -> (Pair, CellShape) {
    match cell {
        CellEntry::Triangle(x, y, CellHalf::Up) => ([x, y], CellShape::Up),
        CellEntry::Triangle(x, y, CellHalf::Down) => ([x, y], CellShape::Down),
        CellEntry::Square(x, y) => ([x, y], CellShape::Square),
    }
}

/// Converts two coordinates to a lattice point. Reports a problem and returns `None` if a coordinate is not a whole
/// number, or beyond ±[`MAX_LATTICE_COORDINATE`].
pub(super) fn node(findings: &mut Findings, at: &Trail<'_>, pair: Pair) -> Option<(i64, i64)> {
    if !is_sane(findings, at, &pair) {
        return None;
    }
    if pair.iter().any(|x| x.fract() != 0.0) {
        findings.add(at, problem::outline::not_whole(pair));
        return None;
    }
    if pair.iter().any(|x| x.abs() > MAX_LATTICE_COORDINATE) {
        findings.add(at, problem::outline::beyond_lattice(pair, MAX_LATTICE_COORDINATE));
        return None;
    }
    Some((pair[0] as i64, pair[1] as i64))
}

/// Rotates a point by `angle` degrees anticlockwise about the origin of its body and then moves it by `at`, like
/// [`placed`]. If the scene has a lattice, `at` is in lattice coordinates.
pub(super) fn placed_point(lattice: Option<Lattice>, point: Pair, at: Pair, angle: f64) -> Point {
    let (sin, cos) = sin_cos_degrees(angle);
    let by = lattice.map_or(Vector::new(at[0], at[1]), |l| l.point(at[0], at[1]).coords);
    Point::new(cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]) + by
}

/// Rotates the outline by `angle` degrees anticlockwise about its origin and then moves it by `at`.
///
/// If the scene has a lattice, `at` is in lattice coordinates; otherwise it is in the units of the file. For cells,
/// `at` must be whole numbers, and `angle` a multiple of 60° (triangles) or 90° (squares); otherwise a problem is
/// reported and `None` is returned.
pub(super) fn placed(
    findings: &mut Findings,
    trail: &Trail<'_>,
    lattice: Option<Lattice>,
    outline: Outline,
    at: Pair,
    angle: f64,
) -> Option<Placed> {
    match (outline, lattice) {
        (Outline::Cells(cells), Some(lattice)) => {
            let by = node(findings, &trail.key("at"), at);
            let turn = if lattice.kind == LatticeKind::Triangular { 60.0 } else { 90.0 };
            let steps = angle.rem_euclid(360.0) / turn;
            if steps.fract() != 0.0 {
                findings.add(&trail.key("angle"), problem::outline::angle_off_lattice(angle, turn));
                return None;
            }
            let by = by?;
            let cells: Vec<Cell> = cells.into_iter().map(|c| c.turned(steps as i64).moved(by)).collect();
            let polygon = lattice.polygon(&cells)?;
            Some(Placed { polygon, cells: Some(cells), circle: None })
        }
        (Outline::Polygon(polygon), lattice) => {
            let by = lattice.map_or(Vector::new(at[0], at[1]), |l| l.point(at[0], at[1]).coords);
            Some(Placed { polygon: polygon.placed(angle, by), cells: None, circle: None })
        }
        (Outline::Circle(circle), lattice) => {
            let centre = placed_point(lattice, circle.centre.into(), at, angle);
            let circle = Circle { centre, ..circle };
            Some(Placed { polygon: circle.polygon(), cells: None, circle: Some(circle) })
        }
        (Outline::Cells(_), None) => None,
    }
}
