//! [`Margins`]: how far a frame is from the edge of standing, in every direction that is asked about.
//!
//! Makes one [`Margins`] per frame. A margin of a frame is the worst of its components'. What is linear in the unknown (a
//! load, a robot's limit) is one linear program; friction, the kernel and the turn of gravity beside loads that do not
//! turn are searched for. Either way the value is believed only when the changed frame stands just inside it and falls
//! just beyond it, by the same proofs as every verdict; the mechanism told is the one just beyond.
//!
//! More friction and a smaller kernel only add admissible forces, and the loads that a structure carries form a convex
//! set, so along friction, kernel, load and limit there is one edge. Along an arc of turning gravity there can be several:
//! the first one, seen from the frame as it is, is told.

mod edge;
mod tilt;
mod trial;

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::{Key, Verdict};
use crate::assembly::Assembly;
use crate::proof::Motion;
use crate::scene::RobotId;
use crate::solve::{Limit, least, most};
use edge::{Edge, Loads, Way};
use trial::{Limited, Setting, Trial};

/// The end of what a frame bears in one direction.
#[derive(Clone, Debug, PartialEq)]
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
}

impl Margin {
    /// The value, where there is one.
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
/// use drystone::{Analysis, Scene, analysis::{Ask, Margin, Options}};
/// // A block 3 m wide and 2 m high would topple at a horizontal share of 1.5, but slides at its friction of 0.5.
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::with(&scene, &Options { margins: Ask::Yes, ..Options::default() });
/// let margins = analysis.frames[0].margins.as_ref().expect("asked for");
/// let slides = margins.horizontal_load.right.at().expect("a block slides");
/// assert!((slides - 0.5).abs() < 1e-6);
/// assert_eq!(margins.load_factor, Margin::Unbounded, "the scene lists no load");
/// # Ok::<(), drystone::scene::Problems>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Margins {
    /// The smallest friction coefficient, the same at every interface, with which it stands; 0 where it needs none.
    /// [`Margin::None`] where it falls at [`Margins::MOST_FRICTION`].
    pub friction: Margin,
    /// The largest turn of gravity in degrees; loads do not turn. Right: gravity's tip moves to the right.
    /// [`Margin::None`] where it falls unturned, even if some turn would let it stand: a margin begins at the frame as it
    /// is. [`Margin::Unbounded`] where half a turn leaves it standing.
    pub tilt: Sides,
    /// The largest share of each weight that may act across gravity beside the weight itself.
    pub horizontal_load: Sides,
    /// The largest safety kernel; [`Margin::Unbounded`] where it stands at 1.
    pub kernel: Margin,
    /// The largest factor on the listed loads; 1 is as they are listed.
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

/// Finds the margins of a frame from its components, and how many changed components were judged for it. A component whose
/// margins were found in an earlier frame is not judged again.
pub(super) fn of(
    components: &[((&Assembly, &Key), Verdict)],
    known: &mut BTreeMap<Key, Margins>,
) -> (Margins, usize) {
    let fresh = components.iter().filter(|c| !known.contains_key(c.0.1));
    let fresh: Vec<&((&Assembly, &Key), Verdict)> = fresh.collect();
    let parts: Vec<(Key, Margins, usize)> = fresh
        .par_iter()
        .map(|((component, key), verdict)| {
            let mut trial = Trial::of(component);
            let margins = of_component(&mut trial, *verdict == Verdict::Stable);
            ((*key).clone(), margins, trial.judged)
        })
        .collect();
    let mut judged = 0;
    for (key, margins, tries) in parts {
        known.insert(key, margins);
        judged += tries;
    }
    let falling = components.iter().filter(|c| c.1 != Verdict::Stable).count();
    let mut whole = Margins {
        friction: Margin::Value {
            at: 0.0,
            mechanism: Vec::new(),
        },
        tilt: Sides {
            left: Margin::Unbounded,
            right: Margin::Unbounded,
        },
        horizontal_load: Sides {
            left: Margin::Unbounded,
            right: Margin::Unbounded,
        },
        kernel: Margin::Unbounded,
        load_factor: Margin::Unbounded,
        robots: Vec::new(),
    };
    for ((_, key), verdict) in components {
        let Some(part) = known.get(*key).cloned() else {
            continue;
        };
        let worse = |whole: &mut Margin, part: Margin, way: Way| {
            if edge::worse(&part, whole, way) {
                *whole = part;
            }
        };
        worse(&mut whole.friction, part.friction, Way::Least);
        worse(&mut whole.tilt.left, part.tilt.left, Way::Most);
        worse(&mut whole.tilt.right, part.tilt.right, Way::Most);
        worse(
            &mut whole.horizontal_load.left,
            part.horizontal_load.left,
            Way::Most,
        );
        worse(
            &mut whole.horizontal_load.right,
            part.horizontal_load.right,
            Way::Most,
        );
        worse(&mut whole.kernel, part.kernel, Way::Most);
        worse(&mut whole.load_factor, part.load_factor, Way::Most);
        // No robot can save a frame in which another component falls.
        let others_fall = falling > usize::from(*verdict != Verdict::Stable);
        whole.robots.extend(part.robots.into_iter().map(|robot| {
            if others_fall {
                RobotMargins {
                    fx: Margin::None,
                    fy: Margin::None,
                    torque: Margin::None,
                    ..robot
                }
            } else {
                robot
            }
        }));
    }
    // Holds stand by robot number in a frame.
    whole.robots.sort_by_key(|r| r.robot);
    (whole, judged)
}

fn of_component(trial: &mut Trial, stands: bool) -> Margins {
    let robots = trial.holds().into_iter().enumerate();
    let robots = robots.map(|(grip, robot)| {
        let [fx, fy, torque] = [0, 1, 2].map(|component| limit(trial, grip, component));
        RobotMargins {
            robot,
            fx,
            fy,
            torque,
        }
    });
    let robots = robots.collect();
    let horizontal_load = Sides {
        left: horizontal(trial, -1.0, stands),
        right: horizontal(trial, 1.0, stands),
    };
    Margins {
        friction: friction(trial),
        tilt: Sides {
            left: tilt::tilt(trial, -1.0, stands, &horizontal_load.left),
            right: tilt::tilt(trial, 1.0, stands, &horizontal_load.right),
        },
        horizontal_load,
        kernel: kernel(trial),
        load_factor: load_factor(trial, stands),
        robots,
    }
}

fn friction(trial: &mut Trial) -> Margin {
    let setting = |mu: f64| Setting {
        friction: Some(mu),
        ..Setting::default()
    };
    Edge {
        way: Way::Least,
        loads: Loads::Other,
        natural: 1.0,
        most: Margins::MOST_FRICTION,
    }
    .searched(trial, &setting)
}

fn kernel(trial: &mut Trial) -> Margin {
    let setting = |kernel: f64| Setting {
        kernel: Some(kernel),
        ..Setting::default()
    };
    Edge {
        way: Way::Most,
        loads: Loads::Other,
        natural: 1.0,
        most: 1.0,
    }
    .searched(trial, &setting)
}

fn horizontal(trial: &mut Trial, side: f64, stands: bool) -> Margin {
    let setting = |share: f64| Setting {
        across: side * share,
        ..Setting::default()
    };
    let alone = Setting {
        along: 0.0,
        across: side,
        loads: 0.0,
        limits: Limited::Unlimited,
        ..Setting::default()
    };
    linear(trial, &setting, alone, stands)
}

fn load_factor(trial: &mut Trial, stands: bool) -> Margin {
    let setting = |factor: f64| Setting {
        loads: factor,
        ..Setting::default()
    };
    let alone = Setting {
        along: 0.0,
        limits: Limited::Unlimited,
        ..Setting::default()
    };
    if trial.is_loaded() {
        linear(trial, &setting, alone, stands)
    } else if stands {
        Margin::Unbounded
    } else {
        Margin::None
    }
}

/// The largest value of a setting in which the loads are linear. `alone` has only what grows: if what needs no limit of
/// any robot carries that, nothing bounds it.
fn linear(
    trial: &mut Trial,
    setting: &dyn Fn(f64) -> Setting,
    alone: Setting,
    stands: bool,
) -> Margin {
    let edge = Edge {
        way: Way::Most,
        loads: Loads::Linear,
        natural: 1.0,
        most: 1e6,
    };
    let (program, toward) = trial.direction(&setting(0.0), &setting(1.0));
    let stands_unloaded = |trial: &mut Trial| trial.judge(&setting(0.0)).0 == Verdict::Stable;
    match most(&program, &toward) {
        Limit::Never if !stands && !stands_unloaded(trial) => Margin::None,
        // It stands within the proof's band and not beyond it: on the edge.
        Limit::Never => edge
            .confirmed(trial, setting, 0.0)
            .unwrap_or_else(|| edge.searched(trial, setting)),
        Limit::Unbounded if trial.judge(&alone).0 == Verdict::Stable => Margin::Unbounded,
        Limit::At(at) => edge
            .confirmed(trial, setting, at)
            .unwrap_or_else(|| edge.searched(trial, setting)),
        _ => edge.searched(trial, setting),
    }
}

fn limit(trial: &mut Trial, grip: usize, component: usize) -> Margin {
    let setting = |most: f64| Setting {
        limits: Limited::One {
            grip,
            component,
            most,
        },
        ..Setting::default()
    };
    let program = trial.program(&Setting::default());
    let mut unit = program.scale.force;
    if component == 2 {
        unit *= program.scale.length;
    }
    let edge = Edge {
        way: Way::Least,
        loads: Loads::Linear,
        natural: unit * crate::program::Scale::HEAVIEST,
        most: 1e6 * unit * crate::program::Scale::HEAVIEST,
    };
    match least(&program, grip, component) {
        Limit::Never => Margin::None,
        Limit::At(at) => edge
            .confirmed(trial, &setting, at * unit)
            .unwrap_or_else(|| edge.searched(trial, &setting)),
        _ => edge.searched(trial, &setting),
    }
}
