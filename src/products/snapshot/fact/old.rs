//! Reads facts from files of the versions 1 and 2, which earlier versions of drystone wrote as lines of text, such as
//! `interface "a" "ground": N 8.00000 N, N at its ends 4.00000 4.00000 N, μ 0.7`.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::{Fact, Facts, QUANTITIES};
use crate::products::snapshot::layer::UnreadableReference;
use crate::text::heading;

/// The first words of these files; the version follows.
pub(super) const FIRST_WORDS: &str = "drystone facts ";

pub(super) fn read(text: &str) -> Result<Facts, UnreadableReference> {
    let wrong = |number: usize, line: &str| {
        UnreadableReference(format!("line {} is not a fact: {}", number + 1, heading(line, 60)))
    };
    let mut facts = Facts { drystone_facts: 0, decimals: BTreeMap::new(), sections: Vec::new() };
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        if number == 0 {
            let version = line.trim_start_matches(FIRST_WORDS).trim().parse();
            facts.drystone_facts = version.ok().filter(|v| [1, 2].contains(v)).ok_or_else(|| wrong(0, line))?;
            continue;
        }
        let fact = fact(line.trim(), &mut facts.decimals).ok_or_else(|| wrong(number, line))?;
        if fact.kind == "scene" || fact.kind.starts_with("frame ") {
            facts.sections.push(Vec::new());
        }
        facts.sections.last_mut().ok_or_else(|| wrong(number, line))?.push(fact);
    }
    Ok(facts)
}

/// Reads a line of the form `kind "name" "name": value, value`; `None` if it has another form. Adds the decimals of its
/// numbers to `decimals`.
fn fact(line: &str, decimals: &mut BTreeMap<String, i32>) -> Option<Fact> {
    let begin = line.find(['"', ':'])?;
    let mut rest = &line[begin..];
    let mut names = Vec::new();
    while rest.starts_with('"') {
        // Names are escaped as in JSON.
        let mut strings = serde_json::Deserializer::from_str(rest).into_iter::<String>();
        names.push(strings.next()?.ok()?);
        rest = rest[strings.byte_offset()..].trim_start();
    }
    let mut fact = Fact { kind: line[..begin].trim().to_owned(), names, values: BTreeMap::new() };
    for value in rest.strip_prefix(':')?.trim().split(", ") {
        let words: Vec<&str> = value.split_whitespace().collect();
        let is_number = |word: &str| word.parse::<f64>().is_ok() || word == "none";
        let Some(first) = words.iter().position(|word| is_number(word)) else {
            if value == "falls" {
                fact.kind = "falls".into();
            } else {
                fact.values.insert("verdict".into(), value.into());
            }
            continue;
        };
        let end = words.iter().rposition(|word| is_number(word))?;
        let (name, unit) = (words[..first].join(" "), words[end + 1..].join(" "));
        let key = QUANTITIES.iter().find(|q| q.1 == name && q.2 == unit)?.0;
        let numbers: Vec<Value> = words[first..=end].iter().map(|word| json!(word.parse::<f64>().ok())).collect();
        for word in words[first..=end].iter().filter(|word| **word != "none") {
            let (mantissa, exponent) = word.split_once('e').unwrap_or((word, "0"));
            let written = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
            decimals.insert(unit.clone(), written - exponent.parse::<i32>().ok()?);
        }
        let several = ["at", "centroid", "force", "gravity", "normal_forces"].contains(&key) || numbers.len() > 1;
        let value = if several { Value::Array(numbers) } else { numbers.into_iter().next()? };
        fact.values.insert(key.into(), value);
    }
    Some(fact)
}
