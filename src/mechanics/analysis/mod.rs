//! [`Analysis`]: a scene with the results of all its frames.
//!
//! Everything here is in metres and newtons, in the axes of the scene (x right, y up). Figures and reports use only
//! these types. Components of a frame's assembly cannot influence each other and are solved separately. A component
//! that was solved in an earlier frame is not solved again. `decide` decides one component, and `analyse` combines the
//! components of a frame.

mod analyse;
mod ask;
mod capacity;
mod cases;
mod decide;
mod force;
mod undecided;
mod frame;
mod gather;
mod warm_start;
mod margin;
mod mechanism;
mod edge;
mod gaps_closed;
mod option;
mod pair;
mod placement;
mod position;
mod removable;
mod repeat;
mod wedged;
pub(crate) mod acting;
mod thrust_states;
mod movement;
mod answers;
mod condition;
mod corners;
mod vehicle;
mod sensitivity;
mod solved_frame;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

#[doc(inline)]
pub use crate::mechanics::proof::{Motion, Proof, ProofThreshold};
use crate::mechanics::scene::{BlockId, Note, Scene};
#[doc(inline)]
pub use crate::mechanics::statics::effect::{EffectName, EffectReport};
#[doc(inline)]
pub use crate::mechanics::statics::interface::{ContactKind, Interface};
#[doc(inline)]
pub use crate::mechanics::statics::resultant::Resultant;
pub use crate::mechanics::wedge::Slide;
pub(crate) use acting::{ActingForce, ForceKind, acting_forces, by_block};
pub use ask::{Ask, Question};
pub(crate) use capacity::capacity_of;
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) use capacity::typed_capacity;
pub use capacity::{
    CapacityEdge, CapacityError, CapacityRequest, CapacityShape, CapacityVertex, Cases, ForceAt, LoadCapacity,
    VertexForce,
};
#[cfg(feature = "certificate")]
pub(in crate::mechanics) use capacity::{extremes, with_grip};
pub use cases::{CaseResult, Envelope, LoadCases};
pub use condition::Condition;
pub use decide::Method;
#[cfg(feature = "certificate")]
pub(crate) use decide::mechanism_of;
pub use force::{Contact, Failure, RobotForce};
pub use frame::{SolveReport, Stages};
pub use margin::{End, Exclusion, Interval, Margin, MarginKind, MarginKinds, Margins, trials};
pub use movement::{Crack, Cracked, MovementOutcome, SupportMovement};
pub use option::{Accuracy, Options};
pub use pair::pair;
pub use placement::{BlockPlacement, Placement, PlacementError, PlacementLimit};
pub use position::VehiclePosition;
pub use removable::{Help, Removable};
pub use sensitivity::{CornerMoves, CornerSlope, EndSensitivity, LoadSlope, NoSensitivity, Sensitivity, Slope};
pub use solved_frame::SolvedFrame;
pub use thrust_states::{ThrustState, ThrustStates};
pub(in crate::mechanics) use undecided::INEXACT;
pub use undecided::UndecidedReason;
pub use vehicle::{Influence, UnderVehicle};
pub use warm_start::{Source, verdicts};
pub(crate) use warm_start::{WarmStart, hinges_on_gaps};
pub use wedged::{FaceCase, PointCase, RuledOut, Wedged};

/// Whether a frame stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// Admissible forces balance every block, and the proof shows them.
    Stable,
    /// Neither of the other verdicts is proved, or the verdict depends on narrow gaps, overlaps or very short
    /// contacts.
    Undecided,
    /// No admissible forces balance every block; the proof is a mechanism along which the loads do positive work.
    Unstable,
}

/// The word for [`Verdict::Stable`] in texts for people.
pub(crate) const STANDS: &str = "stands";
/// The word for [`Verdict::Unstable`] in texts for people.
pub(crate) const FALLS: &str = "falls";
/// The word for [`Verdict::Undecided`] in texts for people.
pub(crate) const UNDECIDED: &str = "undecided";

impl Verdict {
    /// Returns the word for this verdict in tables and figures: `stands`, `falls` or `undecided`.
    pub(crate) fn plain(self) -> &'static str {
        match self {
            Verdict::Stable => STANDS,
            Verdict::Unstable => FALLS,
            Verdict::Undecided => UNDECIDED,
        }
    }

    /// Returns the verb for this verdict in a sentence: `stands`, `falls` or `is undecided`.
    pub(crate) fn verb(self) -> &'static str {
        if self == Verdict::Undecided { "is undecided" } else { self.plain() }
    }

    /// Returns the name of this verdict in JSON results: `stable`, `undecided` or `unstable`.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Unstable => "unstable",
            Verdict::Undecided => "undecided",
        }
    }
}

/// Writes [`Verdict::word`].
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// A scene with the results of each of its frames.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Analysis {
    /// The scene as its author wrote it.
    given: Arc<Scene>,
    /// For each frame, the scene to which its results belong. Empty if all results belong to the given scene.
    of_frames: Vec<Arc<Scene>>,
    /// One entry per frame of the scene, in order. Frames in the same state share their results.
    pub frames: Vec<Arc<FrameAnalysis>>,
    /// How the scene was analysed, and what was asked.
    options: Options,
    /// Notes on things that are allowed but seldom intended: the notes of the scene, and notes on gaps that are
    /// nearly contacts.
    pub notes: Vec<Note>,
}

/// The results of one frame.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct FrameAnalysis {
    /// Whether the frame stands.
    pub verdict: Verdict,
    /// The reasons if the verdict is *undecided*; empty otherwise. [`FrameAnalysis::doubt`] writes them as a
    /// sentence.
    pub doubts: Vec<UndecidedReason>,
    /// The length L in metres. Torques are divided by it to compare them with forces. It is the median length of the
    /// frame's edge interfaces, or the median of the square roots of the blocks' areas if nothing touches.
    pub length: f64,
    /// The sum of all contact and robot forces, Σ(N1+N2+|T|) + Σ(|Fx|+|Fy|+|M|/L), N. The reported forces minimise it
    /// if [`least_force`](FrameAnalysis::least_force) is true.
    pub total_force: f64,
    /// A lower bound on the total force of all forces that balance the frame, N, proved by a motion
    /// ([`force_sum_lower_bound`](crate::mechanics::proof::force_sum_lower_bound)). `None` if the frame does not stand or no bound
    /// was proved.
    pub force_bound: Option<f64>,
    /// Whether the total force is proved to be the least: it exceeds `force_bound` by at most a millionth. If not,
    /// forces with a smaller sum may balance, too.
    pub least_force: bool,
    /// The sum of the magnitudes of all missing forces in `failures`, N; torques are divided by L.
    pub total_sticking: f64,
    /// Sum of the placed blocks' weights, N.
    pub weight: f64,
    /// Forces at every interface between placed bodies.
    pub contacts: Vec<Contact>,
    /// The force and torque of each robot that holds a block.
    pub robots: Vec<RobotForce>,
    /// The adhesion and the robot forces that are missing for the frame to stand. Empty if it stands.
    pub failures: Vec<Failure>,
    /// Blocks that no adhesion at the application points could hold: they are connected to neither ground nor a
    /// robot, or no connection can resist their moment.
    pub unsupported: Vec<BlockId>,
    /// Whether the verdict would be the other one if corners that touch carried force, or if they did not: a frame without
    /// `corner_contacts` that falls would stand, or one with them that stands would fall. Not computed if `options` request only
    /// the verdict, or for scenes with more than 1000 blocks.
    pub corners_decide: bool,
    /// How the blocks move if the frame falls; the fastest point has speed 1.
    pub mechanism: Vec<Motion>,
    /// How far the frame is from its limit of stability, if requested.
    pub margins: Option<Margins>,
    /// How a margin changes with corners, weights, friction and loads, if requested.
    pub sensitivity: Option<Sensitivity>,
    /// The results of the load cases, if the scene has any. All answers to questions hold in all cases; the forces, the
    /// failures and the mechanism are those of the worst case.
    pub cases: Option<LoadCases>,
    /// The answers for the loads of the listed forces only. Present if the answers above also hold in other conditions.
    pub(crate) alone: Option<Arc<Alone>>,
    /// How accurately the blocks must be placed, if requested and if the frame stands.
    pub placement: Option<Placement>,
    /// For each movement of a support that the scene lists: how the structure cracks and follows it. Empty if the frame
    /// does not stand.
    pub movements: Vec<SupportMovement>,
    /// Which blocks may leave, in the order of placing, if requested.
    pub removable: Option<Vec<Removable>>,
    /// The load factor for each position of the vehicle of the scene, if the frame stands without it.
    pub vehicle: Option<Influence>,
    /// Present if the frame stands alone, but not under the vehicle of the scene: all other results are then those with
    /// the axles as loads.
    pub under_vehicle: Option<UnderVehicle>,
    /// The forces that a block can carry, if requested and if the block is placed.
    pub capacity: Option<LoadCapacity>,
    /// Whether the frame stands only by a self-stress that its loads do not build up from rest. `None` if not
    /// requested, if the frame does not stand, or if no answer was found.
    pub only_by_wedging: Option<bool>,
    /// The proof that the frame stands only by a self-stress, if it does.
    pub wedged: Option<Wedged>,
    /// Every effect, simulated or skipped.
    pub effects: Vec<EffectReport>,
    /// How well the verdict is proved.
    pub proof: Proof,
    /// Whether forces or a motion prove the verdict in exact arithmetic. `None` if no certificate was made.
    pub exact: Option<bool>,
    /// How the frame was solved.
    pub solve: SolveReport,
    /// Remarks that are not errors, such as contacts too short to count.
    pub notices: Vec<String>,
}

/// Answers in a single condition.
#[derive(Clone, Debug, Default)]
pub(crate) struct Alone {
    margins: Option<Margins>,
    placement: Option<Placement>,
    capacity: Option<LoadCapacity>,
}

impl FrameAnalysis {
    /// Returns the margins for the weights and loads to which the forces of the frame belong.
    pub(crate) fn margins_alone(&self) -> Option<&Margins> {
        self.alone.as_ref().map_or(self.margins.as_ref(), |alone| alone.margins.as_ref())
    }

    /// Returns the placement tolerance for the weights and loads to which the forces of the frame belong.
    pub(crate) fn placement_alone(&self) -> Option<&Placement> {
        self.alone.as_ref().map_or(self.placement.as_ref(), |alone| alone.placement.as_ref())
    }

    /// Returns the capacity for the weights and loads to which the forces of the frame belong.
    #[cfg(feature = "certificate")]
    pub(crate) fn capacity_alone(&self) -> Option<&LoadCapacity> {
        self.alone.as_ref().map_or(self.capacity.as_ref(), |alone| alone.capacity.as_ref())
    }

    /// Returns the condition of the forces: the worst load case, with the vehicle if the frame falls under it.
    pub fn condition(&self) -> Condition {
        let case = self.cases.as_ref().map(|cases| cases.governing);
        Condition { case, position: self.under_vehicle.and_then(|under| under.position) }
    }
}

impl Analysis {
    /// Analyses every frame of a scene with default options. The analysis keeps the scene: a `Scene` is moved into it,
    /// an `Arc` is shared, and a scene behind a reference is cloned.
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

    /// Analyses every frame of a scene. `options` request additional results, such as margins.
    pub fn with(scene: impl Into<Arc<Scene>>, options: &Options) -> Analysis {
        let mut analysis = Analysis::decide(scene.into(), options);
        corners::add_corners(&mut analysis, options);
        analysis
    }

    /// The same, but does not ask whether corners decide.
    fn decide(scene: Arc<Scene>, options: &Options) -> Analysis {
        if !scene.cases.is_empty() {
            return Analysis::of_cases(scene, options);
        }
        let source = repeat::source_of_each(&scene.frames);
        let once = repeat::without_repeats(&scene, &source);
        let (interfaces, mut frames) = analyse::analyse(&once, options);
        gaps_closed::recheck(&once, &interfaces, &mut frames, options);
        capacity::add_capacities(&once, &interfaces, &mut frames, options);
        movement::add_movements(&once, &interfaces, &mut frames, options);
        removable::add_removables(&once, &interfaces, &mut frames, options);
        let governing = vehicle::decide_under_vehicle((&once, &scene), &interfaces, &mut frames, options);
        let notes = gaps_closed::notes(&once, &interfaces);
        let frames = repeat::with_repeats(frames, &source);
        if governing.iter().all(Option::is_none) {
            return Analysis { given: scene, of_frames: Vec::new(), frames, options: *options, notes };
        }
        let own = (0..source.len()).filter(|number| source[*number] == *number);
        let scenes: BTreeMap<usize, Arc<Scene>> =
            own.zip(governing).map(|(number, under)| (number, under.unwrap_or_else(|| scene.clone()))).collect();
        let of_frames = source.iter().map(|source| scenes[source].clone()).collect();
        Analysis { given: scene, of_frames, frames, options: *options, notes }
    }

    /// Returns how the scene was analysed, and what was asked.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Returns the worst verdict of all frames; stable if there are no frames.
    pub fn verdict(&self) -> Verdict {
        self.frames.iter().map(|f| f.verdict).max().unwrap_or(Verdict::Stable)
    }
}

impl From<&Scene> for Arc<Scene> {
    fn from(scene: &Scene) -> Arc<Scene> {
        Arc::new(scene.clone())
    }
}

/// Compiles only if analyses and scenes can be sent to another thread and shared by several threads.
const _: () = {
    const fn shared<T: Send + Sync + 'static>() {}
    shared::<Analysis>();
    shared::<Scene>();
};
