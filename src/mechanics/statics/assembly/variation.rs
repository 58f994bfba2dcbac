//! Changed assemblies: the same bodies in the same positions, with one quantity changed. Margins are computed from
//! them.

use super::Assembly;
use crate::geometry::Vector;
use crate::scene::Limits;

impl Assembly {
    /// The assembly with the friction coefficient `mu` at every contact.
    pub fn with_friction(mut self, mu: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.friction = mu;
        }
        self
    }

    /// The assembly with application points moved inward by `kernel`/2 of each interface's length.
    pub fn with_kernel(mut self, kernel: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.points = crate::interface::application_points(contact.ends, kernel);
        }
        self
    }

    /// The assembly with another direction or strength of gravity, in newtons per newton of weight.
    pub fn with_gravity(mut self, pull: Vector) -> Assembly {
        self.pull = pull;
        self.with_summed_loads()
    }

    /// The assembly with the listed loads multiplied by a factor.
    pub fn with_load_factor(mut self, factor: f64) -> Assembly {
        self.load_factor = factor;
        self.with_summed_loads()
    }

    /// The assembly with other limits for the grip with this index.
    pub fn with_limits(mut self, grip: usize, limits: Limits) -> Assembly {
        self.grips[grip].limits = limits;
        self
    }
}
