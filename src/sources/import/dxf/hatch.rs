//! [`loops`]: reads the boundary of a HATCH entity.

use super::entity::{Corner, Shape, count, open, part_of_ellipse, polyline};
use super::record::{Record, integer, number};
use crate::geometry::{Point, Vector};
use crate::sources::import::subpath::{Segment, Subpath};

/// Two edges of a boundary are connected if the distance of their ends is at most this times (1 + the distance of the
/// end from the origin).
const END_TOL: f64 = 1e-6;

/// Returns the closed curves of the boundary of a hatch.
///
/// # Errors
/// Returns the reason why the boundary cannot be read.
pub(super) fn loops(hatch: &Record<'_>) -> Result<Vec<Subpath>, &'static str> {
    let mut groups = Groups { rest: &hatch.groups };
    groups.skip_to(91).ok_or("it has no boundary")?;
    let paths = count(groups.next().map_or("", |(_, value)| value));
    let mut loops = Vec::new();
    for _ in 0..paths {
        let Some(flags) = groups.value_of(92) else {
            break;
        };
        // If the flag with the value 2 is set, the boundary is a polyline, otherwise a list of edges.
        let curve = match integer(flags) & 2 {
            0 => groups.edges()?,
            _ => groups.polyline()?,
        };
        loops.extend(curve);
    }
    if loops.is_empty() { Err("it has no boundary") } else { Ok(loops) }
}

/// The groups of a hatch that are not read yet.
struct Groups<'r, 't> {
    rest: &'r [(i32, &'t str)],
}

impl<'t> Groups<'_, 't> {
    fn next(&mut self) -> Option<(i32, &'t str)> {
        let (first, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*first)
    }

    /// Skips all groups before the next group with this code. Returns `None`, and skips nothing, if there is no such
    /// group.
    fn skip_to(&mut self, code: i32) -> Option<()> {
        let skipped = self.rest.iter().position(|(c, _)| *c == code)?;
        self.rest = &self.rest[skipped..];
        Some(())
    }

    /// Reads up to the next group with this code, including it, and returns its value. Returns `None`, and skips nothing,
    /// if there is no such group.
    fn value_of(&mut self, code: i32) -> Option<&'t str> {
        self.skip_to(code)?;
        self.next().map(|(_, value)| value)
    }

    fn number_of(&mut self, code: i32) -> f64 {
        self.value_of(code).map_or(f64::NAN, number)
    }

    fn point_of(&mut self, code: i32) -> Point {
        Point::new(self.number_of(code), self.number_of(code + 10))
    }

    /// Reads a boundary that is stored as a polyline; group code 93 is the number of its corners. Returns `None` if it
    /// has no corners.
    fn polyline(&mut self) -> Result<Option<Subpath>, &'static str> {
        let corners = count(self.value_of(93).ok_or("its boundary is not complete")?);
        let mut list = Vec::new();
        for _ in 0..corners {
            if !self.rest.iter().any(|(code, _)| *code == 10) {
                break;
            }
            let at = self.point_of(10);
            let bulge = match self.rest.first() {
                Some((42, value)) => number(value),
                _ => 0.0,
            };
            list.push(Corner { at, bulge });
        }
        Ok(match polyline(&list, true) {
            Shape::Curve(curve) => Some(curve),
            _ => None,
        })
    }

    /// Reads a boundary that is stored as edges: lines, arcs and parts of ellipses. Group code 93 is the number of
    /// edges, and code 72 the type of each edge. Returns `None` if there are no edges.
    fn edges(&mut self) -> Result<Option<Subpath>, &'static str> {
        let edges = count(self.value_of(93).ok_or("its boundary is not complete")?);
        let mut curve: Option<Subpath> = None;
        for _ in 0..edges {
            let Some(kind) = self.value_of(72) else { break };
            let edge = match integer(kind) {
                1 => open(self.point_of(10), vec![Segment::Line(self.point_of(11))]),
                2 => self.arc(),
                3 => self.ellipse(),
                _ => return Err("its boundary contains a spline"),
            };
            curve = Some(match curve {
                None => edge,
                Some(mut before) => {
                    append(&mut before, edge)?;
                    before
                }
            });
        }
        if let Some(curve) = &mut curve {
            curve.closed = true;
        }
        Ok(curve)
    }

    /// Reads an arc: centre, radius, angles in degrees, and whether it turns anticlockwise.
    fn arc(&mut self) -> Subpath {
        let (centre, radius) = (self.point_of(10), self.number_of(40));
        let angles = [self.number_of(50), self.number_of(51)].map(f64::to_radians);
        let (u, v) = (Vector::new(radius, 0.0), Vector::new(0.0, radius));
        self.turned(centre, u, v, angles)
    }

    /// Reads an ellipse: centre, end of the long axis, ratio of the axes, angles in degrees, and whether it turns
    /// anticlockwise.
    fn ellipse(&mut self) -> Subpath {
        let (centre, major) = (self.point_of(10), self.point_of(11).coords);
        let minor = Vector::new(-major.y, major.x) * self.number_of(40);
        let angles = [self.number_of(50), self.number_of(51)].map(f64::to_radians);
        self.turned(centre, major, minor, angles)
    }

    /// Returns the elliptical arc between the angles `from` and `to`, in radians, with the half axes `u` and `v`. Group
    /// code 73 is 0 for a clockwise arc, whose angles are measured clockwise.
    fn turned(&mut self, centre: Point, u: Vector, v: Vector, [from, to]: [f64; 2]) -> Subpath {
        let is_anticlockwise = self.value_of(73).is_none_or(|value| integer(value) != 0);
        let v = if is_anticlockwise { v } else { -v };
        part_of_ellipse(centre, u, v, from, to)
    }
}

/// Appends an edge to the end of a curve. Reverses the edge if its end, but not its start, meets the end of the curve.
/// Reverses a curve of a single edge if only the start of the curve meets the edge. Returns an error message if the
/// curve and the edge do not meet.
fn append(curve: &mut Subpath, edge: Subpath) -> Result<(), &'static str> {
    let end = curve.segments.last().map_or(curve.start, Segment::end);
    let near = |a: Point, b: Point| (a - b).norm() <= END_TOL * (1.0 + a.coords.norm());
    let edge_end = edge.segments.last().map_or(edge.start, Segment::end);
    if near(end, edge.start) {
        curve.segments.extend(edge.segments);
    } else if near(end, edge_end) {
        curve.segments.extend(edge.reversed().segments);
    } else if curve.segments.len() == 1 && near(curve.start, edge.start) {
        *curve = curve.reversed();
        curve.segments.extend(edge.segments);
    } else if curve.segments.len() == 1 && near(curve.start, edge_end) {
        *curve = curve.reversed();
        curve.segments.extend(edge.reversed().segments);
    } else {
        return Err("the edges of its boundary do not meet");
    }
    Ok(())
}
