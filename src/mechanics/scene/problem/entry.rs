//! Messages about keys and values that do not fit the format of a scene file.

use super::{Code, Wording, choice, new_wording, shortened};
use crate::text::nearest;

pub(in crate::mechanics::scene) fn wrong_type(expected: &str, found: &str) -> Wording {
    new_wording(Code::WrongType, format!("expected {expected}, found {found}"), help(expected, found))
}

pub(in crate::mechanics::scene) fn friction_word(expected: &str, found: &str) -> Wording {
    new_wording(
        Code::WrongType,
        format!("expected {expected}, found {found}"),
        "write a number such as 0.6; to name what a body is made of, use `material`, and give its friction in `materials`",
    )
}

/// Returns the remedy for a value of the wrong type. Where possible, the remedy shows the text to write in the file.
fn help(expected: &str, found: &str) -> String {
    let (is_number, is_text) = (found.starts_with("the number "), found.starts_with("the string "));
    match expected {
        "a point [x, y]" if is_number => {
            "write each point in brackets: an outline is [[x, y], [x, y], …], and `holes` is a list of outlines".into()
        }
        "a vector [x, y]" if is_number => {
            let size = found.trim_start_matches("the number ").trim_start_matches('-');
            format!("write [x, y], where y points up: {size} downwards is [0, -{size}]; gravity already acts on every block")
        }
        "a number" if is_text => "write a number without a unit; the units are metres, newtons, kilograms and degrees, unless the file gives other `units`".into(),
        // Only the version of the format is read as a whole number.
        "a whole number" => "write 1, the version of the scene format".into(),
        "a string" if is_number => {
            format!("write \"{}\", in quotes", found.trim_start_matches("the number "))
        }
        "a list" if found == "an object" => "write a list in brackets: [{…}]".into(),
        _ => format!("write {expected} here"),
    }
}

pub(in crate::mechanics::scene) fn quoted_number(expected: &str, found: &str) -> Wording {
    new_wording(
        Code::WrongType,
        format!("expected {expected}, found the string \"{found}\""),
        format!("write {found} without quotes"),
    )
}

pub(in crate::mechanics::scene) fn coordinates(found: usize) -> Wording {
    let help = match found {
        3.. => "write [x, y]; a scene has only two dimensions: x points to the right, and y points up",
        _ => "write [x, y]",
    };
    new_wording(Code::WrongLength, format!("a point has two coordinates; this one has {}", count(found)), help)
}

pub(in crate::mechanics::scene) fn components(found: usize) -> Wording {
    let help = match found {
        3.. => "write [x, y]; a scene has only two dimensions: x points to the right, and y points up",
        _ => "write [x, y]",
    };
    new_wording(Code::WrongLength, format!("a vector has two components; this one has {}", count(found)), help)
}

/// Returns a count as text: a small count as a word, a larger count in digits.
fn count(n: usize) -> String {
    match n {
        0 => "none".into(),
        1 => "one".into(),
        3 => "three".into(),
        4 => "four".into(),
        _ => n.to_string(),
    }
}

pub(in crate::mechanics::scene) fn unknown_choice(text: &str, known: &[String]) -> Wording {
    let names = choice(known.iter().map(|n| format!("\"{n}\"")));
    let help = match nearest(text, known.iter().map(String::as_str)) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("write {names}"),
    };
    new_wording(Code::UnknownChoice, format!("expected {names}, found \"{}\"", shortened(text)), help)
}

pub(in crate::mechanics::scene) fn unknown_key<'k>(key: &str, known: impl Iterator<Item = &'k str> + Clone) -> Wording {
    let meant = synonym(key).filter(|meant| known.clone().any(|k| k == *meant));
    let is_cohesive = ["cohesion", "adhesion", "mortar", "tensile_strength"].contains(&key);
    let help = match meant.or_else(|| nearest(key, known.clone())) {
        _ if is_cohesive => {
            "joints are dry: they transmit pressure and friction, but no tension; remove the key".into()
        }
        Some(near) if meant.is_some() => format!("the key is called `{near}` here"),
        Some(near) => format!("the nearest known key is `{near}`"),
        None => format!("known keys are {}", known.collect::<Vec<_>>().join(", ")),
    };
    new_wording(Code::UnknownKey, format!("unknown key `{}`", shortened(key)), help)
}

/// Returns the key of the scene format that means the same as `key`, a word that other programs use. `None` if no such
/// key is known.
fn synonym(key: &str) -> Option<&'static str> {
    Some(match key.to_lowercase().as_str() {
        "mu" | "μ" | "friction_coefficient" => "friction",
        "floor" | "base" | "foundation" | "supports" => "ground",
        "bodies" | "bricks" | "stones" | "elements" | "voussoirs" => "blocks",
        "name" | "label" => "id",
        "vertices" | "points" | "corners" | "coordinates" | "outline" => "polygon",
        "color" | "colour" => "fill",
        "rotation" | "rotate" | "theta" => "angle",
        "position" | "pos" | "origin" | "offset" => "at",
        "version" => "drystone",
        "lattice" => "grid",
        "forces" => "loads",
        "torque_limit" | "moment" => "torque",
        "tolerance" => "contact_tolerance",
        _ => return None,
    })
}

pub(in crate::mechanics::scene) fn duplicate_key(key: &str, line: usize, column: usize) -> Wording {
    new_wording(
        Code::DuplicateKey,
        format!("the key `{}` occurs twice; first in line {line}, column {column}", shortened(key)),
        "remove one of the two keys",
    )
}

/// Returns the message about a key that occurs twice in an object built in code.
pub(in crate::mechanics::scene) fn key_twice(key: &str) -> Wording {
    new_wording(Code::DuplicateKey, format!("the key `{}` occurs twice", shortened(key)), "remove one of the two keys")
}

pub(in crate::mechanics::scene) fn missing_key(key: &str) -> Wording {
    let help = match key {
        "drystone" => "add `\"drystone\": 1`, the version of the scene format".into(),
        "blocks" => "add `\"blocks\": […]`, the list of blocks; it may be empty".into(),
        _ => format!("add `\"{key}\"`"),
    };
    new_wording(Code::MissingKey, format!("the key `{key}` is missing"), help)
}

pub(in crate::mechanics::scene) fn contact_of_one() -> Wording {
    new_wording(
        Code::UnknownChoice,
        "both bodies of the contact are the same body",
        "name two different bodies; `ground` is the ground",
    )
}
