//! [`Sensitivity`]: the derivatives of a margin with respect to corners, load points, weights and friction.
//!
//! At an end of a margin's interval the forces balance, and the power of all forces along the mechanism u is 0. If a
//! quantity p changes, the parameter value λ at this end changes such that this power stays 0. Therefore dλ/dp =
//! −(u·∂r/∂p) / (u·∂r/∂λ), where r is the sum of the forces on each body. The derivative is exact. It needs one linear
//! program for each end, and no program for each corner.
//!
//! | file | content |
//! |---|---|
//! | `elimination` | small dense systems of equations, with all their solutions |
//! | `joints`, `corners` | corners that move together if contacts are kept |
//! | `case`, `reduced`, `state` | forces and mechanism at an end, and whether they are unique |
//! | `rates` | the derivatives for one state |
//! | `find` | the sensitivity of a frame: each derivative is unique, one-sided, or at a kink |
//!
//! Reference: Nocedal and Wright, Numerical Optimization, 2006, section 12.8 (multipliers and sensitivity).

mod elimination;
mod joints;
mod corners;
mod case;
mod reduced;
mod state;
mod rates;
mod find;

use super::margin::MarginKind;
use super::{Analysis, Options};
use crate::geometry::{Point, Vector};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
pub use find::Slope;
pub(super) use find::{Part, find};

impl Analysis {
    /// Returns the derivatives of a margin of a frame (numbered from 0) with respect to the positions of corners and of
    /// load points (per metre), weights (per newton) and friction coefficients (per unit).
    ///
    /// The derivatives are in the unit of the margin (degrees for the tilt) divided by these units. The frame is
    /// analysed again unless [`Options::sensitivity`] requested this margin.
    ///
    /// # Errors
    /// Returns the reason if neither end of the margin has derivatives. For [`MarginKind::Robots`], or if the frame
    /// does not exist, the reason is [`NoSensitivity::NotApplicable`].
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::MarginKind};
    /// // A block 3 m wide and 2 m high would topple at a horizontal share of 1.5, but slides at its friction of 0.5.
    /// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
    ///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
    ///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }] }"#)?;
    /// let analysis = Analysis::new(&scene);
    /// let found = analysis.sensitivity(0, MarginKind::HorizontalLoad).expect("it slides");
    /// let right = found.high.expect("it slides to the right");
    /// let friction = right.friction_of_all.and_then(|slope| slope.unique()).expect("unique");
    /// assert!((friction - 1.0).abs() < 1e-9);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn sensitivity(&self, frame: usize, kind: MarginKind) -> Result<Sensitivity, NoSensitivity> {
        let known = self.frames.get(frame).and_then(|f| f.sensitivity.as_ref());
        let found = match known.filter(|known| known.kind == kind) {
            Some(known) => known.clone(),
            None => {
                let scene = self.given.alone(frame).ok_or(NoSensitivity::NotApplicable)?;
                let analysis = Analysis::with(scene, &Options::default().sensitivity(kind));
                let first = analysis.frames.first().and_then(|frame| frame.sensitivity.clone());
                first.ok_or(NoSensitivity::NotApplicable)?
            }
        };
        match found.reason() {
            Some(reason) => Err(reason),
            None => Ok(found),
        }
    }
}

/// How the ends of a margin change with corners, weights, friction and loads.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sensitivity {
    /// The margin whose ends change.
    pub kind: MarginKind,
    /// The derivatives of the lower end of its interval, or the reason why there are none.
    pub low: Result<EndSensitivity, NoSensitivity>,
    /// The derivatives of the upper end of its interval, or the reason why there are none.
    pub high: Result<EndSensitivity, NoSensitivity>,
}

impl Sensitivity {
    /// Returns the margin whose sensitivity a figure shows by default: the load factor if a placed block has a load,
    /// otherwise the tilt.
    pub fn default_kind(scene: &Scene) -> MarginKind {
        let placed = |block| scene.frames.iter().any(|f| f.placed.contains(&block));
        if scene.loads.iter().any(|load| placed(load.block)) { MarginKind::LoadFactor } else { MarginKind::Tilt }
    }

    /// Returns the derivatives of the end of the interval that a figure shows. This is the end nearer to 0; for the
    /// load factor it is the upper end, if that has derivatives. The flag is true for the upper end. `None` if neither
    /// end has derivatives.
    pub fn nearest(&self) -> Option<(bool, &EndSensitivity)> {
        match (&self.low, &self.high) {
            (Err(_), Err(_)) => None,
            (Ok(low), Err(_)) => Some((false, low)),
            (Err(_), Ok(high)) => Some((true, high)),
            (Ok(low), Ok(high)) => {
                let is_nearer = low.value.abs() < (1.0 - 1e-6) * high.value.abs();
                if is_nearer && self.kind != MarginKind::LoadFactor { Some((false, low)) } else { Some((true, high)) }
            }
        }
    }

    /// Returns those ends of the interval that have derivatives, the lower end first. The flag is true for the upper
    /// end.
    pub fn ends(&self) -> impl Iterator<Item = (bool, &EndSensitivity)> {
        let both = [(false, &self.low), (true, &self.high)];
        both.into_iter().filter_map(|(is_high, end)| Some((is_high, end.as_ref().ok()?)))
    }

    /// Returns why there are no derivatives, if neither end of the interval has any. Otherwise `None`.
    ///
    /// This is the reason for the upper end. If the frame falls beyond the lower end only, as with friction, it is
    /// the reason for the lower end.
    pub fn reason(&self) -> Option<NoSensitivity> {
        let falls_nowhere =
            |reason: &NoSensitivity| matches!(reason, NoSensitivity::Unbounded | NoSensitivity::RangeEnds);
        match (&self.low, &self.high) {
            (Err(low), Err(high)) if falls_nowhere(high) && !falls_nowhere(low) => Some(*low),
            (Err(_), Err(high)) => Some(*high),
            _ => None,
        }
    }
}

/// Why an end of a margin has no sensitivity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoSensitivity {
    /// The margin does not exist in this frame (for example, there are no loads), or the scene lists its contacts.
    NotApplicable,
    /// The frame falls at every value.
    Empty,
    /// The frame stands at every value in this direction.
    Unbounded,
    /// The end is a limit of the range of the parameter; the frame does not fall there.
    RangeEnds,
    /// No verdict confirms the end.
    Unconfirmed,
    /// Forces and mechanism at the end could not be computed.
    Unsolved,
}

/// The derivatives of one end of a margin.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct EndSensitivity {
    /// The value of the parameter at this end: in degrees for the tilt, otherwise without a unit.
    pub value: f64,
    /// The derivatives for the corners of all placed blocks, in the order of the blocks.
    pub corners: Vec<CornerSlope>,
    /// The derivative for each placed block, per newton of its weight. Its centroid stays where it is.
    pub weights: Vec<(BlockId, Slope)>,
    /// The derivative for each interface of the frame, with the index of the interface, per unit of its friction
    /// coefficient. Empty for the margin of friction, which sets all coefficients.
    pub friction: Vec<(usize, Slope)>,
    /// The derivative if all friction coefficients increase together, per unit. `None` for the margin of friction.
    pub friction_of_all: Option<Slope>,
    /// The derivatives for each load on a placed block.
    pub loads: Vec<LoadSlope>,
}

/// How an end changes if a corner moves and the contacts are kept.
///
/// Corners at the same end of a joint move together. A corner on an edge of another body moves along this edge, and
/// follows the edge if the edge moves. A weight that is computed from a density changes with the area. The points of
/// loads and grips stay; a load or a grip without `at` moves with the centroid.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CornerSlope {
    /// The block.
    pub block: BlockId,
    /// The index of the corner: anticlockwise in the outline, from 0. The corners of holes follow.
    pub corner: usize,
    /// The position of the corner, metres.
    pub at: Point,
    /// The other bodies with a corner that is joined with this corner and moves with it.
    pub with: Vec<BodyId>,
    /// In which directions the corner can move, with the derivatives per metre.
    pub moves: CornerMoves,
}

/// How a margin changes with the place of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LoadSlope {
    /// The index of the entry of the load in the list of loads of the scene file.
    pub entry: usize,
    /// The block on which it acts.
    pub block: BlockId,
    /// The point at which it acts, metres.
    pub at: Point,
    /// The derivatives per metre that this point moves along x and along y.
    pub slopes: [Slope; 2],
}

/// The directions in which a corner can move without opening a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CornerMoves {
    /// In every direction; the derivatives along x and along y.
    Freely([Slope; 2]),
    /// Along the edge of another body.
    Along {
        /// The unit vector along the edge.
        direction: Vector,
        /// The derivative in this direction.
        slope: Slope,
    },
    /// The corner cannot move without opening a contact, or the derivatives of its moves are not computed.
    Not,
}

impl CornerMoves {
    /// Returns the gradient, which points in the direction in which the margin's value increases most. `None` if a
    /// derivative is not unique, or if the corner cannot move.
    pub fn gradient(self) -> Option<Vector> {
        match self {
            CornerMoves::Freely([x, y]) => Some(Vector::new(x.unique()?, y.unique()?)),
            CornerMoves::Along { direction, slope } => Some(direction * slope.unique()?),
            CornerMoves::Not => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reason_comes_from_an_end_at_which_the_frame_falls() {
        use NoSensitivity::{RangeEnds, Unbounded, Unconfirmed, Unsolved};
        let reason = |low, high| {
            let (kind, low, high) = (MarginKind::Friction, Err(low), Err(high));
            Sensitivity { kind, low, high }.reason()
        };
        assert_eq!(reason(Unsolved, Unbounded), Some(Unsolved));
        assert_eq!(reason(Unconfirmed, RangeEnds), Some(Unconfirmed));
        assert_eq!(reason(Unsolved, Unconfirmed), Some(Unconfirmed));
        assert_eq!(reason(RangeEnds, Unbounded), Some(Unbounded));
    }
}
