//! Names in the source are those of statics and optimisation: words that once stood in their place do not come back.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::source::{bare, collect};

/// A word that is no name here, and what is written in its place.
const REPLACED: &[(&str, &str)] = &[
    ("need", "loads"),
    ("aim", "objective"),
    ("worth", "multipliers"),
    ("twin", "dual"),
    ("leftover", "residual"),
    ("tidy", "least_squares_amounts"),
    ("manner", "settings"),
    ("manners", "settings"),
    ("care", "conditioning"),
    ("lavish", "non_binding"),
    ("hopeless", "infeasible even with sticking"),
    ("yardstick", "reference scale"),
    ("unclear", "unsolved or undecided"),
    ("hunch", "candidate"),
    ("blown", "scaled"),
    ("told", "described, listed or reported"),
    ("said", "stated or labelled"),
];

/// The old words among the identifiers of a text without comments and strings, with what is meant.
fn old_words(code: &str) -> Vec<(String, &'static str)> {
    let identifiers = code.split(|c: char| !c.is_alphanumeric() && c != '_');
    identifiers
        .filter_map(|name| {
            let plain = name.to_lowercase();
            let (_, instead) = REPLACED.iter().find(|(old, _)| *old == plain)?;
            Some((name.to_owned(), *instead))
        })
        .collect()
}

#[test]
fn identifiers_are_plain_terms() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    assert!(files.len() > 20, "the walk found {} files", files.len());
    let mut faults = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("source is UTF-8");
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let path = file.display();
        for (name, instead) in old_words(&format!("{stem} {}", bare(&text))) {
            faults.push(format!("{path}: `{name}`; {instead}"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Rooms whose types others build on: those of the public interface, and those whose types it gives out.
const PUBLIC: &[&str] = &[
    "scene",
    "geometry",
    "interface",
    "starter",
    "import",
    "analysis",
    "wording",
    "drawing",
    "figure",
    "output",
    "report",
    "batch",
    "session",
    "snapshot",
];

/// A name among the public types means one thing; only `Options` is always seen with its module.
#[test]
fn a_name_of_a_public_type_is_given_once() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut homes: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for room in PUBLIC {
        let mut files = Vec::new();
        collect(&root.join(room), &mut files);
        for file in files {
            let text = fs::read_to_string(&file).expect("source is UTF-8");
            for line in bare(&text).lines() {
                let public = line.trim_start().strip_prefix("pub ");
                let kind = public.and_then(|rest| rest.split_once(' '));
                let named =
                    kind.filter(|(kind, _)| ["struct", "enum", "type", "trait"].contains(kind));
                let Some((_, name)) = named else { continue };
                let name = name.split(|c: char| !c.is_alphanumeric()).next();
                let home = homes
                    .entry(name.unwrap_or_default().to_owned())
                    .or_default();
                home.push(file.display().to_string());
            }
        }
    }
    assert!(homes.len() > 100, "{}", homes.len());
    homes.retain(|name, files| name != "Options" && files.len() > 1);
    assert!(homes.is_empty(), "{homes:#?}");
}

#[test]
fn old_words_are_found_and_no_parts_of_others() {
    let code = "let need = Twin::of(TOLD, claim, needed, careful, aim_of, told_of_all);";
    let found: Vec<String> = old_words(code).into_iter().map(|w| w.0).collect();
    assert_eq!(found, ["need", "Twin", "TOLD"]);
}
