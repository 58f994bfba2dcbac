//! Reads an assembly of the Python package `compas_assembly`, or a model of `compas_dem`, from JSON. The blocks must be
//! prisms perpendicular to one coordinate plane, and the scene gets their sections in this plane.
//!
//! The first object whose nodes have blocks is the assembly, wherever it is in the file. Files of all versions of
//! COMPAS can therefore be read, although some versions wrap the data in a key `data` and older ones in a key `value`.
//! A model has its blocks under the key `elements`, and its graph refers to them.
//!
//! The section of a prism does not depend on its mesh:
//!
//! 1. Find the faces that lie in a plane perpendicular to the axis of the prism. They must lie in two planes.
//! 2. An edge that belongs to one face of an end is on the boundary of this end. Join these edges to outlines, and drop
//!    corners on straight lines.
//! 3. Both ends must have the same corners, and all other vertices must lie on the boundary in the section.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value};

use super::choice;
use super::draft::{Remark, Role, short};
use super::naming::Naming;
use super::outline::NO_GROUND;
use super::{DrawingProblems, Imported, Options};
use crate::geometry::{Point, Polygon, cross};
use crate::mechanics::scene::format::{BlockEntry, GroundEntry, Pair};

/// Coordinates count as equal if they differ by less than this share of the largest coordinate. The thicknesses of the
/// blocks are compared with the same share of the largest thickness.
const EQUAL_COORDINATE_TOL: f64 = 1e-6;
/// The ends of two blocks may differ by this share of the largest depth.
const DEPTH_TOL: f64 = 1e-3;
/// The largest number of comparisons of a vertex with an edge of the section of one block.
const MAX_COMPARISONS: usize = 20_000_000;

/// A coordinate plane: its name, and the indices of the axes that point to the right, up, and perpendicular to the
/// plane.
pub(super) type Plane = (&'static str, [usize; 3]);

/// The planes in the order in which they are tried: z is up in COMPAS.
pub(super) const PLANES: [Plane; 3] = [("xz", [0, 2, 1]), ("yz", [1, 2, 0]), ("xy", [0, 1, 2])];

/// A block of the assembly: the name of its node, whether it is a support, its density in kg/m³ if the file gives it,
/// and the corners of its faces.
struct AssemblyBlock {
    name: String,
    is_support: bool,
    density: Option<f64>,
    faces: Vec<Vec<[f64; 3]>>,
}

/// The section of a prism, and the coordinates of its ends perpendicular to the section.
struct Section {
    polygon: Polygon,
    ends: [f64; 2],
}

/// True if a JSON value contains an assembly or a model with blocks.
pub(super) fn is_assembly(value: &Value) -> bool {
    !blocks(value).is_empty()
}

/// Reads an assembly, given as JSON, as the sections of its blocks in the coordinate plane with this name. `scene` has
/// the other properties of the scene.
///
/// # Errors
/// Returns a message if there is no such plane, or for the reasons of [`read`].
#[cfg(feature = "python")]
pub(crate) fn sections(
    text: &str,
    plane: &str,
    scene: crate::mechanics::scene::format::SceneFile,
) -> Result<crate::mechanics::scene::format::SceneFile, String> {
    let Some(plane) = PLANES.into_iter().find(|known| known.0 == plane) else {
        return Err(format!("plane is \"xz\", \"yz\" or \"xy\", not {plane:?}"));
    };
    match read(text, &Options::default().scene(scene), &[plane]) {
        Ok(imported) => Ok(imported.scene),
        Err(refused) => {
            let problems = refused.problems.into_iter();
            let problems: Vec<String> = problems.map(|r| format!("{}; {}", r.message, r.help)).collect();
            Err(problems.join("\n"))
        }
    }
}

/// Reads an assembly, whose blocks are cut in the first of `planes` to which they are perpendicular. Adds notes about
/// the plane of the section, the unit of length and the thickness.
///
/// # Errors
/// Returns an error if the text is not an assembly with blocks, if all blocks are supports, if the blocks are not
/// prisms perpendicular to one of the planes, if blocks lie at different depths, if they differ in thickness and
/// `options` has no thickness, or if `--ground` or `--ignore` chooses nothing.
pub(super) fn read(text: &str, options: &Options, planes: &[Plane]) -> Result<Imported, DrawingProblems> {
    let refused = |message: String, help: &str| DrawingProblems::of(vec![Remark::new("", message, help)]);
    let value: Value =
        serde_json::from_str(text).map_err(|error| refused(error.to_string(), "correct the JSON text"))?;
    let solids = blocks(&value);
    if solids.is_empty() {
        let help = "write it with compas.json_dump(assembly, \"assembly.json\")";
        return Err(refused("it has no nodes with blocks".into(), help));
    }
    let cut = |plane: &Plane| solids.iter().map(|s| section(s, plane.1)).collect::<Option<Vec<Section>>>();
    let Some((plane, sections)) = planes.iter().find_map(|plane| Some((plane.0, cut(plane)?))) else {
        let help = match planes {
            [_] => "choose another plane, or turn the assembly",
            _ => "turn the assembly, or cut a plane section of it first",
        };
        return Err(refused(not_prismatic(&solids, planes), help));
    };
    let polygons: Vec<Option<Polygon>> = sections.iter().map(|s| Some(s.polygon.clone())).collect();
    let naming = Naming::new(options, false);
    let named: Vec<Option<Role>> = solids.iter().map(|s| naming.role(&s.name)).collect();
    let choices = naming.choices().map_err(DrawingProblems::new)?;
    let labels: Vec<String> = solids.iter().map(|s| format!("block {}", crate::text::line(&s.name))).collect();
    let list = || choice::list(labels.iter().map(String::as_str), &polygons, 1.0);
    let chosen = choice::roles(&choices, &polygons, 1.0)
        .map_err(|why| DrawingProblems { notes: list(), ..DrawingProblems::new(why) })?;

    let metres = options.scale.unwrap_or(1.0) * options.ratio.unwrap_or(1.0);
    let mut scene = options.scene.clone();
    let mut depths = Vec::new();
    let roles = chosen.into_iter().zip(named).map(|(chosen, named)| chosen.or(named));
    for ((solid, section), role) in solids.iter().zip(sections).zip(roles) {
        let by_support = if solid.is_support { Role::Ground } else { Role::Block };
        let rings = section.polygon.rings().iter();
        let mut rings = rings.map(|ring| ring.iter().map(|p| [p.x * metres, p.y * metres]).collect());
        let outline: Vec<Pair> = rings.next().unwrap_or_default();
        let holes: Vec<Vec<Pair>> = rings.collect();
        match role.unwrap_or(by_support) {
            Role::Ground => scene.ground.push(GroundEntry { holes, ..GroundEntry::from(outline) }),
            Role::Ignored => continue,
            Role::Block | Role::Robot => {
                let density = solid.density;
                scene.blocks.push(BlockEntry { holes, density, ..BlockEntry::from(outline).id(&solid.name) });
            }
        }
        depths.push((solid.name.as_str(), section.ends.map(|end| end * metres)));
    }
    if scene.blocks.is_empty() {
        let help = "blocks whose node has is_support become ground, and those that --ground chooses";
        return Err(refused("it has no block that is not a support".into(), help));
    }
    // A structure is plane only if the ends of thinner blocks lie between those of thicker ones.
    let thickness = |one: &(&str, [f64; 2])| one.1[1] - one.1[0];
    let mut nested = depths.clone();
    nested.sort_by(|a, b| thickness(b).total_cmp(&thickness(a)));
    let reach = nested.iter().flat_map(|one| one.1).map(f64::abs).fold(0.0, f64::max);
    let off = DEPTH_TOL * reach;
    let is_apart = |pair: &&[(&str, [f64; 2])]| pair[1].1[0] < pair[0].1[0] - off || pair[1].1[1] > pair[0].1[1] + off;
    if let Some([front, back]) = nested.windows(2).find(is_apart) {
        let ([near, end], [start, far]) = (front.1, back.1);
        let [front, back] = [front, back].map(|one| crate::text::line(one.0));
        let message = format!(
            "block {front} is {} to {} m deep and block {back} {} to {} m, so they do not lie in one plane",
            short(near),
            short(end),
            short(start),
            short(far)
        );
        return Err(refused(
            message,
            "a scene is a plane structure: move the blocks to one depth, or import those of one depth",
        ));
    }
    let thicknesses = depths.iter().map(|(_, [start, end])| end - start);
    let (thin, thick) = thicknesses.fold((f64::INFINITY, 0.0_f64), |(a, b), d| (a.min(d), b.max(d)));
    if scene.thickness.is_none() {
        if thick - thin > EQUAL_COORDINATE_TOL * thick {
            let message = format!("its blocks are {thin} to {thick} m thick, and a plane scene has one thickness");
            return Err(refused(message, "give the thickness with --thickness, in Python with thickness="));
        }
        scene.thickness = Some(thick);
    }
    let mut notes = vec![
        format!("the blocks are imported as sections in the plane {plane}; a unit of length is {metres} m"),
        format!("the blocks are {thick} m thick perpendicular to the plane"),
    ];
    let mut remarks = Vec::new();
    if scene.ground.is_empty() {
        let help =
            "mark supports with is_support, or choose them with --ground: a number below, a point x,y, or below:Y";
        remarks.push(Remark::new("", NO_GROUND, help));
        notes.extend(list());
    }
    Ok(Imported { scene, notes, remarks, ..Imported::default() })
}

/// Returns a message that names the first block that is not a prism perpendicular to one of the planes. If
/// there is no such block, the message says that the blocks are prisms perpendicular to different planes.
fn not_prismatic(solids: &[AssemblyBlock], planes: &[Plane]) -> String {
    let odd = solids.iter().find(|s| planes.iter().all(|plane| section(s, plane.1).is_none()));
    let which = match planes {
        [(name, _)] => format!("the plane {name}"),
        _ => "one of the planes xz, yz and xy".into(),
    };
    match odd {
        Some(solid) => format!(
            "block {} is not a prism perpendicular to {which}: it needs two parallel ends with the same outline, and \
             straight sides between them",
            crate::text::line(&solid.name)
        ),
        None => "its blocks are prisms, but perpendicular to different planes".into(),
    }
}

/// Searches a JSON value for the first assembly or model, and returns its blocks, sorted by name. The list is empty if
/// there is none.
fn blocks(value: &Value) -> Vec<AssemblyBlock> {
    let mut found = match value {
        Value::Object(object) => {
            let list = |key: &str| object.get(key).and_then(Value::as_object);
            let own: Vec<AssemblyBlock> = match (list("elements"), list("node")) {
                (Some(elements), _) => elements.iter().filter_map(|(id, e)| element(object, id, e)).collect(),
                (None, Some(nodes)) => {
                    nodes.iter().filter_map(|(name, node)| solid(name, &node["block"], node)).collect()
                }
                (None, None) => Vec::new(),
            };
            if own.is_empty() { object.values().map(blocks).find(|b| !b.is_empty()).unwrap_or_default() } else { own }
        }
        Value::Array(list) => list.iter().map(blocks).find(|b| !b.is_empty()).unwrap_or_default(),
        _ => Vec::new(),
    };
    // JSON sorts the keys as text: 10 comes before 2.
    found.sort_by_cached_key(|b| (b.name.parse::<u64>().unwrap_or(u64::MAX), b.name.clone()));
    found
}

/// Reads an element of a `compas_dem` model. Its name is the number of its node in the graph.
fn element(model: &Map<String, Value>, id: &str, element: &Value) -> Option<AssemblyBlock> {
    let data = element.get("data").unwrap_or(element);
    let graph = &model.get("graph")?;
    let nodes = graph.get("data").unwrap_or(graph).get("node").and_then(Value::as_object);
    let node = nodes.and_then(|nodes| nodes.iter().find(|(_, node)| node["element"].as_str() == Some(id)));
    let mut block = solid(node.map_or(id, |(name, _)| name), &data["geometry"], data)?;
    let matrix = &data["transformation"]["data"]["matrix"];
    if matrix.is_array() {
        let number = |row: usize, column: usize| matrix[row][column].as_f64();
        for corner in block.faces.iter_mut().flatten() {
            let [x, y, z] = *corner;
            for (row, c) in corner.iter_mut().enumerate() {
                *c = number(row, 0)? * x + number(row, 1)? * y + number(row, 2)? * z + number(row, 3)?;
            }
        }
    }
    let material = data["material"].as_str().and_then(|id| model.get("materials")?.get(id));
    block.density = material.and_then(|m| m.get("data").unwrap_or(m)["density"].as_f64()).filter(|d| *d > 0.0);
    Some(block)
}

/// Returns the object with the vertices and faces of a block. `None` if there is no such object.
fn mesh(block: &Value) -> Option<&Map<String, Value>> {
    let object = block.as_object()?;
    if object.get("vertex").is_some_and(Value::is_object) && object.contains_key("face") {
        return Some(object);
    }
    ["data", "value"].iter().find_map(|key| mesh(object.get(*key)?))
}

/// Reads a block from its mesh. It is a support if its mesh or `flags` say so.
fn solid(name: &str, block: &Value, flags: &Value) -> Option<AssemblyBlock> {
    let mesh = mesh(block)?;
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
        is_support: is_true(&flags["is_support"]) || attributes.is_some_and(|a| is_true(&a["is_support"])),
        density: None,
        faces,
    })
}

/// A point of the section, rounded to steps of the tolerance, so that it can be found in a set.
type Key = [i64; 2];

/// Returns the section of a block in the plane of the axes `right` and `up`, and its thickness along the axis `across`.
/// `None` if the block is not a prism along the axis `across`.
fn section(solid: &AssemblyBlock, [right, up, across]: [usize; 3]) -> Option<Section> {
    let size = solid.faces.iter().flatten().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let tolerance = 1e-9 + EQUAL_COORDINATE_TOL * size;
    let key = |p: &Point| [p.x, p.y].map(|x| (x / tolerance).round() as i64);
    let place = |c: &[f64; 3]| Point::new(c[right], c[up]);
    // Step 1: collect the faces of both ends. All vertices lie between the ends.
    let depths = || solid.faces.iter().flatten().map(|c| c[across]);
    let (low, high) = depths().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
    if !(high - low > tolerance) {
        return None;
    }
    let end = |depth: f64| -> Vec<Vec<Point>> {
        let lies_in_it = |face: &&Vec<[f64; 3]>| face.iter().all(|c| (c[across] - depth).abs() <= tolerance);
        outlines(solid.faces.iter().filter(lies_in_it).map(|face| face.iter().map(place).collect()), tolerance)
    };
    // Step 2: find the outlines of both ends.
    let (rings, others) = (end(low), end(high));
    let (outline, holes) = rings.split_first()?;
    let polygon = Polygon::new(outline.clone(), holes.to_vec()).ok()?;
    // Step 3: compare the corners of the ends, and check that the sides are straight.
    let keys = |rings: &[Vec<Point>]| rings.iter().flatten().map(key).collect::<BTreeSet<Key>>();
    let is_near = |keys: &BTreeSet<Key>, [x, y]: Key| {
        (-1..=1).any(|i| (-1..=1).any(|j| keys.contains(&[x.saturating_add(i), y.saturating_add(j)])))
    };
    let (one, other) = (keys(&rings), keys(&others));
    if !one.iter().all(|k| is_near(&other, *k)) || !other.iter().all(|k| is_near(&one, *k)) {
        return None;
    }
    let inner = solid.faces.iter().filter(|face| {
        // The faces of the ends may have vertices inside the outline.
        [low, high].iter().all(|depth| face.iter().any(|c| (c[across] - depth).abs() > tolerance))
    });
    let sides: Vec<Point> = inner.flatten().map(place).filter(|p| !is_near(&one, key(p))).collect();
    let edges: Vec<_> = polygon.edges().collect();
    if sides.len().saturating_mul(edges.len()) > MAX_COMPARISONS {
        return None;
    }
    let is_on_edge = |p: &Point| edges.iter().any(|edge| edge.distance(*p) <= 2.0 * tolerance);
    let is_prism = sides.iter().all(is_on_edge);
    is_prism.then_some(Section { polygon, ends: [low, high] })
}

/// Returns the outlines around the faces of one end, without corners on straight lines, the largest first (step 2).
fn outlines(faces: impl Iterator<Item = Vec<Point>>, tolerance: f64) -> Vec<Vec<Point>> {
    let key = |p: &Point| [p.x, p.y].map(|x| (x / tolerance).round() as i64);
    let mut places: BTreeMap<Key, Point> = BTreeMap::new();
    let mut boundary: BTreeSet<[Key; 2]> = BTreeSet::new();
    for face in faces {
        for (a, b) in face.iter().zip(face.iter().cycle().skip(1)) {
            let mut edge = [key(a), key(b)];
            places.entry(edge[0]).or_insert(*a);
            edge.sort_unstable();
            // An edge between two faces occurs twice, and is removed again.
            if edge[0] != edge[1] && !boundary.insert(edge) {
                boundary.remove(&edge);
            }
        }
    }
    let mut beside: BTreeMap<Key, Vec<Key>> = BTreeMap::new();
    for [a, b] in boundary {
        beside.entry(a).or_default().push(b);
        beside.entry(b).or_default().push(a);
    }
    let mut rings = Vec::new();
    while let Some((&first, _)) = beside.first_key_value() {
        let mut ring = Vec::new();
        let mut at = first;
        while let Some(next) = beside.get_mut(&at).and_then(Vec::pop) {
            ring.push(places[&at]);
            let back = beside.entry(next).or_default();
            back.retain(|k| *k != at);
            at = next;
        }
        beside.retain(|_, ends| !ends.is_empty());
        rings.push(straightened(&ring, tolerance));
    }
    let area = |ring: &Vec<Point>| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| cross(a.coords, b.coords)).sum::<f64>().abs()
    };
    rings.sort_by(|a, b| area(b).total_cmp(&area(a)));
    rings
}

/// Returns a ring without the corners that lie on the straight line between their neighbours.
fn straightened(ring: &[Point], tolerance: f64) -> Vec<Point> {
    let count = ring.len();
    let is_corner = |i: &usize| {
        let (before, at, after) = (ring[(i + count - 1) % count], ring[*i], ring[(i + 1) % count]);
        let along = after - before;
        (cross(along, at - before) / along.norm()).abs() > tolerance || (at - before).dot(&(after - at)) < 0.0
    };
    (0..count).filter(is_corner).map(|i| ring[i]).collect()
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
        let scene = read(&assembly(block(0.25, 1.0, 0.0)), &Options::default(), &PLANES).expect("prisms").scene;
        assert_eq!((scene.blocks.len(), scene.ground.len()), (1, 1));
        assert_eq!(scene.thickness, Some(0.5));
        let corners = scene.blocks[0].polygon.clone().expect("an outline");
        assert!(corners.contains(&[0.25, 1.0]) && corners.contains(&[1.25, 2.0]), "{corners:?}");
    }

    #[test]
    fn a_block_that_is_not_a_prism_is_reported_by_name() {
        let problems = read(&assembly(block(0.0, 1.0, 0.3)), &Options::default(), &PLANES)
            .expect_err("a block that is not a prism")
            .problems;
        assert!(problems[0].message.contains("block 1 is not a prism"), "{problems:?}");
    }
}
