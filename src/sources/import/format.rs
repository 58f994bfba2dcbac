//! [`Format`]: the formats that can be imported, and how their content shows which of them a text has.

use serde_json::Value;

use super::{compas, geojson, table, wkt};

/// The format of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Scalable Vector Graphics from Inkscape, Illustrator or this library.
    Svg,
    /// Drawing Exchange Format, in text form, from CAD programs.
    Dxf,
    /// GeoJSON: polygons with properties.
    GeoJson,
    /// Well-known text: one geometry per line.
    Wkt,
    /// A list of bodies with mass and centre, and of their contacts: rows of numbers, or JSON.
    Contacts,
    /// A list of boxes with centre, size and angle, such as the state of a simulator: rows of numbers, or JSON.
    Boxes,
    /// An assembly of `compas_assembly`, as JSON.
    Compas,
}

impl Format {
    /// Returns the format of a JSON text by its content: a contact list, a list of boxes, an assembly of COMPAS, or else
    /// GeoJSON.
    pub fn of_json(text: &str) -> Format {
        let text = table::unmarked(text);
        let value: Value = serde_json::from_str(text).unwrap_or_default();
        if value["contacts"].is_array() && value["bodies"].is_array() {
            Format::Contacts
        } else if !value.is_null() && has_boxes(text) {
            Format::Boxes
        } else if compas::is_assembly(&value) {
            Format::Compas
        } else {
            Format::GeoJson
        }
    }

    /// Returns the format that the content of a text shows; `None` if it shows none.
    pub fn of_text(text: &str) -> Option<Format> {
        let text = text.trim_start_matches(['\u{feff}', '\u{1e}']).trim_start();
        let mut lines = text.lines().map(str::trim);
        let (first, second) = (lines.next().unwrap_or(""), lines.next().unwrap_or(""));
        if text.starts_with('<') {
            return text.contains("<svg").then_some(Format::Svg);
        }
        if first == "999" || (first == "0" && second == "SECTION") {
            return Some(Format::Dxf);
        }
        if let (true, Ok(values)) = (text.starts_with(['{', '[']), geojson::values(text)) {
            let first = values.first().map(|value| value.get(0).unwrap_or(value));
            return match Format::of_json(text) {
                Format::GeoJson => first.filter(|value| value["type"].is_string()).map(|_| Format::GeoJson),
                other => Some(other),
            };
        }
        if wkt::is_table(text) || text.lines().take(MAX_LINES).any(wkt::is_geometry) {
            return Some(Format::Wkt);
        }
        if has_boxes(text) {
            return Some(Format::Boxes);
        }
        (!table::entries(&[("", text)], false).all.is_empty()).then_some(Format::Contacts)
    }

    /// Returns the name of the format in messages.
    pub(super) fn name(self) -> &'static str {
        match self {
            Format::Svg => "SVG",
            Format::Dxf => "DXF",
            Format::GeoJson => "GeoJSON",
            Format::Wkt => "well-known text",
            Format::Contacts => "a contact list",
            Format::Boxes => "a list of boxes",
            Format::Compas => "an assembly of COMPAS",
        }
    }
}

/// The number of lines in which well-known text is searched.
const MAX_LINES: usize = 20;

pub(super) fn has_boxes(text: &str) -> bool {
    table::entries(&[("", text)], false).all.iter().any(table::Entry::is_box)
}
