//! [`Threshold`]: searches for the value of a parameter (friction or kernel) at which a component begins or ceases to
//! stand.
//!
//! Newton's method ([`super::newton`]) finds the value; verdicts just inside and just beyond confirm it. If these
//! verdicts are too far apart, or Newton's method fails, bisection narrows the range between them. A value that is not
//! confirmed by verdicts on both sides is not reported.

use super::exclusion::Exclusion;
use super::interval::{End, Interval};
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::analysis::decide::Place;
use crate::proof::Motion;

/// The side of the threshold on which the component stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// It stands below: the threshold is the largest admissible value.
    Most,
    /// It stands above: the threshold is the least sufficient value.
    Least,
}

/// The search for the threshold of a parameter: the value, at least 0, at which a component begins or ceases to
/// stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Threshold {
    /// The side on which the component stands.
    pub way: Way,
    /// A typical value of the parameter.
    pub natural: f64,
    /// The largest value that is tried.
    pub most: f64,
}

impl Threshold {
    /// Creates the search for the smallest value from 0 to `most` at which the component stands, such as its least
    /// friction.
    pub fn least(most: f64) -> Threshold {
        Threshold {
            way: Way::Least,
            natural: 1.0,
            most,
        }
    }

    /// Creates the search for the largest value from 0 to `most` at which the component stands, such as its largest
    /// kernel.
    pub fn most(most: f64) -> Threshold {
        Threshold {
            way: Way::Most,
            ..Threshold::least(most)
        }
    }

    /// Returns the interval of values at which the component stands: from 0 to `end`, or from `end` upwards.
    fn interval(&self, end: End) -> Interval {
        match self.way {
            Way::Most => Interval::Between {
                low: End::natural(0.0),
                high: end,
            },
            Way::Least => Interval::Between {
                low: end,
                high: End::Unbounded,
            },
        }
    }

    /// The smallest relative distance from the threshold at which verdicts are computed, on both sides.
    pub(super) const NEAR: f64 = 1e-6;
    /// Newton's root is accepted if a stable and an unstable value on both sides of it are at most this far apart,
    /// relative.
    pub(super) const SURE: f64 = 512e-6;
    /// Distances from the threshold grow by this factor up to [`Threshold::FAR`], until a proof is strong enough.
    const WIDER: f64 = 16.0;
    /// The largest relative distance from the threshold at which verdicts are computed to confirm it.
    const FAR: f64 = 256e-6;

    /// Below this fraction of its typical value, distances on the falling side are relative to this fraction: a verdict
    /// may be stable beyond the threshold by the tolerance of the proofs, which does not shrink with the threshold.
    const SMALL: f64 = 0.1;

    /// Searches for the threshold between 0 and `most`, by Newton's method and bisection. Returns the interval of
    /// values at which the component stands.
    ///
    /// If the verdict at a value is undecided, the search ends there, because it cannot find the threshold more
    /// exactly.
    pub fn searched(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> Interval {
        let (at_zero, motion) = trial.judge(&setting(0.0));
        let at_none = match (at_zero, self.way) {
            (Verdict::Unstable, Way::Most) => return Interval::excluded_by(motion),
            (Verdict::Undecided, Way::Most) => return Interval::Undecided,
            (Verdict::Stable, Way::Least) => return self.interval(End::natural(0.0)),
            (verdict, _) => verdict == Verdict::Stable,
        };
        let (mut near, mut far) = (0.0, self.natural.min(self.most));
        // Take larger and larger steps away from 0, until the component no longer stands, or begins to stand.
        let (mut verdict, mut motion) = trial.judge(&setting(far));
        while (verdict == Verdict::Stable) == at_none {
            if far >= self.most {
                return match (self.way, verdict) {
                    (Way::Most, _) => self.interval(End::Unbounded),
                    (Way::Least, Verdict::Unstable) => {
                        Interval::Empty(vec![Exclusion::below(far, motion)])
                    }
                    (Way::Least, _) => Interval::Undecided,
                };
            }
            (near, far) = (far, (far * 10.0).min(self.most));
            (verdict, motion) = trial.judge(&setting(far));
        }
        // In the bracket, the component stands at `inside` and does not stand at `outside`.
        let (inside, outside) = match self.way {
            Way::Most => (near, far),
            Way::Least => (far, near),
        };
        // Find the threshold with Newton's method. Then compute verdicts at values just below and just above it.
        let root = self.stepped(trial, setting, [inside, outside]);
        let mut bracket = Bracket {
            inside,
            outside,
            mechanism: None,
        };
        if let Some(root) = root {
            self.enclose(trial, setting, &mut bracket, root);
        }
        self.interval(self.closed_in(trial, setting, bracket, root))
    }

    /// Computes verdicts on both sides of `root`, the threshold according to Newton's method, as near to it as
    /// possible. Narrows the bracket to these values.
    fn enclose(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        bracket: &mut Bracket,
        root: f64,
    ) {
        let within = |value: &f64, bracket: &Bracket| {
            (value - bracket.inside) * (value - bracket.outside) < 0.0
        };
        for value in self.steps(root, Side::Inside) {
            if within(&value, bracket) && bracket.take(trial, setting, value) == Verdict::Stable {
                break;
            }
        }
        // Just beyond the threshold, the verdict may still be stable within the tolerance of the proofs. Therefore use
        // only an unstable verdict there.
        for value in self.steps(root, Side::Beyond) {
            if !within(&value, bracket) {
                continue;
            }
            let (verdict, motion) = trial.judge_at(&setting(value), Place::AtEdge);
            if verdict == Verdict::Unstable {
                (bracket.outside, bracket.mechanism) = (value, Some(motion));
                break;
            }
        }
    }

    /// Bisects a bracket until its two values are close enough, and returns the end of the interval. A bracket that
    /// contains `root` may be wider (`SURE`). The end is unconfirmed if the values stay too far apart.
    fn closed_in(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        mut bracket: Bracket,
        root: Option<f64>,
    ) -> End {
        let is_none = |value: f64| value < Self::NEAR * self.natural;
        let width = |bracket: &Bracket| {
            let size = bracket.inside.max(bracket.outside);
            (bracket.inside - bracket.outside).abs() / size.max(Self::SMALL * self.natural)
        };
        let is_around = |bracket: &Bracket, root: &f64| {
            (root - bracket.inside) * (root - bracket.outside) <= 0.0
        };
        let is_enough = |bracket: &Bracket| match root.filter(|root| is_around(bracket, root)) {
            Some(_) => width(bracket) <= Self::SURE,
            None => width(bracket) <= Self::NEAR,
        };
        let mut is_decided = true;
        while is_decided && !is_enough(&bracket) && !is_none(bracket.inside.max(bracket.outside)) {
            let middle = 0.5 * (bracket.inside + bracket.outside);
            is_decided = bracket.take(trial, setting, middle) != Verdict::Undecided;
        }
        // The component stands at a value that differs from 0 by less than the tolerance, so it stands from 0 on.
        if self.way == Way::Least && is_none(bracket.inside) {
            return End::natural(0.0);
        }
        let root = root.filter(|root| is_around(&bracket, root));
        let is_close = width(&bracket)
            <= if root.is_some() {
                Self::SURE
            } else {
                2.0 * Self::NEAR
            };
        let is_confirmed = is_close || is_none(bracket.inside.max(bracket.outside));
        let is_last = self.is_last(&bracket);
        match bracket.mechanism.filter(|_| is_confirmed) {
            Some(mechanism) => {
                let value = root.unwrap_or(bracket.inside);
                End::At {
                    value: if is_none(value) { 0.0 } else { value },
                    mechanism,
                }
            }
            // The verdict is undecided only within 1e-6 of the largest value, so the interval ends at the largest
            // value.
            None if is_last && self.stands_at_the_last(trial, setting) => End::natural(self.most),
            None => End::Unconfirmed {
                stands: bracket.inside,
                beyond: bracket.outside,
            },
        }
    }

    /// True if no fall was found up to the largest value: the search is for the largest admissible value, and the
    /// bracket ends at `most` without a mechanism.
    fn is_last(&self, bracket: &Bracket) -> bool {
        self.way == Way::Most && bracket.outside == self.most && bracket.mechanism.is_none()
    }

    /// True if the component stands at a value that is 1e-6 (relative) below the largest value.
    fn stands_at_the_last(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> bool {
        let last = self.most * (1.0 - Self::NEAR);
        trial.judge_at(&setting(last), Place::AtEdge).0 == Verdict::Stable
    }

    /// Returns values at growing distances from the threshold `at`, on the side where the component stands (`Inside`)
    /// or falls (`Beyond`).
    pub(super) fn steps(&self, at: f64, side: Side) -> impl Iterator<Item = f64> {
        let size = if at > 0.0 { at } else { self.natural };
        let sign = match (self.way, side) {
            (Way::Most, Side::Beyond) | (Way::Least, Side::Inside) => size,
            _ => -size,
        };
        let far = match side {
            Side::Inside => Self::FAR,
            Side::Beyond => Self::FAR * (Self::SMALL * self.natural / size).max(1.0),
        };
        let most = match self.way {
            Way::Most => self.most,
            Way::Least => f64::INFINITY,
        };
        let mut ended = false;
        std::iter::successors(Some(Self::NEAR), |step| Some(step * Self::WIDER))
            .take_while(move |step| *step <= far)
            .map(move |step| (at + sign * step).clamp(0.0, most))
            // Steps that pass 0 or `most` are clamped to this limit. Return the limit once, then stop.
            .take_while(move |value| {
                let last = *value == 0.0 || *value == most;
                !std::mem::replace(&mut ended, last)
            })
    }
}

/// Two values between which the threshold lies.
struct Bracket {
    /// Here the component stands.
    inside: f64,
    /// Here it falls, or is undecided.
    outside: f64,
    /// The mechanism at the latest value at which a fall was proved.
    mechanism: Option<Vec<Motion>>,
}

impl Bracket {
    /// Decides the component at a value inside the bracket, and moves one end of the bracket to this value. The bracket
    /// stays if the verdict is undecided.
    fn take(&mut self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, value: f64) -> Verdict {
        let (verdict, motion) = trial.judge_at(&setting(value), Place::AtEdge);
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
