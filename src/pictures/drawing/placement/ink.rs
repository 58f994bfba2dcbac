//! [`Ink`]: convex shapes that labels must not cover. The shapes are stored in a uniform grid, so that the test of a
//! position only checks nearby shapes.
//!
//! Two convex pieces are disjoint exactly if a side of one of them separates them (the separating axis theorem). A
//! figure tests hundreds of positions for each label. Therefore a test allocates no memory, and each side stores the
//! projection of its piece onto the normal of the side.

use core::f64::consts::TAU;

use super::{Placed, corners};
use crate::pictures::drawing::arrow::head_size;
use crate::pictures::drawing::{PagePoint, PageRect};

/// Convex pieces that labels must not cover.
#[derive(Clone, Debug, Default)]
pub struct Ink {
    pieces: Vec<ConvexPiece>,
    /// Corners of all pieces, one piece after the other.
    corners: Vec<PagePoint>,
    /// The side that begins at each of the corners.
    sides: Vec<ConvexSide>,
    /// The grid, once [`Ink::index`] has built it.
    grid: Option<Grid>,
}

#[derive(Clone, Copy, Debug)]
struct ConvexPiece {
    /// Whether the piece is a label or a leader of a label. Other leaders should not cross such a piece.
    is_label: bool,
    /// The range of its corners and sides in the lists of [`Ink`].
    first: usize,
    end: usize,
    min: PagePoint,
    max: PagePoint,
}

impl Ink {
    /// Adds a convex shape. `corners` contains the corners of the shape in order around it. Two corners give a line of
    /// width 0.
    pub fn convex(&mut self, corners: impl IntoIterator<Item = PagePoint>) {
        self.piece(corners, false);
    }

    fn piece(&mut self, corners: impl IntoIterator<Item = PagePoint>, is_label: bool) {
        let first = self.corners.len();
        self.corners.extend(corners);
        let own = &self.corners[first..];
        let Some(&start) = own.first() else { return };
        let (mut min, mut max) = (start, start);
        for p in own {
            min = PagePoint::new(min.x.min(p.x), min.y.min(p.y));
            max = PagePoint::new(max.x.max(p.x), max.y.max(p.y));
        }
        for (i, corner) in own.iter().enumerate() {
            let next = own.get(i + 1).copied().unwrap_or(start);
            self.sides.push(ConvexSide::new(*corner, next, own));
        }
        let piece = ConvexPiece { is_label, first, end: self.corners.len(), min, max };
        if let Some(grid) = &mut self.grid {
            grid.add(self.pieces.len(), &piece);
        }
        self.pieces.push(piece);
    }

    /// Builds the grid of all shapes added so far, if there is none. Shapes that are added later enter the grid too.
    /// With the grid, [`place`](super::place) tests positions faster.
    pub fn index(&mut self) {
        if self.grid.is_none() {
            self.grid = Some(Grid::new(&self.pieces));
        }
    }

    /// True if `matches` is true for a piece whose bounding box overlaps the box from `min` to `max`. The search stops
    /// at the first such piece, and `matches` is called at most once for each piece.
    fn any_near(&self, min: PagePoint, max: PagePoint, mut matches: impl FnMut(&ConvexPiece) -> bool) -> bool {
        let mut tested = |piece: &ConvexPiece| {
            piece.min.x < max.x && piece.max.x > min.x && piece.min.y < max.y && piece.max.y > min.y && matches(piece)
        };
        let Some(grid) = &self.grid else {
            return self.pieces.iter().any(tested);
        };
        let cells = grid.cells(min, max);
        for y in cells.top..=cells.bottom {
            for x in cells.left..=cells.right {
                for entry in &grid.lists[y * grid.columns + x] {
                    // A piece that is in several cells is tested only once: in the first cell that both the piece and
                    // the box touch.
                    let first = x == cells.left.max(entry.left) && y == cells.top.max(entry.top);
                    if first && tested(&self.pieces[entry.number]) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Adds a line that is `width` pixels wide. A line of length 0 is ignored.
    pub fn line(&mut self, from: PagePoint, to: PagePoint, width: f64) {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let length = libm::hypot(dx, dy);
        if length.is_nan() || length <= 0.0 {
            return;
        }
        let (x, y) = (-dy / length * width / 2.0, dx / length * width / 2.0);
        self.convex([from.moved(x, y), to.moved(x, y), to.moved(-x, -y), from.moved(-x, -y)]);
    }

    /// Adds a disc. The disc is stored as the regular octagon around it.
    pub fn disc(&mut self, centre: PagePoint, radius: f64) {
        let corner_radius = radius / libm::cos(TAU / 16.0);
        let corner = |i: u32| {
            let angle = TAU * (f64::from(i) + 0.5) / 8.0;
            centre.moved(corner_radius * libm::cos(angle), corner_radius * libm::sin(angle))
        };
        self.convex((0..8).map(corner));
    }

    /// Adds the arrow that [`arrow::straight`](crate::pictures::drawing::arrow::straight) draws.
    pub fn arrow(&mut self, from: PagePoint, along: (f64, f64), width: f64) {
        let length = libm::hypot(along.0, along.1);
        if length.is_nan() || length <= 0.0 {
            return;
        }
        let (ux, uy) = (along.0 / length, along.1 / length);
        let (long, wide) = head_size(length, width);
        let (neck, half) = (length - long, wide / 2.0);
        let end = from.moved(ux * neck, uy * neck);
        self.line(from, end, width);
        self.convex([
            end.moved(-uy * half, ux * half),
            end.moved(ux * long, uy * long),
            end.moved(uy * half, -ux * half),
        ]);
    }

    /// Adds a rectangle.
    pub fn rect(&mut self, rect: PageRect) {
        self.convex(corners(rect));
    }

    /// Adds a label and its leader line. Leader lines of other labels should cross neither the label nor its line. Does
    /// nothing for `None`.
    pub(super) fn add_label(&mut self, placed: Option<&Placed>) {
        let Some(placed) = placed else { return };
        self.piece(corners(placed.rect), true);
        if let Some(leader) = placed.leader {
            self.piece(leader, true);
        }
    }

    /// True if the rectangle does not overlap any ink.
    pub fn clear(&self, rect: PageRect) -> bool {
        let (min, max) = (rect.at, rect.at.moved(rect.width, rect.height));
        // `any_near` calls `meets` only for pieces whose bounding box overlaps the rectangle. No side of the rectangle
        // separates such a piece from the rectangle, so only the sides of the piece must be tested.
        let meets = |piece: &ConvexPiece| {
            let sides = &self.sides[piece.first..piece.end];
            !sides.iter().any(|side| side.separates_box(min, max))
        };
        !self.any_near(min, max, meets)
    }

    /// Returns the number of labels and leader lines that the line between two points crosses, and the number of other
    /// pieces of ink that it crosses.
    pub(super) fn crossed(&self, from: PagePoint, to: PagePoint) -> (usize, usize) {
        let (min, max) =
            (PagePoint::new(from.x.min(to.x), from.y.min(to.y)), PagePoint::new(from.x.max(to.x), from.y.max(to.y)));
        let (mut labels, mut others) = (0, 0);
        self.any_near(min, max, |piece| {
            let sides = &self.sides[piece.first..piece.end];
            let line = [from, to];
            if !sides.iter().any(|side| side.separates(&line))
                && !separated(&line, &self.corners[piece.first..piece.end])
            {
                let count = if piece.is_label { &mut labels } else { &mut others };
                *count += 1;
            }
            false
        });
        (labels, others)
    }
}

/// Pieces that overlap by less than this, pixels, only touch. The tolerance is far above rounding errors, which must
/// not decide a position, and far below any visible overlap.
const TOUCH_TOL: f64 = 1e-3;

/// A side of a convex piece, and the projection of the piece onto its normal.
#[derive(Clone, Copy, Debug)]
struct ConvexSide {
    from: PagePoint,
    along: (f64, f64),
    /// The least and the greatest [`ConvexSide::offset`] of the piece's corners.
    own: (f64, f64),
    /// [`TOUCH_TOL`] times the length of the side, to compare with offsets.
    touch: f64,
}

impl ConvexSide {
    fn new(from: PagePoint, to: PagePoint, piece: &[PagePoint]) -> ConvexSide {
        let along = (to.x - from.x, to.y - from.y);
        let side = ConvexSide { from, along, own: (0.0, 0.0), touch: TOUCH_TOL * libm::hypot(along.0, along.1) };
        ConvexSide { own: side.offset_range(piece), ..side }
    }

    /// Returns the signed distance of a point from the line through this side, multiplied by the length of the side.
    fn offset(&self, p: PagePoint) -> f64 {
        self.along.0 * (p.y - self.from.y) - self.along.1 * (p.x - self.from.x)
    }

    /// Returns the least and the greatest [`ConvexSide::offset`] of the points.
    fn offset_range(&self, points: &[PagePoint]) -> (f64, f64) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in points {
            let side = self.offset(*p);
            (low, high) = (low.min(side), high.max(side));
        }
        (low, high)
    }

    /// True if the line through this side separates its piece from these points.
    fn separates(&self, others: &[PagePoint]) -> bool {
        self.is_disjoint(self.offset_range(others))
    }

    /// True if the line through this side separates its piece from the box from `min` to `max`.
    fn separates_box(&self, min: PagePoint, max: PagePoint) -> bool {
        // One corner of the box has the least offset, and another the greatest. The direction of the side determines
        // which corners.
        let (below, above) = if self.along.0 >= 0.0 { (min.y, max.y) } else { (max.y, min.y) };
        let (right, left) = if self.along.1 >= 0.0 { (max.x, min.x) } else { (min.x, max.x) };
        let least = self.offset(PagePoint::new(right, below));
        let most = self.offset(PagePoint::new(left, above));
        self.is_disjoint((least, most))
    }

    /// True if the range of offsets of the piece and the range `other` are disjoint, or overlap by at most
    /// [`TOUCH_TOL`].
    fn is_disjoint(&self, other: (f64, f64)) -> bool {
        self.own.1 <= other.0 + self.touch || other.1 <= self.own.0 + self.touch
    }
}

/// True if the line through a side of the convex polygon `piece` separates the polygon from the points `others`.
pub(super) fn separated(piece: &[PagePoint], others: &[PagePoint]) -> bool {
    (0..piece.len()).any(|i| {
        let next = piece[(i + 1) % piece.len()];
        ConvexSide::new(piece[i], next, piece).separates(others)
    })
}

/// Side of a cell of the grid, pixels: about the size of a label.
const CELL_SIDE: f64 = 48.0;

/// The numbers of the pieces in each cell of a uniform grid.
#[derive(Clone, Debug)]
struct Grid {
    /// The numbers of the first column and of the first row, counted in cells from the corner of the page.
    left: f64,
    top: f64,
    columns: usize,
    rows: usize,
    /// Row by row, the pieces that touch each cell.
    lists: Vec<Vec<Entry>>,
}

/// A piece in a cell. `left` and `top` are the first column and row that the piece touches.
#[derive(Clone, Copy, Debug)]
struct Entry {
    number: usize,
    left: usize,
    top: usize,
}

/// The cells that a box touches: columns and rows, both ends included.
struct Cells {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Grid {
    fn new(pieces: &[ConvexPiece]) -> Grid {
        // Limit the size of the grid: a page is only a few thousand pixels wide. Pieces far outside the page share the
        // outermost cells.
        let cell = |v: f64| (v / CELL_SIDE).floor().clamp(-20.0, 200.0);
        let ends = |ends: (f64, f64), min: f64, max: f64| (ends.0.min(cell(min)), ends.1.max(cell(max)));
        let (mut x, mut y) = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
        for piece in pieces {
            x = ends(x, piece.min.x, piece.max.x);
            y = ends(y, piece.min.y, piece.max.y);
        }
        // Without pieces, the ranges are empty, and the grid has one cell.
        let count = |(first, last): (f64, f64)| ((last - first).max(0.0) as usize) + 1;
        let first = |(first, _): (f64, f64)| if first.is_finite() { first } else { 0.0 };
        let mut grid = Grid {
            left: first(x),
            top: first(y),
            columns: count(x),
            rows: count(y),
            lists: vec![Vec::new(); count(x) * count(y)],
        };
        for (number, piece) in pieces.iter().enumerate() {
            grid.add(number, piece);
        }
        grid
    }

    fn add(&mut self, number: usize, piece: &ConvexPiece) {
        let Cells { left, right, top, bottom } = self.cells(piece.min, piece.max);
        for y in top..=bottom {
            for x in left..=right {
                self.lists[y * self.columns + x].push(Entry { number, left, top });
            }
        }
    }

    /// Returns the cells that the box from `min` to `max` touches. A part of the box outside the grid belongs to the
    /// nearest cells of the grid.
    fn cells(&self, min: PagePoint, max: PagePoint) -> Cells {
        let cell =
            |v: f64, first: f64, count: usize| (((v / CELL_SIDE).floor() - first).max(0.0) as usize).min(count - 1);
        Cells {
            left: cell(min.x, self.left, self.columns),
            right: cell(max.x, self.left, self.columns),
            top: cell(min.y, self.top, self.rows),
            bottom: cell(max.y, self.top, self.rows),
        }
    }
}

#[cfg(test)]
mod tests;
