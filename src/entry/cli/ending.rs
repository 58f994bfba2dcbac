//! [`ExitStatus`]: how a command ended, in the order in which the worse one wins.

use std::process::ExitCode;

use crate::analysis::{Analysis, Verdict};

/// How a command ended. The greater is the one that is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ExitStatus {
    /// Done, and every frame is stable.
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

impl ExitStatus {
    /// What the frames of an analysis come to.
    pub(crate) fn from_analysis(analysis: &Analysis) -> ExitStatus {
        ExitStatus::from(analysis.verdict())
    }

    /// The process's exit code.
    pub(crate) fn code(self) -> ExitCode {
        ExitCode::from(self.number())
    }

    fn number(self) -> u8 {
        match self {
            ExitStatus::Done => 0,
            ExitStatus::Unstable => 1,
            ExitStatus::WrongInput => 2,
            ExitStatus::Undecided => 3,
            ExitStatus::NotWritten => 4,
        }
    }
}

impl From<Verdict> for ExitStatus {
    fn from(verdict: Verdict) -> ExitStatus {
        match verdict {
            Verdict::Stable => ExitStatus::Done,
            Verdict::Undecided => ExitStatus::Undecided,
            Verdict::Unstable => ExitStatus::Unstable,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_told_in_the_order_2_4_1_3_0() {
        let mut all = [
            ExitStatus::Done,
            ExitStatus::Unstable,
            ExitStatus::WrongInput,
            ExitStatus::Undecided,
            ExitStatus::NotWritten,
        ];
        all.sort();
        assert_eq!(all.map(ExitStatus::number), [0, 3, 1, 4, 2]);
    }
}
