//! [`place`]: where labels have room. None lies on ink, on another label, or off its page.
//!
//! Each label wants to be near its anchor. Places that its maker prefers are tried first, then rings about the anchor,
//! wider and wider; a label that ends up apart from what it names gets a leader line. Labels are placed in the order
//! given, the most important first; one for which no place is clear is left out.

mod untangle;

use core::f64::consts::TAU;
use std::collections::BTreeMap;

use super::arrow::head_size;
use super::{PagePoint, PageRect};

/// Rings tried about an anchor.
const RINGS: usize = 60;
/// Places tried on each ring.
const AROUND: usize = 24;
/// Clear room kept around a label, pixels.
const ROOM: f64 = 1.5;
/// A label whose nearest point is farther than this beyond the first ring gets a leader line, pixels.
const NEAR: f64 = 6.0;
/// A leader that crosses ink counts as so many pixels of distance.
const CROSSING: f64 = 14.0;

/// A leader that crosses a label, for want of another place, counts as so many pixels of distance: more than any way.
const STRUCK: f64 = 1000.0;

/// Places whose costs differ by less than so many pixels are equally good.
const TIE: f64 = 1e-3;

/// A place that is not liked counts as so many pixels of distance.
const DISLIKED: f64 = 110.0;

/// Ink that labels must keep clear of: convex pieces.
#[derive(Clone, Debug, Default)]
pub struct Ink {
    pieces: Vec<Piece>,
    /// The numbers of the pieces in each field of a raster, once there is one.
    raster: Option<BTreeMap<(i64, i64), Vec<usize>>>,
}

#[derive(Clone, Debug)]
struct Piece {
    /// Whether it is a label, which a leader that crosses it would strike out, or a leader, which one could take for it.
    is_label: bool,
    corners: Vec<PagePoint>,
    min: PagePoint,
    max: PagePoint,
}

impl Ink {
    /// A convex piece with these corners in order; two corners are a line without width.
    pub fn convex(&mut self, corners: impl IntoIterator<Item = PagePoint>) {
        self.piece(corners.into_iter().collect(), false);
    }

    fn piece(&mut self, corners: Vec<PagePoint>, is_label: bool) {
        let least = |a: PagePoint, b: PagePoint| PagePoint::new(a.x.min(b.x), a.y.min(b.y));
        let most = |a: PagePoint, b: PagePoint| PagePoint::new(a.x.max(b.x), a.y.max(b.y));
        let ends =
            |pick: &dyn Fn(PagePoint, PagePoint) -> PagePoint| corners.iter().copied().reduce(pick);
        if let (Some(min), Some(max)) = (ends(&least), ends(&most)) {
            let number = self.pieces.len();
            if let Some(raster) = &mut self.raster {
                for field in fields(min, max) {
                    raster.entry(field).or_default().push(number);
                }
            }
            self.pieces.push(Piece {
                is_label,
                corners,
                min,
                max,
            });
        }
    }

    /// Sorts the pieces into a raster, so that the many questions of [`place`] look at those nearby alone.
    pub fn index(&mut self) {
        let mut raster: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (number, piece) in self.pieces.iter().enumerate() {
            for field in fields(piece.min, piece.max) {
                raster.entry(field).or_default().push(number);
            }
        }
        self.raster = Some(raster);
    }

    /// The pieces whose boxes meet a box, each once.
    fn near(&self, min: PagePoint, max: PagePoint) -> impl Iterator<Item = &Piece> {
        let meets = move |piece: &&Piece| {
            piece.min.x < max.x && piece.max.x > min.x && piece.min.y < max.y && piece.max.y > min.y
        };
        let numbers = self.raster.as_ref().map(|raster| {
            let lists = fields(min, max).filter_map(|field| raster.get(&field));
            let mut numbers: Vec<usize> = lists.flatten().copied().collect();
            numbers.sort_unstable();
            numbers.dedup();
            numbers
        });
        let all = match numbers {
            Some(numbers) => numbers,
            None => (0..self.pieces.len()).collect(),
        };
        all.into_iter().map(|n| &self.pieces[n]).filter(meets)
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

    /// The arrow that [`arrow::straight`](super::arrow::straight) draws.
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

    /// A label, which no leader should cross.
    fn label(&mut self, rect: PageRect) {
        self.piece(corners(rect).to_vec(), true);
    }

    /// A label and its leader, neither of which another leader should cross.
    fn placed(&mut self, placed: Option<&Placed>) {
        let Some(placed) = placed else { return };
        self.label(placed.rect);
        if let Some([from, to]) = placed.leader {
            self.piece(vec![from, to], true);
        }
    }

    /// Whether an upright rectangle lies clear of all ink.
    pub fn clear(&self, rect: PageRect) -> bool {
        let (min, max) = (rect.at, rect.at.moved(rect.width, rect.height));
        !self.near(min, max).any(|piece| meets(&piece.corners, rect))
    }

    /// How many labels and how many other pieces a line touches.
    fn crossed(&self, from: PagePoint, to: PagePoint) -> (usize, usize) {
        let (min, max) = (
            PagePoint::new(from.x.min(to.x), from.y.min(to.y)),
            PagePoint::new(from.x.max(to.x), from.y.max(to.y)),
        );
        let crosses = |piece: &&Piece| {
            !parted(&piece.corners, &[from, to]) && !parted(&[from, to], &piece.corners)
        };
        let crossed = self.near(min, max).filter(crosses);
        crossed.fold((0, 0), |(labels, others), piece| match piece.is_label {
            true => (labels + 1, others),
            false => (labels, others + 1),
        })
    }
}

/// Side of a field of the raster, pixels.
const FIELD: f64 = 48.0;

/// The fields of the raster that a box touches.
fn fields(min: PagePoint, max: PagePoint) -> impl Iterator<Item = (i64, i64)> {
    // A page has some thousand pixels; what lies far beyond it shares the last fields.
    let field = |v: f64| (v / FIELD).floor().clamp(-20.0, 200.0) as i64;
    let (left, right, top, bottom) = (field(min.x), field(max.x), field(min.y), field(max.y));
    (left..=right).flat_map(move |x| (top..=bottom).map(move |y| (x, y)))
}

/// A label that wants a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Wish {
    /// What it names: where its leader would begin.
    pub anchor: PagePoint,
    /// How far from the anchor the nearest ring begins, pixels.
    pub from: f64,
    /// Width and height of the label, pixels.
    pub size: (f64, f64),
    /// Middles tried first; a label at one of these needs no leader.
    pub preferred: Vec<PagePoint>,
    /// More room, pixels, that a preferred place should have; places that have it come first.
    pub ease: f64,
    /// Whether it may stand elsewhere than at a preferred place: how far from the first ring at most, pixels.
    pub roams: Option<f64>,
}

/// Where a label stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Whether it stands where it was not liked, for want of another place.
    pub disliked: bool,
    /// The label.
    pub rect: PageRect,
    /// The line from the label to what it names, where it stands apart from it.
    pub leader: Option<[PagePoint; 2]>,
}

/// A place for each wish on the page, in the order of the wishes; `None` where there is none. Placed labels become ink.
pub fn place(ink: &mut Ink, page: PageRect, wishes: &[Wish]) -> Vec<Option<Placed>> {
    place_where(ink, page, wishes, &|_, _| false)
}

/// As [`place`]; where a label by the number of its wish is not liked, it stands only for want of another place nearby,
/// and with a leader. Places that are preferred are always liked.
pub fn place_where(
    ink: &mut Ink,
    page: PageRect,
    wishes: &[Wish],
    disliked: &dyn Fn(usize, PageRect) -> bool,
) -> Vec<Option<Placed>> {
    let bare = ink.clone();
    let each = wishes.iter().enumerate().map(|(number, wish)| {
        let placed = one(ink, page, wish, &|rect| disliked(number, rect));
        ink.placed(placed.as_ref());
        placed
    });
    let mut placed: Vec<Option<Placed>> = each.collect();
    if untangle::untangle(&bare, page, wishes, &mut placed, disliked) {
        *ink = bare;
        for placed in &placed {
            ink.placed(placed.as_ref());
        }
    }
    placed
}

fn one(
    ink: &Ink,
    page: PageRect,
    wish: &Wish,
    disliked: &dyn Fn(PageRect) -> bool,
) -> Option<Placed> {
    let with_room = |middle: PagePoint, room: f64| {
        let rect = around(middle, wish.size);
        let kept = around(middle, (wish.size.0 + 2.0 * room, wish.size.1 + 2.0 * room));
        (within(page, kept) && ink.clear(kept)).then_some(rect)
    };
    for room in [ROOM + wish.ease, ROOM + 0.4 * wish.ease, ROOM] {
        let place = |middle: &PagePoint| with_room(*middle, room);
        if let Some(rect) = wish.preferred.iter().find_map(place) {
            return Some(Placed {
                disliked: false,
                rect,
                leader: None,
            });
        }
    }
    let fits = |middle: PagePoint| with_room(middle, ROOM);
    let farthest = wish.from + wish.roams?;
    let step = (0.5 * wish.size.1).max(3.0);
    let mut best: Option<(f64, Placed)> = None;
    for ring in 0..RINGS {
        let radius = wish.from + step * ring as f64;
        // A ring farther out than the best place cannot better it by more than a crossing.
        if radius > farthest || best.is_some_and(|(cost, _)| radius > cost) {
            break;
        }
        for part in 0..AROUND {
            let angle = TAU * part as f64 / AROUND as f64;
            let (cos, sin) = (libm::cos(angle), libm::sin(angle));
            // The label's nearest side lies on the ring, not its middle: wide labels stand as near as narrow ones.
            let (x, y) = (
                cos * radius + cos * wish.size.0 / 2.0,
                sin * radius + sin * wish.size.1 / 2.0,
            );
            let Some(rect) = fits(wish.anchor.moved(x, y)) else {
                continue;
            };
            let end = nearest(rect, wish.anchor);
            let apart = libm::hypot(end.x - wish.anchor.x, end.y - wish.anchor.y);
            let (labels, others) = ink.crossed(wish.anchor, end);
            let disliked = disliked(rect);
            let leader = (disliked || apart > wish.from + NEAR).then_some([end, wish.anchor]);
            let penalty = if disliked { DISLIKED } else { 0.0 };
            let cost = radius
                + penalty
                + CROSSING * others.saturating_sub(1) as f64
                + STRUCK * labels as f64;
            // Of places that differ by rounding alone the first stays.
            if best.is_none_or(|(least, _)| cost < least - TIE) {
                let placed = Placed {
                    disliked,
                    rect,
                    leader,
                };
                best = Some((cost, placed));
            }
        }
    }
    best.map(|(_, placed)| placed)
}

fn around(middle: PagePoint, (width, height): (f64, f64)) -> PageRect {
    PageRect {
        at: middle.moved(-width / 2.0, -height / 2.0),
        width,
        height,
    }
}

fn within(page: PageRect, rect: PageRect) -> bool {
    rect.at.x >= page.at.x
        && rect.at.y >= page.at.y
        && rect.at.x + rect.width <= page.at.x + page.width
        && rect.at.y + rect.height <= page.at.y + page.height
}

/// The point of a rectangle that is nearest to `p`.
pub(crate) fn nearest(rect: PageRect, p: PagePoint) -> PagePoint {
    PagePoint::new(
        p.x.clamp(rect.at.x, rect.at.x + rect.width),
        p.y.clamp(rect.at.y, rect.at.y + rect.height),
    )
}

fn corners(rect: PageRect) -> [PagePoint; 4] {
    [
        rect.at,
        rect.at.moved(rect.width, 0.0),
        rect.at.moved(rect.width, rect.height),
        rect.at.moved(0.0, rect.height),
    ]
}

/// Whether a convex piece and an upright rectangle overlap; their boxes do.
fn meets(piece: &[PagePoint], rect: PageRect) -> bool {
    // The rectangle's own sides part nothing: the boxes overlap.
    !parted(piece, &corners(rect))
}

/// Pieces that reach into each other by less than this, pixels, touch: what rounding decides must not choose a place.
const TOUCH: f64 = 1e-3;

/// Whether a side of the convex `piece` parts it from the others.
fn parted(piece: &[PagePoint], others: &[PagePoint]) -> bool {
    (0..piece.len()).any(|i| {
        let (a, b) = (piece[i], piece[(i + 1) % piece.len()]);
        let beside = |p: &PagePoint| (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        let sides = |of: &[PagePoint]| {
            let all = of.iter().map(beside);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), side| {
                (low.min(side), high.max(side))
            })
        };
        let (own, other) = (sides(piece), sides(others));
        let touch = TOUCH * libm::hypot(b.x - a.x, b.y - a.y);
        own.1 <= other.0 + touch || other.1 <= own.0 + touch
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: PageRect = PageRect {
        at: PagePoint { x: 0.0, y: 0.0 },
        width: 200.0,
        height: 100.0,
    };

    fn wish(x: f64, y: f64) -> Wish {
        Wish {
            anchor: PagePoint::new(x, y),
            from: 4.0,
            size: (30.0, 10.0),
            preferred: vec![PagePoint::new(x + 20.0, y)],
            ease: 3.0,
            roams: Some(f64::INFINITY),
        }
    }

    #[test]
    fn a_slanting_line_bars_what_it_crosses_and_not_its_box() {
        let mut ink = Ink::default();
        ink.line(PagePoint::new(0.0, 0.0), PagePoint::new(100.0, 100.0), 2.0);
        assert!(!ink.clear(around(PagePoint::new(50.0, 52.0), (10.0, 10.0))));
        assert!(ink.clear(around(PagePoint::new(80.0, 20.0), (30.0, 30.0))));
        ink.disc(PagePoint::new(80.0, 20.0), 4.0);
        assert!(!ink.clear(around(PagePoint::new(80.0, 20.0), (2.0, 2.0))));
        assert!(ink.clear(around(PagePoint::new(80.0, 30.0), (8.0, 8.0))));
    }

    #[test]
    fn labels_keep_clear_of_each_other_and_those_far_off_get_a_leader() {
        let wishes = vec![wish(50.0, 50.0); 12];
        let placed = place(&mut Ink::default(), PAGE, &wishes);
        let rects: Vec<Placed> = placed.into_iter().flatten().collect();
        assert_eq!(rects.len(), 12);
        assert_eq!(rects[0].leader, None);
        assert!(rects.iter().any(|p| p.leader.is_some()));
        for (i, a) in rects.iter().enumerate() {
            assert!(within(PAGE, a.rect));
            for b in &rects[..i] {
                let mut ink = Ink::default();
                ink.rect(b.rect);
                assert!(ink.clear(a.rect), "{a:?} lies on {b:?}");
            }
        }
    }

    #[test]
    fn a_label_without_room_is_left_out() {
        let mut ink = Ink::default();
        ink.rect(PAGE);
        assert_eq!(place(&mut ink, PAGE, &[wish(50.0, 50.0)]), [None]);
        let fixed = Wish {
            roams: None,
            preferred: Vec::new(),
            ..wish(50.0, 50.0)
        };
        assert_eq!(place(&mut Ink::default(), PAGE, &[fixed]), [None]);
    }
}
