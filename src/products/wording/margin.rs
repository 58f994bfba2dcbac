//! Margins in words: at which values of a parameter a frame stands, and where its present value is.
//!
//! [`StatedMargin`] is the one source for the terminal's lines, for tables, bars and captions, and for the headline.

use super::number::digits;
use crate::analysis::{End, FrameAnalysis, Interval, Verdict};
use crate::scene::Scene;
use crate::text;

/// What a margin varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// One friction coefficient for every interface.
    Friction,
    /// The turn of gravity, degrees.
    Tilt,
    /// The share of each weight that acts across gravity.
    HorizontalLoad,
    /// The safety kernel.
    Kernel,
    /// The factor on the listed loads.
    LoadFactor,
    /// The limit of a robot's force, N.
    RobotForce,
    /// The limit of a robot's torque, N·m.
    RobotTorque,
}

impl Parameter {
    /// The unit behind a value, with a space before it where one belongs there.
    fn unit(self) -> &'static str {
        match self {
            Parameter::Tilt => "°",
            Parameter::RobotForce => " N",
            Parameter::RobotTorque => " N·m",
            _ => "",
        }
    }

    /// Whether it runs to both sides of 0.
    pub fn is_signed(self) -> bool {
        matches!(self, Parameter::Tilt | Parameter::HorizontalLoad)
    }

    /// A value with its unit and, where it has one, its side.
    fn value(self, value: f64) -> String {
        let unit = self.unit();
        if !self.is_signed() {
            return format!("{}{unit}", digits(value));
        }
        let side = match value {
            v if v < 0.0 => " left",
            v if v > 0.0 => " right",
            _ => "",
        };
        format!("{}{unit}{side}", digits(value.abs()))
    }
}

/// Where the present value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// Among the values at which the frame stands.
    Inside,
    /// Elsewhere.
    Outside,
    /// Neither was shown.
    Unknown,
}

/// One margin of a frame: its interval and its present value.
#[derive(Clone, Debug)]
pub struct StatedMargin<'a> {
    /// What varies.
    pub parameter: Parameter,
    /// The same in words.
    pub name: String,
    /// The values at which the frame stands.
    pub interval: &'a Interval,
    /// The least and the largest present value: they differ where interfaces differ in friction, and are infinite where a
    /// robot has no limit. `None` where a frame has no interface.
    pub present: Option<(f64, f64)>,
    /// Where the present value is.
    pub position: Position,
}

/// The margins of a frame that were computed, the headline first.
pub fn stated<'a>(scene: &Scene, found: &'a FrameAnalysis) -> Vec<StatedMargin<'a>> {
    let Some(margins) = &found.margins else {
        return Vec::new();
    };
    let intervals = &margins.intervals;
    let position = match found.verdict {
        Verdict::Stable => Position::Inside,
        Verdict::Unstable => Position::Outside,
        Verdict::Undecided => Position::Unknown,
    };
    let one = |parameter, name: &str, interval: &'a Interval, present: f64| StatedMargin {
        parameter,
        name: name.to_owned(),
        interval,
        present: Some((present, present)),
        position,
    };
    let (tilt, share) = ("tilt of gravity", "horizontal share of the weights");
    let mut list = Vec::new();
    for (parameter, name, interval, present) in [
        (
            Parameter::LoadFactor,
            "factor on the loads",
            &intervals.load_factor,
            1.0,
        ),
        (
            Parameter::Friction,
            "friction coefficient",
            &intervals.friction,
            0.0,
        ),
        (Parameter::Tilt, tilt, &intervals.tilt, 0.0),
        (
            Parameter::HorizontalLoad,
            share,
            &intervals.horizontal_load,
            0.0,
        ),
        (
            Parameter::Kernel,
            "safety kernel",
            &intervals.kernel,
            scene.kernel,
        ),
    ] {
        let Some(interval) = interval else {
            continue;
        };
        let mut margin = one(parameter, name, interval, present);
        if parameter == Parameter::Friction {
            margin.present = friction(found);
            margin.position = friction_position(interval, margin.present, position);
        }
        list.push(margin);
    }
    for robot in &intervals.robots {
        let arm = &scene.robots[robot.robot.0];
        let id = text::line(&arm.id);
        for (parameter, name, interval, limit) in [
            (
                Parameter::RobotForce,
                "horizontal force",
                &robot.fx,
                arm.limits.fx,
            ),
            (
                Parameter::RobotForce,
                "vertical force",
                &robot.fy,
                arm.limits.fy,
            ),
            (
                Parameter::RobotTorque,
                "torque",
                &robot.torque,
                arm.limits.torque,
            ),
        ] {
            let name = format!("limit of the {name} of robot {id}");
            list.push(one(parameter, &name, interval, limit));
        }
    }
    if let Some(first) = headline(&list) {
        list[..=first].rotate_right(1);
    }
    list
}

/// The number of the margin that matters most: of the factor on the loads, where there are loads; else of the margin with
/// the least reserve.
fn headline(list: &[StatedMargin<'_>]) -> Option<usize> {
    let loads = list
        .iter()
        .position(|m| m.parameter == Parameter::LoadFactor);
    let reserves = list.iter().map(StatedMargin::reserve).enumerate();
    loads.or_else(|| {
        reserves
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(first, _)| first)
    })
}

/// The least and the largest friction coefficient of the frame's interfaces.
fn friction(found: &FrameAnalysis) -> Option<(f64, f64)> {
    let all = found
        .contacts
        .iter()
        .map(|contact| contact.interface.friction);
    all.fold(None, |range, friction| match range {
        None => Some((friction, friction)),
        Some((low, high)) => Some((friction.min(low), friction.max(high))),
    })
}

/// Where friction coefficients are that differ: the interval is that of one coefficient for all interfaces.
fn friction_position(
    interval: &Interval,
    present: Option<(f64, f64)>,
    alike: Position,
) -> Position {
    match present {
        Some((low, high)) if low < high => {
            match (interval.contains(low), interval.contains(high)) {
                (true, true) => Position::Inside,
                (false, false) if !matches!(interval, Interval::Undecided) => Position::Outside,
                _ => Position::Unknown,
            }
        }
        _ => alike,
    }
}

impl StatedMargin<'_> {
    /// At which values it stands, and where it is now: `stands from 0.3 to 2.4; now 1`.
    pub fn sentence(&self) -> String {
        match self.present_words() {
            None => self.stands(),
            Some(present) => format!("{}; {present}", self.stands()),
        }
    }

    /// At which values it stands.
    pub fn stands(&self) -> String {
        stands(self.parameter, self.interval)
    }

    /// The present value, and whether it is among those at which it stands.
    fn present_words(&self) -> Option<String> {
        let (low, high) = self.present?;
        let value = |value: f64| self.parameter.value(value);
        let now = match (low, high) {
            (_, high) if high.is_infinite() && low.is_infinite() => "now without limit".to_owned(),
            (low, high) if low == high => format!("now {}", value(low)),
            _ => format!("now {} to {}", value(low), value(high)),
        };
        let is_interval = matches!(self.interval, Interval::Between { .. });
        Some(match self.position {
            Position::Outside if is_interval => format!("{now}, outside"),
            Position::Unknown if is_interval && low == high => format!("{now}, undecided"),
            _ => now,
        })
    }

    /// What is left to the nearest end: 0 at or beyond it, 1 where nothing limits it.
    ///
    /// A value that may grow counts in parts of its end, one that may shrink in parts of itself, tilts in parts of a right
    /// angle and horizontal shares in parts of the whole weight.
    pub fn reserve(&self) -> f64 {
        if self.position != Position::Inside {
            return 0.0;
        }
        let (Some(low), Some(high)) = (self.interval.low(), self.interval.high()) else {
            return 0.0;
        };
        let [low, high] = [low, high].map(confirmed);
        let Some((least, most)) = self.present else {
            return 1.0;
        };
        let room = match self.parameter {
            Parameter::Tilt => [low.map(|v| -v / 90.0), high.map(|v| v / 90.0)],
            Parameter::HorizontalLoad => [low.map(|v| -v), high],
            Parameter::Kernel => [None, high.map(|v| (v - most) / (1.0 - most))],
            _ => [
                low.filter(|v| *v > 0.0 && least.is_finite())
                    .map(|v| 1.0 - v / least),
                high.map(|v| 1.0 - most / v),
            ],
        };
        let room = room.into_iter().flatten().filter(|share| !share.is_nan());
        room.fold(1.0, f64::min).max(0.0)
    }
}

/// The farthest value at which it is known to stand.
pub fn confirmed(end: &End) -> Option<f64> {
    match end {
        End::At { value, .. } => Some(*value),
        End::Unconfirmed { stands, .. } => Some(*stands),
        End::Unbounded => None,
    }
}

/// An interval in words: `stands from 0.3 to 2.4`.
pub fn stands(parameter: Parameter, interval: &Interval) -> String {
    let (low, high) = match interval {
        Interval::Between { low, high } => (low, high),
        Interval::Empty => {
            return match parameter {
                Parameter::LoadFactor => "stands at no factor on its loads",
                _ => "stands at no value",
            }
            .to_owned();
        }
        Interval::Undecided => return "no verdict confirms at which values it stands".to_owned(),
    };
    let unconfirmed = [("lower", low), ("upper", high)]
        .into_iter()
        .filter_map(|(name, end)| {
            let End::Unconfirmed { stands, beyond } = end else {
                return None;
            };
            let value = |value: f64| parameter.value(value);
            Some(if beyond.is_finite() {
                let [stands, beyond] = [value(*stands), value(*beyond)];
                format!(" ({name} end not confirmed: between {stands} and {beyond})")
            } else {
                format!(" ({name} end not confirmed: beyond {})", value(*stands))
            })
        });
    let unconfirmed: String = unconfirmed.collect();
    format!("stands {}{unconfirmed}", range(parameter, low, high))
}

/// The values between two ends in words.
fn range(parameter: Parameter, low: &End, high: &End) -> String {
    // A parameter that begins at 0 has no lower end there.
    let begins = |low: &f64| parameter.is_signed() || *low > 0.0;
    let least = confirmed(low).filter(begins);
    let most = confirmed(high);
    let value = |value: f64| parameter.value(value);
    if parameter == Parameter::LoadFactor {
        let factor = match (least, most) {
            (None, None) => "any factor".to_owned(),
            (None, Some(high)) => format!("at most {}", value(high)),
            (Some(low), None) => format!("at least {}", value(low)),
            (Some(low), Some(high)) if value(low) == value(high) => value(low),
            (Some(low), Some(high)) => format!("{} to {}", value(low), value(high)),
        };
        return format!("with its loads times {factor}");
    }
    match (least, most) {
        (None, None) => "at any value".to_owned(),
        (None, Some(high)) if parameter.is_signed() => {
            format!("from any value left to {}", value(high))
        }
        (Some(low), None) if parameter.is_signed() => {
            format!("from {} to any value right", value(low))
        }
        (None, Some(high)) => format!("up to {}", value(high)),
        (Some(low), None) => format!("at {} and more", value(low)),
        // Ends that read alike are one value at the digits that are written.
        (Some(low), Some(high)) if value(low) == value(high) => format!("only at {}", value(low)),
        (Some(low), Some(high)) => format!("from {} to {}", value(low), value(high)),
    }
}

/// The margins of a frame that were computed, a line each, the headline first; then what must be known about them.
pub fn lines(scene: &Scene, found: &FrameAnalysis) -> Vec<String> {
    let stated = stated(scene, found);
    let line = |margin: &StatedMargin<'_>| format!("{}: {}", margin.name, margin.sentence());
    let mut lines: Vec<String> = stated.iter().map(line).collect();
    let notes = found
        .margins
        .iter()
        .flat_map(|margins| &margins.intervals.notes);
    lines.extend(notes.map(|note| format!("note: {note}")));
    lines
}
