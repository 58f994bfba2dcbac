//! A vehicle that travels over a structure, against single checks of the same loads.

use drystone::analysis::{Influence, MarginKind, MarginKinds, Options};
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, Scene};
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
    let options = Options::default().margins(true).margin_kinds(MarginKinds::new(&[MarginKind::LoadFactor]));
    let frame = Analysis::with(scene(&file), &options).frames.remove(0);
    frame.margins.as_ref().expect("margins").load_factor.at()
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
    let expected = [Some(1.5), Some(3.0), None, None, None, Some(3.0)];
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
