//! [`Options`]: the accuracy of an analysis, and the results that are computed in addition to the verdict.
//!
//! A level changes what an answer costs and how well it must be proved, never what it may say without a proof.

use std::time::Instant;

use super::margin::MarginKinds;
use crate::proof::ProofThreshold;
use crate::solve::{Choice, Conditioning, SolverSettings, TOLERANCE};

/// How an analysis is made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How accurate it is.
    pub accuracy: Accuracy,
    /// A tolerance for the solver in place of the level's own, to measure what it costs.
    pub tolerance: Option<f64>,
    /// How far each frame is from the edge of standing.
    pub margins: bool,
    /// Which margins, where they are asked for; by default all.
    pub margin_kinds: MarginKinds,
    /// Whether each standing frame stands only by wedging.
    pub wedging: bool,
    /// The verdict with its proof, and no program beyond what decides: where a frame falls, what fails is not sought; where it
    /// stands, the forces are some that balance. Each is stated in the result.
    pub verdict_only: bool,
    /// When to give up: what is not decided by then is `Undecided`, and its doubt says so. Without one the same scene gives
    /// the same answer every time.
    pub deadline: Option<Instant>,
}

/// What an answer may cost, and how well it must be proved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Accuracy {
    /// The unique forces; a verdict is believed as [`ProofThreshold::STANDARD`] says.
    #[default]
    Standard,
    /// The unique forces; a verdict without a proof as [`ProofThreshold::STRICT`] wants it is `Undecided`.
    Proved,
}

impl Accuracy {
    /// The threshold that a proof must reach.
    pub fn demand(self) -> ProofThreshold {
        match self {
            Accuracy::Standard => ProofThreshold::STANDARD,
            Accuracy::Proved => ProofThreshold::STRICT,
        }
    }
}

impl Options {
    setters! {
        accuracy: Accuracy, "How accurate it is.";
        margins: bool, "How far each frame is from the edge of standing.";
        margin_kinds: MarginKinds, "Which margins, where they are asked for.";
        wedging: bool, "Whether each standing frame stands only by wedging.";
        verdict_only: bool, "The verdict with its proof, and no program beyond what decides.";
    }

    optional_setters! {
        tolerance: f64, "A tolerance for the solver in place of the level's own, to measure what it costs.";
        deadline: Instant, "When to give up.";
    }

    /// Nothing but the verdict, its proof and what belongs to it.
    pub(super) const PLAIN: Options = Options {
        accuracy: Accuracy::Standard,
        tolerance: None,
        margins: false,
        margin_kinds: MarginKinds::ALL,
        wedging: false,
        verdict_only: false,
        deadline: None,
    };

    /// Whether the deadline has passed.
    pub(super) fn is_late(self) -> bool {
        self.deadline.is_some_and(|end| Instant::now() >= end)
    }

    /// The solver settings in the order in which they are tried, until a proof is strong enough.
    pub(super) fn solver_settings(self) -> Vec<SolverSettings> {
        let full = match self.accuracy {
            Accuracy::Standard => SolverSettings::from(Conditioning::Full),
            // The violation of a motion comes from the solver. Only a more exact solution makes it smaller.
            Accuracy::Proved => SolverSettings {
                tolerance: TOLERANCE * 1e-2,
                ..Conditioning::Full.into()
            },
        };
        let mut list = vec![SolverSettings::from(Conditioning::Plain), full];
        for one in &mut list {
            if self.verdict_only {
                one.choice = Choice::Any;
            }
            one.tolerance = self.tolerance.unwrap_or(one.tolerance);
        }
        list
    }
}
