//! Reads source files as text: all files below a folder, without comments and strings, and the names that they use.

use std::fs;
use std::path::{Path, PathBuf};

/// Adds all `.rs` files below the folder to `files`, in order of path.
pub(crate) fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).expect("readable").map(|e| e.expect("readable").path()).collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            collect(&entry, files);
        } else if entry.extension().is_some_and(|e| e == "rs") {
            files.push(entry);
        }
    }
}

/// Folders of `src` that only group modules.
pub(crate) const GROUPS: &[&str] = &["mechanics", "mechanics/statics", "pictures", "sources", "products", "entry"];

/// The module to which a path below `src` belongs: `mechanics/scene` for `mechanics/scene/frame.rs`. `None` for the
/// `mod.rs` of a group.
pub(crate) fn module_of(path: &str) -> Option<String> {
    let mut module = String::new();
    for name in path.trim_end_matches("mod.rs").trim_end_matches(".rs").split('/').filter(|name| !name.is_empty()) {
        if !module.is_empty() {
            module.push('/');
        }
        module.push_str(name);
        if !GROUPS.contains(&module.as_str()) {
            return Some(module);
        }
    }
    None
}

/// The modules that the code names in paths from the root of the crate, such as `crate::mechanics::scene::Scene`, also
/// with braces: `crate::{geometry, mechanics::{scene, program}}`. A path that ends with a group gives this group.
pub(crate) fn modules_used(code: &str) -> Vec<String> {
    let mut paths = Vec::new();
    for (at, prefix) in code.match_indices("crate::") {
        if !ends_in_word(&code[..at]) && !code[..at].ends_with('$') {
            spread(&code[at + prefix.len()..], "", &mut paths);
        }
    }
    let mut modules: Vec<String> = paths.into_iter().map(|path| module_of(&path).unwrap_or(path)).collect();
    modules.sort();
    modules.dedup();
    modules
}

/// Adds the paths at the beginning of the text, with slashes and below `above`: `{a::b, c}` gives `above/a/b` and
/// `above/c`. Returns the text after them.
fn spread<'t>(text: &'t str, above: &str, paths: &mut Vec<String>) -> &'t str {
    let text = text.trim_start();
    if let Some(mut rest) = text.strip_prefix('{') {
        while !rest.starts_with('}') && !rest.is_empty() {
            rest = spread(rest, above, paths).trim_start();
            rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
        }
        return rest.strip_prefix('}').unwrap_or(rest);
    }
    let Some(word) = word_at(text) else {
        return text.get(1..).unwrap_or_default();
    };
    let path = if above.is_empty() { word.clone() } else { format!("{above}/{word}") };
    match text[word.len()..].strip_prefix("::") {
        Some(rest) => spread(rest, &path, paths),
        None => {
            paths.push(path);
            &text[word.len()..]
        }
    }
}

/// The first names of all paths that begin with `prefix`, also in braces: `prefix{a::b, c}` has `a` and `c`.
///
/// A longer path that ends in the prefix, such as `super::super::` for `super::`, does not count.
pub(crate) fn names_after(code: &str, prefix: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        if code[..at].ends_with("::") || ends_in_word(&code[..at]) {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        match rest.strip_prefix('{') {
            None => names.extend(word_at(rest)),
            Some(group) => {
                let mut depth = 0;
                let mut begin = true;
                for (i, c) in group.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' if depth == 0 => break,
                        '}' => depth -= 1,
                        ',' if depth == 0 => begin = true,
                        c if begin && c.is_alphabetic() => {
                            names.extend(word_at(&group[i..]));
                            begin = false;
                        }
                        _ => {}
                    }
                }
            }
        }
    }
    names.sort();
    names.dedup();
    names
}

/// The name at the beginning of the text.
pub(crate) fn word_at(text: &str) -> Option<String> {
    let word: String = text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    (!word.is_empty()).then_some(word)
}

/// Whether the code uses another crate: at the beginning of a path, or in `use name`.
///
/// A module of drystone may have the name of a crate, as `output::png` does. In a file that imports or declares it,
/// the name means this module.
pub(crate) fn names_crate(code: &str, name: &str) -> bool {
    let ours = [";", "::{self", ",", "}"].map(|end| format!("::{name}{end}"));
    if ours.iter().any(|import| code.contains(import)) || code.contains(&format!("mod {name};")) {
        return false;
    }
    code.match_indices(name).any(|(at, _)| {
        let before = code[..at].chars().next_back().unwrap_or(' ');
        let before_is_head = !(before.is_alphanumeric() || before == '_')
            && (before != ':' || code[..at].ends_with(" ::") || code[..at].ends_with("(::"));
        let after = &code[at + name.len()..];
        let used = code[..at].trim_end().ends_with("use") && after.starts_with([';', ' ']);
        before_is_head && (after.starts_with("::") || used)
    })
}

/// The code without comments, strings and character literals.
pub(crate) fn bare(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let bytes: Vec<char> = text.chars().collect();
    let mut i = 0;
    let at = |i: usize| bytes.get(i).copied().unwrap_or('\0');
    while i < bytes.len() {
        let c = bytes[i];
        if c == '/' && at(i + 1) == '/' {
            while i < bytes.len() && bytes[i] != '\n' {
                i += 1;
            }
        } else if c == '/' && at(i + 1) == '*' {
            let mut depth = 0;
            loop {
                if at(i) == '/' && at(i + 1) == '*' {
                    depth += 1;
                    i += 2;
                } else if at(i) == '*' && at(i + 1) == '/' {
                    depth -= 1;
                    i += 2;
                } else {
                    i += 1;
                }
                if depth == 0 || i >= bytes.len() {
                    break;
                }
            }
        } else if c == 'r' && (at(i + 1) == '"' || at(i + 1) == '#') && !ends_in_word(&out) {
            let hashes = bytes[i + 1..].iter().take_while(|c| **c == '#').count();
            if at(i + 1 + hashes) != '"' {
                out.push(c);
                i += 1;
                continue;
            }
            let close: Vec<char> = std::iter::once('"').chain(std::iter::repeat_n('#', hashes)).collect();
            i += 2 + hashes;
            while i < bytes.len() && !bytes[i..].starts_with(&close) {
                i += 1;
            }
            i += close.len();
        } else if c == '"' {
            i += 1;
            while i < bytes.len() && bytes[i] != '"' {
                i += if bytes[i] == '\\' { 2 } else { 1 };
            }
            i += 1;
        } else if c == '\'' && (at(i + 2) == '\'' || at(i + 1) == '\\') {
            // A character literal. A lifetime has no quote after its first letter.
            i += if at(i + 1) == '\\' { 3 } else { 2 };
            while i < bytes.len() && bytes[i] != '\'' {
                i += 1;
            }
            i += 1;
        } else {
            out.push(c);
            i += 1;
        }
    }
    out
}

/// Whether the last character may be part of a name.
pub(crate) fn ends_in_word(text: &str) -> bool {
    text.chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_')
}
