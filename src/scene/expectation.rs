//! [`Expectation`]: what the types of a scene file expect, walked beside a file that does not keep to it.
//!
//! [`check`] finds every misfit at once, and writes the file anew with stand-ins for what does not fit, so that its
//! meaning can be examined all the same.

use std::collections::BTreeMap;

use super::finding::{Doubt, Finding, Findings};
use super::path::Trail;
use super::problem;
use super::source::{Entry, Mark, Node, NodeKind, Source};

/// What a value is expected to be.
#[derive(Clone, Debug)]
pub(super) enum Expectation {
    /// `null`: the same as nothing.
    Null,
    /// `true` or `false`.
    Flag,
    /// A number.
    Number,
    /// A whole number.
    Whole,
    /// A string.
    Text,
    /// One of these strings.
    Name(Vec<String>),
    /// A list of any length.
    List(Box<Expectation>),
    /// A list of exactly these.
    Tuple(Vec<Expectation>),
    /// An object with these keys and no others.
    Object(Vec<Key>),
    /// An object with any keys.
    Map(Box<Expectation>),
    /// One of several.
    Any(Vec<Expectation>),
    /// Whatever.
    Anything,
}

/// A key of an object.
#[derive(Clone, Debug)]
pub(super) struct Key {
    /// Its name.
    pub(super) name: String,
    /// Whether it has to be there.
    pub(super) required: bool,
    /// What its value is expected to be.
    pub(super) value: Expectation,
}

impl Expectation {
    /// One of several; names are put together into one list of names.
    pub(super) fn any(choices: Vec<Expectation>) -> Expectation {
        let mut names = Vec::new();
        let mut others = Vec::new();
        for choice in choices {
            match choice {
                Expectation::Name(more) => names.extend(more),
                other => others.push(other),
            }
        }
        if !names.is_empty() {
            others.insert(0, Expectation::Name(names));
        }
        if others.len() == 1 {
            others.swap_remove(0)
        } else {
            Expectation::Any(others)
        }
    }

    /// What is expected, in words.
    fn words(&self) -> String {
        match self {
            Expectation::Null => "null".into(),
            Expectation::Flag => "true or false".into(),
            Expectation::Number => "a number".into(),
            Expectation::Whole => "a whole number".into(),
            Expectation::Text => "a string".into(),
            Expectation::Name(names) => problem::choice(names.iter().map(|n| format!("\"{n}\""))),
            Expectation::List(_) => "a list".into(),
            Expectation::Tuple(items) if items.iter().all(|i| matches!(i, Expectation::Number)) => {
                format!("a list of {} numbers", items.len())
            }
            Expectation::Tuple(items) => {
                format!(
                    "[{}]",
                    items
                        .iter()
                        .map(Expectation::words)
                        .collect::<Vec<_>>()
                        .join(", ")
                )
            }
            Expectation::Object(_) | Expectation::Map(_) => "an object".into(),
            Expectation::Any(choices) => problem::choice(
                choices
                    .iter()
                    .filter(|c| !matches!(c, Expectation::Null))
                    .map(Expectation::words),
            ),
            Expectation::Anything => "anything".into(),
        }
    }

    /// Something that fits, as JSON: the simplest.
    fn stand_in(&self) -> String {
        match self {
            Expectation::Null | Expectation::Anything => "null".into(),
            Expectation::Flag => "false".into(),
            Expectation::Number | Expectation::Whole => "0".into(),
            Expectation::Text => "\"\"".into(),
            Expectation::Name(names) => format!("\"{}\"", names.first().map_or("", String::as_str)),
            Expectation::List(_) => "[]".into(),
            Expectation::Map(_) => "{}".into(),
            Expectation::Tuple(items) => {
                format!(
                    "[{}]",
                    items
                        .iter()
                        .map(Expectation::stand_in)
                        .collect::<Vec<_>>()
                        .join(",")
                )
            }
            Expectation::Object(keys) => {
                let required = keys.iter().filter(|k| k.required);
                let entries = required.map(|k| format!("\"{}\":{}", k.name, k.value.stand_in()));
                format!("{{{}}}", entries.collect::<Vec<_>>().join(","))
            }
            Expectation::Any(choices) => {
                choices.first().map_or("null".into(), Expectation::stand_in)
            }
        }
    }
}

/// A file that was walked: what does not fit, and the file with stand-ins.
pub(super) struct Checked {
    /// Every misfit.
    pub(super) findings: Vec<Finding>,
    /// Where the stand-ins are.
    pub(super) doubt: Doubt,
    /// The file with stand-ins, as JSON that fits.
    pub(super) text: String,
}

/// Walks a file beside what is expected of it.
pub(super) fn check(source: &Source<'_>, root: &Node, expected: &Expectation) -> Checked {
    let mut walk = Walk {
        source,
        findings: Findings::default(),
        doubt: Doubt::default(),
        level: usize::MAX,
    };
    let mut text = String::with_capacity(source.text.len());
    walk.value(root, expected, &Trail::Top, 0, &mut text);
    Checked {
        findings: walk.findings.list,
        doubt: walk.doubt,
        text,
    }
}

struct Walk<'s> {
    source: &'s Source<'s>,
    findings: Findings,
    doubt: Doubt,
    /// How many steps down the topmost misfit lies.
    level: usize,
}

impl Walk<'_> {
    fn misfit(&mut self, at: &Trail<'_>, level: usize, mark: Mark, wording: problem::Wording) {
        self.level = self.level.min(level);
        if self.findings.is_full() {
            // A file with so many misfits is not examined further.
            self.doubt.paths = vec![Trail::Top.path()];
            return;
        }
        self.doubt.paths.push(at.path());
        match mark {
            Mark::Key => self.findings.add_key(at, wording),
            Mark::Value => self.findings.add(at, wording),
        }
    }

    /// Checks one value and appends it, or a stand-in, to `out`.
    fn value(
        &mut self,
        node: &Node,
        expected: &Expectation,
        at: &Trail<'_>,
        level: usize,
        out: &mut String,
    ) {
        match (expected, &node.kind) {
            (Expectation::Null, NodeKind::Null)
            | (Expectation::Flag, NodeKind::Flag)
            | (Expectation::Number, NodeKind::Number(_))
            | (Expectation::Text, NodeKind::Text(_))
            | (Expectation::Anything, _) => out.push_str(self.written(node)),
            (Expectation::Whole, NodeKind::Number(number)) if number.parse::<i64>().is_ok() => {
                out.push_str(self.written(node));
            }
            (Expectation::Name(names), NodeKind::Text(text)) => {
                if names.contains(text) {
                    out.push_str(self.written(node));
                } else {
                    self.misfit(
                        at,
                        level,
                        Mark::Value,
                        problem::entry::unknown_choice(text, names),
                    );
                    out.push_str(&expected.stand_in());
                }
            }
            (Expectation::List(item), NodeKind::List(entries)) => {
                self.list(entries.iter().map(|e| (e, &**item)), at, level, out);
            }
            (Expectation::Tuple(items), NodeKind::List(entries)) => {
                if items.len() == entries.len() {
                    self.list(entries.iter().zip(items), at, level, out);
                } else {
                    self.misfit(
                        at,
                        level,
                        Mark::Value,
                        problem::entry::wrong_length(entries.len(), &expected.words()),
                    );
                    out.push_str(&expected.stand_in());
                }
            }
            (Expectation::Map(value), NodeKind::Object(entries)) => {
                self.object(entries, |_| Some(value), &[], at, level, out);
            }
            (Expectation::Object(keys), NodeKind::Object(entries)) => {
                self.object(
                    entries,
                    |name| keys.iter().find(|k| k.name == name).map(|k| &k.value),
                    keys,
                    at,
                    level,
                    out,
                );
            }
            (Expectation::Any(choices), _) => self.any(node, expected, choices, at, level, out),
            _ => {
                self.wrong_type(node, expected, at, level, out);
            }
        }
    }

    fn list<'n>(
        &mut self,
        entries: impl Iterator<Item = (&'n Node, &'n Expectation)>,
        at: &Trail<'_>,
        level: usize,
        out: &mut String,
    ) {
        out.push('[');
        for (i, (entry, expected)) in entries.enumerate() {
            if i > 0 {
                out.push(',');
            }
            self.value(entry, expected, &at.index(i), level + 1, out);
        }
        out.push(']');
    }

    fn object<'e>(
        &mut self,
        entries: &[Entry],
        expected: impl Fn(&str) -> Option<&'e Expectation>,
        keys: &[Key],
        at: &Trail<'_>,
        level: usize,
        out: &mut String,
    ) {
        let mut seen: BTreeMap<&str, &Entry> = BTreeMap::new();
        let before = out.len();
        out.push('{');
        for entry in entries {
            let here = at.key(&entry.name);
            if let Some(first) = seen.get(entry.name.as_str()) {
                let (line, column) = self.source.place(first.name_range.start);
                self.misfit(
                    &here,
                    level + 1,
                    Mark::Key,
                    problem::entry::duplicate_key(&entry.name, line, column),
                );
                continue;
            }
            seen.insert(&entry.name, entry);
            let Some(expected) = expected(&entry.name) else {
                let free = keys
                    .iter()
                    .map(|k| k.name.as_str())
                    .filter(|k| *k != "$schema");
                self.misfit(
                    &here,
                    level + 1,
                    Mark::Key,
                    problem::entry::unknown_key(&entry.name, free),
                );
                continue;
            };
            if out.len() > before + 1 {
                out.push(',');
            }
            out.push_str(&self.source.text[entry.name_range.clone()]);
            out.push(':');
            self.value(&entry.value, expected, &here, level + 1, out);
        }
        for key in keys
            .iter()
            .filter(|k| k.required && !seen.contains_key(k.name.as_str()))
        {
            self.misfit(
                &at.key(&key.name),
                level + 1,
                Mark::Value,
                problem::entry::missing_key(&key.name),
            );
            if out.len() > before + 1 {
                out.push(',');
            }
            out.push_str(&format!("\"{}\":{}", key.name, key.value.stand_in()));
        }
        out.push('}');
    }

    /// Takes the choice that fits, else the one that comes nearest: it fails deepest down, and least often.
    fn any(
        &mut self,
        node: &Node,
        expected: &Expectation,
        choices: &[Expectation],
        at: &Trail<'_>,
        level: usize,
        out: &mut String,
    ) {
        let mut best: Option<(Walk<'_>, String)> = None;
        for choice in choices {
            let mut walk = Walk {
                source: self.source,
                findings: Findings::default(),
                doubt: Doubt::default(),
                level: usize::MAX,
            };
            let mut text = String::new();
            walk.value(node, choice, at, level, &mut text);
            let nearer = best.as_ref().is_none_or(|(b, _)| {
                let (here, there) = (walk.level, b.level);
                here > there || (here == there && walk.findings.list.len() < b.findings.list.len())
            });
            if nearer {
                best = Some((walk, text));
            }
        }
        let same_kind = |choice: &&Expectation| {
            matches!(
                (choice, &node.kind),
                (
                    Expectation::List(_) | Expectation::Tuple(_),
                    NodeKind::List(_)
                ) | (
                    Expectation::Object(_) | Expectation::Map(_),
                    NodeKind::Object(_)
                ) | (Expectation::Name(_), NodeKind::Text(_))
            )
        };
        match best {
            Some((walk, text))
                if walk.level > level || choices.iter().filter(same_kind).count() == 1 =>
            {
                self.level = self.level.min(walk.level);
                let full = self.findings.is_full();
                for finding in walk.findings.list {
                    self.findings.keep(finding);
                }
                if full {
                    self.doubt.paths = vec![Trail::Top.path()];
                } else {
                    self.doubt.paths.extend(walk.doubt.paths);
                }
                out.push_str(&text);
            }
            _ => {
                self.wrong_type(node, expected, at, level, out);
            }
        }
    }

    fn wrong_type(
        &mut self,
        node: &Node,
        expected: &Expectation,
        at: &Trail<'_>,
        level: usize,
        out: &mut String,
    ) {
        let words = expected.words();
        let wording = match &node.kind {
            NodeKind::Text(text)
                if words == "a number" && text.parse::<f64>().is_ok_and(f64::is_finite) =>
            {
                problem::entry::quoted_number(&words, &problem::shortened(text))
            }
            _ => problem::entry::wrong_type(&words, &self.found(node)),
        };
        self.misfit(at, level, Mark::Value, wording);
        out.push_str(&expected.stand_in());
    }

    fn written(&self, node: &Node) -> &str {
        &self.source.text[node.range.clone()]
    }

    /// What stands there, in words.
    fn found(&self, node: &Node) -> String {
        match &node.kind {
            NodeKind::Null => "null".into(),
            NodeKind::Flag => self.written(node).into(),
            NodeKind::Number(number) => format!("the number {}", problem::shortened(number)),
            NodeKind::Text(text) => format!("the string \"{}\"", problem::shortened(text)),
            NodeKind::List(entries) => format!("a list of {}", entries.len()),
            NodeKind::Object(_) => "an object".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::format;

    #[test]
    fn a_sound_file_is_written_anew_as_it_was() {
        for text in [
            include_str!("../../assets/starter.json"),
            include_str!("../../assets/thesis/figure-4.json"),
        ] {
            let source = Source::parse(text);
            let root = source.root.as_ref().expect("JSON");
            let checked = check(&source, root, &format::expected());
            assert!(checked.findings.is_empty() && checked.doubt.paths.is_empty());
            let (before, after) = (format::parse(text), format::parse(&checked.text));
            assert_eq!(after.ok(), before.ok());
        }
    }

    #[test]
    fn what_does_not_fit_is_stood_in_for() {
        let text = r#"{ "drystone": "1", "blocks": [{ "id": 5, "polygon": [[0, 0], [1], [0, 1]] }], "grid": { "side": 2 } }"#;
        let source = Source::parse(text);
        let root = source.root.as_ref().expect("JSON");
        let checked = check(&source, root, &format::expected());
        let places: Vec<String> = checked
            .doubt
            .paths
            .iter()
            .map(ToString::to_string)
            .collect();
        assert_eq!(
            places,
            [
                "drystone",
                "blocks[0].id",
                "blocks[0].polygon[1]",
                "grid.kind"
            ]
        );
        let file = format::parse(&checked.text)
            .ok()
            .expect("the stand-ins fit");
        assert_eq!(
            file.blocks[0].polygon,
            Some(vec![[0.0, 0.0], [0.0, 0.0], [0.0, 1.0]])
        );
        assert_eq!(file.grid.and_then(|g| g.side), Some(2.0));
    }
}
