//! Random scenes of one to three groups of blocks, each on separate ground.

use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::{block, rectangle};

/// A scene of one to three groups of blocks, each on separate ground.
pub(super) fn random_scene(number: u64) -> Value {
    let mut chance = Random::new(0x1a7e_0000 + number);
    let mut file = json!({ "drystone": 1, "ground": [], "blocks": [], "robots": [], "loads": [] });
    file["friction"] = json!(chance.one_of(&[0.0, 0.125, 0.25, 0.5, 0.5, 0.7, 0.7, 1.0, 2.0]));
    file["kernel"] = json!(chance.one_of(&[0.0, 0.0, 0.0, 0.25]));
    let is_loaded = chance.percent(75);
    for part in 0..chance.whole(1, 3) {
        let x = 32.0 * part as f64;
        let ids: Vec<String> = add_part(&mut file, &mut chance, x, part);
        if is_loaded && chance.percent(75) {
            for _ in 0..chance.whole(1, 2) {
                let id = &ids[chance.whole(0, ids.len() as i64 - 1) as usize];
                // The load acts at a corner, because corners are exact and centroids are rounded.
                let mut load = json!({ "block": id, "at": corner(&file, id) });
                let quarter = |chance: &mut Random| chance.whole(-24, 24) as f64 / 4.0;
                let force = [quarter(&mut chance), quarter(&mut chance)];
                // Avoid a load of zero.
                load["force"] = json!(if force == [0.0; 2] { [0.0, -1.0] } else { force });
                if chance.percent(25) {
                    load["torque"] = json!(quarter(&mut chance));
                }
                push(&mut file, "loads", load);
            }
        }
        if chance.percent(30) {
            let held = chance.whole(0, ids.len() as i64 - 1) as usize;
            let id = &ids[held];
            let newtons = chance.whole(0, 24) as f64 / 2.0;
            let limits = match chance.whole(0, 3) {
                0 => json!({ "fx": newtons, "fy": newtons, "torque": 0 }),
                1 => json!({ "fx": newtons, "fy": 24, "torque": chance.whole(0, 6) }),
                2 => json!({ "fx": 100, "fy": newtons, "torque": 2 }),
                _ => json!({ "fx": 1000, "fy": 1000, "torque": 1000 }),
            };
            let at = corner(&file, id);
            let id = format!("r{part}");
            let robot = json!({ "id": id, "holds": ids[held], "at": at, "limits": limits });
            push(&mut file, "robots", robot);
        }
    }
    file
}

/// The first corner of a block.
fn corner(file: &Value, id: &str) -> Value {
    let mut blocks = file["blocks"].as_array().into_iter().flatten();
    let block = blocks.find(|block| block["id"] == id).expect("a block of the scene");
    block["polygon"][0].clone()
}

fn push(file: &mut Value, list: &str, entry: Value) {
    file[list].as_array_mut().expect("a list").push(entry);
}

/// Adds the ground and the blocks of one group to the right of `x`. Returns the names of its blocks.
fn add_part(file: &mut Value, chance: &mut Random, x: f64, part: i64) -> Vec<String> {
    let eighth = |chance: &mut Random, least: i64, most: i64| chance.whole(least, most) as f64 / 8.0;
    let mut ground = vec![rectangle(x - 2.0, -1.0, 12.0, 1.0)];
    let mut bodies = Vec::new();
    match chance.whole(0, 5) {
        // A block next to a wall, without a floor. It stands only if a load presses it against the wall.
        0 => {
            ground = vec![rectangle(x - 1.0, 0.0, 1.0, 9.0)];
            bodies.push(rectangle(x, 4.0, 1.0, eighth(chance, 4, 16)));
        }
        // A plank that overhangs its pier, with a counterweight on it.
        1 => {
            ground = vec![rectangle(x, 0.0, 2.0, 2.0)];
            let out = eighth(chance, 4, 32);
            bodies.push(rectangle(x, 2.0, 2.0 + out, 0.5));
            bodies.push(rectangle(x + eighth(chance, 0, 8), 2.5, 0.5, 1.0));
        }
        // A stack whose blocks are set off from each other.
        2 => {
            let mut left = x;
            for level in 0..chance.whole(1, 4) {
                bodies.push(rectangle(left, level as f64, 2.0, 1.0));
                left += eighth(chance, -6, 6);
            }
        }
        // A lintel on two posts.
        3 => {
            let high = eighth(chance, 8, 24);
            bodies.push(rectangle(x, 0.0, 1.0, high));
            bodies.push(rectangle(x + 4.0, 0.0, 1.0, high));
            bodies.push(rectangle(x + eighth(chance, 0, 4), high, 4.5, 0.5));
        }
        // A block on a slope of 3 in 4 or 1 in 2, rising to the right or to the left.
        4 => {
            let steep = chance.one_of(&[0.75, 0.5, -0.75, -0.5]);
            let y = |at: f64| at * steep;
            let corners = [[x, -16.0], [x + 16.0, -16.0], [x + 16.0, y(16.0)], [x, 0.0]];
            ground = vec![json!(corners)];
            let up = eighth(chance, 8, 24);
            let (at, far) = (4.0, 5.0 + eighth(chance, 0, 8));
            let base = [[x + at, y(at)], [x + far, y(far)]];
            let top = [[x + far, y(far) + up], [x + at, y(at) + up]];
            bodies.push(json!([base[0], base[1], top[0], top[1]]));
        }
        // A wide block, a tall block, and sometimes a block in the air.
        _ => {
            bodies.push(rectangle(x, 0.0, eighth(chance, 8, 24), 1.0));
            bodies.push(rectangle(x + 4.0, 0.0, 1.0, eighth(chance, 8, 32)));
            if chance.percent(15) {
                bodies.push(rectangle(x + 7.0, 3.0, 1.0, 1.0));
            }
        }
    }
    for polygon in ground {
        push(file, "ground", json!({ "polygon": polygon }));
    }
    let ids: Vec<String> = (0..bodies.len()).map(|k| format!("{part}-{k}")).collect();
    for (id, polygon) in ids.iter().zip(bodies) {
        push(file, "blocks", block(id, polygon, chance.whole(1, 9) as f64));
    }
    ids
}
