//! [`Ending`]: how a command ended, in the order in which the worse one wins.

use std::process::ExitCode;

use crate::analysis::{Analysis, Verdict};

/// How a command ended. The greater is the one that is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Ending {
    /// Done, and everything that was asked about is stable.
    Done,
    /// Done; nothing is unstable, and some frame is undecided.
    Undecided,
    /// Done, and some frame is unstable.
    Unstable,
    /// The output could not be written.
    NotWritten,
    /// The input or the command line is wrong; nothing was written.
    WrongInput,
}

impl Ending {
    /// What the frames of an analysis come to.
    pub(crate) fn of(analysis: &Analysis) -> Ending {
        Ending::from(analysis.verdict())
    }

    /// The process's exit code.
    pub(crate) fn code(self) -> ExitCode {
        ExitCode::from(self.number())
    }

    fn number(self) -> u8 {
        match self {
            Ending::Done => 0,
            Ending::Unstable => 1,
            Ending::WrongInput => 2,
            Ending::Undecided => 3,
            Ending::NotWritten => 4,
        }
    }
}

impl From<Verdict> for Ending {
    fn from(verdict: Verdict) -> Ending {
        match verdict {
            Verdict::Stable => Ending::Done,
            Verdict::Undecided => Ending::Undecided,
            Verdict::Unstable => Ending::Unstable,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_told_in_the_order_2_4_1_3_0() {
        let mut all = [
            Ending::Done,
            Ending::Unstable,
            Ending::WrongInput,
            Ending::Undecided,
            Ending::NotWritten,
        ];
        all.sort();
        assert_eq!(all.map(Ending::number), [0, 3, 1, 4, 2]);
    }
}
