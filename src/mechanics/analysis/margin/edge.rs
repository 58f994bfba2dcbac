//! [`Threshold`]: between a value at which a component stands and one at which it falls.
//!
//! A value from elsewhere is confirmed by judging just inside and just beyond it; without one, the edge is searched for:
//! by Newton's steps where only the contacts change with the value, else by halving, to nine digits. A value that no verdict
//! confirms on either side is withheld.

use super::interval::{End, Interval};
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::analysis::component::Place;
use crate::proof::Motion;

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
    /// A parameter, up to `most`, of which a least value suffices.
    pub fn least(most: f64) -> Threshold {
        Threshold {
            way: Way::Least,
            natural: 1.0,
            most,
        }
    }

    /// A parameter, up to `most`, of which a largest value is borne.
    pub fn most(most: f64) -> Threshold {
        Threshold {
            way: Way::Most,
            ..Threshold::least(most)
        }
    }

    /// The interval of which one end is this one.
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
    /// A motion found so far beyond an edge at most is near enough to confirm it.
    const SURE: f64 = 256e-6;
    /// Steps away from an edge grow by this factor up to [`Threshold::FAR`], as long as no proof convinces so close to it.
    const WIDER: f64 = 16.0;
    /// The largest step away from an edge within which it may stay undecided.
    const FAR: f64 = 5e-3;

    /// A value, if the component stands just inside it and falls just beyond.
    pub fn confirmed(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        at: f64,
    ) -> Option<End> {
        let at = if at < 1e-9 * self.natural { 0.0 } else { at };
        let guessed = self
            .steps(at, Side::Inside)
            .any(|inside| trial.guess(&setting(inside)).0 == Verdict::Stable);
        if !guessed {
            let mut verdicts = self
                .steps(at, Side::Inside)
                .map(|inside| trial.judge_at(&setting(inside), Place::AtEdge).0);
            if verdicts.find(|v| *v != Verdict::Undecided) != Some(Verdict::Stable) {
                return None;
            }
        }
        let mechanism = self.beyond(trial, setting, at)?;
        Some(End::At {
            value: at,
            mechanism,
        })
    }

    /// The interval whose end lies between 0 and `most`, found by Newton's steps or else by halving.
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
        // Large steps outward, as long as the answer is that at 0.
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
        let (mut inside, mut outside) = match self.way {
            Way::Most => (near, far),
            Way::Least => (far, near),
        };
        let found = self.stepped(trial, setting, [inside, outside]);
        if let Some(found) = found.and_then(|at| self.confirmed(trial, setting, at)) {
            return self.interval(found);
        }
        while (inside - outside).abs() > 1e-9 * inside.max(outside) + 1e-11 * self.natural {
            let next = 0.5 * (inside + outside);
            match trial.judge(&setting(next)).0 {
                Verdict::Stable => inside = next,
                Verdict::Unstable => outside = next,
                Verdict::Undecided => break,
            }
        }
        // What is left of the band around 0 is 0.
        let at = if inside < 1e-6 * self.natural {
            0.0
        } else {
            inside
        };
        let found = self.confirmed(trial, setting, at);
        self.interval(found.unwrap_or(End::Unconfirmed {
            stands: inside,
            beyond: outside,
        }))
    }

    /// The edge from Newton's steps on the least that forces leave unbalanced, seen from where it falls; `None` where they
    /// lead nowhere.
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
        // The latest falling ones, and the last standing one.
        let (mut falling, mut standing) = (Vec::new(), None);
        let mut edge = None;
        for _ in 0..STEPS {
            if tangent.left <= LEFT {
                return None;
            }
            let size = inside.max(outside);
            let root = trial.root(&tangent, setting, [outside, inside]);
            let is_within = within(root, inside, outside);
            falling.push((outside, tangent.clone()));
            if (inside - outside).abs() <= CLOSE * size {
                edge = Some(if is_within { root } else { inside });
                break;
            }
            if is_within && (root - outside).abs() <= CLOSE * size {
                edge = Some(root);
                break;
            }
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
            // It stands where the step ended. Is the edge just there?
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
        let at = edge?;
        let away = |value: f64| (value - at).abs() / at.max(f64::MIN_POSITIVE);
        let near = falling
            .into_iter()
            .rev()
            .find(|(value, _)| (2.0 * Self::NEAR..0.9 * Self::SURE).contains(&away(*value)));
        let falls = near.or_else(|| {
            let value = self.steps(at, Side::Beyond).nth(1)?;
            Some((value, trial.tangent(&setting(value))?))
        });
        let standing = standing.filter(|(value, _)| away(*value) <= Self::NEAR);
        let stands = standing.or_else(|| {
            let value = self.steps(at, Side::Inside).next()?;
            Some((value, trial.tangent(&setting(value))?))
        });
        for (found, verdict) in [(falls, Verdict::Unstable), (stands, Verdict::Stable)] {
            if let Some((value, tangent)) = found {
                trial.learn_tangent(&tangent, &setting(value), verdict);
            }
        }
        Some(at)
    }

    /// The mechanism just beyond an edge: at the nearest of growing steps where there is a proved one. Empty at a least
    /// value of 0.
    fn beyond(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        at: f64,
    ) -> Option<Vec<Motion>> {
        if at == 0.0 && self.way == Way::Least {
            return Some(Vec::new());
        }
        let motion = |(verdict, motion)| (verdict == Verdict::Unstable).then_some(motion);
        let guessed = self
            .steps(at, Side::Beyond)
            .find_map(|outside| motion(trial.guess(&setting(outside))));
        guessed.or_else(|| {
            self.steps(at, Side::Beyond)
                .find_map(|outside| motion(trial.judge_at(&setting(outside), Place::AtEdge)))
        })
    }

    /// Values at growing steps from an edge.
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
            // Where there is no farther value, the last one is tried once.
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

/// Which side of an edge is looked at.
#[derive(Clone, Copy)]
enum Side {
    Inside,
    Beyond,
}
