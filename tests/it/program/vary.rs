//! Numbers that vary: known limits come out, every sample agrees with a closed form, and pictures keep their bytes.

use std::fs;

use serde_json::Value;

use super::{Bench, Ran};

fn run(bench: &Bench, numbers: &str) -> Ran {
    bench.run(&format!("vary {numbers}"))
}

/// The result as JSON.
fn found(bench: &Bench, numbers: &str) -> Value {
    let ran = run(bench, &format!("{numbers} --json"));
    assert_eq!(ran.code, 0, "{numbers}: {}", ran.err);
    serde_json::from_str(&ran.out).expect("JSON")
}

/// The states of the intervals, and the values between which they meet.
fn ends(result: &Value) -> Vec<(String, [f64; 2])> {
    let list = result["intervals"].as_array().expect("intervals").iter();
    list.map(|interval| {
        let number = |key: &str| interval[key].as_f64().expect("a number");
        (interval["state"].as_str().expect("a word").to_owned(), [number("from"), number("to")])
    })
    .collect()
}

/// Samples of a map: the pair, and whether it holds.
fn pairs(result: &Value) -> Vec<([f64; 2], bool)> {
    let list = result["samples"].as_array().expect("samples").iter();
    list.map(|sample| {
        let number = |i: usize| sample["at"][i].as_f64().expect("a number");
        assert!(sample["state"] == "holds" || sample["state"] == "fails", "{sample}");
        ([number(0), number(1)], sample["state"] == "holds")
    })
    .collect()
}

/// Least thickness over the middle radius of arches with radial joints, for angles of embrace: Milankovitch's 0.1075 for the
/// semicircle, and for the others the values of many single verdicts. 51 voussoirs come close to a continuous arch.
#[test]
fn arches_have_their_published_least_thickness() {
    let bench = Bench::new();
    for (angle, wanted) in
        [(100.0, 0.0113), (120.0, 0.0228), (140.0, 0.0412), (160.0, 0.0685), (180.0, 0.1074), (200.0, 0.1604)]
    {
        let result = found(&bench, &format!("arch voussoirs=51 friction=5 angle={angle} thickness=0.01..0.6"));
        let list = ends(&result);
        assert_eq!((list.len(), list[0].0.as_str(), list[1].0.as_str()), (2, "fails", "holds"), "{list:?}");
        let thickness = list[1].1[0];
        let inner = if angle < 180.0 { 2.0 / libm::sin(f64::to_radians(angle / 2.0)) } else { 2.0 };
        let share = thickness / (inner + thickness / 2.0);
        assert!((share - wanted).abs() < 1.1e-4, "{angle}°: {share}");
    }
}

/// The three regions of a semicircular arch: below μ = 0.309 it slides at any thickness; then its least thickness falls to
/// Milankovitch's value. The values at 51 voussoirs: thickness over middle radius 0.191 at 0.315, 0.131 at 0.37.
#[test]
fn a_semicircle_slides_turns_or_does_both() {
    let bench = Bench::new();
    let share = |thickness: f64| thickness / (2.0 + thickness / 2.0);
    for (friction, wanted) in [(0.315, 0.191), (0.35, 0.152), (0.37, 0.131), (0.41, 0.1075)] {
        let list = ends(&found(&bench, &format!("arch voussoirs=51 friction={friction} thickness=0.1..0.8")));
        assert!((share(list[1].1[0]) - wanted).abs() < 1e-3, "{friction}: {list:?}");
    }
    let list = ends(&found(&bench, "arch voussoirs=51 friction=0.305 thickness=0.1..0.8"));
    assert_eq!(list, [("fails".to_owned(), [0.1, 0.8])]);
    let text = run(&bench, "arch voussoirs=51 friction=0.2..0.5 thickness=0.6").out;
    assert!(text.contains("falls") && text.contains("(sliding)"), "{text}");
}

#[test]
fn ladders_and_inclines_have_their_closed_forms() {
    let bench = Bench::new();
    // A thin ladder of any length at a smooth wall: tan α = 1 / (2 μ).
    let list = ends(&found(&bench, "ladder thickness=0.0001 friction=0.6 angle=20..80"));
    let wanted = libm::atan(1.0 / 1.2).to_degrees();
    assert!((list[1].1[0] - wanted).abs() < 0.02, "{list:?}");
    let list = ends(&found(&bench, "incline friction=0.5 angle=0..60"));
    let wanted = libm::atan(0.5).to_degrees();
    assert!(list[0].1[1] <= wanted && wanted <= list[1].1[0] + 0.01 && list[1].1[0] - list[0].1[1] < 0.011, "{list:?}");
}

/// A wall of width 1 m and height 2 m with water to its top: it turns about its toe if its weight is below 2 H M / b, and
/// slides if the friction is below H / W.
#[test]
fn the_map_of_a_wall_with_water_follows_its_two_closed_forms() {
    let bench = Bench::new();
    let wall = r#"{ "drystone": 1, "ground": [{ "polygon": [[-3, -1], [4, -1], [4, 0], [-3, 0]] }],
        "blocks": [{ "id": "wall", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]], "weight": 40000 }],
        "loads": [{ "block": "wall", "force": [19620, 0], "at": [0, 0.5] }] }"#;
    fs::write(bench.path("wall.json"), wall).expect("written");
    let result = found(&bench, "wall.json blocks.wall.weight=1000..60000 friction=0.1..1.2");
    let mut counts = [0, 0];
    for ([weight, friction], holds) in pairs(&result) {
        let room = (weight - 19620.0).min(friction * weight - 19620.0);
        assert!(holds == (room >= 0.0) || room.abs() < 1.0, "{weight} N, {friction}: {holds}");
        counts[usize::from(holds)] += 1;
    }
    // A grid as fine as the border would have a million pairs.
    assert!(counts[0] > 200 && counts[1] > 200 && counts[0] + counts[1] < 1500, "{counts:?}");
    assert_eq!(result["ranges"][0]["given"], 40000.0);
    // Moved to the edge of the ground, it falls when half of its pressure lies beyond.
    let result = found(&bench, "wall.json friction=0.6 loads=[] blocks.wall.at[0]=0..4");
    assert_eq!(ends(&result)[0].1, [0.0, 3.5]);
    // The moment of a force is linear in its height, so the values at which the wall stands are an interval.
    let result = found(&bench, "wall.json friction=0.6 loads[0].at[1]=0..2");
    assert_eq!((ends(&result)[0].1[1], result["is_interval"].as_bool()), (1.019, Some(true)));
    // A step that is meant to fall holds where it falls, which is no interval. Neither are values of one part of gravity.
    fs::write(bench.path("meant.json"), wall.replace("\"drystone\": 1,", "\"drystone\": 1, \"expect\": \"unstable\","))
        .expect("written");
    let result = found(&bench, "meant.json friction=0.6 loads[0].at[1]=0..2");
    assert_eq!((ends(&result)[0].0.as_str(), result["is_interval"].as_bool()), ("fails", Some(false)));
    assert_eq!(found(&bench, "wall.json friction=0.6 gravity=[0,-9.81] gravity[0]=-5..5")["is_interval"], false);
}

#[test]
fn a_tower_leans_by_its_width_over_the_number_of_blocks() {
    let bench = Bench::new();
    for ([blocks, lean], holds) in pairs(&found(&bench, "tower blocks=2..9 lean=0.02..0.6")) {
        // Coordinates are rounded to 0.1 mm.
        assert!(holds == (lean <= 1.0 / blocks) || (lean - 1.0 / blocks).abs() < 2e-4, "{blocks}, {lean}: {holds}");
        assert_eq!(blocks.fract(), 0.0);
    }
}

#[test]
fn figure_9a_needs_more_friction_with_a_kernel() {
    let bench = Bench::new();
    let figure = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/thesis/figure-9a.json");
    fs::copy(figure, bench.path("9a.json")).expect("copied");
    for (kernel, wanted) in [(0.0, 0.3849), (0.2, 0.5389)] {
        let list = ends(&found(&bench, &format!("9a.json corner_contacts=true kernel={kernel} friction=0.2..0.9")));
        assert!((list[1].1[0] - wanted).abs() < 2e-4, "{kernel}: {list:?}");
    }
}

#[test]
fn a_goal_is_a_number_of_the_result() {
    let bench = Bench::new();
    let list = ends(&found(&bench, "incline friction=0.2..1 angle=10 tilt>=15"));
    assert!((list[1].1[0] - libm::tan(25_f64.to_radians())).abs() < 2e-4, "{list:?}");
    let list = ends(&found(&bench, "tower lean=0..0.2 total_force<=0"));
    assert_eq!(list[0].0, "fails");
    // No scene is no fall.
    let ran = run(&bench, "arch thickness=-1..1");
    assert!(ran.out.contains("no scene") && ran.out.contains("it must be a length in metres"), "{}", ran.out);
    // If the result has no number of this name, the goal is not reached.
    assert_eq!(ends(&found(&bench, "tower lean=0..0.1 nothing>=1")).len(), 1);
}

#[test]
fn files_have_all_samples_and_pictures_name_their_regions() {
    let bench = Bench::new();
    let ran = run(&bench, "ladder angle=20..80 friction=0.1..1 -o map.svg -o map.csv -o map.json");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let text = |name: &str| fs::read_to_string(bench.path(name)).expect("written");
    let map = text("map.svg");
    for words in ["falls: sliding", "stands", "angle, degrees", "friction coefficient", "the scene as given"] {
        assert!(map.contains(words), "{words}: {map}");
    }
    let json: Value = serde_json::from_str(&text("map.json")).expect("JSON");
    assert_eq!(text("map.csv").lines().count(), json["samples"].as_array().expect("a list").len() + 1);
    assert!(text("map.csv").starts_with("angle,friction,state\n"));
    // Characters that no font has are shown as code points.
    let named = fs::read_to_string(bench.path("stands.json")).expect("there").replace("\"lintel\"", "\"石\"");
    fs::write(bench.path("named.json"), named).expect("written");
    let ran = run(&bench, "named.json blocks.石.friction=0..1 kernel=0..0.5 -o named.svg --text paths");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let ran = run(&bench, "incline friction=0.2..1 angle=20 --curve tilt -o curve.svg -o curve.csv");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(text("curve.csv").starts_with("friction,state,tilt\n") && text("curve.svg").contains("0.364"));
}

/// An incline of friction μ and angle α stands at tilts up to atan μ − α: each line of equal tilt has this value.
#[test]
fn lines_on_a_map_have_the_value_of_a_closed_form() {
    let bench = Bench::new();
    let ran = run(
        &bench,
        "incline friction=0.2..1 angle=0..40 --isolines tilt -o map.json -o map.svg --keep kept --resume log",
    );
    assert_eq!(ran.code, 0, "{}", ran.err);
    let text = |name: &str| fs::read_to_string(bench.path(name)).expect("written");
    let json: Value = serde_json::from_str(&text("map.json")).expect("JSON");
    let lines = json["isolines"].as_array().expect("a list");
    assert!(lines.len() >= 4 && json["value"] == "tilt", "{json}");
    for line in lines {
        let value = line["value"].as_f64().expect("a number");
        for pair in line["lines"].as_array().expect("a list").iter().flat_map(|run| run.as_array().expect("pairs")) {
            let [friction, angle] = [0, 1].map(|i| pair[i].as_f64().expect("a number"));
            let wanted = libm::atan(friction).to_degrees() - angle;
            assert!((value - wanted).abs() < 0.05, "{friction}, {angle}: {value} beside {wanted}");
        }
    }
    assert!(text("map.svg").contains("lines: tilt, degrees"));
    // Each sample is a scene, which has its verdict.
    let samples = json["samples"].as_array().expect("samples");
    let names: std::collections::BTreeSet<String> = samples
        .iter()
        .map(|sample| {
            format!(
                "friction={} angle={}.json",
                sample["at"][0].as_f64().expect("friction"),
                sample["at"][1].as_f64().expect("angle")
            )
        })
        .collect();
    let kept: std::collections::BTreeSet<String> = fs::read_dir(bench.path("kept"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(names, kept);
    let scene = |name: &str| drystone::Scene::from_json(&text(&format!("kept/{name}"))).expect("a scene");
    assert!((scene("friction=0.2 angle=0.json").blocks()[0].body.friction - 0.2).abs() < 1e-12);
    // A later run takes all results from the file, and writes the same; one with another question is refused.
    let (log, map) = (text("log"), text("map.json"));
    let again = run(&bench, "incline friction=0.2..1 angle=0..40 --isolines tilt -o again.json --resume log");
    assert_eq!((again.code, text("again.json") == map, text("log") == log), (0, true, true), "{}", again.err);
    // What a stopped run left, half a line too, is completed.
    fs::write(bench.path("log"), &log[..log.len() / 2]).expect("written");
    let again = run(&bench, "incline friction=0.2..1 angle=0..40 --isolines tilt -o again.json --resume log");
    assert_eq!((again.code, text("again.json") == map, text("log").lines().count()), (0, true, log.lines().count()));
    let ran = run(&bench, "incline friction=0.2..1 angle=0..50 --isolines tilt --resume log");
    assert_eq!((ran.code, text("log").lines().count()), (0, text("log").lines().count()));
    let ran = run(&bench, "incline friction=0.2..1 --resume log");
    assert!(ran.code == 2 && ran.err.contains("results of another question"), "{}", ran.err);
    fs::write(bench.path("notes.txt"), "mine\n").expect("written");
    let ran = run(&bench, "incline friction=0.2..1 --resume notes.txt");
    assert!(ran.code == 2 && text("notes.txt") == "mine\n", "{}", ran.err);
}

#[test]
fn a_report_has_what_varies_with_its_picture() {
    let bench = Bench::new();
    let vary = |numbers: &str, out: &str| {
        let mut command = bench.command(&format!("report stands.json -o {out} --vary"));
        command.arg(numbers);
        super::ran(command)
    };
    let ran = vary("friction=0.1..0.9 --curve tilt", "curve.html");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let text = |name: &str| fs::read_to_string(bench.path(name)).expect("written");
    let page = text("curve.html");
    for words in [
        "For which values: friction from 0.1 to 0.9",
        "class=\"curve\"",
        "drystone vary stands.json friction=0.1..0.9 --curve tilt",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let ran = vary("friction=0.1..0.9 kernel=0..0.5", "map.md");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        text("map.md").contains("each point of the border lies between two of them")
            || text("map.md").contains("Each point of the border")
    );
    // A scene that lacks the number is listed as refused; the others have their part.
    let other = fs::read_to_string(bench.path("stands.json")).expect("there").replace("\"lintel\"", "\"beam\"");
    fs::write(bench.path("other.json"), other).expect("written");
    let mut command = bench.command("report stands.json other.json -o both.html --set kernel=0.1 --vary");
    command.arg("blocks.lintel.friction=0.1..0.9 --curve tilt");
    let ran = super::ran(command);
    assert!(ran.code == 2 && ran.err.contains("the scene has no entry \"lintel\""), "{}", ran.err);
    let page = text("both.html");
    assert!(page.contains("--curve tilt --set kernel=0.1") && page.contains("other.json"), "{}", ran.err);
    let ran = vary("frictionn=0.1..0.9", "wrong.md");
    assert!(
        ran.code == 2 && ran.err.contains("unknown key `frictionn`") && !bench.path("wrong.md").exists(),
        "{}",
        ran.err
    );
    let ran = vary("friction=0.1..0.9", "wrong.json");
    assert!(ran.code == 2 && ran.err.contains("drystone vary --json"), "{}", ran.err);
}

/// The map on the page of questions.
#[test]
fn the_map_in_the_documentation_is_the_one_of_its_command() {
    let bench = Bench::new();
    let ran = run(&bench, "arch voussoirs=51 friction=0.2..0.6 thickness=0.05..0.7 -o arch.svg");
    assert_eq!(ran.code, 0, "{}", ran.err);
    let (made, kept) = (fs::read(bench.path("arch.svg")).expect("written"), "assets/questions/arch-map.svg");
    let kept = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(kept);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        fs::write(&kept, &made).expect("writable");
    }
    assert!(made == fs::read(&kept).unwrap_or_default(), "the map differs; set UPDATE_SNAPSHOTS to accept it");
    let text = String::from_utf8(made).expect("UTF-8");
    for words in ["falls: sliding", "falls: hinges", "hinges and", "stands"] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn what_cannot_be_varied_is_refused_with_the_remedy() {
    let bench = Bench::new();
    for (numbers, wanted) in [
        ("stands.json friction=1..0", "the first value must be less than the second"),
        ("stands.json friction=a..b", "write NAME=FROM..TO"),
        ("stands.json friction=0.5", "one number or two must vary"),
        ("stands.json friction=0..1 kernel=0..0.5 tilt=0..1", "one number or two must vary"),
        ("stands.json nonsense=0..1", "unknown key `nonsense`"),
        ("stands.json friction=0..1 tilt>=1 tilt>=2", "only one goal"),
        ("stands.json friction=0..1 kernel=0..1 --curve tilt", "--curve is for one number"),
        ("stands.json friction=0..1 --isolines tilt", "--isolines is for two numbers"),
        ("stands.json blocks.lintell.weight=0..1", "blocks.lintell.weight=0: the scene has no entry"),
        ("stands.json friction=0..1 -o out.svg", "needs --curve"),
        ("stands.json friction=0..1 -o out.txt", ".json or .csv"),
        ("stands.json friction=0..1 --placement", "unexpected argument '--placement'"),
        ("tower blocks=1.5..3", "a whole number"),
        ("nothing.json friction=0..1", "cannot read nothing.json"),
    ] {
        let ran = run(&bench, numbers);
        assert_eq!(ran.code, 2, "{numbers}: {}", ran.out);
        assert!(ran.err.contains(wanted), "{numbers}: {}", ran.err);
    }
    assert!(!bench.path("out.svg").exists());
    // Blocks overlap at both ends of the range, but not between them. Overlaps of a hundredth are roundings.
    let walls = r#"{ "drystone": 1, "ground": [{ "polygon": [[0, -1], [9, -1], [9, 0], [0, 0]] }], "blocks": [
        { "id": "a", "polygon": [[1, 0], [2, 0], [2, 1], [1, 1]] }, { "id": "b", "polygon": [[5, 0], [6, 0], [6, 1], [5, 1]] },
        { "id": "c", "polygon": [[3, 0], [4, 0], [4, 1], [3, 1]] }] }"#;
    fs::write(bench.path("walls.json"), walls).expect("written");
    let list = ends(&found(&bench, "walls.json blocks.c.at[0]=-1.5..1.5"));
    assert_eq!(
        list.iter().map(|(state, _)| state.as_str()).collect::<Vec<_>>(),
        ["no_scene", "holds", "no_scene"],
        "{list:?}"
    );
    assert!((list[1].1[0] + 1.0).abs() < 0.011 && (list[1].1[1] - 1.0).abs() < 0.011, "{list:?}");
    let ran = run(&bench, "arch voussoirs=900 friction=0.1..0.9 --time-limit 0.05");
    assert!(ran.out.contains("the time limit was reached") || ran.code == 2, "{}", ran.out);
}
