//! [`Line`]: finds the values of a parameter between which a component stands. The loads, or the limits of forces, must
//! be linear in this parameter.
//!
//! The power of the loads along a fixed mechanism is linear in such a parameter. One mechanism therefore shows that a
//! component falls at every value on one side of the value at which this power vanishes: a cutting plane (Kelley 1960).
//! One linear program gives an end of the interval, and the forces and the mechanism there; verdicts confirm the end.
//! If the verdicts do not confirm it, cutting planes and bisection narrow the range that contains the end.

mod nearest;

use super::interval::End;
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::LimitDistance;
use crate::mechanics::proof::{Motion, Proof};

/// A parameter, and how a component changes with it.
pub(super) struct Line<'a> {
    /// Returns the change of the component for a value of the parameter.
    pub setting: &'a dyn Fn(f64) -> Setting,
    /// The least meaningful value; −∞ if all values are meaningful.
    pub min_value: f64,
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
struct Bracket {
    /// A value at which the component stands.
    inside: f64,
    /// The known fall whose range begins nearest to `inside`; `None` if no fall is known.
    beyond: Option<Fall>,
}

/// A proved fall at all values from one value outward.
struct Fall {
    /// The mechanism proves that the component falls at this value and at every value farther out. The verdict may
    /// still be stable slightly farther out, because a proof by forces has a tolerance. A mechanism has no tolerance.
    from: f64,
    /// The value at which the mechanism was found.
    at: f64,
    mechanism: Vec<Motion>,
}

/// The values at which a mechanism proves a fall: all above one value, all below it, or all values.
enum ExcludedRange {
    Above(f64),
    Below(f64),
    All,
}

/// An end is found if a stable and an unstable value are at most this far apart, relative to the end.
const END_TOL: f64 = 1e-6;
/// The end from a linear program is accepted if verdicts within this relative distance, on both sides, agree with it.
const CONFIRMATION_TOL: f64 = 256e-6;
/// A verdict may be stable this far beyond the end, relative to the value, within the tolerance of the proofs.
const STABLE_BEYOND: f64 = 4e-6;
/// The possible error of an end is ignored if it is at most this fraction of [`Line::typical_small`].
const MIN_UNSURE: f64 = 1e-3;
/// The relative error of the forces near an end, if no forces are known there: half of the tolerance of the proofs.
const UNKNOWN_ERROR: f64 = 0.5 * Proof::IMBALANCE_TOL;
/// The relative error of known forces counts as at least this value. Without this minimum, one end in a random scene
/// was too far out by 2·10⁻⁶ of its value.
const LEAST_ERROR: f64 = 2e-10;
/// A value that differs from 0 by at most this fraction of [`Line::typical_small`] differs only by the rounding of the
/// solver.
const ROUNDING_TOL: f64 = 1e-9;
/// Distances from an end grow by this factor while verdicts stay undecided.
const OFFSET_GROWTH: f64 = 16.0;
/// The largest number of steps of one search.
const MAX_STEPS: usize = 60;
/// The largest value that is tried, as a multiple of [`Line::typical_large`].
const MAX_VALUE: f64 = 1e6;
/// If the power of a mechanism vanishes only beyond this multiple of [`Line::typical_large`], the component counts as
/// falling at every value.
const MAX_VANISHING_VALUE: f64 = 1e6;

impl Line<'_> {
    /// Finds the end of the interval in the direction `outward` (−1 or 1), starting at the value `from`, at which the
    /// component stands.
    ///
    /// `hint` is the end that a linear program found. The forces and the motion of this program are already in the
    /// cache of `trial`.
    pub fn end(&self, trial: &mut Trial, from: f64, outward: f64, hint: Option<f64>) -> End {
        let hint = hint
            .map(|hint| self.without_rounding(hint))
            .filter(|hint| (hint - from) * outward >= -STABLE_BEYOND * self.size(*hint));
        // The interval may end at the smallest possible value of the parameter, such as 0.
        let is_natural = outward < 0.0 && self.min_value.is_finite();
        if is_natural
            && hint.is_none_or(|hint| hint <= self.min_value)
            && (from <= self.min_value || self.decide_at_limit(trial, self.min_value).0 == Verdict::Stable)
        {
            return End::natural(self.min_value);
        }
        let mut bracket = Bracket { inside: from, beyond: None };
        // Compute verdicts on both sides of the hint. They often confirm the end at once.
        if let Some(hint) = hint {
            self.test_near_hint(trial, &mut bracket, hint, outward);
        }
        // Step outward until the component falls. Then narrow the bracket by cutting planes and bisection.
        for _ in 0..MAX_STEPS {
            let Some(fall) = &bracket.beyond else {
                match self.step_outward(trial, &mut bracket, outward) {
                    Some(end) => return end,
                    None => continue,
                }
            };
            let beyond = fall.from;
            if (beyond - bracket.inside) * outward <= END_TOL * self.size(beyond) {
                return self.enclosed(trial, bracket, from, hint, outward);
            }
            // `beyond` is where the mechanism ceases to prove a fall. Try a value just inside it. If the verdict there
            // is undecided, try the middle of the bracket.
            let inside = bracket.inside;
            let just = beyond - 0.5 * outward * END_TOL * self.size(beyond);
            let found = [just, 0.5 * (inside + beyond)]
                .into_iter()
                .filter(|value| (value - inside) * outward > 0.0)
                .any(|value| {
                    match self.decide_at_limit(trial, value) {
                        (Verdict::Stable, _) => bracket.inside = value,
                        (Verdict::Unstable, motion) => self.narrow(trial, &mut bracket, value, motion, outward),
                        (Verdict::Undecided, _) => return false,
                    }
                    true
                });
            if !found {
                break;
            }
        }
        self.unconfirmed(bracket, hint, outward)
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
        let Bracket { inside, beyond } = bracket;
        let Some(fall) = beyond else {
            return self.unconfirmed(Bracket { inside, beyond }, hint, outward);
        };
        let within = hint.filter(|hint| {
            (hint - inside) * outward >= -END_TOL * self.size(*hint) && (fall.from - hint) * outward >= 0.0
        });
        let value = self.without_rounding(within.unwrap_or(fall.from)).max(self.min_value);
        if (from - value) * outward <= END_TOL * self.size(value) {
            return End::At {
                value: self.on_the_safe_side(trial, value, [from, inside], outward),
                mechanism: fall.mechanism,
            };
        }
        // Find a value at which the component stands beyond doubt: test the smallest value of the parameter, or `value`
        // if there is no smallest value.
        let base = if self.min_value.is_finite() { self.min_value } else { value };
        let stands = self.decide_at_limit(trial, base).0 == Verdict::Stable;
        End::Unconfirmed { stands: if stands { base } else { from }, beyond: fall.at }
    }

    /// Returns an end moved inward by its possible error, but not beyond `from`. The forces that balance the component
    /// at the value `inside` determine the error. Returns the end unchanged if even the largest possible error is
    /// small.
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

    /// Returns the end if the bracket could not be narrowed enough. This is the hint if the verdicts on both sides
    /// agree with it, otherwise an unconfirmed end.
    fn unconfirmed(&self, bracket: Bracket, hint: Option<f64>, outward: f64) -> End {
        let Bracket { inside, beyond } = bracket;
        let Some(Fall { from: beyond, mechanism, .. }) = beyond else {
            return End::Unconfirmed { stands: inside, beyond: outward * f64::INFINITY };
        };
        // The hint is confirmed if the verdicts on both sides are close enough to it.
        let agrees = |hint: &f64| {
            let [from_inside, to_beyond] =
                [hint - inside, beyond - hint].map(|apart| apart * outward / self.size(*hint));
            (-STABLE_BEYOND..=CONFIRMATION_TOL).contains(&from_inside)
                && (-END_TOL..=CONFIRMATION_TOL).contains(&to_beyond)
        };
        match hint.filter(agrees) {
            Some(value) => End::At { value, mechanism },
            None => End::Unconfirmed { stands: inside, beyond },
        }
    }

    /// Computes verdicts on both sides of `hint`, the expected end, and narrows the bracket to these values. Tries
    /// cached proofs first, because they need no program.
    fn test_near_hint(&self, trial: &mut Trial, bracket: &mut Bracket, hint: f64, outward: f64) {
        let size = self.size(hint);
        let steps = || {
            std::iter::successors(Some(0.5 * END_TOL), |step| Some(step * OFFSET_GROWTH))
                .take_while(|step| *step <= 1.0)
        };
        let inside = |step: f64| {
            let value = hint - outward * step * size;
            ((value - bracket.inside) * outward > 0.0).then_some(value)
        };
        let near = || steps().take_while(|step| *step <= CONFIRMATION_TOL).filter_map(inside);
        let remembered = near().find(|value| trial.cached_verdict(&(self.setting)(*value)).0 == Verdict::Stable);
        let stands =
            remembered.or_else(|| near().find(|value| self.decide_at_limit(trial, *value).0 == Verdict::Stable));
        let outside = |step: f64| Some(hint + outward * step * size).filter(|value| *value >= self.min_value);
        let mut falls = steps().filter_map(outside).find_map(|value| {
            let (verdict, motion) = trial.cached_verdict(&(self.setting)(value));
            (verdict == Verdict::Unstable).then_some((value, motion))
        });
        if falls.is_none() {
            falls = steps().take_while(|step| *step <= CONFIRMATION_TOL).filter_map(outside).find_map(|value| {
                let (verdict, motion) = self.decide_at_limit(trial, value);
                (verdict == Verdict::Unstable).then_some((value, motion))
            });
        }
        if let Some(value) = stands {
            bracket.inside = value;
        }
        if let Some((value, motion)) = falls {
            self.narrow(trial, bracket, value, motion, outward);
        }
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
        let is_closer = bracket.beyond.as_ref().is_none_or(|known| (known.from - from) * outward > 0.0);
        if is_closer {
            bracket.beyond = Some(Fall { from, at: value, mechanism: motion });
        }
    }

    /// Takes one step outward, as long as no value is known at which the component falls: decides the component at a
    /// larger distance. Returns the end of the interval if the search must stop, otherwise `None`.
    fn step_outward(&self, trial: &mut Trial, bracket: &mut Bracket, outward: f64) -> Option<End> {
        let most = MAX_VALUE * self.typical_large;
        let next = bracket.inside + outward * (10.0 * bracket.inside.abs()).max(self.typical_small);
        let next = next.clamp(self.min_value.max(-most), most);
        if next == bracket.inside {
            return Some(if next == self.min_value { End::natural(next) } else { End::Unbounded });
        }
        match self.decide_at_limit(trial, next) {
            (Verdict::Stable, _) => bracket.inside = next,
            (Verdict::Unstable, motion) => self.narrow(trial, bracket, next, motion, outward),
            (Verdict::Undecided, _) => {
                return Some(End::Unconfirmed { stands: bracket.inside, beyond: next });
            }
        }
        None
    }

    /// Returns the values at which a mechanism proves a fall. The mechanism was found at `value`.
    fn excluded_range(&self, trial: &Trial, value: f64, motion: &[Motion]) -> ExcludedRange {
        let [without, with] = [0.0, self.typical_large].map(|at| trial.power(&(self.setting)(at), motion));
        // The power along the mechanism is a linear function A + B·x of the parameter x. It is zero at x = −A/B.
        let slope = (with - without) / self.typical_large;
        let mut bound = -without / slope;
        // Rounding must not exclude the least meaningful value, such as the load factor 0.
        if (bound - self.min_value).abs() < ROUNDING_TOL * self.typical_small {
            bound = self.min_value;
        }
        if !bound.is_finite() || bound.abs() > MAX_VANISHING_VALUE * self.typical_large {
            return ExcludedRange::All;
        }
        // The mechanism was found at `value`, so the excluded range must contain `value`.
        if slope > 0.0 { ExcludedRange::Above(bound.min(value)) } else { ExcludedRange::Below(bound.max(value)) }
    }

    fn decide_at_limit(&self, trial: &mut Trial, value: f64) -> (Verdict, Vec<Motion>) {
        trial.decide_at(&(self.setting)(value), LimitDistance::AtLimit)
    }

    /// Returns the magnitude of `value`, to which distances are relative; `typical_small` if `value` is nearly 0.
    pub fn size(&self, value: f64) -> f64 {
        if value.abs() < 1e-3 * self.typical_small { self.typical_small } else { value.abs() }
    }

    /// Returns `value`, or 0 if `value` differs from 0 only by rounding.
    fn without_rounding(&self, value: f64) -> f64 {
        if value.abs() < ROUNDING_TOL * self.typical_small { 0.0 } else { value }
    }
}
