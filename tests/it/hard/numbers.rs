//! Hard cases of very large and very small numbers: weights, friction coefficients, limits, lengths and loads.

use drystone::Analysis;
use serde_json::{Value, json};

use super::{FALLS, STANDS};
use crate::structure::{arch, block, first, on_floor, rectangle, scene, tower, verdict, wall};

/// The rounding error in the balance of a mountain can exceed the weight of a feather. A falling feather would then
/// seem to stand.
#[test]
fn a_feather_on_a_mountain_is_judged_by_its_own_weight() {
    for exponent in [2, 4, 6, 8] {
        let mountain = 6.0 * libm::exp10(f64::from(exponent));
        let build = |x: f64| {
            let big = block("mountain", rectangle(0.0, 0.0, 2.0, 1.0), mountain);
            on_floor(0.5, vec![big, block("feather", rectangle(x, 1.0, 1.0, 0.1), 6.0)])
        };
        assert_eq!(verdict(&build(1.6)), FALLS, "1e{exponent}");
        assert_eq!(verdict(&build(1.4)), STANDS, "1e{exponent}");
        for heavy in [0, 2] {
            let mut file = tower(3, 0.5);
            file["blocks"][heavy]["weight"] = json!(mountain);
            assert_eq!(verdict(&file), STANDS, "1e{exponent} at {heavy}");
        }
    }
}

/// Friction cones of very different slopes, 0 and 1000: the columns of the program differ much in size.
#[test]
fn friction_of_zero_and_of_a_thousand() {
    for friction in [0.0, 1e3] {
        let mut file = wall(4, 4);
        file["friction"] = json!(friction);
        assert_eq!(verdict(&file), STANDS, "{friction}");
    }
    assert_eq!(verdict(&arch(11, 0.2, 0.0)), FALLS);
    assert_eq!(verdict(&arch(11, 0.2, 1e3)), STANDS);
}

/// A very large limit could become a coefficient of the objective. Rounding would then hide all other coefficients.
#[test]
fn non_binding_limits_change_nothing() {
    let path = format!("{}/assets/thesis/figure-4.json", env!("CARGO_MANIFEST_DIR"));
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let totals = |file: &Value| {
        let scene = scene(file);
        let frames = Analysis::new(&scene).frames;
        frames.iter().map(|f| (f.verdict, f.total_force, f.total_sticking)).collect::<Vec<_>>()
    };
    let expected = totals(&file);
    for limit in [1e2, 1e6, 1e9, 1e12] {
        for robot in file["robots"].as_array_mut().unwrap() {
            robot["limits"] = json!({ "force": limit });
        }
        for (a, b) in totals(&file).iter().zip(&expected) {
            assert_eq!(a.0, b.0, "{limit}");
            assert!((a.1 - b.1).abs() < 1e-8 && (a.2 - b.2).abs() < 1e-8, "{limit}: {a:?} {b:?}");
        }
    }
}

/// A contact as short as a millionth of the block: L, the unit of length for moments, is equally short.
#[test]
fn a_block_on_a_splinter() {
    let splinter = |width: f64, off: f64| {
        json!({ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": rectangle(-1.0, -1.0, 2.0, 1.0) }],
            "blocks": [
                { "id": "splinter", "polygon": [[-0.5, 0], [0.5, 0], [width / 2.0, 1], [-width / 2.0, 1]], "weight": 1 },
                { "id": "block", "polygon": rectangle(-0.5 + off, 1.0, 1.0, 1.0), "weight": 6 }] })
    };
    for width in [1e-2, 1e-4, 1e-5, 1e-6] {
        assert_eq!(verdict(&splinter(width, 0.3 * width)), STANDS, "{width:e}");
        assert_eq!(verdict(&splinter(width, 0.7 * width)), FALLS, "{width:e}");
    }
}

/// A million block lengths from the origin, f64 leaves ten digits for the shape of a block.
#[test]
fn a_wall_a_million_block_lengths_from_the_origin() {
    let mut file = wall(4, 4);
    let expected = first(&file).total_force;
    for list in ["ground", "blocks"] {
        for body in file[list].as_array_mut().unwrap() {
            for corner in body["polygon"].as_array_mut().unwrap() {
                *corner = json!([corner[0].as_f64().unwrap() + 1e6, corner[1].as_f64().unwrap() - 1e6]);
            }
        }
    }
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    assert!((frame.total_force - expected).abs() < 1e-6 * expected);
}

/// With μ = 1000, a push of 7·10⁻⁷ N is tiny compared with μN and looks like a rounding error. But it exceeds the
/// tolerance: if it is dropped, there is no proof.
#[test]
fn a_light_push_on_very_rough_bricks() {
    let brick = |id, x, y, width, height, weight| block(id, rectangle(x, y, width, height), weight);
    let mut file = on_floor(
        1e3,
        vec![
            brick("0", -1.125, 0.0, 1.0, 1.0, 1.0),
            brick("1", 0.375, 0.0, 1.5, 1.0, 3.0),
            brick("2", -1.125, 1.0, 2.0, 0.5, 4.0),
            brick("3", 0.875, 1.0, 1.0, 0.5, 5.0),
        ],
    );
    file["loads"] = json!([{ "block": "3", "force": [7e-7, 0] }]);
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS, "{}", frame.doubt());
}

/// In every optimum, the robot exerts its largest permitted force. The least-squares step must not replace this force
/// by others.
#[test]
fn a_binding_limit_keeps_the_least_sum_of_forces() {
    let file = json!({ "drystone": 1, "friction": 0.3409671125134316, "kernel": 0.1836611407211487,
        "ground": [{ "polygon": [[-0.640625, 0.765625], [-1.015625, 1.203125], [-1.234375, 1.015625], [-0.859375, 0.578125]] },
                   { "polygon": [[0.8125, 0.578125], [1.203125, 0.875], [1.3515625, 0.6796875], [0.9609375, 0.3828125]] }],
        "blocks": [block("0", json!([[-0.640625, 0.765625], [-1.015625, 1.203125], [-0.234375, 1.5], [-0.140625, 0.984375]]), 7.0),
                   block("1", json!([[-0.140625, 0.984375], [-0.234375, 1.5], [0.59375, 1.390625], [0.375, 0.921875]]), 6.0),
                   block("2", json!([[0.375, 0.921875], [0.59375, 1.390625], [1.203125, 0.875], [0.8125, 0.578125]]), 7.0)],
        "robots": [{ "holds": "1", "limits": { "fx": 0.1653510166185448, "fy": 9.5 } },
                   { "holds": "2", "at": [0.375, 0.921875], "limits": { "fx": 5.5, "torque": 3 } }] });
    let frame = first(&file);
    // The optimum of an exact program. Least squares over a face without the limit gave 33.3959.
    assert!((frame.total_force / 33.323_081_432_182_72 - 1.0).abs() < 1e-9, "{}", frame.total_force);
}

/// The adhesion against a light load is less than a millionth of the adhesion that the weights need. The sum must
/// include it.
#[test]
fn the_adhesion_against_a_light_load_is_included() {
    let push = 8e-7;
    let mut file = on_floor(
        0.0,
        vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0), block("b", rectangle(0.75, 1.0, 1.0, 1.0), 6.0)],
    );
    file["loads"] = json!([{ "block": "a", "force": [push, 0] }]);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    // The weight of b acts 0.25 m beyond the edge of a, and the two contact points are 0.25 m apart. So the far point
    // needs a tension of 6 N. The push is added to it.
    assert!((frame.total_sticking - 6.0 - push).abs() < 1e-9, "{}", frame.total_sticking);
}

/// A sliver 10 m long and 1 mm thick: its normal comes from a short difference and its centroid from areas that
/// cancel.
#[test]
fn a_needle_under_a_block() {
    let file = json!({ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": rectangle(0.0, -1.0, 10.0, 1.0) }],
        "blocks": [{ "id": "needle", "polygon": [[0, 0], [10, 0], [10, 1e-3]], "weight": 1 },
                   { "id": "block", "polygon": [[0, 0], [10, 1e-3], [10, 2], [0, 2]], "weight": 1 }] });
    assert_eq!(verdict(&file), STANDS);
}

/// A robot whose limit is exactly the force that it needs, or 1e-5 N less or more.
#[test]
fn a_robot_with_exactly_the_limit_it_needs() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    for (limit, expected) in [(8.0, STANDS), (8.0 - 1e-5, FALLS), (8.0 + 1e-5, STANDS)] {
        file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "force": limit } }]);
        assert_eq!(verdict(&file), expected, "{limit}");
    }
}
