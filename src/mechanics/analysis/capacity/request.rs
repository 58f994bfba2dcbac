//! [`CapacityRequest`]: the block, the point and the cases for which a capacity is computed.

use crate::geometry::{Point, Vector};
use crate::scene::{BlockId, Frame, Hold, Scene};

/// The block, the point and the cases for which a [`LoadCapacity`](super::LoadCapacity) is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CapacityRequest {
    /// The block on which the force acts.
    pub block: BlockId,
    /// Where it acts.
    pub at: ForceAt,
    /// The cases in each of which the forces must be carried.
    pub cases: Cases,
}

/// Where a force acts on a block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum ForceAt {
    /// At the grip point if a robot holds the block: then it is the force of this robot, without the limits of its force.
    /// Otherwise at the centroid of the block.
    #[default]
    Usual,
    /// At a point that moves with the block, metres.
    Point(Point),
    /// At two points, in any direction at each. They are one more contact, whose resultant is asked for.
    Contact([Point; 2]),
}

/// Ranges of quantities that are not known exactly; `None` for those of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Cases {
    /// The rotation of gravity, degrees, positive if its tip moves to the right. Listed loads do not rotate.
    pub tilt: Option<[f64; 2]>,
    /// The fraction of each weight that acts at right angles to gravity, positive to the right.
    pub horizontal_load: Option<[f64; 2]>,
    /// One friction coefficient for every interface.
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
    /// A point is not finite, or two points are the same.
    #[error(
        "the point ({0}, {1}) is not valid: coordinates must be numbers of at most 1e12, and two points must differ"
    )]
    Point(f64, f64),
    /// A range is not valid.
    #[error("{0}")]
    Range(String),
    /// Neither forces nor a motion proved whether any force is carried.
    #[error("no proof was found of which forces are carried")]
    Undecided,
    /// The deadline passed.
    #[error("the deadline passed before the forces that are carried were found")]
    Late,
}

impl CapacityRequest {
    /// Requests the forces at the usual point of a block: its grip point, or its centroid.
    pub fn of_block(block: BlockId) -> CapacityRequest {
        CapacityRequest {
            block,
            at: ForceAt::Usual,
            cases: Cases::default(),
        }
    }

    /// Returns the request of a scene for which nobody chose a block: the last block that a robot holds, or the placed
    /// block whose centroid is highest. `None` without blocks.
    pub fn usual(scene: &Scene) -> Option<CapacityRequest> {
        let held = scene.frames.iter().rev().find_map(|f| f.holds.first());
        let highest = || {
            let placed = scene.frames.last()?.placed.iter().copied();
            let height = |id: &BlockId| scene.blocks[id.0].centroid.y;
            placed.max_by(|a, b| height(a).total_cmp(&height(b)).then(b.cmp(a)))
        };
        held.map(|hold| hold.block)
            .or_else(highest)
            .map(CapacityRequest::of_block)
    }

    /// Sets where the force acts.
    #[must_use]
    pub fn at(self, at: ForceAt) -> CapacityRequest {
        CapacityRequest { at, ..self }
    }

    /// Sets the cases in each of which the forces must be carried.
    #[must_use]
    pub fn cases(self, cases: Cases) -> CapacityRequest {
        CapacityRequest { cases, ..self }
    }

    /// Returns the hold of the robot whose force is asked for, if there is one.
    pub(super) fn tool<'f>(&self, frame: &'f Frame) -> Option<&'f Hold> {
        let is_usual = self.at == ForceAt::Usual;
        let mut holds = frame.holds.iter();
        holds.find(|hold| is_usual && hold.block == self.block)
    }

    /// Returns the point, or the two points, at which the force acts in a frame.
    ///
    /// # Errors
    /// If the block does not exist or a point is not valid.
    pub fn points(&self, scene: &Scene, frame: &Frame) -> Result<Vec<Point>, CapacityError> {
        let block = scene.blocks.get(self.block.0);
        let block = block.ok_or(CapacityError::NoBlock)?;
        let points = match self.at {
            ForceAt::Usual => vec![self.tool(frame).map_or(block.centroid, |hold| hold.at)],
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
    /// Returns the same cases with a range of tilts, degrees.
    #[must_use]
    pub fn tilt(self, from: f64, to: f64) -> Cases {
        let tilt = Some([from, to]);
        Cases { tilt, ..self }
    }

    /// Returns the same cases with a range of horizontal fractions of the weights.
    #[must_use]
    pub fn horizontal_load(self, from: f64, to: f64) -> Cases {
        let horizontal_load = Some([from, to]);
        Cases {
            horizontal_load,
            ..self
        }
    }

    /// Returns the same cases with a range of friction coefficients.
    #[must_use]
    pub fn friction(self, from: f64, to: f64) -> Cases {
        let friction = Some([from, to]);
        Cases { friction, ..self }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// If a range is not valid, or if its extreme values do not show which forces are carried between them.
    pub fn check(&self) -> Result<(), CapacityError> {
        let ranges = [
            ("tilt", self.tilt),
            ("horizontal", self.horizontal_load),
            ("friction", self.friction),
        ];
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
                return wrong(
                    "is wider than 90°: between such tilts gravity differs too much from both; split it into smaller ranges",
                );
            }
            if name == "friction" && from < 0.0 {
                return wrong("begins below 0");
            }
        }
        Ok(())
    }

    /// The widest range of tilts, degrees.
    pub const WIDEST_TILT: f64 = 90.0;

    /// True if there is one case only, that of the scene.
    pub fn is_empty(&self) -> bool {
        *self == Cases::default()
    }
}

impl Scene {
    /// Returns the block with this id.
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

    /// Returns a copy of the scene with one more load.
    pub(in crate::mechanics::analysis) fn with_force(
        &self,
        block: BlockId,
        at: Point,
        force: Vector,
    ) -> Scene {
        let mut scene = self.clone();
        scene.loads.push(crate::scene::Load {
            block,
            at,
            force,
            torque: 0.0,
            at_centroid: false,
        });
        scene
    }
}
