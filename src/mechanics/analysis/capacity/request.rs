//! [`CapacityRequest`]: the block, the point and the ranges of uncertain quantities for which a capacity is computed.

use crate::geometry::{Point, Vector};
use crate::mechanics::scene::{BlockId, Frame, Hold, Load, Scene};

/// The block, the point and the ranges of uncertain quantities for which a [`LoadCapacity`](super::LoadCapacity) is
/// computed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CapacityRequest {
    /// The block on which the force acts.
    pub block: BlockId,
    /// The point at which the force acts.
    pub at: ForceAt,
    /// The ranges of uncertain quantities. The forces must be carried at all values in these ranges.
    pub cases: Cases,
}

/// The point of a block at which a force acts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum ForceAt {
    /// At the grip point if a robot holds the block. The force then replaces the force of this robot, and its force
    /// limits do not apply. Otherwise at the centroid of the block.
    #[default]
    Default,
    /// At this point, in metres. The point is fixed to the block.
    Point(Point),
    /// At two points, in metres, with a force in any direction at each. The capacity is the set of the resultants of
    /// the two forces.
    Contact([Point; 2]),
}

/// Ranges of quantities that are not known exactly. `None` means that the value of the scene is used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Cases {
    /// The rotation of gravity, degrees, positive if the tip of its vector moves to the right. Listed loads do not
    /// rotate.
    pub tilt: Option<[f64; 2]>,
    /// The fraction of each weight that acts at right angles to gravity, positive to the right.
    pub horizontal_load: Option<[f64; 2]>,
    /// The friction coefficient of all interfaces.
    pub friction: Option<[f64; 2]>,
}

/// Why no capacity was computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CapacityError {
    /// The scene has no frame with this number.
    #[error("the scene has no frame with this number")]
    NoFrame,
    /// The scene has no such block.
    #[error("the scene has no such block")]
    NoBlock,
    /// The block is not placed in this frame.
    #[error("the block is not placed in this frame")]
    NotPlaced,
    /// The magnitude of a coordinate is not finite or exceeds 1e12 m, or the two points are the same.
    #[error(
        "the point ({0}, {1}) is not valid: coordinates must be numbers of at most 1e12, and two points must differ"
    )]
    Point(f64, f64),
    /// A range is not valid.
    #[error("{0}")]
    Range(String),
    /// No proof was found of which forces are carried.
    #[error("no proof was found of which forces are carried")]
    Undecided,
    /// Forces and motions are proved, but they leave a gap between the forces that are carried and those that are not, N.
    #[error("no proof was found of which forces are carried: the proofs leave a gap of {0:.1e} N")]
    Inexact(f64),
    /// The search stopped after this number of checks without a proof.
    #[error("no proof was found of which forces are carried: the search stopped after {0} checks without a proof")]
    GaveUp(usize),
    /// The deadline passed before a result was found.
    #[error("the deadline passed before the forces that are carried were found")]
    Late,
}

impl CapacityRequest {
    /// Creates the request for a force at the default point of a block: the grip point if a robot holds the block,
    /// otherwise the centroid.
    pub fn of_block(block: BlockId) -> CapacityRequest {
        CapacityRequest { block, at: ForceAt::Default, cases: Cases::default() }
    }

    /// Returns the default request for a scene. It uses the block of the first robot, in the last frame in which a
    /// robot holds a block. If no frame has such a robot, it uses the block with the highest centroid in the last
    /// frame. `None` if there is no such block.
    pub fn default_for(scene: &Scene) -> Option<CapacityRequest> {
        let held = scene.frames.iter().rev().find_map(|f| f.holds.first());
        let highest = || {
            let placed = scene.frames.last()?.placed.iter().copied();
            let height = |id: &BlockId| scene.blocks[id.0].centroid.y;
            placed.max_by(|a, b| height(a).total_cmp(&height(b)).then(b.cmp(a)))
        };
        held.map(|hold| hold.block).or_else(highest).map(CapacityRequest::of_block)
    }

    /// Returns the same request with the force at another point of the block.
    #[must_use]
    pub fn at(self, at: ForceAt) -> CapacityRequest {
        CapacityRequest { at, ..self }
    }

    /// Returns the same request for other ranges of tilt, horizontal load and friction.
    #[must_use]
    pub fn cases(self, cases: Cases) -> CapacityRequest {
        CapacityRequest { cases, ..self }
    }

    /// Returns the hold of the robot whose force the request replaces. `None` if no robot holds the block, or if the
    /// request names a point.
    pub(super) fn tool<'f>(&self, frame: &'f Frame) -> Option<&'f Hold> {
        let is_default = self.at == ForceAt::Default;
        let mut holds = frame.holds.iter();
        holds.find(|hold| is_default && hold.block == self.block)
    }

    /// Returns the points at which the force acts in a frame, in metres: two for a contact, otherwise one.
    ///
    /// # Errors
    /// Returns an error if the block does not exist or if a point is not valid.
    pub fn points(&self, scene: &Scene, frame: &Frame) -> Result<Vec<Point>, CapacityError> {
        let block = scene.blocks.get(self.block.0);
        let block = block.ok_or(CapacityError::NoBlock)?;
        let points = match self.at {
            ForceAt::Default => vec![self.tool(frame).map_or(block.centroid, |hold| hold.at)],
            ForceAt::Point(at) => vec![at],
            ForceAt::Contact(both) => both.to_vec(),
        };
        let is_valid = |p: &Point| p.x.abs() <= 1e12 && p.y.abs() <= 1e12;
        let wrong = points.iter().find(|p| !is_valid(p));
        let same = || points.get(1).filter(|second| **second == points[0]);
        match wrong.or_else(same) {
            Some(at) => Err(CapacityError::Point(at.x, at.y)),
            None => Ok(points),
        }
    }
}

impl Cases {
    /// Returns these cases with a range of tilts of gravity, in degrees.
    #[must_use]
    pub fn tilt(self, from: f64, to: f64) -> Cases {
        let tilt = Some([from, to]);
        Cases { tilt, ..self }
    }

    /// Returns these cases with a range of horizontal loads, as fractions of the weights.
    #[must_use]
    pub fn horizontal_load(self, from: f64, to: f64) -> Cases {
        let horizontal_load = Some([from, to]);
        Cases { horizontal_load, ..self }
    }

    /// Returns these cases with a range of friction coefficients, which apply to all interfaces.
    #[must_use]
    pub fn friction(self, from: f64, to: f64) -> Cases {
        let friction = Some([from, to]);
        Cases { friction, ..self }
    }

    /// Checks the ranges: the numbers must be finite, the smaller number first, and friction must not be negative.
    ///
    /// # Errors
    /// Returns an error if a range is not valid, or if a range of tilts is wider than [`Cases::WIDEST_TILT`].
    pub fn check(&self) -> Result<(), CapacityError> {
        let ranges = [("tilt", self.tilt), ("horizontal", self.horizontal_load), ("friction", self.friction)];
        for (name, range) in ranges {
            let Some([from, to]) = range else { continue };
            let wrong = |why: &str| {
                let range = format!("the range {name}={from}..{to} {why}");
                Err(CapacityError::Range(range))
            };
            if !(from <= to && from.is_finite() && to.is_finite()) {
                return wrong("is not valid; write the smaller number first");
            }
            if name == "tilt" && to - from > Self::WIDEST_TILT {
                return wrong("is wider than 90°; split it into smaller ranges");
            }
            if name == "friction" && from < 0.0 {
                return wrong("begins below 0");
            }
        }
        Ok(())
    }

    /// The widest range of tilts, degrees.
    pub const WIDEST_TILT: f64 = 90.0;

    /// True if no range is given. The capacity is then computed only for the values of the scene.
    pub fn is_empty(&self) -> bool {
        *self == Cases::default()
    }
}

impl Scene {
    /// Returns the index of the block with this `id` in the scene; `None` if there is no such block.
    ///
    /// ```
    /// use drystone::Scene;
    /// let scene = Scene::from_json(r#"{ "drystone": 1, "blocks": [
    ///     { "id": "a", "polygon": [[0, 0], [3, 0], [0, 2]] }] }"#)?;
    /// assert!(scene.block_named("a").is_some() && scene.block_named("b").is_none());
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn block_named(&self, id: &str) -> Option<BlockId> {
        self.blocks.iter().position(|b| b.id == id).map(BlockId)
    }

    /// Returns a copy of the scene with one more load: a force, N, at a point of a block.
    pub(in crate::mechanics::analysis) fn with_force(&self, block: BlockId, at: Point, force: Vector) -> Scene {
        let mut scene = self.clone();
        scene.loads.push(Load {
            block,
            at,
            force,
            torque: 0.0,
            is_fixed: false,
            fixed_along: None,
            entry: usize::MAX,
            spread: None,
            at_centroid: false,
        });
        scene
    }
}
