//! [`RowPlaces`]: positions for the amounts of loads that act next to each other, such as the loads on a beam. Each
//! amount is placed at the tail of its arrow. If the amounts are too wide for one line, some are placed in further lines
//! and joined to their arrows by leaders.

use super::super::arrow::{ArrowKind, ForceArrow};
use super::super::pen::Pen;
use crate::pictures::drawing::PagePoint;

/// Least number of loads in a row.
const MIN_LOADS: usize = 3;
/// Gap between an arrow's tail and the amount, pixels.
const TAIL_GAP: f64 = 3.0;
/// Gap between two amounts in a line, pixels. With more space, the amounts stand beside their arrows.
const AMOUNT_GAP: f64 = 6.0;
/// The number of lines beyond the first line, farther from the tails.
const MORE_LINES: u32 = 2;
/// Sine of the largest angle between the arrows of a row.
const MAX_SINE: f64 = 0.35;

/// The positions for the amount of a load in a row, pixels.
pub(super) struct RowPlaces {
    /// The tail of the arrow.
    pub tail: PagePoint,
    /// The centre of the amount in the first line, next to the tail.
    pub first: PagePoint,
    /// The centres of the amount in the other lines, which need a leader.
    pub others: Vec<PagePoint>,
}

impl RowPlaces {
    /// Returns the positions for the amount of `arrow`. Returns `None` if the arrow is not a load or has no length, if
    /// there are too few loads beside it, or if there is space for the amounts beside their arrows. The width and
    /// height of the amount are in pixels.
    pub fn new(pen: &Pen<'_>, arrow: &ForceArrow, (wide, high): (f64, f64)) -> Option<RowPlaces> {
        let tail = pen.camera.place(arrow.at);
        let (x, y) = pen.camera.turn(arrow.reach());
        let length = libm::hypot(x, y);
        if arrow.kind != ArrowKind::Load || length.is_nan() || length <= 0.0 {
            return None;
        }
        let (ux, uy) = (x / length, y / length);
        let along = ux.abs() * wide + uy.abs() * high;
        let across = uy.abs() * wide + ux.abs() * high;
        let offsets = row(pen, arrow, tail, (ux, uy), along);
        let crowded = offsets.iter().any(|off| *off < across + AMOUNT_GAP);
        if offsets.len() + 1 < MIN_LOADS || !crowded {
            return None;
        }
        let line = |number: u32| {
            let far = TAIL_GAP + 0.5 * along + f64::from(number) * (along + TAIL_GAP);
            tail.moved(-ux * far, -uy * far)
        };
        Some(RowPlaces { tail, first: line(0), others: (1..=MORE_LINES).map(line).collect() })
    }
}

/// Returns the distances, across the arrow, from `tail` to the tails of the other loads in the row of `arrow`, pixels.
/// The arrows of these loads have nearly the direction (`ux`, `uy`). Along the arrow, their tails differ from `tail` by
/// at most `along` pixels.
fn row(pen: &Pen<'_>, arrow: &ForceArrow, tail: PagePoint, (ux, uy): (f64, f64), along: f64) -> Vec<f64> {
    let arrows = pen.context.marks[pen.number].arrows.iter();
    let others = arrows.filter(|a| a.kind == ArrowKind::Load && !core::ptr::eq(*a, arrow));
    let offset = |other: &ForceArrow| {
        let (x, y) = pen.camera.turn(other.reach());
        let length = libm::hypot(x, y);
        let parallel = x * ux + y * uy > 0.0 && (x * uy - y * ux).abs() <= MAX_SINE * length;
        let at = pen.camera.place(other.at);
        let (dx, dy) = (at.x - tail.x, at.y - tail.y);
        (parallel && (dx * ux + dy * uy).abs() <= along).then_some((dx * uy - dy * ux).abs())
    };
    others.filter_map(offset).collect()
}
