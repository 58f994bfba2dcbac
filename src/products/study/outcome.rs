//! [`Outcome`]: the result of a solution method for a whole frame.

use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::Scale;
use crate::mechanics::solve::{Amounts, Effort};

/// The result of a method for a whole frame or for an independent part of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The verdict.
    pub verdict: Verdict,
    /// The total force if the frame stands, the total adhesion if it falls, in N. `None` if the method does not find
    /// it.
    pub total: Option<f64>,
    /// The largest resultant at a contact or grip, in N. `None` if the method does not find it.
    pub largest: Option<f64>,
    /// The number of failures.
    pub points: usize,
    /// The largest imbalance, if the verdict was found from forces. For the accuracy levels it is relative to the
    /// forces on a block, for the other methods to the heaviest load.
    pub imbalance: Option<f64>,
    /// The largest violation of the motion relative to its power, if the verdict was found from a motion. Only the
    /// accuracy levels give it.
    pub violation: Option<f64>,
    /// The number of iterations of the solvers.
    pub iterations: usize,
    /// The solving time in s; `None` if the method does not measure it.
    pub(super) seconds: Option<f64>,
}

impl Outcome {
    /// Returns the outcome for a frame without loads: it stands, and all forces are zero.
    pub(super) fn empty() -> Outcome {
        Outcome {
            verdict: Verdict::Stable,
            total: Some(0.0),
            largest: Some(0.0),
            points: 0,
            imbalance: Some(0.0),
            violation: None,
            iterations: 0,
            seconds: None,
        }
    }

    pub(super) fn undecided(effort: Effort) -> Outcome {
        Outcome {
            verdict: Verdict::Undecided,
            total: None,
            largest: None,
            imbalance: None,
            iterations: effort.iterations,
            ..Outcome::empty()
        }
    }

    /// Returns the outcome for a part of a frame that falls. Adhesion of `total` at `points` failures would hold it.
    /// `total` is in the scaled units of the program; `None` if it is not known.
    pub(super) fn falls(total: Option<f64>, points: usize, effort: Effort) -> Outcome {
        Outcome { verdict: Verdict::Unstable, total, points, ..Outcome::undecided(effort) }
    }

    /// Returns the outcome for a part of a frame that stands: the forces `amounts` balance the loads. `imbalance` is
    /// the largest error of this balance, in the scaled units of the program.
    pub(super) fn stands(amounts: &Amounts, imbalance: f64, effort: Effort) -> Outcome {
        Outcome {
            verdict: Verdict::Stable,
            total: Some(amounts.total()),
            largest: Some(largest(amounts)),
            imbalance: Some(imbalance / Scale::HEAVIEST),
            ..Outcome::undecided(effort)
        }
    }

    /// Converts the forces from the scaled units of a program to newtons.
    pub(super) fn in_newtons(self, scale: Scale) -> Outcome {
        Outcome { total: self.total.map(|v| v * scale.force), largest: self.largest.map(|v| v * scale.force), ..self }
    }

    /// Combines the outcomes of two independent parts of a frame. If their verdicts are equal, sums are added, and the
    /// larger of two largest values is kept. If their verdicts differ, the combined outcome is that of the worse part,
    /// with the iterations of both parts.
    pub(super) fn and(self, other: Outcome) -> Outcome {
        let both = |a: Option<f64>, b: Option<f64>, join: fn(f64, f64) -> f64| a.zip(b).map(|(a, b)| join(a, b));
        let iterations = self.iterations + other.iterations;
        if self.verdict == other.verdict {
            Outcome {
                total: both(self.total, other.total, |a, b| a + b),
                largest: both(self.largest, other.largest, f64::max),
                points: self.points + other.points,
                imbalance: both(self.imbalance, other.imbalance, f64::max),
                iterations,
                ..self
            }
        } else {
            let worse = if self.verdict > other.verdict { self } else { other };
            Outcome { iterations, ..worse }
        }
    }
}

/// Returns the magnitude of the largest resultant at a contact or grip, in the scaled units of the program.
fn largest(amounts: &Amounts) -> f64 {
    let contacts = amounts.normal.iter().zip(&amounts.friction).map(|(n, t)| libm::hypot(n[0] + n[1], *t));
    let grips = amounts.grip.iter().map(|g| libm::hypot(g[0], g[1]));
    contacts.chain(grips).fold(0.0, f64::max)
}
