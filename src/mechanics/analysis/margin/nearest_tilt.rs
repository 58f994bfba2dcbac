//! Finds the tilt of gravity nearest to 0 at which a frame stands, for a frame that falls without tilt.
//!
//! The mechanism of a tilt excludes an arc of tilts. Arc by arc the excluded range around 0 grows, until the frame
//! stands at one of its ends or until the range is a full turn.

use super::exclusion::{Exclusion, fewest_arcs};
use super::interval::Interval;
use super::tilt::{FAR, MAX_CUTS, MIN_GAP, around, cut, size, steps, turned};
use super::trial::Trial;
use crate::analysis::Verdict;
use crate::analysis::decide::Place;

/// If a cut gains less than this, relative to the tilt, the search looks ahead by [`AHEAD`] times the gain. Cuts
/// whose mechanisms change a little each time can gain less and less: a fifteenth less each time for a lintel that a
/// load pulls off its posts.
const SLOW: f64 = 1e-2;
/// How far the search looks ahead, as a multiple of the gain.
const AHEAD: f64 = 16.0;
/// Returns the interval of tilts at which a frame stands, in degrees, for a frame that falls without tilt. If there are
/// several such intervals, it returns the interval nearest to 0.
pub(super) fn nearest(trials: &mut [Trial]) -> Interval {
    match first_standing(trials) {
        Err(interval) => interval,
        Ok(turn) => {
            let each = trials.iter_mut().map(|trial| around(trial, turn));
            each.fold(Interval::UNBOUNDED, Interval::intersection)
        }
    }
}

/// Finds the tilt nearest to 0 at which all components stand, in degrees. Each mechanism excludes an arc of tilts
/// around 0; the search goes on from the nearer end of the excluded range. If no tilt is found, the error is the
/// interval: empty or undecided.
fn first_standing(trials: &mut [Trial]) -> Result<f64, Interval> {
    let mut excluded = Excluded::default();
    let mut turn = 0.0;
    'cuts: for _ in 0..MAX_CUTS {
        let outward = if turn < 0.0 { -1.0 } else { 1.0 };
        // The verdict may be undecided exactly at the end of the excluded range, so also try tilts slightly beyond it.
        let far = std::iter::successors(Some(0.01), |step| Some(step * 4.0));
        let steps = std::iter::once(0.0)
            .chain(steps())
            .chain(far.take_while(|step| *step < 1.0))
            .map(|step| turn + outward * step * size(turn));
        for at in steps {
            match judged_together(trials, at) {
                Together::Stands => return Ok(at),
                Together::Undecided => {}
                Together::Falls(arc) => {
                    excluded.add(arc);
                    // Enlarge the excluded range by a small step, in case the arc does not enlarge it.
                    if outward > 0.0 {
                        excluded.high = excluded.high.max(at + MIN_GAP);
                    } else {
                        excluded.low = excluded.low.min(at - MIN_GAP);
                    }
                    if excluded.is_full_turn() {
                        return Err(excluded.interval());
                    }
                    let next = excluded.nearest_end();
                    let gain = (next - turn) * outward;
                    turn = next;
                    if (0.0..SLOW * size(turn)).contains(&gain) {
                        let ahead = turn + AHEAD * outward * gain;
                        match judged_together(trials, ahead) {
                            Together::Stands => return Ok(ahead),
                            Together::Falls(arc) if excluded.meets(&arc) => {
                                excluded.add(arc);
                                turn = excluded.nearest_end();
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

/// The tilts around 0 that mechanisms exclude, in degrees.
#[derive(Default)]
struct Excluded {
    low: f64,
    high: f64,
    arcs: Vec<Exclusion>,
    /// Whether it covers tilts at which no verdict was reached.
    has_gaps: bool,
}

impl Excluded {
    /// Adds an arc to the excluded range. Tilts between the range and the arc are also excluded: their verdicts were
    /// undecided.
    fn add(&mut self, arc: Exclusion) {
        let from = arc.from.unwrap_or(f64::NEG_INFINITY);
        let to = arc.to.unwrap_or(f64::INFINITY);
        self.has_gaps |= from > self.high + gap(self.high) || to < self.low - gap(self.low);
        (self.low, self.high) = (self.low.min(from), self.high.max(to));
        self.arcs.push(arc);
    }

    fn meets(&self, arc: &Exclusion) -> bool {
        arc.from.is_some_and(|from| from <= self.high) && arc.to.is_some_and(|to| to >= self.low)
    }

    fn is_full_turn(&self) -> bool {
        self.high - self.low >= 360.0
    }

    /// Returns the end of the excluded range that is nearer to 0, in degrees.
    fn nearest_end(&self) -> f64 {
        if self.high <= -self.low {
            self.high
        } else {
            self.low
        }
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
        Interval::Empty(fewest_arcs(&self.arcs, gap))
    }
}

/// Returns the largest gap, in degrees, between two arcs near the tilt `turn` that still count as joined. Verdicts
/// cannot resolve smaller gaps.
fn gap(turn: f64) -> f64 {
    FAR * size(turn)
}

/// The verdict of a whole frame at a tilt.
enum Together {
    Stands,
    Undecided,
    /// It falls at these tilts by one mechanism.
    Falls(Exclusion),
}

/// Returns the verdict of the whole frame with gravity tilted by `turn` degrees. If the frame falls, also returns the
/// tilts at which its mechanism proves the fall.
fn judged_together(trials: &mut [Trial], turn: f64) -> Together {
    let mut together = Together::Stands;
    for trial in trials {
        let (found, motion) = trial.judge_at(&turned(turn, 1.0), Place::AtEdge);
        match found {
            Verdict::Stable => {}
            Verdict::Undecided => together = Together::Undecided,
            Verdict::Unstable => {
                let arc = cut(trial, turn, &motion);
                return Together::Falls(Exclusion {
                    from: arc.map(|[from, _]| from),
                    to: arc.map(|[_, to]| to),
                    mechanism: motion,
                });
            }
        }
    }
    together
}
