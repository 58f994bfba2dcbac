//! How far gravity may turn: exact from one linear program where all forces grow with the loads, else by judging.

use std::f64::consts::{FRAC_PI_2, PI};

use super::edge::{Loads, Threshold, Way};
use super::trial::{Setting, Trial};
use super::{Margin, linear};
use crate::analysis::Verdict;
use crate::proof::Motion;

/// The largest turn of gravity to one side, degrees, where the largest horizontal share to that side is known.
pub(super) fn tilt(trial: &mut Trial, side: f64, stands: bool, horizontal: &Margin) -> Margin {
    if !stands {
        return Margin::None;
    }
    if !trial.is_loaded() && !trial.is_limited() {
        return of_weights(trial, side, horizontal);
    }
    let quarters = [(0.0, FRAC_PI_2), (FRAC_PI_2, PI)];
    let exit = quarters
        .into_iter()
        .find_map(|(from, to)| first_exit(trial, side, [from, to], false));
    let setting = |degrees: f64| turned(degrees.to_radians(), 1.0, side);
    let edge = Threshold {
        way: Way::Most,
        loads: Loads::Other,
        natural: 1f64.to_degrees(),
        most: 180.0,
    };
    match exit.map(f64::to_degrees) {
        None => Margin::Unbounded,
        Some(at) => {
            let at = if at < 1e-5 { 0.0 } else { at };
            let found = edge.confirmed(trial, &setting, at);
            found.unwrap_or_else(|| {
                let wider = std::iter::successors(Some(0.01), |step| Some(step * 4.0));
                let mut turns = wider.map(|step| at + step).take_while(|turn| *turn < 180.0);
                let falls = |turn: &f64| trial.judge(&setting(*turn)).0 == Verdict::Unstable;
                Margin::Unconfirmed {
                    stands: at,
                    beyond: turns.find(falls).unwrap_or(180.0),
                }
            })
        }
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
fn of_weights(trial: &mut Trial, side: f64, horizontal: &Margin) -> Margin {
    let angle = |from: f64, share: f64, mechanism: &[Motion]| Margin::Value {
        at: (from + libm::atan(share)).to_degrees(),
        mechanism: mechanism.to_vec(),
    };
    match horizontal {
        Margin::Value { at, mechanism } => angle(0.0, *at, mechanism),
        Margin::Unconfirmed { stands, beyond } => Margin::Unconfirmed {
            stands: libm::atan(*stands).to_degrees(),
            beyond: libm::atan(*beyond).to_degrees(),
        },
        Margin::None | Margin::NotAsked => horizontal.clone(),
        Margin::Unbounded => {
            let lifted = |share: f64| Setting {
                along: -share,
                across: side,
                ..Setting::default()
            };
            let alone = Setting {
                along: -1.0,
                ..Setting::default()
            };
            match linear(trial, &lifted, alone, Some(f64::INFINITY)) {
                Margin::Value { at, mechanism } => angle(FRAC_PI_2, at, &mechanism),
                other => other,
            }
        }
    }
}

/// The first turn between `from`, where it stands, and `to` at which it ceases to stand.
///
/// The loads that are carried form a convex set. If it holds both ends of an arc and the point where the tangents at
/// them meet, it holds the triangle of the three and so the whole arc; otherwise the arc is halved.
///
/// That it does not stand at `to` may be `known`. It is not asked again then: as close to the edge as halving comes,
/// forces that are remembered from just inside pass for a balance at `to`, too.
fn first_exit(trial: &mut Trial, side: f64, [from, to]: [f64; 2], known: bool) -> Option<f64> {
    let mut judge = |angle: f64, stretch: f64| trial.judge(&turned(angle, stretch, side)).0;
    let (width, middle) = (to - from, 0.5 * (from + to));
    let is_beyond = known || judge(to, 1.0) != Verdict::Stable;
    if width < 1e-9 {
        return is_beyond.then_some(from);
    }
    let beyond_the_arc = 1.0 / libm::cos(0.5 * width);
    if !is_beyond && judge(middle, beyond_the_arc) == Verdict::Stable {
        return None;
    }
    match judge(middle, 1.0) {
        Verdict::Stable => first_exit(trial, side, [from, middle], false)
            .or_else(|| first_exit(trial, side, [middle, to], is_beyond)),
        // The edge lies there, within what can be decided.
        Verdict::Undecided if width < 1e-2 => Some(from),
        _ => first_exit(trial, side, [from, middle], true),
    }
}
