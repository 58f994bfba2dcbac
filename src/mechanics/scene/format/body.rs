//! The types of the scene file for bodies, for the robots and loads that act on them, and for listed contacts.

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

#[cfg(feature = "schema")]
use super::FILL_PATTERN;
use super::{CellEntry, Pair};

/// A part of the ground; one of `polygon`, `cells` and `shape` gives its outline.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct GroundEntry {
    /// Corners [x, y] of the outline in the length unit of the scene, clockwise or anticlockwise. The outline must not
    /// cross itself; it may be concave.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(length(min = 3)))]
    pub polygon: Option<Vec<Pair>>,
    /// Holes in the polygon, each a list of corners in the length unit of the scene. A hole lies inside the outline and
    /// not inside another hole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Pair>>,
    /// Lattice cells that form the outline, connected by common edges, each listed once.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub cells: Option<Vec<CellEntry>>,
    /// Name of a shape that gives the outline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<String>,
    /// Position of the body's origin: in the length unit of the scene, or in lattice coordinates if the scene has a
    /// grid (whole numbers for cells). Default [0, 0].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = [0.0, 0.0])))]
    pub at: Option<Pair>,
    /// Rotation of the body about its own origin, before the body is moved, in degrees anticlockwise; for cells a
    /// multiple of 60, or of 90 on the square lattice. Default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.0)))]
    pub angle: Option<f64>,
    /// Name of the material of the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Friction coefficient of the body, at least 0. Default: that of its material, else that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub friction: Option<f64>,
    /// Fill colour of the body, "#rrggbb" or "#rgb".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("pattern" = FILL_PATTERN)))]
    pub fill: Option<String>,
}

/// A rigid block; one of `polygon`, `cells` and `shape` gives its outline. A block may have a `centre` instead of an
/// outline; it then touches other bodies only at listed `contacts`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct BlockEntry {
    /// Name of the block, used by no other block; neither empty nor `ground`. Default: the number of the block in the
    /// list, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Corners [x, y] of the outline in the length unit of the scene, clockwise or anticlockwise. The outline must not
    /// cross itself; it may be concave.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(length(min = 3)))]
    pub polygon: Option<Vec<Pair>>,
    /// Holes in the polygon, each a list of corners in the length unit of the scene. A hole lies inside the outline and
    /// not inside another hole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Pair>>,
    /// Lattice cells that form the outline, connected by common edges, each listed once.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub cells: Option<Vec<CellEntry>>,
    /// Name of a shape that gives the outline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<String>,
    /// Position of the body's origin: in the length unit of the scene, or in lattice coordinates if the scene has a
    /// grid (whole numbers for cells). Default [0, 0].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = [0.0, 0.0])))]
    pub at: Option<Pair>,
    /// Rotation of the body about its own origin, before the body is moved, in degrees anticlockwise; for cells a
    /// multiple of 60, or of 90 on the square lattice. Default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.0)))]
    pub angle: Option<f64>,
    /// Name of the material of the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Point [x, y] in the length unit of the scene at which the weight acts, for a block without an outline. Such a
    /// block needs a `mass` or a `weight`, and touches other bodies only at the `contacts` of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre: Option<Pair>,
    /// Weight of the block in the force unit of the scene, in the direction of gravity, at least 0. A `weight` takes
    /// precedence over `mass` and over every density.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub weight: Option<f64>,
    /// Mass of the block in kg, at least 0. A `mass` takes precedence over every density.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub mass: Option<f64>,
    /// Density of the block in kg/m³, at least 0. Default: that of its material, else that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub density: Option<f64>,
    /// Friction coefficient of the body, at least 0. Default: that of its material, else that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub friction: Option<f64>,
    /// Fill colour of the body, "#rrggbb" or "#rgb".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("pattern" = FILL_PATTERN)))]
    pub fill: Option<String>,
}

/// A robot that can hold one block at a time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct RobotEntry {
    /// Name of the robot, used by no other robot. Default: "r" and the number of the robot in the list, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Name of the block that the robot holds in a scene without steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub holds: Option<String>,
    /// Grip point [x, y], in the length unit of the scene, on the block in the key `holds`; ignored without `holds`.
    /// Default: the block's centroid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Pair>,
    /// Largest force and torque of the robot. Default: any force, no torque.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<LimitsEntry>,
}

/// The largest force components and torque of a robot, in either direction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LimitsEntry {
    /// Largest horizontal force in the force unit of the scene, at least 0. Default: `force`, else unlimited.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub fx: Option<f64>,
    /// Largest vertical force in the force unit of the scene, at least 0. Default: `force`, else unlimited.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub fy: Option<f64>,
    /// Largest torque in the force unit times the length unit of the scene, at least 0. Default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("default" = 0.0)))]
    pub torque: Option<f64>,
    /// Limit for `fx` and `fy` if they are not given; in the force unit of the scene, at least 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub force: Option<f64>,
}

/// A point at which two bodies touch, in a scene that lists its contacts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ContactEntry {
    /// Names of the two bodies that touch; `ground` is the ground.
    pub bodies: [String; 2],
    /// Point [x, y], in the length unit of the scene, at which the two bodies touch.
    pub at: Pair,
    /// Direction of the normal, which points into the first body: degrees anticlockwise from the x axis.
    pub normal: f64,
    /// Friction coefficient at the contact, at least 0. Default: that of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub friction: Option<f64>,
}

/// A load on a block, in addition to its weight.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LoadEntry {
    /// Name of the loaded block.
    pub block: String,
    /// Force [x, y] in the force unit of the scene. Default [0, 0].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = [0.0, 0.0])))]
    pub force: Option<Pair>,
    /// Point [x, y], in the length unit of the scene, at which the force acts. Default: the block's centroid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Pair>,
    /// Torque in the force unit times the length unit of the scene, anticlockwise positive. Default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = 0.0)))]
    pub torque: Option<f64>,
}
