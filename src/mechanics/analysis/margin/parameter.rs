//! Computes the interval of values at which a component stands, for each parameter: friction, tilt, loads, kernel,
//! robot limits.

use super::interval::Interval;
use super::kind::{MarginKind, MarginKinds};
use super::linear::{linear, robots};
use super::margins::Margins;
use super::search::{Path, Predictor};
use super::threshold::threshold;
use super::trial::{LimitChange, Setting, Trial};
use super::{ComponentIntervals, tilt};

/// Returns the intervals of all requested parameters of a component. `stands` is true if the unchanged component
/// stands. `with_tilt` is true if the tilt is requested and the whole frame stands; only then are the tilts around 0
/// computed.
pub(super) fn intervals(trial: &mut Trial, stands: bool, kinds: MarginKinds, with_tilt: bool) -> ComponentIntervals {
    let robots = if kinds.has(MarginKind::Robots) { robots(trial, stands) } else { Vec::new() };
    // The interval of tilts may follow from the horizontal load, so compute the horizontal load if either of the two
    // margins is requested.
    let horizontal = [MarginKind::HorizontalLoad, MarginKind::Tilt];
    let horizontal_load = horizontal.iter().any(|kind| kinds.has(*kind)).then(|| horizontal_load(trial, stands));
    let tilt = horizontal_load.as_ref().filter(|_| with_tilt);
    let tilt = tilt.map(|horizontal| tilt::around_present(trial, horizontal));
    ComponentIntervals {
        friction: kinds.has(MarginKind::Friction).then(|| friction(trial)),
        tilt,
        horizontal_load,
        kernel: kinds.has(MarginKind::Kernel).then(|| kernel(trial)),
        load_factor: (kinds.has(MarginKind::LoadFactor) && trial.has_factored_loads())
            .then(|| load_factor(trial, stands)),
        robots,
    }
}

fn friction(trial: &mut Trial) -> Interval {
    let setting = |mu: f64| Setting { friction: Some(mu), ..Setting::default() };
    threshold(trial, &setting, Margins::MAX_FRICTION, -1.0)
}

fn kernel(trial: &mut Trial) -> Interval {
    let setting = |kernel: f64| Setting { kernel: Some(kernel), ..Setting::default() };
    threshold(trial, &setting, 1.0, 1.0)
}

fn horizontal_load(trial: &mut Trial, stands: bool) -> Interval {
    let line = Path {
        predictor: Predictor::Plane,
        setting: &|share| Setting { across: share, ..Setting::default() },
        min_value: f64::NEG_INFINITY,
        max_value: f64::INFINITY,
        typical_small: 1.0,
        typical_large: (1.0 / trial.weights_to_loads()).max(1.0),
        load_ratio: 1.0 / trial.weights_to_loads(),
    };
    let alone = |side: f64| Setting {
        along: 0.0,
        across: side,
        loads: 0.0,
        has_fixed_loads: false,
        limits: LimitChange::FiniteToZero,
        ..Setting::default()
    };
    linear(trial, &line, 0.0, stands, &alone)
}

fn load_factor(trial: &mut Trial, stands: bool) -> Interval {
    let line = Path {
        predictor: Predictor::Plane,
        setting: &|factor| Setting { loads: factor, ..Setting::default() },
        min_value: 0.0,
        max_value: f64::INFINITY,
        typical_small: trial.weights_to_loads().min(1.0),
        typical_large: trial.weights_to_loads().max(1.0),
        load_ratio: trial.weights_to_loads(),
    };
    let alone = |side: f64| Setting {
        along: 0.0,
        loads: side,
        has_fixed_loads: false,
        limits: LimitChange::FiniteToZero,
        ..Setting::default()
    };
    linear(trial, &line, 1.0, stands, &alone)
}
