//! Tests of the occupied area of a page.

use super::*;

#[test]
fn the_grid_does_not_change_the_results() {
    // Lines, discs and labels at random places on a page and outside it.
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
            0 => plain.line(from, from.moved(next(300.0) - 150.0, next(200.0) - 100.0), 2.0),
            1 => plain.disc(from, 1.0 + next(8.0)),
            _ => late.push(PageRect { at: from, width: 1.0 + next(60.0), height: 12.0 }),
        }
    }
    let mut sorted = plain.clone();
    sorted.index();
    for (i, rect) in late.into_iter().enumerate() {
        let placed =
            Placed { avoided: false, rect, leader: (i % 2 == 0).then(|| [rect.at, rect.at.moved(-70.0, 30.0)]) };
        plain.add_label(Some(&placed));
        sorted.add_label(Some(&placed));
    }
    let (mut clear, mut crossed) = (0, 0);
    for _ in 0..4000 {
        let at = PagePoint::new(next(700.0) - 150.0, next(500.0) - 150.0);
        let rect = PageRect { at, width: 1.0 + next(40.0), height: 1.0 + next(12.0) };
        assert_eq!(plain.clear(rect), sorted.clear(rect), "{rect:?}");
        // A test of the box as a convex piece finds the same intersections.
        let meets = |p: &ConvexPiece| !separated(&plain.corners[p.first..p.end], &corners(rect));
        let max = at.moved(rect.width, rect.height);
        assert_eq!(!plain.any_near(at, max, meets), plain.clear(rect), "{rect:?}");
        clear += usize::from(plain.clear(rect));
        let to = at.moved(next(200.0) - 100.0, next(200.0) - 100.0);
        let all = plain.crossed(at, to);
        assert_eq!(all, sorted.crossed(at, to), "{at:?} {to:?}");
        crossed += all.0.min(all.1);
    }
    assert!((1000..3500).contains(&clear) && crossed > 100, "{clear}, {crossed}");
}
