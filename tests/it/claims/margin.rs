//! What is told of how far a structure is from the edge.

use drystone::Analysis;
use drystone::analysis::{Options, Verdict};
use serde_json::{Value, json};

use super::{list, number, told_with};
use crate::structure::{arch, harmonic, on_slope, scene, wall};

/// Every margin of some scenes of ours, asked of changed files through the front door.
#[test]
fn margins_are_borne_out_by_verdicts_on_either_side() {
    let mut pushed = wall(3, 2);
    pushed["loads"] = json!([{ "block": "4", "force": [1.0, 0.0], "at": [1.0, 0.75] }]);
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    held["robots"] =
        json!([{ "id": "r", "holds": "a", "limits": { "fx": 9, "fy": 9, "torque": 9 } }]);
    let mut asked = 0;
    for file in [
        arch(11, 0.3, 0.7),
        wall(4, 3),
        harmonic(4, 0.9),
        pushed,
        held,
    ] {
        let options = Options::default().margins(true);
        let json = told_with(&file, &options).json;
        let margins = &json["frames"][0]["margins"];
        let mut agrees = |margin: &Value, more_is_worse: bool, change: &dyn Fn(f64) -> Value| {
            let Some(at) = margin.as_f64().filter(|at| *at > 1e-6) else {
                return;
            };
            for (share, inside) in [(1.0 - 1e-4, more_is_worse), (1.0 + 1e-4, !more_is_worse)] {
                let changed = change(at * share);
                let verdict = Analysis::new(scene(&changed)).frames[0].verdict;
                let expected = if inside {
                    Verdict::Stable
                } else {
                    Verdict::Unstable
                };
                assert_eq!(
                    verdict, expected,
                    "{at} times {share} in {margins}: {changed}"
                );
                asked += 1;
            }
        };
        let with = |key: &str, value: Value| {
            let mut changed = file.clone();
            changed[key] = value;
            changed
        };
        agrees(&margins["friction"], false, &|mu| {
            with("friction", json!(mu))
        });
        agrees(&margins["kernel"], true, &|kernel| {
            with("kernel", json!(kernel))
        });
        agrees(&margins["load_factor"], true, &|factor| {
            let mut changed = file.clone();
            for load in changed["loads"].as_array_mut().expect("loads") {
                for axis in 0..2 {
                    load["force"][axis] = json!(number(&load["force"][axis]) * factor);
                }
            }
            changed
        });
        for (side, way) in [("left", -1.0), ("right", 1.0)] {
            if file["loads"].is_null() {
                agrees(&margins["tilt"][side], true, &|degrees| {
                    let angle = degrees.to_radians();
                    with(
                        "gravity",
                        json!([way * libm::sin(angle), -libm::cos(angle)]),
                    )
                });
            }
            agrees(&margins["horizontal_load"][side], true, &|share| {
                let mut changed = file.clone();
                let scene = scene(&file);
                let mut loads = list(&file["loads"]).to_vec();
                for block in scene.blocks() {
                    let at = [block.centroid.x, block.centroid.y];
                    loads.push(json!({ "block": block.id, "force": [way * share * block.weight, 0.0], "at": at }));
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
    assert!(asked >= 20, "{asked}");
}
