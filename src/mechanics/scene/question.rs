//! The questions that a scene asks beside its verdicts.

use super::BlockId;
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

/// A vehicle that travels over the structure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Vehicle {
    /// The axles, the first in front.
    pub axles: Vec<Axle>,
    /// The blocks that the vehicle travels over; empty for all blocks.
    pub over: Vec<BlockId>,
    /// The distance between the analysed positions, metres; 0 for the positions with an axle at an end of a block's top.
    pub step: f64,
    /// Whether the vehicle also travels to the left.
    pub both_ways: bool,
}

/// An axle of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Axle {
    /// The weight on the axle, N.
    pub weight: f64,
    /// The distance behind the first axle, metres.
    pub offset: f64,
}
