//! The files of `figure/` form no circle: read from the source as text, as `layers` reads the rooms.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::source::{bare, collect};

/// Which files of `figure/` each of its files uses, by their names; a folder counts as the file it belongs to.
fn figure_files() -> BTreeMap<String, BTreeSet<String>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/products/figure");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let name = |file: &Path| {
        let below = file.strip_prefix(&root).expect("below figure");
        let first = below
            .iter()
            .next()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        first.trim_end_matches(".rs").to_owned()
    };
    let names: BTreeSet<String> = files.iter().map(|f| name(f)).collect();
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in files.iter().filter(|f| !f.ends_with("figure/mod.rs")) {
        let text = bare(&fs::read_to_string(file).expect("source is UTF-8"));
        let (code, _) = text.split_once("#[cfg(test)]").unwrap_or((&text, ""));
        let used = uses.entry(name(file)).or_default();
        for from in ["super::", "crate::figure::"] {
            for (at, _) in code.match_indices(from) {
                let rest = &code[at + from.len()..];
                let word: String = rest
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect();
                if names.contains(&word) && word != name(file) {
                    used.insert(word);
                }
            }
        }
    }
    uses
}

/// The first circle among files that use each other, by the way round it.
fn circle(uses: &BTreeMap<String, BTreeSet<String>>) -> Option<Vec<String>> {
    // Files that use nothing that is left are taken away; what remains in the end goes round.
    let mut left = uses.clone();
    loop {
        let done: Vec<String> = left
            .iter()
            .filter(|(_, used)| !used.iter().any(|u| left.contains_key(u)))
            .map(|(name, _)| name.clone())
            .collect();
        if done.is_empty() {
            break;
        }
        left.retain(|name, _| !done.contains(name));
    }
    let mut way = vec![left.keys().next()?.clone()];
    loop {
        let next = left[&way[way.len() - 1]]
            .iter()
            .find(|u| left.contains_key(*u))?;
        if let Some(at) = way.iter().position(|w| w == next) {
            return Some(way.split_off(at));
        }
        way.push(next.clone());
    }
}

#[test]
fn the_files_of_figure_form_no_circle_and_its_parts_know_no_kind() {
    let uses = figure_files();
    assert!(uses.len() > 30, "{}", uses.len());
    assert_eq!(circle(&uses), None);
    for part in [
        "label",
        "legend",
        "layout",
        "panel",
        "pen",
        "context",
        "description",
        "view",
        "unit",
        "apart",
        "fill",
    ] {
        for barred in ["kind", "strip", "draw"] {
            assert!(!uses[part].contains(barred), "{part} uses {barred}");
        }
    }
    let mut round = uses;
    round
        .entry("view".into())
        .or_default()
        .insert("kind".into());
    assert!(circle(&round).is_some_and(|way| way.contains(&"kind".to_owned())));
}
