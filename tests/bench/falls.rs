//! What falls beside what stands: the same stacks, arches and walls upright and with gravity turned.
//!
//! `cargo bench --bench falls` prints the rows of `src/doc/performance.md`; a word after `--` keeps the rows that have it
//! in their name, such as `-- "wall 915"`, and `BLOCKS=10000` takes in those of more than 2 100 blocks. Upright and turned take turns, so
//! that other work on the machine slows both alike; told is the median. Walls are in running bond, μ is 0.7.

#![allow(
    clippy::panic,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "the table is the result; a scene of our own that is not sound is a mistake here"
)]

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../it/structure.rs"]
mod structure;

use std::time::Instant;

use drystone::analysis::{Options, Verdict};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use structure::{arch, block, on_floor, rectangle, scene, wall};

/// How often each is timed, at most.
const TURNS: usize = 7;

/// No row is timed for more than about so many seconds.
const LONGEST: f64 = 3.0;

/// Turns of gravity, degrees.
const ANGLES: [f64; 4] = [26.0, 30.0, 40.0, 60.0];

fn main() {
    let most: usize = std::env::var("BLOCKS").map_or(2_100, |text| text.parse().unwrap());
    let words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with('-'));
    let words: Vec<String> = words.collect();
    println!(
        "| structure | upright, ms | turned by | verdict | failures | programs | iterations | ms | ratio |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for (name, blocks, file) in structures() {
        for angle in ANGLES {
            let row = format!("{name} {blocks} at {angle}°");
            if blocks > most || words.iter().any(|word| !row.contains(word.as_str())) {
                continue;
            }
            told(&name, blocks, &file, angle);
        }
    }
}

fn told(name: &str, blocks: usize, file: &Value, angle: f64) {
    let scenes = [scene(file), scene(&turned(file, angle))];
    let upright = Analysis::of(&scenes[0]);
    assert_eq!(
        upright.verdict(),
        Verdict::Stable,
        "{name} {blocks} upright"
    );
    let (first, analysis) = timed(&scenes[1]);
    let frame = &analysis.frames[0];
    let [stands, falls] = if first > 1e3 * LONGEST {
        [
            median(vec![timed(&scenes[0]).0, timed(&scenes[0]).0]),
            first,
        ]
    } else {
        medians(&scenes)
    };
    println!(
        "| {name} {blocks} | {stands:.1} | {angle}° | {} | {} | {} | {} | {falls:.1} | {:.1} |",
        match frame.verdict {
            Verdict::Stable => "stands",
            Verdict::Unstable => "falls",
            Verdict::Undecided => "undecided",
        },
        frame.failures.len(),
        frame.solve.programs,
        frame.solve.iterations,
        falls / stands
    );
}

/// One analysis and the milliseconds it took.
fn timed(scene: &Scene) -> (f64, Analysis<'_>) {
    let start = Instant::now();
    let analysis = Analysis::with(std::hint::black_box(scene), &Options::default());
    (1e3 * start.elapsed().as_secs_f64(), analysis)
}

/// Median times of two scenes in milliseconds.
fn medians(scenes: &[Scene; 2]) -> [f64; 2] {
    let start = Instant::now();
    let mut times = [Vec::new(), Vec::new()];
    while times[0].len() < TURNS && (times[0].len() < 2 || start.elapsed().as_secs_f64() < LONGEST)
    {
        for (scene, times) in scenes.iter().zip(&mut times) {
            times.push(timed(scene).0);
        }
    }
    times.map(median)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The same file with gravity turned to the right.
fn turned(file: &Value, degrees: f64) -> Value {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let mut file = file.clone();
    file["gravity"] = json!([9.81 * sin, -9.81 * cos]);
    file
}

fn stack(blocks: usize) -> Value {
    let at = |k: usize| rectangle(0.0, 0.5 * k as f64, 1.0, 0.5);
    let blocks = (0..blocks).map(|k| block(&format!("{k}"), at(k), 6.0));
    on_floor(0.7, blocks.collect())
}

fn structures() -> Vec<(String, usize, Value)> {
    let mut all = Vec::new();
    for blocks in [10, 100, 1000, 2000, 10_000] {
        all.push(("stack".to_string(), blocks, stack(blocks)));
    }
    for blocks in [11, 101, 1001, 2001, 10_001] {
        all.push(("arch".to_string(), blocks, arch(blocks, 0.3, 0.7)));
    }
    for (columns, rows) in [
        (3, 3),
        (10, 10),
        (20, 20),
        (30, 30),
        (45, 45),
        (64, 64),
        (100, 100),
    ] {
        let file = wall(columns, rows);
        let blocks = file["blocks"].as_array().unwrap().len();
        all.push(("wall".to_string(), blocks, file));
    }
    all
}
