//! [`Path`]: a parameter and how a component changes with it. The searches of [`search`](super::search) and
//! [`nearest`](super::nearest) follow it.
//!
//! Many parameters change the loads or the limits of forces linearly. Then the power of the loads along a fixed mechanism
//! is a linear function of the parameter, too, and is 0 at one value. On one side of this value the power is positive, so
//! the component falls at every value there. This is a cutting plane (Kelley 1960). At the tilt θ, the power is
//! A cos θ + B sin θ + C, so a mechanism excludes an arc of tilts. Friction and the kernel change the mechanisms
//! themselves.

use super::interval::{END_TOL, ROUNDING_TOL};
use super::trial::{LimitChange, Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::LimitDistance;
use crate::mechanics::proof::Motion;

/// Values beyond this multiple of [`Path::typical_large`] are not tried. If the power of a mechanism vanishes only beyond
/// it, the component counts as falling at every value.
pub(super) const MAX_VALUE: f64 = 1e6;
/// A threshold of friction or kernel below this has the [`Path::resolution`] of this value.
const LEAST_THRESHOLD_SIZE: f64 = 0.1;

/// How the end of an interval is predicted from a value at which the component falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Predictor {
    /// Loads or limits are linear in the parameter: the mechanism excludes all values on one side of a value.
    Plane,
    /// The parameter is the tilt in degrees: the mechanism excludes an arc of tilts.
    Arc,
    /// The forces depend on the parameter: the tangent of the least residual predicts the end, but proves nothing.
    Tangent,
}

/// A parameter, and how a component changes with it.
pub(super) struct Path<'a> {
    pub predictor: Predictor,
    /// Returns the change of the component for a value of the parameter.
    pub setting: Box<dyn Fn(f64) -> Setting + 'a>,
    /// The least meaningful value; −∞ if all values are meaningful.
    pub min_value: f64,
    /// The largest value that is tried.
    pub max_value: f64,
    /// A typical small size of the parameter. Distances from smaller values are relative to it.
    pub typical_small: f64,
    /// A typical large size of the parameter. For the factor on a load of 10⁻⁵ N it is 10⁵ if the blocks weigh 1 N.
    pub typical_large: f64,
    /// The largest load that the parameter does not change, divided by the largest load that the parameter adds per
    /// unit. If forces balance with a relative error of 10⁻⁷, the end may be off by 10⁻⁷ times this ratio. This matters
    /// only for loads far smaller than the others.
    pub load_ratio: f64,
}

impl<'a> Path<'a> {
    /// Creates the path of a parameter that is at least 0 and of the order of 1.
    pub fn new(predictor: Predictor, setting: impl Fn(f64) -> Setting + 'a) -> Path<'a> {
        Path {
            predictor,
            setting: Box::new(setting),
            min_value: 0.0,
            max_value: f64::INFINITY,
            typical_small: 1.0,
            typical_large: 1.0,
            load_ratio: 0.0,
        }
    }

    /// Creates the path of friction or the kernel, on which the forces depend, from 0 to `max_value`.
    pub fn threshold(max_value: f64, setting: impl Fn(f64) -> Setting + 'a) -> Path<'a> {
        Path { max_value, typical_large: max_value / MAX_VALUE, ..Path::new(Predictor::Tangent, setting) }
    }

    /// Leaves only the loads that grow in the direction of larger (1) or smaller (−1) values. An interval is unbounded in
    /// this direction only if the component stands with these loads alone.
    pub fn grown_alone(&self, outward: f64) -> Setting {
        let [from, to] = [0.0, 1.0].map(&self.setting);
        Setting {
            along: outward * (to.along - from.along),
            across: outward * (to.across - from.across),
            loads: outward * (to.loads - from.loads),
            limits: LimitChange::FiniteToZero,
            ..Setting::UNLOADED
        }
    }

    /// Returns the first and the last value at which a mechanism proves a fall; infinite if there is no such value. The
    /// mechanism was found at `value`, which lies between them.
    pub fn excluded(&self, trial: &Trial, value: f64, motion: &[Motion]) -> [f64; 2] {
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
        match self.predictor {
            Predictor::Tangent => everywhere,
            Predictor::Plane => {
                let [without, with] = [0.0, self.typical_large].map(|at| trial.power(&(self.setting)(at), motion));
                // The power along the mechanism is a linear function A + B·x of the parameter x, 0 at x = −A/B.
                let slope = (with - without) / self.typical_large;
                let mut bound = -without / slope;
                // Rounding must not exclude the least meaningful value, such as the load factor 0.
                if (bound - self.min_value).abs() < ROUNDING_TOL * self.typical_small {
                    bound = self.min_value;
                }
                match bound {
                    _ if !bound.is_finite() || bound.abs() > MAX_VALUE * self.typical_large => everywhere,
                    _ if slope > 0.0 => [bound.min(value), f64::INFINITY],
                    _ => [f64::NEG_INFINITY, bound.max(value)],
                }
            }
            Predictor::Arc => {
                let power = |along: f64, across: f64| {
                    let setting = Setting { along, across, ..Setting::default() };
                    trial.power(&setting, motion)
                };
                let constant = power(0.0, 0.0);
                let [along, across] = [power(1.0, 0.0) - constant, power(0.0, 1.0) - constant];
                let size = libm::hypot(along, across);
                // The power is positive where size · cos(θ − middle) + constant > 0.
                if constant >= size {
                    return everywhere;
                }
                let middle = libm::atan2(across, along).to_degrees();
                let half = libm::acos((-constant / size).clamp(-1.0, 1.0)).to_degrees();
                let offset = value - middle;
                let offset = offset - 360.0 * (offset / 360.0).round();
                let half = half.max(offset.abs());
                [value - offset - half, value - offset + half]
            }
        }
    }

    pub fn decide_at_limit(&self, trial: &mut Trial, value: f64) -> (Verdict, Vec<Motion>) {
        trial.decide_at(&(self.setting)(value), LimitDistance::AtLimit)
    }

    /// Returns the magnitude of `value`, to which distances are relative; for a value near 0 a typical size.
    pub fn size(&self, value: f64) -> f64 {
        match self.predictor {
            Predictor::Tangent => {
                if value > 0.0 {
                    value
                } else {
                    self.typical_small
                }
            }
            Predictor::Arc => value.abs().clamp(1.0, 90.0),
            Predictor::Plane => {
                if value.abs() < 1e-3 * self.typical_small {
                    self.typical_small
                } else {
                    value.abs()
                }
            }
        }
    }

    /// Returns the size of `value` for the width of a bracket and for the largest distance at which a fall confirms a hint:
    /// within the tolerance of the proofs a verdict may be stable beyond a threshold of friction or kernel, and this
    /// tolerance does not shrink with the threshold.
    pub fn resolution(&self, value: f64) -> f64 {
        let least = if self.predictor == Predictor::Tangent { LEAST_THRESHOLD_SIZE * self.typical_small } else { 0.0 };
        self.size(value).max(least)
    }

    /// Returns `value`, or 0 if `value` differs from 0 only by rounding.
    pub fn without_rounding(&self, value: f64) -> f64 {
        let rounding = if self.predictor == Predictor::Tangent { END_TOL } else { ROUNDING_TOL };
        if value.abs() < rounding * self.typical_small { 0.0 } else { value }
    }
}
