//! The statements about forces: totals, weights, resultants, and the used fractions of friction and of limits.

use drystone::result::{Fields, Layout, Origin, PictureOutcome, Timing, line_of, to_json, to_json_with_blocks};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use super::{check, cross, dot, less, list, number, pair, structures};
use crate::structure::{block, on_floor, rectangle};

#[test]
fn totals_are_the_sums_of_the_listed_forces() {
    let mut falling = 0;
    for checked in structures() {
        let frame = &checked.json["frames"][0];
        let mut sum = 0.0;
        for interface in list(&frame["interfaces"]) {
            let normal = pair(&interface["normal_forces"]);
            sum += normal[0] + normal[1] + number(&interface["friction_force"]).abs();
        }
        for robot in list(&frame["robots"]) {
            let force = pair(&robot["force"]);
            sum += force[0].abs() + force[1].abs() + number(&robot["torque"]).abs() / checked.length;
        }
        let total = number(&frame["total_force"]);
        assert!((sum - total).abs() <= 1e-9 * sum.max(1e-9), "{sum} {total}: {}", checked.file);
        let missing: f64 = list(&frame["failures"])
            .iter()
            .map(|f| if f["torque"].is_null() { number(&f["amount"]) } else { number(&f["amount"]) / checked.length })
            .sum();
        let sticking = number(&frame["total_sticking"]);
        let size = number(&frame["weight"]).max(sticking).max(total);
        assert!((missing - sticking).abs() <= 1e-6 * size, "{missing} {sticking}: {}", checked.file);
        falling += usize::from(missing > 0.0);
        for failure in list(&frame["failures"]) {
            let amount = number(&failure["amount"]);
            let own = match failure["kind"].as_str().expect("a kind") {
                "robot_torque" => number(&failure["torque"]).abs(),
                "robot_force" => pair(&failure["force"]).iter().map(|v| v.abs()).sum(),
                _ => dot(pair(&failure["force"]), pair(&failure["force"])).sqrt(),
            };
            assert!((amount - own).abs() <= 1e-9 * own, "{failure}");
        }
    }
    assert!(falling > 5, "some fall");
}

#[test]
fn the_weight_is_that_of_the_placed_blocks() {
    let file = on_floor(
        0.7,
        vec![
            block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0),
            block("b", rectangle(0.0, 1.0, 1.0, 1.0), 7.5),
            json!({ "id": "c", "polygon": rectangle(3.0, 0.0, 2.0, 0.5), "density": 200 }),
        ],
    );
    let checked = check(&file);
    let weight = number(&checked.json["frames"][0]["weight"]);
    assert!((weight - (12.5 + 200.0 * 9.81)).abs() < 1e-9 * weight, "{weight}");
}

#[test]
fn the_blocks_of_a_frame_are_those_placed_with_their_weights_and_outlines() {
    let frame = json!({ "id": "frame", "polygon": rectangle(0.0, 0.0, 4.0, 4.0), "weight": 9,
        "holes": [[[1, 1], [3, 1], [3, 3], [1, 3]]] });
    let mut file = on_floor(0.7, vec![frame, block("top", rectangle(1.0, 4.0, 2.0, 1.0), 5.0)]);
    file["steps"] = json!([{ "place": ["frame"] }, { "place": ["top"] }]);
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let analysis = Analysis::new(&scene);
    let written = to_json_with_blocks(None, &analysis, Timing::LeftOut, Layout::OneLine);
    let result: Value = serde_json::from_str(&written).expect("JSON");
    let blocks = |frame: usize| list(&result["frames"][frame]["blocks"]).to_vec();
    assert_eq!(blocks(0).len(), 1);
    assert_eq!(
        blocks(1),
        [
            json!({ "id": "frame", "centre": [2.0, 2.0], "area": 12.0, "weight": 9.0,
                "vertices": [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
                "holes": [[[1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [1.0, 1.0]]] }),
            json!({ "id": "top", "centre": [2.0, 4.5], "area": 2.0, "weight": 5.0,
                "vertices": [[1.0, 4.0], [3.0, 4.0], [3.0, 5.0], [1.0, 5.0]] }),
        ]
    );
    let fields = Fields::read("frames.blocks.area").expect("a field");
    let line = line_of(&Origin::default(), &analysis, &PictureOutcome::NotAsked, &fields);
    assert_eq!(line, "{\"frames\":[{\"blocks\":[{\"area\":12.0}]},{\"blocks\":[{\"area\":12.0},{\"area\":2.0}]}]}\n");
    let plain = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
    assert!(!plain.contains("\"blocks\""), "blocks are listed only on request");
}

#[test]
fn resultants_replace_the_forces_at_both_points() {
    for checked in structures() {
        for interface in list(&checked.json["frames"][0]["interfaces"]) {
            let normal = pair(&interface["normal"]);
            let tangent = [-normal[1], normal[0]];
            let forces = pair(&interface["normal_forces"]);
            let friction = number(&interface["friction_force"]);
            let points = [pair(&interface["application_points"][0]), pair(&interface["application_points"][1])];
            let (at, force) = (pair(&interface["resultant"]["at"]), pair(&interface["resultant"]["force"]));
            let sum = forces[0] + forces[1];
            let size = sum + friction.abs();
            for ((n, t), force) in normal.iter().zip(tangent).zip(force) {
                assert!((n * sum + t * friction - force).abs() <= 1e-9 * size, "{interface}");
            }
            // The moment about the first point must be the same; friction has no moment about it.
            let span = less(points[1], points[0]);
            let moment = cross(span, normal.map(|n| n * forces[1]));
            let of_resultant = cross(less(at, points[0]), force);
            let reach = dot(span, span).sqrt();
            assert!((moment - of_resultant).abs() <= 1e-6 * size * reach, "{interface}");
        }
    }
}

#[test]
fn contact_forces_press_and_friction_is_stated_as_a_used_fraction() {
    for checked in structures() {
        for interface in list(&checked.json["frames"][0]["interfaces"]) {
            let forces = pair(&interface["normal_forces"]);
            assert!(forces[0] >= 0.0 && forces[1] >= 0.0, "{interface}");
            let most = number(&interface["mu"]) * (forces[0] + forces[1]);
            let friction = number(&interface["friction_force"]).abs();
            let share = number(&interface["friction_used"]);
            assert!(friction <= most * (1.0 + 1e-12), "{interface}");
            assert!((share * most - friction).abs() <= 1e-9 * most, "{interface}");
            assert!(most > 0.0 || share == 0.0, "{interface}");
        }
    }
}

#[test]
fn a_robot_stays_within_its_limits_and_states_the_largest_used_fraction() {
    let mut limited = 0;
    for checked in structures() {
        for robot in list(&checked.json["frames"][0]["robots"]) {
            let listed = list(&checked.file["robots"]).iter().find(|r| r["id"] == robot["id"]);
            let limits = &listed.expect("a robot of the file")["limits"];
            let limit = |key: &str| {
                limits[key].as_f64().or_else(|| match key {
                    "torque" => None,
                    _ => limits["force"].as_f64(),
                })
            };
            let [x, y] = pair(&robot["force"]);
            let given = [
                (x, limit("fx")),
                (y, limit("fy")),
                // A robot without a torque limit exerts no torque.
                (number(&robot["torque"]), Some(limit("torque").unwrap_or(0.0))),
            ];
            let mut most: f64 = 0.0;
            for (amount, limit) in given {
                let Some(limit) = limit else { continue };
                assert!(amount.abs() <= limit * (1.0 + 1e-9), "{robot} {}", checked.file);
                if limit > 0.0 {
                    most = most.max(amount.abs() / limit);
                    limited += 1;
                }
            }
            let share = number(&robot["limit_used"]);
            assert!((share - most).abs() <= 1e-9, "{robot} {most} {limits}");
        }
    }
    assert!(limited > 5);
}
