//! [`ExitStatus`]: the result of a command. The variants are ordered: the worst of several results decides the exit
//! code.

use crate::mechanics::analysis::{Analysis, Verdict};
use crate::mechanics::scene::Scene;
use crate::mechanics::scene::format::Expectation;

/// The result of a command. The greatest of several results is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ExitStatus {
    /// Done, and every frame stands, or falls as the scene expects.
    Done,
    /// Done; at least one frame is undecided, and no frame counts as [`ExitStatus::Unstable`].
    Undecided,
    /// Done, and at least one frame falls, or stands although the scene expects it to fall.
    Unstable,
    /// The output could not be written.
    NotWritten,
    /// An input or the command line is wrong, or the program itself failed on a scene. There is no result for this
    /// input.
    WrongInput,
}

impl ExitStatus {
    /// Returns the worst exit status of the frames of an analysis. A frame that the scene expects to fall counts as
    /// `Done` if it falls, and as `Unstable` if it stands.
    pub(crate) fn from_analysis(analysis: &Analysis) -> ExitStatus {
        let verdicts = analysis.frames.iter().map(|frame| frame.verdict);
        ExitStatus::from_verdicts(analysis.given(), verdicts)
    }

    /// Returns the exit status for the verdicts of the frames of a scene, like [`ExitStatus::from_analysis`].
    pub(crate) fn from_verdicts(scene: &Scene, verdicts: impl IntoIterator<Item = Verdict>) -> ExitStatus {
        let frames = verdicts.into_iter().zip(&scene.frames);
        let endings = frames.map(|(verdict, frame)| match (frame.expected, verdict) {
            (Some(Expectation::Unstable), Verdict::Unstable) => ExitStatus::Done,
            (Some(Expectation::Unstable), Verdict::Stable) => ExitStatus::Unstable,
            (_, verdict) => ExitStatus::from(verdict),
        });
        endings.max().unwrap_or(ExitStatus::Done)
    }

    /// Returns the exit code of the process.
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
    fn exit_statuses_from_mild_to_severe_are_0_3_1_4_2() {
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
