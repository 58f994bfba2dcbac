//! Small files that would be expensive: their cost is counted, and if it is too large they are refused.

use drystone::scene::{Code, Scene};
use drystone::{Analysis, figure, output};
use serde_json::{Value, json};

use crate::structure::{block, on_floor, rectangle};

/// `count` wedges that fill a half-circle around the origin, tips together, on flat ground.
fn fan(count: usize) -> Value {
    let corner = |k: usize| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * k as f64 / count as f64);
        [3.0 * cos, 3.0 * sin]
    };
    let wedge = |k: usize| json!({ "polygon": [[0, 0], corner(k), corner(k + 1)], "weight": 1 });
    json!({ "drystone": 1, "friction": 0.6, "corner_contacts": true,
        "ground": [{ "polygon": [[-10, -1], [10, -1], [10, 0], [-10, 0]] }],
        "blocks": (0..count).map(wedge).collect::<Vec<_>>() })
}

#[test]
fn corner_contacts_of_too_many_blocks_at_one_point_are_refused() {
    let refused = Scene::from_json(&fan(400).to_string()).expect_err("refused");
    assert_eq!(refused.list[0].code, Code::TooManyTips);
    let words = refused.to_string();
    assert!(words.contains("corners of 400 bodies meet at (0, 0)"), "{words}");
    // 400 · 399 / 2.
    assert!(words.contains("79800 corner contacts"), "{words}");
    assert!(words.contains("remove `corner_contacts`"), "{words}");
    // Without corner contacts, or with fewer blocks placed at a time, they are accepted.
    let mut without = fan(400);
    without["corner_contacts"] = false.into();
    assert!(Scene::from_json(&without.to_string()).is_ok());
    assert!(Scene::from_json(&fan(100).to_string()).is_ok());
    let mut in_turn = fan(120);
    in_turn["steps"] = json!([
        { "place": (1..=60).map(|k| k.to_string()).collect::<Vec<_>>() },
        { "remove": (1..=60).map(|k| k.to_string()).collect::<Vec<_>>(),
          "place": (61..=120).map(|k| k.to_string()).collect::<Vec<_>>() }
    ]);
    assert!(Scene::from_json(&in_turn.to_string()).is_ok());
}

#[test]
fn a_figure_of_many_loads_names_the_largest() {
    let mut file = on_floor(0.6, vec![block("a", rectangle(0.0, 0.0, 10.0, 10.0), 100.0)]);
    let load = |k: u32| {
        let at = [0.1 + f64::from(k % 50) * 0.19, 0.1 + f64::from(k / 50) * 0.19];
        json!({ "block": "a", "at": at, "force": [0, -1.0 - f64::from(k)] })
    };
    let mut amounts = |count: u32| {
        file["loads"] = (0..count).map(load).collect();
        let scene = Scene::from_json(&file.to_string()).expect("sound");
        let drawing = figure::forces(&Analysis::new(&scene), &figure::Options::default());
        let svg = output::svg::write(&drawing);
        let named = svg.matches("class=\"amount\"").count();
        (named, svg.contains("amounts only at the largest"))
    };
    let (named, is_said) = amounts(10);
    assert!(named >= 7 && !is_said, "{named}");
    // The 16 largest, or fewer if there is no room, and the largest contact force.
    let (named, is_said) = amounts(1000);
    assert!(is_said && (3..=18).contains(&named), "{named}");
}
