//! [`JointSet`]: joints with a name, whose friction may differ from that of other joints.

use super::format::JointDirection;
use super::{BodyId, Scene};
use crate::geometry::Vector;

/// A set of joints of a scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointSet {
    /// The name of the set.
    pub id: String,
    /// The direction of its joints; `None` for all directions.
    pub direction: Option<JointDirection>,
    /// The bodies on both sides; `None` for all bodies.
    pub bodies: Option<(JointBody, JointBody)>,
    /// The numbers of the materials on both sides in the scene's list; `None` for all materials.
    pub materials: Option<(usize, usize)>,
    /// The friction coefficient of its joints, if the set gives one.
    pub friction: Option<f64>,
    /// Whether the margin `friction_factor` multiplies the coefficients of this set.
    pub is_factored: bool,
}

/// A body at the joints of a [`JointSet`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointBody {
    /// A block, or a part of the ground.
    Is(BodyId),
    /// Any part of the ground.
    AnyGround,
}

impl JointBody {
    fn is(self, body: BodyId) -> bool {
        match self {
            JointBody::Is(own) => own == body,
            JointBody::AnyGround => matches!(body, BodyId::Ground(_)),
        }
    }
}

/// The sine of 45 degrees, with room for rounding: a joint at exactly 45 degrees is a bed.
const BED: f64 = std::f64::consts::FRAC_1_SQRT_2 - 1e-9;

impl JointSet {
    /// True if the joint of two bodies with this normal meets all that the set asks for. Without gravity, no joint has a
    /// direction.
    pub(super) fn contains(&self, scene: &Scene, bodies: [BodyId; 2], normal: Vector) -> bool {
        let [a, b] = bodies;
        let of_direction = self.direction.is_none_or(|wanted| {
            let down = scene.down();
            let is_bed = normal.dot(&down).abs() >= BED * down.norm();
            down.norm() > 0.0 && is_bed == (wanted == JointDirection::Bed)
        });
        let of_bodies =
            self.bodies.is_none_or(|(first, second)| first.is(a) && second.is(b) || first.is(b) && second.is(a));
        let [m, n] = bodies.map(|body| scene.body(body).material);
        let of_materials = self.materials.is_none_or(|(first, second)| {
            [m, n] == [Some(first), Some(second)] || [n, m] == [Some(first), Some(second)]
        });
        of_direction && of_bodies && of_materials
    }
}
