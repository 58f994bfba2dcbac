//! How steps change the frames.

use serde_json::{Value, json};

use super::Shown::{Refused, Result};
use super::{Claim, WEIGHT, assert_claims, file};
use crate::structure::rectangle;

/// A scene with the given steps, three blocks, one of them on another, and two robots.
fn steps(steps: Value) -> Value {
    let at = |id: &str, x: f64, y: f64| json!({ "id": id, "polygon": rectangle(x, y, 1.0, 1.0) });
    file(json!({ "blocks": [at("a", 0.0, 0.0), at("b", 0.0, 1.0), at("c", 3.0, 0.0)],
        "robots": [{ "id": "r" }, { "id": "q", "holds": "a", "at": [0.25, 0.25] }], "steps": steps }))
}

#[test]
fn steps_work_as_the_page_says() {
    let holding = json!({ "place": ["a", "c"], "hold": { "r": "a" } });
    let two = json!({ "place": ["a"], "hold": { "r": "a", "q": "a" } });
    assert_claims(vec![
        Claim(
            "Each step makes one frame",
            steps(json!([{ "title": "t" }, {}, {}])),
            Result("/frames/2/title", json!("")),
        ),
        Claim("blocks stay placed", steps(json!([{ "place": ["a"] }, {}])), Result("/frames/1/weight", json!(9.81))),
        Claim(
            "robots hold their blocks until a later step releases them",
            steps(json!([holding, {}])),
            Result("/frames/1/robots/0/holds", json!("a")),
        ),
        Claim(
            "a robot may release one block and hold another in the same step",
            steps(json!([holding, { "release": ["r"], "hold": { "r": "c" } }])),
            Result("/frames/1/robots/0/holds", json!("c")),
        ),
        Claim(
            "a robot may hold a block that is placed in the same step",
            steps(json!([holding])),
            Result("/frames/0/robots/0/holds", json!("a")),
        ),
        Claim(
            "can hold another block only after a `release`",
            steps(json!([holding, { "hold": { "r": "c" } }])),
            Refused("holds_two", "release"),
        ),
        Claim(
            "Without a `release`, a robot may only take hold of the same block again, at another grip point",
            steps(json!([holding, { "hold": { "r": { "block": "a", "at": [0.1, 0.1] } } }])),
            Result("/frames/1/robots/0/at", json!([0.1, 0.1])),
        ),
        Claim("Several robots may hold one block", steps(json!([two])), Result("/frames/0/robots/1/holds", json!("a"))),
        Claim(
            "The `at` of a robot also applies in a step",
            steps(json!([two])),
            Result("/frames/0/robots/1/at", json!([0.25, 0.25])),
        ),
        Claim(
            "The key `holds` of a robot applies to a scene without steps",
            steps(json!([{ "place": ["a"] }])),
            Result("/frames/0/robots", json!([])),
        ),
        Claim("has one frame, in which all blocks are placed", steps(json!([])), Result(WEIGHT, json!(3.0 * 9.81))),
        Claim(
            "each robot holds the block in its key `holds`",
            steps(json!([])),
            Result("/frames/0/robots/0/id", json!("q")),
        ),
        Claim(
            "A removed block may be placed again, even in the same step",
            steps(json!([{ "place": ["a"] }, { "remove": ["a"], "place": ["a"] }])),
            Result("/frames/1/weight", json!(9.81)),
        ),
        Claim(
            "draws a block in the frame of this step only; the planned block carries no force",
            steps(json!([{ "place": ["a"], "plan": { "r": "b" } }])),
            Result(WEIGHT, json!(9.81)),
        ),
        Claim(
            "a step that places a placed block",
            steps(json!([{ "place": ["a"] }, { "place": ["a"] }])),
            Refused("placed_twice", "steps[1]"),
        ),
        Claim(
            "removes or holds a block that is not placed",
            steps(json!([{ "place": ["a"], "remove": ["a"] }])),
            Refused("not_placed", "removed"),
        ),
        Claim(
            "removes or holds a block that is not placed",
            steps(json!([{ "hold": { "r": "a" } }])),
            Refused("not_placed", "holds"),
        ),
        Claim(
            "removes a held block",
            steps(json!([holding, { "remove": ["a"] }])),
            Refused("removed_while_held", "release"),
        ),
        Claim(
            "plans a placed block",
            steps(json!([{ "place": ["a"], "plan": { "r": "a" } }])),
            Refused("placed_twice", "plan"),
        ),
    ]);
    let loaded = |steps: Value| {
        let blocks = json!([{ "id": "a", "polygon": rectangle(0.0, 0.0, 1.0, 1.0) }, { "id": "b", "polygon": rectangle(3.0, 0.0, 1.0, 1.0) }]);
        file(json!({ "blocks": blocks, "loads": [{ "block": "b", "force": [0, -5] }], "steps": steps }))
    };
    let phrase = "A load acts in every frame in which its block is placed";
    let steps = json!([{ "place": ["a"] }, { "place": ["b"] }, {}]);
    for (pointer, force) in
        [("/frames/0/total_force", 9.81), ("/frames/1/total_force", 24.62), ("/frames/2/total_force", 24.62)]
    {
        assert_claims(vec![Claim(phrase, loaded(steps.clone()), Result(pointer, json!(force)))]);
    }
}
