//! The statements about how a structure falls.

use serde_json::Value;

use super::{cross, dot, less, list, number, pair, structures};
use crate::structure::scene;

/// The velocity of a point of a body. The ground and bodies that are not listed are at rest.
fn speed(frame: &Value, centroid: &dyn Fn(&str) -> [f64; 2], body: &str, at: [f64; 2]) -> [f64; 2] {
    let moves = list(&frame["mechanism"]).iter().find(|m| m["block"] == body);
    moves.map_or([0.0; 2], |m| {
        let (v, spin, arm) = (pair(&m["velocity"]), number(&m["spin"]), less(at, centroid(body)));
        [v[0] - spin * arm[1], v[1] + spin * arm[0]]
    })
}

#[test]
fn no_contact_force_opposes_a_mechanism_and_its_fastest_point_has_speed_one() {
    let mut seen = 0;
    for checked in structures() {
        let frame = &checked.json["frames"][0];
        if list(&frame["mechanism"]).is_empty() {
            assert_ne!(frame["verdict"], "unstable", "{}", checked.file);
            continue;
        }
        seen += 1;
        let scene = scene(&checked.file);
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
        assert!((fastest - 1.0).abs() < 1e-6, "{fastest}: {}", checked.file);
        for interface in list(&frame["interfaces"]) {
            let normal = pair(&interface["normal"]);
            let tangent = [-normal[1], normal[0]];
            let [a, b] = [0, 1].map(|k| interface["bodies"][k].as_str().expect("a name"));
            let mu = number(&interface["mu"]);
            for at in list(&interface["application_points"]) {
                let at = pair(at);
                let apart = less(speed(frame, &centroid, a, at), speed(frame, &centroid, b, at));
                // No admissible contact force n ± μ t may take power from the motion.
                let power = dot(apart, normal) - mu * dot(apart, tangent).abs();
                assert!(power >= -1e-5 * (1.0 + mu), "{interface} {power}: {}", checked.file);
            }
        }
    }
    assert!(seen > 5);
}

/// The numbers of a proof by a motion, recomputed from the motion, the weights and the interfaces of the same result:
/// the power of the loads, the largest speed against which a contact could act, and the sum of forces below which no
/// balance exists.
#[test]
fn the_numbers_of_a_proof_by_a_motion_are_those_of_the_listed_motion() {
    let mut seen = 0;
    for checked in structures() {
        let frame = &checked.json["frames"][0];
        let proof = &frame["proof"];
        // With several groups, the proof is the worst of several motions.
        if frame["verdict"] != "unstable" || frame["solve"]["groups"] != 1 {
            continue;
        }
        let power = number(&proof["power"]);
        let violation = number(&proof["worst_violation"]);
        assert!(power > 0.0 && violation >= 0.0, "{proof}");
        match proof["no_balance_below"].as_f64() {
            Some(sum) => assert!((sum * violation - power).abs() <= 1e-9 * power, "{proof}"),
            None => assert_eq!((&proof["no_balance_below"], violation), (&"unbounded".into(), 0.0)),
        }
        let scene = scene(&checked.file);
        let moves = |id: &str| list(&frame["mechanism"]).iter().find(|m| m["block"] == id);
        let down = [scene.down().x, scene.down().y];
        let (mut work, mut loads, mut fastest): (f64, f64, f64) = (0.0, 0.0, 0.0);
        for (k, block) in scene.blocks().iter().enumerate() {
            let Some(moving) = moves(&block.id) else {
                continue;
            };
            let (v, spin) = (pair(&moving["velocity"]), number(&moving["spin"]));
            let centroid = [block.centroid.x, block.centroid.y];
            let (mut force, mut moment) = (down.map(|d| d * block.weight), 0.0);
            let mut listed = [0.0; 2];
            for load in scene.loads().iter().filter(|l| l.block.0 == k) {
                let pull = [load.force.x, load.force.y];
                listed = [listed[0] + pull[0], listed[1] + pull[1]];
                moment += cross(less([load.at.x, load.at.y], centroid), pull) + load.torque;
            }
            force = [force[0] + listed[0], force[1] + listed[1]];
            work += dot(force, v) + moment * spin;
            let arms = block.body.polygon.outline().iter();
            let arms: Vec<[f64; 2]> = arms.map(|p| less([p.x, p.y], centroid)).collect();
            let radius = arms.iter().map(|a| dot(*a, *a).sqrt()).fold(0.0, f64::max);
            let speeds = arms.iter().map(|a| [v[0] - spin * a[1], v[1] + spin * a[0]]);
            let speed = speeds.map(|v| dot(v, v).sqrt()).fold(0.0, f64::max);
            let gross = block.weight + dot(listed, listed).sqrt() + moment.abs() / radius;
            loads += gross * speed;
            fastest = fastest.max(speed);
        }
        // Limited robots can take power from the motion. A robot without a limit on a moving block would stop it.
        for robot in list(&frame["robots"]) {
            let id = robot["holds"].as_str().expect("a name");
            let Some(moving) = moves(id) else { continue };
            let block = scene.blocks().iter().find(|b| b.id == id).expect("a block");
            let arm = less(pair(&robot["at"]), [block.centroid.x, block.centroid.y]);
            let (v, spin) = (pair(&moving["velocity"]), number(&moving["spin"]));
            let at_grip = [v[0] - spin * arm[1], v[1] + spin * arm[0]];
            let listed = list(&checked.file["robots"]).iter().find(|r| r["id"] == robot["id"]);
            let limits = &listed.expect("a robot of the file")["limits"];
            for (key, speed) in [("fx", at_grip[0]), ("fy", at_grip[1]), ("torque", spin)] {
                let own = limits[key].as_f64();
                let limit = match key {
                    "torque" => own.or(Some(0.0)),
                    _ => own.or_else(|| limits["force"].as_f64()),
                };
                match limit.filter(|limit| *limit <= 1e4 * loads) {
                    Some(limit) => work -= limit * speed.abs(),
                    None => assert!(speed.abs() <= violation + 1e-8, "{robot}: {}", checked.file),
                }
            }
        }
        let expected = work / loads;
        assert!(
            (power - expected).abs() <= 1e-6 * expected.abs().max(1e-3),
            "{power} {expected} {fastest}: {}",
            checked.file
        );
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
}
