//! The sheet of a scene: two pages, with what a support is, the stone, and the collapse of the headline margin.

use std::path::Path;

use super::Folder;

fn scene(name: &str) -> String {
    let path = format!("{}/tests/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("readable")
}

#[test]
fn a_sheet_has_two_pages_with_an_outline_margins_forces_and_the_collapse() {
    for name in ["arch13", "archload", "buttress", "loaded", "slide"] {
        let folder = Folder::new(&[("a.json", &scene(name))]);
        folder.done("report a.json -o a.pdf");
        let pdf = std::fs::read(folder.path("a.pdf")).expect("there");
        let pdf = String::from_utf8_lossy(&pdf);
        let pages = pdf.matches("/Type/Page/").count() + pdf.matches("/Type /Page\n").count();
        assert_eq!(pages, 2, "{name}");
        folder.done("report a.json -o a.html");
        let page = folder.text("a.html");
        let at = |words: &str| page.find(words).unwrap_or_else(|| panic!("{name}: {words}"));
        let parts = [
            "data-kind=\"structure\"",
            ">Supports and settings<",
            ">Reactions<",
            ">Margins<",
            "data-kind=\"forces\"",
            ">Balance of forces<",
            ">Assumptions and proof<",
        ];
        let places = parts.map(at);
        assert!(places.is_sorted(), "{name}: {places:?}");
        assert!(page.contains(">Where it would fail first<") || page.contains(">Where it fails<"), "{name}");
        assert!(!page.contains("no room for"), "{name}");
    }
}

/// The joints of the table are those of the collapse of the headline margin, and the use of the listed balance is called
/// one of many.
#[test]
fn the_joints_are_those_of_the_collapse_of_the_headline_margin() {
    let folder = Folder::new(&[("a.json", &scene("archload"))]);
    folder.done("report a.json -o a.md");
    let text = folder.text("a.md");
    assert!(text.contains("of one possible balance") || text.contains("missing"), "{text}");
    let rows = text.lines().filter(|line| line.contains("| hinge |")).count();
    assert!(text.contains(&format!("with {rows} hinges")), "{text}");
    for words in ["opening 100", "nearest to opening", "Governing"] {
        assert!(!text.contains(words), "{words}: {text}");
    }
}

#[test]
fn a_support_is_named_by_its_side() {
    let text = r#"{ "drystone": 1, "density": 2700, "friction": 0.58,
        "ground": [{ "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] },
                   { "polygon": [[1, 0], [2, 0], [2, 3], [1, 3]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]] }],
        "loads": [{ "block": "a", "at": [0, 1], "force": [3000, 0] }] }"#;
    let folder = Folder::new(&[("a.json", text)]);
    folder.done("report a.json -o a.md");
    let page = folder.text("a.md");
    for words in ["| ground under a |", "| wall right of a |", "| all blocks |"] {
        assert!(page.contains(words), "{words}: {page}");
    }
    assert!(!page.contains("unnamed"), "{page}");
}

#[test]
fn the_inputs_are_those_that_the_author_gave() {
    let text = r#"{ "drystone": 1, "ground": [{ "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]], "mass": 500 },
                   { "id": "b", "polygon": [[1, 0], [2, 0], [2, 2], [1, 2]], "weight": 7000 }],
        "loads": [{ "id": "crane", "block": "a", "force": [0, -900] }, { "block": "b", "force": [0, -800] }] }"#;
    let folder = Folder::new(&[("a.json", text)]);
    folder.done("report a.json -o a.md");
    let page = folder.text("a.md");
    for words in ["| mass of a block, kg |", "| 2 | – | 500 | 0.7 |", "| crane: a |", "| b | 1.5 |"] {
        assert!(page.contains(words), "{words}: {page}");
    }
}

#[test]
fn a_case_is_written_with_its_factors_and_a_vehicle_with_its_axles() {
    let [wall, bridge] = ["retaining-wall", "bridge-vehicle"].map(|name| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/questions/{name}.json"));
        std::fs::read_to_string(path).expect("a scene")
    });
    let mut bridge: serde_json::Value = serde_json::from_str(&bridge).expect("JSON");
    bridge["vehicle"]["axles"] = serde_json::json!([{ "weight": 9000 }, { "weight": 40, "offset": 1.2 }]);
    let folder = Folder::new(&[("wall.json", &wall), ("bridge.json", &bridge.to_string())]);
    folder.done("report wall.json -o wall.md");
    folder.done("report bridge.json -o bridge.md");
    let (wall, bridge) = (folder.text("wall.md"), folder.text("bridge.md"));
    // The density is that of the scene, not of a case with 0.9 of the weights.
    for words in
        ["| all blocks | 4 | 2300 |", "1.35 × earth, 1.35 × people, 0.9 × weights", "earth, 1.5 × wind, weights"]
    {
        assert!(wall.contains(words), "{words}: {wall}");
    }
    for words in ["| 1 | 9000 | 0 |\n| 2 | 40 | 1.2 |", "| axle 1 on ", "falls · under its vehicle"] {
        assert!(bridge.contains(words), "{words}: {bridge}");
    }
}

/// The figure of the vehicle is the first after the outline, the table of the collapse has the joints of this figure, and each
/// load case and each movement has a figure.
#[test]
fn a_vehicle_its_cases_and_its_movements_have_figures_and_tables() {
    let read = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/questions/{name}.json"));
        std::fs::read_to_string(path).expect("a scene")
    };
    let [bridge, wall, arch] = ["bridge-vehicle", "retaining-wall", "spreading-arch"].map(read);
    let folder = Folder::new(&[("bridge.json", &bridge), ("wall.json", &wall), ("arch.json", &arch)]);
    for name in ["bridge", "wall", "arch"] {
        folder.done(&format!("report {name}.json -o {name}.md"));
    }
    folder.done("report bridge.json -o out.json");
    let result: serde_json::Value = serde_json::from_str(&folder.text("out.json")).expect("JSON");
    let positions = result["scenes"][0]["frames"][0]["vehicle"]["positions"].as_array().expect("positions").len();
    let [page, wall, arch] = ["bridge.md", "wall.md", "arch.md"].map(|name| folder.text(name));
    assert!(page.contains("*Figure 3: The forces") && page.contains("See Figures 2 and 3."), "{page}");
    let captions: Vec<&str> = page.lines().filter(|line| line.starts_with('*') && !line.starts_with("**")).collect();
    assert!(captions[1].contains("The load factor for each position of the first axle"), "{captions:?}");
    let rows = page.split("The positions with the least load factors").nth(1).expect("a table");
    let rows = rows.lines().skip(2).take_while(|line| !line.is_empty());
    assert_eq!(rows.filter(|line| line.starts_with("| ") && line.contains("1: ")).count(), 12, "{page}");
    assert!(page.contains("| **3.851** | **to the right** | **1: A5** | **1.89** |"), "{page}");
    folder.done("report bridge.json -o full.md --full");
    let full = folder.text("full.md");
    assert_eq!(full.lines().filter(|line| line.contains("to the ") && line.contains("1: ")).count(), positions);
    for case in ["earth alone", "wind"] {
        assert!(wall.contains(&format!(": Load case {case}: the forces of one possible balance.*")), "{wall}");
    }
    assert_eq!(arch.matches("How the structure cracks if right moves by").count(), 2 * 2, "{arch}");
    assert!(arch.contains("| movement of a support | right moves by"), "{arch}");
}

/// Only a report that is not full adds up the loads after the twelfth.
#[test]
fn a_full_report_lists_all_loads() {
    let load = |number: usize| format!(r#"{{ "block": "a", "at": [0, {number}e-1], "force": [9{number}, -50] }}"#);
    let loads: Vec<String> = (0..20).map(load).collect();
    let text = format!(
        r#"{{ "drystone": 1, "density": 2400, "ground": [{{ "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] }}],
        "blocks": [{{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]] }}], "loads": [{}] }}"#,
        loads.join(",")
    );
    let folder = Folder::new(&[("a.json", &text)]);
    for (more, rows) in [("", 12), (" --full", 20)] {
        folder.done(&format!("report a.json -o a.md{more}"));
        let page = folder.text("a.md");
        assert_eq!(page.lines().filter(|line| line.starts_with("| a | 0 |")).count(), rows, "{page}");
        assert_eq!(page.contains("| 8 more, together |"), more.is_empty(), "{page}");
    }
}

/// The collapse at the least friction slides with this friction, not with the present one.
#[test]
fn a_ladder_has_a_table_of_the_joints_that_slide_at_its_least_friction() {
    let mut ladder = crate::validation::blocks::ladder();
    ladder["friction"] = serde_json::json!(0.2);
    let folder = Folder::new(&[("a.json", &ladder.to_string())]);
    folder.done("report a.json -o a.md");
    let page = folder.text("a.md");
    assert!(page.contains("stands down to 0.884 × its friction (0.177)"), "{page}");
    assert!(page.contains("beyond, 1 block moves, with 2 sliding and tipping joints."), "{page}");
    assert_eq!(page.matches("| slides and tips |").count(), 2, "{page}");
}

#[test]
fn a_report_names_the_steps_that_fall() {
    let step = |place: &[&str]| serde_json::json!({ "place": place });
    let block = |id: &str, x: f64, y: f64| serde_json::json!({ "id": id, "polygon": [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]], "weight": 1 });
    let file = serde_json::json!({ "drystone": 1, "ground": [{ "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] }],
        "blocks": [block("a", 0.0, 0.0), block("b", 0.6, 1.0), block("c", 1.0, 0.0)],
        "steps": [step(&["a"]), step(&["b"]), step(&["c"])] });
    let folder = Folder::new(&[("a.json", &file.to_string())]);
    for (name, words) in [("a.md", "falls in step (b) of 3"), ("a.html", "</span> in step (b) of 3")] {
        folder.run(&format!("report a.json -o {name}"));
        assert!(folder.text(name).contains(words), "{}", folder.text(name));
    }
}

#[test]
fn a_sheet_of_many_loads_has_two_pages() {
    let load = |number: usize| format!(r#"{{ "block": "a", "at": [0, {number}e-1], "force": [9{number}, -50] }}"#);
    let loads: Vec<String> = (1..9).map(load).collect();
    let text = format!(
        r#"{{ "drystone": 1, "density": 2400, "ground": [{{ "polygon": [[-1, -1], [3, -1], [3, 0], [-1, 0]] }}],
        "blocks": [{{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]] }}], "loads": [{}] }}"#,
        loads.join(",")
    );
    let folder = Folder::new(&[("a.json", &text)]);
    folder.done("report a.json -o a.pdf");
    let pdf = std::fs::read(folder.path("a.pdf")).expect("written");
    assert_eq!(String::from_utf8_lossy(&pdf).matches("/Type/Page/").count(), 2);
}
