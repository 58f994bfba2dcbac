//! Describes the differences between two lists of facts.

use std::collections::BTreeMap;

use super::change::{Change, MAX_SINGLE_CHANGES, group_equal};
use super::round::{UNITLESS_STEP, last_digit, short};
use super::{Fact, Facts, Section, Value};

/// The kind of a fact which states that a block falls.
const FALLING_FACT: &str = "falling";
/// Added to the weight of a change of the scene: a block, a load, friction, a robot's limits, gravity, the kernel, the
/// title.
const CAUSE_WEIGHT: f64 = 5e9;
/// Weight of a changed verdict. Changes of numbers usually have weights of at most 1e6, far below the weights here.
const VERDICT_WEIGHT: f64 = 4e9;
/// Weight of a block that begins to fall, or no longer falls.
const FALL_WEIGHT: f64 = 3e9;
/// Weight of an object, other than a failure, that appears or vanishes.
const PRESENCE_WEIGHT: f64 = 2e9;
/// Weight of a failure that appears or vanishes, and of a changed title. Added to the weight of a failure that changes.
const FAILURE_WEIGHT: f64 = 1e9;

pub(super) fn changes(expected: &Facts, found: &Facts) -> Vec<Change> {
    let found = &found.in_version(expected.version);
    let mut changes = Vec::new();
    // The first section is about the scene, so more than two sections mean several frames.
    let several = expected.sections.len().max(found.sections.len()) > 2;
    for (old, new) in pairs(&expected.sections, &found.sections) {
        match (old, new) {
            (Some(old), Some(new)) => section(old, new, several, &mut changes),
            (Some(old), None) => {
                changes.push(Change { words: format!("{} is gone", heading(old)), weight: PRESENCE_WEIGHT })
            }
            (None, Some(new)) => {
                changes.push(Change { words: format!("{} is new", heading(new)), weight: PRESENCE_WEIGHT })
            }
            (None, None) => {}
        }
    }
    // The sort is stable: changes of equal weight keep the order of the facts.
    changes.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    changes
}

type Pair<'f> = (Option<&'f Section>, Option<&'f Section>);

/// Pairs the sections of two lists of facts: by position if the lists have the same length, otherwise by title.
fn pairs<'f>(expected: &'f [Section], found: &'f [Section]) -> Vec<Pair<'f>> {
    if expected.len() == found.len() {
        return expected.iter().map(Some).zip(found.iter().map(Some)).collect();
    }
    let title = |s: &Section| (s.head.kind == "scene", s.head.names.clone());
    let mut pairs = Vec::new();
    let mut next = 0;
    for old in expected {
        let same = found[next..].iter().position(|new| title(new) == title(old));
        match same {
            Some(far) => {
                pairs.extend(found[next..next + far].iter().map(|new| (None, Some(new))));
                pairs.push((Some(old), Some(&found[next + far])));
                next += far + 1;
            }
            None => pairs.push((Some(old), None)),
        }
    }
    pairs.extend(found[next..].iter().map(|new| (None, Some(new))));
    pairs
}

fn heading(section: &Section) -> String {
    match section.head.names.first().filter(|n| !n.is_empty()) {
        Some(title) => format!("{} ({title})", section.head.kind),
        None => section.head.kind.clone(),
    }
}

/// Compares the facts of two paired sections, and adds the differences to `changes`.
fn section(old: &Section, new: &Section, several: bool, changes: &mut Vec<Change>) {
    let is_frame = new.head.kind.starts_with("frame ");
    let place = if several && is_frame { format!("{}: ", new.head.kind) } else { String::new() };
    let before = changes.len();
    head(old, new, is_frame, changes);
    let (was, is) = (by_name(&old.facts), by_name(&new.facts));
    let mut names = ordered_keys(&was, &is, new);
    group_falling(&was, &is, &mut names, &place, changes);
    for key in names {
        let change = match (was.get(key), is.get(key)) {
            (Some(old), Some(new)) => values(&old.values, &new.values).map(|(words, weight)| {
                let is_failure = key.0.starts_with("failure");
                Change {
                    words: format!("{place}{}: {words}", called(key)),
                    weight: weight + if is_failure { FAILURE_WEIGHT } else { 0.0 },
                }
            }),
            (Some(old), None) => Some(presence_change(key, old, &place, PresenceChange::Gone)),
            (None, Some(new)) => Some(presence_change(key, new, &place, PresenceChange::New)),
            (None, None) => None,
        };
        changes.extend(change);
    }
    for kind in ["block", "interface"] {
        group_equal(before, &place, kind, changes);
    }
    if !is_frame {
        for cause in &mut changes[before..] {
            cause.weight += CAUSE_WEIGHT;
        }
    }
}

/// Compares the headings of two sections: their titles, and their values. The value of a frame is its verdict. The
/// values of a scene are gravity and kernel.
fn head(old: &Section, new: &Section, is_frame: bool, changes: &mut Vec<Change>) {
    let what = if is_frame { heading(new) } else { "the scene".into() };
    if old.head.names != new.head.names {
        let title = |s: &Section| s.head.names.first().cloned().unwrap_or_default();
        changes.push(Change {
            words: format!("{what}: the title was \"{}\", and is now \"{}\"", title(old), title(new)),
            weight: FAILURE_WEIGHT,
        });
    }
    if let Some((words, weight)) = values(&old.head.values, &new.head.values) {
        changes
            .push(Change { words: format!("{what}: {words}"), weight: if is_frame { VERDICT_WEIGHT } else { weight } });
    }
}

/// Returns the keys of old and new facts, in the order of the new facts. Keys of facts that no longer exist come last.
fn ordered_keys<'k>(was: &'k ByName<'_>, is: &'k ByName<'_>, new: &Section) -> Vec<&'k Key> {
    let order = |key: &Key| {
        let kind = if key.0 == FALLING_FACT { "block" } else { &key.0 };
        let same = |f: &Fact| f.kind == kind && f.names == key.1;
        let place = new.facts.iter().position(same);
        (place.unwrap_or(usize::MAX), key.2)
    };
    let mut names: Vec<&Key> = was.keys().chain(is.keys()).collect();
    names.sort_by(|a, b| order(a).cmp(&order(b)).then(a.cmp(b)));
    names.dedup();
    names
}

/// If more than [`MAX_SINGLE_CHANGES`] blocks begin to fall, reports all of them in one line, and removes their keys
/// from `names`. Does the same for blocks that no longer fall.
fn group_falling(was: &ByName<'_>, is: &ByName<'_>, names: &mut Vec<&Key>, place: &str, changes: &mut Vec<Change>) {
    for (before, now, what) in [(was, is, "no longer stand"), (is, was, "no longer fall")] {
        let fresh = |key: &Key| key.0 == FALLING_FACT && now.contains_key(key) && !before.contains_key(key);
        let who: Vec<String> = names.iter().filter(|k| fresh(k)).map(|k| k.1.join("–")).collect();
        if who.len() <= MAX_SINGLE_CHANGES {
            continue;
        }
        names.retain(|key| !fresh(key));
        changes.push(Change {
            words: format!("{place}{} blocks {what}: {}", who.len(), who.join(", ")),
            weight: FALL_WEIGHT,
        });
    }
}

/// The key of a fact: kind, names, and a counter for facts with the same kind and names.
type Key = (String, Vec<String>, usize);

/// Facts by key.
type ByName<'f> = BTreeMap<Key, &'f Fact>;

fn by_name(facts: &[Fact]) -> ByName<'_> {
    let mut known: ByName<'_> = BTreeMap::new();
    let mut counts: BTreeMap<(&str, &[String]), usize> = BTreeMap::new();
    for fact in facts {
        let falls = fact.values.iter().any(|v| v.unit == "falls");
        let kind = if falls { FALLING_FACT } else { &fact.kind };
        let count = counts.entry((kind, &fact.names)).or_default();
        known.insert((kind.to_owned(), fact.names.clone(), *count), fact);
        *count += 1;
    }
    known
}

/// Returns the name of the object of a fact for messages: `interface a–ground`, `block c`.
fn called((kind, names, number): &Key) -> String {
    let number = match number {
        0 => String::new(),
        n => format!(" (no. {})", n + 1),
    };
    let names = match kind.as_str() {
        // The names are the two materials of a pair.
        "friction" => names.join(" on "),
        "robot" | "failure robot" => names.join(" on "),
        _ => names.join("–"),
    };
    match (kind.as_str(), names.as_str()) {
        ("sums", _) => "all together".into(),
        (kind, "") => format!("{kind}{number}"),
        ("load", names) => format!("load on {names}{number}"),
        ("limits", names) => format!("limits of robot {names}{number}"),
        ("friction", names) => format!("friction of {names}{number}"),
        ("failure robot", names) => format!("missing from robot {names}{number}"),
        ("failure tension", names) => format!("tension at {names}{number}"),
        ("failure friction", names) => format!("sliding at {names}{number}"),
        (kind, names) => format!("{kind} {names}{number}"),
    }
}

enum PresenceChange {
    Gone,
    New,
}

fn presence_change(key: &Key, fact: &Fact, place: &str, presence: PresenceChange) -> Change {
    let block = key.1.join("–");
    let (words, weight) = match (key.0.as_str(), presence) {
        (FALLING_FACT, PresenceChange::New) => (format!("block {block} no longer stands"), FALL_WEIGHT),
        (FALLING_FACT, PresenceChange::Gone) => (format!("block {block} no longer falls"), FALL_WEIGHT),
        (kind, presence) => {
            let weight = if kind.starts_with("failure") { FAILURE_WEIGHT } else { PRESENCE_WEIGHT };
            let first = fact.values.first().map(described).unwrap_or_default();
            let is = match presence {
                PresenceChange::Gone => "is gone:",
                PresenceChange::New => "is new:",
            };
            (format!("{} {is} {first}", called(key)), weight)
        }
    };
    Change { words: format!("{place}{words}"), weight }
}

fn described(value: &Value) -> String {
    let numbers: Vec<String> = value.numbers.iter().map(|n| short(n)).collect();
    let parts = [value.name.clone(), numbers.join(", "), value.unit.clone()];
    let parts: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
    parts.join(" ")
}

/// Returns a description of all changed values, and the weight of the largest change. Returns `None` if no value
/// changed.
fn values(old: &[Value], new: &[Value]) -> Option<(String, f64)> {
    let mut words = Vec::new();
    let mut weight: f64 = 0.0;
    for now in new {
        let Some(before) = old.iter().find(|v| v.name == now.name) else {
            words.push(format!("{} is new", described(now)));
            continue;
        };
        if let Some(by) = differ(before, now) {
            weight = weight.max(by);
            words.push(change(before, now));
        }
    }
    for before in old {
        if !new.iter().any(|v| v.name == before.name) {
            words.push(format!("{} is gone", described(before)));
        }
    }
    (!words.is_empty()).then(|| (words.join(", "), weight))
}

/// Describes a changed value: `N 3 → 4.2 N`, `stable → unstable`.
fn change(old: &Value, new: &Value) -> String {
    let name = if new.name.is_empty() { String::new() } else { format!("{} ", new.name) };
    if old.numbers.is_empty() || new.numbers.is_empty() || old.unit != new.unit {
        let bare = |v: &Value| described(&Value { name: String::new(), ..v.clone() });
        return format!("{name}{} → {}", bare(old), bare(new));
    }
    let list = |v: &Value| v.numbers.iter().map(|n| short(n)).collect::<Vec<_>>().join(", ");
    let unit = if new.unit.is_empty() { String::new() } else { format!(" {}", new.unit) };
    format!("{name}{} → {}{unit}", list(old), list(new))
}

/// Returns the largest difference between the numbers of two values, in units of their last digit (1e-6 for numbers
/// without a unit). Returns `None` if rounding can explain the difference. Returns 1e6 if the values differ in their
/// unit, in their word or in how many numbers they have, or if only one of two numbers is `none`.
fn differ(old: &Value, new: &Value) -> Option<f64> {
    let shape = old.unit == new.unit && old.numbers.len() == new.numbers.len();
    if !shape {
        return Some(1e6);
    }
    let mut most: f64 = 0.0;
    for (a, b) in old.numbers.iter().zip(&new.numbers) {
        match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => {
                // Numbers without a unit are counts and coefficients. They have no rounding error of the solver, so
                // they are compared in a fixed small unit.
                let rounded = last_digit(a).max(last_digit(b));
                let digit = if new.unit.is_empty() { UNITLESS_STEP } else { rounded };
                most = most.max((x - y).abs() / digit);
            }
            _ if a == b => {}
            _ => most = 1e6,
        }
    }
    // A rounding error of the solver may change the last digit by 1 unit. A change by 2 units is reported, so the
    // limit is 1.5.
    (most > 1.5).then_some(most)
}
