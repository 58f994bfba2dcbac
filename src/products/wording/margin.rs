//! Describes margins.

use super::number::digits;
use crate::analysis::{Margin, Margins, Sides};
use crate::scene::Scene;

/// The value of a margin with its unit. `none` is the text for a structure that falls at any value.
pub fn value(margin: &Margin, unit: &str, none: &str) -> String {
    match margin {
        Margin::Value { at, .. } => format!("{}{unit}", digits(*at)),
        Margin::None => none.into(),
        Margin::Unbounded => "any".into(),
        Margin::Unconfirmed { stands, .. } => {
            format!("not confirmed (it stands at {}{unit})", digits(*stands))
        }
        Margin::NotAsked => "not requested".into(),
        Margin::NotApplicable => "none (there are no loads)".into(),
    }
}

/// The text for a frame that falls at any value.
pub const NONE: &str = "none (it falls at any)";
/// The text for a frame that falls even without a tilt.
pub const UNTURNED: &str = "none (it falls unturned)";

/// One line for each margin that was computed.
pub fn lines(scene: &Scene, margins: &Margins) -> Vec<String> {
    let edge = |margin: &Margin, unit: &str| value(margin, unit, NONE);
    let one = |name: &str, margin: &Margin| {
        let shown = !matches!(margin, Margin::NotAsked | Margin::NotApplicable);
        shown.then(|| format!("{name}: {}", edge(margin, "")))
    };
    let two = |name: &str, sides: &Sides, unit: &str, none: &str| {
        let (left, right) = (
            value(&sides.left, unit, none),
            value(&sides.right, unit, none),
        );
        let asked = sides.left != Margin::NotAsked;
        asked.then(|| format!("{name}: left {left}, right {right}"))
    };
    let share = "largest horizontal share of the weights";
    let lines = [
        one("least friction", &margins.friction),
        two("largest tilt", &margins.tilt, "°", UNTURNED),
        two(share, &margins.horizontal_load, "", NONE),
        one("largest kernel", &margins.kernel),
        one("largest factor on the loads", &margins.load_factor),
    ];
    let mut lines: Vec<String> = lines.into_iter().flatten().collect();
    lines.extend(margins.robots.iter().map(|robot| {
        format!(
            "least limits of robot {}, each alone: fx {}, fy {}, torque {}",
            scene.robots[robot.robot.0].id,
            edge(&robot.fx, " N"),
            edge(&robot.fy, " N"),
            edge(&robot.torque, " N·m")
        )
    }));
    lines
}
