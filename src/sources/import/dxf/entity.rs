//! [`curve`]: converts an entity to a curve, in the units of the drawing.

use core::f64::consts::TAU;

use super::record::{Record, integer, number};
use super::spline::spline;
use crate::geometry::{Point, Vector};
use crate::sources::import::subpath::{Arc, Segment, Subpath};

const NOT_PLANE: &str = "it does not lie in the plane of the drawing";

/// The shape of an entity.
#[derive(Debug)]
pub(super) enum Shape {
    /// A curve, closed or open.
    Curve(Subpath),
    /// The grip point of a robot.
    Point(Point),
    /// The entity has no outline that can be read. The text is the reason.
    Unreadable(&'static str),
}

/// Converts an entity to a curve or a point. `vertices` are the `VERTEX` records that follow a `POLYLINE` entity.
/// Returns `None` for kinds of entities that this function does not know, such as text.
pub(super) fn curve(entity: &Record<'_>, vertices: &[Record<'_>]) -> Option<Shape> {
    let shape = match entity.kind {
        "LINE" => Shape::Curve(open(point(entity, 10), vec![Segment::Line(point(entity, 11))])),
        "ARC" => Shape::Curve(arc(entity, 1.0)),
        "CIRCLE" => {
            let radius = entity.number(40).unwrap_or(f64::NAN);
            Shape::Curve(Subpath::ellipse(point(entity, 10), radius, radius))
        }
        "ELLIPSE" => {
            Shape::Curve(ellipse(entity, turn(entity).unwrap_or(1.0), [41, 42].map(|code| entity.number(code))))
        }
        "LWPOLYLINE" => polyline(&corners(entity), entity.has_flag(70, 1)),
        "POLYLINE" if entity.has_flag(70, 16 | 64) => Shape::Unreadable("it is a mesh"),
        "POLYLINE" => {
            // Vertices with flag 16 are control points of a spline; they are not on the curve.
            let on_curve = vertices.iter().filter(|v| !v.has_flag(70, 16));
            let corners: Vec<Corner> = on_curve.map(corner).collect();
            polyline(&corners, entity.has_flag(70, 1))
        }
        "SOLID" | "TRACE" | "3DFACE" => {
            // The fourth corner of a SOLID is stored before the third. A triangle repeats a corner, or has only three.
            let order = if entity.kind == "3DFACE" { [10, 11, 12, 13] } else { [10, 11, 13, 12] };
            let given = order.into_iter().filter(|code| entity.number(*code).is_some());
            let (mut corners, heights): (Vec<Point>, Vec<f64>) =
                given.map(|code| (point(entity, code), entity.number(code + 20).unwrap_or(0.0))).unzip();
            corners.dedup();
            match Subpath::closed(&corners) {
                Some(_) if heights.iter().any(|z| *z != heights[0]) => return Some(Shape::Unreadable(NOT_PLANE)),
                outline => outline.map_or(Shape::Unreadable("it has no corners"), Shape::Curve),
            }
        }
        "POINT" => Shape::Point(point(entity, 10)),
        "SPLINE" => match spline(entity) {
            Some(curve) => Shape::Curve(curve),
            None => Shape::Unreadable("its control points and knots are not complete"),
        },
        "3DSOLID" | "BODY" | "MESH" | "REGION" | "SURFACE" => Shape::Unreadable("it is not a plane outline"),
        "MLINE" => Shape::Unreadable("a multiline (MLINE) has no single outline"),
        _ => return None,
    };
    Some(match (turn(entity), shape) {
        (None, _) => Shape::Unreadable(NOT_PLANE),
        (Some(-1.0), Shape::Curve(curve)) if !matches!(entity.kind, "LINE" | "ELLIPSE" | "SPLINE") => {
            // If the normal of a curve points down, its x axis points to the left, so the curve is mirrored. LINE,
            // ELLIPSE and SPLINE are not mirrored, because they always use the axes of the drawing.
            Shape::Curve(curve.mapped(&crate::sources::import::subpath::Affine::scale(-1.0, 1.0)))
        }
        (_, shape) => shape,
    })
}

/// Returns 1 if the normal of an entity, which has the group codes 210, 220 and 230, points up, and −1 if it points down.
/// `None` if the magnitude of its x or y component exceeds 1e-6, or if its z component is 0.
pub(super) fn turn(entity: &Record<'_>) -> Option<f64> {
    let [x, y, z] = [(210, 0.0), (220, 0.0), (230, 1.0)].map(|(code, default)| entity.number(code).unwrap_or(default));
    (x.abs() <= 1e-6 && y.abs() <= 1e-6 && z != 0.0).then_some(if z > 0.0 { 1.0 } else { -1.0 })
}

/// Reads a point: x has the group code `code`, and y has `code` + 10. A missing coordinate becomes NaN.
pub(super) fn point(record: &Record<'_>, code: i32) -> Point {
    let coordinate = |code| record.number(code).unwrap_or(f64::NAN);
    Point::new(coordinate(code), coordinate(code + 10))
}

/// A corner of a polyline, with the bulge of the segment that begins there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) at: Point,
    pub(super) bulge: f64,
}

fn corner(vertex: &Record<'_>) -> Corner {
    Corner { at: point(vertex, 10), bulge: vertex.number(42).unwrap_or(0.0) }
}

/// Reads the corners of an LWPOLYLINE. Group code 10 (x) begins a corner; codes 20 (y) and 42 (bulge) belong to it.
pub(super) fn corners(entity: &Record<'_>) -> Vec<Corner> {
    let mut corners: Vec<Corner> = Vec::new();
    for (code, value) in &entity.groups {
        match (code, corners.last_mut()) {
            (10, _) => corners.push(Corner { at: Point::new(number(value), f64::NAN), bulge: 0.0 }),
            (20, Some(corner)) => corner.at.y = number(value),
            (42, Some(corner)) => corner.bulge = number(value),
            _ => {}
        }
    }
    corners
}

/// Returns the curve through the corners of a polyline: straight lines, and arcs where a corner has a bulge.
pub(super) fn polyline(corners: &[Corner], is_closed: bool) -> Shape {
    let (Some(first), Some(last)) = (corners.first(), corners.last()) else {
        return Shape::Unreadable("it has no corners");
    };
    let mut segments: Vec<Segment> =
        corners.windows(2).map(|pair| Segment::bulged(pair[0].at, pair[1].at, pair[0].bulge)).collect();
    if is_closed && last.bulge != 0.0 && last.at != first.at {
        segments.push(Segment::bulged(last.at, first.at, last.bulge));
    }
    Shape::Curve(Subpath { start: first.at, segments, closed: is_closed })
}

/// Reads an ARC: centre, radius, and the angles of start and end in degrees, measured anticlockwise.
/// `turn` is −1 if they are measured clockwise.
pub(super) fn arc(entity: &Record<'_>, turn: f64) -> Subpath {
    let radius = entity.number(40).unwrap_or(f64::NAN);
    let angles = [50, 51].map(|code| entity.number(code).unwrap_or(0.0).to_radians());
    part_of_ellipse(point(entity, 10), Vector::new(radius, 0.0), Vector::new(0.0, turn * radius), angles)
}

/// Reads an ELLIPSE: centre, the end of the long axis relative to the centre, the ratio of the axes, and the angles of
/// start and end in radians, which are measured clockwise if `turn` is −1.
pub(super) fn ellipse(entity: &Record<'_>, turn: f64, [from, to]: [Option<f64>; 2]) -> Subpath {
    let major = point(entity, 11).coords;
    let minor = Vector::new(-major.y, major.x) * (turn * entity.number(40).unwrap_or(1.0));
    part_of_ellipse(point(entity, 10), major, minor, [from.unwrap_or(0.0), to.unwrap_or(TAU)])
}

/// Returns the curve `centre + u cos θ + v sin θ` for θ from `from` up to `to`, in radians. The curve is the whole
/// ellipse if the two angles are equal or differ by full turns.
fn part_of_ellipse(centre: Point, u: Vector, v: Vector, [from, to]: [f64; 2]) -> Subpath {
    let sweep = match (to - from).rem_euclid(TAU) {
        // Equal angles mean a full turn. The tolerance allows for angles with six decimals.
        turn if turn < 1e-6 || TAU - turn < 1e-6 => TAU,
        turn => turn,
    };
    let at = |angle: f64| centre + u * libm::cos(angle) + v * libm::sin(angle);
    let start = at(from);
    let is_closed = sweep == TAU;
    let end = if is_closed { start } else { at(from + sweep) };
    Subpath { start, segments: vec![Segment::Arc(Arc { centre, u, v, from, sweep, to: end })], closed: is_closed }
}

/// Returns an open curve of segments that begins at `start`.
pub(super) fn open(start: Point, segments: Vec<Segment>) -> Subpath {
    Subpath { start, segments, closed: false }
}

/// Parses a whole number of at least 0. Returns 0 for any other text.
pub(super) fn count(value: &str) -> usize {
    usize::try_from(integer(value)).unwrap_or(0)
}
