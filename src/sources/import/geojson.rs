//! Reads GeoJSON into a [`Draft`]: polygons with properties. Coordinates are in metres with y up;
//! longitudes and latitudes in degrees are recognised and refused.

use serde_json::{Map, Value};

use super::draft::{Draft, FillRule, Part, PartGeometry, Role, Values};
use super::naming::Naming;
use super::subpath::Subpath;
use crate::geometry::{Bounds, Point};

/// The properties that can name a feature, the most important first. A point separates the keys of nested objects.
pub(super) const NAME_KEYS: [&str; 8] =
    ["name", "Name", "label", "class", "classification.name", "layer", "Layer", "id"];

/// Reads a GeoJSON text. `scale` is in metres per unit. Coordinates that look like degrees are refused, unless the user
/// gave the scale (`is_scale_given`).
///
/// # Errors
/// Returns the reason why the text cannot be read as GeoJSON.
pub(super) fn read(text: &str, scale: f64, is_scale_given: bool, naming: &Naming<'_>) -> Result<Draft, String> {
    let whole = match values(text)?.as_mut_slice() {
        [Value::Object(object)] => std::mem::take(object),
        [Value::Array(list)] => collection(std::mem::take(list)),
        list => collection(list.iter_mut().map(Value::take).collect()),
    };
    if whole.contains_key("drystone") {
        return Err("it is not GeoJSON but already a scene file".into());
    }
    if !is_scale_given && let Some(why) = degrees_problem(&whole) {
        return Err(why);
    }
    let mut reader = Reader { draft: Draft::default(), scale, naming };
    reader.object(&whole, "", &Properties::default());
    Ok(reader.draft)
}

/// Returns the values of a JSON text: one, or one per line as in a sequence of features. A record separator may begin each
/// line (RFC 8142).
///
/// # Errors
/// Returns the message of the parser.
pub(super) fn values(text: &str) -> Result<Vec<Value>, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text).replace('\u{1e}', " ");
    serde_json::Deserializer::from_str(&text).into_iter().collect::<Result<_, _>>().map_err(|e| e.to_string())
}

/// Wraps features that stand in a plain list, or one per line, into a collection.
fn collection(features: Vec<Value>) -> Map<String, Value> {
    Map::from_iter([("type".into(), "FeatureCollection".into()), ("features".into(), features.into())])
}

/// The properties of a feature.
#[derive(Clone, Debug, Default)]
struct Properties {
    name: String,
    kind: Option<Role>,
    fill: Option<[u8; 3]>,
    values: Values,
}

struct Reader<'n> {
    draft: Draft,
    scale: f64,
    naming: &'n Naming<'n>,
}

impl Reader<'_> {
    fn object(&mut self, object: &Map<String, Value>, at: &str, about: &Properties) {
        let kind = object.get("type").and_then(Value::as_str).unwrap_or("");
        match kind {
            "FeatureCollection" => self.each(object, "features", at, about),
            "GeometryCollection" => self.each(object, "geometries", at, about),
            "Feature" => {
                let about = self.properties(object, at);
                if about.kind == Some(Role::Ignored) {
                    self.draft.skip(self.naming.why_ignored(), labelled(at, &about.name));
                    return;
                }
                match object.get("geometry") {
                    Some(Value::Object(geometry)) => {
                        self.object(geometry, &below(at, "geometry"), &about);
                    }
                    _ => self.lose("element", at, &about, "it has no geometry"),
                }
            }
            "Polygon" | "MultiLineString" => match object.get("coordinates").and_then(|c| self.rings(c)) {
                Some(rings) => self.outlines(rings, kind == "Polygon", at, about),
                None => self.unreadable(at, about),
            },
            "LineString" => match object.get("coordinates").and_then(|c| self.ring(c)) {
                Some(line) => self.outlines(vec![line], false, at, about),
                None => self.unreadable(at, about),
            },
            "MultiPolygon" => match object.get("coordinates").and_then(Value::as_array) {
                Some(polygons) => {
                    for (i, polygon) in polygons.iter().enumerate() {
                        let at = format!("{}[{i}]", below(at, "coordinates"));
                        match self.rings(polygon) {
                            Some(rings) => self.outlines(rings, true, &at, about),
                            None => self.unreadable(&at, about),
                        }
                    }
                }
                None => self.unreadable(at, about),
            },
            "Point" if about.kind == Some(Role::Robot) => match object.get("coordinates").and_then(|c| self.point(c)) {
                Some(spot) => self.part(PartGeometry::Point(spot), at, about),
                None => self.unreadable(at, about),
            },
            "Point" | "MultiPoint" => {
                self.lose("point", at, about, "a point encloses no area");
            }
            "" => self.lose("element", at, about, "it has no type"),
            _ => self.lose("element", at, about, &format!("{kind} is not a type of GeoJSON")),
        }
    }

    fn each(&mut self, object: &Map<String, Value>, key: &str, at: &str, about: &Properties) {
        let at = below(at, key);
        let Some(list) = object.get(key).and_then(Value::as_array) else {
            self.lose("element", &at, about, "it is not a list");
            return;
        };
        for (i, entry) in list.iter().enumerate() {
            let at = format!("{at}[{i}]");
            match entry {
                Value::Object(entry) => self.object(entry, &at, about),
                _ => self.lose("element", &at, about, "it is not an object"),
            }
        }
    }

    /// Reads the properties of a feature: its name, fill and physical values, and its role. The role follows from the
    /// name or from the properties `kind` and `ground`.
    fn properties(&mut self, feature: &Map<String, Value>, at: &str) -> Properties {
        let none = Map::new();
        let properties = feature.get("properties").and_then(Value::as_object).unwrap_or(&none);
        let text = |value: Option<&Value>| match value {
            Some(Value::String(text)) if !text.trim().is_empty() => Some(text.trim().to_owned()),
            Some(Value::Number(number)) => Some(number.to_string()),
            _ => None,
        };
        let value = |key: &str| match key.split_once('.') {
            Some((outer, inner)) => text(properties.get(outer).and_then(|value| value.get(inner))),
            None => text(properties.get(key)),
        };
        let names: Vec<String> = NAME_KEYS.iter().filter_map(|key| value(key)).chain(text(feature.get("id"))).collect();
        let kind = names.iter().filter_map(|name| self.naming.role(name)).next();
        let name = names.into_iter().next().unwrap_or_default();
        let mut about = Properties { kind, name, ..Properties::default() };
        let word = properties.get("kind").and_then(Value::as_str);
        match word.map(str::to_ascii_lowercase).as_deref() {
            Some("block") => about.kind = Some(Role::Block),
            Some(word) => match self.naming.role(word) {
                Some(kind) => about.kind = Some(kind),
                None => {
                    let why = format!("its kind `{word}` is not block, ground, robot or ignore; it is ignored");
                    self.remark(at, &about, &why);
                }
            },
            None => {}
        }
        if properties.get("ground").and_then(Value::as_bool) == Some(true) {
            about.kind = Some(Role::Ground);
        }
        about.values = Values {
            friction: self.number(properties, "friction", at, &about),
            density: self.number(properties, "density", at, &about),
            weight: self.number(properties, "weight", at, &about),
            mass: self.number(properties, "mass", at, &about),
        };
        if let Some(fill) = properties.get("fill").and_then(Value::as_str) {
            match fill.trim().parse::<svgtypes::Color>() {
                Ok(c) => about.fill = Some([c.red, c.green, c.blue]),
                Err(_) => self.remark(at, &about, "its fill is not a valid colour; it is ignored"),
            }
        }
        about
    }

    /// Reads a physical value of a feature; `None` if it is missing or not a number. A value that is not a number is
    /// reported.
    fn number(&mut self, properties: &Map<String, Value>, key: &str, at: &str, about: &Properties) -> Option<f64> {
        let value = properties.get(key).filter(|v| !v.is_null())?;
        let number = value.as_f64();
        if number.is_none() {
            self.remark(at, about, &format!("its {key} is not a number; it is ignored"));
        }
        number
    }

    fn rings(&self, value: &Value) -> Option<Vec<Vec<Point>>> {
        value.as_array()?.iter().map(|ring| self.ring(ring)).collect()
    }

    fn ring(&self, value: &Value) -> Option<Vec<Point>> {
        value.as_array()?.iter().map(|p| self.point(p)).collect()
    }

    fn point(&self, value: &Value) -> Option<Point> {
        let numbers = value.as_array()?;
        let number = |i: usize| numbers.get(i)?.as_f64();
        Some(Point::new(number(0)?, number(1)?) * self.scale)
    }

    fn outlines(&mut self, rings: Vec<Vec<Point>>, closed: bool, at: &str, about: &Properties) {
        let outline = |ring: &Vec<Point>| Some(Subpath { closed, ..Subpath::closed(ring)? });
        let subpaths = rings.iter().filter_map(outline).collect();
        self.part(PartGeometry::Subpaths(subpaths, FillRule::EvenOdd), at, about);
    }

    fn part(&mut self, form: PartGeometry, at: &str, about: &Properties) {
        let part = Part::new(about.kind, &about.name, labelled(at, &about.name), form);
        self.draft.parts.push(Part { fill: about.fill, values: about.values, ..part });
    }

    fn unreadable(&mut self, at: &str, about: &Properties) {
        self.lose("element", at, about, "its coordinates do not have the form that its type needs");
    }

    fn lose(&mut self, what: &'static str, at: &str, about: &Properties, why: &str) {
        self.draft.lose(what, &labelled(at, &about.name), why, "");
    }

    fn remark(&mut self, at: &str, about: &Properties, message: &str) {
        self.draft.remark(labelled(at, &about.name), message, "");
    }
}

fn below(at: &str, key: &str) -> String {
    if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") }
}

fn labelled(at: &str, name: &str) -> String {
    match (at, name) {
        ("", "") => "the outermost object".into(),
        (at, "") => at.to_owned(),
        ("", name) => format!("\"{name}\""),
        (at, name) => format!("{at} \"{name}\""),
    }
}

/// Coordinates in the range of degrees count as places on the globe if their distance from the origin, relative to
/// their extent, exceeds this. Drawings usually lie nearer to their origin.
const MIN_ORIGIN_DISTANCE_RATIO: f64 = 20.0;
/// A structure on the globe extends at most this many degrees, about 100 km.
const MAX_EXTENT_DEGREES: f64 = 1.0;
/// The largest depth to which nested collections are searched for coordinates.
const MAX_DEPTH: usize = 50;

/// Returns a message if the coordinates are probably longitudes and latitudes in degrees. The message says why, and
/// what to do. Returns `None` if the coordinates are probably lengths.
pub(super) fn degrees_problem(object: &Map<String, Value>) -> Option<String> {
    let remedy = "drystone needs lengths: draw the structure in its own plane, or project it first, for example with \
        ogr2ogr -t_srs EPSG:25832 metres.geojson degrees.geojson; if the numbers are lengths, give --unit m";
    let system = object.get("crs").and_then(|crs| crs.get("properties")?.get("name")?.as_str());
    if let Some(system) =
        system.filter(|name| name.contains("CRS84") || name.ends_with(":4326") || name.contains("WGS84"))
    {
        let system = crate::text::heading(system, 60);
        return Some(format!("its coordinates are longitudes and latitudes in degrees ({system}); {remedy}"));
    }
    let mut points = Vec::new();
    collect(object, 0, &mut points);
    let b = Bounds::from_points(points)?;
    let extent = (b.max.x - b.min.x).max(b.max.y - b.min.y);
    let on_globe = b.min.x >= -180.0 && b.max.x <= 180.0 && b.min.y >= -90.0 && b.max.y <= 90.0;
    let distance = b.min.coords.norm().min(b.max.coords.norm());
    let is_far = extent > 0.0 && extent <= MAX_EXTENT_DEGREES && distance > MIN_ORIGIN_DISTANCE_RATIO * extent;
    (on_globe && is_far && system.is_none()).then(|| {
        format!(
            "its coordinates look like longitude and latitude in degrees: {} to {} and {} to {}; {remedy}",
            b.min.x, b.max.x, b.min.y, b.max.y
        )
    })
}

fn collect(object: &Map<String, Value>, depth: usize, points: &mut Vec<Point>) {
    for key in ["features", "geometries", "geometry"] {
        let entries = match object.get(key) {
            Some(Value::Array(list)) => list.as_slice(),
            Some(value) => std::slice::from_ref(value),
            None => &[],
        };
        for entry in entries.iter().filter_map(Value::as_object) {
            if depth < MAX_DEPTH {
                collect(entry, depth + 1, points);
            }
        }
    }
    if let Some(coordinates) = object.get("coordinates") {
        numbers(coordinates, points);
    }
}

/// Adds the points in nested lists to `points`. The recursion needs no limit, because the JSON parser limits the
/// nesting depth.
fn numbers(value: &Value, points: &mut Vec<Point>) {
    let Some(list) = value.as_array() else { return };
    let number = |i: usize| list.get(i).and_then(Value::as_f64);
    match (number(0), number(1)) {
        (Some(x), Some(y)) => points.push(Point::new(x, y)),
        _ => list.iter().for_each(|entry| numbers(entry, points)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_kinds_and_values_of_features_are_read() {
        let text = r##"{ "type": "FeatureCollection", "features": [
            { "type": "Feature", "properties": { "name": "soil", "ground": true, "friction": 0.4 },
              "geometry": { "type": "Polygon", "coordinates": [[[0, 0, 7], [4, 0, 7], [4, -1, 7], [0, 0, 7]]] } },
            { "type": "Feature", "id": 12, "properties": { "density": 3, "fill": "#8b6b3d", "weight": "heavy" },
              "geometry": { "type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [0, 1]]], [[[5, 0], [6, 0], [5, 1]]]] } },
            { "type": "Feature", "properties": { "name": "robot a" }, "geometry": { "type": "Point", "coordinates": [0.2, 0.2] } },
            { "type": "Feature", "properties": { "kind": "cloud" }, "geometry": { "type": "LineString", "coordinates": [] } },
            { "type": "Feature", "properties": null, "geometry": null }, 7 ] }"##;
        let draft = read(text, 2.0, true, &Naming::default()).expect("readable");
        let kinds: Vec<Role> = draft.parts.iter().map(|p| p.kind).collect();
        assert_eq!(kinds, [Role::Ground, Role::Block, Role::Block, Role::Robot, Role::Block]);
        assert_eq!(draft.parts[0].values.friction, Some(0.4));
        assert_eq!(draft.parts[1].name, "12");
        assert_eq!(draft.parts[1].fill, Some([0x8b, 0x6b, 0x3d]));
        assert!(matches!(draft.parts[3].form, PartGeometry::Point(p) if p == Point::new(0.4, 0.4)));
        let remarks: Vec<&str> = draft.remarks.iter().map(|r| r.message.as_str()).collect();
        assert_eq!(remarks.len(), 4, "{remarks:?}");
        assert!(remarks[1].contains("its kind `cloud` is not block, ground, robot or ignore"));
        assert_eq!(draft.remarks[0].element, "features[1] \"12\"");
        assert!(read("{", 1.0, true, &Naming::default()).is_err());
    }

    fn says(coordinates: &str, crs: &str) -> Option<String> {
        let text = format!(
            r#"{{ {crs} "type": "Feature", "geometry": {{ "type": "Polygon", "coordinates": [[{coordinates}]] }} }}"#
        );
        let value: Value = serde_json::from_str(&text).expect("JSON");
        degrees_problem(value.as_object().expect("an object"))
    }

    #[test]
    fn degrees_are_recognised_and_lengths_are_not() {
        let munich = "[11.5801, 48.1301], [11.5809, 48.1301], [11.5809, 48.1306]";
        let why = says(munich, "").expect("a message about degrees");
        assert!(why.contains("11.5801 to 11.5809") && why.contains("--unit m"), "{why}");
        let named = r#""crs": { "properties": { "name": "urn:ogc:def:crs:OGC:1.3:CRS84" } },"#;
        assert!(says("[0, 0], [4, 0], [4, 3]", named).is_some());
        let projected = r#""crs": { "properties": { "name": "urn:ogc:def:crs:EPSG::25832" } },"#;
        for (coordinates, crs) in [
            ("[0, 0], [0.5, 0], [0.5, 0.4]", ""),
            ("[100, 50], [112, 50], [112, 57]", ""),
            ("[691000.1, 5334000.1], [691000.9, 5334000.1], [691000.9, 5334000.4]", ""),
            (munich, projected),
        ] {
            assert_eq!(says(coordinates, crs), None, "{coordinates}");
        }
    }
}
