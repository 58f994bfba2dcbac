//! Follows a [`Path`] from a value at which a component stands to the end of the values at which it stands.
//!
//! 1. A program predicts the end: the *hint*. It also gives forces and a mechanism there, as proofs for verdicts.
//! 2. Verdicts just inside and just beyond the hint confirm it.
//! 3. If they do not, the search steps outward until the component falls. Then it narrows the range that contains the
//!    end: to where the last mechanism ceases to prove a fall, if this is known, otherwise by bisection.
//!
//! Gravity along and across its original direction and the factor on loads form a space in which the component stands in
//! a convex set. For all parameters but the tilt, the path through this space is straight. Tilts form a circle, which may
//! leave the set and enter it again, so that the search also shows that the component stands between two stable tilts.

use super::interval::{END_TOL, End};
use super::path::{MAX_VALUE, Path, Predictor};
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::proof::{Motion, Proof};

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
/// A range between two stable tilts is not searched further if it is narrower than this, degrees.
pub(super) const MIN_ARC: f64 = 1e-6;
/// Distances from an end grow by this factor while verdicts stay undecided.
const OFFSET_GROWTH: f64 = 16.0;
/// The largest number of steps of one search. Most of them exclude values by a mechanism.
pub(super) const MAX_STEPS: usize = 200;
/// The step of a search among tilts, degrees. A right angle is no multiple of it, because many structures are exactly at
/// their limit of stability at right angles.
const TILT_STEP: f64 = 77.7;
/// The largest number of times that an end is moved inward by [`Path::sharpened`]. Each time costs a program.
const MAX_SHARPENINGS: usize = 8;

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

    /// True if the component stands just inside an end that was found for other loads, and from the present value up to
    /// there.
    pub fn reaches(&self, trial: &mut Trial, end: &End, outward: f64) -> bool {
        let value = match (end, self.predictor) {
            // More friction never hurts.
            (End::Unbounded, Predictor::Tangent) => return true,
            (End::Unbounded, Predictor::Plane) => {
                return trial.decide(&self.grown_alone(outward)).0 == Verdict::Stable;
            }
            (End::Unbounded, Predictor::Arc) => return false,
            (End::At { value, .. }, _) => *value,
            (End::Unconfirmed { stands, .. }, _) => *stands,
        };
        let inside = (value - outward * END_TOL * self.size(value)).clamp(self.min_value, self.max_value);
        let stands = self.decide_at_limit(trial, inside).0 == Verdict::Stable;
        stands && (self.predictor != Predictor::Arc || self.fall_between(trial, [0.0, inside]).is_none())
    }

    /// Finds the end of the interval in a bracket. See [`Path::end`].
    pub fn search(&self, trial: &mut Trial, bracket: Bracket, outward: f64, hint: Option<f64>) -> End {
        let end = self.confirmed(trial, bracket, outward, hint);
        match self.predictor {
            Predictor::Arc => self.sharpened(trial, end, outward),
            Predictor::Tangent if trial.has_slight_loads() => self.sharpened(trial, end, outward),
            _ => end,
        }
    }

    fn confirmed(&self, trial: &mut Trial, mut bracket: Bracket, outward: f64, hint: Option<f64>) -> End {
        let from = bracket.inside;
        let hint = self.usable(hint, from, outward);
        // Compute verdicts on both sides of the hint. They often confirm the end at once.
        if let Some(hint) = hint {
            self.test_near_hint(trial, &mut bracket, hint, outward);
        }
        // Step outward until the component falls. Then narrow the bracket by mechanisms and bisection.
        let mut is_slow = false;
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
            // A mechanism may cease to prove a fall at `beyond`. Try values just inside it. Otherwise, if the verdicts
            // there are undecided, or if the last mechanism hardly narrowed the bracket, try values farther inside.
            let is_cut = self.predictor != Predictor::Tangent && known.mechanism.is_some();
            let size = self.size(beyond);
            let near = offsets(0.5 * END_TOL).filter(|_| is_cut).map(|step| (beyond - outward * step * size, true));
            let far = [0.5, 0.75, 0.25].map(|share| (inside + share * (beyond - inside), false));
            let mut values: Vec<(f64, bool)> = near.chain(far).collect();
            if is_slow {
                values.rotate_right(far.len());
            }
            values.retain(|(value, _)| (value - inside) * outward > 0.0);
            let found = values.into_iter().find_map(|(value, is_near)| {
                let verdict = self.test(trial, &mut bracket, value, outward);
                (verdict != Verdict::Undecided).then_some((value, is_near, verdict))
            });
            match found {
                None => break,
                Some((value, true, Verdict::Stable)) if bracket.inside == value => {
                    return self.enclosed(trial, bracket, from, hint, outward);
                }
                Some((_, is_near, verdict)) => is_slow = is_near && verdict == Verdict::Unstable,
            }
        }
        self.unconfirmed(trial, bracket, hint, outward)
    }

    /// Moves an end inward if a mechanism proves a fall just inside it, and returns the end. The verdict there is stable
    /// only within the tolerance of a proof by forces; a mechanism has no such tolerance. This matters if some loads are
    /// slight, and for tilts, of which this tolerance may be more than 0.0001 degrees.
    fn sharpened(&self, trial: &mut Trial, end: End, outward: f64) -> End {
        let End::At { mut value, mut mechanism } = end else {
            return end;
        };
        for _ in 0..MAX_SHARPENINGS {
            let inside = (value - outward * END_TOL * self.size(value)).clamp(self.min_value, self.max_value);
            let setting = (self.setting)(inside);
            let Some(tangent) = trial.tangent(&setting).filter(|_| inside != value) else {
                break;
            };
            let Some(motion) = trial.proved_motion(&tangent, &setting) else {
                break;
            };
            let closer = match self.predictor {
                Predictor::Tangent => trial.root(&tangent, &self.setting, [inside, inside + (inside - value)]),
                _ => self.bound(trial, inside, &motion, outward),
            };
            let is_inward = (closer - inside) * (inside - value) > 0.0;
            value = (if is_inward { closer } else { inside }).clamp(self.min_value, self.max_value);
            mechanism = motion;
        }
        End::At { value, mechanism }
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
        let nearest = if self.predictor == Predictor::Tangent { inside } else { falls };
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
            growing(first, most)
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
            if !is_within(bracket, value) {
                continue;
            }
            match self.decide_at_limit(trial, value) {
                (Verdict::Unstable, motion) => return self.narrow(trial, bracket, value, motion, outward),
                // Just beyond the end the verdict may be stable within the tolerance of the proofs. Farther out it shows
                // that the hint is wrong, if no mechanism contradicts it.
                (Verdict::Stable, _) if self.refutes(trial, value, (value - hint) * outward / size) => {
                    bracket.inside = value;
                    return;
                }
                _ => {}
            }
        }
    }

    /// True if a stable verdict at a value proves that the end lies beyond it. The value lies beyond a threshold by this
    /// distance, relative to [`Path::size`].
    fn refutes(&self, trial: &mut Trial, value: f64, distance: f64) -> bool {
        let setting = (self.setting)(value);
        let is_far = self.predictor == Predictor::Tangent && distance > STABLE_BEYOND;
        is_far && trial.tangent(&setting).is_some_and(|tangent| trial.proved_motion(&tangent, &setting).is_none())
    }

    /// Decides the component at a value inside a bracket, and moves the end of the bracket to this value, or farther if the
    /// mechanism excludes more. An undecided verdict changes nothing. Returns the verdict.
    fn test(&self, trial: &mut Trial, bracket: &mut Bracket, value: f64, outward: f64) -> Verdict {
        let (verdict, motion) = self.decide_at_limit(trial, value);
        match verdict {
            Verdict::Stable => match self.fall_between(trial, [bracket.inside, value]) {
                None => bracket.inside = value,
                Some((inside, falls, found)) => {
                    *bracket = Bracket { inside, beyond: None };
                    self.set_beyond(trial, bracket, falls, found, outward);
                }
            },
            Verdict::Unstable => self.narrow(trial, bracket, value, motion, outward),
            Verdict::Undecided => {}
        }
        verdict
    }

    /// Finds tilts between two stable tilts at which the component ceases to stand: a stable tilt, and a tilt with
    /// another verdict. `None` if it stands at all tilts between them, and for other parameters.
    ///
    /// If the convex set of stable gravity contains both ends of an arc and the intersection of the tangents there, it
    /// contains the triangle of these points, and therefore the arc. If the set is a cone, it contains every arc of less
    /// than half a turn between two of its directions. Otherwise the arc is bisected.
    fn fall_between(&self, trial: &mut Trial, [from, to]: [f64; 2]) -> Option<(f64, f64, (Verdict, Vec<Motion>))> {
        let width = (to - from).abs();
        let is_straight = self.predictor != Predictor::Arc || width <= MIN_ARC;
        if is_straight || (width < 179.0 && !trial.is_loaded() && !trial.is_limited()) {
            return None;
        }
        let middle = 0.5 * (from + to);
        if width < 170.0 {
            let beyond_the_arc = 1.0 / libm::cos(0.5 * width.to_radians());
            let apex = Setting::tilted(middle, beyond_the_arc);
            if trial.decide(&apex).0 == Verdict::Stable {
                return None;
            }
        }
        match self.decide_at_limit(trial, middle) {
            (Verdict::Stable, _) => {
                self.fall_between(trial, [from, middle]).or_else(|| self.fall_between(trial, [middle, to]))
            }
            found => Some((from, middle, found)),
        }
    }

    /// Narrows a bracket with the mechanism by which the component falls at `value`.
    fn narrow(&self, trial: &Trial, bracket: &mut Bracket, value: f64, motion: Vec<Motion>, outward: f64) {
        let from = self.bound(trial, value, &motion, outward);
        let is_closer = |known: &Beyond| (known.from - from) * outward > 0.0;
        if bracket.beyond.as_ref().is_none_or(is_closer) {
            bracket.beyond = Some(Beyond { from, at: value, mechanism: Some(motion) });
        }
        // The mechanism may exclude even stable tilts inside: their verdicts hold only within the tolerance of a proof by
        // forces. Search again from the start.
        if self.predictor == Predictor::Arc && (bracket.inside - from) * outward > MIN_ARC {
            bracket.inside = if outward > 0.0 { self.min_value } else { self.max_value };
        }
    }

    /// Returns the value, seen from inside, from which on a mechanism proves a fall. It was found at `value`.
    fn bound(&self, trial: &Trial, value: f64, motion: &[Motion], outward: f64) -> f64 {
        let excluded = self.excluded(trial, value, motion);
        let bound = if outward > 0.0 { excluded[0] } else { excluded[1] };
        match self.predictor {
            Predictor::Arc => bound.clamp(self.min_value, self.max_value),
            _ if bound.is_finite() => bound,
            // The mechanism excludes even the values inside at which the verdict was stable: such a verdict holds only
            // within its tolerance.
            _ => value,
        }
    }

    /// Sets the outer end of a bracket to a value with a verdict other than *stable*.
    fn set_beyond(
        &self,
        trial: &Trial,
        bracket: &mut Bracket,
        value: f64,
        (verdict, motion): (Verdict, Vec<Motion>),
        outward: f64,
    ) {
        match verdict {
            Verdict::Unstable => self.narrow(trial, bracket, value, motion, outward),
            _ => bracket.beyond = Some(Beyond { from: value, at: value, mechanism: None }),
        }
    }

    /// Takes one step outward, as long as no value is known at which the component falls: decides the component at a
    /// larger distance. Returns the end of the interval if the search must stop, otherwise `None`.
    fn step_outward(&self, trial: &mut Trial, bracket: &mut Bracket, outward: f64) -> Option<End> {
        let most = MAX_VALUE * self.typical_large;
        let inside = bracket.inside;
        let next = match self.predictor {
            // A search towards the tilt 0 must not jump over tilts near 0.
            Predictor::Arc if inside * outward < 0.0 => 0.0,
            Predictor::Arc => inside + outward * TILT_STEP,
            _ => inside + outward * (10.0 * inside.abs()).max(self.typical_small),
        };
        let next = next.clamp(self.min_value.max(-most), self.max_value.min(most));
        if next == inside {
            let is_natural = next == self.min_value && self.predictor != Predictor::Arc;
            return Some(if is_natural { End::natural(next) } else { End::Unbounded });
        }
        if self.test(trial, bracket, next, outward) == Verdict::Undecided {
            bracket.beyond = Some(Beyond { from: next, at: next, mechanism: None });
        }
        None
    }
}

/// Returns growing distances from an end, relative to [`Path::size`], at which verdicts confirm it.
pub(super) fn offsets(first: f64) -> impl Iterator<Item = f64> {
    growing(first, CONFIRMATION_TOL)
}

fn growing(first: f64, most: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(first), |step| Some(step * OFFSET_GROWTH)).take_while(move |step| *step <= most)
}
