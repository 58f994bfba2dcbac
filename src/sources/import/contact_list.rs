//! Reads a contact list: bodies with centre and mass, and the points at which they touch.
//!
//! A body has x, y and mass, and perhaps a number or name; otherwise, bodies count from 1. A contact has its two bodies (0
//! is the ground), x, y, the direction of the normal into the first body in radians, and the friction coefficient.

use std::collections::BTreeSet;

use super::table::{Column, Entries, Entry, FORM, entries, value};
use super::{DrawingProblems, Imported, Options};
use crate::mechanics::scene::format::{BlockEntry, ContactEntry};

/// Directions with a magnitude above this, in radians, are refused, because they are most likely degrees.
pub(super) const MAX_DIRECTION: f64 = 7.0;
/// A direction within this many degrees of a multiple of 15° is replaced by that multiple: π is often written as
/// 3.1416.
const SNAP_DEGREES: f64 = 0.01;

/// Reads a contact list from one file or several. Notes state the units and the directions of the normals.
///
/// A comma is a separator or a decimal comma. If only one of the two readings gives a contact list, it is taken.
///
/// # Errors
/// Returns a problem for each row that is neither a body nor a contact, each contact with a body that does not exist,
/// and each contact whose normal has a direction beyond ±7 rad (about a full turn). If there are no such rows, returns
/// one problem if there is no body or no contact, or if both readings of the commas give a contact list.
pub(super) fn read(files: &[(&str, &str)], options: &Options) -> Result<Imported, DrawingProblems> {
    if !(options.ground.is_empty() && options.ignore.is_empty()) {
        return Err(DrawingProblems::new("a contact list has no outlines to choose; its body 0 is the ground"));
    }
    match (list(entries(files, false), options), list(entries(files, true), options)) {
        (Ok(plain), Ok(decimal)) if plain.scene != decimal.scene => {
            let mut both = Entries::default();
            let message = "its commas can be read as separators and as decimal points";
            both.problem("", message, "write decimal points, or put only semicolons between the numbers");
            Err(DrawingProblems::of(both.problems))
        }
        (Err(_), Ok(mut decimal)) => {
            decimal.notes.push("commas are read as decimal points".into());
            Ok(decimal)
        }
        (plain, _) => plain,
    }
}

/// Makes a scene from the entries of a list.
fn list(mut entries: Entries, options: &Options) -> Result<Imported, DrawingProblems> {
    let metres = options.scale.unwrap_or(1.0) * options.ratio.unwrap_or(1.0);
    let all = std::mem::take(&mut entries.all);
    let is_contact = |entry: &&Entry| entry.has(&[Column::First, Column::Second]);
    let (contacts, bodies): (Vec<&Entry>, Vec<&Entry>) = all.iter().partition(is_contact);
    let (mut scene, mut known) = (options.scene.clone(), BTreeSet::new());
    for body in bodies {
        let numbers = [Column::X, Column::Y, Column::Mass].map(|column| body.number(column));
        let [Some(x), Some(y), Some(mass)] = numbers else {
            let given = numbers.iter().flatten().count();
            entries.problem(&body.place, format!("it has {given} of the numbers x, y and mass of a body"), FORM);
            continue;
        };
        let id = body.cells.get(&Column::Name).map_or((known.len() + 1).to_string(), |name| id(name));
        if id.parse::<f64>().is_ok_and(|id| !(id >= 1.0 && id.fract() == 0.0)) {
            entries.problem(&body.place, format!("the number {id} of its body is not a whole number from 1"), FORM);
        }
        if !known.insert(id.clone()) {
            entries.problem(&body.place, format!("there are two bodies {id}"), "give each body its own number");
        }
        scene.blocks.push(BlockEntry::new(id).centre([x * metres, y * metres]).mass(mass));
    }
    for contact in contacts {
        let numbers = [Column::X, Column::Y, Column::Angle].map(|column| contact.number(column));
        let friction = contact.cells.get(&Column::Friction);
        let ([Some(x), Some(y), Some(normal)], true) = (numbers, friction.is_none_or(|f| value(f).is_some())) else {
            entries.problem(&contact.place, "its numbers cannot be read", FORM);
            continue;
        };
        let [first, second] =
            [Column::First, Column::Second].map(|column| match id(&contact.cells[&column]).as_str() {
                "0" => "ground".to_owned(),
                name => name.to_owned(),
            });
        if [&first, &second].into_iter().any(|name| name != "ground" && !known.contains(name)) {
            let message = match known.len() {
                0 => "there are no bodies for its contacts".to_owned(),
                count => format!("it names the bodies {first} and {second}, but there are {count}"),
            };
            let help = "bodies count from 1; 0 is the ground; bodies and contacts in two files are read together: \
                drystone import bodies.csv contacts.csv";
            entries.problem(&contact.place, message, help);
            continue;
        }
        if normal.abs() > MAX_DIRECTION {
            let message = format!("the direction {normal} of its normal is more than a full turn");
            entries.problem(&contact.place, message, "give directions in radians: π/2 points up");
            continue;
        }
        let entry = ContactEntry::between(first, second, [x * metres, y * metres], degrees(normal));
        scene.contacts.push(match contact.number(Column::Friction) {
            Some(friction) => entry.friction(friction),
            None => entry,
        });
    }
    if entries.problems.is_empty() && (scene.blocks.is_empty() || scene.contacts.is_empty()) {
        let (message, help) = match (scene.blocks.is_empty(), scene.contacts.is_empty()) {
            (false, true) => {
                ("it has no contact", "if another file has the contacts: drystone import bodies.csv contacts.csv")
            }
            _ => ("it has no body, or no contact", FORM),
        };
        entries.problem("", message, help);
    }
    if !entries.problems.is_empty() {
        return Err(DrawingProblems::of(entries.problems));
    }
    let mut notes = vec![
        format!("a unit of length is {metres} m, masses are in kg"),
        "normals are read in radians and point into the first body of a contact; body 0 is the ground".into(),
    ];
    notes.append(&mut entries.notes);
    Ok(Imported { scene, notes, ..Imported::default() })
}

/// Returns the name of a body; numbers are written alike, so that 1.0 is 1.
fn id(name: &str) -> String {
    value(name).map_or_else(|| name.trim().to_owned(), |number| number.to_string())
}

/// Converts an angle from radians to degrees. An angle within 0.01° of a multiple of 15° becomes that multiple.
fn degrees(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let near = 15.0 * (degrees / 15.0).round();
    if (degrees - near).abs() <= SNAP_DEGREES { near } else { degrees }
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
        let first = read(&[("", rows)], &options).expect("a contact list").scene;
        let second = read(&[("", json)], &options).expect("a contact list").scene;
        assert_eq!(first, second);
        assert_eq!((first.blocks.len(), first.contacts.len()), (2, 4));
        assert_eq!(first.contacts[0].normal, 180.0);
        assert_eq!(first.contacts[1].bodies, ["1", "ground"]);
    }

    #[test]
    fn wrong_rows_are_reported_with_their_lines() {
        let text = "25 35 2\n1 2 60 60\n1 0 0 0 90 0.5\n1 7 0 0 0 0.5\n1 0 x 0 0 0.5";
        let problems = read(&[("", text)], &Options::default()).expect_err("refused").problems;
        let places: Vec<&str> = problems.iter().map(|p| p.element.as_str()).collect();
        assert_eq!(places, ["line 5", "line 2", "line 3", "line 4"]);
    }

    #[test]
    fn pasted_text_and_decimal_commas_are_read() {
        // The output of a course program: its bodies begin with their number.
        let pasted = "Bodies in this case are:\nBody id, center of mass x, center of mass y, mass\n1 25 35 2\n2 66 42 5\n\
            Contacts in this case are:\nBody id1, body id2, x, y, normal, mu\n1 0 0 0 1.5707963267948966 0.4\n\
            1 2 60 60 3.141592653589793 0.5\n";
        let pasted = read(&[("", pasted)], &Options::default()).expect("a contact list").scene;
        assert_eq!(pasted.blocks[1].centre, Some([66.0, 42.0]));
        assert_eq!(pasted.contacts[1].bodies, ["1", "2"]);
        // A German spreadsheet.
        let german = "x;y;Masse\n25,0;35,0;2,0\n66,0;42,0;5,0\nKörper 1;Körper 2;x;y;Normale;Reibung\n\
            1;2;60,0;60,0;3,14159265;0,5\n1;0;0,0;0,0;1,57079633;0,1\n";
        let german = read(&[("", german)], &Options::default()).expect("a contact list");
        assert_eq!(german.scene.contacts[0].friction, Some(0.5));
        assert_eq!(german.scene.blocks, pasted.blocks);
        assert!(german.notes.iter().any(|n| n.contains("commas are read as decimal points")));
        // Three numbers with decimal commas, or six numbers?
        let both = "1,5 2,5 3,5\n1 0 0 0 0 0\n2,0 1,5 3,5\n1,0 1,0 0,5";
        let refused = read(&[("", both)], &Options::default()).map(|i| i.scene.blocks.len());
        assert!(refused.is_err() || refused == Ok(3), "{refused:?}");
    }
}
