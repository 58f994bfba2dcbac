//! The types of the scene file for units of length and force.

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The units of the file. Figures, tables and reports also use the units of the file; results in JSON are in metres and
/// newtons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct UnitsEntry {
    /// Unit of all lengths: coordinates, positions, the thickness, the edge length of grid cells and the contact
    /// tolerance. Default "m".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = "m")))]
    pub length: Option<LengthUnit>,
    /// Unit of all forces and weights. The unit of torques is this unit times the unit of lengths. Default "N".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = "N")))]
    pub force: Option<ForceUnit>,
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

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[non_exhaustive]
pub enum LengthUnit {
    /// Metres.
    #[default]
    #[serde(rename = "m")]
    Metre,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetre,
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Inches, 0.0254 m.
    #[serde(rename = "in")]
    Inch,
    /// Feet, 0.3048 m.
    #[serde(rename = "ft")]
    Foot,
}

/// A unit of force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[non_exhaustive]
pub enum ForceUnit {
    /// Newtons.
    #[default]
    #[serde(rename = "N")]
    Newton,
    /// Kilonewtons.
    #[serde(rename = "kN")]
    Kilonewton,
    /// Meganewtons.
    #[serde(rename = "MN")]
    Meganewton,
    /// Pounds-force, 4.4482216152605 N.
    #[serde(rename = "lbf")]
    PoundForce,
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
