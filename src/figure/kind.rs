//! [`Kind`]: what the panels of a figure show. One file per kind; here they meet.

use super::arrow::Marks;
use super::legend::{self, Entry};
use super::mark;
use super::option::Options;
use super::panel;
use super::stage::Stage;
use super::strip::strip;
use super::verdict;
use crate::analysis::Analysis;
use crate::drawing::{Camera, Drawing, Group};
use crate::geometry::Bounds;

/// What the panels of a figure show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Every force as an arrow on the block it acts on, and what is missing.
    #[default]
    Forces,
}

/// A figure of this kind, one panel per frame.
///
/// Units: the page is in pixels at natural size.
pub fn draw(analysis: &Analysis<'_>, kind: Kind, options: &Options) -> Drawing {
    strip(analysis, kind, options)
}

impl Kind {
    /// The title of a figure whose scene has none.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Kind::Forces => "Forces in a dry-laid structure",
        }
    }

    /// Whether blocks tell amplitudes by their colour; otherwise they are plain.
    pub(crate) fn tells_amplitudes(self) -> bool {
        match self {
            Kind::Forces => true,
        }
    }

    /// The arrows of a frame, `newtons_per_unit` N being one unit edge long.
    pub(crate) fn marks(
        self,
        analysis: &Analysis<'_>,
        frame: usize,
        options: &Options,
        newtons_per_unit: f64,
    ) -> Marks {
        match self {
            Kind::Forces => mark::marks(analysis, frame, options, newtons_per_unit),
        }
    }

    /// A box around what a frame's picture shows beside blocks, ground, robots and arrows.
    pub(crate) fn reach(
        self,
        _analysis: &Analysis<'_>,
        _frame: usize,
        _unit: f64,
    ) -> Option<Bounds> {
        match self {
            Kind::Forces => None,
        }
    }

    /// What the camera sees of a frame; ground is cut at the edge of `view`.
    pub(crate) fn picture(
        self,
        stage: &Stage<'_>,
        frame: usize,
        view: Bounds,
        camera: &Camera,
    ) -> Group {
        match self {
            Kind::Forces => panel::picture(stage, frame, view, camera),
        }
    }

    /// Everything that occurs in the figure, `unit` pixels being one unit edge.
    pub(crate) fn entries(self, stage: &Stage<'_>, unit: f64) -> Vec<Entry> {
        match self {
            Kind::Forces => legend::entries(stage, unit),
        }
    }

    /// What is said below a frame's verdict.
    pub(crate) fn reason(self, stage: &Stage<'_>, frame: usize) -> String {
        let (scene, found) = (stage.analysis.scene, &stage.analysis.frames[frame]);
        match self {
            Kind::Forces => verdict::reason(scene, found),
        }
    }
}
