//! Executes the steps of a scene file one after the other, and creates a [`Frame`] after each step.
//!
//! The order within a step is: release, remove, place, hold, plan. If a step cannot be executed as written, the
//! problem is reported, and the step is executed as it was most likely meant, so that one mistake causes only one
//! problem.

use std::collections::BTreeMap;

use super::finding::Findings;
use super::format::{HoldEntry, Pair, StepEntry};
use super::name::{self, Names};
use super::number::is_sane;
use super::problem;
use super::{BlockId, RobotId};
use super::{Frame, Grip, Hold, Plan};
use crate::geometry::Point;
use crate::read::Trail;

/// The largest sum, over all frames and load cases, of the number of placed blocks and of grips. It allows a wall of
/// 1 400 blocks that are placed in one step each. The result has about 600 bytes for each of them.
pub(super) const MAX_PLACED_BLOCKS: usize = 1_000_000;

/// The largest number of frames.
const MAX_FRAMES: usize = 50_000;

/// The parts of the scene that the steps refer to.
pub(super) struct StepContext<'s> {
    /// The indices of the blocks by name.
    pub(super) blocks: &'s Names<'s>,
    /// The indices of the robots by name.
    pub(super) robots: &'s Names<'s>,
    /// The centroid of each block; the origin for a block that is not valid.
    pub(super) centroids: &'s [Point],
    /// For each robot, the block in its key `holds` and the grip point on this block; `None` if the robot has no valid
    /// key `holds`.
    pub(super) grips: &'s [Option<Grip>],
}

impl StepContext<'_> {
    fn grip(&self, robot: RobotId, block: BlockId, at: Option<Pair>) -> Grip {
        match (at, self.grips[robot.0]) {
            (None, Some(own)) if own.block == block => own,
            _ => Grip::new(block, at.map(|at| Point::new(at[0], at[1])), self.centroids[block.0]),
        }
    }
}

/// Returns the only frame of a scene without steps. `blocks` is the number of blocks, which are all placed. The robots
/// hold the blocks given by `holds`.
pub(super) fn frame_without_steps(blocks: usize, holds: Vec<Hold>) -> Frame {
    Frame { title: String::new(), placed: (0..blocks).map(BlockId).collect(), holds, plans: Vec::new(), expected: None }
}

/// Executes the steps and returns the frame after each of them. Reports the problems of the steps. Reports an error and
/// stops if there are more than [`MAX_FRAMES`] frames, or if they contain more than [`MAX_PLACED_BLOCKS`] blocks in total
/// in `cases` load cases.
pub(super) fn frames(
    findings: &mut Findings,
    steps: &[StepEntry],
    context: &StepContext<'_>,
    cases: usize,
) -> Vec<Frame> {
    let top = Trail::Top;
    let list = top.key("steps");
    let mut state = StepState {
        placed_in_step: BTreeMap::new(),
        by_placing_order: BTreeMap::new(),
        next: 0,
        holds: BTreeMap::new(),
    };
    if steps.len() > MAX_FRAMES {
        findings.add(&list, problem::message::too_many_steps(steps.len(), MAX_FRAMES));
        return Vec::new();
    }
    let mut frames = Vec::with_capacity(steps.len());
    let mut placed_total = 0;
    for (k, step) in steps.iter().enumerate() {
        let frame = state.execute(findings, &list.index(k), k, step, context);
        // A frame without blocks needs memory and time too.
        placed_total += (frame.placed.len() + frame.holds.len()).max(1);
        frames.push(frame);
        if placed_total * cases > MAX_PLACED_BLOCKS {
            findings.add(&list.index(k), problem::message::too_many_placed(MAX_PLACED_BLOCKS));
            break;
        }
    }
    frames
}

/// The placed blocks and the blocks held by robots, after the steps so far.
struct StepState {
    /// For each placed block, the index of the step that placed it, and its number in placing order.
    placed_in_step: BTreeMap<BlockId, (usize, usize)>,
    /// The blocks in placing order.
    by_placing_order: BTreeMap<usize, BlockId>,
    /// The next number in placing order.
    next: usize,
    holds: BTreeMap<RobotId, Grip>,
}

impl StepState {
    fn execute(
        &mut self,
        findings: &mut Findings,
        at: &Trail<'_>,
        number: usize,
        step: &StepEntry,
        context: &StepContext<'_>,
    ) -> Frame {
        let list = at.key("release");
        for (i, name) in step.release.iter().enumerate() {
            if let Some(robot) = context.robots.find(findings, &list.index(i), name) {
                self.holds.remove(&RobotId(robot));
            }
        }
        let list = at.key("remove");
        for (i, name) in step.remove.iter().enumerate() {
            let at = list.index(i);
            if let Some(block) = context.blocks.find(findings, &at, name).map(BlockId) {
                self.remove(findings, &at, name, block, context);
            }
        }
        let list = at.key("place");
        for (i, name) in step.place.iter().enumerate() {
            let at = list.index(i);
            if let Some(block) = context.blocks.find(findings, &at, name).map(BlockId) {
                if let Some((placed_in_step, _)) = self.placed_in_step.get(&block) {
                    findings.add(&at, problem::message::placed_twice(name, *placed_in_step, number));
                    continue;
                }
                self.placed_in_step.insert(block, (number, self.next));
                self.by_placing_order.insert(self.next, block);
                self.next += 1;
            }
        }
        let list = at.key("hold");
        name::once(findings, &list, &step.hold);
        for (robot, hold) in &step.hold.0 {
            self.hold(findings, &list.key(robot), robot, hold, context);
        }
        let plans = self.plans(findings, &at.key("plan"), step, context);
        Frame {
            title: step.title.clone().unwrap_or_default(),
            placed: self.by_placing_order.values().copied().collect(),
            holds: self.holds.iter().map(|(robot, grip)| grip.by(*robot)).collect(),
            plans,
            expected: step.expect,
        }
    }

    fn remove(
        &mut self,
        findings: &mut Findings,
        at: &Trail<'_>,
        name: &str,
        block: BlockId,
        context: &StepContext<'_>,
    ) {
        let Some((_, place)) = self.placed_in_step.remove(&block) else {
            findings.add(at, problem::message::removed_unplaced(name));
            return;
        };
        self.by_placing_order.remove(&place);
        let holders: Vec<RobotId> =
            self.holds.iter().filter(|(_, held)| held.block == block).map(|(r, _)| *r).collect();
        if let Some(robot) = holders.first() {
            findings.add(at, problem::message::removed_held(name, context.robots.name(robot.0)));
        }
        for robot in holders {
            self.holds.remove(&robot);
        }
    }

    fn hold(
        &mut self,
        findings: &mut Findings,
        at: &Trail<'_>,
        robot_name: &str,
        hold: &HoldEntry,
        context: &StepContext<'_>,
    ) {
        let inner = at.key("block");
        let (name, point, name_at) = match hold {
            HoldEntry::Block(name) => (name, None, at),
            HoldEntry::Grip(grip) => (&grip.block, grip.at, &inner),
        };
        let robot = context.robots.find_key(findings, at, robot_name).map(RobotId);
        let block = context.blocks.find(findings, name_at, name).map(BlockId);
        let sound = point.is_none_or(|p| is_sane(findings, &at.key("at"), &p));
        let Some(block) = block else { return };
        if !self.placed_in_step.contains_key(&block) {
            findings.add(name_at, problem::message::held_unplaced(robot_name, name));
            return;
        }
        let Some(robot) = robot else { return };
        if let Some(other) = self.holds.get(&robot)
            && other.block != block
        {
            findings.add(at, problem::message::holds_two(robot_name, context.blocks.name(other.block.0), name));
        }
        if sound {
            self.holds.insert(robot, context.grip(robot, block, point));
        }
    }

    fn plans(&self, findings: &mut Findings, at: &Trail<'_>, step: &StepEntry, context: &StepContext<'_>) -> Vec<Plan> {
        let mut plans = Vec::new();
        name::once(findings, at, &step.plan);
        for (robot_name, name) in &step.plan.0 {
            let at = at.key(robot_name);
            let robot = context.robots.find_key(findings, &at, robot_name).map(RobotId);
            let block = context.blocks.find(findings, &at, name).map(BlockId);
            let Some(block) = block else { continue };
            if self.placed_in_step.contains_key(&block) {
                findings.add(&at, problem::message::planned_placed(robot_name, name));
            } else if let Some(robot) = robot {
                plans.push(Plan { robot, block });
            }
        }
        plans.sort_by_key(|p| p.robot);
        plans
    }
}
