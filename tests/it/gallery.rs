//! The gallery of the thesis: its panels as scenes, compared with the numbers that its author's program computed.

use drystone::Analysis;
use drystone::analysis::{Failure, Verdict};
use drystone::internals::geometry::{Point, Vector};
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
    scene.frames()[number as usize].clone()
}

fn same_corners(found: &[drystone::internals::geometry::Point], expected: &Value, what: &str) {
    let expected = expected.as_array().expect("a list of corners");
    assert_eq!(found.len(), expected.len(), "{what}");
    for corner in expected {
        let (x, y) = (corner[0].as_f64().expect("x"), corner[1].as_f64().expect("y"));
        let near = found.iter().any(|p| (p.x - x).abs() < 1e-6 && (p.y - y).abs() < 1e-6);
        assert!(near, "{what} has no corner at ({x}, {y})");
    }
}

#[test]
fn bodies_have_the_corners_of_the_source() {
    for (name, panel) in panels() {
        let scene = scene(&panel);
        let frame = frame(&scene, &panel);
        assert!(scene.exact(), "{name}");
        let ground = panel["ground"].as_array().expect("ground");
        assert_eq!(scene.ground().len(), ground.len(), "{name}");
        for (ours, theirs) in scene.ground().iter().zip(ground) {
            same_corners(ours.body.polygon.outline(), &theirs["polygon"], &format!("{name}, ground"));
        }
        let blocks = panel["blocks"].as_array().expect("blocks");
        assert_eq!(frame.placed.len(), blocks.len(), "{name}");
        for (id, theirs) in frame.placed.iter().zip(blocks) {
            let block = &scene.blocks()[id.0];
            let theirs_id = theirs["id"].as_str().expect("id");
            let what = format!("{name}, block {theirs_id}");
            assert!(block.id.starts_with(theirs_id), "{what} is called {}", block.id);
            same_corners(block.body.polygon.outline(), &theirs["polygon"], &what);
            assert!((block.centroid.x - theirs["centroid"][0].as_f64().expect("x")).abs() < 1e-6, "{what}");
            assert!((block.centroid.y - theirs["centroid"][1].as_f64().expect("y")).abs() < 1e-6, "{what}");
            assert_eq!(block.weight, panel["weight_per_block"].as_f64().expect("weight"), "{what}");
        }
    }
}

#[test]
fn robots_hold_the_blocks_of_the_source_with_its_limits() {
    for (name, panel) in panels() {
        let scene = scene(&panel);
        let frame = frame(&scene, &panel);
        assert_eq!(scene.kernel(), panel["kernel"].as_f64().expect("kernel"), "{name}");
        for block in scene.blocks() {
            assert_eq!(block.body.friction, panel["friction"].as_f64().expect("friction"), "{name}");
        }
        for robot in panel["robots"].as_array().expect("robots") {
            let number = robot["id"].as_u64().expect("id") as usize;
            let held = frame.holds.iter().find(|h| h.robot.0 == number);
            let held = held.map(|h| scene.blocks()[h.block.0].id.clone());
            assert_eq!(held, robot["holds"].as_u64().map(|b| b.to_string()), "{name}, robot {number}");
            let limits = robot["limits"].as_object();
            if let (Some(ours), Some(limits)) = (scene.robots().get(number), limits) {
                assert_eq!(ours.limits.fx, limits["fx"].as_f64().expect("fx"), "{name}");
                assert_eq!(ours.limits.fy, limits["fy"].as_f64().expect("fy"), "{name}");
                assert_eq!(ours.limits.torque, limits["torque"].as_f64().expect("torque"), "{name}");
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
        assert_eq!(frame.title, format!("Robot {robot} wants to place a new block"));
        assert_eq!(frame.plans.len(), 1);
        assert_eq!(frame.plans[0].robot.0, robot);
        assert_eq!(scene.blocks()[frame.plans[0].block.0].id, "5");
    }
}

/// The corner forces of the thesis at an interface, as (N1, N2, f⁺ − f⁻).
fn expected_forces(interface: &Value) -> ([f64; 2], f64) {
    let corner = |k: usize, n: usize| interface["corner_forces_N_fplus_fminus"][k][n].as_f64().expect("a force");
    ([corner(0, 0), corner(1, 0)], corner(0, 1) - corner(0, 2) + corner(1, 1) - corner(1, 2))
}

fn point(value: &Value) -> Point {
    Point::new(value[0].as_f64().expect("x"), value[1].as_f64().expect("y"))
}

/// Verdict, totals, robots and interfaces of every panel, compared with the six decimals of the thesis.
#[test]
fn forces_are_those_of_the_source() {
    for (name, panel) in panels() {
        let scene = scene(&panel);
        let analysis = Analysis::new(&scene);
        let found = &analysis.frames[panel["frame"].as_u64().expect("a frame") as usize];
        let expected = &panel["expected"];
        let verdict = if expected["verdict"] == "stable" { Verdict::Stable } else { Verdict::Unstable };
        assert_eq!(found.verdict, verdict, "{name}");
        assert!(found.proof.holds(), "{name}: {:?}", found.proof);
        let near = |found: f64, expected: f64, what: &str| {
            assert!((found - expected).abs() <= 1e-6, "{name}, {what}: {found} instead of {expected}")
        };
        if let Some(total) = expected["total_force"].as_f64() {
            near(found.total_force, total, "total force");
        }
        let sticking = expected["sticking"].as_array().expect("a list");
        near(found.total_sticking, sticking.iter().map(|s| s[1].as_f64().expect("an amount")).sum(), "total sticking");
        let mut amounts: Vec<f64> = sticking.iter().filter_map(|s| s[1].as_f64()).collect();
        let mut failing: Vec<f64> = found.failures.iter().map(amount).collect();
        amounts.sort_by(f64::total_cmp);
        failing.sort_by(f64::total_cmp);
        assert_eq!(amounts.len(), failing.len(), "{name}: {:?}", found.failures);
        for (a, b) in failing.iter().zip(&amounts) {
            near(*a, *b, "a failure");
        }
        for (number, robot) in expected["robots"].as_array().expect("robots").iter().enumerate() {
            let value = |k: usize| robot[k].as_f64().expect("a force");
            let held = found.robots.iter().find(|r| r.robot.0 == number);
            let (force, torque) = held.map_or((Vector::zeros(), 0.0), |r| (r.force, r.torque));
            near(force.x, value(0) - value(1), "robot force x");
            near(force.y, value(2) - value(3), "robot force y");
            near(torque, value(4) - value(5), "robot torque");
        }
        let interfaces = expected["interfaces"].as_array().expect("interfaces");
        assert_eq!(found.contacts.len(), interfaces.len(), "{name}");
        for interface in interfaces {
            let points = [point(&interface["application_points"][0]), point(&interface["application_points"][1])];
            let lies = |p: Point, q: Point| (p - q).norm() < 2e-6;
            let contact = found.contacts.iter().find(|c| {
                let [p, q] = c.application_points;
                (lies(p, points[0]) && lies(q, points[1])) || (lies(q, points[0]) && lies(p, points[1]))
            });
            let contact = contact.unwrap_or_else(|| panic!("{name}: no interface at {points:?}"));
            let (mut normal, friction) = expected_forces(interface);
            if !lies(contact.application_points[0], points[0]) {
                normal.reverse();
            }
            near(contact.normal_forces[0], normal[0], "N1");
            near(contact.normal_forces[1], normal[1], "N2");
            // The source does not state on which of the two blocks its friction acts, so only magnitudes are
            // compared.
            near(contact.friction_force.abs(), friction.abs(), "T");
            let sum = normal[0] + normal[1];
            if sum > 1e-3 {
                let points = contact.application_points;
                let at = points[0] + (points[1] - points[0]) * (normal[1] / sum);
                assert!((contact.resultant.at - at).norm() < 3e-6, "{name}: {} {at}", contact.resultant.at);
            }
        }
    }
}

fn amount(failure: &Failure) -> f64 {
    match failure {
        Failure::Tension { force, .. } | Failure::Friction { force, .. } | Failure::RobotForce { force, .. } => {
            force.norm()
        }
        Failure::RobotTorque { torque, .. } => torque.abs(),
        other => panic!("an unknown kind of failure: {other:?}"),
    }
}

/// Figure 9a stands if the friction is at least a value that depends on corner contacts and the kernel. Figure 9b
/// stands if its robot may exert a torque.
#[test]
fn effects_that_the_source_neglects_make_figure_9_stand() {
    let read = |name: &str| -> Value {
        let path = format!("{}/assets/thesis/{name}", env!("CARGO_MANIFEST_DIR"));
        serde_json::from_str(&std::fs::read_to_string(path).expect("the scene is there")).expect("JSON")
    };
    let stands = |file: &Value| crate::structure::first(file).verdict == Verdict::Stable;
    for (corner_contacts, kernel, least) in
        [(true, 0.2, 0.5389), (true, 0.0, 0.3849), (false, 0.2, 1.6166), (false, 0.0, 1.1547)]
    {
        let mut file = read("figure-9a.json");
        file["corner_contacts"] = corner_contacts.into();
        file["kernel"] = kernel.into();
        file["friction"] = (least - 0.0002).into();
        assert!(!stands(&file), "corner contacts {corner_contacts}, kernel {kernel}");
        file["friction"] = (least + 0.0002).into();
        assert!(stands(&file), "corner contacts {corner_contacts}, kernel {kernel}");
    }
    let mut file = read("figure-9b.json");
    file["robots"][0]["limits"]["torque"] = 100.0.into();
    let frame = crate::structure::first(&file);
    assert_eq!(frame.verdict, Verdict::Stable);
    assert!((frame.robots[0].torque.abs() - 6.204).abs() < 1e-3, "{:?}", frame.robots);
}
