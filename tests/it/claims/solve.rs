//! The statements about how a result was found: groups, programs, iterations, methods and times.

use std::time::Instant;

use drystone::Analysis;
use drystone::analysis::{MarginKinds, Options};
use drystone::internals::solve::{Conditioning, balance};
use drystone::result::{Layout, Timing, to_json};
use serde_json::{Value, json};

use super::{Checked, check, list, number, structures};
use crate::falls::program;
use crate::structure::{arch, block, on_floor, on_slope, rectangle, scene};

fn count(value: &Value) -> u64 {
    value.as_u64().expect("a whole number")
}

/// The number of groups of blocks that touch each other, directly or through other blocks, from the interfaces of a
/// result.
fn groups_of(checked: &Checked) -> u64 {
    let scene = scene(&checked.file);
    let blocks: Vec<&str> = scene.blocks().iter().map(|b| b.id.as_str()).collect();
    let mut group: Vec<usize> = (0..blocks.len()).collect();
    let place = |name: &Value| blocks.iter().position(|id| Some(*id) == name.as_str());
    for interface in list(&checked.json["frames"][0]["interfaces"]) {
        let [a, b] = [0, 1].map(|k| place(&interface["bodies"][k]));
        if let (Some(a), Some(b)) = (a, b) {
            let (old, new) = (group[a], group[b]);
            for member in &mut group {
                if *member == old {
                    *member = new;
                }
            }
        }
    }
    group.sort_unstable();
    group.dedup();
    group.len() as u64
}

/// The number of groups in a result agrees with its interfaces. Without a program there are no iterations.
#[test]
fn groups_are_those_of_the_listed_interfaces() {
    let (mut several, mut solved) = (0, 0);
    for checked in structures() {
        let solve = &checked.json["frames"][0]["solve"];
        let groups = groups_of(&checked);
        assert_eq!(count(&solve["groups"]), groups, "{}", checked.file);
        assert_eq!(count(&solve["reused"]), 0, "{}", checked.file);
        let [programs, iterations] = ["programs", "iterations"].map(|key| count(&solve[key]));
        assert_eq!(programs == 0, iterations == 0, "{}", checked.file);
        assert!(iterations >= programs, "{}", checked.file);
        several += usize::from(groups > 1);
        solved += usize::from(programs > 0);
    }
    assert!(several > 3 && solved > 10, "{several} {solved}");
}

/// Arches next to each other, with different block names.
fn arches(count: usize) -> Value {
    let mut file = arch(11, 0.3, 0.7);
    let moved = |body: &Value, metres: f64, name: Option<String>| {
        let mut body = body.clone();
        for corner in body["polygon"].as_array_mut().expect("corners") {
            corner[0] = json!(number(&corner[0]) + metres);
        }
        if let Some(name) = name {
            body["id"] = json!(name);
        }
        body
    };
    let (ground, blocks) = (file["ground"].clone(), file["blocks"].clone());
    for copy in 1..count {
        // Moving by 16 m does not change the digits of the differences of coordinates.
        let metres = 16.0 * copy as f64;
        for body in list(&ground) {
            let body = moved(body, metres, None);
            file["ground"].as_array_mut().expect("a list").push(body);
        }
        for body in list(&blocks) {
            let name = format!("{copy}-{}", body["id"].as_str().expect("a name"));
            let body = moved(body, metres, Some(name));
            file["blocks"].as_array_mut().expect("a list").push(body);
        }
    }
    file
}

/// The program of least force decides an arch. So the result counts the programs and iterations of this program
/// solved alone. For several groups, it counts the sum over all groups.
#[test]
fn programs_and_iterations_are_those_of_the_solver() {
    let alone = program(&scene(&arch(11, 0.3, 0.7)));
    let effort = balance(&alone, Conditioning::Plain).effort;
    assert!(effort.programs > 0 && effort.iterations > 0);
    let solve = check(&arches(1)).json["frames"][0]["solve"].clone();
    assert_eq!(count(&solve["programs"]), effort.programs as u64);
    assert_eq!(count(&solve["iterations"]), effort.iterations as u64);
    assert_eq!(solve["method"], "kinematic");
    let solve = check(&arches(3)).json["frames"][0]["solve"].clone();
    assert_eq!(count(&solve["groups"]), 3);
    assert_eq!(count(&solve["programs"]), 3 * effort.programs as u64);
}

/// The method is that of the group that was hardest to decide: a closed form for a stack and for a block on a slope,
/// a program for an arch, with or without a block next to it.
#[test]
fn the_method_is_that_of_the_hardest_group() {
    let stack = (0..3).map(|k| {
        let at = rectangle(0.25 * f64::from(k), f64::from(k), 1.0, 1.0);
        block(&k.to_string(), at, 1.0)
    });
    for file in [on_floor(0.7, stack.collect()), on_slope(20.0, 2.0, 1.0, 0.6, 0.2)] {
        let solve = &check(&file).json["frames"][0]["solve"];
        let found = (&solve["method"], count(&solve["programs"]));
        assert_eq!(found, (&json!("closed form"), 0), "{file}");
    }
    let mut both = arch(11, 0.3, 0.7);
    for _ in 0..2 {
        let solve = &check(&both).json["frames"][0]["solve"];
        assert_eq!(solve["method"], "kinematic", "{both}");
        let ground = json!({ "polygon": rectangle(64.0, -1.0, 9.0, 1.0) });
        both["ground"].as_array_mut().expect("a list").push(ground);
        let separate = block("separate", rectangle(65.0, 0.0, 1.0, 1.0), 1.0);
        both["blocks"].as_array_mut().expect("a list").push(separate);
    }
}

/// Two arches; the second step adds the second arch, and the third step removes it.
#[test]
fn groups_of_an_earlier_frame_are_reused_and_cost_no_program() {
    let mut file = arches(2);
    let names: Vec<Value> = list(&file["blocks"]).iter().map(|body| body["id"].clone()).collect();
    let (first, second) = names.split_at(names.len() / 2);
    file["steps"] = json!([{ "place": first }, { "place": second }, { "remove": second }]);
    let frames = check(&file).json["frames"].clone();
    let solve = |k: usize| {
        let solve = &frames[k]["solve"];
        ["groups", "reused", "programs"].map(|key| count(&solve[key]))
    };
    let [_, _, alone] = solve(0);
    assert!(alone > 0);
    assert_eq!(solve(0), [1, 0, alone]);
    assert_eq!(solve(1), [2, 1, alone]);
    assert_eq!(solve(2), [1, 1, 0]);
}

/// The time of a frame is at most that of the call that analyses it, and its stages sum to at most the time of the
/// frame. The time of a stage that was not requested is 0.
#[test]
fn times_do_not_exceed_the_time_of_the_call() {
    let file = arch(11, 0.3, 0.7);
    for (requested, options) in
        [(false, Options::default()), (true, Options::default().margins(MarginKinds::ALL).wedging(true))]
    {
        let start = Instant::now();
        let analysis = Analysis::with(scene(&file), &options);
        let took = start.elapsed().as_secs_f64();
        let json = to_json(&analysis, Timing::Included, Layout::OneLine);
        let json: Value = serde_json::from_str(&json).expect("JSON");
        let solve = &json["frames"][0]["solve"];
        let stages = ["assembly", "solution", "wedging", "margins"];
        let stages = stages.map(|key| number(&solve["stages"][key]));
        let seconds = number(&solve["seconds"]);
        assert!(seconds > 0.0 && seconds <= took, "{solve} of {took} s");
        assert!(stages.iter().sum::<f64>() <= seconds * (1.0 + 1e-9));
        let [assembly, solution, wedging, margins] = stages;
        assert!(assembly > 0.0 && solution > 0.0, "{solve}");
        assert_eq!([wedging > 0.0, margins > 0.0], [requested; 2], "{solve}");
    }
}
