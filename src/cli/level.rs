//! [`Level`]: how accurate an answer is asked for, the part that `check` and `render` share.

use clap::{Args, ValueEnum};

use crate::analysis::{Accuracy, Options};

/// How accurate.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Level {
    /// draft: any balance, soon. standard: the unique forces. proved: no verdict without a hundred times better proof
    #[arg(long, value_enum, value_name = "LEVEL", default_value = "standard")]
    accuracy: Name,
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
            ..Options::default()
        }
    }
}
