//! [`Options`]: the choices a reader has about a figure of forces.

use crate::drawing::Theme;

/// How the force of an interface is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ForceStyle {
    /// Normal and friction force as one arrow on each of the two bodies.
    #[default]
    Resultant,
    /// Normal and friction force as two arrows, as the source's printed figures have it.
    Components,
}

/// Which amplitude is one unit long.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
pub enum ArrowScale {
    /// Each panel has its own.
    #[default]
    Panel,
    /// All panels share one, so that lengths compare between them.
    Strip,
}

/// Which forces of its interfaces a free-body diagram shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
pub struct Options {
    /// How the force of an interface is drawn.
    pub style: ForceStyle,
    /// Which amplitude is one unit long.
    pub normalisation: Normalisation,
    /// Over what the scale of arrows is shared.
    pub scale: ArrowScale,
    /// Which forces of its interfaces a free-body diagram shows.
    pub corners: Corners,
    /// How much of the way a mechanism is drawn along, 0 … 1.
    pub way: f64,
    /// Panels beside each other; chosen by their shape where `None`.
    pub columns: Option<usize>,
    /// Colours.
    pub theme: Theme,
    /// Whether titles and captions are written.
    pub captions: bool,
    /// Whether verdicts, scales and the key are shown.
    pub keys: bool,
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
            corners: Corners::default(),
            way: 1.0,
            columns: None,
            theme: Theme::default(),
            captions: true,
            keys: true,
            labels: true,
            amounts: false,
            width: None,
        }
    }
}

impl Options {
    /// Whether arrows look as in the source's printed figures: components to the source's scale.
    pub(crate) fn printed(&self) -> bool {
        self.normalisation == Normalisation::Source && self.style == ForceStyle::Components
    }
}
