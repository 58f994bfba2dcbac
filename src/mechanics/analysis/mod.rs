//! [`Analysis`]: a scene and all that was found out about it, frame by frame.
//!
//! Everything here is in the scene's own units (metres, newtons) and axes (x right, y up). Pictures and reports read
//! this and nothing deeper. Components of a frame's assembly, which cannot influence each other, are solved apart, and a
//! component that has been solved in an earlier frame is not solved again; `decide` decides one component, and this
//! file combines them.

mod decide;
mod cost;
mod undecided;
mod frame;
mod gather;
mod warm_start;
mod margin;
mod mechanism;
mod gaps_closed;
mod option;
mod pair;
mod wedged;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use std::time::Instant;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

use crate::assembly::Assembly;
use crate::effect::wedging::{self, Wedging};
use crate::effect::{self, FrameContext};
#[doc(inline)]
pub use crate::effect::{EffectName, EffectReport};
use crate::geometry::{Point, Vector};
use crate::interface::Interfaces;
#[doc(inline)]
pub use crate::interface::{ContactKind, Interface};
use crate::program::UnknownCounts;
#[doc(inline)]
pub use crate::proof::{Motion, Proof, ProofThreshold};
#[doc(inline)]
pub use crate::resultant::Resultant;
use crate::scene::{BlockId, BodyId, Note, RobotId, Scene};
pub use crate::solve::Slide;
use crate::solve::{DeadlineGuard, Effort};
pub use cost::{SolveReport, Stages};
pub use decide::Method;
use decide::{Findings, decide_component};
use frame::settle;
use gather::{add, gathered};
use margin::{ComponentIntervals, Part};
pub use margin::{
    End, Interval, Intervals, Margin, MarginKind, MarginKinds, Margins, RobotIntervals,
    RobotMargins, Sides, trials,
};
pub use mechanism::Toward;
pub use option::{Accuracy, Options};
pub use pair::pair;
pub use undecided::UndecidedReason;
pub use warm_start::{Source, verdicts};
pub(crate) use warm_start::{WarmStart, hinges_on_gaps};
pub use wedged::{FaceCase, PointCase, RuledOut, Wedged};

/// Whether a frame stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// Admissible forces balance every block, and the proof shows them.
    Stable,
    /// Neither proof convinces.
    Undecided,
    /// No admissible forces do, and the proof shows a mechanism along which the loads do work.
    Unstable,
}

impl Verdict {
    /// Its word in results, for programs.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Unstable => "unstable",
            Verdict::Undecided => "undecided",
        }
    }
}

/// The word in results, for programs: `stable`, `undecided` or `unstable`.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// A scene and what was found out about each of its frames.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis {
    /// The scene examined.
    pub scene: Arc<Scene>,
    /// One entry per frame of the scene, in order.
    pub frames: Vec<FrameAnalysis>,
    /// What is allowed and seldom meant: the scene's notes, and gaps that are nearly contacts.
    pub notes: Vec<Note>,
}

/// What was found out about one frame.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct FrameAnalysis {
    /// Whether it stands.
    pub verdict: Verdict,
    /// Why it is undecided; empty otherwise. [`FrameAnalysis::doubt`] says it in a sentence.
    pub doubts: Vec<UndecidedReason>,
    /// L in metres, by which torques are weighed against forces: the median length of the frame's edge interfaces, or the
    /// median block's square root of area where nothing touches.
    pub length: f64,
    /// Σ(N1+N2+|T|) + Σ(|Fx|+|Fy|+|M|/L), N: the source's cost.
    pub total_force: f64,
    /// Where it stands: the sum that admissible forces must have at least to balance, N, as far as a motion shows it
    /// ([`force_sum_lower_bound`](crate::proof::force_sum_lower_bound)).
    pub force_bound: Option<f64>,
    /// Whether the total force is no more than a millionth above that; where not, the forces balance, and a smaller sum may
    /// balance too.
    pub least_force: bool,
    /// The same sum over the sticking forces, N.
    pub total_sticking: f64,
    /// Sum of the placed blocks' weights, N.
    pub weight: f64,
    /// Forces at every interface between placed bodies.
    pub contacts: Vec<Contact>,
    /// What each holding robot gives.
    pub robots: Vec<RobotForce>,
    /// What would have to stick for the frame to stand. Empty where it stands.
    pub failures: Vec<Failure>,
    /// Blocks that no sticking could save: they reach neither ground nor a robot, or nothing there could take a moment.
    pub unsupported: Vec<BlockId>,
    /// How the blocks move where the frame falls, the fastest point with speed 1.
    pub mechanism: Vec<Motion>,
    /// How far it is from the edge of standing, where that was asked for.
    pub margins: Option<Margins>,
    /// Whether it stands only by a self-stress that its loads do not build up from rest, where that was asked for, it
    /// stands, and an answer was found.
    pub only_by_wedging: Option<bool>,
    /// What shows that it stands only by a self-stress, where it does.
    pub wedged: Option<Wedged>,
    /// Every effect, simulated or skipped.
    pub effects: Vec<EffectReport>,
    /// How well the verdict is proved.
    pub proof: Proof,
    /// How it was solved.
    pub solve: SolveReport,
    /// Things a reader should know that are no errors, such as contacts too short to count.
    pub notices: Vec<String>,
}

/// An interface and the admissible force it carries.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Contact {
    /// Where the two bodies touch; forces are those on `interface.bodies[0]`.
    pub interface: Interface,
    /// The two application points, metres.
    pub application_points: [Point; 2],
    /// Normal forces N1, N2 at them, N, at least 0.
    pub normal_forces: [f64; 2],
    /// Friction force, N, signed along (−n_y, n_x).
    pub friction_force: f64,
    /// The interface's one force.
    pub resultant: Resultant,
    /// |T| / (μ ΣN), 0 without force.
    pub friction_used: f64,
}

/// What a robot gives to the block it holds.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct RobotForce {
    /// The robot.
    pub robot: RobotId,
    /// The block it holds.
    pub block: BlockId,
    /// The grip point, metres.
    pub at: Point,
    /// Force on the block, N.
    pub force: Vector,
    /// Torque on the block, N·m.
    pub torque: f64,
    /// Largest share of a limit that is used, 0 where nothing is limited.
    pub limit_used: f64,
}

/// One thing that would have to stick, or one thing a robot would have to give beyond its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Failure {
    /// A pull across an interface, at one of its application points.
    Tension {
        /// The two bodies; `force` acts on the first.
        bodies: [BodyId; 2],
        /// Where.
        at: Point,
        /// The pull on `bodies[0]`, N.
        force: Vector,
    },
    /// Friction beyond what the pressure allows, drawn at the middle of the interface.
    Friction {
        /// The two bodies; `force` acts on the first.
        bodies: [BodyId; 2],
        /// Where.
        at: Point,
        /// The force on `bodies[0]`, N.
        force: Vector,
    },
    /// A force the robot's limits do not allow.
    RobotForce {
        /// The robot.
        robot: RobotId,
        /// The block it holds.
        block: BlockId,
        /// The grip point.
        at: Point,
        /// The missing force on the block, N.
        force: Vector,
    },
    /// A torque the robot's limit does not allow.
    RobotTorque {
        /// The robot.
        robot: RobotId,
        /// The block it holds.
        block: BlockId,
        /// The grip point.
        at: Point,
        /// The missing torque on the block, N·m.
        torque: f64,
    },
}

impl Failure {
    /// The point where it acts, metres.
    pub fn at(&self) -> Point {
        match *self {
            Failure::Tension { at, .. }
            | Failure::Friction { at, .. }
            | Failure::RobotForce { at, .. }
            | Failure::RobotTorque { at, .. } => at,
        }
    }

    /// The missing force, N, on the first body of a joint or on the block that a robot holds; zero for a torque.
    pub fn force(&self) -> Vector {
        match *self {
            Failure::Tension { force, .. }
            | Failure::Friction { force, .. }
            | Failure::RobotForce { force, .. } => force,
            Failure::RobotTorque { .. } => Vector::zeros(),
        }
    }

    /// The missing torque on the block that a robot holds, N·m; zero for a force.
    pub fn torque(&self) -> f64 {
        match *self {
            Failure::RobotTorque { torque, .. } => torque,
            _ => 0.0,
        }
    }

    /// The missing force on a body, N, and the missing torque, N·m; `None` if it does not act on that body.
    pub fn on(&self, body: BodyId) -> Option<(Vector, f64)> {
        let sign = match *self {
            Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. } => match bodies {
                [a, _] if a == body => 1.0,
                [_, b] if b == body => -1.0,
                _ => return None,
            },
            Failure::RobotForce { block, .. } | Failure::RobotTorque { block, .. } => {
                if BodyId::Block(block) != body {
                    return None;
                }
                1.0
            }
        };
        Some((self.force() * sign, self.torque()))
    }

    /// The robot whose limits are exceeded; `None` for a joint.
    pub fn robot(&self) -> Option<RobotId> {
        match *self {
            Failure::RobotForce { robot, .. } | Failure::RobotTorque { robot, .. } => Some(robot),
            Failure::Tension { .. } | Failure::Friction { .. } => None,
        }
    }
}

/// What is known of the components of earlier frames.
#[derive(Default)]
struct Known {
    findings: BTreeMap<Key, Findings>,
    intervals: BTreeMap<Key, ComponentIntervals>,
}

/// What makes one component the same as one of an earlier frame: its blocks, who holds them where, and L.
type Key = (Vec<BlockId>, Vec<(RobotId, BlockId, [u64; 2])>, u64);

impl Analysis {
    /// Examines every frame of a scene, which it keeps: a scene is moved in, an `Arc` shared, and a reference cloned.
    ///
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict};
    /// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
    ///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
    ///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }],
    ///     "loads": [{ "block": "a", "force": [2, 0], "at": [1, 1] }] }"#)?;
    /// let frame = &Analysis::new(&scene).frames[0];
    /// assert_eq!(frame.verdict, Verdict::Stable);
    /// assert_eq!(frame.contacts[0].resultant.force.y, 6.0);
    /// // The push at half height moves the resultant a third of a metre towards the far edge.
    /// assert!((frame.contacts[0].resultant.at.x - (2.5 + 1.0 / 3.0)).abs() < 1e-9);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn new(scene: impl Into<Arc<Scene>>) -> Analysis {
        Analysis::with(scene, &Options::default())
    }

    /// Examines every frame of a scene, and what else is asked for.
    pub fn with(scene: impl Into<Arc<Scene>>, options: &Options) -> Analysis {
        let scene = scene.into();
        let (found, mut frames) = analyse(&scene, options);
        gaps_closed::recheck(&scene, &found, &mut frames, options);
        let notes = gaps_closed::notes(&scene, &found);
        Analysis {
            scene,
            frames,
            notes,
        }
    }

    /// The worst verdict of all frames.
    pub fn verdict(&self) -> Verdict {
        self.frames
            .iter()
            .map(|f| f.verdict)
            .max()
            .unwrap_or(Verdict::Stable)
    }
}

impl From<&Scene> for Arc<Scene> {
    fn from(scene: &Scene) -> Arc<Scene> {
        Arc::new(scene.clone())
    }
}

/// An analysis may be handed to another thread, and read by several.
const _: () = {
    const fn shared<T: Send + Sync + 'static>() {}
    shared::<Analysis>();
    shared::<Scene>();
};

/// Analyses every frame of a scene, with gaps and overlaps as they are.
fn analyse(scene: &Scene, options: &Options) -> (Interfaces, Vec<FrameAnalysis>) {
    let found = Interfaces::new(scene);
    let frames = analyse_frames(scene, &found, options);
    (found, frames)
}

/// Analyses every frame of a scene with given interfaces.
fn analyse_frames(scene: &Scene, found: &Interfaces, options: &Options) -> Vec<FrameAnalysis> {
    let mut known = Known::default();
    let frames = scene.frames.iter();
    frames
        .map(|frame| {
            let interfaces = found.in_frame(scene, frame);
            let context = FrameContext {
                scene,
                frame,
                interfaces: &interfaces,
            };
            let mut analysis = analyse_frame(&context, *options, &mut known);
            analysis.notices.extend(found.notices.iter().cloned());
            analysis
        })
        .collect()
}

/// Analyses one frame.
fn analyse_frame(context: &FrameContext, options: Options, known: &mut Known) -> FrameAnalysis {
    let start = Instant::now();
    let (assembly, reports) = effect::assemble(context);
    let components = assembly.components();
    let keys: Vec<Key> = components.iter().map(key).collect();
    let mut stages = Stages {
        assembly: start.elapsed().as_secs_f64(),
        ..Stages::default()
    };
    let fresh: Vec<usize> = (0..components.len())
        .filter(|k| !known.findings.contains_key(&keys[*k]))
        .collect();
    let one = |k: &usize| {
        let _until = DeadlineGuard::new(options.deadline);
        decide_component(&components[*k], options)
    };
    // Many small components are worth the threads; the order of the results is that of the components either way.
    #[cfg(feature = "parallel")]
    let findings: Vec<Findings> = if fresh.len() > 16 {
        fresh.par_iter().map(one).collect()
    } else {
        fresh.iter().map(one).collect()
    };
    #[cfg(not(feature = "parallel"))]
    let findings: Vec<Findings> = fresh.iter().map(one).collect();
    let effort = findings
        .iter()
        .fold(Effort::default(), |sum, f| sum.and(f.effort));
    for (k, found) in fresh.iter().zip(findings) {
        known.findings.insert(keys[*k].clone(), found);
    }
    let found: Vec<(&Assembly, &Findings)> = components
        .iter()
        .zip(&keys)
        .filter_map(|(component, key)| Some((component, known.findings.get(key)?)))
        .collect();
    let mut analysis = gathered(context, &assembly, reports);
    for (component, found) in &found {
        add(&mut analysis, component, found, context.scene.kernel);
    }
    let count = found
        .iter()
        .fold(UnknownCounts::default(), |sum, f| sum.plus(&f.1.count));
    settle(&mut analysis, context, &count, options.verdict_only);
    if analysis.verdict == Verdict::Undecided && options.is_late() {
        analysis.doubts.insert(0, UndecidedReason::Late);
    }
    stages.solution = start.elapsed().as_secs_f64() - stages.assembly;
    let _until = DeadlineGuard::new(options.deadline);
    let methods = found.iter().map(|f| f.1.method);
    analysis.solve = SolveReport {
        method: methods.max().unwrap_or(Method::ClosedForm),
        iterations: effort.iterations,
        programs: effort.programs,
        groups: components.len(),
        reused: components.len() - fresh.len(),
        seconds: 0.0,
        stages,
    };
    let before = start.elapsed().as_secs_f64();
    let wedging = match (options.wedging, analysis.verdict) {
        (false, _) => Wedging::NotAsked,
        (true, Verdict::Stable) => {
            let components = found.iter().copied();
            let (only, shown, wedged) = decide::only_by_wedging(context.scene, components);
            (analysis.only_by_wedging, analysis.wedged) = (only, wedged);
            shown
        }
        (true, _) => Wedging::Falls,
    };
    let after = start.elapsed().as_secs_f64();
    analysis.solve.stages.wedging = after - before;
    let mut judged = None;
    if options.margins {
        let parts = found
            .iter()
            .zip(&keys)
            .map(|((component, found), key)| Part {
                component,
                key,
                found,
            });
        let parts: Vec<Part> = parts.collect();
        let (margins, tries) = margin::of(&parts, options.margin_kinds, &mut known.intervals);
        let name = |robot: RobotId| context.scene.robots[robot.0].id.clone();
        analysis.notices.extend(margins.intervals.withheld(name));
        analysis.margins = Some(margins);
        judged = Some(tries);
    }
    analysis.solve.stages.margins = start.elapsed().as_secs_f64() - after;
    analysis.effects.push(effect::margin::report(judged));
    analysis.effects.push(wedging::report(wedging));
    analysis.solve.seconds = start.elapsed().as_secs_f64();
    analysis
}

fn key(component: &Assembly) -> Key {
    let blocks = component.bodies.iter().map(|body| body.block);
    let holds = component.grips.iter().map(|grip| {
        let block = component.bodies[grip.body].block;
        (
            grip.robot,
            block,
            [grip.at.x.to_bits(), grip.at.y.to_bits()],
        )
    });
    (
        blocks.collect(),
        holds.collect(),
        component.length.to_bits(),
    )
}
