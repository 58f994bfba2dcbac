//! [`chains`]: joins open curves whose ends meet into loops.
//!
//! 1. Number the points at the ends of all curves. Ends within the tolerance are the same point.
//! 2. If exactly two ends meet at a point, their curves are connected.
//! 3. Follow the connections. A walk that returns to its start is a loop. Other curves remain open.

use std::collections::BTreeMap;

use crate::geometry::Point;
use crate::sources::import::subpath::{Segment, Subpath};

/// An open curve, with text that describes its entity to the user.
#[derive(Clone, Debug)]
pub(super) struct OpenCurve {
    pub(super) curve: Subpath,
    pub(super) element: String,
}

/// The loops of a layer, and the curves that belong to no loop.
#[derive(Debug, Default)]
pub(super) struct Chains {
    /// The loops, each with the description of its first curve.
    pub(super) loops: Vec<(Subpath, String)>,
    pub(super) left: Vec<OpenCurve>,
    /// The first point where more than two ends of curves meet; `None` if there is no such point.
    pub(super) branch: Option<Point>,
}

/// Joins curves into loops where their ends are at most `tolerance` apart. `tolerance` has the unit of the curves.
pub(super) fn chains(curves: Vec<OpenCurve>, tolerance: f64) -> Chains {
    let mut chains = Chains::default();
    let (points, places) = numbered(&curves, tolerance);
    // Step 2: list the curves that start or end at each point. An entry is the index of a curve, and true if the curve
    // ends there.
    let mut ends: Vec<Vec<(usize, bool)>> = vec![Vec::new(); places.len()];
    for (i, [start, end]) in points.iter().enumerate() {
        ends[*start].push((i, false));
        ends[*end].push((i, true));
    }
    chains.branch = (0..places.len()).find(|p| ends[*p].len() > 2).map(|p| places[p]);
    let mut used = vec![false; curves.len()];
    for first in 0..curves.len() {
        if used[first] {
            continue;
        }
        let Some(walk) = walk(first, &points, &ends) else {
            continue;
        };
        let mut joined = curves[first].curve.clone();
        for &(i, is_backwards) in &walk[1..] {
            let next = if is_backwards { curves[i].curve.reversed() } else { curves[i].curve.clone() };
            joined.segments.extend(next.segments);
        }
        joined.closed = true;
        for (i, _) in walk {
            used[i] = true;
        }
        chains.loops.push((joined, curves[first].element.clone()));
    }
    let unused = curves.into_iter().zip(used).filter(|(_, used)| !used);
    chains.left = unused.map(|(curve, _)| curve).collect();
    chains
}

/// Follows connected curves from the curve `first` until they return to its start (step 3). Returns the loop as the
/// index of each curve, and whether the curve is reversed. `None` if the curves form no loop.
fn walk(first: usize, points: &[[usize; 2]], ends: &[Vec<(usize, bool)>]) -> Option<Vec<(usize, bool)>> {
    let mut walk = vec![(first, false)];
    let mut at = points[first][1];
    while at != points[first][0] {
        let (last, _) = walk[walk.len() - 1];
        let [one, other] = ends[at].as_slice() else {
            return None;
        };
        let (next, is_end) = if one.0 == last { *other } else { *one };
        if next == last || walk.len() > points.len() {
            return None;
        }
        walk.push((next, is_end));
        at = points[next][usize::from(!is_end)];
    }
    // If more than two curves meet at the start, the loop is ambiguous.
    (ends[at].len() == 2).then_some(walk)
}

/// Numbers the end points of all curves; points within `tolerance` get the same number (step 1). Returns the numbers of
/// the start and end point of each curve, and the list of points.
fn numbered(curves: &[OpenCurve], tolerance: f64) -> (Vec<[usize; 2]>, Vec<Point>) {
    let mut places: Vec<Point> = Vec::new();
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    let size = 2.0 * tolerance;
    let mut number = |point: Point| {
        let cell = [point.x, point.y].map(|c| (c / size).floor() as i64);
        for dx in -1..=1 {
            for dy in -1..=1 {
                let key = [cell[0].saturating_add(dx), cell[1].saturating_add(dy)];
                let near = |i: &&usize| (places[**i] - point).norm() <= tolerance;
                if let Some(place) = cells.get(&key).and_then(|list| list.iter().find(near)) {
                    return *place;
                }
            }
        }
        places.push(point);
        cells.entry(cell).or_default().push(places.len() - 1);
        places.len() - 1
    };
    let ends = |curve: &OpenCurve| {
        let curve = &curve.curve;
        [curve.start, curve.segments.last().map_or(curve.start, Segment::end)]
    };
    let numbers = curves.iter().map(|curve| ends(curve).map(&mut number)).collect();
    (numbers, places)
}
