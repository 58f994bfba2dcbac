//! Doubtful input is reported: default weights, missing ground, units, existing files and damaged scenes.

use std::fs;

use super::Bench;

/// An Inkscape drawing of a lintel on two posts in one layer, with the abutments in another layer.
const DRAWING: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 60" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">
  <g inkscape:groupmode="layer" inkscape:label="Abutments"><rect y="50" width="100" height="10"/></g>
  <g inkscape:groupmode="layer" inkscape:label="Stones"><rect x="10" y="30" width="10" height="20"/>
    <rect x="60" y="30" width="10" height="20"/><rect x="10" y="20" width="60" height="10"/></g></svg>"#;

fn bench() -> Bench {
    let bench = Bench::new();
    let other = DRAWING.replace("Abutments", "Felsen");
    let degrees = r#"{ "type": "Feature", "geometry": { "type": "Polygon",
        "coordinates": [[[11.58, 48.13], [11.581, 48.13], [11.581, 48.1305]]] } }"#;
    for (name, text) in [("drawing.svg", DRAWING), ("other.svg", &other), ("degrees.geojson", degrees)] {
        fs::write(bench.path(name), text).expect("writable");
    }
    bench
}

/// Runs a command, and asserts its exit code and that standard error contains the words.
fn assert_run(bench: &Bench, line: &str, code: i32, words: &[&str]) {
    let ran = bench.run(line);
    assert_eq!(ran.code, code, "{line}: {}", ran.err);
    for words in words {
        assert!(ran.err.contains(words), "{line}: {}", ran.err);
    }
}

#[test]
fn weights_of_the_default_density_are_noted_once() {
    let bench = bench();
    let note = "the weights of 3 blocks come from the default density of 1 kg/m³";
    assert_run(&bench, "import drawing.svg -o a.json", 0, &[note, "--density"]);
    let ran = bench.run("check a.json");
    assert_eq!(ran.out.matches(note).count(), 1, "{}", ran.out);
    assert!(ran.out.contains("give `density` in kg/m³"), "{}", ran.out);
    let ran = bench.run("import drawing.svg -o b.json --material limestone");
    assert!(!ran.err.contains("default density"), "{}", ran.err);
    assert!(
        ran.err.contains("limestone: 2500 kg/m³, friction coefficient 0.6; from 20 to 29 kN/m³ (EN 1991-1-1)"),
        "{}",
        ran.err
    );
    assert!(!bench.run("check b.json").out.contains("default density"));
    let ran = bench.run("import drawing.svg --material granite --friction 0.3");
    assert!(ran.out.contains("\"friction\": 0.3") && ran.out.contains("\"density\": 2910.0"), "{}", ran.out);
    let unknown = "the known materials are basalt, concrete, gneiss, granite, limestone, sandstone";
    assert_run(&bench, "import drawing.svg --material cheese", 2, &[unknown]);
}

#[test]
fn a_scene_is_replaced_only_with_force() {
    let bench = bench();
    fs::write(bench.path("mine.json"), "edited by hand").expect("writable");
    for line in ["import drawing.svg -o mine.json", "new arch -o mine.json"] {
        assert_run(&bench, line, 4, &["cannot write mine.json: the file exists; --force replaces it"]);
        let kept = fs::read_to_string(bench.path("mine.json")).expect("there");
        assert_eq!(kept, "edited by hand");
        assert_run(&bench, &format!("{line} --force"), 0, &[]);
        fs::write(bench.path("mine.json"), "edited by hand").expect("writable");
    }
}

#[test]
fn ground_is_found_by_name_or_layer_and_its_absence_is_reported() {
    let bench = bench();
    assert_run(
        &bench,
        "import drawing.svg -o a.json",
        0,
        &["3 blocks, 1 part of the ground", "taken as ground by name: Abutments"],
    );
    assert_eq!(bench.run("check a.json").code, 0);
    assert_run(
        &bench,
        "import other.svg -o b.json",
        0,
        &["warning: other.svg: no part of the drawing is ground", "--ground:", "the drawing has Felsen, Stones", "1: "],
    );
    assert_run(&bench, "import other.svg --strict", 2, &["no part of the drawing is ground"]);
    assert_run(&bench, "import other.svg -o c.json --ground-layer felsen", 0, &["3 blocks, 1 part of the ground"]);
    assert_run(&bench, "import other.svg --ground-layer Felse", 2, &["called `Felse`", "did you mean `Felsen`?"]);
}

#[test]
fn scales_and_units_are_read_as_people_write_them() {
    let bench = bench();
    assert_run(&bench, "import drawing.svg --scale 1:50", 2, &["add --unit mm, cm, m, in or ft"]);
    assert_run(&bench, "import drawing.svg --scale 1:50 --unit mm -o a.json", 0, &["a unit of the drawing is 0.05 m"]);
    assert_run(&bench, "import drawing.svg --unit cm -o b.json", 0, &["a unit of the drawing is 0.01 m"]);
    assert_run(&bench, "import drawing.svg --scale 0.1 --unit mm", 2, &["--scale 0.1 is already in metres per unit"]);
    assert_run(&bench, "import drawing.svg --scale 1:0", 2, &["give a ratio such as 1:50, or metres per unit"]);
    assert_run(
        &bench,
        "import degrees.geojson",
        2,
        &["look like longitude and latitude in degrees: 11.58 to 11.581 and 48.13 to 48.1305", "--unit m"],
    );
    assert_run(&bench, "import degrees.geojson --unit m -o c.json", 0, &["1 block"]);
}

#[test]
fn a_csv_file_is_csv() {
    let bench = bench();
    let ran = bench.run("batch falls.json stands.json wrong.json -o answers.csv");
    assert_eq!(ran.code, 2, "{}", ran.err);
    let text = fs::read_to_string(bench.path("answers.csv")).expect("written");
    let rows: Vec<&str> = text.lines().collect();
    assert!(rows[0].starts_with("file,line,scene,frame,title,verdict,weight_n,"), "{text}");
    let columns = rows[0].split(',').count();
    assert!(rows.iter().all(|row| row.split(',').count() == columns), "{text}");
    let cells = rows.iter().skip(1).flat_map(|row| row.split(','));
    let digits = |cell: &str| cell.trim_matches(['0', '.']).chars().filter(char::is_ascii_digit).count();
    assert!(cells.filter(|cell| cell.parse::<f64>().is_ok()).all(|cell| digits(cell) <= 12), "{text}");
    assert!(rows[1].starts_with("\"falls.json\",,") && rows[1].contains(",1,"), "{text}");
    assert!(rows.iter().any(|row| row.contains(",unstable,")), "{text}");
    assert!(rows.last().is_some_and(|row| row.contains("\"line 3: ")), "{text}");
    assert!(!bench.made().contains(&"answers.csv.resume".to_owned()));
    for (line, words) in [
        ("batch falls.json -o a.parquet", "batch writes no .parquet files; write .csv or .ndjson"),
        ("batch falls.json -o a.csv --resume", "--resume needs one line for each scene"),
        ("batch falls.json -o a.csv --fields verdict", "the same columns in every run"),
    ] {
        assert_run(&bench, line, 2, &[words]);
    }
}

#[test]
fn damaged_scenes_in_a_snapshot_folder_fail() {
    let bench = Bench::empty();
    fs::create_dir(bench.path("scenes")).expect("writable");
    fs::write(bench.path("scenes/good.json"), super::STANDS).expect("writable");
    fs::write(bench.path("scenes/other.json"), "{ \"name\": \"no scene\" }").expect("writable");
    fs::write(bench.path("scenes/tsconfig.json"), "{ // a comment\n}").expect("writable");
    assert_eq!(bench.run("snapshot scenes --accept-in-ci").code, 0);
    for (text, words) in [
        ("{ \"blocks\": [", "the file ends too early"),
        ("", "the file is empty"),
        ("{\n<<<<<<< HEAD\n\"blocks\": []\n=======\n>>>>>>> b\n}", "a merge conflict has left two versions"),
    ] {
        fs::write(bench.path("scenes/bad.json"), text).expect("writable");
        assert_run(&bench, "snapshot scenes", 2, &[words, "bad.json"]);
    }
    fs::write(bench.path("scenes/bad.json"), b"\xff\xfe{\0").expect("writable");
    assert_run(&bench, "snapshot scenes", 2, &["is not UTF-8 text"]);
}

#[test]
fn scenes_meant_to_fall_pass_and_others_do_not() {
    let bench = Bench::new();
    let expect = |text: &str, word: &str| text.replacen('{', &format!("{{ \"expect\": \"{word}\","), 1);
    let step = super::FALLS.replacen("\"title\": \"Alone\"", "\"expect\": \"unstable\", \"title\": \"Alone\"", 1);
    assert_ne!(step, super::FALLS);
    for (name, text) in [
        ("step.json", &step),
        ("meant.json", &expect(super::STANDS, "stable")),
        ("stubborn.json", &expect(super::STANDS, "unstable")),
        ("wrong-word.json", &expect(super::STANDS, "falls")),
    ] {
        fs::write(bench.path(name), text).expect("writable");
    }
    for (line, code) in [
        ("check step.json", 0),
        ("check falls.json", 1),
        ("check meant.json", 0),
        ("check stubborn.json", 1),
        ("check --exit-zero falls.json stubborn.json", 0),
        ("check --exit-zero wrong.json", 2),
        ("check wrong-word.json", 2),
        ("batch step.json", 0),
        ("batch stubborn.json", 1),
        ("render step.json -o x.svg --strict", 0),
    ] {
        assert_eq!(bench.run(line).code, code, "{line}");
    }
    assert!(bench.run("check step.json").out.contains("falls, as expected"));
    assert!(bench.run("check stubborn.json").out.contains("stands, but its `expect` says unstable"));
}

#[test]
fn several_scenes_have_a_total_and_the_examples_do_what_they_say() {
    let bench = Bench::new();
    let ran = bench.run("check stands.json falls.json");
    let total = "2 scenes: 1 stands, 1 falls; 3 frames: 2 stand, 1 falls";
    assert!(ran.out.contains(total), "{}", ran.out);
    assert!(!bench.run("check stands.json").out.contains("scenes:"));
    assert_eq!(bench.run("new -o a.json").code, 0);
    assert_eq!(bench.run("new --example falls -o b.json").code, 0);
    assert_eq!((bench.run("check a.json").code, bench.run("check b.json").code), (0, 1));
    let short = bench.run("check a.json").out;
    assert!(!short.contains("edges touch within") && !short.contains("proof"), "{short}");
    let full = bench.run("check --verbose a.json").out;
    assert!(full.contains("edges touch within") && full.contains("sticking none; proof: "), "{full}");
}

#[test]
fn mistakes_of_newcomers_get_the_remedy() {
    let bench = Bench::new();
    let scene = r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 1]],
        "friction": "granite", "cohesion": 3 }], "loads": [{ "block": "a", "force": -10 }] }"#;
    fs::write(bench.path("new.json"), scene).expect("writable");
    assert_run(&bench, "check new.json", 2, &["use `material`", "joints are dry", "10 downwards is [0, -10]"]);
    assert_run(&bench, "batch stands.json --fields frames.forces", 2, &["did you mean frames.interfaces?"]);
    fs::write(bench.path("two.ndjson"), "{ \"drystone\": 1 }\n{ \"drystone\": 1 }\n").expect("writable");
    assert_run(&bench, "check two.ndjson", 2, &["drystone batch FILE"]);
}
