//! [`Findings`]: the problems found so far, and the parts of the file that could not be read.
//!
//! A block whose polygon could not be read is not also reported to have no polygon, or to overlap its neighbour.

use super::path::{Path, Segment, Trail};
use super::problem::{self, Wording};
use super::source::Mark;

/// So many findings of a file are kept; a file with more has one cause, and it is among the first.
const MOST: usize = 2000;
/// For at most this many unknown names the nearest known name is suggested, which compares with all names.
const HINTED: usize = 50;

/// One thing that is wrong, and where.
pub(super) struct Finding {
    /// Where.
    pub(super) path: Path,
    /// Whether it is the key or the value there.
    pub(super) mark: Mark,
    /// What to say.
    pub(super) wording: Wording,
}

/// All that was found wrong.
#[derive(Default)]
pub(super) struct Findings {
    /// In the order of finding.
    pub(super) list: Vec<Finding>,
    /// Parts of the file that could not be read.
    pub(super) doubt: UnreadParts,
}

impl Findings {
    /// Findings of a file some parts of which could not be read.
    pub(super) fn doubting(doubt: UnreadParts) -> Findings {
        Findings {
            list: Vec::new(),
            doubt,
        }
    }

    /// Whether the entry that something stands in could not all be read.
    pub(super) fn doubts(&self, at: &Trail<'_>) -> bool {
        // A file without doubts is the one that has to be quick.
        !self.doubt.paths.is_empty() && self.doubt.touches(&at.path())
    }

    /// Whether no more findings are kept.
    pub(super) fn is_full(&self) -> bool {
        self.list.len() > MOST
    }

    /// Whether a further finding is still to say what may have been meant.
    pub(super) fn hints(&self) -> bool {
        self.list.len() < HINTED
    }

    /// Notes what is wrong at a value, unless it stands in a part in doubt.
    pub(super) fn add(&mut self, at: &Trail<'_>, wording: Wording) {
        self.note(at, Mark::Value, wording);
    }

    /// Notes what is wrong at a key.
    pub(super) fn add_key(&mut self, at: &Trail<'_>, wording: Wording) {
        self.note(at, Mark::Key, wording);
    }

    fn note(&mut self, at: &Trail<'_>, mark: Mark, wording: Wording) {
        if self.is_full() {
            return;
        }
        let path = at.path();
        if !self.doubt.touches(&path) {
            self.keep(Finding {
                path,
                mark,
                wording,
            });
        }
    }

    /// Takes a finding; the first one too many becomes the notice that there are more.
    pub(super) fn keep(&mut self, finding: Finding) {
        match self.list.len() {
            n if n < MOST => self.list.push(finding),
            MOST => self.list.push(Finding {
                path: Path::default(),
                mark: Mark::Value,
                wording: problem::text::more_problems(MOST),
            }),
            _ => {}
        }
    }
}

/// Parts of a file that could not be read.
#[derive(Default)]
pub(super) struct UnreadParts {
    /// Where reading failed.
    pub(super) paths: Vec<Path>,
}

impl UnreadParts {
    /// Whether the entry (of `blocks`, `materials`, …) that a path lies in, or the path itself, could not all be read.
    pub(super) fn touches(&self, path: &Path) -> bool {
        let entry = &path.0[..path.0.len().min(2)];
        self.paths
            .iter()
            .any(|p| p.starts_with(entry) || path.starts_with(&p.0))
    }

    /// Whether anything at all could not be read at or below a key of the file.
    pub(super) fn touches_key(&self, key: &str) -> bool {
        let key = [Segment::Key(key.to_string())];
        self.paths
            .iter()
            .any(|p| p.starts_with(&key) || p.0.is_empty())
    }

    /// The first entry of a list that could not all be read; 0 where the list itself could not.
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

    /// Set if a list or map of names could not be read completely; unknown names are then not reported.
    ///
    /// `known` is how many there are. A misspelt top-level key may have been meant to hold them all.
    pub(super) fn hides_names(&self, list: &str, known: usize) -> bool {
        self.paths.iter().any(|path| match path.0.as_slice() {
            [] => true,
            [Segment::Key(key)] => key == list || (known == 0 && !TOP.contains(&key.as_str())),
            [Segment::Key(key), Segment::Index(_)] => key == list,
            [Segment::Key(key), Segment::Index(_), Segment::Key(inner)] => {
                key == list && !ENTRY.contains(&inner.as_str())
            }
            _ => false,
        })
    }
}

/// Keys of a scene file under which names are given.
const TOP: [&str; 4] = ["materials", "shapes", "blocks", "robots"];

/// Keys of blocks and robots that certainly are not a misspelt `id`.
const ENTRY: [&str; 15] = [
    "polygon",
    "holes",
    "cells",
    "shape",
    "at",
    "angle",
    "material",
    "weight",
    "mass",
    "density",
    "friction",
    "fill",
    "holds",
    "limits",
    "thickness",
];
