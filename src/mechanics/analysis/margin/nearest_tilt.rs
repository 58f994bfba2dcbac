//! Finds the tilt of gravity nearest to 0 at which a frame stands, for a frame that does not stand without tilt.
//!
//! A mechanism found at one tilt proves that the frame falls at all tilts in an arc. Each such arc enlarges the
//! excluded range around 0, until the frame stands at one end of the range or the range is a full turn.

use super::interval::{Exclusion, Interval, fewest_arcs};
use super::search::CONFIRMATION_TOL;
use super::tilt::{MAX_CUTS, MIN_ARC, around, excluded_arc, offsets, tilt_scale, tilted};
use super::trial::Trial;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::LimitDistance;

/// If a step of the search enlarges the excluded range by less than this, relative to the tilt, the search looks ahead
/// by [`LOOKAHEAD_FACTOR`] times this gain. If the mechanism changes slightly from step to step, the gain can shrink
/// each time: by a fifteenth for a lintel that a load pulls off its posts.
const SLOW_GAIN: f64 = 1e-2;
/// How far the search looks ahead, as a multiple of the gain.
const LOOKAHEAD_FACTOR: f64 = 16.0;
/// The tilt at which two excluded arcs meet is rounded to a multiple of this, degrees. It is a power of 2, so that 180° is
/// such a multiple, and it changes the loads by less than the tolerance of the proofs.
const MEETING_ROUNDING: f64 = 1.0 / 16_777_216.0;
/// Returns the interval of tilts at which a frame stands, in degrees, for a frame that does not stand without tilt. If
/// there are several such intervals, it returns the interval nearest to 0.
pub(super) fn nearest_stable_tilts(trials: &mut [Trial]) -> Interval {
    match first_standing(trials) {
        Err(interval) => interval,
        Ok(tilt) => {
            let each = trials.iter_mut().map(|trial| around(trial, tilt));
            each.fold(Interval::UNBOUNDED, Interval::intersection)
        }
    }
}

/// Finds the tilt nearest to 0 at which all components stand, in degrees. Each mechanism excludes an arc of tilts. The
/// search continues from the end of the excluded range that is nearer to 0. If no tilt is found, the `Err` contains the
/// interval: empty or undecided.
fn first_standing(trials: &mut [Trial]) -> Result<f64, Interval> {
    let mut excluded = Excluded::default();
    let mut tilt = 0.0;
    'cuts: for _ in 0..MAX_CUTS {
        let outward = if tilt < 0.0 { -1.0 } else { 1.0 };
        // The verdict may be undecided exactly at the end of the excluded range, so also try tilts slightly beyond it.
        let far = std::iter::successors(Some(0.01), |step| Some(step * 4.0));
        let steps = std::iter::once(0.0)
            .chain(offsets())
            .chain(far.take_while(|step| *step < 1.0))
            .map(|step| tilt + outward * step * tilt_scale(tilt));
        for at in steps {
            match decide_frame(trials, at) {
                FrameVerdict::Stands => return Ok(at),
                FrameVerdict::Undecided => {}
                FrameVerdict::Falls(arc) => {
                    excluded.add(arc);
                    // Enlarge the excluded range by a small step, in case the arc does not enlarge it.
                    if outward > 0.0 {
                        excluded.high = excluded.high.max(at + MIN_ARC);
                    } else {
                        excluded.low = excluded.low.min(at - MIN_ARC);
                    }
                    if excluded.is_full_turn() {
                        // The ends of the range meet. At this one tilt the frame may stand.
                        return match excluded.meeting_tilt() {
                            Some(at) if matches!(decide_frame(trials, at), FrameVerdict::Stands) => Ok(at),
                            _ => Err(excluded.interval()),
                        };
                    }
                    let next = excluded.nearest_end();
                    let gain = (next - tilt) * outward;
                    tilt = next;
                    if (0.0..SLOW_GAIN * tilt_scale(tilt)).contains(&gain) {
                        let ahead = tilt + LOOKAHEAD_FACTOR * outward * gain;
                        match decide_frame(trials, ahead) {
                            FrameVerdict::Stands => return Ok(ahead),
                            FrameVerdict::Falls(arc) if excluded.meets(&arc) => {
                                excluded.add(arc);
                                tilt = excluded.nearest_end();
                            }
                            _ => {}
                        }
                    }
                    continue 'cuts;
                }
            }
        }
        return Err(Interval::Undecided);
    }
    Err(Interval::Undecided)
}

/// The range of tilts around 0 that mechanisms exclude, in degrees.
#[derive(Default)]
struct Excluded {
    low: f64,
    high: f64,
    arcs: Vec<Exclusion>,
    /// Whether the range contains tilts at which no verdict was reached.
    has_gaps: bool,
}

impl Excluded {
    /// Adds an arc to the excluded range. Tilts between the range and the arc are also excluded: their verdicts were
    /// undecided.
    fn add(&mut self, arc: Exclusion) {
        let from = arc.from.unwrap_or(f64::NEG_INFINITY);
        let to = arc.to.unwrap_or(f64::INFINITY);
        self.has_gaps |= from > self.high + max_joined_gap(self.high) || to < self.low - max_joined_gap(self.low);
        (self.low, self.high) = (self.low.min(from), self.high.max(to));
        self.arcs.push(arc);
    }

    fn meets(&self, arc: &Exclusion) -> bool {
        arc.from.is_some_and(|from| from <= self.high) && arc.to.is_some_and(|to| to >= self.low)
    }

    fn is_full_turn(&self) -> bool {
        self.high - self.low >= 360.0
    }

    /// Returns the tilt at which the ends of a range of a full turn meet, in degrees, without the rounding of the ends.
    /// `None` if the ends overlap, so that mechanisms exclude every tilt.
    fn meeting_tilt(&self) -> Option<f64> {
        let first = self.arcs.iter().filter_map(|arc| arc.from).fold(f64::INFINITY, f64::min);
        let last = self.arcs.iter().filter_map(|arc| arc.to).fold(f64::NEG_INFINITY, f64::max);
        let gap = first + 360.0 - last;
        let middle = last + 0.5 * gap;
        (gap.abs() <= MIN_ARC).then(|| (middle / MEETING_ROUNDING).round() * MEETING_ROUNDING)
    }

    /// Returns the end of the excluded range that is nearer to 0, in degrees.
    fn nearest_end(&self) -> f64 {
        if self.high <= -self.low { self.high } else { self.low }
    }

    /// Returns the interval of stable tilts if the excluded range is a full turn: empty, or undecided if the range
    /// contains tilts without a verdict.
    fn interval(self) -> Interval {
        let everywhere = self.arcs.iter().find(|arc| arc.from.is_none());
        if let Some(motion) = everywhere {
            return Interval::Empty(vec![motion.clone()]);
        }
        if self.has_gaps {
            return Interval::Undecided;
        }
        Interval::Empty(fewest_arcs(&self.arcs, max_joined_gap))
    }
}

/// Returns the largest gap, in degrees, between two arcs near `tilt` that still count as joined. Verdicts
/// cannot resolve smaller gaps.
fn max_joined_gap(tilt: f64) -> f64 {
    CONFIRMATION_TOL * tilt_scale(tilt)
}

/// The verdict of a whole frame at a tilt.
enum FrameVerdict {
    Stands,
    Undecided,
    /// The frame falls at these tilts by one mechanism.
    Falls(Exclusion),
}

/// Returns the verdict of the whole frame with gravity tilted by `tilt` degrees. If the frame falls, also returns the
/// tilts at which its mechanism proves the fall.
fn decide_frame(trials: &mut [Trial], tilt: f64) -> FrameVerdict {
    let mut verdict = FrameVerdict::Stands;
    for trial in trials {
        let (found, motion) = trial.decide_at(&tilted(tilt, 1.0), LimitDistance::AtLimit);
        match found {
            Verdict::Stable => {}
            Verdict::Undecided => verdict = FrameVerdict::Undecided,
            Verdict::Unstable => {
                let arc = excluded_arc(trial, tilt, &motion);
                return FrameVerdict::Falls(Exclusion {
                    from: arc.map(|[from, _]| from),
                    to: arc.map(|[_, to]| to),
                    mechanism: motion,
                });
            }
        }
    }
    verdict
}
