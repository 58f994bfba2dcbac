//! Methods that build a scene file in code: one for each key, with the same name. Each method returns the object on
//! which it was called.
//!
//! Nothing is checked before [`SceneFile::build`]. It applies the same rules as for a file and reports all problems at
//! once.

use super::{
    BlockEntry, CellEntry, ContactEntry, ForceUnit, FrictionPairEntry, GridEntry, GridKind,
    GripEntry, GroundEntry, HoldEntry, LengthUnit, LimitsEntry, LoadEntry, MaterialEntry, Pair,
    RobotEntry, SceneFile, ShapeEntry, StepEntry, UnitsEntry,
};
use crate::scene::{NoteCode, Scene, SceneError};

/// Methods that set a key whose value is text.
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

/// Methods that set an outline.
macro_rules! outline {
    () => {
        /// Sets the outline to a polygon: its corners [x, y] in metres, clockwise or anticlockwise.
        pub fn polygon(mut self, corners: impl Into<Vec<Pair>>) -> Self {
            self.polygon = Some(corners.into());
            self
        }

        /// Adds a hole to the polygon: its corners [x, y] in metres.
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

/// Methods that set the outline, position, friction, material and colour of a body.
macro_rules! body {
    () => {
        outline!();
        optional_setters! {
            at: Pair, "Position of its origin, in metres; a lattice point if the scene has a grid.";
            angle: f64, "Rotation about its own origin before it is moved, degrees anticlockwise.";
            friction: f64, "Its own friction coefficient, at least 0.";
        }
        words! {
            shape, "Name of a shape of the scene, used instead of an outline of its own.";
            material, "Name of its material.";
            fill, "Fill colour, `#rrggbb` or `#rgb`.";
        }
    };
}

/// Converts corners to a body or shape with this outline.
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
        title, "Title of the scene, for reports and captions.";
        author, "Author of the calculation, for reports.";
        project, "Project that the structure belongs to, for reports.";
        date, "Date of the calculation, for reports: any text.";
    }

    /// Sets the units of the lengths and forces of the scene.
    pub fn units(mut self, length: LengthUnit, force: ForceUnit) -> Self {
        self.units = Some(UnitsEntry::default().of_length(length).of_force(force));
        self
    }

    /// Sets the lattice and the edge length of its cells in metres.
    pub fn grid(mut self, kind: GridKind, side: f64) -> Self {
        let side = Some(side);
        self.grid = Some(GridEntry { kind, side });
        self
    }

    /// Adds a material.
    pub fn material(mut self, name: impl Into<String>, material: MaterialEntry) -> Self {
        self.materials.0.push((name.into(), material));
        self
    }

    /// Adds the friction coefficient between two materials, at least 0.
    pub fn friction_pair(mut self, a: &str, b: &str, friction: f64) -> Self {
        let between = [a.into(), b.into()];
        self.friction_pairs
            .push(FrictionPairEntry { between, friction });
        self
    }

    /// Adds a shape: corners in metres, or a [`ShapeEntry`].
    pub fn shape(mut self, name: impl Into<String>, shape: impl Into<ShapeEntry>) -> Self {
        self.shapes.0.push((name.into(), shape.into()));
        self
    }

    /// Adds a part of the ground: corners in metres, or a [`GroundEntry`].
    pub fn ground(mut self, part: impl Into<GroundEntry>) -> Self {
        self.ground.push(part.into());
        self
    }

    /// Adds a block: a [`BlockEntry`], or corners in metres. A block from corners gets its number as id, from 1.
    pub fn block(mut self, block: impl Into<BlockEntry>) -> Self {
        self.blocks.push(block.into());
        self
    }

    /// Adds a robot.
    pub fn robot(mut self, robot: RobotEntry) -> Self {
        self.robots.push(robot);
        self
    }

    /// Adds a contact. If a scene lists contacts, no others are searched.
    pub fn contact(mut self, contact: ContactEntry) -> Self {
        self.contacts.push(contact);
        self
    }

    /// Adds a load.
    pub fn load(mut self, load: LoadEntry) -> Self {
        self.loads.push(load);
        self
    }

    /// Adds a step of the assembly, which makes a frame.
    pub fn step(mut self, step: StepEntry) -> Self {
        self.steps.push(step);
        self
    }

    /// Switches off the notes that have this code.
    pub fn silence(mut self, code: NoteCode) -> Self {
        self.silence.push(code.to_string());
        self
    }

    /// Checks the scene, like [`Scene::new`].
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
        fill, "Fill colour, `#rrggbb` or `#rgb`.";
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
        centre: Pair, "Point [x, y] in metres at which the weight acts, for a block without an outline.";
        weight: f64, "Weight in newtons along gravity, at least 0. Takes precedence over mass and density.";
        mass: f64, "Mass in kg, at least 0. Takes precedence over density.";
        density: f64, "Its own density in kg/m³, at least 0.";
    }
    words! {
        id, "Its name, used once.";
    }
}

impl RobotEntry {
    /// Creates a robot with this id. Its force has no limits, and it gives no torque.
    pub fn new(id: impl Into<String>) -> RobotEntry {
        RobotEntry::default().id(id)
    }

    optional_setters! {
        at: Pair, "Grip point [x, y] in metres on the block that it `holds`.";
        limits: LimitsEntry, "What it can give.";
    }
    words! {
        id, "Its name, used once.";
        holds, "The block it holds in a scene without steps.";
    }
}

impl LimitsEntry {
    optional_setters! {
        fx: f64, "Largest horizontal force in newtons, at least 0.";
        fy: f64, "Largest vertical force in newtons, at least 0.";
        torque: f64, "Largest torque in N·m, at least 0.";
        force: f64, "Limit for `fx` and `fy` if they are not given; newtons, at least 0.";
    }
}

impl ContactEntry {
    /// Creates a contact of two bodies at a point [x, y] in metres. The normal points into the first body; it is given
    /// in degrees anticlockwise from the x axis. The name `ground` stands for the ground.
    pub fn between(
        first: impl Into<String>,
        second: impl Into<String>,
        at: Pair,
        normal: f64,
    ) -> ContactEntry {
        ContactEntry {
            bodies: [first.into(), second.into()],
            at,
            normal,
            friction: None,
        }
    }

    optional_setters! {
        friction: f64, "Friction coefficient, at least 0; that of the scene otherwise.";
    }
}

impl LoadEntry {
    /// Creates a load on the block with this id. Force and torque are zero until they are set.
    pub fn on(block: impl Into<String>) -> LoadEntry {
        LoadEntry {
            block: block.into(),
            ..LoadEntry::default()
        }
    }

    optional_setters! {
        force: Pair, "Force [x, y] in newtons.";
        at: Pair, "Where the force acts, [x, y] in metres; the block's centroid otherwise.";
        torque: f64, "Torque in N·m, anticlockwise positive.";
    }
}

impl StepEntry {
    /// Creates a step. `title` is the title of its frame.
    pub fn new(title: impl Into<String>) -> StepEntry {
        StepEntry::default().title(title)
    }

    words! {
        title, "Title of the frame after this step.";
    }

    /// Adds robots that release their blocks.
    pub fn release<S: Into<String>>(mut self, robots: impl IntoIterator<Item = S>) -> Self {
        self.release.extend(robots.into_iter().map(Into::into));
        self
    }

    /// Adds blocks that are removed.
    pub fn remove<S: Into<String>>(mut self, blocks: impl IntoIterator<Item = S>) -> Self {
        self.remove.extend(blocks.into_iter().map(Into::into));
        self
    }

    /// Adds blocks that are placed, in this order.
    pub fn place<S: Into<String>>(mut self, blocks: impl IntoIterator<Item = S>) -> Self {
        self.place.extend(blocks.into_iter().map(Into::into));
        self
    }

    /// Adds a robot that takes hold of a block. The grip point is the robot's own `at` for the block that it `holds`,
    /// otherwise the centroid.
    pub fn hold(mut self, robot: impl Into<String>, block: impl Into<String>) -> Self {
        let hold = HoldEntry::Block(block.into());
        self.hold.0.push((robot.into(), hold));
        self
    }

    /// Adds a robot that takes hold of a block at a point [x, y] in metres.
    pub fn hold_at(mut self, robot: impl Into<String>, block: impl Into<String>, at: Pair) -> Self {
        let (block, at) = (block.into(), Some(at));
        let hold = HoldEntry::Grip(GripEntry { block, at });
        self.hold.0.push((robot.into(), hold));
        self
    }

    /// Adds a block that a robot is about to place. It is drawn as an outline and carries no force.
    pub fn plan(mut self, robot: impl Into<String>, block: impl Into<String>) -> Self {
        self.plan.0.push((robot.into(), block.into()));
        self
    }
}
