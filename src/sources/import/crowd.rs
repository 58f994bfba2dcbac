//! Drawings of which too much lies in one place: refused before any work on pairs of outlines begins.
//!
//! Whether outlines touch, hold each other or overlap is a question about pairs. Where bodies lie side by side an index finds
//! the few that matter; a thousand outlines on one spot are half a million pairs, and no structure.

use super::outline::Outlines;
use super::{Remark, Role};
use crate::geometry::Bounds;
use crate::geometry::snap::Corner;

/// A drawing has at most so many outlines, copies included.
pub(super) const MOST_BODIES: usize = 20_000;
/// So many pairs of outlines may lie over each other by their boxes, and for every outline so many more.
const MOST_PAIRS: usize = 100_000;
const PAIRS_EACH: usize = 10;
/// So many comparisons of a corner with a side tell which outlines of one path lie in which.
const MOST_WORK: usize = 200_000_000;

/// Why a drawing is refused.
pub(super) fn problem(outlines: &Outlines) -> Option<Remark> {
    let count = outlines.bodies.len();
    if count > MOST_BODIES {
        return Some(too_many(count));
    }
    let boxes = |kind: Role| -> Vec<Bounds> {
        let bodies = outlines.bodies.iter().filter(|b| b.kind == kind);
        bodies
            .filter_map(|b| Bounds::from_points(b.rings.iter().flatten().map(|c| c.at)))
            .collect()
    };
    let most = MOST_PAIRS + PAIRS_EACH * count;
    let (blocks, ground) = (boxes(Role::Block), boxes(Role::Ground));
    (pairs(blocks, most) > most || pairs(ground, most) > most).then(|| Remark {
        element: String::new(),
        message: format!(
            "of its {count} outlines more than {most} pairs lie over each other: they cannot be blocks side by side"
        ),
        help: "delete copies that lie on one another".into(),
    })
}

/// What is reported of a drawing of so many outlines.
pub(super) fn too_many(count: usize) -> Remark {
    Remark {
        element: String::new(),
        message: format!(
            "the drawing has {count} outlines or more, copies included; at most {MOST_BODIES} are taken"
        ),
        help: "import a part of it, or name the layers that are no blocks ignore".into(),
    }
}

/// Whether the outlines of one path are too many, or too many sided, to tell which of them lies in which.
pub(super) fn is_tangle(rings: &[Vec<Corner>]) -> bool {
    let mut boxes: Vec<(Bounds, usize)> = rings
        .iter()
        .filter_map(|r| Some((Bounds::from_points(r.iter().map(|c| c.at))?, r.len())))
        .collect();
    boxes.sort_by(|a, b| a.0.min.x.total_cmp(&b.0.min.x));
    let mut work = 0_usize;
    for (i, (a, corners)) in boxes.iter().enumerate() {
        for (b, others) in &boxes[i + 1..] {
            work += 1;
            if b.min.x > a.max.x {
                break;
            }
            if a.intersects(*b) {
                work = work.saturating_add(corners.saturating_mul(*others));
            }
            if work > MOST_WORK {
                return true;
            }
        }
    }
    // Each pair of boxes is looked at once more where outlines are sorted.
    rings.len().saturating_mul(rings.len()) > MOST_WORK
}

/// How many pairs of boxes have an area in common; one more than `most` where there are more.
fn pairs(mut boxes: Vec<Bounds>, most: usize) -> usize {
    boxes.sort_by(|a, b| a.min.x.total_cmp(&b.min.x));
    let mut count = 0;
    for (i, a) in boxes.iter().enumerate() {
        for b in boxes[i + 1..].iter().take_while(|b| b.min.x < a.max.x) {
            if a.min.y < b.max.y && b.min.y < a.max.y {
                count += 1;
                if count > most {
                    return count;
                }
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    fn square(x: f64, y: f64) -> Bounds {
        Bounds {
            min: Point::new(x, y),
            max: Point::new(x + 1.0, y + 1.0),
        }
    }

    #[test]
    fn boxes_side_by_side_are_no_pairs() {
        let wall = (0..60).flat_map(|x| (0..60).map(move |y| square(f64::from(x), f64::from(y))));
        assert_eq!(pairs(wall.collect(), 9), 0);
        let heap = vec![square(0.0, 0.0); 10];
        assert_eq!(pairs(heap.clone(), 100), 45);
        assert_eq!(pairs(heap, 9), 10, "counting ends where it is too many");
    }

    #[test]
    fn a_path_of_many_outlines_on_one_spot_is_a_tangle() {
        let ring = |x: f64| -> Vec<Corner> {
            [(x, 0.0), (x + 1.0, 0.0), (x, 1.0)]
                .map(|(x, y)| Corner {
                    at: Point::new(x, y),
                    curved: false,
                })
                .to_vec()
        };
        assert!(is_tangle(&vec![ring(0.0); 7000]));
        assert!(!is_tangle(&vec![ring(0.0); 1000]));
        let apart: Vec<Vec<Corner>> = (0..7000).map(|i| ring(f64::from(2 * i))).collect();
        assert!(!is_tangle(&apart));
    }
}
