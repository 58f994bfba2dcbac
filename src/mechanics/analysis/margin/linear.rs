//! Computes the interval of a parameter in which the loads are linear.
//!
//! 1. If the component falls at the present value, find the nearest value at which it stands ([`nearest_start`]).
//! 2. From a value at which it stands, find the end in each direction ([`end`]): one linear program, confirmed by verdicts.

use super::interval::{End, Interval};
use super::line::Line;
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::solve::{Limit, largest_factor, nearest_factor};

/// A value at which the component stands.
struct Start {
    value: f64,
    /// The end on the side of the present value, according to the linear program; `None` if the component stands
    /// there.
    facing_end: Option<f64>,
}

/// Returns the interval of a parameter in which the loads are linear.
///
/// `stands` is true if the component stands at `present`. `alone` returns the component with only the loads that grow
/// in one direction. If contacts and unlimited robots carry these loads, the interval has no end in that direction.
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

/// Finds the value nearest to `present` at which the component stands. The error is the interval if no such value is
/// found.
fn nearest_start(trial: &mut Trial, line: &Line, present: f64) -> Result<Start, Interval> {
    // A linear program predicts the value.
    let (program, toward) = trial.direction(
        &(line.setting)(present),
        &(line.setting)(present + line.reach),
    );
    let found = nearest_factor(&program, &toward);
    let at = match found.limit {
        Limit::At(change) => (present + change * line.reach).max(line.least),
        _ => present,
    };
    // Cache the forces and the motion of this program, because they often prove later verdicts. If the component stands
    // at no value, the motion belongs to the present value.
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

/// Finds the end in the direction `outward` from `start`, a value at which the component stands. `base` is the
/// present value, if the component stands there.
fn end(
    trial: &mut Trial,
    line: &Line,
    start: f64,
    outward: f64,
    base: Option<f64>,
    alone: &dyn Fn(f64) -> Setting,
) -> End {
    // If the component stands at the least meaningful value, the end is there. This needs no linear program.
    if outward < 0.0
        && line.least.is_finite()
        && trial.judge(&(line.setting)(line.least)).0 == Verdict::Stable
    {
        return End::natural(line.least);
    }
    let step = outward * line.reach;
    let (program, toward) = trial.direction(&(line.setting)(start), &(line.setting)(start + step));
    let found = largest_factor(&program, &toward);
    match found.limit {
        Limit::Unbounded if trial.judge(&alone(outward)).0 == Verdict::Stable => End::Unbounded,
        Limit::At(change) => {
            let at = (start + step * change).max(line.least);
            let around = line.around(at, outward);
            trial.learn_edge(&program, &found, around, line.setting, base);
            line.end(trial, start, outward, Some(at))
        }
        // The component stands only within the proof's tolerance, so the start is the end.
        Limit::Never => line.end(trial, start, outward, Some(start)),
        // The program was not solved, or its unbounded ray could not be confirmed: search the end by verdicts alone.
        _ => line.end(trial, start, outward, None),
    }
}
