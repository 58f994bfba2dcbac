//! [`Analysis::edges`]: the values at which a frame begins to fall if one parameter changes, and the mechanism there.

use super::{Analysis, Margin, Sides, Toward};
use crate::geometry::{Vector, quarter_turn, sin_cos_degrees};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::Scene;

/// How far gravity is rotated beyond the limit to find the mechanism there, degrees. In radians, this is also the step
/// of the horizontal load, and the relative step of the load factor.
const DEGREES_BEYOND_LIMIT: f64 = 0.05;

/// A limit of the parameter of a margin.
struct Limit {
    /// The value of the parameter at the limit.
    at: f64,
    /// 1 if the frame falls at larger values, −1 if it falls at smaller values.
    outward: f64,
    /// The mechanism at the limit.
    motions: Vec<Motion>,
}

impl Analysis {
    /// Returns the value of a parameter at which a frame (numbered from 0) begins to fall, and the elementary mechanism
    /// there. Of two limits of tilt or horizontal load, returns the limit nearer to 0. For the load factor, returns the
    /// upper limit, or the lower limit if there is no upper limit. `None` if the margin was not computed, or if no
    /// limit with a mechanism was found.
    ///
    /// Units and signs: see [`Toward`].
    pub fn edge(&self, frame: usize, toward: Toward) -> Option<(f64, Vec<Motion>)> {
        let limit = self.limits(frame, toward).into_iter().next()?;
        Some(self.beyond(frame, toward, limit))
    }

    /// Like [`Analysis::edge`], with both values at which a frame begins to fall, if it has two: first the value of
    /// `edge`, then the value at the other end.
    ///
    /// Units and signs: see [`Toward`].
    pub fn edges(&self, frame: usize, toward: Toward) -> Vec<(f64, Vec<Motion>)> {
        let limits = self.limits(frame, toward).into_iter();
        limits.map(|limit| self.beyond(frame, toward, limit)).collect()
    }

    /// Returns the limits of a parameter that have a mechanism, first the limit of [`Analysis::edge`].
    fn limits(&self, frame: usize, toward: Toward) -> Vec<Limit> {
        let margins = self.frames.get(frame).and_then(|f| f.margins.as_ref());
        let Some(margins) = margins else {
            return Vec::new();
        };
        let side = |margin: &Margin, sign: f64| match margin {
            Margin::Value { at, mechanism } if !mechanism.is_empty() => {
                Some(Limit { at: sign * at, outward: sign, motions: mechanism.clone() })
            }
            _ => None,
        };
        let sides = |sides: &Sides| [side(&sides.right, 1.0), side(&sides.left, -1.0)];
        let limits = match toward {
            Toward::Tilt => sides(&margins.tilt),
            Toward::HorizontalLoad => sides(&margins.horizontal_load),
            Toward::LoadFactor => {
                let largest = side(&margins.load_factor, 1.0);
                let least = margins.least_factor().map(|(at, motions)| Limit { at, outward: -1.0, motions });
                let least = least.filter(|least| largest.is_none() || least.at > 0.0);
                [largest, least]
            }
        };
        let mut limits: Vec<Limit> = limits.into_iter().flatten().collect();
        if toward != Toward::LoadFactor {
            limits.sort_by(|a, b| a.at.abs().total_cmp(&b.at.abs()));
        }
        limits
    }

    /// Returns the value at a limit, and the elementary mechanism slightly beyond it. Exactly at the limit, the power
    /// along the mechanism is 0; slightly beyond the limit it is positive.
    fn beyond(&self, frame: usize, toward: Toward, limit: Limit) -> (f64, Vec<Motion>) {
        let (gravity, mut scene) = (self.scene.gravity, Scene::clone(self.scene_of(frame)));
        let Limit { at, outward, motions } = limit;
        match toward {
            Toward::Tilt => {
                let (sin, cos) = sin_cos_degrees(at + DEGREES_BEYOND_LIMIT * outward);
                scene.gravity = Vector::new(cos * gravity.x - sin * gravity.y, sin * gravity.x + cos * gravity.y);
            }
            Toward::HorizontalLoad => {
                let fraction = at + DEGREES_BEYOND_LIMIT.to_radians() * outward;
                scene.gravity = gravity + quarter_turn(gravity) * fraction;
            }
            Toward::LoadFactor => {
                let factor = at * (1.0 + outward * DEGREES_BEYOND_LIMIT.to_radians());
                for load in scene.loads.iter_mut().filter(|load| !load.is_fixed) {
                    load.force *= factor;
                    load.torque *= factor;
                }
            }
        }
        let motions = self.elementary_mechanisms(&scene, &self.frames[frame], &motions);
        (at, motions)
    }
}
