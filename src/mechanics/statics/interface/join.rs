//! [`join_segments`]: joins contact segments of the same two bodies that continue each other along one line.
//!
//! A corner inside a straight joint divides an edge in two, but must not change the interfaces. A joint may consist
//! of a hundred thousand segments. Their ends are therefore looked up in a grid (spatial hashing) whose cells are as
//! wide as the largest distance of two ends that are joined.

use std::collections::BTreeMap;

use super::{Interface, normal_across};
use crate::geometry::{Point, Tolerance, cross};

/// Two points count as one if their distance is at most this multiple of the contact tolerance: ends of segments on one
/// line, which then continue each other, points at which a corner or a circle touches another body, and the corners at
/// the end of a joint.
///
/// Each end of a segment comes from corners that are displaced by up to the tolerance each. If the multiple were ten
/// times smaller, the segments of one rounded joint would not be joined. If it were ten times larger, the two feet of
/// a body would be joined across the hollow between them. This changes the interfaces that are drawn, but no verdict.
pub(in crate::mechanics) const JOIN_REACH: f64 = 4.0;

/// Segments whose normals differ by more than this, in radians, are not on one line.
///
/// Rounding of coordinates turns normals by 10⁻⁷ or less in scenes of usual size. If the angle were ten times smaller,
/// joints of drawings with seven digits would be split; if it were ten times larger, neighbouring sides of a finely
/// drawn curve would be joined.
const SAME_LINE_TOL: f64 = 1e-6;

/// Joins the contact segments of one pair of bodies that continue each other. Returns the joined segments, and also the
/// segments that were not joined with any other segment.
pub(super) fn join_segments(segments: Vec<Interface>, tolerance: Tolerance) -> Vec<Interface> {
    let mut remaining = SegmentGrid::new(segments, JOIN_REACH * tolerance.gap);
    let mut joined = Vec::new();
    while let Some(mut one) = remaining.take_last() {
        while let Some(other) = remaining.take_neighbour(&one) {
            one.ends = outermost_ends(&one, &other);
            one.normal = normal_across(one.ends);
        }
        joined.push(one);
    }
    joined
}

/// Returns the two outermost ends of two segments, in the order in which the first segment runs.
///
/// All four ends are compared, because it is not known which ends meet if the segments are shorter than the distance
/// within which ends count as equal.
fn outermost_ends(one: &Interface, other: &Interface) -> [Point; 2] {
    let along = one.tangent();
    let place = |p: &Point| along.dot(&(p - one.ends[0]));
    let mut ends = one.ends;
    for p in other.ends {
        if place(&p) < place(&ends[0]) {
            ends[0] = p;
        }
        if place(&p) > place(&ends[1]) {
            ends[1] = p;
        }
    }
    ends
}

/// A cell of the grid, by column and row.
type GridCell = (i64, i64);

/// Segments that are not yet joined, with a grid over their ends.
struct SegmentGrid {
    /// The segments; `None` for those that were removed.
    segments: Vec<Option<Interface>>,
    /// For each cell the indices of the segments that begin in it.
    begins: BTreeMap<GridCell, Vec<usize>>,
    /// For each cell the indices of the segments that end in it.
    ends: BTreeMap<GridCell, Vec<usize>>,
    /// The largest distance of two ends that continue each other, and the width of a cell; metres.
    reach: f64,
}

impl SegmentGrid {
    fn new(segments: Vec<Interface>, reach: f64) -> SegmentGrid {
        let mut grid = SegmentGrid {
            segments: Vec::with_capacity(segments.len()),
            begins: BTreeMap::new(),
            ends: BTreeMap::new(),
            reach,
        };
        for (number, segment) in segments.into_iter().enumerate() {
            let [from, to] = segment.ends.map(|p| grid.cell(p));
            grid.begins.entry(from).or_default().push(number);
            grid.ends.entry(to).or_default().push(number);
            grid.segments.push(Some(segment));
        }
        grid
    }

    /// Returns the grid cell of a point. If `reach` is 0, all points of a quadrant have the same cell. The search is
    /// then slow but correct.
    fn cell(&self, p: Point) -> GridCell {
        let number = |x: f64| (x / self.reach).floor() as i64;
        (number(p.x), number(p.y))
    }

    /// Removes and returns the last remaining segment.
    fn take_last(&mut self) -> Option<Interface> {
        while let Some(last) = self.segments.pop() {
            if last.is_some() {
                return last;
            }
        }
        None
    }

    /// Removes and returns the first segment that continues `one` at either end.
    fn take_neighbour(&mut self, one: &Interface) -> Option<Interface> {
        let behind = self.neighbour(SegmentEnd::Begin, one.ends[1], one);
        let before = self.neighbour(SegmentEnd::End, one.ends[0], one);
        let next = behind.into_iter().chain(before).min()?;
        self.segments.get_mut(next)?.take()
    }

    /// Returns the index of the first segment on the line of `one` that begins or ends (as `end` says) within reach of
    /// the point `p`. `None` if there is no such segment.
    fn neighbour(&mut self, end: SegmentEnd, p: Point, one: &Interface) -> Option<usize> {
        let (x, y) = self.cell(p);
        let (table, which) = match end {
            SegmentEnd::Begin => (&mut self.begins, 0),
            SegmentEnd::End => (&mut self.ends, 1),
        };
        let mut first: Option<usize> = None;
        // A point within reach lies in the same cell or in one of the eight around it.
        for dx in -1..=1 {
            for dy in -1..=1 {
                let cell = (x.saturating_add(dx), y.saturating_add(dy));
                let Some(numbers) = table.get_mut(&cell) else {
                    continue;
                };
                numbers.retain(|n| matches!(self.segments.get(*n), Some(Some(_))));
                let continues = |n: &usize| {
                    let Some(Some(other)) = self.segments.get(*n) else {
                        return false;
                    };
                    let is_collinear =
                        cross(one.normal, other.normal).abs() <= SAME_LINE_TOL && one.normal.dot(&other.normal) > 0.0;
                    is_collinear && (p - other.ends[which]).norm() <= self.reach
                };
                first = first.into_iter().chain(numbers.iter().copied().find(continues)).min();
            }
        }
        first
    }
}

/// Which end of a segment.
#[derive(Clone, Copy)]
enum SegmentEnd {
    Begin,
    End,
}
