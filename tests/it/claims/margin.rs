//! The statements about the margins of a structure.

use drystone::Analysis;
use drystone::analysis::{MarginKind, MarginKinds, Options, Verdict};
use drystone::figure::{self, Kind};
use drystone::output::svg;
use serde_json::{Value, json};

use super::{check_with, list, number};
use crate::oracle::random;
use crate::structure::{arch, harmonic, on_slope, scene, wall};

/// Every margin of some scenes, checked by analysing changed scene files.
#[test]
fn margins_agree_with_verdicts_on_either_side() {
    let mut pushed = wall(3, 2);
    pushed["loads"] = json!([{ "block": "4", "force": [1.0, 0.0], "at": [1.0, 0.75] }]);
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    // With a vertical limit this small, the robot needs its horizontal force.
    held["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 9, "fy": 0.1, "torque": 9 } }]);
    let mut compared = 0;
    for file in [arch(11, 0.3, 0.7), wall(4, 3), harmonic(4, 0.9), pushed, held] {
        let options = Options::default().margins(MarginKinds::ALL);
        let json = check_with(&file, &options).json;
        let margins = &json["frames"][0]["margins"];
        let mut agrees = |margin: &Value, more_is_worse: bool, change: &dyn Fn(f64) -> Value| {
            let Some(at) = margin.as_f64().filter(|at| *at > 1e-6) else {
                return;
            };
            for (share, inside) in [(1.0 - 1e-5, more_is_worse), (1.0 + 1e-5, !more_is_worse)] {
                let changed = change(at * share);
                let verdict = Analysis::new(scene(&changed)).frames[0].verdict;
                let expected = if inside { Verdict::Stable } else { Verdict::Unstable };
                assert_eq!(verdict, expected, "{at} times {share} in {margins}: {changed}");
                compared += 1;
            }
        };
        assert_margins_are_ends(margins);
        let with = |key: &str, value: Value| {
            let mut changed = file.clone();
            changed[key] = value;
            changed
        };
        agrees(&margins["friction"], false, &|mu| with("friction", json!(mu)));
        agrees(&margins["kernel"], true, &|kernel| with("kernel", json!(kernel)));
        agrees(&margins["load_factor"], true, &|factor| {
            let mut changed = file.clone();
            for load in changed["loads"].as_array_mut().expect("loads") {
                for axis in 0..2 {
                    load["force"][axis] = json!(number(&load["force"][axis]) * factor);
                }
            }
            changed
        });
        for (side, sign) in [("left", -1.0), ("right", 1.0)] {
            if file["loads"].is_null() {
                agrees(&margins["tilt"][side], true, &|degrees| {
                    let angle = degrees.to_radians();
                    with("gravity", json!([sign * libm::sin(angle), -libm::cos(angle)]))
                });
            }
            agrees(&margins["horizontal_load"][side], true, &|share| {
                let mut changed = file.clone();
                let scene = scene(&file);
                let mut loads = list(&file["loads"]).to_vec();
                for block in scene.blocks() {
                    let at = [block.centroid.x, block.centroid.y];
                    loads.push(json!({ "block": block.id, "force": [sign * share * block.weight, 0.0], "at": at }));
                }
                changed["loads"] = json!(loads);
                changed
            });
        }
        for key in ["fx", "fy", "torque"] {
            agrees(&margins["robots"]["r"][key], false, &|limit| {
                let mut changed = file.clone();
                changed["robots"][0]["limits"][key] = json!(limit);
                changed
            });
        }
    }
    assert!(compared >= 20, "{compared}");
}

/// A margin is the end of its interval on the same side.
fn assert_margins_are_ends(margins: &Value) {
    let intervals = &margins["intervals"];
    let assert_is_end = |margin: &Value, interval: &Value, end: usize, sign: f64| {
        let Some(at) = margin.as_f64() else {
            assert!(margin == "unbounded" || interval.is_null(), "{margins}");
            return;
        };
        assert_eq!(at, sign * number(&interval[end]) + 0.0, "{margins}");
    };
    assert_is_end(&margins["friction"], &intervals["friction"], 0, 1.0);
    assert_is_end(&margins["kernel"], &intervals["kernel"], 1, 1.0);
    assert_is_end(&margins["load_factor"], &intervals["load_factor"], 1, 1.0);
    for key in ["tilt", "horizontal_load"] {
        assert_is_end(&margins[key]["left"], &intervals[key], 0, -1.0);
        assert_is_end(&margins[key]["right"], &intervals[key], 1, 1.0);
    }
    for (robot, limits) in margins["robots"].as_object().into_iter().flatten() {
        for key in ["fx", "fy", "torque"] {
            assert_is_end(&limits[key], &intervals["robots"][robot][key], 0, 1.0);
        }
    }
}

/// The text of a figure `--kind mechanism --at load-factor` states the interval of the result, whether or not the frame stands as it is.
#[test]
fn the_figure_of_a_margin_states_the_interval_of_the_result() {
    let options = Options::default().margins(MarginKinds::new(&[MarginKind::LoadFactor]));
    // A plank overhangs its support; the load is a counterweight of which at least a third is needed.
    let plank = json!({ "drystone": 1, "friction": 0.7,
        "ground": [{ "polygon": [[0, -1], [4, -1], [4, 0], [0, 0]] }],
        "blocks": [{ "id": "plank", "polygon": [[1, 0], [9, 0], [9, 1], [1, 1]], "weight": 6 }],
        "loads": [{ "block": "plank", "force": [0, -12], "at": [2.5, 1] }] });
    let random = (0..400).map(|number| random::scene(number).1);
    let loaded = |file: &Value| !list(&file["loads"]).is_empty();
    let sound = |file: &Value| drystone::Scene::from_json(&file.to_string()).is_ok();
    let files = random.filter(loaded).filter(sound).take(40);
    let (mut standing, mut falling, mut never) = (0, 0, 0);
    for (number_of, file) in [plank].into_iter().chain(files).enumerate() {
        let checked = check_with(&file, &options);
        let frame = &checked.json["frames"][0];
        let interval = &frame["margins"]["intervals"]["load_factor"];
        let analysis = Analysis::with(scene(&file), &options);
        let figure_options = figure::Options::default().at(drystone::figure::At::Margin(MarginKind::LoadFactor));
        let svg = svg::write(&figure::draw(&analysis, Kind::Mechanism, &figure_options));
        let document = roxmltree::Document::parse(&svg).expect("XML");
        let parts = document.descendants().filter(|n| n.has_tag_name("text"));
        let words: Vec<&str> = parts.filter_map(|n| n.text()).collect();
        let words = words.join(" ");
        let ends = [&interval[0], &interval[1]].map(Value::as_f64);
        // Ends are written with three digits.
        let near = |exact: f64| {
            let plain = words.replace("×10⁶", "e6").replace("×10⁷", "e7").replace("×10⁸", "e8");
            let numbers: Vec<f64> = plain.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
            numbers.into_iter().any(|value| (value - exact).abs() <= 1e-2 * exact)
        };
        if number_of == 0 {
            // The weight acts 1 m outside the ground's edge at x = 4 m, the load 1.5 m inside: 6·1 = 12·1.5·f.
            assert!(ends[0].is_some_and(|low| (low - 1.0 / 3.0).abs() < 1e-6), "{interval}");
            assert!(words.contains("stands with its loads times at least 0.334"), "{words}");
        }
        if interval == "withheld" {
            assert!(words.contains("not confirmed"), "{words}: {file}");
            continue;
        }
        match (frame["verdict"].as_str().expect("a word"), interval.is_null()) {
            (verdict, true) => {
                assert_ne!(verdict, "stable", "{file}");
                assert!(words.contains("stands under no multiple of its loads"), "{words}");
                never += 1;
            }
            ("stable", false) => {
                let low = ends[0].filter(|low| *low > 0.0);
                for end in [low, ends[1]].into_iter().flatten() {
                    assert!(near(end), "{end}: {words}: {file}");
                }
                standing += 1;
            }
            (_, false) => {
                let low = ends[0].filter(|low| *low > 0.0);
                assert!(words.contains("stands with its loads"), "{words}: {file}");
                for end in [low, ends[1].filter(|high| *high > 0.0)].into_iter().flatten() {
                    assert!(near(end), "{end}: {words}: {file}");
                }
                falling += 1;
            }
        }
    }
    assert!(standing > 5 && falling > 3 && never > 3, "{standing} {falling} {never}");
}
