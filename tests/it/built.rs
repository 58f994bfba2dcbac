//! A scene built in code equals the scene of a file with the same content, and errors in it are reported in the same
//! way.

use drystone::analysis::Analysis;
use drystone::scene::format::{
    BlockEntry, CellEntry, CellHalf, GridKind, GroundEntry, LimitsEntry, LoadEntry, MaterialEntry, RobotEntry,
    SceneFile, ShapeEntry, StepEntry,
};
use drystone::scene::{Code, NoteCode, Problem, Scene};
use serde_json::json;

const REFERENCE: &str = include_str!("../reference/problems.txt");

#[test]
fn every_key_has_a_builder_method() {
    let read = json!({ "drystone": 1, "title": "all", "author": "A. Mason", "project": "Mill Lane", "date": "2026-11-23", "gravity": [0.0, -9.0], "friction": 0.6, "kernel": 0.1, "density": 2.0,
        "thickness": 0.5, "contact_tolerance": 1e-6, "corner_contacts": true,
        "materials": { "oak": { "density": 700.0, "friction": 0.5, "fill": "#8b6b3d" }, "slate": {} },
        "friction_pairs": [{ "between": ["oak", "slate"], "friction": 0.3 }],
        "shapes": { "frame": { "polygon": [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]],
                               "holes": [[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]]] } },
        "ground": [{ "polygon": [[-5.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-5.0, 0.0]] },
                   { "shape": "frame", "at": [20.0, 0.0], "angle": 90.0, "material": "slate", "friction": 0.4, "fill": "#abc" }],
        "blocks": [{ "id": "a", "shape": "frame", "at": [0.0, 0.0], "angle": 0.0, "material": "oak", "weight": 6.0, "fill": "#fff" },
                   { "polygon": [[5.0, 0.0], [6.0, 0.0], [6.0, 1.0], [5.0, 1.0]] },
                   { "id": "c", "polygon": [[0.0, 3.0], [1.0, 3.0], [1.0, 4.0], [0.0, 4.0]], "mass": 3.0, "density": 4.0, "friction": 0.2 }],
        "robots": [{ "id": "r", "holds": "a", "at": [1.0, 0.5], "limits": { "fx": 1.0, "fy": 2.0, "torque": 3.0, "force": 4.0 } },
                   { "id": "s" }],
        "loads": [{ "block": "a", "force": [1.0, 0.0], "at": [0.0, 0.5], "torque": 0.25 }],
        "steps": [{ "title": "one", "place": ["a", "2"], "hold": { "r": "a", "s": { "block": "2", "at": [5.5, 1.0] } }, "plan": {} },
                  { "title": "two", "release": ["r", "s"], "remove": ["2"], "place": ["c"] },
                  { "title": "three", "plan": { "s": "2" } }],
        "silence": ["friction_high"] });
    let square = |x: f64, y: f64| [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
    let limits = LimitsEntry::default().fx(1.0).fy(2.0).torque(3.0).force(4.0);
    let frame = ShapeEntry::from([[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]]);
    let made = Scene::builder()
        .title("all")
        .author("A. Mason")
        .project("Mill Lane")
        .date("2026-11-23")
        .gravity([0.0, -9.0])
        .friction(0.6)
        .kernel(0.1)
        .density(2.0)
        .thickness(0.5)
        .contact_tolerance(1e-6)
        .corner_contacts(true)
        .material("oak", MaterialEntry::default().density(700.0).friction(0.5).fill("#8b6b3d"))
        .material("slate", MaterialEntry::default())
        .friction_pair("oak", "slate", 0.3)
        .shape("frame", frame.hole(square(1.0, 1.0)))
        .ground([[-5.0, -1.0], [9.0, -1.0], [9.0, 0.0], [-5.0, 0.0]])
        .ground(
            GroundEntry::default()
                .shape("frame")
                .at([20.0, 0.0])
                .angle(90.0)
                .material("slate")
                .friction(0.4)
                .fill("#abc"),
        )
        .block(BlockEntry::new("a").shape("frame").at([0.0, 0.0]).angle(0.0).material("oak").weight(6.0).fill("#fff"))
        .block(square(5.0, 0.0))
        .block(BlockEntry::new("c").polygon(square(0.0, 3.0)).mass(3.0).density(4.0).friction(0.2))
        .robot(RobotEntry::new("r").holds("a").at([1.0, 0.5]).limits(limits))
        .robot(RobotEntry::new("s"))
        .load(LoadEntry::on("a").force([1.0, 0.0]).at([0.0, 0.5]).torque(0.25))
        .step(StepEntry::new("one").place(["a", "2"]).hold("r", "a").hold_at("s", "2", [5.5, 1.0]))
        .step(StepEntry::new("two").release(["r", "s"]).remove(["2"]).place(["c"]))
        .step(StepEntry::new("three").plan("s", "2"))
        .silence(NoteCode::FrictionHigh);
    let file = SceneFile::from_json(&read.to_string()).expect("a scene file");
    assert_eq!(made, file);
    let same = |scene: &Scene| format!("{:?}", Analysis::new(scene).frames[2].contacts);
    let (built, read) = (made.build().expect("sound"), Scene::from_json(&read.to_string()).expect("sound"));
    assert_eq!(built.frames().len(), 3);
    assert_eq!(same(&built), same(&read));
}

#[test]
fn cells_and_their_grid_equal_those_of_a_file() {
    let made = Scene::builder()
        .grid(GridKind::Triangular, 2.0)
        .ground(GroundEntry::default().cells([CellEntry::Triangle(0.0, -1.0, CellHalf::Up)]))
        .block(BlockEntry::new("d").shape("down").at([0.0, 0.0]));
    let text = r#"{ "drystone": 1, "grid": { "kind": "triangular", "side": 2 }, "ground": [{ "cells": [[0, -1, "up"]] }],
        "blocks": [{ "id": "d", "shape": "down", "at": [0, 0] }] }"#;
    assert_eq!(Some(&made), SceneFile::from_json(text).ok().as_ref());
    assert!(made.build().expect("sound").exact());
}

/// The path, code, message and help of each problem, without line and column, in alphabetical order.
fn messages(problems: &[Problem]) -> Vec<String> {
    let mut messages: Vec<String> =
        (problems.iter()).map(|p| format!("{} {} {} {}", p.path, p.code, p.message, p.help)).collect();
    messages.sort();
    messages
}

#[test]
fn errors_in_code_are_reported_as_in_a_file() {
    let mut compared = 0;
    for case in REFERENCE.split("\n## ") {
        let text = case.split_once('\n').expect("a title").1;
        let text = text.split("\n--\n").next().expect("a scene");
        // A value of a wrong type cannot be written in code.
        let Ok(file) = SceneFile::from_json(text) else {
            continue;
        };
        let (read, made) = (Scene::from_json(text), Scene::new(file));
        let list = |scene: Result<Scene, drystone::scene::SceneError>| {
            scene.map_or_else(|problems| messages(&problems.list), |_| Vec::new())
        };
        let (read, made) = (list(read), list(made));
        assert_eq!(made, read, "{text}");
        compared += usize::from(!made.is_empty());
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn a_name_used_twice_in_code_is_reported_as_a_key_used_twice_in_a_file() {
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let problems = Scene::builder()
        .material("oak", MaterialEntry::default())
        .material("oak", MaterialEntry::default())
        .shape("s", triangle)
        .shape("s", triangle)
        .block(BlockEntry::new("a").polygon(triangle))
        .block(BlockEntry::new("b").polygon([[5.0, 0.0], [6.0, 0.0], [5.0, 1.0]]))
        .robot(RobotEntry::new("r"))
        .step(StepEntry::new("one").place(["a"]).hold("r", "a").hold("r", "a"))
        .step(StepEntry::new("two").plan("r", "b").plan("r", "b"))
        .build()
        .expect_err("refused");
    let found: Vec<(Code, &str)> = (problems.list.iter()).map(|p| (p.code, p.path.as_str())).collect();
    let at = ["materials.oak", "shapes.s", "steps[0].hold.r", "steps[1].plan.r"];
    assert_eq!(found, at.map(|path| (Code::DuplicateKey, path)));
}
