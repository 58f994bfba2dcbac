//! Intervals of scenes whose loads are far smaller or far larger than the weights.
//!
//! If the loads of a scene are a million times smaller, the ends of its load factor are a million times larger. So
//! the exact interval of the original scene gives that of the changed scene.

use drystone::Scene;
use drystone::analysis::{End, Interval, MarginKind};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::exact::{NONE, Problems, check_friction, check_kernel, check_tilt, exact_interval, is_borderline};
use super::random::random_scene;
use super::{analysed, known, near};
use crate::oracle::factor::Growing;
use crate::oracle::number_of;
use crate::random::Random;

/// The file with all its loads multiplied by a factor.
fn scaled(file: &Value, by: f64) -> Value {
    let mut changed = file.clone();
    for load in changed["loads"].as_array_mut().into_iter().flatten() {
        for axis in 0..2 {
            load["force"][axis] = json!(load["force"][axis].as_f64().expect("newtons") * by);
        }
        if let Some(torque) = load["torque"].as_f64() {
            load["torque"] = json!(torque * by);
        }
    }
    changed
}

/// The rounding error of an end, relative to the loads.
const ROUNDING: f64 = 1e-12;

/// Compares an interval with the exact interval. An end may lie inside the exact interval by up to `none`, the
/// tolerance of the verdicts in units of the parameter. Or it may be unconfirmed between two values that enclose the
/// exact end. If the scene itself is within the tolerance of its limit, its own value, `now`, may be the end: the frame
/// stands there.
fn compare_safely(
    name: &str,
    file: &Value,
    found: Option<&Interval>,
    exact: Option<[f64; 2]>,
    [none, rounding]: [f64; 2],
    now: f64,
) -> Option<String> {
    let wrong = || Some(format!("{name} {found:?}, exactly {exact:?}"));
    let (Some(Interval::Between { low, high }), Some(ends)) = (found, exact) else {
        let is_right = match (found, exact) {
            (Some(Interval::Empty(_)), None) => true,
            (Some(Interval::Empty(_)), Some([low, high])) => high - low <= none,
            // The scene is within the tolerance of its limit.
            (Some(_), _) => is_borderline(file),
            (None, _) => false,
        };
        return if is_right { None } else { wrong() };
    };
    let is_right = |end: &End, exact: f64, outward: f64| {
        let allowed = (1e-6 * exact.abs()).max(rounding);
        let is_inside = |value: f64, by: f64| (value - exact) * outward <= by;
        match end {
            End::Unbounded => exact == outward * f64::INFINITY,
            End::At { value, .. } if *value == now && is_borderline(file) => true,
            End::At { value, .. } => is_inside(*value, allowed) && !is_inside(*value, -none.max(allowed)),
            End::Unconfirmed { stands, beyond } => is_inside(*stands, allowed) && !is_inside(*beyond, -allowed),
            _ => false,
        }
    };
    let [least, most] = ends;
    let both = is_right(low, least, -1.0) && is_right(high, most, 1.0);
    if both { None } else { wrong() }
}

/// The errors in the intervals of a scene whose loads are multiplied by a power of two.
fn problems(number: u64) -> Vec<String> {
    let given = random_scene(number);
    let power = [-24, -20, -17, -12, 12, 20][number as usize % 6];
    let by = libm::ldexp(1.0, power);
    let file = scaled(&given, by);
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let found = analysed(&scene);
    let mut problems = Problems { has_band: true, ..Problems::default() };
    if !scene.loads().is_empty() {
        // The exact ends of the changed scene.
        let ordinary = |end: f64| end / by;
        let exact = exact_interval(&given, Growing::ListedLoads);
        let exact = exact.map(|ends| ends.map(ordinary));
        // The weights are up to 36 times the original loads.
        let band = [36.0 * NONE / by, ROUNDING / by];
        let wrong = compare_safely("load factor", &file, found.of(MarginKind::LoadFactor), exact, band, 1.0);
        problems.list.extend(wrong);
    }
    let (across, share) = (Growing::AcrossGravity, found.of(MarginKind::HorizontalLoad));
    // If the weights are far below the loads, the error is relative to the loads.
    let exact = exact_interval(&file, across);
    let band = if by > 1.0 { [NONE * by, ROUNDING * by] } else { [NONE; 2] };
    problems.list.extend(compare_safely("horizontal", &file, share, exact, band, 0.0));
    check_friction(&file, &found, &mut problems);
    check_kernel(&file, &found, &mut problems);
    check_tilt(&file, &found, &mut Random::new(number), &mut problems);
    problems.of(number, &file)
}

/// `DRYSTONE_INTERVAL_SLIGHT=600` sets the number of scenes.
#[test]
fn intervals_are_exact_if_loads_are_far_smaller_or_larger_than_weights() {
    let first = number_of("DRYSTONE_INTERVAL_FIRST", 0);
    let wanted = number_of("DRYSTONE_INTERVAL_SLIGHT", 36);
    let numbers = (first..first + wanted).into_par_iter();
    let found: Vec<String> = numbers.flat_map_iter(problems).collect();
    assert!(found.is_empty(), "{} problems:\n{}", found.len(), found.join("\n"));
}

/// A load factor that must be 0 was once 10⁻⁶ or withheld, because a verdict may be stable just beyond 0. At that
/// time, the exact program had a limit of 10⁷ and no tolerance.
#[test]
fn very_small_loads_that_cannot_be_carried_have_a_load_factor_of_zero() {
    for number in [50069, 50118, 50214, 50274, 50293, 50297, 700146] {
        let found = problems(number);
        assert!(found.is_empty(), "{found:?}");
    }
}

/// Of a block under 5·10⁶ N, the horizontal load of the stone of 5 N on top was once 0.032 instead of 0.25: the end was
/// moved to the safe side by the tolerance of the forces, not by their error. In the other scenes, the kernel was too
/// large, because a verdict is stable just beyond it within its tolerance.
#[test]
fn loads_far_larger_or_smaller_than_weights_leave_the_other_margins_exact() {
    for number in [594, 5000082, 5000231, 5000275] {
        let found = problems(number);
        assert!(found.is_empty(), "{found:?}");
    }
}

/// The counterweight of the plank is divided by up to 10¹². A load factor of 9·10⁹ once counted as unbounded.
#[test]
fn the_load_factor_of_a_tiny_counterweight_is_found() {
    let (file, margins) = known("plank");
    let ordinary = margins.of(MarginKind::LoadFactor).expect("there is a load");
    let low = ordinary.low().and_then(|end| end.value()).expect("it needs a counterweight");
    for by in [1e-5, 1e-9, 1e-12] {
        let file = scaled(&file, by);
        let scene = Scene::from_json(&file.to_string()).expect("sound");
        let margins = analysed(&scene);
        let found = margins.of(MarginKind::LoadFactor);
        assert!(matches!(found, Some(Interval::Between { .. })), "{by}: {found:?}");
        near(super::ends(found), [low / by, f64::INFINITY]);
    }
}
