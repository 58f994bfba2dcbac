//! Tests of rings that are not a polygon, and of the errors that are reported for them.

use super::*;

fn flaws(rings: &[&[[f64; 2]]]) -> Vec<PolygonError> {
    made(rings).expect_err("rings that are not a polygon")
}

/// The error that two edges of the outline cross at a point. Each edge is given by the number of its first corner.
fn crossing(corners: [usize; 2], at: [f64; 2]) -> PolygonError {
    PolygonError::Crossing { rings: [0, 0], corners, at: Point::new(at[0], at[1]) }
}

#[test]
fn repeated_corners_are_dropped_and_corners_on_straight_edges_stay() {
    let [a, b, c, d] = square(0.0, 0.0, 2.0);
    let middle = [1.0, 0.0];
    let found = sound(&[&[a, a, middle, b, b, b, c, d, a, a]]);
    assert_eq!(found.outline(), points(&[a, middle, b, c, d]));
    let few = |ring: usize, corners: usize| vec![PolygonError::TooFewCorners { ring, corners }];
    assert_eq!(flaws(&[&[]]), few(0, 0));
    assert_eq!(flaws(&[&[a, a, a]]), few(0, 1));
    assert_eq!(flaws(&[&[a, b, a]]), few(0, 2));
    assert_eq!(flaws(&[&[a, b, c, d], &[middle, c]]), few(1, 2));
    // Every ring has its error, with the number of the ring in the list.
    let both = [few(0, 2), few(1, 1)].concat();
    assert_eq!(flaws(&[&[a, b], &[c]]), both);
}

#[test]
fn a_ring_on_a_line_encloses_nothing() {
    let flat = |ring: usize| vec![PolygonError::ZeroArea { ring }];
    assert_eq!(flaws(&[&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]]), flat(0));
    assert_eq!(flaws(&[&[[0.0, 0.0], [f64::NAN, 1.0], [2.0, 0.0]]]), flat(0));
    assert_eq!(flaws(&[&[[0.0, 0.0], [f64::INFINITY, 1.0], [2.0, 0.0]]]), flat(0));
    let line = [[1.0, 1.0], [2.0, 1.0], [3.0, 1.0]];
    assert_eq!(flaws(&[&square(0.0, 0.0, 4.0), &line]), flat(1));
    // A needle: its area is half its height times its length, and its perimeter is twice its length. The area is h/8
    // of the squared perimeter.
    for size in [1.0, 1e3, 1e-3] {
        let needle = |h: f64| [[0.0, 0.0], [size, 0.0], [0.5 * size, h * size]];
        assert_eq!(flaws(&[&needle(6e-15)]), flat(0));
        assert_eq!(sound(&[&needle(1e-14)]).outline().len(), 3);
    }
    // A bow tie has zero area, because its two halves cancel. Only its crossing is reported.
    let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
    assert_eq!(flaws(&[&bow]), [crossing([0, 2], [1.0, 1.0])]);
}

#[test]
fn a_hole_lies_inside_the_outline_and_outside_other_holes() {
    let outline = square(0.0, 0.0, 9.0);
    let outside = |ring: usize| vec![PolygonError::HoleOutside { ring }];
    let beside = square(10.0, 1.0, 1.0);
    assert_eq!(flaws(&[&outline, &beside]), outside(1));
    assert_eq!(flaws(&[&outline, &square(1.0, 1.0, 1.0), &beside]), outside(2));
    let (hole, within) = (square(1.0, 1.0, 4.0), square(2.0, 2.0, 1.0));
    assert_eq!(flaws(&[&outline, &hole, &within]), outside(2));
    assert_eq!(flaws(&[&outline, &within, &hole]), outside(1));
    // A ring around the outline.
    assert_eq!(flaws(&[&within, &outline]), outside(1));
    let found = sound(&[&outline, &hole, &square(6.0, 6.0, 2.0)]);
    assert_eq!((found.area(), found.rings().len()), (81.0 - 16.0 - 4.0, 3));
}

#[test]
fn a_crossing_names_the_corners_where_its_edges_begin() {
    // The first edge is crossed by the edge that begins at corner 3. Corner 2 repeats corner 1 and is dropped.
    let crossed = [[0.0, 0.0], [6.0, 3.0], [6.0, 3.0], [6.0, 9.0], [2.0, -5.0], [-4.0, 9.0]];
    let found = flaws(&[&crossed]);
    let [PolygonError::Crossing { rings, corners, at }] = found[..] else {
        unreachable!("one crossing: {found:?}");
    };
    // x = 6 − 4s, y = 9 − 14s on y = x / 2: s = 1/2.
    assert_eq!((rings, corners), ([0, 0], [0, 3]), "numbers in the given list");
    assert!((at - Point::new(4.0, 2.0)).norm() < 1e-12);
    // A corner that lies on an edge, and then two corners at the same point.
    let touching = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 0.0], [0.0, 3.0]];
    assert_eq!(flaws(&[&touching]), [crossing([0, 2], [2.0, 0.0]), crossing([0, 3], [2.0, 0.0])]);
    let pinched = [[0.0, 0.0], [2.0, 2.0], [4.0, 0.0], [4.0, 4.0], [2.0, 2.0], [0.0, 4.0]];
    let at = [2.0, 2.0];
    let wanted = [[0, 3], [0, 4], [1, 3], [1, 4]].map(|corners| crossing(corners, at));
    assert_eq!(flaws(&[&pinched]), wanted);
    // The corner is close to the edge, but does not touch it.
    let near = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 1e-300], [0.0, 3.0]];
    assert_eq!(sound(&[&near]).outline().len(), 5);
}

#[test]
fn a_path_may_not_turn_back_on_itself() {
    let spike = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [6.0, 2.0], [5.0, 2.0], [3.0, 4.0]];
    assert_eq!(flaws(&[&spike])[0], crossing([2, 3], [6.0, 2.0]));
    // The first and the last edge: the ring folds back where it closes.
    let closing = [[6.0, 2.0], [5.0, 2.0], [3.0, 4.0], [0.0, 0.0], [4.0, 0.0], [4.0, 2.0]];
    assert!(flaws(&[&closing]).contains(&crossing([0, 5], [6.0, 2.0])));
}

#[test]
fn holes_may_touch_neither_the_outline_nor_each_other() {
    let outline = square(0.0, 0.0, 9.0);
    let rings = |flaws: Vec<PolygonError>| {
        let all = flaws.into_iter().map(|flaw| match flaw {
            PolygonError::Crossing { rings, .. } => rings,
            other => unreachable!("a crossing: {other:?}"),
        });
        all.collect::<Vec<_>>()
    };
    let tip = [[1.0, 0.0], [2.0, 1.0], [1.0, 1.0]];
    assert_eq!(rings(flaws(&[&outline, &tip])), [[0, 1]; 2]);
    let across = rings(flaws(&[&outline, &square(1.0, 1.0, 2.0), &square(2.0, 2.0, 2.0)]));
    assert_eq!(across, [[1, 2]; 2]);
}

#[test]
fn the_first_twenty_crossings_are_listed_in_the_order_of_the_edges() {
    // A zigzag of many teeth, and a line back through all of them.
    let zigzag = |teeth: usize| {
        let mut ring: Vec<[f64; 2]> = (0..=teeth).map(|k| [k as f64, if k % 2 == 0 { -1.0 } else { 1.0 }]).collect();
        ring.extend([[teeth as f64 + 1.0, 0.0], [-1.0, 0.0]]);
        ring
    };
    for (teeth, listed) in [(19, 19), (20, 20), (21, 20), (90, 20)] {
        let found = flaws(&[&zigzag(teeth)]);
        let line = teeth + 1;
        let wanted: Vec<PolygonError> = (0..listed).map(|k| crossing([k, line], [k as f64 + 0.5, 0.0])).collect();
        assert_eq!(found, wanted, "{teeth}");
    }
    // The same ring, listed from the beginning of the line.
    let mut ring = zigzag(31);
    ring.rotate_right(2);
    let found = flaws(&[&ring]);
    let wanted: Vec<PolygonError> = (0..20).map(|k| crossing([0, k + 2], [k as f64 + 0.5, 0.0])).collect();
    assert_eq!(found, wanted);
}

#[test]
fn crossings_are_found_at_any_size() {
    let crossed = [[0.0, 0.0], [4.0, 4.0], [4.0, 1.0], [0.0, 3.0]];
    // A U with a corner below its right inner side, on the line of this side. Its two upper sides lie on one line.
    let apart =
        [[0.0, 0.0], [3.0, 0.0], [5.0, 0.0], [5.0, 4.0], [3.0, 4.0], [3.0, 1.0], [2.0, 1.0], [2.0, 4.0], [0.0, 4.0]];
    for size in [1.0, 1e-90, 1e90] {
        let crossed = crossed.map(|p| p.map(|v| size * v));
        let [PolygonError::Crossing { corners, at, .. }] = flaws(&[&crossed])[..] else {
            unreachable!("one crossing at size {size}");
        };
        assert_eq!(corners, [0, 2]);
        assert!((at.coords / size - Vector::new(2.0, 2.0)).norm() < 1e-12);
        let apart = apart.map(|p| p.map(|v| size * v));
        assert_eq!(sound(&[&apart]).outline(), points(&apart));
    }
}
