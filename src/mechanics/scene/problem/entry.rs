//! Messages about keys and entries of a scene that was built in code, or that fit the format but not each other.

use super::{Code, Wording, new_wording};
use crate::text::shortened;

/// Returns the message about a key that occurs twice in an object built in code.
pub(in crate::mechanics::scene) fn key_twice(key: &str) -> Wording {
    new_wording(Code::DuplicateKey, format!("the key `{}` occurs twice", shortened(key)), "remove one of the two keys")
}

pub(in crate::mechanics::scene) fn contact_of_one() -> Wording {
    new_wording(
        Code::UnknownChoice,
        "both bodies of the contact are the same body",
        "name two different bodies; `ground` is the ground",
    )
}
