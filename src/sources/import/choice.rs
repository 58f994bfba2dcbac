//! [`Choice`]: bodies that the options `--ground` and `--ignore` choose by number, point or height instead of by name.

use super::draft::Role;
use crate::geometry::{Bounds, Point, Polygon};

/// A value of `--ground` or `--ignore` that is not a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Choice {
    /// A number in the list of bodies, from 1.
    Number(usize),
    /// All bodies that contain this point, in the unit of the drawing with y up.
    Inside(Point),
    /// All bodies that lie completely below this height, in the unit of the drawing.
    Below(f64),
}

/// The bodies that one value of an option chooses, and their new role.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen<'o> {
    pub(super) role: Role,
    pub(super) text: &'o str,
    pub(super) choice: Choice,
}

impl Choice {
    /// Parses `3`, `1.5,0.2` or `below:0`; `None` for other text, which can only be a name.
    pub(super) fn parse(text: &str) -> Option<Choice> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        let text = text.trim();
        if let Some(height) = text.strip_prefix("below:") {
            return number(height).map(Choice::Below);
        }
        match text.split_once(',') {
            Some((x, y)) => Some(Choice::Inside(Point::new(number(x)?, number(y)?))),
            None => text.parse().ok().map(Choice::Number),
        }
    }

    fn holds(self, number: usize, polygon: &Polygon, unit: f64) -> bool {
        match self {
            Choice::Number(wanted) => number == wanted,
            Choice::Inside(at) => polygon.contains(at * unit),
            Choice::Below(height) => {
                let bounds = polygon.bounds();
                // Bodies that reach exactly up to the line are below it, whatever the rounding of their coordinates.
                bounds.max.y <= height * unit + 1e-9 * bounds.diagonal()
            }
        }
    }
}

impl Chosen<'_> {
    /// Returns, for each body, whether it is chosen. `unit` is the unit of the drawing in metres.
    ///
    /// # Errors
    /// Returns a message if no body is chosen.
    fn among(&self, bodies: &[Option<Polygon>], unit: f64) -> Result<Vec<bool>, String> {
        let is_chosen = |(i, polygon): (usize, &Option<Polygon>)| {
            polygon.as_ref().is_some_and(|polygon| self.choice.holds(i + 1, polygon, unit))
        };
        let chosen: Vec<bool> = bodies.iter().enumerate().map(is_chosen).collect();
        if chosen.contains(&true) {
            return Ok(chosen);
        }
        let option = if self.role == Role::Ground { "--ground" } else { "--ignore" };
        let why = match self.choice {
            Choice::Number(_) => format!("the bodies are numbered from 1 to {}", bodies.len()),
            Choice::Inside(_) => "no outline contains this point".into(),
            Choice::Below(_) => "no outline lies completely below this height".into(),
        };
        Err(format!("{option} {} chooses nothing: {why}", self.text))
    }
}

/// Returns the new role of each body; `None` for bodies that no value chooses. A later value wins over an earlier one.
///
/// # Errors
/// Returns a message for the first value that chooses no body.
pub(super) fn roles(values: &[Chosen<'_>], bodies: &[Option<Polygon>], unit: f64) -> Result<Vec<Option<Role>>, String> {
    let mut roles = vec![None; bodies.len()];
    for value in values {
        for (role, chosen) in roles.iter_mut().zip(value.among(bodies, unit)?) {
            if chosen {
                *role = Some(value.role);
            }
        }
    }
    Ok(roles)
}

/// The largest number of bodies that [`list`] lists.
const MAX_LISTED_BODIES: usize = 12;

/// Returns lines that list the lowest bodies with their numbers, for the options `--ground` and `--ignore`. `elements`
/// are descriptions of the bodies. `unit` is the unit of the drawing in metres.
pub(super) fn list<'e>(elements: impl Iterator<Item = &'e str>, bodies: &[Option<Polygon>], unit: f64) -> Vec<String> {
    let mut boxes: Vec<_> = elements
        .zip(bodies)
        .enumerate()
        .filter_map(|(i, (element, polygon))| Some((i + 1, element, polygon.as_ref()?.bounds())))
        .collect();
    boxes.sort_by(|a, b| a.2.min.y.total_cmp(&b.2.min.y));
    let more = boxes.len().saturating_sub(MAX_LISTED_BODIES);
    let number = |x: f64| super::draft::six_digits(x / unit);
    let line = |(i, element, b): &(usize, &str, Bounds)| {
        format!(
            "{i}: {element}, from ({}, {}) to ({}, {})",
            number(b.min.x),
            number(b.min.y),
            number(b.max.x),
            number(b.max.y)
        )
    };
    let mut lines = vec!["bodies by height, in the unit of the drawing with y up:".to_owned()];
    lines.extend(boxes.iter().take(MAX_LISTED_BODIES).map(line));
    if more > 0 {
        lines.push(format!("and {more} more above"));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_a_number_a_point_a_height_or_a_name() {
        for (text, choice) in [
            ("3", Some(Choice::Number(3))),
            ("1.5, -2", Some(Choice::Inside(Point::new(1.5, -2.0)))),
            ("below:-0.5", Some(Choice::Below(-0.5))),
            ("below:x", None),
            ("1,2,3", None),
            ("Felsen", None),
        ] {
            assert_eq!(Choice::parse(text), choice, "{text}");
        }
    }
}
