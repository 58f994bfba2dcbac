//! [`Scale`]: the units of length and force of a program, in metres and newtons.
//!
//! The tolerances of an interior-point solver are absolute numbers, so its data must have a suitable size. For 3 000
//! towers with lengths of about 1, every verdict was right if the heaviest load was between 0.1 and 10⁴. With loads as
//! large as those of large structures in newtons, half of the towers were reported as infeasible. The unit of length is
//! therefore the median interface length, and forces are scaled so that the heaviest load is 300.

use crate::mechanics::statics::assembly::Assembly;

/// Metres and newtons per unit of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Metres per unit of length: L, the median interface length.
    pub length: f64,
    /// Newtons per unit of force.
    pub force: f64,
}

impl Scale {
    /// Chooses the units for an assembly from its median interface length and its heaviest load.
    pub fn from_assembly(assembly: &Assembly) -> Scale {
        Scale::new(assembly.length, assembly.heaviest_load())
    }

    /// The heaviest load of an assembly in scaled units. The verdicts were also right with a tenth of this value and
    /// with ten times this value.
    pub const HEAVIEST: f64 = 300.0;

    /// Chooses the units from a median interface length (m) and the heaviest load (N). If there are no loads, the
    /// heaviest load counts as 1 N.
    pub fn new(length: f64, heaviest: f64) -> Scale {
        let heaviest = if heaviest > 0.0 { heaviest } else { 1.0 };
        Scale { length, force: heaviest / Self::HEAVIEST }
    }

    /// Returns the unit of moment of the program, in N·m.
    pub fn moment(&self) -> f64 {
        self.length * self.force
    }
}
