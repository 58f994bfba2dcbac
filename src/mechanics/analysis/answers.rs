//! [`Answers`]: combines the answers of a frame in several conditions into those that hold in all of them.

use std::sync::Arc;

use super::condition::Condition;
use super::placement::Placement;
use super::removable::Removable;
use super::{Alone, FrameAnalysis, Margins, Motion, Verdict};
use crate::mechanics::scene::{RobotId, Scene};

/// The answers of a frame that hold in several conditions.
#[derive(Clone, Debug)]
pub(super) struct Answers {
    verdict: Verdict,
    mechanism: Vec<Motion>,
    margins: Option<Margins>,
    placement: Option<Placement>,
    removable: Option<Vec<Removable>>,
    /// The blocks that need the help of different robots in different conditions.
    without_help: Vec<Removable>,
}

impl Answers {
    /// Returns the answers of a frame in one condition.
    pub(super) fn of(found: &FrameAnalysis, condition: Condition) -> Answers {
        let with = |own: &mut Condition| {
            own.case = condition.case.or(own.case);
            own.position = condition.position.or(own.position);
        };
        let FrameAnalysis { verdict, mechanism, margins, placement, removable, .. } = found.clone();
        let mut answers = Answers { verdict, mechanism, margins, placement, removable, without_help: Vec::new() };
        let margins = answers.margins.iter_mut().flat_map(|margins| &mut margins.each);
        margins.flat_map(|margin| &mut margin.conditions).for_each(with);
        answers.placement.iter_mut().flat_map(|own| &mut own.conditions).for_each(with);
        answers.removable.iter_mut().flatten().for_each(|row| with(&mut row.condition));
        answers
    }

    /// Returns a frame with these answers, which are its own.
    pub(super) fn in_place_of(self, found: FrameAnalysis) -> FrameAnalysis {
        FrameAnalysis { margins: self.margins, placement: self.placement, removable: self.removable, ..found }
    }

    /// Keeps what also holds for these answers of the same frame.
    pub(super) fn also(&mut self, other: Answers) {
        let pair = self.margins.as_ref().zip(other.margins.as_ref());
        self.margins = pair.map(|(own, others)| {
            Margins::and((own, (self.verdict, &self.mechanism)), (others, (other.verdict, &other.mechanism)))
        });
        self.placement = self.placement.take().zip(other.placement).map(|(own, other)| own.and(other));
        self.removable = self.removable.take().zip(other.removable).map(|(own, other)| {
            let rows = own.into_iter().zip(other).map(|(own, other)| {
                let (row, differs) = own.and(other);
                self.without_help.extend(differs.then(|| row.clone()));
                row
            });
            rows.collect()
        });
        if other.verdict > self.verdict {
            (self.verdict, self.mechanism) = (other.verdict, other.mechanism);
        }
    }

    /// Gives a frame these answers instead of those in its own condition.
    pub(super) fn give_to(self, scene: &Scene, found: &mut FrameAnalysis) {
        let alone = Alone { margins: found.margins.take(), placement: found.placement.take() };
        let name = |robot: RobotId| scene.robots[robot.0].id.clone();
        let withheld = self.margins.iter().flat_map(|margins| margins.withheld(name));
        let withheld: Vec<String> = withheld.filter(|notice| !found.notices.contains(notice)).collect();
        found.notices.extend(withheld);
        for row in &self.without_help {
            found.notices.push(format!(
                "removable: no single block is known whose robot helps in all conditions if block {} leaves",
                scene.blocks[row.block.0].id
            ));
        }
        // What was combined before stays: the results in the condition of the forces.
        found.alone.get_or_insert_with(|| Arc::new(alone));
        (found.margins, found.placement, found.removable) = (self.margins, self.placement, self.removable);
    }
}
