//! [`Analysis`]: a scene and all that was found out about it, frame by frame.
//!
//! Everything here is in the scene's own units (metres, newtons) and axes (x right, y up). Pictures and reports read
//! this and nothing deeper. Groups of blocks that cannot influence each other are solved apart, and a group that has
//! been solved in an earlier frame is not solved again; `group` does one group, this file puts frames together.

mod frame;
mod group;
mod margin;
mod mechanism;
mod option;

use std::collections::BTreeMap;
use std::time::Instant;

use rayon::prelude::*;

pub use crate::effect::EffectReport;
use crate::effect::wedging::{self, Wedging};
use crate::effect::{self, Plan, Situation};
use crate::geometry::{Point, Vector};
use crate::interface::{Interface, Interfaces};
use crate::program::{Group, groups};
pub use crate::proof::{Demand, Motion, Proof};
pub use crate::resultant::Resultant;
use crate::resultant::{friction_used, of as resultant_of};
use crate::scene::{BlockId, BodyId, Frame, RobotId, Scene};
use crate::solve::Effort;
use frame::{settle, worst};
use group::{Findings, solved};
pub use margin::{Margin, Margins, RobotMargins, Sides};
pub use option::{Accuracy, Ask, Options};

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

/// A scene and what was found out about each of its frames.
#[derive(Clone, Debug)]
pub struct Analysis<'s> {
    /// The scene examined.
    pub scene: &'s Scene,
    /// L, the median interface length in metres, by which torques are weighed against forces.
    pub length: f64,
    /// One entry per frame of the scene, in order.
    pub frames: Vec<FrameAnalysis>,
}

/// What was found out about one frame.
#[derive(Clone, Debug)]
pub struct FrameAnalysis {
    /// Whether it stands.
    pub verdict: Verdict,
    /// Why it is undecided, in words, with both proofs' numbers; empty otherwise.
    pub doubt: String,
    /// Σ(N1+N2+|T|) + Σ(|Fx|+|Fy|+|M|/L), N: the source's cost.
    pub total_force: f64,
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

/// How a frame was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveReport {
    /// Name of the method.
    pub method: &'static str,
    /// Iterations of all programs together.
    pub iterations: usize,
    /// Programs solved for this frame; 0 where closed forms or earlier frames answered it.
    pub programs: usize,
    /// Groups of blocks that cannot influence each other.
    pub groups: usize,
    /// Groups answered by an earlier frame.
    pub reused: usize,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// What is known of the groups of earlier frames.
#[derive(Default)]
struct Known {
    findings: BTreeMap<Key, Findings>,
    margins: BTreeMap<Key, Margins>,
}

/// What makes one group the same as one of an earlier frame: its blocks and who holds them where.
type Key = (Vec<BlockId>, Vec<(RobotId, BlockId, [u64; 2])>);

impl<'s> Analysis<'s> {
    /// Examines every frame of a scene.
    ///
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict};
    /// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
    ///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
    ///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }],
    ///     "loads": [{ "block": "a", "force": [2, 0], "at": [1, 1] }] }"#)?;
    /// let frame = &Analysis::of(&scene).frames[0];
    /// assert_eq!(frame.verdict, Verdict::Stable);
    /// assert_eq!(frame.contacts[0].resultant.force.y, 6.0);
    /// // The push at half height moves the resultant a third of a metre towards the far edge.
    /// assert!((frame.contacts[0].resultant.at.x - (2.5 + 1.0 / 3.0)).abs() < 1e-9);
    /// # Ok::<(), drystone::scene::Problems>(())
    /// ```
    pub fn of(scene: &'s Scene) -> Analysis<'s> {
        Analysis::with(scene, &Options::default())
    }

    /// Examines every frame of a scene, and what else is asked for.
    pub fn with(scene: &'s Scene, options: &Options) -> Analysis<'s> {
        let found = Interfaces::of(scene);
        let length = Analysis::length_of(scene, &found);
        let mut known = Known::default();
        let frames = scene
            .frames
            .iter()
            .map(|frame| {
                let interfaces = found.in_frame(scene, frame);
                let mut analysis =
                    examined(scene, frame, &interfaces, length, *options, &mut known);
                analysis.notices.extend(found.notices.iter().cloned());
                analysis
            })
            .collect();
        Analysis {
            scene,
            length,
            frames,
        }
    }

    /// L: the median interface length, or the typical block's where nothing touches; metres.
    pub fn length_of(scene: &Scene, found: &Interfaces) -> f64 {
        found
            .typical_length()
            .unwrap_or_else(|| typical_block(scene))
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

/// A length to weigh torques by where nothing touches: the median block's square root of area.
fn typical_block(scene: &Scene) -> f64 {
    let mut sizes: Vec<f64> = scene
        .blocks
        .iter()
        .map(|b| b.body.polygon.area().sqrt())
        .collect();
    sizes.sort_by(f64::total_cmp);
    sizes
        .get(sizes.len().saturating_sub(1) / 2)
        .copied()
        .unwrap_or(1.0)
}

/// Examines one frame.
fn examined(
    scene: &Scene,
    frame: &Frame,
    interfaces: &[&Interface],
    length: f64,
    options: Options,
    known: &mut Known,
) -> FrameAnalysis {
    let start = Instant::now();
    let situation = Situation {
        scene,
        frame,
        interfaces,
    };
    let plan = effect::plan(&situation);
    let groups = groups(scene.blocks.len(), frame, interfaces);
    let keys: Vec<Key> = groups.iter().map(|g| key(frame, g)).collect();
    let fresh: Vec<usize> = (0..groups.len())
        .filter(|k| !known.findings.contains_key(&keys[*k]))
        .collect();
    let one = |k: &usize| solved(&situation, &plan, &groups[*k], length, options);
    // Many small groups are worth the threads; the order of the results is that of the groups either way.
    let findings: Vec<Findings> = if fresh.len() > 16 {
        fresh.par_iter().map(one).collect()
    } else {
        fresh.iter().map(one).collect()
    };
    let effort = findings
        .iter()
        .fold(Effort::default(), |sum, f| sum.and(f.effort));
    for (k, found) in fresh.iter().zip(findings) {
        known.findings.insert(keys[*k].clone(), found);
    }
    let mut analysis = gathered(scene, frame, interfaces, &plan);
    for (group, key) in groups.iter().zip(&keys) {
        if let Some(found) = known.findings.get(key) {
            add(&mut analysis, scene, frame, group, found, length);
        }
    }
    settle(&mut analysis, &situation);
    let mut judged = None;
    if options.margins == Ask::Yes {
        let (findings, ends) = (&known.findings, &mut known.margins);
        let (margins, tries) =
            margin::of(scene, frame, interfaces, &groups, findings, ends, length);
        analysis.margins = Some(margins);
        judged = Some(tries);
    }
    analysis.effects.push(effect::margin::report(judged));
    let wedging = match (options.wedging, analysis.verdict) {
        (Ask::No, _) => Wedging::NotAsked,
        (Ask::Yes, Verdict::Stable) => {
            let found = groups
                .iter()
                .zip(&keys)
                .filter_map(|(group, key)| Some((group, known.findings.get(key)?)));
            analysis.only_by_wedging =
                group::only_by_wedging(scene, frame, interfaces, &plan, found, length);
            match analysis.only_by_wedging {
                Some(_) => Wedging::Found,
                None => Wedging::Unclear,
            }
        }
        (Ask::Yes, _) => Wedging::Falls,
    };
    analysis.effects.push(wedging::report(wedging));
    analysis.solve = SolveReport {
        method: if effort.programs == 0 && fresh.len() == groups.len() {
            "closed form"
        } else {
            "kinematic"
        },
        iterations: effort.iterations,
        programs: effort.programs,
        groups: groups.len(),
        reused: groups.len() - fresh.len(),
        seconds: start.elapsed().as_secs_f64(),
    };
    analysis
}

fn key(frame: &Frame, group: &Group) -> Key {
    let holds = group.holds.iter().map(|h| {
        let hold = frame.holds[*h];
        (
            hold.robot,
            hold.block,
            [hold.at.x.to_bits(), hold.at.y.to_bits()],
        )
    });
    (group.blocks.clone(), holds.collect())
}

/// The frame before any group is added: every contact and grip without force.
fn gathered(scene: &Scene, frame: &Frame, interfaces: &[&Interface], plan: &Plan) -> FrameAnalysis {
    let contacts = interfaces
        .iter()
        .map(|interface| Contact {
            interface: (*interface).clone(),
            application_points: interface.application_points(scene.kernel),
            normal_forces: [0.0; 2],
            friction_force: 0.0,
            resultant: resultant_of(interface, scene.kernel, [0.0; 2], 0.0),
            friction_used: 0.0,
        })
        .collect();
    let robots = frame
        .holds
        .iter()
        .map(|h| RobotForce {
            robot: h.robot,
            block: h.block,
            at: h.at,
            force: Vector::zeros(),
            torque: 0.0,
            limit_used: 0.0,
        })
        .collect();
    FrameAnalysis {
        verdict: Verdict::Stable,
        doubt: String::new(),
        total_force: 0.0,
        total_sticking: 0.0,
        weight: frame.placed.iter().map(|b| scene.blocks[b.0].weight).sum(),
        contacts,
        robots,
        failures: Vec::new(),
        unsupported: Vec::new(),
        mechanism: Vec::new(),
        margins: None,
        only_by_wedging: None,
        effects: plan.reports.clone(),
        proof: Proof::Forces {
            worst_imbalance: 0.0,
            worst_share: 0.0,
            worst_pull: 0.0,
            worst_slip: 0.0,
        },
        solve: SolveReport {
            method: "kinematic",
            iterations: 0,
            programs: 0,
            groups: 0,
            reused: 0,
            seconds: 0.0,
        },
        notices: Vec::new(),
    }
}

/// Enters what was found for one group.
fn add(
    analysis: &mut FrameAnalysis,
    scene: &Scene,
    frame: &Frame,
    group: &Group,
    found: &Findings,
    length: f64,
) {
    for (number, (normal, friction)) in group.interfaces.iter().zip(&found.contacts) {
        let contact = &mut analysis.contacts[*number];
        contact.normal_forces = *normal;
        contact.friction_force = *friction;
        contact.resultant = resultant_of(&contact.interface, scene.kernel, *normal, *friction);
        contact.friction_used = friction_used(&contact.interface, *normal, *friction);
        analysis.total_force += normal[0] + normal[1] + friction.abs();
    }
    for (number, (force, torque)) in group.holds.iter().zip(&found.grips) {
        let limits = scene.robots[frame.holds[*number].robot.0].limits;
        let share = |amount: f64, limit: f64| {
            if limit.is_finite() && limit > 0.0 {
                amount.abs() / limit
            } else {
                0.0
            }
        };
        let robot = &mut analysis.robots[*number];
        robot.force = *force;
        robot.torque = *torque;
        robot.limit_used = share(force.x, limits.fx)
            .max(share(force.y, limits.fy))
            .max(share(*torque, limits.torque));
        analysis.total_force += force.x.abs() + force.y.abs() + torque.abs() / length;
    }
    analysis.total_sticking += found.total_sticking;
    analysis.failures.extend(found.failures.iter().copied());
    analysis.mechanism.extend(found.mechanism.iter().copied());
    if found.unsupported {
        analysis.unsupported.extend(group.blocks.iter().copied());
    }
    if found.verdict == Verdict::Undecided && !analysis.doubt.is_empty() {
        analysis.doubt.push_str("; ");
    }
    analysis.doubt.push_str(&found.doubt);
    analysis.proof = match (analysis.verdict, found.verdict) {
        // Groups of the same verdict: the worst of their numbers. Otherwise the worse verdict brings its own proof.
        (a, b) if a == b => worst(analysis.proof, found.proof),
        (a, b) if a < b => found.proof,
        _ => analysis.proof,
    };
    analysis.verdict = analysis.verdict.max(found.verdict);
}
