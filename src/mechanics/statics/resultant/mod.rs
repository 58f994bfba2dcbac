//! [`Resultant`]: the one force that stands for both corners of an interface.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.9 and its footnote: the moment-equivalent point is the
//! amplitude-weighted average of the
//! application points.

use crate::geometry::{Point, Vector};
use crate::interface::Interface;
use crate::scene::BodyId;

/// The one force that stands for both corners of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Resultant {
    /// The body it acts on; its partner gets the opposite.
    pub on: BodyId,
    /// The moment-equivalent point Σ N_k p_k / Σ N_k, metres (the middle where there is no force).
    pub at: Point,
    /// Normal and friction force together, N.
    pub force: Vector,
}

/// Sums the corner forces of an interface.
///
/// Friction acts along the interface, so it has the same moment wherever on it it is placed: at Σ N_k p_k / Σ N_k the sum
/// has the moment of all corner forces together.
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
/// let sum = resultant::from_corner_forces(&seam, 0.0, [1.0, 3.0], 2.0);
/// assert_eq!(sum.at, Point::new(1.0, 1.0));
/// assert_eq!(sum.force, Vector::new(-2.0, 4.0));
/// ```
pub fn from_corner_forces(
    interface: &Interface,
    kernel: f64,
    normal: [f64; 2],
    friction: f64,
) -> Resultant {
    let points = interface.application_points(kernel);
    let sum = normal[0] + normal[1];
    let at = if sum > 0.0 {
        points[0] + (points[1] - points[0]) * (normal[1] / sum)
    } else {
        interface.middle()
    };
    Resultant {
        on: interface.bodies[0],
        at,
        force: interface.normal * sum + interface.tangent() * friction,
    }
}

/// |T| / (μ (N1 + N2)): the share of the available friction that is used; 0 where there is no force.
pub fn friction_used(interface: &Interface, normal: [f64; 2], friction: f64) -> f64 {
    let available = interface.friction * (normal[0] + normal[1]);
    if available > 0.0 {
        friction.abs() / available
    } else {
        0.0
    }
}
