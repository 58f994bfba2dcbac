//! Tests the page of results: each phrase has a small scene that shows it.

use drystone::Analysis;
use drystone::analysis::{EffectName, MarginKind, MarginKinds, Method, Options};
use drystone::result::{Layout, Timing, to_json};
use serde_json::{Value, json};

use super::words_of;
use crate::structure::{block, on_floor, on_slope, rectangle, scene};

fn result(file: &Value, options: &Options) -> Value {
    let analysis = Analysis::with(scene(file), options);
    let json = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
    serde_json::from_str(&json).expect("JSON")
}

/// A phrase of the page, a scene, the options of its analysis, a path in the result, and the expected value at this
/// path. `None` if there must be no value.
struct Claim<'a>(&'static str, &'a Value, &'a Options, &'static str, Option<Value>);

fn assert_claims(claims: Vec<Claim<'_>>) {
    let page = words_of("src/doc/result.md");
    for Claim(phrase, file, options, pointer, expected) in claims {
        assert!(page.contains(phrase), "the page does not contain: {phrase}");
        let result = result(file, options);
        let found = result.pointer(pointer);
        let near = match (found, &expected) {
            (Some(found), Some(expected)) => is_near(found, expected),
            (found, expected) => found == expected.as_ref(),
        };
        assert!(near, "{phrase}\n{file}\n{pointer}: {found:?}");
    }
}

/// True if two values are equal, numbers up to 10⁻⁹.
fn is_near(found: &Value, expected: &Value) -> bool {
    match (found, expected) {
        (Value::Array(found), Value::Array(expected)) => {
            found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| is_near(a, b))
        }
        _ => match (found.as_f64(), expected.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * b.abs().max(1.0),
            _ => found == expected,
        },
    }
}

/// A block of 3 m by 2 m without support.
fn hanging() -> Value {
    on_floor(0.7, vec![block("a", rectangle(0.0, 5.0, 3.0, 2.0), 6.0)])
}

fn held(limits: Value, loads: Value) -> Value {
    let mut file = on_floor(0.7, vec![block("a", rectangle(0.0, 5.0, 2.0, 2.0), 10.0)]);
    file["robots"] = json!([{ "id": "idle" }, { "id": "r", "holds": "a", "limits": limits }]);
    file["loads"] = loads;
    file
}

#[test]
fn sums_lengths_and_shares_are_as_the_page_says() {
    let plain = Options::default();
    let side_by_side = |widths: &[f64]| {
        let blocks = widths.iter().enumerate();
        let blocks = blocks.map(|(k, width)| block(&k.to_string(), rectangle(5.0 * k as f64, 0.0, *width, 1.0), 1.0));
        on_floor(0.7, blocks.collect())
    };
    let mut tip = on_floor(0.7, vec![block("a", json!([[0, 0], [1, 1], [0, 2], [-1, 1]]), 1.0)]);
    tip["corner_contacts"] = json!(true);
    let mut smooth = on_floor(0.0, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 1.0)]);
    let flat = smooth.clone();
    smooth["loads"] = json!([{ "block": "a", "force": [1, 0] }]);
    let mut hung = side_by_side(&[1.0]);
    hung["blocks"].as_array_mut().expect("blocks").push(block("z", rectangle(0.0, 5.0, 1.0, 1.0), 2.0));
    let slides = on_slope(35.0, 2.0, 1.0, 0.5, 0.1);
    let only = Options::default().verdict_only(true);
    let (nothing, two, three) = (on_floor(0.7, vec![]), side_by_side(&[3.0, 0.5]), side_by_side(&[3.0, 0.5, 2.0]));
    let hanging = hanging();
    let none = json!([]);
    let (short, no, side) = (
        held(json!({ "force": 9 }), none.clone()),
        held(json!({ "force": 0 }), none.clone()),
        held(json!({ "force": 20 }), json!([{ "block": "a", "force": [15, 0] }])),
    );
    let at = |phrase, file, pointer, value| Claim(phrase, file, &plain, pointer, Some(value));
    assert_claims(vec![
        at("median length of the interfaces without corner contacts", &three, "/frames/0/length", json!(2.0)),
        at("the shorter of the two in the middle", &two, "/frames/0/length", json!(0.5)),
        at("without corner contacts", &tip, "/frames/0/length", json!(2f64.sqrt())),
        at(
            "in a frame without interfaces the square root of the median block's area",
            &hanging,
            "/frames/0/length",
            json!(6f64.sqrt()),
        ),
        at("1 in an empty frame", &nothing, "/frames/0/length", json!(1.0)),
        at("weight of all placed blocks", &hung, "/frames/0/weight", json!(3.0)),
        at(
            "friction force as a share of the largest possible friction μN, from 0 to 1; 0 without friction",
            &smooth,
            "/frames/0/interfaces/0/friction_used",
            json!(0.0),
        ),
        at(
            "friction force as a share of the largest possible friction μN, from 0 to 1; 0 without friction",
            &flat,
            "/frames/0/interfaces/0/friction_used",
            json!(0.0),
        ),
        at(
            "in a falling frame for the balance that includes the missing forces",
            &slides,
            "/frames/0/interfaces/0/friction_used",
            json!(1.0),
        ),
        at("robots that hold a block in this frame", &side, "/frames/0/robots/0/id", json!("r")),
        Claim("robots that hold a block in this frame", &side, &plain, "/frames/0/robots/1", None),
        at(
            "largest share of a limit that the robot uses, from 0 to 1",
            &side,
            "/frames/0/robots/0/limit_used",
            json!(0.75),
        ),
        at(
            "in a falling frame for the balance that includes the missing forces",
            &short,
            "/frames/0/robots/0/limit_used",
            json!(1.0),
        ),
        at("0 for a robot without limits, or with all limits 0", &no, "/frames/0/robots/0/limit_used", json!(0.0)),
        at("missing force, on `bodies[0]` or on the block", &short, "/frames/0/failures/0/force", json!([0.0, 1.0])),
        at(
            "`failures` may be empty and `total_sticking` may be 0 in a frame that falls",
            &hanging,
            "/frames/0/verdict",
            json!("unstable"),
        ),
        at("`failures` may be empty", &hanging, "/frames/0/failures", json!([])),
        at("if no adhesion would help (`unsupported`)", &hanging, "/frames/0/total_sticking", json!(0.0)),
        Claim(
            "and with `--verdict-only`, which does not compute it",
            &slides,
            &only,
            "/frames/0/total_sticking",
            Some(json!(0.0)),
        ),
        Claim("`failures` may be empty", &slides, &only, "/frames/0/failures", Some(json!([]))),
        at(
            "blocks that would fall even if all contacts and grips could stick",
            &hung,
            "/frames/0/unsupported",
            json!(["z"]),
        ),
        at("velocities of the blocks as the collapse begins", &hung, "/frames/0/mechanism/0/block", json!("z")),
        Claim("velocities of the blocks as the collapse begins", &hung, &plain, "/frames/0/mechanism/1", None),
        at("empty if the frame stands", &flat, "/frames/0/mechanism", json!([])),
        at("title of the step; empty if it has none", &flat, "/frames/0/title", json!("")),
        at("lower bound of `total_force` for all balances", &flat, "/frames/0/total_force_bound", json!(1.0)),
        Claim("if the frame stands and a bound was found", &hanging, &plain, "/frames/0/total_force_bound", None),
    ]);
}

#[test]
fn requested_values_are_present_and_others_are_not() {
    let plain = Options::default();
    let some = Options::default().margins(MarginKinds::new(&[MarginKind::Friction]));
    let all = Options::default().margins(MarginKinds::ALL).wedging(true);
    let stands = on_floor(0.7, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 1.0)]);
    let mut narrow = stands.clone();
    narrow["blocks"][0]["polygon"] = rectangle(0.0, 0.005, 1.0, 1.0);
    let (hanging, held) = (hanging(), held(json!(null), json!([])));
    let there = |phrase, file, options, pointer, value| Claim(phrase, file, options, pointer, Some(value));
    let empty = json!({ "left": [], "right": [] });
    assert_claims(vec![
        Claim("`frames[].margins` | object | *with `--margins`:*", &stands, &plain, "/frames/0/margins", None),
        there(
            "`frames[].margins.friction` | margin | *if requested:*",
            &stands,
            &some,
            "/frames/0/margins/friction",
            json!(0.0),
        ),
        Claim("`frames[].margins.kernel` | margin | *if requested:*", &stands, &some, "/frames/0/margins/kernel", None),
        Claim("`frames[].margins.tilt` | object | *if requested:*", &stands, &some, "/frames/0/margins/tilt", None),
        there("empty if they were not requested", &held, &some, "/frames/0/margins/robots", json!({})),
        there(
            "least limits of each robot that holds a block",
            &held,
            &all,
            "/frames/0/margins/robots/r/fy",
            json!(10.0),
        ),
        Claim("least limits of each robot that holds a block", &held, &all, "/frames/0/margins/robots/idle", None),
        there(
            "empty for a margin that is unbounded or null",
            &stands,
            &some,
            "/frames/0/margins/mechanisms/tilt",
            empty.clone(),
        ),
        there(
            "empty for a margin that is unbounded or null",
            &hanging,
            &all,
            "/frames/0/margins/mechanisms/tilt",
            empty,
        ),
        there("null if it falls without a turn", &hanging, &all, "/frames/0/margins/tilt/left", Value::Null),
        there(
            "a margin is null if the frame stands at no value",
            &hanging,
            &all,
            "/frames/0/margins/friction",
            Value::Null,
        ),
        there(
            "`frames[].only_by_wedging` | boolean or null | *with `--wedging`, if the frame stands:*",
            &stands,
            &all,
            "/frames/0/only_by_wedging",
            json!(false),
        ),
        Claim("with `--wedging`, if the frame stands", &hanging, &all, "/frames/0/only_by_wedging", None),
        Claim("with `--wedging`, if the frame stands", &stands, &plain, "/frames/0/only_by_wedging", None),
        there("by forces if the frame stands", &stands, &plain, "/frames/0/proof/worst_pull", json!(0.0)),
        there("by a motion if it falls", &hanging, &plain, "/frames/0/proof/no_balance_below", json!("unbounded")),
        there("by either if it is undecided", &narrow, &plain, "/frames/0/verdict", json!("undecided")),
        Claim("`frames[].doubt` | text | *if the frame is undecided:*", &stands, &plain, "/frames/0/doubt", None),
        Claim("only if `false`", &stands, &plain, "/frames/0/total_force_least", None),
        Claim("`notes` | objects | *if there are notes", &stands, &plain, "/notes", None),
        there("title of the scene; empty if the scene has none", &stands, &plain, "/scene", json!("")),
        Claim("from the command line", &stands, &plain, "/file", None),
    ]);
}

#[test]
fn effects_and_methods_have_the_names_on_the_page() {
    let page = words_of("src/doc/result.md");
    let stands = on_floor(0.7, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 1.0)]);
    let result = result(&stands, &Options::default());
    let effects = result["frames"][0]["effects"].as_array().expect("effects");
    let named: Vec<String> = effects.iter().map(|e| format!("`{}`", e["effect"].as_str().unwrap_or(""))).collect();
    let (last, first) = named.split_last().expect("some");
    assert!(page.contains(&format!("{} or {last}", first.join(", "))), "{named:?}");
    // An effect that is not simulated states the number of unknowns that it would add.
    let sticking = effects.iter().find(|e| e["effect"] == EffectName::Sticking.word()).expect("there");
    assert_eq!((&sticking["simulated"], sticking["unknowns"].as_u64() > Some(0)), (&json!(false), true));
    for method in [
        Method::ClosedForm,
        Method::LeastForce,
        Method::LeastForceRefined,
        Method::LeastResidual,
        Method::LeastSticking,
    ] {
        assert!(page.contains(&format!("`{method}`")), "{method}");
    }
}
