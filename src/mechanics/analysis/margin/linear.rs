//! The interval of a parameter in which the loads are linear.
//!
//! 1. Where the component falls at the present value, find the nearest value at which it stands ([`nearest_start`]).
//! 2. From a value at which it stands, find the end in each direction ([`end`]): one linear program, confirmed by verdicts.

use super::interval::{End, Interval};
use super::line::Line;
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::solve::{Limit, largest_factor, nearest_factor};

/// A value at which the component stands.
struct Start {
    value: f64,
    /// Where the linear program put the end that faces the present value; `None` if the component stands there.
    facing_end: Option<f64>,
}

/// The interval of a parameter in which the loads are linear.
///
/// `stands` is whether the component stands at `present`. `alone` has only the loads that grow in one direction: if contacts
/// and unlimited robots carry these loads, the interval has no end in that direction.
pub(super) fn linear(
    trial: &mut Trial,
    line: &Line,
    present: f64,
    stands: bool,
    alone: &dyn Fn(f64) -> Setting,
) -> Interval {
    let start = if stands {
        Start {
            value: present,
            facing_end: None,
        }
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
    Interval::Between { low, high }
}

/// The value nearest to the present one at which the component stands. The error is the interval if no such value is found.
fn nearest_start(trial: &mut Trial, line: &Line, present: f64) -> Result<Start, Interval> {
    // The linear program says where the value is.
    let (program, toward) =
        trial.direction(&(line.setting)(present), &(line.setting)(present + 1.0));
    let found = nearest_factor(&program, &toward);
    let at = match found.limit {
        Limit::At(change) => (present + change).max(line.least),
        _ => present,
    };
    // Its forces and its motion often prove the verdicts that follow. A motion that no value stops moves at the present one.
    let toward_present = (present - at).signum();
    let beyond = match found.limit {
        Limit::Never => [present; 3],
        _ => line.around(at, toward_present),
    };
    trial.learn_edge(&program, &found, beyond, line.setting, None);
    // Verdicts confirm it.
    let facing_end = matches!(found.limit, Limit::At(_)).then_some(at);
    Ok(Start {
        value: line.nearest(trial, present, facing_end)?,
        facing_end,
    })
}

/// The end in one direction, seen from `start`, at which the component stands. `base` is the value at which the component is
/// as given, if it stands there.
fn end(
    trial: &mut Trial,
    line: &Line,
    start: f64,
    outward: f64,
    base: Option<f64>,
    alone: &dyn Fn(f64) -> Setting,
) -> End {
    // The least value that has a meaning: one verdict, no linear program.
    if outward < 0.0
        && line.least.is_finite()
        && trial.judge(&(line.setting)(line.least)).0 == Verdict::Stable
    {
        return End::natural(line.least);
    }
    let (program, toward) =
        trial.direction(&(line.setting)(start), &(line.setting)(start + outward));
    let found = largest_factor(&program, &toward);
    match found.limit {
        Limit::Unbounded if trial.judge(&alone(outward)).0 == Verdict::Stable => End::Unbounded,
        Limit::At(change) => {
            let at = (start + outward * change).max(line.least);
            let around = line.around(at, outward);
            trial.learn_edge(&program, &found, around, line.setting, base);
            line.end(trial, start, outward, Some(at))
        }
        // It stands within the proof's tolerance and not beyond it: the start is the end.
        Limit::Never => line.end(trial, start, outward, Some(start)),
        // The program was not solved, or its unbounded ray could not be confirmed: verdicts alone search the end.
        _ => line.end(trial, start, outward, None),
    }
}
