//! The placement tolerance: values that another program computed, values by hand, and moved structures.

use std::fs;
use std::path::Path;
use std::process::Command;

use drystone::analysis::{Options, Placement, PlacementLimit, Verdict};
use drystone::internals::chart::Point;
use drystone::result::{Layout, Timing, to_json};
use drystone::starter::{Doorway, Tower};
use drystone::{Analysis, Scene};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::oracle::balance::Balance;
use crate::oracle::{number_of, random, touch};
use crate::peers::growth::{Growth, GrowthLine, growth};
use crate::random::Random;
use crate::structure::{block, on_floor, rectangle, scene};

/// The placement tolerance of the last frame of a scene.
#[track_caller]
fn tolerance(scene: Scene) -> Placement {
    let mut analysis = Analysis::with(scene, &Options::default().placement(true));
    let last = analysis.frames.pop().expect("a frame");
    last.placement.clone().unwrap_or_else(|| panic!("no tolerance of a frame that is {}", last.verdict))
}

fn project_scene(path: &str) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    Scene::from_json(&fs::read_to_string(file).expect("a scene")).expect("a valid scene")
}

/// Compares a tolerance with values in millimetres: the proved one, and the largest error at which the structure is
/// known to fall.
#[track_caller]
fn compare(name: &str, found: &Placement, proved: f64, falls_at: f64) {
    let off = (1e3 * found.proved - proved).abs();
    assert!(off <= 1e-4 * proved, "{name}: {} mm instead of {proved} mm", 1e3 * found.proved);
    let at = 1e3 * found.falls_at.unwrap_or_else(|| panic!("{name} falls at no error"));
    assert!(at >= 1e3 * found.proved * (1.0 - 1e-9), "{name}: falls at {at} mm, before the proved {proved} mm");
    assert!(at <= falls_at * (1.0 + 1e-4), "{name}: falls at {at} mm instead of {falls_at} mm");
}

#[test]
fn tolerances_agree_with_a_dense_program_of_another_solver() {
    let starter = |text: String| Scene::from_json(&text).expect("a starter");
    let scenes = [
        ("new", project_scene("assets/starter.json"), 69.826, 69.826),
        ("new tower", starter(Tower::default().scene().to_json()), 50.0, 50.0),
        ("new doorway", starter(Doorway::default().scene().to_json()), 122.149, 125.234),
        ("arch13", project_scene("tests/scenes/arch13.json"), 192.203, 192.203),
        ("archload", project_scene("tests/scenes/archload.json"), 77.975, 82.306),
        ("loaded", project_scene("tests/scenes/loaded.json"), 125.842, 125.842),
        ("lintel", project_scene("tests/scenes/lintel.json"), 360.451, 369.565),
        ("Figure 6 without a kernel", project_scene("assets/thesis/figure-6-kernel-0.json"), 62.5, 62.5),
        ("Figure 8, left", project_scene("assets/thesis/figure-8-left.json"), 16.487, 16.487),
        ("corbelled vault", project_scene("assets/gallery/corbelled-vault.json"), 81.597, 81.597),
        ("flying buttress", project_scene("assets/gallery/flying-buttress.json"), 31.509, 34.434),
    ];
    for (name, scene, proved, falls_at) in scenes {
        compare(name, &tolerance(scene), proved, falls_at);
    }
}

/// A pillar 1 m wide with a slab on it, and a load on the slab beside the axis of the pillar.
fn loaded_pillar() -> Value {
    let mut file = on_floor(
        0.7,
        vec![
            block("pillar", rectangle(0.0, 0.0, 1.0, 2.0), 1000.0),
            block("slab", rectangle(-0.5, 2.0, 2.0, 0.2), 1.0),
        ],
    );
    file["loads"] = json!([{ "block": "slab", "force": [0, -10], "at": [0.95, 2.2] }]);
    file
}

#[test]
fn a_load_is_off_its_place_like_the_block_it_acts_on() {
    // The slab with its load of 10 at 0.45 m from the axis: (10 (0.45 + d) + d) / 11 = 0.5 - d.
    let expected = 1e3 * (0.5 - 4.5 / 11.0) / 2.0;
    compare("pillar", &tolerance(scene(&loaded_pillar())), expected, expected);
}

#[test]
fn a_block_that_is_in_its_place_leaves_room_for_the_others() {
    // A block on the ground has half its width of 1 m between itself and its joint: 0.5 - d = d.
    let mut file = on_floor(0.7, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0)]);
    let found = tolerance(scene(&file));
    compare("block", &found, 250.0, 250.0);
    assert!((found.blocks[0].proved - 0.25).abs() < 1e-5, "{:?}", found.blocks);
    // With twice the error of the others, it may be off half as much.
    file["blocks"][0]["placement"] = json!(2);
    compare("block", &tolerance(scene(&file)), 125.0, 125.0);
    file["blocks"][0]["placement"] = json!(0);
    let frame = Analysis::with(scene(&file), &Options::default().placement(true)).frames.remove(0);
    assert_eq!(frame.placement, None, "no block is off its place");
    // The upper of two blocks leans over the lower one: its joint may lose 0.2 m at each end, and no more.
    let blocks = vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0), block("b", rectangle(0.3, 1.0, 1.0, 1.0), 5.0)];
    let mut pile = on_floor(0.7, blocks);
    pile["blocks"][1]["placement"] = json!(0);
    compare("pile", &tolerance(scene(&pile)), 200.0, 200.0);
}

#[test]
fn blocks_without_friction_have_a_tolerance() {
    let one = on_floor(0.0, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0)]);
    compare("block", &tolerance(scene(&one)), 250.0, 250.0);
}

#[test]
fn the_command_line_names_the_blocks_that_are_off_their_places() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("pile.json");
    let pile = on_floor(
        0.7,
        vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0), block("b", rectangle(0.3, 1.0, 1.0, 1.0), 5.0)],
    );
    fs::write(&file, pile.to_string()).expect("written");
    let run = |options: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let output = command.arg("check").arg(&file).args(options).output().expect("the program runs");
        let texts = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        (output.status.code(), texts.concat())
    };
    let (code, all) = run(&["--placement"]);
    assert_eq!(code, Some(0), "{all}");
    assert!(all.contains("placement: stands for all errors up to ") && all.contains("; falls with a pattern"), "{all}");
    let (code, one) = run(&["--placement", "--placed", "a"]);
    assert!(code == Some(0) && one.contains("placement: stands") && one != all, "{one}");
    // Reports and figures state the same number.
    let tolerance = all.split("up to ").nth(1).and_then(|rest| rest.split(" (").next()).expect("a length").to_owned();
    for (what, name) in [("report", "out.md"), ("render", "out.svg")] {
        let output = folder.path().join(name);
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let status = command.arg(what).arg(&file).arg("--placement").arg("-o").arg(&output).status().expect("it runs");
        let text = fs::read_to_string(&output).expect("written").replace('\u{a0}', " ");
        assert!(status.success() && text.contains(&format!("for all errors up to {tolerance}")), "{name}: {tolerance}");
        let row = text.lines().find(|line| line.contains("| placement tolerance |"));
        assert!(what == "render" || row.is_some_and(|row| row.contains(&tolerance) && row.contains('█')), "{row:?}");
    }
    let (code, wrong) = run(&["--placement", "--placed", "b,c"]);
    assert!(code == Some(2) && wrong.contains("there is no block c"), "{wrong}");
    let (code, alone) = run(&["--placed", "b"]);
    assert!(code == Some(2) && alone.contains("--placement"), "{alone}");
}

#[test]
fn contacts_at_one_point_leave_no_room() {
    let mut file = on_floor(0.7, vec![block("a", json!([[0, 1], [1, 0], [2, 1], [1, 2]]), 5.0)]);
    file["corner_contacts"] = json!(true);
    let analysis = Analysis::with(scene(&file), &Options::default().placement(true));
    let found = analysis.frames[0].placement.as_ref().expect("a square stands on its corner");
    assert_eq!((found.proved, found.limited_by), (0.0, PlacementLimit::PointContact));
}

#[test]
fn a_frame_that_falls_has_no_tolerance() {
    let file = on_floor(0.7, vec![block("a", rectangle(0.0, 1.0, 1.0, 1.0), 5.0)]);
    let frame = Analysis::with(scene(&file), &Options::default().placement(true)).frames.remove(0);
    assert_eq!((frame.verdict, frame.placement.as_ref()), (Verdict::Unstable, None));
}

/// A pile of two to eight blocks with level joints, of random sizes and units.
fn pile(random: &mut Random) -> Value {
    let unit = [0.01, 0.1, 1.0, 10.0, 100.0][random.below(5)];
    let count = 2 + (random.between(0.0, 7.0) as usize);
    let (mut left, mut bottom, mut blocks) = (0.0, 0.0, Vec::new());
    for number in 0..count {
        let (width, height) = (random.between(1.0, 3.0), random.between(0.3, 1.0));
        let places: Vec<f64> = [left, bottom, width, height].iter().map(|x| x * unit).collect();
        blocks.push(block(
            &format!("b{number}"),
            rectangle(places[0], places[1], places[2], places[3]),
            random.between(1.0, 9.0),
        ));
        left += random.between(-0.3, 0.3);
        bottom += height;
    }
    on_floor(random.between(0.3, 0.9), blocks)
}

#[test]
fn moved_piles_stand_within_their_tolerance() {
    let mut random = Random::new(46);
    let mut fallen_beyond = 0;
    let mut checked = 0;
    for _ in 0..40 {
        let file = pile(&mut random);
        let start = scene(&file);
        let analysis = Analysis::with(start, &Options::default().placement(true));
        let Some(found) = &analysis.frames[0].placement else { continue };
        checked += 1;
        if let Some(at) = found.falls_at {
            assert!(found.proved <= at, "{found:?}");
            assert!(at - found.proved <= 1e-4 * at, "the joints of a pile leave no gap: {found:?}");
        }
        for share in [0.99, 0.99, 0.99, 0.99, 1.3, 1.3] {
            let mut moved = file.clone();
            for body in moved["blocks"].as_array_mut().expect("blocks") {
                let side = if random.percent(50) { -1.0 } else { 1.0 };
                for corner in body["polygon"].as_array_mut().expect("corners") {
                    corner[0] = json!(corner[0].as_f64().expect("a number") + side * share * found.proved);
                }
            }
            let verdict = Analysis::new(scene(&moved)).verdict();
            if share < 1.0 {
                assert_eq!(verdict, Verdict::Stable, "{moved} within {}", found.proved);
            } else if verdict == Verdict::Unstable {
                fallen_beyond += 1;
            }
        }
    }
    assert!(checked >= 20 && fallen_beyond >= 5, "{checked} checked, {fallen_beyond} fell beyond");
}

/// A pile moved as `pattern` says, times `share`.
fn moved_as(file: &Value, found: &Placement, share: f64) -> Scene {
    let mut moved = file.clone();
    for (body, error) in moved["blocks"].as_array_mut().expect("blocks").iter_mut().zip(&found.pattern) {
        for corner in body["polygon"].as_array_mut().expect("corners") {
            corner[0] = json!(corner[0].as_f64().expect("a number") + share * error.offset.x);
        }
    }
    scene(&moved)
}

#[test]
fn patterns_fall_and_their_opposites_within_the_tolerance_stand() {
    // Two blocks, the upper one off to the right: moved blocks fall before the model does only if both ends of a joint
    // move, so here they fall exactly at the pattern.
    let file = on_floor(
        0.7,
        vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0), block("b", rectangle(0.3, 1.0, 1.0, 1.0), 5.0)],
    );
    let found = tolerance(scene(&file));
    assert!(found.pattern.iter().all(|error| error.offset.y == 0.0), "gravity points down: {found:?}");
    for share in [0.98, -0.98] {
        let verdict =
            Analysis::new(moved_as(&file, &found, share * found.proved / found.falls_at.expect("it falls"))).verdict();
        assert_eq!(verdict, Verdict::Stable, "{share}");
    }
    assert!(!found.mechanism.is_empty() && found.block.is_some() && found.joint.is_some());
}

#[test]
fn the_json_contains_the_tolerance_that_was_found() {
    let file = on_floor(0.7, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0)]);
    let analysis = Analysis::with(scene(&file), &Options::default().placement(true));
    let found = analysis.frames[0].placement.as_ref().expect("a tolerance");
    let json: Value = serde_json::from_str(&to_json(&analysis, Timing::LeftOut, Layout::OneLine)).expect("JSON");
    let written = &json["frames"][0]["placement"];
    assert_eq!(written["proved"], json!(found.proved));
    assert_eq!(written["falls_at"], json!(found.falls_at));
    assert_eq!(written["limited_by"], "balance");
    assert_eq!((&written["block"], &written["joint"]), (&json!("a"), &json!(0)));
    assert_eq!(written["pattern"][0]["block"], "a");
    assert_eq!(written["pattern"][0]["offset"][0], json!(found.pattern[0].offset.x));
    assert_eq!(written["blocks"][0]["proved"], json!(found.blocks[0].proved));
    assert_eq!(written["mechanism"][0]["block"], "a");
}

#[test]
fn robots_hold_with_their_limits() {
    // A cantilever that a robot holds: the tolerance grows with the force that the robot may exert.
    let held = |force: f64| {
        let mut file = on_floor(
            0.7,
            vec![
                block("post", rectangle(0.0, 0.0, 1.0, 1.0), 20.0),
                block("beam", rectangle(0.2, 1.0, 2.0, 0.3), 10.0),
            ],
        );
        file["robots"] =
            json!([{ "id": "r", "holds": "beam", "at": [2, 1.1], "limits": { "fx": 0, "fy": force, "torque": 0 } }]);
        tolerance(scene(&file)).proved
    };
    let [weak, strong] = [3.0, 6.0].map(held);
    assert!(weak > 0.0 && strong > weak, "{weak} {strong}");
}

/// A block that only a robot holds, beside a block on the ground: the robot must exert the torque of its error.
#[test]
fn a_robot_alone_holds_an_error_with_its_torque() {
    let held = |limits: Value| {
        let blocks =
            vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 5.0), block("b", rectangle(3.0, 2.0, 1.0, 1.0), 10.0)];
        let mut file = on_floor(0.7, blocks);
        file["robots"] = json!([{ "id": "r", "holds": "b", "limits": limits }]);
        tolerance(scene(&file))
    };
    // Without torque there is no room, with 0.6 N·m the block of 10 N may be off by 0.06 m.
    assert_eq!(held(json!({})).proved, 0.0);
    let torque = held(json!({ "torque": 0.6 }));
    compare("held", &torque, 60.0, 60.0);
    assert!((torque.blocks[1].proved - 0.06).abs() < 1e-6, "{:?}", torque.blocks);
    compare("on the ground", &held(json!({ "torque": 600 })), 250.0, 250.0);
}

/// The scene in which the centre of gravity of each block is off by its offset, metres, to the right, its loads to the
/// side that turns it the same way: as torques, because all gravity points down.
fn off_as(file: &Value, start: &Scene, offsets: &[f64]) -> Scene {
    let mut moved = file.clone();
    let mut loads = moved["loads"].as_array().cloned().unwrap_or_default();
    for (number, (block, offset)) in start.blocks().iter().zip(offsets).enumerate() {
        let own = start.loads().iter().filter(|load| load.block.0 == number);
        let size = block.weight + own.map(|load| load.force.norm()).sum::<f64>();
        let at = [block.centroid.x, block.centroid.y];
        loads.push(json!({ "block": block.id, "force": [0, 0], "at": at, "torque": -offset * size }));
    }
    moved["loads"] = json!(loads);
    scene(&moved)
}

/// Whether exact forces balance the scene if the ends of all joints are `inward` metres inside their places.
fn stands_exactly(moved: &Scene, inward: f64) -> bool {
    let mut touches = touch::as_found(moved);
    for touch in &mut touches {
        let [first, last] = touch.ends.clone();
        let along = touch::minus(&last, &first);
        let share = touch::exact(inward / touch::dot(&along, &along).to_f64_fast().sqrt());
        let step = along.map(|v| v * &share);
        touch.ends = [[&first[0] + &step[0], &first[1] + &step[1]], touch::minus(&last, &step)];
    }
    Balance::groups(moved, &touches).iter().all(Balance::stands)
}

/// Walls, stacks, lattices and arches with robots and loads, by an exact program that shares no code with the search: all
/// patterns within the proved tolerance stand, and the pattern of `falls_at` falls. `DRYSTONE_PLACEMENTS` sets the number
/// of scenes, and `DRYSTONE_PLACEMENT_PATTERNS` sets the number of random patterns for each scene.
#[test]
fn exact_programs_confirm_tolerances_of_random_scenes() {
    let count = number_of("DRYSTONE_PLACEMENTS", 24);
    let patterns = number_of("DRYSTONE_PLACEMENT_PATTERNS", 6) as usize;
    let judge = |number: u64| {
        let (_, mut file) = random::scene(number);
        file["kernel"] = json!(0);
        file.as_object_mut().expect("a scene").remove("gravity");
        let start = Scene::from_json(&file.to_string()).ok().filter(|scene| scene.blocks().len() <= 9)?;
        let analysis = Analysis::with(&start, &Options::default().placement(true));
        let found = analysis.frames[0].placement.clone().filter(|found| found.proved > 0.0)?;
        let mut offsets = vec![0.0; start.blocks().len()];
        found.pattern.iter().for_each(|error| offsets[error.block.0] = error.offset.x);
        if let Some(at) = found.falls_at {
            let beyond: Vec<f64> = offsets.iter().map(|offset| offset * 1.001).collect();
            let falls = !stands_exactly(&off_as(&file, &start, &beyond), at * 1.001);
            assert!(falls, "scene {number} stands beyond {at}: {file}");
        }
        // Random patterns, and the pattern that falls with one block changed or none.
        let mut random = Random::new(number);
        let within = found.proved * 0.999;
        for pattern in 0..patterns + offsets.len() {
            let sign = |block: usize, offset: f64| match pattern.checked_sub(patterns) {
                Some(changed) => {
                    if (offset < 0.0) == (changed == block) {
                        within
                    } else {
                        -within
                    }
                }
                None => within,
            };
            let mut errors: Vec<f64> = offsets.iter().enumerate().map(|(block, offset)| sign(block, *offset)).collect();
            if pattern < patterns {
                errors.iter_mut().for_each(|error| *error *= if random.percent(50) { 1.0 } else { -1.0 });
            }
            let stands = stands_exactly(&off_as(&file, &start, &errors), within);
            assert!(stands, "scene {number} falls within {}: {errors:?} {file}", found.proved);
        }
        Some(found.falls_at.map_or(0.0, |at| 1.0 - found.proved / at))
    };
    let gaps: Vec<f64> = (0..count).into_par_iter().filter_map(judge).collect();
    let wide = gaps.iter().filter(|gap| **gap > 0.1).count();
    assert!(gaps.len() as u64 * 5 > count && wide * 10 <= gaps.len(), "{wide} of {} gaps are wide", gaps.len());
}

/// `UPDATE_SNAPSHOTS=1` draws the picture again.
#[test]
fn the_picture_of_the_cost_shows_the_table_of_the_page() {
    let mut lines: Vec<GrowthLine> = Vec::new();
    for row in include_str!("../../src/doc/placement.md").lines() {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let [name, numbers @ ..] = &cells[..] else { continue };
        let numbers: Vec<f64> = numbers.iter().filter_map(|cell| cell.parse().ok()).collect();
        let [blocks, alone, with, ratio] = numbers[..] else { continue };
        assert!((with / alone / ratio - 1.0).abs() < 0.05, "{row}");
        let point = Point { x: blocks, y: ratio, wrong: false };
        match lines.iter_mut().find(|line| line.name == *name) {
            Some(line) => line.points.push(point),
            None => lines.push(GrowthLine { name: (*name).to_owned(), is_highlighted: true, points: vec![point] }),
        }
    }
    assert_eq!(lines.iter().map(|line| line.points.len()).collect::<Vec<_>>(), [6, 6, 6]);
    let chart = Growth {
        title: "What the placement tolerance costs".into(),
        x: "blocks".into(),
        y: "processor time, in multiples of that of check alone".into(),
        lines,
        wrong: String::new(),
    };
    let drawn = growth(&chart).expect("drawn");
    let shown = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/placement-cost.svg");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        fs::write(&shown, &drawn).expect("writable");
    }
    let kept = fs::read_to_string(&shown).expect("in the repository");
    assert!(kept == drawn, "the picture differs from the table: inspect it, and run once with UPDATE_SNAPSHOTS=1");
}
