//! [`untangle`] exchanges the positions of two labels with leader lines if the leader lines then cross each other or
//! labels less often. Crossings with drawn shapes do not count.
//!
//! Labels are placed one after the other, so in a crowd a late label may only find a position behind other labels. The
//! method is a local search over pairs (2-opt). It stops if no exchange reduces the number of crossings, or after a few
//! rounds.

use super::ink::separated;
use super::{Ink, LABEL_CLEARANCE, LabelRequest, Placed, centred, corners, within};
use crate::pictures::drawing::{PagePoint, PageRect};

/// Largest number of rounds over all pairs. The second round rarely changes anything; the limit keeps crowded figures
/// fast.
const MAX_ROUNDS: usize = 4;

/// Exchanges the positions of pairs of labels as long as this reduces the number of crossings, in at most
/// [`MAX_ROUNDS`] rounds. `avoid` is true if the label with this index must not be at this rectangle. Returns true if
/// any label moved.
pub(super) fn untangle(
    ink_without_labels: &Ink,
    page: PageRect,
    requests: &[LabelRequest],
    placed: &mut [Option<Placed>],
    avoid: &dyn Fn(usize, PageRect) -> bool,
) -> bool {
    // Returns the position of the label with the index `number`, centred in the rectangle `to`; `None` if it does not
    // fit there.
    let moved = |number: usize, to: PageRect| {
        let request = &requests[number];
        let centre = to.at.moved(to.width / 2.0, to.height / 2.0);
        let rect = centred(centre, request.size);
        let (width, height) = (rect.width + 2.0 * LABEL_CLEARANCE, rect.height + 2.0 * LABEL_CLEARANCE);
        let kept = centred(centre, (width, height));
        let free = within(page, kept) && ink_without_labels.clear(kept) && !avoid(number, rect);
        free.then(|| Placed::with_leader(rect, request.anchor))
    };
    // Only compare labels that have a position. In a crowded figure, thousands of labels have none.
    let numbers: Vec<usize> = (0..placed.len()).filter(|i| placed[*i].is_some()).collect();
    let mut present: Vec<Option<Placed>> = numbers.iter().map(|i| placed[*i]).collect();
    let moved = |number: usize, to: PageRect| moved(numbers[number], to);
    let mut any_moved = false;
    for _ in 0..MAX_ROUNDS {
        let mut improved = false;
        for i in 0..present.len() {
            for j in 0..i {
                improved |= exchange(&mut present, i, j, &moved);
            }
        }
        any_moved |= improved;
        if !improved {
            break;
        }
    }
    for (number, label) in numbers.iter().zip(present) {
        placed[*number] = label;
    }
    any_moved
}

/// Exchanges the positions of the labels `i` and `j` on three conditions: both have leader lines, each fits at the
/// other's position, and the exchange reduces the number of crossings. Returns true if the positions were exchanged.
fn exchange(
    placed: &mut [Option<Placed>],
    i: usize,
    j: usize,
    moved: &dyn Fn(usize, PageRect) -> Option<Placed>,
) -> bool {
    let (Some(a), Some(b)) = (placed[i], placed[j]) else {
        return false;
    };
    if a.leader.is_none() || b.leader.is_none() {
        return false;
    }
    let before = crossings(placed, i, j);
    if before == 0 {
        return false;
    }
    let (Some(x), Some(y)) = (moved(i, b.rect), moved(j, a.rect)) else {
        return false;
    };
    (placed[i], placed[j]) = (Some(x), Some(y));
    let is_clear = |number: usize, own: &Placed| {
        let others = placed.iter().enumerate().filter(|(k, _)| *k != number);
        let mut others = others.filter_map(|(_, other)| other.as_ref());
        !others.any(|other| overlap(own.rect, other.rect))
    };
    let better = is_clear(i, &x) && is_clear(j, &y) && crossings(placed, i, j) < before;
    if !better {
        (placed[i], placed[j]) = (Some(a), Some(b));
    }
    better
}

/// Returns the number of crossings in which label `i` or `j` takes part. A crossing is a leader line that crosses
/// another leader line or a label. A crossing between `i` and `j` counts twice.
fn crossings(placed: &[Option<Placed>], i: usize, j: usize) -> usize {
    let mut count = 0;
    for own in [i, j] {
        let Some(a) = placed[own] else { continue };
        for (number, other) in placed.iter().enumerate() {
            let Some(b) = other.filter(|_| number != own) else {
                continue;
            };
            let crosses = |leader: Option<[PagePoint; 2]>, other: &[PagePoint]| {
                leader.is_some_and(|line| !separated(&line, other) && !separated(other, &line))
            };
            let leaders = b.leader.is_some_and(|line| crosses(a.leader, &line));
            let labels = crosses(a.leader, &corners(b.rect)) || crosses(b.leader, &corners(a.rect));
            count += usize::from(leaders) + usize::from(labels);
        }
    }
    count
}

fn overlap(a: PageRect, b: PageRect) -> bool {
    a.at.x < b.at.x + b.width + LABEL_CLEARANCE
        && b.at.x < a.at.x + a.width + LABEL_CLEARANCE
        && a.at.y < b.at.y + b.height + LABEL_CLEARANCE
        && b.at.y < a.at.y + a.height + LABEL_CLEARANCE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_with_crossing_leaders_exchange_positions_and_others_stay() {
        let page = PageRect { at: PagePoint::new(0.0, 0.0), width: 200.0, height: 100.0 };
        let request = |x: f64| LabelRequest {
            anchor: PagePoint::new(x, 20.0),
            first_ring: 4.0,
            size: (20.0, 10.0),
            preferred: Vec::new(),
            with_leader: Vec::new(),
            padding: 0.0,
            max_distance: Some(f64::INFINITY),
        };
        let requests = [request(50.0), request(100.0)];
        let at = |x: f64, request: &LabelRequest| {
            let rect = centred(PagePoint::new(x, 80.0), request.size);
            Some(Placed::with_leader(rect, request.anchor))
        };
        let mut placed = vec![at(120.0, &requests[0]), at(40.0, &requests[1])];
        assert_eq!(crossings(&placed, 0, 1), 2);
        let none = |_: usize, _: PageRect| false;
        assert!(untangle(&Ink::default(), page, &requests, &mut placed, &none));
        assert_eq!(crossings(&placed, 0, 1), 0);
        assert_eq!(placed, vec![at(40.0, &requests[0]), at(120.0, &requests[1])]);
        assert!(!untangle(&Ink::default(), page, &requests, &mut placed, &none));
        // If ink is in the way, no label is moved.
        let mut ink = Ink::default();
        ink.rect(centred(PagePoint::new(40.0, 80.0), (20.0, 10.0)));
        let mut crossed = vec![at(120.0, &requests[0]), at(40.0, &requests[1])];
        assert!(!untangle(&ink, page, &requests, &mut crossed, &none));
    }
}
