//! Parses a text, and chooses the message and the place for an error in a text that cannot be parsed.

use std::ops::Range;

use super::mistake::{Broken, Cause, Dialect, Kind, Mistake};
use super::source::Source;
use super::tree::{SyntaxError, Why, parse};
use crate::text::shortened;

/// Parses a text in JSON.
///
/// # Errors
/// The first syntax error, with its place.
pub fn json<'t>(text: &'t str, dialect: &Dialect) -> Result<Source<'t>, Broken> {
    let tree = parse(text).map_err(|fault| {
        let (span, kind, message, help) = cause(text, fault, dialect);
        Broken { span, mistake: Mistake::new(kind, message, help) }
    })?;
    Ok(Source::new(text, tree))
}

/// Parses a text in TOML.
///
/// # Errors
/// Every syntax error, with its place.
#[cfg(feature = "toml")]
pub fn toml<'t>(text: &'t str, dialect: &Dialect) -> Result<Source<'t>, Vec<Broken>> {
    let help = dialect.help(Cause::NotToml, "correct the text here, or shortly before this place");
    let broken = |(span, why)| Broken {
        span,
        mistake: Mistake::new(Kind::Syntax, format!("this is not TOML: {why}"), help.clone()),
    };
    let tree = super::toml::parse(text).map_err(|errors| errors.into_iter().map(broken).collect::<Vec<_>>())?;
    Ok(Source::new(text, tree))
}

/// Returns the mistake of bytes that are not UTF-8. The first `valid` bytes are UTF-8. `text` is the text in which a
/// replacement character takes the place of each invalid byte.
pub fn not_utf8(bytes: &[u8], valid: usize, text: &str) -> Broken {
    let utf16 = bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]);
    let byte = bytes.get(valid).copied().unwrap_or(0);
    let help =
        if utf16 { "the file looks like UTF-16; save it as UTF-8" } else { "save the file in the encoding UTF-8" };
    // Before the first replacement character, the text and the bytes are equal.
    let span = one(text, valid);
    Broken { span, mistake: Mistake::new(Kind::NotUtf8, format!("the byte 0x{byte:02X} is not UTF-8 text"), help) }
}

/// Returns the range of bytes of the character that begins at the byte with the index `byte`.
fn one(text: &str, byte: usize) -> Range<usize> {
    let length = text[byte..].chars().next().map_or(0, char::len_utf8);
    byte..byte + length
}

/// The range of bytes to mark, the kind, the message and the remedy.
type Explained = (Range<usize>, Kind, String, String);

fn cause(text: &str, fault: SyntaxError, dialect: &Dialect) -> Explained {
    if text.trim().is_empty() {
        let help = dialect.help(Cause::Empty, "write `{}` for an empty object");
        return (0..0, Kind::Empty, "the file is empty".into(), help);
    }
    if let Some(line) = conflict(text) {
        let help = "keep one version, and delete the lines that begin with <<<<<<<, ======= and >>>>>>>";
        return (line, Kind::Syntax, "a merge conflict has left two versions of the text here".into(), help.into());
    }
    if let Some((line, format)) = other_format(text) {
        let help = dialect.help(Cause::OtherFormat(format), "write JSON, which begins with `{`");
        return (line, Kind::OtherFormat, format!("this looks like {format}"), help);
    }
    let here = one(text, fault.at);
    let not_json = |span: Range<usize>, message: &str, help: &str| (span, Kind::Syntax, message.into(), help.into());
    match fault.why {
        Why::End(open) => {
            let help = match open {
                Some((c, at)) => {
                    let (line, column) = Source::plain(text).place(at);
                    let line = dialect.lines_before + line;
                    format!(
                        "the `{c}` opened in line {line}, column {column} is never closed; is a part of the file missing?"
                    )
                }
                None => "a part of the file seems to be missing".into(),
            };
            let end = text.trim_end().len();
            (end..end, Kind::EndsEarly, "the file ends too early".into(), help)
        }
        Why::TooDeep => {
            let help = dialect.help(Cause::TooDeep, "write fewer levels of brackets");
            (here, Kind::TooDeep, "more than 127 brackets are open at once".into(), help)
        }
        Why::Control(quote) => {
            let broken = text[..fault.at].trim_end_matches(['\n', '\r']).len();
            not_json(
                quote..broken.max(quote + 1),
                "a string contains a line break or another control character",
                "close the string on its line; write a line break as \\n and a tab as \\t",
            )
        }
        Why::Escape => not_json(
            here,
            "JSON has no such escape sequence in a string",
            "write a backslash as \\\\, a line break as \\n, and any character by its code as \\u00e9",
        ),
        Why::Surrogate => not_json(
            here,
            "the escape is only half of a surrogate pair",
            "write the character itself, or both halves of its surrogate pair",
        ),
        Why::TrailingComma(comma) => not_json(
            comma..comma + 1,
            "there is a comma after the last entry",
            "remove the comma, or add the entry that follows it",
        ),
        Why::Value | Why::Key | Why::Colon | Why::Comma(_) | Why::Behind => unexpected(text, fault, here, dialect),
    }
}

/// Explains an unexpected character.
fn unexpected(text: &str, fault: SyntaxError, here: Range<usize>, dialect: &Dialect) -> Explained {
    let token = token(text, fault.at);
    if let Some((message, help)) = known_token(&text[token.clone()], dialect) {
        return (token, Kind::Syntax, message, help);
    }
    if fault.why == Why::Key
        && let Some(number) = decimal_comma(text, &token)
    {
        let message = format!("`{}` is not a number in JSON", number.replacen('.', ",", 1));
        return (token, Kind::Syntax, message, format!("write {number}, with a point"));
    }
    let quotes = "put strings and keys in double quotes".to_owned();
    let expected = |what: &str| {
        let message = format!("this is not JSON: expected {what}");
        (message, "correct the text here, or shortly before this place".to_owned())
    };
    let noun = dialect.noun;
    let (message, help) = match (text[fault.at..].chars().next(), fault.why) {
        (Some('/' | '#'), _) => ("JSON has no comments".into(), dialect.help(Cause::Comment, "remove the comment")),
        (Some('\''), _) => ("JSON has no single quotes".into(), quotes),
        (_, Why::Comma(close)) => {
            let help = "put a comma between entries, and check that every bracket is closed";
            (format!("expected `,` or `{close}`"), help.into())
        }
        (_, Why::Colon) => expected("`:`"),
        (_, Why::Key) => expected("a key in double quotes"),
        (_, Why::Behind) => (
            format!("there is text after the end of the {noun}"),
            format!("remove the text after the last bracket of the {noun}, or a superfluous closing bracket before it"),
        ),
        _ => expected("a value"),
    };
    (here, Kind::Syntax, message, help)
}

/// If the digits at `token` follow a comma and other digits, as in `0,6`, returns the number with a decimal point.
fn decimal_comma(text: &str, token: &Range<usize>) -> Option<String> {
    let digits = &text[token.clone()];
    let before = text[..token.start].strip_suffix(',')?;
    let start = before.rfind(|c: char| !(c.is_ascii_digit() || c == '-')).map_or(0, |i| i + 1);
    let whole = &before[start..];
    let is_number = |t: &str| !t.is_empty() && t.bytes().all(|b| b.is_ascii_digit());
    (is_number(whole.trim_start_matches('-')) && is_number(digits)).then(|| format!("{whole}.{digits}"))
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

/// Returns the message and the remedy for a word or number that is not valid in JSON, such as `True`, `NaN`, a string
/// without quotes or `+1`. `None` if `found` is valid JSON, or neither a word nor a number.
fn known_token(found: &str, dialect: &Dialect) -> Option<(String, String)> {
    let meant = match found.trim_start_matches(['-', '+']) {
        "NaN" | "nan" | "Infinity" | "infinity" | "Inf" | "inf" | "INF" => {
            let help = dialect.help(Cause::NotANumber, "give a finite number");
            return Some((format!("`{found}` is not a number in JSON"), help));
        }
        "True" => "true",
        "False" => "false",
        "None" | "nil" | "undefined" => "null",
        "true" | "false" | "null" => return None,
        _ => "",
    };
    if !meant.is_empty() {
        return Some((format!("`{found}` is not JSON"), format!("write `{meant}`")));
    }
    let first = found.chars().next()?;
    let short = shortened(found);
    if first.is_alphabetic() || first == '_' {
        return Some((format!("`{short}` is not JSON"), "put strings and keys in double quotes".into()));
    }
    let digits = first.is_ascii_digit() || matches!(first, '.' | '+' | '-');
    let help = "write numbers as 0.5, -2 or 1e3: no leading + or 0, and a digit on both sides of the point";
    (digits && parse(found).is_err()).then(|| (format!("`{short}` is not a number in JSON"), help.into()))
}

/// Returns the range of bytes of the word or number around the byte with the index `byte`.
fn token(text: &str, byte: usize) -> Range<usize> {
    let part = |c: &char| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-');
    let length = |all: &mut dyn Iterator<Item = char>| all.map(char::len_utf8).sum::<usize>();
    let before = length(&mut text[..byte].chars().rev().take_while(part));
    let after = length(&mut text[byte..].chars().take_while(part));
    byte - before..byte + after
}
