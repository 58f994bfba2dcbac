//! [`Line`]: finds the values of a parameter between which a component stands. The loads, or the limits of forces, must
//! be linear in this parameter.
//!
//! The power of the loads along a fixed mechanism is linear in such a parameter. One mechanism therefore shows that a
//! component falls at every value on one side of the value at which this power vanishes: a cutting plane (Kelley
//! 1960). One linear program gives the end and the forces and the mechanism there; verdicts confirm them. If they do
//! not, cutting planes and bisection narrow the range that contains the end.

use super::exclusion::Exclusion;
use super::interval::{End, Interval};
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::analysis::decide::LimitDistance;
use crate::proof::Motion;

/// A parameter, and how a component changes with it.
pub(super) struct Line<'a> {
    /// The changed component at a value.
    pub setting: &'a dyn Fn(f64) -> Setting,
    /// The least meaningful value; −∞ if all values are meaningful.
    pub min_value: f64,
    /// A typical small size of the parameter. Distances from smaller values are relative to it.
    pub typical_small: f64,
    /// A typical large size of the parameter: a load of 10⁻⁵ N equals a weight of 1 N at the factor 10⁵.
    pub typical_large: f64,
}

/// Two values between which an end lies.
struct Bracket {
    /// Here the component stands.
    inside: f64,
    /// From here outward a mechanism proves that it falls.
    beyond: Option<(f64, Vec<Motion>)>,
}

/// The values at which a mechanism proves a fall: all above one value, all below it, or all values.
enum ExcludedRange {
    Above(f64),
    Below(f64),
    All,
}

/// An end is found if the component stands and falls within this distance, relative to the value.
const END_TOL: f64 = 1e-6;
/// The end from a linear program is accepted if verdicts within this relative distance, on both sides, agree with it.
const CONFIRMATION_TOL: f64 = 256e-6;
/// A verdict may be stable this far beyond the end, relative to the value, within the tolerance of the proofs.
const STABLE_BEYOND: f64 = 4e-6;
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
            && (from <= self.min_value
                || self.decide_at_limit(trial, self.min_value).0 == Verdict::Stable)
        {
            return End::natural(self.min_value);
        }
        let mut bracket = Bracket {
            inside: from,
            beyond: None,
        };
        // Compute verdicts on both sides of the hint. They often confirm the end at once.
        if let Some(hint) = hint {
            self.test_near_hint(trial, &mut bracket, hint, outward);
        }
        // Step outward until the component falls. Then narrow the bracket by cutting planes and bisection.
        for _ in 0..MAX_STEPS {
            let Some((beyond, mechanism)) = &bracket.beyond else {
                match self.step_outward(trial, &mut bracket, outward) {
                    Some(end) => return end,
                    None => continue,
                }
            };
            if (beyond - bracket.inside) * outward <= END_TOL * self.size(*beyond) {
                // The stable value may lie slightly beyond the end, within the tolerance of the proofs.
                let within = hint.filter(|hint| {
                    (hint - bracket.inside) * outward >= -END_TOL * self.size(*hint)
                        && (beyond - hint) * outward >= 0.0
                });
                return End::At {
                    value: self.without_rounding(within.unwrap_or(*beyond)),
                    mechanism: mechanism.clone(),
                };
            }
            // `beyond` is where the mechanism ceases to prove a fall. Try a value just inside it. If the verdict there
            // is undecided, try the middle of the bracket.
            let (beyond, inside) = (*beyond, bracket.inside);
            let just_inside = beyond - 0.5 * outward * END_TOL * self.size(beyond);
            let end_moved = [just_inside, 0.5 * (inside + beyond)]
                .into_iter()
                .filter(|value| (value - inside) * outward > 0.0)
                .any(|value| {
                    match self.decide_at_limit(trial, value) {
                        (Verdict::Stable, _) => bracket.inside = value,
                        (Verdict::Unstable, motion) => {
                            self.narrow(trial, &mut bracket, value, motion, outward)
                        }
                        (Verdict::Undecided, _) => return false,
                    }
                    true
                });
            if !end_moved {
                break;
            }
        }
        self.unconfirmed(bracket, hint, outward)
    }

    /// Returns three values for an end of the interval: the end, a value just inside it, and a value clearly beyond it.
    pub fn test_values(&self, end: f64, outward: f64) -> [f64; 3] {
        let size = outward * self.size(end);
        [
            end,
            end - 0.5 * END_TOL * size,
            (end + 16.0 * CONFIRMATION_TOL * size).max(self.min_value),
        ]
    }

    /// Returns `value`, limited to a large finite number, so that an inward search can start there.
    pub fn finite_start(&self, value: f64) -> f64 {
        value.min(MAX_VALUE * self.typical_large)
    }

    /// Returns the end if the bracket could not be narrowed enough. This is the hint if the verdicts on both sides
    /// agree with it, otherwise an unconfirmed end.
    fn unconfirmed(&self, bracket: Bracket, hint: Option<f64>, outward: f64) -> End {
        let Bracket { inside, beyond } = bracket;
        let Some((beyond, mechanism)) = beyond else {
            return End::Unconfirmed {
                stands: inside,
                beyond: outward * f64::INFINITY,
            };
        };
        // The hint is confirmed if the verdicts on both sides are close enough to it.
        let is_confirmed = |hint: &f64| {
            let [from_inside, to_beyond] = [hint - inside, beyond - hint]
                .map(|distance| distance * outward / self.size(*hint));
            (-STABLE_BEYOND..=CONFIRMATION_TOL).contains(&from_inside)
                && (-END_TOL..=CONFIRMATION_TOL).contains(&to_beyond)
        };
        match hint.filter(is_confirmed) {
            Some(value) => End::At { value, mechanism },
            None => End::Unconfirmed {
                stands: inside,
                beyond,
            },
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
        let near = || {
            steps()
                .take_while(|step| *step <= CONFIRMATION_TOL)
                .filter_map(inside)
        };
        let cached =
            near().find(|value| trial.cached_verdict(&(self.setting)(*value)).0 == Verdict::Stable);
        let stands = cached.or_else(|| {
            near().find(|value| self.decide_at_limit(trial, *value).0 == Verdict::Stable)
        });
        let outside =
            |step: f64| Some(hint + outward * step * size).filter(|value| *value >= self.min_value);
        let mut falls = steps().filter_map(outside).find_map(|value| {
            let (verdict, motion) = trial.cached_verdict(&(self.setting)(value));
            (verdict == Verdict::Unstable).then_some((value, motion))
        });
        if falls.is_none() {
            falls = steps()
                .take_while(|step| *step <= CONFIRMATION_TOL)
                .filter_map(outside)
                .find_map(|value| {
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
    fn narrow(
        &self,
        trial: &Trial,
        bracket: &mut Bracket,
        value: f64,
        motion: Vec<Motion>,
        outward: f64,
    ) {
        let reached = match self.excluded_range(trial, value, &motion) {
            ExcludedRange::Above(bound) if outward > 0.0 => bound,
            ExcludedRange::Below(bound) if outward < 0.0 => bound,
            // The mechanism excludes even values at which the verdict was stable: that verdict holds only within its
            // tolerance. Use `value` itself as the outer end.
            _ => value,
        };
        let bound = if (reached - bracket.inside) * outward < 0.0 {
            bracket.inside
        } else {
            reached
        };
        let is_closer = bracket
            .beyond
            .as_ref()
            .is_none_or(|(known, _)| (known - bound) * outward > 0.0);
        if is_closer {
            bracket.beyond = Some((bound, motion));
        }
    }

    /// Searches farther outward while no value is known at which the component falls: decides it at a larger distance.
    /// Returns the end of the interval if the search must stop, otherwise `None`.
    fn step_outward(&self, trial: &mut Trial, bracket: &mut Bracket, outward: f64) -> Option<End> {
        let max_value = MAX_VALUE * self.typical_large;
        let next = bracket.inside + outward * (10.0 * bracket.inside.abs()).max(self.typical_small);
        let next = next.clamp(self.min_value.max(-max_value), max_value);
        if next == bracket.inside {
            return Some(if next == self.min_value {
                End::natural(next)
            } else {
                End::Unbounded
            });
        }
        match self.decide_at_limit(trial, next) {
            (Verdict::Stable, _) => bracket.inside = next,
            (Verdict::Unstable, motion) => self.narrow(trial, bracket, next, motion, outward),
            (Verdict::Undecided, _) => {
                return Some(End::Unconfirmed {
                    stands: bracket.inside,
                    beyond: next,
                });
            }
        }
        None
    }

    /// Finds the value nearest to `present` at which the component stands, although it falls at `present`. `hint` is
    /// this value according to a linear program. If no value is found, the error is the interval: empty if mechanisms
    /// exclude all values, otherwise undecided.
    pub fn nearest(
        &self,
        trial: &mut Trial,
        present: f64,
        hint: Option<f64>,
    ) -> Result<f64, Interval> {
        let (mut low, mut high) = (self.min_value, f64::INFINITY);
        // `below` and `above` are the exclusions of all values below `low` and above `high`.
        let [mut below, mut above] = [None, None];
        let limit = MAX_VANISHING_VALUE * self.typical_large;
        let mut next = Some(present);
        let mut hinted = hint;
        for _ in 0..MAX_STEPS {
            let value = match next.take() {
                Some(value) => value,
                None => {
                    let within = |value: &f64| (low..=high).contains(value);
                    hinted
                        .take()
                        .filter(within)
                        .unwrap_or(present.clamp(low, high))
                }
            };
            let found = self.decide_near(trial, value, [low, high]);
            match found {
                (Verdict::Stable, at, _) => return Ok(at),
                (Verdict::Undecided, ..) => return Err(Interval::Undecided),
                (Verdict::Unstable, at, motion) => match self.excluded_range(trial, at, &motion) {
                    ExcludedRange::All => return Err(Interval::excluded_by(motion)),
                    ExcludedRange::Above(bound) if bound.min(at) < high => {
                        high = bound.min(at);
                        above = Some(Exclusion::above(high, motion));
                    }
                    ExcludedRange::Below(bound) if bound.max(at) > low => {
                        low = bound.max(at);
                        below = Some(Exclusion::below(low, motion));
                    }
                    ExcludedRange::Above(_) | ExcludedRange::Below(_) => {}
                },
            }
            if low > high || low > limit || high < -limit {
                let excluded = [below, above].into_iter().flatten();
                return Err(Interval::Empty(excluded.collect()));
            }
        }
        Err(Interval::Undecided)
    }

    /// Returns the verdict at `value`. If it is undecided, tries values near it, between `low` and `high`. Also returns
    /// the value that the verdict belongs to, and the mechanism if the component falls there.
    fn decide_near(
        &self,
        trial: &mut Trial,
        value: f64,
        [low, high]: [f64; 2],
    ) -> (Verdict, f64, Vec<Motion>) {
        let steps = std::iter::successors(Some(END_TOL), |step| Some(step * OFFSET_GROWTH))
            .take_while(|step| *step <= CONFIRMATION_TOL);
        let away = steps
            .flat_map(|step| [step, -step])
            .map(|step| value + step * self.size(value));
        let mut last = Vec::new();
        for at in std::iter::once(value).chain(away.filter(|at| (low..=high).contains(at))) {
            let (verdict, motion) = self.decide_at_limit(trial, at);
            if verdict != Verdict::Undecided {
                return (verdict, at, motion);
            }
            last = motion;
        }
        (Verdict::Undecided, value, last)
    }

    /// Returns the values at which a mechanism proves a fall. The mechanism was found at `value`.
    fn excluded_range(&self, trial: &Trial, value: f64, motion: &[Motion]) -> ExcludedRange {
        let [without, with] =
            [0.0, self.typical_large].map(|at| trial.power(&(self.setting)(at), motion));
        // The power along the mechanism is a linear function A + B·x of the parameter x. It is zero at x = −A/B.
        let slope = (with - without) / self.typical_large;
        let bound = -without / slope;
        if !bound.is_finite() || bound.abs() > MAX_VANISHING_VALUE * self.typical_large {
            return ExcludedRange::All;
        }
        // The mechanism was found at `value`, so the excluded range must contain `value`.
        if slope > 0.0 {
            ExcludedRange::Above(bound.min(value))
        } else {
            ExcludedRange::Below(bound.max(value))
        }
    }

    fn decide_at_limit(&self, trial: &mut Trial, value: f64) -> (Verdict, Vec<Motion>) {
        trial.decide_at(&(self.setting)(value), LimitDistance::AtLimit)
    }

    /// Returns the magnitude of `value`, to which distances are relative; `typical_small` if `value` is nearly 0.
    fn size(&self, value: f64) -> f64 {
        if value.abs() < 1e-3 * self.typical_small {
            self.typical_small
        } else {
            value.abs()
        }
    }

    /// Returns `value`, or 0 if `value` differs from 0 only by rounding.
    fn without_rounding(&self, value: f64) -> f64 {
        if value.abs() < 1e-9 * self.typical_small {
            0.0
        } else {
            value
        }
    }
}
