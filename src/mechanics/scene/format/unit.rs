//! The types of the scene file for units of length and force.

use super::declare::{entry, word};

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
