//! [`import_json`]: writes the log of an import as JSON.

use super::Layout;
use super::json::{Json, object, written};
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
    let warnings = imported.remarks.iter().map(|remark| {
        object! {
            element: &remark.element,
            message: &remark.message,
            help: Json::from(&remark.help).unless_empty(),
        }
    });
    let snapped = imported.snapped.iter().map(|snapped| {
        object! {
            body: &snapped.body,
            element: &snapped.element,
            corners: snapped.corners,
            distance: snapped.distance,
            to: Json::list(&snapped.to),
        }
    });
    let left_out = imported.left_out.iter().map(|(what, count)| object! { what: *what, count: *count });
    let log = object! {
        drystone: env!("CARGO_PKG_VERSION"),
        blocks: scene.blocks.len(),
        ground: scene.ground.len(),
        robots: scene.robots.len(),
        scene: text,
        notes: Json::list(&imported.notes),
        warnings: Json::list(warnings),
        left_out: Json::list(left_out),
        snapped: Json::list(snapped),
    };
    written(&log, Layout::Lines, 1)
}
