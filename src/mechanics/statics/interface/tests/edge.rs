//! Tests of edges that face each other: their distance, inclination, length and direction.

use super::*;

/// Rotates a point anticlockwise by this number of quarter turns.
fn quarters(p: Pair, times: usize) -> Pair {
    (0..times).fold(p, |[x, y], _| [-y, x])
}

#[test]
fn application_points_lie_inward_of_the_ends() {
    // The interface is 5 m long, from the lower right to the upper left.
    let seam = Interface {
        bodies: [FIRST, BodyId::Ground(0)],
        kind: ContactKind::Edge,
        ends: [Point::new(5.0, 1.0), Point::new(1.0, 4.0)],
        normal: Vector::new(0.6, 0.8),
        friction: 0.5,
    };
    assert_eq!(seam.tangent(), Vector::new(-0.8, 0.6));
    assert_eq!(seam.length(), 5.0);
    assert_eq!(seam.middle(), Point::new(3.0, 2.5));
    let points = |kernel: f64| seam.application_points(kernel);
    assert_eq!(points(0.0), seam.ends);
    assert_eq!(points(0.5), [Point::new(4.0, 1.75), Point::new(2.0, 3.25)]);
    assert_eq!(points(1.0), [seam.middle(); 2]);
}

/// A block above a ledge, and the same scene rotated by quarter turns: the distance and the position relative to the
/// block are the same.
#[test]
fn edges_are_found_on_every_side_of_a_block() {
    for times in 0..4 {
        let at = |apart: f64| {
            let turned = |list: Vec<Pair>| list.iter().map(|p| quarters(*p, times)).collect::<Vec<_>>();
            let ledge = turned(rectangle(-2.0, -1.0, 3.0, 1.0));
            let block = rectangle(-0.75, 0.0, 4.0, 2.0);
            let block = block.iter().map(|p| [p[0], p[1] + apart]).collect();
            scene(vec![ledge], vec![turned(block)])
        };
        let gap = gap(&at(0.0), BodyId::Ground(0));
        let outward = quarters([0.0, 1.0], times);
        let found = Interfaces::new(&at(0.9 * gap));
        assert_eq!((found.all.len(), found.near_misses.len()), (1, 0), "{times}");
        assert!(near(found.all[0].normal, outward));
        let apart = Interfaces::new(&at(29.0 * gap));
        assert_eq!((apart.all.len(), apart.near_misses.len()), (0, 1), "{times}");
        let place = quarters([0.125 * ODD, 29.0 * gap], times);
        let off = apart.near_misses[0].at - Point::new(place[0], place[1]);
        assert!(off.norm() < 1e-9, "{:?}", apart.near_misses[0]);
    }
}

/// The smaller of two blocks decides whether edges are too far apart, whatever the order of the blocks.
#[test]
fn the_size_of_the_smaller_block_limits_near_misses() {
    let (small, large) = (|apart: f64| rectangle(0.0, 4.0 + apart, 1.0, 1.0), rectangle(0.0, 0.0, 4.0, 4.0));
    let floor = vec![rectangle(-5.0, -1.0, 20.0, 1.0)];
    for (share, seen) in [(0.009, 1), (0.011, 0), (0.03, 0)] {
        let example = scene(floor.clone(), vec![small(share), large.clone()]);
        assert_eq!(Interfaces::new(&example).near_misses.len(), seen, "{share}");
        let example = scene(floor.clone(), vec![large.clone(), small(share)]);
        assert_eq!(Interfaces::new(&example).near_misses.len(), seen, "{share}");
    }
}

/// The second block lies higher than the first by `apart`. It begins at the first block's right end, minus `shared`.
#[test]
fn edges_whose_overlap_is_shorter_than_their_distance_do_not_face_each_other() {
    let at = |shared: f64, apart: f64| {
        let other = rectangle(2.0, 1.0, 2.0, 1.0);
        let other = other.iter().map(|p| [p[0] - shared, p[1] + apart]);
        scene(vec![rectangle(-5.0, -1.0, 10.0, 1.0)], vec![rectangle(0.0, 0.0, 2.0, 1.0), other.collect()])
    };
    let gap = at(0.0, 0.0).tolerance_between(FIRST, SECOND).gap;
    for (shared, apart, seen) in [(25.0, 20.0, 1), (19.0, 20.0, 0), (5.0, 20.0, 0), (-5.0, 20.0, 0), (-5.0, 0.0, 0)] {
        let found = Interfaces::new(&at(shared * gap, apart * gap));
        let edges = found.all.iter().filter(|i| i.kind == ContactKind::Edge);
        assert_eq!(edges.count(), 1, "{shared} {apart}");
        assert_eq!(found.near_misses.len(), seen, "{shared} {apart}");
        assert_eq!(found.notices.len(), seen, "{shared} {apart}");
    }
}

/// A box whose right end is raised by `rise` times the gap. The floor ends `width` m to the right of the box's left
/// end. Also returns the gap, the contact tolerance in metres.
fn askew(rise: f64, width: f64) -> (Scene, f64) {
    let at = |rise: f64| {
        let mut block = rectangle(0.0, 0.0, 2.0, 2.0);
        block[1][1] += rise;
        scene(vec![rectangle(width - 9.0, -1.0, 9.0, 1.0)], vec![block])
    };
    let gap = gap(&at(0.0), BodyId::Ground(0));
    (at(rise * gap), gap)
}

#[test]
fn the_distance_of_inclined_edges_is_that_of_the_wider_end() {
    let (scene, gap) = askew(5.0, 4.0);
    let found = Interfaces::new(&scene);
    assert_eq!(found.near_misses.len(), 1);
    let miss = found.near_misses[0];
    assert!((miss.distance - 5.0 * gap).abs() < 1e-12, "{miss:?}");
    assert!((miss.at.x - ODD).abs() < 1e-5);
    assert!(found.all.iter().all(|i| i.kind == ContactKind::Corner));
}

/// Over the shared 10 mm the edges are closer than the gap even at a rise of 50 gaps. Such edges still form no joint.
#[test]
fn strongly_inclined_edges_have_no_joint_even_over_a_short_overlap() {
    for (rise, joints) in [(1.9, 1), (50.0, 0)] {
        let (scene, gap) = askew(rise, 0.01);
        let found = Interfaces::new(&scene).all;
        let joints_found = found.iter().filter(|i| i.kind == ContactKind::Edge).count();
        assert_eq!(joints_found, joints, "{rise} {gap}");
    }
}

#[test]
fn two_segments_of_one_line_are_joined_and_opposite_faces_are_not() {
    // A corner in the floor, below the block.
    let floor = odd(&[[-5.0, -1.0], [5.0, -1.0], [5.0, 0.0], [0.75, 0.0], [-5.0, 0.0]]);
    let example = scene(vec![floor], vec![rectangle(0.0, 0.0, 2.0, 1.0)]);
    let found = Interfaces::new(&example).all;
    assert_eq!(found.len(), 1, "{found:?}");
    let ends = found[0].ends.map(|p| p.x);
    assert!((ends[0] - 2.0 * ODD).abs() < 1e-9 && ends[1].abs() < 1e-9);
    // A fin in a slot. It is thinner than the distance over which segments are joined. Its two faces are pressed in
    // opposite directions.
    let width = 8e-6;
    let (left, right) = (1.0, 1.0 + width);
    let slotted = odd(&[
        [-5.0, -2.0],
        [5.0, -2.0],
        [5.0, 0.0],
        [right, 0.0],
        [right, -1.0],
        [left, -1.0],
        [left, 0.0],
        [-5.0, 0.0],
    ]);
    let finned =
        odd(&[[left, -1.0], [right, -1.0], [right, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.0, 0.0], [left, 0.0]]);
    let example = scene(vec![slotted], vec![finned]);
    let gap = gap(&example, BodyId::Ground(0));
    assert!(gap < width && width < 4.0 * gap, "{gap}");
    let found = Interfaces::new(&example).all;
    let faces: Vec<f64> =
        found.iter().filter(|i| i.length() > 0.5 && i.normal.x.abs() > 0.5).map(|i| i.normal.x).collect();
    assert_eq!(faces.len(), 2, "{found:?}");
    assert!((faces[0] + faces[1]).abs() < 1e-9, "{faces:?}");
}

/// Two segments that meet at a corner are not joined.
#[test]
fn segments_are_joined_only_in_one_line() {
    let stair = odd(&[[-5.0, -1.0], [1.0, -1.0], [1.0, 0.0], [-5.0, 3.0]]);
    let block = odd(&[[1.0, -1.0], [3.0, -1.0], [3.0, 3.0], [-5.0, 3.0], [1.0, 0.0]]);
    let found = Interfaces::new(&scene(vec![stair], vec![block])).all;
    let edges = found.iter().filter(|i| i.kind == ContactKind::Edge);
    let lengths: Vec<f64> = edges.map(|i| i.length() / ODD).collect();
    assert_eq!(lengths.len(), 2, "{found:?}");
    let expected = libm::sqrt(45.0) + 1.0;
    assert!((lengths.iter().sum::<f64>() - expected).abs() < 1e-9);
}

#[test]
fn slivers_count_as_interfaces_on_request() {
    let at = |shared: f64, tolerance: Option<f64>| {
        let mut scene = Scene::builder().friction(0.5);
        if let Some(tolerance) = tolerance {
            scene = scene.contact_tolerance(tolerance);
        }
        scene
            .ground(rectangle(-5.0, -1.0, 10.0, 1.0))
            .block(BlockEntry::new("a").polygon(rectangle(0.0, 0.0, 2.0, 1.0)))
            .block(BlockEntry::new("b").polygon(rectangle(-2.0 + shared, 1.0, 2.0, 1.0)))
            .build()
            .expect("the scene is valid")
    };
    let found = Interfaces::new(&at(1e-7, None));
    assert_eq!((found.all.len(), found.slivers.len()), (1, 1));
    assert_eq!(found.notices.len(), 1);
    assert!((found.slivers[0].length() - 1e-7 * ODD).abs() < 1e-12);
    let counted = found.with_slivers();
    assert_eq!((counted.all.len(), counted.slivers.len()), (2, 0));
    let pairs: Vec<[BodyId; 2]> = counted.all.iter().map(|i| i.bodies).collect();
    assert_eq!(pairs, [[FIRST, BodyId::Ground(0)], [SECOND, FIRST]]);
    // A contact at a point, up to the rounding of numbers, is not even a sliver.
    let found = Interfaces::new(&at(1e-10, None));
    assert_eq!((found.slivers.len(), found.notices.len()), (0, 0));
    // Three slivers are reported together, with the length of the longest.
    let row = |shared: f64, x: f64| [rectangle(x, 0.0, 1.0, 1.0), rectangle(x - 1.0 + shared, 1.0, 1.0, 1.0)];
    let rows = [row(1e-7, -3.0), row(3e-7, 0.0), row(2e-7, 3.0)].concat();
    let found = Interfaces::new(&scene(vec![rectangle(-9.0, -1.0, 18.0, 1.0)], rows));
    let begin = "3 contact(s) up to 3.1×10⁻⁷ m long are shorter than ";
    assert!(found.notices[0].starts_with(begin), "{:?}", found.notices);
}

/// A box whose left end is raised by ten gaps. On a floor that begins below its middle, the distance is five gaps.
#[test]
fn the_distance_of_edges_is_measured_only_where_they_overlap() {
    let at = |rise: f64, begin: f64| {
        let mut block = rectangle(0.0, 0.0, 2.0, 2.0);
        block[0][1] += rise;
        scene(vec![rectangle(begin, -1.0, 9.0, 1.0)], vec![block])
    };
    let gap = gap(&at(0.0, 1.0), BodyId::Ground(0));
    for (begin, apart) in [(1.0, 5.0), (0.5, 7.5), (-1.0, 10.0)] {
        let found = Interfaces::new(&at(10.0 * gap, begin));
        assert_eq!(found.near_misses.len(), 1, "{begin}");
        let off = (found.near_misses[0].distance - apart * gap).abs();
        assert!(off < 1e-9, "{begin} {:?}", found.near_misses[0]);
    }
}
