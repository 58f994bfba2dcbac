//! Margins in words: the values of a parameter at which a frame stands, and the present value.
//!
//! [`StatedMargin`] is the one source for the terminal's lines, for tables, bars and captions, and for the headline.

use super::number::{NO_BREAK, digits};
use crate::analysis::{End, FrameAnalysis, Interval, Intervals, Verdict};
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
    /// The unit of a value, with a space before it if needed.
    fn unit(self) -> &'static str {
        match self {
            Parameter::Tilt => "°",
            Parameter::RobotForce => " N",
            Parameter::RobotTorque => " N·m",
            _ => "",
        }
    }

    /// Whether the values of the parameter may be negative.
    pub fn is_signed(self) -> bool {
        matches!(self, Parameter::Tilt | Parameter::HorizontalLoad)
    }

    /// A value with its unit and, for a signed parameter, its side.
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

/// All margins of a frame that were computed. The headline comes first.
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
    let mut list = whole_frame(scene, found, intervals, position);
    list.extend(robot_limits(scene, intervals, position));
    if let Some(first) = headline(&list) {
        list[..=first].rotate_right(1);
    }
    list
}

/// The margins that belong to the whole frame.
fn whole_frame<'a>(
    scene: &Scene,
    found: &FrameAnalysis,
    intervals: &'a Intervals,
    position: Position,
) -> Vec<StatedMargin<'a>> {
    use Parameter::{Friction, HorizontalLoad, Kernel, LoadFactor, Tilt};
    let share = "horizontal share of the weights";
    let all = [
        (
            LoadFactor,
            "factor on the loads",
            &intervals.load_factor,
            1.0,
        ),
        (Friction, "friction coefficient", &intervals.friction, 0.0),
        (Tilt, "tilt of gravity", &intervals.tilt, 0.0),
        (HorizontalLoad, share, &intervals.horizontal_load, 0.0),
        (Kernel, "safety kernel", &intervals.kernel, scene.kernel),
    ];
    let mut list = Vec::new();
    for (parameter, name, interval, present) in all {
        let Some(interval) = interval else {
            continue;
        };
        let mut margin = StatedMargin {
            parameter,
            name: name.to_owned(),
            interval,
            present: Some((present, present)),
            position,
        };
        if parameter == Friction {
            margin.present = friction(found);
            margin.position = friction_position(interval, margin.present, position);
        }
        list.push(margin);
    }
    list
}

/// The margins of the limits of each robot.
fn robot_limits<'a>(
    scene: &Scene,
    intervals: &'a Intervals,
    position: Position,
) -> Vec<StatedMargin<'a>> {
    use Parameter::{RobotForce, RobotTorque};
    let mut list = Vec::new();
    for robot in &intervals.robots {
        let arm = &scene.robots[robot.robot.0];
        let (id, limits) = (text::line(&arm.id), arm.limits);
        let all = [
            (RobotForce, "horizontal force", &robot.fx, limits.fx),
            (RobotForce, "vertical force", &robot.fy, limits.fy),
            (RobotTorque, "torque", &robot.torque, limits.torque),
        ];
        list.extend(all.map(|(parameter, name, interval, limit)| StatedMargin {
            parameter,
            name: format!("limit of the {name} of robot {id}"),
            interval,
            present: Some((limit, limit)),
            position,
        }));
    }
    list
}

/// The index of the most important margin: the load factor if there are loads, otherwise the margin with the least reserve.
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

/// The position of different friction coefficients relative to an interval that holds for one common coefficient.
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
    /// The interval and the present value: `stands from 0.3 to 2.4; now 1`.
    pub fn sentence(&self) -> String {
        match self.present_words() {
            None => self.stands(),
            Some(present) => format!("{}; {present}", self.stands()),
        }
    }

    /// The interval in words, without the present value.
    pub fn stands(&self) -> String {
        stands(self.parameter, self.interval)
    }

    /// The present value in words, and whether it lies in the interval.
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

    /// The relative distance of the present value from the nearest end: 0 at or beyond an end, 1 if there is no end.
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

/// The end of the interval, or the farthest value at which the frame is known to stand.
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
    // Leave out a lower end of 0 for a parameter that cannot be negative.
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
        // Two ends with the same text are one value at the printed precision.
        (Some(low), Some(high)) if value(low) == value(high) => format!("only at {}", value(low)),
        (Some(low), Some(high)) => format!("from {} to {}", value(low), value(high)),
    }
}

/// What a frame that falls lacks, as far as its margins were computed: `falls: carries 33 % of its load`. `None` for a frame
/// that does not fall, and where no margin says more than the verdict.
pub fn falls_headline(scene: &Scene, found: &FrameAnalysis) -> Option<String> {
    if found.verdict != Verdict::Unstable {
        return None;
    }
    let intervals = &found.margins.as_ref()?.intervals;
    let loads = intervals.load_factor.as_ref();
    let lack = loads
        .and_then(|interval| load_lack(scene, interval))
        .or_else(|| friction_lack(found, intervals.friction.as_ref()?))?;
    Some(format!("falls: {lack}"))
}

/// How much of its loads a frame carries, or how much more it needs, where the present loads let it fall.
fn load_lack(scene: &Scene, interval: &Interval) -> Option<String> {
    let loads = match scene.loads.len() {
        1 => "load",
        _ => "loads",
    };
    let [low, high] = [interval.low()?, interval.high()?].map(confirmed);
    match (low, high) {
        // Rounded down: so much it carries.
        (_, Some(high)) if high < 1.0 => {
            let share = libm::floor(100.0 * high + 1e-4);
            Some(match share >= 1.0 {
                true => format!("carries {share}{NO_BREAK}% of its {loads}"),
                false => format!("carries less than 1{NO_BREAK}% of its {loads}"),
            })
        }
        (Some(low), _) if low > 1.0 => Some(format!("would need {} times its {loads}", above(low))),
        _ => None,
    }
}

/// The friction coefficient with which a frame would stand, where its own is too small.
fn friction_lack(found: &FrameAnalysis, interval: &Interval) -> Option<String> {
    let (least, most) = friction(found)?;
    match interval {
        Interval::Empty => Some("no friction would hold it".to_owned()),
        Interval::Undecided => None,
        Interval::Between { low, .. } => {
            let low = confirmed(low).filter(|low| *low > least)?;
            let everywhere = if least < most { " at every joint" } else { "" };
            Some(format!("would need friction {}{everywhere}", above(low)))
        }
    }
}

/// A number above 0 to two decimals, rounded up: with it the frame stands.
fn above(value: f64) -> String {
    format!("{:.2}", libm::ceil(100.0 * value - 1e-4) / 100.0)
}

/// The margins of a frame, one line each, the headline first. Remarks follow.
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
