//! A pebble without support is added at a random edge of a random structure.

use drystone::scene::{BlockId, BodyId};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use super::{FALLS, STANDS, topped};
use crate::random::Random;
use crate::structure::{arch, block, harmonic, verdict, wall};

/// A pebble on the outside of a block's edge that faces sideways or down. Its size is a fraction of the edge's
/// length. `None` for an edge that faces up.
fn hung(polygon: &Value, edge: usize, size: f64) -> Option<Value> {
    let corner = |k: usize| {
        let corner = &polygon[k % polygon.as_array()?.len()];
        Some([corner[0].as_f64()?, corner[1].as_f64()?])
    };
    let ([ax, ay], [bx, by]) = (corner(edge)?, corner(edge + 1)?);
    let (along, out) = ([bx - ax, by - ay], [by - ay, ax - bx]);
    // Outlines run anticlockwise here, so the outside is on the right.
    if out[1] > 0.0 {
        return None;
    }
    let at = |u: f64, v: f64| {
        json!([
            ax + (0.4 + size * u) * along[0] + size * v * out[0],
            ay + (0.4 + size * u) * along[1] + size * v * out[1]
        ])
    };
    Some(json!([at(0.0, 0.0), at(0.0, 0.5), at(1.0, 0.5), at(1.0, 0.0)]))
}

/// A stable structure becomes unstable if an unsupported pebble of any size is added at any edge.
#[test]
fn a_falling_pebble_makes_any_structure_fall() {
    let mut chance = Random::new(2024);
    let mut tried = 0;
    for round in 0..200 {
        let n = chance.whole(1, 5) as usize;
        let mut file = match round % 4 {
            0 => wall(n, n + 1),
            1 => arch(2 * n + 3, 0.4, 0.9),
            2 => harmonic(n + 1, 0.9),
            _ => topped(2 * n, 0.5, 0.2),
        };
        assert_eq!(verdict(&file), STANDS, "round {round}");
        let blocks = file["blocks"].as_array().expect("a list").clone();
        let onto = chance.whole(0, blocks.len() as i64 - 1) as usize;
        let mut polygon = blocks[onto]["polygon"].clone();
        let doubled: f64 = {
            let list = polygon.as_array().expect("corners");
            let at = |k: usize| [0, 1].map(|c| list[k % list.len()][c].as_f64().unwrap_or(0.0));
            (0..list.len()).map(|k| at(k)[0] * at(k + 1)[1] - at(k)[1] * at(k + 1)[0]).sum()
        };
        if doubled < 0.0 {
            polygon.as_array_mut().expect("corners").reverse();
        }
        let edge = chance.whole(0, 3) as usize;
        let size = libm::exp10(-4.0 * chance.share()) * 0.2;
        let Some(pebble) = hung(&polygon, edge, size) else {
            continue;
        };
        let weight = libm::exp10(-12.0 * chance.share());
        file["blocks"].as_array_mut().expect("a list").push(block("pebble", pebble, weight));
        // If another body is at this position or next to it, the pebble may overlap it or be supported. Such cases
        // are skipped.
        let Ok(scene) = Scene::from_json(&file.to_string()) else {
            continue;
        };
        if !scene.penetrations().is_empty() {
            continue;
        }
        let analysis = Analysis::new(&scene);
        let frame = &analysis.frames[0];
        let last = BodyId::Block(BlockId(blocks.len()));
        let touched = frame.contacts.iter().filter(|c| c.interface.bodies.contains(&last));
        if touched.count() > 1 {
            continue;
        }
        tried += 1;
        assert_eq!(frame.verdict, FALLS, "round {round}: {}\n{file}", frame.doubt());
    }
    assert!(tried > 25, "{tried}");
}
