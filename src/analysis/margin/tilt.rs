//! How far gravity may turn: exact from one linear program where all forces grow with the loads, else by judging.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Margin;
use super::edge::{Edge, Way};
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::solve::{Limit, most};

/// The largest turn of gravity to one side, degrees.
pub(super) fn tilt(trial: &mut Trial, side: f64, stands: bool) -> Margin {
    if !stands {
        return Margin::None;
    }
    let setting = |degrees: f64| turned(degrees.to_radians(), 1.0, side);
    let edge = Edge {
        way: Way::Most,
        natural: 1f64.to_degrees(),
        most: 180.0,
    };
    if !trial.is_loaded() && !trial.is_limited() {
        let known = match without_loads(trial, side) {
            Limit::At(angle) => edge.confirmed(trial, &setting, angle.to_degrees()),
            Limit::Unbounded => {
                (trial.judge(&setting(180.0)).0 == Verdict::Stable).then_some(Margin::Unbounded)
            }
            _ => None,
        };
        if let Some(known) = known {
            return known;
        }
    }
    let quarters = [(0.0, FRAC_PI_2), (FRAC_PI_2, PI)];
    let exit = quarters
        .into_iter()
        .find_map(|(from, to)| first_exit(trial, side, from, to));
    match exit.map(f64::to_degrees) {
        None => Margin::Unbounded,
        Some(at) => edge.told(trial, &setting, if at < 1e-5 { 0.0 } else { at }),
    }
}

/// Gravity turned by an angle, `stretch` times as strong.
fn turned(angle: f64, stretch: f64, side: f64) -> Setting {
    Setting {
        along: stretch * libm::cos(angle),
        across: stretch * side * libm::sin(angle),
        ..Setting::default()
    }
}

/// The largest turn where only weights act and no limit cuts a force: what is carried is a cone then, and the turn's
/// tangent is the largest horizontal share; beyond a quarter turn, the rest's tangent the largest lifting share.
fn without_loads(trial: &mut Trial, side: f64) -> Limit {
    let across = Setting {
        along: 0.0,
        across: side,
        ..Setting::default()
    };
    let sideways = Setting {
        across: side,
        ..Setting::default()
    };
    let (program, toward) = trial.direction(&Setting::default(), &sideways);
    match most(&program, &toward) {
        Limit::At(share) => Limit::At(libm::atan(share)),
        Limit::Never => Limit::At(0.0),
        Limit::Unbounded => {
            let lifted = Setting {
                along: -1.0,
                ..across
            };
            let (program, toward) = trial.direction(&across, &lifted);
            match most(&program, &toward) {
                Limit::At(share) => Limit::At(FRAC_PI_2 + libm::atan(share)),
                Limit::Never => Limit::At(FRAC_PI_2),
                other => other,
            }
        }
        Limit::Unclear => Limit::Unclear,
    }
}

/// The first turn between `from`, where it stands, and `to` at which it ceases to stand.
///
/// The loads that are carried form a convex set. If it holds both ends of an arc and the point where the tangents at
/// them meet, it holds the triangle of the three and so the whole arc; otherwise the arc is halved.
fn first_exit(trial: &mut Trial, side: f64, from: f64, to: f64) -> Option<f64> {
    let mut stands =
        |angle: f64, stretch: f64| trial.judge(&turned(angle, stretch, side)).0 == Verdict::Stable;
    let (width, middle) = (to - from, 0.5 * (from + to));
    if width < 1e-9 {
        return (!stands(to, 1.0)).then_some(from);
    }
    if stands(to, 1.0) && stands(middle, 1.0 / libm::cos(0.5 * width)) {
        return None;
    }
    if stands(middle, 1.0) {
        first_exit(trial, side, from, middle).or_else(|| first_exit(trial, side, middle, to))
    } else {
        first_exit(trial, side, from, middle)
    }
}
