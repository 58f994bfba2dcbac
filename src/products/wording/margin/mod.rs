//! Describes margins in words. A margin is the interval of values of a parameter at which a frame stands, compared
//! with the current value.
//!
//! The terminal, tables, bars, captions and the headline all use [`StatedMargin`].

mod falls;
mod governing;
mod list;
mod range;

#[cfg(any(feature = "report", feature = "cli"))]
pub use governing::headline;
pub use governing::{Governing, governing};
pub use list::stated;
pub use range::stands;

use super::number::{amount, digits, three_down, three_up};
use crate::mechanics::analysis::{End, FrameAnalysis, Interval, UNDECIDED};
use crate::mechanics::scene::{Scene, Unit};

/// Smaller values of a parameter are rounding errors.
const NOISE: f64 = 1e-9;

/// The parameter that a margin varies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parameter {
    /// One friction coefficient for every interface.
    Friction,
    /// The rotation of gravity, degrees.
    Tilt,
    /// The horizontal force on each block, relative to its weight.
    HorizontalLoad,
    /// The safety kernel: the fraction of each interface's length that must stay free of force.
    Kernel,
    /// The factor on the listed loads.
    LoadFactor,
    /// The limit of a robot's force, N, and the unit in which it is written.
    RobotForce(Unit),
    /// The limit of a robot's torque, N·m, and the unit in which it is written.
    RobotTorque(Unit),
}

impl Parameter {
    /// Returns the unit that is written after a value of this parameter: `°` for a tilt, otherwise an empty text. The
    /// limits of robots are written with their own units instead.
    fn unit(self) -> &'static str {
        match self {
            Parameter::Tilt => "°",
            _ => "",
        }
    }

    /// True if a value of the parameter can be negative. A negative value points to the left.
    pub fn is_signed(self) -> bool {
        matches!(self, Parameter::Tilt | Parameter::HorizontalLoad)
    }

    /// Writes a value of the parameter with its unit. A signed value has its direction instead of a sign: `5° left`.
    pub(in crate::products) fn value(self, value: f64) -> String {
        if let Parameter::RobotForce(unit) | Parameter::RobotTorque(unit) = self {
            return amount(value, unit);
        }
        self.written(value, &digits)
    }

    /// Writes an end of an interval at which the frame stands, rounded into the interval. `is_upper` is true for the
    /// upper end.
    pub(in crate::products) fn end(self, value: f64, is_upper: bool) -> String {
        match self {
            Parameter::RobotForce(_) | Parameter::RobotTorque(_) => self.value(value),
            _ if is_upper == (value >= 0.0) => self.written(value, &three_down),
            _ => self.written(value, &three_up),
        }
    }

    /// Writes a value with its unit and its side. `number` writes its size.
    fn written(self, value: f64, number: &dyn Fn(f64) -> String) -> String {
        let unit = self.unit();
        let value = if value.abs() < NOISE { 0.0 } else { value };
        if !self.is_signed() {
            return format!("{}{unit}", number(value));
        }
        let side = match value {
            v if v < 0.0 => " left",
            v if v > 0.0 => " right",
            _ => "",
        };
        let past = if self == Parameter::Tilt && value.abs() > 180.0 { " (past upside down)" } else { "" };
        format!("{}{unit}{side}{past}", number(value.abs()))
    }
}

/// The position of the current value of a parameter relative to the interval of the margin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// The frame stands at this value.
    Inside,
    /// The frame falls at this value.
    Outside,
    /// It is undecided whether the frame stands at this value.
    Unknown,
}

/// One margin of a frame: its interval and its current value.
#[derive(Clone, Debug)]
pub struct StatedMargin<'a> {
    /// The parameter.
    pub parameter: Parameter,
    /// The name of the parameter in words.
    pub name: String,
    /// The values at which the frame stands.
    pub interval: &'a Interval,
    /// The least and the largest current value. They differ if interfaces have different friction, and are infinite
    /// if a robot has no limit. `None` for the friction of a frame without interfaces.
    pub present: Option<(f64, f64)>,
    /// The position of the current value.
    pub position: Position,
}

impl StatedMargin<'_> {
    /// Describes the interval and the current value of the margin: `stands from 0.3 to 2.4; now 1`.
    pub fn sentence(&self) -> String {
        match self.present_words() {
            None => self.stands(),
            Some(present) => format!("{}; {present}", self.stands()),
        }
    }

    /// Describes the interval of the margin without the current value: `stands from 0.3 to 2.4`.
    pub fn stands(&self) -> String {
        stands(self.parameter, self.interval)
    }

    /// Describes the current value, and whether it is outside the interval or undecided: `now 3, outside`. Returns
    /// `None` if there is no current value.
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
            Position::Unknown if is_interval && low == high => format!("{now}, {UNDECIDED}"),
            _ => now,
        })
    }

    /// Returns the two ends of the interval and the current value in words: `0.3`, `no limit`, `1`.
    pub fn ends_and_present(&self) -> [String; 3] {
        let parameter = self.parameter;
        let end = |end: Option<&End>, is_upper: bool| match end {
            None => "no value".to_owned(),
            Some(End::Unbounded) => "no limit".to_owned(),
            Some(End::At { value, .. }) => parameter.end(*value, is_upper),
            Some(End::Unconfirmed { stands, .. }) => format!("at least {}", parameter.end(*stands, is_upper)),
        };
        let ends = match self.interval {
            Interval::Undecided => [UNDECIDED.to_owned(), UNDECIDED.to_owned()],
            interval => [end(interval.low(), false), end(interval.high(), true)],
        };
        let present = match self.present {
            None => "–".to_owned(),
            Some((low, _)) if low.is_infinite() => "no limit".to_owned(),
            Some((low, high)) if low == high => parameter.value(low),
            Some((low, high)) => format!("{} to {}", parameter.value(low), parameter.value(high)),
        };
        let [low, high] = ends;
        [low, high, present]
    }

    /// True if the frame stands at every value of the parameter.
    pub fn has_no_limit(&self) -> bool {
        let free = |end: Option<&End>| matches!(end, Some(End::Unbounded));
        let from_zero = self.interval.low().and_then(confirmed) == Some(0.0);
        self.position == Position::Inside && free(self.interval.high()) && (from_zero || free(self.interval.low()))
    }

    /// Returns the relative distance of the current value from the nearest end of the interval, from 0 to 1. It is 0 if
    /// the frame is not known to stand at the current value. It is 1 if the interval has no end or is undecided, or if
    /// there is no current value.
    ///
    /// The distance to an upper end is divided by the value of this end, and the distance to a lower end by the
    /// current value. There are three exceptions: the distance of a tilt is divided by 90°, that of a kernel by 1
    /// minus the present kernel, and a horizontal force is already a fraction of the weight.
    pub fn reserve(&self) -> f64 {
        if self.position != Position::Inside {
            return 0.0;
        }
        if matches!(self.interval, Interval::Undecided) {
            return 1.0;
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
            _ => [low.filter(|v| *v > 0.0 && least.is_finite()).map(|v| 1.0 - v / least), high.map(|v| 1.0 - most / v)],
        };
        let room = room.into_iter().flatten().filter(|share| !share.is_nan());
        room.fold(1.0, f64::min).max(0.0)
    }
}

/// Returns the value of an end of an interval. If the end is not confirmed, returns the farthest value at which the
/// frame is known to stand. Returns `None` if the interval is unbounded on this side.
pub fn confirmed(end: &End) -> Option<f64> {
    match end {
        End::At { value, .. } => Some(*value),
        End::Unconfirmed { stands, .. } => Some(*stands),
        End::Unbounded => None,
    }
}

/// Describes each margin of a frame in one line, the most important margin first. The notes on margins follow, one
/// line each.
pub fn lines(scene: &Scene, frame_analysis: &FrameAnalysis) -> Vec<String> {
    let stated = stated(scene, frame_analysis);
    let line = |margin: &StatedMargin<'_>| format!("{}: {}", margin.name, margin.sentence());
    let mut lines: Vec<String> = stated.iter().map(line).collect();
    let notes = frame_analysis.margins.iter().flat_map(|margins| &margins.intervals.notes);
    lines.extend(notes.map(|note| format!("note: {note}")));
    lines
}
