//! Reads GeoJSON into a [`Draft`]: polygons with properties. Coordinates are in metres with y up;
//! longitudes and latitudes in degrees are recognised and refused.

use serde_json::{Map, Value};

use super::draft::{Draft, FillRule, Part, PartGeometry, Role, Values};
use super::naming::Naming;
use super::subpath::Subpath;
use super::table::{decimal, is_true};
use crate::geometry::{Bounds, Point};

/// The properties that can name a feature, the most important first. A point separates the keys of nested objects.
const NAME_KEYS: [&str; 6] = ["name", "label", "class", "classification.name", "layer", "id"];

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
    let mut reader = Reader { draft: Draft::default(), scale, naming };
    reader.object(&whole, "", &Properties::default());
    let system = whole.get("crs").and_then(|crs| crs.get("properties")?.get("name")?.as_str());
    match degrees_problem(&reader.draft, system).filter(|_| !is_scale_given) {
        Some(why) => Err(why),
        None => Ok(reader.draft),
    }
}

/// Returns the values of a JSON text: one, or one per line as in a sequence of features. A record separator may begin each
/// line (RFC 8142).
///
/// # Errors
/// Returns the message of the parser.
pub(super) fn values(text: &str) -> Result<Vec<Value>, String> {
    let text = text.replace('\u{1e}', " ");
    serde_json::Deserializer::from_str(&text).into_iter().collect::<Result<_, _>>().map_err(|e| e.to_string())
}

/// Wraps features that stand in a plain list, or one per line, into a collection.
fn collection(features: Vec<Value>) -> Map<String, Value> {
    Map::from_iter([("type".into(), "FeatureCollection".into()), ("features".into(), features.into())])
}

/// The properties of a feature.
#[derive(Clone, Debug, Default)]
pub(super) struct Properties {
    pub(super) name: String,
    pub(super) kind: Option<Role>,
    pub(super) fill: Option<[u8; 3]>,
    pub(super) values: Values,
}

impl Properties {
    /// Reads the name, role, fill and physical values of the feature `at`. The role follows from a name or from the
    /// properties `kind` and `ground`. Keys may be in upper or lower case, and values in quotes. `id` is a name too.
    pub(super) fn read(
        given: &Map<String, Value>,
        id: Option<&Value>,
        at: &str,
        naming: &Naming<'_>,
        draft: &mut Draft,
    ) -> Properties {
        let value = |key: &str| {
            let alike = || given.iter().find(|(other, _)| other.eq_ignore_ascii_case(key)).map(|found| found.1);
            given.get(key).or_else(alike).filter(|value| !value.is_null() && *value != "")
        };
        let text = |value: &Value| match value {
            Value::String(text) if !text.trim().is_empty() => Some(text.trim().to_owned()),
            Value::Number(_) | Value::Bool(_) => Some(value.to_string()),
            _ => None,
        };
        let named = |key: &&str| match key.split_once('.') {
            Some((outer, inner)) => value(outer)?.get(inner).and_then(text),
            None => value(key).and_then(text),
        };
        let names: Vec<String> = NAME_KEYS.iter().filter_map(named).chain(id.and_then(text)).collect();
        let kind = names.iter().find_map(|name| naming.role(name));
        let mut about =
            Properties { kind, name: names.into_iter().next().unwrap_or_default(), ..Properties::default() };
        let element = labelled(at, &about.name);
        match value("kind").and_then(text).map(|word| word.to_lowercase()).as_deref() {
            Some("block") => about.kind = Some(Role::Block),
            Some(word) => match naming.role(word) {
                Some(kind) => about.kind = Some(kind),
                None => {
                    let why = format!("its kind `{word}` is not block, ground, robot or ignore; it is ignored");
                    draft.remark(&element, why, "");
                }
            },
            None => {}
        }
        if value("ground").and_then(text).is_some_and(|word| is_true(&word)) {
            about.kind = Some(Role::Ground);
        }
        let mut number = |key: &str| {
            let number = text(value(key)?).filter(|_| !value(key).is_some_and(Value::is_boolean));
            let number = number.and_then(|number| decimal(&number));
            if number.is_none() {
                draft.remark(&element, format!("its {key} is not a number; it is ignored"), "");
            }
            number
        };
        let [friction, density, weight, mass] = ["friction", "density", "weight", "mass"].map(&mut number);
        about.values = Values { friction, density, weight, mass };
        if let Some(Value::String(fill)) = value("fill") {
            match fill.trim().parse::<svgtypes::Color>() {
                Ok(c) => about.fill = Some([c.red, c.green, c.blue]),
                Err(_) => draft.remark(&element, "its fill is not a valid colour; it is ignored", ""),
            }
        }
        about
    }

    /// Adds a geometry with these properties to the draft.
    pub(super) fn part(&self, form: PartGeometry, element: String, draft: &mut Draft) {
        let part = Part::new(self.kind, &self.name, element, form);
        draft.parts.push(Part { fill: self.fill, values: self.values, ..part });
    }
}

struct Reader<'n> {
    draft: Draft,
    scale: f64,
    naming: &'n Naming<'n>,
}

impl Reader<'_> {
    fn object(&mut self, object: &Map<String, Value>, at: &str, about: &Properties) {
        let kind = object.get("type").and_then(Value::as_str).unwrap_or("");
        let coordinates = object.get("coordinates").unwrap_or(&Value::Null);
        let is_read = match kind {
            "FeatureCollection" => return self.each(object, "features", at, about),
            "GeometryCollection" => return self.each(object, "geometries", at, about),
            "Feature" => {
                let (none, given) = (Map::new(), object.get("properties").and_then(Value::as_object));
                let id = object.get("id");
                let about = Properties::read(given.unwrap_or(&none), id, at, self.naming, &mut self.draft);
                match object.get("geometry") {
                    _ if about.kind == Some(Role::Ignored) => {
                        self.draft.skip(self.naming.why_ignored(), labelled(at, &about.name));
                    }
                    Some(Value::Object(geometry)) => self.object(geometry, &below(at, "geometry"), &about),
                    _ => self.lose("element", at, &about, "it has no geometry"),
                }
                return;
            }
            "Polygon" | "MultiLineString" => self.outlines(coordinates, kind == "Polygon", at, about),
            "LineString" => self.outlines(&vec![coordinates.clone()].into(), false, at, about),
            "MultiPolygon" => coordinates.as_array().map(|polygons| {
                for (i, polygon) in polygons.iter().enumerate() {
                    let at = format!("{}[{i}]", below(at, "coordinates"));
                    if self.outlines(polygon, true, &at, about).is_none() {
                        self.unreadable(&at, about);
                    }
                }
            }),
            "Point" if about.kind == Some(Role::Robot) => self.point(coordinates).map(|spot| {
                about.part(PartGeometry::Point(spot), labelled(at, &about.name), &mut self.draft);
            }),
            "Point" | "MultiPoint" => return self.lose("point", at, about, "a point encloses no area"),
            "" => return self.lose("element", at, about, "it has no type"),
            _ => return self.lose("element", at, about, &format!("{kind} is not a type of GeoJSON")),
        };
        if is_read.is_none() {
            self.unreadable(at, about);
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

    fn point(&self, value: &Value) -> Option<Point> {
        Some(Point::new(value.get(0)?.as_f64()?, value.get(1)?.as_f64()?) * self.scale)
    }

    /// Adds the outline or lines of a geometry; `None` if its coordinates cannot be read.
    fn outlines(&mut self, rings: &Value, closed: bool, at: &str, about: &Properties) -> Option<()> {
        let ring = |ring: &Value| ring.as_array()?.iter().map(|p| self.point(p)).collect::<Option<Vec<Point>>>();
        let rings: Vec<Vec<Point>> = rings.as_array()?.iter().map(ring).collect::<Option<_>>()?;
        let subpaths = rings.iter().filter_map(|ring| Some(Subpath { closed, ..Subpath::closed(ring)? })).collect();
        let form = PartGeometry::Subpaths(subpaths, FillRule::EvenOdd);
        about.part(form, labelled(at, &about.name), &mut self.draft);
        Some(())
    }

    fn unreadable(&mut self, at: &str, about: &Properties) {
        self.lose("element", at, about, "its coordinates do not have the form that its type needs");
    }

    fn lose(&mut self, what: &'static str, at: &str, about: &Properties, why: &str) {
        self.draft.lose(what, &labelled(at, &about.name), why, "");
    }
}

fn below(at: &str, key: &str) -> String {
    if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") }
}

pub(super) fn labelled(at: &str, name: &str) -> String {
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

/// Returns a message if the coordinates are probably longitudes and latitudes in degrees. The message says why, and
/// what to do. Returns `None` if the coordinates are probably lengths. `system` is the name of their system.
pub(super) fn degrees_problem(draft: &Draft, system: Option<&str>) -> Option<String> {
    let remedy = "drystone needs lengths: draw the structure in its own plane, or project it first, for example with \
        ogr2ogr -t_srs EPSG:25832 metres.geojson degrees.geojson; if the numbers are lengths, give --unit m";
    if let Some(system) = system {
        let is_globe = ["CRS84", "WGS84"].iter().any(|name| system.contains(name)) || system.ends_with("4326");
        let name = crate::text::heading(system, 60);
        return is_globe.then(|| format!("its coordinates are longitudes and latitudes in degrees ({name}); {remedy}"));
    }
    let b = draft.parts.iter().filter_map(Part::around).reduce(Bounds::union)?;
    let extent = b.width().max(b.height());
    let on_globe = b.min.x >= -180.0 && b.max.x <= 180.0 && b.min.y >= -90.0 && b.max.y <= 90.0;
    let distance = b.min.coords.norm().min(b.max.coords.norm());
    let is_far = extent > 0.0 && extent <= MAX_EXTENT_DEGREES && distance > MIN_ORIGIN_DISTANCE_RATIO * extent;
    (on_globe && is_far).then(|| {
        format!(
            "its coordinates look like longitude and latitude in degrees: {} to {} and {} to {}; {remedy}",
            b.min.x, b.max.x, b.min.y, b.max.y
        )
    })
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
        read(&text, 1.0, false, &Naming::default()).err()
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
