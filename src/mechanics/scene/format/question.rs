//! The types of the scene file for the questions that a scene asks: what happens if a support moves, and where a
//! vehicle is most dangerous.

use super::declare::entry;
use super::{Pair, vector};

entry! {
    /// A small movement of a part of the ground: a rotation about a point, and a translation.
    pub struct MovementEntry {
        /// Name of the part of the ground that moves.
        ground: required String,
        /// Translation [x, y] in the length unit of the scene. Default [0, 0].
        translation: Option<Pair> [extend("default" = [0.0, 0.0])] as vector,
        /// Rotation about the point in the key `about`, in degrees anticlockwise. Default 0.
        rotation: Option<f64> [extend("default" = 0.0)],
        /// Point [x, y], in the length unit of the scene, about which the part turns. Default: the centroid of the part.
        about: Option<Pair>,
    }
}

impl MovementEntry {
    /// Creates a movement of the part of the ground with this id. It is zero until a translation or a rotation is set.
    pub fn of(ground: impl Into<String>) -> MovementEntry {
        MovementEntry { ground: ground.into(), ..MovementEntry::default() }
    }
}

entry! {
    /// A vehicle that travels over the structure. Its axles are loads on the blocks below them, along gravity.
    pub struct VehicleEntry {
        /// The axles, the first in front.
        axles: required Vec<AxleEntry> [length(min = 1)],
        /// Names of the blocks that the vehicle travels over. Default: all placed blocks that are seen from above.
        over: Vec<String>,
        /// Distance between the positions that are analysed, in the length unit of the scene, at least 0. With 0,
        /// every position with an axle at an end of the top of a block: one of these is the most dangerous position.
        /// Default 0.
        step: Option<f64> [range(min = 0.0), extend("default" = 0.0)],
        /// Whether the vehicle also travels to the left. Default true.
        both_ways: Option<bool> [extend("default" = true)],
    }
}

entry! {
    /// An axle of a vehicle.
    pub struct AxleEntry {
        /// Weight on the axle in the force unit of the scene, at least 0.
        weight: required f64 [range(min = 0.0)],
        /// Distance behind the first axle in the length unit of the scene. Default 0.
        offset: Option<f64> [extend("default" = 0.0)],
    }
}
