//! Structures the tests build: as scene files, so that every test goes through the front door.

use drystone::analysis::{FrameAnalysis, Verdict};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

/// A scene file's text into a checked scene.
pub fn scene(file: &Value) -> Scene {
    Scene::from_json(&file.to_string()).unwrap_or_else(|problems| panic!("{problems}"))
}

/// The first frame of a scene file.
pub fn first(file: &Value) -> FrameAnalysis {
    let scene = scene(file);
    let frame = Analysis::new(&scene).frames.remove(0);
    assert!(
        frame.proof.holds() || frame.verdict == Verdict::Undecided,
        "{:?}",
        frame.proof
    );
    frame
}

/// The first frame's verdict.
pub fn verdict(file: &Value) -> Verdict {
    first(file).verdict
}

/// Corners of an axis-parallel rectangle.
pub fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Value {
    json!([
        [x, y],
        [x + width, y],
        [x + width, y + height],
        [x, y + height]
    ])
}

/// A block of weight in newtons.
pub fn block(id: &str, polygon: Value, weight: f64) -> Value {
    json!({ "id": id, "polygon": polygon, "weight": weight })
}

/// Blocks on a floor y ≤ 0 from −100 to 100.
pub fn on_floor(friction: f64, blocks: Vec<Value>) -> Value {
    json!({ "drystone": 1, "friction": friction, "ground": [{ "polygon": rectangle(-100.0, -1.0, 200.0, 1.0) }],
        "blocks": blocks })
}

/// A block b wide and h high on a slope of `degrees`, rising to the right.
pub fn on_slope(degrees: f64, width: f64, height: f64, friction: f64, kernel: f64) -> Value {
    json!({ "drystone": 1, "friction": friction, "kernel": kernel,
        "shapes": { "slope": { "polygon": rectangle(-10.0, -1.0, 20.0, 1.0) },
                    "block": { "polygon": rectangle(-0.3 * width, 0.0, width, height) } },
        "ground": [{ "shape": "slope", "angle": degrees }],
        "blocks": [{ "id": "a", "shape": "block", "angle": degrees, "weight": 5.0 }] })
}

/// n equal bricks of length 1, each reaching beyond the one below as the harmonic stack does, times `share`.
pub fn harmonic(n: usize, share: f64) -> Value {
    let mut left = vec![0.0; n];
    // From the top: brick k (from 1) reaches 1/(2k) beyond the next below, the lowest beyond the table's edge.
    let mut x = 0.0;
    for k in (1..=n).rev() {
        x += share / (2.0 * k as f64);
        left[k - 1] = x - 1.0;
    }
    let blocks = (1..=n)
        .map(|k| {
            block(
                &format!("{k}"),
                rectangle(left[k - 1], (n - k) as f64 * 0.2, 1.0, 0.2),
                2.0,
            )
        })
        .collect::<Vec<_>>();
    json!({ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": rectangle(-5.0, -1.0, 5.0, 1.0) }], "blocks": blocks })
}

/// A semicircular arch of n voussoirs with radial joints, centreline radius 1.
pub fn arch(n: usize, thickness: f64, friction: f64) -> Value {
    let (inner, outer) = (1.0 - thickness / 2.0, 1.0 + thickness / 2.0);
    let at = |radius: f64, k: usize| {
        let angle = std::f64::consts::PI * k as f64 / n as f64;
        let (sin, cos) = if 2 * k == n {
            (1.0, 0.0)
        } else {
            (libm::sin(angle), libm::cos(angle))
        };
        json!([-radius * cos, if k == n { 0.0 } else { radius * sin }])
    };
    let blocks = (0..n)
        .map(|k| {
            let polygon = json!([
                at(inner, k),
                at(inner, k + 1),
                at(outer, k + 1),
                at(outer, k)
            ]);
            json!({ "id": format!("v{k}"), "polygon": polygon, "density": 1000 })
        })
        .collect::<Vec<_>>();
    json!({ "drystone": 1, "friction": friction,
        "ground": [{ "polygon": rectangle(-2.0, -1.0, 4.0, 1.0) }], "blocks": blocks })
}

/// A wall of bricks in running bond, `columns` wide and `rows` high, half bricks at the ends of every second row.
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
            blocks.push(block(
                &format!("{}", blocks.len()),
                rectangle(pair[0], y, width, 0.5),
                6.0 * width,
            ));
        }
    }
    on_floor(0.7, blocks)
}
