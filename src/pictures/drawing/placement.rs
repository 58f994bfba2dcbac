//! [`place`]: where labels have room. None lies on ink, on another label, or off its page.
//!
//! Each label wants to be near its anchor. Places that its maker prefers are tried first, then rings about the anchor,
//! wider and wider; a label that ends up apart from what it names gets a leader line. Labels are placed in the order
//! given, the most important first; one for which no place is clear is left out.

mod ink;
mod untangle;

use core::f64::consts::TAU;

use super::{PagePoint, PageRect};

pub use self::ink::Ink;

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

/// A label that wants a place.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelRequest {
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

/// A place for each request on the page, in the order of the requests; `None` where there is none. Placed labels become ink.
pub fn place(ink: &mut Ink, page: PageRect, requests: &[LabelRequest]) -> Vec<Option<Placed>> {
    place_where(ink, page, requests, &|_, _| false)
}

/// As [`place`]; where a label by the number of its request is not liked, it stands only for want of another place nearby,
/// and with a leader. Places that are preferred are always liked.
pub fn place_where(
    ink: &mut Ink,
    page: PageRect,
    requests: &[LabelRequest],
    disliked: &dyn Fn(usize, PageRect) -> bool,
) -> Vec<Option<Placed>> {
    ink.index();
    let bare = ink.clone();
    let each = requests.iter().enumerate().map(|(number, request)| {
        let placed = one(ink, page, request, &|rect| disliked(number, rect));
        ink.placed(placed.as_ref());
        placed
    });
    let mut placed: Vec<Option<Placed>> = each.collect();
    if untangle::untangle(&bare, page, requests, &mut placed, disliked) {
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
    request: &LabelRequest,
    disliked: &dyn Fn(PageRect) -> bool,
) -> Option<Placed> {
    let with_room = |middle: PagePoint, room: f64| {
        let rect = around(middle, request.size);
        let kept = around(
            middle,
            (request.size.0 + 2.0 * room, request.size.1 + 2.0 * room),
        );
        (within(page, kept) && ink.clear(kept)).then_some(rect)
    };
    for room in [ROOM + request.ease, ROOM + 0.4 * request.ease, ROOM] {
        let place = |middle: &PagePoint| with_room(*middle, room);
        if let Some(rect) = request.preferred.iter().find_map(place) {
            return Some(Placed {
                disliked: false,
                rect,
                leader: None,
            });
        }
    }
    let fits = |middle: PagePoint| with_room(middle, ROOM);
    let farthest = request.from + request.roams?;
    let step = (0.5 * request.size.1).max(3.0);
    let mut best: Option<(f64, Placed)> = None;
    for ring in 0..RINGS {
        let radius = request.from + step * ring as f64;
        // A ring farther out than the best place cannot better it by more than a crossing.
        if radius > farthest || best.is_some_and(|(cost, _)| radius > cost) {
            break;
        }
        for part in 0..AROUND {
            let angle = TAU * part as f64 / AROUND as f64;
            let (cos, sin) = (libm::cos(angle), libm::sin(angle));
            // The label's nearest side lies on the ring, not its middle: wide labels stand as near as narrow ones.
            let (x, y) = (
                cos * radius + cos * request.size.0 / 2.0,
                sin * radius + sin * request.size.1 / 2.0,
            );
            let Some(rect) = fits(request.anchor.moved(x, y)) else {
                continue;
            };
            let end = nearest(rect, request.anchor);
            let apart = libm::hypot(end.x - request.anchor.x, end.y - request.anchor.y);
            let (labels, others) = ink.crossed(request.anchor, end);
            let disliked = disliked(rect);
            let leader = (disliked || apart > request.from + NEAR).then_some([end, request.anchor]);
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

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: PageRect = PageRect {
        at: PagePoint { x: 0.0, y: 0.0 },
        width: 200.0,
        height: 100.0,
    };

    fn request(x: f64, y: f64) -> LabelRequest {
        LabelRequest {
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
        let requests = vec![request(50.0, 50.0); 12];
        let placed = place(&mut Ink::default(), PAGE, &requests);
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
        assert_eq!(place(&mut ink, PAGE, &[request(50.0, 50.0)]), [None]);
        let fixed = LabelRequest {
            roams: None,
            preferred: Vec::new(),
            ..request(50.0, 50.0)
        };
        assert_eq!(place(&mut Ink::default(), PAGE, &[fixed]), [None]);
    }
}
