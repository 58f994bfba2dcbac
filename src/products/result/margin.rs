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
use super::question::movement;
use crate::mechanics::analysis::{CaseResult, End, Interval, MarginKind, Margins};
use crate::mechanics::scene::Scene;

/// Writes the margins of a frame as one line of JSON: the value of the key `margins` in the result of the frame.
pub fn margins_json(scene: &Scene, margins: &Margins) -> String {
    compact(&margins_of(scene, margins))
}

/// Returns the value of the key `margins`.
pub(super) fn margins_of<'a>(scene: &'a Scene, found: &'a Margins) -> Json<'a> {
    let beyond = |end: Option<&End>| match end {
        Some(End::At { mechanism, .. }) => motions(scene, mechanism),
        _ => Json::List(Vec::new()),
    };
    let robots = |read: &dyn Fn(Option<&End>) -> Json<'a>| of_robots(scene, found, |interval| read(interval.low()));
    let own = MarginKind::of_frame().map(|kind| (kind.word(), margin(found, kind)));
    let mechanisms = MarginKind::of_frame().map(|kind| (kind.word(), ends(found, kind, |end, _| beyond(end))));
    // Where the loads of the structure as it is change, both ends of the interval have a motion.
    let has_both = |kind: &MarginKind| kind.changes_loads() && kind.about().structure.is_none();
    let both = MarginKind::of_frame().filter(has_both).map(|kind| {
        let interval = found.of(kind).filter(|interval| interval.low().is_some());
        (kind.word(), interval.map(|interval| [beyond(interval.low()), beyond(interval.high())]).into())
    });
    Json::object(own).and(object! {
        robots: robots(&|end| value(end, 1.0)),
        intervals: each(scene, found, interval),
        excluded: each(scene, found, |interval| excluded(scene, interval)).unless_empty(),
        notes: Json::list(&found.notes).unless_empty(),
        mechanisms: Json::object(mechanisms).and(object! {
            robots: robots(&beyond),
            intervals: Json::object(both),
        }),
    })
}

/// Returns the value of the key `cases` for one load case.
pub(super) fn case<'a>(scene: &'a Scene, case: &'a CaseResult) -> Json<'a> {
    let margins = case.margins.as_ref();
    object! {
        id: &case.id,
        verdict: case.verdict.word(),
        load_factor: margins.map(|margins| margin(margins, MarginKind::LoadFactor)),
        tilt: margins.map(|margins| margin(margins, MarginKind::Tilt)),
        movements: Json::list(case.movements.iter().map(|moved| movement(scene, moved))).unless_empty(),
    }
}

/// Returns the margin of a kind; absent if it was not requested.
fn margin<'a>(found: &Margins, kind: MarginKind) -> Json<'a> {
    if found.kinds.has(kind) { ends(found, kind, value) } else { Json::Absent }
}

/// Describes the ends of the interval of a kind that are margins: one, or one to the left and one to the right. `described`
/// also gets the sign of the margin: −1 to the left, otherwise 1.
fn ends<'a>(found: &Margins, kind: MarginKind, described: impl Fn(Option<&End>, f64) -> Json<'a>) -> Json<'a> {
    let end = |end: usize, sign: f64| described(found.end(kind, end), sign);
    match kind.about().ends {
        [true, true] => object! { left: end(0, -1.0), right: end(1, 1.0) },
        [_, is_upper] => end(usize::from(is_upper), 1.0),
    }
}

/// Computes a value for each parameter from its interval. Parameters and robots without values are left out.
fn each<'a>(scene: &'a Scene, found: &'a Margins, value: impl Fn(&Interval) -> Json<'a>) -> Json<'a> {
    let own = MarginKind::of_frame().map(|kind| (kind.word(), found.of(kind).map(&value).into()));
    Json::object(own).and(object! { robots: of_robots(scene, found, value).unless_empty() })
}

/// Computes a value for each limit of each robot from its interval.
fn of_robots<'a>(scene: &'a Scene, found: &Margins, value: impl Fn(&Interval) -> Json<'a>) -> Json<'a> {
    Json::object(found.robots().map(|(robot, limits)| {
        let [fx, fy, torque] = limits.map(&value);
        (scene.robots[robot.0].id.as_str(), object! { fx: fx, fy: fy, torque: torque }.unless_empty())
    }))
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

/// Returns the value of a margin, times its sign.
fn value<'a>(end: Option<&End>, sign: f64) -> Json<'a> {
    match end {
        Some(End::At { value, .. }) => Json::Number(sign * value),
        Some(End::Unbounded) => "unbounded".into(),
        _ => Json::Null,
    }
}
