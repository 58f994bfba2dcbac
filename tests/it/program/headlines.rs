//! Every product states the same verdict and the same headline of a scene with conditions: load cases, vehicles and
//! movements.

use std::fs;

use serde_json::{Value, json};

use super::Bench;
use crate::random::Random;
use crate::structure::rectangle;

/// A round arch on two supports.
fn arch(random: &mut Random, count: usize) -> Value {
    let thickness = random.between(0.12, 0.3);
    let friction = random.between(0.4, 0.8);
    let mut file = crate::structure::arch(count, thickness, friction);
    file["ground"] = json!([{ "id": "left", "polygon": rectangle(-2.0, -0.5, 2.0, 0.5) },
        { "id": "right", "polygon": rectangle(0.0, -0.5, 2.0, 0.5) }]);
    file
}

/// A scene with load cases, a vehicle, both, or a movement.
fn scene(random: &mut Random, number: usize) -> Value {
    let count = 5 + number % 4;
    let mut file = arch(random, count);
    if number % 4 != 1 && number % 4 != 3 {
        let loads = |k: usize, random: &mut Random| {
            let force = [random.between(-400.0, 400.0), random.between(-2000.0, 0.0)];
            json!({ "id": format!("load {k}"), "block": format!("v{}", (2 * k + 1) % count), "force": force })
        };
        file["loads"] = (0..2).map(|k| loads(k, random)).collect();
        file["cases"] = json!([{ "id": "one", "loads": { "load 0": 1.35 } },
            { "id": "other", "loads": { "load 0": 0.9, "load 1": random.between(0.5, 1.5) } }]);
    }
    if number % 4 < 2 {
        file["vehicle"] = json!({ "axles": [{ "weight": random.between(200.0, 6000.0) },
            { "weight": random.between(100.0, 2000.0), "offset": 0.4 }] });
    }
    if number % 4 == 3 {
        file["movements"] = json!([{ "ground": "right", "translation": [0.01, random.between(-0.01, 0.0)] }]);
    }
    file
}

/// The text of a page without its tags.
fn plain(page: &str) -> String {
    let mut text = String::new();
    let mut is_tag = false;
    for c in page.chars() {
        match c {
            '<' => is_tag = true,
            '>' => is_tag = false,
            c if !is_tag => text.push(if c == '\u{a0}' { ' ' } else { c }),
            _ => {}
        }
    }
    text.replace("&gt;", ">").replace("&amp;", "&")
}

#[test]
fn every_product_states_the_headline_of_a_scene_with_conditions() {
    let mut random = Random::new(6201);
    let bench = Bench::new();
    let (mut falls, mut compared) = (0, 0);
    for number in 0..30 {
        let file = scene(&mut random, number);
        fs::write(bench.path("s.json"), file.to_string()).expect("written");
        for old in ["s.svg", "s.md", "s.html"] {
            let _ = fs::remove_file(bench.path(old));
        }
        let checked = bench.run("check s.json --quiet --json");
        let json: Value = serde_json::from_str(&checked.out).unwrap_or_else(|_| panic!("{}", checked.err));
        let verdict = json["frames"][0]["verdict"].as_str().expect("a verdict");
        let word = match verdict {
            "stable" => "stands",
            "unstable" => "falls",
            _ => "undecided",
        };
        falls += usize::from(word == "falls");
        let table = bench.run("check s.json");
        assert_eq!(table.code, checked.code, "{file}");
        let row = table.out.lines().find(|line| line.trim_start().starts_with("all ")).expect("a row");
        let columns: Vec<&str> = row.split("  ").map(str::trim).filter(|column| !column.is_empty()).collect();
        assert_eq!(columns[1], word, "{file}");
        // The table may shorten the headline.
        let headline = columns.last().expect("a headline").replace('\u{a0}', " ");
        for line in ["render s.json -o s.svg -q", "report s.json -o s.md -q", "report s.json -o s.html -q --strict"] {
            let ran = bench.run(line);
            assert!(ran.code == 0 || line.contains("--strict"), "{line}: {}", ran.err);
            assert!(!line.contains("--strict") || ran.code == table.code, "{line}: {} {file}", ran.code);
        }
        for product in ["s.svg", "s.md", "s.html"] {
            let text = plain(&fs::read_to_string(bench.path(product)).expect("written"));
            assert!(text.contains(&headline), "{product} lacks {headline:?}: {file}");
            assert!(text.contains(word), "{product} lacks {word}: {file}");
        }
        compared += 1;
    }
    assert!(compared == 30 && (5..25).contains(&falls), "{falls} of {compared} fall");
}
