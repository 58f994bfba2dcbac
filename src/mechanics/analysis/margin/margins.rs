//! [`Margins`]: the distances of a frame from collapse, which are computed from [`Intervals`].

use super::interval::{End, Interval, Intervals};
use super::kind::{MarginKind, MarginKinds};
use crate::proof::Motion;
use crate::scene::RobotId;

/// The end of what a frame bears in one direction.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Margin {
    /// It stands up to here (of what must not be too small: from here on).
    Value {
        /// Where the edge is, in the unit of the margin.
        at: f64,
        /// How the blocks begin to move just beyond; empty where there is no beyond, as below a friction of 0.
        mechanism: Vec<Motion>,
    },
    /// It falls at any value.
    None,
    /// It stands at any value.
    Unbounded,
    /// The edge lies between, but no verdict was reached near enough to it on either side.
    Unconfirmed {
        /// Here it stands.
        stands: f64,
        /// Here it falls, or is undecided.
        beyond: f64,
    },
    /// It was not asked for.
    NotAsked,
    /// The parameter has no meaning in this scene: it lists no loads.
    NotApplicable,
}

impl Margin {
    /// The value; `None` if there is none.
    pub fn at(&self) -> Option<f64> {
        match self {
            Margin::Value { at, .. } => Some(*at),
            _ => None,
        }
    }
}

/// A margin to either side, as seen with gravity pointing down the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Sides {
    /// Towards the left.
    pub left: Margin,
    /// Towards the right.
    pub right: Margin,
}

/// How far a frame is from the edge of standing.
///
/// # Example
/// ```
/// use drystone::{Analysis, Scene, analysis::{Margin, Options}};
/// // A block 3 m wide and 2 m high would topple at a horizontal share of 1.5, but slides at its friction of 0.5.
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::with(&scene, &Options::default().margins(true));
/// let margins = analysis.frames[0].margins.as_ref().expect("asked for");
/// let slides = margins.horizontal_load.right.at().expect("a block slides");
/// assert!((slides - 0.5).abs() < 1e-6);
/// assert_eq!(margins.load_factor, Margin::NotApplicable, "the scene lists no load");
/// let tilt = margins.intervals.tilt.as_ref().expect("asked for");
/// assert!(tilt.contains(-26.5) && tilt.contains(26.5) && !tilt.contains(26.6));
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Margins {
    /// The values of each parameter at which it stands. All other fields are read from them.
    pub intervals: Intervals,
    /// The smallest friction coefficient, the same at every interface, with which it stands; 0 where it needs none.
    /// [`Margin::None`] where it falls at [`Margins::MOST_FRICTION`].
    pub friction: Margin,
    /// The largest turn of gravity in degrees; loads do not turn. Right: gravity's tip moves to the right.
    /// [`Margin::None`] where it falls unturned, even if some turn would let it stand: a margin begins at the frame as it
    /// is. [`Margin::Unbounded`] where it stands at every turn.
    pub tilt: Sides,
    /// The largest share of each weight that may act across gravity in addition to the weight. [`Margin::None`] where it
    /// falls without it.
    pub horizontal_load: Sides,
    /// The largest safety kernel; [`Margin::Unbounded`] where it stands at 1.
    pub kernel: Margin,
    /// The largest factor on the listed loads; 1 is as they are listed. [`Margin::NotApplicable`] without loads.
    pub load_factor: Margin,
    /// Each holding robot's least sufficient limits, in the order of the frame's holds.
    pub robots: Vec<RobotMargins>,
}

impl Margins {
    /// The largest friction coefficient that is tried.
    pub const MOST_FRICTION: f64 = 1e3;
}

/// A robot's least sufficient limits: of one component alone, its others and the other robots' as the scene has them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotMargins {
    /// The robot.
    pub robot: RobotId,
    /// Of the horizontal force, N.
    pub fx: Margin,
    /// Of the vertical force, N.
    pub fy: Margin,
    /// Of the torque, N·m.
    pub torque: Margin,
}

impl Margins {
    /// The requested margins from these intervals.
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
    /// The ends of an interval as distances from 0 to both sides; no values if it does not contain 0.
    fn around_zero(interval: Option<&Interval>) -> Sides {
        let both = |margin: Margin| Sides {
            left: margin.clone(),
            right: margin,
        };
        match interval {
            None => both(Margin::NotAsked),
            Some(interval @ Interval::Between { low, high }) if interval.contains(0.0) => Sides {
                left: margin(low, -1.0),
                right: margin(high, 1.0),
            },
            Some(_) => both(Margin::None),
        }
    }
}

/// The least sufficient value.
fn least(interval: &Interval) -> Margin {
    interval.low().map_or(Margin::None, |end| margin(end, 1.0))
}

/// The largest admissible value.
fn most(interval: &Interval) -> Margin {
    interval.high().map_or(Margin::None, |end| margin(end, 1.0))
}

/// An end as a margin, with its value multiplied by `sign`.
fn margin(end: &End, sign: f64) -> Margin {
    // Adding 0 turns −0 into 0.
    let signed = |value: f64| sign * value + 0.0;
    match end {
        End::Unbounded => Margin::Unbounded,
        End::At { value, mechanism } => Margin::Value {
            at: signed(*value),
            mechanism: mechanism.clone(),
        },
        End::Unconfirmed { stands, beyond } => Margin::Unconfirmed {
            stands: signed(*stands),
            beyond: signed(*beyond),
        },
    }
}
