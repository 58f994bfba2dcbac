//! [`Displacement`]: a rigid displacement of a block: a rotation about a point and a translation.

use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::Motion;

/// A rotation about a point, followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Displacement {
    centre: Point,
    sin: f64,
    cos: f64,
    translation: Vector,
}

impl Displacement {
    /// Converts the velocity of a block to a displacement. If the block spins, the displacement is a rotation by
    /// `amplitude`·spin about the instantaneous centre; otherwise it is a translation by `amplitude`·velocity.
    ///
    /// Units: `amplitude` is the displacement in metres of a point of speed 1.
    pub fn new(motion: &Motion, centroid: Point, amplitude: f64) -> Displacement {
        let angle = amplitude * motion.spin;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        // The rotation about the instantaneous centre equals a rotation about the centroid, followed by the translation
        // along the chord of the centroid's arc: amplitude·(sin θ/θ·v + (1 − cos θ)/θ·v⊥). Below 1e-6 rad, the first
        // terms of the Taylor series are used, with a relative error below 2e-13. They also hold for a pure
        // translation.
        let (along, aside) = if angle.abs() < 1e-6 { (1.0, 0.5 * angle) } else { (sin / angle, (1.0 - cos) / angle) };
        let translation = (motion.velocity * along + quarter_turn(motion.velocity) * aside) * amplitude;
        Displacement { centre: centroid, sin, cos, translation }
    }

    /// Creates a rotation by an angle in radians about a point, followed by a translation in metres.
    pub fn from_pose(centre: Point, angle: f64, translation: Vector) -> Displacement {
        Displacement { centre, sin: libm::sin(angle), cos: libm::cos(angle), translation }
    }

    /// Returns the translation that follows the rotation, metres.
    pub fn translation(&self) -> Vector {
        self.translation
    }

    /// Returns the position of a point of the block after the displacement, metres. `point` is its original position.
    pub fn moved(&self, point: Point) -> Point {
        self.centre + self.turned(point - self.centre) + self.translation
    }

    /// Returns the original position of a point of the block, metres. `point` is its position after the displacement.
    pub fn back(&self, point: Point) -> Point {
        let d = point - self.centre - self.translation;
        self.centre + d * self.cos - quarter_turn(d) * self.sin
    }

    /// Rotates a vector by the rotation of the block.
    pub fn turned(&self, direction: Vector) -> Vector {
        direction * self.cos + quarter_turn(direction) * self.sin
    }
}
