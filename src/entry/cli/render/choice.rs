//! The types of the option values of `drystone render`, and their conversion to the options of a figure.

use std::sync::LazyLock;

use clap::ValueEnum;
use clap::builder::PossibleValue;

use crate::products::figure;

/// The value of `--kind`: a kind of figure with panels, or the free-body diagram of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KindChoice {
    /// A figure with a panel for each frame.
    Panels(figure::Kind),
    /// A free-body diagram, which has no panels.
    Freebody,
}

impl ValueEnum for KindChoice {
    fn value_variants<'a>() -> &'a [KindChoice] {
        static ALL: LazyLock<Vec<KindChoice>> = LazyLock::new(|| {
            let panels = figure::Kind::ALL.into_iter().map(KindChoice::Panels);
            panels.chain([KindChoice::Freebody]).collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, help) = match self {
            KindChoice::Panels(kind) => (kind.name(), kind.help()),
            KindChoice::Freebody => (figure::FREEBODY, figure::FREEBODY_HELP),
        };
        Some(PossibleValue::new(name).help(help))
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum Fill {
    /// The larger of a block's weight and its largest normal force, N
    Amplitude,
    /// The largest mean pressure on one of its interfaces, N/m², for the scene's thickness
    Stress,
    /// The largest fraction of the available friction that one of its interfaces uses
    Friction,
    /// Nothing: plain blocks
    None,
    /// Fractions of the robots' limits, computed and coloured as in Vallat (2023)
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

impl KindChoice {
    /// Returns the kind of the panels; `None` for a free-body diagram, which has no panels.
    pub(super) fn panels(self) -> Option<figure::Kind> {
        match self {
            KindChoice::Panels(kind) => Some(kind),
            KindChoice::Freebody => None,
        }
    }

    /// True if the figure shows margins.
    pub(super) fn needs_margins(self) -> bool {
        self.panels().is_some_and(figure::Kind::needs_margins)
    }

    /// True if the figure shows the sensitivity of a margin: how it changes with the input.
    pub(super) fn needs_sensitivity(self) -> bool {
        self.panels().is_some_and(figure::Kind::needs_sensitivity)
    }

    /// True if the figure shows the forces that a block can carry.
    pub(super) fn needs_capacity(self) -> bool {
        self.panels().is_some_and(figure::Kind::needs_capacity)
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
