//! [`Track`]: one run of a pen, of lines and curves, and how it becomes corners.
//!
//! A curve is cut into equal steps of its parameter, so that the same curve drawn the other way round, as the neighbour
//! of a curved block has it, gets the same corners.

use core::f64::consts::{FRAC_PI_2, TAU};

use super::affine::Affine;
use crate::geometry::snap::Corner;
use crate::geometry::{Point, Vector, cross};

/// A curve is cut into at most so many pieces.
const MOST: f64 = 4096.0;

/// A run of a pen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Track {
    pub(super) start: Point,
    pub(super) pieces: Vec<Piece>,
    /// Whether the pen went back to where it began.
    pub(super) closed: bool,
}

/// A piece of a track, from where the one before it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Piece {
    Line(Point),
    /// Two handles and the end.
    Cubic(Point, Point, Point),
    Arc(Arc),
}

/// `centre + u cos θ + v sin θ` for θ from `from` over `sweep`, and the end as it was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    pub(super) centre: Point,
    pub(super) u: Vector,
    pub(super) v: Vector,
    pub(super) from: f64,
    pub(super) sweep: f64,
    pub(super) to: Point,
}

impl Track {
    pub(super) fn closed(corners: &[Point]) -> Option<Track> {
        let (start, rest) = corners.split_first()?;
        Some(Track {
            start: *start,
            pieces: rest.iter().map(|p| Piece::Line(*p)).collect(),
            closed: true,
        })
    }

    /// An ellipse with its axes along the coordinates', from its rightmost point.
    pub(super) fn ellipse(centre: Point, rx: f64, ry: f64) -> Track {
        let start = centre + Vector::new(rx, 0.0);
        let arc = Arc {
            centre,
            u: Vector::new(rx, 0.0),
            v: Vector::new(0.0, ry),
            from: 0.0,
            sweep: TAU,
            to: start,
        };
        Track {
            start,
            pieces: vec![Piece::Arc(arc)],
            closed: true,
        }
    }

    pub(super) fn mapped(&self, map: &Affine) -> Track {
        let piece = |piece: &Piece| match piece {
            Piece::Line(to) => Piece::Line(map.point(*to)),
            Piece::Cubic(a, b, to) => Piece::Cubic(map.point(*a), map.point(*b), map.point(*to)),
            Piece::Arc(arc) => Piece::Arc(Arc {
                centre: map.point(arc.centre),
                u: map.vector(arc.u),
                v: map.vector(arc.v),
                to: map.point(arc.to),
                ..*arc
            }),
        };
        Track {
            start: map.point(self.start),
            pieces: self.pieces.iter().map(piece).collect(),
            closed: self.closed,
        }
    }

    /// Whether any of it is a curve.
    pub(super) fn bends(&self) -> bool {
        let straight = |piece: &Piece| matches!(piece, Piece::Line(_));
        !self.pieces.iter().all(straight)
    }

    /// Points whose box holds the track.
    pub(super) fn hull(&self) -> Vec<Point> {
        let mut points = vec![self.start];
        for piece in &self.pieces {
            match piece {
                Piece::Line(to) => points.push(*to),
                Piece::Cubic(a, b, to) => points.extend([*a, *b, *to]),
                Piece::Arc(arc) => {
                    let reach =
                        Vector::new(libm::hypot(arc.u.x, arc.v.x), libm::hypot(arc.u.y, arc.v.y));
                    points.extend([arc.centre - reach, arc.centre + reach]);
                }
            }
        }
        points
    }

    /// The corners of the track with its curves cut so that no chord is farther than `tolerance` from its curve. A last
    /// corner no farther than `close` from the first is the first; `None` where the track is open.
    pub(super) fn flattened(&self, tolerance: f64, close: f64) -> Option<Vec<Corner>> {
        let mut corners = vec![Corner {
            at: self.start,
            curved: false,
        }];
        for piece in &self.pieces {
            let from = corners[corners.len() - 1].at;
            let inner = piece.inner(from, tolerance);
            let last = corners.len() - 1;
            corners[last].curved = !inner.is_empty();
            corners.extend(inner.into_iter().map(|at| Corner { at, curved: true }));
            corners.push(Corner {
                at: piece.end(),
                curved: false,
            });
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

impl Piece {
    pub(super) fn end(&self) -> Point {
        match self {
            Piece::Line(to) | Piece::Cubic(_, _, to) => *to,
            Piece::Arc(arc) => arc.to,
        }
    }

    /// The corners between the ends.
    fn inner(&self, from: Point, tolerance: f64) -> Vec<Point> {
        match self {
            Piece::Line(_) => Vec::new(),
            Piece::Cubic(a, b, to) => {
                // A chord over 1/n of a curve is off by at most |second derivative|/8n², and that of a cubic by its
                // handles is at most six times the larger second difference.
                let bend = (a.coords * 2.0 - from.coords - b.coords)
                    .norm()
                    .max((b.coords * 2.0 - a.coords - to.coords).norm());
                let n = steps((0.75 * bend / tolerance).sqrt());
                let at = |k: f64| {
                    let (t, s) = (k / n, (n - k) / n);
                    Point::from(
                        from.coords * (s * s * s)
                            + (a.coords * s + b.coords * t) * (3.0 * s * t)
                            + to.coords * (t * t * t),
                    )
                };
                inner_steps(n).map(at).collect()
            }
            Piece::Arc(arc) => {
                let radius = largest_stretch(arc.u, arc.v);
                let half = if tolerance < radius {
                    libm::acos(1.0 - tolerance / radius)
                } else {
                    FRAC_PI_2
                };
                // An eighth of a turn at most: a circle stays recognisable at any tolerance.
                let widest = (2.0 * half).min(TAU / 8.0);
                let n = steps((arc.sweep.abs() / widest) * (1.0 - 1e-9));
                let at = |k: f64| {
                    let (sin, cos) = sin_cos(arc.from + arc.sweep * (k / n));
                    arc.centre + arc.u * cos + arc.v * sin
                };
                inner_steps(n).map(at).collect()
            }
        }
    }
}

fn steps(wanted: f64) -> f64 {
    // NaN and what is too small are one step.
    if wanted > 1.0 {
        wanted.ceil().min(MOST)
    } else {
        1.0
    }
}

fn inner_steps(n: f64) -> impl Iterator<Item = f64> {
    (1..n as u32).map(f64::from)
}

/// Sine and cosine, exact at quarter turns.
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

/// The longest radius of the ellipse `u cos θ + v sin θ`.
fn largest_stretch(u: Vector, v: Vector) -> f64 {
    let (sum, det) = (u.norm_squared() + v.norm_squared(), cross(u, v));
    let inner = (sum * sum - 4.0 * det * det).max(0.0).sqrt();
    ((sum + inner) / 2.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chord_is_no_farther_from_its_curve_than_told() {
        let track = Track::ellipse(Point::new(2.0, 1.0), 5.0, 3.0);
        for tolerance in [1.0, 0.1, 1e-3] {
            let corners = track.flattened(tolerance, 0.0).expect("closed");
            let off = |p: Point| {
                let d = p - Point::new(2.0, 1.0);
                (1.0 - libm::hypot(d.x / 5.0, d.y / 3.0)) * 5.0
            };
            for i in 0..corners.len() {
                let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                assert!(off(a.at).abs() < 1e-12 && a.curved);
                let middle = a.at + (b.at - a.at) / 2.0;
                assert!((0.0..=1.01 * tolerance).contains(&off(middle)));
            }
        }
        assert_eq!(track.flattened(99.0, 0.0).expect("closed").len(), 8);
    }

    #[test]
    fn the_same_curve_backwards_has_the_same_corners() {
        let p = [(0.0, 0.0), (1.0, 3.0), (4.0, 3.5), (6.0, -1.0)].map(|p| Point::new(p.0, p.1));
        let there = Piece::Cubic(p[1], p[2], p[3]).inner(p[0], 0.01);
        let mut back = Piece::Cubic(p[2], p[1], p[0]).inner(p[3], 0.01);
        back.reverse();
        assert!(there.len() > 5);
        assert_eq!(there.len(), back.len());
        for (a, b) in there.iter().zip(&back) {
            assert!((a - b).norm() < 1e-14);
        }
    }

    #[test]
    fn an_open_track_is_none_unless_its_ends_nearly_meet() {
        let mut track = Track::closed(
            &[(0.0, 0.0), (3.0, 0.0), (0.0, 2.0), (0.0, 0.001)].map(|p| Point::new(p.0, p.1)),
        )
        .expect("corners");
        assert_eq!(track.flattened(0.1, 1e-6).map(|c| c.len()), Some(4));
        track.closed = false;
        assert_eq!(track.flattened(0.1, 1e-6), None);
        assert_eq!(track.flattened(0.1, 0.01).map(|c| c.len()), Some(3));
    }
}
