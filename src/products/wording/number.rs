//! Formats numbers with units and directions.

use crate::geometry::{Point, Vector};
use crate::mechanics::scene::Unit;
use crate::mechanics::scene::format::UnitsEntry;
use crate::text::{power_of_ten, superscript, without_zeros};

/// A no-break space.
pub const NO_BREAK: char = '\u{a0}';

/// Writes a value, given in SI units, with three significant digits, an SI prefix and its unit: `5.74 N·m`, `−12 kN`,
/// `250 µN`. If the scene file chooses the unit, no prefix is added: `0.0024 kN`.
pub fn quantity(value: f64, unit: impl Into<Unit>) -> String {
    let unit = unit.into();
    let (value, symbol) = (if unit.is_chosen { unit.value_from_si(value) } else { value }, unit.symbol());
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { format!("0 {symbol}") } else { format!("unlimited {symbol}") };
    }
    // Round in decimal before choosing the prefix, so that 999.7 N becomes 1 kN and not 1000 N.
    let (mantissa, exponent) = three_digits(value);
    let prefixes = ["n", "µ", "m", "", "k", "M", "G"];
    let step = match exponent {
        _ if unit.is_chosen => 0,
        // Values from 0.01 to 1 get no prefix, because 0.05 N is easier to compare with 3 N than 50 mN is.
        -2..0 => 0,
        exponent => exponent.div_euclid(3),
    };
    let prefix = usize::try_from(step + 3).ok().and_then(|place| prefixes.get(place));
    match prefix.filter(|_| !unit.is_chosen || (-4..7).contains(&exponent)) {
        Some(prefix) => format!("{} {prefix}{symbol}", shifted(value, -3 * step)),
        None => {
            let sign = if value < 0.0 { "−" } else { "" };
            format!("{sign}{}×10{} {symbol}", without_zeros(&mantissa), superscript(exponent))
        }
    }
}

/// Returns three significant digits of the size of a quantity, and their power of ten: `4.13` and 2. All quantities in
/// texts, tables and figures have these digits.
///
/// Two equal forces can differ by a rounding error of the solver (relative error below 1e-9). If one is just below 4.125
/// and the other just above, they would be rounded differently. The factor moves both above this limit.
fn three_digits(value: f64) -> (String, i32) {
    let rounded = format!("{:.2e}", value.abs() * (1.0 + 1e-7));
    let (mantissa, exponent) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    (mantissa.to_owned(), exponent.parse().unwrap_or(0))
}

/// Writes a quantity in a column of a table: the digits that [`quantity`] writes, for a unit that is `10^-shift` times
/// the unit of `value`.
pub fn shifted(value: f64, shift: i32) -> String {
    let (mantissa, exponent) = three_digits(value);
    // A float is formatted with as few digits as possible, so no digits follow the three significant ones.
    let size: f64 = format!("{mantissa}e{}", exponent + shift).parse().unwrap_or(0.0);
    let sign = if value < 0.0 && size > 0.0 { "−" } else { "" };
    format!("{sign}{size}")
}

/// Writes the magnitude and the direction of a force: `7.1 N at 30°`. The angle is measured anticlockwise from the
/// positive x axis.
pub fn force(force: Vector, units: UnitsEntry) -> String {
    // Round before adding 360° and taking the remainder, so that an angle just below 0 is written as 0°, not as 360°.
    let degrees = (libm::atan2(force.y, force.x).to_degrees().round() + 360.0) % 360.0;
    format!("{} at {degrees:.0}°", quantity(force.norm(), units.force()))
}

/// Writes a ratio in whole percent: `97 %`. Only a ratio of at least [`FULL_UTILISATION`] is written as `100 %`, and
/// only a ratio of at most 1 − `FULL_UTILISATION` as `0 %`. Other ratios that round to these values are written as
/// `over 99 %` or `under 1 %`.
pub fn percent(share: f64) -> String {
    let rounded = (100.0 * share).round();
    let space = NO_BREAK;
    match rounded {
        _ if share >= FULL_UTILISATION => format!("100{space}%"),
        r if r >= 100.0 => format!("over 99{space}%"),
        r if r <= 0.0 && share > 1.0 - FULL_UTILISATION => format!("under 1{space}%"),
        r => format!("{:.0}{space}%", r.max(0.0)),
    }
}

/// Ratios of at least this value count as 100 %, because the difference is a rounding error of the solver.
pub const FULL_UTILISATION: f64 = 1.0 - 1e-6;

/// Writes a count and its noun in the singular or plural: `1 hinge`, `2 hinges`.
pub fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// Returns the largest number that is 1, 2 or 5 times a power of ten and not larger than `value`. Returns 0 if
/// `value` is not positive and finite.
pub fn round_below(value: f64) -> f64 {
    if !(value > 0.0 && value.is_finite()) {
        return 0.0;
    }
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let lead = match mantissa.as_bytes().first() {
        Some(b'5'..=b'9') => '5',
        Some(b'2'..=b'4') => '2',
        _ => '1',
    };
    format!("{lead}e{exponent}").parse().unwrap_or(0.0)
}

/// Like [`round_below`], but the result is a round number if it is converted to `unit`. `value` and the result are in
/// SI units.
pub fn round_below_in(value: f64, unit: Unit) -> f64 {
    match unit.size {
        1.0 => round_below(value),
        size => size * round_below(unit.value_from_si(value)),
    }
}

/// Joins words to a list in a sentence: `a`, `a and b`, `a, b and c`.
pub fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Returns the letter that labels a panel of a figure: a … z, then aa, ab …. `number` is the index of the panel, from
/// 0.
pub fn letter(number: usize) -> String {
    let mut rest = number + 1;
    let mut letters = Vec::new();
    while rest > 0 {
        rest -= 1;
        letters.push(char::from(b'a' + (rest % 26) as u8));
        rest /= 26;
    }
    letters.iter().rev().collect()
}

/// Writes a number with four significant digits, or with all digits of its whole part if it has more. Trailing zeros of
/// decimals are dropped. Numbers below 0.001 or from a million on are written like `1.234×10⁶`.
pub fn digits(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&size) {
        return power_of_ten(x, 3);
    }
    // `first` is the power of ten of the first significant digit. Three more digits follow.
    let first = libm::log10(size).floor() as i32;
    let decimals = usize::try_from(3 - first).unwrap_or(0);
    without_zeros(&format!("{x:.decimals$}")).to_owned()
}

/// Writes a number with three significant digits, with trailing zeros: `2.40`, `0.334`, `12.0`.
pub fn three(x: f64) -> String {
    if x == 0.0 || !(1e-4..1e5).contains(&x.abs()) {
        return digits(x);
    }
    let decimals = |x: f64| usize::try_from(2 - libm::log10(x.abs()).floor() as i32).unwrap_or(0);
    // Determine the decimals again after rounding, so that 9.999 becomes 10.0 and not 10.00.
    let rounded: f64 = format!("{x:.*}", decimals(x)).parse().unwrap_or(x);
    format!("{x:.*}", decimals(if rounded == 0.0 { x } else { rounded })).replace('-', "−")
}

/// Writes a positive number with at most three significant digits, rounded down: the safe side of an upper end. The
/// written number may exceed `x` by at most the relative error of margins, 1e-6.
pub fn three_down(x: f64) -> String {
    three_beyond(x, -1.0)
}

/// Writes a positive number with at most three significant digits, rounded up: the safe side of a lower end. The written
/// number may be below `x` by at most the relative error of margins, 1e-6.
pub fn three_up(x: f64) -> String {
    three_beyond(x, 1.0)
}

/// Writes a number with at most three significant digits, rounded up if `sign` is 1 and down if it is −1. The nearest
/// rounding in the other direction is also accepted if its relative distance is at most the error of margins.
fn three_beyond(x: f64, sign: f64) -> String {
    // The relative error of margins.
    const MARGIN_TOL: f64 = 1e-6;
    let nearest = three(x);
    // A number with a power of ten has four digits.
    let (written, more) = match nearest.parse() {
        Ok(written) => (written, 2.0),
        Err(_) => (format!("{x:.3e}").parse().unwrap_or(x), 3.0),
    };
    let safe = if x <= 0.0 || (x - written) * sign <= MARGIN_TOL * x {
        nearest
    } else {
        three(written + sign * libm::exp10(libm::floor(libm::log10(x)) - more))
    };
    without_zeros(&safe).to_owned()
}

/// Chooses one SI prefix for all numbers of a column. `largest` is the largest of these numbers. Returns the unit with
/// the prefix, and the factor by which the numbers must be multiplied.
pub fn prefixed(largest: f64, unit: &str) -> (String, f64) {
    let (prefix, factor) = match largest {
        x if x >= 2e9 => ("G", 1e-9),
        x if x >= 2e6 => ("M", 1e-6),
        x if x >= 2e3 => ("k", 1e-3),
        _ => ("", 1.0),
    };
    (format!("{prefix}{unit}"), factor)
}

/// Writes a number with one significant digit, to show its order of magnitude: `3e-12`.
pub fn rough(x: f64) -> String {
    if x == 0.0 { "0".into() } else { format!("{x:.0e}") }
}

/// Writes a ratio in percent with at most one decimal: `66.7 %`.
pub fn tenths(share: f64) -> String {
    format!("{} %", digits((share * 1000.0).round() / 10.0))
}

/// Writes a time, given in seconds, in ms or s with four significant digits.
pub fn duration(seconds: f64) -> String {
    if seconds < 1.0 { format!("{} ms", digits(seconds * 1e3)) } else { format!("{} s", digits(seconds)) }
}

/// Writes the coordinates of a point in the length unit of the scene: `(2, 1.5) m`. A coordinate that is a rounding error
/// of the other one is written as 0.
pub fn place(p: Point, units: UnitsEntry) -> String {
    place_beyond(p, units, 1e-9 * p.x.abs().max(p.y.abs()))
}

/// Like [`place`], but a coordinate of at most `noise`, in metres, is written as 0.
pub fn place_beyond(p: Point, units: UnitsEntry, noise: f64) -> String {
    let unit = units.length();
    let [x, y] = [p.x, p.y].map(|x| digits(if x.abs() <= noise { 0.0 } else { unit.value_from_si(x) }));
    format!("({x}, {y}) {}", unit.symbol())
}

/// Writes a value, given in SI units, with four significant digits and its unit, without a prefix: `1234 N`.
pub fn amount(value: f64, unit: impl Into<Unit>) -> String {
    let unit = unit.into();
    format!("{} {}", digits(unit.value_from_si(value)), unit.symbol())
}

#[cfg(test)]
mod tests;
