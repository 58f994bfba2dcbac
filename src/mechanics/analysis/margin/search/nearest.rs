//! Finds the value of a parameter nearest to its present value at which a component stands.

use super::{CONFIRMATION_TOL, END_TOL, ExcludedRange, MAX_STEPS, MAX_VALUE, OFFSET_GROWTH, Path};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::margin::exclusion::Exclusion;
use crate::mechanics::analysis::margin::interval::Interval;
use crate::mechanics::analysis::margin::trial::Trial;
use crate::mechanics::proof::Motion;

impl Path<'_> {
    /// Finds the value nearest to `present` at which the component stands, although it falls at `present`. `hint` is
    /// this value according to a linear program. If no value is found, the `Err` contains the interval: empty if
    /// mechanisms exclude all values, otherwise undecided.
    pub fn nearest(&self, trial: &mut Trial, present: f64, hint: Option<f64>) -> Result<f64, Interval> {
        let (mut low, mut high) = (self.min_value, f64::INFINITY);
        // `below` excludes all values below `low`, and `above` excludes all values above `high`.
        let [mut below, mut above] = [None, None];
        let limit = MAX_VALUE * self.typical_large;
        let mut next = Some(present);
        let mut hinted = hint;
        for _ in 0..MAX_STEPS {
            let value = match next.take() {
                Some(value) => value,
                None => {
                    let within = |value: &f64| (low..=high).contains(value);
                    hinted.take().filter(within).unwrap_or(present.clamp(low, high))
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
    fn decide_near(&self, trial: &mut Trial, value: f64, [low, high]: [f64; 2]) -> (Verdict, f64, Vec<Motion>) {
        let steps = std::iter::successors(Some(END_TOL), |step| Some(step * OFFSET_GROWTH))
            .take_while(|step| *step <= CONFIRMATION_TOL);
        let away = steps.flat_map(|step| [step, -step]).map(|step| value + step * self.size(value));
        let mut last = Vec::new();
        // If the range from `low` to `high` is hardly wider than rounding errors, it may contain none of the values to
        // try. Therefore also try its ends if they are near.
        let is_near = |end: &f64| (end - value).abs() <= END_TOL * self.size(value);
        let ends = [low, high].into_iter().filter(is_near);
        let away = away.filter(|at| (low..=high).contains(at));
        for at in std::iter::once(value).chain(away).chain(ends) {
            let (verdict, motion) = self.decide_at_limit(trial, at);
            if verdict != Verdict::Undecided {
                return (verdict, at, motion);
            }
            last = motion;
        }
        (Verdict::Undecided, value, last)
    }
}
