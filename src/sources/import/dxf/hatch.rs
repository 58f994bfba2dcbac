//! [`loops`]: reads the boundary of a HATCH entity.

use super::entity::{Shape, arc, corners, ellipse, open, point, polyline};
use super::record::{Record, integer};
use crate::geometry::Point;
use crate::sources::import::subpath::{Segment, Subpath};

/// Two edges of a boundary are connected if the distance of their ends is at most this times (1 + the distance of the
/// end from the origin).
const END_TOL: f64 = 1e-6;

/// Returns the closed curves of the boundary of a hatch. Each begins with code 92, whose bit 2 marks a polyline, and ends
/// with the number of its sources (97) or with the style of the hatch (75).
///
/// # Errors
/// Returns the reason why the boundary cannot be read.
pub(super) fn loops(hatch: &Record<'_>) -> Result<Vec<Subpath>, &'static str> {
    let mut loops = Vec::new();
    let mut rest = &hatch.groups[..];
    while let Some(start) = rest.iter().position(|(code, _)| *code == 92) {
        let flags = integer(rest[start].1);
        rest = &rest[start + 1..];
        let end = rest.iter().position(|(code, _)| matches!(code, 75 | 92 | 97)).unwrap_or(rest.len());
        let path = hatch.part(&rest[..end]);
        path.text(93).ok_or("its boundary is not complete")?;
        loops.extend(if flags & 2 == 0 { edges(&path)? } else { outline(&path) });
    }
    if loops.is_empty() { Err("it has no boundary") } else { Ok(loops) }
}

fn outline(path: &Record<'_>) -> Option<Subpath> {
    match polyline(&corners(path), true) {
        Shape::Curve(curve) => Some(curve),
        _ => None,
    }
}

/// Reads a boundary that is stored as edges: lines, arcs and parts of ellipses. Each begins with code 72, its type.
/// Returns `None` if there are no edges.
fn edges(path: &Record<'_>) -> Result<Option<Subpath>, &'static str> {
    let mut curve: Option<Subpath> = None;
    let mut rest = &path.groups[..];
    while let Some(start) = rest.iter().position(|(code, _)| *code == 72) {
        let next = rest[start + 1..].iter().position(|(code, _)| *code == 72);
        let end = next.map_or(rest.len(), |next| start + 1 + next);
        let edge = path.part(&rest[start..end]);
        // The angles of a clockwise arc are measured clockwise.
        let turn = if edge.text(73).is_none_or(|value| integer(value) != 0) { 1.0 } else { -1.0 };
        let edge_curve = match edge.integer(72) {
            1 => open(point(&edge, 10), vec![Segment::Line(point(&edge, 11))]),
            2 => arc(&edge, turn),
            3 => ellipse(&edge, turn, [50, 51].map(|code| edge.number(code).map(f64::to_radians))),
            _ => return Err("its boundary contains a spline"),
        };
        match &mut curve {
            None => curve = Some(edge_curve),
            Some(before) => append(before, edge_curve)?,
        }
        rest = &rest[end..];
    }
    Ok(curve.map(|curve| Subpath { closed: true, ..curve }))
}

/// Appends an edge to the end of a curve. Reverses the edge if its end, but not its start, meets the end of the curve.
/// Reverses a curve of a single edge if only the start of the curve meets the edge. Returns an error message if the
/// curve and the edge do not meet.
fn append(curve: &mut Subpath, edge: Subpath) -> Result<(), &'static str> {
    let near = |a: Point, b: Point| (a - b).norm() <= END_TOL * (1.0 + a.coords.norm());
    if curve.segments.len() == 1 && !near(curve.end(), edge.start) && !near(curve.end(), edge.end()) {
        *curve = curve.reversed();
    }
    curve.segments.extend(match curve.end() {
        end if near(end, edge.start) => edge.segments,
        end if near(end, edge.end()) => edge.reversed().segments,
        _ => return Err("the edges of its boundary do not meet"),
    });
    Ok(())
}
