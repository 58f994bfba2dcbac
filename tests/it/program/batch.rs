//! `drystone batch`: one line for every scene, in order, even if some scenes are invalid or a run is interrupted.

mod resume;

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::Stdio;

use serde_json::{Value, json};

use super::{Bench, FALLS, STANDS, WRONG};
use crate::structure::rectangle;

/// A scene file on one line.
fn line(text: &str) -> String {
    let value: Value = serde_json::from_str(text).expect("JSON");
    format!("{value}\n")
}

/// A tower of `bricks` bricks, each shifted by `shift` from the brick below. It falls if the shift is more than
/// 1/`bricks`.
fn tower(title: &str, bricks: usize, shift: f64) -> String {
    let blocks: Vec<Value> = (0..bricks)
        .map(|k| {
            let (x, y) = (shift * k as f64, 0.5 * k as f64);
            json!({ "polygon": [[x, y], [x + 1.0, y], [x + 1.0, y + 0.5], [x, y + 0.5]] })
        })
        .collect();
    let ground = json!([{ "polygon": [[-9, -1], [99, -1], [99, 0], [-9, 0]] }]);
    format!(
        "{}\n",
        json!({ "drystone": 1, "title": title, "contact_tolerance": 1e-6, "ground": ground, "blocks": blocks })
    )
}

fn lines(out: &str) -> Vec<Value> {
    assert!(out.is_empty() || out.ends_with('\n'), "{out:?}");
    out.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"))).collect()
}

#[test]
fn every_line_has_an_answer_in_the_same_order() {
    let bench = Bench::new();
    let stands = line(STANDS);
    let input = format!("{stands}{}{{ \"drystone\": 1,\n\n{stands}", line(FALLS));
    let ran = bench.run_with("batch --no-such", b"");
    assert_eq!(ran.code, 2, "{}", ran.err);
    let ran = bench.run_with("batch", input.as_bytes());
    assert_eq!((ran.code, &*ran.err), (2, "4 scenes: 2 stand, 1 falls, 1 not valid\n"), "a line is invalid");
    let answers = lines(&ran.out);
    assert_eq!(answers.len(), 4, "a blank line is skipped, but counted");
    assert_eq!(answers[0], json!({ "line": 1, "scene": "A lintel", "verdict": "stable" }));
    assert_eq!(answers[1]["verdict"], "unstable", "the worse of the two frames");
    assert_eq!(answers[2]["problems"][0]["line"], 3);
    assert_eq!((&answers[3]["line"], &answers[3]["verdict"]), (&json!(5), &json!("stable")));
}

#[test]
fn problems_are_reported_with_their_positions() {
    let bench = Bench::new();
    let input = format!("{}{}", line(STANDS), line(WRONG));
    let answers = lines(&bench.run_with("batch", input.as_bytes()).out);
    let problems = answers[1]["problems"].as_array().expect("a list");
    let paths: Vec<&Value> = problems.iter().map(|p| &p["path"]).collect();
    assert!(paths.contains(&&json!("blocks[1].weight")), "{paths:?}");
    for problem in problems {
        assert_eq!(problem["line"], 2, "the line of the input");
        assert!(problem["column"].as_u64() > Some(0));
        assert_ne!(problem["message"], "");
    }
    // In a separate file the line numbers are those of the file.
    let ran = bench.run("batch wrong.json");
    let answers = lines(&ran.out);
    assert_eq!(answers[0]["file"], "wrong.json");
    let on = |n| answers[0]["problems"].as_array().into_iter().flatten().any(|p| p["line"] == n);
    assert!(on(3) && on(4), "{}", ran.out);
}

#[test]
fn a_line_that_is_cut_off_says_so() {
    let out = Bench::new().run_with("batch", b"{ \"drystone\": 1, \"blocks\": [\n").out;
    let problem = &lines(&out)[0]["problems"][0];
    assert_eq!(problem["message"], "the line ends too early");
    assert!(problem["hint"].as_str().is_some_and(|hint| hint.ends_with("is a part of the line missing?")), "{problem}");
}

#[test]
fn several_threads_give_the_same_answers_as_one_thread_and_as_check() {
    let bench = Bench::new();
    let mut input = String::new();
    for k in 0..60 {
        // Some towers are large, so that later ones are ready first.
        let bricks = if k % 7 == 0 { 60 } else { 5 };
        input += &tower(&format!("tower {k}"), bricks, 0.004 * f64::from(k));
    }
    fs::write(bench.path("corpus.ndjson"), &input).expect("writable");
    let one = bench.run("batch corpus.ndjson --jobs 1 --fields all");
    let many = bench.run("batch corpus.ndjson --jobs 4 --fields all");
    assert_eq!((one.code, one.out.len()), (many.code, many.out.len()));
    assert!(one.out == many.out, "the output depends on the number of threads");
    assert_eq!(one.code, 1, "some fall");
    for (k, (text, answer)) in input.lines().zip(lines(&one.out)).enumerate().step_by(9) {
        fs::write(bench.path("single.json"), text).expect("writable");
        let alone = bench.run("check --json --no-timing single.json");
        let alone: Value = serde_json::from_str(&alone.out).expect("JSON");
        assert_eq!(answer["frames"], alone["frames"], "scene {k}");
    }
}

#[test]
fn fields_select_the_output() {
    let bench = Bench::new();
    let whole = lines(&bench.run("batch falls.json --fields all").out).remove(0);
    let list = "verdict,frames.total_force,frames.interfaces.resultant.at,frames.proof,contact_tolerance";
    let ran = bench.run(&format!("batch falls.json --fields {list}"));
    let answers = lines(&ran.out).remove(0);
    let keys: Vec<&String> = answers.as_object().expect("an object").keys().collect();
    assert_eq!(keys, ["contact_tolerance", "file", "frames", "verdict"]);
    assert_eq!(answers["contact_tolerance"], whole["contact_tolerance"]);
    for (part, all) in [0, 1].map(|k| (&answers["frames"][k], &whole["frames"][k])) {
        assert_eq!(part.as_object().map(|o| o.len()), Some(3));
        assert_eq!(part["total_force"], all["total_force"]);
        assert_eq!(part["proof"], all["proof"]);
        let at = |v: &Value| v["interfaces"][0]["resultant"]["at"].clone();
        assert_eq!(at(part), at(all));
        assert_eq!(part["interfaces"][0].as_object().map(|o| o.len()), Some(1));
    }
    // With the names of all fields, the result is complete.
    let ran = bench.run("batch falls.json --fields drystone,scene,verdict,contact_tolerance,notes,frames");
    assert_eq!(lines(&ran.out).remove(0), whole);
    // Results that are computed only on request are requested by their field names.
    let frame = |list: &str| {
        let ran = bench.run(&format!("batch falls.json --fields {list}"));
        lines(&ran.out)[0]["frames"][1].clone()
    };
    assert!(frame("frames.margins")["margins"]["friction"].is_number());
    assert_eq!(frame("frames.only_by_wedging"), json!({ "only_by_wedging": false }));
    assert!(frame("frames.solve.seconds")["solve"]["seconds"].is_number());
    assert!(frame("frames.solve.stages")["solve"]["stages"]["solution"].is_number());
    assert!(frame("frames")["solve"].get("seconds").is_none());

    let ran = bench.run("batch falls.json --fields verdict,frames.prof,x");
    assert_eq!((ran.code, &*ran.out), (2, ""));
    assert!(ran.err.contains("did you mean frames.proof?") && ran.err.contains("no field x"));
}

/// For each list of margins, the margins of `batch` equal those of `check`.
#[test]
fn fields_ask_the_questions_whose_answers_they_select() {
    let bench = Bench::new();
    let input = tower("leans", 2, 0.3) + &tower("straight", 3, 0.0);
    fs::write(bench.path("in.ndjson"), input).expect("written");
    let answered = |options: &str| lines(&bench.run(&format!("batch in.ndjson {options}")).out);
    for line in answered("--fields frames.capacity,frames.sensitivity,frames.placement.proved") {
        let frame = &line["frames"][0];
        assert!(frame["capacity"]["shape"].is_string() && frame["sensitivity"]["parameter"] == "tilt", "{line}");
        assert!(frame["placement"]["proved"].is_number(), "{line}");
    }
    for line in answered("--sensitivity kernel --removable") {
        let frame = &line["frames"][0];
        assert!(frame["sensitivity"]["parameter"] == "kernel" && frame["removable"].is_array(), "{line}");
        assert!(frame["capacity"].is_null() && frame["placement"].is_null(), "{line}");
    }
    // The blocks have numbers as names; only the second tower has a third one.
    let of_block = answered("--capacity 3");
    assert!(of_block[0]["problems"][0]["message"].as_str().expect("a problem").contains("no block 3"), "{of_block:?}");
    assert_eq!(of_block[1]["frames"][0]["capacity"]["block"], "3");
}

#[test]
fn commands_refuse_questions_that_they_do_not_answer() {
    let bench = Bench::new();
    for (line, why) in [
        ("plan stands.json --placement", "unexpected argument '--placement'"),
        ("export stands.json --removable -o out.dxf", "unexpected argument '--removable'"),
        ("render stands.json --removable -o out.svg", "add --kind structure"),
        ("render stands.json --sensitivity tilt -o out.svg", "add --kind sensitivity"),
        ("batch stands.json --placement -o out.csv", "write an .ndjson file"),
    ] {
        let ran = bench.run(line);
        assert!(ran.code == 2 && ran.err.contains(why), "{line}: {}", ran.err);
    }
    assert_eq!(bench.run("report stands.json --sensitivity tilt --capacity lintel -o out.md").code, 0);
    let report = fs::read_to_string(bench.path("out.md")).expect("a report");
    assert!(report.contains("Sensitivity of the tilt") && report.contains("Capacity: at "), "{report}");
}

#[test]
fn margins_are_those_of_check() {
    let bench = Bench::new();
    for list in ["", "=friction,tilt", " load-factor", "=horizontal_load,kernel,robots"] {
        for file in ["stands.json", "falls.json"] {
            let ran = bench.run(&format!("check --json --no-timing --margins{list} {file}"));
            let checked: Value = serde_json::from_str(&ran.out).expect("JSON");
            // The motions beyond the margins must be asked for.
            let margins = |result: &Value| {
                let frames = result["frames"].as_array().expect("frames").iter();
                let short = |frame: &Value| {
                    let mut margins = frame["margins"].clone();
                    for long in ["mechanisms", "excluded"] {
                        margins.as_object_mut().and_then(|margins| margins.remove(long));
                    }
                    margins
                };
                frames.map(short).collect::<Vec<_>>()
            };
            assert!(margins(&checked).iter().all(Value::is_object), "{checked}");
            let batch = |fields: &str| {
                let ran = bench.run(&format!("batch --margins{list} {file} {fields}"));
                assert_ne!(ran.code, 2, "{}", ran.err);
                lines(&ran.out).remove(0)
            };
            // `--margins` alone adds only the margins to the output.
            let answers = batch("");
            assert_eq!(margins(&answers), margins(&checked), "{list}");
            assert_eq!(answers["frames"][0].as_object().map(|o| o.len()), Some(1));
            assert_eq!(answers["scene"], checked["scene"]);
            assert_eq!(margins(&batch("--fields verdict,frames.weight")), margins(&checked));
            assert_eq!(batch("--fields all")["frames"], checked["frames"], "{list}");
        }
    }
    let ran = bench.run("batch stands.json --margins --fields frames.margins.friction");
    let answers = lines(&ran.out).remove(0);
    let margins = answers["frames"][0]["margins"].as_object().expect("an object");
    assert!(margins.len() == 1 && margins["friction"].is_number(), "{answers}");
    let answers = lines(&bench.run("batch stands.json --wedging").out).remove(0);
    assert_eq!(answers["frames"], json!([{ "only_by_wedging": false }]));
    assert_eq!(bench.run("batch stands.json --margins=lean").code, 2);
}

#[test]
fn a_folder_is_read_in_the_order_of_names() {
    let bench = Bench::new();
    fs::create_dir(bench.path("in")).expect("made");
    for (name, text) in [
        ("in/b.json", STANDS.to_owned()),
        ("in/a.ndjson", format!("{}{}", line(STANDS), line(FALLS))),
        ("in/readme.txt", "no scene".into()),
    ] {
        fs::write(bench.path(name), text).expect("writable");
    }
    let answers = lines(&bench.run("batch in stands.json").out);
    let places: Vec<(String, Value)> = answers.iter().map(|t| (t["file"].to_string(), t["line"].clone())).collect();
    assert_eq!(places.len(), 4);
    assert!(places[0].0.contains("a.ndjson") && places[0].1 == 1 && places[1].1 == 2);
    assert!(places[2].0.contains("b.json") && places[2].1.is_null());
    assert_eq!(places[3].0, "\"stands.json\"");
    let ran = bench.run("batch nowhere in");
    assert_eq!((ran.code, &*ran.out), (2, ""));
    assert!(ran.err.contains("nowhere"), "{}", ran.err);
}

#[test]
fn each_line_is_answered_before_the_next_one_is_read() {
    let bench = Bench::new();
    let mut child = bench.command("batch").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("starts");
    let mut pipe = child.stdin.take().expect("piped");
    let mut answers = BufReader::new(child.stdout.take().expect("piped"));
    for k in 1..=5 {
        pipe.write_all(line(STANDS).as_bytes()).expect("read");
        let mut answer = String::new();
        answers.read_line(&mut answer).expect("written");
        assert!(answer.starts_with(&format!("{{\"line\":{k},")), "{answer}");
    }
    drop(pipe);
    assert!(child.wait().expect("ended").success());
}

#[test]
fn pictures_are_400_pixels_wide_and_named_after_their_lines() {
    let bench = Bench::new();
    let input = format!("{}broken\n{}", line(STANDS), line(FALLS));
    let ran = bench.run_with("batch --render drawn", input.as_bytes());
    let answers = lines(&ran.out);
    assert_eq!(answers[0]["picture"], "0000001.png");
    assert!(answers[1].get("picture").is_none());
    assert_eq!(answers[2]["picture"], "0000003.png");
    for name in ["0000001.png", "0000003.png"] {
        let png = fs::read(bench.path("drawn").join(name)).expect("drawn");
        assert!(png.starts_with(b"\x89PNG"));
        assert_eq!(png[16..20], 400_u32.to_be_bytes(), "{name}");
    }
    assert_eq!(fs::read_dir(bench.path("drawn")).expect("there").count(), 2);
    // The picture equals that of `render` without a margin.
    let ran = bench.run("batch stands.json --render more --format svg");
    assert_eq!(lines(&ran.out)[0]["picture"], "stands.svg");
    bench.run("render stands.json --no-margin --no-source -o alone.svg");
    let both = ["more/stands.svg", "alone.svg"].map(|n| fs::read(bench.path(n)).expect("there"));
    assert!(both[0] == both[1]);
    fs::create_dir(bench.path("more/in")).expect("made");
    fs::copy(bench.path("stands.json"), bench.path("more/in/stands.json")).expect("copied");
    let ran = bench.run("batch stands.json more/in/stands.json --render drawn");
    assert_eq!((ran.code, &*ran.out), (2, ""), "both would be stands.png");
}

#[test]
fn pictures_of_a_scene_and_of_a_line_never_have_the_same_name() {
    let bench = Bench::new();
    for name in ["a-0000001.json", "a0000001.json", "0000001.json"] {
        fs::copy(bench.path("stands.json"), bench.path(name)).expect("copied");
    }
    fs::write(bench.path("a.ndjson"), line(STANDS)).expect("written");
    for clash in ["a-0000001.json a.ndjson", "a.ndjson a-0000001.json", "- 0000001.json"] {
        let ran = bench.run_with(&format!("batch {clash} --render drawn"), line(STANDS).as_bytes());
        assert_eq!((ran.code, &*ran.out), (2, ""), "{clash}");
        assert!(ran.err.contains("would have the same names"), "{}", ran.err);
    }
    let ran = bench.run("batch a.ndjson a0000001.json 0000001.json --render drawn");
    let pictures: Vec<Value> = lines(&ran.out).iter().map(|answer| answer["picture"].clone()).collect();
    assert_eq!(pictures, ["a-0000001.png", "a0000001.png", "0000001.png"]);
}

#[test]
fn the_time_limit_applies_to_each_scene() {
    let bench = Bench::new();
    // The forces of a tower are unique, so no solver runs that could exceed the time limit. A bridge needs the
    // solver.
    let bridge = |title: &str| {
        let posts = [rectangle(0.0, 0.0, 1.0, 3.0), rectangle(3.0, 0.0, 1.0, 3.0)];
        let polygons = posts.into_iter().chain([rectangle(0.0, 3.0, 4.0, 1.0)]);
        let blocks: Vec<Value> = polygons.map(|p| json!({ "polygon": p })).collect();
        let ground = json!([{ "polygon": rectangle(-9.0, -1.0, 99.0, 1.0) }]);
        let scene = json!({ "drystone": 1, "title": title, "ground": ground, "blocks": blocks });
        format!("{scene}\n")
    };
    let input = format!("{}{}", bridge("a"), bridge("b"));
    let ran = bench.run_with("batch --time-limit 0", input.as_bytes());
    assert_eq!(ran.code, 3, "{}", ran.out);
    assert!(lines(&ran.out).iter().all(|answer| answer["verdict"] == "undecided"));
    let ran = bench.run_with("batch --time-limit 100", input.as_bytes());
    assert_eq!(ran.code, 0, "{}", ran.out);
}

#[test]
fn progress_is_written_to_standard_error_on_request() {
    let bench = Bench::new();
    let input: String = (0..40).map(|k| tower(&k.to_string(), 12, 0.01)).collect();
    fs::write(bench.path("in.ndjson"), input).expect("writable");
    let ran = bench.run("batch in.ndjson --progress 0.01");
    assert_eq!(lines(&ran.out).len(), 40);
    assert!(ran.err.contains("a second"), "{}", ran.err);
    assert!(ran.err.contains("40 scenes in"), "{}", ran.err);
    assert!(ran.err.ends_with("40 stand\n"), "{}", ran.err);
    assert_eq!(bench.run("batch in.ndjson").err, "40 scenes: 40 stand\n");
    assert_eq!(bench.run("batch in.ndjson --progress 0.01 --quiet").err, "");
}

#[test]
fn a_closed_output_ends_the_run_without_failure_while_the_input_is_open() {
    let bench = Bench::new();
    let mut child = bench
        .command("batch")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts");
    let mut pipe = child.stdin.take().expect("piped");
    let endless = std::thread::spawn(move || while pipe.write_all(line(STANDS).as_bytes()).is_ok() {});
    let mut answers = BufReader::new(child.stdout.take().expect("piped"));
    let mut answer = String::new();
    answers.read_line(&mut answer).expect("written");
    drop(answers);
    assert_eq!(child.wait().expect("ended").code(), Some(0));
    let mut errors = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut errors).expect("text");
    assert_eq!(errors, "");
    endless.join().expect("the pipe is closed");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported() {
    let bench = Bench::new();
    for target in ["-o /dev/full", "--render /dev/full/x"] {
        let ran = bench.run(&format!("batch stands.json {target}"));
        assert_eq!(ran.code, 4, "{target}: {}", ran.err);
        assert!(ran.err.contains("cannot write /dev/full"), "{}", ran.err);
    }
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("there");
    let ended = bench.command("batch stands.json").stdout(full).stderr(Stdio::null()).status().expect("starts");
    assert_eq!(ended.code(), Some(4));
}

#[test]
fn an_output_that_is_also_an_input_is_refused() {
    let bench = Bench::new();
    let ran = bench.run("batch stands.json -o stands.json");
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert_eq!(fs::read_to_string(bench.path("stands.json")).ok().as_deref(), Some(STANDS));
}
