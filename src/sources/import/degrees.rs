//! Recognises GeoJSON whose coordinates are longitudes and latitudes, in degrees.

use serde_json::{Map, Value};

use crate::geometry::{Bounds, Point};

/// Coordinates in the range of degrees count as places on the globe if their distance from the origin, relative to
/// their extent, exceeds this. Drawings usually lie nearer to their origin.
const MIN_ORIGIN_DISTANCE_RATIO: f64 = 20.0;
/// A structure on the globe extends at most this many degrees, about 100 km.
const MAX_EXTENT_DEGREES: f64 = 1.0;
/// The largest depth to which nested collections are searched for coordinates.
const MAX_DEPTH: usize = 50;

/// Returns a message if the coordinates are probably longitudes and latitudes in degrees. The message says why, and
/// what to do. Returns `None` if the coordinates are probably lengths.
pub(super) fn problem(object: &Map<String, Value>) -> Option<String> {
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

    fn says(coordinates: &str, crs: &str) -> Option<String> {
        let text = format!(
            r#"{{ {crs} "type": "Feature", "geometry": {{ "type": "Polygon", "coordinates": [[{coordinates}]] }} }}"#
        );
        let value: Value = serde_json::from_str(&text).expect("JSON");
        problem(value.as_object().expect("an object"))
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
