//! The commands `drystone import` and `drystone export`.

use std::fs;

use super::Bench;

const DRAWING: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="8cm" viewBox="0 0 80 60">
  <rect id="ground" y="50" width="80" height="10"/>
  <rect id="post" x="20" y="20.02" width="10" height="30" fill="#8b6b3d"/></svg>"##;
const DOUBTFUL: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 80 60">
  <rect id="post" x="20" y="20" width="10" height="30"/><text id="words">x</text><path d="M0 0 L9 9"/></svg>"#;
const OVERLAP: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 80 60">
  <rect id="a" x="20" y="20" width="10" height="30"/><rect id="b" x="25" y="20" width="10" height="30"/></svg>"#;

fn bench() -> Bench {
    let bench = Bench::new();
    for (name, text) in [("drawing.svg", DRAWING), ("doubtful.svg", DOUBTFUL), ("overlap.svg", OVERLAP)] {
        fs::write(bench.path(name), text).expect("writable");
    }
    bench
}

#[test]
fn a_drawing_becomes_a_scene_that_check_accepts() {
    let bench = bench();
    let ran = bench.run(
        "import drawing.svg -o scene.json --friction 0.6 --density 2000 --kernel 0.1 --gravity 9.81 --thickness 0.2",
    );
    assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{}", ran.err);
    assert!(ran.err.contains("drawing.svg: 1 block, 1 part of the ground, 0 robots"), "{}", ran.err);
    assert!(ran.err.contains("a unit of the drawing is 0.001 m, because it is 8cm wide"), "{}", ran.err);
    assert!(ran.err.contains("snapped 2 corners of post by up to 20 µm, to ground[0]"), "{}", ran.err);
    let scene = fs::read_to_string(bench.path("scene.json")).expect("written");
    assert!(scene.contains(r#""kernel": 0.1"#) && scene.contains(r#""gravity": [0.0,-9.81]"#), "{scene}");
    assert_eq!(bench.run("check scene.json").code, 0);
}

#[test]
fn the_format_of_standard_input_is_given_or_shown_by_its_content() {
    let bench = bench();
    let ran = bench.run_with("import - --format svg --quiet", DRAWING.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    assert!(ran.out.starts_with("{\n  \"drystone\": 1,"), "{}", ran.out);
    let again = bench.run_with("import - --format svg -o -", DRAWING.as_bytes());
    assert_eq!(again.out, ran.out, "the same drawing has the same bytes");
    let unspecified = bench.run_with("import -", DRAWING.as_bytes());
    assert_eq!((unspecified.code, unspecified.out), (0, ran.out));
    let unknown = bench.run_with("import -", b"a letter\nto a friend\n");
    assert_eq!(unknown.code, 2);
    let remedy = "give --format svg, dxf, geojson, wkt, contacts, boxes or compas";
    assert!(unknown.err.contains(remedy), "{}", unknown.err);
    let wkt = bench.run_with("import - --format wkt", b"a; POLYGON ((0 0, 2 0, 2 1))");
    assert!(wkt.code == 0 && wkt.out.contains(r#""id": "a""#), "{}", wkt.err);
}

#[test]
fn the_json_output_describes_the_import() {
    let bench = bench();
    let ran = bench.run("import drawing.svg -o scene.json --json --quiet");
    let result: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(result["blocks"], 1);
    assert_eq!(result["snapped"][0]["body"], "post");
    assert_eq!(result["snapped"][0]["to"], serde_json::json!(["ground[0]"]));
    assert_eq!(bench.run("import drawing.svg --json").code, 2);
    assert_eq!(bench.run("import drawing.svg --json -o -").code, 2);
}

#[test]
fn doubts_are_warnings_unless_strict() {
    let bench = bench();
    let ran = bench.run("import doubtful.svg -o scene.json");
    assert_eq!(ran.code, 0);
    for warning in [
        "warning: doubtful.svg: text \"words\": a text cannot become a block",
        "warning: doubtful.svg: <path> in line 2: it is open",
    ] {
        assert!(ran.err.contains(warning), "{}", ran.err);
    }
    let strict = bench.run("import doubtful.svg -o strict.json --strict");
    assert_eq!(strict.code, 2);
    assert!(strict.err.contains("error: doubtful.svg: text \"words\""), "{}", strict.err);
    assert!(!bench.made().contains(&"strict.json".to_owned()));
}

#[test]
fn a_refused_drawing_writes_nothing_and_ends_with_2() {
    let bench = bench();
    let overlap = bench.run("import overlap.svg --strict -o scene.json");
    assert_eq!(overlap.code, 2);
    assert!(
        overlap
            .err
            .contains("overlap.svg: rect \"b\": block `b` and block `a` overlap by 5 m, with a common area of 150 m²"),
        "{}",
        overlap.err
    );
    for (line, why) in [
        ("import missing.svg -o scene.json", "cannot read missing.svg"),
        ("import drawing.svg --scale 0 -o scene.json", "--scale: 0 is not a valid value"),
        ("import drawing.svg --friction -1 -o scene.json", "friction"),
        ("import drawing.svg --frame 2 -o scene.json", "--frame needs a figure by drystone"),
        ("import drawing.svg --gravity down -o scene.json", "give gravity in m/s²"),
        ("import stands.json -o scene.json", "already a scene file"),
        ("import drawing.svgz -o scene.json", "unpack it first"),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 2, "{line}: {}", ran.err);
        assert!(ran.err.contains(why), "{line}: {}", ran.err);
    }
    assert!(!bench.made().contains(&"scene.json".to_owned()));
    // A scene whose only problem is an overlap is written, so that it can be drawn.
    let broken = bench.run("import overlap.svg -o broken.json");
    assert!(broken.code == 2 && broken.err.contains("drystone render --broken broken.json"), "{}", broken.err);
    assert_eq!(bench.run("render --broken broken.json -o broken.svg").code, 2);
    assert!(bench.made().contains(&"broken.svg".to_owned()));
    let nowhere = bench.run("import drawing.svg -o nowhere/scene.json");
    assert_eq!(nowhere.code, 4, "{}", nowhere.err);

    // Other commands name the one that reads it.
    let ran = bench.run("check drawing.svg");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("drystone import drawing.svg -o scene.json"), "{}", ran.err);
}

#[test]
fn single_frames_of_a_figure_can_be_imported() {
    let bench = bench();
    assert_eq!(bench.run("render falls.json -o figure.svg").code, 0);
    let held = bench.run("import figure.svg -o held.json --friction 0.6");
    assert_eq!(held.code, 0, "{}", held.err);
    assert!(held.err.contains("imported from frame 2 of 2"), "{}", held.err);
    assert!(held.err.contains("2 blocks, 1 part of the ground, 1 robot"), "{}", held.err);
    assert_eq!(bench.run("check held.json").code, 0);
    assert_eq!(bench.run("import figure.svg -o alone.json --frame a").code, 0);
    assert_eq!(bench.run("check alone.json").code, 1);
    let beyond = bench.run("import figure.svg -o beyond.json --frame 3");
    assert_eq!(beyond.code, 2);
    assert!(beyond.err.contains("there is no frame 3: the figure has 2 frames"), "{}", beyond.err);
}

#[test]
fn a_dwg_is_refused_with_a_remedy_and_windows_1252_is_read() {
    let bench = bench();
    let ran = bench.run("import bridge.dwg");
    assert!(ran.code == 2 && ran.err.contains("save it there as DXF"), "{}", ran.err);
    // The layer name "Gelände" in Windows-1252, as in files of versions before 2007.
    let square = "70\n1\n10\n0\n20\n0\n10\n2\n20\n0\n10\n2\n20\n1\n10\n0\n20\n1\n";
    let file = format!("0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nGel\u{e4}nde\n{square}0\nENDSEC\n0\nEOF\n");
    let bytes: Vec<u8> = file.chars().map(|c| c as u8).collect();
    let ran = bench.run_with("import - --format dxf", &bytes);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("the drawing has Gelände"), "{}", ran.err);
}

#[test]
fn export_writes_a_frame_for_cad_programs() {
    let bench = bench();
    assert_eq!(bench.run("new --example falls -o door.json").code, 0);
    let ran = bench.run("export door.json --frame c -o falls.dxf");
    assert_eq!((ran.code, ran.err.as_str()), (0, "wrote falls.dxf\n"));
    let again = bench.run("export door.json -o falls.dxf");
    assert_eq!(again.code, 4, "{}", again.err);
    assert!(again.err.contains("--force replaces it"), "{}", again.err);
    let again = bench.run("export door.json --frame c -o falls.dxf --force");
    assert_eq!(again.code, 0, "{}", again.err);
    let text = fs::read_to_string(bench.path("falls.dxf")).expect("written");
    assert!(text.contains("guide mechanism") && text.is_ascii());
    let printed = bench.run("export door.json --frame c");
    assert_eq!(printed.out, text);
    for (words, why) in [
        ("export door.json -o falls.svg", "does not end in .dxf"),
        ("export door.json --frame 9", "there is no frame 9"),
        ("export absent.json -o x.dxf", "cannot read absent.json"),
    ] {
        let ran = bench.run(words);
        assert!(ran.code == 2 && ran.err.contains(why), "{}", ran.err);
    }
}
