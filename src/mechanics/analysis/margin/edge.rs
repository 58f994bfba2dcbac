//! [`Threshold`]: searches the value of a parameter that separates standing from falling.
//!
//! Newton's steps find the edge; verdicts just inside and just beyond confirm it. Where these are too far apart, or Newton's
//! steps lead nowhere, the stretch between them is halved. A value that no verdicts confirm on both sides is withheld.

use super::interval::{End, Interval};
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::analysis::decide::Place;
use crate::proof::Motion;
use crate::solve::Tangent;

/// Which side of an edge stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Below it: the most that is borne.
    Most,
    /// Above it: the least that suffices.
    Least,
}

/// What is known beforehand about the value, at least 0, at which a component begins or ceases to stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Threshold {
    /// Which side stands.
    pub way: Way,
    /// The size of an ordinary value.
    pub natural: f64,
    /// The largest value that is tried.
    pub most: f64,
}

impl Threshold {
    /// A parameter from 0 to `most` whose least sufficient value is searched.
    pub fn least(most: f64) -> Threshold {
        Threshold {
            way: Way::Least,
            natural: 1.0,
            most,
        }
    }

    /// A parameter from 0 to `most` whose largest admissible value is searched.
    pub fn most(most: f64) -> Threshold {
        Threshold {
            way: Way::Most,
            ..Threshold::least(most)
        }
    }

    /// The interval that this end limits.
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

    /// How far inside an edge it must stand, and from how far beyond it may be shown to fall; relative.
    const NEAR: f64 = 1e-6;
    /// Newton's steps are believed where verdicts no farther apart than this agree with them; relative.
    const SURE: f64 = 512e-6;
    /// Steps away from an edge grow by this factor up to [`Threshold::FAR`], as long as no proof convinces so close to it.
    const WIDER: f64 = 16.0;
    /// The largest step away from an edge within which it may stay undecided.
    const FAR: f64 = 256e-6;

    /// Searches the end between 0 and `most`, with Newton's method or else by bisection, and returns the interval.
    ///
    /// Where a value is undecided the search ends: the edge lies there, within what can be decided.
    pub fn searched(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> Interval {
        let at_none = match (trial.judge(&setting(0.0)).0, self.way) {
            (Verdict::Unstable, Way::Most) => return Interval::Empty,
            (Verdict::Undecided, Way::Most) => return Interval::Undecided,
            (Verdict::Stable, Way::Least) => return self.interval(End::natural(0.0)),
            (verdict, _) => verdict == Verdict::Stable,
        };
        let (mut near, mut far) = (0.0, self.natural.min(self.most));
        // Take large steps from 0 outward, as long as the verdict is the one at 0.
        let mut verdict = trial.judge(&setting(far)).0;
        while (verdict == Verdict::Stable) == at_none {
            if far >= self.most {
                return match (self.way, verdict) {
                    (Way::Most, _) => self.interval(End::Unbounded),
                    (Way::Least, Verdict::Unstable) => Interval::Empty,
                    (Way::Least, _) => Interval::Undecided,
                };
            }
            (near, far) = (far, (far * 10.0).min(self.most));
            verdict = trial.judge(&setting(far)).0;
        }
        // The bracket: here it stands, there it falls.
        let (inside, outside) = match self.way {
            Way::Most => (near, far),
            Way::Least => (far, near),
        };
        // Newton's steps within the bracket, then verdicts on both sides of their root.
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

    /// Finds verdicts on both sides of the root of Newton's method, as close to it as possible.
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
        // Within the tolerance of the proofs the verdict may be "stands" beyond the end. Only the verdict "falls" is
        // informative there.
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

    /// The end inside a bracket: bisects until the two verdicts are close, or as close as they get around `root`.
    fn closed_in(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        mut bracket: Bracket,
        root: Option<f64>,
    ) -> End {
        let is_none = |value: f64| value < Self::NEAR * self.natural;
        let width = |bracket: &Bracket| {
            (bracket.inside - bracket.outside).abs() / bracket.inside.max(bracket.outside)
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
        // Only the tolerance around 0 remains: the end is 0.
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
        match bracket.mechanism.filter(|_| is_confirmed) {
            Some(mechanism) => {
                let value = root.unwrap_or(bracket.inside);
                End::At {
                    value: if is_none(value) { 0.0 } else { value },
                    mechanism,
                }
            }
            None => End::Unconfirmed {
                stands: bracket.inside,
                beyond: bracket.outside,
            },
        }
    }

    /// Finds the end with Newton's method on the least residual, from the side on which the component falls. `None` if the
    /// method does not converge.
    ///
    /// The forces and the motion that confirm it are remembered on the way.
    fn stepped(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        [mut inside, mut outside]: [f64; 2],
    ) -> Option<f64> {
        let within = |value: f64, a: f64, b: f64| (value - a) * (value - b) < 0.0;
        let mut tangent = trial.tangent(&setting(outside))?;
        // The latest values at which the component falls, and the last at which it stands.
        let (mut falling, mut standing) = (Vec::new(), None);
        for _ in 0..STEPS {
            if tangent.left <= LEFT {
                return None;
            }
            let size = inside.max(outside);
            let root = trial.root(&tangent, setting, [outside, inside]);
            let is_within = within(root, inside, outside);
            falling.push((outside, tangent.clone()));
            // Converged: the two sides, or the tangent's root and the falling side, are close.
            let is_bracketed = (inside - outside).abs() <= CLOSE * size;
            if is_bracketed || (is_within && (root - outside).abs() <= CLOSE * size) {
                let edge = if is_within { root } else { inside };
                self.learn_sides(trial, setting, edge, falling, standing);
                return Some(edge);
            }
            // Newton's step to the root of the tangent; half-way where the root lies outside the bracket.
            let next = if is_within {
                root
            } else {
                0.5 * (inside + outside)
            };
            let found = trial.tangent(&setting(next))?;
            if found.left > LEFT {
                (outside, tangent) = (next, found);
                continue;
            }
            inside = next;
            standing = Some((next, found));
            // The component stands at the end of the step. Test whether the end is just there.
            let beside = next + 0.4 * CLOSE * next.max(outside) * (outside - next).signum();
            if is_within && within(beside, inside, outside) {
                let found = trial.tangent(&setting(beside))?;
                if found.left > LEFT {
                    (outside, tangent) = (beside, found);
                } else {
                    inside = beside;
                }
            }
        }
        None
    }

    /// Remembers a motion just beyond an edge and forces just inside it, from the steps that found it or from new tangents.
    fn learn_sides(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        edge: f64,
        falling: Vec<(f64, Tangent)>,
        standing: Option<(f64, Tangent)>,
    ) {
        let away = |value: f64| (value - edge).abs() / edge.max(f64::MIN_POSITIVE);
        // Close enough to confirm the edge, and far enough for the proof to convince.
        let near = falling
            .into_iter()
            .rev()
            .find(|(value, _)| (2.0 * Self::NEAR..0.45 * Self::SURE).contains(&away(*value)));
        let falls = near.or_else(|| {
            let value = self.steps(edge, Side::Beyond).nth(1)?;
            Some((value, trial.tangent(&setting(value))?))
        });
        let standing = standing.filter(|(value, _)| away(*value) <= Self::NEAR);
        let stands = standing.or_else(|| {
            let value = self.steps(edge, Side::Inside).next()?;
            Some((value, trial.tangent(&setting(value))?))
        });
        for (found, verdict) in [(falls, Verdict::Unstable), (stands, Verdict::Stable)] {
            if let Some((value, tangent)) = found {
                trial.learn_tangent(&tangent, &setting(value), verdict);
            }
        }
    }

    /// Values at growing distances from an end.
    fn steps(&self, at: f64, side: Side) -> impl Iterator<Item = f64> {
        let size = if at > 0.0 { at } else { self.natural };
        let sign = match (self.way, side) {
            (Way::Most, Side::Beyond) | (Way::Least, Side::Inside) => size,
            _ => -size,
        };
        let most = match self.way {
            Way::Most => self.most,
            Way::Least => f64::INFINITY,
        };
        let mut ended = false;
        std::iter::successors(Some(Self::NEAR), |step| Some(step * Self::WIDER))
            .take_while(|step| *step <= Self::FAR)
            .map(move |step| (at + sign * step).clamp(0.0, most))
            // If there is no farther value, try the last one once.
            .take_while(move |value| {
                let last = *value == 0.0 || *value == most;
                !std::mem::replace(&mut ended, last)
            })
    }
}

/// Newton's steps, and halvings between them, of one edge.
const STEPS: usize = 24;

/// How near, relatively, a standing and a falling value lie around a found edge.
const CLOSE: f64 = 1e-6;

/// What forces may leave unbalanced, in parts of the largest load, of what stands as far as the solver can tell.
const LEFT: f64 = 1e-8;

/// Two values between which an edge lies.
struct Bracket {
    /// Here the component stands.
    inside: f64,
    /// Here it falls, or is undecided.
    outside: f64,
    /// How it begins to move at the latest value at which it was shown to fall.
    mechanism: Option<Vec<Motion>>,
}

impl Bracket {
    /// Decides the component at a value inside the bracket, first with cached proofs, and narrows the bracket.
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

/// Which side of an edge is looked at.
#[derive(Clone, Copy)]
enum Side {
    Inside,
    Beyond,
}
