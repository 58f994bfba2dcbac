//! [`Path`]: finds an end of the values of a parameter at which a component stands, from a value at which it stands.
//!
//! 1. A program predicts the end: the *hint*. It also gives forces and a mechanism there, as proofs for verdicts.
//! 2. Verdicts just inside and just beyond the hint confirm it.
//! 3. If they do not, the search steps outward until the component falls. Then it narrows the range that contains the
//!    end: by the last mechanism if this shows where the fall begins ([`Predictor::Plane`]), otherwise by bisection.
//!
//! The loads, or the limits of forces, may be linear in the parameter. The power of the loads along a fixed mechanism is
//! then linear, too: one mechanism shows that a component falls at every value on one side of the value at which this
//! power vanishes, a cutting plane (Kelley 1960). Friction and the kernel change the mechanisms themselves.

use super::interval::End;
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::LimitDistance;
use crate::mechanics::proof::{Motion, Proof};

/// How the end of an interval is predicted from a value at which the component falls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Predictor {
    /// Loads or limits are linear in the parameter: the mechanism excludes all values on one side of a value.
    Plane,
    /// The forces depend on the parameter: the tangent of the least residual predicts the end, but proves nothing.
    Tangent,
}

/// A parameter, and how a component changes with it.
pub(super) struct Path<'a> {
    pub predictor: Predictor,
    /// Returns the change of the component for a value of the parameter.
    pub setting: &'a dyn Fn(f64) -> Setting,
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

/// Two values between which an end lies.
pub(super) struct Bracket {
    /// A value at which the component stands.
    pub inside: f64,
    /// The nearest known value at which it does not stand; `None` if no such value is known.
    pub beyond: Option<Beyond>,
}

/// A value at which a component is not proved to stand.
pub(super) struct Beyond {
    /// If the loads are linear in the parameter, the mechanism proves that the component falls at this value and at every
    /// value farther out. The verdict may still be stable slightly farther out, because a proof by forces has a
    /// tolerance. A mechanism has no tolerance.
    pub from: f64,
    /// The value at which the verdict was computed.
    pub at: f64,
    /// How the component falls; `None` if the verdict is undecided.
    pub mechanism: Option<Vec<Motion>>,
}

impl Beyond {
    /// Creates the end of a range from a verdict other than *stable* at `value`.
    pub fn new(value: f64, (verdict, motion): (Verdict, Vec<Motion>)) -> Beyond {
        Beyond { from: value, at: value, mechanism: (verdict == Verdict::Unstable).then_some(motion) }
    }
}

/// The values at which a mechanism proves a fall: all above one value, all below it, or all values.
pub(super) enum ExcludedRange {
    Above(f64),
    Below(f64),
    All,
}

/// An end is found if a stable and an unstable value are at most this far apart, relative to the end. Ends of two
/// components that differ by less are equal.
pub(in crate::mechanics::analysis) const END_TOL: f64 = 1e-6;
/// The end from a linear program is accepted if verdicts within this relative distance, on both sides, agree with it.
pub(super) const CONFIRMATION_TOL: f64 = 256e-6;
/// A verdict may be stable this far beyond the end, relative to the value, within the tolerance of the proofs.
const STABLE_BEYOND: f64 = 4e-6;
/// The possible error of an end is ignored if it is at most this fraction of [`Path::typical_small`].
const MIN_UNSURE: f64 = 1e-3;
/// The relative error of the forces near an end, if no forces are known there: half of the tolerance of the proofs.
const UNKNOWN_ERROR: f64 = 0.5 * Proof::IMBALANCE_TOL;
/// The relative error of known forces counts as at least this value. Without this minimum, one end in a random scene
/// was too far out by 2·10⁻⁶ of its value.
const LEAST_ERROR: f64 = 2e-10;
/// A value that differs from 0 by at most this fraction of [`Path::typical_small`] differs only by the rounding of the
/// solver.
const ROUNDING_TOL: f64 = 1e-9;
/// Distances from an end grow by this factor while verdicts stay undecided.
pub(super) const OFFSET_GROWTH: f64 = 16.0;
/// The largest number of steps of one search.
pub(super) const MAX_STEPS: usize = 60;
/// Values beyond this multiple of [`Path::typical_large`] are not tried. If the power of a mechanism vanishes only beyond
/// it, the component counts as falling at every value.
pub(super) const MAX_VALUE: f64 = 1e6;
/// A threshold of friction or kernel below this has the [`Path::resolution`] of this value.
const LEAST_THRESHOLD_SIZE: f64 = 0.1;

impl Path<'_> {
    /// Finds the end of the interval in the direction `outward` (−1 or 1), starting at the value `from`, at which the
    /// component stands.
    ///
    /// `hint` is the end that a program found. The forces and the motion of this program are already in the cache of
    /// `trial`.
    pub fn end(&self, trial: &mut Trial, from: f64, outward: f64, hint: Option<f64>) -> End {
        // The interval may end at the smallest possible value of the parameter, such as 0.
        let is_natural = outward < 0.0 && self.min_value.is_finite();
        if is_natural
            && self.usable(hint, from, outward).is_none_or(|hint| hint <= self.min_value)
            && (from <= self.min_value || self.decide_at_limit(trial, self.min_value).0 == Verdict::Stable)
        {
            return End::natural(self.min_value);
        }
        self.search(trial, Bracket { inside: from, beyond: None }, outward, hint)
    }

    /// Finds the end of the interval in a bracket. See [`Path::end`].
    pub fn search(&self, trial: &mut Trial, mut bracket: Bracket, outward: f64, hint: Option<f64>) -> End {
        let from = bracket.inside;
        let hint = self.usable(hint, from, outward);
        // Compute verdicts on both sides of the hint. They often confirm the end at once.
        if let Some(hint) = hint {
            self.test_near_hint(trial, &mut bracket, hint, outward);
        }
        // Step outward until the component falls. Then narrow the bracket by cutting planes and bisection.
        for _ in 0..MAX_STEPS {
            let inside = bracket.inside;
            let Some(known) = &bracket.beyond else {
                match self.step_outward(trial, &mut bracket, outward) {
                    Some(end) => return end,
                    None => continue,
                }
            };
            let beyond = known.from;
            let width = (beyond - inside) * outward / self.resolution(beyond);
            let is_around = |hint: &f64| (hint - inside) * outward >= 0.0 && (beyond - hint) * outward >= 0.0;
            let is_confirmed = self.predictor == Predictor::Tangent && hint.as_ref().is_some_and(is_around);
            if width <= END_TOL || (is_confirmed && width <= 2.0 * CONFIRMATION_TOL) {
                return self.enclosed(trial, bracket, from, hint, outward);
            }
            // A mechanism may cease to prove a fall at `beyond`. Try a value just inside it. Otherwise, or if the
            // verdict there is undecided, try the middle of the bracket.
            let is_cut = self.predictor == Predictor::Plane && known.mechanism.is_some();
            let just = is_cut.then_some(beyond - 0.5 * outward * END_TOL * self.size(beyond));
            let values = just.into_iter().chain([0.5 * (inside + beyond)]);
            let found = values
                .filter(|value| (value - inside) * outward > 0.0)
                .any(|value| self.test(trial, &mut bracket, value, outward) != Verdict::Undecided);
            if !found {
                break;
            }
        }
        self.unconfirmed(trial, bracket, hint, outward)
    }

    /// Returns a hint without rounding; `None` if it lies on the wrong side of `from`.
    fn usable(&self, hint: Option<f64>, from: f64, outward: f64) -> Option<f64> {
        let hint = self.without_rounding(hint?);
        ((hint - from) * outward >= -STABLE_BEYOND * self.size(hint)).then_some(hint)
    }

    /// Returns three values for an end of the interval: the end, a value just inside it, and a value clearly beyond it.
    pub fn test_values(&self, end: f64, outward: f64) -> [f64; 3] {
        let size = outward * self.size(end);
        [end, end - 0.5 * END_TOL * size, (end + 16.0 * CONFIRMATION_TOL * size).max(self.min_value)]
    }

    /// Returns `value`, or a large finite number if `value` is even larger, such as infinity. A search for a lower end
    /// can start at the result.
    pub fn finite_start(&self, value: f64) -> f64 {
        value.min(MAX_VALUE * self.typical_large)
    }

    /// Returns the end if the bracket is narrow enough: the hint if it lies in the bracket, otherwise the value beyond
    /// which the mechanism proves the fall.
    ///
    /// If this mechanism excludes even the value `from`, at which the search began, the component stands there only
    /// within the tolerance of the proofs, because the loads that the parameter changes are too small. The end is then
    /// unconfirmed. Otherwise, if these loads are small, the end is moved inward by its possible error, to the safe
    /// side.
    fn enclosed(&self, trial: &mut Trial, bracket: Bracket, from: f64, hint: Option<f64>, outward: f64) -> End {
        let inside = bracket.inside;
        let Some(Beyond { from: falls, at, mechanism: Some(mechanism) }) = bracket.beyond else {
            return self.unconfirmed(trial, bracket, hint, outward);
        };
        let within = hint
            .filter(|hint| (hint - inside) * outward >= -END_TOL * self.size(*hint) && (falls - hint) * outward >= 0.0);
        let nearest = if self.predictor == Predictor::Plane { falls } else { inside };
        let value = self.without_rounding(within.unwrap_or(nearest)).clamp(self.min_value, self.max_value);
        if self.is_natural(value, outward) {
            return End::natural(self.min_value);
        }
        if (from - value) * outward <= END_TOL * self.size(value) {
            return End::At { value: self.on_the_safe_side(trial, value, [from, inside], outward), mechanism };
        }
        // Find a value at which the component stands beyond doubt: test the smallest value of the parameter, or `value`
        // if there is no smallest value.
        let base = if self.min_value.is_finite() { self.min_value } else { value };
        let stands = self.decide_at_limit(trial, base).0 == Verdict::Stable;
        End::Unconfirmed { stands: if stands { base } else { from }, beyond: at }
    }

    /// Returns an end moved inward by its possible error, but not beyond `from`. The error follows from the forces that
    /// balance the component at the value `inside`. If the largest possible error is small, the end is not moved.
    fn on_the_safe_side(&self, trial: &Trial, end: f64, [from, inside]: [f64; 2], outward: f64) -> f64 {
        let unsure = UNKNOWN_ERROR * self.load_ratio;
        let is_sure = unsure <= MIN_UNSURE * self.typical_small || unsure <= END_TOL * self.size(end);
        if is_sure || (end - from) * outward <= 0.0 {
            return end;
        }
        let known = trial.least_force_error(&(self.setting)(inside));
        let error = known.map_or(UNKNOWN_ERROR, |error| (2.0 * error).clamp(LEAST_ERROR, UNKNOWN_ERROR));
        let inward = end - outward * error * self.load_ratio;
        if (inward - from) * outward > 0.0 { inward } else { from }
    }

    /// True if a component that stands at `value` stands at the least possible value, up to the accuracy of a threshold.
    fn is_natural(&self, value: f64, outward: f64) -> bool {
        self.predictor == Predictor::Tangent && outward < 0.0 && self.without_rounding(value) == self.min_value
    }

    /// Returns the end if the bracket could not be narrowed enough. This is the hint if the verdicts on both sides
    /// agree with it, otherwise an unconfirmed end.
    fn unconfirmed(&self, trial: &mut Trial, bracket: Bracket, hint: Option<f64>, outward: f64) -> End {
        let Bracket { inside, beyond } = bracket;
        if self.is_natural(inside, outward) {
            return End::natural(self.min_value);
        }
        let (beyond, mechanism) = match beyond {
            None => return End::Unconfirmed { stands: inside, beyond: outward * f64::INFINITY },
            Some(Beyond { from, mechanism, .. }) => (from, mechanism),
        };
        // If the verdict is undecided only within 1e-6 of the largest value, the interval ends at the largest value.
        let last = self.max_value - END_TOL * self.size(self.max_value);
        if mechanism.is_none() && beyond == self.max_value && self.decide_at_limit(trial, last).0 == Verdict::Stable {
            return End::natural(self.max_value);
        }
        // The hint is confirmed if the frame stands close to it on one side and falls close to it on the other side.
        let agrees = |hint: &f64| {
            let [from_inside, to_beyond] =
                [hint - inside, beyond - hint].map(|apart| apart * outward / self.resolution(*hint));
            (-STABLE_BEYOND..=CONFIRMATION_TOL).contains(&from_inside)
                && (-END_TOL..=CONFIRMATION_TOL).contains(&to_beyond)
        };
        match (hint.filter(agrees), mechanism) {
            (Some(value), Some(mechanism)) => End::At { value, mechanism },
            _ => End::Unconfirmed { stands: inside, beyond },
        }
    }

    /// Computes verdicts on both sides of `hint`, the expected end, and narrows the bracket to these values. Tries
    /// cached proofs first, because they need no program.
    fn test_near_hint(&self, trial: &mut Trial, bracket: &mut Bracket, hint: f64, outward: f64) {
        let size = self.size(hint);
        let is_plane = self.predictor == Predictor::Plane;
        let first = if is_plane { 0.5 * END_TOL } else { END_TOL };
        let offsets = |side: f64, most: f64| {
            std::iter::successors(Some(first), |step| Some(step * OFFSET_GROWTH))
                .take_while(move |step| *step <= most)
                .map(move |step| hint + side * outward * step * size)
                .filter(|value| (self.min_value..=self.max_value).contains(value))
        };
        // If the loads are linear in the parameter, one proof from far away shows where the component stands or falls.
        let cached = |trial: &Trial, value: f64| {
            if is_plane { trial.cached_verdict(&(self.setting)(value)) } else { (Verdict::Undecided, Vec::new()) }
        };
        let is_within = |bracket: &Bracket, value: f64| {
            let is_before = bracket.beyond.as_ref().is_none_or(|known| (known.from - value) * outward > 0.0);
            is_before && (value - bracket.inside) * outward > 0.0
        };
        let remembered = offsets(-1.0, CONFIRMATION_TOL)
            .filter(|value| is_within(bracket, *value))
            .find(|value| cached(trial, *value).0 == Verdict::Stable);
        match remembered {
            Some(value) => bracket.inside = value,
            None => {
                for value in offsets(-1.0, CONFIRMATION_TOL) {
                    if is_within(bracket, value) && self.test(trial, bracket, value, outward) == Verdict::Stable {
                        break;
                    }
                }
            }
        }
        for value in offsets(1.0, 1.0).filter(|_| is_plane) {
            if let (Verdict::Unstable, motion) = cached(trial, value) {
                return self.narrow(trial, bracket, value, motion, outward);
            }
        }
        for value in offsets(1.0, CONFIRMATION_TOL * self.resolution(hint) / size) {
            // Just beyond the end the verdict may be stable within the tolerance of the proofs. Use only a fall.
            if is_within(bracket, value)
                && let (Verdict::Unstable, motion) = self.decide_at_limit(trial, value)
            {
                return self.narrow(trial, bracket, value, motion, outward);
            }
        }
    }

    /// Decides the component at a value inside a bracket, and moves the end of the bracket to this value, or farther if the
    /// mechanism excludes more. An undecided verdict changes nothing. Returns the verdict.
    fn test(&self, trial: &mut Trial, bracket: &mut Bracket, value: f64, outward: f64) -> Verdict {
        let (verdict, motion) = self.decide_at_limit(trial, value);
        match verdict {
            Verdict::Stable => bracket.inside = value,
            Verdict::Unstable => self.narrow(trial, bracket, value, motion, outward),
            Verdict::Undecided => {}
        }
        verdict
    }

    /// Narrows a bracket with the mechanism by which the component falls at `value`.
    fn narrow(&self, trial: &Trial, bracket: &mut Bracket, value: f64, motion: Vec<Motion>, outward: f64) {
        let from = match self.excluded_range(trial, value, &motion) {
            ExcludedRange::Above(bound) if outward > 0.0 => bound,
            ExcludedRange::Below(bound) if outward < 0.0 => bound,
            // The mechanism excludes even the values inside the bracket at which the verdict was stable: such a verdict
            // holds only within its tolerance. Use `value` itself as the outer end.
            _ => value,
        };
        let is_closer = |known: &Beyond| (known.from - from) * outward > 0.0;
        if bracket.beyond.as_ref().is_none_or(is_closer) {
            bracket.beyond = Some(Beyond { from, at: value, mechanism: Some(motion) });
        }
    }

    /// Takes one step outward, as long as no value is known at which the component falls: decides the component at a
    /// larger distance. Returns the end of the interval if the search must stop, otherwise `None`.
    fn step_outward(&self, trial: &mut Trial, bracket: &mut Bracket, outward: f64) -> Option<End> {
        let most = MAX_VALUE * self.typical_large;
        let next = bracket.inside + outward * (10.0 * bracket.inside.abs()).max(self.typical_small);
        let next = next.clamp(self.min_value.max(-most), self.max_value.min(most));
        if next == bracket.inside {
            return Some(if next == self.min_value { End::natural(next) } else { End::Unbounded });
        }
        if self.test(trial, bracket, next, outward) == Verdict::Undecided {
            bracket.beyond = Some(Beyond { from: next, at: next, mechanism: None });
        }
        None
    }

    /// Returns the values at which a mechanism proves a fall. The mechanism was found at `value`.
    pub fn excluded_range(&self, trial: &Trial, value: f64, motion: &[Motion]) -> ExcludedRange {
        if self.predictor == Predictor::Tangent {
            return ExcludedRange::All;
        }
        let [without, with] = [0.0, self.typical_large].map(|at| trial.power(&(self.setting)(at), motion));
        // The power along the mechanism is a linear function A + B·x of the parameter x. It is zero at x = −A/B.
        let slope = (with - without) / self.typical_large;
        let mut bound = -without / slope;
        // Rounding must not exclude the least meaningful value, such as the load factor 0.
        if (bound - self.min_value).abs() < ROUNDING_TOL * self.typical_small {
            bound = self.min_value;
        }
        if !bound.is_finite() || bound.abs() > MAX_VALUE * self.typical_large {
            return ExcludedRange::All;
        }
        // The mechanism was found at `value`, so the excluded range must contain `value`.
        if slope > 0.0 { ExcludedRange::Above(bound.min(value)) } else { ExcludedRange::Below(bound.max(value)) }
    }

    pub fn decide_at_limit(&self, trial: &mut Trial, value: f64) -> (Verdict, Vec<Motion>) {
        trial.decide_at(&(self.setting)(value), LimitDistance::AtLimit)
    }

    /// Returns the magnitude of `value`, to which distances are relative; for a value near 0 a typical size.
    pub fn size(&self, value: f64) -> f64 {
        if self.predictor == Predictor::Tangent {
            return if value > 0.0 { value } else { self.typical_small };
        }
        if value.abs() < 1e-3 * self.typical_small { self.typical_small } else { value.abs() }
    }

    /// Returns the size of `value` for the width of a bracket and for the largest distance at which a fall confirms a hint:
    /// within the tolerance of the proofs a verdict may be stable beyond a threshold of friction or kernel, and this
    /// tolerance does not shrink with the threshold.
    fn resolution(&self, value: f64) -> f64 {
        let least = if self.predictor == Predictor::Tangent { LEAST_THRESHOLD_SIZE * self.typical_small } else { 0.0 };
        self.size(value).max(least)
    }

    /// Returns `value`, or 0 if `value` differs from 0 only by rounding.
    fn without_rounding(&self, value: f64) -> f64 {
        let rounding = if self.predictor == Predictor::Tangent { END_TOL } else { ROUNDING_TOL };
        if value.abs() < rounding * self.typical_small { 0.0 } else { value }
    }
}
