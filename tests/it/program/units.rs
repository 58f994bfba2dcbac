//! A scene in millimetres and kilonewtons has the same results as one in metres and newtons, each in its own units.

use drystone::analysis::{Analysis, MarginKinds, Options};
use drystone::figure::{self, Kind};
use drystone::output;
use drystone::result::{Layout, Timing, to_json};
use drystone::scene::Scene;
use serde_json::{Value, json};

use super::Bench;

/// A lintel on two posts with a robot and a load. The unit of length is `length` metres, that of force `force`
/// newtons.
fn lintel(length: f64, force: f64, units: Value) -> Value {
    let at = |x: f64, y: f64| json!([x / length, y / length]);
    let box_of = |x: f64, y: f64, w: f64, h: f64| json!([at(x, y), at(x + w, y), at(x + w, y + h), at(x, y + h)]);
    let mut file = json!({ "drystone": 1, "title": "Lintel", "friction": 0.6, "kernel": 0.1, "thickness": 0.5 / length,
        "ground": [{ "polygon": box_of(-1.0, -1.0, 8.0, 1.0) }],
        "blocks": [{ "id": "left", "polygon": box_of(0.0, 0.0, 1.0, 3.0), "density": 2000 },
            { "id": "right", "polygon": box_of(5.0, 0.0, 1.0, 3.0), "mass": 3000 },
            { "id": "lintel", "polygon": box_of(0.0, 3.0, 6.0, 1.0), "weight": 11000.0 / force }],
        "loads": [{ "block": "lintel", "force": [500.0 / force, -2000.0 / force], "at": at(4.0, 4.0),
            "torque": 250.0 / (force * length) }],
        "robots": [{ "id": "crane", "limits": { "force": 9000.0 / force, "torque": 100.0 / (force * length) } }],
        "steps": [{ "place": ["left", "lintel"], "hold": { "crane": { "block": "lintel", "at": at(5.0, 4.0) } } },
            { "place": ["right"], "release": ["crane"] }, { "remove": ["left"] }] });
    if !units.is_null() {
        file["units"] = units;
    }
    file
}

fn analysis(file: &Value) -> Analysis {
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    Analysis::with(&scene, &Options::default().margins(MarginKinds::ALL))
}

fn assert_near(a: &Value, b: &Value, at: &str) {
    match (a, b) {
        (Value::Number(x), Value::Number(y)) => {
            let (x, y) = (x.as_f64().expect("a float"), y.as_f64().expect("a float"));
            // The tolerance is that of the solver, on which proofs and margins depend.
            let tolerance = 1e-3 * x.abs().max(y.abs()) + 1e-8;
            assert!((x - y).abs() <= tolerance, "{at}: {x} {y}");
        }
        (Value::Array(x), Value::Array(y)) => {
            assert_eq!(x.len(), y.len(), "{at}");
            for (i, (x, y)) in x.iter().zip(y).enumerate() {
                assert_near(x, y, &format!("{at}[{i}]"));
            }
        }
        (Value::Object(x), Value::Object(y)) => {
            for (key, value) in x {
                assert_near(value, &y[key], &format!("{at}.{key}"));
            }
        }
        _ => {}
    }
}

#[test]
fn results_are_the_same_in_all_units() {
    let frames = |file: &Value| {
        let written = to_json(&analysis(file), Timing::LeftOut, Layout::OneLine);
        let mut result: Value = serde_json::from_str(&written).expect("JSON");
        for frame in result["frames"].as_array_mut().expect("frames") {
            // Motions and proofs depend on the solver, and motions may not be unique.
            frame["mechanism"].take();
            frame["margins"]["mechanisms"].take();
            frame["margins"]["excluded"].take();
            frame["proof"].take();
            frame["solve"].take();
            frame["effects"].take();
        }
        result["frames"].take()
    };
    let si = frames(&lintel(1.0, 1.0, Value::Null));
    for (length, force, units) in [
        (1e-3, 1e3, json!({ "length": "mm", "force": "kN" })),
        (1e-2, 1.0, json!({ "length": "cm" })),
        (1.0, 1e6, json!({ "force": "MN" })),
        (0.3048, 4.448_221_615_260_5, json!({ "length": "ft", "force": "lbf" })),
        (0.0254, 1.0, json!({ "length": "in", "force": "N" })),
    ] {
        let verdicts = |frames: &Value| -> Vec<Value> {
            let list = frames.as_array().expect("frames").iter();
            list.map(|f| f["verdict"].clone()).collect()
        };
        let found = frames(&lintel(length, force, units.clone()));
        assert_eq!(verdicts(&found), verdicts(&si), "{units}");
        assert_near(&si, &found, &units.to_string());
    }
}

#[test]
fn tables_have_the_units_of_the_file() {
    let file = lintel(1e-3, 1e3, json!({ "length": "mm", "force": "kN" }));
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let analysis = Analysis::new(&scene);
    for kind in [Kind::Forces, Kind::Flow, Kind::Thrust, Kind::Mechanism, Kind::Joints] {
        let svg = output::svg::write(&figure::draw(&analysis, kind, &figure::Options::default()));
        let words = svg.replace('\u{a0}', " ");
        assert!(words.contains(" kN"), "{kind:?}");
        for wrong in [" N<", " N ", " N,", " N;", " m<", " mN", "N·m<", " MN"] {
            assert!(!words.contains(wrong), "{kind:?}: {wrong:?}");
        }
    }
    let bench = Bench::new();
    std::fs::write(bench.path("mm.json"), file.to_string()).expect("writable");
    let ran = bench.run("check --verbose --margins mm.json");
    assert!(ran.out.contains(" kN"), "{}", ran.out);
    assert!(!ran.out.contains(" N "), "{}", ran.out);
    let ran = bench.run("report mm.json -o mm.md --full");
    assert_ne!(ran.code, 2, "{}", ran.err);
    let report = std::fs::read_to_string(bench.path("mm.md")).expect("written");
    for head in ["x, mm", "force, kN", "torque, kN·mm"] {
        assert!(report.contains(head), "{head}: {report}");
    }
}

#[test]
fn problems_name_the_units_of_the_file() {
    let mut file = lintel(1e-3, 1e3, json!({ "length": "mm", "force": "kN" }));
    file["blocks"][1]["polygon"] = json!([[0, 0], [1500, 0], [1500, 3000], [0, 3000]]);
    let problems = Scene::from_json(&file.to_string()).expect_err("overlap").to_string();
    assert!(problems.contains("overlap by 1000 mm, with a common area of 3000000 mm²"), "{problems}");
    file["units"] = json!({ "length": "furlong" });
    let problems = Scene::from_json(&file.to_string()).expect_err("no unit").to_string();
    assert!(problems.contains("units.length"), "{problems}");
    let mut file = lintel(1e-3, 1e3, json!({ "length": "mm", "force": "kN" }));
    file["loads"][0]["at"] = json!([9000, 4000]);
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let notes: Vec<&str> = scene.notes().iter().map(|n| n.message.as_str()).collect();
    assert!(notes.iter().any(|n| n.contains("3000 mm outside")), "{notes:?}");
}

/// The output of capacity and sensitivity on the terminal and in figures.
#[test]
fn capacities_and_sensitivities_have_the_units_of_the_file() {
    let file = lintel(1e-3, 1e3, json!({ "length": "mm", "force": "kN" }));
    let bench = Bench::new();
    std::fs::write(bench.path("mm.json"), file.to_string()).expect("writable");
    for arguments in [
        "check mm.json --frame 1 --capacity lintel@3000,4000",
        "check mm.json --frame 1 --sensitivity load_factor",
        "render mm.json --frame 1 --kind capacity --capacity lintel@3000,4000 -o capacity.svg",
        "render mm.json --frame 1 --kind sensitivity --margin load-factor -o sensitivity.svg",
    ] {
        let ran = bench.run(arguments);
        assert_eq!(ran.code, 0, "{arguments}: {}", ran.err);
        let picture = arguments.rsplit_once(" -o ").map(|(_, name)| name);
        let words = picture.map_or(ran.out, |name| std::fs::read_to_string(bench.path(name)).expect("written"));
        let words = words.replace('\u{a0}', " ");
        let unit = if arguments.contains("capacity") { " kN" } else { " mm" };
        assert!(words.contains(unit), "{arguments}: {words}");
        for wrong in [" N<", " N ", " N,", " N;", " m ", " m<", " MN", " cm"] {
            assert!(!words.contains(wrong), "{arguments}: {wrong:?} in {words}");
        }
        if arguments.contains("check") && picture.is_none() && unit == " kN" {
            assert!(words.contains("at (3000, 4000) mm on block lintel"), "{words}");
        }
    }
}

/// A block 0.02 mm above the ground nearly touches it: the note and its remedy use the unit of the file.
#[test]
fn notices_have_the_units_of_the_file() {
    let mut file = lintel(1e-3, 1e3, json!({ "length": "mm", "force": "kN" }));
    file.as_object_mut().expect("an object").remove("steps");
    file["blocks"][0]["polygon"] = json!([[0, 0.02], [1000, 0.02], [1000, 3000], [0, 3000]]);
    let scene = Scene::from_json(&file.to_string()).expect("sound");
    let analysis = Analysis::new(&scene);
    let mut words: Vec<String> = analysis.notes.iter().map(|n| format!("{} {}", n.message, n.hint)).collect();
    words.extend(analysis.frames.iter().flat_map(|f| f.notices.clone()));
    words.extend(analysis.frames.iter().flat_map(|f| &f.doubts).map(ToString::to_string));
    let words = words.join("\n");
    assert!(words.contains("0.02 mm"), "{words}");
    assert!(!words.contains("e-5 m"), "{words}");
}
