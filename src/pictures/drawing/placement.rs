//! [`place`] finds positions for labels. Labels lie inside the page, and they do not cover drawn shapes (the ink) or
//! other labels.
//!
//! The method is greedy, with a few rounds of exchanges at the end. See Christensen, Marks and Shieber, *An empirical
//! study of algorithms for point-feature label placement* (ACM Transactions on Graphics 14, 1995).
//!
//! 1. Labels are placed in the order of the requests, the most important first.
//! 2. Each label takes the first of its preferred positions that is clear of ink.
//! 3. If none is clear, the label takes the first clear position of a second list, with a leader line.
//! 4. If the second list has no clear position either, the label takes the position of least cost on concentric rings
//!    around its anchor. The cost is the distance plus penalties. A label away from its anchor gets a leader line.
//! 5. A label without a clear position is left out.
//! 6. Labels whose leaders cross exchange their positions if that leaves fewer crossings
//!    ([`untangle`](untangle::untangle)).

mod ink;
mod untangle;

use core::f64::consts::TAU;

use super::{PagePoint, PageRect};

pub use self::ink::Ink;

/// Largest number of rings that are tried around an anchor. The distance of two rings is half the height of the label,
/// but at least 3 pixels.
const MAX_RINGS: usize = 60;
/// Positions tried on each ring: every 15°.
const POSITIONS_PER_RING: usize = 24;
/// Clear space around a label, pixels. With less space, letters seem to touch lines. With much more space, crowded
/// figures would lose labels.
const LABEL_CLEARANCE: f64 = 1.5;
/// A label on a ring gets a leader line if all of it lies farther outside the first ring than this, pixels.
const LEADER_DISTANCE: f64 = 6.0;
/// Cost of each piece of ink that a leader crosses, pixels of distance. To avoid such a crossing, a label may be about
/// one line height farther away.
const INK_CROSSING_COST: f64 = 14.0;
/// Cost of each other label that a leader crosses, pixels of distance. The cost is larger than usual distances,
/// because the crossed label would look struck out.
const LABEL_CROSSING_COST: f64 = 1000.0;
/// Cost of a position for which the function `avoid` of the caller is true, pixels of distance.
const AVOIDED_COST: f64 = 110.0;
/// Positions whose costs differ by less than this, pixels, are equally good. The first of them is taken, so that
/// rounding errors do not decide.
const COST_TIE_TOL: f64 = 1e-3;
/// After this number of labels without a free position, rings are no longer searched, because the page is probably
/// full: further labels get a position that their request lists, or none. A search of the rings around an anchor takes
/// tens of milliseconds if there are thousands of arrows.
const MAX_MISSES: usize = 100;

/// A label that needs a position.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelRequest {
    /// The point that the label names. The leader line ends at this point.
    pub anchor: PagePoint,
    /// Radius of the first ring around the anchor, pixels.
    pub first_ring: f64,
    /// Width and height of the label, pixels.
    pub size: (f64, f64),
    /// Centres that are tried first. A label at such a centre needs no leader.
    pub preferred: Vec<PagePoint>,
    /// Centres that are tried after the preferred ones. A label at such a centre has a leader, which crosses no other
    /// label.
    pub with_leader: Vec<PagePoint>,
    /// Additional clear space around a preferred position, pixels. Positions that have this space are tried first.
    pub padding: f64,
    /// Largest distance of the label beyond the first ring, pixels. If it is `None`, no positions on rings are tried.
    pub max_distance: Option<f64>,
}

/// The position of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Whether this position was only taken because no better position was free: `avoid` is true for it, or its leader
    /// crosses another label.
    pub avoided: bool,
    /// The label's rectangle.
    pub rect: PageRect,
    /// The line from the label to its anchor, if it has one.
    pub leader: Option<[PagePoint; 2]>,
}

impl Placed {
    /// Places a label in `rect`, with a leader line from the label to `anchor`.
    fn with_leader(rect: PageRect, anchor: PagePoint) -> Placed {
        Placed { avoided: false, rect, leader: Some([nearest(rect, anchor), anchor]) }
    }
}

/// Finds a position for each label. Returns the positions in the order of the requests, with `None` for a label without
/// a free position. Adds the placed labels and their leader lines to the ink.
///
/// The function `avoid` gets the index of a request and a rectangle for its label. A rectangle for which `avoid` is true has a high cost: it is used only if all other free positions on the rings cost more, and
/// then with a leader line. `avoid` does not apply to the positions that a request lists. After many labels without a
/// free position, the rings are no longer searched.
pub fn place_avoiding(
    ink: &mut Ink,
    page: PageRect,
    requests: &[LabelRequest],
    avoid: &dyn Fn(usize, PageRect) -> bool,
) -> Vec<Option<Placed>> {
    ink.index();
    let ink_without_labels = ink.clone();
    let mut placed = Vec::with_capacity(requests.len());
    let mut misses = 0;
    for (number, request) in requests.iter().enumerate() {
        let preferred = preferred_position(ink, page, request);
        let preferred = preferred.or_else(|| position_with_leader(ink, page, request));
        let position = preferred.or_else(|| {
            if misses < MAX_MISSES { ring_position(ink, page, request, &|rect| avoid(number, rect)) } else { None }
        });
        misses += usize::from(position.is_none());
        ink.add_label(position.as_ref());
        placed.push(position);
    }
    if untangle::untangle(&ink_without_labels, page, requests, &mut placed, avoid) {
        *ink = ink_without_labels;
        for placed in &placed {
            ink.add_label(placed.as_ref());
        }
    }
    placed
}

/// Returns the rectangle of a label with this centre. Returns `None` if the rectangle, enlarged by the clearance
/// (pixels), does not lie inside the page or overlaps ink.
fn fitting(ink: &Ink, page: PageRect, request: &LabelRequest, centre: PagePoint, clearance: f64) -> Option<PageRect> {
    let (width, height) = request.size;
    let kept = centred(centre, (width + 2.0 * clearance, height + 2.0 * clearance));
    (within(page, kept) && ink.clear(kept)).then(|| centred(centre, request.size))
}

/// Returns the first preferred position that is free of ink. Tries all positions with the full padding, then with 40 %
/// of the padding, then without padding.
fn preferred_position(ink: &Ink, page: PageRect, request: &LabelRequest) -> Option<Placed> {
    let clearances = [request.padding, 0.4 * request.padding, 0.0];
    clearances.into_iter().find_map(|padding| {
        let mut centres = request.preferred.iter();
        let rect = centres.find_map(|at| fitting(ink, page, request, *at, LABEL_CLEARANCE + padding))?;
        Some(Placed { avoided: false, rect, leader: None })
    })
}

/// Returns the first position of `with_leader` that is free of ink and whose leader crosses no other label.
fn position_with_leader(ink: &Ink, page: PageRect, request: &LabelRequest) -> Option<Placed> {
    let mut centres = request.with_leader.iter();
    centres.find_map(|at| {
        let rect = fitting(ink, page, request, *at, LABEL_CLEARANCE)?;
        let (labels, _) = ink.crossed(request.anchor, nearest(rect, request.anchor));
        (labels == 0).then(|| Placed::with_leader(rect, request.anchor))
    })
}

/// Returns the free position of least cost on rings around the anchor. Returns `None` if no position on the rings is
/// free, or if the request has no [`LabelRequest::max_distance`].
fn ring_position(
    ink: &Ink,
    page: PageRect,
    request: &LabelRequest,
    avoid: &dyn Fn(PageRect) -> bool,
) -> Option<Placed> {
    let (width, height) = request.size;
    let farthest = request.first_ring + request.max_distance?;
    let ring_step = (0.5 * height).max(3.0);
    let mut best: Option<(f64, Placed)> = None;
    for ring in 0..MAX_RINGS {
        let radius = request.first_ring + ring_step * ring as f64;
        // The cost of a position is at least the radius of its ring, so larger rings have no cheaper position.
        if radius > farthest || best.is_some_and(|(cost, _)| radius > cost) {
            break;
        }
        for part in 0..POSITIONS_PER_RING {
            let angle = TAU * part as f64 / POSITIONS_PER_RING as f64;
            let (cos, sin) = (libm::cos(angle), libm::sin(angle));
            // The nearest side of the label lies about on the ring, so wide labels are as near to the anchor as narrow
            // labels.
            let (x, y) = (cos * radius + cos * width / 2.0, sin * radius + sin * height / 2.0);
            let centre = request.anchor.moved(x, y);
            let Some(rect) = fitting(ink, page, request, centre, LABEL_CLEARANCE) else {
                continue;
            };
            let (penalty, placed) = candidate(ink, request, rect, avoid(rect));
            let cost = radius + penalty;
            if best.is_none_or(|(least, _)| cost < least - COST_TIE_TOL) {
                best = Some((cost, placed));
            }
        }
    }
    best.map(|(_, placed)| placed)
}

/// Returns the sum of the penalties for a label in `rect`, in pixels of distance, and the placed label. The label has a
/// leader line if `avoided` is true or if `rect` is far from the anchor.
fn candidate(ink: &Ink, request: &LabelRequest, rect: PageRect, avoided: bool) -> (f64, Placed) {
    let anchor = request.anchor;
    let end = nearest(rect, anchor);
    let distance = libm::hypot(end.x - anchor.x, end.y - anchor.y);
    let (labels, others) = ink.crossed(anchor, end);
    let needs_leader = avoided || distance > request.first_ring + LEADER_DISTANCE;
    let placed = Placed {
        avoided: avoided || (needs_leader && labels > 0),
        rect,
        leader: needs_leader.then_some([end, anchor]),
    };
    // One of the crossed pieces of ink has no penalty: it is the item that the label names.
    let penalty = if avoided { AVOIDED_COST } else { 0.0 }
        + INK_CROSSING_COST * others.saturating_sub(1) as f64
        + LABEL_CROSSING_COST * labels as f64;
    (penalty, placed)
}

/// Returns the rectangle with this centre, width and height.
fn centred(centre: PagePoint, (width, height): (f64, f64)) -> PageRect {
    PageRect { at: centre.moved(-width / 2.0, -height / 2.0), width, height }
}

fn within(page: PageRect, rect: PageRect) -> bool {
    rect.at.x >= page.at.x
        && rect.at.y >= page.at.y
        && rect.at.x + rect.width <= page.at.x + page.width
        && rect.at.y + rect.height <= page.at.y + page.height
}

/// Returns the point of a rectangle that is nearest to `p`.
pub(crate) fn nearest(rect: PageRect, p: PagePoint) -> PagePoint {
    PagePoint::new(p.x.clamp(rect.at.x, rect.at.x + rect.width), p.y.clamp(rect.at.y, rect.at.y + rect.height))
}

/// Returns the corners of a rectangle, clockwise on the page from the upper left.
fn corners(rect: PageRect) -> [PagePoint; 4] {
    [rect.at, rect.at.moved(rect.width, 0.0), rect.at.moved(rect.width, rect.height), rect.at.moved(0.0, rect.height)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(ink: &mut Ink, page: PageRect, requests: &[LabelRequest]) -> Vec<Option<Placed>> {
        place_avoiding(ink, page, requests, &|_, _| false)
    }

    const PAGE: PageRect = PageRect { at: PagePoint { x: 0.0, y: 0.0 }, width: 200.0, height: 100.0 };

    fn request(x: f64, y: f64) -> LabelRequest {
        LabelRequest {
            anchor: PagePoint::new(x, y),
            first_ring: 4.0,
            size: (30.0, 10.0),
            preferred: vec![PagePoint::new(x + 20.0, y)],
            with_leader: Vec::new(),
            padding: 3.0,
            max_distance: Some(f64::INFINITY),
        }
    }

    #[test]
    fn an_inclined_line_blocks_labels_that_it_crosses_not_its_bounding_box() {
        let mut ink = Ink::default();
        ink.line(PagePoint::new(0.0, 0.0), PagePoint::new(100.0, 100.0), 2.0);
        assert!(!ink.clear(centred(PagePoint::new(50.0, 52.0), (10.0, 10.0))));
        assert!(ink.clear(centred(PagePoint::new(80.0, 20.0), (30.0, 30.0))));
        ink.disc(PagePoint::new(80.0, 20.0), 4.0);
        assert!(!ink.clear(centred(PagePoint::new(80.0, 20.0), (2.0, 2.0))));
        assert!(ink.clear(centred(PagePoint::new(80.0, 30.0), (8.0, 8.0))));
    }

    #[test]
    fn labels_do_not_overlap_and_distant_labels_get_a_leader() {
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
    fn labels_of_a_row_take_two_lines_in_order_with_leaders_that_cross_nothing() {
        let row = |number: u32| {
            let x = 30.0 + 20.0 * f64::from(number);
            LabelRequest {
                anchor: PagePoint::new(x, 50.0),
                preferred: vec![PagePoint::new(x, 40.0)],
                with_leader: vec![PagePoint::new(x, 26.0), PagePoint::new(x, 12.0)],
                padding: 0.0,
                ..request(x, 50.0)
            }
        };
        let requests: Vec<LabelRequest> = (0..7).map(row).collect();
        let placed = place(&mut Ink::default(), PAGE, &requests);
        for (number, placed) in placed.iter().enumerate() {
            let placed = placed.expect("a position");
            let second = number % 2 == 1;
            assert_eq!(placed.leader.is_some(), second);
            assert_eq!(placed.rect.at.y, if second { 21.0 } else { 35.0 });
            assert_eq!(placed.rect.at.x, requests[number].anchor.x - 15.0);
        }
    }

    #[test]
    fn a_label_without_room_is_left_out() {
        let mut ink = Ink::default();
        ink.rect(PAGE);
        assert_eq!(place(&mut ink, PAGE, &[request(50.0, 50.0)]), [None]);
        let fixed = LabelRequest { max_distance: None, preferred: Vec::new(), ..request(50.0, 50.0) };
        assert_eq!(place(&mut Ink::default(), PAGE, &[fixed]), [None]);
    }
}
