//! After each step, a session has the same results as a scene file with the same blocks and holds. Verdicts alone are
//! those of a complete analysis.

use drystone::analysis::{Accuracy, Options, Source, Verdict, verdicts};
use drystone::scene::format::{BlockEntry, SceneFile};
use drystone::session::Session;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::oracle::random;
use crate::random::Random;
use crate::structure::{arch, harmonic, on_slope, rectangle, scene, wall};

fn file(value: &Value) -> SceneFile {
    SceneFile::from_json(&value.to_string()).unwrap()
}

fn entry(block: &Value) -> BlockEntry {
    file(&json!({ "drystone": 1, "blocks": [block] })).blocks.remove(0)
}

/// The state of the session as a scene file, which is analysed from scratch.
struct SceneCopy {
    file: Value,
}

impl SceneCopy {
    fn verdict(&self) -> Result<Verdict, String> {
        let scene = Scene::from_json(&self.file.to_string()).map_err(|p| p.to_string())?;
        Ok(Analysis::new(&scene).verdict())
    }

    fn blocks(&mut self) -> &mut Vec<Value> {
        self.file["blocks"].as_array_mut().unwrap()
    }

    fn robot(&mut self, name: &str) -> &mut Value {
        let robots = self.file["robots"].as_array_mut().unwrap();
        robots.iter_mut().find(|r| r["id"] == name).unwrap()
    }
}

/// The counts of some sequences.
#[derive(Default, Debug)]
struct Tally {
    steps: usize,
    from_warm_start: usize,
    stable: usize,
    unstable: usize,
    refused: usize,
}

/// Runs a random sequence in a session, and compares each verdict with an analysis from scratch.
fn played(number: u64, base: Value, candidate: impl Fn(&mut Random, usize) -> Value, tally: &mut Tally) {
    let mut chance = Random::new(number);
    let mut session = Session::new(file(&base)).unwrap();
    let mut copy = SceneCopy { file: base };
    let mut standing: Vec<String> = Vec::new();
    let mut held: [Option<String>; 2] = [None, None];
    for step in 0..24 {
        let what = chance.whole(0, 9);
        let verdict = match what {
            // If the structure falls, the last block is removed again in most cases.
            _ if session.verdict() == Verdict::Unstable && chance.percent(60) && !standing.is_empty() => {
                let id = standing.pop().unwrap();
                for (k, hold) in held.iter_mut().enumerate() {
                    if hold.as_deref() == Some(&id) {
                        session.release(&format!("r{k}")).unwrap();
                        *hold = None;
                        let robot = copy.robot(&format!("r{k}"));
                        robot.as_object_mut().unwrap().remove("holds");
                    }
                }
                copy.blocks().retain(|b| b["id"] != id);
                session.remove(&id)
            }
            0..=5 => {
                let mut block = candidate(&mut chance, standing.len());
                let id = format!("b{step}");
                block["id"] = json!(id);
                copy.blocks().push(block.clone());
                let outcome = session.place(entry(&block));
                if outcome.is_err() {
                    assert!(copy.verdict().is_err(), "only the session refuses: {outcome:?}");
                    copy.blocks().pop();
                    tally.refused += 1;
                } else {
                    standing.push(id);
                }
                outcome
            }
            6 if !standing.is_empty() => {
                let id = chance.one_of(&(0..standing.len()).collect::<Vec<_>>());
                let id = standing[id].clone();
                if held.iter().flatten().any(|h| *h == id) {
                    assert!(session.remove(&id).is_err(), "it is held");
                    continue;
                }
                standing.retain(|s| *s != id);
                copy.blocks().retain(|b| b["id"] != id);
                session.remove(&id)
            }
            7 | 8 if !standing.is_empty() => {
                let k = chance.whole(0, 1) as usize;
                let id = standing[standing.len() - 1].clone();
                let name = format!("r{k}");
                if held[k].as_ref().is_some_and(|h| *h != id) {
                    assert!(session.hold(&name, &id, None).is_err(), "it holds another");
                    continue;
                }
                copy.robot(&name)["holds"] = json!(id);
                let outcome = session.hold(&name, &id, None);
                held[k] = Some(id);
                outcome
            }
            9 => {
                let k = chance.whole(0, 1) as usize;
                let name = format!("r{k}");
                if held[k].take().is_none() {
                    assert!(session.release(&name).is_err(), "it holds nothing");
                    continue;
                }
                copy.robot(&name).as_object_mut().unwrap().remove("holds");
                session.release(&name)
            }
            _ => continue,
        };
        let Ok(verdict) = verdict else { continue };
        let scratch = copy.verdict().unwrap();
        assert_eq!(verdict, scratch, "sequence {number}, step {step}: {}", copy.file);
        assert_eq!(session.verdict(), scratch);
        tally.steps += 1;
        tally.from_warm_start += usize::from(session.source() == Source::WarmStart);
        match scratch {
            Verdict::Stable => tally.stable += 1,
            Verdict::Unstable => tally.unstable += 1,
            Verdict::Undecided => {}
        }
    }
    // The whole sequence as a scene file, and its end as another.
    for file in [session.scene_file(), session.placed_file()] {
        let scene = Scene::new(file).expect("the session accepted every step");
        let frame = scene.frames().last().expect("a scene has a frame");
        let placed: Vec<&str> = frame.placed.iter().map(|block| scene.blocks()[block.0].id.as_str()).collect();
        assert_eq!(
            (placed, frame.holds.len()),
            (standing.iter().map(String::as_str).collect(), held.iter().flatten().count())
        );
        let analysis = Analysis::new(&scene);
        assert_eq!(analysis.frames.last().map(|frame| frame.verdict), Some(session.verdict()), "sequence {number}");
    }
}

fn robots() -> Value {
    json!([{ "id": "r0" }, { "id": "r1", "limits": { "fx": 2.0, "fy": 6.0, "torque": 0.5 } }])
}

#[test]
fn a_session_on_a_lattice_has_the_results_of_a_scene_file() {
    let mut tally = Tally::default();
    for number in 0..60 {
        let mut chance = Random::new(900 + number);
        let ground: Vec<Value> = (-6..=6).map(|x| json!({ "cells": [[x, 0, "down"]] })).collect();
        let base = json!({ "drystone": 1, "friction": chance.one_of(&[0.3, 0.7, 1.2]), "kernel": chance.one_of(&[0.0, 0.2]),
            "grid": { "kind": "triangular" }, "ground": ground, "robots": robots(), "blocks": [] });
        let shapes = ["up", "down", "hexagon", "linkh", "linkr", "linkl"];
        let candidate = |chance: &mut Random, placed: usize| {
            let high = 1 + placed as i64 / 2;
            json!({ "shape": chance.one_of(&shapes), "at": [chance.whole(-4, 4), chance.whole(0, high)], "weight": chance.whole(1, 9) })
        };
        played(number, base, candidate, &mut tally);
    }
    // Squares rest on squares, so higher structures stand.
    for number in 100..160 {
        let ground: Vec<Value> = (-5..=5).map(|x| json!({ "cells": [[x, -1]] })).collect();
        let base = json!({ "drystone": 1, "friction": 0.6, "grid": { "kind": "square", "side": 0.5 }, "ground": ground,
            "robots": robots(), "blocks": [] });
        let candidate = |chance: &mut Random, placed: usize| {
            let (x, y) = (chance.whole(-3, 3), chance.whole(0, 1 + placed as i64 / 3));
            let wide = chance.whole(1, 3);
            let cells: Vec<Value> = (0..wide).map(|k| json!([x + k, y])).collect();
            json!({ "cells": cells, "weight": wide })
        };
        played(number, base, candidate, &mut tally);
    }
    assert!(tally.stable > 300 && tally.unstable > 300 && tally.refused > 50, "{tally:?}");
    assert!(10 * tally.from_warm_start > 8 * tally.steps, "few verdicts came from the warm start: {tally:?}");
}

#[test]
fn a_session_of_bricks_has_the_results_of_a_scene_file() {
    let mut tally = Tally::default();
    for number in 200..240 {
        let base = json!({ "drystone": 1, "friction": 0.6, "ground": [{ "polygon": rectangle(-20.0, -1.0, 40.0, 1.0) }],
            "robots": robots(), "blocks": [] });
        let candidate = |chance: &mut Random, placed: usize| {
            let x = 0.25 * chance.whole(-6, 6) as f64;
            let y = 0.5 * chance.whole(0, 1 + placed as i64 / 2) as f64;
            json!({ "polygon": rectangle(x, y, 1.0, 0.5), "weight": chance.whole(1, 5) })
        };
        played(number, base, candidate, &mut tally);
    }
    assert!(tally.stable > 100 && tally.unstable > 100, "{tally:?}");
}

#[test]
fn an_invalid_block_is_refused_and_changes_nothing() {
    let base = json!({ "drystone": 1, "grid": { "kind": "square" }, "ground": [{ "cells": [[0, -1]] }],
        "blocks": [{ "id": "a", "cells": [[0, 0]] }] });
    let mut session = Session::new(file(&base)).unwrap();
    for (wrong, message) in [
        (json!({ "cells": [[0, 0]] }), "overlap"),
        (json!({ "cells": [[0, 1], [2, 1]] }), "blocks"),
        (json!({ "id": "a", "cells": [[0, 1]] }), "block a"),
        (json!({ "cells": [[0, 1]], "weight": -1 }), "-1"),
    ] {
        let refused = session.place(entry(&wrong));
        let refused = refused.expect_err(message).to_string();
        assert!(refused.contains(message), "{refused}");
        assert_eq!((session.verdict(), session.scene().blocks().len()), (Verdict::Stable, 1));
    }
    assert!(session.hold("r0", "a", None).is_err() && session.remove("b").is_err());
    let stepped = json!({ "drystone": 1, "blocks": [{ "id": "a", "cells": [[0, 0]] }], "grid": { "kind": "square" },
        "steps": [{ "place": ["a"] }] });
    assert!(Session::new(file(&stepped)).is_err());
    // A block without an id has the least free number.
    session.place(entry(&json!({ "cells": [[0, 1]] }))).unwrap();
    assert_eq!(session.scene().blocks()[1].id, "1");
    assert_eq!(session.analysis().verdict(), Verdict::Stable);
}

#[test]
fn verdicts_without_an_analysis_are_those_of_a_full_analysis() {
    let held = |value: Value| (value.to_string(), scene(&value));
    let mut scenes: Vec<(String, Scene)> = (0..420).map(|n| held(random::scene(n).1)).collect();
    for n in 3..12 {
        for share in [0.9, 0.999_999, 1.0, 1.000_001, 1.1] {
            scenes.push(held(harmonic(n, share)));
        }
        scenes.push(held(arch(n, 0.11 + 0.005 * n as f64, 0.7)));
        scenes.push(held(on_slope(3.0 * n as f64, 1.0, 2.0, 0.4, 0.1)));
    }
    scenes.push(held(wall(4, 6)));
    let options = Options::default();
    let (mut falls, mut stands) = (0, 0);
    for (text, scene) in &scenes {
        let whole = Analysis::with(scene, &options);
        let whole: Vec<Verdict> = whole.frames.iter().map(|f| f.verdict).collect();
        assert_eq!(verdicts(scene, &options), whole, "{text}");
        falls += whole.iter().filter(|v| **v == Verdict::Unstable).count();
        stands += whole.iter().filter(|v| **v == Verdict::Stable).count();
    }
    assert!(falls > 100 && stands > 100, "{falls} fall, {stands} stand");
    let strict = options.accuracy(Accuracy::Proved);
    for (text, scene) in scenes.iter().step_by(10) {
        let whole = Analysis::with(scene, &strict);
        let whole: Vec<Verdict> = whole.frames.iter().map(|f| f.verdict).collect();
        assert_eq!(verdicts(scene, &strict), whole, "{text}");
    }
}
