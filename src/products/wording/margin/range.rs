//! [`stands`]: describes the values of a parameter at which a frame stands.

use super::{Parameter, confirmed};
use crate::analysis::{End, Exclusion, Interval};

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

/// Returns two values if two motions exclude all values of the parameter. Below the first value the frame falls by one
/// motion; above the second value it falls by the other motion.
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
