//! Randomly changed scenes: with huge, tiny and subnormal numbers, hostile ids, and steps that contradict each other.
//!
//! Every small scene of the assets is changed several times by a generator with a seed. The result must be either a
//! list of problems with messages and positions, or a scene with verdicts, finite numbers and figures that can be
//! parsed. It must never be a panic.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use drystone::analysis::{Accuracy, Analysis, CapacityRequest, MarginKind, MarginKinds, Options, Verdict};
use drystone::result::{Layout, Timing, to_json};
use drystone::{Scene, figure, output};
use serde_json::{Map, Value, json};

use crate::random::Random;
use crate::structure::{arch, block, on_floor, rectangle, tower, wall};

/// The number of mutants of each scene.
const EACH: u64 = 24;

const NUMBERS: &[f64] = &[
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-9,
    1e-29,
    1.1e-30,
    1e-60,
    1e9,
    -1e9,
    1e12,
    1.000_000_1e12,
    1e300,
    -1e300,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    1e-300,
    f64::EPSILON,
    0.1 + 0.2,
    360.0,
    1e15,
    9_007_199_254_740_993.0,
];

const WORDS: &[&str] = &[
    "",
    "ground",
    "a\nb",
    "\u{0}",
    "\u{1b}[2J",
    "\u{202e}x",
    "../../etc/passwd",
    "<script>",
    "&amp;",
    "=1+1",
    "constructor",
    "up",
    "hexagon",
    "ﷺ",
    "👩\u{200d}🔬",
];

/// The number of JSON values in a value, itself included.
fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(list) => list.iter().map(count).sum(),
        Value::Object(map) => map.values().map(count).sum(),
        _ => 0,
    }
}

/// The JSON value with this number, counted from 0 in the order of the file. `None` if there are fewer values.
fn at<'v>(value: &'v mut Value, number: &mut usize) -> Option<&'v mut Value> {
    if *number == 0 {
        return Some(value);
    }
    *number -= 1;
    match value {
        Value::Array(list) => list.iter_mut().find_map(|v| at(v, number)),
        Value::Object(map) => map.values_mut().find_map(|v| at(v, number)),
        _ => None,
    }
}

fn change(value: &mut Value, random: &mut Random) {
    match value {
        Value::Number(old) => {
            let old = old.as_f64().unwrap_or(0.0);
            *value = match random.below(8) {
                0..=3 => json!(random.choose(NUMBERS)),
                4 => json!(-old),
                // The next floating-point number: bodies that just touched no longer do.
                5 => json!(f64::from_bits(old.to_bits().wrapping_add(1))),
                6 => json!(old * 1e6),
                _ => json!(format!("{old}")),
            };
        }
        Value::String(_) => *value = json!(random.choose(WORDS)),
        Value::Bool(flag) => *flag = !*flag,
        Value::Null => *value = json!([]),
        Value::Array(list) => match random.below(4) {
            0 => list.clear(),
            1 => list.reverse(),
            _ if list.is_empty() => list.push(Value::Null),
            2 => {
                let again = random.choose(list).clone();
                list.push(again);
            }
            _ => {
                let gone = random.below(list.len());
                list.remove(gone);
            }
        },
        Value::Object(map) => {
            let keys: Vec<String> = map.keys().cloned().collect();
            if keys.is_empty() || random.below(6) == 0 {
                map.insert((*random.choose(WORDS)).to_owned(), json!(0));
            } else {
                let gone = random.choose(&keys).clone();
                map.remove(&gone);
            }
        }
    }
}

/// Replaces the steps by random ones that may place a block twice, remove held blocks, or hold a block that is not
/// placed.
fn contradict(scene: &mut Map<String, Value>, random: &mut Random) {
    let ids = |key: &str| -> Vec<String> {
        let list = scene.get(key).and_then(Value::as_array);
        let entries = list.into_iter().flatten();
        entries.filter_map(|e| e.get("id")?.as_str().map(str::to_owned)).collect()
    };
    let (blocks, robots) = (ids("blocks"), ids("robots"));
    if blocks.is_empty() {
        return;
    }
    let mut steps = Vec::new();
    for _ in 0..=random.below(4) {
        let mut hold = Map::new();
        for robot in &robots {
            hold.insert(robot.clone(), json!(random.choose(&blocks)));
        }
        steps.push(
            json!({ "place": [random.choose(&blocks), random.choose(&blocks)], "remove": [random.choose(&blocks)],
            "hold": hold, "release": robots.iter().take(random.below(3)).collect::<Vec<_>>() }),
        );
    }
    scene.insert("steps".into(), json!(steps));
}

fn mutant(original: &Value, seed: u64) -> Value {
    let mut random = Random::new(seed);
    let mut scene = original.clone();
    if random.below(6) == 0
        && let Some(map) = scene.as_object_mut()
    {
        contradict(map, &mut random);
    }
    for _ in 0..=random.below(4) {
        let mut number = random.below(count(&scene));
        if let Some(value) = at(&mut scene, &mut number) {
            change(value, &mut random);
        }
    }
    // Most mutants should pass the check of the format version.
    if let Some(map) = scene.as_object_mut() {
        map.insert("drystone".into(), json!(1));
    }
    scene
}

/// Whether a text is a valid scene. An error states what is wrong with the listed problems or with the results.
fn examine(text: &str) -> Result<bool, String> {
    let scene = match Scene::from_json(text) {
        Ok(scene) => scene,
        Err(problems) => {
            for problem in &problems.list {
                if problem.message.is_empty() || problem.message.contains('\n') {
                    return Err(format!("a problem without a message or with two lines: {problem:?}"));
                }
                let span = problem.span.clone().unwrap_or(0..0);
                if text.get(span.clone()).is_none() {
                    return Err(format!("the position of a problem is outside the text: {span:?}"));
                }
            }
            return if problems.list.is_empty() { Err("refused without a problem".into()) } else { Ok(false) };
        }
    };
    let analysis = Analysis::new(&scene);
    for frame in &analysis.frames {
        if frame.verdict == Verdict::Undecided && frame.doubt().is_empty() {
            return Err("undecided without a reason".into());
        }
    }
    let json = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
    let value: Value = serde_json::from_str(&json).map_err(|e| format!("no JSON: {e}"))?;
    if let Some(null) = value["frames"].as_array().into_iter().flatten().find(|f| f["total_force"].is_null()) {
        return Err(format!("a sum of forces that is no number: {null}"));
    }
    let drawing = figure::forces(&analysis, &figure::Options::default());
    let svg = output::svg::write(&drawing);
    roxmltree::Document::parse(&svg).map_err(|e| format!("no XML: {e}"))?;
    if svg.contains("NaN") || svg.contains("inf ") {
        return Err("a figure with a coordinate that is not a number".into());
    }
    Ok(true)
}

fn originals() -> Vec<(String, Value)> {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut scenes = Vec::new();
    for folder in ["thesis", "study"] {
        let mut paths: Vec<_> = fs::read_dir(assets.join(folder))
            .expect("readable")
            .map(|entry| entry.expect("readable").path())
            .filter(|path| path.extension().is_some_and(|e| e == "json"))
            .collect();
        paths.sort();
        for path in paths {
            let text = fs::read_to_string(&path).expect("readable");
            // Large scenes take longer and contain no other keys than small ones.
            if text.len() < 4_000 {
                let value = serde_json::from_str(&text).expect("JSON");
                scenes.push((path.display().to_string(), value));
            }
        }
    }
    scenes
}

#[test]
fn mutants_are_refused_with_messages_or_analysed() {
    let originals = originals();
    assert!(originals.len() > 10);
    let (mut sound, mut all) = (0, 0);
    for (name, original) in &originals {
        for number in 0..EACH {
            let end = name.bytes().rev().take(12);
            let named = end.fold(7_u64, |h, b| h.wrapping_mul(131).wrapping_add(b.into()));
            let seed = number ^ named;
            let text = mutant(original, seed).to_string();
            let outcome = catch_unwind(AssertUnwindSafe(|| examine(&text))).unwrap_or_else(|_| Err("a panic".into()));
            match outcome {
                Ok(passed) => sound += usize::from(passed),
                Err(why) => panic!("{name}, seed {seed}: {why}\n{text}"),
            }
            all += 1;
        }
    }
    assert!(
        sound * 10 > all && sound < all,
        "{sound} of {all} mutants are valid: too few or too many for a meaningful test"
    );
}

/// A mutant showed that weights or areas outside the range of f64 make numbers of the program infinite, or the weight
/// of a block 0.
#[test]
fn numbers_whose_products_overflow_or_vanish_are_refused() {
    let scene = |size: f64, weight: f64| {
        json!({ "drystone": 1, "ground": [{ "polygon": [[0, 0], [size, 0], [size, -size], [0, -size]] }],
            "blocks": [{ "id": "a", "polygon": [[0, 0], [size, 0], [size, size], [0, size]], "weight": weight }] })
        .to_string()
    };
    for (size, weight) in [(1e-31, 1.0), (1e-61, 1.0), (1e-160, 1.0), (1.0, 1e-61), (1.0, 5e-324)] {
        let refused = Scene::from_json(&scene(size, weight)).expect_err("too small");
        assert!(refused.to_string().contains("check the units"), "{refused}");
    }
    let least = json!({ "drystone": 1, "density": 1e-30, "thickness": 1e-30, "gravity": [0, -1e-30],
        "ground": [{ "polygon": [[0, 0], [9e-30, 0], [9e-30, -9e-30], [0, -9e-30]] }],
        "blocks": [{ "id": "a", "polygon": [[1e-30, 0], [2e-30, 0], [2e-30, 1e-30], [1e-30, 1e-30]] },
                   { "id": "b", "polygon": [[1.5e-30, 1e-30], [3e-30, 1e-30], [3e-30, 2e-30], [1.5e-30, 2e-30]] }] });
    let scene = Scene::from_json(&least.to_string()).expect("just large enough");
    assert!(scene.blocks().iter().all(|block| block.weight > 0.0));
    assert_eq!(Analysis::new(&scene).frames[0].verdict, Verdict::Unstable, "it overhangs by two thirds");
}

/// Every question has an answer, and no program of a question has a number that is not finite, with joints without length
/// (a kernel of 1), nearly without, without friction, and with more friction than any stone has.
#[test]
fn every_question_is_answered_at_the_ends_of_kernel_and_friction() {
    let crossed = |mut file: Value| {
        file["ground"][0]["id"] = json!("floor");
        file["movements"] = json!([{ "ground": "floor", "rotation": 0.1, "translation": [0.001, 0] }]);
        file["vehicle"] = json!({ "axles": [{ "weight": 5 }], "step": 2 });
        file["loads"] = json!([{ "block": file["blocks"][1]["id"], "force": [0.4, -1] }]);
        file
    };
    let single = on_floor(
        0.5,
        vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 9.81), block("b", rectangle(3.0, 0.0, 2.0, 1.0), 4.0)],
    );
    for file in [crossed(single), crossed(tower(3, 0.5)), crossed(wall(2, 3)), arch(5, 0.4, 0.7)] {
        for (kernel, friction) in
            [0.0, 0.999_999_999, 1.0 - f64::EPSILON, 1.0].iter().flat_map(|k| [0.0, 0.6, 1e6].map(|f| (*k, f)))
        {
            let mut file = file.clone();
            (file["kernel"], file["friction"]) = (json!(kernel), json!(friction));
            let blocks = file["blocks"].as_array().expect("a list").len();
            if blocks > 4 || blocks > 2 && friction != 0.6 {
                // The answers at all positions take most of the time.
                file.as_object_mut().expect("an object").remove("vehicle");
            }
            let scene = Scene::from_json(&file.to_string()).expect("a scene");
            let held = scene.block_named("1").or(scene.block_named("a")).or(scene.block_named("v1")).expect("a block");
            let all = Options::default().margins(MarginKinds::ALL).wedging(true).placement(true).removable(true);
            let all = all.sensitivity(MarginKind::Tilt).capacity(CapacityRequest::of_block(held));
            let strict = (friction == 0.6).then(|| all.accuracy(Accuracy::Proved));
            for options in [Some(all), strict].into_iter().flatten() {
                let analysis = Analysis::with(&scene, &options);
                let text = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
                assert!(serde_json::from_str::<Value>(&text).is_ok(), "kernel {kernel}, friction {friction}");
                for placement in analysis.frames.iter().filter_map(|frame| frame.placement.as_ref()) {
                    assert!(kernel < 1.0 || placement.proved == 0.0, "friction {friction}: {}", placement.proved);
                }
            }
        }
    }
}
