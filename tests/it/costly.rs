//! Small files that would be expensive: their cost is counted, and if it is too large they are refused.

use std::fs;
use std::process::Command;
use std::sync::Arc;

use drystone::analysis::{FrameAnalysis, MarginKinds, Options};
use drystone::certificate::Certificate;
use drystone::result::{Layout, Timing, to_json};
use drystone::scene::{Code, Scene};
use drystone::{Analysis, figure, output};
use serde_json::{Value, json};

use crate::structure::{block, on_floor, rectangle};

/// `count` wedges that fill a half-circle around the origin, tips together, on flat ground.
fn fan(count: usize) -> Value {
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * k as f64 / count as f64);
        [3.0 * cos, 3.0 * sin]
    };
    let wedge = |k: usize| json!({ "polygon": [[0, 0], corner(k), corner(k + 1)], "weight": 1 });
    json!({ "drystone": 1, "friction": 0.6, "corner_contacts": true,
        "ground": [{ "polygon": [[-10, -1], [10, -1], [10, 0], [-10, 0]] }],
        "blocks": (0..count).map(wedge).collect::<Vec<_>>() })
}

#[test]
fn corner_contacts_of_too_many_blocks_at_one_point_are_refused() {
    let refused = Scene::from_json(&fan(400).to_string()).expect_err("refused");
    assert_eq!(refused.list[0].code, Code::TooManyTips);
    let words = refused.to_string();
    assert!(words.contains("corners of 400 bodies meet at (0, 0)"), "{words}");
    // 400 · 399 / 2.
    assert!(words.contains("79800 corner contacts"), "{words}");
    assert!(words.contains("remove `corner_contacts`"), "{words}");
    // Without corner contacts, or with fewer blocks placed at a time, they are accepted.
    let mut without = fan(400);
    without["corner_contacts"] = false.into();
    assert!(Scene::from_json(&without.to_string()).is_ok());
    assert!(Scene::from_json(&fan(100).to_string()).is_ok());
    let mut in_turn = fan(120);
    in_turn["steps"] = json!([
        { "place": (1..=60).map(|k| k.to_string()).collect::<Vec<_>>() },
        { "remove": (1..=60).map(|k| k.to_string()).collect::<Vec<_>>(),
          "place": (61..=120).map(|k| k.to_string()).collect::<Vec<_>>() }
    ]);
    assert!(Scene::from_json(&in_turn.to_string()).is_ok());
}

#[test]
fn a_figure_of_many_loads_names_the_largest() {
    let mut file = on_floor(0.6, vec![block("a", rectangle(0.0, 0.0, 10.0, 10.0), 100.0)]);
    let load = |k: u32| {
        let at = [0.1 + f64::from(k % 50) * 0.19, 0.1 + f64::from(k / 50) * 0.19];
        json!({ "block": "a", "at": at, "force": [0, -1.0 - f64::from(k)] })
    };
    let mut amounts = |count: u32| {
        file["loads"] = (0..count).map(load).collect();
        let scene = Scene::from_json(&file.to_string()).expect("sound");
        let drawing = figure::forces(&Analysis::new(&scene), &figure::Options::default());
        let svg = output::svg::write(&drawing);
        let named = svg.matches("class=\"amount\"").count();
        (named, svg.contains("amounts only at the largest"))
    };
    let (named, is_said) = amounts(10);
    // Stubs of ten loads at one place leave room for half of their amounts.
    assert!(named >= 6 && !is_said, "{named}");
    // The 16 largest, or fewer if there is no room, and the largest contact force.
    let (named, is_said) = amounts(1000);
    assert!(is_said && (3..=18).contains(&named), "{named}");
}

/// Steps that change nothing, or that return to an earlier state, share the results of an earlier frame. Each has the
/// results that it has if no frames are shared: in a scene with only the frames up to the second in its state.
#[test]
fn frames_in_the_same_state_share_their_results() {
    let mut file = on_floor(0.6, vec![block("a", rectangle(0.0, 0.0, 2.0, 1.0), 1.0)]);
    file["blocks"].as_array_mut().expect("a list").push(block("b", rectangle(1.5, 1.0, 2.0, 1.0), 1.0));
    file["robots"] = json!([{ "id": "r" }]);
    let on = json!({ "place": ["b"], "hold": { "r": "b" } });
    let steps = [json!({ "place": ["a"] }), on.clone(), json!({ "title": "still" }), json!({ "release": ["r"] })];
    let again = [json!({ "remove": ["b"] }), on, json!({ "release": ["r"], "remove": ["b"] }), json!({})];
    file["steps"] = steps.iter().chain(&again).chain(&again[1..]).cloned().collect();
    let options = Options::default().margins(MarginKinds::ALL).removable(true).placement(true);
    let one_case = json!([{ "id": "c", "loads": {} }]);
    for cases in [json!([]), one_case] {
        file["cases"] = cases;
        let scene = Scene::from_json(&file.to_string()).expect("sound");
        let mut analysis = Analysis::with(&scene, &options);
        let shared = |frames: &[Arc<FrameAnalysis>]| {
            let first = |k| frames.iter().position(|frame| Arc::ptr_eq(frame, k)).expect("itself");
            assert_eq!(frames.iter().map(first).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 2, 4, 4, 2, 4, 4]);
        };
        // They share what is added later too: motions for drawing, and what is proved exactly. A certificate has them all.
        shared(&analysis.frames);
        shared(&analysis.elementary().frames);
        let certificate = Certificate::new(&mut analysis, String::new(), false);
        let frames = &analysis.frames;
        shared(frames);
        assert!(frames.iter().all(|frame| frame.exact == Some(true)));
        assert!(certificate.frames.iter().map(|frame| frame.frame).eq(1..=11));
        assert!(certificate.check().is_ok_and(|checked| checked.is_exact()));
        let verdicts: Vec<_> = frames.iter().map(|frame| frame.verdict.word()).collect();
        assert_eq!(verdicts[..5], ["stable", "stable", "stable", "unstable", "stable"]);
        assert!(frames[2].solve.reused == frames[2].solve.groups && frames[2].solve.programs == 0);
        let analysis = Analysis::new(&scene);
        let text = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
        assert_eq!(text.matches("\"title\":").count(), 11);
        assert_eq!(text.matches("\"title\":\"still\"").count(), 1);
    }
}

/// A table states no margin of blocks on many equal parts of the ground, or of very many loaded blocks.
#[test]
fn a_table_computes_no_costly_margin_unasked() {
    let margin_of = |ground: usize, height: usize| {
        let block = |k: usize| json!({ "id": format!("b{k}"), "cells": [[0, k]] });
        let scene = json!({ "drystone": 1, "density": 1, "grid": { "kind": "square" },
            "ground": vec![json!({ "cells": [[0, -1]] }); ground],
            "blocks": (0..height).map(block).collect::<Vec<_>>(),
            "loads": [{ "block": "b0", "force": [0.1, 0] }] });
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("scene.json"), scene.to_string()).expect("writable");
        let mut program = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let ran = program.args(["check", "scene.json"]).current_dir(folder.path()).output().expect("starts");
        let table = String::from_utf8_lossy(&ran.stdout).into_owned();
        let mut row = table.lines().nth(2).expect("a row").split_whitespace().map(str::to_owned);
        row.next_back().expect("a cell")
    };
    assert_ne!(margin_of(1, 3), "-");
    assert_ne!(margin_of(1, 141), "-");
    assert_eq!(margin_of(1, 1001), "-");
    assert_eq!(margin_of(1001, 3), "-");
}

#[test]
fn too_many_blocks_are_refused() {
    let blocks = r#"{},"#.repeat(250_000);
    let refused = Scene::from_json(&format!(r#"{{"drystone":1,"blocks":[{blocks}{{}}]}}"#)).expect_err("refused");
    assert_eq!(refused.list.len(), 1);
    assert!(refused.to_string().contains("there are 250001 blocks, and at most 250000 are allowed"), "{refused}");
}
