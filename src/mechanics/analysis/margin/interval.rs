//! [`Interval`]: the values of one parameter at which a frame stands.
//!
//! Equilibrium is linear in the forces and in a factor on loads, so these values form a closed interval. A frame
//! stands if all its components stand: its interval is the intersection of theirs.
//!
//! [`Exclusion`]: a range of values of a parameter in which a frame falls by the same motion.
//!
//! If a frame stands at no value of a parameter, a few exclusions cover all values: one exclusion of all values, two
//! exclusions if two components stand only at different values, or arcs of tilts.

use std::cmp::Ordering;

use crate::mechanics::analysis::Verdict;
use crate::mechanics::proof::Motion;

/// The values of one parameter at which a frame stands. Both ends belong to the interval.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Interval {
    /// The frame stands at no value: together, these exclusions cover all values.
    Empty(Vec<Exclusion>),
    /// The frame stands at every value from the lower to the upper end.
    Between {
        /// The lower end.
        low: End,
        /// The upper end.
        high: End,
    },
    /// No verdict shows at which values the frame stands.
    Undecided,
}

/// One end of an [`Interval`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum End {
    /// The frame stands at every value in this direction.
    Unbounded,
    /// The frame stands at this value and falls just beyond it.
    At {
        /// The value, in the unit of the parameter.
        value: f64,
        /// How the blocks begin to move just beyond the end; empty if the range of the parameter ends here, such as
        /// friction at 0.
        mechanism: Vec<Motion>,
    },
    /// The end lies between two values. No values closer to the end were decided.
    Unconfirmed {
        /// A value at which the frame stands.
        stands: f64,
        /// A value at which the frame falls or is undecided.
        beyond: f64,
    },
}

impl End {
    /// Creates an end at the first or last possible value of a parameter, such as friction 0. The structure stands
    /// there, so the end has no mechanism.
    pub(super) const fn natural(value: f64) -> End {
        End::At { value, mechanism: Vec::new() }
    }

    /// Returns the value of this end. `None` if the interval is unbounded on this side, or if the end is not confirmed.
    pub fn value(&self) -> Option<f64> {
        match self {
            End::At { value, .. } => Some(*value),
            End::Unbounded | End::Unconfirmed { .. } => None,
        }
    }

    /// Returns the outermost value on this side at which the frame is known to stand. Returns `otherwise` if the
    /// interval is unbounded on this side.
    pub(in crate::mechanics::analysis) fn stands(&self, otherwise: f64) -> f64 {
        match self {
            End::At { value, .. } => *value,
            End::Unconfirmed { stands, .. } => *stands,
            End::Unbounded => otherwise,
        }
    }
}

/// An end is found if a stable and an unstable value are at most this far apart, relative to the end. Ends of two
/// components that differ by less are equal.
pub(in crate::mechanics::analysis) const END_TOL: f64 = 1e-6;

/// Ends that differ by at most this, relative to their size or a typical size of the parameter, differ only by the
/// rounding of the solver.
pub(super) const ROUNDING_TOL: f64 = 1e-9;

impl Interval {
    /// All values.
    pub(super) const UNBOUNDED: Interval = Interval::Between { low: End::Unbounded, high: End::Unbounded };

    /// All values that are at least 0.
    pub(super) const FROM_ZERO: Interval = Interval::Between { low: End::natural(0.0), high: End::Unbounded };

    /// Returns the interval of a parameter that does not change the verdict: `all` values if the frame stands, none if it
    /// falls by this motion.
    pub(super) fn of_verdict(verdict: Verdict, motion: &[Motion], all: Interval) -> Interval {
        match verdict {
            Verdict::Stable => all,
            Verdict::Unstable => Interval::excluded_by(motion.to_vec()),
            Verdict::Undecided => Interval::Undecided,
        }
    }

    /// Returns an empty interval: the frame falls by this motion at every value.
    pub(super) fn excluded_by(mechanism: Vec<Motion>) -> Interval {
        Interval::Empty(vec![Exclusion::everywhere(mechanism)])
    }

    /// Returns the interval of the parameter in another unit: all values times a positive factor.
    pub(super) fn scaled(&self, factor: f64) -> Interval {
        let end = |end: &End| match end {
            End::At { value, mechanism } => End::At { value: value * factor, mechanism: mechanism.clone() },
            End::Unconfirmed { stands, beyond } => {
                End::Unconfirmed { stands: stands * factor, beyond: beyond * factor }
            }
            End::Unbounded => End::Unbounded,
        };
        match self {
            Interval::Between { low, high } => Interval::Between { low: end(low), high: end(high) },
            Interval::Empty(all) => {
                let times = |own: &Exclusion| Exclusion {
                    from: own.from.map(|value| value * factor),
                    to: own.to.map(|value| value * factor),
                    ..own.clone()
                };
                Interval::Empty(all.iter().map(times).collect())
            }
            Interval::Undecided => Interval::Undecided,
        }
    }

    /// Returns the lower end of the interval; `None` if the interval is empty or undecided.
    pub fn low(&self) -> Option<&End> {
        match self {
            Interval::Between { low, .. } => Some(low),
            Interval::Empty(_) | Interval::Undecided => None,
        }
    }

    /// Returns the upper end of the interval; `None` if the interval is empty or undecided.
    pub fn high(&self) -> Option<&End> {
        match self {
            Interval::Between { high, .. } => Some(high),
            Interval::Empty(_) | Interval::Undecided => None,
        }
    }

    /// True if the frame is known to stand at a value.
    pub fn contains(&self, value: f64) -> bool {
        match self {
            Interval::Between { low, high } => {
                low.stands(f64::NEG_INFINITY) <= value && value <= high.stands(f64::INFINITY)
            }
            Interval::Empty(_) | Interval::Undecided => false,
        }
    }

    /// True if the frame is known not to stand at a value: the interval is empty, or the value lies beyond a confirmed
    /// end.
    pub fn excludes(&self, value: f64) -> bool {
        match self {
            Interval::Between { low, high } => {
                low.value().is_some_and(|low| value < low) || high.value().is_some_and(|high| high < value)
            }
            Interval::Empty(_) => true,
            Interval::Undecided => false,
        }
    }

    /// Returns the intersection of two intervals: the values at which two components of a frame both stand.
    pub(super) fn intersection(self, other: Interval) -> Interval {
        let (low, high) = match (self, other) {
            (Interval::Empty(a), Interval::Empty(b)) => {
                // Both intervals are empty. Keep the list with fewer exclusions.
                return Interval::Empty(if b.len() < a.len() { b } else { a });
            }
            (empty @ Interval::Empty(_), _) | (_, empty @ Interval::Empty(_)) => return empty,
            (Interval::Undecided, _) | (_, Interval::Undecided) => return Interval::Undecided,
            (Interval::Between { low, high }, Interval::Between { low: other_low, high: other_high }) => {
                // Take the larger of the two lower ends. An unbounded end counts as −∞.
                let [a, b] = [&low, &other_low].map(|end| end.stands(f64::NEG_INFINITY));
                let low = if b.total_cmp(&a) == Ordering::Greater { other_low } else { low };
                // Take the smaller of the two upper ends.
                let [a, b] = [&high, &other_high].map(|end| end.stands(f64::INFINITY));
                let high = if b.total_cmp(&a) == Ordering::Less { other_high } else { high };
                (low, high)
            }
        };
        let (least, most) = (low.stands(f64::NEG_INFINITY), high.stands(f64::INFINITY));
        // Two intervals may have only one value in common, so allow for rounding.
        if least <= most + ROUNDING_TOL * most.abs() {
            return Interval::Between { low, high };
        }
        match (low, high) {
            // No value suits both components: one falls below its lower end, the other falls above its upper end.
            (End::At { value: low, mechanism: below }, End::At { value: high, mechanism: above }) => {
                Interval::Empty(vec![Exclusion::below(low, below), Exclusion::above(high, above)])
            }
            // One end is not confirmed. Both components may stand at a value beyond it, so the intersection is unknown.
            _ => Interval::Undecided,
        }
    }
}

/// The values of a parameter at which a frame falls by one motion. An end is `None` if the range is unbounded there.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Exclusion {
    /// The lower end.
    pub from: Option<f64>,
    /// The upper end.
    pub to: Option<f64>,
    /// How the blocks begin to move at these values.
    pub mechanism: Vec<Motion>,
}

impl Exclusion {
    /// Creates the exclusion of all values: the frame falls by this motion at every value of the parameter.
    pub(super) fn everywhere(mechanism: Vec<Motion>) -> Exclusion {
        Exclusion { from: None, to: None, mechanism }
    }

    /// Returns both ends; infinite where the range is unbounded.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.from.unwrap_or(f64::NEG_INFINITY), self.to.unwrap_or(f64::INFINITY)]
    }

    /// Creates the exclusion of all values below `to`, where the frame falls by this motion.
    pub(super) fn below(to: f64, mechanism: Vec<Motion>) -> Exclusion {
        Exclusion { to: Some(to), ..Exclusion::everywhere(mechanism) }
    }

    /// Creates the exclusion of all values above `from`, where the frame falls by this motion.
    pub(super) fn above(from: f64, mechanism: Vec<Motion>) -> Exclusion {
        Exclusion { from: Some(from), ..Exclusion::everywhere(mechanism) }
    }
}

/// Selects as few arcs of tilts as possible that together cover a full turn, sorted by their beginning. Angles are in
/// degrees. Two arcs count as joined if the gap between them is at most `gap(tilt)`, where `tilt` is the end of the
/// first arc. Returns all arcs if they do not cover a full turn.
pub(super) fn fewest_arcs(arcs: &[Exclusion], gap: impl Fn(f64) -> f64) -> Vec<Exclusion> {
    let first = arcs.iter().map(|arc| arc.ends()[0]);
    let (first, mut kept) = (first.fold(f64::INFINITY, f64::min), Vec::new());
    let mut reached = first;
    while reached < first + 360.0 {
        // Of the arcs that begin within the covered range, choose the arc that ends farthest.
        let joined = arcs.iter().filter(|arc| arc.ends()[0] <= reached + gap(reached));
        let farthest = joined.max_by(|a, b| a.ends()[1].total_cmp(&b.ends()[1]));
        match farthest.filter(|arc| arc.ends()[1] > reached) {
            Some(arc) => {
                reached = arc.ends()[1];
                kept.push(arc.clone());
            }
            None => return arcs.to_vec(),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(low: f64, high: f64) -> Interval {
        let end = |value: f64| if value.is_finite() { End::natural(value) } else { End::Unbounded };
        Interval::Between { low: end(low), high: end(high) }
    }

    #[test]
    fn a_frame_stands_where_all_its_components_stand() {
        let endless = f64::INFINITY;
        for (a, b, both) in [
            ((2.0, endless), (0.0, 0.5), None),
            ((-1.0, 3.0), (0.5, endless), Some((0.5, 3.0))),
            ((-endless, 1.0), (1.0, 2.0), Some((1.0, 1.0))),
            ((-endless, endless), (-2.0, 7.0), Some((-2.0, 7.0))),
        ] {
            let none = || Interval::Empty(vec![Exclusion::below(2.0, Vec::new()), Exclusion::above(0.5, Vec::new())]);
            let expected = both.map_or_else(none, |(low, high)| between(low, high));
            let [a, b] = [a, b].map(|(low, high)| between(low, high));
            assert_eq!(a.clone().intersection(b.clone()), expected);
            assert_eq!(b.intersection(a), expected);
        }
    }

    #[test]
    fn a_value_is_excluded_only_beyond_a_confirmed_end() {
        // At `beyond` the verdict may be undecided: the frame may be stable there and at larger distances.
        let open = Interval::Between { low: End::Unconfirmed { stands: 2.0, beyond: 1.0 }, high: End::natural(3.0) };
        let found = |value: f64| (open.contains(value), open.excludes(value));
        assert_eq!(found(0.5), (false, false));
        assert_eq!(found(2.0), (true, false));
        assert_eq!(found(3.5), (false, true));
        assert!(!Interval::Undecided.excludes(0.0));
        assert!(Interval::excluded_by(Vec::new()).excludes(0.0));
    }

    #[test]
    fn an_unconfirmed_end_never_makes_an_interval_empty() {
        let open = Interval::Between { low: End::natural(0.0), high: End::Unconfirmed { stands: 1.0, beyond: 2.0 } };
        let above = between(1.5, 3.0);
        assert_eq!(open.clone().intersection(above), Interval::Undecided);
        let empty = Interval::excluded_by(Vec::new());
        assert_eq!(open.clone().intersection(empty.clone()), empty);
        assert!(open.contains(1.0) && !open.contains(1.5));
    }

    fn arc(from: f64, to: f64) -> Exclusion {
        Exclusion { from: Some(from), to: Some(to), mechanism: Vec::new() }
    }

    #[test]
    fn a_full_turn_is_covered_by_the_fewest_arcs() {
        let all = vec![arc(-10.0, 60.0), arc(20.0, 40.0), arc(50.0, 170.0), arc(55.0, 120.0), arc(-190.0, -9.0)];
        let found = fewest_arcs(&all, |_| 1e-6);
        assert_eq!(found, [all[4].clone(), all[0].clone(), all[2].clone()], "{found:?}");
        let open = &all[..4];
        assert_eq!(fewest_arcs(open, |_| 1e-6), open);
    }
}
