//! Messages about invalid numbers and colours.

use crate::mechanics::scene::format::UnitsEntry;

use super::{Code, Wording, digits, new_wording};
use crate::text::shortened;

pub(in crate::mechanics::scene) fn version(found: i64) -> Wording {
    new_wording(
        Code::UnknownVersion,
        format!("version {found} of the scene format is not known"),
        "write `\"drystone\": 1`",
    )
}

pub(in crate::mechanics::scene) fn not_finite(x: f64) -> Wording {
    new_wording(Code::NotFinite, format!("the number is {x}"), "give a finite number")
}

pub(in crate::mechanics::scene) fn absurd(x: f64, largest: f64, units: UnitsEntry) -> Wording {
    new_wording(
        Code::TooLarge,
        format!("the number {} exceeds the limit of ±{}", digits(x), digits(largest)),
        check_units(units),
    )
}

/// Returns the remedy for a number that is too large or too small: it asks the author to check the units.
fn check_units(units: UnitsEntry) -> String {
    format!(
        "check the units: {}, kilograms, {}",
        units.length.unwrap_or_default().name(),
        units.force.unwrap_or_default().name()
    )
}

pub(in crate::mechanics::scene) fn tiny(x: f64, smallest: f64, units: UnitsEntry) -> Wording {
    new_wording(
        Code::TooSmall,
        format!("the number {} is too close to 0: its size must be 0 or at least {}", digits(x), digits(smallest)),
        format!("write 0, or {}", check_units(units)),
    )
}

pub(in crate::mechanics::scene) fn tiny_extent(extent: f64, smallest: f64, units: UnitsEntry) -> Wording {
    let unit = units.length().symbol();
    new_wording(
        Code::TooSmall,
        format!("the extent is {} {unit}, which is less than the limit of {} {unit}", digits(extent), digits(smallest)),
        format!("check the units: lengths are in {}", units.length.unwrap_or_default().name()),
    )
}

pub(in crate::mechanics::scene) fn negative(what: &str, x: f64) -> Wording {
    new_wording(Code::Negative, format!("negative {what} {}", digits(x)), format!("`{what}` must be at least 0"))
}

pub(in crate::mechanics::scene) fn kernel(x: f64) -> Wording {
    new_wording(
        Code::OutOfRange,
        format!("the kernel {} is not between 0 and 1", digits(x)),
        "give the fraction of each contact that must stay free of force: 0 for none, 0.2 for a fifth",
    )
}

pub(in crate::mechanics::scene) fn side(x: f64) -> Wording {
    new_wording(
        Code::OutOfRange,
        format!("the edge length of the grid cells is {}, but it must be more than 0", digits(x)),
        "give the edge length of a cell, more than 0",
    )
}

pub(in crate::mechanics::scene) fn too_heavy(weight: f64, largest: f64) -> Wording {
    new_wording(
        Code::TooLarge,
        format!("the block's weight would be {} N, more than the limit of {} N", digits(weight), digits(largest)),
        "check the units of density, thickness, gravity and polygon",
    )
}

pub(in crate::mechanics::scene) fn colour(text: &str) -> Wording {
    new_wording(
        Code::NoColour,
        format!("\"{}\" is not a colour", shortened(text)),
        "write a colour as \"#8b6b3d\" or \"#863\"",
    )
}
