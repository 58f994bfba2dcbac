//! Computes the values of a parameter between which a component stands, if its loads are linear in the parameter.
//!
//! 1. If the component falls at the current value, find the nearest value at which it stands ([`nearest_start`]).
//! 2. From a value at which it stands, find the end in each direction ([`end`]): one linear program, confirmed by
//!    verdicts.

use super::interval::{End, Interval};
use super::search::Path;
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::solve::{Limit, largest_factor, nearest_factor};

/// A value at which the component stands.
struct Start {
    value: f64,
    /// The end of the interval that faces the current value, according to the linear program. `None` if the component
    /// stands at the current value, or if the program found no end.
    facing_end: Option<f64>,
}

/// Returns the interval of values of a parameter at which a component stands. The loads must be linear in the
/// parameter.
///
/// `stands` is true if the component stands at the value `present`. `alone(±1)` leaves only the loads that grow in the
/// direction of larger (1) or smaller (−1) values. The interval is unbounded in this direction only if the component
/// stands with these loads alone.
pub(super) fn linear(
    trial: &mut Trial,
    line: &Path,
    present: f64,
    stands: bool,
    alone: &dyn Fn(f64) -> Setting,
) -> Interval {
    let start = if stands {
        Start { value: present, facing_end: None }
    } else {
        match nearest_start(trial, line, present) {
            Ok(start) => start,
            Err(interval) => return interval,
        }
    };
    let [low, high] = [-1.0, 1.0].map(|outward| {
        let faces_present = (present - start.value) * outward > 0.0;
        match start.facing_end.filter(|_| faces_present) {
            Some(hint) => line.end(trial, start.value, outward, Some(hint)),
            None => {
                let base = stands.then_some(present);
                end(trial, line, start.value, outward, base, alone)
            }
        }
    });
    match (low, high) {
        // The component stands at one value only, and rounding exchanged the ends.
        (End::At { value: low, mechanism: below }, End::At { value: high, mechanism: above }) if low > high => {
            Interval::Between {
                low: End::At { value: start.value, mechanism: below },
                high: End::At { value: start.value, mechanism: above },
            }
        }
        (low, high) => Interval::Between { low, high },
    }
}

/// Finds the value nearest to `present` at which the component stands. If no such value is found, the `Err` contains
/// the interval: empty or undecided.
fn nearest_start(trial: &mut Trial, line: &Path, present: f64) -> Result<Start, Interval> {
    // A linear program predicts the nearest value.
    let (program, toward) = trial.direction(&(line.setting)(present), &(line.setting)(present + line.typical_large));
    let found = nearest_factor(&program, &toward);
    let at = match found.limit {
        Limit::At(change) => (present + change * line.typical_large).max(line.min_value),
        _ => present,
    };
    // Add the forces and the motion of this program to the cache: they often prove later verdicts. If the component
    // stands at no value, the motion proves the fall at `present`.
    let toward_present = (present - at).signum();
    let beyond = match found.limit {
        Limit::Infeasible => [present; 3],
        _ => line.test_values(at, toward_present),
    };
    trial.cache_extreme(&program, &found, beyond, line.setting, None);
    // Verdicts confirm the predicted value.
    let facing_end = matches!(found.limit, Limit::At(_)).then_some(at);
    Ok(Start { value: line.nearest(trial, present, facing_end)?, facing_end })
}

/// Finds the end of the interval in the direction `outward` from `start`, a value at which the component stands. `base`
/// is the current value if the component stands there, otherwise `None`.
fn end(
    trial: &mut Trial,
    line: &Path,
    start: f64,
    outward: f64,
    base: Option<f64>,
    alone: &dyn Fn(f64) -> Setting,
) -> End {
    // If the component stands at the smallest possible value, the interval ends there. This needs no linear program.
    if outward < 0.0 && line.min_value.is_finite() && trial.decide(&(line.setting)(line.min_value)).0 == Verdict::Stable
    {
        return End::natural(line.min_value);
    }
    let step = outward * line.typical_large;
    let (program, toward) = trial.direction(&(line.setting)(start), &(line.setting)(start + step));
    let found = largest_factor(&program, &toward);
    match found.limit {
        Limit::Unbounded if trial.decide(&alone(outward)).0 == Verdict::Stable => End::Unbounded,
        Limit::At(change) => {
            let at = (start + step * change).max(line.min_value);
            let around = line.test_values(at, outward);
            trial.cache_extreme(&program, &found, around, line.setting, base);
            line.end(trial, start, outward, Some(at))
        }
        // The program finds no balancing forces at the start. The component stands there only within the tolerance of
        // the proof, so the start is also the end.
        Limit::Infeasible => line.end(trial, start, outward, Some(start)),
        // The program failed, or its result (unbounded) was not confirmed. Search for the end by verdicts only.
        _ => line.end(trial, start, outward, None),
    }
}
