//! [`Kind`]: the kinds of figures. Each is a type in a file of its own; here they are listed.

use super::compare::Comparison;
use super::content::PanelContent;
use super::context::FigureContext;
use super::flow::ForceFlow;
use super::forces::{BUILD, FORCES};
use super::kernel::Kernel;
use super::margin::CollapseMargin;
use super::mechanism::Mechanism;
use super::option::{ArrowScale, Options};
use super::polygon::ForcePolygon;
use super::thrust::ThrustLine;
use super::utilisation::Utilisation;
use crate::analysis::{Analysis, MarginKinds};

/// What the panels of a figure show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// Every force as an arrow on the block it acts on, and the forces that are missing.
    #[default]
    Forces,
    /// How the forces run through the blocks: lines as wide as the forces, from where forces enter a block to where they
    /// leave it.
    Flow,
    /// How the blocks of a frame that falls begin to move: dashed outlines where they stand, the blocks displaced as
    /// rigid bodies, hinges and slips.
    Mechanism,
    /// The line of thrust through the blocks, from interface to interface.
    Thrust,
    /// The stretch of each interface within which its resultant is safe, and where in it the resultant lies.
    Kernel,
    /// Friction used as a share of the friction available at each interface, and the share of its limits that each robot
    /// uses.
    Utilisation,
    /// The forces of every step of a construction, with arrows to one scale in all panels.
    Build,
    /// The external forces on the structure, and their force polygon, tip to tail.
    Polygon,
    /// The structure as it stands, and as a ghost how it falls just beyond its margin: gravity turned, a horizontal push
    /// added, or the loads increased.
    Margin,
    /// What changed from one frame to the next: blocks and forces, with arrows to one scale in all panels.
    Compare,
}

impl Kind {
    /// All kinds, in the order in which help lists them.
    pub const ALL: [Kind; 10] = [
        Kind::Forces,
        Kind::Flow,
        Kind::Mechanism,
        Kind::Thrust,
        Kind::Kernel,
        Kind::Utilisation,
        Kind::Build,
        Kind::Polygon,
        Kind::Margin,
        Kind::Compare,
    ];

    /// What its panels show.
    pub(crate) fn content(self) -> &'static dyn PanelContent {
        match self {
            Kind::Forces => &FORCES,
            Kind::Flow => &ForceFlow,
            Kind::Mechanism => &Mechanism,
            Kind::Thrust => &ThrustLine,
            Kind::Kernel => &Kernel,
            Kind::Utilisation => &Utilisation,
            Kind::Build => &BUILD,
            Kind::Polygon => &ForcePolygon,
            Kind::Margin => &CollapseMargin,
            Kind::Compare => &Comparison,
        }
    }

    /// Its name, in small letters.
    pub fn name(self) -> &'static str {
        self.content().name()
    }

    /// The kind with this name.
    pub fn from_name(name: &str) -> Option<Kind> {
        Kind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// One line that says what it shows, for a list of all kinds.
    pub fn help(self) -> &'static str {
        self.content().help()
    }

    /// The margins that a figure of this analysis states or draws from, where they were computed; `None` for none.
    pub fn stated_margins(self, analysis: &Analysis) -> Option<MarginKinds> {
        let kinds = self.content().stated_margins(analysis);
        (!kinds.is_empty()).then(|| MarginKinds::new(kinds))
    }

    /// Whether it shows margins, which the analysis computes only on request
    /// ([`analysis::Options::margins`](crate::analysis::Options::margins)).
    pub fn needs_margins(self) -> bool {
        self.content().needs_margins()
    }

    /// The options, with those replaced that the kind decides itself.
    pub(crate) fn options(self, options: &Options) -> Options {
        let mut options = options.clone();
        if self.content().shares_arrow_scale() {
            options.scale = ArrowScale::Strip;
        }
        options
    }

    /// What all panels of a figure of this kind share.
    pub(crate) fn context<'a>(
        self,
        analysis: &'a Analysis,
        options: &'a Options,
    ) -> FigureContext<'a> {
        FigureContext::new(analysis, options, self.content())
    }
}
