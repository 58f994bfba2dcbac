//! [`StepEntry`]: one step of the assembly in a scene file.

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::Serialize;

use super::declare::{entry, word};
use super::{Map, Pair};
use crate::read::{Expected, Node, NodeKind, Read, Reader, Trail};

entry! {
    /// One step of the assembly. Robots first release blocks; then blocks are removed, placed and held, in this order.
    pub struct StepEntry {
        /// Title of the frame after this step.
        title: Option<String>,
        /// Names of the robots that release their blocks.
        release: Vec<String>,
        /// Names of the blocks that are removed.
        remove: Vec<String>,
        /// Names of the blocks that are placed, in this order.
        place: Vec<String>,
        /// For each robot that takes hold of a block: the name of the block, or a grip.
        hold: Map<HoldEntry>,
        /// Blocks that robots are about to place, by robot. Planned blocks are drawn as outlines and carry no force.
        plan: Map<String>,
        /// The expected verdict of the frame after this step. For the exit code of `check`, a frame with its expected
        /// verdict counts as a success, even if the frame falls. Default: the `expect` of the scene.
        expect: Option<Expectation>,
    }
}

impl StepEntry {
    /// Creates a step. `title` is the title of the frame that shows the state after this step.
    pub fn new(title: impl Into<String>) -> StepEntry {
        StepEntry::default().title(title)
    }

    /// Adds ids of robots that release their blocks in this step.
    pub fn release<S: Into<String>>(mut self, robots: impl IntoIterator<Item = S>) -> Self {
        self.release.extend(robots.into_iter().map(Into::into));
        self
    }

    /// Adds ids of blocks that are removed in this step.
    pub fn remove<S: Into<String>>(mut self, blocks: impl IntoIterator<Item = S>) -> Self {
        self.remove.extend(blocks.into_iter().map(Into::into));
        self
    }

    /// Adds ids of blocks that are placed in this step, in this order.
    pub fn place<S: Into<String>>(mut self, blocks: impl IntoIterator<Item = S>) -> Self {
        self.place.extend(blocks.into_iter().map(Into::into));
        self
    }

    /// Lets a robot take hold of a block in this step. The grip point is the robot's `at` if the block is the one that
    /// the robot `holds`; otherwise it is the centroid of the block.
    pub fn hold(mut self, robot: impl Into<String>, block: impl Into<String>) -> Self {
        let hold = HoldEntry::Block(block.into());
        self.hold.0.push((robot.into(), hold));
        self
    }

    /// Lets a robot take hold of a block in this step, at the point `at`, [x, y] in the length unit of the scene.
    pub fn hold_at(mut self, robot: impl Into<String>, block: impl Into<String>, at: Pair) -> Self {
        let (block, at) = (block.into(), Some(at));
        let hold = HoldEntry::Grip(GripEntry { block, at });
        self.hold.0.push((robot.into(), hold));
        self
    }

    /// Adds a block that a robot is about to place. The block is drawn as an outline and transmits no force.
    pub fn plan(mut self, robot: impl Into<String>, block: impl Into<String>) -> Self {
        self.plan.0.push((robot.into(), block.into()));
        self
    }
}

word! {
    /// The verdict that the author of a scene expects for a frame.
    #[non_exhaustive]
    pub enum Expectation {
        /// The frame stands.
        Stable = "stable",
        /// The frame falls.
        Unstable = "unstable",
    }
}

/// What a robot takes hold of: a block's id, or the block with a grip point.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(untagged)]
#[non_exhaustive]
pub enum HoldEntry {
    /// The block's id.
    Block(String),
    /// The block and the grip point.
    Grip(GripEntry),
}

impl Default for HoldEntry {
    fn default() -> HoldEntry {
        HoldEntry::Block(String::new())
    }
}

impl Read for HoldEntry {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<HoldEntry> {
        match &node.kind {
            NodeKind::Text(block) => Some(HoldEntry::Block(block.clone().into_owned())),
            NodeKind::Object(_) => GripEntry::read(r, node, at).map(HoldEntry::Grip),
            _ => {
                r.wrong(node, at, Expected::Other("a string or an object"));
                None
            }
        }
    }
}

entry! {
    /// A block that a robot holds, and its grip point.
    pub struct GripEntry {
        /// Name of the block that the robot holds.
        block: required String,
        /// The grip point [x, y] in the length unit of the scene. Default: the robot's own `at` if this block is the
        /// one in the robot's key `holds`, else the block's centroid.
        at: Option<Pair>,
    }
}
