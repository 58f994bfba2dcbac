//! Alternating measurements, for the benchmarks that print a table. They alternate so that other load on the machine
//! affects all values of a row in the same way. The values are medians.

#![allow(clippy::panic, clippy::unwrap_used, reason = "an invalid scene is a bug in the benchmark")]

#[allow(dead_code, reason = "the tests use the other functions")]
#[path = "../it/structure.rs"]
pub mod structure;

use std::time::Instant;

/// The number of rounds. In each round, every piece of work is measured once.
pub struct Turns {
    /// The minimum number of rounds.
    pub least: usize,
    /// The maximum number of rounds.
    pub most: usize,
    /// After `least` rounds and this many seconds, no new round begins.
    pub seconds: f64,
}

impl Turns {
    /// The median times of several pieces of work, measured alternately, milliseconds.
    pub fn medians<W: Fn()>(&self, work: &[W]) -> Vec<f64> {
        let start = Instant::now();
        let mut times = vec![Vec::new(); work.len()];
        for turn in 0..self.most {
            if turn >= self.least && start.elapsed().as_secs_f64() >= self.seconds {
                break;
            }
            for (work, times) in work.iter().zip(&mut times) {
                let start = Instant::now();
                work();
                times.push(1e3 * start.elapsed().as_secs_f64());
            }
        }
        times.into_iter().map(median).collect()
    }
}

/// The upper median of some times.
pub fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
