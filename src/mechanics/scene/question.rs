//! The questions that a scene asks beside its verdicts.

use crate::geometry::{Point, Vector, quarter_turn};

/// A small movement of a part of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Movement {
    /// The index of the part of the ground, from 0.
    pub ground: usize,
    /// Translation in metres.
    pub translation: Vector,
    /// Rotation in radians, anticlockwise positive.
    pub rotation: f64,
    /// The point about which the part turns, metres.
    pub about: Point,
}

impl Movement {
    /// Returns the displacement of a point of the part, in metres, for a small rotation.
    pub fn at(&self, point: Point) -> Vector {
        self.translation + quarter_turn(point - self.about) * self.rotation
    }
}
