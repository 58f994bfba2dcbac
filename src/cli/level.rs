//! [`Level`]: what an analysis is asked, the part that `check` and `render` share.

use clap::{Args, ValueEnum};

use crate::analysis::{Accuracy, Ask, Options};

/// How accurate, and whether by wedging.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Level {
    /// draft: any balance, soon. standard: the unique forces. proved: no verdict without a hundred times better proof
    #[arg(long, value_enum, value_name = "LEVEL", default_value = "standard")]
    accuracy: Name,
    /// Tell whether each standing frame stands only by a self-stress that its loads do not build up from rest
    #[arg(long)]
    wedging: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Name {
    Draft,
    Standard,
    Proved,
}

impl Level {
    /// What an analysis is asked.
    pub(crate) fn options(self) -> Options {
        let accuracy = match self.accuracy {
            Name::Draft => Accuracy::Draft,
            Name::Standard => Accuracy::Standard,
            Name::Proved => Accuracy::Proved,
        };
        Options {
            accuracy,
            wedging: if self.wedging { Ask::Yes } else { Ask::No },
            ..Options::default()
        }
    }
}
