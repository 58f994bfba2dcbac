//! Computes the interval of values at which a component stands, for each parameter: friction, tilt, loads, kernel,
//! robot limits.

use super::interval::{End, Interval};
use super::kind::{MarginKind, MarginKinds};
use super::linear::{end, linear, robots};
use super::margins::Margins;
use super::search::{Path, Predictor};
use super::threshold::threshold;
use super::trial::{LimitChange, Setting, Trial};
use super::{ComponentIntervals, tilt};
use crate::mechanics::proof::Forces;
use crate::mechanics::solve::largest_factor_fast;
use crate::mechanics::statics::assembly::Assembly;

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

/// Calls `work` with the line of the load factor, and with the function that leaves only the loads that grow with it.
fn along_load_factor<T>(trial: &mut Trial, work: impl FnOnce(&mut Trial, &Path, &dyn Fn(f64) -> Setting) -> T) -> T {
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
    work(trial, &line, &alone)
}

fn load_factor(trial: &mut Trial, stands: bool) -> Interval {
    along_load_factor(trial, |trial, line, alone| linear(trial, line, 1.0, stands, alone))
}

/// Returns the largest load factor with which a component stands. `unloaded` balance it with a load factor of 0.
pub(in crate::mechanics::analysis) fn largest_load_factor(component: &Assembly, unloaded: &Forces) -> End {
    let mut trial = Trial::new(component, Some(unloaded));
    along_load_factor(&mut trial, |trial, line, alone| {
        end(trial, line, 0.0, 1.0, Some(0.0), alone, largest_factor_fast)
    })
}
