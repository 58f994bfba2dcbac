//! The names of the fields of a batch line, in the order of the result: the keys of a result, and `verdict`, the
//! worst verdict of all frames.

use std::sync::LazyLock;

use crate::products::result::key::{KEYS, Type};
use crate::text;

/// The name of a field, and the fields below it. The fields below a list are the fields of its entries.
#[derive(Debug)]
pub(super) struct Name {
    pub word: &'static str,
    pub parts: Vec<Name>,
}

/// All fields that can be selected, except `all`. The path of the file and the picture are written without selection.
pub(super) static NAMES: LazyLock<Vec<Name>> = LazyLock::new(|| {
    let mut names = Vec::new();
    // A path with `*` belongs to a key below the name of a robot. Such keys cannot be selected one by one, only all
    // together by the name of the object that contains the robots.
    for key in KEYS.iter().filter(|k| k.path != "file" && !k.path.contains('*')) {
        let mut list = &mut names;
        for word in key.path.split('.') {
            let word = word.trim_end_matches("[]");
            let known = list.iter().position(|name: &Name| name.word == word);
            let place = known.unwrap_or_else(|| {
                list.push(leaf(word));
                list.len() - 1
            });
            list = &mut list[place].parts;
        }
        if key.kind == Type::Motions {
            list.extend(["block", "velocity", "spin"].map(leaf));
        }
    }
    let behind = names.iter().position(|name| name.word == "scene");
    names.insert(behind.map_or(0, |place| place + 1), leaf("verdict"));
    names
});

fn leaf(word: &'static str) -> Name {
    Name { word, parts: Vec::new() }
}

/// Returns the words of the path of the field with this name, such as `frames`, `proof`; `None` if there is no such
/// field.
pub(super) fn find(typed: &str) -> Option<Vec<&'static str>> {
    if typed == "all" {
        return Some(vec!["all"]);
    }
    let mut names: &'static [Name] = &NAMES;
    let mut path = Vec::new();
    for word in typed.split('.') {
        let name = names.iter().find(|name| name.word == word)?;
        path.push(name.word);
        names = &name.parts;
    }
    Some(path)
}

/// Returns the name of the field that is most similar to `typed`; `None` if no name is similar.
pub(super) fn nearest(typed: &str) -> Option<String> {
    let known = all();
    // Suggest the right field if the user typed another common word for the interfaces or for the total force.
    let synonym = match typed.rsplit('.').next().unwrap_or(typed) {
        "forces" | "contacts" | "contact_forces" => Some("frames.interfaces"),
        "force" | "sum_of_forces" => Some("frames.total_force"),
        _ => None,
    };
    if let Some(name) = synonym {
        return Some(name.to_owned());
    }
    text::nearest(typed, known.iter().map(String::as_str)).map(str::to_owned)
}

/// Returns the names of all fields, such as `frames.total_force`.
fn all() -> Vec<String> {
    fn add(names: &[Name], before: &str, list: &mut Vec<String>) {
        for name in names {
            let path = format!("{before}{}", name.word);
            add(&name.parts, &format!("{path}."), list);
            list.push(path);
        }
    }
    let mut list = vec!["all".to_owned()];
    add(&NAMES, "", &mut list);
    list
}
