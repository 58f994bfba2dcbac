//! The first mistakes that people make with a scene file, and what the program says about them.

use std::fs;

use super::Bench;

const GROUND: &str = r#""ground": [{ "polygon": [[-2, -1], [2, -1], [2, 0], [-2, 0]] }]"#;
const SQUARE: &str = r#""polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": 5"#;

/// Runs `check` on a scene with these keys, and returns the exit code and all output.
fn check(keys: &str) -> (i32, String) {
    let bench = Bench::new();
    fs::write(bench.path("mine.json"), format!("{{ \"drystone\": 1, {keys} }}")).expect("writable");
    let ran = bench.run("check mine.json");
    (ran.code, ran.out + &ran.err)
}

#[test]
fn a_message_shows_the_text_to_write() {
    let blocks = format!(r#"{GROUND}, "blocks": [{{ "id": "a", {SQUARE} }}]"#);
    for (keys, words) in [
        (format!(r#""units": "mm", {blocks}"#), r#"write "units": { "length": "mm" }"#),
        (format!(r#""units": "kN", {blocks}"#), r#"write "units": { "force": "kN" }"#),
        (format!(r#"{blocks}, "steps": [{{ "place": "a" }}]"#), r#"write a list in brackets: ["a"]"#),
        (format!(r#""friction": 0,6, {blocks}"#), "write 0.6, with a point"),
        (format!(r#""friction": "0,6", {blocks}"#), "write 0.6, with a point and without quotes"),
    ] {
        let (code, said) = check(&keys);
        assert!(code == 2 && said.contains(words), "{said}");
    }
}

#[test]
fn problems_of_one_kind_are_one_message_with_a_count() {
    // Sixty weights with units, and one block that does not exist: the hint about the name is not lost.
    let block = |i: usize| format!(r#"{{ "id": "b{i}", "polygon": [[{i}, 0], [{i}.5, 0], [{i}, 1]], "weight": -1 }}"#);
    let blocks: Vec<String> = (0..60).map(block).collect();
    let keys =
        format!(r#"{GROUND}, "blocks": [{}], "loads": [{{ "block": "b07", "force": [1, 0] }}]"#, blocks.join(",\n"));
    let (_, said) = check(&keys);
    assert!(said.contains("... and 59 more problems of this kind, at blocks[1]"), "{said}");
    assert!(said.contains("the nearest known block is `b"), "{said}");
    assert_eq!(said.matches("negative weight").count(), 1, "{said}");
    // A robot that takes one block after the other without `release`.
    let block = |i: usize| format!(r#"{{ "id": "b{i}", "polygon": [[{i}, 0], [{i}.5, 0], [{i}, 1]] }}"#);
    let blocks: Vec<String> = (0..10).map(block).collect();
    let step = |i: usize| format!(r#"{{ "place": ["b{i}"], "hold": {{ "r": "b{i}" }} }}"#);
    let steps: Vec<String> = (0..10).map(step).collect();
    let keys = format!(
        r#"{GROUND}, "blocks": [{}], "robots": [{{ "id": "r" }}], "steps": [{}]"#,
        blocks.join(","),
        steps.join(",\n")
    );
    let (_, said) = check(&keys);
    assert_eq!(said.matches("while it still holds").count(), 1, "{said}");
    assert!(said.contains("... and 8 more problems of this kind"), "{said}");
}

#[test]
fn a_corner_that_carries_nothing_is_named_with_its_key() {
    let diamond = r#""blocks": [{ "id": "diamond", "polygon": [[0, 0], [1, 1], [0, 2], [-1, 1]], "weight": 10 }]"#;
    let (code, said) = check(&format!("{GROUND}, {diamond}"));
    assert_eq!(code, 1);
    let words = "diamond and ground touch only at a corner, at (0, 0) m, which carries force only in a scene with \"corner_contacts\": true";
    assert!(said.contains(words), "{said}");
    // On its tip, the diamond is balanced.
    let (code, said) = check(&format!("{GROUND}, {diamond}, \"corner_contacts\": true"));
    assert!(code == 0 && !said.contains("touch only at a corner"), "{said}");
}

#[test]
fn lines_of_a_batch_are_counted_as_in_the_input() {
    let bench = Bench::new();
    let good = format!(r#"{{ "drystone": 1, {GROUND}, "blocks": [{{ {SQUARE} }}] }}"#);
    let twice = format!(r#"{{ "drystone": 1, "drystone": 1, {GROUND}, "blocks": [{{ {SQUARE} }}] }}"#);
    fs::write(bench.path("all.ndjson"), format!("{good}\n\n  \n{twice}\n")).expect("writable");
    let ran = bench.run("batch all.ndjson -o all.csv");
    let table = fs::read_to_string(bench.path("all.csv")).expect("written");
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows.len(), 2, "{table} {}", ran.err);
    assert!(
        rows[1].starts_with("\"all.ndjson\",4,")
            && rows[1].contains("line 4: the key `drystone` occurs twice; first in line 4, column 3"),
        "{table}"
    );
}

#[test]
fn a_folder_may_contain_files_of_other_programs() {
    let bench = Bench::new();
    fs::create_dir(bench.path("mixed")).expect("new");
    let good = format!(r#"{{ "drystone": 1, {GROUND}, "blocks": [{{ {SQUARE} }}] }}"#);
    fs::write(bench.path("mixed/ONE.JSON"), &good).expect("writable");
    fs::write(bench.path("mixed/package.json"), r#"{ "name": "web", "version": "1.0.0" }"#).expect("writable");
    let ran = bench.run("check mixed");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.out.contains("ONE.JSON") && ran.err.contains("package.json: left out, because it has no key \"drystone\""),
        "{}",
        ran.err
    );
    assert_eq!(bench.run("check mixed/package.json").code, 2, "a file named directly");
    fs::remove_file(bench.path("mixed/ONE.JSON")).expect("there");
    assert_eq!(bench.run("check mixed").code, 2);
}
