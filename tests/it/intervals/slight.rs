//! Intervals where the loads are far smaller or far larger than the weights.
//!
//! A factor on loads that are a millionth as large is a million times as large: the exact interval of the scene with its
//! ordinary loads gives that of the changed one.

use drystone::Scene;
use drystone::analysis::{End, Interval};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::exact::{
    NONE, Problems, check_friction, check_kernel, check_tilt, exact_interval, is_borderline,
};
use super::random::random_scene;
use super::{analysed, known, near};
use crate::oracle::factor::Growing;
use crate::oracle::number_of;
use crate::random::Random;

/// The file with all its loads times a factor.
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

/// What rounding may do to an end, in parts of the loads.
const ROUNDING: f64 = 1e-12;

/// An interval against the exact one. Within the band of the verdicts (`none`, in units of the parameter) an end may be
/// off to the safe side only, or withheld between two values with the exact end in between.
fn compare_safely(
    name: &str,
    file: &Value,
    found: &Option<Interval>,
    exact: Option<[f64; 2]>,
    [none, rounding]: [f64; 2],
) -> Option<String> {
    let wrong = || Some(format!("{name} {found:?}, exactly {exact:?}"));
    let (Some(Interval::Between { low, high }), Some(ends)) = (found, exact) else {
        let is_right = match (found, exact) {
            (Some(Interval::Empty(_)), None) => true,
            (Some(Interval::Empty(_)), Some([low, high])) => high - low <= none,
            // Within the band of the verdicts it stands, or whether it does is not stated.
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
            End::At { value, .. } => {
                is_inside(*value, allowed) && !is_inside(*value, -none.max(allowed))
            }
            End::Unconfirmed { stands, beyond } => {
                is_inside(*stands, allowed) && !is_inside(*beyond, -allowed)
            }
            _ => false,
        }
    };
    let [least, most] = ends;
    let both = is_right(low, least, -1.0) && is_right(high, most, 1.0);
    if both { None } else { wrong() }
}

/// What is wrong with the intervals of a scene whose loads are multiplied by a power of two.
fn problems(number: u64) -> Vec<String> {
    let given = random_scene(number);
    let power = [-24, -20, -17, -12, 12, 20][number as usize % 6];
    let by = libm::ldexp(1.0, power);
    let file = scaled(&given, by);
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let found = analysed(&scene).intervals;
    let mut problems = Problems {
        has_band: true,
        ..Problems::default()
    };
    if !scene.loads().is_empty() {
        // In units of the ordinary loads.
        let ordinary = |end: f64| end / by;
        let exact = exact_interval(&given, Growing::ListedLoads);
        let exact = exact.map(|ends| ends.map(ordinary));
        // The weights are up to 36 times the ordinary loads.
        let band = [36.0 * NONE / by, ROUNDING / by];
        let wrong = compare_safely("load factor", &file, &found.load_factor, exact, band);
        problems.list.extend(wrong);
    }
    let (across, share) = (Growing::AcrossGravity, &found.horizontal_load);
    // Weights far below the loads are balanced to the digits of the loads.
    let exact = exact_interval(&file, across);
    let band = match by > 1.0 {
        true => [NONE * by, ROUNDING * by],
        false => [NONE; 2],
    };
    problems
        .list
        .extend(compare_safely("horizontal", &file, share, exact, band));
    check_friction(&file, &found, &mut problems);
    check_kernel(&file, &found, &mut problems);
    check_tilt(&file, &found, &mut Random::new(number), &mut problems);
    problems.of(number, &file)
}

/// `DRYSTONE_INTERVAL_SLIGHT=600` looks at more of them.
#[test]
fn loads_far_smaller_and_larger_than_weights_have_exact_intervals() {
    let first = number_of("DRYSTONE_INTERVAL_FIRST", 0);
    let wanted = number_of("DRYSTONE_INTERVAL_SLIGHT", 36);
    let numbers = (first..first + wanted).into_par_iter();
    let found: Vec<String> = numbers.flat_map_iter(problems).collect();
    assert!(
        found.is_empty(),
        "{} problems:\n{}",
        found.len(),
        found.join("\n")
    );
}

/// A factor that must be 0 was 10⁻⁶ or withheld, since a verdict may be stable just beyond it. The exact program knew no end beyond
/// 10⁷, and no band.
#[test]
fn slight_loads_that_nothing_may_carry_have_a_factor_of_zero() {
    for number in [50069, 50118, 50214, 50274, 50293, 50297] {
        let found = problems(number);
        assert!(found.is_empty(), "{found:?}");
    }
}

/// The counterweight of the plank in units of a micronewton: a factor of 9·10⁹ once counted as none.
#[test]
fn a_counterweight_given_as_a_tiny_load_is_found() {
    let (file, margins) = known("plank");
    let ordinary = margins.intervals.load_factor.expect("there is a load");
    let low = ordinary
        .low()
        .and_then(|end| end.value())
        .expect("it needs a counterweight");
    for by in [1e-5, 1e-9, 1e-12] {
        let file = scaled(&file, by);
        let scene = Scene::from_json(&file.to_string()).expect("sound");
        let found = analysed(&scene).intervals.load_factor;
        assert!(
            matches!(found, Some(Interval::Between { .. })),
            "{by}: {found:?}"
        );
        near(super::ends(&found), [low / by, f64::INFINITY]);
    }
}
