//! The imports between the files of a folder form no cycle, not even through other files. Source files are read as
//! text, without comments, strings and tests.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::source::{bare, collect, names_after};

/// Folders whose files still import each other. The test fails when one of them no longer does, so that the list
/// shrinks.
const KNOWN_CYCLES: &[&str] = &[];

/// For each module of a folder, the other modules of this folder that it uses. A subfolder counts as one module.
/// `mod.rs` is left out, because it declares the others.
fn uses_within(root: &Path, folder: &Path) -> BTreeMap<String, BTreeSet<String>> {
    let mut files = Vec::new();
    collect(folder, &mut files);
    let below = |file: &Path| file.strip_prefix(folder).expect("below").to_owned();
    let module = |file: &Path| {
        let path = below(file);
        let first = path.iter().next().expect("a name").to_string_lossy();
        first.trim_end_matches(".rs").to_owned()
    };
    let names: BTreeSet<String> = files.iter().map(|file| module(file)).collect();
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for file in &files {
        let own = module(file);
        let is_test = file.iter().any(|part| part == "tests" || part == "tests.rs");
        if matches!(own.as_str(), "mod" | "lib" | "main") || is_test {
            continue;
        }
        let text = bare(&fs::read_to_string(file).expect("source is UTF-8"));
        let (code, _) = text.split_once("#[cfg(test)]").unwrap_or((&text, ""));
        // How many `super::` lead from the file to the folder's own module.
        let levels = below(file).iter().count() - usize::from(file.ends_with("mod.rs"));
        let mut used = names_after(code, &"super::".repeat(levels));
        used.extend(names_after(code, &crate_path(root, folder)));
        let used = used.into_iter();
        let used = used.filter(|name| names.contains(name) && *name != own);
        uses.entry(own.clone()).or_default().extend(used);
    }
    uses
}

/// The path of a folder's module in code, such as `crate::mechanics::scene::` for `src/mechanics/scene`.
fn crate_path(root: &Path, folder: &Path) -> String {
    let folder = folder.strip_prefix(root).expect("below src").to_string_lossy().replace('\\', "/");
    format!("crate::{}::", folder.replace('/', "::"))
}

/// Adds all folders below `folder` to `found`.
fn folders(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            folders(&path, found);
            found.push(path);
        }
    }
}

/// The first cycle of modules that use each other, as the list of its modules.
fn cycle(uses: &BTreeMap<String, BTreeSet<String>>) -> Option<Vec<String>> {
    // Modules that use none of the remaining modules are removed again and again; the rest contains a cycle.
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
    let mut chain = vec![left.keys().next()?.clone()];
    loop {
        let next = left[&chain[chain.len() - 1]].iter().find(|u| left.contains_key(*u))?;
        if let Some(at) = chain.iter().position(|name| name == next) {
            return Some(chain.split_off(at));
        }
        chain.push(next.clone());
    }
}

#[test]
fn no_files_of_a_folder_import_each_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    folders(&root, &mut all);
    let mut faults = Vec::new();
    for folder in &all {
        let name = folder.strip_prefix(&root).expect("below src");
        let name = name.to_string_lossy().replace('\\', "/");
        match (cycle(&uses_within(&root, folder)), KNOWN_CYCLES.contains(&&name[..])) {
            (Some(chain), false) => faults.push(format!("{name}: {} import each other", chain.join(" → "))),
            (None, true) => faults.push(format!("{name} has no cycle any more: remove it from KNOWN_CYCLES")),
            _ => {}
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn files_that_import_each_other_through_a_third_are_caught() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut uses = uses_within(&root, &root.join("geometry"));
    assert!(uses["polygon"].contains("crossing") && uses["crossing"].contains("edge"));
    assert_eq!(cycle(&uses), None);
    uses.entry("edge".into()).or_default().insert("polygon".into());
    assert!(cycle(&uses).is_some_and(|chain| chain.len() == 2 || chain.len() == 3));
}

#[test]
fn shared_parts_of_figures_do_not_import_a_kind_of_figure() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let uses = uses_within(&root, &root.join("products/figure"));
    assert!(uses.len() > 30, "{}", uses.len());
    for part in [
        "canvas",
        "design",
        "placing",
        "stage",
        "sheet",
        "gives",
        "fall",
        "displacement",
        "description",
        "parallel_arrows",
        "fill",
    ] {
        for barred in ["kind", "draw"] {
            assert!(!uses[part].contains(barred), "{part} uses {barred}");
        }
    }
}
