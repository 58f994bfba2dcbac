//! Random small scenes: piles, cut walls, stacks on slopes and arches. Each number always gives the same scene.
//!
//! If possible, coordinates are coarse fractions, so that bodies touch exactly and many scenes are exactly at their
//! limit. A load of 10⁻⁴ to 10⁻⁹ of a weight then moves a scene slightly to one side of the limit.

use serde_json::{Value, json};

use super::shape;
use crate::random::Random;

/// Every kind of scene, and whether floating-point numbers represent its corners exactly.
pub const KINDS: [(&str, bool); 6] = [
    ("square lattice", true),
    ("triangular lattice", false),
    ("bricks", true),
    ("slope", true),
    ("cut wall", true),
    ("arch", true),
];

/// The kind and the file of the scene with this number.
pub fn scene(number: u64) -> (usize, Value) {
    let mut chance = Random::new(number);
    let kind = (number % KINDS.len() as u64) as usize;
    let mut file = match kind {
        0 => shape::square_pile(&mut chance),
        1 => shape::triangular_pile(&mut chance),
        2 => shape::bricks(&mut chance, [1, 0]),
        3 => {
            let along = chance.one_of(&[[4, 3], [12, 5], [12, -5], [24, 7], [3, 4], [1, 0]]);
            shape::bricks(&mut chance, along)
        }
        4 => shape::cut_wall(&mut chance),
        _ => shape::arch(&mut chance),
    };
    dress(&mut file, &mut chance, kind == 3);
    (kind, file)
}

/// Adds friction, kernel, weights, robots and loads.
fn dress(file: &mut Value, chance: &mut Random, slope: bool) {
    file["drystone"] = json!(1);
    let mut friction = chance.one_of(&[0.0, 0.0, 0.05, 0.25, 0.5, 0.577, 0.7, 1.0, 3.0, 1000.0]);
    if chance.percent(30) {
        friction = chance.share();
    }
    if slope && chance.percent(40) {
        let difference = chance.one_of(&[0.0, 0.0, 1e-3, 1e-5, 1e-6, 1e-8, -1e-8, -1e-6, -1e-5, -1e-3]);
        friction = chance.one_of(&[0.75, 5.0 / 12.0, 7.0 / 24.0, 4.0 / 3.0]) + difference;
    }
    file["friction"] = json!(friction);
    let kernel = if chance.percent(15) { chance.share() } else { chance.one_of(&[0.0, 0.0, 0.0, 0.2, 0.2, 0.25, 1.0]) };
    file["kernel"] = json!(kernel);
    if chance.percent(12) {
        file["gravity"] =
            chance.one_of(&[[3.0, -4.0], [-1.0, -1.0], [0.125, -1.0], [-5.0, -12.0]]).map(Value::from).to_vec().into();
    }
    let blocks = file["blocks"].as_array_mut().expect("every kind has blocks");
    let names: Vec<String> = (0..blocks.len()).map(|k| format!("{k}")).collect();
    let by_density = chance.percent(30);
    let mut places = Vec::new();
    for (block, name) in blocks.iter_mut().zip(&names) {
        block["id"] = json!(name);
        if !by_density {
            let factor = if chance.percent(4) { 1000.0 } else { 1.0 };
            let least = if chance.percent(5) { 0 } else { 1 };
            block["weight"] = json!(factor * chance.whole(least, 9) as f64);
        }
        places.push(block["polygon"][0].clone());
    }
    let robots = if chance.percent(30) { chance.whole(1, 2) } else { 0 };
    let mut held = Vec::new();
    let mut list = Vec::new();
    for k in 0..robots {
        let block = chance.whole(0, names.len() as i64 - 1) as usize;
        if held.contains(&block) {
            continue;
        }
        held.push(block);
        let mut robot = json!({ "id": format!("r{k}"), "holds": names[block] });
        if chance.percent(50) && places[block].is_array() {
            robot["at"] = places[block].clone();
        }
        let newtons = chance.whole(0, 24) as f64 / 2.0;
        match chance.whole(0, 4) {
            0 => robot["limits"] = json!({ "force": newtons }),
            1 => robot["limits"] = json!({ "fx": newtons, "torque": chance.whole(0, 6) }),
            2 => robot["limits"] = json!({ "fy": newtons, "fx": chance.share() }),
            3 => robot["limits"] = json!({ "force": 1000, "torque": 1000 }),
            _ => {}
        }
        list.push(robot);
    }
    file["robots"] = json!(list);
    let mut loads = Vec::new();
    let quarter = |chance: &mut Random| chance.whole(-16, 16) as f64 / 4.0;
    let listed = if chance.percent(30) { chance.whole(1, 2) } else { 0 };
    for _ in 0..listed {
        let name = &names[chance.whole(0, names.len() as i64 - 1) as usize];
        let mut load = json!({ "block": name, "force": [quarter(chance), quarter(chance)] });
        if chance.percent(50) {
            load["at"] = json!([quarter(chance), quarter(chance)]);
        }
        if chance.percent(25) {
            load["torque"] = json!(quarter(chance));
        }
        loads.push(load);
    }
    if chance.percent(25) {
        let size = libm::exp10(-chance.whole(4, 9) as f64) * chance.whole(1, 9) as f64;
        let direction = chance.one_of(&[[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, -1.0]]);
        let name = &names[chance.whole(0, names.len() as i64 - 1) as usize];
        loads.push(json!({ "block": name, "force": [size * direction[0], size * direction[1]] }));
    }
    file["loads"] = json!(loads);
}
