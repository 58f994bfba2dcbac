//! Margins in words.

use super::number::digits;
use crate::analysis::{Margin, Margins, Sides};
use crate::scene::Scene;

/// A margin's value with its unit, or what stands in its place.
pub fn value(margin: &Margin, unit: &str, none: &str) -> String {
    match margin {
        Margin::Value { at, .. } => format!("{}{unit}", digits(*at)),
        Margin::None => none.into(),
        Margin::Unbounded => "any".into(),
    }
}

/// What is said where a frame falls at any value.
pub const NONE: &str = "none (it falls at any)";
/// What is said where a frame falls as it is.
pub const UNTURNED: &str = "none (it falls unturned)";

/// How far a frame is from the edge, a line per margin.
pub fn lines(scene: &Scene, margins: &Margins) -> Vec<String> {
    let edge = |margin: &Margin, unit: &str| value(margin, unit, NONE);
    let sides = |sides: &Sides, unit: &str, none: &str| {
        let (left, right) = (
            value(&sides.left, unit, none),
            value(&sides.right, unit, none),
        );
        format!("left {left}, right {right}")
    };
    let mut lines = vec![
        format!("least friction: {}", edge(&margins.friction, "")),
        format!("largest tilt: {}", sides(&margins.tilt, "°", UNTURNED)),
        format!(
            "largest horizontal share of the weights: {}",
            sides(&margins.horizontal_load, "", NONE)
        ),
        format!("largest kernel: {}", edge(&margins.kernel, "")),
        format!(
            "largest factor on the loads: {}",
            edge(&margins.load_factor, "")
        ),
    ];
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
