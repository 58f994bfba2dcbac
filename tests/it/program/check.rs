//! `check`: verdicts, tables, JSON and problems.

use std::fs;

use serde_json::Value;

use super::Bench;

#[test]
fn check_ends_with_the_worst_verdict() {
    let bench = Bench::new();
    for (line, code) in [
        ("check stands.json", 0),
        ("check falls.json", 1),
        ("check stands.json falls.json", 1),
        ("check falls.json stands.json", 1),
        ("check falls.json --frame 2", 0),
        ("check falls.json --frame b", 0),
        ("check falls.json --frame a", 1),
        ("check wrong.json", 2),
        ("check falls.json wrong.json", 2),
        ("check missing.json", 2),
        ("check .", 2),
        ("check falls.json --frame 3", 2),
        ("check falls.json --frame 0", 2),
        ("check", 2),
        ("check stands.json --jsn", 2),
        ("", 2),
        ("--version", 0),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, code, "{line}: {}{}", ran.out, ran.err);
        assert_eq!(ran.err.is_empty(), code != 2, "{line}: {}", ran.err);
        if code == 2 {
            assert_eq!(ran.out, "", "{line}");
        }
    }
}

#[test]
fn the_table_has_verdicts_numbers_and_failures() {
    let bench = Bench::new();
    let ran = bench.run("check falls.json");
    let lines: Vec<&str> = ran.out.lines().collect();
    assert!(lines[0].contains("falls.json") && lines[0].contains("Half a lintel"), "{}", ran.out);
    assert!(lines[2].contains("(a) Alone") && lines[2].contains("falls"), "{}", ran.out);
    assert!(ran.out.contains("(b) Held"), "{}", ran.out);
    let limits = "The blocks are\n          rigid, laid dry and at rest";
    assert!(!ran.out.contains(limits), "only with --explain");
    let explained = bench.run("check --explain falls.json").out;
    assert!(explained.contains(limits), "{explained}");
    for line in explained.lines().rev().take(9) {
        assert!(line.chars().count() <= 80, "{line}");
    }
    // The weight of the lintel, 11 N, acts 2 m beyond the edge of the post. The pull at the far corner has an arm of
    // 1 m.
    let words = "lintel comes off left at (0, 3) m: holding them together would need a pull of 22 N";
    assert!(ran.out.contains(words), "{}", ran.out);
    // At the foot of the post, the weight of the post reduces the pull: 6 N half a metre inside the edge.
    assert!(
        ran.out.contains("left comes off ground at (0, 0) m: holding them together would need a pull of 19 N"),
        "{}",
        ran.out
    );
}

/// The table states the headline margin, but not forces of one balance among many; the range of a thrust follows with
/// `--explain`.
#[test]
fn the_table_states_the_headline_margin_and_explains_which_numbers_are_of_one_balance() {
    let bench = Bench::new();
    let arch = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/arch13.json");
    let table = bench.run(&format!("check {arch}")).out;
    let head = table.lines().nth(1).expect("a head");
    assert!(head.split_whitespace().eq(["frame", "verdict", "weight", "margin"]), "{table}");
    assert!(table.contains("falls at ") && !table.contains("tilt of gravity:"), "{table}");
    let explained = bench.run(&format!("check --explain {arch}")).out;
    assert!(explained.contains("The horizontal thrust H may lie between "), "{explained}");
    assert!(explained.contains("many sets of forces can balance a frame"), "{explained}");
    let json: Value = serde_json::from_str(&bench.run(&format!("check --json {arch}")).out).expect("JSON");
    assert!(json["frames"][0]["margins"].is_null(), "{json}");
}

#[test]
fn the_json_output_has_one_object_per_scene() {
    let bench = Bench::new();
    let ran = bench.run("check --json falls.json");
    let result: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(result["scene"], "Half a lintel");
    let frames = result["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 2);
    assert_eq!((&frames[0]["verdict"], &frames[1]["verdict"]), (&"unstable".into(), &"stable".into()));
    assert_eq!(frames[0]["failures"][0]["kind"], "tension");
    assert!(frames[0]["proof"]["power"].as_f64().expect("number") > 0.0);
    assert!(frames[1]["proof"]["worst_imbalance"].as_f64().expect("number") < 1e-7);
    assert!(frames[1]["solve"]["seconds"].as_f64().expect("number") >= 0.0);
    assert_eq!(frames[1]["robots"][0]["id"], "crane");
    assert!((frames[0]["weight"].as_f64().expect("number") - 17.0).abs() < 1e-12);

    let ran = bench.run("check --json --no-timing stands.json falls.json");
    let lines: Vec<Value> = ran.out.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 2);
    assert_eq!((&lines[0]["scene"], &lines[1]["scene"]), (&"A lintel".into(), &"Half a lintel".into()));
    assert!(lines[1]["frames"][0]["solve"]["seconds"].is_null());
}

#[test]
fn margins_are_present_on_request() {
    let bench = Bench::new();
    let object = |line: &str| -> Value { serde_json::from_str(&bench.run(line).out).expect("JSON") };
    let plain = object("check --json falls.json");
    assert!(plain["frames"][0].get("margins").is_none());
    let result = object("check --json --margins falls.json");
    let margins = |frame: usize| &result["frames"][frame]["margins"];
    assert!(margins(0)["tilt"]["left"].is_null(), "it falls without a tilt");
    assert!(margins(1)["friction"].as_f64().expect("number") >= 0.0);
    // The scene lists no loads.
    assert!(margins(1)["load_factor"].is_null());
    assert!(margins(1)["intervals"].get("load_factor").is_none());
    let friction = &margins(1)["intervals"]["friction"];
    assert_eq!(friction[0], margins(1)["friction"]);
    assert!(friction[1].is_null(), "it also stands with more friction");
    assert!(margins(1)["robots"]["crane"]["fy"].as_f64().expect("number") > 0.0);
    let output = bench.run("check --margins stands.json").out;
    assert!(output.contains("friction coefficient: stands "), "{output}");
}

#[test]
fn single_margins_can_be_requested() {
    let bench = Bench::new();
    for line in [
        "check --json --margins friction,tilt falls.json",
        "check --json --margins=friction,tilt falls.json",
        "check falls.json --json --margins tilt,friction",
    ] {
        let result: Value = serde_json::from_str(&bench.run(line).out).expect("JSON");
        let margins = result["frames"][1]["margins"].as_object().expect("margins");
        let mut keys: Vec<&str> = margins.keys().map(String::as_str).collect();
        keys.sort_unstable();
        let expected = ["friction", "intervals", "mechanisms", "robots", "tilt"];
        assert_eq!(keys, expected, "{line}");
        assert!(margins["robots"].as_object().expect("an object").is_empty());
    }
    let output = bench.run("check --margins kernel stands.json").out;
    assert!(output.contains("safety kernel: stands ") && !output.contains("friction coefficient: "), "{output}");
    let wrong = bench.run("check --margins fricton,tilt stands.json");
    assert_eq!(wrong.code, 2);
    assert!(wrong.err.contains("friction"), "{}", wrong.err);
}

#[test]
fn the_most_effective_changes_of_a_margin_are_listed_in_words() {
    let bench = Bench::new();
    let output = bench.run("check --sensitivity horizontal_load stands.json").out;
    assert!(output.contains("(right end of the interval in which the frame stands)"), "{output}");
    assert!(output.contains("; what changes it most, estimated from derivatives:"), "{output}");
    assert!(output.contains(" → about "), "{output}");
    let output = bench.run("check --sensitivity load_factor stands.json").out;
    let reason = "no sensitivity of the load factor: there are no loads on placed blocks";
    assert!(output.contains(reason), "{output}");
    let result = bench.run("check --json --sensitivity tilt stands.json").out;
    let result: Value = serde_json::from_str(&result).expect("JSON");
    let found = &result["frames"][0]["sensitivity"];
    assert_eq!(found["parameter"], "tilt");
    assert_eq!(found["ends"].as_array().map(Vec::len), Some(2));
    let vertices = &found["ends"][1]["vertices"];
    assert_eq!(vertices[0]["moves"], "along", "it stands on the ground");
    let wrong = bench.run("check --sensitivity robots stands.json");
    assert_eq!(wrong.code, 2);
}

#[test]
fn the_result_with_the_verdict_alone_has_the_same_keys() {
    let bench = Bench::new();
    let object = |line: &str| -> Value { serde_json::from_str(&bench.run(line).out).expect("JSON") };
    let whole = object("check --json --no-timing falls.json");
    let result = object("check --json --no-timing --verdict-only falls.json");
    let keys = |value: &Value| -> Vec<String> {
        let keys = value.as_object().expect("an object").keys();
        keys.filter(|key| *key != "notices").cloned().collect()
    };
    for number in 0..2 {
        let (whole, result) = (&whole["frames"][number], &result["frames"][number]);
        assert_eq!(keys(whole), keys(result));
        assert_eq!(whole["verdict"], result["verdict"]);
    }
    let notices = result["frames"][0]["notices"].to_string();
    assert!(notices.contains("only the verdict was asked for"), "{notices}");
    let output = bench.run("check --verdict-only --verbose falls.json");
    assert_eq!(output.code, 1);
    assert!(output.out.contains("unknown"), "{}", output.out);
}

#[test]
fn without_timing_the_same_scene_gives_the_same_bytes() {
    let bench = Bench::new();
    for line in ["check --json --no-timing falls.json", "check --no-timing falls.json", "render falls.json -o -"] {
        let (once, again) = (bench.run(line), bench.run(line));
        assert_eq!(once.out, again.out, "{line}");
        assert!(once.out.len() > 100, "{line}");
    }
}

#[test]
fn all_problems_of_a_scene_are_shown_with_their_positions() {
    let bench = Bench::new();
    let ran = bench.run("check wrong.json");
    assert_eq!(ran.code, 2);
    for words in ["wrong.json:3:", "frction", "friction", "wrong.json:4:", "-3"] {
        assert!(ran.err.contains(words), "{words} is not in\n{}", ran.err);
    }
    let both = bench.run("check wrong.json missing.json stands.json");
    assert!(both.err.contains("wrong.json:3:") && both.err.contains("missing.json"), "{}", both.err);
}

#[test]
fn an_invalid_file_is_answered_with_its_problems_and_the_others_with_results() {
    let bench = Bench::new();
    for quiet in ["", "-q "] {
        let line = format!("{quiet}check --json --frame 2 falls.json wrong.json missing.json stands.json falls.json");
        let ran = bench.run(&line);
        assert_eq!(ran.code, 2);
        let lines: Vec<Value> = (ran.out.lines()).map(|line| serde_json::from_str(line).expect("only JSON")).collect();
        let files: Vec<&str> = lines.iter().filter_map(|l| l["file"].as_str()).collect();
        assert_eq!(files, ["falls.json", "wrong.json", "missing.json", "stands.json", "falls.json"]);
        assert_eq!(lines[0]["frames"][0]["verdict"], "stable");
        let problem = &lines[1]["problems"][0];
        assert_eq!((&problem["code"], &problem["line"]), (&"unknown_key".into(), &3.into()));
        assert_eq!(problem["path"], "blocks[0].frction");
        assert_eq!(problem["hint"], "the nearest known key is `friction`");
        assert_eq!(lines[2]["problems"][0]["code"], "not_readable");
        assert!(lines[2]["problems"][0]["line"].is_null());
        assert_eq!(lines[3]["problems"][0]["code"], "no_such_frame");
        assert_eq!(lines[4]["frames"][0]["title"], "Held");
        assert!(ran.err.contains("wrong.json:3:") && ran.err.contains("missing.json"), "{}", ran.err);
    }
    let alone = bench.run("check --json wrong.json");
    let object: Value = serde_json::from_str(&alone.out).expect("JSON");
    assert_eq!((alone.code, &object["file"]), (2, &"wrong.json".into()));
    // A problem of an option has a message too, without the advice to type --help.
    let unknown = bench.run("check --json stands.json --capacity z");
    let object: Value = serde_json::from_str(&unknown.out).expect("JSON");
    let message = object["problems"][0]["message"].as_str().expect("a message");
    assert!(message.starts_with("--capacity: the scene has no block z") && !message.contains("--help"), "{message}");
}

#[test]
fn a_folder_as_an_argument_means_its_scenes() {
    let bench = Bench::new();
    let ran = bench.run("check --json .");
    let files: Vec<Value> =
        (ran.out.lines()).map(|line| serde_json::from_str::<Value>(line).expect("JSON")["file"].clone()).collect();
    assert_eq!(files, ["./falls.json", "./stands.json", "./wrong.json"]);
    std::fs::create_dir(bench.path("none")).expect("made");
    let ran = bench.run("check none");
    assert!(ran.code == 2 && ran.err.contains("no .json files"), "{}", ran.err);
    std::fs::remove_file(bench.path("wrong.json")).expect("removed");
    assert_eq!(bench.run("render . -o one.svg").code, 2, "two scenes, one file");
    assert_eq!(bench.run("render . -o out/").code, 0);
    assert!(bench.path("out/falls.svg").exists() && bench.path("out/stands.svg").exists());
}

/// The statements of `src/doc/result.md` about files, folders and standard input.
#[test]
fn files_are_answered_in_the_order_of_the_result_page() {
    let bench = Bench::new();
    let scene = fs::read(bench.path("stands.json")).expect("readable");
    for name in ["many/10.json", "many/9.json", "many/deeper/1.json", "one/a.json", "none/a.txt"] {
        let path = bench.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
        fs::write(path, &scene).expect("writable");
    }
    let files = |line: &str| {
        let ran = bench.run(&format!("check --json {line}"));
        let values = serde_json::Deserializer::from_str(&ran.out).into_iter::<Value>();
        let files: Vec<String> =
            (values.map(|v| v.expect("JSON")["file"].as_str().expect("text").to_owned())).collect();
        (ran.code, ran.out.lines().count(), files.join(" "))
    };
    let (code, lines, name) = files("stands.json");
    assert!(code == 0 && lines > 10 && name == "stands.json", "one scene is written over several lines");
    let (code, lines, name) = files("one");
    assert!(code == 0 && lines > 10 && name == "one/a.json", "also for the only file of a folder");
    assert_eq!(files("stands.json falls.json"), (1, 2, "stands.json falls.json".into()));
    assert_eq!(files("many"), (0, 2, "many/10.json many/9.json".into()));
    assert_eq!(files("stands.json wrong.json falls.json"), (2, 3, "stands.json wrong.json falls.json".into()));
    assert_eq!(files("-q missing.json stands.json"), (2, 2, "missing.json stands.json".into()));
    assert_eq!(files("none"), (2, 0, String::new()));
    let ran = bench.run_with("check --json -", &scene);
    let result: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(result["file"], "-");
    // A program must check for refused files before it reads `frames`.
    let ran = bench.run("check --json -q wrong.json");
    let refused: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert!(refused.get("frames").is_none() && !ran.err.is_empty());
}
