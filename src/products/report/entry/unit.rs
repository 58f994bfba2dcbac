//! [`Units`]: the SI prefix for all forces and torques in the tables of a frame. [`Column`]: the unit of a table column,
//! and how its numbers are written: with the digits that sentences and figures have.

use crate::mechanics::analysis::SolvedFrame;
use crate::mechanics::scene::Unit;
use crate::mechanics::scene::format::UnitsEntry;
use crate::products::wording::failure;
use crate::products::wording::number::{digits, shifted};

/// The format of the numbers of a table column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    /// The unit with its prefix.
    pub unit: String,
    /// The size of the unit without its prefix in SI units.
    size: f64,
    /// The power of ten from the unit without its prefix to that with it.
    shift: i32,
    /// Whether the numbers are coordinates, which have four significant digits.
    is_length: bool,
    /// Numbers up to this size are rounding errors and are written as 0.
    noise: f64,
}

/// Numbers up to this fraction of the largest number of a column are rounding errors of the solver.
const NOISE: f64 = 1e-6;

/// The SI prefix that all forces and torques in the tables of a frame share. Units that the scene chooses have no prefix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    prefix: &'static str,
    shift: i32,
    scene: UnitsEntry,
}

impl Units {
    /// Chooses the prefix for the largest force, missing force, weight or load: G, M, k, m, µ or no prefix. Above 1000 N
    /// the prefix is k, above 10⁸ N it is M, above 10¹¹ N it is G. Below 0.01 N it is m, below 10⁻⁵ N it is µ.
    pub fn new(solved: SolvedFrame<'_>) -> Units {
        let SolvedFrame { scene, found: frame_analysis, .. } = solved;
        let missing = frame_analysis.failures.iter().map(failure::magnitude);
        let loads = scene.loads.iter().map(|l| l.force.norm());
        let weights = scene.blocks.iter().map(|b| b.weight);
        let given = loads.chain(weights);
        Units::of(missing.chain(given).chain([frame_analysis.largest_force()]), scene.units)
    }

    fn of(forces: impl IntoIterator<Item = f64>, scene: UnitsEntry) -> Units {
        let (prefix, shift) = match largest(forces) {
            x if x > 1e11 => ("G", -9),
            x if x > 1e8 => ("M", -6),
            x if x > 1e3 => ("k", -3),
            x if x >= 0.01 || x == 0.0 => ("", 0),
            x if x >= 1e-5 => ("m", 3),
            _ => ("µ", 6),
        };
        Units { prefix, shift, scene }
    }

    /// Chooses the unit of a column of forces. `numbers` are all forces of the column, in newtons.
    pub fn newtons(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.column(numbers, self.scene.force())
    }

    /// Chooses the unit of a column of torques. `numbers` are all torques of the column, in newton metres.
    pub fn torques(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.column(numbers, self.scene.torque())
    }

    /// Chooses the unit of a column of pressures. `numbers` are all pressures of the column, in N/m².
    pub fn stresses(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        self.column(numbers, self.scene.stress())
    }

    fn column(self, numbers: impl IntoIterator<Item = f64>, unit: Unit) -> Column {
        let (prefix, shift) = if unit.is_chosen { ("", 0) } else { (self.prefix, self.shift) };
        let noise = NOISE * largest(numbers);
        Column { unit: format!("{prefix}{}", unit.symbol()), size: unit.size, shift, is_length: false, noise }
    }

    /// Chooses the unit of a column of lengths. `numbers` are all lengths of the column, in metres.
    pub fn lengths(self, numbers: impl IntoIterator<Item = f64>) -> Column {
        Column::lengths(numbers, self.scene)
    }
}

impl Column {
    /// Makes a column of lengths. `numbers` are in metres; the column shows them in the length unit of the scene.
    pub fn lengths(numbers: impl IntoIterator<Item = f64>, units: UnitsEntry) -> Column {
        let unit = units.length();
        let noise = NOISE * largest(numbers);
        Column { unit: unit.symbol(), size: unit.size, shift: 0, is_length: true, noise }
    }

    /// Converts a value from the SI unit to the unit of the column, and writes it without the unit.
    pub fn write(&self, value: f64) -> String {
        match value {
            value if value.abs() <= self.noise => "0".to_owned(),
            value if self.is_length => digits(value / self.size).replace('-', "−"),
            value => shifted(value / self.size, self.shift),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::products::wording::number::quantity;

    #[test]
    fn a_table_has_one_unit_and_the_digits_of_sentences() {
        let si = UnitsEntry::default();
        let units = Units::of([110_395.0, 7.5], si);
        let column = units.newtons([110_395.0, -42.0, 0.0]);
        assert_eq!(column.unit, "kN");
        let cases = [(110_395.0, "110"), (504.83, "0.505"), (-42.0, "−0.042"), (-0.01, "0"), (4125.0 - 1e-6, "4.13")];
        for (value, written) in cases {
            assert_eq!(column.write(value), written);
        }
        assert_eq!((quantity(504.83, "N"), quantity(4125.0 - 1e-6, "N")), ("505 N".into(), "4.13 kN".into()));
        assert_eq!(units.torques([7.5]).with_unit(7.5), "0.0075 kN·m");
        assert_eq!(Units::of([7.5], si).newtons([7.5]).with_unit(7.5), "7.5 N");
        assert_eq!(Units::of([4.9e10], si).newtons([4.9e10]).with_unit(4.9e10), "49000 MN");
        assert_eq!(Column::lengths([4.893, -2.3e-15], si).write(-2.3e-15), "0");
    }
}
