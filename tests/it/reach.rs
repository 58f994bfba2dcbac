//! What reaches a target: sums by hand, and verdicts on changed scenes.

use std::fs;
use std::path::Path;
use std::process::Command;

use drystone::analysis::{Change, ChangeKind, MarginKind, Options, Reach, Reached, Verdict};
use drystone::scene::Vector;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::{arch, block, on_floor, rectangle, scene, tilted};

fn reached(file: &Value, kind: MarginKind, value: f64) -> Reached {
    let options = Options::default().reach(Reach { kind, value });
    let mut analysis = Analysis::with(scene(file), &options);
    let frame = analysis.frames.pop().expect("a frame");
    assert!(frame.notices.iter().all(|notice| !notice.contains("reach")), "{:?}", frame.notices);
    frame.reach.clone().expect("it was requested")
}

#[track_caller]
fn change(found: &Reached, what: ChangeKind) -> &Change {
    found.changes.iter().find(|change| change.what == what).unwrap_or_else(|| panic!("no {what:?} in {found:?}"))
}

/// Compares an amount that is rounded up to three digits with the exact one.
#[track_caller]
fn compare(found: &Reached, what: ChangeKind, exact: f64) {
    let least = change(found, what).least.unwrap_or_else(|| panic!("no {what:?} suffices: {found:?}"));
    assert!(exact <= least * (1.0 + 1e-9) && least <= exact * 1.01, "{what:?}: {least}, not {exact}");
}

/// A block of 60 N, 3 m wide and 2 m high, with a push to the right at the height `y`.
fn pushed(force: f64, y: f64, friction: f64) -> Value {
    let mut file = on_floor(friction, vec![block("a", rectangle(0.0, 0.0, 3.0, 2.0), 60.0)]);
    file["loads"] = json!([{ "block": "a", "force": [force, 0.0], "at": [0.0, y] }]);
    file
}

#[test]
fn a_block_on_a_floor_agrees_with_sums_by_hand() {
    // With twice its push of 20 N, it slides.
    let found = reached(&pushed(20.0, 0.5, 0.5), MarginKind::LoadFactor, 2.0);
    assert_eq!(found.verdict, Verdict::Unstable);
    compare(&found, ChangeKind::Friction, 40.0 / 60.0);
    compare(&found, ChangeKind::Weight, 40.0 / 0.5 - 60.0);
    compare(&found, ChangeKind::Hold, (40.0 - 0.5 * 60.0) / 1.25_f64.sqrt());
    assert_eq!(found.changes.len(), 3, "{found:?}");
    // Pushed at its top, it overturns, whatever the friction.
    let found = reached(&pushed(30.0, 2.0, 0.8), MarginKind::LoadFactor, 2.0);
    let friction = change(&found, ChangeKind::Friction);
    assert!(friction.least.is_none() && friction.mechanism[0].spin < 0.0, "{friction:?}");
    compare(&found, ChangeKind::Weight, 60.0 * 2.0 / 1.5 - 60.0);
    // The hold acts across the line from the corner to the centroid.
    compare(&found, ChangeKind::Hold, (60.0 * 2.0 - 60.0 * 1.5) / libm::hypot(1.5, 1.0));
    // Weight does not help against a tilt, in either direction.
    let alone = on_floor(0.5, vec![block("a", rectangle(0.0, 0.0, 3.0, 2.0), 60.0)]);
    let tilt = reached(&alone, MarginKind::Tilt, 30.0);
    compare(&tilt, ChangeKind::Friction, libm::tan(30.0_f64.to_radians()));
    let weight = change(&tilt, ChangeKind::Weight);
    assert!(weight.least.is_none() && weight.mechanism.len() == 1, "{weight:?}");
    compare(&reached(&alone, MarginKind::HorizontalLoad, 0.7), ChangeKind::Friction, 0.7);
    let stands = reached(&alone, MarginKind::Tilt, 20.0);
    assert!(stands.verdict == Verdict::Stable && stands.changes.is_empty(), "{stands:?}");
    // The governing case decides; the factor of a case acts on the added weight too.
    let mut cases = pushed(20.0, 0.5, 0.5);
    cases["loads"][0]["id"] = json!("push");
    cases["cases"] = json!([{ "id": "light", "weights": 0.8 }, { "id": "plain" }]);
    compare(&reached(&cases, MarginKind::LoadFactor, 2.0), ChangeKind::Weight, 80.0 / 0.8 - 60.0);
}

/// True if a scene stands as it is, and also when it is tilted by this angle to the left and to the right.
fn stands(file: &Value, degrees: f64) -> bool {
    let verdict = |angle: f64| Analysis::new(scene(&tilted(file.clone(), angle))).verdict();
    [0.0, degrees, -degrees].into_iter().all(|angle| verdict(angle) == Verdict::Stable)
}

/// An arch with more loads, given as blocks and forces.
fn with_loads(file: &Value, loads: &[(usize, Vector)]) -> Value {
    let blocks = scene(file).blocks().to_vec();
    let load = |(block, force): &(usize, Vector)| {
        let at = blocks[*block].centroid;
        json!({ "block": format!("v{block}"), "force": [force.x, force.y], "at": [at.x, at.y], "fixed": true })
    };
    let mut file = file.clone();
    let more: Vec<Value> = loads.iter().map(load).collect();
    file["loads"] = file["loads"].as_array().into_iter().flatten().cloned().chain(more).collect();
    file
}

/// The forces of a tie or a prop between two blocks.
fn connection(file: &Value, change: &Change) -> Vec<(usize, Vector)> {
    let [a, b] = [change.blocks[0].0, change.blocks[1].0];
    let blocks = scene(file).blocks().to_vec();
    let along = (blocks[b].centroid - blocks[a].centroid).normalize();
    let along = if change.what == ChangeKind::Tie { along } else { -along };
    vec![(a, along), (b, -along)]
}

fn scaled(forces: &[(usize, Vector)], amount: f64) -> Vec<(usize, Vector)> {
    forces.iter().map(|(block, force)| (*block, force * amount)).collect()
}

#[test]
fn an_arch_stands_at_the_target_with_each_amount_and_falls_with_less() {
    // Tilted to both sides.
    let (thickness, degrees) = (0.2, 20.0);
    let file = arch(11, thickness, 0.9);
    let found = reached(&file, MarginKind::Tilt, degrees);
    assert!(!stands(&file, degrees) && found.verdict == Verdict::Unstable);
    let factor = change(&found, ChangeKind::Thickness).least.expect("a factor");
    assert!(stands(&arch(11, thickness * factor, 0.9), degrees));
    assert!(!stands(&arch(11, thickness * (factor - 0.01), 0.9), degrees));
    assert!(change(&found, ChangeKind::Friction).least.is_none());
    let tie = change(&found, ChangeKind::Tie);
    let with_tie = |force: f64| {
        let tied = with_loads(&file, &scaled(&connection(&file, tie), force));
        [degrees, -degrees].map(|angle| Analysis::new(scene(&tilted(tied.clone(), angle))).verdict())
    };
    let least = tie.least.expect("a force");
    assert!(
        with_tie(0.98 * least).contains(&Verdict::Unstable) && with_tie(least).contains(&Verdict::Stable),
        "{tie:?}"
    );
    // With a load at its quarter.
    let loaded = with_loads(&file, &[(2, Vector::new(0.0, -500.0))]);
    let mut file = loaded.clone();
    file["loads"][0]["fixed"] = json!(false);
    let factor = 20.0;
    let at_target = with_loads(&loaded, &[(2, Vector::new(0.0, -500.0 * (factor - 1.0)))]);
    let falls = |file: &Value| Analysis::new(scene(file)).verdict() == Verdict::Unstable;
    assert!(!falls(&loaded) && falls(&at_target));
    let found = reached(&file, MarginKind::LoadFactor, factor);
    for change in found.changes.iter().filter(|change| change.least.is_some()) {
        let forces = match change.what {
            ChangeKind::Weight => vec![(change.blocks[0].0, Vector::new(0.0, -1.0))],
            ChangeKind::Tie | ChangeKind::Prop => connection(&file, change),
            _ => continue,
        };
        let least = change.least.expect("an amount");
        assert!(falls(&with_loads(&at_target, &scaled(&forces, 0.98 * least))), "{change:?}");
        assert!(!falls(&with_loads(&at_target, &scaled(&forces, least))), "{change:?}");
        assert!(change.what != ChangeKind::Weight || !falls(&with_loads(&loaded, &scaled(&forces, least))));
    }
    assert!(change(&found, ChangeKind::Weight).least.is_some(), "{found:?}");
}

#[test]
fn the_story_of_the_wall_has_the_numbers_of_the_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("src/doc/questions.md")).expect("the page");
    let scene = root.join("assets/questions/retaining-wall.json");
    let run = |options: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let ran = command.arg("check").arg(&scene).args(options).output().expect("it runs");
        String::from_utf8_lossy(&ran.stdout).into_owned()
    };
    let said = run(&["--reach", "load_factor=4"]);
    let lines: Vec<&str> = said.lines().skip_while(|line| !line.contains("reach: ")).map(str::trim).collect();
    let lines: Vec<&str> = lines.into_iter().take_while(|line| !line.is_empty() && !line.starts_with("note")).collect();
    assert!(lines.len() >= 4, "{said}");
    for line in &lines {
        assert!(page.contains(line), "the page lacks: {line}\n{said}");
    }
    let json: Value = serde_json::from_str(&run(&["--reach", "load_factor=4", "--json", "--no-timing"])).expect("JSON");
    let reach = &json["frames"][0]["reach"];
    assert!(reach["margin"] == "load_factor" && reach["target"] == 4.0 && reach["stands"] == false, "{reach}");
    assert_eq!(reach["changes"].as_array().map(Vec::len), Some(lines.len() - 1), "{reach}");
    assert!(Scene::from_json(&fs::read_to_string(&scene).expect("a scene")).is_ok());
}
