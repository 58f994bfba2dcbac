//! [`Rounding`]: rounds numbers of one quantity to the same decimal place.

/// The step to which numbers without a unit (counts, coefficients) are rounded.
pub(super) const UNITLESS_STEP: f64 = 1e-6;

/// The decimal place of the last digit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rounding {
    /// The decimals of the mantissa.
    decimals: usize,
    /// The power of ten, 0 for plain numbers.
    exponent: i32,
}

impl Rounding {
    /// Chooses the decimal place at which `largest` has `digits` significant digits. If `largest` is zero, negative,
    /// infinite or NaN, the place is chosen for 1 instead.
    pub(super) fn new(digits: usize, largest: f64) -> Rounding {
        let is_valid = largest > 0.0 && largest.is_finite();
        let size = if is_valid { largest } else { 1.0 };
        // Read the exponent from the printed number, because a computed logarithm may be wrong by one at powers of
        // ten.
        let printed = format!("{size:e}");
        let ten: i32 = printed.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
        let digits = digits.max(1);
        if (-3..6).contains(&ten) {
            let decimals = (digits as i32 - 1 - ten).max(0);
            return Rounding { decimals: decimals as usize, exponent: 0 };
        }
        Rounding { decimals: digits - 1, exponent: ten }
    }

    /// Writes the rounded number as text, never as −0. A number that is not finite becomes `none`.
    pub(super) fn write(self, value: f64) -> String {
        if !value.is_finite() {
            return "none".into();
        }
        let decimals = self.decimals;
        let scaled = match self.exponent {
            0 => format!("{value:.decimals$}"),
            // Read the power of ten from text, because `powi` is not exact.
            e => {
                let unit: f64 = format!("1e{e}").parse().unwrap_or(1.0);
                format!("{:.decimals$}", value / unit)
            }
        };
        let zero = scaled.chars().all(|c| matches!(c, '-' | '0' | '.'));
        let sign = if zero { scaled.trim_start_matches('-') } else { &scaled };
        match self.exponent {
            0 => sign.to_owned(),
            e => format!("{sign}e{e}"),
        }
    }
}

/// Returns the place value of the last digit of a written number: 0.01 for `1.23`.
pub(super) fn last_digit(written: &str) -> f64 {
    let (mantissa, exponent) = written.split_once('e').unwrap_or((written, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, d)| d.len());
    let exponent: i64 = exponent.parse().unwrap_or(0);
    format!("1e{}", exponent - decimals as i64).parse().unwrap_or(0.0)
}

/// Shortens a written number for messages: removes trailing zeros, and replaces the hyphen by a minus sign.
pub(super) fn short(written: &str) -> String {
    let (mantissa, exponent) = match written.split_once('e') {
        Some((mantissa, exponent)) => (mantissa, format!("e{exponent}")),
        None => (written, String::new()),
    };
    let mantissa = match mantissa.contains('.') {
        true => mantissa.trim_end_matches('0').trim_end_matches('.'),
        false => mantissa,
    };
    match mantissa {
        "0" | "" => "0".into(),
        _ => format!("{}{exponent}", mantissa.replace('-', "−")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_end_at_the_decimal_place_of_the_largest_number() {
        let written = |largest: f64, value: f64| Rounding::new(6, largest).write(value);
        assert_eq!(written(24.0, 4.460_206_8), "4.4602");
        assert_eq!(written(6.0, -0.000_000_4), "0.00000");
        assert_eq!(written(0.05, 0.012_345_67), "0.0123457");
        assert_eq!(written(123_456.0, 7.6), "8");
        assert_eq!(written(2.5e9, -1.25e7), "-0.01250e9");
        assert_eq!(written(3e-7, 1e-7), "1.00000e-7");
        assert_eq!(written(0.0, f64::NAN), "none");
        assert_eq!(last_digit("-0.01250e9"), 1e4);
        assert_eq!((last_digit("4.4602"), last_digit("8")), (1e-4, 1.0));
        assert_eq!(short("4.20000"), "4.2");
        assert_eq!((short("-0.01250e9"), short("0.00000e9")), ("−0.0125e9".into(), "0".into()));
        assert_eq!(short("100"), "100");
    }
}
