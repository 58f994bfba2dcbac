//! Compares computed intervals with an exact program.

use dashu_ratio::RBig;
use drystone::Scene;
use drystone::analysis::{Interval, MarginKind, Margins};
use serde_json::{Value, json};

use super::read;
use crate::oracle::balance::{Balance, Locked};
use crate::oracle::factor::{ENDLESS, Growing};
use crate::oracle::touch::touches;
use crate::random::Random;

fn exact_scene(file: &Value) -> Scene {
    Scene::from_json(&file.to_string()).expect("a changed scene is sound")
}

/// Whether a changed file stands, by the exact program.
fn stands(file: &Value) -> bool {
    let scene = exact_scene(file);
    let touches = touches(&scene);
    Balance::groups(&scene, &touches).iter().all(Balance::stands)
}

/// The exact interval of a scene, with all its groups.
pub(super) fn exact_interval(file: &Value, growing: Growing) -> Option<[f64; 2]> {
    exact_interval_of(file, growing, None)
}

/// Compares the intervals of the load factor if nothing can turn, if nothing can slide, and within the middle third.
pub(super) fn check_changed_structures(file: &Value, found: &Margins, problems: &mut Problems) {
    let third = with(file, "kernel", file["kernel"].as_f64().unwrap_or(0.0).max(2.0 / 3.0));
    for (kind, file, locked) in [
        (MarginKind::Sliding, file, Some(Locked::Turning)),
        (MarginKind::Overturning, file, Some(Locked::Sliding)),
        (MarginKind::MiddleThird, &third, None),
    ] {
        let exact = exact_interval_of(file, Growing::ListedLoads, locked);
        compare(kind.word(), found.of(kind), exact, NONE, problems);
    }
}

fn exact_interval_of(file: &Value, growing: Growing, locked: Option<Locked>) -> Option<[f64; 2]> {
    let scene = exact_scene(file);
    let touches = touches(&scene);
    let mut whole = [RBig::from(-ENDLESS), RBig::from(ENDLESS)];
    if growing == Growing::ListedLoads {
        whole[0] = RBig::ZERO;
    }
    for mut group in Balance::groups(&scene, &touches) {
        group.locked = locked;
        let [low, high] = group.interval(growing)?;
        let [least, most] = whole;
        whole = [least.max(low), most.min(high)];
    }
    if whole[0] > whole[1] {
        return None;
    }
    let [low, high] = whole.map(|value| value.to_f64_fast());
    let endless = ENDLESS as f64;
    Some([if low <= -endless { f64::NEG_INFINITY } else { low }, if high >= endless { f64::INFINITY } else { high }])
}

fn with(file: &Value, key: &str, value: f64) -> Value {
    let mut changed = file.clone();
    changed[key] = json!(value);
    changed
}

fn turned(file: &Value, degrees: f64) -> Value {
    let mut changed = file.clone();
    let angle = degrees.to_radians();
    changed["gravity"] = json!([libm::sin(angle), -libm::cos(angle)]);
    changed
}

/// Compares the interval of a parameter on which the loads depend linearly with the exact interval.
pub(super) fn check_linear(
    name: &str,
    file: &Value,
    growing: Growing,
    found: Option<&Interval>,
    problems: &mut Problems,
) {
    compare(name, found, exact_interval(file, growing), NONE, problems);
}

/// An end up to this value counts as 0. It is the tolerance of the verdicts.
pub(super) const NONE: f64 = 1e-7;

/// Compares an interval with the exact interval. An end up to `none` counts as 0.
pub(super) fn compare(
    name: &str,
    found: Option<&Interval>,
    exact: Option<[f64; 2]>,
    none: f64,
    problems: &mut Problems,
) {
    let Some(found) = found else {
        problems.push(format!("{name} is absent"));
        return;
    };
    match (read(found), exact) {
        (Err(withheld), _) => problems.push(format!("{name} withheld: {withheld}, exactly {exact:?}")),
        (Ok(None), None) => {}
        (Ok(Some(found)), Some(exact)) => {
            for (a, b) in found.into_iter().zip(exact) {
                if a != b && !((a - b).abs() <= (1e-6 * b.abs()).max(none)) {
                    problems.push(format!("{name} {found:?}, exactly {exact:?}"));
                    return;
                }
            }
        }
        // Within the tolerance of the proofs, an interval of one point may also be empty.
        (Ok(Some([low, high])), None) if high - low <= (1e-6 * high.abs()).max(none) => {}
        (Ok(None), Some([low, high])) if high - low <= (1e-6 * high.abs()).max(none) => {}
        (found, exact) => problems.push(format!("{name} {found:?}, exactly {exact:?}")),
    }
}

/// The errors in the intervals of a scene.
#[derive(Default)]
pub(super) struct Problems {
    pub(super) list: Vec<String>,
    /// True if a wrong verdict within the tolerance of the verdicts is no error, for example because a load is as
    /// small as this tolerance.
    pub(super) has_band: bool,
}

impl Problems {
    pub(super) fn push(&mut self, problem: String) {
        self.list.push(problem);
    }

    /// All errors with the number of the scene, followed by the scene.
    pub(super) fn of(mut self, number: u64, file: &Value) -> Vec<String> {
        if !self.list.is_empty() {
            self.push(file.to_string());
        }
        let list = self.list.iter();
        list.map(|problem| format!("{number}: {problem}")).collect()
    }
}

/// Whether the scene of a file is within the tolerance of its limit.
pub(super) fn is_borderline(file: &Value) -> bool {
    let scene = exact_scene(file);
    let touches = touches(&scene);
    let groups = Balance::groups(&scene, &touches);
    groups.iter().any(Balance::is_borderline)
}

/// Adds a problem if a changed file does not stand or fall as expected.
fn expect(name: &str, file: &Value, standing: bool, problems: &mut Problems) {
    if stands(file) != standing && !(problems.has_band && is_borderline(file)) {
        let word = if standing { "falls" } else { "stands" };
        problems.push(format!("{name}: the exact program {word}"));
    }
}

/// The tolerance of an end of friction, kernel or limit, relative to the end.
const RELATIVE_TOL: f64 = 1e-6;
/// The absolute tolerance of such an end. Friction and kernel change the forces in proportion to the loads, and
/// verdicts are accurate to this fraction of the loads.
const ABSOLUTE_TOL: f64 = 1e-7;

pub(super) fn check_friction(file: &Value, found: &Margins, problems: &mut Problems) {
    let at = |mu: f64| with(file, "friction", mu);
    let interval = found.of(MarginKind::Friction).expect("requested");
    match read(interval) {
        Err(withheld) => problems.push(format!("friction withheld: {withheld}")),
        Ok(None) => expect("friction none", &at(1000.0), false, problems),
        Ok(Some([low, _])) => {
            let more = (low * (1.0 + RELATIVE_TOL) + ABSOLUTE_TOL).max(2e-6);
            expect(&format!("friction {low}"), &at(more), true, problems);
            if low > 2e-6 {
                expect(&format!("friction {low}"), &at(low * (1.0 - RELATIVE_TOL) - ABSOLUTE_TOL), false, problems);
            }
        }
    }
}

pub(super) fn check_kernel(file: &Value, found: &Margins, problems: &mut Problems) {
    let at = |kernel: f64| with(file, "kernel", kernel);
    match read(found.of(MarginKind::Kernel).expect("requested")) {
        Err(withheld) => problems.push(format!("kernel withheld: {withheld}")),
        Ok(None) => expect("kernel none", &at(0.0), false, problems),
        Ok(Some([_, high])) if high.is_infinite() => expect("kernel endless", &at(1.0), true, problems),
        Ok(Some([_, high])) => {
            let name = format!("kernel {high}");
            if high > 2e-6 {
                expect(&name, &at(high * (1.0 - RELATIVE_TOL) - ABSOLUTE_TOL), true, problems);
            }
            let more = (high * (1.0 + RELATIVE_TOL) + ABSOLUTE_TOL).max(2e-6);
            if more < 1.0 {
                expect(&name, &at(more), false, problems);
            }
        }
    }
}

pub(super) fn check_tilt(file: &Value, found: &Margins, chance: &mut Random, problems: &mut Problems) {
    const OFF: f64 = 1e-4;
    match read(found.of(MarginKind::Tilt).expect("requested")) {
        Err(withheld) => problems.push(format!("tilt withheld: {withheld}")),
        Ok(None) => {
            for _ in 0..12 {
                let turn = 360.0 * chance.share();
                expect(&format!("tilt none at {turn}"), &turned(file, turn), false, problems);
            }
        }
        Ok(Some([low, high])) if low.is_infinite() || high.is_infinite() => {
            if low.is_finite() || high.is_finite() {
                problems.push(format!("tilt {low} to {high}: one end of a circle"));
            }
            for _ in 0..12 {
                let turn = 360.0 * chance.share();
                expect(&format!("tilt endless at {turn}"), &turned(file, turn), true, problems);
            }
        }
        Ok(Some([low, high])) => {
            let name = format!("tilt {low} to {high}");
            for (turn, standing) in [(low - OFF, false), (low + OFF, true), (high - OFF, true), (high + OFF, false)] {
                let is_inside = turn > low + 0.5 * OFF && turn < high - 0.5 * OFF;
                if is_inside == standing {
                    expect(&format!("{name} at {turn}"), &turned(file, turn), standing, problems);
                }
            }
            for _ in 0..3 {
                let turn = low + (high - low) * chance.share();
                if turn > low + OFF && turn < high - OFF {
                    expect(&format!("{name} at {turn}"), &turned(file, turn), true, problems);
                }
            }
            // If the interval excludes 0, the scene must fall at every tilt smaller than its nearer end.
            let nearest = if low > 0.0 { low } else { -high };
            for _ in 0..4 {
                let turn = (nearest - OFF) * (2.0 * chance.share() - 1.0);
                if nearest > OFF {
                    expect(&format!("{name} at {turn}"), &turned(file, turn), false, problems);
                }
            }
        }
    }
}

pub(super) fn check_robots(file: &Value, found: &Margins, problems: &mut Problems) {
    for (robot, limits) in found.robots() {
        for (key, interval) in ["fx", "fy", "torque"].into_iter().zip(limits) {
            let at = |limit: f64| {
                let mut changed = file.clone();
                let limits = &mut changed["robots"][robot.0]["limits"];
                limits[key] = json!(limit);
                changed
            };
            match read(interval) {
                Err(withheld) => problems.push(format!("{key} withheld: {withheld}")),
                Ok(None) => expect(&format!("{key} none"), &at(1e6), false, problems),
                Ok(Some([low, _])) => {
                    let name = format!("{key} {low}");
                    expect(&name, &at((low * (1.0 + RELATIVE_TOL)).max(1e-5)), true, problems);
                    if low > 1e-5 {
                        expect(&name, &at(low * (1.0 - RELATIVE_TOL) - ABSOLUTE_TOL), false, problems);
                    }
                }
            }
        }
    }
}
