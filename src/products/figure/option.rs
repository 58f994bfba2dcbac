//! [`Options`]: the options of a figure of forces.

use crate::analysis::Toward;
use crate::drawing::Theme;
use crate::scene::BlockId;

/// How the force of an interface is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ForceStyle {
    /// Normal and friction force as one arrow on each of the two bodies.
    #[default]
    Resultant,
    /// Normal and friction force as two arrows, as the source's printed figures have it.
    Components,
}

/// Which amplitude is one unit long.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Normalisation {
    /// The largest amplitude that is drawn.
    #[default]
    Drawn,
    /// The largest single unknown of the program: a corner's normal force, an interface's friction, a robot's component,
    /// or a weight. Sums of them are then longer than one unit; what fails has its own scale, block by block. The
    /// source's figures are drawn so.
    Source,
}

/// Over what the scale of arrows is shared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ArrowScale {
    /// Each panel has its own.
    #[default]
    Panel,
    /// All panels share one, so that lengths compare between them.
    Strip,
}

/// What the colours of blocks tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fill {
    /// The larger of a block's weight and the largest normal force of one of its interfaces, on a scale from 0 to the
    /// largest in the figure.
    #[default]
    Amplitude,
    /// The largest mean pressure, normal force over area, on one of its interfaces, N/m². A corner has no area and is
    /// left out.
    Stress,
    /// The largest share of the friction available that one of its interfaces uses.
    Friction,
    /// Nothing: blocks are plain.
    None,
    /// The rule of the source, in its colours: a held block tells how far its robot is used, every other its amplitude as
    /// a share of the smallest limit of all robots; where no robot has a limit, of the largest in the figure.
    Source,
}

/// Which forces of its interfaces a free-body diagram shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Corners {
    /// Those at both ends of every interface where there are at most three, one for each interface where there are more;
    /// what is zero is left out.
    #[default]
    Few,
    /// Every unknown of the program at every end, by name, also those that are zero; arrows then only name forces.
    All,
}

/// The choices about a figure of forces.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How the force of an interface is drawn.
    pub style: ForceStyle,
    /// Which amplitude is one unit long.
    pub normalisation: Normalisation,
    /// Over what the scale of arrows is shared.
    pub scale: ArrowScale,
    /// What the colours of blocks tell.
    pub fill: Fill,
    /// Which forces of its interfaces a free-body diagram shows.
    pub corners: Corners,
    /// In which direction [`Kind::Margin`](super::Kind::Margin) follows a frame until it falls.
    pub toward: Toward,
    /// How much of the way a mechanism is drawn along, 0 … 1.
    pub way: f64,
    /// Panels beside each other; chosen by their shape where `None`.
    pub columns: Option<usize>,
    /// Colours.
    pub theme: Theme,
    /// Whether the figure's title is written.
    pub titles: bool,
    /// Whether the frames' captions are written.
    pub captions: bool,
    /// Whether verdicts and what is written below them are shown.
    pub verdicts: bool,
    /// Whether the scale of arrows and the key are shown.
    pub keys: bool,
    /// Whether a bar of a round number of metres is shown.
    pub scale_bar: bool,
    /// Whether the width and the height of all blocks of a frame are measured at its edges.
    pub dimensions: bool,
    /// The block whose neighbourhood alone is shown; everything where `None`.
    pub zoom: Option<BlockId>,
    /// Whether blocks and robots bear their names, in frames of at most 60 blocks.
    pub labels: bool,
    /// Whether arrows bear their amounts, in frames of at most 60 blocks.
    pub amounts: bool,
    /// Width of the page, pixels; chosen by what is on it where `None`. Words keep their size whatever the width.
    pub width: Option<f64>,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            style: ForceStyle::default(),
            normalisation: Normalisation::default(),
            scale: ArrowScale::default(),
            fill: Fill::default(),
            corners: Corners::default(),
            toward: Toward::default(),
            way: 1.0,
            columns: None,
            theme: Theme::default(),
            titles: true,
            captions: true,
            verdicts: true,
            keys: true,
            scale_bar: false,
            dimensions: false,
            zoom: None,
            labels: true,
            amounts: false,
            width: None,
        }
    }
}

impl Options {
    setters! {
        style: ForceStyle, "How the force of an interface is drawn.";
        normalisation: Normalisation, "Which amplitude is one unit long.";
        scale: ArrowScale, "Over what the scale of arrows is shared.";
        fill: Fill, "What the colours of blocks tell.";
        corners: Corners, "Which forces of its interfaces a free-body diagram shows.";
        toward: Toward, "In which direction [`Kind::Margin`](super::Kind::Margin) follows a frame until it falls.";
        way: f64, "How much of the way a mechanism is drawn along, 0 … 1.";
        theme: Theme, "Colours.";
        titles: bool, "Whether the figure's title is written.";
        captions: bool, "Whether the frames' captions are written.";
        verdicts: bool, "Whether verdicts and what is written below them are shown.";
        keys: bool, "Whether the scale of arrows and the key are shown.";
        scale_bar: bool, "Whether a bar of a round number of metres is shown.";
        dimensions: bool, "Whether the width and the height of all blocks of a frame are measured at its edges.";
        labels: bool, "Whether blocks and robots bear their names, in frames of at most 60 blocks.";
        amounts: bool, "Whether arrows bear their amounts, in frames of at most 60 blocks.";
    }

    optional_setters! {
        columns: usize, "Panels beside each other.";
        zoom: BlockId, "The block whose neighbourhood alone is shown.";
        width: f64, "Width of the page, pixels. Words keep their size whatever the width.";
    }

    /// Whether arrows look like those in the printed figures of the source: separate components, in the scale of the
    /// source.
    pub(crate) fn printed(&self) -> bool {
        self.normalisation == Normalisation::Source && self.style == ForceStyle::Components
    }
}
