//! Tests of contacts of tips with edges and with other tips.

use super::*;

#[test]
fn a_block_on_the_tip_of_an_earlier_block_is_pushed_upward() {
    // A roof on the floor and a board on its ridge. The contact names the board first and pushes it upward.
    let roof = odd(&[[0.0, 0.0], [4.0, 0.0], [2.0, 1.0]]);
    let board = rectangle(-1.0, 1.0, 5.0, 1.0);
    let example = scene(vec![rectangle(-5.0, -1.0, 20.0, 1.0)], vec![roof, board]);
    let found = Interfaces::new(&example).all;
    let corners: Vec<&Interface> = found.iter().filter(|i| i.kind == ContactKind::Corner).collect();
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
    let notched = odd(&[[-5.0, -3.0], [5.0, -3.0], [5.0, 0.0], [1.5, 0.0], [0.0, -1.0], [-1.5, 0.0], [-5.0, 0.0]]);
    let wedge = odd(&[[0.0, -1.0], [0.5, 0.5], [-0.5, 0.5]]);
    let found = Interfaces::new(&scene(vec![notched], vec![wedge])).all;
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(near(found[0].normal, [0.0, 1.0]), "{found:?}");
    let spire = odd(&[[-1.0, -1.0], [1.0, -1.0], [0.0, 2.0]]);
    let roof = odd(&[[-4.0, 0.0], [-3.0, 0.0], [0.0, 2.0], [3.0, 0.0], [4.0, 0.0], [0.0, 5.0]]);
    let found = Interfaces::new(&scene(vec![spire], vec![roof])).all;
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(near(found[0].normal, [0.0, 1.0]), "{found:?}");
}

/// A pointed post stands anywhere on a slope of 3 : 4. Posts next to the slope have no contact.
#[test]
fn a_tip_anywhere_on_a_slope_is_pushed_perpendicular_to_the_slope() {
    // The slope rises from (0, 0) to (8, 6). The ground ends there with a vertical face.
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

/// A corner contact less than four gaps beyond the end of a joint belongs to the joint. Farther away it does not.
#[test]
fn a_tip_next_to_a_joint_belongs_to_it_up_to_four_gaps() {
    // A block with a flat foot 0.3 m wide and, after a slit, a pointed foot.
    let at = |slit: f64| {
        let foot = odd(&[[0.0, 0.0], [0.3, 0.0], [0.3, 1.0], [0.3, 1.0], [0.3, 0.0], [0.6, 1.5], [0.0, 1.5]]);
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
