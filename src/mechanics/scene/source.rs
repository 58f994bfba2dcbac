//! [`Source`]: the text of a scene file, with the position of every value in the text. The line and the column of each
//! problem are computed from it.

use std::ops::Range;

use super::path::{Path, Segment};
use super::tree::{Entry, NodeKind, SyntaxError, Tree, parse};

/// A text and its JSON values.
pub(super) struct Source<'t> {
    /// The text, to which all ranges of bytes refer.
    pub(super) text: &'t str,
    /// The values; `None` if the text is not JSON.
    pub(super) tree: Option<Tree<'t>>,
    /// The index of the first byte of each line.
    lines: Vec<usize>,
}

/// The part of an entry to which a problem refers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// Its value.
    Value,
    /// Its key.
    Key,
}

impl<'t> Source<'t> {
    /// Parses a JSON text. The error contains the index of the byte at which the text stops being valid JSON.
    pub(super) fn parse(text: &'t str) -> Result<Source<'t>, SyntaxError> {
        let tree = Some(parse(text)?);
        Ok(Source { tree, ..Source::plain(text) })
    }

    /// Stores a text without parsing it, for messages about text that is not JSON.
    pub(super) fn plain(text: &'t str) -> Source<'t> {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(i, _)| i + 1)).collect();
        Source { text, tree: None, lines }
    }

    /// Returns the line and the column in which the byte with this index lies. Both are counted from 1, the column in
    /// characters.
    pub(super) fn place(&self, byte: usize) -> (usize, usize) {
        let line = self.line(byte);
        let start = self.lines[line - 1];
        let before = self.text.get(start..byte).unwrap_or("");
        (line, before.chars().count() + 1)
    }

    /// Returns the line in which the byte with this index lies, counted from 1.
    pub(super) fn line(&self, byte: usize) -> usize {
        self.lines.partition_point(|start| *start <= byte).max(1)
    }

    /// Returns the index of the first byte of each entry in the top-level list with the key `list`.
    pub(super) fn starts(&self, list: &str) -> impl Iterator<Item = usize> + '_ {
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
    /// the path that the text contains. `None` if the text is not JSON.
    pub(super) fn find(&self, path: &Path, mark: Mark) -> Option<Range<usize>> {
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
    use crate::mechanics::scene::path::Trail;

    #[test]
    fn values_and_keys_are_found_at_their_place_in_the_text() {
        let text = "{\n  \"é\": [1, {\"b\": 22}],\n  \"a\": 1, \"a\": 2\n}";
        let source = Source::parse(text).expect("JSON");
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
