//! The time to compute the set of forces that the keystone of an arch can carry, relative to one check of that arch.
//!
//! `cargo bench --bench capacity` prints the medians. The goal for a block of an arch of 100 blocks is at most the
//! time of 20 checks.

#![allow(
    clippy::print_stdout,
    reason = "a benchmark reports on standard output"
)]

use std::time::Instant;

use drystone::analysis::CapacityRequest;
use drystone::starter::Arch;
use drystone::{Analysis, Scene};

/// The number of measurements of each case.
const ROUNDS: usize = 5;

fn main() {
    println!("| blocks | one check, ms | capacity of the keystone, ms | checks | corners |");
    println!("|---|---|---|---|---|");
    for blocks in [11, 25, 51, 99] {
        let file = Arch {
            voussoirs: blocks,
            ..Arch::default()
        };
        let scene = Scene::new(file.scene()).expect("sound");
        let keystone = drystone::scene::BlockId(blocks / 2);
        let request = CapacityRequest::of_block(keystone);
        let analysis = Analysis::new(&scene);
        let check = median(|| drop(Analysis::new(&scene)));
        let mut corners = 0;
        let capacity = median(|| {
            let found = analysis
                .capacity(0, &request)
                .expect("the capacity is found");
            corners = found.vertices.len();
        });
        let times = capacity / check;
        println!("| {blocks} | {check:.2} | {capacity:.1} | {times:.1} | {corners} |");
    }
}

/// The median time of `ROUNDS` calls, ms.
fn median(mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[ROUNDS / 2]
}
