//! What became of facts, in words.

use std::collections::BTreeMap;

use super::round::{PLAIN, last_digit, short};
use super::{Fact, Facts, Section, Value};

/// Something that is not as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What, in words on one line.
    pub words: String,
    /// How much it matters: verdicts first, then what there is, then by how much numbers changed, the most first.
    weight: f64,
}

/// What a block is that falls.
const FALLING: &str = "falling";
/// So many blocks that begin or cease to fall are listed one by one.
const ONE_BY_ONE: usize = 4;

/// Before everything else: a verdict.
const VERDICT: f64 = 4e9;
/// Then what falls.
const FALL: f64 = 3e9;
/// Then what is there or not.
const THERE: f64 = 2e9;
/// Then what fails.
const FAILURE: f64 = 1e9;

pub(super) fn changes(expected: &Facts, found: &Facts) -> Vec<Change> {
    let mut changes = Vec::new();
    let several = expected.sections.len().max(found.sections.len()) > 2;
    for (old, new) in pairs(&expected.sections, &found.sections) {
        match (old, new) {
            (Some(old), Some(new)) => section(old, new, several, &mut changes),
            (Some(old), None) => changes.push(Change {
                words: format!("{} is gone", heading(old)),
                weight: THERE,
            }),
            (None, Some(new)) => changes.push(Change {
                words: format!("{} is new", heading(new)),
                weight: THERE,
            }),
            (None, None) => {}
        }
    }
    // Stable: in the order of the facts where they matter alike.
    changes.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    changes
}

type Pair<'f> = (Option<&'f Section>, Option<&'f Section>);

/// Sections that belong together: by their order where there are as many, else frames by their titles.
fn pairs<'f>(expected: &'f [Section], found: &'f [Section]) -> Vec<Pair<'f>> {
    if expected.len() == found.len() {
        return expected
            .iter()
            .map(Some)
            .zip(found.iter().map(Some))
            .collect();
    }
    let title = |s: &Section| (s.head.kind == "scene", s.head.names.clone());
    let mut pairs = Vec::new();
    let mut next = 0;
    for old in expected {
        let same = found[next..]
            .iter()
            .position(|new| title(new) == title(old));
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

fn section(old: &Section, new: &Section, several: bool, changes: &mut Vec<Change>) {
    let is_frame = new.head.kind.starts_with("frame ");
    let place = if several && is_frame {
        format!("{}: ", new.head.kind)
    } else {
        String::new()
    };
    if old.head.names != new.head.names {
        let title = |s: &Section| s.head.names.first().cloned().unwrap_or_default();
        let what = if is_frame {
            heading(new)
        } else {
            "the scene".into()
        };
        changes.push(Change {
            words: format!(
                "{what}: the title was \"{}\", it is \"{}\"",
                title(old),
                title(new)
            ),
            weight: FAILURE,
        });
    }
    if let Some((words, weight)) = values(&old.head.values, &new.head.values) {
        let (what, weight) = if is_frame {
            (heading(new), VERDICT)
        } else {
            ("the scene".into(), weight)
        };
        changes.push(Change {
            words: format!("{what}: {words}"),
            weight,
        });
    }
    let (was, is) = (by_name(&old.facts), by_name(&new.facts));
    let mut names: Vec<&Key> = was.keys().chain(is.keys()).collect();
    // In the order of the new facts, what is gone behind them.
    let order = |key: &Key| {
        let kind = if key.0 == FALLING { "block" } else { &key.0 };
        let same = |f: &Fact| f.kind == kind && f.names == key.1;
        let place = new.facts.iter().position(same);
        (place.unwrap_or(usize::MAX), key.2)
    };
    names.sort_by(|a, b| order(a).cmp(&order(b)).then(a.cmp(b)));
    names.dedup();
    for (before, now, what) in [
        (&was, &is, "no longer stand"),
        (&is, &was, "fall no longer"),
    ] {
        let fresh =
            |key: &Key| key.0 == FALLING && now.contains_key(key) && !before.contains_key(key);
        let who: Vec<String> = names
            .iter()
            .filter(|k| fresh(k))
            .map(|k| k.1.join("–"))
            .collect();
        if who.len() <= ONE_BY_ONE {
            continue;
        }
        names.retain(|key| !fresh(key));
        changes.push(Change {
            words: format!("{place}{} blocks {what}: {}", who.len(), who.join(", ")),
            weight: FALL,
        });
    }
    for key in names {
        let change = match (was.get(key), is.get(key)) {
            (Some(old), Some(new)) => {
                values(&old.values, &new.values).map(|(words, weight)| Change {
                    words: format!("{place}{}: {words}", called(key)),
                    weight: weight
                        + if key.0.starts_with("failure") {
                            FAILURE
                        } else {
                            0.0
                        },
                })
            }
            (Some(old), None) => Some(came_or_went(key, old, &place, Way::Gone)),
            (None, Some(new)) => Some(came_or_went(key, new, &place, Way::New)),
            (None, None) => None,
        };
        changes.extend(change);
    }
}

/// Kind, names, and the how manieth of these.
type Key = (String, Vec<String>, usize);

/// Facts by what is known of them.
type ByName<'f> = BTreeMap<Key, &'f Fact>;

fn by_name(facts: &[Fact]) -> ByName<'_> {
    let mut known: ByName<'_> = BTreeMap::new();
    let mut counts: BTreeMap<(&str, &[String]), usize> = BTreeMap::new();
    for fact in facts {
        let falls = fact.values.iter().any(|v| v.unit == "falls");
        let kind = if falls { FALLING } else { &fact.kind };
        let count = counts.entry((kind, &fact.names)).or_default();
        known.insert((kind.to_owned(), fact.names.clone(), *count), fact);
        *count += 1;
    }
    known
}

/// `interface a–ground`, `block c`.
fn called((kind, names, number): &Key) -> String {
    let number = match number {
        0 => String::new(),
        n => format!(" (no. {})", n + 1),
    };
    let names = match kind.as_str() {
        "robot" | "failure robot" => names.join(" on "),
        _ => names.join("–"),
    };
    match (kind.as_str(), names.as_str()) {
        ("sums", _) => "all together".into(),
        (kind, "") => format!("{kind}{number}"),
        ("failure robot", names) => format!("missing from robot {names}{number}"),
        ("failure tension", names) => format!("tension at {names}{number}"),
        ("failure friction", names) => format!("sliding at {names}{number}"),
        (kind, names) => format!("{kind} {names}{number}"),
    }
}

enum Way {
    Gone,
    New,
}

fn came_or_went(key: &Key, fact: &Fact, place: &str, way: Way) -> Change {
    let block = key.1.join("–");
    let (words, weight) = match (key.0.as_str(), way) {
        (FALLING, Way::New) => (format!("block {block} no longer stands"), FALL),
        (FALLING, Way::Gone) => (format!("block {block} falls no longer"), FALL),
        (kind, way) => {
            let weight = if kind.starts_with("failure") {
                FAILURE
            } else {
                THERE
            };
            let first = fact.values.first().map(described).unwrap_or_default();
            let is = match way {
                Way::Gone => "is gone:",
                Way::New => "is new:",
            };
            (format!("{} {is} {first}", called(key)), weight)
        }
    };
    Change {
        words: format!("{place}{words}"),
        weight,
    }
}

fn described(value: &Value) -> String {
    let numbers: Vec<String> = value.numbers.iter().map(|n| short(n)).collect();
    let parts = [value.name.clone(), numbers.join(", "), value.unit.clone()];
    let parts: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
    parts.join(" ")
}

/// What changed among values, in words, and how much the largest change matters.
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

/// `N 3 → 4.2 N`, `stable → unstable`.
fn change(old: &Value, new: &Value) -> String {
    let name = if new.name.is_empty() {
        String::new()
    } else {
        format!("{} ", new.name)
    };
    if old.numbers.is_empty() || new.numbers.is_empty() || old.unit != new.unit {
        let bare = |v: &Value| {
            described(&Value {
                name: String::new(),
                ..v.clone()
            })
        };
        return format!("{name}{} → {}", bare(old), bare(new));
    }
    let list = |v: &Value| {
        v.numbers
            .iter()
            .map(|n| short(n))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let unit = if new.unit.is_empty() {
        String::new()
    } else {
        format!(" {}", new.unit)
    };
    format!("{name}{} → {}{unit}", list(old), list(new))
}

/// By how many of their last digits two values differ, where that is more than rounding explains.
fn differ(old: &Value, new: &Value) -> Option<f64> {
    let shape = old.unit == new.unit && old.numbers.len() == new.numbers.len();
    if !shape {
        return Some(1e6);
    }
    let mut most: f64 = 0.0;
    for (a, b) in old.numbers.iter().zip(&new.numbers) {
        match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => {
                // Without a unit they are counts and coefficients, which nothing was solved for.
                let rounded = last_digit(a).max(last_digit(b));
                let digit = if new.unit.is_empty() { PLAIN } else { rounded };
                most = most.max((x - y).abs() / digit);
            }
            _ if a == b => {}
            _ => most = 1e6,
        }
    }
    // 1½: each of the two may have been rounded to the other side of the same number.
    (most > 1.5).then_some(most)
}
