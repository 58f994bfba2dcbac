//! The choices of `drystone render`, and what they are called in a figure.

use clap::ValueEnum;

use crate::analysis::Toward;
use crate::figure;

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum KindChoice {
    /// Every force as an arrow on the block it acts on, and what is missing
    Forces,
    /// Where it falls, how: blocks displaced along the collapse, hinges and slips
    Mechanism,
    /// The line of thrust through the blocks
    Thrust,
    /// The safe stretch of each interface, and where in it the resultant sits
    Kernel,
    /// Friction used of friction available, interface by interface
    Utilisation,
    /// The steps of a construction, arrows to one scale in all of them; --animate shows them one after the other
    Build,
    /// The forces on the structure from outside, and their polygon beside it
    Polygon,
    /// As it stands, and as a ghost how it falls just beyond its margin; --margin says which
    Margin,
    /// What changed from one frame to the next, or from the last frame of one scene to that of another
    Compare,
    /// One block cut free, with every force that may act on it by name
    Freebody,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Fill {
    /// The larger of a block's weight and its largest normal force, N
    Amplitude,
    /// The largest mean pressure on one of its interfaces, N/m², for the scene's thickness
    Stress,
    /// The largest share of the friction available that one of its interfaces uses
    Friction,
    /// Nothing: plain blocks
    None,
    /// Shares of the robots' limits, by the rule and in the colours of the source
    Source,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Arrows {
    Resultant,
    Components,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Normalise {
    Drawn,
    Source,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum ArrowScale {
    Panel,
    Strip,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Margin {
    /// How far gravity may turn
    Tilt,
    /// How large a share of each weight may push across gravity
    HorizontalLoad,
    /// How many times as large the listed loads may be
    LoadFactor,
}

impl KindChoice {
    /// What the panels of the figure show; `None` for a free-body diagram, which has none.
    pub(super) fn panels(self) -> Option<figure::Kind> {
        match self {
            KindChoice::Forces => Some(figure::Kind::Forces),
            KindChoice::Mechanism => Some(figure::Kind::Mechanism),
            KindChoice::Thrust => Some(figure::Kind::Thrust),
            KindChoice::Kernel => Some(figure::Kind::Kernel),
            KindChoice::Utilisation => Some(figure::Kind::Utilisation),
            KindChoice::Build => Some(figure::Kind::Build),
            KindChoice::Polygon => Some(figure::Kind::Polygon),
            KindChoice::Margin => Some(figure::Kind::Margin),
            KindChoice::Compare => Some(figure::Kind::Compare),
            KindChoice::Freebody => None,
        }
    }
}

impl Fill {
    pub(super) fn figure(self) -> figure::Fill {
        match self {
            Fill::Amplitude => figure::Fill::Amplitude,
            Fill::Stress => figure::Fill::Stress,
            Fill::Friction => figure::Fill::Friction,
            Fill::None => figure::Fill::None,
            Fill::Source => figure::Fill::Source,
        }
    }
}

impl Arrows {
    pub(super) fn figure(self) -> figure::ForceStyle {
        match self {
            Arrows::Resultant => figure::ForceStyle::Resultant,
            Arrows::Components => figure::ForceStyle::Components,
        }
    }
}

impl Normalise {
    pub(super) fn figure(self) -> figure::Normalisation {
        match self {
            Normalise::Drawn => figure::Normalisation::Drawn,
            Normalise::Source => figure::Normalisation::Source,
        }
    }
}

impl ArrowScale {
    pub(super) fn figure(self) -> figure::ArrowScale {
        match self {
            ArrowScale::Panel => figure::ArrowScale::Panel,
            ArrowScale::Strip => figure::ArrowScale::Strip,
        }
    }
}

impl Margin {
    pub(super) fn toward(self) -> Toward {
        match self {
            Margin::Tilt => Toward::Tilt,
            Margin::HorizontalLoad => Toward::HorizontalLoad,
            Margin::LoadFactor => Toward::LoadFactor,
        }
    }
}
