//! [`stands`] describes in words at which values of a parameter a frame stands.

use super::{Parameter, confirmed};
use crate::mechanics::analysis::{End, Exclusion, FALLS, Interval, STANDS};

/// Describes at which values of a parameter the frame stands: `stands from 0.3 to 2.4`.
pub fn stands(parameter: Parameter, interval: &Interval) -> String {
    let (low, high) = match interval {
        Interval::Between { low, high } => (low, high),
        Interval::Empty(excluded) => {
            let none = match parameter {
                Parameter::LoadFactor => "stands under no multiple of its loads",
                _ => "stands at no value",
            };
            return match conflict(excluded) {
                Some([low, high]) => {
                    let [low, high] = [low, high].map(|value| parameter.value(value));
                    if parameter.is_signed() {
                        format!("{none}: {FALLS} to the left of {low}, and {FALLS} to the right of {high}")
                    } else {
                        format!("{none}: {FALLS} below {low}, and {FALLS} above {high}")
                    }
                }
                None => none.to_owned(),
            };
        }
        Interval::Undecided => return format!("no verdict shows at which values it {STANDS}"),
    };
    let unconfirmed = [("lower", low), ("upper", high)].into_iter().filter_map(|(name, end)| {
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
    format!("{STANDS} {}{unconfirmed}", range(parameter, low, high))
}

/// Returns two values if two collapse motions together exclude all values of the parameter. The first motion excludes
/// values below the first value, and the second motion excludes values above the second value.
fn conflict(excluded: &[Exclusion]) -> Option<[f64; 2]> {
    match excluded {
        [below, above] if below.from.is_none() && above.to.is_none() => Some([below.to?, above.from?]),
        _ => None,
    }
}

/// Describes the values between the two ends of an interval: `from 0.3 to 2.4`.
fn range(parameter: Parameter, low: &End, high: &End) -> String {
    // If the parameter cannot be negative, do not write a lower end of 0.
    let begins = |low: &f64| parameter.is_signed() || *low > 0.0;
    let least = confirmed(low).filter(begins);
    let most = confirmed(high);
    let least_words = |value: f64| parameter.end(value, false);
    let value = |value: f64| parameter.end(value, true);
    // An interval that is shorter than the rounding is one value.
    let is_one = |low: f64, high: f64| parameter.value(low) == parameter.value(high);
    if parameter == Parameter::LoadFactor {
        let factor = match (least, most) {
            (None, None) => "any factor".to_owned(),
            (None, Some(high)) => format!("at most {}", value(high)),
            (Some(low), None) => format!("at least {}", least_words(low)),
            (Some(low), Some(high)) if is_one(low, high) => parameter.value(low),
            (Some(low), Some(high)) => format!("{} to {}", least_words(low), value(high)),
        };
        return format!("with its loads times {factor}");
    }
    match (least, most) {
        (None, None) => "at any value".to_owned(),
        (None, Some(high)) if parameter.is_signed() => {
            format!("up to {}, without a limit to the left", value(high))
        }
        (Some(low), None) if parameter.is_signed() => {
            format!("from {} on, without a limit to the right", least_words(low))
        }
        (None, Some(high)) => format!("up to {}", value(high)),
        (Some(low), None) => format!("at {} and more", least_words(low)),
        // If both ends have the same text, they are equal at the printed precision.
        (Some(low), Some(high)) if is_one(low, high) => format!("only at {}", parameter.value(low)),
        (Some(low), Some(high)) => format!("from {} to {}", least_words(low), value(high)),
    }
}
