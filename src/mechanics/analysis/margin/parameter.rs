//! The intervals of values at which a component stands, for each parameter: friction, tilt, loads, kernel, robot limits.
//!
//! For a parameter in which the loads are linear ([`linear`]):
//!
//! 1. If the component falls at the present value, find the nearest value at which it stands ([`Path::nearest`]).
//! 2. From a value at which it stands, find the end in each direction ([`end`]): one linear program, confirmed by
//!    verdicts.
//!
//! Changed gravity has two components: one along the original direction and one across it. If only weights act and no
//! robot has a finite limit, the stable directions of gravity form a cone, and the tilts follow from the interval of
//! horizontal loads. Otherwise they are searched.
//!
//! [`robots`]: computes the values of each robot limit at which a component stands. Each limit is changed alone. If a
//! component stands with several limits set to 0 at once, it stands with each of them set to 0 alone, because larger
//! limits admit more forces. In the same way, a component that falls with several limits removed falls with each of them
//! removed alone, by the same motion. One verdict therefore settles a whole group of limits that do not matter. A group
//! that one verdict does not settle is halved. If k of n limits matter, this takes about k·log₂(n/k) verdicts, and k
//! searches.

use super::interval::{End, Interval};
use super::kind::{MarginKind, MarginKinds};
use super::margins::{Margin, Margins};
use super::path::{MAX_VALUE, Path, Predictor};
use super::search::Bracket;
use super::threshold::threshold;
use super::trial::{LimitChange, Setting, Trial, has_factored_loads};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::Forces;
use crate::mechanics::solve::{
    ExtremeValue, Limit, largest_factor, largest_factor_fast, least_grip_limit, nearest_factor,
};
use crate::mechanics::statics::assembly::Assembly;

/// Returns the requested margins of a component. `stands` is true if the unchanged component stands. `with_tilt` is true
/// if the tilt is requested and the whole frame stands; only then are the tilts around 0 computed.
pub(super) fn margins(trial: &mut Trial, stands: bool, kinds: MarginKinds, with_tilt: bool) -> Margins {
    use MarginKind::{HorizontalLoad, Tilt};
    let is_asked = kinds.has(MarginKind::Robots) && trial.holds().len() <= MAX_ROBOTS;
    let robots = if is_asked { robots(trial, stands) } else { Vec::new() };
    let mut each: Vec<Margin> = Vec::new();
    // The interval of tilts may follow from the horizontal load, so compute the horizontal load if either of the two
    // margins is requested.
    if kinds.has(HorizontalLoad) || kinds.has(Tilt) {
        let interval = linear(trial, &HorizontalLoad.path(trial), 0.0, stands);
        if with_tilt {
            each.push(Margin::new(Tilt, None, tilts_around_present(trial, &interval)));
        }
        each.push(Margin::new(HorizontalLoad, None, interval));
    }
    for kind in MarginKind::of_frame().filter(|kind| kinds.has(*kind) && !kind.is_signed()) {
        let about = kind.about();
        if let Some(structure) = about.structure {
            each.push(Margin::new(kind, None, of_structure(trial, kind, structure)));
            continue;
        }
        if about.applies.is_some_and(|applies| !applies(trial.component())) {
            continue;
        }
        let path = kind.path(trial);
        // With one friction coefficient, a factor on the friction is the coefficient in another unit.
        let known = trial.only_friction().filter(|mu| kind == MarginKind::FrictionFactor && *mu > 0.0);
        let known = known.and_then(|mu| Some((mu, each.iter().find(|own| own.kind == MarginKind::Friction)?)));
        let interval = match (known, about.present) {
            (Some((mu, own)), _) => own.interval.scaled(1.0 / mu),
            (_, Some(present)) if path.predictor == Predictor::Plane => linear(trial, &path, present, stands),
            _ => threshold(trial, &path, if about.ends[1] { 1.0 } else { -1.0 }),
        };
        each.push(Margin::new(kind, None, interval));
    }
    each.extend(robots);
    Margins { kinds, each, notes: Vec::new() }
}

/// Returns the interval of the load factor of a changed structure with the loads of a component. Without loads, it stands at
/// every factor or at none.
fn of_structure(trial: &mut Trial, kind: MarginKind, structure: fn(Assembly) -> Assembly) -> Interval {
    let changed = structure(trial.component().clone());
    let mut own = Trial::new(&changed, None);
    let (verdict, motion) = own.decide(&Setting::default());
    let path = kind.path(&own);
    let interval = match has_factored_loads(&changed) {
        true => linear(&mut own, &path, 1.0, verdict == Verdict::Stable),
        false => Interval::of_verdict(verdict, &motion, Interval::FROM_ZERO),
    };
    trial.decided_count += own.decided_count;
    interval
}

/// Returns the largest load factor with which a component stands. `unloaded` balance it with a load factor of 0.
pub(in crate::mechanics::analysis) fn largest_load_factor(component: &Assembly, unloaded: &Forces) -> End {
    let mut trial = Trial::new(component, Some(unloaded));
    let path = MarginKind::LoadFactor.path(&trial);
    end(&mut trial, &path, 0.0, 1.0, Some(0.0), largest_factor_fast)
}

/// Returns the interval of tilts around 0, in degrees, at which a component stands. It must stand at tilt 0.
/// `horizontal` is its interval of horizontal loads.
fn tilts_around_present(trial: &mut Trial, horizontal: &Interval) -> Interval {
    match horizontal {
        Interval::Between { low, high } if !trial.is_loaded() && !trial.is_limited() => {
            let low = limit_of_weights(trial, -1.0, low);
            let high = limit_of_weights(trial, 1.0, high);
            // The stable directions of gravity form a convex cone. A cone that reaches half a turn on one side, but not
            // on the other, is a half-plane: it ends at half a turn, where the mechanism of the other end begins.
            let half_turn = |side: f64, other: &End| match other {
                End::Unbounded => End::Unbounded,
                End::At { mechanism, .. } => End::At { value: side * 180.0, mechanism: mechanism.clone() },
                End::Unconfirmed { beyond, .. } => {
                    End::Unconfirmed { stands: side * 180.0, beyond: beyond + side * 360.0 }
                }
            };
            match (low, high) {
                (End::Unbounded, high) => Interval::Between { low: half_turn(-1.0, &high), high },
                (low, End::Unbounded) => Interval::Between { high: half_turn(1.0, &low), low },
                (low, high) => Interval::Between { low, high },
            }
        }
        _ => tilts_around(trial, 0.0),
    }
}

/// Returns the interval of tilts, in degrees, at which a component stands, around the tilt `from`. It must stand at
/// `from`.
pub(super) fn tilts_around(trial: &mut Trial, from: f64) -> Interval {
    let [low, high] = [-1.0, 1.0].map(|outward| {
        let whole = MarginKind::Tilt.path(trial);
        let to = from + outward * 360.0;
        let path = Path { min_value: from.min(to), max_value: from.max(to), ..whole };
        path.search(trial, Bracket { inside: from, beyond: None }, outward, None)
    });
    Interval::Between { low, high }
}

/// Returns the largest tilt on one side (`side` is −1 or 1), for a component with only weights and no finite robot
/// limits. Up to 90°, the tangent of this tilt is the largest horizontal load. Beyond 90°, a second linear program
/// gives the largest upward fraction of the weights, whose arctangent is added to 90°.
fn limit_of_weights(trial: &mut Trial, side: f64, horizontal: &End) -> End {
    let tilt = |share: f64| libm::atan(share).to_degrees();
    match horizontal {
        End::At { value, mechanism } => End::At { value: tilt(*value), mechanism: mechanism.clone() },
        End::Unconfirmed { stands, beyond } => End::Unconfirmed { stands: tilt(*stands), beyond: tilt(*beyond) },
        End::Unbounded => {
            let upward = move |share: f64| Setting { along: -share, across: side, ..Setting::default() };
            match linear(trial, &Path::new(Predictor::Plane, upward), 0.0, true) {
                Interval::Between { high: End::At { value, mechanism }, .. } => {
                    End::At { value: side * (90.0 + tilt(value)), mechanism }
                }
                Interval::Between { high: End::Unbounded, .. } => End::Unbounded,
                _ => End::Unconfirmed { stands: side * 90.0, beyond: side * 180.0 },
            }
        }
    }
}

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
/// `stands` is true if the component stands at the value `present`.
fn linear(trial: &mut Trial, line: &Path, present: f64, stands: bool) -> Interval {
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
                end(trial, line, start.value, outward, base, largest_factor)
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
    trial.cache_extreme(&program, &found, beyond, &line.setting, None);
    // Verdicts confirm the predicted value.
    let facing_end = matches!(found.limit, Limit::At(_)).then_some(at);
    Ok(Start { value: line.nearest(std::slice::from_mut(trial), present, facing_end)?, facing_end })
}

/// Finds the end of the interval in the direction `outward` from `start`, a value at which the component stands. `base`
/// is the current value if the component stands there, otherwise `None`. `largest_factor` solves the linear program.
fn end(
    trial: &mut Trial,
    line: &Path,
    start: f64,
    outward: f64,
    base: Option<f64>,
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
        Limit::Unbounded if trial.decide(&line.grown_alone(outward)).0 == Verdict::Stable => End::Unbounded,
        Limit::At(change) => {
            let at = (start + step * change).max(line.min_value);
            let around = line.test_values(at, outward);
            trial.cache_extreme(&program, &found, around, &line.setting, base);
            line.end(trial, start, outward, Some(at))
        }
        // The program finds no balancing forces at the start. The component stands there only within the tolerance of
        // the proof, so the start is also the end.
        Limit::Infeasible => line.end(trial, start, outward, Some(start)),
        // The program failed, or its result (unbounded) was not confirmed. Search for the end by verdicts only.
        _ => line.end(trial, start, outward, None),
    }
}

/// The limits of more robots that hold one component are not examined: their time grows with the square of this number.
pub(in crate::mechanics::analysis) const MAX_ROBOTS: usize = 2000;

/// The least number of limits that are tried as a group. The three limits of two robots are found sooner one by one.
const MIN_GROUP: usize = 8;

/// Returns the margins of the limits of each robot that holds a body, in the order of the grips. `stands` is true if
/// the component stands with the limits of the scene.
fn robots(trial: &mut Trial, stands: bool) -> Vec<Margin> {
    let robots = trial.holds();
    let mut found = Vec::with_capacity(3 * robots.len());
    group(trial, [0, 3 * robots.len()], stands, &mut found);
    let margin = |(k, interval)| Margin::new(MarginKind::Robots, Some((robots[k / 3], k % 3)), interval);
    found.into_iter().enumerate().map(margin).collect()
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
        (verdict == Verdict::Stable).then_some(Interval::FROM_ZERO)
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
    let setting = move |value: f64| Setting {
        limits: LimitChange::Replace { first: 3 * grip + component, end: 3 * grip + component + 1, value },
        ..Setting::default()
    };
    let program = trial.program(&Setting::default());
    let mut unit = program.scale.force;
    if component == 2 {
        unit *= program.scale.length;
    }
    let typical = unit * Scale::HEAVIEST;
    let line = Path { typical_small: typical, typical_large: typical, ..Path::new(Predictor::Plane, setting) };
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
    let start = enough.min(MAX_VALUE * line.typical_large);
    Interval::Between { low: line.end(trial, start, -1.0, hint), high: End::Unbounded }
}
