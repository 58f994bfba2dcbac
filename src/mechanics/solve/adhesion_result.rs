//! [`LeastAdhesion`]: the least additional forces with which a structure would stand: tension and excess friction of
//! contacts, and excess forces of robots.

use super::amounts::{Amounts, Effort};

/// The least adhesion with which every block of a program is balanced, with the forces of that balance and a motion.
#[derive(Clone, Debug)]
pub struct LeastAdhesion {
    /// True if admissible forces and adhesion together can balance every block; `None` if the solver ended without a
    /// result.
    pub balanced: Option<bool>,
    /// The admissible forces (pressure, friction and robot forces within their limits) of the balance with the least
    /// adhesion. All are 0 if there is no such balance.
    pub forces: Amounts,
    /// The adhesion (tension, and friction and robot forces beyond their limits) of the balance with the least
    /// adhesion. All are 0 if there is no such balance.
    pub adhesion: Amounts,
    /// A motion that no contact resists: three velocities for each block. If the structure needs adhesion, the loads do
    /// more work along it than the robots can absorb. `None` if the solver ended without a result.
    pub motion: Option<Vec<f64>>,
    /// True if admissible forces had a small cost in the program. The contacts may then resist the motion slightly.
    pub priced: bool,
    /// The number of programs and iterations that were needed.
    pub effort: Effort,
}
