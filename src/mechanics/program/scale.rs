//! [`Scale`]: the metres and newtons per unit of a program.
//!
//! The tolerances of an interior-point solver are absolute numbers, so that data must have a suitable size. On 3 000 towers
//! with lengths of about 1, heaviest loads from 0.1 to 10⁴ gave every verdict right. With SI units of large structures, half
//! of the towers were called infeasible. Lengths are therefore measured in median interface lengths, and forces are scaled
//! so that the heaviest load is 300.

use crate::assembly::Assembly;

/// Metres and newtons per unit of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Metres per unit of length: L, the median interface length.
    pub length: f64,
    /// Newtons per unit of force.
    pub force: f64,
}

impl Scale {
    /// The scale of an assembly, from its length L and its heaviest load.
    pub fn from_assembly(assembly: &Assembly) -> Scale {
        Scale::new(assembly.length, assembly.heaviest_load())
    }

    /// The heaviest load of a frame in scaled units. Ten times and a tenth of it are within the range that was tested.
    pub const HEAVIEST: f64 = 300.0;

    /// The scale for a median interface length (m) and a heaviest load (N). A frame without loads is scaled by 1 N.
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
