//! [`Reader`]: reads the values of a scene file, such as numbers, points and lists, from the syntax tree.
//!
//! A value that does not fit is reported, with what was expected and what was found, and then treated as absent. Its
//! path is recorded as unreadable, so that problems that only follow from its absence are not reported.

use std::collections::BTreeMap;

use super::super::finding::{Findings, UnreadParts};
use super::super::format::{Map, Pair};
use super::super::path::Trail;
use super::super::problem::{self, Wording};
use super::super::source::{Mark, Source};
use super::super::tree::{Entry, List, Node, NodeKind};

/// In objects with more keys than this, repeated keys are found with a table. In smaller objects, each key is compared
/// with all keys before it.
const MAX_KEYS_WITHOUT_TABLE: usize = 16;

/// Reads the values of a scene file and collects their problems.
pub(super) struct Reader<'s, 't> {
    pub(super) source: &'s Source<'t>,
    pub(super) findings: Findings,
    pub(super) unread: UnreadParts,
}

/// The entries of a value that is an object.
#[derive(Clone, Copy)]
pub(super) struct Object<'n, 't> {
    entries: &'n [Entry<'t>],
}

impl<'n, 't> Object<'n, 't> {
    /// Returns the value of the key `key`; `None` if the object has no such key. If the key occurs twice, returns its
    /// first value.
    fn get(self, key: &str) -> Option<&'n Node<'t>> {
        let found = self.entries.iter().find(|e| e.name == key);
        found.map(|e| &e.value)
    }
}

/// The meaning of a pair of numbers, for messages.
#[derive(Clone, Copy)]
pub(super) enum Meaning {
    Point,
    Vector,
}

impl<'s, 't> Reader<'s, 't> {
    pub(super) fn new(source: &'s Source<'t>) -> Reader<'s, 't> {
        Reader { source, findings: Findings::default(), unread: UnreadParts::default() }
    }

    /// Returns the entries of a list.
    pub(super) fn items(&self, list: &List) -> &'s [Node<'t>] {
        let tree = self.source.tree.as_ref();
        tree.map_or(&[], |tree| tree.items(list))
    }

    /// Reports a problem of the key or value at `at`, and records that this part of the file could not be read.
    fn report(&mut self, at: &Trail<'_>, mark: Mark, wording: Wording) {
        if self.findings.is_full() {
            // The list of problems is full. Treat the whole file as unreadable, so that no further problems are
            // reported.
            self.unread.paths = vec![Trail::Top.path()];
            return;
        }
        self.unread.paths.push(at.path());
        match mark {
            Mark::Key => self.findings.add_key(at, wording),
            Mark::Value => self.findings.add(at, wording),
        }
    }

    /// Reports that a value has the wrong type. `expected` describes the right type for the message.
    pub(super) fn wrong(&mut self, node: &Node<'_>, at: &Trail<'_>, expected: &str) {
        let quoted = match &node.kind {
            NodeKind::Text(text) if expected == "a number" => {
                Some(text.trim()).filter(|t| t.parse::<f64>().is_ok_and(f64::is_finite))
            }
            _ => None,
        };
        let is_text = matches!(node.kind, NodeKind::Text(_));
        let wording = match quoted {
            Some(number) => problem::entry::quoted_number(expected, &problem::shortened(number)),
            None if expected == "a number" && at.ends_in("friction") && is_text => {
                problem::entry::friction_word(expected, &self.found(node))
            }
            None => problem::entry::wrong_type(expected, &self.found(node)),
        };
        self.report(at, Mark::Value, wording);
    }

    /// Describes a value for messages, such as "the number 5" or "an object".
    fn found(&self, node: &Node<'_>) -> String {
        match &node.kind {
            NodeKind::Null => "null".into(),
            NodeKind::Flag(flag) => flag.to_string(),
            NodeKind::Number(_) => format!("the number {}", problem::shortened(self.written(node))),
            NodeKind::Text(text) => format!("the string \"{}\"", problem::shortened(text)),
            NodeKind::List(list) => format!("a list of length {}", list.len()),
            NodeKind::Object(_) => "an object".into(),
        }
    }

    /// Returns the text of a value as written in the file.
    pub(super) fn written(&self, node: &Node<'_>) -> &'t str {
        &self.source.text[node.range.clone()]
    }

    pub(super) fn number(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<f64> {
        match node.kind {
            NodeKind::Number(x) if x.is_finite() => return Some(x),
            NodeKind::Number(_) => {
                let wording = problem::text::number_too_large(self.written(node));
                self.report(at, Mark::Value, wording);
            }
            _ => self.wrong(node, at, "a number"),
        }
        None
    }

    pub(super) fn text(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<String> {
        if let NodeKind::Text(text) = &node.kind {
            return Some(text.clone().into_owned());
        }
        self.wrong(node, at, "a string");
        None
    }

    pub(super) fn flag(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<bool> {
        if let NodeKind::Flag(flag) = node.kind {
            return Some(flag);
        }
        self.wrong(node, at, "true or false");
        None
    }

    /// Reads a string that must be one of the words in `choices`, and returns the value of that word. Reports any other
    /// value and returns `None`.
    pub(super) fn choice<T: Copy>(&mut self, node: &Node<'_>, at: &Trail<'_>, choices: &[(&str, T)]) -> Option<T> {
        let names: Vec<String> = choices.iter().map(|c| c.0.to_owned()).collect();
        let NodeKind::Text(text) = &node.kind else {
            let expected = problem::choice(names.iter().map(|n| format!("\"{n}\"")));
            self.wrong(node, at, &expected);
            return None;
        };
        let chosen = choices.iter().find(|c| c.0 == text).map(|c| c.1);
        if chosen.is_none() {
            self.report(at, Mark::Value, problem::entry::unknown_choice(text, &names));
        }
        chosen
    }

    /// Reads a point or vector [x, y]. If the list has more than two numbers, reports the error and returns the first
    /// two. Reports any other invalid value and returns `None`.
    pub(super) fn pair(&mut self, node: &Node<'_>, at: &Trail<'_>, meaning: Meaning) -> Option<Pair> {
        let NodeKind::List(list) = &node.kind else {
            let expected = match meaning {
                Meaning::Point => "a point [x, y]",
                Meaning::Vector => "a vector [x, y]",
            };
            self.wrong(node, at, expected);
            return None;
        };
        let items = self.items(list);
        let mut numbers = [0.0; 2];
        let mut sound = true;
        for (i, item) in items.iter().take(2).enumerate() {
            match self.number(item, &at.index(i)) {
                Some(x) => numbers[i] = x,
                None => sound = false,
            }
        }
        if items.len() != 2 {
            let wording = match meaning {
                Meaning::Point => problem::entry::coordinates(items.len()),
                Meaning::Vector => problem::entry::components(items.len()),
            };
            if items.len() > 2 && sound {
                self.findings.add(at, wording);
                return Some(numbers);
            }
            if sound {
                self.report(at, Mark::Value, wording);
            }
            return None;
        }
        sound.then_some(numbers)
    }

    pub(super) fn point(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<Pair> {
        self.pair(node, at, Meaning::Point)
    }

    pub(super) fn vector(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<Pair> {
        self.pair(node, at, Meaning::Vector)
    }

    /// Reads an object. Reports keys that are not in `keys`, and keys that occur twice.
    pub(super) fn object(&mut self, node: &Node<'t>, at: &Trail<'_>, keys: &[&str]) -> Option<Object<'s, 't>> {
        let object = self.any_object(node, at)?;
        for entry in object.entries {
            if !keys.contains(&entry.name.as_ref()) {
                let known = keys.iter().copied().filter(|k| *k != "$schema");
                let wording = problem::entry::unknown_key(&entry.name, known);
                self.report(&at.key(&entry.name), Mark::Key, wording);
            }
        }
        Some(object)
    }

    /// Reads an object with any keys. Reports keys that occur twice.
    fn any_object(&mut self, node: &Node<'t>, at: &Trail<'_>) -> Option<Object<'s, 't>> {
        let NodeKind::Object(object) = &node.kind else {
            self.wrong(node, at, "an object");
            return None;
        };
        let entries = self.source.tree.as_ref()?.entries(object);
        for (second, first) in repeated(entries) {
            let (line, column) = self.source.place(first.name_range.start);
            let wording = problem::entry::duplicate_key(&second.name, line, column);
            self.report(&at.key(&second.name), Mark::Key, wording);
        }
        Some(Object { entries })
    }

    /// Reads the value of an optional key with the function `read`. Returns `None` if the key is absent, if its value
    /// is `null`, or if `read` returns `None`.
    pub(super) fn optional<T>(
        &mut self,
        object: Object<'_, 't>,
        at: &Trail<'_>,
        key: &str,
        read: impl FnOnce(&mut Self, &Node<'t>, &Trail<'_>) -> Option<T>,
    ) -> Option<T> {
        let node = object.get(key)?;
        match node.kind {
            NodeKind::Null => None,
            _ => read(self, node, &at.key(key)),
        }
    }

    /// Reads the value of a required key with the function `read`. Reports a missing key and returns `None`.
    pub(super) fn required<T>(
        &mut self,
        object: Object<'_, 't>,
        at: &Trail<'_>,
        key: &str,
        read: impl FnOnce(&mut Self, &Node<'t>, &Trail<'_>) -> Option<T>,
    ) -> Option<T> {
        if let Some(node) = object.get(key) {
            return read(self, node, &at.key(key));
        }
        let wording = problem::entry::missing_key(key);
        self.report(&at.key(key), Mark::Value, wording);
        None
    }

    /// Reads the list that is the value of `key`. The function `read` reads each entry. The result is empty if the key
    /// is absent, or if its value is not a list.
    pub(super) fn list<T: Default>(
        &mut self,
        object: Object<'_, 't>,
        at: &Trail<'_>,
        key: &str,
        read: impl FnMut(&mut Self, &Node<'t>, &Trail<'_>) -> Option<T>,
    ) -> Vec<T> {
        let node = object.get(key);
        node.and_then(|node| self.entries(node, &at.key(key), read)).unwrap_or_default()
    }

    /// Reads all entries of a list with the function `read`. An entry that does not fit is replaced by the default
    /// value, so that the other entries keep their indices.
    pub(super) fn entries<T: Default>(
        &mut self,
        node: &Node<'t>,
        at: &Trail<'_>,
        mut read: impl FnMut(&mut Self, &Node<'t>, &Trail<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let NodeKind::List(list) = &node.kind else {
            self.wrong(node, at, "a list");
            return None;
        };
        let items = self.items(list);
        let mut list = Vec::with_capacity(items.len());
        for (i, item) in items.iter().enumerate() {
            list.push(read(self, item, &at.index(i)).unwrap_or_default());
        }
        Some(list)
    }

    /// Reads the object that is the value of `key` as a map from names to values. If a name occurs twice, only the
    /// first entry counts. The map is empty if the key is absent, or if its value is not an object.
    pub(super) fn map<T: Default>(
        &mut self,
        object: Object<'_, 't>,
        at: &Trail<'_>,
        key: &str,
        mut read: impl FnMut(&mut Self, &Node<'t>, &Trail<'_>) -> Option<T>,
    ) -> Map<T> {
        let Some(node) = object.get(key) else {
            return Map::default();
        };
        let at = at.key(key);
        let Some(object) = self.any_object(node, &at) else {
            return Map::default();
        };
        let mut map: Vec<(String, T)> = Vec::with_capacity(object.entries.len());
        let again: Vec<usize> = (repeated(object.entries)).map(|(second, _)| second.name_range.start).collect();
        for entry in object.entries {
            if again.contains(&entry.name_range.start) {
                continue;
            }
            let value = read(self, &entry.value, &at.key(&entry.name)).unwrap_or_default();
            map.push((entry.name.clone().into_owned(), value));
        }
        Map(map)
    }
}

/// Returns the entries whose key occurred before, each together with the first entry that has the same key.
fn repeated<'n, 't>(entries: &'n [Entry<'t>]) -> impl Iterator<Item = (&'n Entry<'t>, &'n Entry<'t>)> {
    let mut table: BTreeMap<&str, &Entry<'t>> = BTreeMap::new();
    entries.iter().enumerate().filter_map(move |(i, entry)| {
        let first = if entries.len() <= MAX_KEYS_WITHOUT_TABLE {
            entries[..i].iter().find(|e| e.name == entry.name)
        } else {
            let first = table.get(entry.name.as_ref()).copied();
            table.entry(entry.name.as_ref()).or_insert(entry);
            first
        };
        first.map(|first| (entry, first))
    })
}
