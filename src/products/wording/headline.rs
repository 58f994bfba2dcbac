//! [`headline`] describes the most important margin of a frame in one sentence.

use super::margin::{Parameter, StatedMargin, confirmed};
use super::number::{three_down, three_up};
use crate::mechanics::analysis::{End, FALLS, Interval, STANDS, UNDECIDED, Verdict};

/// Describes a margin as a sentence without a full stop: `It carries 2.40 times its load`, `It falls: it carries 0.33
/// of its load`. `loads` is the number of loads of the frame.
pub fn headline(margin: &StatedMargin<'_>, verdict: Verdict, loads: usize) -> String {
    let load = if loads == 1 { "load" } else { "loads" };
    match (verdict, margin.parameter) {
        (Verdict::Undecided, _) => format!("It is {UNDECIDED} whether it {STANDS}"),
        (Verdict::Stable, Parameter::LoadFactor) => load_factor_phrase(margin, load),
        (Verdict::Unstable, Parameter::LoadFactor) => lacks(margin, load),
        (Verdict::Stable, _) => reserve(margin),
        (Verdict::Unstable, _) => falls(margin),
    }
}

/// Writes the upper end of an interval: `2.40`, or `at least 2.40` if the end is not confirmed. Returns `None` if the
/// interval has no upper end. `write` formats the number.
fn end(end: Option<&End>, write: &dyn Fn(f64) -> String) -> Option<String> {
    let end = end?;
    Some(format!("{}{}", at_least(end), write(confirmed(end)?)))
}

fn load_factor_phrase(margin: &StatedMargin<'_>, load: &str) -> String {
    let low = margin.interval.low().and_then(confirmed);
    match end(margin.interval.high(), &three_down) {
        Some(value) => format!("It carries {value} times its {load}"),
        None if matches!(margin.interval, Interval::Undecided) => {
            format!("It carries its {load}; no proof shows how much more")
        }
        None => match low {
            Some(low) if low > 0.0 => {
                format!("It carries {} times its {load} and any larger multiple", three_up(low))
            }
            _ => format!("It carries any multiple of its {load}"),
        },
    }
}

fn lacks(margin: &StatedMargin<'_>, load: &str) -> String {
    if matches!(margin.interval, Interval::Undecided) {
        return format!("It {FALLS}; no proof shows which part of its {load} it carries");
    }
    let low = margin.interval.low().and_then(confirmed);
    match (low, end(margin.interval.high(), &three_down)) {
        (Some(low), _) if low > 1.0 => {
            format!("It {FALLS}: it needs {} times its {load}", three_up(low))
        }
        (_, Some(high)) => format!("It {FALLS}: it carries {high} of its {load}"),
        _ => format!("It {FALLS} under any multiple of its {load}"),
    }
}

/// Describes the margin of a structure that stands, for all parameters except the load factor. For tilt and horizontal
/// load, the text states the end of the interval that is nearer to 0.
fn reserve(margin: &StatedMargin<'_>) -> String {
    if matches!(margin.interval, Interval::Undecided) {
        return format!("It {STANDS}; {}: {}", margin.name, margin.stands());
    }
    let nearest = || {
        let ends = [(margin.interval.low(), "left"), (margin.interval.high(), "right")];
        let known = ends.into_iter().filter_map(|(end, side)| Some((confirmed(end?)?.abs(), side, at_least(end?))));
        known.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    match margin.parameter {
        Parameter::Tilt => match nearest() {
            Some((angle, side, at_least)) => {
                format!("It {STANDS} {at_least}until gravity turns {}° to the {side}", three_down(angle))
            }
            None => format!("It {STANDS} however far gravity turns"),
        },
        Parameter::HorizontalLoad => match nearest() {
            Some((share, side, at_least)) => format!(
                "It {STANDS} {at_least}until a horizontal force of {} times its weight pushes it to the {side}",
                three_down(share)
            ),
            None => format!("It {STANDS} under a horizontal force of any multiple of its weight"),
        },
        Parameter::Friction => match margin.interval.low().map(|end| (confirmed(end), end)) {
            Some((Some(least), end)) if least > 0.0 => {
                format!("It {STANDS} {}down to a friction coefficient of {}", at_least(end), three_up(least))
            }
            _ => format!("It {STANDS} even without friction"),
        },
        Parameter::Kernel => match end(margin.interval.high(), &three_down) {
            Some(most) => format!("It {STANDS} up to a safety kernel of {most}"),
            None => format!("It {STANDS} even with the largest safety kernel, 1"),
        },
        _ => format!("{}: {}", margin.name, margin.sentence()),
    }
}

/// Returns `at least ` for an end that is not confirmed: the structure may stand beyond it.
fn at_least(end: &End) -> &'static str {
    match end {
        End::Unconfirmed { .. } => "at least ",
        _ => "",
    }
}

fn falls(margin: &StatedMargin<'_>) -> String {
    let low = margin.interval.low().and_then(confirmed);
    match (margin.parameter, low) {
        (Parameter::Friction, Some(least)) if least > 0.0 => {
            format!("It {FALLS}: it would stand with a friction coefficient of {}", three_up(least))
        }
        (Parameter::Friction, _) if matches!(margin.interval, Interval::Empty(_)) => {
            format!("It {FALLS} whatever the friction coefficient")
        }
        _ => format!("It {FALLS}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::products::wording::margin::Position;

    /// An undecided interval is unknown. It must not be described as an interval without end.
    #[test]
    fn the_headline_of_an_undecided_margin_states_neither_a_limit_nor_that_there_is_none() {
        let parameters = [Parameter::Tilt, Parameter::HorizontalLoad, Parameter::Friction, Parameter::Kernel];
        for parameter in parameters {
            let margin = StatedMargin {
                parameter,
                name: "parameter".to_owned(),
                interval: &Interval::Undecided,
                present: Some((0.0, 0.0)),
                position: Position::Inside,
            };
            assert_eq!(
                headline(&margin, Verdict::Stable, 0),
                "It stands; parameter: no verdict shows at which values it stands"
            );
            assert_eq!(margin.reserve(), 1.0, "another margin comes first");
        }
    }
}
