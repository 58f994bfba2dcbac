//! Estimates the rounding error of coordinates from their digits in the scene file.
//!
//! Only the digits are used, not the geometry. If most coordinates have the same number of decimals and none has
//! more, they were rounded to this number. If all numbers are 32-bit floats, they were computed or stored as such
//! floats. If neither is true, a quarter of the numbers is enough to show rounding to decimals or to significant
//! digits. Otherwise no rounding is assumed.

use std::fmt::{LowerExp, Write};

use super::ToleranceSource;
use super::format::{Pair, SceneFile};

/// A file counts as rounded to k digits only if at least this fraction of its numbers have k digits, and none has
/// more.
const MIN_ROUNDED_SHARE: f64 = 0.25;
/// At least this fraction of the numbers must have the same, largest number of decimals, before 32-bit floats are
/// considered. Of numbers rounded to k decimals, nine in ten have exactly k decimals. Of 32-bit floats, far fewer have
/// the largest number of decimals that occurs.
const MIN_DECIMAL_SHARE: f64 = 0.6;
/// Numbers with more decimals or significant digits than this count as not rounded.
const MAX_ROUNDED_DIGITS: usize = 12;
/// The size of a table of digits. Numbers with more digits are counted in its last entry.
const DIGIT_TABLE_SIZE: usize = 40;

/// The rounding of the coordinates in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rounding {
    /// The kind of rounding.
    pub(super) source: ToleranceSource,
    /// The largest error of a coordinate, in the units of the file.
    pub(super) error: f64,
}

/// Estimates how the coordinates in a file are rounded, and the largest error that this causes. `None` if the digits do
/// not show any rounding.
pub(super) fn estimate_rounding(file: &SceneFile) -> Option<Rounding> {
    let mut digits = Digits::default();
    let mut reach = 0.0_f64;
    let mut turns = Digits::default();
    let mut ring = |points: &[Pair]| {
        for x in points.iter().flatten() {
            digits.count_digits(*x);
            reach = reach.max(x.abs());
        }
    };
    let entries = (file.ground.iter())
        .map(|g| (&g.polygon, &g.holes, &g.circle, g.at, g.angle))
        .chain((file.blocks.iter()).map(|b| (&b.polygon, &b.holes, &b.circle, b.at, b.angle)))
        .chain((file.shapes.0.iter()).map(|s| (&s.1.polygon, &s.1.holes, &s.1.circle, None, None)));
    for (polygon, holes, circle, at, angle) in entries {
        ring(polygon.as_deref().unwrap_or_default());
        holes.iter().for_each(|hole| ring(hole));
        circle.iter().for_each(|circle| ring(&[circle.centre, [circle.radius; 2]]));
        // If the scene has a grid, `at` counts lattice steps, not lengths, so it is not used here.
        if file.grid.is_none() {
            ring(at.as_slice());
        }
        turns.count_digits(angle.unwrap_or(0.0));
    }
    let mut found = digits.rounding()?;
    // Angles with three decimals or more were probably rounded. Add the error that this causes at the farthest
    // coordinate. Angles with fewer decimals count as exact, such as whole degrees.
    if let Some(k) = (turns.decimals.last_digit(MIN_ROUNDED_SHARE, turns.count)).filter(|k| *k >= 3) {
        found.error += (0.5 * power(k)).to_radians() * reach;
    }
    Some(found)
}

/// Counts of numbers by their digits.
#[derive(Default)]
struct Digits {
    count: usize,
    /// The largest absolute value.
    largest: f64,
    /// Histogram: the entry k is the count of coordinates with k decimals.
    decimals: Table,
    /// Histogram: the entry k is the count of coordinates with k significant digits.
    significant: Table,
    /// Whether some number is neither a 32-bit float nor the shortest notation of one.
    wide: bool,
    /// Buffer for the notation of the latest number.
    text: String,
    /// Buffer for the notation of the 32-bit float nearest to the latest number.
    narrow: String,
}

/// Returns two numbers about the shortest decimal notation of `x`: how many significant digits it has, and how many
/// digits after the decimal point. The second number is negative for a multiple of ten: −2 for 300. `None` if `x` is 0,
/// or if the notation needs more than 12 decimals or 15 digits.
///
/// Two different decimal numbers with at most 15 digits never round to the same double. The function tries 0, 1, 2, …
/// decimals; the first decimal number that equals `x` is therefore the shortest.
fn few_digits(x: f64) -> Option<(usize, i64)> {
    let mut power = 1.0;
    for behind in 0..=MAX_ROUNDED_DIGITS as i64 {
        let whole = (x.abs() * power).round();
        if whole >= 1e15 {
            return None;
        }
        if whole / power == x.abs() {
            let (mut rest, mut zeros) = (whole as u64, 0);
            while rest > 0 && rest.is_multiple_of(10) {
                (rest, zeros) = (rest / 10, zeros + 1);
            }
            let digits = rest.checked_ilog10()? + 1;
            return Some((digits as usize, behind - zeros));
        }
        power *= 10.0;
    }
    None
}

/// Writes a number into `text` in scientific notation, with the fewest digits that identify this number. Replaces the
/// previous content.
fn write_shortly(text: &mut String, x: impl LowerExp) {
    text.clear();
    // Writing to a `String` cannot fail.
    let _ = write!(text, "{x:e}");
}

struct Table([usize; DIGIT_TABLE_SIZE]);

impl Default for Table {
    fn default() -> Table {
        Table([0; DIGIT_TABLE_SIZE])
    }
}

impl Table {
    fn add(&mut self, digits: usize) {
        self.0[digits.min(DIGIT_TABLE_SIZE - 1)] += 1;
    }

    /// Returns the largest number of digits that occurs in the table. `None` if fewer than the fraction `share` of
    /// `count` numbers have that many digits, or if the number of digits exceeds [`MAX_ROUNDED_DIGITS`].
    fn last_digit(&self, share: f64, count: usize) -> Option<usize> {
        let last = self.0.iter().rposition(|n| *n > 0)?;
        let enough = self.0[last] as f64 >= share * count as f64;
        (enough && last <= MAX_ROUNDED_DIGITS).then_some(last)
    }

    fn at_least(&self, digits: usize) -> usize {
        self.0[digits..].iter().sum()
    }
}

impl Digits {
    /// Adds the digits of a number to the counts. Zeros are skipped, because every notation represents them exactly.
    fn count_digits(&mut self, x: f64) {
        if x == 0.0 || !x.is_finite() {
            return;
        }
        let (digits, behind) = few_digits(x).unwrap_or_else(|| {
            write_shortly(&mut self.text, x);
            let (mantissa, exponent) = self.text.split_once('e').unwrap_or((&self.text, "0"));
            let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
            let exponent: i64 = exponent.parse().unwrap_or(0);
            (digits, digits as i64 - 1 - exponent)
        });
        self.decimals.add(usize::try_from(behind.max(0)).unwrap_or(DIGIT_TABLE_SIZE));
        self.significant.add(digits);
        let narrow = x as f32;
        // Every number with at most six digits is the shortest notation of some 32-bit float, so only longer numbers
        // are tested.
        if !self.wide && digits > 6 && f64::from(narrow) != x {
            write_shortly(&mut self.text, x);
            write_shortly(&mut self.narrow, narrow);
            self.wide = self.narrow != self.text;
        }
        self.count += 1;
        self.largest = self.largest.max(x.abs());
    }

    fn rounding(&self) -> Option<Rounding> {
        let decimals = |k: usize| Rounding { source: ToleranceSource::Decimals(k), error: 0.5 * power(k) };
        let float = 0.5 * f64::from(f32::EPSILON) * self.largest;
        if let Some(k) = self.decimals.last_digit(MIN_DECIMAL_SHARE, self.count) {
            let mut found = decimals(k);
            if !self.wide {
                found.error = found.error.max(float);
            }
            return Some(found);
        }
        // A number with seven digits is usually the shortest notation of some 32-bit float, so it proves nothing. For a
        // number with eight digits this is rarely a coincidence.
        let long = self.significant.at_least(7) as f64 >= MIN_ROUNDED_SHARE * self.count as f64;
        if !self.wide && long && self.significant.at_least(8) > 0 {
            return Some(Rounding {
                source: ToleranceSource::Float32,
                // Double the error, because the coordinates may have been computed from other 32-bit floats.
                error: 2.0 * float,
            });
        }
        if let Some(k) = self.decimals.last_digit(MIN_ROUNDED_SHARE, self.count) {
            return Some(decimals(k));
        }
        let n = self.significant.last_digit(MIN_ROUNDED_SHARE, self.count)?;
        let text = format!("{:e}", self.largest);
        let exponent: i32 = text.split_once('e')?.1.parse().ok()?;
        let unit = libm::pow(10.0, f64::from(exponent + 1) - n as f64);
        Some(Rounding { source: ToleranceSource::Digits(n), error: 0.5 * unit })
    }
}

/// Returns the power 10⁻ᵏ.
fn power(k: usize) -> f64 {
    libm::pow(10.0, -(k as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rounding(numbers: impl IntoIterator<Item = f64>) -> Option<Rounding> {
        let mut digits = Digits::default();
        numbers.into_iter().for_each(|x| digits.count_digits(x));
        digits.rounding()
    }

    /// Irregular numbers between −20 and 20.
    fn numbers() -> impl Iterator<Item = f64> {
        (1..200).map(|i| 20.0 * libm::sin(f64::from(i * i)))
    }

    #[test]
    fn the_digits_of_the_shortest_notation_are_counted() {
        let by_hand = [0.5, 1200.0, -3.0, 0.001, 1e-9, 0.1 + 0.2, 1e15, 12345678.9, 5e-324];
        let decimals = (0..=12).flat_map(|k| numbers().map(move |x| (x / power(k)).round() * power(k)));
        let all = by_hand.into_iter().chain(decimals).chain(numbers());
        let mut few = 0;
        for x in all.filter(|x| *x != 0.0) {
            let text = format!("{x:e}");
            let (mantissa, exponent) = text.split_once('e').expect("scientific notation");
            let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
            let exponent: i64 = exponent.parse().expect("a number");
            if let Some(found) = few_digits(x) {
                assert_eq!(found, (digits, digits as i64 - 1 - exponent), "{x}");
                few += 1;
            }
            let narrow = x as f32;
            let shortest = format!("{narrow:e}") == text;
            assert!(digits > 6 || shortest || x.abs() < 1e-37, "{x}");
        }
        assert!(few > 1000, "{few}");
    }

    #[test]
    fn decimals_are_counted() {
        for k in 0..=9 {
            let unit = power(k);
            let rounded = numbers().map(|x| (x / unit).round() * unit);
            let text = rounded.map(|x| format!("{x:.k$}").parse().unwrap_or(f64::NAN));
            let found = rounding(text).expect("rounded numbers");
            assert_eq!(found.source, ToleranceSource::Decimals(k));
            assert!((found.error - 0.5 * unit).abs() <= 1e-12 * unit);
        }
    }

    #[test]
    fn floats_of_32_bits_are_recognised_in_exact_and_in_short_notation() {
        let full = numbers().map(|x| f64::from(x as f32));
        let short = numbers().map(|x| format!("{}", x as f32).parse().unwrap_or(f64::NAN));
        for found in [rounding(full), rounding(short)] {
            let found = found.expect("rounded numbers");
            assert_eq!(found.source, ToleranceSource::Float32);
            assert!((1e-6..3e-6).contains(&found.error), "{}", found.error);
        }
    }

    #[test]
    fn significant_digits_are_counted_where_decimals_differ() {
        let spread = (0..240).map(|i| libm::pow(10.0, f64::from(i % 6) - 2.0) * (1.0 + f64::from(i) / 77.0));
        let text = spread.map(|x| format!("{x:.5e}").parse().unwrap_or(f64::NAN));
        let found = rounding(text).expect("rounded numbers");
        assert_eq!(found.source, ToleranceSource::Digits(6));
        assert!((0.004..0.006).contains(&found.error), "{}", found.error);
    }

    #[test]
    fn exact_numbers_and_short_numbers_with_one_long_number_show_no_rounding() {
        assert_eq!(rounding(numbers()), None);
        let by_hand = (0..40).map(|i| 0.5 * f64::from(i)).chain([1.000001]);
        assert_eq!(rounding(by_hand), None);
        assert_eq!(rounding([]), None);
    }
}
