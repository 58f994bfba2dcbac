//! What the benchmarks that print a table have in common: they time by turns, so that other work on the machine slows all
//! of a row alike, and tell medians.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a scene of our own that is not sound is a mistake in a benchmark"
)]

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../it/structure.rs"]
pub mod structure;

use std::time::Instant;

/// How often work is timed.
pub struct Turns {
    /// At least.
    pub least: usize,
    /// At most.
    pub most: usize,
    /// No turn begins after so many seconds, once each was timed often enough.
    pub seconds: f64,
}

impl Turns {
    /// Median times of some work in milliseconds, each in its turn.
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
