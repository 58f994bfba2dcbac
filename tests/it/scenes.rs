//! The meaning of a valid scene file: defaults, precedence, positions and steps.

use drystone::analysis::{Analysis, Verdict};
use drystone::internals::geometry::{Point, Vector};
use drystone::scene::{BlockId, BodyId, Frame, Limits, Rgb, Scene, starter};

fn scene(text: &str) -> Scene {
    Scene::from_json(text).unwrap_or_else(|problems| panic!("{text}\n{problems}"))
}

fn near(p: Point, x: f64, y: f64) {
    assert!((p - Point::new(x, y)).norm() < 1e-12, "{p} is not ({x}, {y})");
}

fn placed(frame: &Frame) -> Vec<usize> {
    frame.placed.iter().map(|b| b.0).collect()
}

#[test]
fn everything_but_version_and_blocks_has_a_default() {
    let scene = scene(
        r#"{ "drystone": 1, "blocks": [{ "polygon": [[0, 0], [0, 2], [3, 0]] }, { "polygon": [[5, 0], [7, 0], [7, 1]] }] }"#,
    );
    assert_eq!(scene.title(), "");
    assert_eq!(scene.gravity(), Vector::new(0.0, -9.81));
    assert_eq!((scene.kernel(), scene.corner_contacts().on_edges(), scene.exact()), (0.0, false, false));
    assert!(scene.lattice().is_none() && scene.robots().is_empty() && scene.loads().is_empty());
    let block = &scene.blocks()[0];
    assert_eq!((block.id.as_str(), block.body.friction, block.body.fill), ("1", 0.7, None));
    assert!((block.weight - 3.0 * 9.81).abs() < 1e-12);
    near(block.centroid, 1.0, 2.0 / 3.0);
    assert_eq!(scene.frames().len(), 1);
    assert_eq!(placed(&scene.frames()[0]), [0, 1]);
    let empty = Scene::from_json(r#"{ "drystone": 1, "blocks": [], "$schema": "scene.schema.json", "title": null }"#);
    assert!(empty.expect("a scene without blocks is valid").frames()[0].placed.is_empty());
}

#[test]
fn the_most_specific_weight_has_precedence() {
    let square = r#""polygon": [[0, 0], [2, 0], [2, 1], [0, 1]]"#;
    for (given, weight) in [
        (r#""weight": 7, "mass": 5, "density": 3, "material": "oak""#, 7.0),
        (r#""mass": 5, "density": 3, "material": "oak""#, 5.0 * 2.5),
        (r#""density": 3, "material": "oak""#, 3.0 * 2.0 * 0.5 * 2.5),
        (r#""material": "oak""#, 11.0 * 2.0 * 0.5 * 2.5),
        (r#""material": "plain""#, 13.0 * 2.0 * 0.5 * 2.5),
        (r#""at": [4, 4]"#, 13.0 * 2.0 * 0.5 * 2.5),
        (r#""weight": 0"#, 0.0),
    ] {
        let scene = scene(&format!(
            r#"{{ "drystone": 1, "gravity": [1.5, -2], "density": 13, "thickness": 0.5,
            "materials": {{ "oak": {{ "density": 11 }}, "plain": {{}} }}, "blocks": [{{ {square}, {given} }}] }}"#
        ));
        assert!((scene.blocks()[0].weight - weight).abs() < 1e-12, "{given}: {}", scene.blocks()[0].weight);
    }
}

#[test]
fn friction_is_that_of_the_pair_or_else_the_smaller_of_both_bodies() {
    let scene = scene(
        r##"{ "drystone": 1, "friction": 0.9,
        "materials": { "oak": { "friction": 0.5, "fill": "#863" }, "ice": { "friction": 0.1 }, "granite": {} },
        "friction_pairs": [{ "between": ["oak", "ice"], "friction": 0.3 }, { "between": ["ice", "ice"], "friction": 0.02 }],
        "ground": [{ "polygon": [[0, -1], [9, -1], [9, 0], [0, 0]], "material": "ice" }],
        "blocks": [
            { "id": "a", "polygon": [[0, 0], [1, 0], [1, 1]], "material": "oak" },
            { "id": "b", "polygon": [[2, 0], [3, 0], [3, 1]], "material": "oak", "friction": 0.8, "fill": "#8b6b3d" },
            { "id": "c", "polygon": [[4, 0], [5, 0], [5, 1]], "material": "ice" },
            { "id": "d", "polygon": [[6, 0], [7, 0], [7, 1]], "material": "granite" } ] }"##,
    );
    let (ground, block) = (BodyId::Ground(0), |i| BodyId::Block(BlockId(i)));
    let up = drystone::geometry::Vector::new(0.0, 1.0);
    assert_eq!(scene.friction_at([block(0), ground], up), 0.3);
    assert_eq!(
        scene.friction_at([ground, block(1)], up),
        0.3,
        "the pair has precedence over the coefficient of a body"
    );
    assert_eq!(scene.friction_at([block(2), ground], up), 0.02);
    assert_eq!(scene.friction_at([block(3), ground], up), 0.1);
    assert_eq!(scene.friction_at([block(0), block(1)], up), 0.5);
    assert_eq!(scene.friction_at([block(1), block(3)], up), 0.8);
    assert_eq!(scene.blocks()[0].body.fill, Some(Rgb([0x88, 0x66, 0x33])));
    assert_eq!(scene.blocks()[1].body.fill, Some(Rgb([0x8b, 0x6b, 0x3d])));
    assert_eq!(scene.name(ground), "ground");
}

#[test]
fn a_shape_is_rotated_about_its_origin_and_then_moved() {
    let scene = scene(
        r#"{ "drystone": 1, "shapes": { "bar": { "polygon": [[0, 0], [4, 0], [4, 1], [0, 1]], "holes": [[[1, 0.25], [2, 0.25], [1, 0.5]]] } },
        "blocks": [{ "shape": "bar", "at": [10, 20], "angle": 90 }] }"#,
    );
    let polygon = &scene.blocks()[0].body.polygon;
    for (x, y) in [(10.0, 20.0), (10.0, 24.0), (9.0, 24.0), (9.0, 20.0)] {
        assert!(polygon.outline().contains(&Point::new(x, y)), "({x}, {y})");
    }
    assert_eq!(polygon.holes().len(), 1);
    assert!((polygon.area() - 3.875).abs() < 1e-12);
}

#[test]
fn on_a_lattice_bodies_lie_at_lattice_points_and_grips_in_metres() {
    let scene = scene(
        r#"{ "drystone": 1, "grid": { "kind": "triangular", "side": 2 },
        "shapes": { "dart": { "cells": [[0, 0, "up"], [0, 0, "down"]] } },
        "blocks": [{ "id": "a", "shape": "dart", "at": [3, 1], "angle": -60 }, { "id": "b", "cells": [[7, 2, "down"]] }],
        "robots": [{ "id": "r", "holds": "a", "at": [3, 1] }], "loads": [{ "block": "b", "at": [3, 1] }] }"#,
    );
    assert!(scene.exact());
    assert_eq!(scene.tolerance().gap, 0.0);
    near(scene.robots()[0].holds.expect("holds").at, 3.0, 1.0);
    near(scene.loads()[0].at, 3.0, 1.0);
    // Rotated by −60°, the dart's cells share the edge from (0, 0) to (1, −1); its centroid is the middle of that
    // edge.
    let h = 3f64.sqrt();
    near(scene.blocks()[0].centroid, 7.0 + 0.5, h - h / 2.0);
    assert!((scene.blocks()[0].body.polygon.area() - 2.0 * h).abs() < 1e-12);
}

#[test]
fn a_polygon_in_a_lattice_scene_makes_it_inexact_and_may_lie_between_lattice_points() {
    let scene = scene(
        r#"{ "drystone": 1, "grid": { "kind": "triangular", "side": 2 }, "ground": [{ "shape": "down" }],
        "blocks": [{ "polygon": [[0, 0], [1, 0], [0, 0.5]], "at": [1.5, 2], "angle": 180 }] }"#,
    );
    assert!(!scene.exact() && scene.tolerance().gap > 0.0);
    let h = 3f64.sqrt();
    near(scene.blocks()[0].centroid, 5.0 - 1.0 / 3.0, 2.0 * h - 0.5 / 3.0);
}

#[test]
fn shapes_on_a_square_lattice_are_rotated_by_right_angles() {
    let scene = scene(
        r#"{ "drystone": 1, "grid": { "kind": "square", "side": 0.5 }, "blocks": [
        { "cells": [[0, 0], [1, 0], [2, 0]], "at": [4, 2], "angle": 450 }] }"#,
    );
    assert!(scene.exact());
    let bounds = scene.blocks()[0].body.polygon.bounds();
    near(bounds.min, 1.5, 1.0);
    near(bounds.max, 2.0, 2.5);
}

#[test]
fn missing_limits_have_their_defaults() {
    let limits = |text: &str| {
        let text = format!(r#"{{ "drystone": 1, "blocks": [], "robots": [{{ "id": "r"{text} }}] }}"#);
        scene(&text).robots()[0].limits
    };
    let free = f64::INFINITY;
    assert_eq!(limits(""), Limits { fx: free, fy: free, torque: 0.0 });
    assert_eq!(limits(r#", "limits": {}"#), Limits { fx: free, fy: free, torque: 0.0 });
    assert_eq!(limits(r#", "limits": { "force": 5 }"#), Limits { fx: 5.0, fy: 5.0, torque: 0.0 });
    assert_eq!(limits(r#", "limits": { "force": 5, "fy": 9, "torque": 2 }"#), Limits { fx: 5.0, fy: 9.0, torque: 2.0 });
    assert_eq!(limits(r#", "limits": { "fy": 0 }"#), Limits { fx: free, fy: 0.0, torque: 0.0 });
}

#[test]
fn steps_are_applied_in_order() {
    let scene = scene(
        r#"{ "drystone": 1, "blocks": [
            { "id": "a", "polygon": [[0, 0], [2, 0], [2, 2], [0, 2]] },
            { "id": "b", "polygon": [[2, 0], [4, 0], [4, 2], [2, 2]] },
            { "id": "c", "polygon": [[4, 0], [6, 0], [6, 2], [4, 2]] } ],
        "robots": [{ "id": "r", "holds": "b", "at": [2.5, 0.5] }, { "id": "s" }],
        "steps": [
            { "place": ["b", "a"], "hold": { "s": "a", "r": "b" }, "plan": { "s": "c", "r": "c" } },
            { "title": "moved", "release": ["s", "r"], "remove": ["b"], "place": ["c", "b"], "hold": { "r": "a", "s": { "block": "c", "at": [4.5, 1.5] } } },
            { "release": ["s", "s"], "hold": { "r": { "block": "a", "at": [0.5, 1] } } } ] }"#,
    );
    assert_eq!(scene.frames().len(), 3);
    let frame = &scene.frames()[0];
    assert_eq!((frame.title.as_str(), placed(frame)), ("", vec![1, 0]));
    assert_eq!(frame.holds.iter().map(|h| (h.robot.0, h.block.0)).collect::<Vec<_>>(), [(0, 1), (1, 0)]);
    near(frame.holds[0].at, 2.5, 0.5);
    near(frame.holds[1].at, 1.0, 1.0);
    assert_eq!(frame.plans.iter().map(|p| (p.robot.0, p.block.0)).collect::<Vec<_>>(), [(0, 2), (1, 2)]);
    let frame = &scene.frames()[1];
    assert_eq!(
        (frame.title.as_str(), placed(frame)),
        ("moved", vec![0, 2, 1]),
        "a block that is placed again is the last one"
    );
    near(frame.holds[0].at, 1.0, 1.0);
    near(frame.holds[1].at, 4.5, 1.5);
    assert!(frame.plans.is_empty());
    let frame = &scene.frames()[2];
    assert_eq!(frame.holds.len(), 1);
    near(frame.holds[0].at, 0.5, 1.0);
}

#[test]
fn without_steps_every_robot_holds_the_block_of_its_key() {
    let scene = scene(
        r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [2, 0], [2, 4], [0, 4]] }],
        "robots": [{}, { "holds": "a", "at": [0.25, 3] }, { "id": "x", "holds": "a" }] }"#,
    );
    assert_eq!(scene.robots().iter().map(|r| r.id.as_str()).collect::<Vec<_>>(), ["r0", "r1", "x"]);
    let holds = &scene.frames()[0].holds;
    assert_eq!(holds.iter().map(|h| h.robot.0).collect::<Vec<_>>(), [1, 2]);
    near(holds[0].at, 0.25, 3.0);
    near(holds[1].at, 1.0, 2.0);
}

#[test]
fn bodies_may_touch_and_parts_of_the_ground_may_overlap() {
    let noisy = scene(
        r#"{ "drystone": 1, "ground": [{ "polygon": [[0, -1], [9, -1], [9, 0], [0, 0]] }, { "polygon": [[1, -1], [5, -1], [5, 0], [1, 0]] }],
        "blocks": [{ "polygon": [[0, -0.0000001], [1, 0], [1, 1], [0, 1]] }, { "polygon": [[0.9999999, 0], [2, 0], [2, 1], [0.9999999, 1]] }] }"#,
    );
    assert_eq!(noisy.blocks().len(), 2);
    let exchanged = scene(
        r#"{ "drystone": 1, "grid": { "kind": "square" }, "blocks": [{ "cells": [[0, 0]] }, { "cells": [[0, 0], [0, 1]] }, { "cells": [[0, 0]] }],
        "steps": [{ "place": ["1"], "plan": {} }, { "remove": ["1"], "place": ["2"] }] }"#,
    );
    assert_eq!(placed(&exchanged.frames()[1]), [1], "blocks that are never placed at the same time may overlap");
}

#[test]
fn the_starter_scene_is_short_and_has_robots_materials_loads_and_steps() {
    let scene = scene(starter());
    assert!(starter().lines().count() <= 60);
    assert!(!scene.robots().is_empty() && !scene.materials().is_empty() && !scene.loads().is_empty());
    assert!(scene.frames().len() >= 3 && scene.frames().iter().all(|f| !f.title.is_empty()));
    assert!(scene.lattice().is_none());
    let verdicts: Vec<Verdict> = Analysis::new(&scene).frames.iter().map(|f| f.verdict).collect();
    assert_eq!(verdicts, [Verdict::Stable; 5], "the first example stands");
}

/// `cargo bench --bench large` measures how long this takes.
#[test]
fn a_wall_of_ten_thousand_blocks_is_read() {
    let mut blocks = Vec::new();
    for row in 0..100 {
        for column in 0..100 {
            let x = f64::from(column) * 2.0 + f64::from(row % 2);
            blocks.push(format!(r#"{{ "shape": "brick", "at": [{x}, {row}] }}"#));
        }
    }
    let text = format!(
        r#"{{ "drystone": 1, "shapes": {{ "brick": {{ "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]] }} }},
        "ground": [{{ "polygon": [[-1, -1], [202, -1], [202, 0], [-1, 0]] }}], "blocks": [{}] }}"#,
        blocks.join(",")
    );
    assert_eq!(scene(&text).blocks().len(), 10_000);
}
