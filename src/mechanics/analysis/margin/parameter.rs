//! Computes the interval of values at which a component stands, for each parameter: friction, tilt, loads, kernel,
//! robot limits.

use super::edge::Threshold;
use super::interval::{End, Interval, RobotIntervals};
use super::kind::{MarginKind, MarginKinds};
use super::line::Line;
use super::linear::linear;
use super::margins::Margins;
use super::trial::{LimitChange, Setting, Trial};
use super::{ComponentIntervals, tilt};
use crate::analysis::Verdict;
use crate::program::Scale;
use crate::solve::{Limit, least_grip_limit};

/// Returns the intervals of all requested parameters of a component. `stands` is true if the unchanged component
/// stands. `with_tilt` is true if its whole frame stands; only then are its tilts around 0 computed.
pub(super) fn intervals(
    trial: &mut Trial,
    stands: bool,
    kinds: MarginKinds,
    with_tilt: bool,
) -> ComponentIntervals {
    let grips = match kinds.has(MarginKind::Robots) {
        true => trial.holds(),
        false => Vec::new(),
    };
    let robots = grips.into_iter().enumerate().map(|(grip, robot)| {
        let [fx, fy, torque] = [0, 1, 2].map(|component| limit(trial, grip, component, stands));
        RobotIntervals {
            robot,
            fx,
            fy,
            torque,
        }
    });
    let robots = robots.collect();
    // The interval of tilts may follow from the horizontal load, so compute the horizontal load for both margins.
    let horizontal = [MarginKind::HorizontalLoad, MarginKind::Tilt];
    let horizontal_load = horizontal
        .iter()
        .any(|kind| kinds.has(*kind))
        .then(|| horizontal_load(trial, stands));
    let tilt = horizontal_load.as_ref().filter(|_| with_tilt);
    let tilt = tilt.map(|horizontal| tilt::around_present(trial, horizontal));
    ComponentIntervals {
        friction: kinds.has(MarginKind::Friction).then(|| friction(trial)),
        tilt,
        horizontal_load,
        kernel: kinds.has(MarginKind::Kernel).then(|| kernel(trial)),
        load_factor: (kinds.has(MarginKind::LoadFactor) && trial.is_loaded())
            .then(|| load_factor(trial, stands)),
        robots,
    }
}

fn friction(trial: &mut Trial) -> Interval {
    let setting = |mu: f64| Setting {
        friction: Some(mu),
        ..Setting::default()
    };
    Threshold::smallest_stable(Margins::MOST_FRICTION).search(trial, &setting)
}

fn kernel(trial: &mut Trial) -> Interval {
    let setting = |kernel: f64| Setting {
        kernel: Some(kernel),
        ..Setting::default()
    };
    Threshold::largest_stable(1.0).search(trial, &setting)
}

fn horizontal_load(trial: &mut Trial, stands: bool) -> Interval {
    let line = Line {
        setting: &|share| Setting {
            across: share,
            ..Setting::default()
        },
        min_value: f64::NEG_INFINITY,
        typical_small: 1.0,
        typical_large: (1.0 / trial.weights_to_loads()).max(1.0),
    };
    let alone = |side: f64| Setting {
        along: 0.0,
        across: side,
        loads: 0.0,
        limits: LimitChange::FiniteToZero,
        ..Setting::default()
    };
    linear(trial, &line, 0.0, stands, &alone)
}

fn load_factor(trial: &mut Trial, stands: bool) -> Interval {
    let line = Line {
        setting: &|factor| Setting {
            loads: factor,
            ..Setting::default()
        },
        min_value: 0.0,
        typical_small: trial.weights_to_loads().min(1.0),
        typical_large: trial.weights_to_loads().max(1.0),
    };
    let alone = |side: f64| Setting {
        along: 0.0,
        loads: side,
        limits: LimitChange::FiniteToZero,
        ..Setting::default()
    };
    linear(trial, &line, 1.0, stands, &alone)
}

/// Returns the values of one robot limit at which the component stands, in N or N·m. `component` selects the limit: 0
/// is force x, 1 is force y, 2 is the torque. `stands` is true if the component stands with the limits of the scene.
fn limit(trial: &mut Trial, grip: usize, component: usize, stands: bool) -> Interval {
    let setting = |value: f64| Setting {
        limits: LimitChange::Replace {
            grip,
            component,
            value,
        },
        ..Setting::default()
    };
    let program = trial.program(&Setting::default());
    let mut unit = program.scale.force;
    if component == 2 {
        unit *= program.scale.length;
    }
    let line = Line {
        setting: &setting,
        min_value: 0.0,
        typical_small: unit * Scale::HEAVIEST,
        typical_large: unit * Scale::HEAVIEST,
    };
    // If the component stands, the limit in the scene is sufficient, and the search starts there.
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
    Interval::Between {
        low: line.end(trial, line.finite_start(enough), -1.0, hint),
        high: End::Unbounded,
    }
}
