//! Scene files that several tests share.

use std::sync::Arc;

use drystone::analysis::{FrameAnalysis, Verdict};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

/// The scene of a scene file. Panics if the file is invalid.
pub fn scene(file: &Value) -> Scene {
    Scene::from_json(&file.to_string()).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The analysis of the first frame of a scene file. Panics if the frame has a verdict but not its proof.
pub fn first(file: &Value) -> Arc<FrameAnalysis> {
    let scene = scene(file);
    let frame = Analysis::new(&scene).frames.remove(0);
    assert!(frame.proof.holds() || frame.verdict == Verdict::Undecided, "{:?}", frame.proof);
    frame
}

/// The verdict of the first frame.
pub fn verdict(file: &Value) -> Verdict {
    first(file).verdict
}

/// A lintel on two posts. It stands.
pub const LINTEL: &str = r#"{ "drystone": 1, "title": "A lintel", "friction": 0.6,
  "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
  "blocks": [
    { "id": "left",   "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]], "weight": 6 },
    { "id": "right",  "polygon": [[5, 0], [6, 0], [6, 3], [5, 3]], "weight": 7 },
    { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]], "weight": 11 } ] }"#;

/// A lintel on one post. It falls in the first frame; in the second, a robot holds its free end.
pub const HALF_LINTEL: &str = r#"{ "drystone": 1, "title": "Half a lintel", "friction": 0.6,
  "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
  "blocks": [
    { "id": "left",   "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]], "weight": 6 },
    { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]], "weight": 11 } ],
  "robots": [{ "id": "crane" }],
  "steps": [ { "title": "Alone", "place": ["left", "lintel"] },
             { "title": "Held", "hold": { "crane": { "block": "lintel", "at": [5, 3.5] } } } ] }"#;

/// Corners of an axis-parallel rectangle.
pub fn corners(x: f64, y: f64, width: f64, height: f64) -> Vec<[f64; 2]> {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}

/// Corners of an axis-parallel rectangle, as JSON.
pub fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Value {
    json!(corners(x, y, width, height))
}

/// The same file with gravity rotated to the right.
pub fn tilted(mut file: Value, degrees: f64) -> Value {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    file["gravity"] = json!([9.81 * sin, -9.81 * cos]);
    file
}

/// The same file with gravity and all polygons rotated about the origin. An angle of 0° does not change the file.
pub fn rotated(file: &Value, degrees: f64) -> Value {
    if degrees == 0.0 {
        return file.clone();
    }
    let (s, c) = libm::sincos(degrees.to_radians());
    let mut file = file.clone();
    for list in ["ground", "blocks"] {
        for body in file[list].as_array_mut().expect("a list") {
            for corner in body["polygon"].as_array_mut().expect("corners") {
                let [x, y] = [0, 1].map(|k| corner[k].as_f64().expect("a number"));
                *corner = json!([c * x - s * y, s * x + c * y]);
            }
        }
    }
    tilted(file, degrees)
}

/// A tower of n blocks, 1 m wide.
pub fn tower(n: usize, height: f64) -> Value {
    let brick = |k: usize| {
        let at = rectangle(0.0, k as f64 * height, 1.0, height);
        block(&format!("{k}"), at, 6.0)
    };
    on_floor(0.5, (0..n).map(brick).collect())
}

/// A block with its weight in newtons.
pub fn block(id: &str, polygon: Value, weight: f64) -> Value {
    json!({ "id": id, "polygon": polygon, "weight": weight })
}

/// Blocks on a floor from x = −100 to x = 100, whose upper edge is at y = 0.
pub fn on_floor(friction: f64, blocks: Vec<Value>) -> Value {
    json!({ "drystone": 1, "friction": friction, "ground": [{ "polygon": rectangle(-100.0, -1.0, 200.0, 1.0) }],
        "blocks": blocks })
}

/// A block of this width and height on a slope of `degrees`, which rises to the right.
pub fn on_slope(degrees: f64, width: f64, height: f64, friction: f64, kernel: f64) -> Value {
    json!({ "drystone": 1, "friction": friction, "kernel": kernel,
        "shapes": { "slope": { "polygon": rectangle(-10.0, -1.0, 20.0, 1.0) },
                    "block": { "polygon": rectangle(-0.3 * width, 0.0, width, height) } },
        "ground": [{ "shape": "slope", "angle": degrees }],
        "blocks": [{ "id": "a", "shape": "block", "angle": degrees, "weight": 5.0 }] })
}

/// n equal bricks of length 1, one on another. Each overhangs the brick below by `share` times as much as in the
/// harmonic stack.
pub fn harmonic(n: usize, share: f64) -> Value {
    let mut left = vec![0.0; n];
    // Brick k, counted from 1 at the top, overhangs the brick below by share/(2k). The lowest brick overhangs the
    // ground.
    let mut x = 0.0;
    for k in (1..=n).rev() {
        x += share / (2.0 * k as f64);
        left[k - 1] = x - 1.0;
    }
    let blocks = (1..=n)
        .map(|k| block(&format!("{k}"), rectangle(left[k - 1], (n - k) as f64 * 0.2, 1.0, 0.2), 2.0))
        .collect::<Vec<_>>();
    json!({ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": rectangle(-5.0, -1.0, 5.0, 1.0) }], "blocks": blocks })
}

/// A semicircular arch of n voussoirs with radial joints. The radius of its centreline is 1.
pub fn arch(n: usize, thickness: f64, friction: f64) -> Value {
    let (inner, outer) = (1.0 - thickness / 2.0, 1.0 + thickness / 2.0);
    let at = |radius: f64, k: usize| {
        let angle = std::f64::consts::PI * k as f64 / n as f64;
        let (sin, cos) = if 2 * k == n { (1.0, 0.0) } else { (libm::sin(angle), libm::cos(angle)) };
        json!([-radius * cos, if k == n { 0.0 } else { radius * sin }])
    };
    let blocks = (0..n)
        .map(|k| {
            let polygon = json!([at(inner, k), at(inner, k + 1), at(outer, k + 1), at(outer, k)]);
            json!({ "id": format!("v{k}"), "polygon": polygon, "density": 1000 })
        })
        .collect::<Vec<_>>();
    json!({ "drystone": 1, "friction": friction,
        "ground": [{ "polygon": rectangle(-2.0, -1.0, 4.0, 1.0) }], "blocks": blocks })
}

/// A wall of bricks in running bond, `columns` bricks wide and `rows` high, with half bricks at the ends of every
/// second row.
pub fn wall(columns: usize, rows: usize) -> Value {
    let mut blocks = Vec::new();
    for row in 0..rows {
        let y = row as f64 * 0.5;
        let mut edges: Vec<f64> = (0..=columns).map(|c| c as f64).collect();
        if row % 2 == 1 {
            edges = std::iter::once(0.0)
                .chain((0..columns).map(|c| c as f64 + 0.5))
                .chain(std::iter::once(columns as f64))
                .collect();
        }
        for pair in edges.windows(2) {
            let width = pair[1] - pair[0];
            blocks.push(block(&format!("{}", blocks.len()), rectangle(pair[0], y, width, 0.5), 6.0 * width));
        }
    }
    on_floor(0.7, blocks)
}
