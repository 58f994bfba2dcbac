//! Reads a contact list: bodies with centre and mass, and the points at which they touch, as rows of numbers or as
//! JSON.
//!
//! A row of three numbers is a body: x, y, mass. If all bodies have four numbers, the first is the number of the body. A
//! row of six numbers is a contact: the numbers of the two bodies from
//! 1 (0 is the ground), x, y, the direction of the normal into the first body in radians, and the friction coefficient.

use std::collections::BTreeSet;

use serde_json::Value;

use super::draft::Remark;
use super::{DrawingProblems, Imported, Options};
use crate::mechanics::scene::format::{BlockEntry, ContactEntry};

/// Directions with a magnitude above this, in radians, are refused, because they are most likely degrees.
const MAX_DIRECTION: f64 = 7.0;
/// A direction within this many degrees of a multiple of 15° is replaced by that multiple: π is often written as
/// 3.1416.
const SNAP_DEGREES: f64 = 0.01;

/// One body or contact, with a description of its place in the file.
struct Row {
    place: String,
    numbers: Vec<f64>,
}

/// True if a JSON text is a contact list: an object with the lists `bodies` and `contacts`.
pub(super) fn is_contact_list(text: &str) -> bool {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let value: Value = serde_json::from_str(text).unwrap_or_default();
    value["bodies"].is_array() && value["contacts"].is_array()
}

/// Reads a contact list. Notes state the units and the directions of the normals.
///
/// A comma is a separator or a decimal comma. If only one of the two readings gives a contact list, it is taken.
///
/// # Errors
/// Returns a problem for each row that is neither a body nor a contact, each contact with a body that does not exist,
/// and each contact whose normal has a direction beyond ±7 rad (about a full turn). If there are no such rows, returns
/// one problem if there is no body or no contact, or if both readings of the commas give a contact list.
pub(super) fn read(text: &str, options: &Options) -> Result<Imported, DrawingProblems> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if !(options.ground.is_empty() && options.ignore.is_empty()) {
        return Err(DrawingProblems::new("a contact list has no outlines to choose; its body 0 is the ground"));
    }
    let rows = if text.trim_start().starts_with('{') { json_rows(text) } else { written_rows(text, false) };
    let plain = list(rows, options).map_err(DrawingProblems::of);
    if text.trim_start().starts_with('{') || !text.contains(',') {
        return plain;
    }
    match (plain, list(written_rows(text, true), options)) {
        (Ok(plain), Ok(decimal)) if plain.scene != decimal.scene => {
            let message = "its commas can be read as separators and as decimal points";
            let help = "write decimal points, or put only semicolons between the numbers";
            Err(DrawingProblems::of(vec![problem("", message.into(), help)]))
        }
        (Err(_), Ok(mut decimal)) => {
            decimal.notes.push("commas are read as decimal points".into());
            Ok(decimal)
        }
        (plain, _) => plain,
    }
}

/// Makes a scene from the rows of a list, or returns the problems of its rows.
fn list((rows, mut problems): (Vec<Row>, Vec<Remark>), options: &Options) -> Result<Imported, Vec<Remark>> {
    let metres = options.scale.unwrap_or(1.0) * options.ratio.unwrap_or(1.0);
    // Either all bodies begin with their number, or none. A first pass collects the numbers.
    let is_numbered = !rows.iter().any(|row| row.numbers.len() == 3);
    let mut ids: Vec<f64> = Vec::new();
    for row in &rows {
        match row.numbers[..] {
            [_, _, _] => ids.push((ids.len() + 1) as f64),
            [id, ..] if row.numbers.len() == 4 && is_numbered => ids.push(id),
            _ => {}
        }
    }
    let known: BTreeSet<u64> = ids.iter().map(|id| id.to_bits()).collect();
    let name = |number: f64| match number {
        0.0 => Some("ground".to_owned()),
        number => known.contains(&number.to_bits()).then(|| number.to_string()),
    };
    let mut scene = options.scene.clone();
    for row in &rows {
        match row.numbers[..] {
            [x, y, mass] => {
                let id = (scene.blocks.len() + 1).to_string();
                scene.blocks.push(BlockEntry::new(id).centre([x * metres, y * metres]).mass(mass));
            }
            [id, x, y, mass] if is_numbered => {
                if !(id >= 1.0 && id.fract() == 0.0) {
                    let message = format!("the number {id} of its body is not a whole number from 1");
                    problems.push(problem(&row.place, message, ROW_FORM_HELP));
                }
                scene.blocks.push(BlockEntry::new(id.to_string()).centre([x * metres, y * metres]).mass(mass));
            }
            [i, j, x, y, normal, friction] => {
                let [Some(first), Some(second)] = [i, j].map(name) else {
                    let message = format!("it names the bodies {i} and {j}, but there are {}", ids.len());
                    problems.push(problem(&row.place, message, "bodies count from 1; 0 is the ground"));
                    continue;
                };
                if normal.abs() > MAX_DIRECTION {
                    let message = format!("the direction {normal} of its normal is more than a full turn");
                    problems.push(problem(&row.place, message, "give directions in radians: π/2 points up"));
                    continue;
                }
                let at = [x * metres, y * metres];
                let contact = ContactEntry::between(first, second, at, degrees(normal));
                scene.contacts.push(contact.friction(friction));
            }
            _ => {
                let message = format!("it has {} numbers", row.numbers.len());
                problems.push(problem(&row.place, message, ROW_FORM_HELP));
            }
        }
    }
    if problems.is_empty() && (scene.blocks.is_empty() || scene.contacts.is_empty()) {
        let message = "it has no body, or no contact";
        problems.push(problem("", message.into(), ROW_FORM_HELP));
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let notes = vec![
        format!("a unit of length is {metres} m, masses are in kg"),
        "normals are read in radians and point into the first body of a contact; body 0 is the ground".into(),
    ];
    Ok(Imported { scene, notes, remarks: Vec::new(), snapped: Vec::new() })
}

const ROW_FORM_HELP: &str = "a body has three numbers: x, y, mass, or its number before them; a contact has six: first body, second body, x, y, direction of the \
    normal in radians, friction";

fn problem(element: &str, message: String, help: &str) -> Remark {
    Remark { element: element.into(), message, help: help.into() }
}

/// Converts an angle from radians to degrees. An angle within 0.01° of a multiple of 15° becomes that multiple.
fn degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let near = 15.0 * (degrees / 15.0).round();
    if (degrees - near).abs() <= SNAP_DEGREES { near } else { degrees }
}

/// Reads rows of numbers, separated by commas, semicolons, tabs or spaces. With `decimal_comma`, commas are decimal
/// points. Skips comments, which begin with `#` or `%`, and headings. Returns the rows, and the problems of lines that
/// cannot be read.
fn written_rows(text: &str, decimal_comma: bool) -> (Vec<Row>, Vec<Remark>) {
    let (mut rows, mut problems) = (Vec::new(), Vec::new());
    for (number, line) in text.lines().enumerate() {
        let line = line.split(['#', '%']).next().unwrap_or("");
        let line = if decimal_comma { line.replace(',', ".") } else { line.to_owned() };
        let is_separator = |c: char| matches!(c, ',' | ';' | '[' | ']' | '"') || c.is_whitespace();
        let cells: Vec<&str> = line.split(is_separator).filter(|cell| !cell.is_empty()).collect();
        let labelled = cells.first().is_some_and(|cell| {
            let word = cell.trim_end_matches(':').to_lowercase();
            matches!(word.as_str(), "body" | "contact")
        });
        let cells = &cells[usize::from(labelled)..];
        let numbers: Vec<Option<f64>> = cells.iter().map(|cell| value(cell.trim_end_matches(':'))).collect();
        if numbers.iter().all(Option::is_none) || is_heading(&line) {
            continue;
        }
        let place = format!("line {}", number + 1);
        match numbers.into_iter().collect() {
            Some(numbers) => rows.push(Row { place, numbers }),
            None => problems.push(problem(&place, "it has words between numbers".into(), ROW_FORM_HELP)),
        }
    }
    (rows, problems)
}

/// True if a line has several columns that all begin with a word, such as `body 1; body 2; x; y`.
fn is_heading(line: &str) -> bool {
    let Some(separator) = [';', '\t', ','].into_iter().find(|s| line.contains(*s)) else {
        return false;
    };
    let columns = || line.split(separator).map(|c| c.trim().trim_matches('"')).filter(|c| !c.is_empty());
    let begins_with_word = |column: &str| {
        column.starts_with(char::is_alphabetic) && column.split_whitespace().next().is_some_and(|w| value(w).is_none())
    };
    columns().count() > 1 && columns().all(begins_with_word)
}

/// Parses a finite number, also with π: `pi`, `-pi/2`, `3*pi/2`. `None` for other text.
fn value(cell: &str) -> Option<f64> {
    let cell = cell.replace('π', "pi").to_lowercase();
    if let Ok(number) = cell.parse::<f64>() {
        return number.is_finite().then_some(number);
    }
    let (numerator, denominator) = match cell.split_once('/') {
        Some((n, d)) => (n, d.parse::<f64>().ok().filter(|d| *d != 0.0)?),
        None => (cell.as_str(), 1.0),
    };
    let factor = numerator.strip_suffix("pi")?.trim_end_matches('*');
    let factor = match factor {
        "" | "+" => 1.0,
        "-" => -1.0,
        number => number.parse::<f64>().ok()?,
    };
    let number = factor * std::f64::consts::PI / denominator;
    number.is_finite().then_some(number)
}

/// Reads the bodies and contacts of a JSON object. Each entry is a list of numbers, or an object with named numbers.
/// Returns the rows, and the problems of entries that cannot be read.
fn json_rows(text: &str) -> (Vec<Row>, Vec<Remark>) {
    let file: Value = match serde_json::from_str(text) {
        Ok(file) => file,
        Err(error) => {
            let help = "correct the JSON text";
            return (Vec::new(), vec![problem("", error.to_string(), help)]);
        }
    };
    let (mut rows, mut problems) = (Vec::new(), Vec::new());
    let body: &[&[&str]] = &[&["x", "centre.0", "center.0"], &["y", "centre.1", "center.1"], &["mass", "m"]];
    let contact: &[&[&str]] = &[
        &["i", "bodies.0"],
        &["j", "bodies.1"],
        &["x", "at.0"],
        &["y", "at.1"],
        &["normal", "theta", "angle"],
        &["friction", "mu"],
    ];
    for (list, names) in [("bodies", body), ("contacts", contact)] {
        for (i, entry) in file[list].as_array().into_iter().flatten().enumerate() {
            let place = format!("{list}[{i}]");
            let numbers: Option<Vec<f64>> = match entry.as_array() {
                Some(cells) => cells.iter().map(Value::as_f64).collect(),
                None => names.iter().map(|names| named(entry, names)).collect(),
            };
            match numbers.filter(|numbers| numbers.len() == names.len()) {
                Some(numbers) => rows.push(Row { place, numbers }),
                None => problems.push(problem(&place, "its numbers cannot be read".into(), ROW_FORM_HELP)),
            }
        }
    }
    (rows, problems)
}

/// Returns the value of the first key in `names` that has a number in the entry. The key `centre.0` means the first
/// number of the list `centre`. `None` if no key has a number.
fn named(entry: &Value, names: &[&str]) -> Option<f64> {
    names.iter().find_map(|name| match name.split_once('.') {
        Some((list, number)) => entry[list][number.parse::<usize>().ok()?].as_f64(),
        None => entry[*name].as_f64(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_json_give_the_same_contacts() {
        let rows = "x, y, mass\n25, 35, 2\n66 42 5 # the second\ncontact; 1; 2; 60; 60; pi; 0.5\n\
            1,0,0,0,pi/2,0.1\n2 0 60 0 1.5708 0.5\n[2, 0, 72, 0, 0.5*pi, 0.5]\n";
        let json = r#"{ "bodies": [[25, 35, 2], { "centre": [66, 42], "mass": 5 }],
            "contacts": [[1, 2, 60, 60, 3.14159265, 0.5], { "i": 1, "j": 0, "x": 0, "y": 0, "normal": 1.5707963, "mu": 0.1 },
                { "bodies": [2, 0], "at": [60, 0], "theta": 1.5707963, "friction": 0.5 }, [2, 0, 72, 0, 1.5707963, 0.5]] }"#;
        let options = Options::default();
        let first = read(rows, &options).expect("a contact list").scene;
        let second = read(json, &options).expect("a contact list").scene;
        assert_eq!(first, second);
        assert_eq!((first.blocks.len(), first.contacts.len()), (2, 4));
        assert_eq!(first.contacts[0].normal, 180.0);
        assert_eq!(first.contacts[1].bodies, ["1", "ground"]);
    }

    #[test]
    fn wrong_rows_are_reported_with_their_lines() {
        let text = "25 35 2\n1 2 60 60\n1 0 0 0 90 0.5\n1 7 0 0 0 0.5\n1 0 x 0 0 0.5";
        let problems = read(text, &Options::default()).expect_err("refused").problems;
        let places: Vec<&str> = problems.iter().map(|p| p.element.as_str()).collect();
        assert_eq!(places, ["line 5", "line 2", "line 3", "line 4"]);
    }

    #[test]
    fn pasted_text_and_decimal_commas_are_read() {
        // The output of a course program: its bodies begin with their number.
        let pasted = "Bodies in this case are:\nBody id, center of mass x, center of mass y, mass\n1 25 35 2\n2 66 42 5\n\
            Contacts in this case are:\nBody id1, body id2, x, y, normal, mu\n1 0 0 0 1.5707963267948966 0.4\n\
            1 2 60 60 3.141592653589793 0.5\n";
        let pasted = read(pasted, &Options::default()).expect("a contact list").scene;
        assert_eq!(pasted.blocks[1].centre, Some([66.0, 42.0]));
        assert_eq!(pasted.contacts[1].bodies, ["1", "2"]);
        // A German spreadsheet.
        let german = "x;y;Masse\n25,0;35,0;2,0\n66,0;42,0;5,0\nKörper 1;Körper 2;x;y;Normale;Reibung\n\
            1;2;60,0;60,0;3,14159265;0,5\n1;0;0,0;0,0;1,57079633;0,1\n";
        let german = read(german, &Options::default()).expect("a contact list");
        assert_eq!(german.scene.contacts[0].friction, Some(0.5));
        assert_eq!(german.scene.blocks, pasted.blocks);
        assert!(german.notes.iter().any(|n| n.contains("commas are read as decimal points")));
        // Three numbers with decimal commas, or six numbers?
        let both = "1,5 2,5 3,5\n1 0 0 0 0 0\n2,0 1,5 3,5\n1,0 1,0 0,5";
        let refused = read(both, &Options::default()).map(|i| i.scene.blocks.len());
        assert!(refused.is_err() || refused == Ok(3), "{refused:?}");
    }
}
