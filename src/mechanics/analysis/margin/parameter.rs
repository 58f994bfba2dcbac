//! The interval of each parameter of one component.

use super::edge::Threshold;
use super::interval::{End, Interval, RobotIntervals};
use super::kind::{MarginKind, MarginKinds};
use super::line::Line;
use super::margins::Margins;
use super::trial::{Limited, Setting, Trial};
use super::{ComponentIntervals, tilt};
use crate::analysis::Verdict;
use crate::program::Scale;
use crate::solve::{Limit, largest_factor, least_grip_limit, nearest_factor};

/// All intervals of a component that were requested. `stands` is whether it does as it is; `with_tilt` whether all
/// components of its frame do, so that the tilts around 0 are wanted.
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
    // A tilt of plain weights follows from the horizontal share.
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
    Threshold::least(Margins::MOST_FRICTION).searched(trial, &setting)
}

fn kernel(trial: &mut Trial) -> Interval {
    let setting = |kernel: f64| Setting {
        kernel: Some(kernel),
        ..Setting::default()
    };
    Threshold::most(1.0).searched(trial, &setting)
}

fn horizontal_load(trial: &mut Trial, stands: bool) -> Interval {
    let line = Line {
        setting: &|share| Setting {
            across: share,
            ..Setting::default()
        },
        least: f64::NEG_INFINITY,
        natural: 1.0,
    };
    let alone = |side: f64| Setting {
        along: 0.0,
        across: side,
        loads: 0.0,
        limits: Limited::Unlimited,
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
        least: 0.0,
        natural: 1.0,
    };
    let alone = |side: f64| Setting {
        along: 0.0,
        loads: side,
        limits: Limited::Unlimited,
        ..Setting::default()
    };
    linear(trial, &line, 1.0, stands, &alone)
}

/// The interval of a parameter in which the loads are linear. `stands` is whether the component does at `present`. `alone`
/// has only what grows in one direction: if what needs no limit of any robot carries that, nothing bounds it.
pub(super) fn linear(
    trial: &mut Trial,
    line: &Line,
    present: f64,
    stands: bool,
    alone: &dyn Fn(f64) -> Setting,
) -> Interval {
    let mut start = present;
    // Where it falls at present, the value nearest to it at which it stands is one end.
    let mut nearest = None;
    if !stands {
        let (program, toward) =
            trial.direction(&(line.setting)(present), &(line.setting)(present + 1.0));
        let found = nearest_factor(&program, &toward);
        let at = match found.limit {
            Limit::At(change) => (present + change).max(line.least),
            _ => present,
        };
        let toward_present = (present - at).signum();
        // Of a motion that no value stops, the present one is well beyond.
        let beyond = match found.limit {
            Limit::Never => [present; 3],
            _ => line.around(at, toward_present),
        };
        trial.learn_edge(&program, &found, beyond, line.setting, None);
        nearest = matches!(found.limit, Limit::At(_)).then_some(at);
        start = match line.nearest(trial, present, nearest) {
            Ok(start) => start,
            Err(interval) => return interval,
        };
    }
    let [low, high] = [-1.0, 1.0].map(|outward| {
        let faces_present = (present - start) * outward > 0.0;
        if let Some(hint) = nearest.filter(|_| faces_present) {
            return line.end(trial, start, outward, Some(hint));
        }
        if outward < 0.0 && line.least.is_finite() {
            let stands = trial.judge(&(line.setting)(line.least)).0 == Verdict::Stable;
            if stands {
                return End::natural(line.least);
            }
        }
        let (program, toward) =
            trial.direction(&(line.setting)(start), &(line.setting)(start + outward));
        let found = largest_factor(&program, &toward);
        match found.limit {
            Limit::Unbounded if trial.judge(&alone(outward)).0 == Verdict::Stable => End::Unbounded,
            Limit::At(change) => {
                let at = (start + outward * change).max(line.least);
                let base = stands.then_some(present);
                trial.learn_edge(
                    &program,
                    &found,
                    line.around(at, outward),
                    line.setting,
                    base,
                );
                line.end(trial, start, outward, Some(at))
            }
            // It stands within the proof's band and not beyond it: on the edge.
            Limit::Never => line.end(trial, start, outward, Some(start)),
            _ => line.end(trial, start, outward, None),
        }
    });
    Interval::Between { low, high }
}

/// The interval of one limit of one grip.
fn limit(trial: &mut Trial, grip: usize, component: usize, stands: bool) -> Interval {
    let setting = |most: f64| Setting {
        limits: Limited::One {
            grip,
            component,
            most,
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
        least: 0.0,
        natural: unit * Scale::HEAVIEST,
    };
    let given = program.grips[grip].limits[component] * unit;
    if !stands {
        match trial.judge(&setting(f64::INFINITY)).0 {
            Verdict::Stable => {}
            Verdict::Unstable => return Interval::Empty,
            Verdict::Undecided => return Interval::Undecided,
        }
    }
    let enough = if stands { given } else { f64::INFINITY };
    let found = least_grip_limit(&program, grip, component);
    let hint = match found.limit {
        Limit::At(at) => {
            let at = at * unit;
            trial.learn_edge(&program, &found, line.around(at, -1.0), &setting, None);
            Some(at)
        }
        _ => None,
    };
    Interval::Between {
        low: line.end(trial, line.from(enough), -1.0, hint),
        high: End::Unbounded,
    }
}
