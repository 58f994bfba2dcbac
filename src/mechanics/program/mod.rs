//! [`Program`]: the equilibrium equations of one component of an assembly, without units.
//!
//! Each block has three rows: force x, force y, and moment about its centroid divided by L. Each force has a column
//! ([`Column`]). Invariant: lengths are divided by the median interface length L, and forces are scaled so that the
//! heaviest load is [`Scale::HEAVIEST`]. The solver's data therefore do not depend on the position and units of the
//! scene.
//!
//! | file | content |
//! |---|---|
//! | `column` | the coefficients of each force in the equilibrium equations |
//! | `scale` | metres and newtons to numbers without units, and back |
//! | `pose` | the optimisation problems for the solvers |

mod column;
mod pose;
mod scale;
#[cfg(test)]
mod tests;

pub use column::{Column, Force, UnknownCounts, adhesion_columns, columns};
#[cfg(test)]
use pose::product;
pub use pose::{
    Aim, Correction, CostCap, Factor, QuadraticProgram, force_primal, kinematic_form, least_change, least_norm,
    least_squares,
};
pub use scale::Scale;

use crate::geometry::{Point, Vector};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::interface::ContactKind;

/// The equilibrium of one component of an assembly, in numbers without units.
#[derive(Clone, Debug)]
pub struct Program {
    /// Number of bodies; body k has the rows 3k, 3k+1 and 3k+2.
    pub blocks: usize,
    /// The right-hand side: minus the load vector of each body, as (x, y, moment).
    pub loads: Vec<f64>,
    /// The contacts.
    pub contacts: Vec<ContactTerm>,
    /// The grips.
    pub grips: Vec<GripTerm>,
    /// The metres and newtons per unit of the program.
    pub scale: Scale,
}

/// A contact in scaled numbers.
#[derive(Clone, Debug)]
pub struct ContactTerm {
    /// Edge or corner.
    pub kind: ContactKind,
    /// The index of the first body, and the lever arms of the application points about its centroid.
    pub on: (usize, [Vector; 2]),
    /// The index of the second body, and the lever arms about its centroid; `None` if the second body is the ground.
    pub from: Option<(usize, [Vector; 2])>,
    /// Unit normal that points into the first body.
    pub normal: Vector,
    /// Friction coefficient; 0 if friction is not simulated.
    pub friction: f64,
    /// The number of application points: 2 for an edge, 1 for a corner contact.
    pub points: usize,
}

/// A grip in scaled numbers.
#[derive(Clone, Debug)]
pub struct GripTerm {
    /// The index of the held body.
    pub block: usize,
    /// Lever arm of the grip point about the body's centroid.
    pub arm: Vector,
    /// Limits of force x, force y and torque divided by L; infinite without a limit, 0 if the component is not
    /// simulated.
    pub limits: [f64; 3],
}

impl Program {
    /// Sets up the equilibrium equations of an assembly in the units of `scale`. Contacts and grips keep their order.
    pub fn new(assembly: &Assembly, scale: Scale) -> Program {
        let arms = |body: usize, points: [Point; 2]| {
            let centroid = assembly.bodies[body].centroid;
            (body, points.map(|p| (p - centroid) / scale.length))
        };
        let mut loads = Vec::with_capacity(3 * assembly.bodies.len());
        for body in &assembly.bodies {
            loads.extend([
                -body.load.force.x / scale.force,
                -body.load.force.y / scale.force,
                -body.load.moment / scale.moment(),
            ]);
        }
        let contacts = assembly.contacts.iter().map(|contact| ContactTerm {
            kind: contact.kind,
            on: arms(contact.on, contact.points),
            from: contact.from.map(|body| arms(body, contact.points)),
            normal: contact.normal,
            friction: contact.friction,
            points: contact.points_in_use(),
        });
        let grips = assembly.grips.iter().map(|grip| GripTerm {
            block: grip.body,
            arm: (grip.at - assembly.bodies[grip.body].centroid) / scale.length,
            limits: [grip.limits.fx / scale.force, grip.limits.fy / scale.force, grip.limits.torque / scale.moment()],
        });
        Program { blocks: assembly.bodies.len(), loads, contacts: contacts.collect(), grips: grips.collect(), scale }
    }

    /// Programs of at least this many blocks have many blocks. A short first attempt decides most of them, extra
    /// solutions cost too much, and near the limit of stability they need wider tolerances. A wall of 200 bricks is the
    /// smallest with which this was measured.
    const MANY_BLOCKS: usize = 200;

    /// True if the program has many blocks, so that other orders and tolerances of solvers suit it.
    pub fn has_many_blocks(&self) -> bool {
        self.blocks >= Self::MANY_BLOCKS
    }

    /// A robot's limit above this multiple of the sum of all loads counts as non-binding.
    const NON_BINDING_RATIO: f64 = 10.0;

    /// Returns the program without those limits of robots that are far above the loads. `None` if there are no such
    /// limits.
    ///
    /// A limit adds a row and an unknown, and a limit of 10⁹ times the loads dominates the objective numerically. The
    /// caller checks with [`Program::allows`] whether the result respects the omitted limits. If it does not, the
    /// caller solves the program again with all limits.
    pub fn without_non_binding_limits(&self) -> Option<Program> {
        let sum: f64 = self.loads.iter().map(|v| v.abs()).sum();
        let non_binding = |limit: f64| limit.is_finite() && limit > Self::NON_BINDING_RATIO * sum;
        let any = self.grips.iter().flat_map(|g| g.limits).any(non_binding);
        any.then(|| {
            let mut program = self.clone();
            for limit in program.grips.iter_mut().flat_map(|g| &mut g.limits).filter(|l| non_binding(**l)) {
                *limit = f64::INFINITY;
            }
            program
        })
    }

    /// True if robot forces are within the limits of this program, up to rounding. `grips` has the force x, force y and
    /// torque of each grip, in program units.
    pub fn allows(&self, grips: &[[f64; 3]]) -> bool {
        self.grips.iter().zip(grips).all(|(term, given)| {
            term.limits.iter().zip(given).all(|(limit, amount)| amount.abs() <= limit * (1.0 + 1e-9) + 1e-9)
        })
    }
}
