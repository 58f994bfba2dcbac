//! [`Summary`]: the errors, times and wrong verdicts of one method at one tolerance, over all frames of a study.

use super::{Mark, Method, Run, Study};
use crate::mechanics::analysis::Accuracy;
use crate::mechanics::solve::TOLERANCE;

/// The results of one method at one tolerance over all frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// The method.
    pub method: Method,
    /// The tolerance of the solver.
    pub tolerance: f64,
    /// The median over the frames of the time relative to `standard` at the default tolerance.
    pub time: f64,
    /// The largest relative error of the total among frames with the right verdict.
    pub total_error: Option<f64>,
    /// The median of these relative errors.
    pub median_error: Option<f64>,
    /// The largest relative error of the largest single force, among frames with the right verdict.
    pub largest_error: Option<f64>,
    /// The number of wrong verdicts.
    pub wrong: usize,
    /// The number of frames without a verdict.
    pub undecided: usize,
    /// The number of frames with a certified reference.
    pub frames: usize,
    /// The median of the iterations.
    pub iterations: usize,
    /// Whether this entry is on the Pareto front: it has no wrong verdict, and no other entry without a wrong verdict
    /// is better in time or in `total_error` and at least equal in the other of the two.
    pub best: bool,
}

/// Returns the middle value of a list; of two middle values, the larger one. Returns `None` for an empty list.
fn median(mut list: Vec<f64>) -> Option<f64> {
    list.sort_by(f64::total_cmp);
    list.get(list.len() / 2).copied()
}

/// Summarises a study over all its frames. Returns one entry for each combination of method and tolerance, in the
/// order of the runs.
///
/// The time of a frame is divided by the time of the method `standard` on the same frame, at the tolerance nearest to
/// the default. Large frames therefore do not dominate small ones.
pub fn summary(study: &Study) -> Vec<Summary> {
    let Some(first) = study.cases.first() else {
        return Vec::new();
    };
    let base: Vec<f64> = study
        .cases
        .iter()
        .map(|case| {
            let standard = case.runs.iter().filter(|r| r.method == Method::Level(Accuracy::Standard));
            let far = |r: &&Run| libm::log10(r.tolerance / TOLERANCE).abs();
            standard.min_by(|a, b| far(a).total_cmp(&far(b))).map_or(1.0, |r| r.seconds).max(1e-9)
        })
        .collect();
    let mut lines: Vec<Summary> = (0..first.runs.len())
        .map(|k| {
            let runs = || study.cases.iter().map(move |case| &case.runs[k]);
            let count = |mark: Mark| runs().filter(|r| r.mark == mark).count();
            let worst = |of: fn(&Run) -> Option<f64>| runs().filter_map(of).reduce(f64::max);
            let times = runs().zip(&base).map(|(r, base)| r.seconds / base);
            let iterations = runs().map(|r| r.outcome.iterations as f64);
            Summary {
                method: first.runs[k].method,
                tolerance: first.runs[k].tolerance,
                time: median(times.collect()).unwrap_or(1.0),
                total_error: worst(|r| r.total_error),
                median_error: median(runs().filter_map(|r| r.total_error).collect()),
                largest_error: worst(|r| r.largest_error),
                wrong: count(Mark::Wrong),
                undecided: count(Mark::Undecided),
                frames: study.cases.len() - count(Mark::Unknown),
                iterations: median(iterations.collect()).unwrap_or(0.0) as usize,
                best: false,
            }
        })
        .collect();
    let without_errors: Vec<(f64, f64)> =
        lines.iter().filter(|l| l.wrong == 0).filter_map(|l| l.total_error.map(|e| (l.time, e))).collect();
    for line in &mut lines {
        line.best = line.wrong == 0
            && line.total_error.is_some_and(|error| {
                !without_errors.iter().any(|(t, e)| (*t < line.time && *e <= error) || (*t <= line.time && *e < error))
            });
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_value() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(Vec::new()), None);
    }
}
