//! Path data into tracks: every command of SVG, absolute and relative.

use core::f64::consts::TAU;

use svgtypes::{PathParser, PathSegment};

use crate::geometry::{Point, Vector, cross};
use crate::import::track::{Arc, Piece, Track};

/// The tracks of a `d` attribute.
///
/// # Errors
/// The reader's words where the text is no path data.
pub(super) fn tracks(text: &str) -> Result<Vec<Track>, String> {
    let mut pen = TrackBuilder {
        tracks: Vec::new(),
        at: Point::origin(),
        open: None,
        handle: None,
        quadratic: None,
    };
    for segment in PathParser::from(text) {
        pen.draw(segment.map_err(|error| error.to_string())?);
    }
    pen.lift();
    Ok(pen.tracks)
}

struct TrackBuilder {
    tracks: Vec<Track>,
    at: Point,
    open: Option<Track>,
    /// The last cubic's second handle, where the last command was a cubic; a smooth one continues it.
    handle: Option<Point>,
    /// Likewise the handle of a quadratic.
    quadratic: Option<Point>,
}

impl TrackBuilder {
    fn lift(&mut self) {
        self.tracks
            .extend(self.open.take().filter(|track| !track.pieces.is_empty()));
    }

    /// A track, begun where the pen is if none is: after a `Z` the next may do without an `M`.
    fn add(&mut self, piece: Piece) {
        let start = self.at;
        let track = self.open.get_or_insert(Track {
            start,
            pieces: Vec::new(),
            closed: false,
        });
        track.pieces.push(piece);
        self.at = piece.end();
    }

    fn draw(&mut self, segment: PathSegment) {
        let base = if segment.is_abs() {
            Vector::zeros()
        } else {
            self.at.coords
        };
        let place = |x: f64, y: f64| Point::new(x, y) + base;
        let (handle, quadratic) = (self.handle.take(), self.quadratic.take());
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                self.lift();
                self.at = place(x, y);
                self.open = Some(Track {
                    start: self.at,
                    pieces: Vec::new(),
                    closed: false,
                });
            }
            PathSegment::LineTo { x, y, .. } => self.add(Piece::Line(place(x, y))),
            PathSegment::HorizontalLineTo { x, .. } => {
                self.add(Piece::Line(Point::new(x + base.x, self.at.y)));
            }
            PathSegment::VerticalLineTo { y, .. } => {
                self.add(Piece::Line(Point::new(self.at.x, y + base.y)));
            }
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => {
                self.handle = Some(place(x2, y2));
                self.add(Piece::Cubic(place(x1, y1), place(x2, y2), place(x, y)));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = handle.map_or(self.at, |h| self.at + (self.at - h));
                self.handle = Some(place(x2, y2));
                self.add(Piece::Cubic(first, place(x2, y2), place(x, y)));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                self.quadratic(place(x1, y1), place(x, y));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let handle = quadratic.map_or(self.at, |h| self.at + (self.at - h));
                self.quadratic(handle, place(x, y));
            }
            PathSegment::EllipticalArc {
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
                ..
            } => {
                let to = place(x, y);
                let turn = x_axis_rotation.to_radians();
                self.add(match arc(self.at, to, [rx, ry], turn, large_arc, sweep) {
                    Some(arc) => Piece::Arc(arc),
                    None => Piece::Line(to),
                });
            }
            PathSegment::ClosePath { .. } => {
                if let Some(mut track) = self.open.take() {
                    self.at = track.start;
                    track.closed = true;
                    self.open = Some(track);
                    self.lift();
                }
            }
        }
    }

    /// A quadratic is a cubic whose handles lie two thirds of the way to its own.
    fn quadratic(&mut self, handle: Point, to: Point) {
        let towards = |from: Point| from + (handle - from) * (2.0 / 3.0);
        self.quadratic = Some(handle);
        self.add(Piece::Cubic(towards(self.at), towards(to), to));
    }
}

/// An arc by its ends, as SVG gives it, by its centre; `None` where it is a straight line (SVG 2, appendix B.2).
fn arc(
    from: Point,
    to: Point,
    radii: [f64; 2],
    turn: f64,
    large: bool,
    clockwise: bool,
) -> Option<Arc> {
    let (rx, ry) = (radii[0].abs(), radii[1].abs());
    if from == to || !(rx > 0.0 && ry > 0.0) {
        return None;
    }
    let (sin, cos) = libm::sincos(turn);
    let (along, across) = (Vector::new(cos, sin), Vector::new(-sin, cos));
    // On a unit circle: half the chord, in which the radii are too small where it is longer than 1.
    let half = (from - to) / 2.0;
    let h = Vector::new(half.dot(&along) / rx, half.dot(&across) / ry);
    let length = h.norm();
    let scale = length.max(1.0);
    let (rx, ry) = (rx * scale, ry * scale);
    let h = h / scale;
    let off = ((1.0 - h.norm_squared()).max(0.0)).sqrt() / h.norm();
    let side = if large == clockwise { -off } else { off };
    let centre = Vector::new(h.y, -h.x) * side;
    let (u, v) = (along * rx, across * ry);
    let middle = from + (to - from) / 2.0;
    let (start, end) = (h - centre, -h - centre);
    let begin = libm::atan2(start.y, start.x);
    let mut sweep = libm::atan2(cross(start, end), start.dot(&end));
    if clockwise && sweep < 0.0 {
        sweep += TAU;
    } else if !clockwise && sweep > 0.0 {
        sweep -= TAU;
    }
    // Half a circle may come out on either side of a half turn.
    if sweep == 0.0 || !(rx.is_finite() && ry.is_finite()) {
        return None;
    }
    Some(Arc {
        centre: middle + u * centre.x + v * centre.y,
        u,
        v,
        from: begin,
        sweep,
        to,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(d: &str) -> Vec<(f64, f64)> {
        let tracks = tracks(d).expect("path data");
        assert_eq!(tracks.len(), 1, "{d}");
        let corners = tracks[0].flattened(1e-4, 1e-9).expect("closed");
        corners.iter().map(|c| (c.at.x, c.at.y)).collect()
    }

    #[test]
    fn relative_commands_and_those_of_one_coordinate_come_to_the_same() {
        let square = [(1.0, 2.0), (5.0, 2.0), (5.0, 5.0), (1.0, 5.0)];
        for d in [
            "M1 2 5 2 5 5 1 5Z",
            "m1,2h4v3h-4z",
            "M1 2H5V5H1V2",
            "m 1 2 l 4 0 0 3 -4 0 z",
        ] {
            assert_eq!(corners(d), square, "{d}");
        }
    }

    #[test]
    fn what_follows_a_close_begins_where_the_closed_began() {
        let tracks = tracks("M1 1h2v2z l-5 0 0 -5z M9 9").expect("path data");
        assert_eq!(tracks.len(), 2);
        assert_eq!(tracks[1].start, Point::new(1.0, 1.0));
        assert_eq!(tracks[1].pieces[1], Piece::Line(Point::new(-4.0, -4.0)));
    }

    #[test]
    fn arcs_run_on_their_circle_whichever_of_the_four_they_are() {
        for (large, sweep, centre) in [
            (0, 0, (4.0, 3.0)),
            (0, 1, (0.0, 0.0)),
            (1, 0, (0.0, 0.0)),
            (1, 1, (4.0, 3.0)),
        ] {
            let d = format!("M4 0A4 3 0 {large} {sweep} 0 3Z");
            let found = corners(&d);
            for p in &found {
                let reach = libm::hypot((p.0 - centre.0) / 4.0, (p.1 - centre.1) / 3.0);
                assert!((reach - 1.0).abs() < 1e-12, "{d}: {p:?}");
            }
            // A quarter of an ellipse, or three.
            let area = crate::geometry::snap::area(
                &tracks(&d).expect("data")[0]
                    .flattened(1e-4, 1e-9)
                    .expect("closed"),
            );
            let expected = 12.0 * core::f64::consts::PI / 4.0 * if large == 1 { 3.0 } else { 1.0 };
            let triangle = if large == 1 { 6.0 } else { -6.0 };
            assert!(
                (area.abs() - expected - triangle).abs() < 1e-2,
                "{d}: {area}"
            );
        }
        // Radii too small for their chord grow, a turned ellipse turns, none at all is a line.
        assert!(
            corners("M0 0A1 1 0 0 1 10 0Z")
                .iter()
                .all(|p| (libm::hypot(p.0 - 5.0, p.1) - 5.0).abs() < 1e-12)
        );
        assert_eq!(corners("M0 0A0 1 0 0 1 10 0L3 3Z").len(), 3);
    }

    #[test]
    fn smooth_curves_mirror_the_handle_before_them() {
        let smooth = corners("M0 0C0 2 2 4 4 4S8 2 8 0Z");
        let plain = corners("M0 0C0 2 2 4 4 4C6 4 8 2 8 0Z");
        assert_eq!(smooth, plain);
        let smooth = corners("M0 0Q2 4 4 0T8 0L8-9Z");
        let plain = corners("M0 0Q2 4 4 0Q6 -4 8 0L8-9Z");
        assert_eq!(smooth, plain);
        assert!(tracks("M0 0 L x").is_err());
    }
}
