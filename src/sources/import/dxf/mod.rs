//! Reads DXF drawings into a [`Draft`]: outlines, circles, hatches, lines and arcs.
//!
//! | step | file |
//! |---|---|
//! | 1. split the text into records of group codes and values | `record` |
//! | 2. find the header, the layers, the blocks and the entities | `record` |
//! | 3. convert each entity to curves in its own coordinates | `entity`, `hatch` |
//! | 4. insert blocks with their transform, and group the curves by layer | `walk` |
//!
//! The role of an entity follows from the name of its layer or block, as in other drawings. The name of a layer can
//! also be a material: a layer "granite" sets density and friction. Group codes are those of the AutoCAD DXF
//! reference.

mod entity;
mod hatch;
mod record;
mod spline;
mod walk;

use std::collections::BTreeMap;

use record::Document;
use walk::DxfWalk;

use super::draft::{Draft, Scale};
use super::naming::Naming;

/// Reads a DXF file in text form into a draft in metres, with y up.
///
/// # Errors
/// Returns the reason why the text cannot be read as DXF.
pub(super) fn read(text: &str, scale: Scale, naming: &Naming<'_>) -> Result<Draft, String> {
    let records = record::records(text)?;
    let document = Document::new(&records)?;
    let (metres, note) = scale.of(unit(document.unit), "the drawing states no unit")?;
    let mut walk = DxfWalk {
        document: &document,
        naming,
        metres,
        draft: Draft { unit: metres, ..Draft::default() },
        groups: BTreeMap::new(),
        inserted: 0,
    };
    walk.draft.notes.push(note);
    walk.drawing()?;
    Ok(walk.draft)
}

/// Returns the length in metres of the unit with this `$INSUNITS` code, and a note that the drawing states this unit.
/// `None` if the code is not a known unit of length.
fn unit(code: i64) -> Option<(f64, String)> {
    let (metres, name) = match code {
        1 => (0.0254, "inches"),
        2 => (0.3048, "feet"),
        4 => (1e-3, "millimetres"),
        5 => (1e-2, "centimetres"),
        6 => (1.0, "metres"),
        7 => (1e3, "kilometres"),
        10 => (0.9144, "yards"),
        14 => (0.1, "decimetres"),
        _ => return None,
    };
    Some((metres, format!("the drawing states {name} ($INSUNITS)")))
}

#[cfg(test)]
mod tests;
