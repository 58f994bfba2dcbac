//! Describes margins in words: the values of a parameter at which a frame stands, and the present value.
//!
//! The terminal, tables, bars, captions and the headline all use [`StatedMargin`].

use super::number::{NO_BREAK, digits};
use crate::analysis::{End, Exclusion, FrameAnalysis, Interval, Intervals, Verdict};
use crate::scene::Scene;
use crate::text;

/// The parameter that a margin varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// One friction coefficient for every interface.
    Friction,
    /// The rotation of gravity, degrees.
    Tilt,
    /// The horizontal force on each block, relative to its weight.
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
    /// Returns the unit of a value, with a space before it if needed.
    fn unit(self) -> &'static str {
        match self {
            Parameter::Tilt => "°",
            Parameter::RobotForce => " N",
            Parameter::RobotTorque => " N·m",
            _ => "",
        }
    }

    /// True if the values of the parameter may be negative.
    pub fn is_signed(self) -> bool {
        matches!(self, Parameter::Tilt | Parameter::HorizontalLoad)
    }

    /// Writes a value with its unit and, for a signed parameter, its side: `5° left`.
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

/// The position of the present value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// The frame stands at this value.
    Inside,
    /// The frame falls at this value.
    Outside,
    /// It is undecided whether the frame stands at this value.
    Unknown,
}

/// One margin of a frame: its interval and its present value.
#[derive(Clone, Debug)]
pub struct StatedMargin<'a> {
    /// The parameter.
    pub parameter: Parameter,
    /// The name of the parameter in words.
    pub name: String,
    /// The values at which the frame stands.
    pub interval: &'a Interval,
    /// The least and the largest present value. They differ if interfaces have different friction, and are infinite
    /// if a robot has no limit. `None` for the friction of a frame without interfaces.
    pub present: Option<(f64, f64)>,
    /// The position of the present value.
    pub position: Position,
}

/// Returns all computed margins of a frame. The headline margin comes first.
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

/// Returns the margins of the whole frame.
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

/// Returns the margins of the limits of each robot.
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

/// Returns the index of the most important margin: the load factor if there is one and it has a limit, otherwise the
/// margin with the least reserve.
fn headline(list: &[StatedMargin<'_>]) -> Option<usize> {
    let loads = list
        .iter()
        .position(|m| m.parameter == Parameter::LoadFactor && !m.has_no_limit());
    let reserves = list.iter().map(StatedMargin::reserve).enumerate();
    loads.or_else(|| {
        reserves
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(first, _)| first)
    })
}

/// Returns the least and the largest friction coefficient of the frame's interfaces; `None` without interfaces.
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

/// Returns the position of the friction coefficients relative to an interval for one common coefficient. `alike` is
/// the position if all coefficients are equal.
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
    /// Describes the interval and the present value: `stands from 0.3 to 2.4; now 1`.
    pub fn sentence(&self) -> String {
        match self.present_words() {
            None => self.stands(),
            Some(present) => format!("{}; {present}", self.stands()),
        }
    }

    /// Describes the interval without the present value.
    pub fn stands(&self) -> String {
        stands(self.parameter, self.interval)
    }

    /// Describes the present value, and its position if it is not inside the interval.
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

    /// Returns true if it stands at the present value and however much the parameter grows or shrinks.
    pub fn has_no_limit(&self) -> bool {
        let free = |end: Option<&End>| matches!(end, Some(End::Unbounded));
        let from_zero = self.interval.low().and_then(confirmed) == Some(0.0);
        self.position == Position::Inside
            && free(self.interval.high())
            && (from_zero || free(self.interval.low()))
    }

    /// Returns the relative distance of the present value from the nearest end: 0 at or beyond an end, 1 if there is
    /// no end.
    ///
    /// The distance to an upper end is relative to this end, and the distance to a lower end is relative to the
    /// present value. The distance of a tilt is divided by 90°. A horizontal force is a fraction of the weight already.
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

/// Returns the end of the interval, or, if it is not confirmed, the farthest value at which the frame is known to
/// stand. `None` if there is no end.
pub fn confirmed(end: &End) -> Option<f64> {
    match end {
        End::At { value, .. } => Some(*value),
        End::Unconfirmed { stands, .. } => Some(*stands),
        End::Unbounded => None,
    }
}

/// Describes an interval: `stands from 0.3 to 2.4`.
pub fn stands(parameter: Parameter, interval: &Interval) -> String {
    let (low, high) = match interval {
        Interval::Between { low, high } => (low, high),
        Interval::Empty(excluded) => {
            let none = match parameter {
                Parameter::LoadFactor => "stands with no factor on its loads",
                _ => "stands at no value",
            };
            return match conflict(excluded) {
                Some([low, high]) => {
                    let [low, high] = [low, high].map(|value| parameter.value(value));
                    match parameter.is_signed() {
                        true => format!(
                            "{none}: falls to the left of {low}, and falls to the right of {high}"
                        ),
                        false => format!("{none}: falls below {low}, and falls above {high}"),
                    }
                }
                None => none.to_owned(),
            };
        }
        Interval::Undecided => return "no verdict shows at which values it stands".to_owned(),
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

/// Returns the value below which the frame falls by one motion, and the value above which it falls by another, if
/// these two motions exclude all values.
fn conflict(excluded: &[Exclusion]) -> Option<[f64; 2]> {
    match excluded {
        [below, above] if below.from.is_none() && above.to.is_none() => {
            Some([below.to?, above.from?])
        }
        _ => None,
    }
}

/// Describes the values between two ends.
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
        // If both ends have the same text, they are the same value at the printed precision.
        (Some(low), Some(high)) if value(low) == value(high) => format!("only at {}", value(low)),
        (Some(low), Some(high)) => format!("from {} to {}", value(low), value(high)),
    }
}

/// Describes how far a falling frame is from standing: `falls: carries 33 % of its load`. `None` if the frame does
/// not fall, or if no computed margin says more than the verdict.
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

/// Describes which share of its loads a frame carries, or which factor on its loads it needs. `None` if neither is
/// known.
fn load_lack(scene: &Scene, interval: &Interval) -> Option<String> {
    let loads = match scene.loads.len() {
        1 => "load",
        _ => "loads",
    };
    let [low, high] = [interval.low()?, interval.high()?].map(confirmed);
    match (low, high) {
        // Round down: the frame carries at least this share.
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

/// Describes the friction coefficient with which a frame would stand. `None` if its own friction is large enough, or
/// if no value is known.
fn friction_lack(found: &FrameAnalysis, interval: &Interval) -> Option<String> {
    let (least, most) = friction(found)?;
    match interval {
        Interval::Empty(_) => Some("no friction would hold it".to_owned()),
        Interval::Undecided => None,
        Interval::Between { low, .. } => {
            let low = confirmed(low).filter(|low| *low > least)?;
            let everywhere = if least < most { " at every joint" } else { "" };
            Some(format!("would need friction {}{everywhere}", above(low)))
        }
    }
}

/// Writes a positive number with two decimals, rounded up, so that the frame stands with it.
fn above(value: f64) -> String {
    format!("{:.2}", libm::ceil(100.0 * value - 1e-4) / 100.0)
}

/// Describes the margins of a frame, one line each, the headline margin first. Notes follow.
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
