//! [`movement`]: describes how the position or outline of an element changed. No other file of this folder uses
//! svgtypes.

use svgtypes::{SimplePathSegment, SimplifyingPathParser};

use super::POSITION_TOL;
use super::tree::Element;

/// A change of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Movement {
    /// No change.
    None,
    /// A translation to the right and down, in pixels.
    Moved(f64, f64),
    /// A rotation in degrees anticlockwise, perhaps with a translation.
    Turned(f64),
    /// Another outline with the same path commands. The number is the largest change of a coordinate, in pixels.
    Reshaped(f64),
    /// An outline with other path commands, or an outline that cannot be read.
    Redrawn,
}

impl Movement {
    /// Describes the movement in words, such as `moved by 1 px to the right`; empty if there is no change.
    pub(super) fn words(self) -> String {
        let short = |value: f64| {
            let text = format!("{:.2}", value.abs());
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        };
        match self {
            Movement::None => String::new(),
            Movement::Moved(x, y) => {
                let way = |by: f64, there: &str, back: &str| {
                    let word = if by > 0.0 { there } else { back };
                    (by.abs() > POSITION_TOL).then(|| format!("{} px {word}", short(by)))
                };
                let ways = [way(x, "to the right", "to the left"), way(y, "down", "up")];
                let ways: Vec<String> = ways.into_iter().flatten().collect();
                format!("moved by {}", ways.join(" and "))
            }
            Movement::Turned(degrees) => {
                let way = if degrees > 0.0 { "anticlockwise" } else { "clockwise" };
                format!("turned by {}° {way}", short(degrees))
            }
            Movement::Reshaped(far) => format!("its outline changed by up to {} px", short(far)),
            Movement::Redrawn => "its outline changed".into(),
        }
    }
}

/// Finds the change of an element's shape. The simplest explanation is tried first: no change, then a translation, a
/// rotation, and another shape.
pub(super) fn movement(old: &Element, new: &Element) -> Movement {
    if old.shape == new.shape || old.tag == "svg" {
        return Movement::None;
    }
    let (Some((a, what)), Some((b, is))) = (points(old), points(new)) else {
        return Movement::Redrawn;
    };
    if what != is || a.len() != b.len() {
        return Movement::Redrawn;
    }
    let far = |b: &[[f64; 2]], to: &dyn Fn([f64; 2]) -> [f64; 2]| {
        let far = a.iter().zip(b).map(|(p, q)| {
            let p = to(*p);
            (p[0] - q[0]).abs().max((p[1] - q[1]).abs())
        });
        far.fold(0.0, f64::max)
    };
    // 1. No change: no point has moved.
    let stayed = far(&b, &|p| p);
    if stayed <= POSITION_TOL {
        return Movement::None;
    }
    // 2. Translation: the shift of the centroid moves all points to their new positions.
    let (from, to) = (centre(&a), centre(&b));
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    if far(&b, &|p| [p[0] + x, p[1] + y]) <= 2.0 * POSITION_TOL {
        if x.abs() <= POSITION_TOL && y.abs() <= POSITION_TOL {
            return Movement::None;
        }
        return Movement::Moved(rounded(x), rounded(y));
    }
    // 3. Rotation: the best rotation about the centroid, after the shift of the centroid, moves all points to their new
    //    positions.
    let angle = best_rotation(&a, &b, from, to);
    let (sin, cos) = libm::sincos(angle);
    let turned = |p: [f64; 2]| {
        let p = [p[0] - from[0], p[1] - from[1]];
        [to[0] + cos * p[0] - sin * p[1], to[1] + sin * p[0] + cos * p[1]]
    };
    if far(&b, &turned) <= 2.0 * POSITION_TOL {
        // The y axis of the page points down, so a positive angle is clockwise. Report the opposite sign, positive
        // anticlockwise.
        return Movement::Turned(-angle.to_degrees());
    }
    Movement::Reshaped(stayed)
}

/// Rounds a translation along one axis. Positions in the SVG are rounded to 0.01. Translations are rounded more
/// coarsely, so that all elements that moved together report the same distance.
fn rounded(by: f64) -> f64 {
    match by.abs() {
        far if far < 0.2 => (by * 100.0).round() / 100.0,
        _ => (by * 10.0).round() / 10.0,
    }
}

/// Returns the angle, in radians, of the rotation that fits the points `a` best to the points `b`. `from` and `to`
/// are the centroids of `a` and `b`. With points p of `a` and q of `b`, each relative to its centroid, the
/// least-squares (Procrustes) solution in the plane is atan2(Σ p × q, Σ p · q).
fn best_rotation(a: &[[f64; 2]], b: &[[f64; 2]], from: [f64; 2], to: [f64; 2]) -> f64 {
    let (mut along, mut across) = (0.0, 0.0);
    for (p, q) in a.iter().zip(b) {
        let (p, q) = ([p[0] - from[0], p[1] - from[1]], [q[0] - to[0], q[1] - to[1]]);
        along += p[0] * q[0] + p[1] * q[1];
        across += p[0] * q[1] - p[1] * q[0];
    }
    libm::atan2(across, along)
}

/// Returns the mean of the points.
fn centre(points: &[[f64; 2]]) -> [f64; 2] {
    let count = points.len().max(1) as f64;
    let sum = points.iter().fold([0.0, 0.0], |s, p| [s[0] + p[0], s[1] + p[1]]);
    [sum[0] / count, sum[1] / count]
}

/// Returns the points that define the shape of an element, and a text of its other properties: the letters of its path
/// commands, or the radius of a circle. Returns `None` if a number cannot be read.
fn points(element: &Element) -> Option<(Vec<[f64; 2]>, String)> {
    let mut points = Vec::new();
    let mut letters = String::new();
    if let Some(data) = element.place_of("d") {
        for segment in SimplifyingPathParser::from(data) {
            match segment.ok()? {
                SimplePathSegment::MoveTo { x, y } => {
                    letters.push('M');
                    points.push([x, y]);
                }
                SimplePathSegment::LineTo { x, y } => {
                    letters.push('L');
                    points.push([x, y]);
                }
                SimplePathSegment::CurveTo { x1, y1, x2, y2, x, y } => {
                    letters.push('C');
                    points.extend([[x1, y1], [x2, y2], [x, y]]);
                }
                SimplePathSegment::Quadratic { x1, y1, x, y } => {
                    letters.push('Q');
                    points.extend([[x1, y1], [x, y]]);
                }
                SimplePathSegment::ClosePath => letters.push('Z'),
            }
        }
        return Some((points, letters));
    }
    let number = |name: &str| match element.place_of(name) {
        None => Some(0.0),
        Some(text) => text.trim_end_matches("px").parse::<f64>().ok(),
    };
    for (x, y) in [("x", "y"), ("x1", "y1"), ("x2", "y2"), ("cx", "cy")] {
        if element.place_of(x).is_some() || element.place_of(y).is_some() {
            points.push([number(x)?, number(y)?]);
        }
    }
    if element.place_of("width").is_some() || element.place_of("height").is_some() {
        let corner = points.first().copied().unwrap_or_default();
        points.push([corner[0] + number("width")?, corner[1] + number("height")?]);
    }
    letters.push_str(element.place_of("r").unwrap_or_default());
    letters.push_str(element.place_of("points").unwrap_or_default());
    Some((points, letters))
}
