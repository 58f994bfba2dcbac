//! The layers of the crate: each module uses only the modules that its layer may use, and each foreign crate is named
//! only in the files listed for it.
//!
//! The order of the layers follows from the order of the modules in each group's `mod.rs` and from [`GROUP_RULES`].
//! Source files, including their tests, are read as text without comments and strings.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::source::{GROUPS, bare, collect, module_of, modules_used, names_after, names_crate};

/// Which groups of modules a group may use besides itself. A module outside all groups counts as a group.
const GROUP_RULES: &[(&str, &[&str])] = &[
    ("text", &[]),
    ("read", &["text"]),
    ("geometry", &[]),
    ("clock", &[]),
    ("mechanics", &["clock", "geometry", "read", "text"]),
    ("pictures", &["geometry", "read", "text"]),
    ("sources", &["mechanics", "geometry", "read", "text"]),
    ("products", &["sources", "pictures", "mechanics", "clock", "geometry", "read", "text"]),
    ("entry", &["products", "sources", "pictures", "mechanics", "clock", "geometry", "read", "text"]),
];

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
                let others = usable.iter().flat_map(|group| &members[group]);
                allowed.insert(module.clone(), others.chain(&own[..place]).cloned().collect());
            }
        }
        Layers { allowed }
    }
}

/// The modules of a group in their order, with their paths; a nested group is replaced by its modules. For a module
/// outside all groups, that module.
fn members_of(root: &Path, group: &str) -> Vec<String> {
    if !GROUPS.contains(&group) {
        return vec![group.to_owned()];
    }
    let text = bare(&fs::read_to_string(root.join(group).join("mod.rs")).expect("a group has a mod.rs"));
    let names = text.lines().filter_map(|line| Some(line.trim().strip_suffix(';')?.split_once("mod ")?.1));
    names.flat_map(|name| members_of(root, &format!("{group}/{name}"))).collect()
}

/// The files in which a foreign crate may be named. A path that ends in a slash stands for all files below it.
const CRATE_FILES: &[(&str, &[&str])] = &[
    (
        "serde",
        &[
            "mechanics/certificate/mod.rs",
            "mechanics/scene/format.rs",
            "mechanics/scene/format/",
            "products/result/",
            "products/snapshot/fact/",
        ],
    ),
    ("dashu_ratio", &["mechanics/certificate/number.rs"]),
    ("hmac_sha256", &["entry/cli/verify.rs"]),
    (
        "serde_json",
        &[
            "mechanics/certificate/mod.rs",
            "mechanics/scene/format.rs",
            "mechanics/scene/format/",
            "mechanics/scene/reading.rs",
            "read/tree.rs",
            "products/result/",
            "products/snapshot/fact/",
            "products/snapshot/ci.rs",
            "sources/import/",
            "products/report/book.rs",
            "products/vary/mod.rs",
            "entry/cli/vary/",
        ],
    ),
    ("toml", &["read/toml.rs"]),
    ("schemars", &["mechanics/scene/format.rs", "mechanics/scene/format/"]),
    ("clarabel", &["mechanics/solve/"]),
    ("amd", &["mechanics/solve/basis_factor.rs", "mechanics/solve/normal/elimination_tree.rs"]),
    (
        "resvg",
        &[
            "pictures/output/tree.rs",
            "pictures/output/png.rs",
            "pictures/output/png/",
            "pictures/output/pdf.rs",
            "pictures/output/pdf/",
            "pictures/output/svg.rs",
            "pictures/output/svg/",
        ],
    ),
    ("krilla", &["pictures/output/pdf.rs", "pictures/output/pdf/"]),
    ("subsetter", &["pictures/output/svg/font.rs"]),
    ("write_fonts", &["pictures/output/svg/font.rs"]),
    (
        "base64",
        &[
            "pictures/output/attachment.rs",
            "pictures/output/svg/font.rs",
            "products/snapshot/review.rs",
            "entry/cli/snapshot.rs",
        ],
    ),
    (
        "png",
        &[
            "pictures/output/png.rs",
            "pictures/output/png/",
            "pictures/output/animation.rs",
            "pictures/output/animation/",
            "products/snapshot/picture.rs",
        ],
    ),
    ("gif", &["pictures/output/animation.rs", "pictures/output/animation/"]),
    ("earcut", &["geometry/overlap.rs"]),
    ("robust", &["geometry/"]),
    ("skrifa", &["pictures/drawing/text.rs"]),
    ("web_time", &["clock.rs"]),
    ("ariadne", &["entry/cli/error.rs"]),
    ("indicatif", &["entry/cli/progress.rs"]),
    ("anstream", &["entry/cli/terminal.rs"]),
    ("terminal_size", &["entry/cli/terminal.rs"]),
    ("unicode_width", &["entry/cli/page.rs"]),
    ("clap_complete", &["entry/cli/print.rs"]),
    ("clap_mangen", &["entry/cli/print.rs"]),
    ("clap", &["entry/cli/", "entry/request.rs", "products/figure/option.rs", "text/mod.rs", "lib.rs"]),
    ("tempfile", &["pictures/output/file.rs"]),
    ("signal_hook", &["entry/cli/signal.rs"]),
    ("plotters", &["pictures/chart.rs"]),
    ("maud", &["products/report/", "products/snapshot/review.rs"]),
    ("pulldown_cmark", &["products/report/book.rs"]),
    ("roxmltree", &["sources/import/"]),
    ("svgtypes", &["sources/import/"]),
    ("simplecss", &["sources/import/"]),
    ("pyo3", &["entry/python/"]),
    ("wasm_bindgen", &["entry/wasm/"]),
    ("js_sys", &["entry/wasm/mod.rs"]),
    ("arrow_array", &["entry/python/table.rs"]),
    ("arrow_schema", &["entry/python/table.rs"]),
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
        faults.extend(faults_of(&layers, &path, &text));
        sources.push((path, bare(&text)));
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
    let own = module_of(path);
    let stem = path.rsplit('/').next().unwrap_or_default().trim_end_matches(".rs");
    if EMPTY_NAMES.contains(&stem) || path.split('/').any(|folder| EMPTY_NAMES.contains(&folder)) {
        faults.push(format!("{path}: the name does not say what the file contains"));
    }
    let is_root = matches!(path, "lib.rs" | "main.rs" | "internals.rs");
    if let (Some(own), false) = (&own, is_root) {
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
    // Where the path is, below the folder of its module. In the `mod.rs` of this folder, `super` leaves the module; in
    // its other files, `super::super` does.
    let within = own.as_deref().and_then(|own| path.strip_prefix(own)?.strip_prefix('/'));
    let folders_within = within.map_or(0, |within| within.matches('/').count());
    let is_mod = path.ends_with("mod.rs");
    if code.contains("super::super::") && (folders_within == 0 || (folders_within == 1 && is_mod)) {
        faults.push(format!("{path}: super::super:: leaves the module"));
    }
    let (outside_tests, _) = code.split_once("#[cfg(test)]").unwrap_or((&code, ""));
    if within == Some("mod.rs") && outside_tests.contains("super::") {
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
    assert!(may("mechanics/analysis", "mechanics/proof") && !may("mechanics/proof", "mechanics/analysis"));
    assert!(
        may("mechanics/program", "mechanics/statics/effect") && !may("mechanics/statics/effect", "mechanics/program")
    );
    // A proof must not use the code that it checks.
    assert!(!may("mechanics/proof", "mechanics/program") && !may("mechanics/proof", "mechanics/solve"));
    assert!(may("products/figure", "pictures/drawing") && may("products/figure", "mechanics/analysis"));
    assert!(!may("pictures/drawing", "mechanics/analysis") && !may("mechanics/analysis", "pictures/drawing"));
    assert!(may("entry/cli", "products/report") && !may("products/report", "entry/cli"));
    assert!(may("entry/python", "entry/cli") && !may("entry/cli", "entry/python"));
}

#[test]
fn a_drawing_module_that_uses_the_mechanics_is_a_fault() {
    let bad = "use crate::mechanics::analysis::Analysis;\nfn f() {}\n";
    assert_eq!(
        faults("pictures/drawing/arrow.rs", bad),
        ["pictures/drawing/arrow.rs: pictures/drawing may not use mechanics/analysis"]
    );
    assert_eq!(faults("products/figure/forces.rs", bad), Vec::<String>::new());
}

#[test]
fn uses_in_braces_and_in_code_are_found() {
    let group = "use crate::{geometry::{Point, Vector}, mechanics::{program::Columns, statics::effect}};";
    assert_eq!(modules_used(group), ["geometry", "mechanics/program", "mechanics/statics/effect"]);
    let group = "use crate::{geometry::Point, mechanics::program::Columns};";
    assert_eq!(
        faults("mechanics/proof.rs", group),
        ["mechanics/proof.rs: mechanics/proof may not use mechanics/program"]
    );
    let call = "fn f() { let x = crate::mechanics::solve::solve(1); }";
    assert_eq!(
        faults("mechanics/scene/frame.rs", call),
        ["mechanics/scene/frame.rs: mechanics/scene may not use mechanics/solve"]
    );
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
        assert_eq!(faults("mechanics/analysis/mod.rs", source).len(), 1, "{source}");
    }
    assert!(faults("pictures/output/png.rs", "use resvg::usvg;").is_empty());
}

#[test]
fn a_clock_other_than_the_crates_own_is_a_fault() {
    let sources =
        ["use std::time::{Duration, Instant};", "fn f() { std::time::Instant::now(); }", "use web_time::Instant;"];
    for source in sources {
        assert_eq!(faults("mechanics/analysis/mod.rs", source).len(), 1, "{source}");
    }
    let fine = "use crate::clock::Instant;\nuse std::time::Duration;";
    assert_eq!(faults("mechanics/analysis/mod.rs", fine), Vec::<String>::new());
}

#[test]
fn words_that_only_look_like_uses_are_no_faults() {
    let fine = r##"
        //! Made by crate::mechanics::analysis, unlike serde::Serialize.
        /* crate::entry::cli /* crate::products::figure */ clarabel::solve */
        const A: &str = "crate::entry::cli";
        const B: &str = r#"use "resvg::x""#;
        const C: char = '"';
        fn g<'a>(x: &'a str) -> &'a str { my_serde::f(x) }
        use crate::mechanics::scene::png::Thing;
    "##;
    assert_eq!(faults("mechanics/statics/interface/mod.rs", fine), Vec::<String>::new());
}

#[test]
fn globs_paths_above_the_module_and_empty_names_are_faults() {
    assert_eq!(faults("mechanics/scene/shape.rs", "use crate::geometry::*;").len(), 1);
    assert_eq!(faults("mechanics/scene/shape.rs", "use super::*;").len(), 1);
    assert_eq!(faults("mechanics/scene/shape.rs", "#[cfg(test)]\nmod tests { use super::*; }"), Vec::<String>::new());
    assert_eq!(faults("mechanics/scene/mod.rs", "use super::geometry::Point;").len(), 1);
    assert_eq!(faults("mechanics/scene/shape.rs", "use super::super::geometry::Point;").len(), 1);
    assert_eq!(faults("mechanics/scene/utils.rs", "").len(), 1);
    assert_eq!(faults("cellar/wine.rs", "").len(), 1);
}
