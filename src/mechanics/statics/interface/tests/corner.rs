//! Tips on edges and tips on tips, of whichever body.

use super::*;

#[test]
fn a_block_that_rests_on_the_tip_of_an_earlier_one_is_pressed_up_by_it() {
    // A roof on the floor, a board on its ridge: the board is named first, and pushed upward.
    let roof = odd(&[[0.0, 0.0], [4.0, 0.0], [2.0, 1.0]]);
    let board = rectangle(-1.0, 1.0, 5.0, 1.0);
    let there = scene(vec![rectangle(-5.0, -1.0, 20.0, 1.0)], vec![roof, board]);
    let found = Interfaces::new(&there).all;
    let corners: Vec<&Interface> = found
        .iter()
        .filter(|i| i.kind == ContactKind::Corner)
        .collect();
    assert_eq!(corners.len(), 1, "{found:?}");
    assert_eq!(corners[0].bodies, [SECOND, FIRST]);
    assert!(near(corners[0].normal, [0.0, 1.0]));
    assert!((corners[0].ends[0] - Point::new(2.0 * ODD, ODD)).norm() < 1e-9);
}

#[test]
fn blocks_at_the_four_corners_of_a_square_press_along_its_diagonals() {
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let blocks = [(2.0, 3.0), (-1.0, 3.0), (-1.0, -1.0), (2.0, -1.0)];
    let blocks = blocks.map(|(x, y)| rectangle(x, y, 1.0, 1.0));
    let found = Interfaces::new(&scene(vec![rectangle(0.0, 0.0, 2.0, 3.0)], blocks.into())).all;
    assert_eq!(found.len(), 4, "{found:?}");
    let normals = [[half, half], [-half, half], [-half, -half], [half, -half]];
    for (tip, normal) in found.iter().zip(normals) {
        assert!(near(tip.normal, normal), "{tip:?}");
    }
}

/// A wedge whose tip stands in a notch of the ground, and a spire of the ground in a notch of a block.
#[test]
fn a_tip_in_a_notch_presses_along_the_notch() {
    let notched = odd(&[
        [-5.0, -3.0],
        [5.0, -3.0],
        [5.0, 0.0],
        [1.5, 0.0],
        [0.0, -1.0],
        [-1.5, 0.0],
        [-5.0, 0.0],
    ]);
    let wedge = odd(&[[0.0, -1.0], [0.5, 0.5], [-0.5, 0.5]]);
    let found = Interfaces::new(&scene(vec![notched], vec![wedge])).all;
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(near(found[0].normal, [0.0, 1.0]), "{found:?}");
    let spire = odd(&[[-1.0, -1.0], [1.0, -1.0], [0.0, 2.0]]);
    let roof = odd(&[
        [-4.0, 0.0],
        [-3.0, 0.0],
        [0.0, 2.0],
        [3.0, 0.0],
        [4.0, 0.0],
        [0.0, 5.0],
    ]);
    let found = Interfaces::new(&scene(vec![spire], vec![roof])).all;
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(near(found[0].normal, [0.0, 1.0]), "{found:?}");
}

/// A pointed post on a slope of 3 : 4, wherever along it; beside it there is no contact.
#[test]
fn a_tip_on_a_slope_is_pushed_square_to_it_wherever_it_stands() {
    // The slope runs from (0, 0) up to (8, 6), on a part of the ground that falls off behind it.
    let slope = odd(&[[0.0, 0.0], [8.0, 0.0], [8.0, 6.0]]);
    let post = |along: f64| {
        let [x, y] = [0.8 * along, 0.6 * along];
        odd(&[[x, y], [x + 0.1, y + 2.0], [x - 0.3, y + 2.0]])
    };
    for along in [0.5, 3.0, 7.0, 9.5] {
        let found = Interfaces::new(&scene(vec![slope.clone()], vec![post(along)])).all;
        assert_eq!(found.len(), 1, "{along} {found:?}");
        assert!(near(found[0].normal, [-0.6, 0.8]), "{found:?}");
        let at = Point::new(0.8 * along * ODD, 0.6 * along * ODD);
        assert!((found[0].ends[0] - at).norm() < 1e-9);
    }
    for beside in [[-1.0, -0.75], [9.0, 6.75], [3.0, 3.0]] {
        let [x, y] = beside;
        let block = odd(&[[x, y], [x + 0.1, y + 2.0], [x - 0.3, y + 2.0]]);
        let found = Interfaces::new(&scene(vec![slope.clone()], vec![block])).all;
        assert!(found.is_empty(), "{beside:?} {found:?}");
    }
}

/// A corner contact beyond the end of a joint by less than four gaps belongs to it, one farther off does not.
#[test]
fn a_tip_beside_a_joint_is_part_of_it_up_to_four_gaps() {
    // A block with a flat foot of 0.3 m and beside it, past a slit, a pointed one.
    let at = |slit: f64| {
        let foot = odd(&[
            [0.0, 0.0],
            [0.3, 0.0],
            [0.3, 1.0],
            [0.3, 1.0],
            [0.3, 0.0],
            [0.6, 1.5],
            [0.0, 1.5],
        ]);
        let mut foot = foot;
        foot.remove(3);
        foot[2][0] += slit / 2.0;
        foot[3][0] += slit;
        scene(vec![rectangle(-5.0, -1.0, 10.0, 1.0)], vec![foot])
    };
    let gap = gap(&at(1e-4), BodyId::Ground(0));
    for (gaps, contacts) in [(3.0, 1), (5.0, 2), (100.0, 2)] {
        let found = Interfaces::new(&at(gaps * gap)).all;
        assert_eq!(found.len(), contacts, "{gaps} {found:?}");
    }
}
