//! [`Options`]: how accurate an analysis must be, and what it computes in addition to the verdict.
//!
//! The accuracy changes the cost of a verdict and the strength of its proof. No accuracy allows a verdict without a
//! proof.

use std::time::Duration;

use super::capacity::CapacityRequest;
use super::margin::{MarginKind, MarginKinds};
use crate::clock::Instant;
use crate::mechanics::proof::ProofThreshold;
use crate::mechanics::solve::{Choice, Conditioning, SolverSettings, TOLERANCE};

/// So long after the deadline, closed forms end too. One takes less than a thousandth of a second for most components.
const OVERDUE: Duration = Duration::from_millis(100);

/// The options of an analysis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// How strong the proof of a verdict must be.
    pub accuracy: Accuracy,
    /// A solver tolerance that replaces the tolerance of `accuracy`. Benchmarks use it to measure how the tolerance
    /// changes the computing time.
    pub tolerance: Option<f64>,
    /// Whether to compute how far each frame is from its limit of stability.
    pub margins: bool,
    /// The margins to compute, if margins are requested; by default all.
    pub margin_kinds: MarginKinds,
    /// The margin whose derivatives are computed, if any. The margin itself is computed too.
    pub sensitivity: Option<MarginKind>,
    /// The request to compute all forces that a block can carry, if any.
    pub capacity: Option<CapacityRequest>,
    /// Whether to check if a stable frame stands only by wedging.
    pub wedging: bool,
    /// Whether to compute how accurately the blocks of a stable frame must be placed.
    pub placement: bool,
    /// Whether to find out which blocks may leave a frame ([`FrameAnalysis::removable`](super::FrameAnalysis::removable)).
    /// Takes one verdict for each block, and some programs for each block without which the rest falls.
    pub removable: bool,
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
        margins: bool, "Whether to compute how far each frame is from its limit of stability.";
        margin_kinds: MarginKinds, "The margins to compute, if margins are requested.";
        wedging: bool, "Whether to check if a stable frame stands only by wedging.";
        removable: bool, "Whether to find out which blocks may leave a frame, and how hard robots must hold.";
        placement: bool, "Whether to compute how accurately the blocks of a stable frame must be placed.";
        verdict_only: bool, "Whether to compute only the verdict and its proof.";
    }

    optional_setters! {
        sensitivity: MarginKind, "The margin whose derivatives are computed.";
        capacity: CapacityRequest, "The request to compute all forces that a block can carry.";
        tolerance: f64, "A solver tolerance that replaces the tolerance of `accuracy`.";
        deadline: Instant, "The time at which the analysis stops.";
    }

    /// The verdict with its proof, forces and failures, and nothing else.
    pub(super) const PLAIN: Options = Options {
        accuracy: Accuracy::Standard,
        tolerance: None,
        margins: false,
        margin_kinds: MarginKinds::ALL,
        sensitivity: None,
        capacity: None,
        wedging: false,
        placement: false,
        removable: false,
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

    /// Returns the margins to compute: the requested margins, and the margin whose derivatives are requested. `None` if
    /// neither is requested.
    pub(super) fn wanted_margins(self) -> Option<MarginKinds> {
        let requested = self.margins.then_some(self.margin_kinds);
        match (requested, self.sensitivity) {
            (kinds, None) => kinds,
            (None, Some(kind)) => Some(MarginKinds::new(&[kind])),
            (Some(kinds), Some(kind)) => Some(kinds.with(kind)),
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
