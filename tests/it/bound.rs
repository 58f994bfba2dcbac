//! Every run ends: the most expensive files of less than a megabyte are processed or refused within ten seconds of
//! processor time and 1.3 GB of address space. A refusal states the number that is too large.

#![cfg(unix)]

mod style;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use drystone::Analysis;
use drystone::analysis::{Options, UndecidedReason, Verdict};
use serde_json::json;

use crate::structure::{block, on_floor, rectangle, scene};

struct Ran {
    code: Option<i32>,
    messages: String,
}

/// Runs the program on a file. The system limits its time and memory.
fn run(name: &str, text: &str, arguments: &str) -> Ran {
    run_within(1_300_000, name, text, arguments)
}

/// Runs the program on a file, with at most this number of kilobytes of address space.
fn run_within(kilobytes: usize, name: &str, text: &str, arguments: &str) -> Ran {
    assert!(text.len() < 1_000_000, "{name} has {} bytes", text.len());
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join(name), text).expect("writable");
    run_in(folder.path(), kilobytes, arguments)
}

/// Runs the program in a folder, with at most this number of kilobytes of address space.
fn run_in(folder: &Path, kilobytes: usize, arguments: &str) -> Ran {
    let program = env!("CARGO_BIN_EXE_drystone");
    // The limit of ten seconds holds for an optimised build; the checks of a debug build take several times as long.
    let seconds = if cfg!(debug_assertions) { 60 } else { 10 };
    let line = format!("ulimit -t {seconds}; ulimit -v {kilobytes}; exec '{program}' >/dev/null {arguments}");
    let ran = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", "2")
        // Under CI no snapshot is accepted; a test here needs one.
        .env_remove("CI")
        .output()
        .expect("starts");
    Ran { code: ran.status.code(), messages: String::from_utf8_lossy(&ran.stderr).into_owned() }
}

/// A file that is too large is refused with its size, the limit and a remedy, and is not read: it has more bytes than the
/// program may have memory.
#[test]
fn files_of_more_than_64_mb_are_refused_unread() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let grow = |name: &str, size: u64| {
        fs::create_dir_all(at(name).parent().expect("a folder")).expect("writable");
        let file = fs::File::options().create(true).append(true).open(at(name)).expect("writable");
        file.set_len(size).expect("sparse");
    };
    let refused = |name: &str, size: u64, arguments: &str| {
        let Ran { code, messages } = run_in(folder.path(), 1_300_000, arguments);
        let words =
            format!("{size} bytes or more are too many, at most 64000000 are read; split it into smaller files");
        let words = words.split(' ').collect::<Vec<_>>();
        let said = messages.split([' ', '\n', '"']).filter(|word| !word.is_empty()).collect::<Vec<_>>();
        assert!(said.windows(words.len()).any(|some| some == words), "{arguments}: {code:?} {messages}");
        assert!(code == Some(2) && messages.contains(name), "{arguments}: {code:?} {messages}");
    };
    let scene = json!({ "drystone": 1, "blocks": [{ "id": "a", "polygon": square(0.0) }] }).to_string();
    fs::write(at("good.json"), &scene).expect("writable");
    fs::create_dir(at("kept")).expect("writable");
    fs::write(at("kept/s.json"), &scene).expect("writable");
    assert_eq!(run_in(folder.path(), 1_300_000, "snapshot --accept -q kept").code, Some(0));
    fs::write(at("book.md"), "```drystone file=big.json\n```\n").expect("writable");

    let size = 5_000_000_000;
    for name in ["big.json", "big.toml", "big.svg", "big.dxf", "big.md", "in/big.json", "kept/s.txt", "set/s.json"] {
        grow(name, size);
    }
    let commands = [
        ("big.json", "check big.json"),
        ("big.toml", "check big.toml"),
        ("big.json", "check in"),
        ("big.json", "batch big.json >&2"),
        ("big.json", "plan big.json"),
        ("big.json", "verify big.json"),
        ("big.svg", "import big.svg"),
        ("big.dxf", "import big.dxf"),
        ("big.json", "render good.json -o good.svg --style big.json"),
        ("big.toml", "render good.json -o good.svg --style big.toml"),
        ("big.md", "markdown big.md -o out.md"),
        ("big.json", "markdown book.md -o out.md"),
        ("s.json", "snapshot set"),
    ];
    for (name, arguments) in commands {
        refused(name, size, arguments);
    }
    grow("kept/drystone-snapshots.toml", size);
    refused("drystone-snapshots.toml", size, "snapshot kept");
    fs::remove_file(at("kept/drystone-snapshots.toml")).expect("there");
    // A reference that is not read is one that differs.
    let ran = run_in(folder.path(), 1_300_000, "snapshot kept >&2");
    assert_eq!(ran.code, Some(1), "{}", ran.messages);
    // Streams are read up to the limit, and lines of scenes to their ends.
    let least = 64_000_001;
    grow("lines.ndjson", least);
    refused("standard input", least, "check - < big.json");
    refused("lines.ndjson", least, "batch lines.ndjson >&2");
}

#[track_caller]
fn refused(name: &str, text: &str, arguments: &str, words: &str) {
    let ran = run(name, text, arguments);
    let start: String = ran.messages.chars().take(400).collect();
    assert_eq!(ran.code, Some(2), "{name}: {start}");
    assert!(ran.messages.contains(words), "{name}: {start}");
}

fn svg(body: &str) -> String {
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="9" height="9">{body}</svg>"#
    )
}

fn square(x: f64) -> serde_json::Value {
    json!([[x, 0], [x + 1.0, 0], [x + 1.0, 1], [x, 1]])
}

#[test]
fn copies_of_copies() {
    let mut body = String::from(r#"<defs><rect id="a0" width="1" height="1"/>"#);
    for level in 0..17 {
        let _ = write!(
            body,
            r##"<g id="a{}"><use href="#a{level}"/><use href="#a{level}" x="{}"/></g>"##,
            level + 1,
            2 << level
        );
    }
    body += r##"</defs><use href="#a17"/>"##;
    refused("bomb.svg", &svg(&body), "import bomb.svg", "outlines, copies included; the limit is");
}

#[test]
fn equal_outlines() {
    let rects = r#"<rect width="4" height="4"/>"#.repeat(19_000);
    let ran = run("rects.svg", &svg(&rects), "import rects.svg -o rects.json");
    assert!(ran.code == Some(0) && ran.messages.contains("exact repeats (18999)"), "{}", ran.messages);
    let path = format!(r#"<path d="{}"/>"#, "M0 0h4v4h-4z".repeat(4_000));
    let ran = run("path.svg", &svg(&path), "import path.svg -o scene.json");
    assert!(matches!(ran.code, Some(0 | 2)), "{}", ran.messages);
    let path = format!(r#"<path fill-rule="evenodd" d="{}"/>"#, "M0 0h4v4h-4z".repeat(80_000));
    refused("paths.svg", &svg(&path), "import paths.svg", "80000 outlines are too many to find the holes");
    let rings = vec![json!([[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]); 16_000];
    let text = json!({ "type": "MultiPolygon", "coordinates": rings }).to_string();
    let ran = run("same.geojson", &text, "import same.geojson -o same.json");
    assert!(ran.code == Some(0) && ran.messages.contains("exact repeats (15999)"), "{}", ran.messages);
    let text = "POLYGON((0 0,1 0,1 1,0 1,0 0))\n".repeat(20_000);
    let ran = run("same.wkt", &text, "import same.wkt -o wkt.json");
    assert!(ran.code == Some(0) && ran.messages.contains("exact repeats (19999)"), "{}", ran.messages);
    // Outlines that differ by little are no repeats.
    let rects: String = (0..19_000).map(|i| format!(r#"<rect width="4" height="4.{i:05}"/>"#)).collect();
    refused("rects.svg", &svg(&rects), "import rects.svg", "outlines overlap, so they cannot be blocks");
}

#[test]
fn very_many_circles_and_corners_of_curves() {
    let mut circles = String::new();
    for i in 0..19_000 {
        let _ = write!(circles, r#"<circle cx="{}" r="1"/>"#, 3 * i);
    }
    let ran = run("circles.svg", &svg(&circles), "import circles.svg -q -o circles.json");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
    let path = format!(r#"<path d="M0 0{}z"/>"#, "a1e7 1e7 0 1 1 1 0".repeat(40_000));
    refused("arcs.svg", &svg(&path), "import arcs.svg", "corners with chords for curves; the limit is 1000000");
}

#[test]
fn one_id_for_all_elements_and_very_many_classes() {
    let mut body = String::new();
    for i in 0..9_000 {
        let _ = write!(body, r#"<rect id="a" x="{}" width="4" height="4"/>"#, 5 * i);
    }
    let ran = run("ids.svg", &svg(&body), "import ids.svg -q -o ids.json");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
    let mut body = String::from("<style>");
    for i in 0..4_900 {
        let _ = write!(body, ".c{i}{{fill:red}}");
    }
    body += "</style>";
    body += &r#"<g class="c1"/>"#.repeat(40_000);
    refused("classes.svg", &svg(&body), "import classes.svg", "4900 style rules and 40002 elements");
    // Each part of the selector stands for any ancestor.
    let selector = format!("z{} .a", " g".repeat(12));
    let groups = ["<g>", "</g>"].map(|tag| tag.repeat(40));
    let rect = r#"<rect class="a" width="1" height="1"/>"#;
    let body = format!("<style>{selector}{{fill:red}}</style>{}{rect}{}", groups[0], groups[1]);
    refused("selector.svg", &svg(&body), "import selector.svg", "1 style rules and 43 elements");
}

#[test]
fn unknown_names_and_keys() {
    let blocks: Vec<_> =
        (0..7_000).map(|i| json!({ "id": format!("b{i}"), "polygon": square(f64::from(2 * i)) })).collect();
    let names: Vec<String> = (0..16_000).map(|i| format!("zz{i}x")).collect();
    let text = json!({ "drystone": 1, "blocks": blocks, "steps": [{ "place": names }] }).to_string();
    refused("names.json", &text, "check names.json", "and 1949 more problems of this kind");
    // Names of 80 letters take longest to compare.
    let long = |first: char, i: usize| format!("{first}{i:05}{}", "ab".repeat(37));
    let blocks: Vec<_> = (0..2_000).map(|i| json!({ "id": long('b', i), "polygon": square(2.0 * i as f64) })).collect();
    let names: Vec<String> = (0..7_000).map(|i| long('z', i)).collect();
    let text = json!({ "drystone": 1, "blocks": blocks, "steps": [{ "place": names }] }).to_string();
    refused("long.json", &text, "check long.json", "unknown block");
    let mut text = String::from("{\"drystone\": 1");
    for i in 0..60_000 {
        let _ = write!(text, ",\"k{i}\":1");
    }
    text += ",\"blocks\": []}";
    refused("keys.json", &text, "check keys.json", "there are more problems than the 2000 in this list");
}

/// Load cases share the limit of placed blocks and have one of their own, and their cost does not grow with the square of
/// their number.
#[test]
fn very_many_load_cases() {
    let cases = |count: usize| (0..count).map(|i| json!({ "id": format!("c{i}") })).collect::<Vec<_>>();
    let mut file = json!({ "drystone": 1, "blocks": [{ "id": "a", "polygon": square(0.0) }], "cases": cases(20_000),
        "loads": vec![json!({ "block": "a", "torque": 0 }); 20_000] });
    let words = "20000 loads in 20000 load cases are 400000000 loads, and at most 1000000 are allowed";
    refused("loads.json", &file.to_string(), "check loads.json", words);
    (file["loads"], file["steps"]) = (json!([]), json!(vec![json!({}); 50_000]));
    refused("empty.json", &file.to_string(), "check empty.json", "contain more than 1000000 blocks and grips in total");
    (file["steps"], file["cases"]) = (json!([]), json!(cases(10_000)));
    let ran = run("cases.json", &file.to_string(), "check cases.json -q");
    assert_eq!(ran.code, Some(1), "{}", ran.messages);
}

/// Equal arrows count once for each place of a label, and only some hundred labels search for a place.
#[test]
fn very_many_loads_at_one_point() {
    let load = json!({ "block": "a", "force": [0.001, -1], "at": [0.5, 1] });
    let file = json!({ "drystone": 1, "blocks": [{ "id": "a", "polygon": square(0.0) }], "loads": vec![load; 10_000],
        "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }] });
    let ran = run("loads.json", &file.to_string(), "render loads.json -q -o loads.svg");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
}

#[test]
fn very_many_crossings() {
    // A star whose every side crosses others.
    let n = 20_001;
    let corners: Vec<_> = (0..n)
        .map(|i| {
            let (y, x) = libm::sincos(f64::from(i) * 3.2);
            json!([(x * 1e6).round() / 1e6, (y * 1e6).round() / 1e6])
        })
        .collect();
    let text = json!({ "drystone": 1, "blocks": [{ "id": "a", "polygon": corners }] }).to_string();
    refused("star.json", &text, "check star.json", "meets the side");
}

#[test]
fn a_joint_of_many_edges() {
    let n = 30_000;
    let top: Vec<_> = (0..=n).map(|i| json!([i, 0])).collect();
    let under = [json!([0, -1]), json!([n, -1])];
    let ground: Vec<_> = under.iter().chain(top.iter().rev()).cloned().collect();
    let over = [json!([n, 1]), json!([0, 1])];
    let block: Vec<_> = top.iter().chain(&over).cloned().collect();
    let text = json!({ "drystone": 1, "ground": [{ "polygon": ground }], "blocks": [{ "id": "a", "polygon": block }] });
    let ran = run("joint.json", &text.to_string(), "check joint.json");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
}

#[test]
fn a_picture_that_is_too_large() {
    let mut steps = vec![json!({ "place": ["a"] })];
    steps.extend((0..499).map(|i| json!({ "title": format!("step {i}") })));
    let text = json!({ "drystone": 1, "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
        "blocks": [{ "id": "a", "polygon": square(2.0) }], "steps": steps })
    .to_string();
    refused("steps.json", &text, "render steps.json -o a.png", "out of range");
}

/// The number of panels is known before they are laid out.
#[test]
fn a_figure_or_a_report_of_very_many_panels() {
    let mut steps = vec![json!({ "place": ["a"] })];
    steps.extend(vec![json!({ "title": "ttttttttt" }); 40_000]);
    let text = json!({ "drystone": 1, "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
        "blocks": [{ "id": "a", "polygon": square(2.0) }], "steps": steps })
    .to_string();
    let words = "a figure of 40001 panels is too large, at most 2000 are drawn";
    for arguments in
        ["render steps.json -o a.svg", "render steps.json -o a.gif --animate 2", "render steps.json --panels -o a.svg"]
    {
        refused("steps.json", &text, arguments, words);
    }
    refused("steps.json", &text, "report steps.json --full -o r.html", words);
    let ran = run("steps.json", &text, "render steps.json --frame last -o a.svg");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
    let ran = run("steps.json", &text, "check -q steps.json");
    assert_eq!(ran.code, Some(0), "{}", ran.messages);
}

#[test]
fn very_many_steps() {
    let blocks: Vec<_> =
        (0..500).map(|i| json!({ "id": format!("b{i}"), "polygon": square(f64::from(2 * i)) })).collect();
    let mut steps = vec![json!({ "place": (0..500).map(|i| format!("b{i}")).collect::<Vec<_>>() })];
    steps.extend(vec![json!({}); 250_000]);
    let text = json!({ "drystone": 1, "blocks": blocks, "steps": steps }).to_string();
    refused("steps.json", &text, "check steps.json", "there are 250001 steps, and at most 50000 are allowed");
}

/// A wall in running bond. With 40 rows and 30 columns, a check takes longer than a hundredth of a second.
fn wall(rows: i32, columns: i32) -> String {
    let mut blocks = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let x = 2 * column + row % 2;
            let corners = [[x, row], [x + 2, row], [x + 2, row + 1], [x, row + 1]];
            blocks.push(json!({ "id": format!("{row}-{column}"), "polygon": corners }));
        }
    }
    let end = 2 * columns + 1;
    json!({ "drystone": 1, "ground": [{ "polygon": [[0, 0], [end, 0], [end, -1], [0, -1]] }],
        "loads": [{ "block": format!("{}-0", rows - 1), "force": [0.3, 0] }], "blocks": blocks })
    .to_string()
}

#[test]
fn a_time_limit_leaves_a_large_wall_undecided() {
    let text = wall(40, 30);
    let late = run("wall.json", &text, "check --time-limit 0.01 wall.json");
    assert_eq!(late.code, Some(3), "{}", late.messages);
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("wall.json"), wall(3, 3)).expect("writable");
    fs::write(folder.path().join("large.json"), &text).expect("writable");
    let outcome = |arguments: &[&str]| {
        let ran = Command::new(env!("CARGO_BIN_EXE_drystone"))
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .expect("starts");
        (ran.status.code(), String::from_utf8_lossy(&ran.stdout).into_owned())
    };
    let (code, table) = outcome(&["check", "--time-limit", "0", "large.json"]);
    assert!(code == Some(3) && table.contains("the time limit was reached"), "{table}");
    for command in ["render --strict large.json -o a.svg", "report --strict large.json -o a.json", "plan large.json"] {
        let arguments: Vec<&str> = command.split(' ').chain(["--time-limit", "0"]).collect();
        assert_eq!(outcome(&arguments).0, Some(3), "{command}");
    }
    let free = outcome(&["check", "--no-timing", "wall.json"]);
    assert_eq!(free.0, Some(0), "{}", free.1);
    assert_eq!(outcome(&["check", "--no-timing", "--time-limit", "1000", "wall.json"]), free);
}

/// Each load case of 100 separate blocks is decided in closed form. After the deadline, the other cases are not analysed.
#[test]
fn a_time_limit_ends_many_load_cases_and_the_positions_of_a_vehicle() {
    let limited = |name: &str, scene: &serde_json::Value| {
        let started = Instant::now();
        let ran = run(name, &scene.to_string(), &format!("check -q --time-limit 0.2 {name}"));
        assert!(ran.code.is_some_and(|code| code == 3 || code == 0), "{name}: {:?} {}", ran.code, ran.messages);
        let most = if cfg!(debug_assertions) { 20.0 } else { 0.7 };
        assert!(started.elapsed().as_secs_f64() < most, "{name}: {:?}", started.elapsed());
    };
    let blocks: Vec<_> =
        (0..100).map(|i| json!({ "id": format!("b{i}"), "polygon": square(2.0 * i as f64) })).collect();
    let cases: Vec<_> = (0..9000).map(|i| json!({ "id": format!("c{i}"), "weights": 1.0 + 1e-3 * i as f64 })).collect();
    let ground = json!([{ "polygon": [[0, 0], [300, 0], [300, -1], [0, -1]] }]);
    limited("cases.json", &json!({ "drystone": 1, "ground": ground, "blocks": blocks, "cases": cases }));
    let mut scene: serde_json::Value = serde_json::from_str(&wall(12, 12)).expect("JSON");
    scene["loads"] = json!([]);
    let axles: Vec<_> = (0..30).map(|i| json!({ "weight": 9, "offset": 0.01 * f64::from(i) })).collect();
    scene["vehicle"] = json!({ "axles": axles });
    limited("vehicle.json", &scene);
}

/// The work that the check of a certificate needs has a limit: numbers of all sizes in one step, many changed frames of
/// many bodies, long outlines that lie on each other, and many contacts at a long outline.
#[test]
fn certificates_of_strangers() {
    let body = |ground: bool, outline: serde_json::Value| json!({ "id": "a", "ground": ground, "outline": outline, "weight": 1 });
    let triangle = || json!([[0, 0], [1, 0], [1, 1]]);
    let frame = |verdict: &str, placed: Vec<usize>, contacts: serde_json::Value, more: [serde_json::Value; 2]| {
        json!({ "frame": 1, "verdict": verdict, "gravity": [0, -1], "placed": placed, "contacts": contacts,
            "forces": more[0], "motion": more[1] })
    };
    let file = |listed: bool, bodies: Vec<_>, frames: Vec<serde_json::Value>, limits: Vec<_>| {
        json!({ "drystone_certificate": 1, "scene_sha256": "", "distance": 0.1, "corners_carry": false, "shortest": 0,
            "listed": listed, "bodies": bodies, "frames": frames, "limits": limits })
        .to_string()
    };
    // Numbers from 1e-300 to 1e300 with all digits.
    let number = |k: usize| libm::sin(k as f64) * libm::exp10(300.0 * libm::cos((k * k) as f64));
    let pairs: Vec<_> = (0..70).map(|k| [1 + k % 30, 1 + (k % 30 + 1 + k * k % 29) % 30]).collect();
    let contact = |k: usize, bodies: [usize; 2]| {
        json!({ "bodies": bodies, "points": [[number(5 * k), number(5 * k + 1)], [number(5 * k + 2), number(5 * k + 3)]],
            "friction": 1 })
    };
    let contacts: Vec<_> = pairs.iter().enumerate().map(|(k, bodies)| contact(k, *bodies)).collect();
    let step = [json!((1..=30).collect::<Vec<_>>()), json!((0..200).collect::<Vec<_>>())];
    let forces = json!({ "contacts": vec![[1, 1, 0]; 70], "grips": [], "order": [step] });
    let bodies: Vec<_> = (0..31).map(|k| body(k == 0, triangle())).collect();
    let steps = |number: usize| {
        let mut frame = frame("stable", (1..31).collect(), json!(contacts), [forces.clone(), json!(null)]);
        frame["frame"] = json!(number);
        frame
    };
    let limits = vec![json!({ "frame": 1, "of": "", "change": {}, "verdict": "stable" }); 9_000];
    let many = (0..5_000).map(|k| body(k == 0, triangle())).collect();
    let empty = frame("undecided", Vec::new(), json!([]), [json!(null), json!(null)]);
    let long: Vec<_> = (0..15_000).map(|x| [x, 0]).chain([[0, 1]]).collect();
    let two = || vec![body(true, json!(long)), body(false, json!(long))];
    let near = vec![json!({ "bodies": [1, 0], "points": [[0, 0], [1, 0]], "friction": 0 }); 6_000];
    let files = [
        ("steps.json", file(true, bodies, (1..5).map(steps).collect(), Vec::new())),
        ("limits.json", file(true, many, vec![empty], limits)),
        (
            "long.json",
            file(false, two(), vec![frame("unstable", vec![1], json!([]), [json!(null), json!([])])], Vec::new()),
        ),
        (
            "near.json",
            file(false, two(), vec![frame("stable", vec![1], json!(near), [json!(null), json!(null)])], Vec::new()),
        ),
    ];
    for (name, text) in files {
        let ran = run(name, &text, &format!("verify {name} >&2"));
        assert_eq!(ran.code, Some(3), "{name}: {}", ran.messages.chars().take(400).collect::<String>());
        let is_given_up = ran.messages.contains("steps of arithmetic");
        assert!(is_given_up || name != "steps.json", "{name}: {}", ran.messages);
        let late = run(name, &text, &format!("verify --time-limit 0 {name} >&2"));
        assert!(late.messages.contains("the time limit"), "{name}: {}", late.messages);
    }
}

/// A certificate ends with its time limit, and says so; one of very many blocks is refused.
#[test]
fn certificates_are_written_in_time() {
    let args = "check --time-limit 0 --certificate proof.json wall.json >&2";
    let ran = run("wall.json", &wall(3, 3), args);
    assert!(matches!(ran.code, Some(0 | 3)), "{}", ran.messages);
    let mut scene: serde_json::Value = serde_json::from_str(&wall(10, 11)).expect("JSON");
    let names: Vec<_> = scene["blocks"].as_array().into_iter().flatten().map(|block| block["id"].clone()).collect();
    let mut steps = vec![json!({ "place": names })];
    steps.extend(vec![json!({}); 1000]);
    scene["steps"] = json!(steps);
    let words = "110110 blocks in all frames and conditions are too many for a certificate, at most 100000 are written";
    refused("wall.json", &scene.to_string(), "check --verdict-only --certificate proof.json wall.json", words);
}

/// A closed form decides two separate blocks on a floor even with a time limit of 0. If the blocks overlap, the
/// verdict needs a second analysis, for which no time is left.
#[test]
fn a_time_limit_leaves_overlaps_undecided() {
    let two_blocks = |depth: f64| {
        let left = block("left", rectangle(0.0, 0.0, 1.0, 1.0), 1.0);
        let right = block("right", rectangle(1.0 - depth, 0.0, 1.0, 1.0), 1.0);
        scene(&on_floor(0.7, vec![left, right]))
    };
    let now = Options::default().deadline(Instant::now());
    for (depth, late) in [(-0.5, Verdict::Stable), (0.001, Verdict::Undecided)] {
        let scene = two_blocks(depth);
        assert_eq!(Analysis::new(&scene).verdict(), Verdict::Stable, "{depth}");
        let analysis = Analysis::with(&scene, &now);
        assert_eq!(analysis.verdict(), late, "{depth}");
        let doubts = &analysis.frames[0].doubts;
        let is_late = doubts.contains(&UndecidedReason::Late);
        assert_eq!(is_late, depth > 0.0, "{doubts:?}");
    }
}

/// Two combs with `teeth` teeth each, `reach` apart from each other in x, whose gaps fit the teeth of the other.
fn combs(teeth: i32, reach: i32) -> String {
    let (mut lower, mut upper) = (Vec::new(), Vec::new());
    for x in (0..teeth).map(|k| 4 * k) {
        lower.extend([[x, 0], [x, 10], [x + 2, 10], [x + 2, 0]]);
        upper.extend([[x + 2 - reach, 10], [x + 2 - reach, 0], [x + 4, 0], [x + 4, 10]]);
    }
    let end = 4 * teeth;
    lower.extend([[end, 0], [end, -1], [0, -1]]);
    upper.extend([[end + 2, 10], [end + 2, 11], [2 - reach, 11]]);
    json!({ "drystone": 1, "ground": [{ "polygon": lower }], "blocks": [{ "polygon": upper }] }).to_string()
}

/// Two combs that fit each other, with teeth so long and inclined that each of their boxes meets all others.
fn slanted_combs(teeth: i32) -> String {
    let (mut lower, mut upper, end) = (Vec::new(), Vec::new(), 4 * teeth);
    for x in (0..teeth).map(|k| 4 * k) {
        lower.extend([[x, 0], [x + end, end], [x + 2 + end, end], [x + 2, 0]]);
        upper.extend([[x + 2 + end, end], [x + 2, 0], [x + 4, 0], [x + 4 + end, end]]);
    }
    lower.extend([[end, 0], [end, -1], [0, -1]]);
    upper.extend([[2 * end + 2, end], [2 * end + 2, end + 1], [end + 2, end + 1]]);
    json!({ "drystone": 1, "ground": [{ "polygon": lower }], "blocks": [{ "polygon": upper }] }).to_string()
}

/// Two combs whose teeth cross: every tooth of one overlaps every tooth of the other.
fn crossed_combs(teeth: i32) -> String {
    let mut comb = Vec::new();
    for x in (0..teeth).map(|k| 4 * k) {
        comb.extend([[x, 0], [x, 4 * teeth], [x + 2, 4 * teeth], [x + 2, 0]]);
    }
    comb.extend([[4 * teeth, 0], [4 * teeth, -1], [0, -1]]);
    let other: Vec<_> = comb.iter().rev().map(|[x, y]| [*y, *x]).collect();
    json!({ "drystone": 1, "ground": [{ "polygon": comb }], "blocks": [{ "polygon": other }] }).to_string()
}

/// Files of 15 to 300 kB in which something grows with the square of their length. Each is processed or refused within
/// 500 MB of address space, which the program, its threads and the text of the largest file need at least half of.
#[test]
fn memory_grows_with_the_length_of_a_file() {
    let floor = |parts: usize| vec![json!({ "polygon": [[0, -1], [2000, -1], [2000, 0], [0, 0]] }); parts];
    let row = |count: usize| -> Vec<_> {
        (0..count).map(|i| json!({ "id": format!("b{i}"), "polygon": square(2.0 * i as f64) })).collect()
    };
    let names = |count: usize| -> Vec<String> { (0..count).map(|i| format!("b{i}")).collect() };
    let scene = |ground: Vec<_>, blocks: Vec<_>, more: serde_json::Value| {
        let mut scene = json!({ "drystone": 1, "ground": ground, "blocks": blocks });
        scene.as_object_mut().expect("an object").extend(more.as_object().cloned().unwrap_or_default());
        scene.to_string()
    };
    let wedge = |fan: usize, k: usize| {
        let corner = |k: usize| {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * k as f64 / 90.0);
            [10.0 * fan as f64 + 4.0 * cos, 4.0 * sin]
        };
        json!({ "polygon": [[10 * fan, 0], corner(k), corner(k + 1)] })
    };
    let fans = (0..12).flat_map(|fan| (0..90).map(move |k| (fan, k))).map(|(fan, k)| wedge(fan, k)).collect();
    let shelf = |i: usize| {
        let y = i % 2;
        json!({ "id": format!("b{i}"), "polygon": [[0, y], [1, y], [1, y + 1], [0, y + 1]] })
    };
    let turn = |i: usize| match i {
        0 => json!({ "place": ["b0"] }),
        _ => json!({ "remove": [format!("b{}", i - 1)], "place": [format!("b{i}")] }),
    };
    let turns: Vec<_> = (0..1200).map(turn).collect();
    let holds: serde_json::Map<_, _> = (0..2000).map(|i| (format!("r{i}"), "b0".into())).collect();
    let mut held = vec![json!({ "place": ["b0"], "hold": holds })];
    held.extend(vec![json!({}); 2000]);
    let robots: Vec<_> = (0..2000).map(|i| json!({ "id": format!("r{i}") })).collect();
    let mut idle = vec![json!({ "place": names(100) })];
    idle.extend(vec![json!({}); 4000]);
    let cases: Vec<_> = (0..3000).map(|i| json!({ "id": format!("c{i}"), "weights": 1 })).collect();
    let near = (0..3000).map(|i| json!({ "polygon": square(f64::from(i) * 1e-7) })).collect();
    let tolerant = json!({ "contact_tolerance": 0.01 });
    let overlaps = "there are more overlaps than the 1000 in this list";
    let too_near = "lie so close together that they may touch; at most";
    let too_many = "contain more than 1000000 blocks and grips in total";
    let files = [
        ("ground.json", scene(floor(2500), row(500), json!({})), too_near),
        ("one_place.json", scene(floor(1), vec![json!({ "polygon": square(0.0) }); 3000], json!({})), overlaps),
        ("near.json", scene(floor(1), near, tolerant), overlaps),
        ("turns.json", scene(floor(1), (0..1200).map(shelf).collect(), json!({ "steps": turns })), too_near),
        ("fans.json", scene(floor(1), fans, json!({ "corner_contacts": true })), "pairs of corners meet in one frame"),
        ("cases.json", scene(floor(1), row(400), json!({ "cases": cases })), too_many),
        ("held.json", scene(floor(1), row(1), json!({ "robots": robots, "steps": held })), too_many),
        ("idle.json", scene(floor(1), row(100), json!({ "steps": idle })), ""),
        ("combs.json", combs(1500, 0), ""),
        ("slanted.json", slanted_combs(1500), ""),
        ("deep.json", combs(1500, 1), "overlap by 1 m, with a common area of 15000 m²"),
        ("crossed.json", crossed_combs(1500), "with a common area of at least"),
    ];
    for (name, text, words) in files {
        assert!((15_000..300_000).contains(&text.len()), "{name} has {} bytes", text.len());
        let ran = run_within(500_000, name, &text, &format!("check --json {name}"));
        let start: String = ran.messages.chars().take(400).collect();
        assert_eq!(ran.code, Some(if words.is_empty() { 0 } else { 2 }), "{name}: {start}");
        assert!(ran.messages.contains(words), "{name}: {start}");
    }
}
