//! [`Margins`]: for each parameter, the largest or the smallest value at which a frame stands. They are read from
//! [`Intervals`].
//!
//! Describes the margins that are withheld: the verdicts on both sides of an end are too far apart, or no verdict shows
//! where the frame stands.

use super::interval::{End, Interval, Intervals};
use super::kind::{MarginKind, MarginKinds};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{RobotId, digits};

/// One margin: the limit of stability of a frame in one direction.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Margin {
    /// The frame stands up to this value, or from this value on if the parameter must not be too small.
    Value {
        /// The limit of stability, in the unit of the margin.
        at: f64,
        /// How the blocks begin to move just beyond the limit; empty if no value lies beyond it, such as a friction
        /// below 0.
        mechanism: Vec<Motion>,
    },
    /// The frame falls at every value. For a tilt or a horizontal load: the frame falls without it.
    None,
    /// The frame stands at every value in this direction.
    Unbounded,
    /// The limit lies between two values, but no verdicts closer to it were proved.
    Unconfirmed {
        /// A value at which the frame stands.
        stands: f64,
        /// A value at which the frame falls or is undecided.
        beyond: f64,
    },
    /// No verdict shows at which values the frame stands.
    Undecided,
    /// The margin was not requested.
    NotAsked,
    /// The frame has no listed loads, so a load factor has no meaning.
    NotApplicable,
}

impl Margin {
    /// Returns the limit of stability, in the unit of the margin. `None` if the margin has no confirmed value.
    pub fn at(&self) -> Option<f64> {
        match self {
            Margin::Value { at, .. } => Some(*at),
            _ => None,
        }
    }
}

/// The margins to both sides, seen with gravity pointing down the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Sides {
    /// Towards the left.
    pub left: Margin,
    /// Towards the right.
    pub right: Margin,
}

/// How far a frame is from its limit of stability.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, analysis::{Margin, Options}};
/// // A block 3 m wide and 2 m high would topple at a horizontal share of 1.5, but slides at its friction of 0.5.
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::with(&scene, &Options::default().margins(true));
/// let margins = analysis.frames[0].margins.as_ref().expect("requested");
/// let slides = margins.horizontal_load.right.at().expect("a block slides");
/// assert!((slides - 0.5).abs() < 1e-6);
/// assert_eq!(margins.load_factor, Margin::NotApplicable, "the scene lists no load");
/// let tilt = margins.intervals.tilt.as_ref().expect("requested");
/// assert!(tilt.contains(-26.5) && tilt.contains(26.5) && !tilt.contains(26.6));
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Margins {
    /// The values of each parameter at which the frame stands. All other fields follow from them.
    pub intervals: Intervals,
    /// The smallest friction coefficient, the same at every interface, with which the frame stands; 0 if it needs no
    /// friction. [`Margin::None`] if it falls at [`Margins::MAX_FRICTION`].
    pub friction: Margin,
    /// The largest rotation of gravity to each side, in degrees. Listed loads do not rotate. To the right means that
    /// the tip of the gravity vector moves to the right. [`Margin::None`] if the frame falls without rotation, even if
    /// it stands at some rotation. [`Margin::Unbounded`] if it stands at every rotation.
    pub tilt: Sides,
    /// The largest fraction of each weight that may act at right angles to gravity, in addition to the weight.
    /// [`Margin::None`] if the frame falls without it.
    pub horizontal_load: Sides,
    /// The largest safety kernel with which the frame stands; [`Margin::Unbounded`] if it stands with a kernel of 1.
    pub kernel: Margin,
    /// The largest factor on the listed loads; 1 means the loads as listed. [`Margin::NotApplicable`] without listed
    /// loads.
    pub load_factor: Margin,
    /// The least sufficient limits of each robot that holds a block, in the order of the frame's holds.
    pub robots: Vec<RobotMargins>,
}

impl Margins {
    /// The largest friction coefficient that is tried.
    pub const MAX_FRICTION: f64 = 1e3;

    /// Returns the smallest load factor with which the frame stands, and the mechanism by which it falls below this
    /// factor. `None` if the frame also stands at factor 0, or if no smallest factor is confirmed.
    pub(in crate::mechanics::analysis) fn least_factor(&self) -> Option<(f64, Vec<Motion>)> {
        let low = self.intervals.load_factor.as_ref()?.low()?;
        match low {
            End::At { value, mechanism } if !mechanism.is_empty() => Some((*value, mechanism.clone())),
            _ => None,
        }
    }
}

/// A robot's least sufficient limits. Each limit is changed alone; the robot's other limits and the limits of other
/// robots are as in the scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotMargins {
    /// The robot.
    pub robot: RobotId,
    /// The least sufficient limit of the horizontal force, N.
    pub fx: Margin,
    /// The least sufficient limit of the vertical force, N.
    pub fy: Margin,
    /// The least sufficient limit of the torque, N·m.
    pub torque: Margin,
}

impl Margins {
    /// Reads the requested margins from the intervals.
    pub(super) fn new(intervals: Intervals, kinds: MarginKinds) -> Margins {
        let robots = intervals.robots.iter().map(|robot| RobotMargins {
            robot: robot.robot,
            fx: least(&robot.fx),
            fy: least(&robot.fy),
            torque: least(&robot.torque),
        });
        let one = |interval: &Option<Interval>, read: fn(&Interval) -> Margin| {
            interval.as_ref().map_or(Margin::NotAsked, read)
        };
        Margins {
            friction: one(&intervals.friction, least),
            tilt: Sides::around_zero(intervals.tilt.as_ref()),
            horizontal_load: Sides::around_zero(intervals.horizontal_load.as_ref()),
            kernel: one(&intervals.kernel, most),
            load_factor: match &intervals.load_factor {
                None if kinds.has(MarginKind::LoadFactor) => Margin::NotApplicable,
                interval => one(interval, most),
            },
            robots: robots.collect(),
            intervals,
        }
    }
}

impl Sides {
    /// Returns how far the interval extends from 0 to the left and to the right. Both margins are [`Margin::None`] if
    /// the interval excludes 0, and [`Margin::Undecided`] if no verdict shows whether it contains 0.
    fn around_zero(interval: Option<&Interval>) -> Sides {
        let both = |margin: Margin| Sides { left: margin.clone(), right: margin };
        match interval {
            None => both(Margin::NotAsked),
            Some(interval @ Interval::Between { low, high }) if interval.contains(0.0) => {
                Sides { left: margin(low, -1.0), right: margin(high, 1.0) }
            }
            Some(interval) if interval.excludes(0.0) => both(Margin::None),
            Some(_) => both(Margin::Undecided),
        }
    }
}

/// Returns the lower end of an interval as a margin: the smallest value at which the frame stands. [`Margin::None`] if
/// the interval is empty, [`Margin::Undecided`] if it is undecided.
fn least(interval: &Interval) -> Margin {
    match interval {
        Interval::Between { low, .. } => margin(low, 1.0),
        Interval::Empty(_) => Margin::None,
        Interval::Undecided => Margin::Undecided,
    }
}

/// Returns the upper end of an interval as a margin: the largest value at which the frame stands. [`Margin::None`] if
/// the interval is empty, [`Margin::Undecided`] if it is undecided.
fn most(interval: &Interval) -> Margin {
    match interval {
        Interval::Between { high, .. } => margin(high, 1.0),
        Interval::Empty(_) => Margin::None,
        Interval::Undecided => Margin::Undecided,
    }
}

/// Converts an end of an interval to a margin. The value is multiplied by `sign`: −1 for a margin to the left,
/// otherwise 1.
fn margin(end: &End, sign: f64) -> Margin {
    // Adding 0 turns −0 into 0.
    let signed = |value: f64| sign * value + 0.0;
    match end {
        End::Unbounded => Margin::Unbounded,
        End::At { value, mechanism } => Margin::Value { at: signed(*value), mechanism: mechanism.clone() },
        End::Unconfirmed { stands, beyond } => Margin::Unconfirmed { stands: signed(*stands), beyond: signed(*beyond) },
    }
}

impl Intervals {
    /// Returns a sentence for each withheld margin, with the reason. `robot` returns the name of a robot.
    pub(in crate::mechanics::analysis) fn withheld(&self, robot: impl Fn(RobotId) -> String) -> Vec<String> {
        let mut list = Vec::new();
        let mut add = |least: &str, largest: &str, interval: &Interval| match interval {
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
        };
        for (least, largest, interval) in [
            ("the least friction", "the largest friction", &self.friction),
            ("the largest tilt in degrees to the left", "the largest tilt in degrees to the right", &self.tilt),
            (
                "the largest horizontal share to the left",
                "the largest horizontal share to the right",
                &self.horizontal_load,
            ),
            ("the least kernel", "the largest kernel", &self.kernel),
            ("the least factor on the loads", "the largest factor on the loads", &self.load_factor),
        ] {
            if let Some(interval) = interval {
                add(least, largest, interval);
            }
        }
        for found in &self.robots {
            let name = robot(found.robot);
            for (interval, component) in
                [(&found.fx, "fx in newtons"), (&found.fy, "fy in newtons"), (&found.torque, "torque in newton metres")]
            {
                add(
                    &format!("the least {component} of robot {name}"),
                    &format!("the largest {component} of robot {name}"),
                    interval,
                );
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MarginKinds, Margins, RobotIntervals};
    use super::*;
    use crate::mechanics::analysis::Margin;

    #[test]
    fn margins_without_a_confirmed_verdict_are_withheld_with_a_reason() {
        let open = End::Unconfirmed { stands: 0.25, beyond: 2.5e-8 };
        let up_to = |high: End| Interval::Between { low: End::natural(0.0), high };
        let found = Intervals {
            friction: Some(Interval::excluded_by(Vec::new())),
            tilt: Some(Interval::Between {
                low: End::Unconfirmed { stands: -0.25, beyond: -0.5 },
                high: End::Unbounded,
            }),
            kernel: Some(up_to(open.clone())),
            robots: vec![RobotIntervals {
                robot: RobotId(0),
                fx: Interval::excluded_by(Vec::new()),
                fy: Interval::Between { low: open, high: End::Unbounded },
                torque: Interval::Undecided,
            }],
            ..Intervals::default()
        };
        let listed = found.withheld(|_| "r".to_string());
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
        let margins = Margins::new(found, MarginKinds::ALL);
        assert_eq!(margins.kernel.at(), None);
        assert!(matches!(margins.tilt.left, Margin::Unconfirmed { stands, .. } if stands == 0.25));
        assert_eq!(margins.load_factor, Margin::NotApplicable);
        // “Falls at every value” is a different statement from “undecided”.
        assert_eq!(margins.friction, Margin::None);
        assert_eq!(margins.robots[0].fx, Margin::None);
        assert_eq!(margins.robots[0].torque, Margin::Undecided);
    }

    #[test]
    fn a_margin_around_a_present_value_that_no_verdict_decides_is_undecided() {
        let read = |tilt: Interval| {
            let found = Intervals { tilt: Some(tilt), ..Intervals::default() };
            Margins::new(found, MarginKinds::ALL).tilt.left
        };
        let open = Interval::Between { low: End::Unconfirmed { stands: 1.0, beyond: -1.0 }, high: End::Unbounded };
        assert_eq!(read(Interval::Undecided), Margin::Undecided);
        assert_eq!(read(open), Margin::Undecided);
        let right = Interval::Between { low: End::natural(1.0), high: End::Unbounded };
        assert_eq!(read(right), Margin::None);
    }
}
