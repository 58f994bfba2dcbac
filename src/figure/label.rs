//! Where a block's name has room: the place inside the block that is farthest from its edges, arrows and discs.

use super::arrow::{ForceArrow, Marks};
use super::stage::{DISC, Stage};
use crate::drawing::arrow::{HEAD_LENGTH, HEAD_WIDTH};
use crate::geometry::{Bounds, Point, Polygon, Vector};
use crate::scene::{BlockId, Frame};

/// Above so many blocks in a frame names would be soup.
const MOST_BLOCKS: usize = 60;
/// Places tried along each axis of a block.
const TRIED: usize = 13;

/// A place for the name of each placed block, in placing order: where a bar about it is clear whose half
/// length between its round ends and whose radius, both in metres, `room(block)` tells; `None` where nowhere is.
pub(crate) fn places(
    stage: &Stage<'_>,
    frame: &Frame,
    marks: &Marks,
    room: impl Fn(BlockId) -> (f64, f64),
) -> Vec<Option<Point>> {
    if frame.placed.len() > MOST_BLOCKS {
        return vec![None; frame.placed.len()];
    }
    let discs: Vec<Point> = frame.holds.iter().map(|h| h.at).collect();
    let place = |id: &BlockId| {
        let polygon = &stage.analysis.scene.blocks[id.0].body.polygon;
        let (half, needed) = room(*id);
        let near = polygon.bounds().grown(2.0 * stage.unit);
        let arrows: Vec<&ForceArrow> = marks
            .arrows
            .iter()
            .filter(|a| near.meets(reach(a)))
            .collect();
        let clear_at = |p: Point| {
            if !polygon.contains(p) {
                return f64::NEG_INFINITY;
            }
            let from_discs = discs.iter().map(|d| (p - d).norm() - DISC * stage.unit);
            let from_turns = marks
                .turns
                .iter()
                .map(|t| (p - t.at).norm() - 0.65 * stage.unit);
            let from_arrows = arrows.iter().map(|a| from_arrow(a, p));
            from_discs
                .chain(from_turns)
                .chain(from_arrows)
                .fold(from_edges(polygon, p), f64::min)
        };
        // The middle first, then outwards, and no further once it is too narrow: most places fail at once.
        let clear = |p: Point| {
            let mut least = f64::INFINITY;
            for share in [0.0, -1.0, 1.0, -0.5, 0.5] {
                least = least.min(clear_at(p + Vector::new(half * share, 0.0)));
                if least < needed {
                    return f64::NEG_INFINITY;
                }
            }
            least
        };
        // Room beyond what is comfortable counts for nothing, so that names keep near the middle.
        let middle = stage.analysis.scene.blocks[id.0].centroid;
        let score = |p: Point| clear(p).min(1.6 * needed) - 0.05 * (p - middle).norm();
        let best =
            candidates(polygon)
                .into_iter()
                .map(|p| (score(p), p))
                .fold(None, |best, next| match best {
                    Some((score, _)) if score >= next.0 => best,
                    _ => Some(next),
                });
        best.filter(|(score, _)| score.is_finite()).map(|(_, p)| p)
    };
    frame.placed.iter().map(place).collect()
}

fn candidates(polygon: &Polygon) -> Vec<Point> {
    let bounds = polygon.bounds();
    let share = |i: usize| (i as f64 + 0.5) / TRIED as f64;
    let mut points = Vec::new();
    for row in 0..TRIED {
        for column in 0..TRIED {
            let x = bounds.min.x + bounds.width() * share(column);
            let y = bounds.min.y + bounds.height() * share(row);
            let p = Point::new(x, y);
            if polygon.contains(p) {
                points.push(p);
            }
        }
    }
    points
}

fn from_edges(polygon: &Polygon, p: Point) -> f64 {
    polygon
        .edges()
        .map(|e| from_segment(e.from, e.to, p))
        .fold(f64::INFINITY, f64::min)
}

/// How far a point is from an arrow's ink, metres; below 0 inside it.
pub(crate) fn from_arrow(arrow: &ForceArrow, p: Point) -> f64 {
    let end = arrow.at + arrow.vector;
    let tip = end + arrow.vector.normalize() * (HEAD_LENGTH * arrow.width);
    let shaft = from_segment(arrow.at, end, p) - arrow.width / 2.0;
    // The head is a wedge; half its width around its axis covers it.
    let head = from_segment(end, tip, p) - HEAD_WIDTH * arrow.width / 3.0;
    shaft.min(head)
}

fn from_segment(a: Point, b: Point, p: Point) -> f64 {
    let along = b - a;
    let length = along.norm_squared();
    let share = if length > 0.0 {
        ((p - a).dot(&along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - (a + along * share)).norm()
}

fn reach(arrow: &ForceArrow) -> Bounds {
    let tip = arrow.at + arrow.vector;
    Bounds {
        min: arrow.at.inf(&tip),
        max: arrow.at.sup(&tip),
    }
}
