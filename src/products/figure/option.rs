//! [`Options`]: the options of a figure, such as its colours, its scale of arrows and its size.

use crate::mechanics::analysis::Toward;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::Theme;

/// Whether the force of an interface is drawn as one arrow or as components.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ForceStyle {
    /// The sum of normal and friction force as one arrow on each of the two bodies.
    #[default]
    Resultant,
    /// Normal and friction force as two arrows, as in the figures of the thesis.
    Components,
}

/// The force whose arrow is one unit length long. The unit length is the side of a lattice cell, or a typical size of a
/// block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Normalisation {
    /// The largest force that is drawn.
    #[default]
    Drawn,
    /// The largest weight, load or single unknown of the analysis (normal force of a corner, friction force of an
    /// interface, force component of a robot). Arrows of sums can then be longer than one unit length. Each block has a
    /// separate scale for its missing forces. The figures of the thesis use this scale.
    Source,
}

/// Whether each panel has its own scale of arrows or all panels share one scale.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ArrowScale {
    /// Each panel has its own scale.
    #[default]
    Panel,
    /// All panels have the same scale, so that lengths can be compared.
    Strip,
}

/// The quantity that the colours of blocks show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fill {
    /// The amplitude: the larger of a block's weight and the largest normal force on its interfaces. The scale ends at
    /// the largest amplitude in the figure.
    #[default]
    Amplitude,
    /// The largest mean pressure (normal force over area) on one of its interfaces, N/m². Corners have no area and are
    /// left out.
    Stress,
    /// The largest used fraction of the available friction on one of its interfaces.
    Friction,
    /// No quantity: blocks have one plain colour.
    None,
    /// The rule of the thesis, in its colours. A block that a robot holds shows the used fraction of the limits of
    /// this robot. Any other block shows its amplitude as a fraction of the smallest force limit of all robots. If no
    /// robot has a force limit, every block shows its amplitude as a fraction of the largest amplitude.
    Source,
}

/// Which forces of interfaces a free-body diagram shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Corners {
    /// For a block with at most three interfaces, the forces at both ends of each interface. For a block with more
    /// interfaces, one force for each interface. Forces that are zero are left out.
    #[default]
    Few,
    /// Every unknown force at every end of an interface with its name, even if it is zero. The lengths of arrows then
    /// show no magnitudes.
    All,
}

/// The options of a figure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Whether the force of an interface is drawn as one arrow or as components.
    pub style: ForceStyle,
    /// The force whose arrow is one unit length long.
    pub normalisation: Normalisation,
    /// Whether each panel has its own scale of arrows or all panels share one scale.
    pub scale: ArrowScale,
    /// The quantity that the colours of blocks show.
    pub fill: Fill,
    /// Which forces of interfaces a free-body diagram shows.
    pub corners: Corners,
    /// The parameter that [`Kind::Margin`](super::Kind::Margin) changes until a frame falls.
    pub toward: Toward,
    /// How far the blocks of a mechanism are drawn along their paths: 0 at the beginning, 1 at the end.
    pub motion_progress: f64,
    /// The number of panels in a row; `None` to choose it by the shape of the panels.
    pub columns: Option<usize>,
    /// Colours, widths and font sizes.
    pub theme: Theme,
    /// Whether the title of the figure is drawn.
    pub titles: bool,
    /// Whether the captions of frames are drawn.
    pub captions: bool,
    /// Whether verdicts and the texts below them are drawn. A free-body diagram ignores this option.
    pub verdicts: bool,
    /// Whether the scale of arrows and the legend are drawn; in a free-body diagram also the verdict, the notes and the
    /// list of forces.
    pub keys: bool,
    /// Whether a scale bar in metres is drawn.
    pub scale_bar: bool,
    /// Whether dimension lines show the width and height of all blocks of a frame.
    pub dimensions: bool,
    /// Whether [`Kind::Thrust`](super::Kind::Thrust) also shows the force polygon next to the structure: a load line, a
    /// pole, and a ray for each joint.
    pub with_polygon: bool,
    /// The block in the centre of a zoomed picture. The picture only shows this block and its surroundings. `None` for
    /// the whole structure.
    pub zoom: Option<BlockId>,
    /// Whether blocks and robots have labels with their names, and loads, missing forces and the largest forces have
    /// labels with their magnitudes. In frames with more than 60 blocks, most blocks have no names.
    pub labels: bool,
    /// Whether all arrows have labels with their magnitudes, in frames with at most 60 blocks. If a frame has more than
    /// 200 magnitudes, only the largest are written.
    pub amounts: bool,
    /// Width of the page, pixels; `None` to choose it by the content. Font sizes do not depend on this width. Only on a
    /// page as narrow as a column of print, the texts around the picture become smaller if they would need more space
    /// than the picture.
    pub width: Option<f64>,
    /// Largest height of the picture of a frame without its legend, pixels. `None` to choose it by the number of
    /// frames.
    pub height: Option<f64>,
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
            motion_progress: 1.0,
            columns: None,
            theme: Theme::default(),
            titles: true,
            captions: true,
            verdicts: true,
            keys: true,
            scale_bar: false,
            dimensions: false,
            with_polygon: false,
            zoom: None,
            labels: true,
            amounts: false,
            width: None,
            height: None,
        }
    }
}

/// A page narrower than this, pixels, is a column of print. In print, this width is 110 mm.
const PRINT_COLUMN: f64 = 520.0;

impl Options {
    setters! {
        style: ForceStyle, "Whether the force of an interface is drawn as one arrow or as components.";
        normalisation: Normalisation, "Which force has an arrow that is one unit length long.";
        scale: ArrowScale, "Whether each panel has its own scale of arrows or all panels share one scale.";
        fill: Fill, "The quantity that the colours of blocks show, such as stresses.";
        corners: Corners, "Which forces of interfaces a free-body diagram shows.";
        toward: Toward, "The parameter that [`Kind::Margin`](super::Kind::Margin) changes until a frame falls.";
        motion_progress: f64, "How far the blocks of a mechanism are drawn along their paths: 0 at the beginning, 1 at the end.";
        theme: Theme, "Colours, widths and font sizes.";
        titles: bool, "Whether the title of the figure is drawn.";
        captions: bool, "Whether the captions of frames are drawn.";
        verdicts: bool, "Whether verdicts and the texts below them are drawn. A free-body diagram ignores this option.";
        keys: bool, "Whether the scale of arrows and the legend are drawn; in a free-body diagram also the verdict, the notes and the list of forces.";
        scale_bar: bool, "Whether a scale bar in metres is drawn.";
        dimensions: bool, "Whether dimension lines show the width and height of all blocks of a frame.";
        with_polygon: bool, "Whether [`Kind::Thrust`](super::Kind::Thrust) also shows the force polygon.";
        labels: bool, "Whether labels show the names of blocks and robots, and the magnitudes of the main forces.";
        amounts: bool, "Whether all arrows have labels with their magnitudes, in frames with at most 60 blocks.";
    }

    optional_setters! {
        columns: usize, "The number of panels in a row.";
        zoom: BlockId, "The block in the centre of a zoomed picture, which shows only this block and its surroundings.";
        width: f64, "Width of the page, pixels. On a page narrower than 520, texts are shorter; they are also smaller if the pictures would take less than 55 % of the height of the page.";
        height: f64, "Largest height of the picture of a frame without its legend, pixels.";
    }

    /// True if arrows look as in the printed figures of the thesis: separate arrows for the components of forces, at
    /// the scale of the thesis.
    pub(crate) fn printed(&self) -> bool {
        self.normalisation == Normalisation::Source && self.style == ForceStyle::Components
    }

    /// True if the page is as narrow as a column of print. Texts are then shorter, and lines closer together.
    pub(crate) fn is_column(&self) -> bool {
        self.width.is_some_and(|width| width < PRINT_COLUMN)
    }
}
