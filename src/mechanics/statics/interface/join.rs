//! [`join_stretches`]: joins the common stretches of two bodies that continue each other along one line.
//!
//! A corner inside a straight joint divides an edge in two, but must not change the interfaces. A joint may consist of
//! a hundred thousand stretches. Their ends are therefore searched in a grid (spatial hashing) whose cells are as wide
//! as the largest distance of two ends that are joined.

use std::collections::BTreeMap;

use super::{Interface, normal_across};
use crate::geometry::{Point, Tolerance, cross};

/// Two stretches on one line continue each other if their ends lie within this many gaps of each other.
///
/// Each end of a stretch comes from corners that are displaced by up to a gap each. At a tenth, the stretches of one
/// rounded joint would not be joined. At ten times, the two feet of a body would be joined across the hollow between
/// them, which changes no verdict but the interfaces that are drawn.
pub(super) const JOIN_REACH: f64 = 4.0;

/// Stretches whose normals differ by more than this, in radians, are not on one line.
///
/// Rounding of coordinates turns normals by 10⁻⁷ or less in scenes of usual size. A tenth would split joints of
/// drawings with seven digits; ten times this angle would join neighbouring sides of a finely drawn curve.
const SAME_LINE_TOL: f64 = 1e-6;

/// Joins the stretches of one pair of bodies that continue each other. Returns the joined and all other stretches.
pub(super) fn join_stretches(stretches: Vec<Interface>, tolerance: Tolerance) -> Vec<Interface> {
    let mut remaining = StretchGrid::new(stretches, JOIN_REACH * tolerance.gap);
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

/// Returns the two outermost ends of two stretches, in the order along the first stretch.
///
/// All four ends are compared: if the stretches are shorter than the distance within which ends count as equal, it is
/// not known which ends meet.
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

/// Stretches that are not yet joined, with a grid over their ends.
struct StretchGrid {
    /// The stretches; `None` for those that were removed.
    stretches: Vec<Option<Interface>>,
    /// For each cell the indices of the stretches that begin in it.
    begins: BTreeMap<GridCell, Vec<usize>>,
    /// For each cell the indices of the stretches that end in it.
    ends: BTreeMap<GridCell, Vec<usize>>,
    /// The largest distance of two ends that continue each other, and the width of a cell; metres.
    reach: f64,
}

impl StretchGrid {
    fn new(stretches: Vec<Interface>, reach: f64) -> StretchGrid {
        let mut grid = StretchGrid {
            stretches: Vec::with_capacity(stretches.len()),
            begins: BTreeMap::new(),
            ends: BTreeMap::new(),
            reach,
        };
        for (number, stretch) in stretches.into_iter().enumerate() {
            let [from, to] = stretch.ends.map(|p| grid.cell(p));
            grid.begins.entry(from).or_default().push(number);
            grid.ends.entry(to).or_default().push(number);
            grid.stretches.push(Some(stretch));
        }
        grid
    }

    /// Returns the grid cell of a point. If `reach` is 0, all points of a quadrant have the same cell. The search is
    /// then slow but correct.
    fn cell(&self, p: Point) -> GridCell {
        let number = |x: f64| (x / self.reach).floor() as i64;
        (number(p.x), number(p.y))
    }

    /// Removes and returns the last remaining stretch.
    fn take_last(&mut self) -> Option<Interface> {
        while let Some(last) = self.stretches.pop() {
            if last.is_some() {
                return last;
            }
        }
        None
    }

    /// Removes and returns the first stretch that continues `one` at either end.
    fn take_neighbour(&mut self, one: &Interface) -> Option<Interface> {
        let behind = self.neighbour(StretchEnd::Begin, one.ends[1], one);
        let before = self.neighbour(StretchEnd::End, one.ends[0], one);
        let next = behind.into_iter().chain(before).min()?;
        self.stretches.get_mut(next)?.take()
    }

    /// Returns the index of the first stretch on the line of `one` whose end of the given kind lies at `p`. `None` if
    /// there is no such stretch.
    fn neighbour(&mut self, end: StretchEnd, p: Point, one: &Interface) -> Option<usize> {
        let (x, y) = self.cell(p);
        let (table, which) = match end {
            StretchEnd::Begin => (&mut self.begins, 0),
            StretchEnd::End => (&mut self.ends, 1),
        };
        let mut first: Option<usize> = None;
        // A point within reach lies in the same cell or in one of the eight around it.
        for dx in -1..=1 {
            for dy in -1..=1 {
                let cell = (x.saturating_add(dx), y.saturating_add(dy));
                let Some(numbers) = table.get_mut(&cell) else {
                    continue;
                };
                numbers.retain(|n| matches!(self.stretches.get(*n), Some(Some(_))));
                let continues = |n: &usize| {
                    let Some(Some(other)) = self.stretches.get(*n) else {
                        return false;
                    };
                    let is_collinear = cross(one.normal, other.normal).abs() <= SAME_LINE_TOL
                        && one.normal.dot(&other.normal) > 0.0;
                    is_collinear && (p - other.ends[which]).norm() <= self.reach
                };
                first = first
                    .into_iter()
                    .chain(numbers.iter().copied().find(continues))
                    .min();
            }
        }
        first
    }
}

/// Which end of a stretch.
#[derive(Clone, Copy)]
enum StretchEnd {
    Begin,
    End,
}
