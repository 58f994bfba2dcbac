//! [`StepEntry`]: one step of the assembly in a scene file.

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Map, Pair};

/// One step of the assembly. Robots first release blocks; then blocks are removed, placed and held, in this order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct StepEntry {
    /// Title of the frame after this step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Names of the robots that release their blocks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub release: Vec<String>,
    /// Names of the blocks that are removed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remove: Vec<String>,
    /// Names of the blocks that are placed, in this order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub place: Vec<String>,
    /// For each robot that takes hold of a block: the name of the block, or a grip.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub hold: Map<HoldEntry>,
    /// Blocks that robots are about to place, by robot. Planned blocks are drawn as outlines and carry no force.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub plan: Map<String>,
    /// The expected verdict of the frame after this step. For the exit code of `check`, a frame with its expected
    /// verdict counts as a success, even if the frame falls. Default: the `expect` of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expect: Option<Expectation>,
}

/// The verdict that the author of a scene expects for a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Expectation {
    /// The frame stands.
    Stable,
    /// The frame falls.
    Unstable,
}

/// What a robot takes hold of: a block's id, or the block with a grip point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

/// A block that a robot holds, and its grip point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct GripEntry {
    /// Name of the block that the robot holds.
    pub block: String,
    /// The grip point [x, y] in the length unit of the scene. Default: the robot's own `at` if this block is the one in
    /// the robot's key `holds`, else the block's centroid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Pair>,
}
