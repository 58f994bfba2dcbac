//! Imports small files of the kinds that people brought: exports of other programs, tables, and pictures.
//!
//! Each is reduced to what was misread at first.

use drystone::analysis::Verdict;
use drystone::import::{DrawingProblems, Format, Imported, Options, import};
use drystone::scene::NoteCode;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::random::Random;

fn read(text: &str, format: Format, options: &Options) -> Imported {
    import(text, format, options).unwrap_or_else(|refusal| panic!("{refusal:?}"))
}

fn refused(text: &str, format: Format, options: &Options) -> DrawingProblems {
    import(text, format, options).expect_err("refused")
}

fn verdict(imported: &Imported) -> Verdict {
    let scene = Scene::from_json(&imported.scene.to_json()).expect("sound");
    Analysis::new(&scene).verdict()
}

fn counts(imported: &Imported) -> (usize, usize) {
    (imported.scene.blocks.len(), imported.scene.ground.len())
}

fn ids(imported: &Imported) -> Vec<&str> {
    imported.scene.blocks.iter().filter_map(|b| b.id.as_deref()).collect()
}

fn has_note(imported: &Imported, words: &str) -> bool {
    imported.notes.iter().any(|n| n.contains(words))
}

/// The area of the block with this number, in square metres.
fn area(imported: &Imported, block: usize) -> f64 {
    Scene::from_json(&imported.scene.to_json()).expect("sound").blocks()[block].body.polygon.area()
}

/// A GeoJSON file of rectangles: the properties, and the corners at the lower left and the upper right.
fn rectangles(list: &[(Value, [f64; 4])]) -> String {
    let features = list.iter().map(|(properties, [x, y, right, top])| {
        json!({ "type": "Feature", "properties": properties, "geometry": { "type": "Polygon",
            "coordinates": [[[x, y], [right, y], [right, top], [x, top], [x, y]]] } })
    });
    json!({ "type": "FeatureCollection", "features": features.collect::<Vec<_>>() }).to_string()
}

fn options(ground: &[&str], ignore: &[&str]) -> Options {
    let texts = |list: &[&str]| list.iter().map(|t| (*t).to_owned()).collect::<Vec<String>>();
    Options::default().ground(texts(ground)).ignore(texts(ignore))
}

#[test]
fn the_name_of_a_feature_decides_before_its_class_and_its_id() {
    // QGIS writes an id and a name, QuPath a class.
    let floor = [-1.0, -0.3, 4.0, 0.0];
    for properties in [
        json!({ "id": 1, "name": "ground" }),
        json!({ "class": "ground" }),
        json!({ "classification": { "name": "Ground", "color": [1, 2, 3] } }),
        json!({ "Name": "floor", "Layer": "ground" }),
    ] {
        let stone = json!({ "id": 2, "name": "stone A", "class": "stone" });
        let text = rectangles(&[(properties, floor), (stone, [0.0, 0.0, 1.0, 0.5])]);
        let imported = read(&text, Format::GeoJson, &Options::default());
        assert_eq!((counts(&imported), ids(&imported)), ((1, 1), vec!["stone A"]));
        assert_eq!(verdict(&imported), Verdict::Stable);
    }
}

#[test]
fn bodies_without_names_are_chosen_by_number_point_or_height() {
    let body = |x: f64, y: f64| (json!({}), [x, y, x + 100.0, y + 100.0]);
    let text = rectangles(&[body(0.0, 0.0), body(20.0, 100.0), body(40.0, 200.0), body(0.0, -100.0)]);
    let silent = read(&text, Format::GeoJson, &Options::default());
    assert_eq!(counts(&silent), (4, 0));
    assert!(silent.remarks[0].help.contains("--ground"), "{:?}", silent.remarks);
    assert!(has_note(&silent, "4: features[3].geometry, from (0, -100) to (100, 0)"), "{:?}", silent.notes);
    for value in ["4", "50,-20", "below:0"] {
        let imported = read(&text, Format::GeoJson, &options(&[value], &[]));
        assert_eq!((counts(&imported), verdict(&imported)), ((3, 1), Verdict::Stable), "{value}");
    }
    // Heights are in the unit of the drawing.
    let small = read(&text, Format::GeoJson, &options(&["below:0"], &["90,250"]).scale(0.001));
    assert_eq!(counts(&small), (2, 1));
    let left_out = read(&text, Format::GeoJson, &options(&["4"], &["3"]));
    assert_eq!((counts(&left_out), has_note(&left_out, "left out with --ignore: 1 of 4")), ((2, 1), true));
    for value in ["5", "999,0", "below:-200", "nothing"] {
        let refusal = refused(&text, Format::GeoJson, &options(&[value], &[]));
        assert_eq!((refusal.problems.len(), refusal.notes.is_empty()), (1, value == "nothing"), "{refusal:?}");
    }
}

#[test]
fn a_drawing_with_y_down_is_turned_upside_down() {
    let wall: Vec<(Value, [f64; 4])> = (0..3)
        .map(|i| {
            (
                json!({ "name": format!("s{i}") }),
                [200.0, 950.0 - 150.0 * f64::from(i), 500.0, 1100.0 - 150.0 * f64::from(i)],
            )
        })
        .collect();
    let floor = (json!({ "name": "ground" }), [100.0, 1100.0, 1500.0, 1180.0]);
    let text = rectangles(&[vec![floor], wall].concat());
    let hanging = read(&text, Format::GeoJson, &Options::default());
    assert_eq!(verdict(&hanging), Verdict::Unstable);
    let scene = Scene::new(hanging.scene).expect("sound");
    assert!(scene.notes().iter().any(|n| n.code == NoteCode::BelowGround), "{:?}", scene.notes());
    let turned = read(&text, Format::GeoJson, &Options::default().flip_y(true));
    assert_eq!(verdict(&turned), Verdict::Stable);
    let scene = Scene::new(turned.scene).expect("sound");
    assert!(!scene.notes().iter().any(|n| n.code == NoteCode::BelowGround), "{:?}", scene.notes());
}

#[test]
fn a_spreadsheet_of_well_known_text_is_a_drawing() {
    let text = "WKT,id,name\n\"POLYGON ((-1 -0.3,4 -0.3,4 0,-1 0,-1 -0.3))\",0,ground\n\"POLYGON ((0 0,1 0,1 0.5,0 0.5,0 0))\",1,a\n\
        \"POLYGON ((1.2 0,2.2 0,2.2 0.5,1.2 0.5,1.2 0))\",2,b\n\"POLYGON ((0.5 0.5,1.7 0.5,1.7 1,0.5 1,0.5 0.5))\",3,c\n";
    let imported = read(text, Format::Contacts, &Options::default());
    assert_eq!((ids(&imported), verdict(&imported)), (vec!["a", "b", "c"], Verdict::Stable));
}

#[test]
fn the_background_of_a_page_is_left_out() {
    let text = r#"<svg width="400" height="300" viewBox="0 0 400 300" fill="none" xmlns="http://www.w3.org/2000/svg">
        <rect width="400" height="300" fill="white"/><rect x="20" y="260" width="360" height="20"/>
        <path d="M100 210H200V260H100V210Z"/></svg>"#;
    let imported = read(text, Format::Svg, &options(&["below:41"], &[]));
    assert_eq!((counts(&imported), verdict(&imported)), ((1, 1), Verdict::Stable));
    assert!(has_note(&imported, "as large as the page"));
    let alone = r#"<svg viewBox="0 0 4 3" xmlns="http://www.w3.org/2000/svg"><rect width="4" height="3"/></svg>"#;
    assert_eq!(counts(&read(alone, Format::Svg, &Options::default())), (1, 0));
}

#[test]
fn clip_paths_cut_outlines_or_contain_them() {
    let text = |clip: &str| {
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="400mm" height="300mm" viewBox="0 0 400 300">
            <clipPath id="page"><rect width="400" height="300"/></clipPath><clipPath id="c">{clip}</clipPath>
            <g clip-path="url(#page)"><g clip-path="url(#c)"><rect id="s" x="100" y="120" width="120" height="160"/></g></g></svg>"##
        )
    };
    let square = read(&text(r#"<rect x="100" y="100" width="80" height="100"/>"#), Format::Svg, &Options::default());
    assert!((area(&square, 0) - 0.08 * 0.08).abs() < 1e-12);
    assert_eq!(square.remarks.len(), 1, "only the ground is missing: {:?}", square.remarks);
    let round = read(&text(r#"<circle cx="160" cy="200" r="50"/>"#), Format::Svg, &Options::default());
    assert!((area(&round, 0) / (std::f64::consts::PI * 0.05 * 0.05) - 1.0).abs() < 0.02);
    // A concave clip path, and one of two outlines, are not used.
    for clip in [
        r#"<path d="M100 100H300L150 150L100 300Z"/>"#,
        r#"<rect width="150" height="150"/><rect y="150" width="9" height="9"/>"#,
    ] {
        let whole = read(&text(clip), Format::Svg, &Options::default());
        assert!((area(&whole, 0) - 0.12 * 0.16).abs() < 1e-12);
        assert!(
            whole.remarks.iter().any(|r| r.message.contains("the whole outline is imported")),
            "{:?}",
            whole.remarks
        );
    }
}

/// A box of size 1 whose ends are triangles, and one of whose sides is divided.
fn meshed(x: f64, z: f64) -> Value {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.0]];
    let vertex: serde_json::Map<String, Value> = (0..10)
        .map(|i| {
            let [u, w] = corners[i % 5];
            (i.to_string(), json!({ "x": x + u, "y": i / 5, "z": z + w }))
        })
        .collect();
    let face = json!({ "0": [0, 4, 3], "1": [4, 2, 3], "2": [4, 1, 2], "3": [5, 8, 9], "4": [9, 8, 7], "5": [9, 7, 6],
        "6": [0, 5, 9, 4], "7": [4, 9, 6, 1], "8": [1, 6, 7, 2], "9": [2, 7, 8, 3], "10": [3, 8, 5, 0] });
    json!({ "vertex": vertex, "face": face })
}

#[test]
fn a_prism_is_a_prism_however_it_is_meshed() {
    let node = |z: f64, support: bool| json!({ "block": { "data": meshed(0.0, z) }, "is_support": support });
    let assembly =
        |support| json!({ "data": { "graph": { "node": { "0": node(0.0, support), "1": node(1.0, false) } } } });
    let imported = read(&assembly(true).to_string(), Format::Compas, &Options::default());
    assert_eq!((counts(&imported), imported.scene.thickness), ((1, 1), Some(1.0)));
    assert_eq!(imported.scene.blocks[0].polygon.as_ref().expect("an outline").len(), 4);
    assert_eq!(verdict(&imported), Verdict::Stable);
    // Without supports, there is a warning, and numbers, points and heights choose the ground.
    let silent = assembly(false).to_string();
    let unsupported = read(&silent, Format::Compas, &Options::default());
    assert!(unsupported.remarks[0].message.contains("no part of the drawing is ground"));
    assert!(has_note(&unsupported, "1: block 0, from (0, 0) to (1, 1)"), "{:?}", unsupported.notes);
    for value in ["0", "0.5,0.5", "below:1"] {
        assert_eq!(counts(&read(&silent, Format::Compas, &options(&[value], &[]))), (1, 1), "{value}");
    }
}

#[test]
fn a_block_model_of_compas_dem_is_read() {
    let element = |z: f64, support: bool| json!({ "data": { "name": "Block", "material": "m", "geometry": { "data": meshed(0.0, z) }, "is_support": support } });
    let moved = json!({ "data": { "matrix": [[1, 0, 0, 0.25], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]] } });
    let mut top = element(0.0, false);
    top["data"]["transformation"] = moved;
    let model = json!({ "dtype": "compas_dem.models/BlockModel", "data": {
        "elements": { "f": element(0.0, true), "a": element(1.0, false), "c": top },
        "materials": { "m": { "data": { "density": 2000 } } },
        "graph": { "node": { "0": { "element": "f" }, "1": { "element": "a" }, "2": { "element": "c" } } } } });
    assert_eq!(Format::of_json(&model.to_string()), Format::Compas);
    let imported = read(&model.to_string(), Format::Compas, &Options::default());
    assert_eq!((counts(&imported), ids(&imported)), ((2, 1), vec!["1", "2"]));
    assert_eq!(imported.scene.blocks[0].density, Some(2000.0));
    assert!(imported.scene.blocks[1].polygon.as_ref().expect("an outline").contains(&[1.25, 3.0]));
    assert_eq!(verdict(&imported), Verdict::Stable);
}

#[test]
fn an_assembly_with_blocks_at_different_depths_is_refused() {
    let element = |x: f64, y: f64, z: f64| {
        let matrix = json!([[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]);
        json!({ "data": { "name": "Block", "geometry": { "data": meshed(0.0, 0.0) }, "is_support": z == 0.0,
            "transformation": { "data": { "matrix": matrix } } } })
    };
    let model = |depth: f64| {
        let model = json!({ "dtype": "compas_dem.models/BlockModel", "data": {
            "elements": { "f": element(0.0, 0.0, 0.0), "a": element(0.0, depth, 1.0) },
            "graph": { "node": { "0": { "element": "f" }, "1": { "element": "a" } } } } });
        model.to_string()
    };
    assert_eq!(verdict(&read(&model(0.0), Format::Compas, &Options::default())), Verdict::Stable);
    for depth in [5.0, 0.6] {
        let refusal = refused(&model(depth), Format::Compas, &Options::default());
        let message = &refusal.problems[0].message;
        let words = [format!("block 1 {depth} to "), "they do not lie in one plane".into()];
        assert!(words.iter().all(|words| message.contains(words)), "{message}");
    }
}

/// Two stones that were drawn by hand, and overlap by 3 of 900 mm; a third overlaps the second by 4 mm.
const BY_HAND: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="900mm" height="600mm" viewBox="0 0 900 600">
    <path id="a" d="M100 400L400 400L405 300L250 293L98 300Z"/><path id="b" d="M110 301L250 296L400 303L390 200L120 210Z"/>
    <path id="c" d="M121 214L391 204L390 100L120 110Z"/><rect id="ground" x="0" y="400" width="900" height="50"/></svg>"#;

#[test]
fn overlaps_are_one_problem_that_names_the_gap_that_closes_them() {
    let refusal = refused(BY_HAND, Format::Svg, &Options::default().gap(1e-4));
    let [problem] = refusal.problems.as_slice() else { panic!("{refusal:?}") };
    assert!(problem.message.contains("2 pairs of bodies overlap, by up to 0.00403 m: "), "{problem:?}");
    let gap = problem.help.split_whitespace().nth(1).and_then(|word| word.parse::<f64>().ok()).expect("a gap");
    assert!(gap < 0.01, "{problem:?}");
    let closed = read(BY_HAND, Format::Svg, &Options::default().gap(gap));
    assert_eq!((counts(&closed), verdict(&closed)), ((3, 1), Verdict::Stable));
    // The overlapping scene can be drawn with its problems.
    let scene = refusal.overlapping.expect("only overlaps are wrong");
    assert_eq!(Scene::from_json(&scene.to_json()).expect_err("it overlaps").list.len(), 2);
}

#[test]
fn blocks_that_touch_nothing_are_counted_with_the_gap_that_joins_them() {
    // Rubble with joints of mortar, 12 mm wide.
    let stone = |i: u32, j: u32| {
        let (x, y) = (0.3 * f64::from(i), 0.2 * f64::from(j));
        (json!({}), [x, y + 0.012, x + 0.288, y + 0.2])
    };
    let wall = (0..4).flat_map(|i| (0..3).map(move |j| stone(i, j))).collect::<Vec<_>>();
    let text = rectangles(&[vec![(json!({ "name": "ground" }), [0.0, -0.2, 1.2, 0.0])], wall].concat());
    let apart = read(&text, Format::GeoJson, &Options::default());
    let note =
        apart.notes.iter().find(|n| n.contains("12 of 12 blocks touch no other body; --gap 0.013 would join them"));
    assert!(note.is_some(), "{:?}", apart.notes);
    let joined = read(&text, Format::GeoJson, &Options::default().gap(0.013));
    assert_eq!(verdict(&joined), Verdict::Stable);
    assert!(!has_note(&joined, "touch no other body"), "{:?}", joined.notes);
}

#[test]
fn a_crate_with_its_own_centre_of_mass_tips_or_slides_at_the_angle_by_hand() {
    // The centre is 0.6 m from both edges and 0.9 m high: it tips at atan(0.6 / 0.9), or slides at atan(0.6) before.
    let tips = libm::atan(0.6 / 0.9).to_degrees();
    let slides = libm::atan(0.6).to_degrees();
    assert!((tips - 33.69).abs() < 0.005 && (slides - 30.96).abs() < 0.005);
    let verdict = |friction: f64, degrees: f64, place: &str| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let text = format!(
            r#"{{ "drystone": 1, "friction": {friction}, "gravity": [{}, {}],
                "ground": [{{ "polygon": [[-3, -1], [4, -1], [4, 0], [-3, 0]] }}],
                "blocks": [{{ "id": "crate", "mass": 100, {place} }}] }}"#,
            9.81 * sin,
            -9.81 * cos
        );
        Analysis::new(Scene::from_json(&text).expect("sound")).verdict()
    };
    let drawn = r#""polygon": [[0, 0], [1.2, 0], [1.2, 1.2], [0, 1.2]], "centre": [0.6, 0.9]"#;
    // The centre moves with the outline: here the crate was drawn on its side.
    let turned =
        r#""polygon": [[0, 0], [1.2, 0], [1.2, 1.2], [0, 1.2]], "centre": [0.9, 0.6], "angle": 90, "at": [1.2, 0]"#;
    for place in [drawn, turned] {
        for (friction, limit) in [(0.7, tips), (0.6, slides)] {
            assert_eq!(verdict(friction, limit - 0.01, place), Verdict::Stable, "{friction} {place}");
            assert_eq!(verdict(friction, limit + 0.01, place), Verdict::Unstable, "{friction} {place}");
        }
    }
}

#[test]
fn damaged_files_are_reported_and_never_panic() {
    let mut numbers = Random::new(47);
    let mut random = move |count: usize| numbers.below(count);
    let node = |z: f64| json!({ "block": { "data": meshed(0.0, z) }, "is_support": z == 0.0 });
    let assembly = json!({ "node": { "0": node(0.0), "1": node(1.0) } }).to_string();
    let spline = "0\nSECTION\n2\nENTITIES\n0\nSPLINE\n8\n0\n70\n1\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n2\n40\n2\n40\n2\n41\n1\n41\n0.7\n\
        41\n1\n41\n1\n10\n0\n20\n0\n10\n4\n20\n0\n10\n4\n20\n4\n10\n0\n20\n4\n0\nSPLINE\n8\n0\n71\n3\n11\n20\n21\n0\n11\n29\n21\n0\n\
        11\n29\n21\n5\n11\n20\n21\n0\n0\nENDSEC\n0\nEOF\n";
    let table = "WKT;id;friction\n\"POLYGON ((0 0,1 0,1 1,0 0))\";a;0.5\nPOLYGON ((2 0,3 0,3 1));ground;x\n";
    let list = "x;y;Masse\n25,0;35,0;2,0\n66,0;42,0;5,0\nA 1;B 2;x;y;N;R\n1;2;60,0;60,0;3,14159265;0,5\n1;0;0,0;0,0;pi/2;0,1\n";
    let clip = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><clipPath id="c"><circle cx="4" cy="4" r="3"/></clipPath>
        <g clip-path="url(#c)" transform="rotate(9)"><path id="a" d="M1 1H8L5 3Q9 9 1 8Z"/></g><rect width="9" height="9"/></svg>"##;
    let files = [
        (assembly.as_str(), Format::Compas),
        (spline, Format::Dxf),
        (table, Format::Contacts),
        (list, Format::Contacts),
        (clip, Format::Svg),
        (BY_HAND, Format::Svg),
    ];
    let bits = ["1e308", "-", ",", ";", "\"", "NaN", "0", "[", "}", "\n", "1e-300", "url(#a)"];
    for (whole, format) in files {
        assert!(import(whole, format, &Options::default()).is_ok() || whole == BY_HAND, "{whole}");
        for _ in 0..300 {
            let mut text = whole.to_owned();
            for _ in 0..=random(3) {
                let at = random(text.len());
                let to = (at + random(9)).min(text.len());
                text.replace_range(at..to, bits[random(bits.len())]);
            }
            let value = ["1", "0.5,0.5", "below:1", "a"][random(4)];
            for options in [Options::default(), options(&[value], &[])] {
                match import(&text, format, &options) {
                    Ok(imported) => assert!(Scene::from_json(&imported.scene.to_json()).is_ok(), "{text}"),
                    Err(refusal) => assert!(!refusal.problems.is_empty()),
                }
            }
        }
    }
}

#[test]
fn circles_of_drawings_are_circles_whatever_the_flattening() {
    let svg = |body: &str| {
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="400mm" height="300mm" viewBox="0 0 400 300">
            <rect id="ground" y="200" width="400" height="100"/>{body}</svg>"##
        )
    };
    let bodies = [
        r#"<circle cx="200" cy="150" r="50"/>"#,
        r#"<ellipse cx="100" cy="75" rx="25" ry="25" transform="scale(2)"/>"#,
        r#"<path d="M150 150A50 50 0 0 1 250 150A50 50 0 0 1 150 150Z"/>"#,
    ];
    for body in bodies {
        for flatten in [1e-4, 4e-4, 0.01] {
            let found = read(&svg(body), Format::Svg, &Options::default().flatten(flatten));
            let circle = found.scene.blocks[0].circle.as_ref().expect("a circle");
            assert!((circle.radius - 0.05).abs() < 1e-12, "{body}");
            assert_eq!(verdict(&found), Verdict::Stable, "{body}");
            assert!(!has_note(&found, "chords"));
        }
    }
    // Three logs drawn by hand, some tenths of a millimetre apart or over each other.
    let pile = r#"<circle cx="150" cy="150.1" r="50"/><circle cx="250.1" cy="149.9" r="50"/><circle cx="200" cy="63.5" r="50"/>"#;
    assert_eq!(verdict(&read(&svg(pile), Format::Svg, &Options::default())), Verdict::Stable);
}

#[test]
fn circles_of_cad_files_and_of_two_bulges_have_their_area() {
    let dxf = |entity: &str| format!("0\nSECTION\n2\nENTITIES\n{entity}0\nENDSEC\n0\nEOF\n");
    let circle = dxf("0\nCIRCLE\n8\nblocks\n10\n3\n20\n4\n40\n5\n");
    let bulges = dxf("0\nLWPOLYLINE\n8\nblocks\n90\n2\n70\n1\n10\n-2\n20\n4\n42\n1\n10\n8\n20\n4\n42\n1\n");
    for text in [circle, bulges] {
        let found = read(&text, Format::Dxf, &Options::default());
        assert!((area(&found, 0) - 25.0 * std::f64::consts::PI).abs() < 1e-9);
        assert_eq!(found.scene.blocks[0].circle.as_ref().expect("a circle").centre, [3.0, 4.0]);
    }
}
