//! The cost of hard cases: a table with the verdict, the proof and the time of each case. The last column is this
//! time divided by the time of an easy case with about the same number of blocks.
//!
//! `cargo bench --bench hard` prints the table. The measurements of the two cases alternate; each value is a median.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "the table is the output; a scene that cannot be read is a bug in this benchmark"
)]

mod turn;

use std::hint::black_box;

use drystone::Analysis;
use drystone::analysis::{Accuracy, Options, Proof, Verdict};
use serde_json::{Value, json};

use turn::Turns;
use turn::structure::{arch, block, on_floor, on_slope, rectangle, scene, wall};

/// The number of measurements of a hard case and its easy case, and the time after which no further round begins.
const TURNS: Turns = Turns { least: 3, most: 15, seconds: 6.0 };

fn main() {
    println!("| case | verdict | proof | ms | easy case, ms | ratio |");
    println!("|---|---|---|---|---|---|");
    let only = std::env::args().nth(1).filter(|word| !word.starts_with('-'));
    for (name, hard, easy) in cases() {
        if only.as_ref().is_some_and(|word| !name.contains(word.as_str())) {
            continue;
        }
        let scenes = [scene(&hard), scene(&easy)];
        let analysis = Analysis::new(&scenes[0]);
        let frame = &analysis.frames[0];
        let options = &Options::default().accuracy(Accuracy::Standard);
        let work = scenes.each_ref().map(|scene| {
            move || {
                black_box(Analysis::with(black_box(scene), options));
            }
        });
        let times = TURNS.medians(&work);
        let (hard, easy) = (times[0], times[1]);
        println!(
            "| {name} | {} | {} | {hard:.2} | {easy:.2} | {:.1} |",
            match frame.verdict {
                Verdict::Stable => "stands",
                Verdict::Unstable => "falls",
                Verdict::Undecided => "undecided",
            },
            proof_text(&frame.proof),
            hard / easy
        );
    }
}

fn proof_text(proof: &Proof) -> String {
    match proof {
        Proof::Forces { worst_imbalance, .. } => format!("off by {worst_imbalance:.0e}"),
        Proof::Mechanism { power, .. } => match proof.excluded_force_sum() {
            x if x.is_finite() => format!("power {power:.0e}, no balance below {x:.0e}"),
            _ => format!("power {power:.0e}, no balance at all"),
        },
    }
}

/// The scene with an additional horizontal load on every block: `share` times its weight.
fn pushed(mut file: Value, share: f64) -> Value {
    file["gravity"] = json!([10.0 * share, -10.0]);
    for block in file["blocks"].as_array_mut().unwrap() {
        block["weight"] = json!(block["weight"].as_f64().unwrap() * libm::hypot(1.0, share));
    }
    file
}

fn tower(weights: &[f64]) -> Value {
    let blocks = weights.iter().enumerate();
    let blocks = blocks.map(|(k, weight)| {
        let at = rectangle(0.0, 0.5 * k as f64, 1.0, 0.5);
        block(&format!("{k}"), at, *weight)
    });
    on_floor(0.5, blocks.collect())
}

fn wedge(half_angle: f64) -> Value {
    let d = libm::tan(half_angle);
    json!({ "drystone": 1, "friction": 0,
        "ground": [{ "polygon": [[-3, 0], [-0.5, 0], [-0.5 - d, 1], [-3, 1]] },
                   { "polygon": [[0.5, 0], [3, 0], [3, 1], [0.5 + d, 1]] }],
        "blocks": [{ "id": "wedge", "polygon": [[-0.5, 0], [0.5, 0], [0.5 + d, 1], [-0.5 - d, 1]], "weight": 6 }] })
}

fn overhang(beyond: f64) -> Value {
    json!({ "drystone": 1, "ground": [{ "polygon": rectangle(0.0, -1.0, 1.0, 1.0) }],
        "blocks": [block("a", rectangle(0.5 + beyond, 0.5, 1.0, 0.5), 6.0),
                   block("b", rectangle(0.0, 0.0, 1.0, 0.5), 6.0)] })
}

fn splinter(width: f64, off: f64) -> Value {
    json!({ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": rectangle(-1.0, -1.0, 2.0, 1.0) }],
        "blocks": [
            { "id": "splinter", "polygon": [[-0.5, 0], [0.5, 0], [width / 2.0, 1], [-width / 2.0, 1]], "weight": 1 },
            { "id": "block", "polygon": rectangle(-0.5 + off, 1.0, 1.0, 1.0), "weight": 6 }] })
}

fn locked(friction: f64) -> Value {
    let blocks: Vec<Value> =
        (0..5).map(|k| block(&format!("{k}"), rectangle(f64::from(k), 0.0, 1.0, 1.0), 6.0)).collect();
    let sides = [-2.0, 5.0].map(|x| json!({ "polygon": rectangle(x, -1.0, 2.0, 3.0) }));
    json!({ "drystone": 1, "friction": friction, "ground": sides, "blocks": blocks })
}

fn held(limit: f64) -> Value {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "force": limit } }]);
    file
}

fn rough(friction: f64) -> Value {
    let mut file = wall(4, 4);
    file["friction"] = json!(friction);
    file
}

fn cored(kernel: f64) -> Value {
    let mut file = wall(4, 4);
    file["kernel"] = json!(kernel);
    file
}

fn far(by: f64) -> Value {
    let mut file = wall(4, 4);
    for list in ["ground", "blocks"] {
        for body in file[list].as_array_mut().unwrap() {
            for corner in body["polygon"].as_array_mut().unwrap() {
                let [x, y] = [0, 1].map(|i| corner[i].as_f64().unwrap());
                *corner = json!([x + by, y - by]);
            }
        }
    }
    file
}

fn tilted(gravity: [f64; 2]) -> Value {
    let mut file = wall(10, 10);
    file["gravity"] = json!(gravity);
    file
}

fn feather(mountain: f64, x: f64) -> Value {
    let big = block("mountain", rectangle(0.0, 0.0, 2.0, 1.0), mountain);
    on_floor(0.5, vec![big, block("feather", rectangle(x, 1.0, 1.0, 0.1), 6.0)])
}

/// The name of each case, its hard scene, and its easy scene. The easy scene is similar but far from its limit.
fn cases() -> Vec<(String, Value, Value)> {
    let slope = |friction| on_slope(30.0, 4.0, 0.5, friction, 0.0);
    let mut heavy = [6.0; 3];
    heavy[2] = 6e8;
    let mut cases = vec![
        ("tower of 1000 blocks of 1 m by 0.5 m".to_string(), tower(&[6.0; 1000]), wall(31, 32)),
        ("a mountain on two blocks, 10⁸ times as heavy".into(), tower(&heavy), tower(&[6.0; 3])),
        ("a feather on a mountain, stands".into(), feather(6e8, 1.4), feather(60.0, 1.2)),
        ("a feather past the edge of a mountain, falls".into(), feather(6e8, 1.6), feather(60.0, 1.9)),
        ("contact of 10⁻⁶ of a block, stands".into(), splinter(1e-6, 3e-7), splinter(0.5, 0.1)),
        ("contact of 10⁻⁶ of a block, falls".into(), splinter(1e-6, 7e-7), splinter(0.5, 0.45)),
        ("μ = 0".into(), rough(0.0), rough(0.7)),
        ("μ = 1000".into(), rough(1e3), rough(0.7)),
        ("kernel 1".into(), cored(1.0), cored(0.2)),
        ("wall 10⁶ m from the origin".into(), far(1e6), far(0.0)),
        ("friction exactly at tan θ".into(), slope(libm::tan(30f64.to_radians())), slope(0.8)),
        ("robot with exactly the force it needs".into(), held(8.0), held(20.0)),
        ("robot with 10⁻⁵ N less than it needs".into(), held(8.0 - 1e-5), held(4.0)),
        ("five blocks locked between walls".into(), locked(0.02), wall(5, 1)),
        ("five blocks between walls without friction".into(), locked(0.0), pushed(wall(5, 1), 2.0)),
        ("wall of 105 bricks failing in every course".into(), tilted([6.0, -8.0]), tilted([4.0, -8.0])),
    ];
    for exponent in [2, 4, 7] {
        let half_angle = libm::exp10(-f64::from(exponent));
        cases.push((format!("frictionless wedge, half-angle 1e-{exponent}"), wedge(half_angle), wedge(0.5)));
        cases.push((format!("inverted frictionless wedge, half-angle 1e-{exponent}"), wedge(-half_angle), wedge(-0.2)));
    }
    for beyond in [0.0, 1e-9, -1e-6, 1e-6, 1e-5] {
        let easy = overhang(if beyond > 1e-7 { 0.2 } else { -0.2 });
        cases.push((format!("overhang {beyond:e} beyond the edge"), overhang(beyond), easy));
    }
    for (voussoirs, least) in THINNEST {
        for (off, easy_factor) in [(-1e-6, 0.5), (1e-6, 2.0)] {
            cases.push((
                format!("arch of {voussoirs} at its minimum thickness {off:+.0e}"),
                arch(voussoirs, least + off, 0.9),
                arch(voussoirs, easy_factor * least, 0.9),
            ));
        }
    }
    for (share, easy_share) in [(0.4815, 0.3), (0.481615, 0.3), (0.481617, 0.6), (0.482, 0.6)] {
        let name = format!("wall of 410 bricks, limit 0.481616, horizontal load {share}");
        cases.push((name, pushed(wall(20, 20), share), pushed(wall(20, 20), easy_share)));
    }
    cases
}

/// Numbers of voussoirs, and the least ratio of thickness to radius at which such an arch stands. As in
/// `tests/it/edge.rs`.
const THINNEST: [(usize, f64); 2] = [(27, 0.106_720_9), (181, 0.107_462_3)];
