//! Supports that move: the least and the greatest thrust of arches against exact programs, and sums by hand.

use drystone::analysis::{Cracked, MovementOutcome, Verdict};
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::{rectangle, scene};
use crate::validation::arches::Arch;

/// A semicircular arch of 100 voussoirs with much friction, and its right foot, which moves.
fn arch(thickness: f64, translation: [f64; 2]) -> Value {
    let mut file = Arch::semicircle(100, thickness, 5.0).file();
    file["ground"] = json!([
        { "id": "left", "polygon": rectangle(-1.6, -0.3, 1.3, 0.3) },
        { "id": "right", "polygon": rectangle(0.3, -0.3, 1.3, 0.3) }
    ]);
    file["movements"] = json!([{ "ground": "right", "translation": translation }]);
    file
}

/// How a scene follows its first movement.
#[track_caller]
fn cracked(scene: &Scene) -> Cracked {
    let frame = Analysis::new(scene).frames.remove(0);
    assert_eq!(frame.verdict, Verdict::Stable);
    match frame.movements.first().map(|moved| moved.outcome.clone()) {
        Some(MovementOutcome::Follows(cracked)) => cracked,
        other => panic!("{other:?}"),
    }
}

#[test]
fn spreading_and_closing_feet_give_the_least_and_the_greatest_thrust_of_exact_programs() {
    let references = [
        (0.12, 0.19085, 0.20706),
        (0.15, 0.17589, 0.22702),
        (0.20, 0.15403, 0.25458),
        (0.25, 0.13491, 0.27721),
        (0.30, 0.11776, 0.29921),
    ];
    let thrust = |thickness: f64, sign: f64| {
        let scene = scene(&arch(thickness, [0.01 * sign, 0.0]));
        let weight: f64 = scene.blocks().iter().map(|block| block.weight).sum();
        let found = cracked(&scene);
        assert!((found.work - 0.01 * sign * found.force.x).abs() < 1e-9 * weight, "{found:?}");
        found.force.x / weight
    };
    for (thickness, least, greatest) in references {
        assert!((thrust(thickness, 1.0) - least).abs() < 0.6e-5, "{thickness}: {}", thrust(thickness, 1.0));
        assert!((thrust(thickness, -1.0) - greatest).abs() < 0.6e-5, "{thickness}: {}", thrust(thickness, -1.0));
    }
    // At the least thickness with which it stands, there is only one thrust.
    assert!((thrust(0.107456, 1.0) - thrust(0.107456, -1.0)).abs() < 1e-5);
}

/// A beam of weight 6 from x = 0 to x = 4 on two supports, 1 m wide, and a movement of the right one.
fn beam(movement: Value) -> Value {
    json!({ "drystone": 1, "friction": 0.5, "movements": [movement],
        "ground": [{ "id": "left", "polygon": rectangle(0.0, -1.0, 1.0, 1.0) },
                   { "id": "right", "polygon": rectangle(3.0, -1.0, 1.0, 1.0) },
                   { "id": "apart", "polygon": rectangle(9.0, -1.0, 1.0, 1.0) }],
        "blocks": [{ "id": "beam", "polygon": rectangle(0.0, 0.0, 4.0, 1.0), "weight": 6 }] })
}

fn result(file: &Value) -> Value {
    let text = to_json(&Analysis::new(scene(file)), Timing::LeftOut, Layout::OneLine);
    let mut all: Value = serde_json::from_str(&text).expect("JSON");
    all["frames"][0]["movements"][0].take()
}

#[track_caller]
fn near(found: &Value, expected: f64) {
    let found = found.as_f64().expect("a number");
    assert!((found - expected).abs() < 1e-6, "{found} instead of {expected}");
}

#[test]
fn a_beam_leans_on_the_far_edge_of_a_support_that_settles() {
    // The least reaction on the right: the left one acts at x = 1, the right one at x = 4, so V = 6 (2 - 1) / (4 - 1).
    let settles = result(&beam(json!({ "ground": "right", "translation": [0, -0.02] })));
    assert_eq!((&settles["ground"], &settles["outcome"]), (&json!("right"), &json!("follows")));
    near(&settles["unit"], 0.02);
    near(&settles["force"][1], -2.0);
    near(&settles["work"], 0.02 * 2.0);
    // The beam turns about x = 1 by 1/3 for each unit that x = 4 sinks.
    near(&settles["velocities"][0]["spin"], -1.0 / 3.0);
    near(&settles["velocities"][0]["velocity"][1], -1.0 / 3.0);
    let joints = settles["joints"].as_array().expect("a list");
    assert_eq!(joints.len(), 2, "{joints:?}");
    for (number, joint) in joints.iter().enumerate() {
        assert_eq!(joint["interface"], json!(number));
        near(&joint["opening"], 1.0 / 3.0);
        near(&joint["slip"], 0.0);
    }
    // If it rises, the beam leans on its near edge and on the far edge of the other: V = 6 · 2 / 3.
    near(&result(&beam(json!({ "ground": "right", "translation": [0, 0.02] })))["force"][1], -4.0);
    // Turned by 1° about its outer edge (4, 0), it sinks at x = 3: the beam stays on the outer edge.
    let turns = result(&beam(json!({ "ground": "right", "rotation": 1, "about": [4, 0] })));
    near(&turns["unit"], core::f64::consts::PI / 180.0);
    near(&turns["work"], 0.0);
    // It pulls the beam to the right: the beam slides on one of the supports, with friction 0.5.
    let pulled = result(&beam(json!({ "ground": "right", "translation": [0.02, 0] })));
    assert!(pulled["joints"].as_array().is_some_and(|all| all.iter().any(|j| j["slip"] != json!(0.0))), "{pulled}");
    let untouched = result(&beam(json!({ "ground": "apart", "translation": [0, 1] })));
    assert_eq!(untouched, json!({ "ground": "apart", "outcome": "untouched" }));
}

#[test]
fn a_block_between_two_walls_jams_if_they_close() {
    let between = |by: f64| {
        json!({ "drystone": 1, "friction": 0.5, "movements": [{ "ground": "right", "translation": [by, 0] }],
            "ground": [{ "polygon": rectangle(-1.0, -1.0, 3.0, 1.0) }, { "polygon": rectangle(-1.0, 0.0, 1.0, 1.0) },
                       { "id": "right", "polygon": rectangle(1.0, 0.0, 1.0, 1.0) }],
            "blocks": [{ "id": "a", "polygon": rectangle(0.0, 0.0, 1.0, 1.0), "weight": 1 }] })
    };
    assert_eq!(result(&between(-0.01))["outcome"], "jams");
    let opens = result(&between(0.01));
    near(&opens["force"][0], 0.0);
}

#[test]
fn cracks_agree_with_the_movement_and_open_no_joint_that_presses() {
    let mut file = arch(0.15, [0.0, 0.0]);
    file["movements"] = json!([{ "ground": "right", "translation": [0.004, -0.003], "rotation": 0.02 }]);
    let scene = scene(&file);
    let frame = Analysis::new(&scene).frames.remove(0);
    let found = cracked(&scene);
    let movement = &scene.movements()[0];
    for (number, contact) in frame.contacts.iter().enumerate() {
        let interface = &contact.interface;
        let crack = found.cracks.iter().find(|crack| crack.contact == number);
        for (end, at) in contact.application_points.iter().enumerate() {
            let [a, b] = interface.bodies.map(|body| found.velocity(&scene, movement, body, *at));
            let opening = (a - b).dot(&interface.normal);
            assert!(opening > -1e-6, "{number} closes by {opening}");
            match crack {
                Some(crack) if crack.end != Some(end) => assert!(opening <= crack.opening + 1e-9),
                _ => assert!(opening.abs() < 1e-3, "{number} opens by {opening}"),
            }
        }
    }
    // The work of the loads on the cracked shape is the work of the reactions of both supports: of the moved one, because
    // the other one rests.
    let down = found.motions.iter().map(|m| -m.velocity.y * scene.blocks()[m.block.0].weight).sum::<f64>();
    assert!((down * found.unit - found.work).abs() < 1e-6 * frame.weight * found.unit, "{down} {}", found.work);
}

#[test]
fn blocks_on_a_split_floor_follow_it() {
    let file = json!({ "drystone": 1, "friction": 0.5,
        "ground": [{ "id": "G0", "polygon": rectangle(-2.0, -2.0, 4.5, 2.0) },
            { "id": "G1", "polygon": rectangle(2.5, -2.0, 9.5, 2.0) }],
        "blocks": [{ "polygon": rectangle(0.0, 0.0, 5.0, 1.96875) }, { "polygon": rectangle(5.0, 0.0, 5.0, 1.3125) }],
        "movements": [{ "ground": "G1", "translation": [0.01, -0.014574604732] }] });
    let cracked = cracked(&scene(&file));
    assert!(cracked.force.x == 0.0 && cracked.force.y < 0.0 && !cracked.cracks.is_empty(), "{cracked:?}");
}
