//! The questions about a scene, on random scenes: each answer is compared with exact programs for the other scenes that its
//! page names, such as the scene without a block. What moves and where blocks are placed is compared in `movement.rs` and
//! `placement.rs`, and orders of building with a search over all states in `plan.rs`.
//!
//! `DRYSTONE_QUESTIONS=1000` sets the number of scenes, and `DRYSTONE_ORACLE_FIRST` the number of the first.

use std::collections::BTreeMap;

use drystone::analysis::{Options, Verdict};
use drystone::{Analysis, Scene};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::balance::Balance;
use super::{number_of, random, touch};

/// Positions of a vehicle are compared up to this number.
const MAX_POSITIONS: usize = 4;

/// Whether all these scenes stand by exact programs. `None` if one is not a sound scene; or if the answer is another, and a
/// tolerance decides one of them.
fn stand(files: &[Value], answer: bool) -> Option<bool> {
    let mut all = true;
    let mut is_clear = true;
    for file in files {
        let scene = Scene::from_json(&file.to_string()).ok().filter(|scene| scene.penetrations().is_empty())?;
        let touches = touch::touches(&scene);
        let found = Analysis::with(&scene, &Options::default().verdict_only(true));
        if touches.len() != found.frames[0].contacts.len() {
            return None;
        }
        let groups = Balance::groups(&scene, &touches);
        let stands = groups.iter().all(Balance::stands);
        all &= stands;
        is_clear &= stands == answer || !groups.iter().any(Balance::is_borderline);
    }
    (all == answer || is_clear).then_some(all)
}

fn list<'v>(file: &'v mut Value, key: &str) -> &'v mut Vec<Value> {
    file[key].as_array_mut().expect("a list")
}

/// The scene without a block, its loads and its robot.
fn without(file: &Value, block: &str) -> Value {
    let mut rest = file.clone();
    list(&mut rest, "blocks").retain(|own| own["id"] != block);
    list(&mut rest, "loads").retain(|load| load["block"] != block);
    list(&mut rest, "robots").retain(|robot| robot["holds"] != block);
    rest
}

/// The scene with all weights and all loads times their factors.
fn factored(file: &Value, weights: f64, loads: f64) -> Value {
    let mut file = file.clone();
    for block in list(&mut file, "blocks") {
        block["weight"] = json!(block["weight"].as_f64().expect("a weight") * weights);
    }
    let times = |value: &Value| value.as_f64().map(|value| json!(value * loads));
    for load in list(&mut file, "loads") {
        load["force"] = load["force"].as_array().into_iter().flatten().filter_map(times).collect();
        if let Some(torque) = times(&load["torque"]) {
            load["torque"] = torque;
        }
    }
    file
}

fn with_load(file: &Value, block: &str, at: [f64; 2], force: [f64; 2]) -> Value {
    let mut file = file.clone();
    list(&mut file, "loads").push(json!({ "block": block, "at": at, "force": force }));
    file
}

/// Compares one scene. Adds to the counts of each question how often an answer was compared, and returns what differs.
fn compared(number: u64) -> (BTreeMap<&'static str, usize>, Vec<String>) {
    let (mut counts, mut wrong) = (BTreeMap::new(), Vec::new());
    let mut compare = |question: &'static str, what: &str, answer: bool, files: &[Value]| {
        let exact = stand(files, answer);
        *counts.entry(question).or_insert(0) += usize::from(exact.is_some());
        if exact.is_some_and(|exact| exact != answer) {
            wrong.push(format!("scene {number}, {question} {what}: {answer}"));
        }
    };
    let (kind, file) = random::scene(number);
    let has_weights = file["blocks"].as_array().into_iter().flatten().all(|block| block["weight"].is_f64());
    let Ok(scene) = Scene::from_json(&file.to_string()) else { return (counts, wrong) };
    if !random::KINDS[kind].1 || scene.blocks().len() > 6 || !scene.penetrations().is_empty() {
        return (counts, wrong);
    }
    let blocks = scene.blocks().to_vec();
    let id = |block: usize| blocks[block].id.as_str();
    let frame = |file: &Value, options: &Options| {
        let scene = Scene::from_json(&file.to_string()).expect("a sound scene");
        Analysis::with(&scene, options).frames.remove(0)
    };
    let is_decided = |verdict: Verdict| verdict != Verdict::Undecided;
    let alone = frame(&file, &Options::default().removable(true));
    for row in alone.removable.iter().flatten().filter(|row| is_decided(row.rest)) {
        let rest = without(&file, id(row.block.0));
        compare("removable", id(row.block.0), row.rest == Verdict::Stable, &[rest]);
    }
    let has_gravity = file.get("gravity").is_some();
    if has_weights && !file["loads"].as_array().is_none_or(Vec::is_empty) {
        // Two load cases: the verdict is that of the worse one.
        let factors = [(0.75, 1.5), (1.25, -0.5)];
        let mut cased = file.clone();
        for (k, load) in list(&mut cased, "loads").iter_mut().enumerate() {
            load["id"] = json!(format!("l{k}"));
        }
        let count = list(&mut cased, "loads").len();
        let case = |(k, (weights, loads)): (usize, (f64, f64))| {
            let loads: serde_json::Map<String, Value> = (0..count).map(|k| (format!("l{k}"), json!(loads))).collect();
            json!({ "id": format!("case {k}"), "weights": weights, "loads": loads })
        };
        cased["cases"] = factors.into_iter().enumerate().map(case).collect();
        let found = frame(&cased, &Options::default());
        if is_decided(found.verdict) {
            let both = factors.map(|(weights, loads)| factored(&file, weights, loads));
            compare("cases", "", found.verdict == Verdict::Stable, &both);
        }
    }
    if has_weights && !has_gravity {
        let mut crossed = file.clone();
        crossed["vehicle"] = json!({ "axles": [{ "weight": 2.5 }, { "weight": 1.5, "offset": 0.75 }] });
        if Scene::from_json(&crossed.to_string()).is_ok() {
            let found = frame(&crossed, &Options::default());
            let loaded = |position: &drystone::analysis::VehiclePosition| {
                let mut file = file.clone();
                for (axle, block, at) in &position.axles {
                    file = with_load(&file, id(block.0), [at.x, at.y], [0.0, -[2.5, 1.5][*axle]]);
                }
                [file]
            };
            let positions = found.vehicle.iter().flat_map(|line| &line.positions).collect::<Vec<_>>();
            let step = positions.len().div_ceil(MAX_POSITIONS).max(1);
            if found.verdict == Verdict::Stable {
                for position in positions.iter().step_by(step) {
                    compare("vehicle", "at a position", true, &loaded(position));
                }
            } else if let Some(at) = found.under_vehicle.and_then(|under| under.position) {
                compare("vehicle", "at the governing position", false, &loaded(positions[at]));
            }
        }
    }
    (counts, wrong)
}

#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn answers_to_questions_about_random_scenes_are_those_of_exact_programs() {
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let wanted = number_of("DRYSTONE_QUESTIONS", 120);
    let found: Vec<_> = (first..first + wanted).into_par_iter().map(compared).collect();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    found.iter().flat_map(|(own, _)| own).for_each(|(question, count)| *counts.entry(*question).or_default() += count);
    println!("{counts:?}");
    let wrong: Vec<&str> = found.iter().flat_map(|(_, wrong)| wrong).map(String::as_str).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let asked = ["removable", "cases", "vehicle"];
    let is_asked = |question: &str| counts.get(question).is_some_and(|count| *count as u64 * 30 > wanted);
    assert!(wanted < 120 || asked.into_iter().all(is_asked), "{counts:?}");
}
