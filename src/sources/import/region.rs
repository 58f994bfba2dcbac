//! [`regions`]: splits the closed outlines of one element into regions, each an outline with its holes.
//!
//! 1. Sort the rings by area, so that a ring comes after all rings around it.
//! 2. The winding number just outside a ring is the sum of the directions of the rings around it: 1 for anticlockwise,
//!    −1 for clockwise. Inside the ring, its own direction is added.
//! 3. A ring begins a region if the area inside it is filled and the area outside is not. If only the area outside is
//!    filled, the ring is a hole of the innermost region around it. All other rings are ignored.

use super::draft::FillRule;
use crate::geometry::snap::{Corner, Rings, area};
use crate::geometry::{Bounds, Point};

/// Returns the regions that the rings enclose by the fill rule. The first ring of a region is its outline, and the
/// others are its holes.
pub(super) fn regions(rings: Vec<Vec<Corner>>, rule: FillRule) -> Vec<Rings> {
    let filled = |winding: i64| match rule {
        FillRule::NonZero => winding != 0,
        FillRule::EvenOdd => winding % 2 != 0,
    };
    let areas: Vec<f64> = rings.iter().map(|r| area(r)).collect();
    let boxes: Vec<Option<Bounds>> = rings.iter().map(|r| Bounds::from_points(r.iter().map(|c| c.at))).collect();
    let mut order: Vec<usize> = (0..rings.len()).collect();
    order.sort_by(|a, b| areas[*b].abs().total_cmp(&areas[*a].abs()));
    let mut kept: Vec<Rings> = Vec::new();
    let mut region_of: Vec<Option<usize>> = vec![None; rings.len()];
    for (place, &i) in order.iter().enumerate() {
        let around: Vec<usize> = order[..place]
            .iter()
            .copied()
            .filter(|j| may_contain(boxes[*j], boxes[i]) && lies_in(&rings[i], &rings[*j]))
            .collect();
        let turn = |k: usize| if areas[k] < 0.0 { -1 } else { 1 };
        let outside: i64 = around.iter().map(|j| turn(*j)).sum();
        match (filled(outside), filled(outside + turn(i))) {
            (false, true) => {
                region_of[i] = Some(kept.len());
                kept.push(vec![rings[i].clone()]);
            }
            (true, false) => {
                if let Some(region) = around.iter().rev().find_map(|j| region_of[*j]) {
                    kept[region].push(rings[i].clone());
                }
            }
            // Both sides are filled, or neither is: the ring is ignored.
            _ => {}
        }
    }
    kept
}

/// True if the outer box intersects the inner box and is large enough to contain it.
fn may_contain(outer: Option<Bounds>, inner: Option<Bounds>) -> bool {
    let (Some(outer), Some(inner)) = (outer, inner) else {
        return false;
    };
    outer.intersects(inner) && outer.width() >= inner.width() && outer.height() >= inner.height()
}

/// True if most corners of a ring are inside another ring. Not all corners must be inside, because some may lie on an
/// edge of the other ring.
fn lies_in(ring: &[Corner], other: &[Corner]) -> bool {
    let other: Vec<Point> = other.iter().map(|c| c.at).collect();
    2 * ring.iter().filter(|c| is_inside(&other, c.at)).count() > ring.len()
}

/// True if a point is inside a ring: if a horizontal ray from it crosses the ring an odd number of times.
pub(super) fn is_inside(ring: &[Point], p: Point) -> bool {
    crossings(ring, p.y).filter(|x| p.x < *x).count() % 2 == 1
}

/// Returns where a horizontal line crosses a ring.
pub(super) fn crossings(ring: &[Point], y: f64) -> impl Iterator<Item = f64> {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    sides.filter(move |(a, b)| (a.y > y) != (b.y > y)).map(move |(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, size: f64, clockwise: bool) -> Vec<Corner> {
        let mut ring: Vec<Corner> = [(x, x), (x + size, x), (x + size, x + size), (x, x + size)]
            .iter()
            .map(|p| Corner { at: Point::new(p.0, p.1), curved: false })
            .collect();
        if clockwise {
            ring.reverse();
        }
        ring
    }

    #[test]
    fn the_fill_rule_decides_what_is_a_hole() {
        let nested =
            |inner_clockwise| vec![square(0.0, 9.0, false), square(1.0, 6.0, inner_clockwise), square(2.0, 1.0, false)];
        // A hole with an island in it.
        let island = regions(nested(true), FillRule::NonZero);
        assert_eq!(island.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
        assert_eq!(regions(nested(false), FillRule::EvenOdd).len(), 2);
        // All rings in the same direction: the inner rings bound nothing.
        let whole = regions(nested(false), FillRule::NonZero);
        assert_eq!(whole.iter().map(Vec::len).collect::<Vec<_>>(), [1]);
        assert_eq!(regions(vec![square(0.0, 1.0, true), square(4.0, 2.0, false)], FillRule::EvenOdd).len(), 2);
    }
}
