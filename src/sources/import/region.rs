//! Regions: what the closed outlines of one element enclose, each an outline with its holes.

use super::draft::Rule;
use crate::geometry::snap::{Corner, Rings, area};
use crate::geometry::{Bounds, Point};

/// The regions that rings enclose under a fill rule.
pub(super) fn regions(rings: Vec<Vec<Corner>>, rule: Rule) -> Vec<Rings> {
    let filled = |winding: i64| match rule {
        Rule::NonZero => winding != 0,
        Rule::EvenOdd => winding % 2 != 0,
    };
    let areas: Vec<f64> = rings.iter().map(|r| area(r)).collect();
    let boxes: Vec<Option<Bounds>> = rings
        .iter()
        .map(|r| Bounds::from_points(r.iter().map(|c| c.at)))
        .collect();
    // The larger ring comes first, so that what holds a ring stands before it.
    let mut order: Vec<usize> = (0..rings.len()).collect();
    order.sort_by(|a, b| areas[*b].abs().total_cmp(&areas[*a].abs()));
    let mut kept: Vec<Rings> = Vec::new();
    let mut region_of: Vec<Option<usize>> = vec![None; rings.len()];
    for (place, &i) in order.iter().enumerate() {
        let around: Vec<usize> = order[..place]
            .iter()
            .copied()
            .filter(|j| holds(boxes[*j], boxes[i]) && lies_in(&rings[i], &rings[*j]))
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
            // A ring with the same on both sides bounds nothing.
            _ => {}
        }
    }
    kept
}

fn holds(outer: Option<Bounds>, inner: Option<Bounds>) -> bool {
    let (Some(outer), Some(inner)) = (outer, inner) else {
        return false;
    };
    outer.intersects(inner) && outer.width() >= inner.width() && outer.height() >= inner.height()
}

/// Whether most of a ring's corners lie inside another; one corner alone may lie on the other's edge.
fn lies_in(ring: &[Corner], other: &[Corner]) -> bool {
    let inside = |p: Point| {
        let mut odd = false;
        for (a, b) in other.iter().zip(other.iter().cycle().skip(1)) {
            let (a, b) = (a.at, b.at);
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
                odd = !odd;
            }
        }
        odd
    };
    2 * ring.iter().filter(|c| inside(c.at)).count() > ring.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, size: f64, clockwise: bool) -> Vec<Corner> {
        let mut ring: Vec<Corner> = [(x, x), (x + size, x), (x + size, x + size), (x, x + size)]
            .iter()
            .map(|p| Corner {
                at: Point::new(p.0, p.1),
                curved: false,
            })
            .collect();
        if clockwise {
            ring.reverse();
        }
        ring
    }

    #[test]
    fn the_fill_rule_decides_what_is_a_hole() {
        let nested = |inner_clockwise| {
            vec![
                square(0.0, 9.0, false),
                square(1.0, 6.0, inner_clockwise),
                square(2.0, 1.0, false),
            ]
        };
        // A hole with an island in it.
        let island = regions(nested(true), Rule::NonZero);
        assert_eq!(island.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
        assert_eq!(regions(nested(false), Rule::EvenOdd).len(), 2);
        // All the same way round: the inner rings bound nothing.
        let whole = regions(nested(false), Rule::NonZero);
        assert_eq!(whole.iter().map(Vec::len).collect::<Vec<_>>(), [1]);
        assert_eq!(
            regions(
                vec![square(0.0, 1.0, true), square(4.0, 2.0, false)],
                Rule::EvenOdd
            )
            .len(),
            2
        );
    }
}
