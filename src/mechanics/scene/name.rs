//! [`Names`]: what goes by which name, and the nearest known name where one is unknown.

use std::collections::{BTreeMap, BTreeSet};

use super::finding::Findings;
use super::format::Map;
use super::path::Trail;
use super::problem;

/// Notes the keys of an object that stand twice. A file's were noted when it was read, and are not there any more.
pub(super) fn once<T>(findings: &mut Findings, at: &Trail<'_>, map: &Map<T>) {
    let mut seen = BTreeSet::new();
    for (name, _) in &map.0 {
        if !seen.insert(name.as_str()) {
            findings.add_key(&at.key(name), problem::entry::key_twice(name));
        }
    }
}

/// Names of one sort with their numbers.
pub(super) struct Names<'f> {
    /// What they name: "block", "robot", "material", "shape".
    sort: &'static str,
    list: Vec<&'f str>,
    numbers: BTreeMap<&'f str, usize>,
    /// Set if some names could not be read; unknown names are then not reported.
    incomplete: bool,
}

impl<'f> Names<'f> {
    /// Names in order; of a name given twice the first counts.
    pub(super) fn new(sort: &'static str, list: Vec<&'f str>, incomplete: bool) -> Names<'f> {
        let mut numbers = BTreeMap::new();
        for (i, name) in list.iter().enumerate() {
            numbers.entry(*name).or_insert(i);
        }
        Names {
            sort,
            list,
            numbers,
            incomplete,
        }
    }

    /// The name with a number.
    pub(super) fn name(&self, number: usize) -> &'f str {
        self.list[number]
    }

    /// The number of a name, if it is known.
    pub(super) fn get(&self, name: &str) -> Option<usize> {
        self.numbers.get(name).copied()
    }

    /// The number of a name that stands as a value; an unknown one is noted.
    pub(super) fn find(
        &self,
        findings: &mut Findings,
        at: &Trail<'_>,
        name: &str,
    ) -> Option<usize> {
        let number = self.get(name);
        if number.is_none() && !self.incomplete {
            let wording = self.unknown(findings, name);
            findings.add(at, wording);
        }
        number
    }

    /// The number of a name that stands as a key; an unknown one is noted.
    pub(super) fn find_key(
        &self,
        findings: &mut Findings,
        at: &Trail<'_>,
        name: &str,
    ) -> Option<usize> {
        let number = self.get(name);
        if number.is_none() && !self.incomplete {
            let wording = self.unknown(findings, name);
            findings.add_key(at, wording);
        }
        number
    }

    fn unknown(&self, findings: &Findings, name: &str) -> problem::Wording {
        if findings.hints() {
            problem::name::unknown_name(self.sort, name, &self.list)
        } else {
            problem::name::another_unknown_name(self.sort, name)
        }
    }
}
