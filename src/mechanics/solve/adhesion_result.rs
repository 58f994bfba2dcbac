//! [`LeastAdhesion`]: the result of the program of least adhesion.

use super::amounts::{Amounts, Effort};

/// The least adhesion with which a program is balanced.
#[derive(Clone, Debug)]
pub struct LeastAdhesion {
    /// Whether some sticking balances every block; `None` if the solver ended without a status.
    pub balanced: Option<bool>,
    /// The admissible forces of that balance.
    pub forces: Amounts,
    /// Its sticking forces.
    pub sticking: Amounts,
    /// A motion along which the loads work and no contact does: three velocities for each block.
    pub motion: Option<Vec<f64>>,
    /// Whether admissible forces had a cost, so that contacts may do a little work along the motion.
    pub priced: bool,
    /// The work it took.
    pub effort: Effort,
}
