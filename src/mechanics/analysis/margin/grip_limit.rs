//! [`robots`]: computes the values of each robot limit at which a component stands.
//!
//! Each limit is changed alone. If a component stands with several limits set to 0 at once, it stands with each of them
//! set to 0 alone, because larger limits admit more forces. In the same way, a component that falls with several limits
//! removed falls with each of them removed alone, by the same motion. One verdict therefore settles a whole group of
//! limits that do not matter. A group that one verdict does not settle is halved. If k of n limits matter, this takes
//! about k·log₂(n/k) verdicts, and k searches.

use super::interval::{End, Interval, RobotIntervals};
use super::search::{Path, Predictor};
use super::trial::{LimitChange, Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::Scale;
use crate::mechanics::solve::{Limit, least_grip_limit};

/// The least number of limits that are tried as a group. The three limits of two robots are found sooner one by one.
const MIN_GROUP: usize = 8;

/// Returns the intervals of the limits of each robot that holds a body, in the order of the grips. `stands` is true if
/// the component stands with the limits of the scene.
pub(super) fn robots(trial: &mut Trial, stands: bool) -> Vec<RobotIntervals> {
    let robots = trial.holds();
    let mut found = Vec::with_capacity(3 * robots.len());
    group(trial, [0, 3 * robots.len()], stands, &mut found);
    let mut found = found.into_iter();
    let of_robot = |robot| {
        let (fx, fy, torque) = (found.next()?, found.next()?, found.next()?);
        Some(RobotIntervals { robot, fx, fy, torque })
    };
    robots.into_iter().filter_map(of_robot).collect()
}

/// Computes, for each robot limit with an index in `first..end`, the values of this limit at which the component
/// stands, and appends the intervals to `found`. Limits 3g, 3g + 1 and 3g + 2 are those of
/// force x, force y and torque of grip g. `stands` is true if the component stands with the limits of the scene.
fn group(trial: &mut Trial, [first, end]: [usize; 2], stands: bool, found: &mut Vec<Interval>) {
    let count = end - first;
    if count < MIN_GROUP {
        let alone = (first..end).map(|k| limit(trial, k / 3, k % 3, stands));
        found.extend(alone);
        return;
    }
    let setting = |value: f64| Setting { limits: LimitChange::Replace { first, end, value }, ..Setting::default() };
    let settled = match stands {
        true => {
            let verdict = trial.decide(&setting(0.0)).0;
            (verdict == Verdict::Stable).then(|| Interval::Between { low: End::natural(0.0), high: End::Unbounded })
        }
        false => match trial.decide(&setting(f64::INFINITY)) {
            (Verdict::Unstable, motion) => Some(Interval::excluded_by(motion)),
            _ => None,
        },
    };
    match settled {
        Some(interval) => found.extend(std::iter::repeat_n(interval, count)),
        None => {
            let middle = first + count / 2;
            group(trial, [first, middle], stands, found);
            group(trial, [middle, end], stands, found);
        }
    }
}

/// Returns the values of one robot limit at which the component stands, in N or N·m. `component` selects the limit: 0
/// is force x, 1 is force y, 2 is the torque. `stands` is true if the component stands with the limits of the scene.
fn limit(trial: &mut Trial, grip: usize, component: usize, stands: bool) -> Interval {
    let setting = |value: f64| Setting {
        limits: LimitChange::Replace { first: 3 * grip + component, end: 3 * grip + component + 1, value },
        ..Setting::default()
    };
    let program = trial.program(&Setting::default());
    let mut unit = program.scale.force;
    if component == 2 {
        unit *= program.scale.length;
    }
    let line = Path {
        predictor: Predictor::Plane,
        setting: &setting,
        min_value: 0.0,
        max_value: f64::INFINITY,
        typical_small: unit * Scale::HEAVIEST,
        typical_large: unit * Scale::HEAVIEST,
        load_ratio: 0.0,
    };
    // If the component stands, the limit in the scene is sufficient, and the search starts there. Otherwise the
    // search starts at an infinite limit, if the component stands with it.
    let given = program.grips[grip].limits[component] * unit;
    if !stands {
        match trial.decide(&setting(f64::INFINITY)) {
            (Verdict::Stable, _) => {}
            (Verdict::Unstable, motion) => return Interval::excluded_by(motion),
            (Verdict::Undecided, _) => return Interval::Undecided,
        }
    }
    let enough = if stands { given } else { f64::INFINITY };
    // A linear program gives the smallest sufficient limit. Verdicts then confirm it.
    let found = least_grip_limit(&program, grip, component);
    let hint = match found.limit {
        Limit::At(at) => {
            let at = at * unit;
            trial.cache_extreme(&program, &found, line.test_values(at, -1.0), &setting, None);
            Some(at)
        }
        _ => None,
    };
    Interval::Between { low: line.end(trial, line.finite_start(enough), -1.0, hint), high: End::Unbounded }
}
