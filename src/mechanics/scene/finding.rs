//! [`Findings`]: the problems found so far while a scene file is checked, and the parts of the file that could not be
//! read.
//!
//! Problems in an entry that could not be read are not added. For example, a block with an unreadable polygon is not
//! also reported to have no outline.

use std::collections::BTreeMap;

use super::format::{BlockEntry, MaterialEntry, RobotEntry, UnitsEntry};
use super::problem::{Problem, SceneError, Wording};
use crate::read::reader::{MAX_FINDINGS, more};
use crate::read::{Mark, Source};
use crate::read::{Path, Segment, Trail};

/// Only this number of unknown names, the first ones, may suggest a similar name. Each suggestion needs a comparison
/// with all names.
const MAX_SUGGESTIONS: usize = 50;

/// A problem and its place in the file.
pub(super) struct Finding {
    /// The path of the value.
    pub(super) path: Path,
    /// Whether the key or the value at this path is wrong.
    pub(super) mark: Mark,
    /// The code, the message and the remedy.
    pub(super) wording: Wording,
}

/// All problems found so far.
#[derive(Default)]
pub(super) struct Findings {
    /// The problems, in the order in which they were found.
    pub(super) list: Vec<Finding>,
    /// Parts of the file that could not be read.
    pub(super) unread: UnreadParts,
    /// The units of the file, for messages.
    pub(super) units: UnitsEntry,
    /// The number of unknown names that were looked up for a suggestion, by the kind of the named objects.
    suggestions: BTreeMap<&'static str, usize>,
}

impl Findings {
    /// Creates an empty list of problems. `unread` contains the parts of the file that could not be read.
    pub(super) fn with_unread(unread: UnreadParts) -> Findings {
        Findings { unread, ..Findings::default() }
    }

    /// True if some part of the entry to which the path `at` belongs could not be read. An entry is an element of
    /// `blocks`, `materials` and so on.
    pub(super) fn is_unread(&self, at: &Trail<'_>) -> bool {
        // Test the common case first: the whole file could be read.
        !self.unread.paths.is_empty() && self.unread.touches(&at.path())
    }

    /// True if the list of problems is full. Further problems are then not added.
    pub(super) fn is_full(&self) -> bool {
        self.list.len() > MAX_FINDINGS
    }

    /// True if the message about the next unknown name of a `sort` of objects may suggest a similar name. Each
    /// suggestion takes a search through all names.
    pub(super) fn may_suggest(&mut self, sort: &'static str) -> bool {
        let used = self.suggestions.entry(sort).or_default();
        *used += 1;
        *used <= MAX_SUGGESTIONS
    }

    /// Reports a problem of the value at the path `at`, unless some part of the entry that contains this path could not
    /// be read. An entry is an element of `blocks`, `materials` and so on.
    pub(super) fn add(&mut self, at: &Trail<'_>, wording: Wording) {
        self.note(at, Mark::Value, wording);
    }

    /// Reports a problem of the key at the path `at`, unless some part of the entry that contains this path could not
    /// be read. An entry is an element of `blocks`, `materials` and so on.
    pub(super) fn add_key(&mut self, at: &Trail<'_>, wording: Wording) {
        self.note(at, Mark::Key, wording);
    }

    fn note(&mut self, at: &Trail<'_>, mark: Mark, wording: Wording) {
        if self.is_full() {
            return;
        }
        let path = at.path();
        if !self.unread.touches(&path) {
            self.keep(Finding { path, mark, wording });
        }
    }

    /// Adds a problem. If the list is full, adds one last entry instead, which says that there are more problems. All
    /// later problems are dropped.
    pub(super) fn keep(&mut self, finding: Finding) {
        match self.list.len() {
            n if n < MAX_FINDINGS => self.list.push(finding),
            MAX_FINDINGS => {
                self.list.push(Finding { path: Path::default(), mark: Mark::Value, wording: more().into() })
            }
            _ => {}
        }
    }
}

/// Converts findings to problems with line and column, sorted by their position in the text `source`. If `source` is
/// `None`, the problems have no line and column and keep their order.
pub(super) fn located(findings: Vec<Finding>, source: Option<&Source<'_>>) -> SceneError {
    let mut list: Vec<Problem> = findings
        .into_iter()
        .map(|finding| {
            let span = source.and_then(|s| s.find(&finding.path, finding.mark));
            Problem::new(finding.path.to_string(), span, source, finding.wording)
        })
        .collect();
    list.sort_by_key(|p| p.span.as_ref().map(|s| s.start));
    SceneError { text: source.map(|s| s.text.to_string()), list }
}

/// Parts of a file that could not be read.
#[derive(Default)]
pub(super) struct UnreadParts {
    /// The paths of the values and keys that could not be read.
    pub(super) paths: Vec<Path>,
}

impl UnreadParts {
    /// True if some part of the entry that contains `path` could not be read. An entry is an element of `blocks`,
    /// `materials` and so on.
    pub(super) fn touches(&self, path: &Path) -> bool {
        let entry = &path.0[..path.0.len().min(2)];
        self.paths.iter().any(|p| p.starts_with(entry) || path.starts_with(&p.0))
    }

    /// True if the value of the top-level key `key`, or some part of this value, could not be read.
    pub(super) fn touches_key(&self, key: &str) -> bool {
        let key = [Segment::Key(key.to_string())];
        self.paths.iter().any(|p| p.starts_with(&key) || p.0.is_empty())
    }

    /// Returns the index of the first entry of the list `list` that could not be read completely; 0 if the list itself
    /// could not be read. `None` if all entries were read.
    pub(super) fn first_entry(&self, list: &str) -> Option<usize> {
        let mut first = None;
        for path in &self.paths {
            let number = match path.0.as_slice() {
                [] => 0,
                [Segment::Key(key)] if key == list => 0,
                [Segment::Key(key), Segment::Index(number), ..] if key == list => *number,
                _ => continue,
            };
            first = Some(first.map_or(number, |f: usize| f.min(number)));
        }
        first
    }

    /// True if some names of the objects under the top-level key `list` may be missing, because part of the file could
    /// not be read. Unknown names are then not reported.
    ///
    /// `known` is the number of names that were read. If it is 0, an unknown top-level key may be the misspelt key of
    /// this list.
    pub(super) fn hides_names(&self, list: &str, known: usize) -> bool {
        self.paths.iter().any(|path| match path.0.as_slice() {
            [] => true,
            [Segment::Key(key)] => key == list || (known == 0 && !NAMED_LISTS.contains(&key.as_str())),
            [Segment::Key(key), Segment::Index(_)] => key == list,
            [Segment::Key(key), Segment::Index(_), Segment::Key(inner)] => key == list && !is_not_a_name(inner),
            _ => false,
        })
    }
}

/// The top-level keys of a scene file under which objects with names or ids are listed.
const NAMED_LISTS: [&str; 4] = ["materials", "shapes", "blocks", "robots"];

/// True for an inner key that is not a misspelt `id`. If the value of such a key cannot be read, the names of the list
/// are still known.
fn is_not_a_name(key: &str) -> bool {
    let known = [BlockEntry::KEYS, RobotEntry::KEYS, MaterialEntry::KEYS].concat();
    key != "id" && (known.contains(&key) || key == "thickness")
}
