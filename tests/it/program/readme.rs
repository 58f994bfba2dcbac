//! Runs the commands of the README and of `src/doc/cli.md`.

use std::fs;

use super::Bench;

const README: &str = include_str!("../../../README.md");
const CLI: &str = include_str!("../../../src/doc/cli.md");

/// The first fenced block of a page that has this language and contains these words.
fn fenced(page: &'static str, language: &str, words: &str) -> &'static str {
    let mark = format!("```{language}\n");
    let blocks = page.split(mark.as_str()).skip(1);
    let mut blocks = blocks.filter_map(|rest| rest.split("```").next());
    blocks.find(|block| block.contains(words)).expect("the page contains such a block")
}

/// Runs each `$ drystone …` line in order, in an initially empty folder. Its output must equal the text below it.
#[test]
fn the_commands_of_the_readme_print_what_it_shows() {
    let bench = Bench::empty();
    let shown = fenced(README, "console", "$ drystone new");
    let mut printed = String::new();
    for line in shown.lines() {
        let Some(typed) = line.strip_prefix("$ drystone ") else {
            continue;
        };
        let (command, asks_for_code) = match typed.strip_suffix("; echo $?") {
            Some(command) => (command, true),
            None => (typed, false),
        };
        let ran = bench.run(command);
        printed += &format!("{line}\n{}{}", ran.out, ran.err);
        if asks_for_code {
            printed += &format!("{}\n", ran.code);
        } else {
            assert_eq!(ran.code, 0, "{line}\n{}", ran.err);
        }
    }
    assert_eq!(printed, shown);
}

/// Runs the commands in a folder with the scene of the page, a second version of it, and a drawing.
#[test]
fn every_command_of_the_page_succeeds() {
    let bench = Bench::new();
    let scene = fenced(README, "json", "\"steps\"");
    let other = scene.replace("\"friction\": 0.6", "\"friction\": 0.5");
    assert_ne!(scene, other);
    fs::create_dir(bench.path("scenes")).expect("writable");
    let line = |text: &str| format!("{}\n", text.replace('\n', " "));
    for (name, text) in [
        ("scene.json", scene),
        ("a.json", scene),
        ("old.json", scene),
        ("b.json", &other),
        ("new.json", &other),
        ("scenes/one.json", scene),
        ("scenes/two.json", &other),
        ("corpus.ndjson", &(line(scene) + &line(&other))),
        ("in.md", "```drystone file=scene.json\n```\n"),
        ("vehicle.json", include_str!("../../../assets/questions/bridge-vehicle.json")),
        ("drawing.svg", include_str!("../../../assets/import/doorway.svg")),
        ("bridge.dxf", include_str!("../../../assets/import/arch.dxf")),
        ("contacts.csv", include_str!("../../../assets/import/contacts.csv")),
        ("assembly-compas.json", include_str!("../../../assets/import/compas.json")),
    ] {
        fs::write(bench.path(name), text).expect("writable");
    }
    let commands = fenced(CLI, "sh", "drystone check scene.json").lines();
    let mut seen = 0;
    for command in commands {
        let typed = command.split(" # ").next().expect("a part").trim();
        // A command with `--watch` runs until it is stopped, and `mdbook` communicates with mdBook.
        if typed.contains("--watch") || typed.ends_with("mdbook") {
            continue;
        }
        let (typed, into) = match typed.split_once(" > ") {
            Some((typed, file)) => (typed, Some(file)),
            None => (typed, None),
        };
        let ran = match typed.strip_prefix("cat scene.json | drystone ") {
            Some(line) => bench.run_with(line, scene.as_bytes()),
            None => bench.run(typed.strip_prefix("drystone ").expect("ours")),
        };
        // Without references `snapshot` reports new pictures and ends with 1.
        let expected = i32::from(typed.contains("snapshot"));
        assert_eq!(ran.code, expected, "{typed}\n{}{}", ran.out, ran.err);
        if let Some(file) = into {
            fs::write(bench.path(file), ran.out).expect("writable");
        }
        let mut words = typed.split_whitespace();
        if words.any(|word| word == "-o") {
            let name = words.next().expect("an output");
            let pages = name.replace(".pdf", "-1.pdf");
            let made = name == "-" || bench.path(name).exists() || bench.path(&pages).exists();
            assert!(made, "{typed} wrote no {name}");
        }
        seen += 1;
    }
    assert!(seen > 25, "{seen}");
}
