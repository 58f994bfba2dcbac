//! The time to compute the set of forces that the keystone of an arch or a brick in the middle of a wall can carry,
//! relative to one check of that arch or wall.
//!
//! `cargo bench --bench capacity` prints the medians. The goal for a block of an arch of 100 blocks is at most the
//! time of 20 checks.

#![allow(clippy::print_stdout, reason = "a benchmark reports on standard output")]

use std::time::Instant;

use drystone::analysis::CapacityRequest;
use drystone::starter::{Arch, Wall};
use drystone::{Analysis, Scene};

/// The number of measurements of each case.
const ROUNDS: usize = 5;

fn main() {
    println!("| structure | one check, ms | capacity of a block, ms | checks | corners |");
    println!("|---|---|---|---|---|");
    for blocks in [11, 25, 51, 99] {
        let arch = Arch { voussoirs: blocks, ..Arch::default() };
        let scene = Scene::new(arch.scene()).expect("sound");
        measure(&format!("arch {blocks}"), &scene, blocks / 2);
    }
    for (courses, bricks) in [(6, 5), (10, 10)] {
        let wall = Wall { courses, bricks, ..Wall::default() };
        let scene = Scene::new(wall.scene()).expect("sound");
        let count = scene.blocks().len();
        measure(&format!("wall {count}"), &scene, count / 2);
    }
}

/// Prints a row of the table.
fn measure(name: &str, scene: &Scene, block: usize) {
    let request = CapacityRequest::of_block(drystone::scene::BlockId(block));
    let analysis = Analysis::new(scene);
    let check = median(|| drop(Analysis::new(scene)));
    let mut corners = 0;
    let capacity = median(|| {
        let found = analysis.capacity(0, &request).expect("the capacity is found");
        corners = found.vertices.len();
    });
    let times = capacity / check;
    println!("| {name} | {check:.2} | {capacity:.1} | {times:.1} | {corners} |");
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
