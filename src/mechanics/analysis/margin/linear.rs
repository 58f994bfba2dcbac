//! Computes the values of a parameter between which a component stands, if its loads are linear in the parameter.
//!
//! 1. If the component falls at the current value, find the nearest value at which it stands ([`nearest_start`]).
//! 2. From a value at which it stands, find the end in each direction ([`end`]): one linear program, confirmed by
//!    verdicts.
//!
//! [`robots`]: computes the values of each robot limit at which a component stands.
//!
//! Each limit is changed alone. If a component stands with several limits set to 0 at once, it stands with each of them
//! set to 0 alone, because larger limits admit more forces. In the same way, a component that falls with several limits
//! removed falls with each of them removed alone, by the same motion. One verdict therefore settles a whole group of
//! limits that do not matter. A group that one verdict does not settle is halved. If k of n limits matter, this takes
//! about k·log₂(n/k) verdicts, and k searches.

use super::interval::{End, Exclusion, Interval, RobotIntervals};
use super::search::{CONFIRMATION_TOL, END_TOL, ExcludedRange, MAX_STEPS, MAX_VALUE, OFFSET_GROWTH, Path, Predictor};
use super::trial::{LimitChange, Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::Motion;
use crate::mechanics::solve::{ExtremeValue, Limit, largest_factor, least_grip_limit, nearest_factor};

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
                end(trial, line, start.value, outward, base, alone, largest_factor)
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
/// is the current value if the component stands there, otherwise `None`. `largest_factor` solves the linear program.
pub(super) fn end(
    trial: &mut Trial,
    line: &Path,
    start: f64,
    outward: f64,
    base: Option<f64>,
    alone: &dyn Fn(f64) -> Setting,
    largest_factor: fn(&Program, &[f64]) -> ExtremeValue,
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
    let settled = if stands {
        let verdict = trial.decide(&setting(0.0)).0;
        (verdict == Verdict::Stable).then(|| Interval::Between { low: End::natural(0.0), high: End::Unbounded })
    } else {
        match trial.decide(&setting(f64::INFINITY)) {
            (Verdict::Unstable, motion) => Some(Interval::excluded_by(motion)),
            _ => None,
        }
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

impl Path<'_> {
    /// Finds the value nearest to `present` at which the component stands, although it falls at `present`. `hint` is
    /// this value according to a linear program. If no value is found, the `Err` contains the interval: empty if
    /// mechanisms exclude all values, otherwise undecided.
    fn nearest(&self, trial: &mut Trial, present: f64, hint: Option<f64>) -> Result<f64, Interval> {
        let (mut low, mut high) = (self.min_value, f64::INFINITY);
        // `below` excludes all values below `low`, and `above` excludes all values above `high`.
        let [mut below, mut above] = [None, None];
        let limit = MAX_VALUE * self.typical_large;
        let mut next = Some(present);
        let mut hinted = hint;
        for _ in 0..MAX_STEPS {
            let value = match next.take() {
                Some(value) => value,
                None => {
                    let within = |value: &f64| (low..=high).contains(value);
                    hinted.take().filter(within).unwrap_or(present.clamp(low, high))
                }
            };
            let found = self.decide_near(trial, value, [low, high]);
            match found {
                (Verdict::Stable, at, _) => return Ok(at),
                (Verdict::Undecided, ..) => return Err(Interval::Undecided),
                (Verdict::Unstable, at, motion) => match self.excluded_range(trial, at, &motion) {
                    ExcludedRange::All => return Err(Interval::excluded_by(motion)),
                    ExcludedRange::Above(bound) if bound.min(at) < high => {
                        high = bound.min(at);
                        above = Some(Exclusion::above(high, motion));
                    }
                    ExcludedRange::Below(bound) if bound.max(at) > low => {
                        low = bound.max(at);
                        below = Some(Exclusion::below(low, motion));
                    }
                    ExcludedRange::Above(_) | ExcludedRange::Below(_) => {}
                },
            }
            if low > high || low > limit || high < -limit {
                let excluded = [below, above].into_iter().flatten();
                return Err(Interval::Empty(excluded.collect()));
            }
        }
        Err(Interval::Undecided)
    }

    /// Returns the verdict at `value`. If it is undecided, tries values near it, between `low` and `high`. Also returns
    /// the value that the verdict belongs to, and the mechanism if the component falls there.
    fn decide_near(&self, trial: &mut Trial, value: f64, [low, high]: [f64; 2]) -> (Verdict, f64, Vec<Motion>) {
        let steps = std::iter::successors(Some(END_TOL), |step| Some(step * OFFSET_GROWTH))
            .take_while(|step| *step <= CONFIRMATION_TOL);
        let away = steps.flat_map(|step| [step, -step]).map(|step| value + step * self.size(value));
        let mut last = Vec::new();
        // If the range from `low` to `high` is hardly wider than rounding errors, it may contain none of the values to
        // try. Therefore also try its ends if they are near.
        let is_near = |end: &f64| (end - value).abs() <= END_TOL * self.size(value);
        let ends = [low, high].into_iter().filter(is_near);
        let away = away.filter(|at| (low..=high).contains(at));
        for at in std::iter::once(value).chain(away).chain(ends) {
            let (verdict, motion) = self.decide_at_limit(trial, at);
            if verdict != Verdict::Undecided {
                return (verdict, at, motion);
            }
            last = motion;
        }
        (Verdict::Undecided, value, last)
    }
}
