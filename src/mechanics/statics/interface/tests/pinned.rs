//! Tests of which stone keeps a gap open, and in which frames.

use super::*;
use crate::mechanics::statics::interface::pinned::{ContactsByBody, pinning_stone};

const GROUND: BodyId = BodyId::Ground(0);
const STONE: BodyId = BodyId::Block(BlockId(1));

/// Creates an interface 1 m long with this middle and this unit normal.
fn interface(bodies: [BodyId; 2], middle: [f64; 2], normal: [f64; 2]) -> Interface {
    let along = Vector::new(-normal[1], normal[0]) / 2.0;
    let middle = Point::new(middle[0], middle[1]);
    Interface {
        bodies,
        kind: ContactKind::Edge,
        ends: [middle - along, middle + along],
        normal: Vector::new(normal[0], normal[1]),
        friction: 0.5,
    }
}

/// A gap of 2 m between the first block and the ground below it.
fn gap() -> NearMiss {
    NearMiss { bodies: [FIRST, GROUND], at: Point::new(0.0, 2.0), distance: 2.0 }
}

fn below() -> Interface {
    interface([STONE, GROUND], [0.0, 0.0], [0.0, 1.0])
}

fn above(x: f64, height: f64) -> Interface {
    interface([FIRST, STONE], [x, height], [0.0, 1.0])
}

fn keeps(all: &[Interface], is_present: bool, tolerance: f64) -> Option<BlockId> {
    pinning_stone(&gap(), &ContactsByBody::new(all), |_| is_present, tolerance)
}

#[test]
fn a_stone_between_half_and_eleven_tenths_of_the_gap_keeps_it_open() {
    for (height, tolerance, holds) in [
        (2.0, 0.0, true),
        (-2.0, 0.0, true),
        (2.19, 0.0, true),
        (2.21, 0.0, false),
        (2.69, 0.5, true),
        (2.71, 0.5, false),
        (1.01, 0.0, true),
        (0.99, 0.0, false),
        (0.0, 0.0, false),
    ] {
        // The position of the upper contact along the gap has no influence. Only its height counts.
        for x in [0.0, 30.0] {
            let found = keeps(&[below(), above(x, height)], true, tolerance);
            assert_eq!(found, holds.then_some(BlockId(1)), "{height} {tolerance}");
        }
    }
}

#[test]
fn a_stone_keeps_a_gap_open_only_if_it_is_present_and_touches_both_bodies() {
    assert_eq!(keeps(&[below(), above(0.0, 2.0)], false, 0.0), None);
    assert_eq!(keeps(&[below()], true, 0.0), None);
    assert_eq!(keeps(&[above(0.0, 2.0)], true, 0.0), None);
    // The upper side of the stone is inclined: at 1/20 it still counts, at 3/4 it does not.
    for (normal, holds) in [([0.05, 0.998_75], true), ([0.6, 0.8], false)] {
        let inclined = interface([FIRST, STONE], [0.0, 2.0], normal);
        let found = keeps(&[below(), inclined], true, 0.0);
        assert_eq!(found.is_some(), holds, "{normal:?}");
    }
    // A stone below another block does not keep this gap open, and neither does a part of the ground.
    let third = BodyId::Block(BlockId(2));
    let other = interface([third, STONE], [0.0, 2.0], [0.0, 1.0]);
    assert_eq!(keeps(&[below(), other], true, 0.0), None);
    let part = BodyId::Ground(1);
    let parts = [interface([FIRST, part], [0.0, 2.0], [0.0, 1.0]), interface([FIRST, GROUND], [0.0, 0.0], [0.0, 1.0])];
    assert_eq!(keeps(&parts, true, 0.0), None);
}

/// A brick above a brick at a distance that still counts as contact, and two stones. The first stone is as high as
/// the gap.
fn pinned() -> Scene {
    let height = 1e-6;
    let mut bricks = [
        rectangle(0.0, 0.0, 2.0, 1.0),
        rectangle(0.0, 1.0, 2.0, 1.0),
        rectangle(0.5, 1.0, 1.0, 1.0),
        rectangle(3.0, 0.0, 1.0, 1.0),
    ];
    bricks[1].iter_mut().for_each(|p| p[1] += height);
    let base = bricks[2][0];
    bricks[2] =
        vec![base, [base[0] + height, base[1]], [base[0] + height, base[1] + height], [base[0], base[1] + height]];
    scene(vec![rectangle(-5.0, -1.0, 10.0, 1.0)], bricks.into())
}

fn frame(placed: &[usize]) -> Frame {
    Frame {
        title: String::new(),
        placed: placed.iter().map(|n| BlockId(*n)).collect(),
        holds: Vec::new(),
        plans: Vec::new(),
        expected: None,
    }
}

#[test]
fn a_frame_has_the_contacts_of_its_blocks_except_in_gaps_that_its_stones_keep_open() {
    let scene = pinned();
    let found = Interfaces::new(&scene);
    assert_eq!(found.pinned_gaps.len(), 1, "{:?}", found.pinned_gaps);
    assert_eq!(found.pinned_gaps[0].stone, BlockId(2));
    let block = |n: usize| BodyId::Block(BlockId(n));
    let pairs = |placed: &[usize]| {
        let list = found.in_frame(&frame(placed));
        let edges = list.iter().filter(|i| i.kind == ContactKind::Edge);
        edges.map(|i| i.bodies).collect::<Vec<_>>()
    };
    let foot = [block(0), GROUND];
    assert_eq!(pairs(&[]), [] as [[BodyId; 2]; 0]);
    assert_eq!(pairs(&[0]), [foot]);
    assert_eq!(pairs(&[1]), [] as [[BodyId; 2]; 0]);
    assert_eq!(pairs(&[0, 1]), [foot, [block(1), block(0)]]);
    let pin = [[block(2), block(0)], [block(2), block(1)]];
    assert_eq!(pairs(&[0, 1, 2]), [foot, pin[0], pin[1]]);
    assert_eq!(pairs(&[1, 2, 3]), [pin[1], [block(3), GROUND]]);
}

#[test]
fn a_gap_contains_only_interfaces_of_its_bodies_near_its_position() {
    let pinned_gaps = PinnedGap { gap: gap(), stone: BlockId(1) };
    let seam = |x: f64, y: f64| interface([FIRST, GROUND], [x, y], [0.0, 1.0]);
    // The interface may be as far from the gap as it is long, here 1 m. Across the gap it may be no farther away than
    // the gap's 2 m.
    for (x, y, inside) in
        [(0.0, 2.0, true), (0.9, 2.0, true), (-0.9, 2.0, true), (1.1, 2.0, false), (0.0, 2.9, true), (0.0, 3.1, false)]
    {
        assert_eq!(pinned_gaps.contains(&seam(x, y)), inside, "{x} {y}");
    }
    let mut long = seam(0.0, 4.1);
    long.ends = [Point::new(9.0, 4.1), Point::new(-9.0, 4.1)];
    assert!(!pinned_gaps.contains(&long));
    long.ends = [Point::new(9.0, 3.9), Point::new(-9.0, 3.9)];
    assert!(pinned_gaps.contains(&long));
    let other = interface([STONE, GROUND], [0.0, 2.0], [0.0, 1.0]);
    assert!(!pinned_gaps.contains(&other));
}
