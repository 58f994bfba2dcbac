//! A vehicle that travels over a structure, against single checks of the same loads.

use drystone::analysis::{Influence, MarginKind, MarginKinds, Options, UndecidedReason, Verdict, verdicts};
use drystone::result::{Layout, Timing, to_json};
use drystone::scene::format::SceneFile;
use drystone::session::Session;
use drystone::{Analysis, Scene, figure, output};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::{block, on_floor, rectangle, scene};

const BRIDGE: &str = include_str!("../../assets/questions/bridge-vehicle.json");

fn bridge(axles: Value) -> Value {
    let mut file: Value = serde_json::from_str(BRIDGE).expect("JSON");
    file["vehicle"] = json!({ "axles": axles });
    file
}

#[track_caller]
fn influence(file: &Value) -> Influence {
    Analysis::new(scene(file)).frames[0].vehicle.clone().expect("an influence line")
}

/// The load factor of a scene with these loads instead of its vehicle: block, point and weight in kilonewtons.
fn single(file: &Value, loads: &[(String, [f64; 2], f64)]) -> Option<f64> {
    let mut file = file.clone();
    file.as_object_mut().expect("an object").remove("vehicle");
    let loads = loads.iter().map(|(block, at, weight)| json!({ "block": block, "at": at, "force": [0, -weight] }));
    file["loads"] = loads.collect();
    let options = Options::default().margins(MarginKinds::new(&[MarginKind::LoadFactor]));
    let frame = Analysis::with(scene(&file), &options).frames.remove(0);
    frame.margins.as_ref().expect("margins").most(MarginKind::LoadFactor)
}

/// Compares the positions of a vehicle, one of `every`, with single checks.
fn compare(axles: &Value, every: usize) -> Influence {
    let file = bridge(axles.clone());
    let (found, scene) = (influence(&file), scene(&file));
    for position in found.positions.iter().step_by(every) {
        let loads = position.axles.iter().map(|(axle, block, at)| {
            let weight = axles[*axle]["weight"].as_f64().expect("a weight");
            (scene.blocks()[block.0].id.clone(), [at.x, at.y], weight)
        });
        let expected = single(&file, &loads.collect::<Vec<_>>());
        let same = match (position.factor, expected) {
            (Some(a), Some(b)) => (a - b).abs() <= 2e-6 * b,
            (a, b) => a == b,
        };
        assert!(same, "{position:?}: {expected:?}");
    }
    found
}

#[test]
fn every_position_of_an_axle_on_a_bridge_has_the_factor_of_a_single_check() {
    let found = compare(&json!([{ "weight": 40 }]), 2);
    let governing = &found.positions[found.governing.expect("a governing position")];
    let least = governing.factor.expect("a factor");
    assert!(found.positions.iter().all(|position| position.factor.is_none_or(|factor| factor >= least * (1.0 - 2e-6))));
    // No position in between is more dangerous, although it was not analysed.
    let file = bridge(json!([{ "weight": 40 }]));
    let (mut random, scene) = (Random::new(49), scene(&file));
    for _ in 0..12 {
        let block = &scene.blocks()[2 + random.below(11)];
        let edge = block.body.polygon.edges().filter(|edge| edge.to.x < edge.from.x);
        let top = edge.max_by(|a, b| (a.from.y + a.to.y).total_cmp(&(b.from.y + b.to.y))).expect("a top");
        let at = top.from + (top.to - top.from) * random.share();
        let factor = single(&file, &[(block.id.clone(), [at.x, at.y], 40.0)]);
        assert!(factor.is_none_or(|factor| factor >= least * (1.0 - 2e-6)), "{} at {at}: {factor:?}", block.id);
    }
}

#[test]
fn two_axles_travel_both_ways() {
    let axles = json!([{ "weight": 20 }, { "weight": 40, "offset": 1.3 }]);
    let found = compare(&axles, 23);
    let right = found.positions.iter().filter(|position| position.to_right).count();
    assert_eq!(found.positions.len(), 2 * right, "as many positions to the left as to the right");
    // The bridge is symmetric: the least factors of both ways are equal.
    let least = |to_right: bool| {
        let own = found.positions.iter().filter(|position| position.to_right == to_right);
        own.filter_map(|position| position.factor).fold(f64::INFINITY, f64::min)
    };
    assert!((least(true) - least(false)).abs() < 1e-3 * least(true), "{} {}", least(true), least(false));
}

/// A beam of weight 6 on a post from x = 0 to x = 1, with a vehicle of weight 2 on it.
fn beam(vehicle: Value) -> Value {
    let blocks =
        vec![block("post", rectangle(0.0, 0.0, 1.0, 1.0), 5.0), block("beam", rectangle(-1.0, 1.0, 3.0, 0.5), 6.0)];
    let mut file = on_floor(0.5, blocks);
    file["vehicle"] = vehicle;
    file
}

#[test]
fn an_axle_on_a_balanced_beam_agrees_with_sums_by_hand() {
    // The beam tips about x = 1 with the vehicle at x > 1: 6 · 0.5 = λ 2 (x - 1).
    let text = to_json(
        &Analysis::new(scene(&beam(json!({ "axles": [{ "weight": 2 }], "over": ["beam"], "step": 0.5 })))),
        Timing::LeftOut,
        Layout::OneLine,
    );
    let json: Value = serde_json::from_str(&text).expect("JSON");
    let vehicle = &json["frames"][0]["vehicle"];
    let positions = vehicle["positions"].as_array().expect("a list");
    // Positions with a step contain the ends of the beam.
    let expected = [Some(1.5), Some(3.0), None, None, None, Some(3.0), Some(1.5)];
    assert_eq!(positions.len(), expected.len(), "one way only, because a single axle is symmetric: {positions:?}");
    for (number, (position, factor)) in positions.iter().zip(expected).enumerate() {
        assert!((position["at"].as_f64().expect("a number") - (0.5 * number as f64 - 1.0)).abs() < 1e-9);
        assert_eq!(position["axles"][0], json!({ "axle": 0, "block": "beam", "at": [position["at"], 1.5] }));
        match factor {
            Some(factor) => assert!((position["factor"].as_f64().expect("a number") - factor).abs() < 1e-5),
            None => assert_eq!(position["factor"], "unbounded"),
        }
    }
    assert_eq!(vehicle["governing"], 0);
    let motions = vehicle["mechanism"].as_array().expect("a list");
    let tips = motions.iter().find(|motion| motion["block"] == "beam").expect("the beam moves");
    assert!(tips["spin"].as_f64().expect("a number") > 0.0, "{tips}");
    // Two axles hold each other: the rear one at x = 1.5 tips the beam until the first is off it.
    let pair = beam(json!({ "axles": [{ "weight": 2 }, { "weight": 2, "offset": 1 }], "both_ways": false }));
    let found = influence(&pair);
    assert!(found.positions.iter().all(|position| position.to_right));
    let governing = &found.positions[found.governing.expect("a position")];
    // Both axles at the left end and 1 m behind it would be beyond the beam; at the right end: 3 = λ 2 (1 + 0).
    assert!((governing.factor.expect("a factor") - 1.5).abs() < 1e-5, "{governing:?}");
}

#[test]
fn a_vehicle_needs_axles_and_known_blocks() {
    let refused = |vehicle: Value| Scene::from_json(&beam(vehicle).to_string()).expect_err("refused").to_string();
    assert!(refused(json!({ "axles": [] })).contains("the vehicle has no axle"));
    assert!(refused(json!({ "axles": [{ "weight": -1 }] })).contains("negative weight"));
    assert!(refused(json!({ "axles": [{ "weight": 1 }], "over": ["bean"] })).contains("`beam`"));
}

/// The beam with an axle of this weight: at its left end it tips about x = 0 if the weight exceeds 6 · 0.5 / 1 = 3.
fn at_left_end(weight: f64) -> Value {
    beam(json!({ "axles": [{ "weight": weight }], "over": ["beam"] }))
}

#[test]
fn a_structure_that_falls_under_its_vehicle_falls() {
    let analysis = Analysis::new(scene(&at_left_end(3.5)));
    let frame = &analysis.frames[0];
    assert_eq!(frame.verdict, Verdict::Unstable);
    let under = frame.under_vehicle.expect("the vehicle decides");
    assert_eq!(under.alone, Verdict::Stable);
    // The results are those at the governing position: the axle is a load there, and the beam turns about x = 0.
    let position = &frame.vehicle.as_ref().expect("an influence line").positions[under.position.expect("a position")];
    assert!((position.factor.expect("a factor") - 3.0 / 3.5).abs() < 1e-5);
    let loads = analysis.at(0).scene.loads();
    assert_eq!((loads.len(), loads[0].at.x, loads[0].force.y), (1, -1.0, -3.5));
    assert!(!frame.failures.is_empty() && !frame.mechanism.is_empty());
    let json: Value =
        serde_json::from_str(&to_json(&analysis, Timing::LeftOut, Layout::OneLine)).expect("JSON of the result");
    let frame = &json["frames"][0];
    assert_eq!((&frame["verdict"], &frame["verdict_without_vehicle"]), (&json!("unstable"), &json!("stable")));
    assert!(frame["governing_position"].is_u64());
    // The verdict alone is the same, and so is that of a structure that carries its vehicle.
    let verdict = |file: &Value, options: &Options| Analysis::with(scene(file), options).verdict();
    let only = Options::default().verdict_only(true);
    assert_eq!(verdict(&at_left_end(3.5), &only), Verdict::Unstable);
    for options in [Options::default(), only] {
        assert_eq!(verdict(&at_left_end(2.9), &options), Verdict::Stable);
    }
    // The quick verdicts of `batch` and a session ask the same question.
    for (weight, expected) in [(3.5, Verdict::Unstable), (2.9, Verdict::Stable)] {
        let file = at_left_end(weight);
        assert_eq!(verdicts(&scene(&file), &Options::default()), [expected]);
        let session =
            Session::new(SceneFile::from_json(&file.to_string()).expect("a scene file")).expect("a sound scene");
        assert_eq!(session.verdict(), expected);
    }
}

#[test]
fn a_structure_that_needs_its_loads_is_decided_with_them_at_each_position() {
    // The beam lies from x = -2 to 1 and weighs 6. Without the load near its right end, it tips about x = 0.
    let with = |axle: f64| {
        let mut file = beam(json!({ "axles": [{ "weight": axle }], "over": ["beam"] }));
        file["blocks"][1]["polygon"] = json!([[-2, 1], [1, 1], [1, 1.5], [-2, 1.5]]);
        file["loads"] = json!([{ "block": "beam", "at": [0.75, 1.5], "force": [0, -4.5] }]);
        Analysis::new(scene(&file))
    };
    // The load has the moment 4.5 · 0.75 = 3.375, the weight 6 · 0.5 = 3. So an axle at x = -2 may weigh 0.375 / 2 = 0.1875.
    assert_eq!(with(0.18).verdict(), Verdict::Stable);
    let falls = with(0.2);
    assert_eq!(falls.verdict(), Verdict::Unstable);
    assert_eq!(falls.frames[0].under_vehicle.map(|under| under.position), Some(None));
}

#[test]
fn too_many_positions_leave_the_frame_undecided() {
    let axles: Vec<Value> = (0..3000).map(|k| json!({ "weight": 1e-6, "offset": 1e-3 * f64::from(k) })).collect();
    let frame = Analysis::new(scene(&beam(json!({ "axles": axles, "over": ["beam"] })))).frames.remove(0);
    assert_eq!(frame.verdict, Verdict::Undecided);
    assert_eq!(frame.doubt(), UndecidedReason::TooManyPositions { most: 5000 }.to_string());
    assert!(frame.doubt().contains("more than 5000 positions"), "{}", frame.doubt());
}

#[test]
fn the_headline_says_that_the_factor_multiplies_the_loads_too() {
    let words = |torque: f64, is_fixed: bool| {
        let mut file = at_left_end(1.0);
        file["loads"] = json!([{ "block": "beam", "torque": torque, "fixed": is_fixed }]);
        let analysis = Analysis::new(scene(&file));
        output::svg::write(&figure::draw(&analysis, figure::Kind::Forces, &figure::Options::default()))
    };
    assert!(words(0.1, false).contains("× the vehicle and its loads"), "{}", words(0.1, false));
    assert!(!words(0.1, true).contains("and its loads"), "{}", words(0.1, true));
}

#[test]
fn the_least_factor_of_two_load_cases_is_the_same_whatever_else_is_computed() {
    // In the case `light`, the beam weighs 3. It tips about x = 0 if its moment 3 · 0.5 is that of the axle, λ · 1 · 1.
    let mut file = at_left_end(1.0);
    file["cases"] = json!([{ "id": "full" }, { "id": "light", "weights": 0.5 }]);
    let least = |options: &Options| {
        let frame = Analysis::with(scene(&file), options).frames.remove(0);
        let line = frame.vehicle.clone().expect("an influence line");
        line.positions[line.governing.expect("a position")].factor.expect("a factor")
    };
    for options in [Options::default(), Options::default().margins(MarginKinds::ALL)] {
        assert!((least(&options) - 1.5).abs() < 1e-5, "{}", least(&options));
    }
    // An axle of 2 stands in the case `full` only.
    file["vehicle"]["axles"][0]["weight"] = json!(2.0);
    let analysis = Analysis::new(scene(&file));
    assert_eq!(analysis.verdict(), Verdict::Unstable);
    assert_eq!(analysis.frames[0].cases.as_ref().expect("cases").governing, 1);
}

#[test]
fn named_blocks_are_passed_only_where_nothing_lies_above_them() {
    // Three stones of an arch: the joint between the key stone and the last one faces upwards, but no axle stands in it.
    let stone = |corners: [[f64; 2]; 4]| json!({ "polygon": corners });
    let file = json!({ "drystone": 1, "friction": 0.5, "density": 2000,
        "ground": [{ "polygon": rectangle(-9.0, -1.0, 18.0, 1.0) }],
        "blocks": [
            stone([[-2.483101, 0.0], [-3.068398, 0.0], [-1.534199, 2.657311], [-1.24155, 2.150429]]),
            stone([[-1.24155, 2.150429], [-1.534199, 2.657311], [1.534199, 2.657311], [1.24155, 2.150429]]),
            stone([[1.24155, 2.150429], [1.534199, 2.657311], [3.068398, 0.0], [2.483101, 0.0]]),
        ],
        "vehicle": { "axles": [{ "weight": 26146.4 }], "both_ways": false, "over": ["3"] } });
    let line = influence(&file);
    let governing = &line.positions[line.governing.expect("a factor")];
    assert!((governing.at - 1.534199).abs() < 1e-9, "{governing:?}");
    assert!(governing.factor.is_some_and(|factor| (factor - 1.7806).abs() < 1e-4), "{governing:?}");
}
