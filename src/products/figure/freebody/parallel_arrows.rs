//! [`separate_arrows`]: moves arrows of a free-body diagram sideways if they overlap on the same line.
//!
//! In the middle of a pile, forces push a block up on the same line on which its weight pulls it down. On this line,
//! the two arrows would overlap. Only the position of the arrow changes; the list of forces keeps the line of action.

use super::arrow::{Arrow, SHAFT_WIDTH};
use crate::pictures::drawing::Camera;
use crate::pictures::drawing::arrow::HEAD_WIDTH;

/// Arrows count as parallel if the angle between their axes is less than this, rad. Opposite arrows are parallel too.
const PARALLEL_ANGLE: f64 = 0.12;
/// Arrows that overlap along their line by less than this, pixels, are not moved.
const END_TO_END: f64 = 2.0;
/// Distance of two axes, pixels: the width of a head and a small gap.
const AXIS_DISTANCE: f64 = (HEAD_WIDTH + 0.8) * SHAFT_WIDTH;

/// Moves each straight arrow that overlaps an earlier arrow sideways, by one or two times [`AXIS_DISTANCE`] to its left
/// or right. If it would overlap an arrow at each of these positions, it is not moved.
pub(super) fn separate_arrows(arrows: &mut [Arrow], camera: &Camera) {
    for i in 1..arrows.len() {
        let (before, rest) = arrows.split_at_mut(i);
        let Some(arrow) = rest.first_mut() else {
            return;
        };
        let (x, y) = arrow.along;
        let length = libm::hypot(x, y);
        if arrow.turn.is_some() || length.is_nan() || length <= 0.0 {
            continue;
        }
        let true_place = camera.place(arrow.at);
        let (across_x, across_y) = (-y / length * AXIS_DISTANCE, x / length * AXIS_DISTANCE);
        let places = [0.0, 1.0, -1.0, 2.0, -2.0].map(|k| true_place.moved(k * across_x, k * across_y));
        let clear = places.into_iter().find(|place| {
            let mut before = before.iter().filter(|other| other.turn.is_none());
            !before.any(|other| {
                let from = camera.place(other.at);
                one_line(other.along, arrow.along, (place.x - from.x, place.y - from.y))
            })
        });
        if let Some(clear) = clear.filter(|clear| *clear != true_place) {
            arrow.at = camera.back(clear);
        }
    }
}

/// True if two arrows are parallel and overlap. `offset` is the vector from the tail of the first arrow to the tail of
/// the second, in pixels.
fn one_line(first: (f64, f64), second: (f64, f64), offset: (f64, f64)) -> bool {
    let (long, other) = (libm::hypot(first.0, first.1), libm::hypot(second.0, second.1));
    if !(long > 0.0 && other > 0.0) {
        return false;
    }
    let (ux, uy) = (first.0 / long, first.1 / long);
    let cross = |(x, y): (f64, f64)| ux * y - uy * x;
    let along = |(x, y): (f64, f64)| ux * x + uy * y;
    let parallel = (cross(second) / other).abs() < PARALLEL_ANGLE;
    let (a, b) = (along(offset), along(offset) + along(second));
    let shared = long.min(a.max(b)) - a.min(b).max(0.0);
    parallel && cross(offset).abs() < AXIS_DISTANCE - 0.1 && shared > END_TO_END
}

#[cfg(test)]
mod tests {
    use super::one_line;

    #[test]
    fn only_arrows_that_overlap_on_one_line_hide_each_other() {
        let up = (0.0, -40.0);
        let down = (0.0, 20.0);
        assert!(one_line(up, down, (0.0, -30.0)));
        assert!(!one_line(up, down, (9.5, -30.0)), "side by side");
        assert!(!one_line(up, down, (0.0, 0.0)), "tail to tail");
        assert!(!one_line(up, (20.0, 0.0), (0.0, -30.0)), "perpendicular");
    }
}
