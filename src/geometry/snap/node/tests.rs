//! Tests of which corners are merged into one node, and of the position of the node.

use super::*;
use crate::geometry::snap::Corner;

/// Bodies of one ring each.
fn bodies(all: &[&[[f64; 2]]]) -> Vec<Rings> {
    let corner = |p: &[f64; 2]| Corner { at: Point::new(p[0], p[1]), curved: false };
    let ring = |corners: &&[[f64; 2]]| vec![corners.iter().map(corner).collect()];
    all.iter().map(ring).collect()
}

/// The nodes of bodies with one corner each, all at the same height. Also returns the number of each corner's node.
fn along(places: &[f64], gaps: &[f64], kept: &[bool]) -> (Nodes, Vec<usize>) {
    let corners: Vec<[[f64; 2]; 1]> = places.iter().map(|x| [[*x, 7.0]]).collect();
    let all: Vec<&[[f64; 2]]> = corners.iter().map(|c| &c[..]).collect();
    let nodes = Nodes::new(&bodies(&all), Gaps::new(gaps), kept);
    let numbers = (0..places.len()).map(|b| nodes.number(b, 0, 0)).collect();
    (nodes, numbers)
}

fn free(places: &[f64], gaps: &[f64]) -> (Nodes, Vec<usize>) {
    along(places, gaps, &vec![false; places.len()])
}

#[test]
fn corners_are_merged_up_to_and_including_the_smaller_gap() {
    for (gaps, one) in
        [([0.25, 0.25], true), ([0.25, 9.0], true), ([9.0, 0.25], true), ([0.125, 9.0], false), ([9.0, 0.125], false)]
    {
        // Exactly a quarter apart.
        let (nodes, numbers) = free(&[1.0, 1.25], &gaps);
        assert_eq!(numbers, if one { [0, 0] } else { [0, 1] }, "{gaps:?}");
        assert_eq!(nodes.all.len(), if one { 1 } else { 2 });
        assert_eq!(nodes.exact, !one);
        assert_eq!(nodes.all[0].gap, if one { 0.25 } else { gaps[0] });
        assert_eq!(nodes.all[0].at, Point::new(1.0, 7.0), "the earlier body stays");
    }
    // The distance counts in any direction.
    for [x, y] in [[0.0, 0.25], [0.0, -0.25], [-0.25, 0.0], [0.15, 0.2], [-0.15, -0.2]] {
        let both = bodies(&[&[[3.0, 5.0]], &[[3.0 + x, 5.0 + y]]]);
        let count = |gap: f64| Nodes::new(&both, Gaps::new(&[gap; 2]), &[false; 2]).all.len();
        assert_eq!((count(0.251), count(0.249)), (1, 2));
    }
}

#[test]
fn all_corners_of_a_node_lie_within_the_gap_of_each_other() {
    // Corners at equal steps: the second is merged with the first, but the third is too far from the first.
    let (nodes, numbers) = free(&[0.0, 0.75, 1.5, 2.25], &[1.0; 4]);
    assert_eq!(numbers, [0, 0, 1, 1]);
    assert_eq!(nodes.bodies(&nodes.all[1]), [2, 3]);
    assert!(!nodes.exact);
    // The closest corners are merged first, whatever their order.
    let (_, numbers) = free(&[0.0, 0.75, 1.25], &[1.0; 3]);
    assert_eq!(numbers, [0, 1, 1]);
    let (nodes, numbers) = free(&[1.25, 0.0, 0.75, 0.25], &[1.0, 1.0, 1.0, 0.5]);
    assert_eq!(numbers, [0, 1, 0, 1]);
    assert_eq!(nodes.all[1].gap, 0.5);
    // Two nodes of two corners become one node if all four are close enough.
    let (nodes, numbers) = free(&[0.0, 0.875, 0.125, 1.0], &[1.0; 4]);
    assert_eq!(numbers, [0; 4]);
    assert_eq!(nodes.bodies(&nodes.all[0]), [0, 1, 2, 3]);
    assert_eq!(nodes.all[0].at, Point::new(0.0, 7.0));
    // A corner with a small gap is not merged with corners that are farther away than this gap.
    let (_, numbers) = free(&[0.0, 0.25, 0.75], &[1.0, 1.0, 0.5]);
    assert_eq!(numbers, [0, 0, 1]);
}

#[test]
fn of_pairs_at_the_same_distance_the_earlier_bodies_are_merged() {
    // The third corner is 5 away from the first and from the second; the fourth is 5 away from the first. The second
    // and the fourth are 11 apart, the other pairs 8.9.
    let all = bodies(&[&[[5.0, 0.0]], &[[-3.0, 4.0]], &[[0.0, 0.0]], &[[8.0, 4.0]]]);
    let nodes = Nodes::new(&all, Gaps::new(&[9.0; 4]), &[false; 4]);
    assert_eq!(nodes.bodies(&nodes.all[0]), [0, 1, 2]);
    assert_eq!(nodes.bodies(&nodes.all[1]), [3]);
}

#[test]
fn corners_of_one_body_are_not_merged() {
    let both = bodies(&[&[[0.0, 0.0], [0.5, 0.0], [9.0, 9.0]], &[[0.25, 0.0], [0.25, 0.125], [-9.0, 9.0]]]);
    let nodes = Nodes::new(&both, Gaps::new(&[1.0; 2]), &[false; 2]);
    let numbers = [0, 1].map(|body| [0, 1, 2].map(|corner| nodes.number(body, 0, corner)));
    // Each of the first two corners is merged with a corner of the other body, not with each other.
    assert_eq!(numbers, [[0, 1, 2], [0, 1, 3]]);
    assert_eq!(nodes.all[1].at, Point::new(0.5, 0.0));
}

#[test]
fn other_corners_move_to_a_fixed_corner() {
    let (nodes, numbers) = along(&[0.0, 0.5], &[1.0; 2], &[false, true]);
    assert_eq!(numbers, [0, 0]);
    assert_eq!(nodes.all[0].at, Point::new(0.5, 7.0));
    assert!(nodes.all[0].fixed);
    let (nodes, _) = along(&[0.0, 0.5], &[1.0; 2], &[true, false]);
    assert_eq!(nodes.all[0].at, Point::new(0.0, 7.0));
    assert!(!free(&[0.0, 0.5], &[1.0; 2]).0.all[0].fixed);
    // Two fixed corners are merged only if their positions are equal.
    let (nodes, numbers) = along(&[0.0, 0.0, 0.5], &[1.0; 3], &[true; 3]);
    assert_eq!(numbers, [0, 0, 1]);
    assert!(nodes.exact && nodes.all.iter().all(|n| n.fixed));
}

#[test]
fn corners_are_numbered_through_all_rings_of_all_bodies() {
    let ring = |x: f64| {
        let all = [[x, 0.0], [x + 1.0, 0.0], [x, 1.0]];
        bodies(&[&all]).remove(0).remove(0)
    };
    let both = [vec![ring(0.0), ring(10.0)], vec![ring(20.0), ring(30.0)]];
    let nodes = Nodes::new(&both, Gaps::new(&[0.1; 2]), &[false; 2]);
    assert_eq!(nodes.all.len(), 12);
    for (body, rings) in both.iter().enumerate() {
        for (k, ring) in rings.iter().enumerate() {
            for (corner, c) in ring.iter().enumerate() {
                assert_eq!(nodes.all[nodes.number(body, k, corner)].at, c.at);
            }
        }
    }
    assert!(nodes.exact);
}
