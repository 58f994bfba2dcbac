//! Describes the differences between two lists of facts in words.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Fact, Facts, QUANTITIES, UNITLESS_DECIMALS, power_of_ten};
use crate::mechanics::analysis::{FALLS, STANDS};

/// If more than this number of blocks or interfaces changed in the same way, one line reports all of them.
const MAX_SINGLE_CHANGES: usize = 4;

/// The words for a block that begins to fall, and for one that no longer falls; then the words for several.
const BLOCK_FALLS: [(&str, &str); 2] =
    [(" no longer stands", "blocks no longer stand: "), (" no longer falls", "blocks no longer fall: ")];

/// The importance of a change. The most important changes come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    /// A changed verdict.
    Verdict,
    /// A block begins to fall, or no longer falls.
    Fall,
    /// An object appears or vanishes.
    Presence,
    /// A failure that appears, vanishes or changes, or a changed title.
    Failure,
    /// A changed number.
    Number,
}

/// A difference between two lists of facts.
struct Change<'f> {
    /// True for a frame. Changes of the scene itself come first, because they cause the others.
    is_result: bool,
    rank: Rank,
    /// The change in units of the last decimal.
    by: f64,
    /// The frame, if there are several: `frame 2: `.
    place: String,
    /// The kind of the object, its names, and both in words: `block a`.
    kind: &'f str,
    name: String,
    object: String,
    /// The change: `: μ 0.7 → 0.5`.
    how: String,
}

type Section = [Fact];
type Key<'f> = (&'f str, &'f [String], usize);

pub(super) fn changes(expected: &Facts, found: &Facts) -> Vec<String> {
    let mut comparison = Comparison { expected, found, place: String::new(), is_result: false, changes: Vec::new() };
    // The first section is about the scene, so more than two sections mean several frames.
    let several = expected.sections.len().max(found.sections.len()) > 2;
    for (old, new) in pairs(&expected.sections, &found.sections) {
        match (old, new) {
            (Some(old), Some(new)) => comparison.section(old, new, several),
            (Some(old), None) => comparison.add((Rank::Presence, 0.0), heading(old), " is gone".into()),
            (None, Some(new)) => comparison.add((Rank::Presence, 0.0), heading(new), " is new".into()),
            (None, None) => {}
        }
        comparison.is_result = true;
        comparison.place.clear();
    }
    let mut changes = comparison.changes;
    // The sort is stable: changes of equal importance keep the order of the facts.
    changes.sort_by(|a, b| {
        let key = |c: &Change<'_>| (c.is_result, c.rank);
        key(a).cmp(&key(b)).then(b.by.total_cmp(&a.by))
    });
    in_words(&changes)
}

/// Returns the changes in words. Equal changes of many blocks or interfaces share one line.
fn in_words(changes: &[Change<'_>]) -> Vec<String> {
    let key = |c: &Change<'_>| (c.place.clone(), c.kind.to_owned(), c.how.clone());
    let mut alike: BTreeMap<_, Vec<&str>> = BTreeMap::new();
    for change in changes {
        alike.entry(key(change)).or_default().push(&change.name);
    }
    let mut words = Vec::new();
    for change in changes {
        let (place, kind, how) = (&change.place, change.kind, &change.how);
        let falls = BLOCK_FALLS.iter().find(|(one, _)| one == how);
        let can_group = falls.is_some() || ["block", "interface"].contains(&kind) && how.contains(" → ");
        match alike.get(&key(change)).filter(|names| can_group && names.len() > MAX_SINGLE_CHANGES) {
            None => words.push(format!("{place}{}{how}", change.object)),
            // The first of these changes stands for all of them.
            Some(names) if names[0] != change.name => {}
            Some(names) => words.push(match falls {
                Some((_, several)) => format!("{place}{} {several}{}", names.len(), names.join(", ")),
                None => format!("{place}{} {kind}s{how}", names.len()),
            }),
        }
    }
    words
}

/// Pairs the sections of two lists of facts: by position if the lists have the same length, otherwise by title.
fn pairs<'f>(expected: &'f [Vec<Fact>], found: &'f [Vec<Fact>]) -> Vec<(Option<&'f Section>, Option<&'f Section>)> {
    let is_same = |old: usize, new: usize| {
        let title = |section: &'f [Fact]| (section[0].kind == "scene", &section[0].names);
        expected.len() == found.len() && old == new || title(&expected[old]) == title(&found[new])
    };
    let mut pairs = Vec::new();
    let mut next = 0;
    for (number, old) in expected.iter().enumerate() {
        let same = (next..found.len()).find(|new| is_same(number, *new));
        let end = same.unwrap_or(next);
        pairs.extend(found[next..end].iter().map(|new| (None, Some(new.as_slice()))));
        pairs.push((Some(old.as_slice()), same.map(|new| found[new].as_slice())));
        next = same.map_or(next, |new| new + 1);
    }
    pairs.extend(found[next..].iter().map(|new| (None, Some(new.as_slice()))));
    pairs
}

/// Returns the name of a section: `the scene`, or `frame 2 (The keystone)`.
fn heading(section: &Section) -> String {
    match (section[0].kind.as_str(), title(section)) {
        ("scene", _) => "the scene".into(),
        (kind, "") => kind.to_owned(),
        (kind, title) => format!("{kind} ({title})"),
    }
}

fn title(section: &Section) -> &str {
    section[0].names.first().map_or("", String::as_str)
}

/// Returns the facts with their keys: kind, names, and a counter for facts with the same kind and names.
fn keyed(facts: &[Fact]) -> Vec<(Key<'_>, &Fact)> {
    let mut counts: BTreeMap<(&str, &[String]), usize> = BTreeMap::new();
    let keyed = facts.iter().map(|fact| {
        let count = counts.entry((&fact.kind, &fact.names)).or_default();
        *count += 1;
        ((fact.kind.as_str(), fact.names.as_slice(), *count), fact)
    });
    keyed.collect()
}

struct Comparison<'f> {
    expected: &'f Facts,
    found: &'f Facts,
    place: String,
    is_result: bool,
    changes: Vec<Change<'f>>,
}

impl<'f> Comparison<'f> {
    fn add(&mut self, weight: (Rank, f64), object: String, how: String) {
        self.add_object(weight, ("", String::new(), object), how);
    }

    fn add_object(&mut self, (rank, by): (Rank, f64), object: (&'f str, String, String), how: String) {
        let (kind, name, object) = object;
        let (place, is_result) = (self.place.clone(), self.is_result);
        self.changes.push(Change { is_result, rank, by, place, kind, name, object, how });
    }

    /// Compares two paired sections.
    fn section(&mut self, old: &'f Section, new: &'f Section, several: bool) {
        // 1. The heading: the title, and the values of the scene or the verdict of the frame.
        if title(old) != title(new) {
            let how = format!(": the title was \"{}\", and is now \"{}\"", title(old), title(new));
            self.add((Rank::Failure, 0.0), heading(new), how);
        }
        if let Some((words, by)) = self.values(&old[0], &new[0]) {
            let rank = if self.is_result { Rank::Verdict } else { Rank::Number };
            self.add((rank, by), heading(new), format!(": {words}"));
        }
        if several && self.is_result {
            self.place = format!("{}: ", new[0].kind);
        }
        // 2. The facts, in the order of the new facts; facts that no longer exist come last.
        let (was, is) = (keyed(&old[1..]), keyed(&new[1..]));
        let (before, now) = (BTreeMap::from_iter(was.clone()), BTreeMap::from_iter(is.clone()));
        for (key, fact) in is {
            let Some(old) = before.get(&key) else {
                self.presence(key, fact, true);
                continue;
            };
            if let Some((words, by)) = self.values(old, fact) {
                let rank = if key.0.starts_with("failure") { Rank::Failure } else { Rank::Number };
                self.add_object((rank, by), called(key), format!(": {words}"));
            }
        }
        for (key, fact) in was.into_iter().filter(|(key, _)| !now.contains_key(key)) {
            self.presence(key, fact, false);
        }
    }

    /// Reports a fact that is new or gone.
    fn presence(&mut self, key: Key<'f>, fact: &Fact, is_new: bool) {
        if key.0 == "falls" {
            let how = BLOCK_FALLS[usize::from(!is_new)].0;
            return self.add_object((Rank::Fall, 0.0), called(key), how.into());
        }
        let rank = if key.0.starts_with("failure") { Rank::Failure } else { Rank::Presence };
        let first = QUANTITIES.iter().find_map(|(key, name, unit)| Some(described(name, fact.values.get(*key)?, unit)));
        let is = if is_new { "is new" } else { "is gone" };
        self.add_object((rank, 0.0), called(key), format!(" {is}: {}", first.unwrap_or_default()));
    }

    /// Describes all values that differ between two facts about the same object. Also returns the largest change in
    /// units of the last decimal. Returns `None` if no value changed.
    fn values(&self, old: &Fact, new: &Fact) -> Option<(String, f64)> {
        let mut words = Vec::new();
        let mut most: f64 = 0.0;
        for (key, name, unit) in QUANTITIES {
            match (old.values.get(key), new.values.get(key)) {
                (Some(was), Some(is)) => {
                    if let Some(by) = self.difference(unit, was, is) {
                        most = most.max(by);
                        words.push(format!("{} → {}", described(name, was, ""), described("", is, unit)));
                    }
                }
                (Some(was), None) => words.push(format!("{} is gone", described(name, was, unit))),
                (None, Some(is)) => words.push(format!("{} is new", described(name, is, unit))),
                (None, None) => {}
            }
        }
        (!words.is_empty()).then(|| (words.join(", "), most))
    }

    /// Returns the largest difference between two values, in units of their last decimal. Returns `None` if rounding can
    /// explain the difference, and 1e6 if the values are different words, or different counts of numbers.
    fn difference(&self, unit: &str, old: &Value, new: &Value) -> Option<f64> {
        let by = match (old, new) {
            (Value::Array(old), Value::Array(new)) if old.len() == new.len() => {
                let pairs = old.iter().zip(new).filter_map(|(old, new)| self.difference(unit, old, new));
                pairs.fold(0.0, f64::max)
            }
            (Value::Number(old), Value::Number(new)) => {
                let decimals = [self.expected, self.found].map(|facts| facts.decimals.get(unit).copied());
                let least = decimals.into_iter().flatten().filter(|_| !unit.is_empty()).min();
                let far = old.as_f64().zip(new.as_f64()).map_or(f64::INFINITY, |(old, new)| (old - new).abs());
                far / power_of_ten(-least.unwrap_or(UNITLESS_DECIMALS))
            }
            _ if old == new => 0.0,
            _ => 1e6,
        };
        // A rounding error of the solver may change the last digit by 1 unit. A change by 2 units is reported, so the
        // limit is 1.5.
        (by > 1.5).then_some(by)
    }
}

/// Returns the kind, the names and both in words: `interface`, `a–ground` and `interface a–ground`.
fn called((kind, names, number): Key<'_>) -> (&str, String, String) {
    let is_on = ["friction", "robot", "failure robot"].contains(&kind);
    let name = names.join(if is_on { " on " } else { "–" });
    let words = match kind {
        "sums" => "all together",
        "load" => "load on ",
        "limits" => "limits of robot ",
        "friction" => "friction of ",
        "failure robot" => "missing from robot ",
        "failure tension" => "tension at ",
        "failure friction" => "sliding at ",
        "falls" => "block ",
        kind => &format!("{kind} "),
    };
    let number = if number > 1 { format!(" (no. {number})") } else { String::new() };
    let object = format!("{words}{name}{number}");
    (kind, name, object)
}

/// Describes a value: `N 4.2 N`.
fn described(name: &str, value: &Value, unit: &str) -> String {
    let value = numbers(value);
    let words: Vec<&str> = [name, &value, unit].into_iter().filter(|word| !word.is_empty()).collect();
    words.join(" ")
}

/// Returns the numbers or the word of a value, with minus signs in place of hyphens.
fn numbers(value: &Value) -> String {
    match value {
        Value::Array(list) => list.iter().map(numbers).collect::<Vec<_>>().join(", "),
        Value::Number(number) => number.as_f64().unwrap_or_default().to_string().replace('-', "−"),
        Value::String(word) => match word.as_str() {
            "stable" => STANDS.into(),
            "unstable" => FALLS.into(),
            other => other.into(),
        },
        _ => "none".into(),
    }
}
