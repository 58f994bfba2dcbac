//! Tests the page of the scene format: each claim is a phrase of the page with a small scene that shows it.
//!
//! The test fails if the page no longer contains the phrase or the scene no longer behaves as the phrase says.

mod order;
mod refused;
mod step;

use drystone::Analysis;
use drystone::result::{Layout, Timing, to_json};
use drystone::scene::Scene;
use serde_json::{Value, json};

use super::words_of;
use crate::structure::rectangle;

/// A block of 1 m by 1 m on a floor. The given keys are added to the scene or replace its keys.
fn file(keys: Value) -> Value {
    let mut file = json!({ "drystone": 1, "ground": [{ "polygon": rectangle(-20.0, -1.0, 60.0, 1.0) }],
        "blocks": [{ "id": "a", "polygon": rectangle(0.0, 0.0, 1.0, 1.0) }] });
    put(&mut file, keys);
    file
}

/// The scene of [`file`] with additional keys of its block.
fn block(keys: Value, scene: Value) -> Value {
    let mut file = file(scene);
    put(&mut file["blocks"][0], keys);
    file
}

/// A scene with cells on a square lattice of half a metre. The given keys are added to its block.
fn cells(keys: Value) -> Value {
    let mut file = json!({ "drystone": 1, "grid": { "kind": "square", "side": 0.5 },
        "ground": [{ "cells": [[0, -1], [1, -1]] }], "blocks": [{ "cells": [[0, 0], [0, 1]] }] });
    put(&mut file["blocks"][0], keys);
    file
}

fn put(object: &mut Value, keys: Value) {
    for (key, value) in keys.as_object().expect("keys") {
        object[key] = value.clone();
    }
}

/// A phrase of the page, a scene, and what the scene shows.
struct Claim(&'static str, Value, Shown);

enum Shown {
    /// The result has this value at this path.
    Result(&'static str, Value),
    /// The scene is refused with only this code, and the message or the help contains these words.
    Refused(&'static str, &'static str),
}
use Shown::{Refused, Result};

fn is_near(found: &Value, expected: &Value) -> bool {
    match (found, expected) {
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_near(a, b)),
        (Value::Number(a), Value::Number(b)) => {
            let [a, b] = [a, b].map(|x| x.as_f64().unwrap_or(f64::NAN));
            (a - b).abs() <= 1e-9 * b.abs().max(1.0)
        }
        _ => found == expected,
    }
}

fn assert_claims(claims: Vec<Claim>) {
    let page = words_of("src/doc/format.md");
    for Claim(phrase, file, shown) in claims {
        assert!(page.contains(phrase), "the page does not contain: {phrase}");
        match (Scene::from_json(&file.to_string()), shown) {
            (Ok(scene), Result(pointer, expected)) => {
                let json = to_json(&Analysis::new(&scene), Timing::LeftOut, Layout::OneLine);
                let result: Value = serde_json::from_str(&json).expect("JSON");
                let found = result.pointer(pointer).unwrap_or(&Value::Null);
                assert!(is_near(found, &expected), "{phrase}\n{file}\n{found}");
            }
            (Err(problems), Refused(code, words)) => {
                let text = problems.to_string();
                let codes = problems.list.iter().map(|p| p.code.word());
                assert!(codes.clone().all(|c| c == code), "{phrase}\n{file}\n{text}");
                assert!(text.contains(words), "{phrase}\n{file}\n{text}");
            }
            (Ok(_), _) => panic!("{phrase}\n{file}\nis not refused"),
            (Err(problems), _) => panic!("{phrase}\n{file}\n{problems}"),
        }
    }
}

const STANDS: &str = "/frames/0/verdict";
const WEIGHT: &str = "/frames/0/weight";
const MU: &str = "/frames/0/interfaces/0/mu";
const ENDS: &str = "/frames/0/interfaces/0/ends";

fn stands() -> Shown {
    Result(STANDS, json!("stable"))
}

#[test]
fn optional_keys_may_be_left_out_and_unknown_keys_are_errors() {
    let without = |key: &str| {
        let mut file = file(json!({}));
        file.as_object_mut().expect("an object").remove(key);
        file
    };
    assert_claims(vec![
        Claim(
            "the message names the nearest known key",
            block(json!({ "weigth": 1 }), json!({})),
            Refused("unknown_key", "the nearest known key is `weight`"),
        ),
        Claim(
            "or all known keys if none is similar",
            file(json!({ "zzzzzz": 1 })),
            Refused(
                "unknown_key",
                "known keys are author, blocks, cases, contact_tolerance, contacts, corner_contacts",
            ),
        ),
        Claim(
            "All keys may be left out, except those that the tables below mark as *required*",
            without("ground"),
            Result(STANDS, json!("unstable")),
        ),
        Claim("`drystone` | integer, required", without("drystone"), Refused("missing_key", "drystone")),
        Claim("`blocks` | list: a block, required", without("blocks"), Refused("missing_key", "blocks")),
        Claim(
            "the value `null` has the same meaning as leaving the key out",
            file(json!({ "title": null, "gravity": null, "grid": null,
            "friction": null, "kernel": null, "contact_tolerance": null, "$schema": null })),
            stands(),
        ),
        Claim(
            "the value `null` has the same meaning as leaving the key out",
            block(
                json!({ "cells": null, "shape": null, "at": null,
            "weight": null, "fill": null }),
                json!({ "robots": [{ "id": null, "holds": null, "at": null, "limits": null }] }),
            ),
            stands(),
        ),
    ]);
    let lists = ["materials", "friction_pairs", "shapes", "ground", "robots", "loads", "steps", "silence"];
    for key in lists.into_iter().chain(["drystone", "blocks"]) {
        let refused = Refused("wrong_type", "found null");
        assert_claims(vec![Claim(
            "`null` is an error for required keys, for keys whose value is a list",
            file(json!({ key: null })),
            refused,
        )]);
    }
}

#[test]
fn defaults_and_units_are_those_of_the_page() {
    let held = |limits: Value| {
        let robot = json!({ "holds": "a", "limits": limits });
        block(json!({ "polygon": rectangle(0.0, 5.0, 1.0, 1.0), "weight": 10 }), json!({ "robots": [robot] }))
    };
    let pushed = |load: Value| block(json!({ "weight": 10 }), json!({ "loads": [load] }));
    let resultant = "/frames/0/interfaces/0/resultant";
    assert_claims(vec![
        Claim("default `[0, -9.81]`", file(json!({})), Result(WEIGHT, json!(9.81))),
        Claim(
            "default `1` | Density in kg/m³, at least 0, of each block for which neither the block nor its material gives one;",
            file(json!({})),
            Result(WEIGHT, json!(9.81)),
        ),
        Claim(
            "default `1` | Thickness of all blocks perpendicular to the plane, in the length unit of the scene, at least 0.",
            file(json!({ "thickness": 2 })),
            Result(WEIGHT, json!(19.62)),
        ),
        Claim(
            "default `0.7` | Friction coefficient μ, at least 0, of each body for which neither the body nor its material gives one.",
            file(json!({})),
            Result(MU, json!(0.7)),
        ),
        Claim(
            "default `0` | Safety kernel, 0 to 1: each application point moves inward by half this fraction of the contact's length.",
            file(json!({ "kernel": 0.2 })),
            Result("/frames/0/interfaces/0/application_points", json!([[0.9, 0], [0.1, 0]])),
        ),
        Claim(
            "default `0`",
            file(json!({})),
            Result("/frames/0/interfaces/0/application_points", json!([[1, 0], [0, 0]])),
        ),
        Claim(
            "default `false` | Which corners that touch carry force: none (`false`), all (`true`), or",
            block(json!({ "polygon": [[0, 0], [1, 1], [0, 2], [-1, 1]] }), json!({})),
            Result(STANDS, json!("unstable")),
        ),
        Claim(
            "none (`false`), all (`true`), or `\"on_edges\"`: those that touch an edge, but not those that touch only another corner.",
            block(json!({ "polygon": [[0, 0], [1, 1], [0, 2], [-1, 1]] }), json!({ "corner_contacts": true })),
            Result("/frames/0/interfaces/0/kind", json!("corner")),
        ),
        Claim(
            "Default: the number of the block in the list, from 1.",
            block(json!({ "id": null }), json!({})),
            Result("/frames/0/interfaces/0/bodies", json!(["1", "ground"])),
        ),
        Claim(
            "Default: \"r\" and the number of the robot in the list, from 0.",
            file(json!({ "robots": [{ "holds": "a" }] })),
            Result("/frames/0/robots/0/id", json!("r0")),
        ),
        Claim(
            "ignored without `holds`. Default: the block's centroid.",
            file(
                json!({ "robots": [{ "id": "r", "at": [0.25, 0.25] }], "steps": [{ "place": ["a"], "hold": { "r": "a" } }] }),
            ),
            Result("/frames/0/robots/0/at", json!([0.5, 0.5])),
        ),
        Claim("Largest force and torque of the robot. Default: any force, no torque.", held(json!(null)), stands()),
        Claim("Default: `force`, else unlimited.", held(json!({ "fx": 0 })), stands()),
        Claim("Default: `force`, else unlimited.", held(json!({ "force": 9 })), Result(STANDS, json!("unstable"))),
        Claim(
            "Limit for `fx` and `fy` if they are not given",
            held(json!({ "force": 5, "fy": 20 })),
            Result("/frames/0/robots/0/limit_used", json!(0.5)),
        ),
        Claim(
            "default `[0, 0]` | Force [x, y] in the force unit of the scene.",
            pushed(json!({ "block": "a" })),
            Result(resultant, json!({ "at": [0.5, 0.0], "force": [0.0, 10.0] })),
        ),
        Claim(
            "Point [x, y], in the length unit of the scene, at which the force acts. Default: the block's centroid.",
            pushed(json!({ "block": "a", "force": [0, -10] })),
            Result(resultant, json!({ "at": [0.5, 0.0], "force": [0.0, 20.0] })),
        ),
        Claim(
            "Point [x, y], in the length unit of the scene, at which the force acts.",
            pushed(json!({ "block": "a", "force": [0, -10], "at": [0.75, 9] })),
            Result("/frames/0/interfaces/0/resultant/at", json!([0.625, 0])),
        ),
        Claim(
            "default `0` | Torque in the force unit times the length unit of the scene, anticlockwise positive.",
            pushed(json!({ "block": "a", "torque": 1 })),
            Result("/frames/0/interfaces/0/resultant/at", json!([0.4, 0])),
        ),
        Claim(
            "With `\"units\": { \"length\": \"mm\", \"force\": \"kN\" }` all lengths of the file are in millimetres",
            json!({ "drystone": 1, "units": { "length": "mm", "force": "kN" },
                "ground": [{ "polygon": rectangle(-2000.0, -1000.0, 6000.0, 1000.0) }],
                "blocks": [{ "polygon": rectangle(0.0, 0.0, 1000.0, 1000.0), "weight": 3 }] }),
            Result("/frames/0/interfaces/0/resultant", json!({ "at": [0.5, 0.0], "force": [0.0, 3000.0] })),
        ),
        Claim(
            "Masses stay in kg, densities in kg/m³ and gravity in m/s².",
            json!({ "drystone": 1, "units": { "length": "mm", "force": "kN" }, "density": 1000, "thickness": 500,
                "ground": [{ "polygon": rectangle(-2000.0, -1000.0, 6000.0, 1000.0) }],
                "blocks": [{ "polygon": rectangle(0.0, 0.0, 1000.0, 1000.0) }] }),
            Result(WEIGHT, json!(4905.0)),
        ),
        Claim(
            "The unit of torques is the unit of forces times that of lengths: kN·mm.",
            json!({ "drystone": 1, "units": { "length": "mm", "force": "kN" },
                "ground": [{ "polygon": rectangle(-2000.0, -1000.0, 6000.0, 1000.0) }],
                "blocks": [{ "id": "a", "polygon": rectangle(0.0, 0.0, 1000.0, 1000.0), "weight": 1 }],
                "loads": [{ "block": "a", "torque": 100 }] }),
            Result("/frames/0/interfaces/0/resultant/at", json!([0.4, 0.0])),
        ),
        Claim(
            "default `1` | Edge length of a cell in the length unit of the scene, more than 0.",
            json!({ "drystone": 1, "grid": { "kind": "square" },
            "blocks": [{ "cells": [[0, 0]] }] }),
            Result(WEIGHT, json!(9.81)),
        ),
        Claim("Title of the scene", file(json!({ "title": "é" })), Result("/scene", json!("é"))),
    ]);
}
