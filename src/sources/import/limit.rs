//! Limits on the number of outlines in a drawing, on the number of pairs of outlines that overlap, and on the number of
//! comparisons in the search for the holes of one path.
//!
//! Tests for contact, holes and overlap compare pairs of outlines. For blocks that lie next to each other, an index
//! finds the few pairs that matter. A thousand outlines in one place are half a million pairs, and they are not a
//! structure. Such drawings are refused before the comparisons begin.

use super::Remark;
use super::draft::Draft;
use crate::geometry::Bounds;
use crate::geometry::snap::Corner;

/// The largest number of outlines, copies included.
pub(super) const MAX_BODIES: usize = 20_000;
/// The largest number of corners of all outlines after chords have replaced their curves.
const MAX_CORNERS: f64 = 1e6;
/// The largest number of pairs with overlapping bounding boxes is `MAX_PAIRS`, plus `MAX_PAIRS_PER_BODY` for each
/// outline. In an arch, for example, the box of each voussoir overlaps those of a few neighbours.
const MAX_PAIRS: usize = 100_000;
const MAX_PAIRS_PER_BODY: usize = 10;
/// The largest number of comparisons of a corner with an edge in the search for the holes of one path.
const MAX_COMPARISONS: usize = 200_000_000;

/// Returns a remark if a drawing has too many outlines, or too many pairs of outlines with overlapping bounding boxes.
/// `boxes` are the bounding boxes of the blocks, and those of the parts of the ground; pairs are counted within each of
/// the two lists.
pub(super) fn problem(boxes: [Vec<Bounds>; 2]) -> Option<Remark> {
    let count: usize = boxes.iter().map(Vec::len).sum();
    if count > MAX_BODIES {
        return Some(too_many(count));
    }
    let max = MAX_PAIRS + MAX_PAIRS_PER_BODY * count;
    boxes.into_iter().any(|boxes| pairs(boxes, max) > max).then(|| {
        let message =
            format!("more than {max} pairs of its {count} outlines overlap, so they cannot be blocks side by side");
        Remark::new("", message, "delete outlines that lie on top of each other")
    })
}

/// Returns the remark about a drawing with too many outlines.
pub(super) fn too_many(count: usize) -> Remark {
    let message = format!("the drawing has at least {count} outlines, copies included; the limit is {MAX_BODIES}");
    Remark::new("", message, "import a part of it, or give layers without blocks names that begin with ignore")
}

/// Returns a remark if the outlines, with chords at most `flatten` metres from their curves, have too many corners.
pub(super) fn corners_problem(draft: &Draft, flatten: f64) -> Option<Remark> {
    let paths = draft.parts.iter().flat_map(|part| part.subpaths().iter().chain(&part.clips));
    let count: f64 = paths.map(|path| path.corners(flatten)).sum();
    (count > MAX_CORNERS).then(|| {
        let message = format!("its outlines have {count} corners with chords for curves; the limit is {MAX_CORNERS}");
        Remark::new("", message, "give a larger --flatten, or import a part of it")
    })
}

/// True if the search for the holes of one path would need too many comparisons.
pub(super) fn has_too_many_pairs(rings: &[Vec<Corner>]) -> bool {
    let mut boxes: Vec<(Bounds, usize)> =
        rings.iter().filter_map(|r| Some((Bounds::from_points(r.iter().map(|c| c.at))?, r.len()))).collect();
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
            if work > MAX_COMPARISONS {
                return true;
            }
        }
    }
    // The number of rings has a limit too, because `regions` compares the bounding boxes of all pairs of rings.
    rings.len().saturating_mul(rings.len()) > MAX_COMPARISONS
}

/// Counts the pairs of boxes with a common area. Counting stops at `max` + 1.
fn pairs(mut boxes: Vec<Bounds>, max: usize) -> usize {
    boxes.sort_by(|a, b| a.min.x.total_cmp(&b.min.x));
    let mut count = 0;
    for (i, a) in boxes.iter().enumerate() {
        for b in boxes[i + 1..].iter().take_while(|b| b.min.x < a.max.x) {
            if a.min.y < b.max.y && b.min.y < a.max.y {
                count += 1;
                if count > max {
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
        Bounds { min: Point::new(x, y), max: Point::new(x + 1.0, y + 1.0) }
    }

    #[test]
    fn boxes_side_by_side_are_not_pairs() {
        let wall = (0..60).flat_map(|x| (0..60).map(move |y| square(f64::from(x), f64::from(y))));
        assert_eq!(pairs(wall.collect(), 9), 0);
        let heap = vec![square(0.0, 0.0); 10];
        assert_eq!(pairs(heap.clone(), 100), 45);
        assert_eq!(pairs(heap, 9), 10, "counting stops above the limit");
    }

    #[test]
    fn a_path_with_many_outlines_in_one_place_is_refused() {
        let ring = |x: f64| -> Vec<Corner> {
            [(x, 0.0), (x + 1.0, 0.0), (x, 1.0)].map(|(x, y)| Corner { at: Point::new(x, y), curved: false }).to_vec()
        };
        assert!(has_too_many_pairs(&vec![ring(0.0); 7000]));
        assert!(!has_too_many_pairs(&vec![ring(0.0); 1000]));
        let apart: Vec<Vec<Corner>> = (0..7000).map(|i| ring(f64::from(2 * i))).collect();
        assert!(!has_too_many_pairs(&apart));
    }
}
