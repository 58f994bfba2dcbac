//! What is wrong with a text that is no JSON, in words that help: the reader's own are for programmers.

use std::ops::Range;

use super::format::{Refusal, RefusalKind};
use super::problem::{self, Problems, Wording};
use super::source::Source;

/// The one problem of a text that is no JSON.
pub(super) fn problem(text: &str, refusal: &Refusal) -> Problems {
    let source = Source::plain(text);
    let byte = source.byte(refusal.line, refusal.column);
    let (span, wording) = explain(&source, byte, refusal);
    Problems::of_text(&source, span, wording)
}

/// The one problem of bytes that are no text.
pub(super) fn not_utf8(bytes: &[u8], valid: usize) -> Problems {
    let text = String::from_utf8_lossy(bytes);
    let source = Source::plain(&text);
    let utf16 = bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]);
    let byte = bytes.get(valid).copied().unwrap_or(0);
    // The replacement character stands where the text breaks off; up to there text and bytes agree.
    let end = text[valid..]
        .chars()
        .next()
        .map_or(valid, |c| valid + c.len_utf8());
    Problems::of_text(&source, valid..end, problem::text::not_utf8(byte, utf16))
}

fn explain(source: &Source<'_>, byte: usize, refusal: &Refusal) -> (Range<usize>, Wording) {
    let text = source.text;
    let one = byte..text[byte..]
        .chars()
        .next()
        .map_or(byte, |c| byte + c.len_utf8());
    if text.trim().is_empty() {
        return (0..0, problem::text::empty_text());
    }
    if refusal.kind == RefusalKind::End {
        let opened = open_bracket(text).map(|(c, at)| {
            let (line, column) = source.place(at);
            (c, line, column)
        });
        let end = text.trim_end().len();
        return (end..end, problem::text::early_end(opened));
    }
    let words = refusal.words.as_str();
    if words.contains("recursion limit") {
        return (one, problem::text::too_deep());
    }
    if words.contains("control character") {
        return open_string(source, byte);
    }
    if words.contains("escape") || words.contains("surrogate") {
        return (one, problem::text::not_json(words));
    }
    let token = token(text, byte);
    let found = &text[token.clone()];
    if words.contains("number out of range") {
        return (token.clone(), problem::text::number_too_large(found));
    }
    if let Some(wording) = known_token(found) {
        return (token, wording);
    }
    match text[byte..].trim_start().chars().next() {
        Some('/' | '#') => return (one, problem::text::comment()),
        Some('\'') => return (one, problem::text::single_quotes()),
        _ => {}
    }
    if words.contains("trailing comma") {
        let comma = text[..byte].rfind(',').map_or(one, |c| c..c + 1);
        return (comma, problem::text::trailing_comma());
    }
    if words.contains("expected `,`") {
        return (one, problem::text::missing_comma(words));
    }
    (one, problem::text::not_json(words))
}

/// What to say of words and numbers that other languages know.
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
    let sound = found.parse::<f64>().is_ok() && is_json_number(found);
    (digits && !sound).then(|| problem::text::odd_number(found))
}

/// Whether a text that is a number for Rust is one for JSON.
fn is_json_number(text: &str) -> bool {
    let whole = text.strip_prefix('-').unwrap_or(text);
    let digits = whole.bytes().take_while(u8::is_ascii_digit).count();
    let rest = &whole[digits..];
    digits > 0
        && (digits == 1 || !whole.starts_with('0'))
        && rest
            .strip_prefix('.')
            .is_none_or(|f| f.starts_with(|c: char| c.is_ascii_digit()))
}

/// The word or number that touches a byte.
fn token(text: &str, byte: usize) -> Range<usize> {
    let part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-');
    let before = text[..byte]
        .chars()
        .rev()
        .take_while(|c| part(*c))
        .map(char::len_utf8)
        .sum::<usize>();
    let after = text[byte..]
        .chars()
        .take_while(|c| part(*c))
        .map(char::len_utf8)
        .sum::<usize>();
    byte - before..byte + after
}

/// A string that is still open where its line ends.
fn open_string(source: &Source<'_>, byte: usize) -> (Range<usize>, Wording) {
    let text = source.text;
    let broken = text[..byte].trim_end_matches(['\n', '\r']).len();
    let start = match open_bracket(&text[..broken]) {
        Some(('"', start)) => start,
        _ => broken,
    };
    (start..broken, problem::text::open_string())
}

/// The innermost bracket, brace or quote that is still open at the end.
fn open_bracket(text: &str) -> Option<(char, usize)> {
    let mut open = Vec::new();
    let mut quote = None;
    let mut escaped = false;
    for (i, c) in text.char_indices() {
        if quote.is_some() {
            match c {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '"' => quote = None,
                _ => {}
            }
            continue;
        }
        match c {
            '"' => quote = Some((c, i)),
            '[' | '{' => open.push((c, i)),
            ']' | '}' => {
                open.pop();
            }
            _ => {}
        }
    }
    quote.or(open.last().copied())
}
