//! [`ribbon`]: computes the outline of a band from its axis and its widths.

use crate::geometry::{Point, Vector, quarter_turn};
use crate::pictures::drawing::{Camera, Outline};

/// Largest width of a band at a corner, as a multiple of its width before and after the corner.
const MAX_MITRE: f64 = 1.6;

/// Returns the outline of a band along `axis` on the page. `widths` has the full width of the band at each point of the
/// axis, in metres. If a point occurs twice with different widths, the width changes abruptly there.
pub(super) fn ribbon(axis: &[Point], widths: &[f64], camera: &Camera) -> Outline {
    let points = 0..axis.len().min(widths.len());
    if axis.iter().all(|p| same(*p, axis[0])) {
        return Outline::default();
    }
    let side = |sign: f64| {
        let at = move |i: usize| camera.place(axis[i] + aside(axis, i) * (0.5 * sign * widths[i]));
        points.clone().map(at)
    };
    Outline::ring(side(1.0).chain(side(-1.0).rev()))
}

/// True if two points coincide, except for rounding.
fn same(a: Point, b: Point) -> bool {
    (a - b).norm() <= 1e-9 * (a.coords.norm() + b.coords.norm())
}

/// Returns a vector across the band at point `i` of the axis, pointing to the left. Its length is 1 on a straight part.
/// At a corner it is longer, so that the band keeps its width (a mitre).
fn aside(axis: &[Point], i: usize) -> Vector {
    let apart = |p: &&Point| !same(**p, axis[i]);
    let across = |along: Vector| quarter_turn(along / along.norm());
    let before = axis[..i].iter().rev().find(apart);
    let behind = axis[i..].iter().find(apart);
    match (before.map(|p| across(axis[i] - p)), behind.map(|p| across(p - axis[i]))) {
        (Some(before), Some(behind)) => {
            let sum = before + behind;
            let half = 0.5 * sum.norm();
            if half < 1e-9 {
                return before;
            }
            sum / sum.norm() * (1.0 / half).min(MAX_MITRE)
        }
        (before, behind) => before.or(behind).unwrap_or_else(Vector::zeros),
    }
}
