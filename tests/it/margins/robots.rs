//! Margins of structures that robots hold: the least limits of the robots, and the tilts that they permit.

use drystone::Analysis;
use drystone::analysis::{EffectName, End, MarginKind, MarginKinds, Margins, Options};
use serde_json::{Value, json};

use super::{high, left, margins, near};
use crate::structure::{block, on_floor, rectangle, scene};

/// The least force x, force y and torque of each robot; `None` if no limit suffices.
type Least = [Option<End>; 3];

fn robots(found: &Margins) -> Vec<Least> {
    let robots = found.robots().map(|(_, limits)| limits.map(|limit| limit.low().cloned()));
    robots.collect()
}

#[track_caller]
fn near_least(limit: &Option<End>, expected: f64, within: f64) {
    near(limit.as_ref().expect("some limit suffices"), expected, within);
}

#[test]
fn a_robot_needs_only_the_force_and_torque_of_its_block() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    // Held 0.25 m to the left of its centroid, the block needs 8 N and 2 N·m.
    file["robots"] = json!([{ "id": "r", "holds": "a", "at": [0.25, 3.5], "limits": { "force": 20, "torque": 5 } }]);
    let found = margins(&file);
    let [[fx, fy, torque]] = &robots(&found)[..] else { panic!("one robot holds") };
    near_least(fx, 0.0, 0.0);
    near_least(fy, 8.0, 1e-6);
    near_least(torque, 2.0, 1e-6);
    // The robot can exert 20 N sideways, 2.5 times the weight of 8 N.
    near(&left(&found, MarginKind::HorizontalLoad), 2.5, 1e-6);
    file["robots"][0]["limits"] = json!({ "force": 4, "torque": 5 });
    let [[fx, fy, torque]] = &robots(&margins(&file))[..] else { panic!("one robot holds") };
    assert_eq!([fx, torque], [&None; 2], "the other limit is too small");
    near_least(fy, 8.0, 1e-6);
}

/// Forty robots hold a block of 8 N in the air, each with up to 2 N. Four of them suffice, so no single limit is
/// needed, and each margin is 0. The robots are split into two halves, and each half holds the block without the
/// other. So three verdicts decide all 120 limits.
#[test]
fn robot_limits_that_may_be_zero_are_found_in_groups() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    let robot = |limit: f64| json!({ "holds": "a", "at": [0.5, 3.5], "limits": { "force": limit, "torque": 1 } });
    let options = Options::default().margins(MarginKinds::new(&[MarginKind::Robots]));
    // The margins of the robots, and the number of verdicts that were computed for them.
    let robot_margins = |file: &Value| {
        let frame = Analysis::with(scene(file), &options).frames.remove(0);
        let mut effects = frame.effects.iter();
        let report = effects.find(|e| e.effect == EffectName::Margins);
        let reason = report.expect("always reported").why.clone();
        let count: Option<usize> = reason.split(' ').find_map(|word| word.parse().ok());
        let margins = frame.margins.as_ref().expect("margins were requested");
        (robots(margins), count)
    };
    file["robots"] = vec![robot(2.0); 40].into();
    let (robots, count) = robot_margins(&file);
    assert_eq!((robots.len(), count), (40, Some(3)));
    for found in &robots {
        found.iter().for_each(|limit| near_least(limit, 0.0, 0.0));
    }
    // With one robot of 7.9 N and 39 of 0.1 N, the strong robot must exert the remaining 8 N − 0.1 N · 39.
    file["robots"] = vec![robot(0.1); 40].into();
    file["robots"][25]["limits"]["force"] = 7.9.into();
    let (robots, count) = robot_margins(&file);
    near_least(&robots[25][1], 4.1, 1e-6);
    near_least(&robots[25][0], 0.0, 0.0);
    near_least(&robots[3][1], 0.0, 0.0);
    assert!(count.is_some_and(|count| count < 60), "{count:?}");
    // Together they exert 4 N too little. Any one of them could exert these 4 N in addition to its 0.1 N.
    file["robots"] = vec![robot(0.1); 40].into();
    let (robots, _) = robot_margins(&file);
    near_least(&robots[7][1], 4.1, 1e-6);
    assert_eq!([&robots[7][0], &robots[7][2]], [&None; 2]);
}

/// A robot that can exert 4 N horizontally holds a block of 8 N up to a tilt of 30°. With 8 N in each direction, it
/// holds the block at every tilt.
#[test]
fn a_limited_robot_holds_up_to_the_tilt_of_its_first_limit() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 4, "fy": 9, "torque": 0 } }]);
    // 8 sin θ = 4.
    near(&high(&margins(&file), MarginKind::Tilt), 30.0, 1e-5);
    near(&left(&margins(&file), MarginKind::Tilt), 30.0, 1e-5);
    file["robots"][0]["limits"] = json!({ "force": 8 });
    assert_eq!(high(&margins(&file), MarginKind::Tilt), End::Unbounded);
}

/// A robot presses a block onto the floor and pushes it along the floor, each with its full limit f. It slides at
/// W sin θ = f + μ (W cos θ + f).
#[test]
fn a_limited_robot_that_pushes_and_presses_holds_up_to_the_tilt_of_sliding() {
    let friction = 0.7;
    for weight in [9.81, 10.0, 3.0] {
        for ratio in [0.1, 0.2, 0.3, 0.4, 0.5, 0.51, 0.55, 0.6] {
            let limit = ratio * weight;
            for limits in [json!({ "force": limit }), json!({ "force": limit, "torque": 1 })] {
                let mut file = on_floor(friction, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), weight)]);
                file["robots"] = json!([{ "id": "r", "holds": "a", "limits": limits }]);
                let found = margins(&file);
                let pushed = (limit + friction * limit) / (weight * libm::hypot(1.0, friction));
                let expected = (libm::atan(friction) + libm::asin(pushed)).to_degrees();
                near(&left(&found, MarginKind::Tilt), expected, 5e-5);
                near(&high(&found, MarginKind::Tilt), expected, 5e-5);
            }
        }
    }
}
