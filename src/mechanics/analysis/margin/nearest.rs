//! Finds the value of a parameter nearest to the present one at which a frame stands, if it falls at the present value.
//!
//! A mechanism found at one value proves that the frame falls in a whole range of values. Each such range enlarges the
//! excluded range around the present value, until the frame stands at one end of it or all values are excluded.

use super::interval::{END_TOL, Exclusion, Interval, fewest_arcs};
use super::path::{MAX_VALUE, Path, Predictor};
use super::search::{CONFIRMATION_TOL, MAX_STEPS, MIN_ARC, offsets};
use super::trial::Trial;
use crate::mechanics::analysis::Verdict;

/// If a step among tilts enlarges the excluded range by less than this, relative to the tilt, the search looks ahead
/// by [`LOOKAHEAD_FACTOR`] times this gain. If the mechanism changes slightly from step to step, the gain can shrink
/// each time: by a fifteenth for a lintel that a load pulls off its posts.
const SLOW_GAIN: f64 = 1e-2;
/// How far the search looks ahead, as a multiple of the gain.
const LOOKAHEAD_FACTOR: f64 = 16.0;
/// The tilt at which two excluded arcs meet is rounded to a multiple of this, degrees. It is a power of 2, so that 180° is
/// such a multiple, and it changes the loads by less than the tolerance of the proofs.
const MEETING_ROUNDING: f64 = 1.0 / 16_777_216.0;

impl Path<'_> {
    /// Finds the value nearest to `present` at which all components stand. `hint` is this value according to a linear
    /// program. If no value is found, the `Err` contains the interval: empty if mechanisms exclude all values, otherwise
    /// undecided.
    pub fn nearest(&self, trials: &mut [Trial], present: f64, hint: Option<f64>) -> Result<f64, Interval> {
        let mut excluded = Excluded { low: present, high: present, ranges: Vec::new(), has_gaps: false };
        let (mut next, mut hint) = (present, hint);
        for _ in 0..MAX_STEPS {
            let values = self.values_near(next, present).into_iter();
            let mut values = values.filter(|at| excluded.allows(*at) && *at >= self.min_value);
            let found = values.find_map(|at| match self.decide_all(trials, at) {
                FrameVerdict::Undecided => None,
                found => Some((at, found)),
            });
            let (at, range) = match found {
                None => return Err(Interval::Undecided),
                Some((at, FrameVerdict::Falls(range))) => (at, range),
                Some((at, _)) => return Ok(at),
            };
            self.exclude(&mut excluded, range);
            if self.predictor == Predictor::Arc {
                // Even if the arc excludes nothing new, each step of the search excludes a little more.
                if next < present {
                    excluded.low = excluded.low.min(at - MIN_ARC);
                } else {
                    excluded.high = excluded.high.max(at + MIN_ARC);
                }
            }
            if self.is_everything(&excluded) {
                // The ends of the range may meet. At this one value the frame may stand.
                let mut meeting = self.meeting(&excluded).into_iter();
                let standing = meeting.find(|at| matches!(self.decide_all(trials, *at), FrameVerdict::Stands));
                return standing.ok_or_else(|| self.interval(excluded));
            }
            let nearest = excluded.nearest_end(present);
            if nearest == next && hint.is_none() {
                hint = self.least_near(next);
                if hint.is_none() {
                    break;
                }
            }
            let gain = (nearest - next).abs();
            let is_slow = gain < SLOW_GAIN * self.size(nearest) && (nearest < present) == (next < present);
            next = hint.take().filter(|hint| excluded.allows(*hint)).unwrap_or(nearest);
            if self.predictor == Predictor::Arc && is_slow {
                let ahead = next + LOOKAHEAD_FACTOR * gain.copysign(next - present);
                match self.decide_all(trials, ahead) {
                    FrameVerdict::Stands => return Ok(ahead),
                    FrameVerdict::Falls(arc) if excluded.meets(&arc) => {
                        self.exclude(&mut excluded, arc);
                        next = excluded.nearest_end(present);
                    }
                    _ => {}
                }
            }
        }
        Err(Interval::Undecided)
    }

    /// Returns a value, and values near it, which are tried if the verdict at the value itself is undecided.
    fn values_near(&self, value: f64, present: f64) -> Vec<f64> {
        let is_arc = self.predictor == Predictor::Arc;
        let far = std::iter::successors(Some(0.01), |step| Some(step * 4.0)).take_while(|step| is_arc && *step < 1.0);
        let outward = if value < present { -1.0 } else { 1.0 };
        let sides: &[f64] = if is_arc { &[outward] } else { &[outward, -outward] };
        let steps = offsets(END_TOL).chain(far).flat_map(|step| sides.iter().map(move |side| side * step));
        let near = std::iter::once(0.0).chain(steps).map(|step| value + step * self.size(value));
        near.chain(self.least_near(value)).collect()
    }

    /// Returns the least meaningful value, if `value` is hardly larger than it: all values between the two may be
    /// undecided, or fall by rounding only.
    fn least_near(&self, value: f64) -> Option<f64> {
        let distance = value - self.min_value;
        (distance > 0.0 && distance <= END_TOL * self.size(value)).then_some(self.min_value)
    }

    /// Adds a range to the excluded range. Values between the two are also excluded: their verdicts were undecided.
    fn exclude(&self, excluded: &mut Excluded, range: Exclusion) {
        let [from, to] = range.ends();
        let gap = |value: f64| CONFIRMATION_TOL * self.size(value);
        excluded.has_gaps |= from > excluded.high + gap(excluded.high) || to < excluded.low - gap(excluded.low);
        (excluded.low, excluded.high) = (excluded.low.min(from), excluded.high.max(to));
        excluded.ranges.push(range);
    }

    /// True if all values that are meaningful, and not extremely large, are excluded.
    fn is_everything(&self, excluded: &Excluded) -> bool {
        match self.predictor {
            Predictor::Arc => excluded.high - excluded.low >= 360.0,
            _ => {
                let most = MAX_VALUE * self.typical_large;
                excluded.low < self.min_value.max(-most) && excluded.high > most
            }
        }
    }

    /// Returns the interval if all values are excluded: empty, or undecided if the range contains values without a
    /// verdict.
    fn interval(&self, excluded: Excluded) -> Interval {
        let Excluded { ranges, has_gaps, .. } = excluded;
        if let Some(everywhere) = ranges.iter().find(|range| range.from.is_none() && range.to.is_none()) {
            return Interval::Empty(vec![everywhere.clone()]);
        }
        if has_gaps {
            return Interval::Undecided;
        }
        if self.predictor == Predictor::Arc {
            return Interval::Empty(fewest_arcs(&ranges, |tilt| CONFIRMATION_TOL * self.size(tilt)));
        }
        let below =
            ranges.iter().filter(|range| range.from.is_none()).max_by(|a, b| a.ends()[1].total_cmp(&b.ends()[1]));
        let above = ranges.iter().filter(|range| range.to.is_none()).min_by(|a, b| a.ends()[0].total_cmp(&b.ends()[0]));
        match (below, above) {
            // Values between the two have no verdict.
            (Some(below), Some(above)) if below.to <= above.from => Interval::Undecided,
            _ => Interval::Empty(below.into_iter().chain(above).cloned().collect()),
        }
    }

    /// If all values are excluded, returns the value at which the excluded ranges only touch, and values within rounding of
    /// it. Empty if the ranges overlap by more than rounding: mechanisms then exclude every value.
    fn meeting(&self, excluded: &Excluded) -> Vec<f64> {
        let first = excluded.ranges.iter().filter_map(|range| range.from).fold(f64::INFINITY, f64::min);
        let last = excluded.ranges.iter().filter_map(|range| range.to).fold(f64::NEG_INFINITY, f64::max);
        let is_arc = self.predictor == Predictor::Arc;
        let first = if is_arc { first + 360.0 } else { first };
        let middle = last + 0.5 * (first - last);
        let width = if is_arc { MIN_ARC } else { END_TOL * self.size(middle) };
        match middle.is_finite() && (first - last).abs() <= width {
            true if is_arc => vec![(middle / MEETING_ROUNDING).round() * MEETING_ROUNDING],
            true => vec![middle, first, last],
            false => Vec::new(),
        }
    }

    /// Returns the verdict on all components at a value. If one falls, also returns the values at which its mechanism
    /// proves the fall.
    fn decide_all(&self, trials: &mut [Trial], value: f64) -> FrameVerdict {
        let mut verdict = FrameVerdict::Stands;
        for trial in trials {
            match self.decide_at_limit(trial, value) {
                (Verdict::Stable, _) => {}
                (Verdict::Undecided, _) => verdict = FrameVerdict::Undecided,
                (Verdict::Unstable, mechanism) => {
                    let [from, to] =
                        self.excluded(trial, value, &mechanism).map(|end| Some(end).filter(|end| end.is_finite()));
                    return FrameVerdict::Falls(Exclusion { from, to, mechanism });
                }
            }
        }
        verdict
    }
}

/// The verdict on a whole frame at a value.
enum FrameVerdict {
    Stands,
    Undecided,
    /// The frame falls at these values by one mechanism.
    Falls(Exclusion),
}

/// The range of values around the present one that mechanisms exclude.
struct Excluded {
    low: f64,
    high: f64,
    ranges: Vec<Exclusion>,
    /// Whether the range contains values at which no verdict was reached.
    has_gaps: bool,
}

impl Excluded {
    fn allows(&self, value: f64) -> bool {
        value <= self.low || value >= self.high
    }

    fn meets(&self, arc: &Exclusion) -> bool {
        arc.from.is_some_and(|from| from <= self.high) && arc.to.is_some_and(|to| to >= self.low)
    }

    /// Returns the end of the excluded range that is nearer to the present value.
    fn nearest_end(&self, present: f64) -> f64 {
        if self.high - present <= present - self.low { self.high } else { self.low }
    }
}
