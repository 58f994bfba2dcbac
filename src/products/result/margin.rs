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

use super::json::{Json, compact, motions, object};
use crate::mechanics::analysis::{CaseResult, End, Interval, Intervals, Margin, Margins, Sides};
use crate::mechanics::scene::Scene;

/// Writes the margins of a frame as one line of JSON: the value of the key `margins` in the result of the frame.
pub fn margins_json(scene: &Scene, margins: &Margins) -> String {
    compact(&margins_of(scene, margins))
}

/// Returns the value of the key `margins`.
pub(super) fn margins_of<'a>(scene: &'a Scene, found: &'a Margins) -> Json<'a> {
    let moving = |margin: &Margin| match margin {
        Margin::Value { mechanism, .. } => motions(scene, mechanism),
        _ => Json::List(Vec::new()),
    };
    object! {
        friction: end(&found.friction),
        tilt: sides(&found.tilt, end).unless_empty(),
        horizontal_load: sides(&found.horizontal_load, end).unless_empty(),
        kernel: end(&found.kernel),
        load_factor: end(&found.load_factor),
        robots: robots(scene, found, |margin| Json::or_null(end(margin))),
        intervals: parameters(scene, &found.intervals, interval),
        excluded: parameters(scene, &found.intervals, |interval| excluded(scene, interval)).unless_empty(),
        notes: Json::list(&found.intervals.notes).unless_empty(),
        mechanisms: object! {
            friction: moving(&found.friction),
            tilt: sides(&found.tilt, moving),
            horizontal_load: sides(&found.horizontal_load, moving),
            kernel: moving(&found.kernel),
            load_factor: moving(&found.load_factor),
            robots: robots(scene, found, moving),
            intervals: mechanisms(scene, &found.intervals),
        },
    }
}

/// Returns the value of the key `cases` for one load case.
pub(super) fn case(case: &CaseResult) -> Json<'_> {
    let margins = case.margins.as_ref();
    object! {
        id: &case.id,
        verdict: case.verdict.word(),
        load_factor: margins.map(|margins| end(&margins.load_factor)),
        tilt: margins.map(|margins| sides(&margins.tilt, end).unless_empty()),
    }
}

/// Computes a value for each parameter from its interval. Parameters and robots without values are left out.
fn parameters<'a>(scene: &'a Scene, found: &'a Intervals, value: impl Fn(&'a Interval) -> Json<'a>) -> Json<'a> {
    let of = |interval: &'a Option<Interval>| interval.as_ref().map(&value);
    let robots = found.robots.iter().map(|robot| {
        let limits = object! { fx: value(&robot.fx), fy: value(&robot.fy), torque: value(&robot.torque) };
        (scene.robots[robot.robot.0].id.as_str(), limits.unless_empty())
    });
    object! {
        friction: of(&found.friction),
        tilt: of(&found.tilt),
        horizontal_load: of(&found.horizontal_load),
        kernel: of(&found.kernel),
        load_factor: of(&found.load_factor),
        robots: Json::object(robots).unless_empty(),
    }
}

/// Returns the motions that together exclude all values of a parameter, if its interval is empty. Each excludes the
/// values between two ends; an end that is `null` has no limit.
fn excluded<'a>(scene: &'a Scene, interval: &Interval) -> Json<'a> {
    let Interval::Empty(excluded) = interval else { return Json::Absent };
    Json::list(excluded.iter().map(|excluded| {
        object! {
            from: Json::or_null(excluded.from),
            to: Json::or_null(excluded.to),
            mechanism: motions(scene, &excluded.mechanism),
        }
    }))
}

/// Returns how the blocks begin to move just beyond both ends of each interval, the lower end first.
fn mechanisms<'a>(scene: &'a Scene, found: &Intervals) -> Json<'a> {
    let moving = |end: &End| match end {
        End::At { mechanism, .. } => motions(scene, mechanism),
        _ => Json::List(Vec::new()),
    };
    let both = |interval: &Option<Interval>| {
        let interval = interval.as_ref()?;
        Some([moving(interval.low()?), moving(interval.high()?)])
    };
    object! {
        tilt: both(&found.tilt),
        horizontal_load: both(&found.horizontal_load),
        load_factor: both(&found.load_factor),
    }
}

/// Returns an interval: two ends, `null` if it is empty, or a word if no verdict confirms it.
fn interval<'a>(interval: &Interval) -> Json<'a> {
    const WITHHELD_VALUE: &str = "withheld";
    let end = |end: &End| match end {
        End::At { value, .. } => Json::Number(*value),
        End::Unbounded => Json::Null,
        _ => WITHHELD_VALUE.into(),
    };
    match interval {
        Interval::Between { low, high } => [end(low), end(high)].into(),
        Interval::Empty(_) => Json::Null,
        _ => WITHHELD_VALUE.into(),
    }
}

fn end<'a>(margin: &Margin) -> Json<'a> {
    match margin {
        Margin::Value { at, .. } => Json::Number(*at),
        Margin::None | Margin::NotApplicable | Margin::Undecided | Margin::Unconfirmed { .. } => Json::Null,
        Margin::NotAsked => Json::Absent,
        Margin::Unbounded => "unbounded".into(),
    }
}

fn sides<'a>(of: &Sides, described: impl Fn(&Margin) -> Json<'a>) -> Json<'a> {
    object! { left: described(&of.left), right: described(&of.right) }
}

fn robots<'a>(scene: &'a Scene, found: &Margins, described: impl Fn(&Margin) -> Json<'a>) -> Json<'a> {
    Json::object(found.robots.iter().map(|robot| {
        let limits = object! {
            fx: described(&robot.fx),
            fy: described(&robot.fy),
            torque: described(&robot.torque),
        };
        (scene.robots[robot.robot.0].id.as_str(), limits)
    }))
}
