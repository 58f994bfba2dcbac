//! Imports drawings as scenes for the WebAssembly module.

use serde::Deserialize;

use super::Refusal;
use crate::mechanics::scene::format::SceneFile;
use crate::products::result::imported_json;
use crate::sources::import::{Format, Options, STONES, Stone, import};

/// The options of an import. Their names are those of the fields of [`Options`] and of the keys of a scene file. In
/// addition, `material` is the name of a stone. `frame` is counted from 1.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct ImportOptions {
    scale: Option<f64>,
    ratio: Option<f64>,
    ground_layers: Vec<String>,
    flatten: Option<f64>,
    gap: Option<f64>,
    frame: Option<usize>,
    title: Option<String>,
    friction: Option<f64>,
    material: Option<String>,
    density: Option<f64>,
    thickness: Option<f64>,
    kernel: Option<f64>,
    gravity: Option<[f64; 2]>,
}

/// Imports a drawing, given as text. `format` is the name of its format. Returns JSON with the log of the import and
/// the text of the scene file.
pub(super) fn imported(text: &str, format: &str, options: ImportOptions) -> Result<String, Refusal> {
    let format = match format {
        "svg" => Format::Svg,
        "dxf" => Format::Dxf,
        "geojson" | "json" => Format::GeoJson,
        "wkt" => Format::Wkt,
        other => {
            let why = format!("format must be svg, dxf, geojson, json or wkt, not {other:?}");
            return Err(Refusal::of_option(why));
        }
    };
    Ok(imported_json(&import(text, format, &options.of_library()?)?))
}

impl ImportOptions {
    fn of_library(self) -> Result<Options, Refusal> {
        let material: Option<Stone> = match self.material.as_deref() {
            None => None,
            Some(name) => Some(Stone::from_name(name).ok_or_else(|| {
                let known = STONES.map(|stone| stone.name).join(", ");
                Refusal::of_option(format!("material must be one of {known}, not {name:?}"))
            })?),
        };
        Ok(Options {
            scale: self.scale,
            ratio: self.ratio,
            ground_layers: self.ground_layers,
            flatten: self.flatten,
            gap: self.gap,
            frame: self.frame.map(|number| number.saturating_sub(1)),
            scene: SceneFile {
                title: self.title,
                friction: self.friction.or(material.map(|m| m.friction)),
                density: self.density.or(material.map(|m| m.density)),
                thickness: self.thickness,
                kernel: self.kernel,
                gravity: self.gravity,
                ..SceneFile::default()
            },
        })
    }
}
