//! [`Kind`]: what the panels of a figure show. One file per kind; here they meet.

use super::arrow::Marks;
use super::collapse;
use super::compare;
use super::displacement::{self, Displacement};
use super::kernel;
use super::legend::{self, Entry};
use super::margin;
use super::mark;
use super::mechanism;
use super::option::{ArrowScale, Options};
use super::panel;
use super::polygon;
use super::stage::{Content, FigureContext};
use super::thrust;
use super::utilisation;
use super::verdict;
use crate::analysis::Analysis;
use crate::drawing::{Camera, Group};
use crate::geometry::Bounds;

/// What the panels of a figure show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// Every force as an arrow on the block it acts on, and what is missing.
    #[default]
    Forces,
    /// Where a frame falls, how its blocks begin to move: where they stand as dashed outlines, displaced along their
    /// motion as rigid bodies; its hinges and slips.
    Mechanism,
    /// The line of thrust through the blocks, from interface to interface.
    Thrust,
    /// The stretch of each interface within which its resultant is safe, and where in it the resultant sits.
    Kernel,
    /// Friction used of friction available at each interface, and of its limits by each robot.
    Utilisation,
    /// The forces of every step of a construction, arrows to one scale in all of them.
    Build,
    /// The forces on the structure from outside, and beside it their polygon, tip to tail.
    Polygon,
    /// The structure as it stands, and as a ghost how it falls just beyond its margin: once gravity has turned, a
    /// horizontal push has come, or its loads have grown so far.
    Margin,
    /// What changed from one frame to the next: blocks and forces, arrows to one scale in all of them.
    Compare,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Kind; 9] = [
        Kind::Forces,
        Kind::Mechanism,
        Kind::Thrust,
        Kind::Kernel,
        Kind::Utilisation,
        Kind::Build,
        Kind::Polygon,
        Kind::Margin,
        Kind::Compare,
    ];

    /// Its name, in small letters.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Forces => "forces",
            Kind::Mechanism => "mechanism",
            Kind::Thrust => "thrust",
            Kind::Kernel => "kernel",
            Kind::Utilisation => "utilisation",
            Kind::Build => "build",
            Kind::Polygon => "polygon",
            Kind::Margin => "margin",
            Kind::Compare => "compare",
        }
    }

    /// The kind of a name.
    pub fn named(name: &str) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The options with what the kind itself decides.
    pub(crate) fn options(self, options: &Options) -> Options {
        let mut options = options.clone();
        if matches!(self, Kind::Build | Kind::Compare) {
            options.scale = ArrowScale::Strip;
        }
        options
    }

    /// What all panels of a figure of this kind share.
    pub(crate) fn stage<'a>(
        self,
        analysis: &'a Analysis,
        options: &'a Options,
    ) -> FigureContext<'a> {
        let content = Content {
            tells_amplitudes: self.tells_amplitudes(),
            draws_forces: self.draws_forces(),
            strikes_names: self == Kind::Margin,
            largest: &|frame| self.largest(analysis, frame, options),
            marks: &|frame, reference| self.marks(analysis, frame, options, reference),
            reach: &|frame, unit, marks| self.reach(analysis, frame, unit, marks, options),
            displaced: &|frame, unit| self.displacements(analysis, frame, unit, options.way),
        };
        let mut stage = FigureContext::new(analysis, options, &content);
        let frames = 0..analysis.frames.len();
        stage.statements = frames.map(|frame| self.reason(&stage, frame)).collect();
        stage
    }

    /// The title of a figure whose scene has none.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Kind::Forces | Kind::Build => "Forces in a dry-laid structure",
            Kind::Mechanism => "How a dry-laid structure falls",
            Kind::Thrust => "The line of thrust in a dry-laid structure",
            Kind::Kernel => "Resultants in the safe stretches of interfaces",
            Kind::Utilisation => "Friction used in a dry-laid structure",
            Kind::Polygon => "The force polygon of a dry-laid structure",
            Kind::Margin => "How far a dry-laid structure is from falling",
            Kind::Compare => "What changes in a dry-laid structure",
        }
    }

    /// Whether blocks tell amplitudes by their colour; otherwise they are plain.
    fn tells_amplitudes(self) -> bool {
        matches!(self, Kind::Forces | Kind::Build)
    }

    /// Whether it draws the forces on each block.
    fn draws_forces(self) -> bool {
        matches!(
            self,
            Kind::Forces | Kind::Build | Kind::Polygon | Kind::Compare
        )
    }

    /// The amount that a frame's own scale takes as one unit edge, N; 0 where the kind draws no arrows.
    fn largest(self, analysis: &Analysis, frame: usize, options: &Options) -> f64 {
        let scene = &analysis.scene;
        let (placed, found) = (&scene.frames[frame], &analysis.frames[frame]);
        match self {
            _ if self.draws_forces() => mark::largest(scene, placed, found, options),
            Kind::Thrust => thrust::largest_load(scene, placed),
            Kind::Margin => margin::largest_load(scene, placed, options),
            _ => 0.0,
        }
    }

    /// The arrows of a frame, `newtons_per_unit` N being one unit edge long.
    fn marks(
        self,
        analysis: &Analysis,
        frame: usize,
        options: &Options,
        newtons_per_unit: f64,
    ) -> Marks {
        match self {
            Kind::Forces | Kind::Build | Kind::Compare => {
                mark::marks(analysis, frame, options, newtons_per_unit)
            }
            // Of a margin of the loads they are shown, as in a line of thrust.
            Kind::Thrust | Kind::Margin => {
                thrust::marks(analysis, frame, options, newtons_per_unit)
            }
            Kind::Polygon => polygon::marks(analysis, frame, options, newtons_per_unit),
            _ => Marks::default(),
        }
    }

    /// A box around what a frame's picture shows beside blocks, ground, robots and arrows.
    fn reach(
        self,
        analysis: &Analysis,
        frame: usize,
        unit: f64,
        marks: &Marks,
        options: &Options,
    ) -> Option<Bounds> {
        match self {
            Kind::Polygon => polygon::reach(analysis, frame, marks),
            Kind::Margin => margin::reach(analysis, frame, unit, options),
            Kind::Compare => compare::reach(analysis, frame),
            _ => mechanism::reach(analysis, &self.displacements(analysis, frame, unit, 1.0)),
        }
    }

    /// How each block of a frame is displaced along this share of its way, by its number; empty where all are drawn in
    /// their places.
    fn displacements(
        self,
        analysis: &Analysis,
        frame: usize,
        unit: f64,
        share: f64,
    ) -> Vec<Option<Displacement>> {
        match self {
            Kind::Mechanism => displacement::displacements(analysis, frame, unit, share),
            _ => Vec::new(),
        }
    }

    /// What the camera sees of a frame; ground is cut at the edge of `view`.
    pub(crate) fn picture(
        self,
        stage: &FigureContext<'_>,
        frame: usize,
        view: Bounds,
        camera: &Camera,
    ) -> Group {
        match self {
            Kind::Forces | Kind::Build => panel::picture(stage, frame, view, camera),
            Kind::Mechanism => mechanism::picture(stage, frame, view, camera),
            Kind::Thrust => thrust::picture(stage, frame, view, camera),
            Kind::Kernel => kernel::picture(stage, frame, view, camera),
            Kind::Utilisation => utilisation::picture(stage, frame, view, camera),
            Kind::Polygon => polygon::picture(stage, frame, view, camera),
            Kind::Margin => margin::picture(stage, frame, view, camera),
            Kind::Compare => compare::picture(stage, frame, view, camera),
        }
    }

    /// Everything that occurs in the figure, `unit` pixels being one unit edge.
    pub(crate) fn entries(self, stage: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        match self {
            Kind::Forces | Kind::Build => legend::entries(stage, unit),
            Kind::Mechanism => mechanism::entries(stage),
            Kind::Thrust => thrust::entries(stage, unit),
            Kind::Kernel => kernel::entries(stage),
            Kind::Utilisation => utilisation::entries(stage),
            Kind::Polygon => polygon::entries(stage, unit),
            Kind::Margin => margin::entries(stage),
            Kind::Compare => compare::entries(stage, unit),
        }
    }

    /// What is written below a frame's verdict.
    fn reason(self, stage: &FigureContext<'_>, frame: usize) -> String {
        let (scene, found) = (&stage.analysis.scene, &stage.analysis.frames[frame]);
        match self {
            Kind::Forces | Kind::Build => verdict::reason(scene, found),
            Kind::Mechanism => collapse::reason(stage.analysis, frame),
            Kind::Thrust => thrust::reason(scene, found),
            Kind::Kernel => kernel::reason(scene, found),
            Kind::Utilisation => utilisation::reason(scene, found),
            Kind::Polygon => polygon::reason(stage, frame),
            Kind::Margin => margin::reason(stage, frame),
            Kind::Compare => compare::reason(stage.analysis, frame),
        }
    }
}
