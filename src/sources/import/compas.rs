//! Reads an assembly of the Python package `compas_assembly` from JSON. The blocks must be prisms perpendicular to one
//! coordinate plane, and the scene gets their sections in this plane.
//!
//! The first object whose nodes have blocks is the assembly, wherever it is in the file. Files of all versions of
//! COMPAS can therefore be read, although some versions wrap the data in a key `data` and older ones in a key `value`.

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use super::Options;
use super::draft::Remark;
use crate::mechanics::scene::format::{BlockEntry, GroundEntry, Pair, SceneFile};

/// Coordinates perpendicular to the plane count as equal if they differ by less than this share of the largest
/// coordinate. The thicknesses of the blocks are compared with the same share of the largest thickness.
const EQUAL_COORDINATE_TOL: f64 = 1e-6;
/// Coordinates are rounded to this many steps per unit of length before the two ends of a prism are compared.
const STEPS_PER_UNIT: f64 = 1e6;

/// A coordinate plane: its name, and the indices of the axes that point to the right, up, and perpendicular to the
/// plane.
pub(super) type Plane = (&'static str, [usize; 3]);

/// The planes in the order in which they are tried: z is up in COMPAS.
pub(super) const PLANES: [Plane; 3] = [("xz", [0, 2, 1]), ("yz", [1, 2, 0]), ("xy", [0, 1, 2])];

/// A block of the assembly: the name of its node, whether it is a support, and the corners of its faces.
struct AssemblyBlock {
    name: String,
    is_support: bool,
    faces: Vec<Vec<[f64; 3]>>,
}

/// True if a JSON text contains an assembly with blocks.
pub(super) fn is_assembly(text: &str) -> bool {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let value: Value = serde_json::from_str(text).unwrap_or_default();
    nodes(&value).is_some()
}

/// Reads an assembly, given as JSON, as the sections of its blocks in the coordinate plane with this name. `scene` has
/// the other properties of the scene.
///
/// # Errors
/// Returns a message if there is no such plane, or for the reasons of [`read`].
#[cfg(feature = "python")]
pub(crate) fn sections(text: &str, plane: &str, scene: SceneFile) -> Result<SceneFile, String> {
    let Some(plane) = PLANES.into_iter().find(|known| known.0 == plane) else {
        return Err(format!("plane is \"xz\", \"yz\" or \"xy\", not {plane:?}"));
    };
    match read(text, &Options::default().scene(scene), &[plane]) {
        Ok((scene, _)) => Ok(scene),
        Err(remarks) => {
            let remarks: Vec<String> = remarks.into_iter().map(|r| format!("{}; {}", r.message, r.help)).collect();
            Err(remarks.join("\n"))
        }
    }
}

/// Reads an assembly, whose blocks are cut in the first of `planes` to which they are perpendicular. Returns the scene
/// file, and notes about the plane of the section, the unit of length and the thickness.
///
/// # Errors
/// Returns an error if the text is not an assembly with blocks, if all blocks are supports, if the blocks are not
/// prisms perpendicular to one of the planes, or if they differ in thickness and `options` has no thickness.
pub(super) fn read(text: &str, options: &Options, planes: &[Plane]) -> Result<(SceneFile, Vec<String>), Vec<Remark>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let refuse = |message: String, help: &str| Err(vec![Remark { element: String::new(), message, help: help.into() }]);
    let value: Value = match serde_json::from_str(text) {
        Ok(value) => value,
        Err(error) => return refuse(error.to_string(), "correct the JSON text"),
    };
    let Some(nodes) = nodes(&value) else {
        let help = "write it with compas.json_dump(assembly, \"assembly.json\")";
        return refuse("it has no nodes with blocks".into(), help);
    };
    let metres = options.scale.unwrap_or(1.0) * options.ratio.unwrap_or(1.0);
    let solids: Vec<AssemblyBlock> = nodes.iter().filter_map(|(name, node)| solid(name, node)).collect();
    if !solids.iter().any(|s| !s.is_support) {
        let help = "blocks whose node has is_support become ground";
        return refuse("it has no block that is not a support".into(), help);
    }
    let Some((plane, axes)) = planes.iter().copied().find(|plane| solids.iter().all(|s| prism(s, plane.1).is_some()))
    else {
        let help = match planes {
            [_] => "choose another plane, or turn the assembly",
            _ => "turn the assembly, or cut a plane section of it first",
        };
        return refuse(not_prismatic(&solids, planes), help);
    };
    let prisms = solids.iter().filter_map(|s| Some((s, prism(s, axes)?)));
    let mut scene = options.scene.clone();
    let mut depths = Vec::new();
    for (solid, (outline, depth)) in prisms {
        depths.push(depth * metres);
        let corners: Vec<Pair> = outline.iter().map(|c| c.map(|x| x * metres)).collect();
        if solid.is_support {
            scene.ground.push(GroundEntry::from(corners))
        } else {
            scene.blocks.push(BlockEntry::from(corners).id(&solid.name))
        }
    }
    let (thin, thick) = depths.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(*d), b.max(*d)));
    if scene.thickness.is_none() {
        if thick - thin > EQUAL_COORDINATE_TOL * thick {
            let message = format!("its blocks are {thin} to {thick} m thick, and a plane scene has one thickness");
            return refuse(message, "give the thickness with --thickness, in Python with thickness=");
        }
        scene.thickness = Some(thick);
    }
    let notes = vec![
        format!("the blocks are imported as sections in the plane {plane}; a unit of length is {metres} m"),
        format!("the blocks are {thick} m thick perpendicular to the plane"),
    ];
    Ok((scene, notes))
}

/// Returns a message that names the first block that is not a prism perpendicular to one of the planes. If
/// there is no such block, the message says that the blocks are prisms perpendicular to different planes.
fn not_prismatic(solids: &[AssemblyBlock], planes: &[Plane]) -> String {
    let odd = solids.iter().find(|s| planes.iter().all(|plane| prism(s, plane.1).is_none()));
    let which = match planes {
        [(name, _)] => format!("the plane {name}"),
        _ => "one of the planes xz, yz and xy".into(),
    };
    match odd {
        Some(solid) => format!(
            "block {} is not a prism perpendicular to {which}: exactly two of its faces must be parallel to this plane \
             and have the same outline",
            crate::text::line(&solid.name)
        ),
        None => "its blocks are prisms, but perpendicular to different planes".into(),
    }
}

/// Searches a JSON value for the first graph whose nodes have blocks, and returns these nodes. `None` if there is no
/// such graph.
fn nodes(value: &Value) -> Option<&Map<String, Value>> {
    match value {
        Value::Object(object) => {
            let own = object.get("node").and_then(Value::as_object);
            let own = own.filter(|nodes| nodes.values().any(|node| mesh(&node["block"]).is_some()));
            own.or_else(|| object.values().find_map(nodes))
        }
        Value::Array(list) => list.iter().find_map(nodes),
        _ => None,
    }
}

/// Returns the object with the vertices and faces of a block. `None` if there is no such object.
fn mesh(block: &Value) -> Option<&Map<String, Value>> {
    let object = block.as_object()?;
    if object.get("vertex").is_some_and(Value::is_object) && object.contains_key("face") {
        return Some(object);
    }
    ["data", "value"].iter().find_map(|key| mesh(object.get(*key)?))
}

fn solid(name: &str, node: &Value) -> Option<AssemblyBlock> {
    let mesh = mesh(&node["block"])?;
    let vertices: BTreeMap<&str, [f64; 3]> = mesh["vertex"]
        .as_object()?
        .iter()
        .map(|(key, at)| {
            // The file may leave out a coordinate that is 0.
            let place = ["x", "y", "z"].map(|axis| at[axis].as_f64().unwrap_or(0.0));
            (key.as_str(), place)
        })
        .collect();
    let corner = |key: &Value| match key {
        Value::String(key) => vertices.get(key.as_str()).copied(),
        other => vertices.get(other.to_string().as_str()).copied(),
    };
    let faces: Vec<Vec<[f64; 3]>> =
        mesh["face"].as_object()?.values().filter_map(|face| face.as_array()?.iter().map(corner).collect()).collect();
    let is_true = |value: &Value| value.as_bool() == Some(true);
    let attributes = mesh.get("attributes");
    Some(AssemblyBlock {
        name: name.trim_matches('\'').to_owned(),
        is_support: is_true(&node["is_support"]) || attributes.is_some_and(|a| is_true(&a["is_support"])),
        faces,
    })
}

/// Returns the section of a block in the plane of the axes `right` and `up`, and its thickness along the axis `across`.
/// `None` if the block is not a prism along the axis `across`.
fn prism(solid: &AssemblyBlock, [right, up, across]: [usize; 3]) -> Option<(Vec<Pair>, f64)> {
    let size = solid.faces.iter().flatten().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut ends = solid.faces.iter().filter_map(|face| {
        let depths = face.iter().map(|c| c[across]);
        let (low, high) = depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
        let is_end = face.len() >= 3 && high - low < 1e-9 + EQUAL_COORDINATE_TOL * size;
        is_end.then(|| (0.5 * (low + high), face.iter().map(|c| [c[right], c[up]]).collect::<Vec<Pair>>()))
    });
    let (Some(one), Some(other), None) = (ends.next(), ends.next(), ends.next()) else {
        return None;
    };
    let corners = |outline: &[Pair]| {
        let mut rounded: Vec<[i64; 2]> =
            outline.iter().map(|c| c.map(|x| (x * STEPS_PER_UNIT).round() as i64)).collect();
        rounded.sort_unstable();
        rounded
    };
    (corners(&one.1) == corners(&other.1)).then(|| (one.1, (one.0 - other.0).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// A box as written by `compas_assembly`.
    fn block(x: f64, z: f64, lean: f64) -> Value {
        let at = |i: usize| {
            let bits = [i & 1, (i >> 1) & 1, (i >> 2) & 1].map(|b| b as f64);
            json!({ "x": x + bits[0] + lean * bits[1] * bits[2], "y": 0.5 * bits[1], "z": z + bits[2] })
        };
        let vertex: Map<String, Value> = (0..8).map(|i| (i.to_string(), at(i))).collect();
        json!({ "dtype": "compas_assembly.datastructures/Block", "data": { "vertex": vertex, "face": {
            "0": [0, 1, 3, 2], "1": [4, 6, 7, 5], "2": [0, 4, 5, 1], "3": [2, 3, 7, 6], "4": [0, 2, 6, 4], "5": [1, 5, 7, 3] } } })
    }

    fn assembly(second: Value) -> String {
        json!({ "dtype": "compas_assembly.datastructures/Assembly", "data": { "graph": { "data": { "node": {
            "0": { "block": block(0.0, 0.0, 0.0), "is_support": true }, "1": { "block": second } } } } } })
        .to_string()
    }

    #[test]
    fn prisms_are_imported_as_their_sections() {
        let (scene, _) = read(&assembly(block(0.25, 1.0, 0.0)), &Options::default(), &PLANES).expect("prisms");
        assert_eq!((scene.blocks.len(), scene.ground.len()), (1, 1));
        assert_eq!(scene.thickness, Some(0.5));
        let corners = scene.blocks[0].polygon.clone().expect("an outline");
        assert!(corners.contains(&[0.25, 1.0]) && corners.contains(&[1.25, 2.0]), "{corners:?}");
    }

    #[test]
    fn a_block_that_is_not_a_prism_is_reported_by_name() {
        let problems = read(&assembly(block(0.0, 1.0, 0.3)), &Options::default(), &PLANES)
            .expect_err("a block that is not a prism");
        assert!(problems[0].message.contains("block 1 is not a prism"), "{problems:?}");
    }
}
