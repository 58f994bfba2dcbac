//! [`Units`]: the SI prefix for all forces and torques in the report on a frame. [`Column`]: the unit and the number of
//! decimals for all numbers of a table column.

use crate::mechanics::analysis::FrameAnalysis;
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{Scene, Unit};
use crate::products::wording::failure;
use crate::products::wording::number::three;

/// The format of the numbers of a table column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    /// The unit with its prefix.
    pub unit: String,
    factor: f64,
    decimals: usize,
}

/// The number of significant digits with which the largest number of a column is written.
const SIGNIFICANT_DIGITS: i32 = 4;

/// The SI prefix that all forces and torques in the report on a frame share. Units that the scene chooses have no
/// prefix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    prefix: &'static str,
    factor: f64,
    scene: UnitsEntry,
}

impl Units {
    /// Chooses the prefix for the largest force, missing force, weight or load: M, k, m, µ or no prefix. Above 1000 N
    /// the prefix is k, above 10⁸ N it is M. Below 0.01 N it is m, below 10⁻⁵ N it is µ.
    pub fn new(scene: &Scene, frame_analysis: &FrameAnalysis) -> Units {
        let contacts = frame_analysis.contacts.iter().map(|c| c.resultant.force.norm());
        let robots = frame_analysis.robots.iter().map(|r| r.force.norm());
        let missing = frame_analysis.failures.iter().map(failure::amount);
        let loads = scene.loads.iter().map(|l| l.force.norm());
        let weights = scene.blocks.iter().map(|b| b.weight);
        let given = loads.chain(weights);
        Units::of(contacts.chain(robots).chain(missing).chain(given), scene.units)
    }

    fn of(forces: impl IntoIterator<Item = f64>, scene: UnitsEntry) -> Units {
        let (prefix, factor) = match largest(forces) {
            x if x > 1e8 => ("M", 1e-6),
            x if x > 1e3 => ("k", 1e-3),
            x if x >= 0.01 || x == 0.0 => ("", 1.0),
            x if x >= 1e-5 => ("m", 1e3),
            _ => ("µ", 1e6),
        };
        Units { prefix, factor, scene }
    }

    /// Chooses the unit and the decimals of a column of forces. `numbers` are all forces of the column, in newtons.
    pub fn newtons(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.column(numbers, self.scene.force())
    }

    /// Chooses the unit and the decimals of a column of torques. `numbers` are all torques of the column, in newton
    /// metres.
    pub fn torques(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.column(numbers, self.scene.torque())
    }

    /// Returns the unit symbols of lengths, forces and torques. The symbols of forces and torques include the prefix,
    /// unless the scene chooses these units.
    pub fn symbols(self) -> [String; 3] {
        let length = self.scene.length().symbol();
        let [force, torque] = [self.scene.force(), self.scene.torque()].map(|u| self.symbol(u));
        [length, force, torque]
    }

    /// Chooses the unit and the decimals of a column of lengths. `numbers` are all lengths of the column, in metres.
    pub fn lengths(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        Column::lengths(numbers, self.scene)
    }

    fn symbol(self, unit: Unit) -> String {
        if unit.is_chosen { unit.symbol() } else { format!("{}{}", self.prefix, unit.symbol()) }
    }

    fn factor(self, unit: Unit) -> f64 {
        if unit.is_chosen { 1.0 / unit.size } else { self.factor }
    }

    fn column(self, numbers: impl IntoIterator<Item = f64>, unit: Unit) -> Column {
        let factor = self.factor(unit);
        Column { unit: self.symbol(unit), factor, decimals: decimals(largest(numbers) * factor) }
    }

    /// Converts a quantity from the SI unit, and writes it for a sentence with three significant digits and the unit.
    pub fn words(self, value: f64, unit: Unit) -> String {
        let number = three(value * self.factor(unit));
        format!("{number} {}", self.symbol(unit))
    }

    /// Writes a force (N) for a sentence, with its unit.
    pub fn force(self, value: f64) -> String {
        self.words(value, self.scene.force())
    }

    /// Writes a torque (N·m) for a sentence, with its unit.
    pub fn torque(self, value: f64) -> String {
        self.words(value, self.scene.torque())
    }
}

impl Column {
    /// Chooses the decimals of a column of lengths. `numbers` are in metres; the column shows them in the length unit
    /// of the scene.
    pub fn lengths(numbers: impl IntoIterator<Item = f64>, units: UnitsEntry) -> Column {
        let unit = units.length();
        let factor = 1.0 / unit.size;
        Column { unit: unit.symbol(), factor, decimals: decimals(largest(numbers) * factor) }
    }

    /// Converts a value from the SI unit to the unit of the column, and writes it with the decimals of the column,
    /// without the unit.
    pub fn write(&self, value: f64) -> String {
        let text = format!("{:.*}", self.decimals, value * self.factor);
        match text.strip_prefix('-') {
            // Write zero without a minus sign.
            Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
            Some(rest) => format!("−{rest}"),
            None => text,
        }
    }

    /// Writes a value like [`Column::write`], followed by the unit of the column.
    pub fn with_unit(&self, value: f64) -> String {
        format!("{} {}", self.write(value), self.unit)
    }

    /// Returns the head of the column with its unit: `#normal force, kN`. The `#` marks a column of numbers.
    pub fn head(&self, what: &str) -> String {
        format!("#{what}, {}", self.unit)
    }
}

/// Returns the largest finite absolute value; 0 if there is none.
fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let finite = numbers.into_iter().map(f64::abs).filter(|x| x.is_finite());
    finite.fold(0.0, f64::max)
}

/// Returns the number of decimals, at most 9, with which `largest` has [`SIGNIFICANT_DIGITS`] significant digits.
fn decimals(largest: f64) -> usize {
    if largest <= 0.0 {
        return 0;
    }
    let first = libm::log10(largest).floor() as i32;
    usize::try_from(SIGNIFICANT_DIGITS - 1 - first).unwrap_or(0).min(9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_has_one_unit_and_a_column_the_same_decimals() {
        let si = UnitsEntry::default();
        let units = Units::of([110_395.0, 7.5], si);
        let column = units.newtons([110_395.0, -42.0, 0.0]);
        assert_eq!(column.unit, "kN");
        assert_eq!(column.write(110_395.0), "110.4");
        assert_eq!((column.write(-42.0), column.write(-0.001)), ("0.0".into(), "0.0".into()));
        assert_eq!(column.write(-420.0), "−0.4");
        assert_eq!(units.torques([7.5]).with_unit(7.5), "0.007500 kN·m");
        assert_eq!(units.force(504.8), "0.505 kN");
        assert_eq!(Units::of([7.5], si).newtons([7.5]).with_unit(7.5), "7.500 N");
    }
}
