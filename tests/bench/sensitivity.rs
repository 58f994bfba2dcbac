//! The time to compute the derivatives of a margin, relative to a check of the same arch with all margins.
//!
//! `cargo bench --bench sensitivity` prints a table. The measurements of all cases alternate.

#![allow(clippy::print_stdout, reason = "the table is the result")]

mod turn;

use std::hint::black_box;

use drystone::Analysis;
use drystone::analysis::{MarginKind, MarginKinds, Options};
use serde_json::json;

use turn::Turns;
use turn::structure::{arch, scene};

/// The number of measurements of each case.
const TURNS: Turns = Turns { least: 5, most: 15, seconds: 20.0 };

fn main() {
    let mut file = arch(100, 0.2, 0.7);
    file["loads"] = json!([{ "block": "v30", "force": [0, -20_000] }]);
    let scene = scene(&file);
    let plain = Options::default();
    let kind = MarginKind::LoadFactor;
    let one = plain.margins(MarginKinds::new(&[kind]));
    let cases = [
        ("a check", plain),
        ("with the load factor", one),
        ("with all margins", plain.margins(MarginKinds::ALL)),
        ("with the load factor and its derivatives", plain.sensitivity(kind)),
    ];
    let work = cases.map(|(_, options)| {
        let scene = &scene;
        move || {
            black_box(Analysis::with(black_box(scene), &options));
        }
    });
    let times = TURNS.medians(&work);
    let whole = times[2];
    println!("| arch of 100 blocks | ms | relative to a check with all margins |");
    println!("|---|---|---|");
    for ((name, _), time) in cases.iter().zip(&times) {
        println!("| {name} | {time:.1} | {:.2} |", time / whole);
    }
    let derivatives = times[3] - times[1];
    println!("| the derivatives alone | {derivatives:.1} | {:.2} |", derivatives / whole);
}
