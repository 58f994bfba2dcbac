//! [`Analysis`]: a scene and all that was found out about it, frame by frame.
//!
//! Everything here is in the scene's own units (metres, newtons) and axes (x right, y up). Pictures and reports read
//! this and nothing deeper.

use crate::geometry::{Point, Vector};
use crate::interface::Interface;
use crate::scene::{BlockId, BodyId, RobotId, Scene};

/// Whether a frame stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// Admissible forces balance every block, and the proof shows them.
    Stable,
    /// No admissible forces do, and the proof shows a mechanism along which the loads do work.
    Unstable,
    /// Neither proof convinces.
    Undecided,
}

/// A scene and what was found out about each of its frames.
#[derive(Clone, Debug)]
pub struct Analysis<'s> {
    /// The scene examined.
    pub scene: &'s Scene,
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
    /// Blocks that no sticking could save: nothing they hang together with reaches ground or a robot.
    pub unsupported: Vec<BlockId>,
    /// How the blocks move where the frame falls, the fastest point with speed 1.
    pub mechanism: Vec<Motion>,
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

/// The one force that stands for both corners of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultant {
    /// The body it acts on; its partner gets the opposite.
    pub on: BodyId,
    /// The moment-equivalent point Σ N_k p_k / Σ N_k, metres (the middle where there is no force).
    pub at: Point,
    /// Normal and friction force together, N.
    pub force: Vector,
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

/// A block's virtual velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The block.
    pub block: BlockId,
    /// Velocity of its centroid.
    pub velocity: Vector,
    /// Turning, anticlockwise positive, per metre.
    pub spin: f64,
}

/// One effect in one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EffectReport {
    /// Its name.
    pub effect: &'static str,
    /// Whether it was simulated.
    pub simulated: bool,
    /// Why, in words.
    pub why: String,
    /// Unknowns it added, or saved where it was skipped.
    pub unknowns: usize,
}

/// How well a verdict is proved, from geometry and forces alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// Forces that balance; each number relative to the largest weight.
    Forces {
        /// Worst imbalance of a block, force or moment/L.
        worst_imbalance: f64,
        /// Worst pull at an application point.
        worst_pull: f64,
        /// Worst friction beyond μN.
        worst_slip: f64,
    },
    /// A mechanism; velocities relative to its fastest point.
    Mechanism {
        /// Power of the loads along it, relative to the largest weight; above 0.
        power: f64,
        /// Worst interpenetration or forbidden slip velocity at a contact or a grip.
        worst_violation: f64,
    },
}

/// How a frame was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveReport {
    /// Name of the method.
    pub method: &'static str,
    /// Iterations of all programs together.
    pub iterations: usize,
    /// Programs solved.
    pub programs: usize,
    /// Wall time in seconds.
    pub seconds: f64,
}
