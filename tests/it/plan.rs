//! Orders of building: compared with a search over all states, and for structures of the thesis, an arch and a vault.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use drystone::analysis::{Analysis, Options, Verdict};
use drystone::scene::BodyId;
use drystone::scene::format::{SceneFile, StepEntry};
use drystone::session::{PlanError, plan};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::{arch, block, on_floor, rectangle, scene};

fn file(value: &Value) -> SceneFile {
    SceneFile::from_json(&value.to_string()).expect("a scene file")
}

fn stands(value: &Value) -> bool {
    Analysis::with(scene(value), &Options::default().verdict_only(true)).verdict() == Verdict::Stable
}

/// Plans a scene and checks every frame: one new block at a time, all blocks at the end, nothing held then, and every
/// frame stands.
#[track_caller]
fn built(value: &Value, robots: usize) -> SceneFile {
    let planned = plan(file(value), number(value, robots), &Options::default()).unwrap_or_else(|why| panic!("{why}"));
    assert_built(&planned, robots);
    planned
}

/// The number of robots for a scene that has none.
fn number(value: &Value, robots: usize) -> Option<usize> {
    value.get("robots").is_none().then_some(robots)
}

#[track_caller]
fn assert_built(planned: &SceneFile, robots: usize) {
    let scene = planned.clone().build().expect("a valid scene");
    let analysis = Analysis::with(&scene, &Options::default().verdict_only(true));
    let mut before = 0;
    for (frame, found) in scene.frames().iter().zip(&analysis.frames) {
        assert_eq!(found.verdict, Verdict::Stable, "{}", planned.to_json());
        assert!(frame.holds.len() <= robots && frame.placed.len() <= before + 1, "{}", planned.to_json());
        before = frame.placed.len();
    }
    let last = scene.frames().last().expect("a frame");
    assert!(last.holds.is_empty() && last.placed.len() == scene.blocks().len(), "{}", planned.to_json());
}

/// Searches all states of at most 12 blocks: a set of placed blocks, and the block that each robot holds. All placed
/// blocks are connected with the ground.
fn is_buildable(value: &Value) -> bool {
    let blocks = value["blocks"].as_array().expect("blocks").len() as u32;
    let robots = value["robots"].as_array().map_or(0, Vec::len);
    let full = (1_u32 << blocks) - 1;
    let state_stands = |placed: u32, held: &[u32]| {
        let mut state = value.clone();
        let names = |set: u32| (0..blocks).filter(move |k| set >> k & 1 == 1);
        let id = |k: u32| value["blocks"][k as usize]["id"].clone();
        let hold = |(robot, held): (usize, &u32)| {
            let name = value["robots"][robot]["id"].as_str().expect("an id").to_owned();
            names(*held).next().map(|k| (name, id(k)))
        };
        let holds: serde_json::Map<String, Value> = held.iter().enumerate().filter_map(hold).collect();
        state["steps"] = json!([{ "place": names(placed).map(id).collect::<Vec<_>>(), "hold": holds }]);
        stands(&state)
    };
    let contacts = Analysis::new(scene(value)).frames[0].contacts.clone();
    let bit = |body: BodyId| if let BodyId::Block(block) = body { 1_u32 << block.0 } else { 0 };
    let is_connected = |placed: u32| {
        let mut reached = 0;
        for _ in 0..blocks {
            for contact in &contacts {
                let [a, b] = contact.interface.bodies.map(bit);
                for (from, to) in [(a, b), (b, a)] {
                    if to & placed != 0 && (from == 0 || from & reached != 0) {
                        reached |= to;
                    }
                }
            }
        }
        reached == placed
    };
    let bits = || [0].into_iter().chain((0..blocks).map(|k| 1_u32 << k));
    let first = (0_u32, vec![0_u32; robots]);
    let mut open = vec![first.clone()];
    let mut seen = BTreeSet::from([first]);
    while let Some((placed, held)) = open.pop() {
        let mut next = Vec::new();
        // A step places at most one block, releases any blocks, and lets at most one robot take hold.
        for after in bits().map(|bit| placed | bit) {
            for set in 0..1_usize << robots {
                let kept: Vec<u32> = (0..robots).map(|robot| held[robot] * u32::from(set >> robot & 1 == 1)).collect();
                next.push((after, kept.clone()));
                let is_held = |bit: u32| kept.contains(&bit);
                for bit in bits().filter(|bit| after & bit != 0 && !is_held(*bit)) {
                    for robot in (0..robots).filter(|robot| kept[*robot] == 0) {
                        let mut taken = kept.clone();
                        taken[robot] = bit;
                        next.push((after, taken));
                    }
                }
            }
        }
        for state in next {
            if seen.insert(state.clone()) && is_connected(state.0) && state_stands(state.0, &state.1) {
                if state == (full, vec![0; robots]) {
                    return true;
                }
                open.push(state);
            }
        }
    }
    false
}

/// Two beams that only balance, each with two weights, or an arch.
fn small_structure(random: &mut Random, round: usize) -> Value {
    if round.is_multiple_of(3) {
        arch(3 + round % 5, random.between(0.2, 0.6), random.between(0.4, 0.8))
    } else {
        let mut blocks = vec![block("base", rectangle(0.0, 0.0, random.between(0.5, 2.0), 1.0), 2.0)];
        for (k, y) in [1.0, 3.0].into_iter().enumerate() {
            let (x, width) = (random.between(-2.0, 0.0), random.between(1.5, 4.0));
            blocks.push(block(&format!("beam{k}"), rectangle(x, y, width, 1.0), width));
            for (side, place) in [("left", -0.3), ("right", 0.8)] {
                let at = rectangle(x + place * width, y + 1.0, 0.5 * width, 1.0);
                blocks.push(block(&format!("{side}{k}"), at, random.between(0.5, 5.0)));
            }
        }
        blocks.truncate(4 + round % 4);
        on_floor(0.6, blocks)
    }
}

/// Gives a structure robots: equal ones without limits, or with limits that are equal or not.
fn with_robots(value: &Value, robots: usize, random: &mut Random, round: usize) -> Value {
    let mut value = value.clone();
    let force = random.between(0.5, 5.0);
    let own = |k: usize| match round % 4 {
        0 => json!({ "force": force }),
        1 => json!({ "force": force / (k + 1) as f64 }),
        _ => json!({}),
    };
    value["robots"] = (0..robots).map(|k| json!({ "id": format!("arm {k}"), "limits": own(k) })).collect();
    value
}

#[test]
fn an_order_is_found_exactly_if_a_search_over_all_states_finds_one() {
    let mut random = Random::new(4906);
    let mut counts = [[0; 2]; 3];
    for round in 0..120 {
        let value = small_structure(&mut random, round);
        if !stands(&value) {
            continue;
        }
        for (robots, count) in counts.iter_mut().enumerate() {
            let value = with_robots(&value, robots, &mut random, round);
            let expected = is_buildable(&value);
            match plan(file(&value), (robots == 0).then_some(0), &Options::default()) {
                Ok(planned) => assert_built(&planned, robots),
                Err(why) => assert!(!expected && matches!(why, PlanError::NoOrder(_)), "{why} for {value}"),
            }
            count[usize::from(expected)] += 1;
        }
    }
    assert!(counts.iter().flatten().all(|count| *count >= 1), "{counts:?}");
}

#[test]
fn twelve_blocks_agree_with_a_search_over_all_states() {
    // Two towers of five bricks, each of which leans over, with a lintel and a weight: the towers stand alone, the
    // overhanging lintel only with its weight.
    let mut blocks = Vec::new();
    for row in 0..5 {
        for (side, x) in [("w", 0.0), ("e", 4.0)] {
            blocks.push(block(&format!("{side}{row}"), rectangle(x, f64::from(row), 1.0, 1.0), 1.0));
        }
    }
    blocks.push(block("beam", rectangle(3.5, 5.0, 4.0, 1.0), 4.0));
    blocks.push(block("weight", rectangle(3.5, 6.0, 1.0, 1.0), 9.0));
    let value = on_floor(0.7, blocks);
    assert!(!is_buildable(&value));
    let refused = plan(file(&value), Some(0), &Options::default()).expect_err("nothing holds the beam");
    let why = refused.to_string();
    assert!(matches!(refused, PlanError::NoOrder(_)) && why.contains("left 7 of 12 (e0, e1,"), "{why}");
    built(&value, 1);
}

#[test]
fn an_arch_needs_a_robot() {
    let value = arch(7, 0.25, 0.7);
    assert!(stands(&value));
    let planned = built(&value, 2);
    assert_eq!(planned.steps.last().map(|step| step.place.len()), Some(0), "the last step only releases");
    built(&value, 1);
    let refused = plan(file(&value), Some(0), &Options::default()).expect_err("it falls before it is closed");
    assert!(matches!(refused, PlanError::NoOrder(_)), "{refused}");
}

#[test]
fn structures_of_the_thesis_an_arch_and_a_vault_are_built() {
    built(&arch(15, 0.25, 0.7), 2);
    for (path, robots) in [
        ("assets/thesis/figure-3b.json", 2),
        ("assets/thesis/figure-4.json", 2),
        ("assets/thesis/figure-8-left.json", 2),
        ("assets/gallery/corbelled-vault.json", 1),
    ] {
        built(&read(path), robots);
    }
    let refused = plan(file(&read("assets/thesis/figure-9a.json")), None, &Options::default()).expect_err("it falls");
    let why = refused.to_string();
    assert!(why.starts_with("the finished structure falls without robots, and block "), "{why}");
}

fn read(path: &str) -> Value {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a scene");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn the_program_writes_steps_that_stand_and_says_why_there_are_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, output) = (folder.path().join("arch.json"), folder.path().join("steps.json"));
    fs::write(&path, arch(5, 0.3, 0.7).to_string()).expect("written");
    let run = |options: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let ran = command.args(options).output().expect("it runs");
        let texts = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        (ran.status.code(), texts.concat())
    };
    let (path, output) = (path.display().to_string(), output.display().to_string());
    let (code, said) = run(&["plan", &path, "--robots", "2", "-o", &output]);
    assert!(code == Some(0) && said.contains("render") && said.contains("--kind build"), "{code:?} {said}");
    let (code, said) = run(&["check", &output]);
    assert_eq!(code, Some(0), "{said}");
    let written = fs::read_to_string(&output).expect("written");
    let again = scene(&serde_json::from_str(&written).expect("JSON"));
    assert!(again.frames().len() >= 5);
    let (code, said) = run(&["plan", &path, "--robots", "0"]);
    assert!(code == Some(1) && said.contains("no order exists"), "{code:?} {said}");
    let (code, said) = run(&["plan", &path, "--robots", "2", "-o", &output]);
    assert!(code == Some(4) && said.contains("--force"), "{code:?} {said}");
    let (code, said) = run(&["plan", &path, "--robots", "2", "--time-limit", "0.000001"]);
    assert_eq!(code, Some(3), "{said}");
    // The plan is the same every time.
    let (_, printed) = run(&["plan", &path, "--robots", "2"]);
    assert_eq!(printed, written);
}

#[test]
fn one_robot_that_releases_and_holds_in_one_step_closes_an_arch_of_four() {
    let value = arch(4, 0.167, 0.5);
    let planned = built(&value, 1);
    let regrips = |step: &StepEntry| {
        let step = serde_json::to_value(step).expect("JSON");
        step.get("release").is_some() && step.get("hold").is_some()
    };
    assert!(planned.steps.iter().any(regrips), "{}", planned.to_json());
}

#[test]
fn the_robots_of_the_scene_keep_their_ids_and_limits() {
    let mut value = arch(5, 0.3, 0.7);
    value["robots"] = json!([{ "id": "left arm", "limits": { "force": 8000 }, "holds": "v0" },
        { "id": "right arm", "limits": { "force": 3000 } }]);
    let planned = plan(file(&value), None, &Options::default()).expect("an order");
    let ids: Vec<_> = planned.robots.iter().filter_map(|robot| robot.id.as_deref()).collect();
    assert_eq!(ids, ["left arm", "right arm"]);
    assert_eq!(planned.robots[1].limits, file(&value).robots[1].limits);
    assert_built(&planned, 2);
    let refused = plan(file(&value), Some(2), &Options::default()).expect_err("it has robots");
    assert!(refused.to_string().contains("its own robots (left arm, right arm)"), "{refused}");
    // A limit that is too small leaves no order.
    for robot in [0, 1] {
        value["robots"][robot]["limits"]["force"] = json!(1e-6);
    }
    assert!(matches!(plan(file(&value), None, &Options::default()), Err(PlanError::NoOrder(_))));
}
