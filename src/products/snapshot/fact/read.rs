//! Reads facts from the text of a reference file.

use super::write::FIRST_WORDS;
use super::{Fact, Facts, Section, Value, Version};

/// The reason why a text is not a list of facts.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FactsError {
    /// The file is empty.
    #[error("it is empty (0 bytes)")]
    Empty,
    /// A Git LFS pointer in place of the file.
    #[error("it is a Git LFS pointer and not the facts; fetch them with `git lfs pull`")]
    Pointer,
    /// A file with merge conflicts.
    #[error("line {0} is a mark of a merge conflict; resolve it, or accept the facts again")]
    Conflict(usize),
    /// The first line does not identify the file as a list of facts.
    #[error("its first line is not \"{FIRST_WORDS}1\" or \"{FIRST_WORDS}2\"")]
    Foreign,
    /// A line that cannot be read.
    #[error("line {line} is not a fact: {text}")]
    Line {
        /// The number of the line, counted from 1.
        line: usize,
        /// The beginning of the line.
        text: String,
    },
}

pub(super) fn facts(text: &str) -> Result<Facts, FactsError> {
    let text = text.trim_start_matches('\u{feff}');
    if text.trim().is_empty() {
        return Err(FactsError::Empty);
    }
    if text.starts_with("version https://git-lfs") {
        return Err(FactsError::Pointer);
    }
    if let Some(line) = text.lines().position(crate::text::is_conflict_mark) {
        return Err(FactsError::Conflict(line + 1));
    }
    let mut lines = text.lines().enumerate();
    let first = lines.next().map_or("", |(_, line)| line.trim_end());
    let version = Version::ALL
        .into_iter()
        .find(|version| first == format!("{FIRST_WORDS}{}", version.number()))
        .ok_or(FactsError::Foreign)?;
    let mut sections: Vec<Section> = Vec::new();
    for (number, line) in lines {
        if line.trim().is_empty() {
            continue;
        }
        let wrong = || FactsError::Line { line: number + 1, text: crate::text::heading(line, 60) };
        let fact = fact(line.trim()).ok_or_else(wrong)?;
        let is_heading = fact.kind == "scene" || fact.kind.starts_with("frame ");
        match sections.last_mut() {
            Some(section) if !is_heading => section.facts.push(fact),
            None if !is_heading => return Err(wrong()),
            _ => sections.push(Section { head: fact, facts: Vec::new() }),
        }
    }
    Ok(Facts { version, sections })
}

/// Reads a line of the form `kind "name" "name": value, value`; `None` if it has another form.
fn fact(line: &str) -> Option<Fact> {
    let begin = line.find(['"', ':'])?;
    let kind = line[..begin].trim().to_owned();
    let mut rest = &line[begin..];
    let mut names = Vec::new();
    while let Some(quoted) = rest.strip_prefix('"') {
        let (name, behind) = unquoted(quoted)?;
        names.push(name);
        rest = behind.trim_start();
    }
    let values = rest.strip_prefix(':')?.trim();
    let values: Vec<Value> = values.split(", ").map(value).collect();
    let is_valid = !kind.is_empty() && values.iter().all(|v| !v.unit.is_empty() || !v.numbers.is_empty());
    is_valid.then_some(Fact { kind, names, values })
}

/// Reads a quoted name from `text`, which begins after the opening quotation mark. Returns the name with escaped
/// characters restored, and the text after the closing quotation mark. Returns `None` if there is no closing
/// quotation mark.
fn unquoted(text: &str) -> Option<(String, &str)> {
    let mut name = String::new();
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' if !escaped => return Some((name, &text[at + 1..])),
            '\\' if !escaped => escaped = true,
            c => {
                name.push(c);
                escaped = false;
            }
        }
    }
    None
}

/// Reads a value: a name, numbers and a unit, or only a word.
fn value(text: &str) -> Value {
    let parts: Vec<&str> = text.split_whitespace().collect();
    let is_number = |part: &&str| part.parse::<f64>().is_ok() || *part == "none";
    let Some(first) = parts.iter().position(&is_number) else {
        return Value { name: String::new(), numbers: Vec::new(), unit: text.trim().to_owned() };
    };
    let count = parts[first..].iter().take_while(|p| is_number(p)).count();
    let numbers = parts[first..first + count].iter().map(|p| (*p).to_owned());
    Value { name: parts[..first].join(" "), numbers: numbers.collect(), unit: parts[first + count..].join(" ") }
}
