//! [`Names`]: finds the index that belongs to a name, and suggests the most similar name for an unknown one.

use std::collections::{BTreeMap, BTreeSet};

use super::finding::Findings;
use super::format::Map;
use super::problem;
use crate::read::Trail;

/// Reports each key that occurs twice in a map that was built in code. For a file, such keys were reported while
/// reading.
pub(super) fn once<T>(findings: &mut Findings, at: &Trail<'_>, map: &Map<T>) {
    let mut seen = BTreeSet::new();
    for (name, _) in &map.0 {
        if !seen.insert(name.as_str()) {
            findings.add_key(&at.key(name), problem::message::key_twice(name));
        }
    }
}

/// The names of all objects of one kind, with their indices.
pub(super) struct Names<'f> {
    /// The kind of the objects: "block", "robot", "material" or "shape".
    sort: &'static str,
    list: Vec<&'f str>,
    numbers: BTreeMap<&'f str, usize>,
    /// Set if some names could not be read; unknown names are then not reported.
    incomplete: bool,
}

impl<'f> Names<'f> {
    /// Creates a table of the names in `list` and their indices. A name that occurs twice has the index of its first
    /// occurrence. `sort` is the kind of the objects, such as "block". If `incomplete` is set, unknown names are not
    /// reported.
    pub(super) fn new(sort: &'static str, list: Vec<&'f str>, incomplete: bool) -> Names<'f> {
        let mut numbers = BTreeMap::new();
        for (i, name) in list.iter().enumerate() {
            numbers.entry(*name).or_insert(i);
        }
        Names { sort, list, numbers, incomplete }
    }

    /// Returns the name with the index `number`.
    pub(super) fn name(&self, number: usize) -> &'f str {
        self.list[number]
    }

    /// Returns the index of a name; `None` if the name is unknown.
    pub(super) fn get(&self, name: &str) -> Option<usize> {
        self.numbers.get(name).copied()
    }

    /// Returns the index of a name that is the value at the path `at`. If the name is unknown, returns `None`, and
    /// reports it unless some names could not be read.
    pub(super) fn find(&self, findings: &mut Findings, at: &Trail<'_>, name: &str) -> Option<usize> {
        self.find_or(findings, name, |findings, wording| findings.add(at, wording))
    }

    /// Returns the index of a name that is the key at the path `at`. If the name is unknown, returns `None`, and
    /// reports it unless some names could not be read.
    pub(super) fn find_key(&self, findings: &mut Findings, at: &Trail<'_>, name: &str) -> Option<usize> {
        self.find_or(findings, name, |findings, wording| findings.add_key(at, wording))
    }

    fn find_or(
        &self,
        findings: &mut Findings,
        name: &str,
        report: impl FnOnce(&mut Findings, problem::Wording),
    ) -> Option<usize> {
        let number = self.get(name);
        if number.is_none() && !self.incomplete {
            let wording = self.unknown(findings, name);
            report(findings, wording);
        }
        number
    }

    fn unknown(&self, findings: &mut Findings, name: &str) -> problem::Wording {
        if findings.may_suggest(self.sort) {
            problem::message::unknown_name(self.sort, name, &self.list)
        } else {
            problem::message::another_unknown_name(self.sort, name)
        }
    }
}
