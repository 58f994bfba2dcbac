//! The command `report`: the content of a report in its four formats, and the behaviour of the HTML page in a
//! browser.

mod balance;
pub mod browser;
mod digits;
mod page;
mod sheet;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use pulldown_cmark::{Event, Options, Parser};
use tempfile::TempDir;

use crate::structure::{HALF_LINTEL as FALLS, LINTEL as STANDS};

/// A scene whose title and name contain HTML markup and invisible control characters.
const HOSTILE: &str = r#"{ "drystone": 1, "title": "<script>alert(1)</script> 𝔘🧱 שלום \u202egnihton",
  "ground": [{ "polygon": [[-1, -1], [4, -1], [4, 0], [-1, 0]] }],
  "blocks": [{ "id": "</noscript><img src=x onerror=alert(2)>", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]] }] }"#;

const WRONG: &str = r#"{ "drystone": 1,
  "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 1]], "weight": -3 },
             { "id": "b", "polygon": [[5, 0], [6, 0], [6, 1]], "friction": -0.25 }] }"#;

/// A folder of scenes that is removed at the end of the test.
struct Folder(TempDir);

/// The exit code of a run, and its output on standard error.
struct Ran(i32, String);

impl Folder {
    fn new(files: &[(&str, &str)]) -> Folder {
        let folder = Folder(tempfile::tempdir().expect("a folder"));
        for (name, text) in files {
            let path = folder.path(name);
            fs::create_dir_all(path.parent().expect("below")).expect("writable");
            fs::write(path, text).expect("writable");
        }
        folder
    }

    /// Two scenes that stand or fall, and one with hostile text.
    fn three() -> Folder {
        Folder::new(&[("in/a.json", STANDS), ("in/b.json", FALLS), ("in/deep/c.json", HOSTILE)])
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    fn run(&self, line: &str) -> Ran {
        let output = Command::new(env!("CARGO_BIN_EXE_drystone"))
            .args(line.split_whitespace())
            .current_dir(self.0.path())
            .stdin(Stdio::null())
            .output()
            .expect("starts");
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!errors.contains("panicked"), "{errors}");
        Ran(output.status.code().expect("no signal"), errors)
    }

    /// Runs a command line, and asserts that it succeeds.
    fn done(&self, line: &str) {
        let Ran(code, errors) = self.run(line);
        assert_eq!(code, 0, "{line}: {errors}");
    }
}

#[test]
fn a_report_has_the_exit_codes_of_render_and_with_strict_those_of_check() {
    let folder = Folder::three();
    for (line, code) in [
        ("report in -o r.html", 0),
        ("report in -o r.html --strict", 1),
        ("report in/a.json -o r.html --strict", 0),
        ("report in -o r.txt", 2),
        ("report in -o r.html --split", 2),
        ("report -o r.html", 2),
        ("report nowhere.json -o n.html", 2),
        ("report in/a.json -o in/a.json", 2),
        ("report in --compare -o r.html", 2),
        ("report in in/a.json --compare -o r.html", 2),
        ("report in -o missing/r.html", 4),
    ] {
        let Ran(ended, errors) = folder.run(line);
        assert_eq!(ended, code, "{line}: {errors}");
    }
    assert!(!folder.path("n.html").exists(), "there was no valid scene");
    assert_eq!(folder.text("in/a.json"), STANDS);
}

#[test]
fn an_invalid_scene_is_listed_and_the_others_are_reported() {
    let folder = Folder::new(&[("in/a.json", STANDS), ("in/b.json", WRONG), ("in/c.json", FALLS)]);
    for form in ["html", "md", "json", "pdf"] {
        let Ran(code, errors) = folder.run(&format!("report in -o r.{form}"));
        assert_eq!(code, 2, "{errors}");
        assert!(errors.contains("blocks[0].weight") && errors.contains("-0.25"), "{errors}");
        assert!(folder.path(&format!("r.{form}")).exists());
    }
    let page = folder.text("r.html");
    let listed = page.find("in/b.json").expect("listed");
    assert!(listed < page.find("A lintel").expect("reported"), "it is listed above the reported scenes");
    for words in ["blocks[0].weight", "-0.25", "Half a lintel", "1 stands, 1 falls; 1 file is not a valid scene"] {
        assert!(page.contains(words), "{words}");
    }
    let json: serde_json::Value = serde_json::from_str(&folder.text("r.json")).expect("JSON");
    assert_eq!(json["summary"], serde_json::json!({ "stable": 1, "unstable": 1, "undecided": 0, "refused": 1 }));
    let scenes = json["scenes"].as_array().expect("a list");
    assert_eq!(scenes[0]["file"], "in/a.json");
    assert_eq!(scenes[1]["frames"][0]["verdict"], "unstable");
    assert_eq!(scenes[2]["problems"].as_array().map(Vec::len), Some(2));
}

#[test]
fn the_same_scenes_give_the_same_bytes_and_times_are_written_only_on_request() {
    let folder = Folder::three();
    for form in ["html", "md", "json", "pdf"] {
        folder.done(&format!("report in -o a.{form} --margins --title T"));
        folder.done(&format!("report in -o a2.{form} --margins --title T"));
        let [a, b] = ["a", "a2"].map(|stem| {
            let bytes = fs::read(folder.path(&format!("{stem}.{form}"))).expect("there");
            String::from_utf8_lossy(&bytes).replace("a2-figures", "a-figures")
        });
        assert_eq!(a, b, "{form}");
    }
    assert!(!folder.text("a.json").contains("\"seconds\""));
    folder.done("report in -o t.json --timing");
    assert!(folder.text("t.json").contains("\"seconds\""));
    // Several effects are solved in one program, so the time is reported for each stage.
    folder.done("report in/a.json -o t.md --timing --margins --full");
    let timed = folder.text("t.md");
    let row = |name: &str| {
        let mut rows = timed.lines().filter(|l| l.starts_with(&format!("| {name}")));
        rows.next().unwrap_or_default().to_owned()
    };
    assert!(timed.contains("| unknowns | time |"), "{timed}");
    for stage in ["setting up", "solving and proving", "margins:"] {
        let time = row(stage);
        assert!(time.ends_with(" ms |") || time.ends_with(" s |"), "{time}");
    }
    assert!(row("friction:").ends_with("| shared |") && row("wedging:").ends_with("| none |"));
    assert!(!folder.text("a.md").contains("| time |"));
}

#[test]
fn the_largest_force_is_that_of_stable_steps_including_robots() {
    let held = r#"{ "drystone": 1, "title": "Held", "robots": [{ "id": "r", "holds": "a", "limits": { "force": 100 } }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": 40 }] }"#;
    let alone = r#"{ "drystone": 1, "title": "Alone",
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": 40 }] }"#;
    let folder = Folder::new(&[("in/a.json", held), ("in/b.json", alone), ("in/c.json", FALLS)]);
    folder.done("report in -o r.html");
    let text = folder.text("r.html");
    let table = text.split("<tbody>").nth(1).expect("a table");
    let table = table.split("</tbody>").next().expect("closed");
    let row = |title: &str| {
        let mut rows = table.split("<tr ").filter(|row| row.contains(title));
        rows.next().unwrap_or_default().to_owned()
    };
    assert!(row(">Held<").contains(">40 N<"), "{}", row(">Held<"));
    assert_eq!(row(">Alone<").matches("none stands").count(), 1, "{table}");
    // The first step falls. The second step, in which a robot holds the block, has forces.
    let half = row("Half a lintel");
    assert!(half.contains(" N<") && !half.contains("none stands"), "{half}");
}

#[test]
fn a_report_in_json_contains_the_results_of_check() {
    let folder = Folder::three();
    folder.done("report in/b.json -o r.json --margins");
    let report: serde_json::Value = serde_json::from_str(&folder.text("r.json")).expect("JSON");
    let output = Command::new(env!("CARGO_BIN_EXE_drystone"))
        .args(["check", "--json", "--no-timing", "--margins", "in/b.json"])
        .current_dir(folder.0.path())
        .output()
        .expect("starts");
    let check: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["scenes"][0], check);
}

/// A scene in millimetres: every column of lengths is in millimetres, and its head says so.
#[test]
fn tables_of_a_report_name_the_length_unit_of_the_scene() {
    let mut scene: serde_json::Value = serde_json::from_str(STANDS).expect("JSON");
    scene["units"] = serde_json::json!({ "length": "mm" });
    let folder = Folder::new(&[("a.json", &scene.to_string())]);
    folder.done("report a.json -o r.md");
    let text = folder.text("r.md");
    let head = text.lines().find(|line| line.starts_with("| joint |"));
    let head = head.expect("the table of joints");
    for name in ["x, mm", "y, mm"] {
        assert!(head.contains(&format!("| {name} |")), "{name}: {head}");
    }
    assert!(!text.contains(", m |"), "{text}");
}

#[test]
fn markdown_has_figures_in_separate_files_and_texts_have_no_effect() {
    let folder = Folder::three();
    folder.done("report in -o r.md");
    let text = folder.text("r.md");
    assert!(text.contains("# Do they stand? 3 scenes") && text.contains("Half a lintel: falls"));
    let mut figures = 0;
    for part in text.split("](<").skip(1) {
        let name = part.split(">)").next().expect("closed");
        assert!(folder.text(name).starts_with("<svg"), "{name}");
        figures += 1;
    }
    // Each scene has three figures, or two if no figure shows how it would fall.
    assert!((7..=9).contains(&figures), "{figures}: {text}");
    for event in Parser::new_ext(&text, Options::all()) {
        // The only markup comes from the report: the targets of the names in the table of all scenes.
        let is_ours = |html: &str| html.starts_with("<a id=\"scene-") || html == "</a>";
        let (Event::Html(html) | Event::InlineHtml(html)) = &event else {
            continue;
        };
        assert!(is_ours(html), "{event:?}");
    }
    assert!(!text.contains('\u{202e}'));
    assert!(text.contains("](#scene-1) | ") && text.contains("<a id=\"scene-1\"></a>"));
}

#[test]
fn markdown_keeps_characters_that_no_font_has_and_figures_show_their_code_points() {
    let named = STANDS.replace("\"lintel\"", "\"石\"");
    let folder = Folder::new(&[("in/a.json", &named)]);
    folder.done("report in -o r.md");
    let text = folder.text("r.md");
    assert!(text.contains("| 石 / ") || text.contains(" / 石 |"), "{text}");
    assert!(!text.contains("U+77F3"), "{text}");
    let figure = text.split("](<").nth(1).expect("a figure");
    let name = figure.split(">)").next().expect("closed");
    assert!(folder.text(name).contains("U+77F3"), "the figure shows the code point");
}

#[test]
fn a_split_report_is_an_index_and_a_page_for_each_scene() {
    let folder = Folder::three();
    folder.done("report in -o out --split");
    let index = folder.text("out/index.html");
    for name in ["0001-a-lintel.html", "0002-half-a-lintel.html"] {
        assert!(index.contains(&format!("href=\"{name}\"")), "{name}");
        assert!(folder.text(&format!("out/{name}")).contains("href=\"index.html\""));
    }
    assert_eq!(fs::read_dir(folder.path("out")).expect("there").count(), 4);
}

#[test]
fn interactive_figures_need_the_script_of_the_same_version_in_an_html_report() {
    let version = env!("CARGO_PKG_VERSION");
    let first = format!("// drystone {version}: interactive figures\n");
    let folder = Folder::new(&[
        ("a.json", STANDS),
        ("pkg/interactive.js", &format!("{first}go(1 < 2);\n")),
        ("old.js", "// drystone 0.0.1: interactive figures\ngo();\n"),
        ("ends.js", &format!("{first}\"</script>\"\n")),
        ("other.js", "go();\n"),
    ]);
    for script in ["pkg", "pkg/interactive.js"] {
        folder.done(&format!("report a.json -o a.html --interactive {script}"));
        let page = folder.text("a.html");
        assert!(page.contains("go(1 < 2);"), "{script}");
        assert!(page.contains("worker-src blob:"), "{script}");
        assert!(page.contains("data-step=\"1\""), "{script}");
    }
    // Without a file: beside the program.
    let copy = folder.path("drystone");
    fs::copy(env!("CARGO_BIN_EXE_drystone"), &copy).expect("copied");
    fs::copy(folder.path("pkg/interactive.js"), folder.path("interactive.js")).expect("copied");
    let mut command = Command::new(copy);
    command.args(["report", "a.json", "-o", "beside.html", "--interactive"]).current_dir(folder.path(""));
    let made = command.output().expect("it runs");
    assert!(made.status.success() && folder.text("beside.html").contains("go(1 < 2);"));
    folder.done("report a.json -o plain.html");
    assert!(!folder.text("plain.html").contains("worker-src"));
    for (line, part) in [
        ("-o a.md --interactive pkg", "only an HTML report"),
        ("-o out --split --interactive pkg", "cannot be used with"),
        ("-o b.html --interactive none", "download interactive.js of the release v"),
        ("-o b.html --interactive", "finds no interactive.js beside the program; download"),
        ("-o b.html --interactive old.js", "belongs to drystone 0.0.1"),
        ("-o b.html --interactive ends.js", "is not the script"),
        ("-o b.html --interactive other.js", "is not the script"),
    ] {
        let Ran(code, errors) = folder.run(&format!("report a.json {line}"));
        assert!(code == 2 && errors.contains(part), "{line}: {code} {errors}");
    }
    assert!(!folder.path("b.html").exists());
}

#[test]
fn a_comparison_names_cases_axles_movements_and_fixed_parts_that_changed() {
    let scene = |factor: f64, fixed: &str, axle: f64, way: f64| {
        format!(
            r#"{{ "drystone": 1, "friction": 0.5,
            "ground": [{{ "id": "floor", "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }}],
            "blocks": [{{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }}],
            "loads": [{{ "id": "push", "block": "a", "force": [1, -1], "at": [1, 1]{fixed} }}],
            "cases": [{{ "id": "calm", "loads": {{}} }}, {{ "id": "storm", "loads": {{ "push": {factor} }} }}],
            "vehicle": {{ "axles": [{{ "weight": {axle} }}] }},
            "movements": [{{ "ground": "floor", "translation": [{way}, 0] }}] }}"#
        )
    };
    let before = scene(1.5, "", 1.0, 0.01);
    let changes = [
        (scene(1.75, "", 1.0, 0.01), "load case storm | 1.5 × push, weights | 1.75 × push, weights"),
        (scene(1.5, r#", "fixed": "vertical""#, 1.0, 0.01), "(1, -1) N at (1, 1) m, vertical part fixed"),
        (scene(1.5, "", 2.0, 0.01), "axles of the vehicle | 1 N, both ways | 2 N, both ways"),
        (scene(1.5, "", 1.0, 0.02), "movement of ground 1 | (0.01, 0) m | (0.02, 0) m"),
    ];
    for (after, words) in changes {
        let folder = Folder::new(&[("a.json", before.as_str()), ("b.json", after.as_str())]);
        folder.done("report --compare a.json b.json -o r.md");
        let page = folder.text("r.md");
        assert!(page.contains(words), "{words}:\n{page}");
    }
}

#[test]
fn a_comparison_states_what_changed_and_marks_it_in_both_figures() {
    let heavier = STANDS.replace("\"weight\": 11", "\"weight\": 22");
    let shifted = heavier.replace("[5, 0], [6, 0], [6, 3], [5, 3]", "[4, 0], [5, 0], [5, 3], [4, 3]");
    let folder = Folder::new(&[
        ("a/x.json", STANDS),
        ("b/x.json", &shifted),
        ("a/only.json", STANDS),
        ("b/same.json", STANDS),
        ("a/same.json", STANDS),
    ]);
    folder.done("report --compare a b -o r.html");
    let page = folder.text("r.html");
    for words in [
        "2 comparisons: no verdict changed; 2 stand, 0 fall",
        "Both stand; changed: ",
        "Only in the first folder: only.json",
        "changed: right and lintel",
        "weight 11 N → 22 N",
        "centroid moved by (-1, 0) m",
        "the blocks and their places are the same",
        "shared forces changed by over 5 %",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // Two figures for each of two pairs. Only the pair that differs has marks, in both of its figures.
    assert_eq!(page.matches("class=\"changed\"").count(), 2, "marks");
    assert_eq!(page.matches("<figure class=\"plate\"").count(), 4);
    folder.done("report --compare a/x.json b/x.json -o r.json");
    let json: serde_json::Value = serde_json::from_str(&folder.text("r.json")).expect("JSON");
    let pair = &json["comparisons"][0];
    assert_eq!(pair["scenes"].as_array().map(Vec::len), Some(2));
    assert!(pair["changes"][0].as_str().is_some_and(|words| words.contains("right")), "{pair}");
}

#[test]
fn a_comparison_lists_loads_robots_and_steps_of_only_one_scene() {
    let blocks = "{ \"id\": \"a\", \"polygon\": [[0,0],[2,0],[2,1],[0,1]], \"friction\": 0.7 },
        { \"id\": \"b\", \"polygon\": [[2,0],[4,0],[4,1],[2,1]], \"friction\": 0.7 }";
    let scene = |force: f64, more: &str| {
        format!(
            "{{ \"drystone\": 1, \"ground\": [{{ \"polygon\": [[-1,-1],[9,-1],[9,0],[-1,0]] }}], \"blocks\": [{blocks}], \
             \"loads\": [{{ \"block\": \"a\", \"force\": [0, {force}], \"at\": [1, 1] }}]{more} }}"
        )
    };
    let first = scene(-60.0, "");
    let lighter = scene(-30.0, ", \"kernel\": 0.2").replace("0.7", "0.5");
    let steps =
        ", \"steps\": [{ \"title\": \"One\", \"place\": [\"a\"] }, { \"title\": \"Both\", \"place\": [\"b\"] }]";
    let folder = Folder::new(&[("a.json", &first), ("b.json", &lighter), ("c.json", &scene(-60.0, steps))]);
    folder.done("report --compare a.json b.json -o b.html");
    let page = folder.text("b.html");
    for words in [
        "otherwise: safety kernel and load on a",
        "(0, -60) N at (1, 1) m",
        "(0, -30) N at (1, 1) m",
        // Stated once for both blocks.
        "friction coefficient 0.7 → 0.5",
        "a and b",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert_eq!(page.matches("friction coefficient 0.7 → 0.5").count(), 1);
    folder.done("report --compare c.json a.json -o c.html");
    let page = folder.text("c.html");
    assert!(page.contains("(a) ") && !page.contains("() <bdi>"), "{page}");
}

#[test]
fn a_comparison_is_in_the_units_of_both_scenes_or_says_that_it_is_in_si_units() {
    let scene = |weight: f64, units: &str| {
        format!(
            r#"{{ "drystone": 1, "friction": 0.6{units}, "ground": [{{ "polygon": [[-900,-100],[900,-100],[900,0],[-900,0]] }}],
                "blocks": [{{ "id": "a", "polygon": [[0,0],[200,0],[200,100],[0,100]], "weight": {weight} }}],
                "loads": [{{ "block": "a", "force": [0, -{weight}], "at": [100, 100] }}] }}"#
        )
    };
    let small = r#", "units": { "length": "mm", "force": "kN" }"#;
    let folder =
        Folder::new(&[("a.json", &scene(2.0, small)), ("b.json", &scene(3.0, small)), ("si.json", &scene(3.0, ""))]);
    folder.done("report --compare a.json b.json -o same.md");
    let page = folder.text("same.md");
    for words in [
        "weight of all blocks, kN | 2 | 3 ",
        "first, kN | second, kN",
        "weight 2 kN → 3 kN",
        "(0, -2) kN at (100, 100) mm",
    ] {
        assert!(page.contains(words), "{words} in {page}");
    }
    let note = "The two scenes have different units.";
    assert!(!page.contains(note), "{page}");
    folder.done("report --compare a.json si.json -o other.md");
    let page = folder.text("other.md");
    for words in
        [note, "weight of all blocks, N | 2000 | 3 ", "(0, -2000) N at (0.1, 0.1) m", "(0, -3) N at (100, 100) m"]
    {
        assert!(page.contains(words), "{words} in {page}");
    }
}

#[test]
fn a_pdf_has_all_pages_and_a_study_has_its_chart() {
    let folder = Folder::three();
    folder.done("report in -o r.pdf --theme paper");
    let pdf = fs::read(folder.path("r.pdf")).expect("there");
    assert!(pdf.starts_with(b"%PDF-"));
    let pages = String::from_utf8_lossy(&pdf).matches("/Type/Page/").count()
        + String::from_utf8_lossy(&pdf).matches("/Type /Page\n").count();
    assert!(pages >= 5, "{pages} pages: the first, and at least one for each step");
    folder.done("report in/a.json -o s.html --accuracy-study");
    assert!(folder.text("s.html").contains("What accuracy costs on this scene"));
}

#[test]
fn a_report_counts_the_moving_blocks_that_its_picture_draws_and_names_joints_that_slide_and_tip() {
    let scene = include_str!("../../assets/thesis/figure-8-right.json");
    let folder = Folder::new(&[("a.json", scene)]);
    folder.done("report a.json -o r.md");
    let report = folder.text("r.md");
    folder.done("render a.json --kind mechanism -o a.svg");
    let drawn = folder.text("a.svg").matches("class=\"displaced\"").count();
    assert!(drawn > 0);
    assert!(report.contains(&format!("{drawn} blocks move, with")), "{report}");
    assert!(report.contains("sliding and tipping joint"), "{report}");
}

#[test]
fn values_of_a_scene_are_set_for_one_run_and_stated() {
    let folder = Folder::new(&[("a.json", STANDS), ("c.ndjson", &STANDS.replace('\n', " "))]);
    folder.done("report --compare a.json --set load_factor=2 --set friction=0.65 -o r.json");
    let json: serde_json::Value = serde_json::from_str(&folder.text("r.json")).expect("JSON");
    let scenes = &json["comparisons"][0]["scenes"];
    assert!(scenes[0]["set"].is_null() && scenes[1]["set"].as_array().is_some_and(|set| set.len() == 2), "{scenes}");
    assert!(scenes[1]["scene"].as_str().is_some_and(|title| title.ends_with("friction = 0.65")), "{scenes}");
    folder.done("report --compare a.json --set kernel=0.1 -o r.md");
    let page = folder.text("r.md");
    let [differs, margins] = ["What else differs", "**Margins**"].map(|words| page.find(words).expect(words));
    assert!(differs < margins && page.contains("render a.json --set kernel=0.1 -o figure.svg"), "{page}");
    folder.done("render a.json --set friction=0.6 -o a.svg");
    assert!(folder.text("a.svg").contains("with friction = 0.6"));
    folder.done("batch c.ndjson --set tilt=1 -o c.out");
    assert!(folder.text("c.out").contains("with tilt = 1"));
    for (line, words) in [
        ("check a.json --set fricton=0.5", "the nearest known key is `friction`"),
        ("check a.json --set blocks.lintl.weight=1", "did you mean \"lintel\"?"),
        ("check a.json --set friction", "such as friction=0.5"),
        ("check a.json --set friction=1 --certificate p.json", "cannot be used with"),
    ] {
        let Ran(code, errors) = folder.run(line);
        assert!(code == 2 && errors.contains(words), "{line}: {errors}");
    }
    let Ran(_, errors) = folder.run("batch c.ndjson -o c.csv");
    assert!(errors.contains("1 scene: 1 stands"), "{errors}");
    folder.done("batch c.ndjson --margins --fields verdict -o m.ndjson");
    let line = folder.text("m.ndjson");
    assert!(line.contains("\"intervals\"") && !line.contains("mechanisms"), "{line}");
}

#[test]
fn habits_of_other_programs_work() {
    let folder = Folder::new(&[("in/a.json", STANDS), ("in/b.json", STANDS), ("wrong.json", WRONG)]);
    folder.done("report in/*.json -o r.json");
    let json: serde_json::Value = serde_json::from_str(&folder.text("r.json")).expect("JSON");
    assert_eq!(json["scenes"].as_array().map(Vec::len), Some(2));
    let Ran(code, errors) = folder.run("batch in/*.ndjson -o b.ndjson");
    assert!(code == 2 && errors.contains("no file matches this pattern"), "{errors}");
    folder.done("render in/a.json -o page-{0p}.svg --pages --force");
    assert!(folder.path("page-1.svg").exists());
    for command in ["render wrong.json -o w.svg", "report wrong.json -o w.html", "render in/*.json -o w.svg"] {
        let Ran(code, errors) = folder.run(&format!("{command} --diagnostics json"));
        assert_eq!(code, 2, "{command}: {errors}");
        for line in errors.lines() {
            let line: serde_json::Value = serde_json::from_str(line).expect(&errors);
            assert!(line["problems"][0]["message"].is_string() || line["note"].is_string(), "{line}");
        }
    }
}
