//! The gallery of the source: its panels as scenes of our own, beside the numbers its author's program computed.

use drystone::scene::{Frame, Scene};
use serde_json::Value;

fn panels() -> serde_json::Map<String, Value> {
    let text = include_str!("../reference/panels.json");
    serde_json::from_str(text).expect("the reference is JSON")
}

fn scene(panel: &Value) -> Scene {
    let path = panel["scene"].as_str().expect("a panel names its scene");
    let full = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&full).expect("the scene is there");
    Scene::from_json(&text).unwrap_or_else(|problems| panic!("{path}:\n{problems}"))
}

fn frame(scene: &Scene, panel: &Value) -> Frame {
    let number = panel["frame"].as_u64().expect("a panel names its frame");
    scene.frames[number as usize].clone()
}

fn same_corners(found: &[drystone::geometry::Point], expected: &Value, what: &str) {
    let expected = expected.as_array().expect("a list of corners");
    assert_eq!(found.len(), expected.len(), "{what}");
    for corner in expected {
        let (x, y) = (
            corner[0].as_f64().expect("x"),
            corner[1].as_f64().expect("y"),
        );
        let near = found
            .iter()
            .any(|p| (p.x - x).abs() < 1e-6 && (p.y - y).abs() < 1e-6);
        assert!(near, "{what} has no corner at ({x}, {y})");
    }
}

#[test]
fn bodies_lie_where_the_source_has_them() {
    for (name, panel) in panels() {
        let scene = scene(&panel);
        let frame = frame(&scene, &panel);
        assert!(scene.exact, "{name}");
        let ground = panel["ground"].as_array().expect("ground");
        assert_eq!(scene.ground.len(), ground.len(), "{name}");
        for (ours, theirs) in scene.ground.iter().zip(ground) {
            same_corners(
                ours.body.polygon.outline(),
                &theirs["polygon"],
                &format!("{name}, ground"),
            );
        }
        let blocks = panel["blocks"].as_array().expect("blocks");
        assert_eq!(frame.placed.len(), blocks.len(), "{name}");
        for (id, theirs) in frame.placed.iter().zip(blocks) {
            let block = &scene.blocks[id.0];
            let theirs_id = theirs["id"].as_str().expect("id");
            let what = format!("{name}, block {theirs_id}");
            assert!(
                block.id.starts_with(theirs_id),
                "{what} is called {}",
                block.id
            );
            same_corners(block.body.polygon.outline(), &theirs["polygon"], &what);
            assert!(
                (block.centroid.x - theirs["centroid"][0].as_f64().expect("x")).abs() < 1e-6,
                "{what}"
            );
            assert!(
                (block.centroid.y - theirs["centroid"][1].as_f64().expect("y")).abs() < 1e-6,
                "{what}"
            );
            assert_eq!(
                block.weight,
                panel["weight_per_block"].as_f64().expect("weight"),
                "{what}"
            );
        }
    }
}

#[test]
fn robots_hold_what_the_source_has_them_hold() {
    for (name, panel) in panels() {
        let scene = scene(&panel);
        let frame = frame(&scene, &panel);
        assert_eq!(
            scene.kernel,
            panel["kernel"].as_f64().expect("kernel"),
            "{name}"
        );
        for block in &scene.blocks {
            assert_eq!(
                block.body.friction,
                panel["friction"].as_f64().expect("friction"),
                "{name}"
            );
        }
        for robot in panel["robots"].as_array().expect("robots") {
            let number = robot["id"].as_u64().expect("id") as usize;
            let held = frame.holds.iter().find(|h| h.robot.0 == number);
            let held = held.map(|h| scene.blocks[h.block.0].id.clone());
            assert_eq!(
                held,
                robot["holds"].as_u64().map(|b| b.to_string()),
                "{name}, robot {number}"
            );
            let limits = robot["limits"].as_object();
            if let (Some(ours), Some(limits)) = (scene.robots.get(number), limits) {
                assert_eq!(ours.limits.fx, limits["fx"].as_f64().expect("fx"), "{name}");
                assert_eq!(ours.limits.fy, limits["fy"].as_f64().expect("fy"), "{name}");
                assert_eq!(
                    ours.limits.torque,
                    limits["torque"].as_f64().expect("torque"),
                    "{name}"
                );
            }
        }
    }
}

#[test]
fn figure_4_plans_the_block_of_its_title() {
    let panels = panels();
    for (name, robot) in [("4b", 0), ("4e", 1)] {
        let scene = scene(&panels[name]);
        let frame = frame(&scene, &panels[name]);
        assert_eq!(
            frame.title,
            format!("Robot {robot} wants to place a new block")
        );
        assert_eq!(frame.plans.len(), 1);
        assert_eq!(frame.plans[0].robot.0, robot);
        assert_eq!(scene.blocks[frame.plans[0].block.0].id, "5");
    }
}
