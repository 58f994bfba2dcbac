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
//! mechanism of an end is the collapse mechanism just beyond it. A margin is an end of such an interval ([`Margins`]).

mod interval;
mod kind;
mod trial;
mod path;
mod search;
mod margins;
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
pub use interval::{End, Exclusion, Interval};
pub use kind::{MarginKind, MarginKinds};
pub use margins::{Margin, Margins};
pub(super) use parameter::{MAX_ROBOTS, largest_load_factor};
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
        Interval::of_verdict(self.findings.verdict, &self.findings.mechanism, all)
    }
}

/// Computes the margins of a frame from its components. Also returns how many components with changed parameters were
/// evaluated for this.
///
/// 1. Find the intervals of the components whose intervals are not known from an earlier frame.
/// 2. Intersect them: a frame stands if all its components stand.
/// 3. If the frame does not stand, search for the tilt nearest to 0 at which it stands. This needs verdicts of the
///    whole frame.
pub(super) fn find_margins(parts: &[Part], kinds: MarginKinds, known: &mut BTreeMap<Key, Margins>) -> (Margins, usize) {
    let all_stand = parts.iter().all(Part::stands);
    let has_tilt = kinds.has(MarginKind::Tilt);
    // Step 1.
    let mut decided_count = find_fresh_intervals(parts, kinds, has_tilt && all_stand, known);
    let components: Vec<(&Part, &Margins)> =
        parts.iter().filter_map(|part| Some((part, known.get(part.key)?))).collect();
    // Step 2.
    let mut margins = intersect(&components, kinds);
    // Step 3.
    if has_tilt && !all_stand {
        let mut trials: Vec<Trial> = parts.iter().map(Part::trial).collect();
        let interval = nearest_tilts(&mut trials);
        margins.each.iter_mut().filter(|m| m.kind == MarginKind::Tilt).for_each(|m| m.interval = interval.clone());
        decided_count += trials.iter().map(|trial| trial.decided_count).sum::<usize>();
    }
    // If loads are listed or a robot has a finite limit, the frame may stand in several separate ranges of tilt. A note
    // then says so.
    let is_cone = |part: &Part| !trial::is_loaded(part.component) && !trial::is_limited(part.component);
    if let Some(Interval::Between { .. }) = margins.of(MarginKind::Tilt)
        && !components.iter().all(|(part, _)| is_cone(part))
    {
        margins.notes.push(ONE_ARC.into());
    }
    (margins, decided_count)
}

/// Computes the intervals of the components that are missing in `known`, and adds the intervals to `known`. Returns how
/// many components with changed parameters were evaluated for this.
fn find_fresh_intervals(
    parts: &[Part],
    kinds: MarginKinds,
    with_tilt: bool,
    known: &mut BTreeMap<Key, Margins>,
) -> usize {
    let is_known = |key: &Key| {
        let found = known.get(key);
        found.is_some_and(|found| found.of(MarginKind::Tilt).is_some() || !with_tilt)
    };
    let fresh = parts.iter().filter(|part| !is_known(part.key));
    let fresh: Vec<&Part> = fresh.collect();
    #[cfg(feature = "parallel")]
    let each = fresh.par_iter();
    #[cfg(not(feature = "parallel"))]
    let each = fresh.iter();
    // A deadline guard applies only to the thread that creates it, so each task creates one.
    let deadline = deadline();
    let fresh_margins: Vec<(Key, Margins, usize)> = each
        .map(|part| {
            let _guard = DeadlineGuard::new(deadline);
            let mut trial = part.trial();
            let margins = parameter::margins(&mut trial, part.stands(), kinds, with_tilt);
            (part.key.clone(), margins, trial.decided_count)
        })
        .collect();
    let mut decided_count = 0;
    for (key, margins, tries) in fresh_margins {
        known.insert(key, margins);
        decided_count += tries;
    }
    decided_count
}

/// Returns the interval of tilts at which a frame stands, in degrees, for a frame that does not stand without tilt. If
/// there are several such intervals, it returns the interval nearest to 0.
fn nearest_tilts(trials: &mut [Trial]) -> Interval {
    let Some(path) = trials.first().map(|trial| MarginKind::Tilt.path(trial)) else {
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

/// Returns the margins of a frame: its intervals are the intersections of the intervals of its components.
fn intersect(components: &[(&Part, &Margins)], kinds: MarginKinds) -> Margins {
    let margin = |kind: MarginKind| {
        let all = || if kind.is_signed() { Interval::UNBOUNDED } else { Interval::FROM_ZERO };
        // Some parameters have a meaning only for some components. Another component stands at every value or at none.
        let is_partial = kind.about().applies.is_some();
        let applies =
            |(part, _): &(&Part, &Margins)| kind.about().applies.is_none_or(|applies| applies(part.component));
        let has_meaning = !is_partial || components.iter().any(applies);
        let each = components.iter().filter_map(|(part, own)| match own.of(kind) {
            None => is_partial.then(|| part.at_present(all())),
            known => known.cloned(),
        });
        let interval = (kinds.has(kind) && has_meaning).then(|| each.fold(all(), Interval::intersection))?;
        Some(Margin::new(kind, None, interval))
    };
    let each = MarginKind::of_frame().filter_map(margin).chain(robots(components)).collect();
    Margins { kinds, each, notes: Vec::new() }
}

/// The note on the interval of tilts of frames that may stand in several separate ranges of tilt.
const ONE_ARC: &str = "tilt: listed loads and robots' limits do not turn with gravity, so the frame may stand at other \
                       tilts too; this interval contains 0, or is the nearest one to 0 if the frame falls without tilt";

/// Returns the margins of the limits of all robots. The intervals of a robot are empty if a component that it does
/// not hold falls, because no limit of this robot prevents that fall.
fn robots(components: &[(&Part, &Margins)]) -> Vec<Margin> {
    let mut robots = Vec::new();
    for (number, (_, own)) in components.iter().enumerate() {
        for margin in own.each.iter().filter(|margin| margin.limit.is_some()) {
            let others = components.iter().enumerate().filter(|(k, _)| *k != number);
            let others = others.map(|(_, (part, _))| part.at_present(Interval::UNBOUNDED));
            let interval = others.fold(margin.interval.clone(), Interval::intersection);
            robots.push(Margin { interval, ..margin.clone() });
        }
    }
    // Sort by robot, which is also the order of the holds in a frame.
    robots.sort_by_key(|margin| margin.limit.map(|limit| limit.0));
    robots
}
