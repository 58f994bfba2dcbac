//! The layers of the crate: each module uses only the modules that its layer may use, and each foreign crate is named
//! only in the files listed for it.
//!
//! The order of the layers follows from the order of the modules in each group's `mod.rs` and from [`GROUP_RULES`].
//! Source files, including their tests, are read as text without comments and strings.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::source::{bare, collect, modules_used, names_after, names_crate, without_groups};

/// Which groups of modules a group may use besides itself. A module outside all groups counts as a group.
const GROUP_RULES: &[(&str, &[&str])] = &[
    ("text", &[]),
    ("geometry", &[]),
    ("clock", &[]),
    ("mechanics", &["clock", "geometry", "text"]),
    ("pictures", &["geometry", "text"]),
    ("sources", &["mechanics", "geometry", "text"]),
    ("products", &["sources", "pictures", "mechanics", "clock", "geometry", "text"]),
    ("entry", &["products", "sources", "pictures", "mechanics", "clock", "geometry", "text"]),
];

/// Modules that a module may not use although they are listed before it. A proof must not use the code that it
/// checks.
const FORBIDDEN: &[(&str, &[&str])] = &[("proof", &["program", "solve"])];

/// Names that may be used everywhere: the documentation pages, and macros, which Rust puts at the crate root.
const EVERYWHERE: &[&str] = &["doc", "assert_scene", "assert_scenes", "assert_figure"];

/// For each module of the crate, the modules that it may use.
struct Layers {
    allowed: BTreeMap<String, Vec<String>>,
}

impl Layers {
    /// Reads the order of the modules from the groups' `mod.rs`.
    fn from_source(root: &Path) -> Layers {
        let members: BTreeMap<&str, Vec<String>> =
            GROUP_RULES.iter().map(|(group, _)| (*group, members_of(root, group))).collect();
        let mut allowed = BTreeMap::new();
        for (group, usable) in GROUP_RULES {
            let own = &members[group];
            for (place, module) in own.iter().enumerate() {
                let forbidden = FORBIDDEN.iter().find(|f| f.0 == module);
                let forbidden = forbidden.map_or(&[][..], |f| f.1);
                let others = usable.iter().flat_map(|group| &members[group]);
                let all = others.chain(&own[..place]);
                let all = all.filter(|used| !forbidden.contains(&used.as_str()));
                allowed.insert(module.clone(), all.cloned().collect());
            }
        }
        Layers { allowed }
    }
}

/// The modules of a group in their order; a nested group is replaced by its modules. For a module outside all groups,
/// that module.
fn members_of(root: &Path, group: &str) -> Vec<String> {
    let path = root.join(group).join("mod.rs");
    let is_group = crate::source::GROUPS.contains(&group);
    let Some(text) = fs::read_to_string(&path).ok().filter(|_| is_group) else {
        let name = group.rsplit('/').next().unwrap_or(group);
        return vec![name.to_owned()];
    };
    let text = bare(&text);
    let modules = text.lines().filter_map(|line| {
        let name = line.trim().strip_suffix(';')?.split_once("mod ")?.1;
        Some(name.to_owned())
    });
    modules
        .flat_map(|name| match crate::source::GROUPS.contains(&name.as_str()) {
            true => members_of(&root.join(group), &name),
            false => vec![name],
        })
        .collect()
}

/// The files in which a foreign crate may be named. A path that ends in a slash stands for all files below it.
const CRATE_FILES: &[(&str, &[&str])] = &[
    (
        "serde",
        &[
            "scene/format.rs",
            "scene/format/",
            "result/",
            "drawing/style/format/value.rs",
            "wasm/drawing.rs",
            "wasm/figure_options.rs",
            "wasm/option.rs",
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
            "import/compas.rs",
            "import/contact_list.rs",
            "import/degrees.rs",
            "report/book.rs",
        ],
    ),
    ("toml", &["drawing/style/format/value.rs", "snapshot/setting.rs"]),
    ("schemars", &["scene/format.rs", "scene/format/"]),
    ("clarabel", &["solve/"]),
    ("amd", &["solve/basis_factor.rs", "solve/normal/elimination_tree.rs"]),
    (
        "resvg",
        &[
            "output/tree.rs",
            "output/png.rs",
            "output/png/",
            "output/pdf.rs",
            "output/pdf/",
            "output/svg.rs",
            "output/svg/",
        ],
    ),
    ("krilla", &["output/pdf.rs", "output/pdf/"]),
    ("subsetter", &["output/svg/font.rs"]),
    ("write_fonts", &["output/svg/font.rs"]),
    ("base64", &["output/svg/font.rs", "snapshot/review.rs", "cli/snapshot/answer.rs"]),
    ("png", &["output/png.rs", "output/png/", "output/animation.rs", "output/animation/", "snapshot/picture/"]),
    ("gif", &["output/animation.rs", "output/animation/"]),
    ("earcut", &["geometry/overlap.rs"]),
    ("robust", &["geometry/"]),
    ("skrifa", &["drawing/text.rs"]),
    ("web_time", &["clock.rs"]),
    ("ariadne", &["cli/error.rs"]),
    ("indicatif", &["cli/progress.rs"]),
    ("anstream", &["cli/terminal.rs"]),
    ("terminal_size", &["cli/terminal.rs"]),
    ("unicode_width", &["cli/page.rs"]),
    ("clap_complete", &["cli/completions.rs"]),
    ("clap_mangen", &["cli/man.rs"]),
    ("clap", &["cli/"]),
    ("tempfile", &["output/file.rs"]),
    ("signal_hook", &["cli/signal.rs"]),
    ("plotters", &["chart/plot.rs", "chart/plot/"]),
    ("maud", &["report/", "snapshot/review.rs"]),
    ("pulldown_cmark", &["report/book.rs"]),
    ("roxmltree", &["import/", "snapshot/element/tree.rs"]),
    ("svgtypes", &["import/", "snapshot/element/shape.rs"]),
    ("simplecss", &["import/"]),
    ("pyo3", &["python/"]),
    ("wasm_bindgen", &["wasm/"]),
    ("js_sys", &["wasm/error.rs"]),
    ("arrow_array", &["python/table.rs"]),
    ("arrow_schema", &["python/table.rs"]),
];

/// Foreign crates that may be named in one file only, which may be any of their listed files.
const SINGLE: &[&str] = &["clarabel", "tempfile", "skrifa"];

/// File names that do not say what the file contains.
const EMPTY_NAMES: &[&str] = &["utils", "util", "common", "helpers", "helper", "core", "misc"];

#[test]
fn modules_use_only_allowed_modules_and_name_foreign_crates_only_in_listed_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    assert!(files.len() > 20, "only {} source files were found", files.len());
    let layers = Layers::from_source(&root);
    let mut faults = Vec::new();
    let mut sources = Vec::new();
    for file in files {
        let path = file.strip_prefix(&root).expect("below src").to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).expect("source is UTF-8");
        let Some(path) = without_groups(&path) else {
            continue;
        };
        faults.extend(faults_of(&layers, path, &text));
        sources.push((path.to_owned(), bare(&text)));
    }
    for name in SINGLE {
        let users: Vec<&str> = sources.iter().filter(|s| names_crate(&s.1, name)).map(|s| s.0.as_str()).collect();
        if users.len() > 1 {
            faults.push(format!("{name} is named in {} files: {}", users.len(), users.join(", ")));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// All faults of one source file; `path` is relative to `src`.
fn faults_of(layers: &Layers, path: &str, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    // A visibility names the full path of its own module.
    let code = bare(text).replace("pub(in crate::", "pub(in ");
    let own = path.split(['/', '.']).next().unwrap_or_default();
    let stem = path.rsplit('/').next().unwrap_or_default().trim_end_matches(".rs");
    if EMPTY_NAMES.contains(&stem) || EMPTY_NAMES.contains(&own) {
        faults.push(format!("{path}: the name does not say what the file contains"));
    }
    if !matches!(own, "lib" | "main" | "internals") {
        match layers.allowed.get(own) {
            None => faults.push(format!("{path}: {own} is not in a group's mod.rs")),
            Some(allowed) => {
                let used = modules_used(&code).into_iter();
                let used = used.filter(|used| used != own && !EVERYWHERE.contains(&&used[..]));
                for used in used.filter(|used| !allowed.contains(used)) {
                    faults.push(format!("{path}: {own} may not use {used}"));
                }
            }
        }
    }
    // In the `mod.rs` of a top-level module, `super` is the crate root. In its other files, `super::super` is.
    let climbs = code.matches("super::super::").count();
    let depth = path.matches('/').count() + usize::from(!path.ends_with("mod.rs")) - 1.min(path.matches('/').count());
    if climbs > 0 && depth < 2 {
        faults.push(format!("{path}: super::super:: leaves the module"));
    }
    let (outside_tests, _) = code.split_once("#[cfg(test)]").unwrap_or((&code, ""));
    if path.ends_with("/mod.rs") && path.matches('/').count() == 1 && outside_tests.contains("super::") {
        faults.push(format!("{path}: super:: leaves the module"));
    }
    for (at, _) in code.match_indices("::*") {
        let path_of = &code[..at];
        let used = path_of.rfind("use ").map_or("", |u| &path_of[u + 4..]);
        if used != "super" && !used.ends_with("prelude") {
            faults.push(format!("{path}: a glob hides where names come from: {used}::*"));
        }
    }
    if outside_tests.contains("use super::*;") && stem != "tests" && !path.contains("/tests/") {
        faults.push(format!("{path}: use super::* outside tests"));
    }
    if path != "clock.rs" && names_after(&code, "std::time::").contains(&"Instant".into()) {
        faults.push(format!("{path}: only clock.rs may use std::time::Instant"));
    }
    for (name, permitted) in CRATE_FILES {
        let is_permitted = permitted.iter().any(|d| *d == path || (d.ends_with('/') && path.starts_with(d)));
        if !is_permitted && names_crate(&code, name) {
            faults.push(format!("{path}: {name} may only be named in {}", permitted.join(", ")));
        }
    }
    faults
}

/// The faults of an invented source file under the rules of the crate.
fn faults(path: &str, text: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    faults_of(&Layers::from_source(&root), path, text)
}

#[test]
fn a_module_may_use_earlier_modules_of_its_group_and_lower_groups() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let layers = Layers::from_source(&root);
    let may = |one: &str, other: &str| layers.allowed[one].contains(&other.to_owned());
    assert!(may("analysis", "proof") && !may("proof", "analysis"));
    assert!(may("program", "effect") && !may("effect", "program"));
    assert!(!may("proof", "program") && !may("proof", "solve"));
    assert!(may("figure", "drawing") && may("figure", "analysis"));
    assert!(!may("drawing", "analysis") && !may("analysis", "drawing"));
    assert!(may("cli", "report") && !may("report", "cli"));
    assert!(may("python", "cli") && !may("cli", "python"));
}

#[test]
fn a_drawing_module_that_uses_the_mechanics_is_a_fault() {
    let bad = "use crate::analysis::Analysis;\nfn f() {}\n";
    assert_eq!(faults("drawing/arrow.rs", bad), ["drawing/arrow.rs: drawing may not use analysis"]);
    assert_eq!(faults("figure/forces.rs", bad), Vec::<String>::new());
}

#[test]
fn uses_in_braces_and_in_code_are_found() {
    let group = "use crate::{geometry::{Point, Vector}, program::Columns};";
    assert_eq!(modules_used(group), ["geometry", "program"]);
    assert_eq!(faults("proof.rs", group), ["proof.rs: proof may not use program"]);
    let call = "fn f() { let x = crate::solve::solve(1); }";
    assert_eq!(faults("scene/frame.rs", call), ["scene/frame.rs: scene may not use solve"]);
}

#[test]
fn a_foreign_crate_in_another_file_is_a_fault() {
    let sources = [
        "use serde::Serialize;",
        "#[derive(serde::Serialize)] struct A;",
        "use resvg::usvg;",
        "fn f() { ariadne::Report::build(); }",
        "use clarabel;",
    ];
    for source in sources {
        assert_eq!(faults("analysis/mod.rs", source).len(), 1, "{source}");
    }
    assert!(faults("output/png.rs", "use resvg::usvg;").is_empty());
}

#[test]
fn a_clock_other_than_the_crates_own_is_a_fault() {
    let sources =
        ["use std::time::{Duration, Instant};", "fn f() { std::time::Instant::now(); }", "use web_time::Instant;"];
    for source in sources {
        assert_eq!(faults("analysis/mod.rs", source).len(), 1, "{source}");
    }
    let fine = "use crate::clock::Instant;\nuse std::time::Duration;";
    assert_eq!(faults("analysis/mod.rs", fine), Vec::<String>::new());
}

#[test]
fn words_that_only_look_like_uses_are_no_faults() {
    let fine = r##"
        //! Made by crate::analysis, unlike serde::Serialize.
        /* crate::cli /* crate::figure */ clarabel::solve */
        const A: &str = "crate::cli";
        const B: &str = r#"use "resvg::x""#;
        const C: char = '"';
        fn g<'a>(x: &'a str) -> &'a str { my_serde::f(x) }
        use crate::scene::png::Thing;
    "##;
    assert_eq!(faults("interface/mod.rs", fine), Vec::<String>::new());
}

#[test]
fn globs_paths_above_the_module_and_empty_names_are_faults() {
    assert_eq!(faults("scene/shape.rs", "use crate::geometry::*;").len(), 1);
    assert_eq!(faults("scene/shape.rs", "use super::*;").len(), 1);
    assert_eq!(faults("scene/shape.rs", "#[cfg(test)]\nmod tests { use super::*; }"), Vec::<String>::new());
    assert_eq!(faults("scene/mod.rs", "use super::geometry::Point;").len(), 1);
    assert_eq!(faults("scene/shape.rs", "use super::super::geometry::Point;").len(), 1);
    assert_eq!(faults("scene/utils.rs", "").len(), 1);
    assert_eq!(faults("cellar/wine.rs", "").len(), 1);
}
