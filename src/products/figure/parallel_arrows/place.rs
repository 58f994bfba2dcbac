//! [`BoxGrid`]: stores boxes in a uniform grid (a spatial hash), which finds the boxes near a given box quickly.

use std::collections::HashMap;

use crate::geometry::{Bounds, Point};

/// A box that covers more cells than this is kept in a separate list, which every search scans.
const MAX_CELLS: f64 = 64.0;

/// Boxes, numbered from 0 in the order in which they were added.
pub(super) struct BoxGrid {
    /// Width and height of a cell, metres.
    cell: f64,
    boxes: Vec<Bounds>,
    /// The indices of the boxes that cover each cell.
    cells: HashMap<(i64, i64), Vec<usize>>,
    /// The indices of the boxes that cover more than [`MAX_CELLS`] cells.
    large: Vec<usize>,
}

impl BoxGrid {
    /// Creates an empty grid. The width of a cell is the mean diagonal of `boxes`.
    pub fn sized_for(boxes: impl ExactSizeIterator<Item = Bounds>) -> BoxGrid {
        let count = boxes.len();
        BoxGrid {
            cell: boxes.map(Bounds::diagonal).sum::<f64>() / count as f64,
            boxes: Vec::new(),
            cells: HashMap::new(),
            large: Vec::new(),
        }
    }

    /// Adds a box to the grid. Its index is the number of boxes added before it.
    pub fn put(&mut self, added: Bounds) {
        let number = self.boxes.len();
        self.boxes.push(added);
        match self.covered(added) {
            None => self.large.push(number),
            Some((low, high)) => {
                for cell in grid(low, high) {
                    self.cells.entry(cell).or_default().push(number);
                }
            }
        }
    }

    /// True if `matches` returns true for at least one of the boxes that overlap `near`. `matches` gets the index of a
    /// box, and may be called several times for the same box.
    pub fn any(&self, near: Bounds, mut matches: impl FnMut(usize) -> bool) -> bool {
        let mut tested = |number: &usize| near.intersects(self.boxes[*number]) && matches(*number);
        let Some((low, high)) = self.covered(near) else {
            return (0..self.boxes.len()).any(|number| tested(&number));
        };
        let mut cells = grid(low, high).filter_map(|cell| self.cells.get(&cell));
        self.large.iter().any(&mut tested) || cells.any(|cell| cell.iter().any(&mut tested))
    }

    /// Returns the indices of the boxes that overlap `near`, in ascending order. If `near` is `None`, returns the
    /// indices of all boxes.
    pub fn meeting(&self, near: Option<Bounds>) -> Vec<usize> {
        let Some(near) = near else {
            return (0..self.boxes.len()).collect();
        };
        let mut found = Vec::new();
        self.any(near, |number| {
            found.push(number);
            false
        });
        // A box that covers several cells is found several times.
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns the lower left and the upper right cell that a box covers. Returns `None` if the box covers more than
    /// [`MAX_CELLS`] cells.
    fn covered(&self, bounds: Bounds) -> Option<((i64, i64), (i64, i64))> {
        let cell = |p: Point| ((p.x / self.cell).floor(), (p.y / self.cell).floor());
        let (low, high) = (cell(bounds.min), cell(bounds.max));
        let few = (high.0 - low.0 + 1.0) * (high.1 - low.1 + 1.0) <= MAX_CELLS;
        let whole = |(x, y): (f64, f64)| (x as i64, y as i64);
        few.then(|| (whole(low), whole(high)))
    }
}

fn grid(low: (i64, i64), high: (i64, i64)) -> impl Iterator<Item = (i64, i64)> {
    (low.0..=high.0).flat_map(move |x| (low.1..=high.1).map(move |y| (x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    #[test]
    fn the_grid_finds_the_same_boxes_as_a_linear_search() {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 40) as f64 / f64::from(1 << 24)
        };
        let mut boxes = Vec::new();
        for number in 0..400 {
            let min = Point::new(40.0 * random() - 20.0, 9.0 * random());
            // Some boxes are long, and would cover very many cells.
            let long = if number % 50 == 0 { 300.0 } else { 1.5 };
            let max = min + Vector::new(long * random(), random());
            boxes.push(Bounds { min, max });
        }
        let mut places = BoxGrid::sized_for(boxes.iter().copied());
        for (count, query) in boxes.iter().enumerate() {
            for near in [*query, query.grown(3.0), query.grown(100.0)] {
                let all = (0..count).filter(|n| near.intersects(boxes[*n]));
                assert_eq!(places.meeting(Some(near)), all.collect::<Vec<_>>());
            }
            assert_eq!(places.meeting(None).len(), count);
            places.put(*query);
        }
        let point = Bounds { min: Point::origin(), max: Point::origin() };
        let mut one = BoxGrid::sized_for([point].into_iter());
        one.put(point);
        assert_eq!(one.meeting(Some(point)), [0]);
    }
}
