//! Describes margins in words. A margin is the interval of values of a parameter at which a frame stands, compared
//! with the current value.
//!
//! The terminal, tables, bars, captions and the headline all use [`StatedMargin`].

mod governing;

#[cfg(any(feature = "report", feature = "cli"))]
pub use governing::headline;
pub use governing::{Governing, OtherFriction, governing};

use super::failure::shortened;
use super::number::{amount, digits, listed, three_down, three_up};
use super::question;
use crate::geometry::range_of;
use crate::mechanics::analysis::{
    Condition, End, Exclusion, FALLS, FrameAnalysis, Interval, Margin, MarginKind, Margins, STANDS, SolvedFrame,
    UNDECIDED, Verdict,
};
use crate::mechanics::scene::{Scene, Unit};
use crate::text;

/// Smaller values of a parameter are rounding errors.
const NOISE: f64 = 1e-9;

/// Writes a value of a parameter with its unit. A signed value has its direction instead of a sign: `5° left`.
pub(in crate::products) fn value(kind: MarginKind, value: f64) -> String {
    written(kind, value, digits)
}

/// Writes an end of an interval at which the frame stands, rounded into the interval. `is_upper` is true for the upper
/// end.
pub(in crate::products) fn end(kind: MarginKind, value: f64, is_upper: bool) -> String {
    written(kind, value, if is_upper == (value >= 0.0) { three_down } else { three_up })
}

/// Writes a value with its unit and its side. `number` writes its size.
fn written(kind: MarginKind, value: f64, number: fn(f64) -> String) -> String {
    let unit = kind.about().unit;
    let value = if value.abs() < NOISE { 0.0 } else { value };
    if !kind.is_signed() {
        return format!("{}{unit}", number(value));
    }
    let side = side(value);
    let past = if kind == MarginKind::Tilt && value.abs() > 180.0 { " (past upside down)" } else { "" };
    format!("{}{unit}{side}{past}", number(value.abs()))
}

/// Returns the word in place of the sign of a tilt or a horizontal load; empty for 0.
pub(super) fn side(value: f64) -> &'static str {
    match value {
        v if v < 0.0 => " left",
        v if v > 0.0 => " right",
        _ => "",
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
    pub kind: MarginKind,
    /// The unit of the limit of a robot.
    unit: Option<Unit>,
    /// The name of the parameter in words.
    pub name: String,
    /// What the parameter multiplies, if it is a factor.
    multiplied: String,
    /// The values at which the frame stands.
    pub interval: &'a Interval,
    /// The least and the largest current value. They differ if interfaces have different friction, and are infinite
    /// if a robot has no limit. `None` for the friction of a frame without interfaces.
    pub present: Option<(f64, f64)>,
    /// The position of the current value.
    pub position: Position,
    /// The conditions that decide the lower and the upper end.
    pub conditions: [Condition; 2],
    /// The names of the conditions that decide the ends, if the scene has load cases or a vehicle.
    pub governed: Option<String>,
}

impl StatedMargin<'_> {
    /// True if the joints have different values now: friction coefficients.
    fn differs(&self) -> bool {
        self.present.is_some_and(|(low, high)| low < high)
    }

    /// Describes the interval and the current value of the margin: `stands from 0.3 to 2.4; now 1`.
    pub fn sentence(&self) -> String {
        let governed = self.governed.as_ref().map(|names| format!("governed by {names}"));
        // One coefficient everywhere is another structure than one with different coefficients.
        let stands = match self.present {
            Some((low, _)) if self.kind == MarginKind::Friction && self.differs() => {
                let smooth = if low == 0.0 { ", smooth ones too" } else { "" };
                format!("{}, the same at all joints{smooth}", self.stands())
            }
            _ => self.stands(),
        };
        [Some(stands), self.present_words(), governed].into_iter().flatten().collect::<Vec<_>>().join("; ")
    }

    /// Writes a value of the parameter.
    fn value(&self, value: f64) -> String {
        self.unit.map_or_else(|| self::value(self.kind, value), |unit| amount(value, unit))
    }

    /// Writes an end of the interval, rounded into the interval.
    fn end(&self, end: f64, is_upper: bool) -> String {
        self.unit.map_or_else(|| self::end(self.kind, end, is_upper), |unit| amount(end, unit))
    }

    /// Describes the current value, and whether it is outside the interval or undecided: `now 3, outside`. Returns
    /// `None` if there is no current value.
    fn present_words(&self) -> Option<String> {
        let (low, high) = self.present?;
        let value = |value: f64| self.value(value);
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
        let end = |end: Option<&End>, is_upper: bool| match end {
            None => "no value".to_owned(),
            Some(End::Unbounded) => "no limit".to_owned(),
            Some(End::At { value, .. }) => self.end(*value, is_upper),
            Some(End::Unconfirmed { stands, .. }) => format!("at least {}", self.end(*stands, is_upper)),
        };
        let ends = match self.interval {
            Interval::Undecided => [UNDECIDED.to_owned(), UNDECIDED.to_owned()],
            interval => [end(interval.low(), false), end(interval.high(), true)],
        };
        let present = match self.present {
            None => "–".to_owned(),
            Some((low, _)) if low.is_infinite() => "no limit".to_owned(),
            Some((low, high)) if low == high => self.value(low),
            Some((low, high)) => format!("{} to {}", self.value(low), self.value(high)),
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
        let room = match self.kind {
            MarginKind::Tilt => [low.map(|v| -v / 90.0), high.map(|v| v / 90.0)],
            MarginKind::HorizontalLoad => [low.map(|v| -v), high],
            MarginKind::Kernel => [None, high.map(|v| (v - most) / (1.0 - most))],
            _ => [low.filter(|v| *v > 0.0 && least.is_finite()).map(|v| 1.0 - v / least), high.map(|v| 1.0 - most / v)],
        };
        let room = room.into_iter().flatten().filter(|share| !share.is_nan());
        room.fold(1.0, f64::min).max(0.0)
    }

    /// Describes at which values of a parameter the frame stands: `stands from 0.3 to 2.4`.
    pub fn stands(&self) -> String {
        let (low, high) = match self.interval {
            Interval::Between { low, high } => (low, high),
            Interval::Empty(excluded) => {
                let none = match self.kind {
                    kind if kind.multiplies_loads() => "stands under no multiple of its loads".to_owned(),
                    MarginKind::FrictionFactor => format!("stands with no multiple of {}", self.multiplied),
                    _ => "stands at no value".to_owned(),
                };
                return match conflict(excluded) {
                    Some([low, high]) => {
                        let [low, high] = [low, high].map(|value| self.value(value));
                        if self.kind.is_signed() {
                            format!("{none}: {FALLS} to the left of {low}, and {FALLS} to the right of {high}")
                        } else {
                            format!("{none}: {FALLS} below {low}, and {FALLS} above {high}")
                        }
                    }
                    None => none,
                };
            }
            Interval::Undecided => return format!("no verdict shows at which values it {STANDS}"),
        };
        let unconfirmed = [("lower", low), ("upper", high)].into_iter().filter_map(|(name, end)| {
            let End::Unconfirmed { stands, beyond } = end else {
                return None;
            };
            let value = |value: f64| self.value(value);
            Some(if beyond.is_finite() {
                let [stands, beyond] = [value(*stands), value(*beyond)];
                format!(" ({name} end not confirmed: between {stands} and {beyond})")
            } else {
                format!(" ({name} end not confirmed: beyond {})", value(*stands))
            })
        });
        let unconfirmed: String = unconfirmed.collect();
        format!("{STANDS} {}{unconfirmed}", self.range(low, high))
    }

    /// Describes the values between the two ends of an interval: `from 0.3 to 2.4`.
    fn range(&self, low: &End, high: &End) -> String {
        // If the parameter cannot be negative, do not write a lower end of 0.
        let begins = |low: &f64| self.kind.is_signed() || *low > 0.0;
        let least = confirmed(low).filter(begins);
        let most = confirmed(high);
        let least_words = |value: f64| self.end(value, false);
        let value = |value: f64| self.end(value, true);
        // An interval that is shorter than the rounding is one value.
        let is_one = |low: f64, high: f64| self.value(low) == self.value(high);
        if self.kind.multiplies_loads() || self.kind == MarginKind::FrictionFactor {
            let factor = match (least, most) {
                (None, None) => "any factor".to_owned(),
                (None, Some(high)) => format!("at most {}", value(high)),
                (Some(low), None) => format!("at least {}", least_words(low)),
                (Some(low), Some(high)) if is_one(low, high) => self.value(low),
                (Some(low), Some(high)) => format!("{} to {}", least_words(low), value(high)),
            };
            return format!("with {} times {factor}", self.multiplied);
        }
        match (least, most) {
            (None, None) => "at any value".to_owned(),
            (None, Some(high)) if self.kind.is_signed() => {
                format!("up to {}, without a limit to the left", value(high))
            }
            (Some(low), None) if self.kind.is_signed() => {
                format!("from {} on, without a limit to the right", least_words(low))
            }
            (None, Some(high)) => format!("up to {}", value(high)),
            (Some(low), None) => format!("at {} and more", least_words(low)),
            // If both ends have the same text, they are equal at the printed precision.
            (Some(low), Some(high)) if is_one(low, high) => format!("only at {}", self.value(low)),
            (Some(low), Some(high)) => format!("from {} to {}", least_words(low), value(high)),
        }
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
pub fn lines(solved: SolvedFrame<'_>) -> Vec<String> {
    let SolvedFrame { found: frame_analysis, .. } = solved;
    let stated = stated(solved);
    let line = |margin: &StatedMargin<'_>| format!("{}: {}", margin.name, margin.sentence());
    let mut lines: Vec<String> = stated.iter().map(line).collect();
    let notes = frame_analysis.margins.iter().flat_map(|margins| &margins.notes);
    lines.extend(notes.map(|note| format!("note: {note}")));
    lines
}

/// Two collapse motions may together exclude all values of a parameter: one excludes all values below a, the other all
/// values above b. Returns `[a, b]`, or `None` if there are no such motions.
fn conflict(excluded: &[Exclusion]) -> Option<[f64; 2]> {
    match excluded {
        [below, above] if below.from.is_none() && above.to.is_none() => Some([below.to?, above.from?]),
        _ => None,
    }
}

/// Returns all computed margins of a frame. The most important margin, which the headline describes, comes first.
pub fn stated<'a>(solved: SolvedFrame<'a>) -> Vec<StatedMargin<'a>> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let Some(margins) = &frame_analysis.margins else {
        return Vec::new();
    };
    let position = match frame_analysis.verdict {
        Verdict::Stable => Position::Inside,
        Verdict::Unstable => Position::Outside,
        Verdict::Undecided => Position::Unknown,
    };
    let margin = |kind: MarginKind| {
        let Margin { interval, conditions, .. } = margins.margin(kind)?;
        let present = match kind {
            MarginKind::Friction => friction(frame_analysis),
            _ => kind.about().present.or(Some(scene.kernel)).map(|present| (present, present)),
        };
        let position = match kind {
            MarginKind::Friction => friction_position(interval, present, position),
            // The verdict on the frame is not the verdict on the changed structure.
            _ if kind.about().structure.is_some() => match interval {
                Interval::Undecided => Position::Unknown,
                interval if interval.contains(1.0) => Position::Inside,
                _ => Position::Outside,
            },
            _ => position,
        };
        let governed = governed(frame_analysis, interval, *conditions);
        let smooth = || smooth_joints(solved);
        let name = match kind {
            MarginKind::Overturning => format!("{}{}", kind.about().name, smooth()),
            _ => kind.about().name.to_owned(),
        };
        let multiplied = match kind {
            MarginKind::FrictionFactor => question::factored_friction(scene),
            _ => "its loads".to_owned(),
        };
        let conditions = *conditions;
        Some(StatedMargin { kind, unit: None, name, multiplied, interval, present, position, conditions, governed })
    };
    // With one coefficient, the factor on the friction says the same as the coefficient.
    let is_same = |kind: MarginKind| {
        let is_alike = friction(frame_analysis).is_none_or(|(least, most)| least == most);
        kind == MarginKind::FrictionFactor
            && is_alike
            && scene.factored_sets().next().is_none()
            && margins.of(MarginKind::Friction).is_some()
    };
    let kinds = MarginKind::of_frame().filter(|kind| !is_same(*kind));
    let mut list: Vec<StatedMargin<'_>> = kinds.filter_map(margin).collect();
    list.sort_by_key(|margin| margin.kind != MarginKind::LoadFactor);
    list.extend(robot_limits(scene, margins, position));
    if let Some(first) = most_important(&list) {
        list[..=first].rotate_right(1);
    }
    list
}

/// Names the smooth joints, because they cannot slide either: `, smooth 1 / wall too`. Empty without smooth joints.
fn smooth_joints(solved: SolvedFrame<'_>) -> String {
    let SolvedFrame { scene, found, .. } = solved;
    let smooth = found.contacts.iter().filter(|contact| contact.interface.friction == 0.0);
    let names = smooth.map(|contact| contact.interface.bodies.map(|body| text::line(scene.name(body))).join(" / "));
    let names = shortened(names.collect(), MAX_SMOOTH_NAMED);
    if names.is_empty() { String::new() } else { format!(", smooth {} too", listed(&names)) }
}

/// At most this many smooth joints are named.
const MAX_SMOOTH_NAMED: usize = 3;

/// Names the conditions that decide the ends of an interval. An end of the range of the parameter, such as friction 0, is
/// decided by none.
fn governed(found: &FrameAnalysis, interval: &Interval, conditions: [Condition; 2]) -> Option<String> {
    let is_decided = |end: Option<&End>| match end {
        None => true,
        Some(End::At { mechanism, .. }) => !mechanism.is_empty(),
        Some(end) => *end != End::Unbounded,
    };
    let ends = [interval.low(), interval.high()].into_iter().zip(conditions);
    question::conditions(found, ends.filter(|(end, _)| is_decided(*end)).map(|(_, condition)| condition))
}

/// Returns the margins for the force and torque limits of each robot.
fn robot_limits<'a>(scene: &Scene, margins: &'a Margins, position: Position) -> Vec<StatedMargin<'a>> {
    let (force, torque) = (scene.units.force(), scene.units.torque());
    let mut list = Vec::new();
    for (robot, [fx, fy, spin]) in margins.robots() {
        let arm = &scene.robots[robot.0];
        let (id, limits) = (text::line(&arm.id), arm.limits);
        let all = [
            (force, "horizontal force", fx, limits.fx),
            (force, "vertical force", fy, limits.fy),
            (torque, "torque", spin, limits.torque),
        ];
        list.extend(all.map(|(unit, name, interval, limit)| StatedMargin {
            kind: MarginKind::Robots,
            unit: Some(unit),
            name: format!("limit of the {name} of robot {id}"),
            multiplied: String::new(),
            interval,
            present: Some((limit, limit)),
            position,
            conditions: Default::default(),
            governed: None,
        }));
    }
    list
}

/// Returns the index of the most important margin. This is the load factor, if the list has it and it has a limit.
/// Otherwise it is the margin with the smallest [`StatedMargin::reserve`]. Returns `None` for an empty list.
fn most_important(list: &[StatedMargin<'_>]) -> Option<usize> {
    let loads = list.iter().position(|m| m.kind == MarginKind::LoadFactor && !m.has_no_limit());
    // One coefficient everywhere is another structure than one with several, for which there is the factor.
    let has_factor = list.iter().any(|margin| margin.kind == MarginKind::FrictionFactor);
    let is_other = |margin: &StatedMargin<'_>| {
        has_factor && margin.kind == MarginKind::Friction && margin.differs() || margin.kind.about().structure.is_some()
    };
    let reserves = list.iter().enumerate().filter(|(_, margin)| !is_other(margin));
    let reserves = reserves.map(|(place, margin)| (place, margin.reserve()));
    loads.or_else(|| reserves.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(first, _)| first))
}

/// Returns the smallest and the largest friction coefficient of the frame's interfaces, or `None` if there are no
/// interfaces.
fn friction(frame_analysis: &FrameAnalysis) -> Option<(f64, f64)> {
    let all = frame_analysis.contacts.iter().map(|contact| contact.interface.friction);
    (!frame_analysis.contacts.is_empty()).then(|| range_of(all))
}

/// Returns the position of the present friction coefficients relative to the interval of the friction margin. This
/// interval assumes one coefficient at all interfaces. `alike` is the result if all present coefficients are equal, or
/// if there are no interfaces.
fn friction_position(interval: &Interval, present: Option<(f64, f64)>, alike: Position) -> Position {
    match present {
        Some((low, high)) if low < high => match (interval.contains(low), interval.contains(high)) {
            (true, true) => Position::Inside,
            (false, false) if !matches!(interval, Interval::Undecided) => Position::Outside,
            _ => Position::Unknown,
        },
        _ => alike,
    }
}
