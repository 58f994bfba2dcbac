//! The scene file as Rust types, one type for each kind of JSON object. The JSON Schema is generated from these types.
//!
//! Each object is declared once, in the macro `entry!`. A [`SceneFile`] is read from text, or built in code: a method has
//! the name of its key, and a method that adds one entry to a list has the singular, such as `block` for the key
//! `blocks`. Each method returns the changed object. Reading checks only the types of the values; [`SceneFile::build`]
//! checks the rest and reports all problems at once. A key may be absent or `null` if its field is an `Option`. No other
//! part of the scene module uses serde, serde_json or schemars.

mod body;
mod declare;
mod lines;
mod load;
mod map;
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(super) mod setting;
mod step;
mod unit;

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::Serialize;

pub use body::{BlockEntry, CircleEntry, ContactEntry, GroundEntry, LimitsEntry, RobotEntry};
pub(crate) use lines::Lines;
pub use load::{
    AxleEntry, BlockSide, CaseEntry, DepthEntry, FixedLoad, FixedPart, LoadEntry, MovementEntry, PressureEntry,
    VehicleEntry,
};
pub use map::Map;
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) use setting::Setting;
#[cfg(feature = "cli")]
pub(crate) use setting::number_in;
pub use step::{Expectation, GripEntry, HoldEntry, StepEntry};
pub(in crate::mechanics::scene) use unit::convert;
pub use unit::{ForceUnit, LengthUnit, UnitsEntry};

use self::declare::{entry, word};
use super::{NoteCode, Scene, SceneError};
use crate::read::{Expected, Node, NodeKind, Read, Reader, Trail};

/// A position or a displacement, `[x, y]`; y points up.
pub type Pair = [f64; 2];

entry! {
    /// A scene of dry-laid blocks: their positions, and the robots that hold them. SI units by default; y points up,
    /// and angles are in degrees anticlockwise.
    #[cfg_attr(feature = "schema", schemars(title = "drystone scene"))]
    pub struct SceneFile {
        /// Path or address of the JSON Schema, for editors; drystone ignores this key.
        schema "$schema": bare Option<String>,
        /// Version of the scene format; must be 1.
        drystone: required Version,
        /// Title of the scene, for reports and captions.
        title: Option<String>,
        /// Author of the calculation, for reports.
        author: Option<String>,
        /// Project that the structure belongs to, for reports.
        project: Option<String>,
        /// Date of the calculation, for reports: any text. Reports never read a clock.
        date: Option<String>,
        /// Units of lengths and forces in this file. Masses stay in kg, densities in kg/m³ and gravity in m/s².
        /// Default: metres and newtons.
        units: bare Option<UnitsEntry>,
        /// Gravity [x, y] in m/s². Weights act in this direction; with [0, 0], no weight acts. Default [0, -9.81].
        gravity: Option<Pair> [extend("default" = [0.0, -9.81])] as vector,
        /// Friction coefficient μ, at least 0, of each body for which neither the body nor its material gives one.
        /// Default 0.7.
        friction: Option<f64> [range(min = 0.0), extend("default" = 0.7)],
        /// Safety kernel, 0 to 1: each application point moves inward by half this fraction of the contact's length.
        /// Default 0.
        kernel: Option<f64> [range(min = 0.0, max = 1.0), extend("default" = 0.0)],
        /// Density in kg/m³, at least 0, of each block for which neither the block nor its material gives one; also a
        /// text with another unit, such as `"150 lb/ft3"`. Default 1.
        density: Option<f64> [range(min = 0.0), extend("default" = 1.0, "type" = ["number", "string", "null"])],
        /// Thickness of all blocks perpendicular to the plane, in the length unit of the scene, at least 0. Default 1.
        thickness: Option<f64> [range(min = 0.0), extend("default" = 1.0)],
        /// Materials of blocks and of the ground, by name.
        materials: Map<MaterialEntry>,
        /// Friction coefficients between pairs of materials.
        friction_pairs: Vec<FrictionPairEntry>,
        /// Sets of joints with a name, by the direction of the joint, its two bodies or their materials. A joint belongs to
        /// the first set that it meets. A set may give the friction coefficient of its joints.
        joint_sets: Vec<JointSetEntry>,
        /// The names of the joint sets whose coefficients the margin `friction_factor` multiplies. Default: all joints.
        friction_factor_on: Vec<String>,
        /// The lattice. With a lattice, `at` of a body is in lattice coordinates, and outlines may be sets of cells.
        grid: bare Option<GridEntry>,
        /// Shapes that bodies can use as outlines, by name. The triangular lattice also has the built-in shapes up,
        /// down, hexagon, linkh, linkr and linkl; these names are reserved.
        shapes: Map<ShapeEntry>,
        /// Parts of the ground: they support any load and never move.
        ground: Vec<GroundEntry>,
        /// The blocks.
        blocks: required Vec<BlockEntry>,
        /// The contacts between bodies, as points with a normal. If any contact is listed, no contacts are computed
        /// from the outlines.
        contacts: Vec<ContactEntry>,
        /// Robots, each of which can hold one block at a time.
        robots: Vec<RobotEntry>,
        /// Loads on blocks, in addition to their weights.
        loads: Vec<LoadEntry>,
        /// Load cases. With cases, the verdict of a frame is that of its worst case. Without cases, all loads act with
        /// factor 1.
        cases: Vec<CaseEntry>,
        /// Small movements of parts of the ground. The analysis computes for each of them how the structure cracks and
        /// follows it.
        movements: Vec<MovementEntry>,
        /// A vehicle that travels over the structure. The analysis finds its most dangerous position.
        vehicle: Option<VehicleEntry>,
        /// Contact tolerance in the length unit of the scene, at least 0: edges at most this far apart touch, and
        /// bodies may overlap by up to this depth. Default: estimated from how the coordinates are written and how
        /// large the scene is.
        contact_tolerance: Option<f64> [range(min = 0.0)],
        /// Which corners that touch carry force: none (`false`), all (`true`), or `"on_edges"`: those that touch an edge, but
        /// not those that touch only another corner. Default false.
        corner_contacts: Option<CornerContacts> [extend("default" = false)],
        /// Steps of the assembly, one frame each. Without steps, there is one frame: all blocks are placed, and each
        /// robot holds the block in its key `holds`.
        steps: Vec<StepEntry>,
        /// The expected verdict of every frame whose step has no `expect`. Default: none.
        expect: Option<Expectation>,
        /// Codes of notes that are switched off, such as `no_ground`.
        silence: Vec<String>,
    }
}

impl SceneFile {
    /// Writes the file as JSON text, with one line for each key and one for each body, robot and step. The text ends
    /// with a line feed.
    ///
    /// # Example
    /// ```
    /// use drystone::Scene;
    /// let text = Scene::builder().block([[0.0, 0.0], [3.0, 0.0], [0.0, 1.0]]).to_json();
    /// assert_eq!(text.lines().count(), 6);
    /// assert!(Scene::from_json(&text).is_ok());
    /// ```
    pub fn to_json(&self) -> String {
        let mut bytes = Vec::new();
        let mut writer = serde_json::Serializer::with_formatter(&mut bytes, Lines::new(1));
        self.serialize(&mut writer).expect("plain structures with text keys always serialise into memory");
        bytes.push(b'\n');
        crate::text::json(&String::from_utf8(bytes).expect("serde_json writes UTF-8")).into_owned()
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

    /// Adds a set of joints.
    pub fn joint_set(mut self, set: JointSetEntry) -> Self {
        self.joint_sets.push(set);
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

    /// Adds a load case. With cases, the verdict of a frame is that of its worst case.
    pub fn case(mut self, case: CaseEntry) -> Self {
        self.cases.push(case);
        self
    }

    /// Adds a small movement of a part of the ground.
    pub fn movement(mut self, movement: MovementEntry) -> Self {
        self.movements.push(movement);
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

    /// Replaces the contact tolerance of the file by `tolerance`, in metres; `None` leaves the file unchanged. The
    /// value is stored in the file's unit of length.
    pub(crate) fn tolerate(&mut self, tolerance: Option<f64>) {
        let unit = self.units.unwrap_or_default().length();
        let given = tolerance.map(|metres| unit.value_from_si(metres));
        self.contact_tolerance = given.or(self.contact_tolerance);
    }
}

/// Version of the scene format; 1 by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(transparent)]
#[cfg_attr(feature = "schema", schemars(inline))]
pub struct Version(pub i64);

impl Default for Version {
    fn default() -> Version {
        Version(1)
    }
}

impl Read for Version {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Version> {
        if let (NodeKind::Number(_), Ok(number)) = (&node.kind, r.written(node).parse()) {
            return Some(Version(number));
        }
        r.wrong(node, at, Expected::Whole);
        None
    }
}

entry! {
    /// A material of blocks or of the ground.
    pub struct MaterialEntry {
        /// Density in kg/m³, at least 0, of blocks of this material that give none; also a text with another unit.
        density: Option<f64> [range(min = 0.0), extend("type" = ["number", "string", "null"])],
        /// Friction coefficient, at least 0, of bodies of this material that give none.
        friction: Option<f64> [range(min = 0.0)],
        /// Fill colour, "#rrggbb" or "#rgb", of bodies of this material that give none.
        fill: Option<String> [extend("pattern" = FILL_PATTERN)],
    }
}

entry! {
    /// The friction coefficient between two materials. At an interface between bodies of these materials, this
    /// coefficient replaces those of the bodies, of the materials and of the scene.
    pub struct FrictionPairEntry {
        /// Names of the two materials, in any order. If both names are equal, the coefficient applies between two
        /// bodies of this material.
        between: required [String; 2] as |r, node, at| two_names(r, node, at, "materials"),
        /// Friction coefficient at interfaces between bodies of these materials, at least 0.
        friction: required f64 [range(min = 0.0)],
    }
}

entry! {
    /// A set of joints. A joint meets the set if it meets all that the entry gives: of `direction`, `bodies` and
    /// `materials`.
    pub struct JointSetEntry {
        /// Name of the set.
        id: required String,
        /// The direction of the joints: `bed` for joints at 45° or more to the direction of gravity, as the beds of a wall,
        /// `head` for all others.
        direction: Option<JointDirection>,
        /// The two bodies, in any order: for each, the id of a block or of a part of the ground, or `ground` for any part of
        /// the ground.
        bodies: Option<[String; 2]> as |r, node, at| two_names(r, node, at, "bodies").map(Some),
        /// Names of the materials of the two bodies, in any order.
        materials: Option<[String; 2]> as |r, node, at| two_names(r, node, at, "materials").map(Some),
        /// Friction coefficient of the joints of this set, at least 0. It comes before the coefficients of bodies, of
        /// materials and of pairs of materials. Listed contacts keep their own.
        friction: Option<f64> [range(min = 0.0)],
    }
}

word! {
    /// The direction of a joint.
    #[non_exhaustive]
    pub enum JointDirection {
        /// Gravity presses the joint, as in the beds of a wall.
        Bed = "bed",
        /// Gravity acts along the joint, as in the upright joints of a wall.
        Head = "head",
    }
}

entry! {
    /// A regular lattice.
    pub struct GridEntry {
        /// The kind of the lattice.
        kind: required GridKind,
        /// Edge length of a cell in the length unit of the scene, more than 0. Default 1.
        side: Option<f64> [extend("default" = 1.0, "exclusiveMinimum" = 0)],
    }
}

word! {
    /// The kind of a lattice.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum GridKind {
        /// Equilateral triangles: lattice point (x, y) is at side·(x + y/2, y·√3/2).
        #[default]
        Triangular = "triangular",
        /// Squares: lattice point (x, y) is at side·(x, y).
        Square = "square",
    }
}

/// Which corners that touch another body carry force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(untagged)]
pub enum CornerContacts {
    /// All of them, or none.
    All(bool),
    /// Those that touch what the word names.
    At(CornersAt),
}

word! {
    /// What a corner must touch to carry force.
    #[derive(serde::Deserialize)]
    #[non_exhaustive]
    pub enum CornersAt {
        /// An edge or a circle. A corner that touches only another corner carries none.
        Edges = "on_edges",
    }
}

impl CornerContacts {
    /// No corner carries force.
    pub const NONE: CornerContacts = CornerContacts::All(false);
    /// Corners that touch an edge carry force.
    pub const ON_EDGES: CornerContacts = CornerContacts::At(CornersAt::Edges);
    /// All corners that touch carry force.
    pub const ALL: CornerContacts = CornerContacts::All(true);

    /// True if a corner that touches an edge carries force.
    pub fn on_edges(self) -> bool {
        self != CornerContacts::NONE
    }

    /// True if a corner that touches only another corner carries force.
    pub fn on_corners(self) -> bool {
        self == CornerContacts::ALL
    }
}

impl From<bool> for CornerContacts {
    fn from(all: bool) -> CornerContacts {
        CornerContacts::All(all)
    }
}

impl Read for CornerContacts {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<CornerContacts> {
        match &node.kind {
            NodeKind::Flag(all) => Some(CornerContacts::All(*all)),
            NodeKind::Text(_) => CornersAt::read(r, node, at).map(CornerContacts::At),
            _ => {
                r.wrong(node, at, Expected::Other("true, false or \"on_edges\""));
                None
            }
        }
    }
}

/// A lattice cell: `[x, y, "up"]` or `[x, y, "down"]` on the triangular lattice, `[x, y]` on the square lattice.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(untagged)]
#[non_exhaustive]
pub enum CellEntry {
    /// The triangle above or below the edge from (x, y) to (x+1, y). Coordinates are whole numbers.
    Triangle(f64, f64, CellHalf),
    /// The square with its lower left corner at (x, y). Coordinates are whole numbers.
    Square(f64, f64),
}

impl Default for CellEntry {
    fn default() -> CellEntry {
        CellEntry::Square(0.0, 0.0)
    }
}

impl Read for CellEntry {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<CellEntry> {
        let items = match &node.kind {
            NodeKind::List(list) if (2..=3).contains(&list.len()) => r.items(list),
            _ => {
                r.wrong(node, at, Expected::Other("[x, y, \"up\"], [x, y, \"down\"] or [x, y]"));
                return None;
            }
        };
        let x = r.number(&items[0], &at.index(0));
        let y = r.number(&items[1], &at.index(1));
        match items.get(2) {
            None => Some(CellEntry::Square(x?, y?)),
            Some(half) => {
                let half = CellHalf::read(r, half, &at.index(2));
                Some(CellEntry::Triangle(x?, y?, half?))
            }
        }
    }
}

word! {
    /// The position of a triangle relative to its horizontal edge: above (`Up`) or below (`Down`).
    pub enum CellHalf {
        /// Corners (x, y), (x+1, y), (x, y+1).
        Up = "up",
        /// Corners (x, y), (x+1, y), (x+1, y−1).
        Down = "down",
    }
}

entry! {
    /// A named shape: a polygon, lattice cells or a circle, in coordinates relative to the origin of the shape.
    pub struct ShapeEntry {
        /// Corners [x, y] of the outline in the length unit of the scene, clockwise or anticlockwise. The outline must
        /// not cross itself; it may be concave.
        polygon: Option<Vec<Pair>> [length(min = 3)],
        /// Holes in the polygon, each a list of corners in the length unit of the scene. A hole lies inside the outline
        /// and not inside another hole.
        holes: Vec<Vec<Pair>>,
        /// Lattice cells that form the outline, connected by common edges, each listed once.
        cells: Option<Vec<CellEntry>> [length(min = 1)],
        /// Circle that forms the outline.
        circle: Option<CircleEntry>,
    }
}

/// Reads an optional vector [x, y].
fn vector<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Option<Pair>> {
    match node.kind {
        NodeKind::Null => Some(None),
        _ => r.vector(node, at).map(Some),
    }
}

/// Reads a list of two names. `what` says what they name.
fn two_names<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>, what: &str) -> Option<[String; 2]> {
    match &node.kind {
        NodeKind::List(list) if list.len() == 2 => Vec::read(r, node, at)?.try_into().ok(),
        _ => {
            r.wrong(node, at, Expected::Other(&format!("a list with the names of two {what}")));
            None
        }
    }
}

/// Defines the method that adds a hole to an outline, and the conversion of corners to an object with this outline.
macro_rules! outline {
    ($($entry:ident)*) => {
        $(
            impl $entry {
                /// Adds a hole to the polygon. The corners of the hole are [x, y] in the length unit of the scene.
                pub fn hole(mut self, corners: impl Into<Vec<Pair>>) -> Self {
                    self.holes.push(corners.into());
                    self
                }
            }

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

outline! { GroundEntry BlockEntry ShapeEntry }

/// Returns the JSON Schema (draft 2020-12) of a scene file. Editors use the schema to complete and check a scene.
///
/// ```
/// assert!(drystone::scene::format::schema().contains("\"title\": \"drystone scene\""));
/// ```
#[cfg(feature = "schema")]
pub fn schema() -> String {
    let settings = schemars::generate::SchemaSettings::draft2020_12();
    let schema = settings.into_generator().into_root_schema_for::<SceneFile>();
    format!("{:#}\n", schema.as_value())
}

#[cfg(feature = "schema")]
const FILL_PATTERN: &str = "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_file_survives_writing_and_reading() {
        let file = SceneFile {
            title: Some("two".into()),
            grid: Some(GridEntry { kind: GridKind::Square, side: Some(0.25) }),
            blocks: vec![BlockEntry {
                id: Some("a".into()),
                cells: Some(vec![CellEntry::Square(1.0, 2.0), CellEntry::Triangle(3.0, 4.0, CellHalf::Down)]),
                ..BlockEntry::default()
            }],
            steps: vec![StepEntry {
                hold: Map(vec![
                    ("z".into(), HoldEntry::Block("a".into())),
                    ("b".into(), HoldEntry::Grip(GripEntry::default())),
                ]),
                ..StepEntry::default()
            }],
            ..SceneFile::default()
        };
        let text = serde_json::to_string(&file).expect("JSON text");
        let read = SceneFile::from_json(&text).expect("a scene file");
        assert_eq!(read, file);
        assert_eq!(read.steps[0].hold.0[0].0, "z", "a map keeps the file's order");
    }

    #[cfg(feature = "schema")]
    #[test]
    fn the_schema_is_made_from_the_types() {
        let schema: serde_json::Value = serde_json::from_str(&schema()).expect("JSON");
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        assert_eq!(schema["additionalProperties"], false);
        assert_eq!(schema["required"], serde_json::json!(["drystone", "blocks"]));
        assert_eq!(schema["properties"]["friction"]["default"], 0.7);
        assert!(schema["properties"]["gravity"]["description"].as_str().expect("a description").contains("m/s²"));
        assert!(schema.get("$id").is_none());
    }
}
