//! [`Answers`]: combines the answers of a frame in several conditions into those that hold in all of them.

use std::sync::Arc;

use super::capacity::LoadCapacity;
use super::condition::Condition;
use super::placement::Placement;
use super::removable::Removable;
use super::sensitivity::Sensitivity;
use super::{Alone, FrameAnalysis, Margins, Motion, Verdict};
use crate::mechanics::scene::{RobotId, Scene};
use crate::mechanics::statics::assembly::Assembly;

/// The answers of a frame that hold in several conditions.
#[derive(Clone, Debug)]
pub(super) struct Answers {
    verdict: Verdict,
    mechanism: Vec<Motion>,
    margins: Option<Margins>,
    sensitivity: Option<Sensitivity>,
    placement: Option<Placement>,
    removable: Option<Vec<Removable>>,
    capacity: Option<LoadCapacity>,
    only_by_wedging: Option<bool>,
    /// The blocks that need the help of different robots in different conditions.
    without_help: Vec<Removable>,
    /// Whether the capacity is known in one condition, but not in all.
    lacks_capacity: bool,
}

impl Answers {
    /// Returns the answers of a frame in one condition.
    pub(super) fn of(found: &FrameAnalysis, condition: Condition) -> Answers {
        let with = |own: &mut Condition| {
            own.case = condition.case.or(own.case);
            own.position = condition.position.or(own.position);
        };
        let mut answers = Answers {
            verdict: found.verdict,
            mechanism: found.mechanism.clone(),
            margins: found.margins.clone(),
            sensitivity: found.sensitivity.clone(),
            placement: found.placement.clone(),
            removable: found.removable.clone(),
            capacity: found.capacity.clone(),
            only_by_wedging: found.only_by_wedging,
            without_help: Vec::new(),
            lacks_capacity: false,
        };
        let margins = answers.margins.iter_mut().flat_map(|margins| &mut margins.each);
        margins.flat_map(|margin| &mut margin.conditions).for_each(with);
        answers.placement.iter_mut().flat_map(|own| &mut own.conditions).for_each(with);
        answers.removable.iter_mut().flatten().for_each(|row| with(&mut row.condition));
        answers.capacity.iter_mut().flat_map(|own| &mut own.edges).for_each(|edge| with(&mut edge.condition));
        answers
    }

    /// Keeps what also holds for these answers of the same frame.
    pub(super) fn also(&mut self, other: Answers) {
        let pair = self.margins.as_ref().zip(other.margins.as_ref());
        let margins = pair.map(|(own, others)| {
            Margins::and((own, (self.verdict, &self.mechanism)), (others, (other.verdict, &other.mechanism)))
        });
        // The derivatives of an end belong to the condition that decides it.
        if let (Some(own), Some(others)) = (&mut self.sensitivity, other.sensitivity) {
            let of = |margins: &Option<Margins>| Some(margins.as_ref()?.margin(own.kind)?.conditions);
            if let (Some(before), Some(now)) = (of(&self.margins), of(&margins)) {
                own.low = if now[0] == before[0] { own.low.clone() } else { others.low };
                own.high = if now[1] == before[1] { own.high.clone() } else { others.high };
            }
        }
        self.margins = margins;
        self.placement = self.placement.take().zip(other.placement).map(|(own, other)| own.and(other));
        // Removable blocks are examined for all positions of a vehicle at once.
        self.removable = match (self.removable.take(), other.removable) {
            (Some(own), Some(other)) => {
                let rows = own.into_iter().zip(other).map(|(own, other)| {
                    let (row, differs) = own.and(other);
                    self.without_help.extend(differs.then(|| row.clone()));
                    row
                });
                Some(rows.collect())
            }
            (own, other) => own.or(other),
        };
        let is_known = self.capacity.is_some() || other.capacity.is_some();
        self.capacity = self.capacity.take().zip(other.capacity).and_then(|(own, other)| own.and(other));
        self.lacks_capacity |= is_known && self.capacity.is_none();
        self.only_by_wedging = match (self.only_by_wedging, other.only_by_wedging) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (own, other) => own.and(other),
        };
        if other.verdict > self.verdict {
            (self.verdict, self.mechanism) = (other.verdict, other.mechanism);
        }
    }

    /// True if the margins, the placement tolerance of all blocks together and the capacity also hold in the condition of a
    /// scene, in which the frame is `assembly`. Their ends are tried by verdicts and proofs. False if this is not known.
    pub(super) fn hold_for(&self, scene: &Scene, assembly: &Assembly) -> bool {
        self.margins.as_ref().is_none_or(|margins| margins.hold_for(assembly))
            && self.placement.as_ref().is_none_or(|placement| placement.holds_for(scene, assembly))
            && self.capacity.as_ref().is_none_or(|capacity| capacity.holds_for(assembly))
    }

    /// True if the placement tolerance of each block alone is known.
    pub(super) fn has_placement_of_blocks(&self) -> bool {
        self.placement.as_ref().is_some_and(|placement| !placement.blocks.is_empty())
    }

    /// Gives a frame of the given scene these answers instead of those in its own condition.
    pub(super) fn give_to(mut self, scene: &Scene, found: &mut FrameAnalysis) {
        // The axles of a vehicle have no place that somebody could change.
        let is_given = |entry: usize| scene.loads.iter().any(|load| load.entry == entry);
        let ends = self.sensitivity.iter_mut().flat_map(|own| [&mut own.low, &mut own.high]);
        ends.flatten().for_each(|end| end.loads.retain(|load| is_given(load.entry)));
        let alone =
            Alone { margins: found.margins.take(), placement: found.placement.take(), capacity: found.capacity.take() };
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
        if self.lacks_capacity {
            found.notices.push("capacity: not known in every condition, so that it is not stated".to_owned());
        }
        if self.only_by_wedging == Some(true) && found.only_by_wedging != Some(true) {
            found
                .notices
                .push("wedging: it stands only by wedging in a condition other than that of its forces".to_owned());
        }
        // What was combined before stays: the results in the condition of the forces.
        found.alone.get_or_insert_with(|| Arc::new(alone));
        (found.margins, found.sensitivity, found.placement) = (self.margins, self.sensitivity, self.placement);
        (found.removable, found.capacity) = (self.removable, self.capacity);
        found.only_by_wedging = self.only_by_wedging;
    }
}
