//! Reads a list of boxes and discs, such as the state of a simulator, into a [`Draft`].
//!
//! A box has the place of its centre, width, height, and perhaps a name, an angle in radians, mass in kg and friction; a
//! disc has a radius. Boxes that are fixed, and boxes without mass in a list with masses, are ground.

use super::contact_list::MAX_DIRECTION;
use super::draft::{Draft, FillRule, Part, PartGeometry, Role, Values};
use super::naming::Naming;
use super::subpath::{Affine, Subpath};
use super::table::{self, Column, Entries, is_true};
use crate::geometry::Point;

/// Reads a list of boxes. `scale` is in metres per unit.
///
/// # Errors
/// Returns the reason why a row is not a box.
pub(super) fn read(text: &str, scale: f64, naming: &Naming<'_>) -> Result<Draft, String> {
    let is_clean = |entries: &Entries| {
        let is_number = |(column, cell): (&Column, &String)| {
            matches!(column, Column::Name | Column::Fixed) || table::value(cell).is_some()
        };
        entries.problems.is_empty() && entries.all.iter().all(|entry| entry.cells.iter().all(is_number))
    };
    let read = |decimal_comma: bool| table::entries(&[("", text)], decimal_comma);
    let mut entries = read(false);
    if !is_clean(&entries) {
        let decimal = Some(read(true)).filter(is_clean);
        entries = decimal.unwrap_or(entries);
    }
    if entries.problems.is_empty() && !entries.all.iter().any(table::Entry::is_box) {
        return Err("it has no boxes: name the columns name, x, y, width, height, angle, mass, friction, fixed".into());
    }
    if let Some(problem) = entries.problems.first() {
        return Err(format!("{}: {}", problem.element, problem.message));
    }
    let mut draft = Draft::default();
    draft.notes.append(&mut entries.notes);
    for entry in &entries.all {
        let name = entry.cells.get(&Column::Name).map_or("", |name| name.trim());
        let element = if name.is_empty() { entry.place.clone() } else { format!("{} \"{name}\"", entry.place) };
        for column in entry.cells.keys().filter(|column| !matches!(column, Column::Name | Column::Fixed)) {
            if entry.number(*column).is_none() {
                return Err(format!("{element}: `{}` is not a number", entry.cells[column]));
            }
        }
        let number = |column| entry.number(column);
        let angle = number(Column::Angle).unwrap_or(0.0);
        if angle.abs() > MAX_DIRECTION {
            return Err(format!(
                "{element}: the angle {angle} is more than a full turn; a column in degrees is angle_deg"
            ));
        }
        let (Some(x), Some(y)) = (number(Column::X), number(Column::Y)) else {
            return Err(format!("{element}: it has no x or no y"));
        };
        let map = Affine::translation(x * scale, y * scale).after(&Affine::rotation(angle.to_degrees()));
        let outline = match (number(Column::Radius), number(Column::Width), number(Column::Height)) {
            (Some(radius), ..) if radius > 0.0 => Subpath::ellipse(Point::origin(), radius * scale, radius * scale),
            (None, Some(width), Some(height)) if width > 0.0 && height > 0.0 => {
                let (x, y) = (0.5 * width * scale, 0.5 * height * scale);
                let corners = [(-x, -y), (x, -y), (x, y), (-x, y)].map(|(x, y)| Point::new(x, y));
                Subpath { closed: true, ..Subpath::closed(&corners).ok_or("it has no corners")? }
            }
            _ => return Err(format!("{element}: it has no width and height above 0, and no radius")),
        };
        let is_fixed = entry.cells.get(&Column::Fixed).is_some_and(|fixed| is_true(fixed));
        let mass = number(Column::Mass).filter(|mass| *mass > 0.0);
        let is_heavy = entry.cells.contains_key(&Column::Mass) && mass.is_none();
        let kind = if is_fixed || is_heavy { Some(Role::Ground) } else { naming.role(name) };
        if kind == Some(Role::Ignored) {
            draft.skip(naming.why_ignored(), element);
            continue;
        }
        let form = PartGeometry::Subpaths(vec![outline.mapped(&map)], FillRule::EvenOdd);
        let values = Values { friction: number(Column::Friction), mass, ..Values::default() };
        draft.parts.push(Part { values, ..Part::new(kind, name, element, form) });
    }
    Ok(draft)
}
