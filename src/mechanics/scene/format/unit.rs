//! The types of the scene file for units of length and force.

use super::declare::{entry, word};
use crate::read::tree::{Entry, Tree};
use crate::read::{Node, NodeKind, Source};

entry! {
    /// The units of the file. Figures, tables and reports also use the units of the file; results in JSON are in metres
    /// and newtons.
    #[derive(Copy, Eq)]
    pub struct UnitsEntry {
        /// Unit of all lengths: coordinates, positions, the thickness, the edge length of grid cells and the contact
        /// tolerance. Default "m".
        length: bare Option<LengthUnit> [extend("default" = "m")],
        /// Unit of all forces and weights. The unit of torques is this unit times the unit of lengths. Default "N".
        force: bare Option<ForceUnit> [extend("default" = "N")],
    }
}

impl UnitsEntry {
    /// Sets the unit of lengths.
    pub fn of_length(mut self, length: LengthUnit) -> Self {
        self.length = Some(length);
        self
    }

    /// Sets the unit of forces.
    pub fn of_force(mut self, force: ForceUnit) -> Self {
        self.force = Some(force);
        self
    }
}

word! {
    /// A unit of length.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum LengthUnit {
        /// Metres.
        #[default]
        Metre = "m",
        /// Centimetres.
        Centimetre = "cm",
        /// Millimetres.
        Millimetre = "mm",
        /// Inches, 0.0254 m.
        Inch = "in",
        /// Feet, 0.3048 m.
        Foot = "ft",
    }
}

word! {
    /// A unit of force.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum ForceUnit {
        /// Newtons.
        #[default]
        Newton = "N",
        /// Kilonewtons.
        Kilonewton = "kN",
        /// Meganewtons.
        Meganewton = "MN",
        /// Pounds-force, 4.4482216152605 N.
        PoundForce = "lbf",
    }
}

impl LengthUnit {
    /// Returns the name of the unit in the plural, such as `metres`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            LengthUnit::Metre => "metres",
            LengthUnit::Centimetre => "centimetres",
            LengthUnit::Millimetre => "millimetres",
            LengthUnit::Inch => "inches",
            LengthUnit::Foot => "feet",
        }
    }
}

impl ForceUnit {
    /// Returns the name of the unit in the plural, such as `newtons`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            ForceUnit::Newton => "newtons",
            ForceUnit::Kilonewton => "kilonewtons",
            ForceUnit::Meganewton => "meganewtons",
            ForceUnit::PoundForce => "pounds-force",
        }
    }
}

/// Replaces texts with a unit by numbers in the units of the file: a `density` such as `"150 lb/ft3"`, and a
/// `unit_weight` such as `"18 kN/m3"`. Other texts stay, and are refused when the values are read.
pub(in crate::mechanics::scene) fn convert(source: &mut Source<'_>) {
    let Some(tree) = &mut source.tree else { return };
    let kilograms = |symbol: &str| match symbol {
        "kg" => Some(1.0),
        "t" => Some(1e3),
        "g" => Some(1e-3),
        "lb" => Some(0.453_592_37),
        _ => None,
    };
    let newtons = |symbol: &str| {
        let units = [ForceUnit::Newton, ForceUnit::Kilonewton, ForceUnit::Meganewton, ForceUnit::PoundForce];
        units.into_iter().map(ForceUnit::parts).find(|unit| unit.0 == symbol).map(|unit| unit.1)
    };
    let mut unit = None;
    for number in 0..tree.entries.len() {
        let Entry { name, value, .. } = &tree.entries[number];
        let NodeKind::Text(text) = &value.kind else { continue };
        let found = match name.as_ref() {
            "density" => per_cubic_metre(text, kilograms),
            "unit_weight" => {
                let unit = *unit.get_or_insert_with(|| force_unit(tree).and_then(newtons).unwrap_or(1.0));
                per_cubic_metre(text, newtons).map(|found| found / unit)
            }
            _ => None,
        };
        if let Some(found) = found {
            tree.entries[number].value.kind = NodeKind::Number(found);
        }
    }
}

/// Returns the force unit that the file names.
fn force_unit<'n>(tree: &'n Tree<'_>) -> Option<&'n str> {
    let entry = |node: &Node<'_>, key: &str| match &node.kind {
        NodeKind::Object(object) => tree.entries(object).iter().find(|entry| entry.name == key),
        _ => None,
    };
    match &entry(&entry(&tree.root, "units")?.value, "force")?.value.kind {
        NodeKind::Text(unit) => Some(unit),
        _ => None,
    }
}

/// Reads a number and its unit per volume, such as `18 kN/m3`. Returns the value per cubic metre, in the unit to which
/// `size` converts.
fn per_cubic_metre(text: &str, size: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let (number, unit) = split_unit(text)?;
    let (unit, volume) = unit.split_once('/')?;
    let length = volume.trim().strip_suffix(['3', '³'])?.trim_end_matches('^');
    use LengthUnit::{Centimetre, Foot, Inch, Metre, Millimetre};
    let units = [Metre, Centimetre, Millimetre, Inch, Foot].map(LengthUnit::parts);
    let metres = units.into_iter().find(|unit| unit.0 == length)?.2;
    Some(number * size(unit.trim())? / (metres * metres * metres))
}

/// Splits a text into its number and the unit after it.
pub(super) fn split_unit(text: &str) -> Option<(f64, &str)> {
    let begin = text.find(|c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E'))?;
    let number = text[..begin].trim().parse::<f64>().ok().filter(|number| number.is_finite())?;
    Some((number, &text[begin..]))
}
