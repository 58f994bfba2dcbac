//! [`Scale`]: how many metres and newtons a pure number stands for.
//!
//! A conic solver's tolerances are absolute in parts of its data. On 3 000 towers with lengths about 1, heaviest loads
//! of 0.1 to 10⁴ gave every verdict right; SI numbers of a large thing in small units called half of them infeasible.
//! So lengths are counted in median interface lengths and forces such that the heaviest load is 300.

use crate::assembly::Assembly;

/// Metres and newtons per pure unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Metres per unit of length: L, the median interface length.
    pub length: f64,
    /// Newtons per unit of force.
    pub force: f64,
}

impl Scale {
    /// The scale of an assembly: its L, and its heaviest load.
    pub fn from_assembly(assembly: &Assembly) -> Scale {
        Scale::new(assembly.length, assembly.heaviest_load())
    }

    /// The heaviest load of a frame in pure units.
    pub const HEAVIEST: f64 = 300.0;

    /// The scale for a median interface length and a heaviest load (N). A frame without loads is scaled by 1 N.
    pub fn new(length: f64, heaviest: f64) -> Scale {
        let heaviest = if heaviest > 0.0 { heaviest } else { 1.0 };
        Scale {
            length,
            force: heaviest / Self::HEAVIEST,
        }
    }

    /// Newton metres per unit of moment.
    pub fn moment(&self) -> f64 {
        self.length * self.force
    }
}
