//! Builder methods that set the keys of a scene file in code. A method has the name of its key; a method that adds one
//! entry to a list has the singular, such as `block` for the key `blocks`. Each method returns the changed object.
//!
//! Nothing is checked before [`SceneFile::build`]. That method applies the same rules as for a file and reports all
//! problems at once.

use super::{
    BlockEntry, CellEntry, ContactEntry, ForceUnit, FrictionPairEntry, GridEntry, GridKind, GripEntry, GroundEntry,
    HoldEntry, LengthUnit, LimitsEntry, LoadEntry, MaterialEntry, Pair, RobotEntry, SceneFile, ShapeEntry, StepEntry,
    UnitsEntry,
};
use crate::mechanics::scene::{NoteCode, Scene, SceneError};

/// Declares methods that set a key whose value is text.
macro_rules! words {
    ($($key:ident, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            pub fn $key(mut self, $key: impl Into<String>) -> Self {
                self.$key = Some($key.into());
                self
            }
        )*
    };
}

/// Declares methods that set an outline.
macro_rules! outline {
    () => {
        /// Sets the outline to a polygon. Its corners are [x, y] in the length unit of the scene, clockwise or
        /// anticlockwise.
        pub fn polygon(mut self, corners: impl Into<Vec<Pair>>) -> Self {
            self.polygon = Some(corners.into());
            self
        }

        /// Adds a hole to the polygon. The corners of the hole are [x, y] in the length unit of the scene.
        pub fn hole(mut self, corners: impl Into<Vec<Pair>>) -> Self {
            self.holes.push(corners.into());
            self
        }

        /// Sets the outline to lattice cells. They must be connected by common edges.
        pub fn cells(mut self, cells: impl Into<Vec<CellEntry>>) -> Self {
            self.cells = Some(cells.into());
            self
        }
    };
}

/// Declares methods that set the outline, position, friction, material and colour of a body.
macro_rules! body {
    () => {
        outline!();
        optional_setters! {
            at: Pair, "Position [x, y] of the body's origin, in the length unit of the scene; in lattice coordinates if the scene has a grid.";
            angle: f64, "Rotation of the body about its own origin, in degrees anticlockwise. The body is rotated before it is moved to `at`.";
            friction: f64, "Friction coefficient of this body, at least 0.";
        }
        words! {
            shape, "Name of a shape of the scene, which gives the outline of this body.";
            material, "Name of the body's material.";
            fill, "Fill colour in figures, `#rrggbb` or `#rgb`.";
        }
    };
}

/// Implements the conversion of corners to a body or a shape with this outline.
macro_rules! from_corners {
    ($($entry:ident)*) => {
        $(
            impl<const N: usize> From<[Pair; N]> for $entry {
                fn from(corners: [Pair; N]) -> $entry {
                    $entry::default().polygon(corners)
                }
            }

            impl From<Vec<Pair>> for $entry {
                fn from(corners: Vec<Pair>) -> $entry {
                    $entry::default().polygon(corners)
                }
            }
        )*
    };
}

from_corners! { GroundEntry BlockEntry ShapeEntry }

impl SceneFile {
    words! {
        title, "Title of the scene, shown in reports and captions.";
        author, "Author of the calculation, shown in reports.";
        project, "Project that the structure belongs to, shown in reports.";
        date, "Date of the calculation, shown in reports. Any text is allowed.";
    }

    /// Sets the units in which all lengths and forces of the scene are given.
    pub fn units(mut self, length: LengthUnit, force: ForceUnit) -> Self {
        self.units = Some(UnitsEntry::default().of_length(length).of_force(force));
        self
    }

    /// Sets the kind of the lattice, and the edge length of its cells in the length unit of the scene.
    pub fn grid(mut self, kind: GridKind, side: f64) -> Self {
        let side = Some(side);
        self.grid = Some(GridEntry { kind, side });
        self
    }

    /// Adds a material. Blocks and ground refer to it by `name`.
    pub fn material(mut self, name: impl Into<String>, material: MaterialEntry) -> Self {
        self.materials.0.push((name.into(), material));
        self
    }

    /// Adds the friction coefficient, at least 0, between the materials with the names `a` and `b`.
    pub fn friction_pair(mut self, a: &str, b: &str, friction: f64) -> Self {
        let between = [a.into(), b.into()];
        self.friction_pairs.push(FrictionPairEntry { between, friction });
        self
    }

    /// Adds a shape, given by its corners in the length unit of the scene or as a [`ShapeEntry`]. Blocks and ground
    /// refer to it by `name`.
    pub fn shape(mut self, name: impl Into<String>, shape: impl Into<ShapeEntry>) -> Self {
        self.shapes.0.push((name.into(), shape.into()));
        self
    }

    /// Adds a part of the ground, given by its corners in the length unit of the scene or as a [`GroundEntry`].
    pub fn ground(mut self, part: impl Into<GroundEntry>) -> Self {
        self.ground.push(part.into());
        self
    }

    /// Adds a block, given by its corners in the length unit of the scene or as a [`BlockEntry`]. If a block has no id,
    /// its number in the list is its id, counted from 1.
    pub fn block(mut self, block: impl Into<BlockEntry>) -> Self {
        self.blocks.push(block.into());
        self
    }

    /// Adds a robot.
    pub fn robot(mut self, robot: RobotEntry) -> Self {
        self.robots.push(robot);
        self
    }

    /// Adds a contact between two bodies. If a scene lists contacts, contacts are not computed from the outlines.
    pub fn contact(mut self, contact: ContactEntry) -> Self {
        self.contacts.push(contact);
        self
    }

    /// Adds a load on a block.
    pub fn load(mut self, load: LoadEntry) -> Self {
        self.loads.push(load);
        self
    }

    /// Adds a step of the assembly. The state after each step is one frame.
    pub fn step(mut self, step: StepEntry) -> Self {
        self.steps.push(step);
        self
    }

    /// Switches off all notes with this code.
    pub fn silence(mut self, code: NoteCode) -> Self {
        self.silence.push(code.to_string());
        self
    }

    /// Checks the scene file and converts it to a [`Scene`], like [`Scene::new`].
    ///
    /// # Errors
    /// All problems of the scene, each with its path.
    pub fn build(self) -> Result<Scene, SceneError> {
        Scene::new(self)
    }
}

impl MaterialEntry {
    optional_setters! {
        density: f64, "Density in kg/m³, at least 0.";
        friction: f64, "Friction coefficient, at least 0.";
    }
    words! {
        fill, "Fill colour in figures, `#rrggbb` or `#rgb`.";
    }
}

impl ShapeEntry {
    outline!();
}

impl GroundEntry {
    body!();
}

impl BlockEntry {
    /// Creates a block with this id.
    pub fn new(id: impl Into<String>) -> BlockEntry {
        BlockEntry::default().id(id)
    }

    body!();
    optional_setters! {
        centre: Pair, "Point [x, y] in the length unit of the scene at which the weight acts. Only for a block without an outline.";
        weight: f64, "Weight of the block in the force unit of the scene, at least 0. It takes precedence over mass and density.";
        mass: f64, "Mass of the block in kg, at least 0. It takes precedence over the density.";
        density: f64, "Density of this block in kg/m³, at least 0.";
    }
    words! {
        id, "Id of this object. Each id may be used only once.";
    }
}

impl RobotEntry {
    /// Creates a robot with this id. It can exert any force, but no torque, until `limits` are set.
    pub fn new(id: impl Into<String>) -> RobotEntry {
        RobotEntry::default().id(id)
    }

    optional_setters! {
        at: Pair, "Grip point [x, y] in the length unit of the scene on the block that the robot `holds`.";
        limits: LimitsEntry, "The largest force and torque of the robot.";
    }
    words! {
        id, "Id of this object. Each id may be used only once.";
        holds, "Id of the block that the robot holds in a scene without steps.";
    }
}

impl LimitsEntry {
    optional_setters! {
        fx: f64, "Largest horizontal force in the force unit of the scene, at least 0.";
        fy: f64, "Largest vertical force in the force unit of the scene, at least 0.";
        torque: f64, "Largest torque in the force unit times the length unit of the scene, at least 0.";
        force: f64, "Limit in the force unit of the scene for `fx` and `fy` where these are not given, at least 0.";
    }
}

impl ContactEntry {
    /// Creates a contact of two bodies at the point `at`, [x, y] in the length unit of the scene. `normal` is the
    /// direction of the contact normal, which points into the first body, in degrees anticlockwise from the x axis. The
    /// name `ground` stands for the ground.
    pub fn between(first: impl Into<String>, second: impl Into<String>, at: Pair, normal: f64) -> ContactEntry {
        ContactEntry { bodies: [first.into(), second.into()], at, normal, friction: None }
    }

    optional_setters! {
        friction: f64, "Friction coefficient of this contact, at least 0. Without it, the coefficient of the scene applies.";
    }
}

impl LoadEntry {
    /// Creates a load on the block with this id. Its force and torque are zero until they are set.
    pub fn on(block: impl Into<String>) -> LoadEntry {
        LoadEntry { block: block.into(), ..LoadEntry::default() }
    }

    optional_setters! {
        force: Pair, "Force [x, y] in the force unit of the scene.";
        at: Pair, "Point [x, y] in the length unit of the scene at which the force acts. Without it, the force acts at the centroid of the block.";
        torque: f64, "Torque in the force unit times the length unit of the scene, anticlockwise positive.";
    }
}

impl StepEntry {
    /// Creates a step. `title` is the title of the frame that shows the state after this step.
    pub fn new(title: impl Into<String>) -> StepEntry {
        StepEntry::default().title(title)
    }

    words! {
        title, "Title of the frame that shows the state after this step.";
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
