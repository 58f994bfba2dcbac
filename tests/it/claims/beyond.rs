//! The motions that a result lists for the frame just beyond each end of its margins.

use drystone::analysis::{MarginKinds, Options};
use serde_json::{Value, json};

use super::{Checked, check, check_with, cross, dot, less, list, number, pair};
use crate::structure::{arch, harmonic, on_slope, scene, wall};

/// The velocity of a point of a body in a motion. The ground and bodies that are not listed are at rest.
fn velocity(motions: &Value, body: &str, centroid: [f64; 2], at: [f64; 2]) -> [f64; 2] {
    let own = list(motions).iter().find(|m| m["block"] == body);
    own.map_or([0.0; 2], |m| {
        let ([u, v], spin, arm) = (pair(&m["velocity"]), number(&m["spin"]), less(at, centroid));
        [u - spin * arm[1], v + spin * arm[0]]
    })
}

/// The power of gravity, loads and robots along a motion, and the largest power that a contact force of 1 N takes
/// from it.
fn power_and_worst(changed: &Value, motions: &Value) -> (f64, f64) {
    let scene = scene(changed);
    let centroid = |name: &str| {
        let block = scene.blocks().iter().find(|block| block.id == name);
        block.map_or([0.0; 2], |block| [block.centroid.x, block.centroid.y])
    };
    let speed = |name: &str, at: [f64; 2]| velocity(motions, name, centroid(name), at);
    let down = [scene.down().x, scene.down().y];
    let mut power = 0.0;
    for block in scene.blocks() {
        let at = centroid(&block.id);
        power += block.weight * dot(down, speed(&block.id, at));
    }
    let spin = |name: &Value| {
        let own = list(motions).iter().find(|m| m["block"] == *name);
        own.map_or(0.0, |m| number(&m["spin"]))
    };
    for load in list(&changed["loads"]) {
        let name = load["block"].as_str().expect("a name");
        let at = load.get("at").map_or_else(|| centroid(name), pair);
        power += dot(pair(&load["force"]), speed(name, at));
        power += load["torque"].as_f64().unwrap_or(0.0) * spin(&load["block"]);
    }
    for robot in list(&changed["robots"]) {
        let name = robot["holds"].as_str().expect("a name");
        let at = robot.get("at").map_or_else(|| centroid(name), pair);
        let ([x, y], limits) = (speed(name, at), &robot["limits"]);
        power -= number(&limits["fx"]) * x.abs() + number(&limits["fy"]) * y.abs();
        power -= number(&limits["torque"]) * spin(&robot["holds"]).abs();
    }
    let mut worst = 0.0_f64;
    for interface in list(&check(changed).json["frames"][0]["interfaces"]) {
        let normal = pair(&interface["normal"]);
        let [a, b] = [0, 1].map(|k| interface["bodies"][k].as_str().expect("a name"));
        for at in list(&interface["application_points"]) {
            let apart = less(speed(a, pair(at)), speed(b, pair(at)));
            let slides = number(&interface["mu"]) * cross(normal, apart).abs();
            worst = worst.max(slides - dot(apart, normal));
        }
    }
    (power, worst)
}

/// A scene whose margins are checked, and the number of motions checked so far.
struct Beyond {
    checked: Checked,
    seen: usize,
}

impl Beyond {
    /// Asserts that the motion listed for an end does work in the scene changed to just beyond this end, and that no
    /// contact can stop it.
    fn holds(&mut self, motions: &Value, end: &Value, change: &dyn Fn(f64) -> Value, sign: f64) {
        let Some(at) = end.as_f64().filter(|at| at.abs() > 1e-6) else {
            // Without an end there is no motion. Nor is there one at an end of 0, below which there are no values.
            assert!(list(motions).is_empty(), "{end}: {motions}");
            return;
        };
        let changed = change(at + sign * 1e-3 * at.abs());
        let (power, worst) = power_and_worst(&changed, motions);
        assert!(power > 0.0, "{power} beyond {at}: {motions} {changed}");
        assert!(worst < 1e-5, "{worst} beyond {at}: {motions} {changed}");
        self.seen += 1;
    }

    fn with(&self, key: &str, value: Value) -> Value {
        let mut changed = self.checked.file.clone();
        changed[key] = value;
        changed
    }

    fn turned(&self, degrees: f64) -> Value {
        let angle = degrees.to_radians();
        self.with("gravity", json!([libm::sin(angle), -libm::cos(angle)]))
    }

    fn pushed(&self, share: f64) -> Value {
        let scene = scene(&self.checked.file);
        let mut loads = list(&self.checked.file["loads"]).to_vec();
        for block in scene.blocks() {
            let at = [block.centroid.x, block.centroid.y];
            let push = [share * block.weight, 0.0];
            loads.push(json!({ "block": block.id, "force": push, "at": at }));
        }
        self.with("loads", json!(loads))
    }

    fn loaded(&self, factor: f64) -> Value {
        let mut changed = self.checked.file.clone();
        for load in changed["loads"].as_array_mut().into_iter().flatten() {
            for axis in 0..2 {
                load["force"][axis] = json!(number(&load["force"][axis]) * factor);
            }
        }
        changed
    }

    fn check_margins(&mut self) {
        let margins = self.checked.json["frames"][0]["margins"].clone();
        let beyond = &margins["mechanisms"];
        let file = self.checked.file.clone();
        let this = Beyond { checked: check(&file), seen: 0 };
        let friction = |mu: f64| this.with("friction", json!(mu));
        self.holds(&beyond["friction"], &margins["friction"], &friction, -1.0);
        let kernel = |kernel: f64| this.with("kernel", json!(kernel));
        self.holds(&beyond["kernel"], &margins["kernel"], &kernel, 1.0);
        let loaded = |factor: f64| this.loaded(factor);
        self.holds(&beyond["load_factor"], &margins["load_factor"], &loaded, 1.0);
        let turned = |degrees: f64| this.turned(degrees);
        let pushed = |share: f64| this.pushed(share);
        let changes: [(&str, &dyn Fn(f64) -> Value); 3] =
            [("tilt", &turned), ("horizontal_load", &pushed), ("load_factor", &loaded)];
        for (key, change) in changes {
            for (side, sign) in [("left", -1.0), ("right", 1.0)] {
                if let Some(at) = margins[key][side].as_f64() {
                    self.holds(&beyond[key][side], &json!(sign * at), change, sign);
                }
            }
            for (k, sign) in [-1.0, 1.0].into_iter().enumerate() {
                let both = &beyond["intervals"][key];
                if both.is_array() {
                    let end = &margins["intervals"][key][k];
                    self.holds(&both[k], end, change, sign);
                }
            }
        }
        for (name, robot) in margins["robots"].as_object().expect("an object") {
            for key in ["fx", "fy", "torque"] {
                let limited = |limit: f64| {
                    let mut changed = file.clone();
                    changed["robots"][0]["limits"][key] = json!(limit);
                    changed
                };
                let motions = &beyond["robots"][name][key];
                self.holds(motions, &robot[key], &limited, -1.0);
            }
        }
        // Loads and limits do not turn with gravity, so a frame may stand again at other tilts; a note says so.
        let is_noted =
            list(&margins["notes"]).iter().any(|note| note.as_str().is_some_and(|note| note.starts_with("tilt:")));
        let is_cone = file["loads"].is_null() && file["robots"].is_null();
        let has_tilt = margins["intervals"]["tilt"].is_array();
        assert_eq!(is_noted, has_tilt && !is_cone, "{margins}");
    }
}

/// The motions that a result lists beyond the ends of its margins, checked in scenes changed by a further thousandth.
#[test]
fn motions_just_beyond_a_margin_are_those_of_the_changed_scene() {
    let mut pushed = wall(3, 2);
    pushed["loads"] = json!([{ "block": "4", "force": [1.0, 0.0], "at": [1.0, 0.75] }]);
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    held["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 9, "fy": 9, "torque": 9 } }]);
    let options = Options::default().margins(MarginKinds::ALL);
    let mut seen = 0;
    for file in [arch(11, 0.3, 0.7), wall(4, 3), harmonic(4, 0.9), pushed, held] {
        let mut beyond = Beyond { checked: check_with(&file, &options), seen: 0 };
        beyond.check_margins();
        seen += beyond.seen;
    }
    assert!(seen >= 25, "{seen}");
}

/// Scenes that stand at no value of one or more parameters: groups of blocks that never stand at the same value, a
/// block that hangs in the air, and a plank that falls at every tilt.
fn hopeless() -> Vec<Value> {
    let read = |text: &str| -> Value { serde_json::from_str(text).expect("JSON") };
    let mut files = vec![
        read(include_str!("../intervals/margin-horizontal-two-groups.json")),
        read(include_str!("../intervals/margin-load-factor-two-groups.json")),
        read(include_str!("../intervals/load-factor-unbounded-ramp.json")),
        read(include_str!("../intervals/plank.json")),
    ];
    let mut held = read(include_str!("../intervals/margin-robot-other-falls.json"));
    held["robots"][0]["limits"] = json!({ "fx": 10, "fy": 10, "torque": 10 });
    held["loads"] = json!([{ "block": "held", "force": [1, 0] }]);
    files.push(held);
    let mut tilted = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    tilted["loads"] = json!([{ "block": "a", "force": [0.0, 50.0] }]);
    files.push(tilted);
    files
}

/// Whether one of the listed motions excludes the value `at`: it does work in the scene changed to this value, and no
/// contact or robot can stop it. `period` is 360° for a tilt, otherwise 0.
fn is_excluded(reasons: &Value, at: f64, period: f64, changed: &Value) -> bool {
    let covers = |reason: &&Value| {
        let from = reason["from"].as_f64().unwrap_or(f64::NEG_INFINITY);
        let to = reason["to"].as_f64().unwrap_or(f64::INFINITY);
        let is_within = |at: f64| from <= at && at <= to;
        is_within(at) || is_within(at - period) || is_within(at + period)
    };
    let reasons = list(reasons);
    assert!(!reasons.is_empty(), "{at}: nothing excludes it");
    reasons.iter().filter(covers).any(|reason| {
        let (power, worst) = power_and_worst(changed, &reason["mechanism"]);
        power > 0.0 && worst < 1e-5
    })
}

/// If an interval is empty, the listed motions exclude all its values. Otherwise none are listed.
#[test]
fn a_scene_with_an_empty_interval_falls_at_each_value_by_a_listed_motion() {
    let signed: Vec<f64> = vec![-900.0, -3.1, -0.61, -0.07, 0.0, 0.03, 0.47, 0.9, 8.0, 1e3];
    let grown: Vec<f64> = signed.iter().map(|v| v.abs()).collect();
    let shares: Vec<f64> = grown.iter().copied().filter(|v| *v <= 1.0).collect();
    let turns: Vec<f64> = (0..72).map(|k| 5.0 * f64::from(k) - 178.7).collect();
    let (mut seen, mut pairs) = (Vec::new(), 0);
    for file in hopeless() {
        let this = Beyond { checked: check_with(&file, &Options::default().margins(MarginKinds::ALL)), seen: 0 };
        let margins = this.checked.json["frames"][0]["margins"].clone();
        let excluded = &margins["excluded"];
        let friction = |mu: f64| this.with("friction", json!(mu));
        let kernel = |kernel: f64| this.with("kernel", json!(kernel));
        let turned = |degrees: f64| this.turned(degrees);
        let pushed = |share: f64| this.pushed(share);
        let loaded = |factor: f64| this.loaded(factor);
        type Change<'c> = (&'static str, &'c [f64], f64, &'c dyn Fn(f64) -> Value);
        let changes: [Change<'_>; 5] = [
            ("friction", &grown, 0.0, &friction),
            ("kernel", &shares, 0.0, &kernel),
            ("tilt", &turns, 360.0, &turned),
            ("horizontal_load", &signed, 0.0, &pushed),
            ("load_factor", &grown, 0.0, &loaded),
        ];
        for (key, values, period, change) in changes {
            let interval = margins["intervals"].get(key);
            let is_empty = interval.is_some_and(Value::is_null);
            assert_eq!(is_empty, !excluded[key].is_null(), "{key} {margins}");
            if !is_empty {
                continue;
            }
            seen.push(key);
            pairs += usize::from(list(&excluded[key]).len() == 2);
            for at in values {
                let changed = change(*at);
                assert!(is_excluded(&excluded[key], *at, period, &changed), "{key} {at}: {} {changed}", excluded[key]);
            }
        }
        for (name, robot) in margins["intervals"]["robots"].as_object().into_iter().flatten() {
            for key in ["fx", "fy", "torque"] {
                let reasons = &excluded["robots"][name][key];
                assert_eq!(robot[key].is_null(), !reasons.is_null(), "{margins}");
                for at in grown.iter().filter(|_| robot[key].is_null()) {
                    let mut changed = file.clone();
                    changed["robots"][0]["limits"][key] = json!(at);
                    assert!(is_excluded(reasons, *at, 0.0, &changed), "{key} {at}: {reasons}");
                    seen.push(key);
                }
            }
        }
    }
    for key in ["friction", "kernel", "tilt", "horizontal_load", "load_factor", "fx", "fy", "torque"] {
        assert!(seen.contains(&key), "no scene stands at no {key}");
    }
    assert!(pairs >= 2, "{pairs} conflicts of two groups");
}
