//! Tests of the parts of snapping: areas, sides, nodes near sides, and damaged bodies.

use super::*;

#[test]
fn the_area_of_an_anticlockwise_ring_is_positive() {
    let at = |x: f64, y: f64| Corner { at: Point::new(x, y), curved: false };
    let mut ring = vec![at(11.0, -5.0), at(14.0, -5.0), at(14.0, -3.0), at(9.0, -1.0)];
    // A box of 5 by 4 minus two triangles: 2 · 4 / 2 and 5 · 2 / 2.
    assert_eq!(area(&ring), 11.0);
    ring.reverse();
    assert_eq!(area(&ring), -11.0);
    assert_eq!(area(&[]), 0.0);
}

/// The nodes near the sides of the first body. Each entry contains the node's body, the side's first corner, the
/// distance along the side, and the distance from the side.
fn beside_first(bodies: &[Rings], gaps: &[f64], kept: &[bool]) -> Vec<(usize, usize, f64, f64)> {
    let nodes = Nodes::new(bodies, Gaps::new(gaps), kept);
    let sides = sides(bodies, &nodes);
    let found = nodes_near_sides(&nodes, &sides, gaps, kept);
    let of_first = found.iter().filter(|b| b.side.body == 0);
    of_first.map(|b| (nodes.bodies(&nodes.all[b.node])[0], b.side.corner, b.reach, b.off)).collect()
}

/// A box of 4 by 1, and a triangle whose tip is (x, y).
fn box_and_tip(x: f64, y: f64) -> Vec<Rings> {
    let tip = ring(&[(x, y), (x + 1.0, y + 4.0), (x - 1.0, y + 4.0)]);
    vec![rectangle(0.0, 0.0, 4.0, 1.0), tip]
}

#[test]
fn a_node_is_near_a_side_between_its_ends_and_within_the_smaller_gap() {
    let free = [false; 2];
    for (y, off) in [(1.25, 0.25), (0.75, 0.25), (1.0, 0.0)] {
        for gaps in [[0.25, 0.25], [9.0, 0.25], [0.25, 9.0]] {
            // The upper side runs from right to left.
            let found = beside_first(&box_and_tip(1.5, y), &gaps, &free);
            assert!(found.contains(&(1, 2, 2.5, off)), "{found:?}");
        }
    }
    for gaps in [[0.125, 0.125], [9.0, 0.125], [0.125, 9.0]] {
        for (x, y) in [(1.5, 1.25), (1.5, 0.75), (4.25, 0.5), (-0.25, 0.5), (2.0, -0.25)] {
            assert!(beside_first(&box_and_tip(x, y), &gaps, &free).is_empty());
        }
    }
    // Beyond the ends of a side, a node on the line of the side is not near it.
    for x in [-0.5, 4.5] {
        assert!(beside_first(&box_and_tip(x, 1.0), &[0.25; 2], &free).is_empty());
    }
    let right = beside_first(&box_and_tip(4.125, 0.25), &[0.25; 2], &free);
    assert_eq!(right, [(1, 1, 0.25, 0.125)]);
    // An inclined side, from (6, 0) to (2, 3). The tip is 2 along it and 1/4 away from it, on either side.
    for (side, off) in [(1.0, 0.25), (-1.0, 0.25)] {
        let mut bodies = box_and_tip(6.0 - 1.6 + side * 0.15, 1.2 + side * 0.2);
        bodies[0] = ring(&[(0.0, 0.0), (6.0, 0.0), (2.0, 3.0)]);
        let found = beside_first(&bodies, &[0.26, 0.26], &free);
        let (_, corner, reach, away) = found[0];
        assert_eq!((found.len(), corner), (1, 1));
        assert!((reach - 2.0).abs() < 1e-12 && (away - off).abs() < 1e-12);
    }
}

#[test]
fn a_fixed_curve_gets_no_corners() {
    for (curved, kept, found) in [(false, true, 1), (true, false, 1), (true, true, 0)] {
        let mut bodies = box_and_tip(1.5, 1.25);
        bodies[0][0][2].curved = curved;
        let all = beside_first(&bodies, &[0.25; 2], &[kept, false]);
        assert_eq!(all.len(), found, "{curved} {kept}");
        // It makes no difference whether the other body is fixed.
        assert_eq!(beside_first(&bodies, &[0.25; 2], &[false, true]).len(), 1);
    }
}

const NONE: [usize; 0] = [];

/// The numbers of the bodies that are damaged. An overlap may become deeper by a millionth of a metre.
fn worse(before: [Rings; 2], after: [Rings; 2]) -> Vec<usize> {
    let wrong = damaged_bodies(&before, &after, &[0.001, 1.0], 0.001);
    wrong.into_iter().collect()
}

#[test]
fn a_body_is_damaged_if_its_ring_is_reversed_or_loses_half_its_area() {
    let far = || rectangle(9.0, 9.0, 1.0, 1.0);
    let to = |after: Rings| worse([rectangle(0.0, 0.0, 2.0, 2.0), far()], [after, far()]);
    assert_eq!(to(rectangle(0.0, 0.0, 2.0, 1.0)), [0]);
    assert_eq!(to(rectangle(0.0, 0.0, 2.0, 1.01)), NONE);
    assert_eq!(to(rectangle(0.0, 0.0, 3.0, 3.0)), NONE, "a larger body is not damaged");
    assert_eq!(to(rectangle(0.0, 0.0, -2.0, 2.0)), [0]);
    let crossed = [(0.0, 0.0), (2.0, 0.0), (0.0, 2.0), (3.0, 3.0), (0.0, 3.0), (3.0, 1.0)];
    assert_eq!(to(ring(&crossed)), [0], "no longer an outline");
    // A body drawn clockwise is judged in the same way.
    let clockwise = |h: f64| rectangle(2.0, 0.0, -2.0, h);
    assert_eq!(worse([far(), clockwise(2.0)], [far(), clockwise(2.0)]), NONE);
    assert_eq!(worse([far(), clockwise(2.0)], [far(), clockwise(0.9)]), [1]);
    // A hole counts like an outline.
    let holed = |w: f64| {
        let mut rings = rectangle(0.0, 0.0, 4.0, 4.0);
        rings.extend(rectangle(1.0, 1.0, w, 1.0));
        rings
    };
    assert_eq!(worse([holed(2.0), far()], [holed(1.1), far()]), NONE);
    assert_eq!(worse([holed(2.0), far()], [holed(0.9), far()]), [0]);
}

#[test]
fn a_body_is_damaged_if_it_overlaps_its_neighbour_more_than_before() {
    let deep = |by: f64| [rectangle(0.0, 0.0, 2.0, 1.0), rectangle(0.0, 1.0 - by, 2.0, 1.0)];
    // The overlap may grow by a thousandth of the smaller gap, which is a millionth.
    for (before, after, wrong) in [
        (0.0, 1e-5, true),
        (0.0, 0.5e-6, false),
        (-0.1, 1e-5, true),
        (0.1, 0.1, false),
        (0.1, 0.1 + 0.5e-6, false),
        (0.1, 0.1 + 1e-5, true),
        (0.1, 0.05, false),
        (0.1, 0.0, false),
    ] {
        let found = worse(deep(before), deep(after));
        assert_eq!(found, if wrong { vec![0, 1] } else { vec![] }, "{before} {after}");
    }
}

#[test]
fn sides_go_round_every_ring() {
    let mut rings = ring(&[(0.0, 0.0), (8.0, 0.0), (0.0, 8.0)]);
    rings.extend(ring(&[(1.0, 1.0), (1.0, 2.0), (3.0, 1.0)]));
    let bodies = [rectangle(-9.0, -9.0, 1.0, 1.0), rings];
    let nodes = Nodes::new(&bodies, Gaps::new(&[0.1; 2]), &[false; 2]);
    let all = sides(&bodies, &nodes);
    let named: Vec<_> = all[4..].iter().map(|s| (s.body, s.ring, s.corner, s.ends)).collect();
    let wanted = [
        (1, 0, 0, [4, 5]),
        (1, 0, 1, [5, 6]),
        (1, 0, 2, [6, 4]),
        (1, 1, 0, [7, 8]),
        (1, 1, 1, [8, 9]),
        (1, 1, 2, [9, 7]),
    ];
    assert_eq!(named, wanted);
}
