//! [`import_json`]: writes the log of an import as JSON.

use serde::Serialize;

use super::{Layout, written};
use crate::sources::import::Imported;

/// Writes the log of an import as one JSON object that ends with a line feed. It states how the drawing was
/// interpreted, which elements were ignored, and which corners were moved to close gaps.
///
/// # Units
/// Metres.
///
/// # Example
/// ```
/// use drystone::import::{Format, Options, import};
/// let text = "a; POLYGON ((0 0, 2 0, 2 1))\nb; POINT (3 3)";
/// let imported = import(text, Format::Wkt, &Options::default()).expect("one block");
/// let json = drystone::result::import_json(&imported);
/// assert!(json.contains(r#""element": "line 2 \"b\"""#));
/// ```
pub fn import_json(imported: &Imported) -> String {
    log(imported, None)
}

/// Like [`import_json`], with the text of the scene file under the key `scene`.
#[cfg(feature = "wasm")]
pub(crate) fn imported_json(imported: &Imported) -> String {
    log(imported, Some(imported.scene.to_json()))
}

fn log(imported: &Imported, text: Option<String>) -> String {
    let scene = &imported.scene;
    let done = ImportReport {
        drystone: env!("CARGO_PKG_VERSION"),
        blocks: scene.blocks.len(),
        ground: scene.ground.len(),
        robots: scene.robots.len(),
        scene: text,
        notes: &imported.notes,
        warnings: (imported.remarks.iter())
            .map(|r| Warning { element: &r.element, message: &r.message, help: &r.help })
            .collect(),
        snapped: (imported.snapped.iter())
            .map(|s| SnappedBody {
                body: &s.body,
                element: &s.element,
                corners: s.corners,
                distance: s.distance,
                to: &s.to,
            })
            .collect(),
    };
    written(&done, Layout::Lines, 1)
}

#[derive(Serialize)]
struct ImportReport<'a> {
    drystone: &'static str,
    blocks: usize,
    ground: usize,
    robots: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    notes: &'a [String],
    warnings: Vec<Warning<'a>>,
    snapped: Vec<SnappedBody<'a>>,
}

#[derive(Serialize)]
struct Warning<'a> {
    element: &'a str,
    message: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    help: &'a str,
}

#[derive(Serialize)]
struct SnappedBody<'a> {
    body: &'a str,
    element: &'a str,
    corners: usize,
    distance: f64,
    to: &'a [String],
}
