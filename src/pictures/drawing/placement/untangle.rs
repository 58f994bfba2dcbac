//! [`untangle`]: two labels whose leaders cross take each other's places where that leaves fewer crossings.
//!
//! Labels are placed one after the other, each where it is best then; the last ones of a crowd may end up behind those of
//! their neighbours.

use super::ink::parted;
use super::{Ink, LabelRequest, Placed, ROOM, around, corners, nearest, within};
use crate::drawing::{PagePoint, PageRect};

/// Rounds over all pairs.
const ROUNDS: usize = 4;

/// Swaps labels while that leaves fewer crossings; whether any was.
pub(super) fn untangle(
    bare: &Ink,
    page: PageRect,
    requests: &[LabelRequest],
    placed: &mut [Option<Placed>],
    disliked: &dyn Fn(usize, PageRect) -> bool,
) -> bool {
    let mut swapped = false;
    for _ in 0..ROUNDS {
        let mut better = false;
        for i in 0..placed.len() {
            for j in 0..i {
                let (Some(a), Some(b)) = (placed[i], placed[j]) else {
                    continue;
                };
                if a.leader.is_none() || b.leader.is_none() {
                    continue;
                }
                let before = tangles(placed, i, j);
                if before == 0 {
                    continue;
                }
                let moved = |number: usize, to: PageRect| {
                    let middle = to.at.moved(to.width / 2.0, to.height / 2.0);
                    let (request, rect) =
                        (&requests[number], around(middle, requests[number].size));
                    let kept = around(middle, (rect.width + 2.0 * ROOM, rect.height + 2.0 * ROOM));
                    let free = within(page, kept) && bare.clear(kept) && !disliked(number, rect);
                    free.then(|| Placed {
                        disliked: false,
                        rect,
                        leader: Some([nearest(rect, request.anchor), request.anchor]),
                    })
                };
                let (Some(x), Some(y)) = (moved(i, b.rect), moved(j, a.rect)) else {
                    continue;
                };
                (placed[i], placed[j]) = (Some(x), Some(y));
                let alone = |number: usize, own: &Placed| {
                    let others = placed.iter().enumerate().filter(|(k, _)| *k != number);
                    let mut others = others.filter_map(|(_, other)| other.as_ref());
                    !others.any(|other| overlap(own.rect, other.rect))
                };
                if alone(i, &x) && alone(j, &y) && tangles(placed, i, j) < before {
                    (better, swapped) = (true, true);
                } else {
                    (placed[i], placed[j]) = (Some(a), Some(b));
                }
            }
        }
        if !better {
            break;
        }
    }
    swapped
}

/// How often the leaders of two labels cross other leaders or labels, and how often other leaders cross these labels.
fn tangles(placed: &[Option<Placed>], i: usize, j: usize) -> usize {
    let mut count = 0;
    for own in [i, j] {
        let Some(a) = placed[own] else { continue };
        for (number, other) in placed.iter().enumerate() {
            let Some(b) = other.filter(|_| number != own) else {
                continue;
            };
            let met = |leader: Option<[PagePoint; 2]>, other: &[PagePoint]| {
                leader.is_some_and(|line| !parted(&line, other) && !parted(other, &line))
            };
            let lines = b.leader.is_some_and(|line| met(a.leader, &line));
            let struck = met(a.leader, &corners(b.rect)) || met(b.leader, &corners(a.rect));
            count += usize::from(lines) + usize::from(struck);
        }
    }
    count
}

fn overlap(a: PageRect, b: PageRect) -> bool {
    a.at.x < b.at.x + b.width + ROOM
        && b.at.x < a.at.x + a.width + ROOM
        && a.at.y < b.at.y + b.height + ROOM
        && b.at.y < a.at.y + a.height + ROOM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossing_leaders_are_swapped_and_others_stay() {
        let page = PageRect {
            at: PagePoint::new(0.0, 0.0),
            width: 200.0,
            height: 100.0,
        };
        let request = |x: f64| LabelRequest {
            anchor: PagePoint::new(x, 20.0),
            from: 4.0,
            size: (20.0, 10.0),
            preferred: Vec::new(),
            ease: 0.0,
            roams: Some(f64::INFINITY),
        };
        let requests = [request(50.0), request(100.0)];
        let at = |x: f64, request: &LabelRequest| {
            let rect = around(PagePoint::new(x, 80.0), request.size);
            Some(Placed {
                disliked: false,
                rect,
                leader: Some([nearest(rect, request.anchor), request.anchor]),
            })
        };
        let mut placed = vec![at(120.0, &requests[0]), at(40.0, &requests[1])];
        assert_eq!(tangles(&placed, 0, 1), 2);
        let none = |_: usize, _: PageRect| false;
        assert!(untangle(
            &Ink::default(),
            page,
            &requests,
            &mut placed,
            &none
        ));
        assert_eq!(tangles(&placed, 0, 1), 0);
        assert_eq!(
            placed,
            vec![at(40.0, &requests[0]), at(120.0, &requests[1])]
        );
        assert!(!untangle(
            &Ink::default(),
            page,
            &requests,
            &mut placed,
            &none
        ));
        // Where ink lies in the way nothing is moved.
        let mut ink = Ink::default();
        ink.rect(around(PagePoint::new(40.0, 80.0), (20.0, 10.0)));
        let mut crossed = vec![at(120.0, &requests[0]), at(40.0, &requests[1])];
        assert!(!untangle(&ink, page, &requests, &mut crossed, &none));
    }
}
