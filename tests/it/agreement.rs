//! All ways to get a result agree: `check --json`, `batch`, a session, a report's `.json`, the facts of snapshots and
//! figures give the same results for random scenes.

use std::process::Command;

use drystone::analysis::{MarginKinds, Options};
use drystone::figure;
use drystone::result::{Layout, Timing, margins_json, to_json};
use drystone::scene::format::SceneFile;
use drystone::session::Session;
use drystone::snapshot::fact::{DIGITS, Facts};
use drystone::{Analysis, Scene};
use serde_json::Value;
use tempfile::TempDir;

use crate::oracle::{number_of, random};

/// The number of scenes that a usual run compares; `DRYSTONE_AGREEMENT` sets another number.
const SCENES: u64 = 30;

/// Random scenes in a folder, in the order of their names.
fn scenes(folder: &TempDir) -> Vec<Value> {
    std::fs::create_dir(folder.path().join("in")).expect("made");
    let files = (0..).map(|number| random::scene(7_000 + number).1);
    let sound = files.filter(|file| Scene::from_json(&file.to_string()).is_ok());
    let files: Vec<Value> = sound.take(number_of("DRYSTONE_AGREEMENT", SCENES) as usize).collect();
    for (number, file) in files.iter().enumerate() {
        let path = folder.path().join(format!("in/{number:04}.json"));
        std::fs::write(path, file.to_string()).expect("writable");
    }
    files
}

/// The output of a command.
fn run(folder: &TempDir, line: &str) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
    command.args(line.split_whitespace()).current_dir(folder.path());
    let output = command.output().expect("starts");
    assert!(output.status.code().is_some_and(|code| code != 2 && code != 4), "{line}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn all_ways_to_get_a_result_agree() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = scenes(&folder);
    let checked = lines(&run(&folder, "check --json --no-timing --margins in"));
    let batch = lines(&run(&folder, "batch --fields all --margins in"));
    run(&folder, "report --margins in -o report.json");
    let report = std::fs::read(folder.path().join("report.json")).expect("written");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!((checked.len(), batch.len()), (files.len(), files.len()));
    assert_eq!(report["scenes"], Value::from(checked.clone()));
    for (number, file) in files.iter().enumerate() {
        let (check, mut line) = (&checked[number], batch[number].clone());
        let keys = line.as_object_mut().expect("an object");
        assert_eq!(keys.remove("verdict"), Some(check["frames"][0]["verdict"].clone()));
        assert_eq!(&line, check, "scene {number}");

        let scene = SceneFile::from_json(&file.to_string()).expect("a scene file");
        let options = Options::default().margins(MarginKinds::ALL);
        let session = Session::with(scene, options).expect("a sound scene");
        let margins = session.analysis();
        let written = to_json(&margins, Timing::LeftOut, Layout::OneLine);
        let written: Value = serde_json::from_str(&written).expect("JSON");
        assert_eq!(written["frames"], check["frames"], "scene {number}");
        let margins = session.margins(MarginKinds::ALL).expect("one frame");
        let margins: Value = serde_json::from_str(&margins_json(session.scene(), &margins)).expect("JSON");
        assert_eq!(margins, check["frames"][0]["margins"], "scene {number}");
        assert_eq!(session.verdict().word(), check["frames"][0]["verdict"], "scene {number}");

        let analysis = Analysis::new(Scene::from_json(&file.to_string()).expect("sound"));
        assert_facts(&Facts::new(&analysis, DIGITS).text(), &check["frames"][0]);
        let caption = figure::caption(&analysis);
        let word = match check["frames"][0]["verdict"].as_str().expect("a word") {
            "stable" => "It stands",
            "unstable" => "It falls",
            _ => "It is undecided",
        };
        assert!(caption.contains(word), "{word}: {caption}");
    }
}

/// Asserts that the facts list the verdict, the sums, the interfaces, the robots and the failures of a frame of the
/// result, in the same order.
fn assert_facts(text: &str, frame: &Value) {
    let facts: Value = serde_json::from_str(text).expect("JSON");
    let number = |value: &Value| value.as_f64().expect("a number");
    let near = |fact: &Value, exact: f64, unit: &str| {
        let digit = libm::pow(10.0, -number(&facts["decimals"][unit]));
        // A value close to the middle of two roundings may be rounded either way.
        assert!((number(fact) - exact).abs() <= 0.505 * digit, "{fact} {exact}: {text}");
    };
    let listed = facts["sections"][1].as_array().expect("the first frame");
    let of_kind = |kind: &str| -> Vec<&Value> {
        listed.iter().filter(|fact| fact["fact"].as_str().expect("a word").starts_with(kind)).collect()
    };
    let verdict = frame["verdict"].as_str().expect("a word");
    assert_eq!(listed[0]["verdict"], verdict, "{text}");
    let sums = of_kind("sums")[0];
    near(&sums["weight"], number(&frame["weight"]), "N");
    let interfaces = frame["interfaces"].as_array().expect("a list");
    assert_eq!(of_kind("interface").len(), interfaces.len(), "{text}");
    if verdict == "undecided" {
        return;
    }
    near(&sums["total_force"], number(&frame["total_force"]), "N");
    near(&sums["total_sticking"], number(&frame["total_sticking"]), "N");
    for (fact, interface) in of_kind("interface").into_iter().zip(interfaces) {
        let normal = &interface["normal_forces"];
        near(&fact["normal_force"], number(&normal[0]) + number(&normal[1]), "N");
        near(&fact["friction_force"], number(&interface["friction_force"]), "N");
        assert!((number(&fact["mu"]) - number(&interface["mu"])).abs() < 1e-6, "{text}");
    }
    let robots = frame["robots"].as_array().expect("a list");
    for (fact, robot) in of_kind("robot").into_iter().zip(robots) {
        near(&fact["force"][0], number(&robot["force"][0]), "N");
        near(&fact["force"][1], number(&robot["force"][1]), "N");
        near(&fact["torque"], number(&robot["torque"]), "N·m");
    }
    let failures = frame["failures"].as_array().expect("a list");
    assert_eq!(of_kind("failure").len(), failures.len(), "{text}");
    for (fact, failure) in of_kind("failure").into_iter().zip(failures) {
        match (failure["torque"].as_f64(), failure["kind"] == "robot_force") {
            (Some(torque), _) => near(&fact["missing_torque"], torque, "N·m"),
            (None, true) => {
                near(&fact["missing"][0], number(&failure["force"][0]), "N");
                near(&fact["missing"][1], number(&failure["force"][1]), "N");
            }
            (None, false) => near(&fact["missing"], number(&failure["amount"]), "N"),
        }
    }
}
