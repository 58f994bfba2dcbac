//! [`Kind`]: lists the kinds of figures. Each kind is implemented by a type in a separate file.

use super::block_arrows::BlockArrows;
use super::capacity::CarriedForces;
use super::compare::Comparison;
use super::flow::ForceFlow;
use super::freebody::FreeBody;
use super::joint_forces::{self, JointForces, about_build};
use super::joints::Joints;
use super::mechanism::Mechanism;
use super::option::{ArrowScale, At, Options};
use super::panel::{About, Figure};
use super::sensitivity::CornerEffects;
use super::structure::Structure;
use super::thrust::ThrustLine;
#[cfg(any(feature = "cli", feature = "wasm"))]
use crate::mechanics::analysis;
use crate::mechanics::analysis::{Analysis, Ask, MarginKind, MarginKinds, Question};
use crate::mechanics::scene::Scene;
#[cfg(any(feature = "cli", feature = "wasm"))]
use crate::mechanics::scene::{BlockId, Frame};
use crate::pictures::drawing::style::ForceMarks;
use crate::text::Word;

/// The largest number of placed blocks of all frames for which all margins are cheap, for which the factor on the loads
/// and the tilt are, and for which the factor on the loads of one frame is: a wall of 2 000 blocks takes 7 s for it. The
/// numbers count blocks, not seconds, so the same scene has the same figure on every machine.
#[cfg(any(feature = "cli", feature = "wasm"))]
const MAX_MARGIN_BLOCKS: [usize; 3] = [60, 140, 1000];
/// So many corners, each of which may touch other blocks, count as one more block.
#[cfg(any(feature = "cli", feature = "wasm"))]
const CORNERS_OF_A_BLOCK: usize = 200;

/// Returns the margins that a figure or a table computes without being asked: other margins of many blocks would take
/// far longer than the verdicts. Returns `None` if there are none.
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) fn cheap_margins(scene: &Scene) -> Option<MarginKinds> {
    let [all, main, one] = MAX_MARGIN_BLOCKS;
    let is_loaded = |frame: &Frame| scene.loads.iter().any(|load| frame.placed.contains(&load.block));
    let size = |block: &BlockId| 1 + scene.blocks[block.0].body.polygon.outline().len() / CORNERS_OF_A_BLOCK;
    let blocks = scene.frames.iter().flat_map(|frame| &frame.placed).map(size).sum::<usize>();
    // Each block may lie on every part of the ground.
    match blocks.max(scene.ground.len()) {
        count if count <= all => Some(MarginKinds::AS_IT_IS),
        count if count <= main => Some(MarginKinds::new(&[MarginKind::LoadFactor, MarginKind::Tilt])),
        count if count <= one && scene.frames.len() == 1 && is_loaded(&scene.frames[0]) => {
            Some(MarginKinds::new(&[MarginKind::LoadFactor]))
        }
        _ => None,
    }
}

/// The kind of a figure: what its panels show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// Every force at a joint as a mark in its place, and every missing force. On a lattice, arrows on the blocks.
    #[default]
    Forces,
    /// The paths of the forces through the blocks. The lines are as wide as the forces. In each block they lead from
    /// the forces that enter it to the forces that leave it.
    Flow,
    /// The mechanism of a frame that falls: dashed outlines of the blocks in their original positions, the displaced
    /// blocks, hinges and slips. With the option [`at`](Options::at), another motion: how a frame that stands falls just
    /// beyond a margin, with errors of placement or under a vehicle, or how it cracks as a support moves.
    Mechanism,
    /// The line of thrust through the blocks, from interface to interface.
    Thrust,
    /// At each joint the part in which its resultant is safe, the position of the resultant, and the used share of the
    /// available friction.
    Joints,
    /// The forces of every step of a construction. The arrows of all panels have the same scale.
    Build,
    /// The forces that a block can carry at a point, as a polygon at this point, and how the structure falls beyond its
    /// longest edges.
    Capacity,
    /// An arrow at each corner that shows in which direction to move the corner to make a margin larger. Up to ten of
    /// the most effective changes are numbered and listed.
    Sensitivity,
    /// The changes of blocks and forces from one frame to the next. The arrows of all panels have the same scale.
    Compare,
    /// The structure and its loads, without forces and without a verdict. If the analysis has found out which blocks may
    /// leave, their outlines show it.
    Structure,
    /// One block as a free body: all forces on it with their names, and a table of them. The option `block` names the
    /// block; the last frame that places it is shown.
    Freebody,
}

impl Kind {
    /// All kinds, in the order in which the help text lists them.
    pub const ALL: [Kind; 11] = [
        Kind::Forces,
        Kind::Flow,
        Kind::Mechanism,
        Kind::Thrust,
        Kind::Joints,
        Kind::Build,
        Kind::Capacity,
        Kind::Sensitivity,
        Kind::Compare,
        Kind::Structure,
        Kind::Freebody,
    ];

    /// Returns what draws a figure of this kind.
    pub(crate) fn drawer(self, options: &Options) -> &'static dyn Figure {
        match self {
            Kind::Forces | Kind::Build if options.theme.forces != ForceMarks::Blocks => &JointForces,
            Kind::Forces | Kind::Build => &BlockArrows,
            Kind::Flow => &ForceFlow,
            Kind::Mechanism => &Mechanism,
            Kind::Thrust => &ThrustLine,
            Kind::Joints => &Joints,
            Kind::Capacity => &CarriedForces,
            Kind::Sensitivity => &CornerEffects,
            Kind::Compare => &Comparison,
            Kind::Structure => &Structure,
            Kind::Freebody => &FreeBody,
        }
    }

    /// Returns the name, the description and the requirements of this kind of figure.
    pub(crate) fn about(self) -> About {
        match self {
            Kind::Build => about_build(),
            kind => kind.drawer(&Options::default()).about(),
        }
    }

    /// Returns the name of this kind of figure in lower case, such as `mechanism`.
    pub fn name(self) -> &'static str {
        self.about().name
    }

    /// Returns the kind of figure with this name; `None` if there is no such kind.
    pub fn from_name(name: &str) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Returns one line of text that describes this kind of figure, for a list of all kinds.
    pub fn help(self) -> &'static str {
        self.about().help
    }

    /// Returns the margins that the line of the verdict of a figure of one frame gives, if they are cheap.
    #[cfg(any(feature = "cli", feature = "wasm"))]
    fn line_margins(self, scene: &Scene, options: &Options) -> Option<MarginKinds> {
        let states = options.verdict_margin && self.about().states_margin && scene.frames.len() == 1;
        states.then(|| cheap_margins(scene)).flatten()
    }

    /// Returns the optional margins of a figure of this analysis: the figure shows them if they have been computed, and
    /// is complete without them. Returns `None` if there are no optional margins.
    pub fn stated_margins(self, analysis: &Analysis) -> Option<MarginKinds> {
        let kinds = self.drawer(&Options::default()).stated_margins(analysis);
        (!kinds.is_empty()).then(|| MarginKinds::new(kinds))
    }

    /// Returns what a user asks about a scene together with what a figure of this kind needs. A margin or a block that
    /// is needed, but not named, is the default of the scene.
    pub fn asks(self, scene: &Scene, user: Ask, options: &Options) -> Ask {
        let needs = [
            (Question::Placement, self == Kind::Mechanism && options.at == Some(At::Placement)),
            (Question::Sensitivity, self.needs_sensitivity()),
            (Question::Capacity, self.needs_capacity()),
        ];
        let needed = needs.into_iter().filter(|(_, is_needed)| *is_needed);
        let mut ask = needed.fold(user, |ask, (question, _)| ask.with(question, scene));
        ask.margins = self.needed_margin(options).map_or(ask.margins, |kind| ask.margins.with(kind));
        ask
    }

    /// Analyses a scene for a figure of this kind. If the line of the verdict gives a margin, the margins are computed too,
    /// provided that they are cheap.
    #[cfg(any(feature = "cli", feature = "wasm"))]
    pub(crate) fn analysed(
        self,
        scene: &Scene,
        mut analysis_options: analysis::Options,
        options: &Options,
    ) -> Analysis {
        let is_asked = !analysis_options.ask.margins.is_empty();
        if let Some(kinds) = self.line_margins(scene, options).filter(|_| !is_asked) {
            analysis_options = analysis_options.margins(kinds);
        }
        analysis_options.ask = self.asks(scene, analysis_options.ask, options);
        let analysis = Analysis::exact(scene, &analysis_options);
        match self.stated_margins(&analysis) {
            Some(kinds) if analysis_options.ask.margins.is_empty() => {
                Analysis::exact(scene, &analysis_options.margins(kinds))
            }
            _ => analysis,
        }
    }

    /// Returns the margin without which the figure is not complete: that of the motion which it shows, or of the forces.
    fn needed_margin(self, options: &Options) -> Option<MarginKind> {
        match self {
            Kind::Mechanism => options.at?.margin(),
            Kind::Joints => options.central.then_some(MarginKind::Kernel),
            _ => None,
        }
    }

    /// True if the figure needs the forces that a block can carry. The analysis computes them only on request
    /// ([`analysis::Ask::capacity`](crate::mechanics::analysis::Ask::capacity)).
    pub fn needs_capacity(self) -> bool {
        self.about().needs_capacity
    }

    /// True if the figure needs the derivatives of a margin. The analysis computes them only on request
    /// ([`analysis::Ask::sensitivity`](crate::mechanics::analysis::Ask::sensitivity)).
    pub fn needs_sensitivity(self) -> bool {
        self.about().needs_sensitivity
    }

    /// True if the figure shows only one block, in one frame.
    pub fn shows_one_block(self) -> bool {
        self.about().shows_one_block
    }

    /// Returns a copy of the options for a figure of this kind of a scene. A kind whose panels share one scale of arrows
    /// overrides the option `scale`, and a kind that shows no verdicts the option `verdicts`. The theme no longer depends
    /// on the scene.
    pub(crate) fn options(self, scene: &Scene, options: &Options) -> Options {
        let asks_for_source_look =
            matches!(self, Kind::Forces | Kind::Build) && joint_forces::asks_for_source_look(options);
        let theme = options.theme.for_scene(scene.lattice.is_some() || asks_for_source_look);
        let mut options = Options { theme, ..options.clone() };
        if asks_for_source_look {
            options.theme.forces = ForceMarks::Blocks;
        }
        if self.about().shares_arrow_scale {
            options.scale = ArrowScale::Strip;
        }
        options.verdicts &= !self.about().hides_verdicts;
        options
    }
}

impl Word for Kind {
    fn all() -> Vec<Kind> {
        Kind::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        self.name()
    }

    fn help(self) -> &'static str {
        self.about().help
    }
}
