//! The house keeps its order: every `crate::` path points to a room that the room may use, and every foreign crate comes
//! in through its one door.
//!
//! Read from the source as text, comments and strings taken out, tests included: a test that reaches across the house
//! is as bad a neighbour as any other code.

use std::fs;
use std::path::Path;

use crate::source::{bare, collect, names_crate, rooms_used, without_groups};

/// What each room may use, itself apart. A room that is not listed here has no place in the house.
const ROOMS: &[(&str, &[&str])] = &[
    ("text", &[]),
    ("geometry", &[]),
    ("scene", &["text", "geometry"]),
    ("interface", &["geometry", "scene"]),
    ("assembly", &["geometry", "scene", "interface"]),
    ("effect", &["geometry", "scene", "interface", "assembly"]),
    ("program", &["geometry", "interface", "assembly", "effect"]),
    ("solve", &["geometry", "interface", "program"]),
    ("proof", &["geometry", "scene", "interface", "assembly"]),
    ("resultant", &["geometry", "scene", "interface", "solve"]),
    (
        "analysis",
        &[
            "geometry",
            "scene",
            "interface",
            "assembly",
            "effect",
            "program",
            "solve",
            "proof",
            "resultant",
        ],
    ),
    ("starter", &["scene"]),
    ("wording", &["geometry", "scene", "analysis"]),
    ("import", &["text", "geometry", "scene"]),
    ("drawing", &["text", "geometry"]),
    (
        "figure",
        &[
            "geometry",
            "scene",
            "interface",
            "analysis",
            "wording",
            "drawing",
        ],
    ),
    ("output", &["text", "drawing"]),
    ("chart", &["text", "drawing"]),
    (
        "study",
        &[
            "geometry",
            "scene",
            "interface",
            "assembly",
            "effect",
            "program",
            "solve",
            "proof",
            "analysis",
        ],
    ),
    (
        "result",
        &[
            "text",
            "geometry",
            "scene",
            "interface",
            "analysis",
            "wording",
            "study",
            "import",
        ],
    ),
    (
        "report",
        &[
            "text",
            "geometry",
            "scene",
            "interface",
            "analysis",
            "wording",
            "figure",
            "drawing",
            "output",
            "chart",
            "study",
            "import",
            "result",
        ],
    ),
    ("batch", &[]),
    (
        "session",
        &["text", "geometry", "scene", "interface", "analysis"],
    ),
    (
        "snapshot",
        &[
            "text",
            "geometry",
            "scene",
            "analysis",
            "figure",
            "drawing",
            "output",
            // Its macros, which the language puts at the root.
            "assert_scene",
            "assert_scenes",
            "assert_figure",
        ],
    ),
    (
        "cli",
        &[
            "text",
            "snapshot",
            "geometry",
            "scene",
            "interface",
            "analysis",
            "wording",
            "figure",
            "drawing",
            "output",
            "study",
            "report",
            "result",
            "import",
            "starter",
            "batch",
        ],
    ),
    ("doc", &[]),
];

/// Where a foreign crate may be named: files, or a whole room where the path ends in a slash.
const DOORS: &[(&str, &[&str])] = &[
    (
        "serde",
        &[
            "scene/format.rs",
            "scene/format/",
            "result/",
            "drawing/style/format/value.rs",
        ],
    ),
    (
        "serde_json",
        &[
            "scene/format.rs",
            "scene/format/",
            "result/",
            "drawing/style/format/value.rs",
            "import/geojson.rs",
            "report/book.rs",
        ],
    ),
    (
        "toml",
        &["drawing/style/format/value.rs", "snapshot/setting.rs"],
    ),
    ("schemars", &["scene/format.rs", "scene/format/"]),
    ("clarabel", &["solve/"]),
    ("amd", &["solve/normal/elimination_tree.rs"]),
    (
        "resvg",
        &[
            "output/tree.rs",
            "output/png.rs",
            "output/png/",
            "output/pdf.rs",
            "output/svg.rs",
            "output/svg/",
        ],
    ),
    ("krilla", &["output/pdf.rs"]),
    ("subsetter", &["output/svg/font.rs"]),
    ("write_fonts", &["output/svg/font.rs"]),
    (
        "base64",
        &[
            "output/svg/font.rs",
            "snapshot/review.rs",
            "cli/snapshot/answer.rs",
        ],
    ),
    (
        "png",
        &["output/png.rs", "output/png/", "snapshot/picture/"],
    ),
    ("earcut", &["geometry/overlap.rs"]),
    ("robust", &["geometry/"]),
    ("skrifa", &["drawing/text.rs"]),
    ("ariadne", &["cli/complaint.rs"]),
    ("indicatif", &["cli/progress.rs"]),
    ("anstream", &["cli/terminal.rs"]),
    ("terminal_size", &["cli/terminal.rs"]),
    ("unicode_width", &["cli/page.rs"]),
    ("clap_complete", &["cli/completions.rs"]),
    ("clap_mangen", &["cli/man.rs"]),
    ("clap", &["cli/"]),
    ("tempfile", &["output/file.rs"]),
    ("signal_hook", &["cli/signal.rs"]),
    ("plotters", &["chart/"]),
    ("maud", &["report/", "snapshot/review.rs"]),
    ("pulldown_cmark", &["report/book.rs"]),
    ("roxmltree", &["import/", "snapshot/element/tree.rs"]),
    ("svgtypes", &["import/", "snapshot/element/shape.rs"]),
    ("simplecss", &["import/"]),
];

/// Doors that are one file, but whose file is the owning room's to choose.
const SINGLE: &[&str] = &["clarabel", "tempfile", "skrifa", "plotters"];

/// Names that say nothing about what a file is.
const EMPTY_NAMES: &[&str] = &[
    "utils", "util", "common", "helpers", "helper", "core", "misc",
];

#[test]
fn every_arrow_points_the_right_way_and_every_crate_has_one_door() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    assert!(
        files.len() > 20,
        "the walk found only {} files",
        files.len()
    );
    let mut faults = Vec::new();
    let mut sources = Vec::new();
    for file in files {
        let path = file
            .strip_prefix(&root)
            .expect("below src")
            .to_string_lossy()
            .replace('\\', "/");
        let text = fs::read_to_string(&file).expect("source is UTF-8");
        let Some(path) = without_groups(&path) else {
            continue;
        };
        faults.extend(faults_of(path, &text));
        sources.push((path.to_owned(), bare(&text)));
    }
    for name in SINGLE {
        let doors: Vec<&str> = sources
            .iter()
            .filter(|s| names_crate(&s.1, name))
            .map(|s| s.0.as_str())
            .collect();
        if doors.len() > 1 {
            faults.push(format!(
                "{name} has {} doors: {}",
                doors.len(),
                doors.join(", ")
            ));
        }
    }
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// Everything that is wrong with one source file, `path` given below `src`.
fn faults_of(path: &str, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    // A visibility names the module's own full path.
    let code = bare(text).replace("pub(in crate::", "pub(in ");
    let own = path.split(['/', '.']).next().unwrap_or_default();
    let stem = path
        .rsplit('/')
        .next()
        .unwrap_or_default()
        .trim_end_matches(".rs");
    if EMPTY_NAMES.contains(&stem) || EMPTY_NAMES.contains(&own) {
        faults.push(format!("{path}: the name says nothing about what it makes"));
    }
    if !matches!(own, "lib" | "main" | "internals") {
        match ROOMS.iter().find(|r| r.0 == own) {
            None => faults.push(format!("{path}: {own} is no room of the house")),
            Some((_, allowed)) => {
                for used in rooms_used(&code) {
                    if used != own && !allowed.contains(&used.as_str()) {
                        faults.push(format!("{path}: {own} may not use {used}"));
                    }
                }
            }
        }
    }
    // `super` in a room's mod.rs is the crate itself, and two of them leave any room of ours.
    let climbs = code.matches("super::super::").count();
    let depth = path.matches('/').count() + usize::from(!path.ends_with("mod.rs"))
        - 1.min(path.matches('/').count());
    if climbs > 0 && depth < 2 {
        faults.push(format!("{path}: super::super:: leaves the room"));
    }
    let (outside_tests, _) = code.split_once("#[cfg(test)]").unwrap_or((&code, ""));
    if path.ends_with("/mod.rs")
        && path.matches('/').count() == 1
        && outside_tests.contains("super::")
    {
        faults.push(format!("{path}: super:: leaves the room"));
    }
    for (at, _) in code.match_indices("::*") {
        let path_of = &code[..at];
        let used = path_of.rfind("use ").map_or("", |u| &path_of[u + 4..]);
        if used != "super" && !used.ends_with("prelude") {
            faults.push(format!(
                "{path}: a glob hides where names come from: {used}::*"
            ));
        }
    }
    if outside_tests.contains("use super::*;") && stem != "tests" && !path.contains("/tests/") {
        faults.push(format!("{path}: use super::* outside tests"));
    }
    for (name, doors) in DOORS {
        let open = doors
            .iter()
            .any(|d| *d == path || (d.ends_with('/') && path.starts_with(d)));
        if !open && names_crate(&code, name) {
            faults.push(format!(
                "{path}: {name} comes in through {} only",
                doors.join(" and ")
            ));
        }
    }
    faults
}

#[test]
fn a_picture_that_asks_the_mechanics_is_caught() {
    let bad = "use crate::analysis::Analysis;\nfn f() {}\n";
    assert_eq!(
        faults_of("drawing/arrow.rs", bad),
        ["drawing/arrow.rs: drawing may not use analysis"]
    );
    assert_eq!(faults_of("figure/forces.rs", bad), Vec::<String>::new());
}

#[test]
fn an_arrow_hidden_in_a_group_or_in_code_is_caught() {
    let group = "use crate::{geometry::{Point, Vector}, program::Columns};";
    assert_eq!(rooms_used(group), ["geometry", "program"]);
    assert_eq!(
        faults_of("proof.rs", group),
        ["proof.rs: proof may not use program"]
    );
    let call = "fn f() { let x = crate::solve::solve(1); }";
    assert_eq!(
        faults_of("scene/frame.rs", call),
        ["scene/frame.rs: scene may not use solve"]
    );
}

#[test]
fn a_second_door_is_caught() {
    let sources = [
        "use serde::Serialize;",
        "#[derive(serde::Serialize)] struct A;",
        "use resvg::usvg;",
        "fn f() { ariadne::Report::build(); }",
        "use clarabel;",
    ];
    for source in sources {
        assert_eq!(faults_of("analysis/mod.rs", source).len(), 1, "{source}");
    }
    assert!(faults_of("output/png.rs", "use resvg::usvg;").is_empty());
}

#[test]
fn words_that_only_look_like_arrows_are_let_pass() {
    let fine = r##"
        //! Made by crate::analysis, unlike serde::Serialize.
        /* crate::cli /* crate::figure */ clarabel::solve */
        const A: &str = "crate::cli";
        const B: &str = r#"use "resvg::x""#;
        const C: char = '"';
        fn g<'a>(x: &'a str) -> &'a str { my_serde::f(x) }
        use crate::scene::png::Thing;
    "##;
    assert_eq!(faults_of("interface/mod.rs", fine), Vec::<String>::new());
}

#[test]
fn globs_climbing_and_empty_names_are_caught() {
    assert_eq!(
        faults_of("scene/shape.rs", "use crate::geometry::*;").len(),
        1
    );
    assert_eq!(faults_of("scene/shape.rs", "use super::*;").len(), 1);
    assert_eq!(
        faults_of(
            "scene/shape.rs",
            "#[cfg(test)]\nmod tests { use super::*; }"
        ),
        Vec::<String>::new()
    );
    assert_eq!(
        faults_of("scene/mod.rs", "use super::geometry::Point;").len(),
        1
    );
    assert_eq!(
        faults_of("scene/shape.rs", "use super::super::geometry::Point;").len(),
        1
    );
    assert_eq!(faults_of("scene/utils.rs", "").len(), 1);
    assert_eq!(faults_of("cellar/wine.rs", "").len(), 1);
}
