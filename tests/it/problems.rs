//! Every kind of error in a scene, and its message.
//!
//! `tests/reference/problems.txt` contains the cases: each has a title, a scene, and all messages for this scene.
//! `UPDATE_SNAPSHOTS=1` replaces the messages by the present ones.

use drystone::scene::{Code, Scene, SceneError, starter};
use serde_json::{Value, json};

const REFERENCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/problems.txt");

struct Case {
    title: String,
    scene: String,
    messages: String,
}

fn cases() -> Vec<Case> {
    let text = std::fs::read_to_string(REFERENCE).expect("the cases are there");
    let parts = text.split("\n## ").map(|part| part.trim_start_matches("## "));
    parts
        .map(|part| {
            let (title, rest) = part.split_once('\n').expect("a title");
            let (scene, messages) = rest.split_once("\n--\n").expect("a scene and its messages");
            Case { title: title.into(), scene: scene.into(), messages: messages.trim().into() }
        })
        .collect()
}

fn refused(text: &str) -> SceneError {
    let problems = Scene::from_json(text).expect_err("refused");
    assert!(!problems.list.is_empty());
    for problem in &problems.list {
        assert!(!problem.message.is_empty() && !problem.help.is_empty(), "{problem}");
        assert!(problem.line >= 1 && problem.column >= 1, "{problem}");
        let span = problem.span.clone().expect("a text has spans");
        let read = problems.text.as_deref().expect("the text is kept");
        assert!(read.get(span).is_some(), "the span of {problem} does not lie in the text");
    }
    problems
}

#[test]
fn every_case_has_its_agreed_messages() {
    let cases = cases();
    assert!(cases.len() > 50);
    let mut updated = String::new();
    let mut wrong = Vec::new();
    for case in &cases {
        let found = refused(&case.scene).to_string();
        if found != case.messages {
            wrong.push(format!("{}:\n{}\n  instead of\n{}", case.title, found, case.messages));
        }
        updated.push_str(&format!("## {}\n{}\n--\n{found}\n\n", case.title, case.scene));
    }
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(REFERENCE, updated).expect("the cases can be written");
        return;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_code_of_a_problem_occurs() {
    let mut missing: Vec<Code> = Code::ALL.to_vec();
    for case in cases() {
        let found = refused(&case.scene);
        missing.retain(|code| !found.list.iter().any(|p| p.code == *code));
    }
    // Errors that cannot occur in a case: numbers that only code can contain, invalid bytes, internal faults, errors
    // of the command line (tests/it/program/check.rs), and scenes that are too large for a case.
    let elsewhere = [
        Code::NotReadable,
        Code::InternalFault,
        Code::NoSuchFrame,
        Code::NotUtf8,
        Code::NotFinite,
        Code::TooManyCorners,
        Code::TooManyPairs,
        Code::TooManySteps,
        Code::TooManyTips,
        Code::MoreProblems,
    ];
    assert_eq!(missing, elsewhere);
    let only = |problems: SceneError| problems.list[0].code;
    assert_eq!(only(Scene::from_slice(b"\xE9").expect_err("refused")), Code::NotUtf8);
    let infinite = Scene::builder().kernel(f64::INFINITY);
    assert_eq!(only(infinite.build().expect_err("refused")), Code::NotFinite);
    let block = r#"{ "polygon": [[0, 0], [1, 0], [0, 1]] }"#;
    let text = format!(r#"{{ "drystone": 1, "blocks": [{}] }}"#, vec![block; 1000].join(","));
    assert!(refused(&text).list.iter().any(|p| p.code == Code::MoreProblems));
    let only_too_many = |text: &str, code: Code| {
        let found = refused(text).list;
        assert!(found.len() == 1 && found[0].code == code, "{found:?}");
    };
    // More than 50 000 frames of one block.
    let text = format!(r#"{{ "drystone": 1, "blocks": [{block}], "steps": [{{}}{}] }}"#, ",{}".repeat(50_000));
    only_too_many(&text, Code::TooManySteps);
    // A shape of 8 000 corners in 700 bodies.
    let corners: Vec<String> = (0..8000)
        .map(|k| {
            let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::TAU / 8000.0);
            format!("[{}, {}]", 100.0 * cos, 100.0 * sin)
        })
        .collect();
    let text = format!(
        r#"{{ "drystone": 1, "shapes": {{ "round": {{ "polygon": [{}] }} }}, "blocks": [{}] }}"#,
        corners.join(","),
        vec![r#"{ "shape": "round" }"#; 700].join(",")
    );
    assert!(refused(&text).list.iter().any(|problem| problem.code == Code::TooManyCorners));
    // 4000 blocks in 2001 frames.
    let text = format!(
        r#"{{ "drystone": 1, "blocks": [{}], "steps": [{{ "place": [{}] }}{}] }}"#,
        (0..4000)
            .map(|i| format!(r#"{{ "polygon": [[{i}, 0], [{i}.5, 0], [{i}, 1]] }}"#))
            .collect::<Vec<_>>()
            .join(","),
        (1..=4000).map(|i| format!("\"{i}\"")).collect::<Vec<_>>().join(","),
        ",{}".repeat(2000),
    );
    assert!(refused(&text).list.iter().any(|p| p.code == Code::TooManySteps));
}

const SMALL: &str = r##"{ "drystone": 1, "title": "é", "grid": { "kind": "triangular", "side": 1e0 },
  "materials": { "oak": { "density": 700, "fill": "#863" } },
  "ground": [{ "shape": "down" }], "blocks": [{ "id": "a\n", "shape": "hexagon", "at": [0, 1], "material": "oak" }],
  "robots": [{ "holds": "a\n", "limits": { "force": 5 } }], "corner_contacts": false, "title2": null }"##;

#[test]
fn a_truncated_file_is_refused_wherever_it_ends() {
    let whole = SMALL.replace(", \"title2\": null", "");
    Scene::from_json(&whole).expect("the whole file is sound");
    for end in 0..whole.len() {
        let problems = Scene::from_slice(&whole.as_bytes()[..end]).expect_err("refused");
        assert_eq!(problems.list.len(), 1, "{end}: {problems}");
    }
}

#[test]
fn a_file_with_one_byte_changed_never_panics() {
    for end in 0..SMALL.len() {
        for byte in [b'"', b'[', b'}', b',', b'0', b'-', b' ', 0xFF, 0] {
            let mut bytes = SMALL.as_bytes().to_vec();
            bytes[end] = byte;
            if let Err(problems) = Scene::from_slice(&bytes) {
                assert!(!problems.list.is_empty());
                assert!(!problems.to_string().contains("schema"), "{end} {byte}: {problems}");
            }
        }
    }
}

/// All scenes in which one value is replaced by `other`.
fn with_one_replaced(value: &Value, other: &Value) -> Vec<Value> {
    let mut all = vec![other.clone()];
    match value {
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                all.extend(with_one_replaced(item, other).into_iter().map(|inner| {
                    let mut items = items.clone();
                    items[i] = inner;
                    Value::Array(items)
                }));
            }
        }
        Value::Object(entries) => {
            for (key, entry) in entries {
                all.extend(with_one_replaced(entry, other).into_iter().map(|inner| {
                    let mut entries = entries.clone();
                    entries.insert(key.clone(), inner);
                    Value::Object(entries)
                }));
            }
        }
        _ => {}
    }
    all
}

#[test]
fn a_file_with_one_value_replaced_never_panics_and_has_a_precise_message() {
    let sources = [
        starter().to_string(),
        SMALL.replace(", \"title2\": null", ""),
        r##"{ "drystone": 1, "grid": { "kind": "square" }, "blocks": [{ "cells": [[0, 0]], "angle": 90, "fill": "#abc" }],
            "loads": [{ "block": "1", "force": [1, 2], "torque": 3 }], "friction_pairs": [] }"##
            .to_string(),
    ];
    for source in sources {
        let whole: Value = serde_json::from_str(&source).expect("JSON");
        for other in [json!(null), json!(true), json!(-1), json!(1e300), json!(0.5), json!("x"), json!([]), json!({})] {
            for scene in with_one_replaced(&whole, &other) {
                let text = scene.to_string();
                if let Err(problems) = Scene::from_json(&text) {
                    assert!(!problems.list.is_empty());
                    assert!(!problems.to_string().contains("drystone schema"), "{text}\n{problems}");
                }
            }
        }
    }
}

#[test]
fn very_deep_nesting_is_refused() {
    for opened in ["[", "{\"a\":", "{\"drystone\":1,\"blocks\":[{\"x\":"] {
        let problems = refused(&opened.repeat(100_000));
        assert_eq!(problems.list.len(), 1);
        assert!(problems.list[0].message.contains("more than 127 brackets"), "{problems}");
    }
}

#[test]
fn bytes_that_are_not_text_are_refused_with_their_position() {
    let problems = Scene::from_slice(b"{ \"drystone\": 1,\n  \"title\": \"caf\xE9\" }").expect_err("refused");
    assert_eq!(
        problems.to_string(),
        "line 2, column 16: the byte 0xE9 is not UTF-8 text\n  help: save the file in the encoding UTF-8"
    );
    let utf16: Vec<u8> = [0xFF, 0xFE].into_iter().chain("{ }".encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let problems = Scene::from_slice(&utf16).expect_err("refused");
    assert!(problems.to_string().contains("UTF-16"), "{problems}");
}

#[test]
fn a_byte_order_mark_is_not_part_of_the_text() {
    let marked = format!("\u{feff}{}", r#"{ "drystone": 1, "blocks": [] }"#);
    assert!(Scene::from_slice(marked.as_bytes()).is_ok());
    assert!(Scene::from_json(&marked).is_ok());
    let problems = Scene::from_slice("\u{feff}{ \"drystone\": 2, \"blocks\": [] }".as_bytes()).expect_err("refused");
    assert_eq!((problems.list[0].line, problems.list[0].column), (1, 15));
}

#[test]
fn a_scene_made_in_code_has_paths_but_no_lines() {
    let problems = Scene::builder()
        .block([[0.0, 0.0], [f64::NAN, 0.0], [0.0, 1.0]])
        .kernel(f64::INFINITY)
        .build()
        .expect_err("refused");
    assert_eq!(
        problems.to_string(),
        "kernel: the number is inf\n  help: give a finite number\n\
         blocks[0].polygon[1]: the number is NaN\n  help: give a finite number"
    );
    assert!(problems.text.is_none() && problems.list.iter().all(|p| p.span.is_none() && p.line == 0));
}

#[test]
fn a_problem_points_at_the_text_that_it_describes() {
    let text = "{ \"drystone\": 1, \"krenel\": 0.5,\n  \"blocks\": [ { \"id\": \"a\",\n    \"weight\": -2 } ] }";
    let problems = refused(text);
    let pointed: Vec<&str> = problems.list.iter().map(|p| &text[p.span.clone().expect("span")]).collect();
    assert_eq!(pointed, ["\"krenel\"", "{ \"id\": \"a\",", "-2"]);
}

#[test]
fn a_thousand_blocks_in_one_place_are_refused_quickly_with_a_message() {
    let block = r#"{ "polygon": [[0, 0], [1, 0], [0, 1]] }"#;
    let text = format!("{{ \"drystone\": 1, \"blocks\": [{}] }}", vec![block; 1000].join(","));
    let problems = refused(&text);
    assert_eq!(problems.list.len(), 1001);
    assert!(problems.to_string().contains("more overlaps than the 1000 in this list"));
    let lattice = text.replace(r#""polygon": [[0, 0], [1, 0], [0, 1]]"#, r#""shape": "up""#);
    let lattice = lattice.replacen('{', r#"{ "grid": { "kind": "triangular" },"#, 1);
    assert_eq!(refused(&lattice).list.len(), 1001);
}
