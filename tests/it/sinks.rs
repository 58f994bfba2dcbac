//! Text from files stays text: hostile strings are written to every kind of output. All kinds of output are listed
//! here.
//!
//! Each output is parsed again. The parser of its format must find each string as one text, and no additional
//! elements.

use std::fs;
use std::path::{Path, PathBuf};

use drystone::internals::study::{TOLERANCES, study};
use drystone::internals::text::HIDDEN;
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, Scene, figure, output, report};
use pulldown_cmark::{Event, Options, Parser, Tag};
use serde_json::{Value, json};

/// Titles and names that a hostile author may write.
const HOSTILE: &[&str] = &[
    "x\n  all     stands    29.43 N       none        0 %   no robot   forces balance to 0e0\n\nnext",
    "x\r  all     stable    29.43 N",
    "x\u{2028}  all  stable\u{2029}y\u{85}z",
    "\u{1b}[31mred\u{1b}]0;title\u{7}\u{9b}2J",
    "nul\u{0}, bell\u{7}, delete\u{7f}",
    "\u{202e}elbats\u{202c} \u{2066}inside\u{2069}",
    "</title><script>alert(1)</script>",
    "\" onload=\"alert(1)",
    "' & <!-- --> ]]> <![CDATA[",
    "[click](javascript:alert(1))",
    "x\n\n# heading\n\n- list\n\n<script>alert(1)</script>\n\n```\ncode",
    "a | b |\n|---|---|\n| c | d",
    "![p](http://h.example/p.png) http://h.example www.h.example",
    "=HYPERLINK(\"http://h.example\")",
    "+1,\"2\"\n-3",
    "@SUM(1,1)",
    "-2+3",
    "\u{fffe}\u{ffff}\u{1ffff}",
    "שלום 石 ü",
];

fn scene(hostile: &str) -> String {
    json!({
        "drystone": 1, "title": hostile, "friction": 0.6,
        "ground": [{ "polygon": [[-1, -1], [4, -1], [4, 0], [-1, 0]] }],
        "blocks": [
            { "id": hostile, "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]] },
            { "id": "b", "polygon": [[0, 1], [3, 1], [3, 2], [0, 2]] } ],
        "robots": [{ "id": format!("r{hostile}") }],
        "steps": [{ "title": hostile, "place": [hostile, "b"] },
                  { "title": format!("2 {hostile}"), "hold": { format!("r{hostile}"): "b" } }]
    })
    .to_string()
}

/// Calls `check` with each hostile text, the scene that contains it, and the analysis of this scene.
fn each(mut check: impl FnMut(&str, &Scene, &Analysis)) {
    for hostile in HOSTILE {
        let scene = Scene::from_json(&scene(hostile)).unwrap_or_else(|e| panic!("{hostile:?}: {e}"));
        check(hostile, &scene, &Analysis::new(&scene));
    }
}

/// Whether a character can have an effect on a terminal other than being displayed.
fn acts(c: char) -> bool {
    (c.is_control() && c != '\n')
        || matches!(c, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn assert_harmless(output: &str, hostile: &str) {
    assert!(!output.contains(acts), "{hostile:?} has an effect in {output:?}");
}

#[test]
fn a_terminal_has_a_line_for_each_frame_and_no_more() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |arguments: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_drystone"))
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .expect("starts");
        (
            output.status.code(),
            String::from_utf8(output.stdout).expect("UTF-8"),
            String::from_utf8(output.stderr).expect("UTF-8"),
        )
    };
    let mut counts = Vec::new();
    for hostile in HOSTILE {
        fs::write(folder.path().join("a.json"), scene(hostile)).expect("writable");
        let (_, out, err) = run(&["check", "--no-timing", "a.json"]);
        assert_harmless(&(out.clone() + &err), hostile);
        counts.push(out.lines().count());
        // Error messages quote an unknown name and the line of the file that contains it.
        let wrong = scene(hostile).replace("\"place\":[", "\"place\":[\"none\",");
        fs::write(folder.path().join("a.json"), wrong).expect("writable");
        let (code, out, err) = run(&["check", "a.json"]);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{hostile:?}");
        assert_harmless(&err, hostile);
        assert!(!err.lines().any(|l| l.trim_start().starts_with("all  ")), "{err}");
    }
    assert!(counts.windows(2).all(|pair| pair[0] == pair[1]), "{counts:?}");
}

#[test]
fn svg_has_the_same_elements_for_all_texts() {
    let mut shapes: Vec<Vec<String>> = Vec::new();
    each(|hostile, _, analysis| {
        let svg = output::svg::write(&figure::forces(analysis, &figure::Options::default()));
        assert_harmless(&svg, hostile);
        let document = roxmltree::Document::parse(&svg).unwrap_or_else(|e| panic!("{hostile:?}: {e}"));
        let mut names: Vec<String> = document
            .descendants()
            .filter(roxmltree::Node::is_element)
            .map(|n| n.tag_name().name().to_owned())
            .collect();
        names.sort();
        names.dedup();
        shapes.push(names);
        assert!(!document.descendants().any(|n| n.has_attribute("onload")));
        let pdf = output::pdf::write(&figure::forces(analysis, &figure::Options::default()), None);
        assert!(pdf.is_ok_and(|bytes| bytes.starts_with(b"%PDF-")), "{hostile:?}");
    });
    assert!(shapes.windows(2).all(|pair| pair[0] == pair[1]), "{shapes:?}");
}

#[test]
fn json_has_the_same_values_and_no_control_characters() {
    each(|hostile, scene, analysis| {
        for layout in [Layout::Lines, Layout::OneLine] {
            let text = to_json(analysis, Timing::LeftOut, layout);
            assert_harmless(&text, hostile);
            let value: Value = serde_json::from_str(&text).expect("JSON");
            assert_eq!(value["scene"], *hostile);
            assert_eq!(value["frames"][0]["title"], *hostile);
        }
        assert_eq!(scene.title(), hostile, "the scene keeps the complete text");
    });
}

#[test]
fn a_page_a_table_and_markdown_of_a_study_have_the_same_structure_for_all_texts() {
    let mut shapes = Vec::new();
    for hostile in HOSTILE {
        let mut file: Value = serde_json::from_str(&scene(hostile)).expect("JSON");
        file["steps"].as_array_mut().expect("steps").truncate(1);
        let scene = Scene::from_json(&file.to_string()).expect("sound");
        let study = study(&[scene], &TOLERANCES[..1], &mut |_| {});
        let page = report::accuracy::page(&study).expect("drawn");
        assert_harmless(&page, hostile);
        let tags = page.matches('<').count();
        let csv = report::accuracy::csv(&study);
        assert_harmless(&csv, hostile);
        for cell in csv.lines().skip(1).map(|line| line.split(',').nth(1).unwrap_or("")) {
            assert!(!cell.trim_start_matches(['"', ' ']).starts_with(['=', '+', '-', '@']), "{cell}");
        }
        let svg = report::accuracy::svg(&study).expect("drawn");
        assert!(roxmltree::Document::parse(&svg).is_ok(), "{hostile:?}");
        assert_harmless(&drystone::result::accuracy_json(&study), hostile);
        // The number of points in the picture depends on the times, so only the table is compared.
        let table = page.split("</svg>").nth(1).unwrap_or_default().matches('<').count();
        shapes.push((table, csv.lines().count(), report::accuracy::markdown(&study).lines().count()));
        assert!(tags > table);
    }
    assert!(shapes.windows(2).all(|pair| pair[0].1 == pair[1].1 && pair[0].2 == pair[1].2), "{shapes:?}");
}

/// The elements of a Markdown text other than paragraphs and plain text.
fn begun(markdown: &str) -> Vec<String> {
    Parser::new_ext(markdown, Options::all())
        .filter_map(|event| match event {
            Event::Start(Tag::Paragraph) | Event::Text(_) | Event::End(_) | Event::SoftBreak => None,
            other => Some(format!("{other:?}")),
        })
        .collect()
}

#[test]
fn hostile_text_stays_text_in_markdown_and_in_a_book() {
    for hostile in HOSTILE {
        let words = drystone::internals::text::markdown(hostile);
        assert_eq!(begun(&words), Vec::<String>::new(), "{hostile:?} as {words:?}");
        let content = format!("Before.\n\n```drystone\n{}\n```\n\nAfter.", scene(hostile));
        let chapter = json!({ "Chapter": { "name": "A", "content": content, "number": [1], "sub_items": [],
            "path": "a.md", "source_path": "a.md", "parent_names": [] } });
        let input = json!([{ "root": ".", "config": { "book": { "src": "src" } }, "renderer": "html",
            "mdbook_version": "0.4.40" }, { "sections": [chapter], "__non_exhaustive": null }]);
        let drawn = report::book::illustrate(&input.to_string()).expect("drawn");
        let drawn: Value = serde_json::from_str(&drawn).expect("JSON");
        let content = drawn["sections"][0]["Chapter"]["content"].as_str().expect("text");
        assert_harmless(content, hostile);
        for event in Parser::new_ext(content, Options::all()) {
            assert!(
                !matches!(
                    event,
                    Event::Start(
                        Tag::Link { .. } | Tag::Heading { .. } | Tag::List(_) | Tag::Image { .. } | Tag::CodeBlock(_)
                    )
                ),
                "{hostile:?}: {event:?}"
            );
        }
        assert!(!content.contains("<script"), "{hostile:?}");
    }
}

#[test]
fn reports_of_snapshots_have_the_same_structure_for_all_names() {
    use drystone::snapshot::fact::{DIGITS, Facts};
    use drystone::snapshot::{CheckOutcome, Finding, Layer, Snapshot, State, ci, review};
    let mut shapes = Vec::new();
    each(|hostile, _, analysis| {
        let facts = Facts::new(analysis, DIGITS);
        assert_harmless(&facts.text(), hostile);
        assert_eq!(Facts::read(&facts.text()), Ok(facts), "{hostile:?}");
        let finding = Finding {
            layer: Layer::Facts,
            file: hostile.into(),
            state: State::Changed,
            words: vec![hostile.to_owned(), "N 3 → 4.2 N".into()],
            fresh: Vec::new(),
            expected: None,
            difference: None,
            picture: None,
            is_invisible: false,
        };
        let report = CheckOutcome {
            snapshots: vec![Snapshot {
                name: hostile.to_owned(),
                scene: Some(hostile.into()),
                references: Vec::new(),
                findings: vec![finding],
                notes: Vec::new(),
            }],
            orphans: vec![(hostile.into(), "delete it".into())],
            ..CheckOutcome::default()
        };
        let xml = ci::junit(&report);
        assert_harmless(&xml, hostile);
        let document = roxmltree::Document::parse(&xml).unwrap_or_else(|e| panic!("{hostile:?}: {e}"));
        let elements = document.descendants().filter(roxmltree::Node::is_element).count();
        let annotations = ci::annotations(&report);
        for annotation in &annotations {
            assert_harmless(annotation, hostile);
            assert_eq!(annotation.lines().count(), 1, "{annotation:?}");
            assert_eq!(annotation.matches("::").count() - hostile.matches("::").count(), 2, "{annotation}");
        }
        let page = review::page(&report, &[hostile.into()]);
        assert_harmless(&page, hostile);
        assert!(!page.contains("<script>alert") && !page.contains("\" onload=\""));
        shapes.push((elements, annotations.len(), page.matches("<li>").count()));
    });
    assert!(shapes.windows(2).all(|pair| pair[0] == pair[1]), "{shapes:?}");
}

#[test]
fn hostile_text_stays_text_in_all_forms_of_a_report() {
    use drystone::report::entry::{Entry, File, ReportOptions};
    use drystone::report::page::{Form, Piece, Refused, Report};
    use drystone::scene::Problem;
    each(|hostile, _, analysis| {
        let text = scene(hostile);
        let file = File { name: hostile, text: &text };
        let entry = Entry::new(file, analysis, &ReportOptions::default());
        let mut problem: Problem = Scene::from_json("").expect_err("refused").list.remove(0);
        problem.path = hostile.into();
        problem.message = hostile.into();
        problem.help = hostile.into();
        for form in [Form::Html, Form::Split, Form::Markdown, Form::Json] {
            let piece = |number| Piece::new(&entry, number, form, "r").expect("drawn");
            let report = Report {
                title: hostile.into(),
                pieces: vec![piece(1), piece(2)],
                refused: vec![Refused { name: hostile.into(), problems: vec![problem.clone()] }],
                notes: vec![hostile.into()],
                compares: false,
                dark: None,
                interactive: None,
            };
            for (name, bytes) in report.files(form, "r").expect("written") {
                let text = String::from_utf8(bytes).expect("UTF-8");
                assert_harmless(&text, hostile);
                if name.ends_with(".html") {
                    assert_eq!(text.matches("<script").count(), 1, "{hostile:?}: {name}");
                    assert_eq!(text.matches("</noscript").count(), text.matches("<noscript").count());
                    assert!(!text.contains("<img") && !text.contains("\" onload="), "{hostile:?}");
                } else if name.ends_with(".md") {
                    for event in Parser::new_ext(&text, Options::all()) {
                        // The only links are those of the report, from the table of all scenes to the scenes.
                        let acts = match &event {
                            Event::Html(html) | Event::InlineHtml(html) => {
                                !html.starts_with("<a id=\"scene-") && **html != *"</a>"
                            }
                            Event::Start(Tag::Link { dest_url, .. }) => !dest_url.starts_with("#scene-"),
                            event => matches!(event, Event::Start(Tag::CodeBlock(_))),
                        };
                        assert!(!acts, "{hostile:?}: {event:?}");
                    }
                } else if name.ends_with(".json") {
                    let value: Value = serde_json::from_str(&text).expect("JSON");
                    assert_eq!(value["scenes"][0]["file"], *hostile);
                    assert_eq!(value["scenes"][2]["problems"][0]["message"], *hostile);
                }
            }
        }
    });
}

#[test]
fn invisible_characters_are_made_visible() {
    each(|hostile, _, analysis| {
        let hidden = hostile.contains(|c: char| acts(c) && !"\r\u{85}\u{2028}\u{2029}".contains(c));
        let svg = output::svg::write(&figure::forces(analysis, &figure::Options::default()));
        if hidden && !hostile.contains("\u{fffe}") {
            assert!(svg.contains(HIDDEN), "{hostile:?}");
        }
    });
}

/// For each kind of output, an expression that its writers contain, and the files that may contain it. A new file
/// with such an expression must be added here.
const WRITERS: &[(&str, &[&str])] = &[
    ("io::stdout", &["entry/cli/terminal.rs", "entry/cli/mod.rs", "entry/cli/batch/output.rs"]),
    ("io::stderr", &["entry/cli/terminal.rs", "entry/cli/mod.rs", "entry/cli/progress.rs"]),
    ("anstream", &["entry/cli/terminal.rs"]),
    ("PreEscaped", &["products/report/accuracy.rs", "products/report/html/", "products/snapshot/review.rs"]),
    (
        "\"<",
        &[
            "pictures/output/svg.rs",
            // Base64 between two tags.
            "pictures/output/attachment.rs",
            // Inserts the name space into a finished chart.
            "products/report/entry/part.rs",
            // Refuses a script that would close its own element; it writes nothing.
            "entry/cli/report.rs",
            // Compares a number with a goal; it writes no markup.
            "entry/cli/vary/varied.rs",
            // Draws the bar of a margin in a table cell.
            "products/report/print/table.rs",
            "pictures/output/svg/",
            "pictures/output/tree.rs",
            "pictures/chart/",
            "products/report/book.rs",
            "products/report/accuracy.rs",
            "products/report/markdown.rs",
            "products/result/",
            "products/snapshot/ci.rs",
            // Compares drawings as text; it writes no markup.
            "products/snapshot/svg.rs",
        ],
    ),
    ("fs::write", &[]),
    // The output of `batch` grows line by line, so that an interrupted run can be resumed.
    ("File::create", &["entry/cli/batch/output.rs", "entry/cli/batch/resume.rs"]),
    ("to_writer", &["products/result/", "mechanics/scene/format.rs", "mechanics/scene/format/"]),
    (".literal(", &["entry/cli/"]),
    ("page.block(", &["entry/cli/error.rs"]),
];

#[test]
fn only_the_listed_files_write_output() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let mut faults = Vec::new();
    for file in &files {
        let text = fs::read_to_string(file).expect("UTF-8");
        // Tests and examples may write any output.
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let path = file.strip_prefix(&root).expect("below").to_string_lossy().replace('\\', "/");
        if path.ends_with("tests.rs") || path.starts_with("sources/import/") {
            continue;
        }
        for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for (sign, writers) in WRITERS {
                let known = |w: &&str| path == *w || (w.ends_with('/') && path.starts_with(*w));
                if line.contains(sign) && !writers.iter().any(known) {
                    faults.push(format!("{path}: {}", line.trim()));
                }
            }
        }
    }
    assert!(files.len() > 100 && faults.is_empty(), "{}", faults.join("\n"));
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}
