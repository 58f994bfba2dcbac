//! Writes margins as JSON. A margin is one end of the interval of values at which the frame stands, or `"unbounded"` if the
//! interval has no end in this direction. It is `null` if there is no value to state: the frame stands at no value, the
//! margin does not apply to the scene, or no verdict confirms it.
//!
//! A tilt or a horizontal load is also `null` if the frame falls without it, even if the frame stands at another value. If
//! no verdict confirms a margin, a notice of the frame then states the two values between which the margin
//! lies. Margins that were not requested are absent.
//!
//! `intervals` has both ends of the interval of each parameter. An end is `null` if the interval has no end there,
//! and `"withheld"` if no verdict confirms it. An interval is `null` if the frame stands at no value; `excluded` then
//! has the motions that exclude all values.

use serde::{Serialize, Serializer};

use super::{Motion, Number, compact};
use crate::mechanics::analysis::{
    End as Limit, Exclusion, Interval, Intervals as Sets, Margin, Margins as Found, Sides as Either,
};
use crate::mechanics::scene::Scene;

/// Writes the margins of a frame as one line of JSON: the value of the key `margins` in the result of the frame.
pub fn margins_json(scene: &Scene, margins: &Found) -> String {
    compact(&Margins::new(scene, margins))
}

#[derive(Serialize)]
pub(super) struct Margins<'a> {
    #[serde(skip_serializing_if = "End::is_left_out")]
    friction: End,
    #[serde(skip_serializing_if = "Sides::is_left_out")]
    tilt: Sides<End>,
    #[serde(skip_serializing_if = "Sides::is_left_out")]
    horizontal_load: Sides<End>,
    #[serde(skip_serializing_if = "End::is_left_out")]
    kernel: End,
    #[serde(skip_serializing_if = "End::is_left_out")]
    load_factor: End,
    robots: Named<'a, Limits<End>>,
    /// The values of each parameter at which the frame stands. Parameters that were not requested, or that do not apply
    /// to the scene, are left out.
    intervals: Parameters<'a, Range>,
    /// For each parameter whose interval is empty, the motions that prove that the frame falls at every value.
    #[serde(skip_serializing_if = "Parameters::is_empty")]
    excluded: Parameters<'a, Vec<Reason<'a>>>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
    mechanisms: Mechanisms<'a>,
}

/// A value for each parameter. Parameters without a value are left out.
#[derive(Serialize)]
struct Parameters<'a, T: Serialize> {
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizontal_load: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kernel: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load_factor: Option<T>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    robots: Named<'a, RobotParameters<T>>,
}

/// A value for each limit of a robot. Limits without a value are left out.
#[derive(Serialize)]
struct RobotParameters<T> {
    #[serde(skip_serializing_if = "Option::is_none")]
    fx: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fy: Option<T>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque: Option<T>,
}

/// A list of keys and values that is written as a JSON object. The keys keep their order.
struct Named<'a, T>(Vec<(&'a str, T)>);

impl<T> Named<'_, T> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Serialize> Serialize for Named<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// An interval of values at which the frame falls by one motion. An end that is `null` has no limit.
#[derive(Serialize)]
struct Reason<'a> {
    from: Option<Number>,
    to: Option<Number>,
    mechanism: Vec<Motion<'a>>,
}

/// An interval: two ends, `null` if it is empty, or `"withheld"`.
#[derive(Serialize)]
#[serde(untagged)]
enum Range {
    Empty,
    Between([RangeEnd; 2]),
    Withheld(&'static str),
}

#[derive(Serialize)]
#[serde(untagged)]
enum RangeEnd {
    At(Number),
    Unbounded,
    Withheld(&'static str),
}

/// This word replaces a value that no verdict confirms.
const WITHHELD_VALUE: &str = "withheld";

/// How the blocks begin to move just beyond each margin.
#[derive(Serialize)]
struct Mechanisms<'a> {
    friction: Vec<Motion<'a>>,
    tilt: Sides<Vec<Motion<'a>>>,
    horizontal_load: Sides<Vec<Motion<'a>>>,
    kernel: Vec<Motion<'a>>,
    load_factor: Vec<Motion<'a>>,
    robots: Named<'a, Limits<Vec<Motion<'a>>>>,
    intervals: IntervalMechanisms<'a>,
}

/// How the blocks begin to move just beyond both ends of an interval, the lower end first.
#[derive(Serialize)]
struct IntervalMechanisms<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<[Vec<Motion<'a>>; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizontal_load: Option<[Vec<Motion<'a>>; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load_factor: Option<[Vec<Motion<'a>>; 2]>,
}

#[derive(Serialize)]
pub(super) struct Sides<T> {
    pub(super) left: T,
    pub(super) right: T,
}

#[derive(Serialize)]
struct Limits<T> {
    fx: T,
    fy: T,
    torque: T,
}

#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum End {
    At(Number),
    None,
    Unbounded(&'static str),
    /// Left out of the object.
    NotAsked,
}

impl End {
    pub(super) fn is_left_out(&self) -> bool {
        matches!(self, End::NotAsked)
    }
}

impl Sides<End> {
    pub(super) fn is_left_out(&self) -> bool {
        self.left.is_left_out()
    }
}

impl<'a> Margins<'a> {
    pub(super) fn new(scene: &'a Scene, found: &'a Found) -> Margins<'a> {
        let motions = |margin: &Margin| match margin {
            Margin::Value { mechanism, .. } => mechanism.iter().map(|m| Motion::new(scene, m)).collect(),
            _ => Vec::new(),
        };
        Margins {
            friction: end(&found.friction),
            tilt: sides(&found.tilt, end),
            horizontal_load: sides(&found.horizontal_load, end),
            kernel: end(&found.kernel),
            load_factor: end(&found.load_factor),
            robots: robots(scene, found, end),
            intervals: Parameters::new(scene, &found.intervals, |interval| Some(range(interval))),
            excluded: Parameters::new(scene, &found.intervals, |interval| reasons(scene, interval)),
            notes: &found.intervals.notes,
            mechanisms: Mechanisms {
                friction: motions(&found.friction),
                tilt: sides(&found.tilt, motions),
                horizontal_load: sides(&found.horizontal_load, motions),
                kernel: motions(&found.kernel),
                load_factor: motions(&found.load_factor),
                robots: robots(scene, found, motions),
                intervals: IntervalMechanisms::new(scene, &found.intervals),
            },
        }
    }
}

impl<'a, T: Serialize> Parameters<'a, T> {
    /// Computes the value of each parameter from its interval. A robot without values is left out.
    fn new(scene: &'a Scene, found: &Sets, value: impl Fn(&Interval) -> Option<T>) -> Parameters<'a, T> {
        let of = |interval: &Option<Interval>| value(interval.as_ref()?);
        let robots = found.robots.iter().filter_map(|robot| {
            let limits = RobotParameters { fx: value(&robot.fx), fy: value(&robot.fy), torque: value(&robot.torque) };
            let is_any = limits.fx.is_some() || limits.fy.is_some() || limits.torque.is_some();
            is_any.then(|| (scene.robots[robot.robot.0].id.as_str(), limits))
        });
        Parameters {
            friction: of(&found.friction),
            tilt: of(&found.tilt),
            horizontal_load: of(&found.horizontal_load),
            kernel: of(&found.kernel),
            load_factor: of(&found.load_factor),
            robots: Named(robots.collect()),
        }
    }

    fn is_empty(&self) -> bool {
        [&self.friction, &self.tilt, &self.horizontal_load, &self.kernel, &self.load_factor].iter().all(|p| p.is_none())
            && self.robots.is_empty()
    }
}

fn reasons<'a>(scene: &'a Scene, interval: &Interval) -> Option<Vec<Reason<'a>>> {
    let Interval::Empty(excluded) = interval else { return None };
    let reason = |excluded: &Exclusion| Reason {
        from: excluded.from.map(Number),
        to: excluded.to.map(Number),
        mechanism: excluded.mechanism.iter().map(|m| Motion::new(scene, m)).collect(),
    };
    Some(excluded.iter().map(reason).collect())
}

impl<'a> IntervalMechanisms<'a> {
    fn new(scene: &'a Scene, found: &Sets) -> IntervalMechanisms<'a> {
        let motions = |end: &Limit| match end {
            Limit::At { mechanism, .. } => mechanism.iter().map(|m| Motion::new(scene, m)).collect(),
            _ => Vec::new(),
        };
        let both = |interval: &Option<Interval>| {
            let interval = interval.as_ref()?;
            Some([motions(interval.low()?), motions(interval.high()?)])
        };
        IntervalMechanisms {
            tilt: both(&found.tilt),
            horizontal_load: both(&found.horizontal_load),
            load_factor: both(&found.load_factor),
        }
    }
}

fn range(interval: &Interval) -> Range {
    let end = |end: &Limit| match end {
        Limit::At { value, .. } => RangeEnd::At(Number(*value)),
        Limit::Unbounded => RangeEnd::Unbounded,
        _ => RangeEnd::Withheld(WITHHELD_VALUE),
    };
    match interval {
        Interval::Between { low, high } => Range::Between([end(low), end(high)]),
        Interval::Empty(_) => Range::Empty,
        _ => Range::Withheld(WITHHELD_VALUE),
    }
}

pub(super) fn end(margin: &Margin) -> End {
    match margin {
        Margin::Value { at, .. } => End::At(Number(*at)),
        Margin::None | Margin::NotApplicable | Margin::Undecided | Margin::Unconfirmed { .. } => End::None,
        Margin::NotAsked => End::NotAsked,
        Margin::Unbounded => End::Unbounded("unbounded"),
    }
}

pub(super) fn sides<T>(of: &Either, described: impl Fn(&Margin) -> T) -> Sides<T> {
    Sides { left: described(&of.left), right: described(&of.right) }
}

fn robots<'a, T>(scene: &'a Scene, found: &Found, described: impl Fn(&Margin) -> T) -> Named<'a, Limits<T>> {
    let robots = found.robots.iter().map(|robot| {
        let limits = Limits { fx: described(&robot.fx), fy: described(&robot.fy), torque: described(&robot.torque) };
        (scene.robots[robot.robot.0].id.as_str(), limits)
    });
    Named(robots.collect())
}
