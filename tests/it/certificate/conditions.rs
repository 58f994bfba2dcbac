//! A frame that stands in several load cases or under a vehicle is proved in each of these conditions.

use std::fs;
use std::process::Command;

use drystone::Scene;
use drystone::analysis::{Options, Verdict};
use drystone::certificate::LoadForm;
use serde_json::{Value, json};

use super::{by_python, certificate, proved, proved_by_python};
use crate::random::Random;
use crate::structure::{arch, scene};

/// An arch with two load cases, a vehicle of two axles, or both.
fn structure(random: &mut Random, number: usize) -> Value {
    let mut file = arch(5 + number % 3, random.between(0.3, 0.5), 0.7);
    if number % 3 != 1 {
        let load = |id: &str, block: &str, random: &mut Random| json!({ "id": id, "block": block, "force": [random.between(-40.0, 40.0), random.between(-100.0, 0.0)] });
        file["loads"] = json!([load("people", "v1", random), load("wind", "v3", random)]);
        file["cases"] = json!([{ "id": "one", "loads": { "people": 1.35 } },
            { "id": "other", "weights": 0.9, "loads": { "people": 0.5, "wind": 1.5 } }]);
    }
    if !number.is_multiple_of(3) {
        let weight = random.between(20.0, 100.0);
        file["vehicle"] = json!({ "axles": [{ "weight": weight }, { "weight": 0.5 * weight, "offset": 0.37 }] });
    }
    file
}

#[test]
fn each_condition_of_a_frame_that_stands_is_proved_by_both_checkers() {
    let mut random = Random::new(6217);
    let (mut texts, mut rust, mut conditions) = (Vec::new(), Vec::new(), 0);
    for number in 0..6 {
        let file = structure(&mut random, number);
        let certificate = certificate(&scene(&file), &Options::default());
        let checked = certificate.check().expect("a structure");
        assert!(checked.is_exact(), "{checked:?}: {file}");
        let stands = certificate.frames[0].verdict == Verdict::Stable.word();
        assert!(stands && certificate.limits.iter().all(|limit| limit.change.loads.is_some()), "{file}");
        conditions += certificate.limits.len();
        // The frame itself is the condition that governs.
        let (cases, positions) = (if number % 3 == 1 { 1 } else { 2 }, if number % 3 == 0 { 0 } else { 10 });
        assert!(certificate.limits.len() >= cases * (1 + positions) - 1, "{}: {file}", certificate.limits.len());
        // With a load that nothing carries, the forces prove nothing.
        let mut wrong = certificate.clone();
        let block = certificate.frames[0].placed[0];
        let push = LoadForm { force: [1e6, 1e6], at: Some([0.0, 0.5]), torque: 0.0, fixed: false };
        wrong.limits[0].change.loads = Some(vec![(block, 1.0, vec![push])]);
        let faults = wrong.check().expect("a structure");
        assert!(!faults.is_exact(), "{file}");
        for one in [&certificate, &wrong] {
            texts.push(one.to_json());
            rust.push(proved(&one.check().expect("a structure")));
        }
    }
    assert!(conditions > 75, "{conditions}");
    let Some(pages) = by_python(&texts) else { return };
    for (rust, page) in rust.iter().zip(&pages) {
        assert_eq!(*rust, proved_by_python(page), "{page:#?}");
    }
}

#[test]
fn the_program_compares_the_conditions_with_those_of_the_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |line: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let ran = command.args(line.split(' ')).current_dir(folder.path()).output().expect("it runs");
        let texts = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        (ran.status.code(), texts.concat())
    };
    let path = |name: &str| folder.path().join(name);
    let file = structure(&mut Random::new(3), 2);
    assert!(Scene::from_json(&file.to_string()).is_ok());
    fs::write(path("s.json"), file.to_string()).expect("written");
    assert_eq!(run("check s.json --certificate c.json -q").0, Some(0));
    let (code, said) = run("verify c.json s.json");
    assert_eq!(code, Some(0), "{said}");
    for words in ["frame 1, load case one, without the vehicle (", "load case other, the first axle at x = "] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let text = fs::read_to_string(path("c.json")).expect("written");
    let mut wrong: Value = serde_json::from_str(&text).expect("JSON");
    wrong["limits"].as_array_mut().expect("proofs").pop();
    fs::write(path("wrong.json"), wrong.to_string()).expect("written");
    let (code, said) = run("verify wrong.json s.json");
    assert!(code == Some(2) && said.contains("the load cases or the positions of the vehicle differ"), "{said}");
    // A body that is not there.
    let mut wrong: Value = serde_json::from_str(&text).expect("JSON");
    wrong["limits"][0]["change"]["loads"][0][0] = json!(99);
    fs::write(path("wrong.json"), wrong.to_string()).expect("written");
    let (code, said) = run("verify wrong.json");
    assert!(code == Some(3) && said.contains("not placed"), "{code:?} {said}");
}

/// Each frame is proved with the loads of its own worst case.
#[test]
fn frames_are_proved_in_their_worst_load_case() {
    let side = |x: f64| json!([[x, 0], [x + 1.0, 0], [x + 1.0, 2], [x, 2]]);
    let push = |id: &str, x: f64| json!({ "id": id, "block": id, "force": [8, 0], "at": [x, 2] });
    let scene = json!({ "drystone": 1, "friction": 0.9,
        "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }],
        "blocks": [{ "id": "a", "polygon": side(0.0), "weight": 9 }, { "id": "b", "polygon": side(4.0), "weight": 9 }],
        "loads": [push("a", 0.0), push("b", 4.0)],
        "cases": [{ "id": "on a", "loads": { "a": 1 } }, { "id": "on b", "loads": { "b": 1 } }],
        "steps": [{ "place": ["a"] }, { "place": ["b"], "remove": ["a"] }] });
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cases.json"), scene.to_string()).expect("writable");
    let ran = Command::new(env!("CARGO_BIN_EXE_drystone"))
        .args(["check", "cases.json", "--json", "--accuracy", "proved"])
        .current_dir(folder.path())
        .output()
        .expect("starts");
    let json: Value = serde_json::from_slice(&ran.stdout).expect("JSON");
    for (number, case) in ["on a", "on b"].into_iter().enumerate() {
        let frame = &json["frames"][number];
        assert_eq!(frame["verdict"], "unstable");
        assert_eq!(frame["governing_case"], case);
        assert_eq!(frame["proof"]["exact"], true, "{frame}");
    }
}
