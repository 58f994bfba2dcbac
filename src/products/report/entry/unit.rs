//! [`Column`]: the unit and the decimals that all numbers of a column share.

/// The format of the numbers of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    /// The unit with its prefix.
    pub unit: String,
    factor: f64,
    decimals: usize,
}

/// Significant digits of the largest number of a column.
const DIGITS: i32 = 4;

impl Column {
    /// Chooses the prefix for numbers in a unit without prefix. The largest absolute value decides: k above 10³, M
    /// above 10⁷, m below 0.01, µ below 10⁻⁵.
    pub fn new(numbers: impl IntoIterator<Item = f64>, unit: &str) -> Column {
        let largest = largest(numbers);
        let (prefix, factor) = match largest {
            x if x > 1e7 => ("M", 1e-6),
            x if x > 1e3 => ("k", 1e-3),
            x if x >= 0.01 || x == 0.0 => ("", 1.0),
            x if x >= 1e-5 => ("m", 1e3),
            _ => ("µ", 1e6),
        };
        Column {
            unit: format!("{prefix}{unit}"),
            factor,
            decimals: decimals(largest * factor),
        }
    }

    /// Chooses the decimals for coordinates in metres.
    pub fn metres(numbers: impl IntoIterator<Item = f64>) -> Column {
        Column {
            unit: "m".to_owned(),
            factor: 1.0,
            decimals: decimals(largest(numbers)),
        }
    }

    /// Writes a number with the prefix and decimals of the column, without its unit.
    pub fn write(&self, value: f64) -> String {
        let text = format!("{:.*}", self.decimals, value * self.factor);
        match text.strip_prefix('-') {
            // No negative zero.
            Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
            Some(rest) => format!("−{rest}"),
            None => text,
        }
    }

    /// Writes a number with the prefix and decimals of the column, and its unit.
    pub fn with_unit(&self, value: f64) -> String {
        format!("{} {}", self.write(value), self.unit)
    }

    /// Returns the head of the column with its unit: `#normal force, kN`.
    pub fn head(&self, what: &str) -> String {
        format!("#{what}, {}", self.unit)
    }
}

fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let finite = numbers.into_iter().map(f64::abs).filter(|x| x.is_finite());
    finite.fold(0.0, f64::max)
}

fn decimals(largest: f64) -> usize {
    if largest <= 0.0 {
        return 0;
    }
    let first = libm::log10(largest).floor() as i32;
    usize::try_from(DIGITS - 1 - first).unwrap_or(0).min(9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_has_one_unit_and_the_same_decimals() {
        let column = Column::new([110_395.0, -42.0, 0.0], "N");
        assert_eq!(column.unit, "kN");
        assert_eq!(column.write(110_395.0), "110.4");
        assert_eq!(
            (column.write(-42.0), column.write(-0.001)),
            ("0.0".into(), "0.0".into())
        );
        assert_eq!(column.write(-420.0), "−0.4");
        let small = Column::new([7.5], "N");
        assert_eq!(small.with_unit(7.5), "7.500 N");
    }
}
