//! [`Stone`]: densities and friction coefficients of common materials.

/// A material for a whole scene: `drystone import --material limestone`.
///
/// # Sources
/// Density: EN 1991-1-1:2002, table A.1 (concrete) and A.2 (natural stone), the middle of the range in kN/m³ divided
/// by 9.81 m/s². Friction: the tangent of the basic friction angle of dry sawn rock surfaces, at the lower end of its
/// range, in Barton and Choubey, "The shear strength of rock joints in theory and practice", Rock Mechanics 10
/// (1977), pages 1 to 54; for concrete the smooth joint of EN 1992-1-1:2004, 6.2.5. Stones differ: measure density
/// and friction if the result depends on them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stone {
    /// The name in lower case.
    pub name: &'static str,
    /// Density in kg/m³.
    pub density: f64,
    /// Friction coefficient of dry joints.
    pub friction: f64,
    /// The source of both numbers, in words.
    pub source: &'static str,
}

/// The known materials, in alphabetical order.
pub const STONES: [Stone; 6] = [
    Stone {
        name: "basalt",
        density: 2960.0,
        friction: 0.7,
        source: "27 to 31 kN/m³ (EN 1991-1-1), 35° (Barton and Choubey 1977)",
    },
    Stone {
        name: "concrete",
        density: 2450.0,
        friction: 0.6,
        source: "24 kN/m³ (EN 1991-1-1), smooth joint (EN 1992-1-1, 6.2.5)",
    },
    Stone {
        name: "gneiss",
        density: 3060.0,
        friction: 0.49,
        source: "30 kN/m³ (EN 1991-1-1), 26° (Barton and Choubey 1977)",
    },
    Stone {
        name: "granite",
        density: 2910.0,
        friction: 0.6,
        source: "27 to 30 kN/m³ (EN 1991-1-1), 31° (Barton and Choubey 1977)",
    },
    Stone {
        name: "limestone",
        density: 2500.0,
        friction: 0.6,
        source: "20 to 29 kN/m³ (EN 1991-1-1), 31° (Barton and Choubey 1977)",
    },
    Stone {
        name: "sandstone",
        density: 2450.0,
        friction: 0.49,
        source: "21 to 27 kN/m³ (EN 1991-1-1), 26° (Barton and Choubey 1977)",
    },
];

impl Stone {
    /// Returns the material with this name, in upper or lower case; `None` if the name is not known.
    pub fn from_name(name: &str) -> Option<Stone> {
        let is_it = |stone: &&Stone| stone.name.eq_ignore_ascii_case(name.trim());
        STONES.iter().find(is_it).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The densities follow from the ranges of unit weights in the sources, the friction coefficients from the
    /// angles.
    #[test]
    fn densities_and_friction_coefficients_follow_from_the_sources() {
        for (name, low, high, angle) in [
            ("basalt", 27.0, 31.0, 35.0),
            ("gneiss", 30.0, 30.0, 26.0),
            ("granite", 27.0, 30.0, 31.0),
            ("limestone", 20.0, 29.0, 31.0),
            ("sandstone", 21.0, 27.0, 26.0),
        ] {
            let stone = Stone::from_name(name).expect("a known material");
            let density = 500.0 * (low + high) / 9.81;
            assert!((stone.density - density).abs() < 6.0, "{name} {density}");
            let friction = libm::tan(f64::to_radians(angle));
            assert!((stone.friction - friction).abs() < 0.005, "{name}");
        }
        assert_eq!(Stone::from_name("Granite").map(|s| s.name), Some("granite"));
        assert_eq!(Stone::from_name("cheese"), None);
    }
}
