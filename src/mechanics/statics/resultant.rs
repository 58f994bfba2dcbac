//! [`Resultant`]: the single force that is equivalent to all forces at an interface.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.9 with its footnote. The resultant acts at the average of the
//! application points, weighted by their normal forces.

use crate::geometry::{Point, Vector};
use crate::mechanics::scene::BodyId;
use crate::mechanics::statics::interface::Interface;

/// The single force that is equivalent to the normal forces and the friction of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Resultant {
    /// The body on which the resultant acts: the first body of the interface. The other body receives the opposite
    /// force.
    pub on: BodyId,
    /// The point of action Σ N_k p_k / Σ N_k, metres; the middle of the interface if there is no normal force.
    pub at: Point,
    /// The sum of normal and friction forces, N.
    pub force: Vector,
}

/// Returns the resultant of the normal forces N1 and N2 at the application points (`normal`) and of the friction force
/// along the tangent, all in newtons. `kernel` is the safety kernel (0 to 1), which determines the application points.
///
/// Friction acts along the line of the interface, so it has the same moment at each point of this line. The resultant
/// at Σ N_k p_k / Σ N_k therefore has the moment of all forces together.
///
/// ```
/// # use drystone::{internals::{interface::*, resultant}, scene::*};
/// # let seam = Interface {
/// #     bodies: [BodyId::Block(BlockId(0)), BodyId::Ground(0)],
/// #     kind: ContactKind::Edge,
/// #     ends: [Point::new(4.0, 1.0), Point::new(0.0, 1.0)],
/// #     normal: Vector::new(0.0, 1.0),
/// #     friction: 0.7,
/// # };
/// // Normals of 1 N at x = 4 and 3 N at x = 0, friction 2 N along (−n_y, n_x) = (−1, 0).
/// let sum = resultant::from_point_forces(&seam, 0.0, [1.0, 3.0], 2.0);
/// assert_eq!(sum.at, Point::new(1.0, 1.0));
/// assert_eq!(sum.force, Vector::new(-2.0, 4.0));
/// ```
pub fn from_point_forces(interface: &Interface, kernel: f64, normal: [f64; 2], friction: f64) -> Resultant {
    let points = interface.application_points(kernel);
    let sum = normal[0] + normal[1];
    let at = if sum > 0.0 { points[0] + (points[1] - points[0]) * (normal[1] / sum) } else { interface.middle() };
    Resultant { on: interface.bodies[0], at, force: interface.normal * sum + interface.tangent() * friction }
}

/// Returns the used fraction of the available friction, |T| / (μ (N1 + N2)); 0 if no friction is available.
pub fn friction_used(interface: &Interface, normal: [f64; 2], friction: f64) -> f64 {
    let available = interface.friction * (normal[0] + normal[1]);
    if available > 0.0 { friction.abs() / available } else { 0.0 }
}
