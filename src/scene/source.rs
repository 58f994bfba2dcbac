//! [`Source`]: the text of a scene file with every value's place in it.
//!
//! Made only once something is wrong: a sound file is read without it. The only file that names jsonc-parser.

use std::ops::Range;

use jsonc_parser::ast::Value;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use super::path::{Path, Segment};

/// A text and its JSON values.
pub(super) struct Source<'t> {
    /// The text, from which all byte ranges count.
    pub(super) text: &'t str,
    /// The topmost value; absent where the text is no JSON.
    pub(super) root: Option<Node>,
    /// First byte of every line.
    lines: Vec<usize>,
}

/// A JSON value with its place.
pub(super) struct Node {
    /// Its bytes in the text.
    pub(super) range: Range<usize>,
    /// What it is.
    pub(super) kind: NodeKind,
}

/// What a JSON value is.
pub(super) enum NodeKind {
    /// `null`
    Null,
    /// `true` or `false`
    Flag,
    /// A number, as written.
    Number(String),
    /// A string, its escapes resolved.
    Text(String),
    /// A list.
    List(Vec<Node>),
    /// An object's entries in their order, keys perhaps twice.
    Object(Vec<Entry>),
}

/// A key and its value.
pub(super) struct Entry {
    /// The key, its escapes resolved.
    pub(super) name: String,
    /// The key's bytes in the text, quotes included.
    pub(super) name_range: Range<usize>,
    /// The value.
    pub(super) value: Node,
}

/// Which part of an entry a problem points at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// Its value.
    Value,
    /// Its key.
    Key,
}

impl<'t> Source<'t> {
    /// A text known to be JSON of bounded nesting, with its values' places.
    pub(super) fn parse(text: &'t str) -> Source<'t> {
        let strict = ParseOptions {
            allow_comments: false,
            allow_loose_object_property_names: false,
            allow_trailing_commas: false,
            allow_missing_commas: false,
            allow_single_quoted_strings: false,
            allow_hexadecimal_numbers: false,
            allow_unary_plus_numbers: false,
            allow_bare_decimal_point_numbers: false,
            allow_non_finite_numbers: false,
            allow_extended_string_escapes: false,
        };
        let parsed = parse_to_ast(text, &CollectOptions::default(), &strict);
        let root = parsed.ok().and_then(|p| p.value).map(node);
        Source {
            root,
            ..Source::plain(text)
        }
    }

    /// Any text, without values.
    pub(super) fn plain(text: &'t str) -> Source<'t> {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(i, _)| i + 1)).collect();
        Source {
            text,
            root: None,
            lines,
        }
    }

    /// Line and column of a byte, both from 1, the column in characters.
    pub(super) fn place(&self, byte: usize) -> (usize, usize) {
        let line = self.lines.partition_point(|start| *start <= byte).max(1);
        let start = self.lines[line - 1];
        let before = self.text.get(start..byte).unwrap_or("");
        (line, before.chars().count() + 1)
    }

    /// The byte at a line (from 1) and a column in bytes (from 1; 0 and columns beyond the line are moved onto it).
    pub(super) fn byte(&self, line: usize, column: usize) -> usize {
        let line = line.clamp(1, self.lines.len());
        let end = self
            .lines
            .get(line)
            .map_or(self.text.len(), |next| next - 1);
        let mut byte = (self.lines[line - 1] + column.saturating_sub(1)).min(end);
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        byte
    }

    /// Where a path leads, or as far along it as the text goes; the first line of it.
    pub(super) fn find(&self, path: &Path, mark: Mark) -> Option<Range<usize>> {
        let mut node = self.root.as_ref()?;
        for (i, segment) in path.0.iter().enumerate() {
            let next = match (segment, &node.kind) {
                (Segment::Index(number), NodeKind::List(entries)) => entries.get(*number),
                (Segment::Key(key), NodeKind::Object(entries)) => {
                    // Of a key given twice the second is the one to point at.
                    let wanted = |e: &&Entry| e.name == *key;
                    let last = mark == Mark::Key && i + 1 == path.0.len();
                    let entry = if last {
                        entries.iter().rev().find(wanted)
                    } else {
                        entries.iter().find(wanted)
                    };
                    match entry {
                        Some(entry) if last => return Some(entry.name_range.clone()),
                        other => other.map(|e| &e.value),
                    }
                }
                _ => None,
            };
            match next {
                Some(next) => node = next,
                None => break,
            }
        }
        Some(self.first_line(node.range.clone()))
    }

    /// What of a range stands on its first line: a whole block over twenty lines would drown what is said about it.
    fn first_line(&self, range: Range<usize>) -> Range<usize> {
        let text = self.text.get(range.clone()).unwrap_or("");
        let line = text.split('\n').next().unwrap_or("").trim_end();
        range.start..range.start + line.len()
    }
}

fn node(value: Value<'_>) -> Node {
    let range = |r: jsonc_parser::common::Range| r.start..r.end;
    match value {
        Value::NullKeyword(v) => Node {
            range: range(v.range),
            kind: NodeKind::Null,
        },
        Value::BooleanLit(v) => Node {
            range: range(v.range),
            kind: NodeKind::Flag,
        },
        Value::NumberLit(v) => Node {
            range: range(v.range),
            kind: NodeKind::Number(v.value.to_string()),
        },
        Value::StringLit(v) => Node {
            range: range(v.range),
            kind: NodeKind::Text(v.value.into_owned()),
        },
        Value::Array(v) => Node {
            range: range(v.range),
            kind: NodeKind::List(v.elements.into_iter().map(node).collect()),
        },
        Value::Object(v) => Node {
            range: range(v.range),
            kind: NodeKind::Object(
                v.properties
                    .into_iter()
                    .map(|p| {
                        use jsonc_parser::common::Ranged;
                        Entry {
                            name_range: range(p.name.range()),
                            name: p.name.into_string(),
                            value: node(p.value),
                        }
                    })
                    .collect(),
            ),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::path::Trail;

    #[test]
    fn values_are_found_where_they_stand() {
        let text = "{\n  \"é\": [1, {\"b\": 22}],\n  \"a\": 1, \"a\": 2\n}";
        let source = Source::parse(text);
        let top = Trail::Top;
        let e = top.key("é");
        let one = e.index(1);
        let range = source
            .find(&one.key("b").path(), Mark::Value)
            .expect("found");
        assert_eq!(&text[range.clone()], "22");
        assert_eq!(source.place(range.start), (2, 18));
        let twice = source.find(&top.key("a").path(), Mark::Key).expect("found");
        assert_eq!(source.place(twice.start), (3, 11));
        let missing = source
            .find(&one.key("c").path(), Mark::Value)
            .expect("found");
        assert_eq!(&text[missing], "{\"b\": 22}");
        assert_eq!(source.find(&top.path(), Mark::Value), Some(0..1));
    }
}
