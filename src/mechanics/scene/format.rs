//! The scene file as Rust types, one type for each kind of JSON object. The JSON Schema is generated from these types.
//!
//! A [`SceneFile`] is read from text, or built in code with the methods in `build`. Reading checks only the types of
//! the values; [`SceneFile::build`] checks the rest. A key may be absent or `null` if its field is an `Option`.
//! No other part of the scene module uses serde, serde_json or schemars.

mod body;
mod build;
mod lines;
mod map;
#[cfg(feature = "schema")]
mod schema;
mod step;
mod unit;

#[cfg(feature = "schema")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use body::{BlockEntry, ContactEntry, GroundEntry, LimitsEntry, LoadEntry, RobotEntry};
pub(crate) use lines::Lines;
pub use map::Map;
#[cfg(feature = "schema")]
pub use schema::schema;
pub use step::{Expectation, GripEntry, HoldEntry, StepEntry};
pub use unit::{ForceUnit, LengthUnit, UnitsEntry};

/// A position or a displacement, `[x, y]`; y points up.
pub type Pair = [f64; 2];

/// A scene of dry-laid blocks: their positions, and the robots that hold them. SI units by default; y points up, and
/// angles are in degrees anticlockwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", schemars(title = "drystone scene"))]
#[non_exhaustive]
pub struct SceneFile {
    /// Path or address of the JSON Schema, for editors; drystone ignores this key.
    #[serde(rename = "$schema", skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Version of the scene format; must be 1.
    pub drystone: Version,
    /// Title of the scene, for reports and captions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Author of the calculation, for reports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub author: Option<String>,
    /// Project that the structure belongs to, for reports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub project: Option<String>,
    /// Date of the calculation, for reports: any text. Reports never read a clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub date: Option<String>,
    /// Units of lengths and forces in this file. Masses stay in kg, densities in kg/m³ and gravity in m/s². Default:
    /// metres and newtons.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitsEntry>,
    /// Gravity [x, y] in m/s². Weights act in this direction; with [0, 0], no weight acts. Default [0, -9.81].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = [0.0, -9.81])))]
    pub gravity: Option<Pair>,
    /// Friction coefficient μ, at least 0, of each body for which neither the body nor its material gives one. Default
    /// 0.7.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("default" = 0.7)))]
    pub friction: Option<f64>,
    /// Safety kernel, 0 to 1: each application point moves inward by half this fraction of the contact's length.
    /// Default 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0), extend("default" = 0.0)))]
    pub kernel: Option<f64>,
    /// Density in kg/m³, at least 0, of each block for which neither the block nor its material gives one. Default 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("default" = 1.0)))]
    pub density: Option<f64>,
    /// Thickness of all blocks perpendicular to the plane, in the length unit of the scene, at least 0. Default 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0), extend("default" = 1.0)))]
    pub thickness: Option<f64>,
    /// Materials of blocks and of the ground, by name.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub materials: Map<MaterialEntry>,
    /// Friction coefficients between pairs of materials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub friction_pairs: Vec<FrictionPairEntry>,
    /// The lattice. With a lattice, `at` of a body is in lattice coordinates, and outlines may be sets of cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridEntry>,
    /// Shapes that bodies can use as outlines, by name. The triangular lattice also has the built-in shapes up, down,
    /// hexagon, linkh, linkr and linkl; these names are reserved.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub shapes: Map<ShapeEntry>,
    /// Parts of the ground: they support any load and never move.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ground: Vec<GroundEntry>,
    /// The blocks.
    pub blocks: Vec<BlockEntry>,
    /// The contacts between bodies, as points with a normal. If any contact is listed, no contacts are computed from
    /// the outlines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<ContactEntry>,
    /// Robots, each of which can hold one block at a time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub robots: Vec<RobotEntry>,
    /// Loads on blocks, in addition to their weights.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadEntry>,
    /// Contact tolerance in the length unit of the scene, at least 0: edges at most this far apart touch, and bodies
    /// may overlap by up to this depth. Default: estimated from how the coordinates are written and how large the scene
    /// is.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub contact_tolerance: Option<f64>,
    /// Whether a corner that touches an edge or another corner carries force. Default false.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = false)))]
    pub corner_contacts: Option<bool>,
    /// Steps of the assembly, one frame each. Without steps, there is one frame: all blocks are placed, and each
    /// robot holds the block in its key `holds`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<StepEntry>,
    /// The expected verdict of every frame whose step has no `expect`. Default: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expect: Option<Expectation>,
    /// Codes of notes that are switched off, such as `no_ground`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub silence: Vec<String>,
}

/// Parses one entry of a scene file, such as a block, from its JSON text. Only the types of the values are checked. The
/// error is a message for the user.
#[cfg(any(feature = "python", feature = "wasm"))]
pub(crate) fn parsed<T: for<'a> Deserialize<'a>>(text: &str) -> Result<T, String> {
    serde_json::from_str(text).map_err(|error| error.to_string())
}

/// Builder methods for the keys of the whole file whose value is a number, a vector or a truth value.
impl SceneFile {
    optional_setters! {
        gravity: Pair, "Gravity [x, y] in m/s². Weights act in its direction.";
        friction: f64, "Friction coefficient μ of bodies without a coefficient of their own or of their material, at least 0.";
        kernel: f64, "Safety kernel, 0 to 1: the fraction of each contact's length that must stay free of force.";
        density: f64, "Density in kg/m³ of blocks without a density of their own or of their material, at least 0.";
        thickness: f64, "Thickness of all blocks in the length unit of the scene, perpendicular to the plane of the scene, at least 0.";
        contact_tolerance: f64, "Contact tolerance: the largest distance, in the length unit of the scene, between two edges that touch, at least 0.";
        corner_contacts: bool, "Whether a corner that touches an edge or another corner transmits force.";
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
        crate::text::json(&String::from_utf8(bytes).expect("serde_json writes UTF-8"))
    }
}

impl SceneFile {
    /// Replaces the contact tolerance of the file by `tolerance`, in metres; `None` leaves the file unchanged. The
    /// value is stored in the file's unit of length.
    pub(super) fn tolerate(&mut self, tolerance: Option<f64>) {
        let unit = self.units.unwrap_or_default().length();
        let given = tolerance.map(|metres| unit.value_from_si(metres));
        self.contact_tolerance = given.or(self.contact_tolerance);
    }
}

/// Version of the scene format; 1 by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(transparent)]
#[cfg_attr(feature = "schema", schemars(inline))]
pub struct Version(pub i64);

impl Default for Version {
    fn default() -> Version {
        Version(1)
    }
}

/// A material of blocks or of the ground.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MaterialEntry {
    /// Density in kg/m³, at least 0, of blocks of this material that give none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub density: Option<f64>,
    /// Friction coefficient, at least 0, of bodies of this material that give none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub friction: Option<f64>,
    /// Fill colour, "#rrggbb" or "#rgb", of bodies of this material that give none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("pattern" = FILL_PATTERN)))]
    pub fill: Option<String>,
}

/// The friction coefficient between two materials. At an interface between bodies of these materials, this coefficient
/// replaces those of the bodies, of the materials and of the scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct FrictionPairEntry {
    /// Names of the two materials, in any order. If both names are equal, the coefficient applies between two bodies
    /// of this material.
    pub between: [String; 2],
    /// Friction coefficient at interfaces between bodies of these materials, at least 0.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0)))]
    pub friction: f64,
}

/// A regular lattice.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct GridEntry {
    /// The kind of the lattice.
    pub kind: GridKind,
    /// Edge length of a cell in the length unit of the scene, more than 0. Default 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(extend("default" = 1.0, "exclusiveMinimum" = 0)))]
    pub side: Option<f64>,
}

/// The kind of a lattice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum GridKind {
    /// Equilateral triangles: lattice point (x, y) is at side·(x + y/2, y·√3/2).
    #[default]
    Triangular,
    /// Squares: lattice point (x, y) is at side·(x, y).
    Square,
}

/// A lattice cell: `[x, y, "up"]` or `[x, y, "down"]` on the triangular lattice, `[x, y]` on the square lattice.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(untagged)]
#[non_exhaustive]
pub enum CellEntry {
    /// The triangle above or below the edge from (x, y) to (x+1, y). Coordinates are whole numbers.
    Triangle(f64, f64, CellHalf),
    /// The square with its lower left corner at (x, y). Coordinates are whole numbers.
    Square(f64, f64),
}

/// The position of a triangle relative to its horizontal edge: above (`Up`) or below (`Down`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum CellHalf {
    /// Corners (x, y), (x+1, y), (x, y+1).
    Up,
    /// Corners (x, y), (x+1, y), (x+1, y−1).
    Down,
}

/// A named shape: either a polygon or lattice cells, in coordinates relative to the origin of the shape.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ShapeEntry {
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
}

#[cfg(feature = "schema")]
const FILL_PATTERN: &str = "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$";

/// Parses a text with serde, for tests of the reader.
#[cfg(test)]
pub(super) fn parse(text: &str) -> Option<SceneFile> {
    serde_json::from_str(text).ok()
}

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
        let read: SceneFile = serde_json::from_str(&text).expect("a scene file");
        assert_eq!(read, file);
        assert_eq!(read.steps[0].hold.0[0].0, "z", "a map keeps the file's order");
    }
}
