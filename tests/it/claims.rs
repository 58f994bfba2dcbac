//! The statements of results and captions are compared with other known values: sums with the listed forces, used
//! fractions with forces and limits, motions with contacts, margins with verdicts. `claims/list.md` lists all
//! statements.
//!
//! These tests read the JSON that other programs read, and compute their geometry separately. So they also find a
//! number that is correct inside the program but written incorrectly.

mod balance;
mod beyond;
mod force;
mod healed;
mod interval;
mod margin;
mod motion;
mod solve;
mod wedging;
mod words;

use drystone::analysis::{Options, Verdict};
use drystone::result::key::{KEYS, REFUSAL_KEYS, Type, paths};
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, figure};
use serde_json::{Value, json};

use crate::oracle::random;
use crate::structure::{arch, harmonic, on_slope, scene, wall};

/// The statements, each with the tests that would notice that it is false.
const LIST: &str = include_str!("claims/list.md");

/// A scene file, its result in the JSON of `check --json`, and the unit of length L, m.
struct Checked {
    file: Value,
    json: Value,
    length: f64,
}

fn check_with(file: &Value, options: &Options) -> Checked {
    let scene = scene(file);
    let analysis = Analysis::with(&scene, options);
    let json = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
    let json: Value = serde_json::from_str(&json).expect("JSON");
    Checked { file: file.clone(), length: number(&json["frames"][0]["length"]), json }
}

fn check(file: &Value) -> Checked {
    check_with(file, &Options::default())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number: {value}"))
}

fn pair(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn less(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The results of structures that stand, slide or topple, are held by robots with limits or carry loads, and of
/// random scenes.
fn structures() -> Vec<Checked> {
    let mut files = vec![
        arch(11, 0.3, 0.7),
        arch(9, 0.05, 0.7),
        wall(4, 3),
        harmonic(5, 0.9),
        harmonic(5, 1.1),
        on_slope(35.0, 2.0, 1.0, 0.6, 0.0),
        on_slope(20.0, 2.0, 1.0, 0.6, 0.2),
    ];
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    held["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 2, "fy": 3, "torque": 1 } }]);
    files.push(held.clone());
    held["robots"][0]["limits"] = json!({ "force": 0.25, "torque": 0.0 });
    files.push(held);
    let mut pushed = wall(3, 2);
    pushed["loads"] = json!([{ "block": "4", "force": [3.0, -2.0], "at": [1.25, 0.75], "torque": 0.5 }]);
    files.push(pushed);
    files.extend((0..90).map(|number| random::scene(number).1));
    let sound = |file: &Value| drystone::Scene::from_json(&file.to_string()).is_ok();
    files.iter().filter(|file| sound(file)).map(check).collect()
}

/// A caption states the verdict of the result and its largest missing force.
#[test]
fn captions_say_what_the_result_says() {
    for checked in structures() {
        let scene = scene(&checked.file);
        let analysis = Analysis::new(&scene);
        let caption = figure::caption(&analysis);
        let frame = &analysis.frames[0];
        let (word, others) = match frame.verdict {
            Verdict::Stable => ("It stands", ["It falls", "It is undecided"]),
            Verdict::Unstable => ("It falls", ["It stands", "It is undecided"]),
            Verdict::Undecided => ("It is undecided", ["It stands", "It falls"]),
        };
        assert!(caption.contains(word), "{caption}");
        assert!(others.iter().all(|w| !caption.contains(w)), "{caption}");
        if frame.failures.is_empty() {
            assert!(!caption.contains("would have to"), "{caption}");
            continue;
        }
        // The caption contains the largest missing force, rounded.
        let largest = list(&checked.json["frames"][0]["failures"])
            .iter()
            .filter(|f| f["torque"].is_null())
            .map(|f| dot(pair(&f["force"]), pair(&f["force"])).sqrt())
            .fold(0.0, f64::max);
        let amounts = caption.split(" N").filter_map(|part| {
            let word: String = part.rsplit([' ', '\u{a0}', '\u{202f}']).next()?.into();
            word.parse::<f64>().ok()
        });
        let near = amounts.into_iter().any(|a: f64| (a - largest).abs() <= 0.06 * largest);
        assert!(!(0.01..=999.0).contains(&largest) || near, "{largest}: {caption}");
    }
}

/// The tests named in the list of claims exist, so a renamed or removed test is noticed.
#[test]
fn every_test_named_in_the_list_exists() {
    let root = env!("CARGO_MANIFEST_DIR");
    let read = |path: String| std::fs::read_to_string(path).unwrap_or_default();
    let named = LIST.split('`').skip(1).step_by(2).filter(|word| word.contains("::"));
    let mut seen = 0;
    for name in named.filter(|name| *name != "file::test") {
        let (file, test) = name.rsplit_once("::").expect("a test has a file");
        let path = format!("{root}/tests/it/{}", file.replace("::", "/"));
        let source = read(format!("{path}.rs")) + &read(format!("{path}/mod.rs"));
        assert!(source.contains(&format!("fn {test}(")), "{name} is no test");
        seen += 1;
    }
    assert!(seen > 30, "{seen}");
}

/// Every key of a result that is a number, a word or a sentence is in the list of claims, with at least one test.
#[test]
fn every_key_of_a_result_has_a_test() {
    let (_, section) = LIST.split_once("## Every key of a result").expect("a section");
    let section = section.split("\n## ").next().unwrap_or_default();
    let quoted = |cell: &str| -> Vec<String> {
        let words = cell.split('`').skip(1).step_by(2);
        words.map(str::to_owned).collect()
    };
    let mut listed = Vec::new();
    for row in section.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = row.split(" | ").collect();
        let [keys, tests] = cells[..] else {
            panic!("two cells: {row}");
        };
        let tests = quoted(tests);
        let are_tests = tests.iter().all(|test| test.contains("::"));
        assert!(!tests.is_empty() && are_tests, "{row}");
        listed.extend(quoted(keys));
    }
    let holds_others = |kind: Type| matches!(kind, Type::Object | Type::Objects | Type::ByRobot);
    let keys = paths(KEYS).into_iter().chain(paths(REFUSAL_KEYS));
    let mut expected: Vec<String> = keys.filter(|(_, key)| !holds_others(key.kind)).map(|(path, _)| path).collect();
    expected.sort_unstable();
    expected.dedup();
    listed.sort_unstable();
    assert_eq!(listed, expected);
}
