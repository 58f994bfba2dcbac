//! Writes the text below the verdict in a figure of a margin: the values of the parameter (tilt, horizontal load or
//! load factor) at which the structure begins to fall or would stand.

use crate::mechanics::analysis::{Analysis, End, Interval, Toward, Verdict};
use crate::products::wording::margin::{Parameter, stands};
use crate::products::wording::number::digits;

use super::super::words::{degrees, percent};

/// Describes for which tilts of gravity, horizontal loads or load factors a frame stands. `toward` selects the
/// parameter.
pub(super) fn sentence(analysis: &Analysis, frame: usize, toward: Toward) -> String {
    let frame_analysis = &analysis.frames[frame];
    let Some(margins) = &frame_analysis.margins else {
        return "its margins were not computed".to_owned();
    };
    let intervals = &margins.intervals;
    let interval = match toward {
        Toward::Tilt => &intervals.tilt,
        Toward::HorizontalLoad => &intervals.horizontal_load,
        Toward::LoadFactor => &intervals.load_factor,
    };
    let Some(interval) = interval else {
        return match toward {
            Toward::LoadFactor => "it has no loads that could grow",
            Toward::Tilt | Toward::HorizontalLoad => "its margin was not computed",
        }
        .to_owned();
    };
    match (frame_analysis.verdict, interval) {
        (Verdict::Stable, _) => standing(analysis, frame, toward, interval),
        (verdict, Interval::Between { .. }) => {
            let now = match verdict {
                Verdict::Undecided => "undecided",
                Verdict::Stable | Verdict::Unstable => "falls",
            };
            let what = match toward {
                Toward::Tilt => "with gravity turned: ",
                Toward::HorizontalLoad => "with a horizontal load, as a share of each weight: ",
                Toward::LoadFactor => "",
            };
            format!("{now} as it is; {what}{}", stands(stated(toward), interval))
        }
        (_, Interval::Empty(_)) => format!("falls at every {}", parameter(toward)),
        (_, Interval::Undecided) => {
            format!("no {} is known at which it stands", parameter(toward))
        }
    }
}

/// Converts the parameter of a figure to the parameter of the sentences in [`wording`](crate::products::wording::margin).
fn stated(toward: Toward) -> Parameter {
    match toward {
        Toward::Tilt => Parameter::Tilt,
        Toward::HorizontalLoad => Parameter::HorizontalLoad,
        Toward::LoadFactor => Parameter::LoadFactor,
    }
}

/// Returns the name of a parameter for a sentence.
fn parameter(toward: Toward) -> &'static str {
    match toward {
        Toward::Tilt => "tilt of gravity",
        Toward::HorizontalLoad => "horizontal load",
        Toward::LoadFactor => "factor on its loads",
    }
}

/// Describes the margin of a frame that stands: the values at which it begins to fall. An end that does not exist or is
/// not confirmed is left out. If no end remains (for the load factor: no upper end), the text says that the frame never
/// falls, or that its margin was not confirmed.
fn standing(analysis: &Analysis, frame: usize, toward: Toward, interval: &Interval) -> String {
    // If the value is below 1, it is the least load factor, which does not limit how much the loads may grow.
    let is_upper = |edge: &f64| toward != Toward::LoadFactor || *edge >= 1.0;
    let edge = analysis.edge(frame, toward).map(|(edge, _)| edge);
    if let Some(edge) = edge.filter(is_upper) {
        if let Some(words) = only_at_zero(toward, interval) {
            return words.into();
        }
        return match toward {
            Toward::Tilt => {
                let turn = |edge: f64| degrees(edge.abs());
                format!("falls once gravity is turned by {}", both_ends(edge, interval, turn))
            }
            Toward::HorizontalLoad => {
                let push = |edge: f64| format!("{} of each weight", percent_of(edge));
                format!("falls once pushed by {}", both_ends(edge, interval, push))
            }
            Toward::LoadFactor => {
                let below = least_factor(interval);
                let below = below.map_or_else(String::new, |low| format!(", or less than {} times", digits(low)));
                format!("falls once its loads are {} times as large{below}", digits(edge))
            }
        };
    }
    match (interval, toward) {
        (Interval::Between { low, high }, _) if is_open(low) || is_open(high) => {
            "its margin was not confirmed by the verdicts on both sides of it".to_owned()
        }
        (Interval::Between { .. }, Toward::Tilt) => "no tilt of gravity makes it fall".to_owned(),
        (Interval::Between { .. }, Toward::HorizontalLoad) => "no horizontal load makes it fall".to_owned(),
        (Interval::Between { .. }, Toward::LoadFactor) => match least_factor(interval) {
            None => "its loads may grow without limit".to_owned(),
            Some(low) => {
                format!("its loads may grow without limit; falls once they are {} times as large", digits(low))
            }
        },
        _ => "its margin was not found".to_owned(),
    }
}

/// Returns the sentence about a frame that stands only without a tilt or a horizontal load. `None` for other intervals, and
/// for the load factor.
fn only_at_zero(toward: Toward, interval: &Interval) -> Option<&'static str> {
    let ends = [interval.low(), interval.high()].map(|end| end.and_then(End::value));
    let is_zero = |end: &Option<f64>| end.is_some_and(|v| v.abs() < SAME_AS_ZERO);
    match toward {
        _ if !ends.iter().all(is_zero) => None,
        Toward::Tilt => Some("stands only without a tilt; falls once gravity is turned to either side"),
        Toward::HorizontalLoad => Some("stands only without a horizontal load; falls once pushed to either side"),
        Toward::LoadFactor => None,
    }
}

/// Tilts in degrees, and horizontal loads as fractions of the weights, that are 0 except for rounding.
const SAME_AS_ZERO: f64 = 1e-9;

/// Describes the ends of an interval around 0, for a text after `by`: `9° to the left, or by 14° to the right`, or `9° to
/// either side` if both amounts are equal. `edge` is the end nearer to 0 and comes first. The other end is left out if it
/// is unbounded or not confirmed. `amount` formats the size of a value without its sign.
fn both_ends(edge: f64, interval: &Interval, amount: impl Fn(f64) -> String) -> String {
    // An end at 0 has no sign, so its side follows from which of the two ends it is.
    let [low, high] = [interval.low(), interval.high()].map(|end| end.and_then(End::value));
    let distance = |end: Option<f64>| end.map_or(f64::INFINITY, |value| (value - edge).abs());
    let (side, other_side, other) =
        if distance(low) <= distance(high) { ("left", "right", high) } else { ("right", "left", low) };
    let near = amount(edge);
    match other.map(amount) {
        Some(far) if far == near => format!("{near} to either side"),
        Some(far) => format!("{near} to the {side}, or by {far} to the {other_side}"),
        None => format!("{near} to the {side}"),
    }
}

fn is_open(end: &End) -> bool {
    matches!(end, End::Unconfirmed { .. })
}

/// Returns the least load factor at which the frame stands. Returns `None` if this factor is 0 or not known.
fn least_factor(interval: &Interval) -> Option<f64> {
    let low = interval.low().and_then(End::value);
    low.filter(|low| *low > 0.0)
}

/// Formats the magnitude of a fraction of gravity in percent. The result may exceed 100 %.
pub(super) fn percent_of(share: f64) -> String {
    if share.abs() < 1.0 { percent(share.abs()) } else { format!("{:.0}\u{a0}%", 100.0 * share.abs()) }
}
