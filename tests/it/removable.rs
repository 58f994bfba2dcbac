//! Which blocks may leave: sums by hand, and verdicts on the rest and under forces in all directions.

use std::process::Command;

use drystone::analysis::{Options, Removable, Verdict};
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::{arch, block, on_floor, rectangle, scene};

fn rows(file: &Value) -> Vec<Removable> {
    let mut analysis = Analysis::with(scene(file), &Options::default().removable(true));
    let last = analysis.frames.pop().expect("a frame");
    assert!(last.notices.iter().all(|notice| !notice.contains("removable")), "{:?}", last.notices);
    last.removable.clone().expect("it was requested")
}

/// Compares the least help for a block with a value, in newtons; `None` if the rest stands or if nothing helps.
#[track_caller]
fn compare(row: &Removable, rest: Verdict, force: Option<f64>, help: Option<(usize, f64)>) {
    assert_eq!(row.rest, rest, "{row:?}");
    let near = |found: f64, expected: f64| (found - expected).abs() <= 1e-5 * (1.0 + expected);
    assert!(row.force.is_some() == force.is_some() && row.force.zip(force).is_none_or(|(a, b)| near(a, b)), "{row:?}");
    match (row.help, help) {
        (Some(found), Some((block, force))) => assert!(found.block.0 == block && near(found.force, force), "{row:?}"),
        (found, expected) => assert!(found.is_none() && expected.is_none(), "{row:?}"),
    }
}

/// Two posts of 3 N with a lintel of 6 N.
fn trilith() -> Value {
    on_floor(
        0.7,
        vec![
            block("left", rectangle(0.0, 0.0, 1.0, 3.0), 3.0),
            block("right", rectangle(4.0, 0.0, 1.0, 3.0), 3.0),
            block("lintel", rectangle(0.0, 3.0, 5.0, 1.0), 6.0),
        ],
    )
}

#[test]
fn a_lintel_may_leave_and_is_held_by_its_weight_if_a_post_leaves() {
    let rows = rows(&trilith());
    compare(&rows[0], Verdict::Unstable, Some(0.0), Some((2, 6.0)));
    compare(&rows[1], Verdict::Unstable, Some(0.0), Some((2, 6.0)));
    compare(&rows[2], Verdict::Stable, Some(0.0), None);
}

#[test]
fn an_overhanging_brick_is_held_by_its_weight() {
    // Brick b overhangs brick a by 2 of 3 m. A push on a does not hold it.
    let bricks = vec![block("a", rectangle(0.0, 0.0, 3.0, 1.0), 3.0), block("b", rectangle(2.0, 1.0, 3.0, 1.0), 3.0)];
    let mut file = on_floor(0.5, bricks);
    let found = rows(&file);
    compare(&found[0], Verdict::Unstable, None, Some((1, 3.0)));
    compare(&found[1], Verdict::Stable, Some(3.0), None);
    // A robot that holds b exerts at least this force; it also holds b without a.
    file["robots"] = json!([{ "id": "r", "holds": "b" }]);
    let held = rows(&file);
    compare(&held[0], Verdict::Stable, Some(0.0), None);
    compare(&held[1], Verdict::Stable, Some(3.0), None);
}

#[test]
fn the_least_help_is_the_least_over_all_directions_and_blocks() {
    let file = arch(7, 0.2, 0.7);
    let found = rows(&file);
    assert!(found.iter().all(|row| row.rest == Verdict::Unstable && row.force == Some(0.0)), "{found:?}");
    let mut helped = 0;
    for row in &found {
        let mut rest = file.clone();
        rest["blocks"].as_array_mut().expect("blocks").remove(row.block.0);
        // A force on each other block in 120 directions: just below the least force nothing stands, just above it the
        // named block does.
        let stands = |block: &str, force: f64| {
            let whole = scene(&file);
            let at = whole.blocks()[whole.block_named(block).expect("a block").0].centroid;
            (0..120).any(|k| {
                let angle = std::f64::consts::PI * f64::from(k) / 60.0;
                let mut pushed = rest.clone();
                pushed["loads"] = json!([{ "block": block, "at": [at.x, at.y],
                    "force": [force * libm::cos(angle), force * libm::sin(angle)] }]);
                Analysis::new(scene(&pushed)).frames[0].verdict == Verdict::Stable
            })
        };
        let names = (0..7).filter(|k| *k != row.block.0).map(|k| format!("v{k}"));
        match row.help {
            Some(help) => {
                helped += 1;
                assert!(stands(&format!("v{}", help.block.0), 1.01 * help.force), "{row:?}");
                assert!(!names.into_iter().any(|name| stands(&name, 0.99 * help.force)), "{row:?}");
            }
            None => assert!(!names.into_iter().any(|name| [1e2, 1e3, 1e4, 1e5].iter().any(|f| stands(&name, *f)))),
        }
    }
    assert!(helped >= 2, "{found:?}");
}

#[test]
fn the_verdict_on_the_rest_is_that_of_the_scene_without_the_block() {
    let mut random = Random::new(49);
    for _ in 0..12 {
        let mut blocks = Vec::new();
        for row in 0..3 {
            let mut x = random.between(0.0, 1.0);
            for column in 0..3 {
                let width = random.between(0.5, 1.6);
                blocks.push(block(&format!("{row}{column}"), rectangle(x, f64::from(row), width, 1.0), width));
                x += width + random.between(0.0, 0.6);
            }
        }
        let file = on_floor(0.6, blocks);
        for row in rows(&file) {
            let mut rest = file.clone();
            rest["blocks"].as_array_mut().expect("blocks").remove(row.block.0);
            assert_eq!(row.rest, Analysis::new(scene(&rest)).frames[0].verdict, "{row:?} of {file}");
        }
    }
}

#[test]
fn json_table_report_and_figure_say_which_blocks_may_leave() {
    let file = trilith();
    let analysis = Analysis::with(scene(&file), &Options::default().removable(true));
    let json: Value = serde_json::from_str(&to_json(&analysis, Timing::LeftOut, Layout::OneLine)).expect("JSON");
    let written = &json["frames"][0]["removable"];
    assert_eq!(written[2], json!({ "block": "lintel", "stands": true, "force": 0.0 }), "{written}");
    assert_eq!(written[0]["help"]["block"], "lintel");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("trilith.json");
    std::fs::write(&path, file.to_string()).expect("written");
    let run = |options: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_drystone")).args(options).arg(&path).output().expect("it runs");
        String::from_utf8_lossy(&output.stdout).replace('\u{a0}', " ")
    };
    let table = run(&["check", "--removable"]);
    let words = "1 of 3 blocks may leave alone: lintel; 2 blocks may leave while a robot holds another one";
    assert!(table.contains(words), "{table}");
    assert!(run(&["check", "--removable", "--json"]).contains("\"removable\""));
    for (what, name) in [("report", "out.md"), ("render", "out.svg")] {
        let output = folder.path().join(name);
        let kind: &[&str] = if what == "render" { &["--kind", "structure", "--removable"] } else { &["--removable"] };
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let status = command.arg(what).arg(&path).args(kind).arg("-o").arg(&output).status().expect("it runs");
        let text = std::fs::read_to_string(&output).expect("written").replace('\u{a0}', " ");
        let words = match what {
            "render" => ["may leave while a robot holds another", "Block lintel: may leave"],
            _ => ["1 of 3 blocks may leave alone", "| lintel | yes |"],
        };
        assert!(status.success() && words.iter().all(|words| text.contains(words)), "{name}: {text}");
    }
    // Figures that need the rows compute them.
    let scene = Scene::from_json(&file.to_string()).expect("a scene");
    assert!(Analysis::new(&scene).frames[0].removable.is_none());
}

#[test]
fn the_torque_of_a_robot_does_not_count_as_standing_without_it() {
    // The centre is 0.5 m outside the ground. A torque of 50 N m holds the block; a force at its centre must be 100 N.
    let mut file = on_floor(0.6, vec![block("a", rectangle(1.0, 0.0, 3.0, 1.0), 100.0)]);
    file["ground"] = json!([{ "polygon": rectangle(0.0, -1.0, 2.0, 1.0) }]);
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "force": 20, "torque": 60 } }]);
    let force = rows(&file)[0].force.expect("a force");
    assert!((force - 100.0).abs() < 1e-5, "{force}");
}
