//! [`Ink`]: what labels keep clear of, sorted so that a place is tried by looking at what lies about it alone.
//!
//! A figure tries hundreds of places for each of its labels: nothing is allocated for one of them, and what a piece has to
//! be asked about is worked out when it is added.

use core::f64::consts::TAU;

use super::{Placed, corners};
use crate::drawing::arrow::head_size;
use crate::drawing::{PagePoint, PageRect};

/// Ink that labels must keep clear of: convex pieces.
#[derive(Clone, Debug, Default)]
pub struct Ink {
    pieces: Vec<Piece>,
    /// Corners of all pieces, one piece's after the other's.
    corners: Vec<PagePoint>,
    /// The side that begins at each of the corners.
    sides: Vec<Side>,
    /// Which pieces lie where, once that is wanted.
    raster: Option<Raster>,
}

#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Whether it is a label, which a leader that crosses it would strike out, or a leader, which one could take for it.
    is_label: bool,
    /// Its corners and sides, by their numbers.
    first: usize,
    end: usize,
    min: PagePoint,
    max: PagePoint,
}

impl Ink {
    /// A convex piece with these corners in order; two corners are a line without width.
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
            self.sides.push(Side::new(*corner, next, own));
        }
        let piece = Piece {
            is_label,
            first,
            end: self.corners.len(),
            min,
            max,
        };
        if let Some(raster) = &mut self.raster {
            raster.add(self.pieces.len(), &piece);
        }
        self.pieces.push(piece);
    }

    /// Sorts the pieces into a raster, so that the many questions of [`place`](super::place) look at those nearby alone.
    pub fn index(&mut self) {
        if self.raster.is_none() {
            self.raster = Some(Raster::new(&self.pieces));
        }
    }

    /// Whether any piece whose box meets a box is `wanted`; each is asked about once.
    fn any_near(
        &self,
        min: PagePoint,
        max: PagePoint,
        mut wanted: impl FnMut(&Piece) -> bool,
    ) -> bool {
        let mut asked = |piece: &Piece| {
            piece.min.x < max.x
                && piece.max.x > min.x
                && piece.min.y < max.y
                && piece.max.y > min.y
                && wanted(piece)
        };
        let Some(raster) = &self.raster else {
            return self.pieces.iter().any(asked);
        };
        let fields = raster.fields(min, max);
        for y in fields.top..=fields.bottom {
            for x in fields.left..=fields.right {
                for entry in &raster.lists[y * raster.columns + x] {
                    // A piece in several fields is met in the first of those that the box touches, too.
                    let met = x == fields.left.max(entry.left) && y == fields.top.max(entry.top);
                    if met && asked(&self.pieces[entry.number]) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// A line `width` pixels wide.
    pub fn line(&mut self, from: PagePoint, to: PagePoint, width: f64) {
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let length = libm::hypot(dx, dy);
        if length.is_nan() || length <= 0.0 {
            return;
        }
        let (x, y) = (-dy / length * width / 2.0, dx / length * width / 2.0);
        self.convex([
            from.moved(x, y),
            to.moved(x, y),
            to.moved(-x, -y),
            from.moved(-x, -y),
        ]);
    }

    /// A disc, as the octagon around it.
    pub fn disc(&mut self, centre: PagePoint, radius: f64) {
        let reach = radius / libm::cos(TAU / 16.0);
        let corner = |i: u32| {
            let angle = TAU * (f64::from(i) + 0.5) / 8.0;
            centre.moved(reach * libm::cos(angle), reach * libm::sin(angle))
        };
        self.convex((0..8).map(corner));
    }

    /// The arrow that [`arrow::straight`](crate::drawing::arrow::straight) draws.
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

    /// An upright rectangle.
    pub fn rect(&mut self, rect: PageRect) {
        self.convex(corners(rect));
    }

    /// A label and its leader, neither of which another leader should cross.
    pub(super) fn placed(&mut self, placed: Option<&Placed>) {
        let Some(placed) = placed else { return };
        self.piece(corners(placed.rect), true);
        if let Some(leader) = placed.leader {
            self.piece(leader, true);
        }
    }

    /// Whether an upright rectangle lies clear of all ink.
    pub fn clear(&self, rect: PageRect) -> bool {
        let (min, max) = (rect.at, rect.at.moved(rect.width, rect.height));
        // The rectangle's own sides part nothing: the boxes overlap.
        let meets = |piece: &Piece| {
            let sides = &self.sides[piece.first..piece.end];
            !sides.iter().any(|side| side.parts_box(min, max))
        };
        !self.any_near(min, max, meets)
    }

    /// How many labels and how many other pieces a line touches.
    pub(super) fn crossed(&self, from: PagePoint, to: PagePoint) -> (usize, usize) {
        let (min, max) = (
            PagePoint::new(from.x.min(to.x), from.y.min(to.y)),
            PagePoint::new(from.x.max(to.x), from.y.max(to.y)),
        );
        let (mut labels, mut others) = (0, 0);
        self.any_near(min, max, |piece| {
            let sides = &self.sides[piece.first..piece.end];
            let line = [from, to];
            if !sides.iter().any(|side| side.parts(&line))
                && !parted(&line, &self.corners[piece.first..piece.end])
            {
                let count = if piece.is_label {
                    &mut labels
                } else {
                    &mut others
                };
                *count += 1;
            }
            false
        });
        (labels, others)
    }
}

/// Pieces that reach into each other by less than this, pixels, touch: what rounding decides must not choose a place.
const TOUCH: f64 = 1e-3;

/// A side of a convex piece, and how far the piece reaches to either side of it.
#[derive(Clone, Copy, Debug)]
struct Side {
    from: PagePoint,
    along: (f64, f64),
    /// Of the piece's corners, the least and the greatest of [`Side::beside`].
    own: (f64, f64),
    /// What [`TOUCH`] is in that measure.
    touch: f64,
}

impl Side {
    fn new(from: PagePoint, to: PagePoint, piece: &[PagePoint]) -> Side {
        let along = (to.x - from.x, to.y - from.y);
        let side = Side {
            from,
            along,
            own: (0.0, 0.0),
            touch: TOUCH * libm::hypot(along.0, along.1),
        };
        Side {
            own: side.reach(piece),
            ..side
        }
    }

    /// How far a point lies beside it, times its length: positive to the left on a page whose y runs up.
    fn beside(&self, p: PagePoint) -> f64 {
        self.along.0 * (p.y - self.from.y) - self.along.1 * (p.x - self.from.x)
    }

    fn reach(&self, points: &[PagePoint]) -> (f64, f64) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in points {
            let side = self.beside(*p);
            (low, high) = (low.min(side), high.max(side));
        }
        (low, high)
    }

    /// Whether it parts its piece from some points.
    fn parts(&self, others: &[PagePoint]) -> bool {
        self.apart(self.reach(others))
    }

    /// Whether it parts its piece from an upright box.
    fn parts_box(&self, min: PagePoint, max: PagePoint) -> bool {
        // The corners at which `beside` is least and greatest follow from the direction of the side.
        let (below, above) = if self.along.0 >= 0.0 {
            (min.y, max.y)
        } else {
            (max.y, min.y)
        };
        let (right, left) = if self.along.1 >= 0.0 {
            (max.x, min.x)
        } else {
            (min.x, max.x)
        };
        let least = self.beside(PagePoint::new(right, below));
        let most = self.beside(PagePoint::new(left, above));
        self.apart((least, most))
    }

    fn apart(&self, other: (f64, f64)) -> bool {
        self.own.1 <= other.0 + self.touch || other.1 <= self.own.0 + self.touch
    }
}

/// Whether a side of the convex `piece` parts it from the others.
pub(super) fn parted(piece: &[PagePoint], others: &[PagePoint]) -> bool {
    (0..piece.len()).any(|i| {
        let next = piece[(i + 1) % piece.len()];
        Side::new(piece[i], next, piece).parts(others)
    })
}

/// Side of a field of the raster, pixels.
const FIELD: f64 = 48.0;

/// The numbers of the pieces in each field of a grid.
#[derive(Clone, Debug)]
struct Raster {
    /// Number of the first column and row, in fields from the page's corner.
    left: f64,
    top: f64,
    columns: usize,
    rows: usize,
    /// Row by row, what touches each field.
    lists: Vec<Vec<Entry>>,
}

/// A piece in a field, and the first column and row of its own fields.
#[derive(Clone, Copy, Debug)]
struct Entry {
    number: usize,
    left: usize,
    top: usize,
}

/// The fields that a box touches: columns and rows, all included.
struct Fields {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Raster {
    fn new(pieces: &[Piece]) -> Raster {
        // A page has some thousand pixels; what lies far beyond it shares the last fields.
        let field = |v: f64| (v / FIELD).floor().clamp(-20.0, 200.0);
        let ends =
            |ends: (f64, f64), min: f64, max: f64| (ends.0.min(field(min)), ends.1.max(field(max)));
        let (mut x, mut y) = (
            (f64::INFINITY, f64::NEG_INFINITY),
            (f64::INFINITY, f64::NEG_INFINITY),
        );
        for piece in pieces {
            x = ends(x, piece.min.x, piece.max.x);
            y = ends(y, piece.min.y, piece.max.y);
        }
        // Of no pieces there is one field.
        let count = |(first, last): (f64, f64)| ((last - first).max(0.0) as usize) + 1;
        let first = |(first, _): (f64, f64)| if first.is_finite() { first } else { 0.0 };
        let mut raster = Raster {
            left: first(x),
            top: first(y),
            columns: count(x),
            rows: count(y),
            lists: vec![Vec::new(); count(x) * count(y)],
        };
        for (number, piece) in pieces.iter().enumerate() {
            raster.add(number, piece);
        }
        raster
    }

    fn add(&mut self, number: usize, piece: &Piece) {
        let Fields {
            left,
            right,
            top,
            bottom,
        } = self.fields(piece.min, piece.max);
        for y in top..=bottom {
            for x in left..=right {
                self.lists[y * self.columns + x].push(Entry { number, left, top });
            }
        }
    }

    /// The fields that a box touches; what lies beyond the grid belongs to the fields at its edge.
    fn fields(&self, min: PagePoint, max: PagePoint) -> Fields {
        let field = |v: f64, first: f64, count: usize| {
            (((v / FIELD).floor() - first).max(0.0) as usize).min(count - 1)
        };
        Fields {
            left: field(min.x, self.left, self.columns),
            right: field(max.x, self.left, self.columns),
            top: field(min.y, self.top, self.rows),
            bottom: field(max.y, self.top, self.rows),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_a_raster_and_without_the_answers_are_the_same() {
        // Lines, discs and labels strewn over a page and beyond it, by a rule without a pattern to the eye.
        let mut plain = Ink::default();
        let mut seed = 1_u64;
        let mut next = |most: f64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 * most
        };
        let mut late = Vec::new();
        for i in 0..60 {
            let from = PagePoint::new(next(600.0) - 100.0, next(400.0) - 100.0);
            match i % 3 {
                0 => plain.line(
                    from,
                    from.moved(next(300.0) - 150.0, next(200.0) - 100.0),
                    2.0,
                ),
                1 => plain.disc(from, 1.0 + next(8.0)),
                _ => late.push(PageRect {
                    at: from,
                    width: 1.0 + next(60.0),
                    height: 12.0,
                }),
            }
        }
        let mut sorted = plain.clone();
        sorted.index();
        for (i, rect) in late.into_iter().enumerate() {
            let placed = Placed {
                disliked: false,
                rect,
                leader: (i % 2 == 0).then(|| [rect.at, rect.at.moved(-70.0, 30.0)]),
            };
            plain.placed(Some(&placed));
            sorted.placed(Some(&placed));
        }
        let (mut clear, mut crossed) = (0, 0);
        for _ in 0..4000 {
            let at = PagePoint::new(next(700.0) - 150.0, next(500.0) - 150.0);
            let rect = PageRect {
                at,
                width: 1.0 + next(40.0),
                height: 1.0 + next(12.0),
            };
            assert_eq!(plain.clear(rect), sorted.clear(rect), "{rect:?}");
            // A box is a piece like any other: asked corner by corner it meets the same ones.
            let meets = |p: &Piece| !parted(&plain.corners[p.first..p.end], &corners(rect));
            let max = at.moved(rect.width, rect.height);
            assert_eq!(
                !plain.any_near(at, max, meets),
                plain.clear(rect),
                "{rect:?}"
            );
            clear += usize::from(plain.clear(rect));
            let to = at.moved(next(200.0) - 100.0, next(200.0) - 100.0);
            let all = plain.crossed(at, to);
            assert_eq!(all, sorted.crossed(at, to), "{at:?} {to:?}");
            crossed += all.0.min(all.1);
        }
        assert!(
            (1000..3500).contains(&clear) && crossed > 100,
            "{clear}, {crossed}"
        );
    }
}
