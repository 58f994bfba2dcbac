//! [`LeastAdhesion`]: the least tension and excess friction that contacts would need for a structure to stand.

use super::amounts::{Amounts, Effort};

/// The least adhesion with which a program is balanced.
#[derive(Clone, Debug)]
pub struct LeastAdhesion {
    /// Whether some adhesion balances every block; `None` if the solver ended without a result.
    pub balanced: Option<bool>,
    /// The admissible forces (pressure and friction within its limit) of that balance.
    pub forces: Amounts,
    /// The adhesion (tension, and friction beyond its limit) of that balance.
    pub adhesion: Amounts,
    /// A motion along which the loads do work and the contacts do none: three velocities for each block. `None` if
    /// the solver ended without a result.
    pub motion: Option<Vec<f64>>,
    /// Whether admissible forces had a small cost in the program. If so, contacts may do a little work along the
    /// motion.
    pub priced: bool,
    /// The number of programs and iterations that were needed.
    pub effort: Effort,
}
