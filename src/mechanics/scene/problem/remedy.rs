//! The remedies of the reader's mistakes that need knowledge of the scene format.

use crate::read::{Cause, Dialect, Expected, NodeKind};

/// The dialect of scene files.
pub(in crate::mechanics::scene) const SCENE: Dialect = Dialect { noun: "scene", remedy, lines_before: 0 };

fn remedy(cause: Cause<'_>) -> Option<String> {
    let words = match cause {
        Cause::WrongType { at, expected, found, written } => match (expected, found) {
            (Expected::Point, NodeKind::Number(_)) => {
                "write each point in brackets: an outline is [[x, y], [x, y], …], and `holes` is a list of outlines"
            }
            (Expected::Vector, NodeKind::Number(_)) => {
                let size = written.trim_start_matches('-');
                return Some(format!(
                    "write [x, y], where y points up: {size} downwards is [0, -{size}]; gravity already acts on every block"
                ));
            }
            (Expected::Number, NodeKind::Text(text)) if at.ends_in("friction") && !text.contains(',') => {
                "write a number such as 0.6; to name what a body is made of, use `material`, and give its friction in `materials`"
            }
            (Expected::Number, NodeKind::Text(text)) if !text.contains(',') => {
                "write a number without a unit; the units are metres, newtons, kilograms and degrees, unless the file gives other `units`"
            }
            (Expected::Object, NodeKind::Text(unit)) if at.ends_in("units") => {
                let key = if matches!(unit.as_ref(), "N" | "kN" | "MN" | "lbf") { "force" } else { "length" };
                return Some(format!("write \"units\": {{ \"{key}\": {written} }}"));
            }
            // Only the version of the format is read as a whole number.
            (Expected::Whole, _) => "write 1, the version of the scene format",
            _ => return None,
        },
        Cause::UnknownKey("cohesion" | "adhesion" | "mortar" | "tensile_strength", _) => {
            "joints are dry: they transmit pressure and friction, but no tension; remove the key"
        }
        Cause::UnknownKey(key, known) => {
            let meant = synonym(key).filter(|meant| known.contains(meant))?;
            return Some(format!("the key is called `{meant}` here"));
        }
        Cause::MissingKey("drystone") => "add `\"drystone\": 1`, the version of the scene format",
        Cause::MissingKey("blocks") => "add `\"blocks\": […]`, the list of blocks; it may be empty",
        Cause::MissingKey(_) | Cause::NotToml => return None,
        Cause::Empty => "start from the scene that `drystone new` writes",
        Cause::OtherFormat("XML") => "a scene is written as JSON; `drystone import` converts a drawing to a scene",
        Cause::OtherFormat(_) => {
            "a scene is written as JSON, which begins with `{`; `drystone new` writes a scene to start from"
        }
        Cause::TooDeep => "a scene needs no more than seven levels of brackets",
        Cause::Comment => "remove the comment; the key `title` can hold a text for people",
        Cause::NotANumber => "give a finite number; if a robot has no limit, leave the limit out",
    };
    Some(words.into())
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
