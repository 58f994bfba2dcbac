//! The cost of each effect. Each effect is switched on alone for the same wall. The table lists the number of
//! unknowns in the result, and the time relative to the wall with only weight and contact.
//!
//! `cargo bench --bench effects` prints a table; `src/doc/performance.md` gives its ratios. The measurements of all
//! walls alternate; each time is a median.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "the table is the output; a scene that cannot be read is a bug in this benchmark"
)]

mod turn;

use std::hint::black_box;

use drystone::analysis::{MarginKinds, Options};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use turn::Turns;
use turn::structure::{scene, wall};

/// The number of measurements of each wall.
const TURNS: Turns = Turns { least: 15, most: 15, seconds: 0.0 };

fn main() {
    let plain = Options::default();
    let margins = plain.margins(MarginKinds::ALL);
    let wedging = plain.wedging(true);
    let robots = json!([{ "id": "r", "holds": "40", "limits": { "force": 100.0 } },
        { "id": "s", "holds": "60", "limits": { "force": 100.0 } }]);
    let mut with_torque = robots.clone();
    for robot in with_torque.as_array_mut().unwrap() {
        robot["limits"]["torque"] = json!(10.0);
    }
    let loads = json!([{ "block": "0", "force": [0.0, -4.0], "at": [0.5, 0.25] }]);
    let cases: Vec<(&str, Value, Options)> = vec![
        ("weight and contact", smooth(), plain),
        ("+ friction", with(&[("friction", json!(0.7))]), plain),
        ("+ kernel", with(&[("kernel", json!(0.2))]), plain),
        ("+ robots", with(&[("robots", robots)]), plain),
        ("+ robot torque", with(&[("robots", with_torque)]), plain),
        ("+ loads", with(&[("loads", loads)]), plain),
        ("+ corner contacts", with(&[("corner_contacts", json!(true))]), plain),
        ("+ margins", smooth(), margins),
        ("+ wedging", smooth(), wedging),
        ("friction + margins", with(&[("friction", json!(0.7))]), margins),
        (
            "friction, falling: + sticking, mechanism",
            with(&[("friction", json!(0.7)), ("gravity", turned(40.0))]),
            plain,
        ),
    ];
    let scenes: Vec<Scene> = cases.iter().map(|c| scene(&c.1)).collect();
    let work = scenes.iter().zip(&cases).map(|(scene, case)| {
        move || {
            black_box(Analysis::with(black_box(scene), &case.2));
        }
    });
    let times = TURNS.medians(&work.collect::<Vec<_>>());
    println!("| wall of {} bricks with | verdict | unknowns | ms | ratio |", scenes[0].blocks().len());
    println!("|---|---|---|---|---|");
    for ((case, scene), time) in cases.iter().zip(&scenes).zip(&times) {
        let analysis = Analysis::with(scene, &case.2);
        let frame = &analysis.frames[0];
        let simulated = frame.effects.iter().filter(|e| e.simulated);
        println!(
            "| {} | {:?} | {} | {:.2} | {:.2} |",
            case.0,
            frame.verdict,
            simulated.map(|e| e.unknowns).sum::<usize>(),
            time,
            time / times[0],
        );
    }
}

/// A wall without friction. Its only effects are weight and contact.
fn smooth() -> Value {
    let mut file = wall(10, 10);
    file["friction"] = json!(0.0);
    file
}

/// The wall without friction, after some keys of its scene file are set.
fn with(keys: &[(&str, Value)]) -> Value {
    let mut file = smooth();
    for (key, value) in keys {
        file[key] = value.clone();
    }
    file
}

/// Gravity of 9.81 m/s², rotated from downwards towards the right.
fn turned(degrees: f64) -> Value {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    json!([9.81 * sin, -9.81 * cos])
}
