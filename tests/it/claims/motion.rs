//! What is told of how a structure falls.

use serde_json::Value;

use super::{dot, less, list, number, pair, structures};
use crate::structure::scene;

/// Speed of a point of a moving body; the ground's is 0.
fn speed(frame: &Value, centroid: &dyn Fn(&str) -> [f64; 2], body: &str, at: [f64; 2]) -> [f64; 2] {
    let moves = list(&frame["mechanism"])
        .iter()
        .find(|m| m["block"] == body);
    moves.map_or([0.0; 2], |m| {
        let (v, spin, arm) = (
            pair(&m["velocity"]),
            number(&m["spin"]),
            less(at, centroid(body)),
        );
        [v[0] - spin * arm[1], v[1] + spin * arm[0]]
    })
}

#[test]
fn a_mechanism_presses_nothing_and_its_fastest_point_has_speed_one() {
    let mut seen = 0;
    for told in structures() {
        let frame = &told.json["frames"][0];
        if list(&frame["mechanism"]).is_empty() {
            assert_ne!(frame["verdict"], "unstable", "{}", told.file);
            continue;
        }
        seen += 1;
        let scene = scene(&told.file);
        let find = |id: &str| scene.blocks().iter().find(|b| b.id == id).expect("a block");
        let centroid = |id: &str| {
            let at = find(id).centroid;
            [at.x, at.y]
        };
        let mut fastest: f64 = 0.0;
        for moves in list(&frame["mechanism"]) {
            let id = moves["block"].as_str().expect("a name");
            for corner in find(id).body.polygon.outline() {
                let v = speed(frame, &centroid, id, [corner.x, corner.y]);
                fastest = fastest.max(dot(v, v).sqrt());
            }
        }
        assert!((fastest - 1.0).abs() < 1e-6, "{fastest}: {}", told.file);
        for interface in list(&frame["interfaces"]) {
            let normal = pair(&interface["normal"]);
            let tangent = [-normal[1], normal[0]];
            let [a, b] = [0, 1].map(|k| interface["bodies"][k].as_str().expect("a name"));
            let mu = number(&interface["mu"]);
            for at in list(&interface["application_points"]) {
                let at = pair(at);
                let apart = less(
                    speed(frame, &centroid, a, at),
                    speed(frame, &centroid, b, at),
                );
                // No admissible force (n, ±μ t) may take power from the motion.
                let power = dot(apart, normal) - mu * dot(apart, tangent).abs();
                assert!(
                    power >= -1e-5 * (1.0 + mu),
                    "{interface} {power}: {}",
                    told.file
                );
            }
        }
    }
    assert!(seen > 5);
}
