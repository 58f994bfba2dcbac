//! Messages of notes, which point out input that is allowed but probably not intended.

use super::{Code, Wording, digits, new_wording, pair};
use crate::text::shortened;

/// Creates the wording of a note. A wording needs a problem code, but this code is never shown, because notes have
/// codes of their own.
fn note(message: String, hint: impl Into<String>) -> Wording {
    new_wording(Code::OutOfRange, message, hint)
}

pub(in crate::mechanics::scene) fn friction_high(mu: f64) -> Wording {
    note(
        format!("a friction coefficient of {} is probably a mistake", digits(mu)),
        "dry stone has 0.5 to 0.8; a coefficient is the tangent of the angle of friction, not degrees or percent",
    )
}

pub(in crate::mechanics::scene) fn grip_outside(block: &str, at: [f64; 2], distance: f64, unit: &str) -> Wording {
    note(
        format!(
            "the grip point {} lies {} {unit} outside the block `{}`",
            pair(at),
            digits(distance),
            shortened(block)
        ),
        "give a point inside the block, or leave out `at` to use the centroid of the block",
    )
}

pub(in crate::mechanics::scene) fn load_outside(block: &str, at: [f64; 2], distance: f64, unit: &str) -> Wording {
    note(
        format!("the load acts at {}, {} {unit} outside the block `{}`", pair(at), digits(distance), shortened(block)),
        "give a point inside the block, or leave out `at` to use the centroid of the block",
    )
}

pub(in crate::mechanics::scene) fn unused_robot(robot: &str, no_steps: bool) -> Wording {
    let hint = if no_steps {
        "give the robot a block that it `holds`, or remove the robot"
    } else {
        "let the robot `hold` a block in a step, or remove the robot; in a scene with `steps`, `holds` is ignored"
    };
    note(format!("the robot `{}` never holds a block", shortened(robot)), hint)
}

pub(in crate::mechanics::scene) fn unused_block(block: &str) -> Wording {
    note(
        format!("no step places the block `{}`", shortened(block)),
        "add the block to `place` of a step, or remove the block",
    )
}

pub(in crate::mechanics::scene) fn default_density(blocks: usize, beside: Option<&str>, force: &str) -> Wording {
    let weight = match blocks {
        1 => "the weight of 1 block comes".to_owned(),
        _ => format!("the weights of {blocks} blocks come"),
    };
    let beside = beside.map_or(String::new(), |beside| format!(", but the {beside} are in {force}"));
    note(
        format!("{weight} from the default density of 1 kg/m³{beside}"),
        format!("give `density` in kg/m³ (stone has about 2500), or `weight` in {force}"),
    )
}

pub(in crate::mechanics::scene) fn no_ground() -> Wording {
    note(
        "the scene has no ground, so only robots can support the blocks".into(),
        "add at least one polygon to `ground`",
    )
}

pub(in crate::mechanics::scene) fn angle_radians(angle: f64, degrees: f64) -> Wording {
    note(
        format!("the angle {} looks like {}° written in radians", digits(angle), digits(degrees)),
        format!("angles are in degrees: give {}", digits(degrees)),
    )
}
