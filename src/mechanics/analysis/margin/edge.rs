//! [`Threshold`]: searches for the value of a parameter (friction or kernel) at which a component begins or ceases to
//! stand.
//!
//! Newton's method ([`super::newton`]) finds the value; verdicts just inside and just beyond confirm it. If these
//! verdicts are too far apart, or Newton's method fails, bisection narrows the range between them. A value that is not
//! confirmed by verdicts on both sides is not reported.

use super::exclusion::Exclusion;
use super::interval::{End, Interval};
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::LimitDistance;
use crate::mechanics::proof::Motion;

/// The side of the threshold on which the component stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StableSide {
    /// The component stands below the threshold, which is the largest admissible value.
    Below,
    /// The component stands above the threshold, which is the least sufficient value.
    Above,
}

/// The search for the threshold of a parameter: the value, at least 0, at which a component begins or ceases to
/// stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Threshold {
    /// The side on which the component stands.
    pub stable_side: StableSide,
    /// A typical value of the parameter.
    pub typical: f64,
    /// The largest value that is tried.
    pub max_value: f64,
}

impl Threshold {
    /// Creates the search for the smallest value from 0 to `max_value` at which the component stands, such as its least
    /// friction.
    pub fn smallest_stable(max_value: f64) -> Threshold {
        Threshold { stable_side: StableSide::Above, typical: 1.0, max_value }
    }

    /// Creates the search for the largest value from 0 to `max_value` at which the component stands, such as its
    /// largest kernel.
    pub fn largest_stable(max_value: f64) -> Threshold {
        Threshold { stable_side: StableSide::Below, ..Threshold::smallest_stable(max_value) }
    }

    /// Returns the interval of values at which the component stands: from 0 to `end`, or from `end` upwards.
    fn interval(&self, end: End) -> Interval {
        match self.stable_side {
            StableSide::Below => Interval::Between { low: End::natural(0.0), high: end },
            StableSide::Above => Interval::Between { low: end, high: End::Unbounded },
        }
    }

    /// The smallest relative distance from the threshold at which verdicts are computed, on both sides.
    pub(super) const MIN_OFFSET: f64 = 1e-6;
    /// Newton's root is accepted if a stable value on one side and an unstable value on the other side are at most
    /// this far apart, relative to their size.
    pub(super) const BRACKET_TOL: f64 = 512e-6;
    /// Distances from the threshold grow by this factor up to [`Threshold::MAX_OFFSET`], until a verdict has a proof.
    const OFFSET_GROWTH: f64 = 16.0;
    /// The largest number of times that an end is moved inward by [`Threshold::sharpened`]. Each time costs a program.
    const MAX_SHARPENINGS: usize = 8;
    /// The largest relative distance from the threshold at which verdicts are computed to confirm it.
    const MAX_OFFSET: f64 = 256e-6;

    /// If the threshold is below this fraction of the typical value, the width of a bracket and the largest distance
    /// on the falling side are relative to this fraction of the typical value. Within the tolerance of the proofs, a
    /// verdict may be stable beyond the threshold, and this tolerance does not shrink with the threshold.
    const MIN_TYPICAL_SHARE: f64 = 0.1;

    /// Searches for the threshold between 0 and `max_value`, by Newton's method and bisection. Returns the interval of
    /// values at which the component stands.
    ///
    /// If a verdict is undecided during the bisection, the search ends, because it cannot find the threshold more
    /// accurately.
    pub fn search(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> Interval {
        let (at_zero, motion) = trial.decide(&setting(0.0));
        let stands_at_zero = match (at_zero, self.stable_side) {
            (Verdict::Unstable, StableSide::Below) => return Interval::excluded_by(motion),
            (Verdict::Undecided, StableSide::Below) => return Interval::Undecided,
            (Verdict::Stable, StableSide::Above) => return self.interval(End::natural(0.0)),
            (verdict, _) => verdict == Verdict::Stable,
        };
        let (mut stepped_from, mut stepped_to) = (0.0, self.typical.min(self.max_value));
        // Take larger and larger steps away from 0, until the component no longer stands, or begins to stand.
        let (mut verdict, mut motion) = trial.decide(&setting(stepped_to));
        while (verdict == Verdict::Stable) == stands_at_zero {
            if stepped_to >= self.max_value {
                return match (self.stable_side, verdict) {
                    (StableSide::Below, _) => self.interval(End::Unbounded),
                    (StableSide::Above, Verdict::Unstable) => {
                        Interval::Empty(vec![Exclusion::below(stepped_to, motion)])
                    }
                    (StableSide::Above, _) => Interval::Undecided,
                };
            }
            (stepped_from, stepped_to) = (stepped_to, (stepped_to * 10.0).min(self.max_value));
            (verdict, motion) = trial.decide(&setting(stepped_to));
        }
        // In the bracket, the component stands at `inside` and does not stand at `outside`.
        let (inside, outside) = match self.stable_side {
            StableSide::Below => (stepped_from, stepped_to),
            StableSide::Above => (stepped_to, stepped_from),
        };
        // Find the threshold with Newton's method. Then compute verdicts at values just below and just above it.
        let root = self.newton_root(trial, setting, [inside, outside]);
        let mut bracket = Bracket { inside, outside, mechanism: None };
        if let Some(root) = root {
            self.enclose(trial, setting, &mut bracket, root);
        }
        let mut end = self.bisect(trial, setting, bracket, root);
        if trial.has_slight_loads() {
            end = self.sharpened(trial, setting, end);
        }
        self.interval(end)
    }

    /// Moves an end inward if a mechanism proves a fall just inside it, and returns the end. The verdict there is
    /// stable only within the tolerance of a proof by forces; a mechanism has no such tolerance. This matters if some
    /// loads are slight.
    fn sharpened(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, end: End) -> End {
        let End::At { mut value, mut mechanism } = end else {
            return end;
        };
        for _ in 0..Self::MAX_SHARPENINGS {
            let Some(inside) = self.test_values(value, Side::Inside).next() else {
                break;
            };
            let Some(tangent) = trial.tangent(&setting(inside)) else {
                break;
            };
            let Some(motion) = trial.proved_motion(&tangent, &setting(inside)) else {
                break;
            };
            let farther = inside + (inside - value);
            let root = trial.root(&tangent, setting, [inside, farther]);
            let is_inward = (root - inside) * (inside - value) > 0.0;
            let next = if is_inward { root } else { inside };
            value = next.clamp(0.0, self.max_value);
            mechanism = motion;
        }
        End::At { value, mechanism }
    }

    /// Computes verdicts on both sides of `root`, the threshold according to Newton's method, as near to it as
    /// possible. Narrows the bracket to these values.
    fn enclose(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, bracket: &mut Bracket, root: f64) {
        let within = |value: &f64, bracket: &Bracket| (value - bracket.inside) * (value - bracket.outside) < 0.0;
        for value in self.test_values(root, Side::Inside) {
            if within(&value, bracket) && bracket.test(trial, setting, value) == Verdict::Stable {
                break;
            }
        }
        // Just beyond the threshold, the verdict may still be stable within the tolerance of the proofs. Therefore use
        // only an unstable verdict there.
        for value in self.test_values(root, Side::Beyond) {
            if !within(&value, bracket) {
                continue;
            }
            let (verdict, motion) = trial.decide_at(&setting(value), LimitDistance::AtLimit);
            if verdict == Verdict::Unstable {
                (bracket.outside, bracket.mechanism) = (value, Some(motion));
                break;
            }
        }
    }

    /// Bisects a bracket until its two values are close enough, and returns the end of the interval. A bracket that
    /// contains `root` may be wider (`BRACKET_TOL`). The end is unconfirmed if the values stay too far apart or no fall
    /// was proved.
    fn bisect(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        mut bracket: Bracket,
        root: Option<f64>,
    ) -> End {
        let is_zero = |value: f64| value < Self::MIN_OFFSET * self.typical;
        let width = |bracket: &Bracket| {
            let size = bracket.inside.max(bracket.outside);
            (bracket.inside - bracket.outside).abs() / size.max(Self::MIN_TYPICAL_SHARE * self.typical)
        };
        let is_around = |bracket: &Bracket, root: &f64| (root - bracket.inside) * (root - bracket.outside) <= 0.0;
        let is_narrow_enough = |bracket: &Bracket| match root.filter(|root| is_around(bracket, root)) {
            Some(_) => width(bracket) <= Self::BRACKET_TOL,
            None => width(bracket) <= Self::MIN_OFFSET,
        };
        let mut is_decided = true;
        while is_decided && !is_narrow_enough(&bracket) && !is_zero(bracket.inside.max(bracket.outside)) {
            let middle = 0.5 * (bracket.inside + bracket.outside);
            is_decided = bracket.test(trial, setting, middle) != Verdict::Undecided;
        }
        // The component stands at a value that differs from 0 by less than the tolerance, so it stands from 0 on.
        if self.stable_side == StableSide::Above && is_zero(bracket.inside) {
            return End::natural(0.0);
        }
        let root = root.filter(|root| is_around(&bracket, root));
        let is_close = width(&bracket) <= if root.is_some() { Self::BRACKET_TOL } else { 2.0 * Self::MIN_OFFSET };
        let is_confirmed = is_close || is_zero(bracket.inside.max(bracket.outside));
        let reaches_max = self.reaches_max(&bracket);
        match bracket.mechanism.filter(|_| is_confirmed) {
            Some(mechanism) => {
                let value = root.unwrap_or(bracket.inside);
                End::At { value: if is_zero(value) { 0.0 } else { value }, mechanism }
            }
            // The verdict is undecided only within 1e-6 of the largest value, so the interval ends at the largest
            // value.
            None if reaches_max && self.stands_just_below_max(trial, setting) => End::natural(self.max_value),
            None => End::Unconfirmed { stands: bracket.inside, beyond: bracket.outside },
        }
    }

    /// True if no fall was found up to the largest value: the search is for the largest admissible value, and the
    /// bracket ends at `max_value` without a mechanism.
    fn reaches_max(&self, bracket: &Bracket) -> bool {
        self.stable_side == StableSide::Below && bracket.outside == self.max_value && bracket.mechanism.is_none()
    }

    /// True if the component stands at a value that is 1e-6 (relative) below the largest value.
    fn stands_just_below_max(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> bool {
        let last = self.max_value * (1.0 - Self::MIN_OFFSET);
        trial.decide_at(&setting(last), LimitDistance::AtLimit).0 == Verdict::Stable
    }

    /// Returns values at growing distances from `threshold`, on the side where the component stands (`Inside`)
    /// or falls (`Beyond`).
    pub(super) fn test_values(&self, threshold: f64, side: Side) -> impl Iterator<Item = f64> {
        let scale = if threshold > 0.0 { threshold } else { self.typical };
        let sign = match (self.stable_side, side) {
            (StableSide::Below, Side::Beyond) | (StableSide::Above, Side::Inside) => scale,
            _ => -scale,
        };
        let max_offset = match side {
            Side::Inside => Self::MAX_OFFSET,
            Side::Beyond => Self::MAX_OFFSET * (Self::MIN_TYPICAL_SHARE * self.typical / scale).max(1.0),
        };
        let max_value = match self.stable_side {
            StableSide::Below => self.max_value,
            StableSide::Above => f64::INFINITY,
        };
        let mut is_clamped = false;
        std::iter::successors(Some(Self::MIN_OFFSET), |step| Some(step * Self::OFFSET_GROWTH))
            .take_while(move |step| *step <= max_offset)
            .map(move |step| (threshold + sign * step).clamp(0.0, max_value))
            // Steps that pass 0 or `max_value` are clamped to this limit. Return the limit once, then stop.
            .take_while(move |value| {
                let last = *value == 0.0 || *value == max_value;
                !std::mem::replace(&mut is_clamped, last)
            })
    }
}

/// Two values between which the threshold lies.
struct Bracket {
    /// A value at which the component stands.
    inside: f64,
    /// A value at which the component falls or is undecided.
    outside: f64,
    /// The mechanism at the last value at which a fall was proved; `None` if no fall was proved.
    mechanism: Option<Vec<Motion>>,
}

impl Bracket {
    /// Decides whether the component stands at a value inside the bracket, and moves the corresponding end of the bracket
    /// to this value. The bracket stays unchanged if the verdict is undecided.
    fn test(&mut self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, value: f64) -> Verdict {
        let (verdict, motion) = trial.decide_at(&setting(value), LimitDistance::AtLimit);
        match verdict {
            Verdict::Stable => self.inside = value,
            Verdict::Unstable => (self.outside, self.mechanism) = (value, Some(motion)),
            Verdict::Undecided => {}
        }
        verdict
    }
}

/// The side of a threshold on which a value is tested.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Inside,
    Beyond,
}
