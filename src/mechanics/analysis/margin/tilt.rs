//! How far gravity may turn: exact from one linear program where all forces grow with the loads, else by judging.

use std::f64::consts::{FRAC_PI_2, PI};

use super::edge::Threshold;
use super::interval::{End, Interval};
use super::line::Line;
use super::parameter::linear;
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;

/// The turns of gravity at which a component stands, degrees, seen from where it is.
pub(super) fn tilt(trial: &mut Trial, stands: bool, horizontal: Option<&Interval>) -> Interval {
    if !stands {
        return Interval::Empty;
    }
    let [low, high] = [-1.0, 1.0].map(|side| end(trial, side, horizontal));
    Interval::Between { low, high }
}

/// The largest turn of gravity to one side.
fn end(trial: &mut Trial, side: f64, horizontal: Option<&Interval>) -> End {
    if let Some(Interval::Between { low, high }) = horizontal
        && !trial.is_loaded()
        && !trial.is_limited()
    {
        return of_weights(trial, side, if side < 0.0 { low } else { high });
    }
    let quarters = [(0.0, FRAC_PI_2), (FRAC_PI_2, PI)];
    let exit = quarters
        .into_iter()
        .find_map(|(from, to)| first_exit(trial, side, [from, to], false));
    let setting = |degrees: f64| turned(degrees.to_radians(), 1.0, side);
    let edge = Threshold::most(180.0);
    let found = match exit.map(f64::to_degrees) {
        None => return End::Unbounded,
        Some(at) => {
            let at = if at < 1e-5 { 0.0 } else { at };
            edge.confirmed(trial, &setting, at)
                .unwrap_or(End::Unconfirmed {
                    stands: at,
                    beyond: 180.0,
                })
        }
    };
    match found {
        End::At { value, mechanism } => End::At {
            value: side * value + 0.0,
            mechanism,
        },
        End::Unconfirmed { stands, beyond } => End::Unconfirmed {
            stands: side * stands + 0.0,
            beyond: side * beyond,
        },
        End::Unbounded => End::Unbounded,
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
fn of_weights(trial: &mut Trial, side: f64, horizontal: &End) -> End {
    let turn = |share: f64| libm::atan(share).to_degrees();
    match horizontal {
        End::At { value, mechanism } => End::At {
            value: turn(*value),
            mechanism: mechanism.clone(),
        },
        End::Unconfirmed { stands, beyond } => End::Unconfirmed {
            stands: turn(*stands),
            beyond: turn(*beyond),
        },
        End::Unbounded => {
            let line = Line {
                setting: &|share| Setting {
                    along: -share,
                    across: side,
                    ..Setting::default()
                },
                least: 0.0,
                natural: 1.0,
            };
            let alone = |_: f64| Setting {
                along: -1.0,
                ..Setting::default()
            };
            match linear(trial, &line, 0.0, true, &alone) {
                Interval::Between {
                    high: End::At { value, mechanism },
                    ..
                } => End::At {
                    value: side * (90.0 + turn(value)),
                    mechanism,
                },
                Interval::Between {
                    high: End::Unbounded,
                    ..
                } => End::Unbounded,
                _ => End::Unconfirmed {
                    stands: side * 90.0,
                    beyond: side * 180.0,
                },
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
