//! [`ExitStatus`]: the result of a command. The variants are ordered: of several results the worst decides the exit code.

use crate::analysis::{Analysis, Verdict};
use crate::scene::Scene;
use crate::scene::format::Expectation;

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
    /// What the frames of an analysis come to. A frame that falls as its author expects is done; one that stands against the
    /// expectation counts as one that falls.
    pub(crate) fn from_analysis(analysis: &Analysis) -> ExitStatus {
        let verdicts = analysis.frames.iter().map(|frame| frame.verdict);
        ExitStatus::from_verdicts(&analysis.scene, verdicts)
    }

    /// Likewise, from the verdicts of the frames alone.
    pub(crate) fn from_verdicts(
        scene: &Scene,
        verdicts: impl IntoIterator<Item = Verdict>,
    ) -> ExitStatus {
        let frames = verdicts.into_iter().zip(&scene.frames);
        let endings = frames.map(|(verdict, frame)| match (frame.expected, verdict) {
            (Some(Expectation::Unstable), Verdict::Unstable) => ExitStatus::Done,
            (Some(Expectation::Unstable), Verdict::Stable) => ExitStatus::Unstable,
            (_, verdict) => ExitStatus::from(verdict),
        });
        endings.max().unwrap_or(ExitStatus::Done)
    }

    /// The exit code of the process.
    pub(crate) fn number(self) -> u8 {
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
