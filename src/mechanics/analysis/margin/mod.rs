//! [`Margins`]: how far a frame is from the edge of standing, in every direction that is asked about.
//!
//! Makes one [`Margins`] per frame. A margin of a frame is the worst of its components'. What is linear in the unknown (a
//! load, a robot's limit) is one linear program; friction, the kernel and the turn of gravity beside loads that do not
//! turn are searched for. Either way the value is believed only when the changed frame stands just inside it and falls
//! just beyond it, by the same proofs as every verdict; the mechanism reported is the one just beyond.
//!
//! More friction and a smaller kernel only add admissible forces, and the loads that a structure carries form a convex
//! set, so along friction, kernel, load and limit there is one edge. Along an arc of turning gravity there can be several:
//! the first one, seen from the frame as it is, is reported.

mod edge;
mod kind;
mod tilt;
mod trial;
mod withheld;

use std::collections::BTreeMap;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use super::component::Findings;
use super::{Key, Verdict};
use crate::assembly::Assembly;
use crate::proof::Motion;
use crate::scene::RobotId;
use crate::solve::{Limit, least, most};
use edge::{Loads, Threshold, Way};
pub use kind::{MarginKind, MarginKinds};
pub use trial::trials;
use trial::{Limited, Setting, Trial};

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
/// use drystone::{Analysis, Scene, analysis::{Margin, Options}};
/// // A block 3 m wide and 2 m high would topple at a horizontal share of 1.5, but slides at its friction of 0.5.
/// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }] }"#)?;
/// let analysis = Analysis::with(&scene, &Options::default().margins(true));
/// let margins = analysis.frames[0].margins.as_ref().expect("asked for");
/// let slides = margins.horizontal_load.right.at().expect("a block slides");
/// assert!((slides - 0.5).abs() < 1e-6);
/// assert_eq!(margins.load_factor, Margin::Unbounded, "the scene lists no load");
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
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

/// One component whose margins are sought.
pub(super) struct Part<'a> {
    pub component: &'a Assembly,
    pub key: &'a Key,
    pub found: &'a Findings,
}

impl Part<'_> {
    fn stands(&self) -> bool {
        self.found.verdict == Verdict::Stable
    }
}

/// Finds the margins of a frame from its components, and how many changed components were judged for it. A component whose
/// margins were found in an earlier frame is not judged again.
pub(super) fn of(
    parts: &[Part],
    kinds: MarginKinds,
    known: &mut BTreeMap<Key, Margins>,
) -> (Margins, usize) {
    let fresh = parts.iter().filter(|part| !known.contains_key(part.key));
    let fresh: Vec<&Part> = fresh.collect();
    #[cfg(feature = "parallel")]
    let each = fresh.par_iter();
    #[cfg(not(feature = "parallel"))]
    let each = fresh.iter();
    let found: Vec<(Key, Margins, usize)> = each
        .map(|part| {
            let forces = part.stands().then_some(&part.found.forces);
            let mut trial = Trial::new(part.component, forces);
            let margins = of_component(&mut trial, part.stands(), kinds);
            (part.key.clone(), margins, trial.judged)
        })
        .collect();
    let mut judged = 0;
    for (key, margins, tries) in found {
        known.insert(key, margins);
        judged += tries;
    }
    let falling = parts.iter().filter(|part| !part.stands()).count();
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
    for component in parts {
        let Some(part) = known.get(component.key).cloned() else {
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
        let others_fall = falling > usize::from(!component.stands());
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
    (only(whole, kinds), judged)
}

/// The margins that were asked for.
fn only(found: Margins, kinds: MarginKinds) -> Margins {
    let or_not = |kind: MarginKind, margin: Margin| match kinds.has(kind) {
        true => margin,
        false => Margin::NotAsked,
    };
    let sides = |kind: MarginKind, sides: Sides| Sides {
        left: or_not(kind, sides.left),
        right: or_not(kind, sides.right),
    };
    Margins {
        friction: or_not(MarginKind::Friction, found.friction),
        tilt: sides(MarginKind::Tilt, found.tilt),
        horizontal_load: sides(MarginKind::HorizontalLoad, found.horizontal_load),
        kernel: or_not(MarginKind::Kernel, found.kernel),
        load_factor: or_not(MarginKind::LoadFactor, found.load_factor),
        robots: found.robots,
    }
}

fn of_component(trial: &mut Trial, stands: bool, kinds: MarginKinds) -> Margins {
    let holds = match kinds.has(MarginKind::Robots) {
        true => trial.holds(),
        false => Vec::new(),
    };
    let robots = holds.into_iter().enumerate();
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
    let of = |kind: MarginKind, trial: &mut Trial, find: &dyn Fn(&mut Trial) -> Margin| {
        if kinds.has(kind) {
            find(trial)
        } else {
            Margin::NotAsked
        }
    };
    // A tilt of plain weights follows from the horizontal share.
    let with_tilt = kinds.has(MarginKind::Tilt);
    let [left, right] = [-1.0, 1.0].map(|side| {
        let share = if kinds.has(MarginKind::HorizontalLoad) || with_tilt {
            horizontal(trial, side, stands)
        } else {
            Margin::NotAsked
        };
        let tilt = of(MarginKind::Tilt, trial, &|trial| {
            tilt::tilt(trial, side, stands, &share)
        });
        (share, tilt)
    });
    Margins {
        friction: of(MarginKind::Friction, trial, &friction),
        tilt: Sides {
            left: left.1,
            right: right.1,
        },
        horizontal_load: Sides {
            left: left.0,
            right: right.0,
        },
        kernel: of(MarginKind::Kernel, trial, &kernel),
        load_factor: of(MarginKind::LoadFactor, trial, &|trial| {
            load_factor(trial, stands)
        }),
        robots,
    }
}

fn friction(trial: &mut Trial) -> Margin {
    let setting = |mu: f64| Setting {
        friction: Some(mu),
        ..Setting::default()
    };
    Threshold {
        way: Way::Least,
        loads: Loads::Constant,
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
    Threshold {
        way: Way::Most,
        loads: Loads::Constant,
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
    linear(trial, &setting, alone, stands.then_some(0.0))
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
        linear(trial, &setting, alone, stands.then_some(1.0))
    } else if stands {
        Margin::Unbounded
    } else {
        Margin::None
    }
}

/// The largest value of a setting in which the loads are linear. `alone` has only what grows: if what needs no limit of
/// any robot carries that, nothing bounds it. `base` is the value at which the component is as given, where it stands there.
fn linear(
    trial: &mut Trial,
    setting: &dyn Fn(f64) -> Setting,
    alone: Setting,
    base: Option<f64>,
) -> Margin {
    let edge = Threshold {
        way: Way::Most,
        loads: Loads::Linear,
        natural: 1.0,
        most: 1e6,
    };
    let (program, toward) = trial.direction(&setting(0.0), &setting(1.0));
    let stands_unloaded = |trial: &mut Trial| trial.judge(&setting(0.0)).0 == Verdict::Stable;
    let found = most(&program, &toward);
    match found.limit {
        Limit::Never if base.is_none() && !stands_unloaded(trial) => Margin::None,
        // It stands within the proof's band and not beyond it: on the edge.
        Limit::Never => edge
            .confirmed(trial, setting, 0.0)
            .unwrap_or_else(|| edge.searched(trial, setting)),
        Limit::Unbounded if trial.judge(&alone).0 == Verdict::Stable => Margin::Unbounded,
        Limit::At(at) => {
            trial.learn_edge(&program, &found, edge.beside(at), setting, base);
            edge.confirmed(trial, setting, at)
                .unwrap_or_else(|| edge.searched(trial, setting))
        }
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
    let edge = Threshold {
        way: Way::Least,
        loads: Loads::Linear,
        natural: unit * crate::program::Scale::HEAVIEST,
        most: 1e6 * unit * crate::program::Scale::HEAVIEST,
    };
    let found = least(&program, grip, component);
    match found.limit {
        Limit::Never => Margin::None,
        Limit::At(at) => {
            let at = at * unit;
            trial.learn_edge(&program, &found, edge.beside(at), &setting, None);
            edge.confirmed(trial, &setting, at)
                .unwrap_or_else(|| edge.searched(trial, &setting))
        }
        _ => edge.searched(trial, &setting),
    }
}
