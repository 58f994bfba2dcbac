//! The statements about the scene: version, title, and the corners that healing moved.

use drystone::Scene;
use serde_json::{Value, json};

use super::{check, less, list, number, pair};
use crate::structure::wall;

/// A wall rotated about the origin, with coordinates of four decimals.
fn turned(degrees: f64) -> Value {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    let mut file = wall(4, 3);
    for bodies in ["ground", "blocks"] {
        for body in file[bodies].as_array_mut().expect("a list") {
            for corner in body["polygon"].as_array_mut().expect("corners") {
                let [x, y] = pair(corner);
                let at = [cos * x - sin * y, sin * x + cos * y];
                let written = at.map(|v| format!("{v:.4}").parse::<f64>().expect("a number"));
                *corner = json!(written);
            }
        }
    }
    file["gravity"] = json!([sin, -cos]);
    file
}

/// The distance of each corner of a file from the nearest corner of the same body of its scene, in metres.
fn moves(file: &Value) -> Vec<f64> {
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let blocks = scene.blocks().iter().map(|block| &block.body);
    let ground = scene.ground().iter().map(|ground| &ground.body);
    let bodies: Vec<_> = ground.chain(blocks).collect();
    let written = list(&file["ground"]).iter().chain(list(&file["blocks"]));
    let mut moves = Vec::new();
    for (body, written) in bodies.into_iter().zip(written) {
        for corner in list(&written["polygon"]) {
            let distances = body.polygon.outline().iter().map(|at| {
                let [x, y] = less(pair(corner), [at.x, at.y]);
                libm::hypot(x, y)
            });
            moves.push(distances.fold(f64::INFINITY, f64::min));
        }
    }
    moves
}

/// Four decimals leave corners up to 7·10⁻⁵ m away from the bodies that they touch. The result counts the corners
/// that healing moved.
#[test]
fn moved_corners_are_counted_and_the_largest_move_is_stated() {
    let mut seen = 0;
    for degrees in [3.0, 17.3, 24.0] {
        let mut file = turned(degrees);
        file["title"] = json!("a wall");
        let json = check(&file).json;
        assert_eq!(json["drystone"], env!("CARGO_PKG_VERSION"));
        assert_eq!(json["scene"], "a wall");
        let tolerance = &json["contact_tolerance"];
        // Rounding moves each coordinate by half a unit of the last decimal. Two corners move apart by twice this in
        // x and in y, so by √2 units. This is rounded up to one and a half units.
        let gap = 1.5e-4;
        assert_eq!((&tolerance["from"], &tolerance["digits"]), (&json!("decimals"), &json!(4)));
        for key in ["gap", "healed_within"] {
            let is_near = (number(&tolerance[key]) - gap).abs() < 1e-12;
            assert!(is_near, "{key}: {tolerance}");
        }
        let moves = moves(&file);
        let moved = moves.iter().filter(|by| **by > 1e-6 * gap);
        assert_eq!(tolerance["moved_corners"], json!(moved.count()), "{degrees}°");
        let largest = moves.iter().fold(0.0_f64, |most, by| most.max(*by));
        let stated = number(&tolerance["largest_move"]);
        assert!((stated - largest).abs() < 1e-12, "{stated} of {largest} m");
        assert!(stated <= gap);
        seen += usize::from(stated > 0.0);
    }
    assert_eq!(seen, 3);
    // Without rotation, every corner lies on the body that it touches.
    let tolerance = &check(&turned(0.0)).json["contact_tolerance"];
    let moved = (&tolerance["moved_corners"], &tolerance["largest_move"]);
    assert_eq!(moved, (&json!(0), &json!(0.0)));
}
