//! [`Edge`]: between a value at which a group stands and one at which it falls.
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

/// Whether a group's margin is worse than what is known of the frame.
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
    /// The size of an ordinary value.
    pub natural: f64,
    /// The largest value that is tried.
    pub most: f64,
}

impl Edge {
    /// How far inside an edge it must stand, and from how far beyond it may be shown to fall; relative.
    const NEAR: f64 = 1e-6;

    /// A value, if the group stands just inside it and falls just beyond.
    pub fn confirmed(
        &self,
        trial: &mut Trial,
        setting: &dyn Fn(f64) -> Setting,
        at: f64,
    ) -> Option<Margin> {
        let at = if at < 1e-9 * self.natural { 0.0 } else { at };
        let inside = at - self.outward(at) * Self::NEAR;
        if trial.judge(&setting(inside.max(0.0))).0 != Verdict::Stable {
            return None;
        }
        let mechanism = self.beyond(trial, setting, at)?;
        Some(Margin::Value { at, mechanism })
    }

    /// The edge between 0 and `most`, found by halving.
    pub fn searched(&self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting) -> Margin {
        let mut stands = |at: f64| trial.judge(&setting(at)).0 == Verdict::Stable;
        let (mut inside, mut outside) = match (self.way, stands(0.0)) {
            (Way::Most, false) => return Margin::None,
            (Way::Least, true) => {
                return Margin::Value {
                    at: 0.0,
                    mechanism: Vec::new(),
                };
            }
            (way, _) => {
                let (mut near, mut far) = (0.0, self.natural.min(self.most));
                // Large steps outward, as long as the answer is that at 0.
                while stands(far) == (way == Way::Most) {
                    if far >= self.most {
                        return if way == Way::Most {
                            Margin::Unbounded
                        } else {
                            Margin::None
                        };
                    }
                    (near, far) = (far, (far * 10.0).min(self.most));
                }
                match way {
                    Way::Most => (near, far),
                    Way::Least => (far, near),
                }
            }
        };
        while (inside - outside).abs() > 1e-9 * inside.max(outside) + 1e-11 * self.natural {
            let middle = 0.5 * (inside + outside);
            if stands(middle) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        // What is left of the band around 0 is 0.
        let at = if inside < 1e-6 * self.natural {
            0.0
        } else {
            inside
        };
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
            step *= 4.0;
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
