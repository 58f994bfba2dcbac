//! Functions that change one quantity of an assembly, such as friction, for the computation of margins. The bodies stay
//! in their positions.

use super::Assembly;
use crate::geometry::Vector;
use crate::mechanics::scene::Limits;

impl Assembly {
    /// Sets the friction coefficient of every contact to `mu`.
    pub fn with_friction(mut self, mu: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.friction = mu;
        }
        self
    }

    /// Moves the application points inward by `kernel`/2 of each interface's length, measured from the interface's
    /// ends.
    pub fn with_kernel(mut self, kernel: f64) -> Assembly {
        for contact in &mut self.contacts {
            contact.points = crate::mechanics::statics::interface::application_points(contact.ends, kernel);
        }
        self
    }

    /// Sets the gravity vector `pull`, in newtons per newton of weight, and recomputes the loads.
    pub fn with_gravity(mut self, pull: Vector) -> Assembly {
        self.pull = pull;
        self.with_summed_loads()
    }

    /// Sets the factor by which the listed loads are multiplied, and recomputes the loads.
    pub fn with_load_factor(mut self, factor: f64) -> Assembly {
        self.load_factor = factor;
        self.with_summed_loads()
    }

    /// Sets the limits of the grip with this index.
    pub fn with_limits(mut self, grip: usize, limits: Limits) -> Assembly {
        self.grips[grip].limits = limits;
        self
    }
}
