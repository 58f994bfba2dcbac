//! Intervals in words and as bars: the output of the terminal and of a report is compared with `check --json`.

mod headline;

use std::collections::BTreeSet;
use std::process::Command;

use roxmltree::{Document, Node};
use serde_json::{Value, json};
use tempfile::TempDir;

use super::{list, number};
use crate::structure::{on_slope, wall};

/// A parameter that has an interval.
struct Parameter {
    /// Its name in the output for people.
    name: String,
    /// The JSON pointer of its interval in `margins.intervals`.
    pointer: String,
    /// True if it may be negative.
    is_signed: bool,
    /// Its value in the scene file.
    present: f64,
}

fn parameters(file: &Value) -> Vec<Parameter> {
    let own = |key: &str, default: f64| file[key].as_f64().unwrap_or(default);
    let mut all: Vec<Parameter> = [
        ("factor on the loads", "load_factor", 1.0),
        ("friction coefficient", "friction", own("friction", 0.7)),
        ("tilt of gravity", "tilt", 0.0),
        ("horizontal load, as a share of the weights", "horizontal_load", 0.0),
        ("safety kernel", "kernel", own("kernel", 0.0)),
        ("factor on the loads if nothing can turn (sliding)", "sliding", 1.0),
        ("factor on the loads if nothing can slide (overturning)", "overturning", 1.0),
        ("factor on the loads within the middle third of all joints", "middle_third", 1.0),
    ]
    .into_iter()
    .map(|(name, key, present)| Parameter {
        name: name.to_owned(),
        pointer: format!("/{key}"),
        is_signed: matches!(key, "tilt" | "horizontal_load"),
        present,
    })
    .collect();
    for robot in list(&file["robots"]) {
        let id = robot["id"].as_str().expect("a name");
        for (name, key) in [("horizontal force", "fx"), ("vertical force", "fy"), ("torque", "torque")] {
            all.push(Parameter {
                name: format!("limit of the {name} of robot {id}"),
                pointer: format!("/robots/{id}/{key}"),
                is_signed: false,
                present: number(&robot["limits"][key]),
            });
        }
    }
    all
}

/// One scene file, the frame of its result, the table of the terminal, and the report.
struct Statements {
    file: Value,
    frame: Value,
    table: String,
    page: String,
}

fn statements(file: Value) -> Statements {
    let folder = TempDir::new().expect("made");
    std::fs::write(folder.path().join("s.json"), file.to_string()).expect("written");
    let run = |line: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        command.args(line.split(' ')).current_dir(folder.path());
        let output = command.output().expect("starts");
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let result: Value = serde_json::from_str(&run("check --json --margins s.json")).expect("JSON");
    let table = run("check --margins s.json");
    run("report --margins s.json -o s.html");
    Statements {
        file,
        frame: result["frames"][0].clone(),
        table,
        page: std::fs::read_to_string(folder.path().join("s.html")).expect("a report"),
    }
}

/// Planks that need a counterweight, an arch that falls under its load, groups of blocks that never stand at the same
/// value, scenes without loads, and a block held by a robot.
fn scenes() -> Vec<Statements> {
    let read = |text: &str| -> Value { serde_json::from_str(text).expect("JSON") };
    let plank = json!({ "drystone": 1, "friction": 0.7,
        "ground": [{ "polygon": [[0, -1], [4, -1], [4, 0], [0, 0]] }],
        "blocks": [{ "id": "plank", "polygon": [[1, 0], [9, 0], [9, 1], [1, 1]], "weight": 6 }],
        "loads": [{ "block": "plank", "force": [0, -3], "at": [2.5, 1] }] });
    let mut held = on_slope(35.0, 2.0, 1.0, 0.2, 0.1);
    held["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 9, "fy": 9, "torque": 9 } }]);
    // It slides at 0.7 · 6 / 1.1 times its load.
    let pushed = json!({ "drystone": 1, "friction": 0.7,
        "ground": [{ "polygon": [[0, -1], [9, -1], [9, 0], [0, 0]] }],
        "blocks": [{ "id": "block", "polygon": [[3, 0], [6, 0], [6, 1], [3, 1]], "weight": 6 }],
        "loads": [{ "block": "block", "force": [1.1, 0], "at": [3, 0.25] }] });
    let files = [
        pushed,
        plank,
        read(include_str!("../intervals/plank.json")),
        read(include_str!("../intervals/archmech.json")),
        read(include_str!("../intervals/margin-horizontal-two-groups.json")),
        read(include_str!("../intervals/margin-load-factor-two-groups.json")),
        wall(3, 2),
        held,
    ];
    files.into_iter().map(statements).collect()
}

/// The sentence after the name of a margin in the terminal's table.
fn sentence<'a>(table: &'a str, name: &str) -> Option<&'a str> {
    let start = format!("{name}: ");
    table.lines().find_map(|line| line.trim().strip_prefix(&start))
}

/// The numbers of a sentence. A number that is followed by "left" is negative.
fn signed_numbers(sentence: &str) -> Vec<f64> {
    let words: Vec<&str> = sentence.split([' ', ';', ',']).collect();
    let following = words.iter().skip(1).chain([&""]);
    let both = words.iter().zip(following);
    both.filter_map(|(word, next)| {
        let value: f64 = word.trim_end_matches('°').parse().ok()?;
        Some(if *next == "left" { -value } else { value })
    })
    .collect()
}

/// The different bars of a report, each as an SVG document.
fn bars(page: &str) -> Vec<&str> {
    let starts = page.match_indices("<svg class=\"bar\"");
    let mut bars: Vec<&str> = starts
        .map(|(start, _)| {
            let rest = &page[start..];
            &rest[..rest.find("</svg>").expect("closed") + 6]
        })
        .collect();
    bars.sort_unstable();
    bars.dedup();
    bars
}

fn class<'a>(bar: Node<'a, 'a>, class: &str) -> Vec<Node<'a, 'a>> {
    let has = |node: &Node| node.attribute("class").is_some_and(|all| all.split(' ').any(|c| c == class));
    bar.descendants().filter(has).collect()
}

fn coordinate(node: Node, name: &str) -> f64 {
    let text = node.attribute(name).unwrap_or_else(|| panic!("{name}"));
    text.parse().expect("a number")
}

#[test]
fn words_and_bars_state_the_intervals_of_the_result() {
    let (mut inside, mut outside, mut never) = (0, 0, 0);
    for stated in scenes() {
        let drawn = bars(&stated.page);
        let mut seen = 0;
        for parameter in parameters(&stated.file) {
            let intervals = &stated.frame["margins"]["intervals"];
            let Some(interval) = intervals.pointer(&parameter.pointer) else {
                assert_eq!(sentence(&stated.table, &parameter.name), None, "{}", stated.table);
                assert!(!stated.page.contains(&parameter.name));
                continue;
            };
            seen += 1;
            let words = sentence(&stated.table, &parameter.name).expect("a line");
            let label = format!("{}: {words}", parameter.name);
            let documents = drawn.iter().map(|bar| Document::parse(bar).expect("XML"));
            let bar = documents
                .into_iter()
                .find(|bar| bar.root_element().attribute("aria-label") == Some(label.as_str()))
                .unwrap_or_else(|| panic!("a bar for {label}"));
            let excluded = stated.frame["margins"]["excluded"].pointer(&parameter.pointer);
            check_words(&parameter, interval, excluded.unwrap_or(&Value::Null), words);
            check_bar(&parameter, interval, bar.root_element());
            match (interval.is_null(), contains(interval, parameter.present)) {
                (true, _) => never += 1,
                (_, true) => inside += 1,
                _ => outside += 1,
            }
            // Another structure may stand where this one falls.
            let is_own = !["/sliding", "/overturning", "/middle_third"].contains(&&*parameter.pointer);
            let stands = stated.frame["verdict"] == "stable";
            assert!(!is_own || contains(interval, parameter.present) == stands, "{label}");
        }
        let different: BTreeSet<&str> = drawn.iter().copied().collect();
        assert_eq!(seen, different.len(), "every bar shows an interval");
        if list(&stated.file["loads"]).is_empty() {
            // The report's proof mentions loads in another sense.
            for words in ["factor on", "with its loads", "loads times"] {
                assert!(!stated.table.contains(words), "{}", stated.table);
                assert!(!stated.page.contains(words), "{words}");
            }
        }
    }
    assert!(inside > 8 && outside > 6 && never > 6, "{inside} {outside} {never}");
}

/// The finite ends of an interval. A lower end of 0 is left out if the parameter cannot be negative.
fn finite(parameter: &Parameter, interval: &Value) -> [Option<f64>; 2] {
    let low = interval[0].as_f64();
    let begins = |low: &f64| parameter.is_signed || *low > 0.0;
    [low.filter(begins), interval[1].as_f64()]
}

fn contains(interval: &Value, value: f64) -> bool {
    let low = interval[0].as_f64().unwrap_or(f64::NEG_INFINITY);
    let high = interval[1].as_f64().unwrap_or(f64::INFINITY);
    !interval.is_null() && low <= value && value <= high
}

/// The two values of a conflict: one group of blocks falls below the first value, another group falls above the
/// second value, which is smaller. Empty if there is no such conflict.
fn conflict(excluded: &Value) -> Vec<f64> {
    let [below, above] = list(excluded) else {
        return Vec::new();
    };
    if !below["from"].is_null() || !above["to"].is_null() {
        return Vec::new();
    }
    vec![number(&below["to"]), number(&above["from"])]
}

fn check_words(parameter: &Parameter, interval: &Value, excluded: &Value, words: &str) {
    let [low, high] = finite(parameter, interval);
    let mut expected: Vec<f64> = [low, high].into_iter().flatten().collect();
    expected.extend(conflict(excluded));
    if let ([a, b], true) = (&expected[..], words.contains("only at")) {
        assert!((a - b).abs() <= 1e-4 * a.abs(), "{words}");
        expected.pop();
    }
    expected.push(parameter.present);
    let found = signed_numbers(words);
    assert_eq!(found.len(), expected.len(), "{words}: {interval}");
    for (found, expected) in found.iter().zip(&expected) {
        // Three digits are written.
        assert!((found - expected).abs() <= 1e-2 * expected.abs(), "{words}: {interval}");
    }
    assert_eq!(words.contains(" no "), interval.is_null(), "{words}");
    if interval.is_null() {
        return;
    }
    let is_outside = !contains(interval, parameter.present);
    assert_eq!(words.ends_with(", outside"), is_outside, "{words}: {interval}");
    let is_one_of = |list: &[&str]| list.iter().any(|part| words.contains(part));
    let bound = (low.is_some(), high.is_some());
    assert_eq!(is_one_of(&["any factor", "at any value"]), bound == (false, false), "{words}");
    assert_eq!(is_one_of(&["at least", "and more", "without a limit to the right"]), bound == (true, false), "{words}");
    assert_eq!(is_one_of(&["at most", "up to", "without a limit to the left"]), bound == (false, true), "{words}");
}

/// Asserts that all marks of a bar lie on one scale. Its 0 is at the left end of the track, or in the middle if the
/// parameter may be negative.
fn check_bar(parameter: &Parameter, interval: &Value, bar: Node) {
    let one = |name: &str| class(bar, name).into_iter().next().expect("one");
    let track = one("all");
    let (left, width) = (coordinate(track, "x"), coordinate(track, "width"));
    let zero = if parameter.is_signed { left + width / 2.0 } else { left };
    let [low, high] = finite(parameter, interval);
    let mut marks: Vec<(f64, f64)> = Vec::new();
    let strokes = class(bar, "edge").into_iter().map(|edge| coordinate(edge, "x1"));
    let ends = [low, high].into_iter().flatten();
    assert_eq!(strokes.len(), ends.clone().count(), "{interval}");
    marks.extend(strokes.zip(ends));
    let now = one("now");
    let is_outside = !contains(interval, parameter.present);
    assert_eq!(now.has_tag_name("path"), is_outside, "a cross outside, a disc inside");
    let at = if is_outside {
        let path = now.attribute("d").expect("a path").trim_start_matches('M');
        let start = path.split(' ').next().expect("a number");
        start.parse::<f64>().expect("a number") + 5.0
    } else {
        coordinate(now, "cx")
    };
    marks.push((at, parameter.present));
    assert_eq!(class(bar, "safe").is_empty(), interval.is_null());
    if !interval.is_null() {
        let safe = one("safe");
        let (from, to) = (coordinate(safe, "x"), coordinate(safe, "x") + coordinate(safe, "width"));
        match low {
            Some(low) => marks.push((from, low)),
            None => assert!((from - left).abs() < 0.11, "open or begins at 0"),
        }
        match high {
            Some(high) => marks.push((to, high)),
            None => assert!((to - left - width).abs() < 0.11, "open to the right"),
        }
        let is_kernel = parameter.pointer == "/kernel";
        let open = [&interval[0], &interval[1]].into_iter().filter(|end| end.is_null());
        let arrows = if is_kernel { 0 } else { open.count() };
        assert_eq!(class(bar, "open").len(), arrows, "{interval}");
    }
    let farthest = marks.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (end, value) = *farthest.expect("marks");
    let pixels = if value == 0.0 { 0.0 } else { (end - zero) / value };
    assert!(pixels >= 0.0);
    for (at, value) in marks {
        // Positions are written to a tenth of a pixel, and the scale is read from one of them.
        let expected = zero + pixels * value;
        assert!((at - expected).abs() < 0.25, "{at} for {value}, not {expected}: {interval}");
    }
}
