//! Scenes of a few blocks: a column, a frame, a ladder, a slope, toppling rock columns, and wedged bars.

use serde_json::{Value, json};

use super::measure::{frame, friction, horizontal, only_by_wedging, tilt};
use crate::structure::{on_floor, on_slope, rectangle};
use crate::wedging::bar_between_walls;

/// A column 1 m wide and 4 m high.
pub fn column() -> Value {
    let polygon = rectangle(0.0, 0.0, 1.0, 4.0);
    let mut file = on_floor(0.7, vec![json!({ "id": "column", "polygon": polygon })]);
    file["ground"][0]["polygon"] = rectangle(-1.5, -0.5, 4.0, 0.5);
    file
}

pub fn column_pushed() -> f64 {
    horizontal(&column())
}

pub fn column_tilted() -> f64 {
    tilt(&column())
}

/// Two columns 0.4 m wide and 2 m high, which carry a beam.
pub fn frame_of_columns() -> Value {
    let mut file = on_floor(
        0.7,
        vec![
            json!({ "id": "left", "polygon": rectangle(0.0, 0.0, 0.4, 2.0) }),
            json!({ "id": "right", "polygon": rectangle(3.0, 0.0, 0.4, 2.0) }),
            json!({ "id": "beam", "polygon": rectangle(-0.2, 2.0, 3.8, 0.5) }),
        ],
    );
    file["ground"][0]["polygon"] = rectangle(-0.8, -0.3, 5.0, 0.3);
    file
}

pub fn frame_pushed() -> f64 {
    horizontal(&frame_of_columns())
}

/// A uniform ladder of 3 m and 20 kg. Its foot is 1 m from a wall without friction. It is a rhombus, so both ends are
/// tips.
pub fn ladder() -> Value {
    let top = [1.0, libm::sqrt(8.0)];
    let middle = [0.5, top[1] / 2.0];
    let across = [-0.02 * top[1], 0.02 * top[0]];
    let side = |sign: f64| [middle[0] + sign * across[0], middle[1] + sign * across[1]];
    json!({ "drystone": 1, "friction": 0.8, "corner_contacts": true, "gravity": [0, -9.8],
        "ground": [{ "polygon": rectangle(-0.6, -0.3, 1.6, 0.3) }, { "polygon": rectangle(1.0, -0.3, 0.3, 3.6), "friction": 0 }],
        "blocks": [{ "id": "ladder", "mass": 20, "polygon": [[0, 0], side(-1.0), top, side(1.0)] }] })
}

/// The force of the wall, newtons.
pub fn ladder_on_its_wall() -> f64 {
    let frame = frame(&ladder());
    let wall = frame.contacts.iter().find(|c| c.resultant.at.y > 1.0);
    wall.expect("the ladder touches the wall").resultant.force.norm()
}

/// tan 31° divided by the least friction on a plane of 34°.
pub fn plane_safety() -> f64 {
    let file = on_slope(34.0, 4.0, 1.0, 0.9, 0.0);
    libm::tan(31f64.to_radians()) / friction(&file)
}

/// The slope of Goodman and Bray: 16 columns, each 10 m wide, on steps that rise at 30° and are 1 m high. A
/// horizontal force of `newtons` supports the lowest column.
pub fn toppling(newtons: f64) -> Value {
    let (sin, cos) = libm::sincos(30f64.to_radians());
    let rotated = |along: f64, up: f64| [along * cos - up * sin, along * sin + up * cos];
    let (mut steps, mut blocks) = (Vec::new(), Vec::new());
    for k in 0..16 {
        let (left, right, foot) = (10.0 * k as f64, 10.0 * (k + 1) as f64, k as f64);
        let height = if k < 10 { 4.0 * (k + 1) as f64 } else { 40.0 - 6.2 * (k - 9) as f64 };
        let head = foot + height;
        let corners = [rotated(left, foot), rotated(right, foot), rotated(right, head), rotated(left, head)];
        blocks.push(json!({ "id": format!("{}", k + 1), "polygon": corners }));
        steps.extend([corners[0], corners[1]]);
    }
    steps.extend([rotated(160.0, -20.0), rotated(0.0, -20.0)]);
    let mut file = json!({ "drystone": 1, "friction": 0.9, "density": 2500, "gravity": [0, -10],
        "ground": [{ "polygon": steps }], "blocks": blocks });
    if newtons > 0.0 {
        file["loads"] = json!([{ "block": "1", "force": [newtons, 0], "at": rotated(0.0, 4.0) }]);
    }
    file
}

pub fn toppling_alone() -> f64 {
    friction(&toppling(500.0))
}

pub fn toppling_supported() -> f64 {
    friction(&toppling(2.013e6))
}

/// tan 38.15° divided by the least friction.
pub fn toppling_safety() -> f64 {
    libm::tan(38.15f64.to_radians()) / toppling_alone()
}

pub fn h_model_wedges() -> f64 {
    only_by_wedging(&bar_between_walls(0.0, 0.84))
}

pub fn a_model_wedges() -> f64 {
    only_by_wedging(&bar_between_walls(0.2, 0.84))
}
