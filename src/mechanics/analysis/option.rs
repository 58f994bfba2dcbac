//! [`Options`]: how an analysis is made, and what it is asked.
//!
//! The accuracy changes the cost of a verdict and the strength of its proof. No accuracy allows a verdict without a
//! proof.

use std::time::Duration;

use super::ask::Ask;
use super::capacity::CapacityRequest;
use super::margin::{MarginKind, MarginKinds};
use crate::clock::Instant;
use crate::mechanics::proof::ProofThreshold;
use crate::mechanics::solve::{Choice, Conditioning, SolverSettings, TOLERANCE};

/// So long after the deadline, closed forms end too. One takes less than a thousandth of a second for most components.
const OVERDUE: Duration = Duration::from_millis(100);

/// Defines one setter method for each listed field of [`Ask`].
macro_rules! asking {
    ($($field:ident: $type:ty, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            pub fn $field(mut self, $field: impl Into<$type>) -> Self {
                self.ask.$field = $field.into();
                self
            }
        )*
    };
}

/// The options of an analysis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How strong the proof of a verdict must be.
    pub accuracy: Accuracy,
    /// A solver tolerance that replaces the tolerance of `accuracy`. Benchmarks use it to measure how the tolerance
    /// changes the computing time.
    pub tolerance: Option<f64>,
    /// What is asked beyond the verdict.
    pub ask: Ask,
    /// Whether to compute only the verdict and its proof. If a frame falls, its failures are not computed. If it
    /// stands, the forces balance, but their sum may not be the least. The result states this.
    pub verdict_only: bool,
    /// The time at which the analysis stops. Components that are not decided by then are `Undecided`, and the reason
    /// names the deadline. Without a deadline the same scene gives the same results every time. In a browser,
    /// `Instant` is the type of the crate `web-time`.
    pub deadline: Option<Instant>,
}

words! {
    /// How strong the proof of a verdict must be. Without such a proof, the verdict is `Undecided`.
    #[non_exhaustive]
    pub enum Accuracy {
        /// A proof must meet [`ProofThreshold::STANDARD`].
        #[default]
        Standard = "standard";
        /// A proof must meet [`ProofThreshold::STRICT`].
        Proved = "proved";
        /// A proof must meet [`ProofThreshold::STANDARD`], and forces or a motion must prove the verdict in exact
        /// arithmetic. [`Analysis::exact`](super::Analysis::exact) computes this.
        Exact = "exact";
    }
}

impl Accuracy {
    /// Returns the threshold that a proof must meet at this accuracy.
    pub fn demand(self) -> ProofThreshold {
        match self {
            Accuracy::Standard | Accuracy::Exact => ProofThreshold::STANDARD,
            Accuracy::Proved => ProofThreshold::STRICT,
        }
    }
}

impl Options {
    setters! {
        accuracy: Accuracy, "How strong the proof of a verdict must be.";
        ask: Ask, "What is asked beyond the verdict.";
        verdict_only: bool, "Whether to compute only the verdict and its proof.";
    }

    optional_setters! {
        tolerance: f64, "A solver tolerance that replaces the tolerance of `accuracy`.";
        deadline: Instant, "The time at which the analysis stops.";
    }

    asking! {
        margins: MarginKinds, "Asks for these margins.";
        sensitivity: Option<MarginKind>, "Asks for the derivatives of a margin.";
        capacity: Option<CapacityRequest>, "Asks for all forces that a block can carry.";
        wedging: bool, "Asks whether a stable frame stands only by wedging.";
        placement: bool, "Asks how accurately the blocks of a stable frame must be placed.";
        removable: bool, "Asks which blocks may leave a frame, and how hard robots must hold.";
    }

    /// Asks for what another request asks, too.
    #[must_use]
    pub fn also(self, ask: Ask) -> Options {
        Options { ask: self.ask.and(ask), ..self }
    }

    /// The verdict with its proof, forces and failures, and nothing else.
    pub(super) const PLAIN: Options = Options {
        accuracy: Accuracy::Standard,
        tolerance: None,
        ask: Ask::NOTHING,
        verdict_only: false,
        deadline: None,
    };

    /// Returns options with the same accuracy, tolerance and deadline, for an analysis that computes only the verdict.
    pub(crate) fn only_verdict(self) -> Options {
        Options {
            accuracy: self.accuracy,
            tolerance: self.tolerance,
            verdict_only: true,
            deadline: self.deadline,
            ..Options::PLAIN
        }
    }

    /// True if the deadline has passed.
    pub(crate) fn is_late(self) -> bool {
        self.deadline.is_some_and(|end| Instant::now() >= end)
    }

    /// True if the deadline passed so long ago that closed forms end too: many frames or load cases take long.
    pub(super) fn is_overdue(self) -> bool {
        self.deadline.is_some_and(|end| Instant::now().saturating_duration_since(end) > OVERDUE)
    }

    /// Returns the solver settings with plain and with full conditioning. They are tried in this order until a proof is
    /// strong enough.
    pub(super) fn solver_settings(self) -> [SolverSettings; 2] {
        let full = match self.accuracy {
            Accuracy::Standard | Accuracy::Exact => SolverSettings::from(Conditioning::Full),
            // A strict proof needs a smaller tolerance: only a more accurate solution reduces the solver's error in a
            // motion.
            Accuracy::Proved => SolverSettings { tolerance: TOLERANCE * 1e-2, ..Conditioning::Full.into() },
        };
        let mut list = [SolverSettings::from(Conditioning::Plain), full];
        for settings in &mut list {
            if self.verdict_only {
                settings.choice = Choice::Any;
            }
            settings.tolerance = self.tolerance.unwrap_or(settings.tolerance);
        }
        list
    }
}
