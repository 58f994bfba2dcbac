//! The types of the scene file for the questions that a scene asks: what happens if a support moves.

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
