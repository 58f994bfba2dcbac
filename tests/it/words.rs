//! Public types have different names.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::source::{bare, collect, module_of};

/// Modules whose types other crates use: those of the public interface, and those whose types it returns.
const PUBLIC: &[&str] = &[
    "mechanics/scene",
    "geometry",
    "mechanics/statics/interface",
    "sources/starter",
    "sources/import",
    "mechanics/analysis",
    "products/wording",
    "pictures/drawing",
    "products/figure",
    "pictures/output",
    "products/result",
    "products/report",
    "mechanics/batch",
    "mechanics/session",
    "products/snapshot",
];

/// Only the name `Options` may occur in several modules, because it is always used together with the name of its
/// module.
#[test]
fn public_types_have_different_names() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files_by_name: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut files = Vec::new();
    collect(&root, &mut files);
    for file in files {
        let path = file.strip_prefix(&root).expect("below src").to_string_lossy().replace('\\', "/");
        let module = module_of(&path);
        if module.is_some_and(|module| PUBLIC.contains(&module.as_str())) {
            let text = fs::read_to_string(&file).expect("source is UTF-8");
            for line in bare(&text).lines() {
                let public = line.trim_start().strip_prefix("pub ");
                let kind = public.and_then(|rest| rest.split_once(' '));
                let named = kind.filter(|(kind, _)| ["struct", "enum", "type", "trait"].contains(kind));
                let Some((_, name)) = named else { continue };
                // A macro declares types with names such as `$name`: they have no name here.
                let name = name.split(|c: char| !c.is_alphanumeric()).next().filter(|name| !name.is_empty());
                let Some(name) = name else { continue };
                let files = files_by_name.entry(name.to_owned()).or_default();
                files.push(file.display().to_string());
            }
        }
    }
    assert!(files_by_name.len() > 100, "{}", files_by_name.len());
    files_by_name.retain(|name, files| name != "Options" && files.len() > 1);
    assert!(files_by_name.is_empty(), "{files_by_name:#?}");
}
