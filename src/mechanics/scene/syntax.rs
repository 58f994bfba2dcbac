//! Chooses the message and the place for the error in a text that is not JSON.

use std::ops::Range;

use super::problem::{self, SceneError, Wording};
use super::source::Source;
use super::tree::{SyntaxError, Why};

/// Returns the error for a text that is not JSON, with the place and the reason.
pub(super) fn problem(text: &str, fault: SyntaxError) -> SceneError {
    let source = Source::plain(text);
    let (span, wording) = explain(&source, fault);
    SceneError::of_text(&source, span, wording)
}

/// Returns the error for bytes that are not UTF-8. The first `valid` bytes are UTF-8.
pub(super) fn not_utf8(bytes: &[u8], valid: usize) -> SceneError {
    let text = String::from_utf8_lossy(bytes);
    let source = Source::plain(&text);
    let utf16 = bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]);
    let byte = bytes.get(valid).copied().unwrap_or(0);
    // The text contains a replacement character in place of the invalid byte. Before this character, the text and the
    // bytes are equal.
    SceneError::of_text(&source, one(&text, valid), problem::text::not_utf8(byte, utf16))
}

/// Returns the range of bytes of the character that begins at the byte with the index `byte`.
fn one(text: &str, byte: usize) -> Range<usize> {
    let length = text[byte..].chars().next().map_or(0, char::len_utf8);
    byte..byte + length
}

fn explain(source: &Source<'_>, fault: SyntaxError) -> (Range<usize>, Wording) {
    let text = source.text;
    if text.trim().is_empty() {
        return (0..0, problem::text::empty_text());
    }
    if let Some(line) = conflict(text) {
        return (line, problem::text::conflict());
    }
    if let Some((line, format)) = other_format(text) {
        return (line, problem::text::other_format(format));
    }
    let here = one(text, fault.at);
    match fault.why {
        Why::End(open) => {
            let opened = open.map(|(c, at)| {
                let (line, column) = source.place(at);
                (c, line, column)
            });
            let end = text.trim_end().len();
            (end..end, problem::text::early_end(opened))
        }
        Why::TooDeep => (here, problem::text::too_deep()),
        Why::Control(quote) => {
            let broken = text[..fault.at].trim_end_matches(['\n', '\r']).len();
            (quote..broken.max(quote + 1), problem::text::open_string())
        }
        Why::Escape => (here, problem::text::escape()),
        Why::Surrogate => (here, problem::text::surrogate()),
        Why::TrailingComma(comma) => (comma..comma + 1, problem::text::trailing_comma()),
        Why::Value | Why::Key | Why::Colon | Why::Comma(_) | Why::Behind => unexpected(text, fault, here),
    }
}

/// Chooses the range of bytes to mark, and the message, for an unexpected character.
fn unexpected(text: &str, fault: SyntaxError, here: Range<usize>) -> (Range<usize>, Wording) {
    let token = token(text, fault.at);
    if let Some(wording) = known_token(&text[token.clone()]) {
        return (token, wording);
    }
    match text[fault.at..].chars().next() {
        Some('/' | '#') => return (here, problem::text::comment()),
        Some('\'') => return (here, problem::text::single_quotes()),
        _ => {}
    }
    let wording = match fault.why {
        Why::Comma(close) => problem::text::missing_comma(close),
        Why::Colon => problem::text::not_json("`:`"),
        Why::Key => problem::text::not_json("a key in double quotes"),
        Why::Behind => problem::text::behind_the_end(),
        _ => problem::text::not_json("a value"),
    };
    (here, wording)
}

/// Returns the range of bytes of the first line that a version control system wrote to mark a merge conflict. A line of
/// seven equal signs alone does not count.
fn conflict(text: &str) -> Option<Range<usize>> {
    let is_mark = |line: &&str| line.starts_with(['<', '>']) && crate::text::is_conflict_mark(line);
    let line = text.lines().find(is_mark)?;
    let start = line.as_ptr() as usize - text.as_ptr() as usize;
    Some(start..start + line.len())
}

/// If the first line of a text looks like YAML, TOML or XML, returns its range of bytes and the name of the format.
/// Blank lines and lines that begin with `#` are skipped.
fn other_format(text: &str) -> Option<(Range<usize>, &'static str)> {
    let line = text.split('\n').map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let start = line.as_ptr() as usize - text.as_ptr() as usize;
    let found = Some(start..start + line.len());
    let is_name = |name: &str| {
        let name = name.trim();
        !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '$'))
    };
    let table = line.strip_prefix('[').and_then(|l| l.split_once(']')).map(|l| l.0.trim_start_matches('['));
    let format = if line.starts_with('<') {
        "XML"
    } else if line.starts_with("---") || line.starts_with("- ") || line.starts_with("%YAML") {
        "YAML"
    } else if line.split_once('=').is_some_and(|(name, _)| is_name(name)) {
        "TOML"
    } else if line
        .split_once(':')
        .is_some_and(|(name, rest)| is_name(name) && (rest.is_empty() || rest.starts_with(' ')))
    {
        "YAML"
    } else if table.is_some_and(|name| is_name(name) && name.starts_with(char::is_alphabetic)) {
        "TOML"
    } else {
        return None;
    };
    found.map(|range| (range, format))
}

/// Returns the message about a word or number that is not valid in JSON, such as `True`, `NaN`, a string without quotes
/// or `+1`. `None` if `found` is valid JSON, or neither a word nor a number.
fn known_token(found: &str) -> Option<Wording> {
    let bare = found.trim_start_matches(['-', '+']);
    match bare {
        "NaN" | "nan" | "Infinity" | "infinity" | "Inf" | "inf" | "INF" => {
            return Some(problem::text::not_a_number(found));
        }
        "True" => return Some(problem::text::foreign_word(found, "true")),
        "False" => return Some(problem::text::foreign_word(found, "false")),
        "None" | "nil" | "undefined" => return Some(problem::text::foreign_word(found, "null")),
        "true" | "false" | "null" => return None,
        _ => {}
    }
    let first = found.chars().next()?;
    if first.is_alphabetic() || first == '_' {
        return Some(problem::text::bare_word(found));
    }
    let digits = found.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-'));
    let sound = super::tree::parse(found).is_ok();
    (digits && !sound).then(|| problem::text::odd_number(found))
}

/// Returns the range of bytes of the word or number around the byte with the index `byte`.
fn token(text: &str, byte: usize) -> Range<usize> {
    let part = |c: &char| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-');
    let length = |all: &mut dyn Iterator<Item = char>| all.map(char::len_utf8).sum::<usize>();
    let before = length(&mut text[..byte].chars().rev().take_while(part));
    let after = length(&mut text[byte..].chars().take_while(part));
    byte - before..byte + after
}
