//! `render --broken` draws a refused scene with its problems.

use std::fs;

use super::Bench;

/// A scene with two overlaps (one with the ground), a gap of 5 mm, an unknown key, and the additions in `more`.
fn doorway(more: &str) -> String {
    format!(
        r#"{{ "drystone": 1, "title": "By hand",
        "ground": [{{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }}],
        "blocks": [{{ "id": "left", "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]] }},
            {{ "id": "right", "polygon": [[5, 0], [6, 0], [6, 3.2], [5, 3.2]] }},
            {{ "id": "lintel", "polygon": [[0, 3.005], [6, 3.005], [6, 4], [0, 4]] }}{more},
            {{ "id": "sunk", "polygon": [[2, -0.3], [3.4, -0.3], [3.4, 0.6], [2, 0.6]] }}] }}"#
    )
}

#[test]
fn a_refused_scene_is_drawn_with_its_problems_and_ends_with_2() {
    let bench = Bench::new();
    fs::write(bench.path("door.json"), doorway("")).expect("written");
    let ran = bench.run("render --broken door.json -o door.svg");
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(ran.err.contains("overlap by 0.195 m,"), "{}", ran.err);
    let svg = fs::read_to_string(bench.path("door.svg")).expect("drawn although it is refused");
    assert!(svg.contains("By hand: refused, with 2 problems"));
    for text in ["overlap by 0.195 m,", "overlap by 0.3 m,", "0.0050 m"] {
        assert!(svg.contains(text), "{text}");
    }
    for mark in ["mark 1", "mark 2", "mark 3"] {
        assert!(svg.contains(&format!("<title>{mark}</title>")), "{mark}");
    }
    let again = bench.run("render --broken door.json -o again.svg");
    assert_eq!(again.code, 2);
    let again = fs::read_to_string(bench.path("again.svg")).expect("drawn");
    assert_eq!(again, svg, "the same scene gives the same bytes");
}

#[test]
fn crossings_are_marked_and_problems_without_a_position_are_not() {
    let bench = Bench::new();
    let cap = r#", { "id": "cap", "polygon": [[1, 4], [5, 4.6], [5, 4], [1, 4.6]] }"#;
    let text = doorway(cap).replace(r#""title""#, r#""titel": "", "title""#);
    fs::write(bench.path("door.json"), text).expect("written");
    let ran = bench.run("render --broken door.json -o -");
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(ran.out.contains("refused, with 4 problems"));
    assert!(ran.out.contains("(not marked in the picture)"));
    assert!(ran.out.contains("<title>mark 2</title>"));
    assert!(!ran.out.contains("<title>mark 1</title>"), "an unknown key");
}

#[test]
fn the_refusal_mentions_render_broken_if_there_are_outlines() {
    let bench = Bench::new();
    fs::write(bench.path("door.json"), doorway("")).expect("written");
    let offer = "drystone render --broken draws the outlines";
    assert!(bench.run("check door.json").err.contains(offer));
    assert!(bench.run("render door.json -o a.svg").err.contains(offer));
    fs::write(bench.path("empty.json"), "{}").expect("written");
    assert!(!bench.run("check empty.json").err.contains(offer));
    assert_eq!(bench.run("render --broken stands.json -o b.svg").code, 0);
    let svg = fs::read_to_string(bench.path("b.svg")).expect("drawn");
    assert!(svg.contains("no problem found"));
    assert!(!bench.path("a.svg").exists(), "nothing was written");
    let ran = bench.run("render --broken empty.json -o empty.svg");
    assert_eq!(ran.code, 2);
    assert!(bench.path("empty.svg").exists(), "a list without a picture");
}
