//! [`Analysis::edges`]: the values at which a frame begins to fall if one parameter changes, and the mechanism there.

use super::condition::Condition;
use super::{Analysis, End, MarginKind};
use crate::geometry::quarter_turn;
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::Scene;

/// How far gravity is rotated beyond the limit to find the mechanism there, degrees. In radians, this is also the step
/// of the horizontal load, and the relative step of the load factor.
const DEGREES_BEYOND_LIMIT: f64 = 0.05;

/// A limit of the parameter of a margin.
struct Limit<'a> {
    /// The value of the parameter at the limit.
    at: f64,
    /// 1 if the frame falls at larger values, −1 if it falls at smaller values.
    outward: f64,
    /// The mechanism at the limit.
    mechanism: &'a [Motion],
    /// The condition that decides the limit.
    condition: Condition,
}

impl Analysis {
    /// Returns the value of a parameter at which a frame (numbered from 0) begins to fall, and the elementary mechanism
    /// there. Of two limits of tilt or horizontal load, returns the limit nearer to 0. For the load factor, returns the
    /// upper limit, or the lower limit if there is no upper limit. `None` if the margin was not computed, or if no
    /// limit with a mechanism was found.
    ///
    /// Units and signs: see [`MarginKind`]. Only tilt, horizontal load and load factor have such limits.
    pub fn edge(&self, frame: usize, kind: MarginKind) -> Option<(f64, Vec<Motion>)> {
        let limit = self.limits(frame, kind).into_iter().next()?;
        Some(self.beyond(frame, kind, limit))
    }

    /// Like [`Analysis::edge`], with both values at which a frame begins to fall, if it has two: first the value of
    /// `edge`, then the value at the other end.
    ///
    /// Units and signs: see [`MarginKind`]. Only tilt, horizontal load and load factor have such limits.
    pub fn edges(&self, frame: usize, kind: MarginKind) -> Vec<(f64, Vec<Motion>)> {
        let limits = self.limits(frame, kind).into_iter();
        limits.map(|limit| self.beyond(frame, kind, limit)).collect()
    }

    /// Returns the limits of a parameter that have a mechanism, first the limit of [`Analysis::edge`].
    fn limits(&self, frame: usize, kind: MarginKind) -> Vec<Limit<'_>> {
        let margins = self.frames.get(frame).and_then(|f| f.margins.as_ref());
        let Some(margins) = margins.filter(|_| kind.changes_loads()) else {
            return Vec::new();
        };
        let limit = |(end, outward)| match margins.end(kind, end)? {
            End::At { value, mechanism } if !mechanism.is_empty() => {
                let condition = margins.margin(kind)?.conditions[end];
                Some(Limit { at: *value, outward, mechanism, condition })
            }
            _ => None,
        };
        let mut limits: Vec<Limit> = [(1, 1.0), (0, -1.0)].into_iter().filter_map(limit).collect();
        if kind.is_signed() {
            limits.sort_by(|a, b| a.at.abs().total_cmp(&b.at.abs()));
        } else if limits.len() == 2 {
            limits.retain(|limit| limit.outward > 0.0 || limit.at > 0.0);
        }
        limits
    }

    /// Returns the value at a limit, and the elementary mechanism slightly beyond it. Exactly at the limit, the power
    /// along the mechanism is 0; slightly beyond the limit it is positive.
    fn beyond(&self, frame: usize, kind: MarginKind, limit: Limit) -> (f64, Vec<Motion>) {
        let Limit { at, outward, mechanism, condition } = limit;
        let beyond = match kind {
            MarginKind::Tilt => at + DEGREES_BEYOND_LIMIT * outward,
            kind if kind.multiplies_loads() => at * (1.0 + outward * DEGREES_BEYOND_LIMIT.to_radians()),
            _ => at + DEGREES_BEYOND_LIMIT.to_radians() * outward,
        };
        let setting = (kind.about().setting)(beyond);
        let (gravity, mut scene) = (self.given.gravity, Scene::clone(&self.scene_in(frame, condition)));
        scene.gravity = gravity * setting.along + quarter_turn(gravity) * setting.across;
        scene.loads.iter_mut().for_each(|load| *load = load.times_factor(setting.loads));
        // The conditions of a changed structure are not those of the scene, so its motion stays as it is.
        if kind.about().structure.is_some() {
            return (at, mechanism.to_vec());
        }
        (at, self.elementary_mechanisms(&scene, &self.frames[frame], mechanism))
    }
}
