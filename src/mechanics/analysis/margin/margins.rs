//! [`Margins`]: for each parameter, the values at which a frame stands.
//!
//! Describes the margins that are withheld: the verdicts on both sides of an end are too far apart, or no verdict shows
//! where the frame stands.

use super::interval::{END_TOL, End, Interval};
use super::kind::{MarginKind, MarginKinds};
use super::trial::Trial;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::condition::Condition;
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{RobotId, digits};
use crate::mechanics::statics::assembly::Assembly;

/// The values of one parameter at which a frame stands.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Margin {
    /// The parameter.
    pub kind: MarginKind,
    /// For [`MarginKind::Robots`], the robot and its varied limit: 0 for the horizontal force, 1 for the vertical force
    /// (N), 2 for the torque (N·m). All other limits are as in the scene.
    pub limit: Option<(RobotId, usize)>,
    /// The values at which the frame stands.
    pub interval: Interval,
    /// The conditions that decide the lower and the upper end of the interval.
    pub conditions: [Condition; 2],
}

impl Margin {
    /// Creates the margin of a frame in a single condition.
    pub(super) fn new(kind: MarginKind, limit: Option<(RobotId, usize)>, interval: Interval) -> Margin {
        Margin { kind, limit, interval, conditions: Default::default() }
    }

    /// Returns the margin in all conditions of this margin and of another one of the same kind.
    fn and(&self, other: &Margin) -> Margin {
        let interval = self.interval.clone().intersection(other.interval.clone());
        // Of ends that differ by rounding, as those of a symmetric structure, the first decides.
        let is_near = |own: Option<&End>, other: Option<&End>| {
            let values = own.and_then(End::value).zip(other.and_then(End::value));
            values.is_some_and(|(own, other)| (own - other).abs() <= END_TOL * own.abs())
        };
        let is_others = |own: Option<&End>, other: Option<&End>, both: Option<&End>| {
            both == other && both != own && !is_near(own, other)
        };
        let conditions = match interval {
            Interval::Between { .. } => {
                let low = is_others(self.interval.low(), other.interval.low(), interval.low());
                let high = is_others(self.interval.high(), other.interval.high(), interval.high());
                [if low { other } else { self }.conditions[0], if high { other } else { self }.conditions[1]]
            }
            // No value is left because of one of them, or because of both.
            _ if self.interval == interval => self.conditions,
            _ if other.interval == interval => other.conditions,
            _ => [self.conditions[0], other.conditions[1]],
        };
        Margin { interval, conditions, ..*self }
    }
}

/// How far a frame is from its limit of stability: the interval of each parameter at which it stands.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, analysis::{MarginKind, MarginKinds, Options}};
/// // A block 3 m wide and 2 m high would topple at a horizontal share of 1.5, but slides at its friction of 0.5.
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::with(&scene, &Options::default().margins(MarginKinds::ALL));
/// let margins = analysis.frames[0].margins.as_ref().expect("requested");
/// let slides = margins.most(MarginKind::HorizontalLoad).expect("a block slides");
/// assert!((slides - 0.5).abs() < 1e-6);
/// assert_eq!(margins.of(MarginKind::LoadFactor), None, "the scene lists no load");
/// let tilt = margins.of(MarginKind::Tilt).expect("requested");
/// assert!(tilt.contains(-26.5) && tilt.contains(26.5) && !tilt.contains(26.6));
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Margins {
    /// The requested margins.
    pub kinds: MarginKinds,
    /// The margins that have a meaning in the scene. The limits of robots come last, in the order of the frame's holds.
    pub each: Vec<Margin>,
    /// Remarks about the intervals, one sentence each.
    pub notes: Vec<String>,
}

impl Margins {
    /// Returns the values of a parameter at which the frame stands. `None` if they were not requested, if the parameter
    /// has no meaning in the scene, or for [`MarginKind::Robots`].
    pub fn of(&self, kind: MarginKind) -> Option<&Interval> {
        self.margin(kind).map(|margin| &margin.interval)
    }

    /// Returns the margin of this kind. `None` as for [`Margins::of`].
    pub fn margin(&self, kind: MarginKind) -> Option<&Margin> {
        self.each.iter().find(|margin| margin.kind == kind && margin.limit.is_none())
    }

    /// Returns the lower (0) or the upper (1) end of an interval, where the frame begins to fall if the value moves away
    /// from the present one. `None` if there is no end: no interval, or the frame is not known to stand without a tilt or
    /// a horizontal load.
    pub(crate) fn end(&self, kind: MarginKind, end: usize) -> Option<&End> {
        let interval = self.of(kind).filter(|interval| !kind.is_signed() || interval.contains(0.0))?;
        if end == 0 { interval.low() } else { interval.high() }
    }

    /// Returns the least value of a parameter with which the frame stands, such as the least friction; negative for a
    /// tilt to the left. `None` if it is not confirmed or there is none: also for a tilt or a horizontal load if the
    /// frame falls without it.
    pub fn least(&self, kind: MarginKind) -> Option<f64> {
        self.end(kind, 0)?.value()
    }

    /// Returns the largest value of a parameter with which the frame stands, such as the largest load factor or the
    /// largest tilt to the right. `None` as for [`Margins::least`].
    pub fn most(&self, kind: MarginKind) -> Option<f64> {
        self.end(kind, 1)?.value()
    }

    /// Returns the intervals of the limits of each robot that holds a block, in the order of the frame's holds: of its
    /// horizontal force, its vertical force and its torque.
    pub fn robots(&self) -> impl Iterator<Item = (RobotId, [&Interval; 3])> {
        let limits = self.each.iter().filter_map(|margin| Some((margin.limit?.0, &margin.interval)));
        let limits: Vec<(RobotId, &Interval)> = limits.collect();
        let robots = limits.chunks_exact(3).map(|of| (of[0].0, [of[0].1, of[1].1, of[2].1]));
        robots.collect::<Vec<_>>().into_iter()
    }

    /// Returns the margins of a frame in all conditions of two lists: those of `self` and those of `other`. Each list comes
    /// with the verdict and the motion in its condition: without a meaning there, such as a factor on loads where no load
    /// acts, a parameter does not change that verdict.
    pub(in crate::mechanics::analysis) fn and(
        (own, own_verdict): (&Margins, (Verdict, &[Motion])),
        (other, other_verdict): (&Margins, (Verdict, &[Motion])),
    ) -> Margins {
        let same = |margin: &Margin, list: &Margins| {
            list.each.iter().find(|own| (own.kind, own.limit) == (margin.kind, margin.limit)).cloned()
        };
        let missing = |margin: &Margin, list: &Margins, (verdict, motion): (Verdict, &[Motion])| {
            let all = if margin.kind.is_signed() { Interval::UNBOUNDED } else { Interval::FROM_ZERO };
            let conditions = list.each.first().map_or(margin.conditions, |own| own.conditions);
            Margin { interval: Interval::of_verdict(verdict, motion, all), conditions, ..margin.clone() }
        };
        let both = own
            .each
            .iter()
            .map(|margin| margin.and(&same(margin, other).unwrap_or_else(|| missing(margin, other, other_verdict))));
        let new = other.each.iter().filter(|margin| same(margin, own).is_none());
        let mut each: Vec<Margin> =
            both.chain(new.map(|margin| missing(margin, own, own_verdict).and(margin))).collect();
        each.sort_by_key(|margin| (margin.kind as usize, margin.limit.map(|limit| limit.0)));
        let mut notes = own.notes.clone();
        notes.extend(other.notes.iter().filter(|note| !own.notes.contains(note)).cloned());
        Margins { kinds: own.kinds, each, notes }
    }

    /// True if an assembly, which is the frame in another condition, also stands up to each end of these margins. False if
    /// this is not known, as for the limits of robots.
    pub(in crate::mechanics::analysis) fn hold_for(&self, assembly: &Assembly) -> bool {
        let components = assembly.components();
        let mut trials: Vec<Trial> = components.iter().map(|component| Trial::new(component, None)).collect();
        self.each.iter().all(|margin| match &margin.interval {
            Interval::Empty(_) => true,
            _ if margin.limit.is_some() => false,
            Interval::Undecided => false,
            Interval::Between { low, high } => trials.iter_mut().all(|trial| {
                let path = margin.kind.path(trial);
                path.reaches(trial, low, -1.0) && path.reaches(trial, high, 1.0)
            }),
        })
    }

    /// Returns a sentence for each withheld margin, with the reason. `robot` returns the name of a robot.
    pub(in crate::mechanics::analysis) fn withheld(&self, robot: impl Fn(RobotId) -> String) -> Vec<String> {
        let mut list = Vec::new();
        for Margin { kind, limit, interval, .. } in &self.each {
            let [least, largest] = match limit {
                None => kind.about().notice.map(str::to_owned),
                Some((id, limit)) => {
                    let limit = ["fx in newtons", "fy in newtons", "torque in newton metres"][*limit];
                    ["least", "largest"].map(|end| format!("the {end} {limit} of robot {}", robot(*id)))
                }
            };
            match interval {
                Interval::Between { low, high } => {
                    for (name, end) in [(least, low), (largest, high)] {
                        if let End::Unconfirmed { stands, beyond } = end {
                            let [stands, beyond] = [stands, beyond].map(|value| digits(*value));
                            list.push(format!(
                                "{name} is withheld, since no verdict confirms it: the frame stands at {stands}, and \
                                 at {beyond} it was not shown to stand; between these values nothing was proved"
                            ));
                        }
                    }
                }
                Interval::Undecided => {
                    list.push(format!("{least} and {largest} are withheld: no verdict shows at which values it stands"))
                }
                Interval::Empty(_) => {}
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(each: impl IntoIterator<Item = (MarginKind, Option<usize>, Interval)>) -> Margins {
        let each = each.into_iter().map(|(kind, limit, interval)| {
            let limit = limit.map(|limit| (RobotId(0), limit));
            Margin::new(kind, limit, interval)
        });
        Margins { kinds: MarginKinds::ALL, each: each.collect(), notes: Vec::new() }
    }

    #[test]
    fn margins_without_a_confirmed_verdict_are_withheld_with_a_reason() {
        use MarginKind::{Friction, Kernel, LoadFactor, Robots, Tilt};
        let open = End::Unconfirmed { stands: 0.25, beyond: 2.5e-8 };
        let left = End::Unconfirmed { stands: -0.25, beyond: -0.5 };
        let margins = found([
            (Friction, None, Interval::excluded_by(Vec::new())),
            (Tilt, None, Interval::Between { low: left.clone(), high: End::Unbounded }),
            (Kernel, None, Interval::Between { low: End::natural(0.0), high: open.clone() }),
            (Robots, Some(0), Interval::excluded_by(Vec::new())),
            (Robots, Some(1), Interval::Between { low: open, high: End::Unbounded }),
            (Robots, Some(2), Interval::Undecided),
        ]);
        let listed = margins.withheld(|_| "r".to_string());
        let expected = [
            (
                "the largest tilt in degrees to the left is withheld",
                "the frame stands at -0.25, and at -0.5 it was not",
            ),
            ("the largest kernel is withheld", "the frame stands at 0.25, and at 2.5e-8 it was not"),
            ("the least fy in newtons of robot r is withheld", "the frame stands at 0.25, and at 2.5e-8 it was not"),
            ("the least torque in newton metres of robot r and the largest", "no verdict shows at which values"),
        ];
        assert_eq!(listed.len(), expected.len());
        for (sentence, (start, reason)) in listed.iter().zip(expected) {
            assert!(sentence.starts_with(start) && sentence.contains(reason), "{sentence}");
        }
        assert_eq!([margins.most(Kernel), margins.least(Tilt), margins.least(Friction)], [None; 3]);
        assert_eq!(margins.end(Tilt, 0), Some(&left));
        assert_eq!(margins.of(LoadFactor), None);
        // “Falls at every value” is a different statement from “undecided”.
        let robots: Vec<(RobotId, [&Interval; 3])> = margins.robots().collect();
        assert!(matches!(robots[..], [(RobotId(0), [Interval::Empty(_), _, Interval::Undecided])]));
    }

    #[test]
    fn a_margin_around_a_present_value_that_no_verdict_decides_has_no_end() {
        let left = |low: End| {
            let tilt = Interval::Between { low, high: End::Unbounded };
            found([(MarginKind::Tilt, None, tilt)]).end(MarginKind::Tilt, 0).cloned()
        };
        assert_eq!(left(End::Unconfirmed { stands: 1.0, beyond: -1.0 }), None);
        assert_eq!(left(End::natural(1.0)), None);
        assert_eq!(left(End::natural(0.0)), Some(End::natural(0.0)));
    }

    #[test]
    fn every_kind_has_its_own_declaration() {
        for (kind, word) in [
            (MarginKind::Friction, "friction"),
            (MarginKind::Tilt, "tilt"),
            (MarginKind::HorizontalLoad, "horizontal_load"),
            (MarginKind::Kernel, "kernel"),
            (MarginKind::LoadFactor, "load_factor"),
            (MarginKind::FrictionFactor, "friction_factor"),
            (MarginKind::Robots, "robots"),
        ] {
            assert_eq!((kind.word(), MarginKind::from_word(word)), (word, Some(kind)));
        }
        assert!(MarginKind::ALL.into_iter().enumerate().all(|(place, kind)| kind as usize == place));
    }
}
