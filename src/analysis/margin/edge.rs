//! [`Edge`]: between a value at which a component stands and one at which it falls.
//!
//! A value from elsewhere is confirmed by judging just inside and just beyond it; without one, the edge is searched for
//! by halving, to nine digits.

use super::Margin;
use super::trial::{Setting, Trial};
use crate::analysis::Verdict;
use crate::proof::Motion;

/// Which side of an edge stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Below it: the most that is borne.
    Most,
    /// Above it: the least that suffices.
    Least,
}

/// Whether a component's margin is worse than what is known of the frame.
pub(super) fn worse(part: &Margin, whole: &Margin, way: Way) -> bool {
    match (part, whole) {
        (Margin::None, _) => *whole != Margin::None,
        (_, Margin::None) | (Margin::Unbounded, _) => false,
        (_, Margin::Unbounded) => true,
        (Margin::Value { at: a, .. }, Margin::Value { at: b, .. }) => match way {
            Way::Most => a < b,
            Way::Least => a > b,
        },
    }
}

/// What is known beforehand about an edge at values ≥ 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Which side stands.
    pub way: Way,
    /// How the loads depend on the value.
    pub loads: Loads,
    /// The size of an ordinary value.
    pub natural: f64,
    /// The largest value that is tried.
    pub most: f64,
}

/// How the power of the loads along a given motion depends on the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loads {
    /// Linearly: a mechanism at one value says up to which value it is one.
    Linear,
    /// Not, or the contacts change with the value as well.
    Other,
}

impl Edge {
    /// How far inside an edge it must stand, and from how far beyond it may be shown to fall; relative.
    const NEAR: f64 = 1e-6;
    /// Steps away from an edge grow by this factor up to [`Edge::FAR`], as long as no proof convinces so close to it.
    const WIDER: f64 = 16.0;
    /// The largest step away from an edge within which it may stay undecided.
    const FAR: f64 = 5e-3;

    /// A value, if the component stands just inside it and falls just beyond.
    pub fn confirmed(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        at: f64,
    ) -> Option<Margin> {
        let at = if at < 1e-9 * self.natural { 0.0 } else { at };
        let mut step = Self::NEAR;
        loop {
            let inside = at - self.outward(at) * step;
            match trial.judge(&setting(inside.max(0.0))).0 {
                Verdict::Stable => break,
                Verdict::Undecided if step < Self::FAR => step *= Self::WIDER,
                _ => return None,
            }
        }
        let mechanism = self.beyond(trial, setting, at)?;
        Some(Margin::Value { at, mechanism })
    }

    /// The edge between 0 and `most`, found by halving and, for linear loads, by how far each mechanism reaches.
    ///
    /// Where a value is undecided the search ends: the edge lies there, within what can be decided.
    pub fn searched(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> Margin {
        let at_none = trial.judge(&setting(0.0)).0 == Verdict::Stable;
        match (self.way, at_none) {
            (Way::Most, false) => return Margin::None,
            (Way::Least, true) => {
                return Margin::Value {
                    at: 0.0,
                    mechanism: Vec::new(),
                };
            }
            _ => {}
        }
        let (mut near, mut far) = (0.0, self.natural.min(self.most));
        // Large steps outward, as long as the answer is that at 0.
        let (mut verdict, mut motion) = trial.judge(&setting(far));
        while (verdict == Verdict::Stable) == at_none {
            if far >= self.most {
                return match self.way {
                    Way::Most => Margin::Unbounded,
                    Way::Least => Margin::None,
                };
            }
            (near, far) = (far, (far * 10.0).min(self.most));
            (verdict, motion) = trial.judge(&setting(far));
        }
        let (mut inside, mut outside) = match self.way {
            Way::Most => (near, far),
            Way::Least => (far, near),
        };
        // The end of a mechanism is the edge itself as soon as it stands there.
        let mut end = None;
        let mut fresh = verdict == Verdict::Unstable;
        while (inside - outside).abs() > 1e-9 * inside.max(outside) + 1e-11 * self.natural {
            let reached = (fresh && self.loads == Loads::Linear)
                .then(|| trial.reach(setting, &motion))
                .flatten()
                .filter(|at| (*at - inside) * (*at - outside) < 0.0);
            let next = reached.unwrap_or(0.5 * (inside + outside));
            (verdict, motion) = trial.judge(&setting(next));
            fresh = false;
            match verdict {
                Verdict::Stable => inside = next,
                Verdict::Unstable => {
                    // After a mechanism's end a halving, so that short steps cannot go on for ever.
                    fresh = reached.is_none();
                    outside = next;
                }
                Verdict::Undecided => {}
            }
            if reached.is_some() {
                end = Some(next);
            }
            if verdict == Verdict::Undecided || (reached.is_some() && verdict == Verdict::Stable) {
                break;
            }
        }
        // What a mechanism rules out is known better than what forces near the edge can show.
        let at = end
            .filter(|end| (end - inside) * (end - outside) <= 0.0)
            .unwrap_or(inside);
        // What is left of the band around 0 is 0.
        let at = if at < 1e-6 * self.natural { 0.0 } else { at };
        self.told(trial, setting, at)
    }

    /// A value with its mechanism, or without one where none is proved.
    pub fn told(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, at: f64) -> Margin {
        let mechanism = self.beyond(trial, setting, at).unwrap_or_default();
        Margin::Value { at, mechanism }
    }

    /// The mechanism just beyond an edge: at the nearest of growing steps where there is a proved one. Empty at a least
    /// value of 0.
    fn beyond(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        at: f64,
    ) -> Option<Vec<Motion>> {
        let mut step = Self::NEAR;
        while step < 0.5 {
            let outside = at + self.outward(at) * step;
            if outside < 0.0 || (outside > self.most && self.way == Way::Most) {
                break;
            }
            let (verdict, motion) = trial.judge(&setting(outside));
            if verdict == Verdict::Unstable {
                return Some(motion);
            }
            step *= Self::WIDER;
        }
        (at == 0.0 && self.way == Way::Least).then(Vec::new)
    }

    /// The size of an outward step of the whole value.
    fn outward(&self, at: f64) -> f64 {
        let size = if at > 0.0 { at } else { self.natural };
        match self.way {
            Way::Most => size,
            Way::Least => -size,
        }
    }
}
