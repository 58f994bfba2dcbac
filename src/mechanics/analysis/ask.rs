//! [`Ask`]: what is asked about the frames of a scene beyond their verdicts. [`Question`]: each question that may be asked.

use super::capacity::CapacityRequest;
use super::margin::{MarginKind, MarginKinds};
use super::sensitivity::Sensitivity;
use crate::mechanics::scene::Scene;

/// A question about a frame that is answered only if it is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Question {
    /// How far is it from its limit of stability?
    Margins,
    /// How does a margin change with corners, weights, friction and loads?
    Sensitivity,
    /// Which forces can a block carry?
    Capacity,
    /// Does it stand only by wedging?
    Wedging,
    /// How accurately must its blocks be placed?
    Placement,
    /// Which blocks may leave?
    Removable,
}

/// What is asked about each frame of a scene beyond its verdict. Nothing is asked by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Ask {
    /// How far each frame is from its limit of stability: the margins to compute.
    pub margins: MarginKinds,
    /// The margin whose derivatives are computed, if any. The margin itself is computed too.
    pub sensitivity: Option<MarginKind>,
    /// All forces that a block can carry, if they are asked for.
    pub capacity: Option<CapacityRequest>,
    /// Whether a stable frame stands only by wedging.
    pub wedging: bool,
    /// How accurately the blocks of a stable frame must be placed.
    pub placement: bool,
    /// Which blocks may leave a frame ([`FrameAnalysis::removable`](super::FrameAnalysis::removable)). Takes one verdict
    /// for each block, and some programs for each block without which the rest falls.
    pub removable: bool,
}

impl Ask {
    /// Nothing but the verdict.
    pub const NOTHING: Ask = Ask {
        margins: MarginKinds::NONE,
        sensitivity: None,
        capacity: None,
        wedging: false,
        placement: false,
        removable: false,
    };

    /// True if a question is asked.
    pub fn has(self, question: Question) -> bool {
        match question {
            Question::Margins => !self.margins.is_empty(),
            Question::Sensitivity => self.sensitivity.is_some(),
            Question::Capacity => self.capacity.is_some(),
            Question::Wedging => self.wedging,
            Question::Placement => self.placement,
            Question::Removable => self.removable,
        }
    }

    /// Returns the request with a question about a scene: about all margins, the usual margin and the usual block. A
    /// question that is asked already stays as it is.
    #[must_use]
    pub fn with(mut self, question: Question, scene: &Scene) -> Ask {
        match question {
            _ if self.has(question) => {}
            Question::Margins => self.margins = MarginKinds::ALL,
            Question::Sensitivity => self.sensitivity = Some(Sensitivity::default_kind(scene)),
            Question::Capacity => self.capacity = CapacityRequest::default_for(scene),
            Question::Wedging => self.wedging = true,
            Question::Placement => self.placement = true,
            Question::Removable => self.removable = true,
        }
        self
    }

    /// Returns what this and another request ask together. Where both name a margin or a block, the other one counts.
    #[must_use]
    pub fn and(self, other: Ask) -> Ask {
        Ask {
            margins: self.margins.and(other.margins),
            sensitivity: other.sensitivity.or(self.sensitivity),
            capacity: other.capacity.or(self.capacity),
            wedging: self.wedging || other.wedging,
            placement: self.placement || other.placement,
            removable: self.removable || other.removable,
        }
    }

    /// True if an analysis that was asked this has all answers that another request asks for.
    pub fn covers(self, other: Ask) -> bool {
        self.and(other).with_needed() == self.with_needed()
    }

    /// Returns the request with what its answers need: the derivatives of a margin need this margin.
    pub(super) fn with_needed(self) -> Ask {
        let of_sensitivity = self.sensitivity.map_or(MarginKinds::NONE, |kind| MarginKinds::new(&[kind]));
        Ask { margins: self.margins.and(of_sensitivity), ..self }
    }
}
