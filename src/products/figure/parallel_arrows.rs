//! [`shifts`]: how far arrows that overlap on one line move to their sides, so that a reader sees both.
//!
//! The ground often pushes a block up on the same line on which its weight pulls it down. On this line, the two arrows
//! would look like one arrow with two heads. Each arrow moves away from the parallel arrow that covers it most, by half
//! of the distance that the two need and do not have. Both arrows of a pair move, so the pair stays centred about its
//! line. An arrow moves by at most [`MAX_SHIFT`] of its own width: farther away, it would show a force beside its line
//! of action, or in another block. Arrows that still overlap after this move stay so.
//!
//! Lengths and directions do not change, so an arrow still shows its force.

use super::arrow::Marks;
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::pictures::drawing::arrow::{HEAD_WIDTH, head_size};

/// Largest move of an arrow across its line, in widths of its own shaft.
pub(crate) const MAX_SHIFT: f64 = 0.8;
/// Gap between two parallel arrows, in widths of the wider shaft.
pub(crate) const ARROW_GAP: f64 = 0.4;
/// Arrows whose directions differ by less than this, rad (7°), count as parallel, because they would cover each other
/// over most of their lengths. Arrows at a larger angle cross, and a reader can distinguish them.
const PARALLEL_ANGLE: f64 = 0.12;
/// With more arrows than this, none is moved, because a reader cannot distinguish single arrows there.
const MAX_ARROWS: usize = 4000;
/// Two arrows lie on one line if their distance is below this fraction of a shaft's width, and two overlaps are equally
/// large if they differ by less. A rounding error must not decide to which side an arrow moves.
const ONE_LINE_TOL: f64 = 1e-3;

/// The place of a straight arrow. All lengths are in the same unit, metres or pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lane {
    pub tail: Point,
    /// The vector from the tail to the tip of the head.
    pub reach: Vector,
    /// The width of the shaft.
    pub width: f64,
}

/// Moves the arrows of a frame that overlap on one line.
pub(crate) fn separate_parallel_arrows(marks: &mut Marks) {
    let lane = |a: &super::arrow::ForceArrow| Lane { tail: a.at, reach: a.reach(), width: a.width };
    let lanes: Vec<Lane> = marks.arrows.iter().map(lane).collect();
    for (arrow, shift) in marks.arrows.iter_mut().zip(shifts(&lanes)) {
        arrow.at += shift;
    }
}

/// Returns the vector by which each arrow moves across its line.
pub(crate) fn shifts(lanes: &[Lane]) -> Vec<Vector> {
    let mut shifts = vec![Vector::zeros(); lanes.len()];
    if lanes.len() > MAX_ARROWS {
        return shifts;
    }
    // Sweep the arrows from left to right, and compare each with those whose boxes begin before its own box ends.
    let spans: Vec<(f64, f64)> = lanes.iter().map(Lane::span).collect();
    let mut order: Vec<usize> = (0..lanes.len()).collect();
    order.sort_by(|a, b| spans[*a].0.total_cmp(&spans[*b].0));
    // For each arrow, the arrows that overlap it: what the distance lacks, their index, and the side to move to.
    let mut overlaps: Vec<Vec<(f64, usize, f64)>> = vec![Vec::new(); lanes.len()];
    for (place, &i) in order.iter().enumerate() {
        for &j in order[place + 1..].iter().take_while(|j| spans[**j].0 <= spans[i].1) {
            let (first, second) = (i.min(j), i.max(j));
            if let Some(overlap) = Overlap::of(&lanes[first], &lanes[second]) {
                overlaps[first].push((overlap.lacks, second, overlap.sides.0));
                overlaps[second].push((overlap.lacks, first, overlap.sides.1));
            }
        }
    }
    for ((lane, overlaps), shift) in lanes.iter().zip(&overlaps).zip(&mut shifts) {
        let most = overlaps.iter().map(|(lacks, ..)| *lacks).fold(0.0, f64::max);
        // Of several arrows that cover this one equally, the first in the list counts.
        let worst = overlaps.iter().filter(|(lacks, ..)| *lacks >= most - ONE_LINE_TOL * lane.width);
        if let Some((lacks, _, side)) = worst.min_by_key(|(_, other, _)| *other) {
            let far = (0.5 * lacks).min(MAX_SHIFT * lane.width);
            *shift = quarter_turn(lane.reach) * (side * far / lane.reach.norm());
        }
    }
    shifts
}

impl Lane {
    /// Returns the range of x in which another arrow may overlap this one.
    fn span(&self) -> (f64, f64) {
        let (x, tip) = (self.tail.x, self.tail.x + self.reach.x);
        let wide = (HEAD_WIDTH + ARROW_GAP) * self.width;
        (x.min(tip) - wide, x.max(tip) + wide)
    }

    /// Returns the shaft and the head, each as (begin, end, half width). Begin and end are distances from the tail.
    fn parts(&self) -> [(f64, f64, f64); 2] {
        let length = self.reach.norm();
        let (long, wide) = head_size(length, self.width);
        let neck = length - long;
        [(0.0, neck, (self.width / 2.0).min(wide / 2.0 / HEAD_WIDTH)), (neck, length, wide / 2.0)]
    }
}

/// How two parallel arrows overlap.
struct Overlap {
    /// The distance that the axes need and do not have.
    lacks: f64,
    /// The side to which each of the two arrows moves: 1 for its left, −1 for its right.
    sides: (f64, f64),
}

impl Overlap {
    /// Returns `None` if the arrows are not parallel, lie one behind the other, or are far enough apart.
    fn of(a: &Lane, b: &Lane) -> Option<Overlap> {
        let (long, other) = (a.reach.norm(), b.reach.norm());
        if !(long > 0.0 && other > 0.0) || cross(a.reach, b.reach).abs() > PARALLEL_ANGLE * long * other {
            return None;
        }
        let along = a.reach / long;
        let sense = b.reach.dot(&along).signum();
        let from = (b.tail - a.tail).dot(&along);
        let gap = ARROW_GAP * a.width.max(b.width);
        let mut needed: f64 = 0.0;
        for (begin, end, half) in a.parts() {
            for (start, stop, wide) in b.parts() {
                let (p, q) = (from + sense * start, from + sense * stop);
                if p.min(q) < end + gap && p.max(q) > begin - gap {
                    needed = needed.max(half + wide + gap);
                }
            }
        }
        // Measure the distance in the middle of the range that both arrows share.
        let tip = from + b.reach.dot(&along);
        let middle = 0.5 * (from.min(tip).max(0.0) + from.max(tip).min(long));
        let share = ((middle - from) / (tip - from)).clamp(0.0, 1.0);
        let beside = cross(along, b.tail + b.reach * share - a.tail);
        let lacks = needed - beside.abs();
        let one_line = beside.abs() <= ONE_LINE_TOL * a.width.max(b.width);
        let sides = match (one_line, sense > 0.0) {
            // On one line, opposite arrows keep to their right. Of two arrows in the same direction, the first does.
            (true, false) => (-1.0, -1.0),
            (true, true) => (-1.0, 1.0),
            (false, _) => (-beside.signum(), sense * beside.signum()),
        };
        (needed > 0.0 && lacks > 0.0).then_some(Overlap { lacks, sides })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lane(x: f64, y: f64, up: f64) -> Lane {
        Lane { tail: Point::new(x, y), reach: Vector::new(0.0, up), width: 1.0 }
    }

    /// From one point, a shaft of width 1 needs the distance 1 + 0.4 from the opposite shaft: 0.7 for each arrow.
    #[test]
    fn opposite_arrows_from_one_point_lie_on_both_sides_of_their_line() {
        let moved = shifts(&[lane(0.0, 0.0, 20.0), lane(0.0, 0.0, -20.0)]);
        assert!((moved[0].x - 0.7).abs() < 1e-12 && (moved[1].x + 0.7).abs() < 1e-12, "{moved:?}");
    }

    /// A head (half width 1.5) on a shaft needs 0.5 + 1.5 + 0.4 = 2.4, but no arrow moves by more than 0.8.
    #[test]
    fn no_arrow_moves_farther_than_the_bound() {
        let pile: Vec<Lane> = (0..9).map(|k| lane(0.0, f64::from(k), if k % 2 == 0 { 20.0 } else { -20.0 })).collect();
        let moved = shifts(&pile);
        assert!(moved.iter().all(|m| (m.norm() - MAX_SHIFT).abs() < 1e-12), "{moved:?}");
        assert_eq!(shifts(&pile[..1]), [Vector::zeros()]);
    }

    #[test]
    fn arrows_that_do_not_overlap_stay_in_place() {
        let apart = [lane(0.0, 0.0, 5.0), lane(3.5, 0.0, 5.0), lane(0.0, 9.0, 5.0), lane(0.0, 8.0, 0.0)];
        assert!(shifts(&apart).iter().all(|m| *m == Vector::zeros()));
    }
}
