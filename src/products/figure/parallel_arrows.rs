//! [`separate_parallel_arrows`]: moves overlapping parallel arrows sideways, so that they are drawn next to each other.
//!
//! The ground often pushes a block up on the same line on which its weight pulls it down. On this line, the two arrows
//! would look like one arrow with two heads. The arrows of a frame are processed one after the other, in drawing order:
//!
//! 1. The ideal offset of an arrow is 0. If an opposite arrow begins at the same point, the ideal offset is half the
//!    width of a shaft plus half the gap, so that the pair is centred about its true line.
//! 2. If the arrow overlaps no earlier arrow at its ideal offset, it gets this offset.
//! 3. Otherwise the candidates are 0 and, for each arrow nearby, the two offsets at which the arrows just do not
//!    overlap. The arrow gets the candidate that is nearest to the ideal offset and at which it overlaps no earlier
//!    arrow.
//!
//! Lengths and directions do not change, so an arrow still shows its force.

mod place;

use self::place::BoxGrid;
use super::arrow::{ForceArrow, Marks};
use crate::geometry::{Bounds, Vector};
use crate::pictures::drawing::arrow::{HEAD_WIDTH, head_size};

/// Arrows whose directions differ by less than this, rad (7°), count as parallel, because they would cover each other
/// over most of their lengths. Arrows at a larger angle cross, and a reader can distinguish them.
const PARALLEL_ANGLE: f64 = 0.12;
/// Gap between two parallel arrows, in widths of the wider shaft.
pub(super) const ARROW_GAP: f64 = 0.4;
/// Candidates are first taken from arrows within this distance, in widths of the arrow's shaft, and only then from all
/// arrows of the frame. This order saves time and does not change the result; see `offset_of_least_change`.
const NEARBY_DISTANCE: f64 = 24.0;
/// Largest number of candidates that are tried. If none of them is free, the page is full at this position, and the
/// arrow is drawn at its ideal offset.
const MAX_CANDIDATES: usize = 1000;
/// Largest number of candidates of a frame. After this number, the remaining arrows are drawn at their ideal offsets.
/// The number of candidates grows with the square of the number of arrows on one line: 3000 loads on a block would
/// have about ten million.
const MAX_CANDIDATES_PER_FRAME: usize = 1_000_000;
/// In frames with more arrows than this, no arrows are moved, because a reader cannot distinguish single arrows there.
const MAX_ARROWS: usize = 4000;
/// Distances from the ideal offset are rounded to this fraction of a shaft's width. Rounding errors must not decide
/// between two offsets at the same distance.
const OFFSET_RESOLUTION: f64 = 1e-6;
/// Relative tolerance of the minimum distance between two arrows. A candidate lies exactly at this distance, and a
/// rounding error must not reject it.
const CLEAR_TOL: f64 = 1e-6;

/// Moves overlapping parallel arrows of a frame sideways, so that they are drawn next to each other. Does nothing if
/// there are more than [`MAX_ARROWS`] arrows.
pub(crate) fn separate_parallel_arrows(marks: &mut Marks) {
    let arrows = &mut marks.arrows;
    if arrows.len() > MAX_ARROWS {
        return;
    }
    let original = arrows.clone();
    // `placed` contains the bounding boxes of the arrows whose final positions are known.
    let mut placed = BoxGrid::sized_for(original.iter().map(space_around));
    let mut by_x: Vec<(f64, usize)> = original.iter().map(|a| a.at.x).zip(0..).collect();
    by_x.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut candidates = 0;
    for i in 0..arrows.len() {
        if let Some(across) = across(&original[i]) {
            let has_opposite = has_opposite(&by_x, &original, i);
            let ideal = if has_opposite { -0.5 * (1.0 + ARROW_GAP) * original[i].width } else { 0.0 };
            let offset = match candidates < MAX_CANDIDATES_PER_FRAME {
                true => offset_of_least_change(&original[i], across, ideal, (arrows, &placed), &mut candidates),
                false => ideal,
            };
            arrows[i].at = original[i].at + across * offset;
        }
        placed.put(space_around(&arrows[i]));
    }
}

/// Returns the sideways offset of an arrow in metres, positive to its left. Of the candidate offsets at which the arrow
/// is not too close to a placed parallel arrow, the result is the one nearest to `ideal`. Returns `ideal` if no tried
/// candidate is suitable. Adds the number of all candidates, tried or not, to `candidates`.
fn offset_of_least_change(
    arrow: &ForceArrow,
    across: Vector,
    ideal: f64,
    (arrows, placed): (&[ForceArrow], &BoxGrid),
    candidates: &mut usize,
) -> f64 {
    let clear = |offset: &f64| {
        let there = ForceArrow { at: arrow.at + across * *offset, ..*arrow };
        !placed.any(space_around(&there), |other| too_close(&there, &arrows[other]))
    };
    // Most arrows do not overlap any other arrow at their ideal offset.
    if clear(&ideal) {
        return ideal;
    }
    let distance = |offset: &f64| ((offset - ideal).abs() / arrow.width / OFFSET_RESOLUTION).round();
    let mut nearest = |within: Option<Bounds>| {
        let mut offsets = vec![ideal, 0.0];
        for other in placed.meeting(within) {
            let other = &arrows[other];
            if let Some((needed, _)) = side_by_side(arrow, other) {
                let now = (arrow.at - other.at).dot(&across);
                offsets.extend([needed - now, -needed - now]);
            }
        }
        *candidates += offsets.len();
        offsets.sort_by(|a, b| distance(a).total_cmp(&distance(b)).then(b.total_cmp(a)));
        offsets.into_iter().take(MAX_CANDIDATES).find(clear)
    };
    // Consider only nearby arrows first. If the offset found is small, do not search again, because arrows farther away
    // can only lead to larger offsets.
    let nearby = nearest(Some(space_around(arrow).grown(NEARBY_DISTANCE * arrow.width)));
    nearby
        .filter(|offset| offset.abs() < 0.5 * NEARBY_DISTANCE * arrow.width)
        .or_else(|| nearest(None))
        .unwrap_or(ideal)
}

/// Returns the bounding box of an arrow, enlarged by the gap between arrows. Arrows whose boxes are disjoint do not
/// overlap.
fn space_around(arrow: &ForceArrow) -> Bounds {
    let tip = arrow.at + arrow.reach();
    let ends = Bounds { min: arrow.at.inf(&tip), max: arrow.at.sup(&tip) };
    ends.grown((HEAD_WIDTH + 2.0 * ARROW_GAP) * arrow.width)
}

/// True if another arrow begins at the same point as arrow `i` and points in the opposite direction. `by_x` lists the x
/// coordinate of the tail and the index of each arrow, from left to right.
fn has_opposite(by_x: &[(f64, usize)], arrows: &[ForceArrow], i: usize) -> bool {
    let (x, far) = (arrows[i].at.x, 0.5 * arrows[i].width);
    let from = by_x.partition_point(|entry| entry.0 < x - far);
    let mut near = by_x[from..].iter().take_while(|entry| entry.0 <= x + far);
    near.any(|(_, j)| opposite(&arrows[i], &arrows[*j]))
}

/// True if two arrows begin at the same point and point in opposite directions.
fn opposite(a: &ForceArrow, b: &ForceArrow) -> bool {
    let near = (a.at - b.at).norm() <= 0.5 * a.width;
    near && a.reach().dot(&b.reach()) < 0.0 && side_by_side(a, b).is_some()
}

/// Returns the unit vector to the left of an arrow; `None` for an arrow of length 0.
fn across(arrow: &ForceArrow) -> Option<Vector> {
    let reach = arrow.reach();
    let length = reach.norm();
    (length > 0.0).then(|| Vector::new(-reach.y, reach.x) / length)
}

/// True if two arrows are parallel and closer to each other than the minimum distance of [`side_by_side`].
fn too_close(a: &ForceArrow, b: &ForceArrow) -> bool {
    side_by_side(a, b).is_some_and(|(needed, distance)| distance < needed * (1.0 - CLEAR_TOL))
}

/// Returns the minimum distance that the axes of two parallel arrows need so that the arrows do not overlap, and their
/// actual distance, in metres. Returns `None` if the arrows are not parallel or lie one behind the other.
fn side_by_side(a: &ForceArrow, b: &ForceArrow) -> Option<(f64, f64)> {
    let (u, v) = (a.reach(), b.reach());
    let (long, other) = (u.norm(), v.norm());
    if !(long > 0.0 && other > 0.0) {
        return None;
    }
    let along = u / long;
    let sine = (along.x * v.y - along.y * v.x) / other;
    if sine.abs() > PARALLEL_ANGLE {
        return None;
    }
    let project = |d: Vector| d.dot(&along);
    let from = project(b.at - a.at);
    let sense = project(v).signum();
    let gap = ARROW_GAP * a.width.max(b.width);
    let needed = parts(a)
        .iter()
        .flat_map(|p| parts(b).map(|q| (*p, q)))
        .filter(|(p, q)| {
            let (low, high) = (from + sense * q.0, from + sense * q.1);
            let (low, high) = (low.min(high), low.max(high));
            low < p.1 + gap && high > p.0 - gap
        })
        .map(|(p, q)| p.2 + q.2 + gap)
        .fold(0.0, f64::max);
    let cross = |d: Vector| along.x * d.y - along.y * d.x;
    // The distance of two straight axes is smallest at the beginning or end of their common range.
    let ends = [from.max(0.0).min(long), (from + project(v)).max(0.0).min(long)];
    let distances = ends.map(|at| {
        let share = ((at - from) / project(v)).clamp(0.0, 1.0);
        cross(b.at + v * share - a.at).abs()
    });
    (needed > 0.0).then_some((needed, distances[0].min(distances[1])))
}

/// Returns the shaft and the head of an arrow, each as (begin, end, half width) in metres. Begin and end are distances
/// from the tail along the arrow.
fn parts(arrow: &ForceArrow) -> [(f64, f64, f64); 2] {
    let length = arrow.reach().norm();
    let (long, wide) = head_size(length, arrow.width);
    let neck = length - long;
    let half = (arrow.width / 2.0).min(wide / 2.0 / HEAD_WIDTH);
    [(0.0, neck.max(0.0), half), (neck, length, wide / 2.0)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::analysis::Analysis;
    use crate::mechanics::scene::Scene;
    use crate::products::figure::{Options, marks};

    fn spread(text: &str) -> Vec<ForceArrow> {
        let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
        let analysis = Analysis::new(&scene);
        let options = Options::default();
        let largest = crate::products::figure::mark::largest(&analysis, 0, &options);
        let mut marks = marks(&analysis, 0, &options, largest);
        let before = marks.clone();
        separate_parallel_arrows(&mut marks);
        for (a, b) in marks.arrows.iter().zip(&before.arrows) {
            assert_eq!((a.vector, a.force), (b.vector, b.force));
            // Every arrow stays within a few widths of the line along which the force acts.
            assert!((a.at - b.at).norm() < 12.0 * a.width, "{a:?} {b:?}");
        }
        let overlaps = |arrows: &[ForceArrow]| {
            let pairs = (0..arrows.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs.filter(|(i, j)| too_close(&arrows[*i], &arrows[*j])).count()
        };
        assert!(overlaps(&before.arrows) > 0, "no arrows overlap before");
        assert_eq!(overlaps(&marks.arrows), 0);
        marks.arrows
    }

    #[test]
    fn overlapping_parallel_arrows_are_moved_apart() {
        let arrows = spread(include_str!("../../../tests/scenes/one.json"));
        assert_eq!(arrows.len(), 2);
        assert!((arrows[0].at.x - arrows[1].at.x).abs() > arrows[0].width);
        let mut column =
            String::from(r#"{ "drystone": 1, "ground": [{ "polygon": [[-1,-1],[3,-1],[3,0],[-1,0]] }], "blocks": ["#);
        for y in 0..9 {
            let comma = if y > 0 { "," } else { "" };
            let up = y + 1;
            column.push_str(&format!(r#"{comma}{{ "polygon": [[0,{y}],[2,{y}],[2,{up}],[0,{up}]], "weight": {up} }}"#));
        }
        spread(&(column + "] }"));
        spread(include_str!("../../../tests/scenes/lintel.json"));
        spread(include_str!("../../../tests/scenes/pin.json"));
    }
}
