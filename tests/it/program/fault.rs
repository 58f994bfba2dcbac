//! An internal fault affects only its scene: the other scenes are answered, and the exit code is 2.

use std::fs;

use serde_json::Value;

use super::{Bench, FALLS, Ran, STANDS};

/// A folder with a stable scene, a scene on which the program fails, and an unstable scene.
fn bench() -> Bench {
    let bench = Bench::empty();
    fs::create_dir(bench.path("all")).expect("a folder");
    for (name, text) in [("all/a.json", STANDS), ("all/faulty.json", STANDS), ("all/z.json", FALLS)] {
        fs::write(bench.path(name), text).expect("writable");
    }
    bench
}

/// Runs a command in which an internal fault occurs when `faulty.json` is processed for the `number`-th time.
fn run(bench: &Bench, line: &str, number: usize) -> Ran {
    let mut command = bench.command(line);
    command.env("DRYSTONE_TEST_FAULT", format!("faulty#{number}"));
    let output = command.output().expect("starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let ran = Ran {
        code: output.status.code().expect("no signal ended it"),
        out: text(&output.stdout),
        err: text(&output.stderr),
    };
    assert_eq!(ran.code, 2, "{line}: {}{}", ran.out, ran.err);
    ran
}

fn is_reported(text: &str) -> bool {
    // Messages are broken into lines of the width of the terminal.
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    text.contains("faulty.json") && text.contains("please report this error together with the scene")
}

#[test]
fn check_answers_the_other_scenes() {
    for number in [1, 2] {
        let ran = run(&bench(), "check all", number);
        assert!(is_reported(&ran.err), "{}", ran.err);
        assert!(ran.out.contains("a.json") && ran.out.contains("z.json"));
        assert!(!ran.out.contains("faulty"), "{}", ran.out);
    }
}

#[test]
fn check_and_batch_write_an_object_for_every_scene() {
    for (line, numbers) in [("check --json all", &[1, 2][..]), ("batch all", &[1])] {
        for number in numbers {
            let ran = run(&bench(), line, *number);
            let read = |line: &str| serde_json::from_str::<Value>(line).expect("JSON");
            let objects: Vec<Value> = ran.out.lines().map(read).collect();
            assert_eq!(objects.len(), 3, "{line}: {}", ran.out);
            let fault = &objects[1]["problems"][0];
            assert_eq!(fault["code"], "internal_fault", "{line}: {}", ran.out);
            assert!(objects[0]["problems"].is_null() && objects[2]["problems"].is_null());
        }
    }
}

#[test]
fn render_draws_the_other_scenes() {
    for number in [1, 2] {
        let bench = bench();
        let ran = run(&bench, "render all -o out/ --format svg", number);
        assert!(is_reported(&ran.err), "{}", ran.err);
        let mut drawn: Vec<String> = fs::read_dir(bench.path("out"))
            .expect("a folder")
            .map(|entry| entry.expect("readable").file_name().into_string().expect("a name"))
            .collect();
        drawn.sort();
        assert_eq!(drawn, ["a.svg", "z.svg"]);
    }
    let bench = bench();
    let ran = run(&bench, "render --broken all -o out/ --format svg", 1);
    assert!(is_reported(&ran.err), "{}", ran.err);
    assert!(bench.path("out/z.svg").exists() && !bench.path("out/faulty.svg").exists());
}

#[test]
fn the_overview_of_a_report_lists_the_fault() {
    for number in [1, 2] {
        let bench = bench();
        let ran = run(&bench, "report all -o out.html", number);
        assert!(is_reported(&ran.err), "{}", ran.err);
        let page = fs::read_to_string(bench.path("out.html")).expect("a page");
        assert!(is_reported(&page) && page.contains("Half a lintel"));
    }
}

#[test]
fn snapshot_checks_the_other_scenes() {
    for number in [1, 2] {
        let ran = run(&bench(), "snapshot all", number);
        assert!(is_reported(&ran.err), "{}{}", ran.out, ran.err);
        assert!(ran.out.contains("all/z"), "{}", ran.out);
        assert!(ran.err.contains("1 scene on which the program failed"), "{}", ran.err);
    }
}
