//! Round stones: weights, contacts and verdicts of circles, compared with closed forms.

use std::f64::consts::PI;

use drystone::analysis::{MarginKind, MarginKinds, Margins, Options, Verdict};
use drystone::scene::format::{BlockEntry, CircleEntry, GroundEntry};
use drystone::scene::{NoteCode, Point};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::{scene, verdict};

const STANDS: Verdict = Verdict::Stable;
const FALLS: Verdict = Verdict::Unstable;

fn log(id: &str, x: f64, y: f64, radius: f64) -> Value {
    json!({ "id": id, "circle": { "centre": [x, y], "radius": radius } })
}

fn file(ground: Value, blocks: Value) -> Value {
    json!({ "drystone": 1, "ground": ground, "blocks": blocks })
}

fn floor() -> Value {
    json!([{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }])
}

fn margins(file: &Value) -> Margins {
    Analysis::with(scene(file), &Options::default().margins(MarginKinds::ALL)).frames[0]
        .margins
        .clone()
        .expect("margins")
}

#[test]
fn a_circle_on_a_level_floor_stands_and_rolls_at_any_tilt() {
    for (x, radius) in [(0.0, 1.0), (0.3, 0.7), (-2.125, 1e-3)] {
        let mut one = file(floor(), json!([log("log", x, radius, radius)]));
        one["contact_tolerance"] = json!(1e-9);
        assert_eq!(verdict(&one), STANDS, "{x}, {radius}");
        let found = margins(&one);
        for end in [found.least(MarginKind::Tilt), found.most(MarginKind::Tilt)] {
            assert!(end.is_some_and(|end| end.abs() < 1e-7), "{end:?}");
        }
    }
    let found = scene(&file(floor(), json!([log("log", 0.0, 0.5, 0.5)])));
    let block = &found.blocks()[0];
    assert!((block.weight - PI * 0.25 * 9.81).abs() < 1e-12 && block.centroid == Point::new(0.0, 0.5));
    let analysis = Analysis::new(&found);
    let contacts = &analysis.frames[0].contacts;
    assert!(contacts.len() == 1 && contacts[0].interface.ends == [Point::origin(); 2]);
}

/// Two logs on the ground that touch each other, and one on top.
fn pile(between: f64, ground: f64) -> Value {
    let top = 1.0 + 3.0_f64.sqrt();
    let mut pile =
        file(floor(), json!([log("left", -1.0, 1.0, 1.0), log("right", 1.0, 1.0, 1.0), log("top", 0.0, top, 1.0)]));
    pile["materials"] = json!({ "soil": {}, "oak": { "density": 700 } });
    pile["friction_pairs"] = json!([{ "between": ["oak", "oak"], "friction": between },
        { "between": ["soil", "oak"], "friction": ground }]);
    pile["ground"][0]["material"] = json!("soil");
    for k in 0..3 {
        pile["blocks"][k]["material"] = json!("oak");
    }
    pile
}

/// The top log presses on each lower log along the line to its ground contact, at 15° to the common normal: tan 15°
/// between the logs. On the ground, the tangent of the resultant is half the weight times tan 15° over 1.5 weights.
#[test]
fn three_logs_stand_from_the_friction_of_the_closed_forms_on() {
    let (between, ground) = (2.0 - 3.0_f64.sqrt(), (2.0 - 3.0_f64.sqrt()) / 3.0);
    for (share, expected) in [(1.001, STANDS), (0.999, FALLS)] {
        assert_eq!(verdict(&pile(between * share, 0.5)), expected, "{share} between the logs");
        assert_eq!(verdict(&pile(0.5, ground * share)), expected, "{share} on the ground");
    }
    let found = margins(&pile(0.5, 0.5));
    let least = found.least(MarginKind::Friction);
    assert!(least.is_some_and(|least| (least - between).abs() < 1e-6), "{least:?}");
    let mut rounded = pile(between * 1.001, 0.5);
    rounded["blocks"][2]["circle"]["centre"] = json!([0.0, 2.732]);
    rounded["contact_tolerance"] = json!(0.001);
    assert_eq!(verdict(&rounded), STANDS, "coordinates with three decimals");
}

#[test]
fn a_log_in_a_groove_between_walls_in_a_hole_and_in_a_grip_stands() {
    let groove = |angle: f64| {
        let (sin, cos) = libm::sincos(angle.to_radians());
        let ground = json!([{ "polygon": [[-4.0 * cos, 4.0 * sin], [0, 0], [4.0 * cos, 4.0 * sin], [4.0 * cos, -1], [-4.0 * cos, -1]] }]);
        file(ground, json!([log("log", 0.0, 1.0 / cos, 1.0)]))
    };
    // Gravity may turn to the side until one face carries all: without friction by the slope of the groove.
    for angle in [20.0, 45.0] {
        let left = margins(&groove(angle)).least(MarginKind::Tilt);
        assert!(left.is_some_and(|left| (left + angle).abs() < 1e-6), "{left:?}");
    }
    let wall = |x: f64| json!({ "polygon": [[x, 0], [x + 1.0, 0], [x + 1.0, 3], [x, 3]] });
    let walls = |radius: f64| file(json!([wall(-2.0), wall(1.0)]), json!([log("log", 0.0, 1.5, radius)]));
    assert_eq!([verdict(&walls(1.0)), verdict(&walls(0.9))], [STANDS, FALLS]);
    let mut held = file(json!([]), json!([log("log", 0.0, 1.5, 1.0)]));
    held["robots"] = json!([{ "holds": "log" }]);
    assert_eq!(verdict(&held), STANDS);
    let ring = json!({ "id": "ring", "polygon": [[-2, 0], [2, 0], [2, 4], [-2, 4]], "holes": [[[-1, 1], [1, 1], [1, 3], [-1, 3]]] });
    let hole = |y: f64| file(floor(), json!([ring, log("log", 0.0, y, 0.5)]));
    assert_eq!([verdict(&hole(1.5)), verdict(&hole(2.0))], [STANDS, FALLS]);
    // A round part of the ground, and a log exactly on top of it.
    let drum = json!([{ "circle": { "centre": [0, 0], "radius": 2 } }]);
    assert_eq!(verdict(&file(drum.clone(), json!([log("log", 0.0, 3.0, 1.0)]))), STANDS);
    assert_eq!(verdict(&file(drum, json!([log("log", 1.8, 2.4, 1.0)]))), FALLS);
}

#[test]
fn a_circle_touches_a_corner_only_in_a_scene_with_corner_contacts() {
    let posts = json!([{ "polygon": [[-3, -1], [-1, -1], [-1, 0], [-3, 0]] }, { "polygon": [[1, -1], [3, -1], [3, 0], [1, 0]] }]);
    let mut gap = file(posts, json!([log("log", 0.0, 1.0, 2.0_f64.sqrt())]));
    assert_eq!(verdict(&gap), FALLS);
    gap["corner_contacts"] = json!(true);
    assert_eq!(verdict(&gap), STANDS);
    let right = margins(&gap).most(MarginKind::Tilt);
    assert!(right.is_some_and(|right| (right - 45.0).abs() < 1e-6), "{right:?}");
    // Exactly at the end of an edge, and at the seam of two edges, the circle touches the edge.
    for x in [-1.0, -2.0] {
        let split = json!([{ "polygon": [[-3, -1], [-1, -1], [-1, 0], [-2, 0], [-3, 0]] }]);
        let found = scene(&file(split, json!([log("log", x, 1.0, 1.0)])));
        let analysis = Analysis::new(&found);
        assert_eq!((analysis.verdict(), analysis.frames[0].contacts.len()), (STANDS, 1), "{x}");
    }
}

#[test]
fn overlaps_and_gaps_of_circles_follow_the_rules_of_polygons() {
    let refused = |blocks: Value| {
        let text = file(floor(), blocks).to_string();
        Scene::from_json(&text).expect_err("refused").to_string()
    };
    let pair = refused(json!([log("a", 0.0, 1.0, 1.0), log("b", 1.5, 1.0, 1.0)]));
    assert!(pair.contains("0.5"), "{pair}");
    assert!(refused(json!([log("a", 0.0, 0.8, 1.0)])).contains("0.2"));
    assert!(refused(json!([log("a", 0.0, 1.0, 1.0), log("b", 0.0, 1.0, 0.2)])).contains("overlap"));
    // A hundredth of a diameter above the floor.
    let near = Analysis::new(scene(&file(floor(), json!([log("a", 0.0, 1.01, 1.0)]))));
    assert_eq!(near.verdict(), Verdict::Undecided);
    assert!(near.notes.iter().any(|note| note.code == NoteCode::NearMiss), "{:?}", near.notes);
    let mut given = file(floor(), json!([log("a", 0.0, 1.01, 1.0)]));
    given["contact_tolerance"] = json!(0.02);
    assert_eq!(verdict(&given), STANDS);
}

#[test]
fn circles_are_read_as_shapes_in_other_units_and_from_code() {
    let mut shape = file(
        json!([{ "polygon": [[-900, 0], [900, 0], [900, -100], [-900, -100]] }]),
        json!([{ "shape": "log", "at": [50, 0], "angle": 90 }]),
    );
    shape["shapes"] = json!({ "log": { "circle": { "centre": [100, 50], "radius": 100 } } });
    shape["units"] = json!({ "length": "mm" });
    let found = scene(&shape);
    let circle = found.blocks()[0].body.circle.expect("a circle");
    assert!((circle.centre - Point::new(0.0, 0.1)).norm() < 1e-15 && (circle.radius - 0.1).abs() < 1e-15);
    let built = Scene::builder()
        .ground(GroundEntry::from([[-9.0, 0.0], [9.0, 0.0], [9.0, -1.0], [-9.0, -1.0]]))
        .block(BlockEntry::new("log").circle(CircleEntry::new([0.0, 0.5], 0.5)))
        .build()
        .expect("sound");
    assert_eq!(Analysis::new(&built).verdict(), STANDS);
    let mut file = file(floor(), json!([log("log", 0.0, 0.0, 1.0)]));
    file["loads"] = json!([{ "block": "log", "force": [0, -1], "at": [0.707, 0.707] }]);
    file["ground"][0]["polygon"] = json!([[-9, -1], [9, -1], [9, -2], [-9, -2]]);
    assert!(scene(&file).notes().iter().all(|note| note.code != NoteCode::LoadOutside));
}
