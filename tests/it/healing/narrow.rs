//! Narrow gaps and slight overlaps on which a verdict may depend.

use drystone::Scene;
use drystone::analysis::{Contact, Verdict};
use drystone::scene::{BlockId, BodyId};
use serde_json::{Value, json};

use super::judged;
use crate::structure::{first, scene as checked};

/// A lintel on two posts; its right end lies `gap` above its post.
fn lintel(gap: f64, tolerance: Option<f64>) -> Value {
    let mut file = json!({
        "drystone": 1, "ground": [{ "polygon": [[-1.3333333333, -1], [5, -1], [5, 0], [-1.3333333333, 0]] }],
        "blocks": [
            { "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]] },
            { "id": "b", "polygon": [[3, 0], [4, 0], [4, 2.0 - gap], [3, 2.0 - gap]] },
            { "id": "lintel", "polygon": [[0, 2], [4, 2], [4, 3], [0, 3]] }
        ]
    });
    if let Some(tolerance) = tolerance {
        file["contact_tolerance"] = json!(tolerance);
    }
    file
}

#[test]
fn a_verdict_that_depends_on_a_narrow_gap_is_undecided() {
    let (verdict, _, doubt) = judged(&lintel(0.004, None));
    assert_eq!(verdict, Verdict::Undecided, "{doubt}");
    for word in ["0.004 m", "lintel", " b ", "contact_tolerance", "falls", "stands"] {
        assert!(doubt.contains(word), "{word}: {doubt}");
    }
    // With the tolerance in the message the verdict is decided, and also with one that leaves the gap open.
    assert_eq!(judged(&lintel(0.004, Some(0.00404))).0, Verdict::Stable);
    assert_eq!(judged(&lintel(0.004, Some(1e-6))).0, Verdict::Unstable);
    // A gap of more than a hundredth of a post's size is not doubtful.
    assert_eq!(judged(&lintel(0.03, None)).0, Verdict::Unstable);
    assert_eq!(judged(&lintel(0.0, None)).0, Verdict::Stable);
}

/// Stones of a fifth of a metre, too small for healing by millimetres. The widest gap measured along edges is 0.33
/// mm, but a corner of the pier lies 0.8 mm from its intended place. If that gap is closed, the arch stands.
#[test]
fn the_tolerance_in_the_message_closes_gaps_at_misplaced_corners() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/arch-on-piers.json");
    let text = std::fs::read_to_string(path).expect("a scene");
    let mut file: Value = serde_json::from_str(&text).expect("JSON");
    let (verdict, _, doubt) = judged(&file);
    assert_eq!(verdict, Verdict::Undecided);
    assert!(doubt.contains("stands if bodies touch"), "{doubt}");
    let (_, closing) = doubt.split_once("contact_tolerance of ").expect("a value");
    let closing = closing.split(' ').next().expect("a number");
    file["contact_tolerance"] = json!(closing.parse::<f64>().expect("a number"));
    assert_eq!(judged(&file).0, Verdict::Stable);
}

#[test]
fn a_small_stone_keeps_its_own_tolerance() {
    // A pebble of 2 mm, 20 µm from its step: less than a millionth of the scene, but a hundredth of the pebble.
    let pebble = |x: f64| {
        json!({
            "drystone": 1, "friction": 0.0, "gravity": [9.81, -9.81],
            "ground": [{ "polygon": [[-40, -1], [40, -1], [40, 0], [0.0, 0], [0.0, 1], [-40, 1]] }],
            "blocks": [
                { "id": "far", "polygon": [[-40, 1], [-38, 1], [-38, 2], [-40, 2]], "friction": 9 },
                { "id": "pebble", "polygon": [[x, 0], [x + 0.002, 0], [x + 0.002, 0.002], [x, 0.002]] }
            ]
        })
    };
    for (x, gap) in [(2e-5, true), (0.0, false)] {
        let file = pebble(x);
        let own = checked(&file).blocks()[1].body.gap;
        assert!(own < 2.1e-6, "{own}");
        let is_pebble = |c: &&Contact| c.interface.bodies[0] == BodyId::Block(BlockId(1));
        let touching = first(&file).contacts.iter().filter(is_pebble).count();
        assert_eq!(touching, if gap { 1 } else { 2 });
    }
}

#[test]
fn a_verdict_that_depends_on_a_slight_overlap_is_undecided() {
    // The lintel overlaps both posts. If these overlaps carry nothing, it falls.
    let file = |depth: f64, tolerance: Option<f64>| {
        let mut file = lintel(0.0, tolerance);
        file["blocks"][2]["polygon"] = json!([[0, 2.0 - depth], [4, 2.0 - depth], [4, 3], [0, 3]]);
        file
    };
    let (verdict, _, doubt) = judged(&file(0.003, None));
    assert_eq!(verdict, Verdict::Undecided, "{doubt}");
    for word in [
        "0.003 m of overlap",
        "lintel",
        " b ",
        "contact_tolerance of 3.03e-3 m",
        "it falls if overlaps",
        "stands if bodies touch",
    ] {
        assert!(doubt.contains(word), "{word}: {doubt}");
    }
    // With the tolerance in the message the verdict is decided. If the overlap exceeds the tolerance, the file is
    // refused.
    assert_eq!(judged(&file(0.003, Some(0.00303))).0, Verdict::Stable);
    for (depth, tolerance) in [(0.003, Some(1e-4)), (0.02, None)] {
        let problems = Scene::from_json(&file(depth, tolerance).to_string()).unwrap_err();
        let deep = format!("overlap by {depth} m,");
        assert!(problems.to_string().contains(&deep), "{problems}");
    }
    let problems = Scene::from_json(&file(0.003, Some(1e-4)).to_string()).unwrap_err();
    let allows = "\"contact_tolerance\": 3.2e-3";
    assert!(problems.to_string().contains(allows), "{problems}");
}

#[test]
fn a_slight_overlap_that_does_not_matter_is_reported_with_the_verdict() {
    // Two posts side by side, the second 4 mm inside the first. The second is pushed away with a tenth of its weight,
    // or with its whole weight.
    let file = |push: f64| {
        json!({
            "drystone": 1, "ground": [{ "polygon": [[-1.3333333333, -1], [5, -1], [5, 0], [-1.3333333333, 0]] }],
            "blocks": [
                { "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]], "weight": 10 },
                { "id": "b", "polygon": [[0.996, 0], [1.996, 0], [1.996, 2], [0.996, 2]], "weight": 10 }
            ],
            "loads": [{ "block": "b", "force": [push, 0], "at": [1.5, 1.0] }]
        })
    };
    for (push, expected) in [(1.0, Verdict::Stable), (10.0, Verdict::Unstable)] {
        let frame = first(&file(push));
        assert_eq!(frame.verdict, expected, "{}", frame.doubt());
        let names_overlap = |n: &String| n.contains("0.004 m of overlap between a and b");
        assert!(frame.notices.iter().any(names_overlap), "{:?}", frame.notices);
    }
    // If it is pushed towards the first post, it stands only if it touches that post.
    let (verdict, _, doubt) = judged(&file(-7.5));
    assert_eq!(verdict, Verdict::Undecided, "{doubt}");
}
