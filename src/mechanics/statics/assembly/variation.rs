//! Changed assemblies: the same bodies in the same places, with one quantity varied. Margins are found from them.

use super::Assembly;
use crate::geometry::Vector;
use crate::scene::Limits;

impl Assembly {
    /// With one friction coefficient at every contact.
    pub fn with_friction(mut self, mu: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.friction = mu;
        }
        self
    }

    /// With application points moved inward by `kernel`/2 of each stretch.
    pub fn with_kernel(mut self, kernel: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.points = crate::interface::application_points(contact.ends, kernel);
        }
        self
    }

    /// With another pull of gravity, in newtons per newton of weight: turned, or stretched.
    pub fn with_gravity(mut self, pull: Vector) -> Assembly {
        self.pull = pull;
        self.with_summed_loads()
    }

    /// With the listed loads times a factor.
    pub fn with_load_factor(mut self, factor: f64) -> Assembly {
        self.load_factor = factor;
        self.with_summed_loads()
    }

    /// With other limits of the grip with this number.
    pub fn with_limits(mut self, grip: usize, limits: Limits) -> Assembly {
        self.grips[grip].limits = limits;
        self
    }
}
