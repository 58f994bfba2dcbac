//! Tests of contacts in scenes whose contacts are obvious.

use super::*;
use crate::mechanics::scene::format::{BlockEntry, CellEntry, CellHalf, GridKind, GroundEntry, Pair};
use crate::text::power_of_ten;

mod corner;
mod edge;
mod pinned;
mod lattice;

/// Coordinates that are multiplied by this number have all their digits. They do not count as rounded, so that no
/// corner is moved.
const ODD: f64 = 1.023_456_789_012_345_6;

fn odd(corners: &[Pair]) -> Vec<Pair> {
    corners.iter().map(|p| p.map(|v| v * ODD)).collect()
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<Pair> {
    odd(&[[x, y], [x + width, y], [x + width, y + height], [x, y + height]])
}

/// A scene with these parts of the ground and these blocks, and with corner contacts.
fn scene(ground: Vec<Vec<Pair>>, blocks: Vec<Vec<Pair>>) -> Scene {
    let mut scene = Scene::builder().friction(0.5).corner_contacts(true);
    for part in ground {
        scene = scene.ground(part);
    }
    for (number, block) in blocks.into_iter().enumerate() {
        scene = scene.block(BlockEntry::new(format!("{number}")).polygon(block));
    }
    scene.build().expect("the scene is valid")
}

const FIRST: BodyId = BodyId::Block(BlockId(0));
const SECOND: BodyId = BodyId::Block(BlockId(1));

/// The gap within which the first block touches the other body.
fn gap(scene: &Scene, other: BodyId) -> f64 {
    scene.tolerance_between(FIRST, other).gap
}

fn near(found: Vector, expected: [f64; 2]) -> bool {
    (found - Vector::new(expected[0], expected[1])).norm() < 1e-9
}

#[test]
fn a_tip_touches_an_edge_on_any_side_within_the_tolerance_and_no_farther() {
    // A triangle whose tip points at the ground. The ground lies below, above, left and right of it; `outward` is the
    // outward normal of the ground.
    let tip = [[0.0, 0.0], [1.0, 2.0], [-1.0, 2.0]];
    let turned = |[x, y]: Pair, [nx, ny]: Pair| [x * ny + y * nx, y * ny - x * nx];
    let slab = [[-5.0, -1.0], [5.0, -1.0], [5.0, 0.0], [-5.0, 0.0]];
    for outward in [[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]] {
        let at = |apart: f64| {
            let place = |p: &Pair| turned(*p, outward);
            let block: Vec<Pair> = odd(&tip.iter().map(place).collect::<Vec<_>>());
            let block = block.iter().map(|p| [p[0] + apart * outward[0], p[1] + apart * outward[1]]).collect();
            scene(vec![odd(&slab.iter().map(place).collect::<Vec<_>>())], vec![block])
        };
        let gap = gap(&at(0.0), BodyId::Ground(0));
        for (apart, touches) in [(0.0, true), (0.9 * gap, true), (1.2 * gap, false)] {
            let found = Interfaces::new(&at(apart)).all;
            assert_eq!(found.len(), usize::from(touches), "{outward:?} {apart}");
            for corner in found {
                assert_eq!(corner.kind, ContactKind::Corner);
                assert_eq!(corner.bodies, [FIRST, BodyId::Ground(0)]);
                assert!(near(corner.normal, outward), "{corner:?}");
                assert_eq!(corner.length(), 0.0);
                assert_eq!(corner.friction, 0.5);
            }
        }
    }
}

#[test]
fn tips_that_meet_press_along_their_bisector() {
    // The block's lower left corner meets the ground's upper right corner. Then its lower right corner meets the
    // ground's upper left corner.
    for (x, normal) in [(0.0, core::f64::consts::FRAC_1_SQRT_2), (-3.0, -core::f64::consts::FRAC_1_SQRT_2)] {
        let scene = scene(vec![rectangle(-2.0, -1.0, 2.0, 1.0)], vec![rectangle(x, 0.0, 1.0, 1.0)]);
        let found = Interfaces::new(&scene).all;
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(near(found[0].normal, [normal, normal.abs()]), "{found:?}");
    }
}

#[test]
fn a_corner_is_a_contact_only_away_from_edge_contacts() {
    let floor = || vec![rectangle(-20.0, -1.0, 40.0, 1.0)];
    let alone = Interfaces::new(&scene(floor(), vec![rectangle(0.0, 0.0, 2.0, 1.0)])).all;
    let kinds: Vec<ContactKind> = alone.iter().map(|i| i.kind).collect();
    assert_eq!(kinds, [ContactKind::Edge]);
    // A table with a flat leg, and a pointed leg 2 m away from it.
    let table = odd(&[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [2.5, 2.0], [3.0, 0.0], [3.5, 3.0], [0.0, 3.0]]);
    let mut found = Interfaces::new(&scene(floor(), vec![table])).all;
    found.sort_by_key(|i| i.kind == ContactKind::Corner);
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!(found[0].kind, ContactKind::Edge);
    assert!((found[0].length() - ODD).abs() < 1e-9);
    assert_eq!(found[1].kind, ContactKind::Corner);
    assert!((found[1].ends[0].x - 3.0 * ODD).abs() < 1e-9);
    assert!(near(found[1].normal, [0.0, 1.0]));
}

#[test]
fn interfaces_are_sorted_by_bodies_and_then_by_position() {
    // A bridge on five piers, with two feet on each pier. The interfaces of a pair are sorted from left to right, and
    // the pairs by their numbers.
    let mut outline = vec![[0.0, 3.0]];
    for k in 0..10 {
        let x = 2.0 * f64::from(k);
        outline.extend([[x, 1.0], [x + 1.0, 1.0], [x + 1.0, 2.0], [x + 2.0, 2.0]]);
    }
    outline.pop();
    outline.pop();
    outline.push([19.0, 3.0]);
    let mut blocks: Vec<Vec<Pair>> = (0..5).rev().map(|k| rectangle(4.0 * f64::from(k), 0.0, 3.5, 1.0)).collect();
    blocks.push(odd(&outline));
    let scene = scene(vec![rectangle(-5.0, -1.0, 40.0, 1.0)], blocks);
    let found = Interfaces::new(&scene).all;
    assert_eq!(found.len(), 15);
    let order = |i: &Interface| (i.bodies, i.ends[0].x);
    assert!(found.windows(2).all(|w| order(&w[0]) < order(&w[1])));
    for i in &found {
        assert!(near(i.normal, [0.0, 1.0]) && i.ends[0].x > i.ends[1].x);
    }
}

#[test]
fn edges_touch_within_the_tolerance_and_are_near_misses_beyond_it() {
    let at = |apart: f64, more: f64| {
        let ground = vec![rectangle(-2.0, -1.0, 3.0, 1.0)];
        let mut block = rectangle(-0.75, 0.0, 4.0, 2.0);
        block.iter_mut().for_each(|p| p[1] += apart);
        let mut other = rectangle(-9.0, 0.0, 1.0, 1.0);
        other.iter_mut().for_each(|p| p[1] += more);
        let under = rectangle(-9.5, -1.0, 2.0, 1.0);
        scene([ground, vec![under]].concat(), vec![block, other])
    };
    let gap = gap(&at(0.0, 0.0), BodyId::Ground(0));
    let found = Interfaces::new(&at(0.9 * gap, 0.0));
    assert_eq!((found.all.len(), found.near_misses.len()), (2, 0));
    assert!(found.notices.is_empty(), "{:?}", found.notices);
    // The shared segment extends from x = −0.75 to 1, halfway between the two edges.
    let segment = &found.all[0];
    assert!((segment.length() - 1.75 * ODD).abs() < 1e-9);
    assert!((segment.middle().x - 0.125 * ODD).abs() < 1e-9);
    assert!((segment.middle().y - 0.45 * gap).abs() < 1e-12);

    let apart = Interfaces::new(&at(29.0 * gap, 0.0));
    assert_eq!((apart.all.len(), apart.near_misses.len()), (1, 1));
    let miss = apart.near_misses[0];
    assert_eq!(miss.bodies, [FIRST, BodyId::Ground(0)]);
    assert!((miss.distance - 29.0 * gap).abs() < 1e-12);
    assert!((miss.at.x - 0.125 * ODD).abs() < 1e-9 && (miss.at.y - 29.0 * gap).abs() < 1e-12);
    let words = format!(
        "0 and ground nearly touch, {} m apart, more than the {} m that count as contact",
        power_of_ten(29.0 * gap, 1),
        power_of_ten(gap, 1)
    );
    assert_eq!(apart.notices.len(), 1);
    assert_eq!(apart.notices[0], words);
    let both = Interfaces::new(&at(29.0 * gap, 20.0 * gap));
    assert_eq!(both.notices, [words + ", and so do 1 other pair(s) of edges"]);
    // At a larger distance there is a near miss without a notice. Beyond a hundredth of the block's size there is
    // none.
    let apart = Interfaces::new(&at(31.0 * gap, 0.0));
    assert_eq!((apart.near_misses.len(), apart.notices.len()), (1, 0));
    let size = crate::mechanics::scene::size(&at(0.0, 0.0).body(FIRST).polygon);
    for (share, seen) in [(0.0099, 1), (0.0101, 0)] {
        assert_eq!(Interfaces::new(&at(share * size, 0.0)).near_misses.len(), seen);
    }
}

#[test]
fn a_contact_too_short_to_count_is_reported_with_its_length() {
    // A brick on a floor. A second brick, one layer higher, overlaps the first by only 10⁻⁷ m.
    let scene = scene(
        vec![rectangle(-5.0, -1.0, 10.0, 1.0)],
        vec![rectangle(0.0, 0.0, 2.0, 1.0), rectangle(-2.0 + 1e-7, 1.0, 2.0, 1.0)],
    );
    let limit = scene.tolerance_between(FIRST, SECOND).min_length;
    let found = Interfaces::new(&scene);
    let short = format!(
        "1 contact(s) up to 1×10⁻⁷ m long are shorter than {} m and count as touching corners, which carry no force",
        power_of_ten(limit, 1)
    );
    assert_eq!(found.notices, [short]);
    let edges = |list: &[Interface]| {
        let edges = list.iter().filter(|i| i.kind == ContactKind::Edge);
        edges.map(|i| i.bodies).collect::<Vec<_>>()
    };
    assert_eq!(edges(&found.all), [[FIRST, BodyId::Ground(0)]]);
}

/// Short and long edges may be inclined by the gap. At three times the gap they have no joint.
#[test]
fn edges_of_any_length_may_be_inclined_by_the_gap() {
    let at = |width: f64, rise: f64| {
        let block = odd(&[[0.0, 0.0], [width, 0.0], [1.0, 1.0], [-1.0, 1.0]]);
        let mut block = block;
        block[1][1] += rise;
        scene(vec![rectangle(-5.0, -1.0, 10.0, 1.0)], vec![block])
    };
    let gap = gap(&at(0.5, 0.0), BodyId::Ground(0));
    let edges = |scene: &Scene| {
        let all = Interfaces::new(scene).all;
        all.iter().filter(|i| i.kind == ContactKind::Edge).count()
    };
    for width in [0.5, 0.01] {
        assert_eq!(edges(&at(width, 0.9 * gap)), 1, "{width}");
        assert_eq!(edges(&at(width, 3.0 * gap)), 0, "{width}");
    }
}

#[test]
fn an_additional_corner_in_a_straight_edge_changes_nothing() {
    let floor = odd(&[[-5.0, -1.0], [5.0, -1.0], [5.0, 0.0], [2.5, 0.0], [1.0, 0.0], [0.25, 0.0], [-5.0, 0.0]]);
    let scene = scene(vec![floor], vec![rectangle(0.0, 0.0, 2.0, 1.0)]);
    let found = Interfaces::new(&scene).all;
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].length() - 2.0 * ODD).abs() < 1e-9);
    assert!(near(found[0].normal, [0.0, 1.0]));
}

#[test]
fn a_row_of_lattice_edges_is_one_interface() {
    // Two rows of three cells, the upper row shifted by one cell, and a third block next to both.
    let cells = |list: [(f64, f64); 3]| list.map(|(x, y)| CellEntry::Square(x, y));
    let row = |x: f64, y: f64| cells([(x, y), (x + 1.0, y), (x + 2.0, y)]);
    let scene = Scene::builder()
        .grid(GridKind::Square, 2.0)
        .friction(0.5)
        .ground(GroundEntry::default().cells(row(3.0, 4.0)))
        .block(BlockEntry::new("low").cells(row(3.0, 5.0)))
        .block(BlockEntry::new("high").cells(row(4.0, 6.0)))
        .block(BlockEntry::new("beside").cells(cells([(2.0, 5.0), (2.0, 6.0), (3.0, 6.0)])))
        .build()
        .expect("the scene is valid");
    let found = Interfaces::new(&scene).all;
    let block = |n: usize| BodyId::Block(BlockId(n));
    let expected = [
        ([block(0), BodyId::Ground(0)], 6.0, [0.0, 1.0], [9.0, 10.0]),
        ([block(1), block(0)], 4.0, [0.0, 1.0], [10.0, 12.0]),
        ([block(2), block(0)], 2.0, [-1.0, 0.0], [6.0, 11.0]),
        ([block(2), block(0)], 2.0, [0.0, 1.0], [7.0, 12.0]),
        ([block(2), block(1)], 2.0, [-1.0, 0.0], [8.0, 13.0]),
    ];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (one, (bodies, length, normal, middle)) in found.iter().zip(expected) {
        assert_eq!(one.bodies, bodies);
        assert!((one.length() - length).abs() < 1e-12, "{one:?}");
        assert!(near(one.normal, normal), "{one:?}");
        assert!((one.middle() - Point::new(middle[0], middle[1])).norm() < 1e-12);
    }
}
