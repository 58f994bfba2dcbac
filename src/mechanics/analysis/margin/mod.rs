//! [`Margins`]: how far a frame is from collapse. For friction, tilt, loads, kernel and robot limits, this module
//! computes the range of values at which the frame stands.
//!
//! The balance equations are linear in the forces, in a factor on loads and in a horizontal fraction of the weights.
//! The bounds on forces are linear in a robot's limit. More friction and a smaller kernel only add admissible forces.
//! For each of these parameters, the values at which a frame stands form an [`Interval`]. A frame stands if all its
//! components stand: its interval is the intersection of theirs.
//!
//! [`path`] says how a component changes with a parameter. [`search`] finds an end from a prediction and confirms it by
//! verdicts, and [`nearest`] finds the first value at which a frame stands. If the forces depend linearly on a parameter,
//! one linear program gives the prediction ([`parameter`]); this includes the limits of robots. For friction and kernel,
//! Newton's method gives it ([`mod@threshold`]).
//! An end is accepted only if it is proved that the changed frame stands just inside it and falls just beyond it. The
//! mechanism of an end is the collapse mechanism just beyond it. [`Margins`] are derived from the intervals.

mod interval;
mod kind;
mod margins;
mod trial;
mod path;
mod search;
mod nearest;
mod threshold;
mod parameter;

use std::collections::BTreeMap;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::Verdict;
use super::decide::Outcome;
use super::frame::Key;
use crate::mechanics::solve::{DeadlineGuard, deadline};
use crate::mechanics::statics::assembly::Assembly;
pub(super) use interval::END_TOL;
pub use interval::Exclusion;
pub use interval::{End, Interval, Intervals, RobotIntervals};
pub use kind::{MarginKind, MarginKinds};
pub use margins::{Margin, Margins, RobotMargins, Sides};
pub(super) use parameter::{MAX_ROBOTS, largest_load_factor};
use path::Path;
use trial::Trial;
pub use trial::trials;
pub(super) use trial::{LimitChange, Setting};

/// One component whose margins are computed.
pub(super) struct Part<'a> {
    pub component: &'a Assembly,
    pub key: &'a Key,
    pub findings: &'a Outcome,
}

impl Part<'_> {
    fn stands(&self) -> bool {
        self.findings.verdict == Verdict::Stable
    }

    fn trial(&self) -> Trial<'_> {
        let forces = self.stands().then_some(&self.findings.forces);
        Trial::new(self.component, forces)
    }

    /// Returns the interval for a parameter that does not affect this component: `all` if the component stands, the
    /// empty interval if it falls, otherwise undecided.
    fn at_present(&self, all: Interval) -> Interval {
        match self.findings.verdict {
            Verdict::Stable => all,
            Verdict::Unstable => Interval::excluded_by(self.findings.mechanism.clone()),
            Verdict::Undecided => Interval::Undecided,
        }
    }
}

/// Computes the margins of a frame from its components. Also returns how many components with changed parameters were
/// evaluated for this.
///
/// 1. Find the intervals of the components whose intervals are not known from an earlier frame.
/// 2. Intersect them: a frame stands if all its components stand.
/// 3. If the frame does not stand, search for the tilt nearest to 0 at which it stands. This needs verdicts of the
///    whole frame.
pub(super) fn find_margins(
    parts: &[Part],
    kinds: MarginKinds,
    known: &mut BTreeMap<Key, Intervals>,
) -> (Margins, usize) {
    let all_stand = parts.iter().all(Part::stands);
    let has_tilt = kinds.has(MarginKind::Tilt);
    // Step 1.
    let mut decided_count = find_fresh_intervals(parts, kinds, has_tilt && all_stand, known);
    let components: Vec<(&Part, &Intervals)> =
        parts.iter().filter_map(|part| Some((part, known.get(part.key)?))).collect();
    // Step 2.
    let mut intervals = intersect(&components, kinds);
    // Step 3.
    if has_tilt && !all_stand {
        let mut trials: Vec<Trial> = parts.iter().map(Part::trial).collect();
        intervals.tilt = Some(nearest_tilts(&mut trials));
        decided_count += trials.iter().map(|trial| trial.decided_count).sum::<usize>();
    }
    // If loads are listed or a robot has a finite limit, the frame may stand in several separate ranges of tilt. A note
    // then says so.
    let is_cone = |part: &Part| !trial::is_loaded(part.component) && !trial::is_limited(part.component);
    if let Some(Interval::Between { .. }) = intervals.tilt
        && !components.iter().all(|(part, _)| is_cone(part))
    {
        intervals.notes.push(ONE_ARC.into());
    }
    (Margins::new(intervals, kinds), decided_count)
}

/// Returns the interval of the load factor or of the friction at which an assembly stands.
pub(super) fn interval_of(assembly: &Assembly, kind: MarginKind) -> Interval {
    let each = assembly.components().into_iter().map(|component| {
        let mut trial = Trial::new(&component, None);
        let (verdict, motion) = trial.decide(&Setting::default());
        let stands = verdict == Verdict::Stable;
        let own = parameter::intervals(&mut trial, stands, MarginKinds::new(&[kind]), false);
        // A component without loads stands at every factor or at none.
        own.of(kind).cloned().unwrap_or(match verdict {
            Verdict::Stable => Interval::UNBOUNDED,
            Verdict::Unstable => Interval::excluded_by(motion),
            Verdict::Undecided => Interval::Undecided,
        })
    });
    each.fold(Interval::Between { low: End::natural(0.0), high: End::Unbounded }, Interval::intersection)
}

/// Computes the intervals of the components that are missing in `known`, and adds the intervals to `known`. Returns how
/// many components with changed parameters were evaluated for this.
fn find_fresh_intervals(
    parts: &[Part],
    kinds: MarginKinds,
    with_tilt: bool,
    known: &mut BTreeMap<Key, Intervals>,
) -> usize {
    let is_known = |key: &Key| {
        let found = known.get(key);
        found.is_some_and(|found| found.tilt.is_some() || !with_tilt)
    };
    let fresh = parts.iter().filter(|part| !is_known(part.key));
    let fresh: Vec<&Part> = fresh.collect();
    #[cfg(feature = "parallel")]
    let each = fresh.par_iter();
    #[cfg(not(feature = "parallel"))]
    let each = fresh.iter();
    // A deadline guard applies only to the thread that creates it, so each task creates one.
    let deadline = deadline();
    let fresh_intervals: Vec<(Key, Intervals, usize)> = each
        .map(|part| {
            let _guard = DeadlineGuard::new(deadline);
            let mut trial = part.trial();
            let intervals = parameter::intervals(&mut trial, part.stands(), kinds, with_tilt);
            (part.key.clone(), intervals, trial.decided_count)
        })
        .collect();
    let mut decided_count = 0;
    for (key, intervals, tries) in fresh_intervals {
        known.insert(key, intervals);
        decided_count += tries;
    }
    decided_count
}

/// Returns the interval of tilts at which a frame stands, in degrees, for a frame that does not stand without tilt. If
/// there are several such intervals, it returns the interval nearest to 0.
fn nearest_tilts(trials: &mut [Trial]) -> Interval {
    let Some(path) = trials.first().map(|trial| Path::of(MarginKind::Tilt, trial)) else {
        return Interval::UNBOUNDED;
    };
    match path.nearest(trials, 0.0, None) {
        Err(interval) => interval,
        Ok(tilt) => {
            let each = trials.iter_mut().map(|trial| parameter::tilts_around(trial, tilt));
            each.fold(Interval::UNBOUNDED, Interval::intersection)
        }
    }
}

/// Returns the intervals of a frame, which are the intersections of the intervals of its components.
fn intersect(components: &[(&Part, &Intervals)], kinds: MarginKinds) -> Intervals {
    let from_zero = || Interval::Between { low: End::natural(0.0), high: End::Unbounded };
    let intersection = |kind: MarginKind| {
        let all = if matches!(kind, MarginKind::Tilt | MarginKind::HorizontalLoad) {
            Interval::UNBOUNDED
        } else {
            from_zero()
        };
        // The load factor has a meaning only if some component is loaded. A component without loads stands at every
        // factor or at none.
        let is_factor = kind == MarginKind::LoadFactor;
        let has_meaning = !is_factor || components.iter().any(|(_, own)| own.of(kind).is_some());
        let each = components.iter().filter_map(|(part, own)| match own.of(kind) {
            None => is_factor.then(|| part.at_present(from_zero())),
            known => known.cloned(),
        });
        (kinds.has(kind) && has_meaning).then(|| each.fold(all, Interval::intersection))
    };
    Intervals {
        friction: intersection(MarginKind::Friction),
        tilt: intersection(MarginKind::Tilt),
        horizontal_load: intersection(MarginKind::HorizontalLoad),
        kernel: intersection(MarginKind::Kernel),
        load_factor: intersection(MarginKind::LoadFactor),
        robots: robots(components),
        notes: Vec::new(),
    }
}

/// The note on the interval of tilts of frames that may stand in several separate ranges of tilt.
const ONE_ARC: &str = "tilt: listed loads and robots' limits do not turn with gravity, so the frame may stand at other \
                       tilts too; this interval contains 0, or is the nearest one to 0 if the frame falls without tilt";

/// Returns the intervals of the limits of all robots. The intervals of a robot are empty if a component that it does
/// not hold falls, because no limit of this robot prevents that fall.
fn robots(components: &[(&Part, &Intervals)]) -> Vec<RobotIntervals> {
    let mut robots = Vec::new();
    for (number, (_, intervals)) in components.iter().enumerate() {
        let others = || components.iter().enumerate().filter(|(k, _)| *k != number);
        for robot in &intervals.robots {
            let with_others = |own: &Interval| {
                others()
                    .fold(own.clone(), |frame, (_, (part, _))| frame.intersection(part.at_present(Interval::UNBOUNDED)))
            };
            robots.push(RobotIntervals {
                robot: robot.robot,
                fx: with_others(&robot.fx),
                fy: with_others(&robot.fy),
                torque: with_others(&robot.torque),
            });
        }
    }
    // Sort by robot, which is also the order of the holds in a frame.
    robots.sort_by_key(|robot| robot.robot);
    robots
}
