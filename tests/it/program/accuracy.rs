//! The command `accuracy`, the accuracy levels of `check`, and undecided verdicts.

use std::fs;

use serde_json::{Value, json};

use super::Bench;

/// A frictionless wedge in its notch, rotated by 30° so that no face is parallel to an axis.
fn wedge(half_angle: f64) -> String {
    let d = half_angle;
    let turned = |shape: &str| json!({ "shape": shape, "angle": 30 });
    let gravity = 30f64.to_radians();
    json!({ "drystone": 1, "friction": 0, "gravity": [libm::sin(gravity), -libm::cos(gravity)],
        "shapes": {
            "left": { "polygon": [[-3, 0], [-0.5, 0], [-0.5 - d, 1], [-3, 1]] },
            "right": { "polygon": [[0.5, 0], [3, 0], [3, 1], [0.5 + d, 1]] },
            "wedge": { "polygon": [[-0.5, 0], [0.5, 0], [0.5 + d, 1], [-0.5 - d, 1]] } },
        "ground": [turned("left"), turned("right")],
        "blocks": [{ "id": "wedge", "shape": "wedge", "angle": 30, "weight": 6 }] })
    .to_string()
}

#[test]
fn a_study_is_written_in_every_form() {
    let bench = Bench::new();
    let forms = ["html", "csv", "json", "svg", "md"];
    let outputs: Vec<String> = forms.iter().map(|form| format!("-o study.{form}")).collect();
    let line = format!("accuracy stands.json --tolerances 1e-4,1e-8 {}", outputs.join(" "));
    let ran = bench.run(&line);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{}", ran.err);
    let text = |form: &str| fs::read_to_string(bench.path(&format!("study.{form}"))).expect(form);
    assert!(text("html").starts_with("<!DOCTYPE html>"));
    assert!(text("svg").starts_with("<svg") && text("svg").contains("What accuracy costs"));
    assert!(text("csv").lines().count() > 4 && text("csv").contains("A lintel"));
    let study: Value = serde_json::from_str(&text("json")).expect("JSON");
    assert!(study.is_object());
    assert!(text("md").contains('|'));
    // An unknown output format is reported before anything is measured or written.
    let ran = bench.run("accuracy stands.json -o study.txt -o other.csv");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains(".html, .csv, .json, .svg or .md"), "{}", ran.err);
    assert!(!bench.path("other.csv").exists());
    assert_eq!(bench.run("accuracy stands.json -o no/such/folder.csv").code, 4);
}

#[test]
fn an_undecided_verdict_ends_with_three_and_states_the_reason() {
    let bench = Bench::new();
    // A thrust of 10⁹ weights is balanced to seven digits. This is enough for a verdict, but not for the level
    // `proved`, which needs nine digits.
    fs::write(bench.path("flat.json"), wedge(1e-9)).expect("writable");
    let ran = bench.run("check --accuracy proved flat.json");
    assert_eq!(ran.code, 3, "{}", ran.out);
    assert!(ran.out.contains("undecided"), "{}", ran.out);
    assert!(ran.out.contains("miss the balance of a block by"), "{}", ran.out);
    // A thrust of 10¹³ weights is balanced to three digits, which is not a proof. The wedge does not fall either.
    fs::write(bench.path("flatter.json"), wedge(1e-13)).expect("writable");
    let ran = bench.run("check flatter.json");
    assert_eq!(ran.code, 3, "{}", ran.out);
    assert!(ran.out.contains("undecided"), "{}", ran.out);
    assert_eq!(bench.run("check flatter.json stands.json").code, 3);
    assert_eq!(bench.run("check flatter.json falls.json").code, 1, "a fall has precedence over an undecided verdict");
    assert_eq!(bench.run("render flatter.json -o flatter.svg").code, 0);
    assert_eq!(bench.run("render flatter.json -o flatter.svg --strict").code, 3);
    let ran = bench.run("check --json flatter.json");
    let result: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(result["frames"][0]["verdict"], "undecided");
}

#[test]
fn at_the_level_exact_a_verdict_that_rests_on_a_tolerance_is_undecided_in_every_command() {
    let bench = Bench::new();
    // A stack of bricks with the largest overhang, in rounded coordinates: the forces balance to 10⁻¹¹ N, and not exactly.
    let stack = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/validation/stack-4.json");
    fs::copy(stack, bench.path("limit.json")).expect("copied");
    assert_eq!(bench.run("check limit.json").code, 0);
    for command in ["check", "check --json", "batch -o out.ndjson", "batch --fields=verdict -o few.ndjson"] {
        assert_eq!(bench.run(&format!("{command} --accuracy exact limit.json")).code, 3, "{command}");
    }
    for (command, code) in [("render limit.json -o limit.svg --strict", 3), ("report limit.json -o report.md", 0)] {
        assert_eq!(bench.run(&format!("{command} --accuracy exact")).code, code, "{command}");
    }
    for file in ["limit.svg", "report.md", "few.ndjson"] {
        let text = fs::read_to_string(bench.path(file)).expect("written");
        assert!(text.contains("undecided") && !text.contains(">stands<"), "{file}: {text}");
    }
    let ran = bench.run("check limit.json --accuracy exact --json");
    let result: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(
        (&result["frames"][0]["verdict"], &result["frames"][0]["proof"]["exact"]),
        (&"undecided".into(), &false.into())
    );
    let doubt = result["frames"][0]["doubt"].to_string();
    assert!(
        doubt.contains("it stands within the tolerances of --accuracy standard, but not in exact arithmetic"),
        "{doubt}"
    );
}

#[test]
fn every_level_gives_the_same_verdicts() {
    let bench = Bench::new();
    for level in ["standard", "proved", "exact"] {
        assert_eq!(bench.run(&format!("check --accuracy {level} stands.json")).code, 0, "{level}");
        assert_eq!(bench.run(&format!("check --accuracy {level} falls.json")).code, 1, "{level}");
    }
    let ran = bench.run("check --accuracy best stands.json");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("standard, proved, exact"), "{}", ran.err);
}

#[test]
fn an_unstable_frame_states_which_forces_its_motion_rules_out() {
    let bench = Bench::new();
    let ran = bench.run("check --json falls.json");
    let result: Value = serde_json::from_str(&ran.out).expect("JSON");
    let frames = result["frames"].as_array().expect("frames");
    assert_eq!(frames[0]["proof"]["no_balance_below"], "unbounded");
    assert!(frames[1]["proof"].get("no_balance_below").is_none());
    assert!(bench.run("check --verbose falls.json").out.contains("no balance at all"));
}
