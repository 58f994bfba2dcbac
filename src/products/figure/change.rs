//! [`ForceChange`]: compares the force of one interface in two frames, and decides whether it changed. Figures and
//! reports use this comparison.

use crate::analysis::Contact;
use crate::geometry::Vector;

/// A force has changed if the difference exceeds this fraction of the larger of both forces. If forces are not
/// unique, smaller differences can come from the solver.
const CHANGE_TOL: f64 = 0.05;
/// Forces below this fraction of the largest force are rounding errors of the solver.
const NOISE_SHARE: f64 = 1e-6;

/// The force of an interface that two frames have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForceChange<'a> {
    /// The interface in the earlier and in the later frame.
    pub contacts: [&'a Contact; 2],
    /// The force on the same body in the earlier and in the later frame, N.
    pub forces: [Vector; 2],
}

impl ForceChange<'_> {
    /// Returns the magnitudes of the earlier and the later force, N.
    pub(crate) fn amounts(&self) -> [f64; 2] {
        self.forces.map(|force| force.norm())
    }

    /// Returns the larger of the two magnitudes, N.
    pub(crate) fn larger(&self) -> f64 {
        let [before, after] = self.amounts();
        before.max(after)
    }

    /// Returns the magnitude of the difference between the earlier and the later force, N.
    pub(crate) fn difference(&self) -> f64 {
        (self.forces[1] - self.forces[0]).norm()
    }

    /// True if the force changed by more than 5 % of the larger magnitude. Forces of at most `noise` newtons count as
    /// zero; see [`noise`].
    pub(crate) fn is_change(&self, noise: f64) -> bool {
        let larger = self.larger();
        larger > noise && self.difference() > CHANGE_TOL * larger
    }
}

/// Returns the largest magnitude that counts as a rounding error, N: a small fraction of the largest of `amounts`,
/// which are also in N.
pub(crate) fn noise(amounts: impl Iterator<Item = f64>) -> f64 {
    NOISE_SHARE * amounts.fold(0.0, f64::max)
}
