//! The types of the scene file for bodies, for the robots that hold them, and for listed contacts.

#[cfg(feature = "schema")]
use super::FILL_PATTERN;
use super::declare::entry;
use super::{CellEntry, Pair, two_names};

entry! {
    /// A circle.
    pub struct CircleEntry {
        /// Centre [x, y] in the length unit of the scene.
        centre: required Pair,
        /// Radius in the length unit of the scene, more than 0.
        radius: required f64 [extend("exclusiveMinimum" = 0.0)],
    }
}

impl CircleEntry {
    /// Creates a circle with this centre and radius, both in the length unit of the scene.
    pub fn new(centre: Pair, radius: f64) -> CircleEntry {
        CircleEntry { centre, radius }
    }
}

entry! {
    /// A part of the ground; one of `polygon`, `cells`, `circle` and `shape` gives its outline.
    pub struct GroundEntry {
        /// Name of this part of the ground in results and in the list `movements`, used by no block and no other part;
        /// neither empty nor `ground`. Default: results call the part `ground`.
        id: Option<String>,
        /// Corners [x, y] of the outline in the length unit of the scene, clockwise or anticlockwise. The outline must
        /// not cross itself; it may be concave.
        polygon: Option<Vec<Pair>> [length(min = 3)],
        /// Holes in the polygon, each a list of corners in the length unit of the scene. A hole lies inside the outline
        /// and not inside another hole.
        holes: Vec<Vec<Pair>>,
        /// Lattice cells that form the outline, connected by common edges, each listed once.
        cells: Option<Vec<CellEntry>> [length(min = 1)],
        /// Circle that forms the outline. It touches another body in one point: at an edge, at another circle, or, if
        /// the scene has `corner_contacts`, at a corner.
        circle: Option<CircleEntry>,
        /// Name of a shape that gives the outline.
        shape: Option<String>,
        /// Position of the body's origin: in the length unit of the scene, or in lattice coordinates if the scene has a
        /// grid (whole numbers for cells). Default [0, 0].
        at: Option<Pair> [extend("default" = [0.0, 0.0])],
        /// Rotation of the body about its own origin, before the body is moved, in degrees anticlockwise; for cells a
        /// multiple of 60, or of 90 on the square lattice. Default 0.
        angle: Option<f64> [extend("default" = 0.0)],
        /// Name of the material of the body.
        material: Option<String>,
        /// Friction coefficient of the body, at least 0. Default: that of its material, else that of the scene.
        friction: Option<f64> [range(min = 0.0)],
        /// Fill colour of the body, "#rrggbb" or "#rgb".
        fill: Option<String> [extend("pattern" = FILL_PATTERN)],
    }
}

entry! {
    /// A rigid block; one of `polygon`, `cells`, `circle` and `shape` gives its outline. A block may have a `centre` instead of
    /// an outline; it then touches other bodies only at listed `contacts`.
    pub struct BlockEntry {
        /// Name of the block, used by no other block; neither empty nor `ground`. Default: the number of the block in
        /// the list, from 1.
        id: Option<String>,
        /// Corners [x, y] of the outline in the length unit of the scene, clockwise or anticlockwise. The outline must
        /// not cross itself; it may be concave.
        polygon: Option<Vec<Pair>> [length(min = 3)],
        /// Holes in the polygon, each a list of corners in the length unit of the scene. A hole lies inside the outline
        /// and not inside another hole.
        holes: Vec<Vec<Pair>>,
        /// Lattice cells that form the outline, connected by common edges, each listed once.
        cells: Option<Vec<CellEntry>> [length(min = 1)],
        /// Circle that forms the outline. It touches another body in one point: at an edge, at another circle, or, if
        /// the scene has `corner_contacts`, at a corner.
        circle: Option<CircleEntry>,
        /// Name of a shape that gives the outline.
        shape: Option<String>,
        /// Position of the body's origin: in the length unit of the scene, or in lattice coordinates if the scene has a
        /// grid (whole numbers for cells). Default [0, 0].
        at: Option<Pair> [extend("default" = [0.0, 0.0])],
        /// Rotation of the body about its own origin, before the body is moved, in degrees anticlockwise; for cells a
        /// multiple of 60, or of 90 on the square lattice. Default 0.
        angle: Option<f64> [extend("default" = 0.0)],
        /// Name of the material of the body.
        material: Option<String>,
        /// Point [x, y] in the length unit of the scene at which the weight acts; `angle` and `at` rotate and move it
        /// with the outline. Default: the centroid of the outline. A block without an outline needs a `centre`, and a
        /// `mass` or a `weight`; it touches other bodies only at the `contacts` of the scene.
        centre: Option<Pair>,
        /// Weight of the block in the force unit of the scene, in the direction of gravity, at least 0. A `weight`
        /// takes precedence over `mass` and over every density.
        weight: Option<f64> [range(min = 0.0)],
        /// Mass of the block in kg, at least 0. A `mass` takes precedence over every density.
        mass: Option<f64> [range(min = 0.0)],
        /// Density of the block in kg/m³, at least 0. Default: that of its material, else that of the scene.
        density: Option<f64> [range(min = 0.0), extend("type" = ["number", "string", "null"])],
        /// Friction coefficient of the body, at least 0. Default: that of its material, else that of the scene.
        friction: Option<f64> [range(min = 0.0)],
        /// When the placement tolerance is computed, the errors of this block are multiplied by this coefficient, at least
        /// 0; with 0 the block is exactly in its place. Default 1.
        placement: Option<f64> [range(min = 0.0), extend("default" = 1.0)],
        /// Fill colour of the body, "#rrggbb" or "#rgb".
        fill: Option<String> [extend("pattern" = FILL_PATTERN)],
    }
}

impl BlockEntry {
    /// True if the block has a key that gives its outline.
    pub(in crate::mechanics::scene) fn has_outline(&self) -> bool {
        self.polygon.is_some() || self.cells.is_some() || self.circle.is_some() || self.shape.is_some()
    }

    /// Creates a block with this id.
    pub fn new(id: impl Into<String>) -> BlockEntry {
        BlockEntry::default().id(id)
    }
}

entry! {
    /// A robot that can hold one block at a time.
    pub struct RobotEntry {
        /// Name of the robot, used by no other robot. Default: "r" and the number of the robot in the list, from 0.
        id: Option<String>,
        /// Name of the block that the robot holds in a scene without steps.
        holds: Option<String>,
        /// Grip point [x, y], in the length unit of the scene, on the block in the key `holds`; ignored without
        /// `holds`. Default: the block's centroid.
        at: Option<Pair>,
        /// Largest force and torque of the robot. Default: any force, no torque.
        limits: Option<LimitsEntry>,
    }
}

impl RobotEntry {
    /// Creates a robot with this id. It can exert any force, but no torque, until `limits` are set.
    pub fn new(id: impl Into<String>) -> RobotEntry {
        RobotEntry::default().id(id)
    }
}

entry! {
    /// The largest force components and torque of a robot, in either direction.
    pub struct LimitsEntry {
        /// Largest horizontal force in the force unit of the scene, at least 0. Default: `force`, else unlimited.
        fx: Option<f64> [range(min = 0.0)],
        /// Largest vertical force in the force unit of the scene, at least 0. Default: `force`, else unlimited.
        fy: Option<f64> [range(min = 0.0)],
        /// Largest torque in the force unit times the length unit of the scene, at least 0. Default 0.
        torque: Option<f64> [range(min = 0.0), extend("default" = 0.0)],
        /// Limit for `fx` and `fy` if they are not given; in the force unit of the scene, at least 0.
        force: Option<f64> [range(min = 0.0)],
    }
}

entry! {
    /// A point at which two bodies touch, in a scene that lists its contacts.
    pub struct ContactEntry {
        /// Names of the two bodies that touch: ids of blocks and of parts of the ground. `ground` is the part of the ground
        /// nearest to the contact.
        bodies: required [String; 2] as |r, node, at| two_names(r, node, at, "bodies"),
        /// Point [x, y], in the length unit of the scene, at which the two bodies touch.
        at: required Pair,
        /// Direction of the normal, which points into the first body: degrees anticlockwise from the x axis.
        normal: required f64,
        /// Friction coefficient at the contact, at least 0. Default: that of the scene.
        friction: Option<f64> [range(min = 0.0)],
    }
}

impl ContactEntry {
    /// Creates a contact of two bodies at the point `at`, [x, y] in the length unit of the scene. `normal` is the
    /// direction of the contact normal, which points into the first body, in degrees anticlockwise from the x axis. The
    /// name `ground` stands for the ground.
    pub fn between(first: impl Into<String>, second: impl Into<String>, at: Pair, normal: f64) -> ContactEntry {
        ContactEntry { bodies: [first.into(), second.into()], at, normal, friction: None }
    }
}
