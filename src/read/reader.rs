//! [`Reader`]: reads values, such as numbers, points and lists, from a syntax tree, and collects all mistakes.
//!
//! A value that does not fit is reported, with what was expected and what was found, and then treated as absent. Its
//! path is recorded as unreadable, so that problems that only follow from its absence are not reported.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::mistake::{Cause, Dialect, Expected, Kind, Mistake, Problem, Problems};
use super::path::{Path, Trail};
use super::source::{Mark, Source};
use super::tree::{Entry, List, Node, NodeKind};
use crate::text::{choice, nearest, shortened};

/// The largest number of mistakes that are kept. If a text has more, they probably have one cause, which the first
/// mistakes already show.
pub const MAX_FINDINGS: usize = 2000;

/// In objects with more keys than this, repeated keys are found with a table. In smaller objects, each key is compared
/// with all keys before it.
const MAX_KEYS_WITHOUT_TABLE: usize = 16;

/// A mistake and the path of its value or key.
#[derive(Debug)]
pub struct Finding {
    /// The path of the value.
    pub path: Path,
    /// Whether the key or the value at this path is wrong.
    pub mark: Mark,
    /// The kind, the message and the remedy.
    pub mistake: Mistake,
}

/// Reads the values of a text and collects their mistakes.
#[derive(Debug)]
pub struct Reader<'s> {
    source: &'s Source<'s>,
    dialect: &'s Dialect,
    /// The mistakes found so far.
    pub findings: Vec<Finding>,
    /// The paths of the values and keys that could not be read; the whole text if there are too many.
    pub unread: Vec<Path>,
}

/// The entries of a value that is an object.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'s>(&'s [Entry<'s>]);

impl<'s> Fields<'s> {
    /// Returns the value of the key `key`; `None` if the object has no such key. If the key occurs twice, returns its
    /// first value.
    pub fn get(self, key: &str) -> Option<&'s Node<'s>> {
        let found = self.0.iter().find(|e| e.name == key);
        found.map(|e| &e.value)
    }
}

impl<'s> Reader<'s> {
    /// Creates a reader of the values of `source`. `dialect` supplies remedies that only the format knows.
    pub fn new(source: &'s Source<'s>, dialect: &'s Dialect) -> Reader<'s> {
        Reader { source, dialect, findings: Vec::new(), unread: Vec::new() }
    }

    /// Returns the mistakes as problems with line and column, in the order of the text; `None` if there are none.
    pub fn problems(self) -> Option<Problems> {
        let source = self.source;
        let mut list: Vec<(usize, Problem)> = self
            .findings
            .into_iter()
            .map(|finding| {
                let start = source.find(&finding.path, finding.mark).map_or(0, |span| span.start);
                (start, source.problem(start, &finding.path.to_string(), finding.mistake))
            })
            .collect();
        list.sort_by_key(|(start, _)| *start);
        (!list.is_empty()).then(|| Problems(list.into_iter().map(|(_, problem)| problem).collect()))
    }

    /// Returns the entries of a list.
    pub fn items(&self, list: &List) -> &'s [Node<'s>] {
        let tree = self.source.tree.as_ref();
        tree.map_or(&[], |tree| tree.items(list))
    }

    /// Returns the text of a value as it is written. A number that does not stand in the text is written here.
    pub fn written(&self, node: &Node<'_>) -> Cow<'s, str> {
        match node.kind {
            NodeKind::Number(number) if node.range.is_empty() => number.to_string().into(),
            _ => self.source.text.get(node.range.clone()).unwrap_or("").into(),
        }
    }

    /// Adds a mistake of the key or value at the path `at` to the findings. The value still counts as read.
    fn add(&mut self, at: &Trail<'_>, mark: Mark, mistake: Mistake) {
        match self.findings.len() {
            n if n < MAX_FINDINGS => self.findings.push(Finding { path: at.path(), mark, mistake }),
            MAX_FINDINGS => {
                self.findings.push(Finding { path: Path::default(), mark: Mark::Value, mistake: more() });
            }
            _ => {}
        }
    }

    /// Reports a mistake of the key or value at the path `at`, and records that this part of the text could not be
    /// read.
    pub fn report(&mut self, at: &Trail<'_>, mark: Mark, mistake: Mistake) {
        if self.findings.len() > MAX_FINDINGS {
            // Treat the whole text as unreadable, so that no further problems are reported.
            self.unread = vec![Path::default()];
            return;
        }
        self.unread.push(at.path());
        self.add(at, mark, mistake);
    }

    /// Reports that a value has the wrong type, or is not within the range that `expected` describes.
    pub fn wrong(&mut self, node: &Node<'_>, at: &Trail<'_>, expected: Expected<'_>) {
        let written = shortened(&self.written(node));
        let found = match &node.kind {
            NodeKind::Null => "null".into(),
            NodeKind::Flag(flag) => flag.to_string(),
            NodeKind::Number(_) => format!("the number {written}"),
            NodeKind::Text(text) => format!("the string \"{}\"", shortened(text)),
            NodeKind::List(list) => format!("a list of length {}", list.len()),
            NodeKind::Object(_) => "an object".into(),
            NodeKind::Date => format!("the date {written}"),
        };
        let cause = Cause::WrongType { at, expected, found: &node.kind, written: &written };
        let help = match (expected, &node.kind) {
            (Expected::Number, NodeKind::Text(text)) if text.trim().parse::<f64>().is_ok_and(f64::is_finite) => {
                let number = shortened(text.trim());
                let message = format!("expected {expected}, found the string \"{number}\"");
                let help = format!("write {number} without quotes");
                return self.report(at, Mark::Value, Mistake::new(Kind::WrongType, message, help));
            }
            (Expected::Number, NodeKind::Text(text)) if decimal(text).is_some() => {
                format!("write {}, with a point and without quotes", decimal(text).unwrap_or_default())
            }
            (Expected::Text, NodeKind::Number(_)) => format!("write \"{written}\", in quotes"),
            (Expected::List, NodeKind::Text(text)) => format!("write a list in brackets: [\"{}\"]", shortened(text)),
            (Expected::List, NodeKind::Object(_)) => "write a list in brackets: [{…}]".into(),
            _ => format!("write {expected} here"),
        };
        let message = format!("expected {expected}, found {found}");
        let mistake = Mistake::new(Kind::WrongType, message, self.dialect.help(cause, help));
        self.report(at, Mark::Value, mistake);
    }

    /// Reads a finite number.
    pub fn number(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<f64> {
        match node.kind {
            NodeKind::Number(x) if x.is_finite() => return Some(x),
            NodeKind::Number(x) if x.is_infinite() => {
                let message = format!("the number {} is too large", shortened(&self.written(node)));
                let mistake = Mistake::new(Kind::TooLarge, message, "give a number of at most 1e12");
                self.report(at, Mark::Value, mistake);
            }
            _ => self.wrong(node, at, Expected::Number),
        }
        None
    }

    /// Reads a number from `least` to `most`. `what` describes it in messages, such as "a width in millimetres".
    pub fn number_within(
        &mut self,
        node: &Node<'_>,
        at: &Trail<'_>,
        [least, most]: [f64; 2],
        what: &str,
    ) -> Option<f64> {
        match node.kind {
            NodeKind::Number(x) if (least..=most).contains(&x) => Some(x),
            _ => {
                self.wrong(node, at, Expected::Other(&format!("{what} from {least} to {most}")));
                None
            }
        }
    }

    /// Reads a whole number from `least` to `most`.
    pub fn whole_within(&mut self, node: &Node<'_>, at: &Trail<'_>, [least, most]: [u32; 2]) -> Option<u32> {
        match node.kind {
            NodeKind::Number(x) if libm::trunc(x) == x && (f64::from(least)..=f64::from(most)).contains(&x) => {
                Some(x as u32)
            }
            _ => {
                self.wrong(node, at, Expected::Other(&format!("a whole number from {least} to {most}")));
                None
            }
        }
    }

    /// Reads a string.
    pub fn text(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<String> {
        if let NodeKind::Text(text) = &node.kind {
            return Some(text.clone().into_owned());
        }
        self.wrong(node, at, Expected::Text);
        None
    }

    /// Reads `true` or `false`.
    pub fn flag(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<bool> {
        if let NodeKind::Flag(flag) = node.kind {
            return Some(flag);
        }
        self.wrong(node, at, Expected::Flag);
        None
    }

    /// Reads a string that must be one of the words in `choices`, and returns the value of that word. Reports any other
    /// value and returns `None`.
    pub fn choice<T: Copy>(&mut self, node: &Node<'_>, at: &Trail<'_>, choices: &[(&str, T)]) -> Option<T> {
        let NodeKind::Text(text) = &node.kind else {
            let expected = choice(choices.iter().map(|(name, _)| format!("\"{name}\"")));
            self.wrong(node, at, Expected::Other(&expected));
            return None;
        };
        let chosen = choices.iter().find(|c| c.0 == text).map(|c| c.1);
        if chosen.is_none() {
            let names: Vec<&str> = choices.iter().map(|c| c.0).collect();
            self.report(at, Mark::Value, unknown_choice(text, &names));
        }
        chosen
    }

    /// Reads a point or vector [x, y]. If the list has more than two numbers, reports the error and returns the first
    /// two. Reports any other invalid value and returns `None`.
    fn pair(&mut self, node: &Node<'_>, at: &Trail<'_>, expected: Expected<'_>, has: &str) -> Option<[f64; 2]> {
        let NodeKind::List(list) = &node.kind else {
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
        if items.len() == 2 || !sound {
            return (items.len() == 2 && sound).then_some(numbers);
        }
        let (count, help) = match items.len() {
            0 => ("none".into(), "write [x, y]"),
            1 => ("one".into(), "write [x, y]"),
            n => {
                let help = "write [x, y]; a scene has only two dimensions: x points to the right, and y points up";
                (
                    if n == 3 {
                        "three".into()
                    } else if n == 4 {
                        "four".into()
                    } else {
                        n.to_string()
                    },
                    help,
                )
            }
        };
        let mistake = Mistake::new(Kind::WrongLength, format!("{has}; this one has {count}"), help);
        if items.len() > 2 {
            self.add(at, Mark::Value, mistake);
            return Some(numbers);
        }
        self.report(at, Mark::Value, mistake);
        None
    }

    /// Reads a point [x, y].
    pub fn point(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<[f64; 2]> {
        self.pair(node, at, Expected::Point, "a point has two coordinates")
    }

    /// Reads a vector [x, y].
    pub fn vector(&mut self, node: &Node<'_>, at: &Trail<'_>) -> Option<[f64; 2]> {
        self.pair(node, at, Expected::Vector, "a vector has two components")
    }

    /// Reads an object. Reports keys that are not in `keys`, and keys that occur twice.
    pub fn object(&mut self, node: &'s Node<'s>, at: &Trail<'_>, keys: &[&str]) -> Option<Fields<'s>> {
        let fields = self.any_object(node, at)?;
        for entry in fields.0.iter().filter(|e| !keys.contains(&e.name.as_ref())) {
            // Keys with a dollar sign are for other programs, such as editors.
            let mut known: Vec<&str> = keys.iter().copied().filter(|k| !k.starts_with('$')).collect();
            known.sort_unstable();
            let key = entry.name.as_ref();
            let general = match nearest(key, known.iter().copied()) {
                Some(near) => format!("the nearest known key is `{near}`"),
                None => format!("known keys are {}", known.join(", ")),
            };
            let help = self.dialect.help(Cause::UnknownKey(key, &known), general);
            let mistake = Mistake::new(Kind::UnknownKey, format!("unknown key `{}`", shortened(key)), help);
            self.report(&at.key(key), Mark::Key, mistake);
        }
        Some(fields)
    }

    /// Reads an object with any keys. Reports keys that occur twice.
    fn any_object(&mut self, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Fields<'s>> {
        let NodeKind::Object(object) = &node.kind else {
            self.wrong(node, at, Expected::Object);
            return None;
        };
        let entries = self.source.tree.as_ref()?.entries(object);
        for (second, first) in repeated(entries) {
            let (line, column) = self.source.place(first.name_range.start);
            let key = shortened(&second.name);
            let line = self.dialect.lines_before + line;
            let message = format!("the key `{key}` occurs twice; first in line {line}, column {column}");
            let mistake = Mistake::new(Kind::DuplicateKey, message, "remove one of the two keys");
            self.report(&at.key(&second.name), Mark::Key, mistake);
        }
        Some(Fields(entries))
    }

    /// Reads the value of an optional key with the function `read`. Returns `None` if the key is absent, if its value
    /// is `null`, or if `read` returns `None`.
    pub fn optional<T>(
        &mut self,
        fields: Fields<'s>,
        at: &Trail<'_>,
        key: &str,
        read: impl FnOnce(&mut Self, &'s Node<'s>, &Trail<'_>) -> Option<T>,
    ) -> Option<T> {
        let node = fields.get(key)?;
        match node.kind {
            NodeKind::Null => None,
            _ => read(self, node, &at.key(key)),
        }
    }

    /// Reads the value of a key with the function `read`. Reports a missing key if it is required. Returns the default
    /// value if the key is absent, or if its value does not fit.
    pub fn key<T: Default>(
        &mut self,
        fields: Fields<'s>,
        at: &Trail<'_>,
        key: &str,
        is_required: bool,
        read: impl FnOnce(&mut Self, &'s Node<'s>, &Trail<'_>) -> Option<T>,
    ) -> T {
        if let Some(node) = fields.get(key) {
            return read(self, node, &at.key(key)).unwrap_or_default();
        }
        if is_required {
            let help = self.dialect.help(Cause::MissingKey(key), format!("add `\"{key}\"`"));
            let mistake = Mistake::new(Kind::MissingKey, format!("the key `{key}` is missing"), help);
            self.report(&at.key(key), Mark::Value, mistake);
        }
        T::default()
    }

    /// Reads all entries of a list with the function `read`. An entry that does not fit is replaced by the default
    /// value, so that the other entries keep their indices.
    pub fn entries<T: Default>(
        &mut self,
        node: &Node<'s>,
        at: &Trail<'_>,
        mut read: impl FnMut(&mut Self, &'s Node<'s>, &Trail<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let NodeKind::List(list) = &node.kind else {
            self.wrong(node, at, Expected::List);
            return None;
        };
        let items = self.items(list);
        let mut list = Vec::with_capacity(items.len());
        for (i, item) in items.iter().enumerate() {
            list.push(read(self, item, &at.index(i)).unwrap_or_default());
        }
        Some(list)
    }

    /// Reads an object as a list of names with their values. If a name occurs twice, only the first entry counts.
    pub fn names<T: Default>(
        &mut self,
        node: &'s Node<'s>,
        at: &Trail<'_>,
        mut read: impl FnMut(&mut Self, &'s Node<'s>, &Trail<'_>) -> Option<T>,
    ) -> Option<Vec<(String, T)>> {
        let Fields(entries) = self.any_object(node, at)?;
        let mut map: Vec<(String, T)> = Vec::with_capacity(entries.len());
        let again: Vec<usize> = repeated(entries).map(|(second, _)| second.name_range.start).collect();
        for entry in entries.iter().filter(|e| !again.contains(&e.name_range.start)) {
            let value = read(self, &entry.value, &at.key(&entry.name)).unwrap_or_default();
            map.push((entry.name.clone().into_owned(), value));
        }
        Some(map)
    }
}

/// Returns a number with a decimal comma, such as `0,6`, with a decimal point; `None` for other text.
fn decimal(text: &str) -> Option<String> {
    let number = text.trim().replacen(',', ".", 1);
    (number != text.trim() && number.parse::<f64>().is_ok_and(f64::is_finite)).then_some(number)
}

/// Returns the last entry of a list that is full: it says that there are more problems.
pub fn more() -> Mistake {
    Mistake::new(
        Kind::More,
        format!("there are more problems than the {MAX_FINDINGS} in this list"),
        "correct the listed problems first; many may have the same cause",
    )
}

/// Returns the mistake of a word that is none of the `known` words.
pub fn unknown_choice(text: &str, known: &[&str]) -> Mistake {
    let names = choice(known.iter().map(|n| format!("\"{n}\"")));
    let help = match nearest(text, known.iter().copied()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("write {names}"),
    };
    Mistake::new(Kind::UnknownChoice, format!("expected {names}, found \"{}\"", shortened(text)), help)
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
