//! [`Source`]: a text with the position of every value. The line and the column of each problem are computed from it.

use std::ops::Range;

use super::mistake::{Mistake, Problem};
use super::path::{Path, Segment};
use super::tree::{Entry, NodeKind, Tree};

/// The notation of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Notation {
    /// JSON.
    Json,
    /// TOML.
    #[cfg(feature = "toml")]
    Toml,
}

/// A text and its values.
#[derive(Debug)]
pub struct Source<'t> {
    /// The text, to which all ranges of bytes refer.
    pub text: &'t str,
    /// The values; `None` if the text could not be parsed.
    pub tree: Option<Tree<'t>>,
    /// The index of the first byte of each line.
    lines: Vec<usize>,
}

/// The part of an entry to which a problem refers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Its value.
    Value,
    /// Its key.
    Key,
}

impl<'t> Source<'t> {
    /// Stores a text with its values.
    pub fn new(text: &'t str, tree: Tree<'t>) -> Source<'t> {
        Source { tree: Some(tree), ..Source::plain(text) }
    }

    /// Stores a text without parsing it, for messages about text that cannot be parsed.
    pub fn plain(text: &'t str) -> Source<'t> {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(i, _)| i + 1)).collect();
        Source { text, tree: None, lines }
    }

    /// Returns the line and the column in which the byte with this index lies. Both are counted from 1, the column in
    /// characters.
    pub fn place(&self, byte: usize) -> (usize, usize) {
        let line = self.line(byte);
        let start = self.lines[line - 1];
        let before = self.text.get(start..byte).unwrap_or("");
        (line, before.chars().count() + 1)
    }

    /// Returns the line in which the byte with this index lies, counted from 1.
    pub fn line(&self, byte: usize) -> usize {
        self.lines.partition_point(|start| *start <= byte).max(1)
    }

    /// Creates the problem that a mistake at the byte with this index makes. Control characters in the message, which
    /// may come from the text, are replaced.
    pub fn problem(&self, byte: usize, path: &str, mistake: Mistake) -> Problem {
        let (line, column) = self.place(byte);
        let [path, message, help] = [path, &mistake.message, &mistake.help].map(crate::text::line);
        Problem { path, line, column, message, help }
    }

    /// Returns the index of the first byte of each entry in the top-level list with the key `list`.
    pub fn starts(&self, list: &str) -> impl Iterator<Item = usize> + '_ {
        let items = self.tree.as_ref().and_then(|tree| {
            let NodeKind::Object(top) = &tree.root.kind else {
                return None;
            };
            let entry = tree.entries(top).iter().find(|e| e.name == list)?;
            match &entry.value.kind {
                NodeKind::List(list) => Some(tree.items(list)),
                _ => None,
            }
        });
        items.unwrap_or_default().iter().map(|n| n.range.start)
    }

    /// Returns the range of bytes of the value or key at this path. For a value with several lines, returns only the
    /// range of its first line. If the text does not contain the whole path, returns the range of the deepest value on
    /// the path that the text contains. `None` if the text could not be parsed.
    pub fn find(&self, path: &Path, mark: Mark) -> Option<Range<usize>> {
        let tree = self.tree.as_ref()?;
        let mut node = &tree.root;
        for (i, segment) in path.0.iter().enumerate() {
            let next = match (segment, &node.kind) {
                (Segment::Index(number), NodeKind::List(list)) => tree.items(list).get(*number),
                (Segment::Key(key), NodeKind::Object(object)) => {
                    let entries = tree.entries(object);
                    // If the key itself is to be marked and it occurs more than once, mark its last occurrence.
                    let wanted = |e: &&Entry<'_>| e.name == *key;
                    let last = mark == Mark::Key && i + 1 == path.0.len();
                    let entry = if last { entries.iter().rev().find(wanted) } else { entries.iter().find(wanted) };
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

    /// Returns the part of a range of bytes that lies on its first line, so that a message marks at most one line of
    /// the text.
    fn first_line(&self, range: Range<usize>) -> Range<usize> {
        let text = self.text.get(range.clone()).unwrap_or("");
        let line = text.split('\n').next().unwrap_or("").trim_end();
        range.start..range.start + line.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::path::Trail;
    use crate::read::tree::parse;

    #[test]
    fn values_and_keys_are_found_at_their_place_in_the_text() {
        let text = "{\n  \"é\": [1, {\"b\": 22}],\n  \"a\": 1, \"a\": 2\n}";
        let source = Source::new(text, parse(text).expect("JSON"));
        let top = Trail::Top;
        let e = top.key("é");
        let one = e.index(1);
        let range = source.find(&one.key("b").path(), Mark::Value).expect("a range of bytes");
        assert_eq!(&text[range.clone()], "22");
        assert_eq!(source.place(range.start), (2, 18));
        let twice = source.find(&top.key("a").path(), Mark::Key).expect("a range of bytes");
        assert_eq!(source.place(twice.start), (3, 11));
        let missing = source.find(&one.key("c").path(), Mark::Value).expect("a range of bytes");
        assert_eq!(&text[missing], "{\"b\": 22}");
        assert_eq!(source.find(&top.path(), Mark::Value), Some(0..1));
    }
}
