//! Hard cases: a tolerance, a very large number or a very small one could reverse the verdict. Each test says why its
//! case is hard.

use drystone::Analysis;
use drystone::analysis::{Proof, Verdict};
use serde_json::{Value, json};

use crate::structure::{
    arch, block, first, on_floor, on_slope, rectangle, scene, tower, verdict, wall,
};

const STANDS: Verdict = Verdict::Stable;
const FALLS: Verdict = Verdict::Unstable;

/// A frictionless wedge between two slopes; each side is `half_angle` off the vertical.
pub fn wedge(half_angle: f64) -> Value {
    let d = libm::tan(half_angle);
    json!({ "drystone": 1, "friction": 0,
        "ground": [{ "polygon": [[-3, 0], [-0.5, 0], [-0.5 - d, 1], [-3, 1]] },
                   { "polygon": [[0.5, 0], [3, 0], [3, 1], [0.5 + d, 1]] }],
        "blocks": [{ "id": "wedge", "polygon": [[-0.5, 0], [0.5, 0], [0.5 + d, 1], [-0.5 - d, 1]], "weight": 6 }] })
}

/// A block whose centre of gravity lies `beyond` the edge of its support. With `pair` the support is another block.
pub fn overhang(beyond: f64, pair: bool) -> Value {
    let mut blocks = vec![block(
        "a",
        rectangle(0.5 + beyond, if pair { 0.5 } else { 0.0 }, 1.0, 0.5),
        6.0,
    )];
    if pair {
        blocks.push(block("b", rectangle(0.0, 0.0, 1.0, 0.5), 6.0));
    }
    json!({ "drystone": 1, "ground": [{ "polygon": rectangle(0.0, -1.0, 1.0, 1.0) }], "blocks": blocks })
}

/// Errors add up from the top to the bottom of a long chain.
#[test]
fn a_tower_of_a_thousand_blocks() {
    let frame = first(&tower(1000, 0.5));
    assert_eq!(frame.verdict, STANDS);
    let foot: f64 = frame
        .contacts
        .iter()
        .filter(|c| c.interface.ends[0].y == 0.0)
        .map(|c| c.normal_forces[0] + c.normal_forces[1])
        .sum();
    assert!((foot - 6000.0).abs() < 1e-6 * 6000.0, "{foot}");
}

/// The thrust of a slender frictionless wedge grows as 1/α. Above 10⁶ times the weight, a big-M program would report
/// a failure.
#[test]
fn a_flat_wedge_stands_however_large_its_thrust() {
    for exponent in 2..=7 {
        let half_angle = libm::exp10(-f64::from(exponent));
        let frame = first(&wedge(half_angle));
        assert_eq!(
            frame.verdict, STANDS,
            "half-angle 1e-{exponent}: {:?}",
            frame.proof
        );
        let expected = 6.0 / (2.0 * libm::sin(half_angle));
        let sum: f64 = frame
            .contacts
            .iter()
            .flat_map(|c| c.normal_forces)
            .sum::<f64>()
            / 2.0;
        assert!(
            (sum / expected - 1.0).abs() < 1e-6,
            "half-angle 1e-{exponent}: {sum} against {expected}"
        );
    }
}

/// The rounding error of a mountain's balance can exceed the weight of a feather, so that a falling feather seems to
/// stand.
#[test]
fn a_feather_on_a_mountain_is_judged_by_its_own_weight() {
    for exponent in [2, 4, 6, 8] {
        let mountain = 6.0 * libm::exp10(f64::from(exponent));
        let build = |x: f64| {
            let big = block("mountain", rectangle(0.0, 0.0, 2.0, 1.0), mountain);
            on_floor(
                0.5,
                vec![big, block("feather", rectangle(x, 1.0, 1.0, 0.1), 6.0)],
            )
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

/// Very close to the edge (within about 1e-7 of L) a balance is accepted. Farther out the verdict must be right and
/// decided.
#[test]
fn a_centre_of_gravity_on_the_edge() {
    for pair in [false, true] {
        for inside in [0.0, -1e-9, -1e-8, -1e-7, -1e-6, -1e-5] {
            assert_eq!(
                verdict(&overhang(inside, pair)),
                STANDS,
                "{inside:e}, pair: {pair}"
            );
        }
        assert_eq!(
            verdict(&overhang(1e-9, pair)),
            STANDS,
            "a balance within the tolerance counts"
        );
        for beyond in [2e-7, 1e-6, 1e-5] {
            assert_eq!(
                verdict(&overhang(beyond, pair)),
                FALLS,
                "{beyond:e}, pair: {pair}"
            );
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

/// With kernel 1 both application points of a joint coincide, so that it cannot transmit a moment.
#[test]
fn kernels_of_zero_and_one() {
    for kernel in [0.0, 1.0] {
        let mut file = wall(4, 4);
        file["kernel"] = json!(kernel);
        assert_eq!(verdict(&file), STANDS, "{kernel}");
    }
    let mut file = arch(11, 0.2, 0.7);
    file["kernel"] = json!(1.0);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert_eq!(
        frame.unsupported.len(),
        11,
        "no adhesion in the middle of a joint holds a chain of hinges"
    );
}

/// At the limit between two verdicts, the status that a solver returns is not reliable.
#[test]
fn an_arch_at_its_minimum_thickness() {
    // The arch of 181 voussoirs has a limit of its own, a little below that of the continuous arch (0.1075), whose
    // hinges may lie between these joints.
    for (thickness, expected) in [
        (0.10743, FALLS),
        (0.10746, FALLS),
        (0.1075, STANDS),
        (0.1076, STANDS),
    ] {
        assert_eq!(verdict(&arch(181, thickness, 0.9)), expected, "{thickness}");
    }
}

/// The rounding of tan θ would decide in its last bit. A balance within the tolerance counts, so the block stands.
#[test]
fn friction_exactly_at_the_slope() {
    for degrees in [10.0f64, 30.0, 45.0, 60.0] {
        let friction = libm::tan(degrees.to_radians());
        assert_eq!(
            verdict(&on_slope(degrees, 4.0, 0.5, friction, 0.0)),
            STANDS,
            "{degrees}"
        );
    }
}

/// There are more supports than needed, so many distributions of forces are optimal. The one of least squares is
/// symmetric.
#[test]
fn redundant_supports_share() {
    let mut blocks: Vec<Value> = (0..5)
        .map(|k| {
            block(
                &format!("post {k}"),
                rectangle(2.0 * k as f64, 0.0, 1.0, 1.0),
                1.0,
            )
        })
        .collect();
    blocks.push(block("beam", rectangle(0.0, 1.0, 9.0, 0.5), 45.0));
    let frame = first(&on_floor(0.5, blocks));
    assert_eq!(frame.verdict, STANDS);
    let carried: Vec<f64> = frame
        .contacts
        .iter()
        .filter(|c| c.interface.ends[0].y == 1.0)
        .map(|c| c.resultant.force.y.abs())
        .collect();
    assert_eq!(carried.len(), 5);
    for (a, b) in carried.iter().zip(carried.iter().rev()) {
        assert!((a - b).abs() < 1e-6, "{carried:?}");
    }
    assert!((carried.iter().sum::<f64>() - 45.0).abs() < 1e-9);
}

/// A structure that fails nearly everywhere.
#[test]
fn a_wall_on_a_tilted_table_fails_in_every_course() {
    let mut file = wall(10, 10);
    file["gravity"] = json!([6.0, -8.0]);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert!(
        frame.total_sticking > 0.0 && frame.failures.len() < 60,
        "{} points",
        frame.failures.len()
    );
}

/// Many small independent programs.
#[test]
fn a_thousand_towers_are_solved_apart() {
    let blocks = (0..1000).flat_map(|k| {
        (0..3).map(move |j| {
            let at = rectangle(f64::from(k) * 0.15 - 90.0, f64::from(j) * 0.1, 0.1, 0.1);
            block(&format!("{k}-{j}"), at, 1.0)
        })
    });
    let frame = first(&on_floor(0.5, blocks.collect()));
    assert_eq!((frame.verdict, frame.solve.groups), (STANDS, 1000));
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

/// Self-stress: the thrust between the two walls is unbounded, and no motion opens every contact.
#[test]
fn a_block_squeezed_between_walls_counts_as_balanced() {
    let file = json!({ "drystone": 1, "friction": 0.01,
        "ground": [{ "polygon": rectangle(-2.0, -1.0, 2.0, 3.0) }, { "polygon": rectangle(1.0, -1.0, 2.0, 3.0) }],
        "blocks": [block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0)] });
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    // The least force that carries the block: μN on either side is half of the weight, 3 N.
    for contact in &frame.contacts {
        let pressed = contact.normal_forces[0] + contact.normal_forces[1];
        assert!((pressed - 300.0).abs() < 1e-6, "{pressed}");
    }
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

/// Effects are simulated only if a frame needs them. A frame equal to an earlier one is not solved again.
#[test]
fn effects_that_a_frame_does_not_need_are_not_simulated() {
    let mut file = wall(2, 2);
    file["friction"] = json!(0.0);
    file["steps"] = json!([
        { "place": ["0", "1"] }, { "place": ["2", "3", "4"] }, { "remove": ["2", "3", "4"] }
    ]);
    let scene = scene(&file);
    let analysis = Analysis::new(&scene);
    let effect = |name: &str| {
        analysis.frames[1]
            .effects
            .iter()
            .find(|e| e.effect.word() == name)
            .unwrap_or_else(|| panic!("no effect {name}"))
    };
    for (name, simulated) in [
        ("weight", true),
        ("contact", true),
        ("friction", false),
        ("kernel", false),
        ("robots", false),
        ("sticking", false),
    ] {
        assert_eq!(
            effect(name).simulated,
            simulated,
            "{name}: {}",
            effect(name).why
        );
    }
    let contacts = analysis.frames[1].contacts.len();
    assert_eq!(effect("contact").unknowns, 2 * contacts);
    assert_eq!(effect("friction").unknowns, 4 * contacts, "saved");
    // The third frame is equal to the first.
    let last = &analysis.frames[2];
    assert_eq!(
        (last.solve.reused, last.solve.groups, last.solve.programs),
        (1, 1, 0)
    );
    let Proof::Forces {
        worst_imbalance, ..
    } = last.proof
    else {
        panic!("{:?}", last.proof)
    };
    assert!(worst_imbalance < 1e-9);
}

/// A very large limit could become a coefficient of the objective that hides all others by rounding.
#[test]
fn non_binding_limits_change_nothing() {
    let path = format!("{}/assets/thesis/figure-4.json", env!("CARGO_MANIFEST_DIR"));
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let totals = |file: &Value| {
        let scene = scene(file);
        let frames = Analysis::new(&scene).frames;
        frames
            .iter()
            .map(|f| (f.verdict, f.total_force, f.total_sticking))
            .collect::<Vec<_>>()
    };
    let expected = totals(&file);
    for limit in [1e2, 1e6, 1e9, 1e12] {
        for robot in file["robots"].as_array_mut().unwrap() {
            robot["limits"] = json!({ "force": limit });
        }
        for (a, b) in totals(&file).iter().zip(&expected) {
            assert_eq!(a.0, b.0, "{limit}");
            assert!(
                (a.1 - b.1).abs() < 1e-8 && (a.2 - b.2).abs() < 1e-8,
                "{limit}: {a:?} {b:?}"
            );
        }
    }
}

/// A contact as short as a millionth of the block: the length L, the unit of length for moments, is then as short.
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

/// At 10⁶ block lengths from the origin, f64 leaves ten digits for the shape of a block.
#[test]
fn a_wall_a_million_lengths_away() {
    let mut file = wall(4, 4);
    let expected = first(&file).total_force;
    for list in ["ground", "blocks"] {
        for body in file[list].as_array_mut().unwrap() {
            for corner in body["polygon"].as_array_mut().unwrap() {
                *corner = json!([
                    corner[0].as_f64().unwrap() + 1e6,
                    corner[1].as_f64().unwrap() - 1e6
                ]);
            }
        }
    }
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    assert!((frame.total_force - expected).abs() < 1e-6 * expected);
}

/// With μ = 1000 a push of 7e-7 N is tiny compared with μN and looks like a rounding error. It exceeds the tolerance,
/// though: when it was dropped, there was no proof.
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

/// A robot's limit that is reached stays part of every optimum: the least-squares step must not replace it by other
/// forces.
#[test]
fn a_limit_that_binds_keeps_the_sum_least() {
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
    assert!(
        (frame.total_force / 33.323_081_432_182_72 - 1.0).abs() < 1e-9,
        "{}",
        frame.total_force
    );
}

/// The adhesion needed against a light load is less than a millionth of what the weights need, but it counts.
#[test]
fn a_light_load_on_a_falling_block_sticks_too() {
    let push = 8e-7;
    let mut file = on_floor(
        0.0,
        vec![
            block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0),
            block("b", rectangle(0.75, 1.0, 1.0, 1.0), 6.0),
        ],
    );
    file["loads"] = json!([{ "block": "a", "force": [push, 0] }]);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    // b's weight acts 0.25 m beyond a's edge and the two contact points are 0.25 m apart: a tension of 6 N at the far
    // point. The push adds to it.
    assert!(
        (frame.total_sticking - 6.0 - push).abs() < 1e-9,
        "{}",
        frame.total_sticking
    );
}

/// A pile that is wedged between walls and still falls. The forces with the least adhesion are unbounded, but this
/// does not mean that no adhesion could hold the pile.
#[test]
fn a_wedged_pile_that_falls_could_be_held_by_adhesion() {
    let polygon = |corners: [[f64; 2]; 4]| json!({ "polygon": corners });
    let file = json!({ "drystone": 1, "friction": 1000.0, "kernel": 0.2,
        "ground": [polygon([[-9.0, -13.0], [15.0, 5.0], [12.0, 9.0], [-12.0, -9.0]]),
                   polygon([[-12.0, -9.0], [-8.0, -6.0], [-14.75, 3.0], [-18.75, 0.0]]),
                   polygon([[8.0, 6.0], [12.0, 9.0], [3.75, 20.0], [-0.25, 17.0]])],
        "blocks": [block("0", json!([[-4.0, -3.0], [-1.0, -0.75], [-2.5, 1.25], [-5.5, -1.0]]), 2.0),
                   block("1", json!([[1.0, 0.75], [8.0, 6.0], [6.5, 8.0], [-0.5, 2.75]]), 3.0),
                   block("2", json!([[-6.0, -1.375], [-5.0, -0.625], [-8.0, 3.375], [-9.0, 2.625]]), 1.0),
                   block("3", json!([[-5.0, -0.625], [1.0, 3.875], [-2.0, 7.875], [-8.0, 3.375]]), 2.0),
                   block("4", json!([[-8.5, 3.0], [-4.5, 6.0], [-7.5, 10.0], [-11.5, 7.0]]), 5.0)] });
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert!(frame.unsupported.is_empty(), "{:?}", frame.unsupported);
    assert!(
        (frame.total_sticking / 1.325_152_168_800_875 - 1.0).abs() < 1e-7,
        "{}",
        frame.total_sticking
    );
}
