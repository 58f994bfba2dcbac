//! [`Arrow`]: the position, shape and name of an arrow of a free-body diagram.

use crate::geometry::Point;
use crate::pictures::drawing::symbol::Symbol;
use crate::pictures::drawing::{Colour, PagePoint};

/// Length of the longest arrow, pixels.
pub(super) const MAX_LENGTH: f64 = 64.0;
/// Width of a shaft, pixels.
pub(super) const SHAFT_WIDTH: f64 = 2.4;

/// An arrow on the page.
#[derive(Clone, Debug)]
pub(super) struct Arrow {
    /// The name next to the arrow; `None` if another arrow of the same unknown has the name.
    pub symbol: Option<Symbol>,
    /// The tooltip.
    pub title: String,
    /// The tail of the arrow, or the centre of a torque arrow, metres.
    pub at: Point,
    /// The vector from the tail to the tip, pixels. For a torque arrow, the length of this vector is the radius.
    pub along: (f64, f64),
    /// The angle through which a torque arrow turns, radians, anticlockwise positive; `None` for a straight arrow.
    pub turn: Option<f64>,
    /// The width of the shaft, pixels.
    pub width: f64,
    /// The colour of the arrow.
    pub colour: Colour,
    /// Whether the arrow is hollow, like the arrows of loads.
    pub hollow: bool,
    /// Whether the arrow shows a missing force, which is drawn above all others.
    pub missing: bool,
}

impl Arrow {
    /// Returns possible centres for the name of the arrow: on both sides of its shaft and beyond its tip, or around a
    /// torque arrow. `wide` and `high` are the width and height of the name in pixels. `from` is the position on the
    /// page of the tail, or of the centre of a torque arrow.
    pub(super) fn beside(&self, from: PagePoint, wide: f64, high: f64) -> Vec<PagePoint> {
        let (x, y) = self.along;
        let length = libm::hypot(x, y).max(1e-9);
        let (ux, uy) = (x / length, y / length);
        let reach = |x: f64, y: f64| x.abs() * wide / 2.0 + y.abs() * high / 2.0;
        if self.turn.is_some() {
            let off = |x: f64, y: f64| {
                let far = length + 3.0 * self.width + 2.0 + reach(x, y);
                from.moved(x * far, y * far)
            };
            return vec![off(1.0, 0.0), off(0.0, -1.0), off(-1.0, 0.0), off(0.0, 1.0)];
        }
        let mut middles = Vec::new();
        for share in [0.8, 1.0, 0.55, 0.3] {
            // The first candidate is above the shaft, because readers look for a name there first.
            let up = if -ux > 0.0 { 1.0 } else { -1.0 };
            for side in [up, -up] {
                let (nx, ny) = (-uy * side, ux * side);
                let off = 1.5 * self.width + 3.0 + reach(nx, ny);
                middles.push(from.moved(x * share + nx * off, y * share + ny * off));
            }
        }
        let beyond = length + 3.0 + reach(ux, uy);
        middles.push(from.moved(ux * beyond, uy * beyond));
        middles
    }
}
