//! Messages about names and ids that are unknown, reserved, empty or used twice.

use super::{Code, Wording, new_wording};
use crate::text::nearest;
use crate::text::shortened;

pub(in crate::mechanics::scene) fn unknown_name(sort: &str, name: &str, known: &[&str]) -> Wording {
    let help = match nearest(name, known.iter().copied()) {
        Some(near) => format!("the nearest known {sort} is `{near}`"),
        None if known.is_empty() => format!("the scene has no {sort}s"),
        None if known.len() <= 12 => {
            format!("known {sort}s are {}", known.iter().map(|n| shortened(n)).collect::<Vec<_>>().join(", "))
        }
        None => format!("the scene has {} {sort}s, but none with a similar name", known.len()),
    };
    new_wording(Code::UnknownName, format!("unknown {sort} `{}`", shortened(name)), help)
}

pub(in crate::mechanics::scene) fn another_unknown_name(sort: &str, name: &str) -> Wording {
    new_wording(
        Code::UnknownName,
        format!("unknown {sort} `{}`", shortened(name)),
        "the first problem of this kind lists the known names or the nearest one",
    )
}

pub(in crate::mechanics::scene) fn id_twice(sort: &str, id: &str, first: &str) -> Wording {
    new_wording(
        Code::DuplicateId,
        format!("the {sort} id `{}` is used twice; first by {first}", shortened(id)),
        format!("give each {sort} a different id"),
    )
}

pub(in crate::mechanics::scene) fn reserved_id() -> Wording {
    new_wording(
        Code::ReservedName,
        "the id `ground` is reserved for the ground in results",
        "give the block another id",
    )
}

pub(in crate::mechanics::scene) fn empty_id(sort: &str) -> Wording {
    new_wording(Code::EmptyId, format!("the {sort}'s id is empty"), "write an id of at least one character")
}

pub(in crate::mechanics::scene) fn built_in_shape(name: &str) -> Wording {
    new_wording(Code::ReservedName, format!("`{name}` is the name of a built-in shape"), "give the shape another name")
}

pub(in crate::mechanics::scene) fn pair_twice(names: &[String; 2], first: usize) -> Wording {
    new_wording(
        Code::DuplicatePair,
        format!(
            "the pair {}, {} is listed twice; first in friction_pairs[{first}]",
            shortened(&names[0]),
            shortened(&names[1])
        ),
        "remove one of the two entries; the order of the names does not matter",
    )
}
