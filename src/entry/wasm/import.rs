//! Imports drawings as scenes for the WebAssembly module.

use super::Refusal;
use crate::entry::request::read_json;
use crate::mechanics::scene::format::SceneFile;
use crate::products::result::imported_json;
use crate::read::Given;
use crate::sources::import::{Format, Options, STONES, import};

/// Imports a drawing, given as text. `format` is the name of its format. Returns JSON with the log of the import and
/// the text of the scene file.
pub(super) fn imported(text: &str, format: &str, options: Option<&str>) -> Result<String, Refusal> {
    let format = match format {
        "svg" => Format::Svg,
        "dxf" => Format::Dxf,
        "geojson" | "json" => Format::GeoJson,
        "wkt" => Format::Wkt,
        other => return Err(format!("format must be svg, dxf, geojson, json or wkt, not {other:?}").into()),
    };
    Ok(imported_json(&import(text, format, &read_json(options, read)?)?))
}

/// Reads the options of an import. Their names are those of the fields of [`Options`] and of the keys of a scene file.
/// In addition, `material` is the name of a stone. `frame` is counted from 1.
fn read(given: &mut Given<'_, '_>) -> Options {
    let stones = STONES.map(|stone| (stone.name, stone));
    let material = given.key("material", |r, node, at| r.choice(node, at, &stones));
    Options {
        scale: given.number("scale"),
        ratio: given.number("ratio"),
        ground: [texts(given, "ground"), texts(given, "ground_layers")].concat(),
        ignore: texts(given, "ignore"),
        flip_y: given.flag("flip_y"),
        flatten: given.number("flatten"),
        gap: given.number("gap"),
        frame: given.whole("frame", [1, u32::MAX]).map(|number| number as usize - 1),
        scene: SceneFile {
            title: given.text("title"),
            friction: given.number("friction").or(material.map(|m| m.friction)),
            density: given.number("density").or(material.map(|m| m.density)),
            thickness: given.number("thickness"),
            kernel: given.number("kernel"),
            gravity: given.key("gravity", |r, node, at| r.vector(node, at)),
            ..SceneFile::default()
        },
    }
}

/// Reads a list of texts; empty if the key is missing.
fn texts(given: &mut Given<'_, '_>, key: &'static str) -> Vec<String> {
    given.list(key, |r, node, at| r.text(node, at)).unwrap_or_default()
}
